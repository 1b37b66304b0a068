#include "turnwright/volumetric/samba.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/volumetric/kinematics.hpp"

namespace turnwright::volumetric {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::string_view kAxes = "XYZBC";
constexpr double kLever = 100;  // length that makes angles comparable with shifts [mm]
// Above this component a null vector changes an unknown.  Directions that are null up to
// 1e-7 have components of up to 2e-6 in unknowns that they do not change, and above 1e-3
// in those they do.
constexpr double kMoves = 5e-5;

Vector3d column(const Vec3& v) { return {v[0], v[1], v[2]}; }

enum class Kind { facet, location, power, reversal };

struct Parameter {
  Kind kind = Kind::facet;
  char axis = 'X';
  std::size_t direction = 0;
  int power = 0;
};

std::optional<Parameter> parsed(const std::string& name) {
  if (name == "facet") return Parameter{};
  if (name.size() != 4 || name[0] != 'E') return std::nullopt;
  const std::size_t direction = letter_index(name[1]);
  const bool located = name[2] == '0';
  const char axis = located ? name[3] : name[2];
  if (direction == std::string_view::npos || kAxes.find(axis) == std::string_view::npos)
    return std::nullopt;
  Parameter p{.kind = Kind::location, .axis = axis, .direction = direction};
  if (located) {
    const bool across = direction > 2 && direction - 3 != letter_index(axis);
    if (is_rotary(axis) || across) return p;
    return std::nullopt;
  }
  if (name[3] == 'b') {
    p.kind = Kind::reversal;
    if (is_rotary(axis) || direction > 2) return std::nullopt;
    return p;
  }
  p.kind = Kind::power;
  p.power = name[3] - '0';
  if (p.power < 1 || p.power > 3) return std::nullopt;
  return p;
}

bool is_angle(const std::string& unknown) {
  const auto p = parsed(unknown);
  return p && p->kind != Kind::facet && p->direction > 2;
}

Matrix3d rotation(const Indexation& at) {
  return (Eigen::AngleAxisd(-at.B_rad, Vector3d::UnitY()) *
          Eigen::AngleAxisd(-at.C_rad, Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// d e/d parameter [mm/mm, mm/rad], in the workpiece frame.
Vector3d sensitivity(const Parameter& p, const std::vector<AxisEffect>& effects,
                     const Position& at) {
  if (p.kind == Kind::facet) return Vector3d::Zero();
  const AxisEffect& effect = *std::ranges::find(effects, p.axis, &AxisEffect::axis);
  const std::size_t k = letter_index(p.axis);
  const Vector3d e = column(effect.error[p.direction]);
  switch (p.kind) {
    case Kind::location:
      return is_rotary(p.axis) ? e : column(effect.squareness[p.direction - 3]);
    case Kind::reversal:
      return at.sign[k] * e;
    default:
      return std::pow(at.q[k] / default_Q(p.axis), p.power) * e;
  }
}

/// Positions of the axes with a tip at `target`, and the signs of the motion to it.
Position position(const Matrix3d& R, const Indexation& at, const Vec3& stylus,
                  const Vec3& target, const std::array<double, 3>& sign) {
  const Vector3d q = R * column(target) - column(stylus);
  Position p{.q = {q[0], q[1], q[2], 0, at.B_rad, at.C_rad}};
  std::ranges::copy(sign, p.sign.begin());
  return p;
}

/// The axis along which a facet is touched: that nearest to its normal, of equally near
/// ones the first, so that rounding does not decide.
Index probing_axis(const Vector3d& normal) {
  constexpr double kEquallyNear = 1e-9;
  const Vector3d size = normal.cwiseAbs();
  Index k = 0;
  while (size[k] < size.maxCoeff() - kEquallyNear) ++k;
  return k;
}

/// Calls ball(R, pose, stylus, index) and touch(R, pose, stylus, signs of X, Y, Z) for
/// each probing, in the order of the readings.
template <class Ball, class Touch>
void each_probing(const SambaStrategy& s, Ball ball, Touch touch) {
  const Vector3d n = column(s.facet_normal).normalized();
  for (const Indexation& at : s.indexations) {
    const Matrix3d R = rotation(at);
    const Vector3d on_machine = R * n;
    const Index probing = probing_axis(on_machine);
    for (const Vec3& stylus : s.styli_mm) {
      for (const std::size_t b : at.balls) ball(R, at, stylus, b);
      for (const auto& move : at.pre_moves) {
        std::array<double, 3> sign{};
        std::size_t next = 0;
        for (Index k = 0; k < 3; ++k)
          sign[static_cast<std::size_t>(k)] =
              k == probing ? (on_machine[k] > 0 ? -1.0 : 1.0) : move[next++];
        touch(R, at, stylus, sign);
      }
    }
  }
}

/// Equations (1) to (3), in the order of the readings.
class Equations {
 public:
  Equations(const SambaStrategy& strategy, const std::vector<std::string>& names)
      : strategy_(strategy), names_(names) {
    for (const std::string& name : names) {
      const auto p = parsed(name);
      if (!p || std::ranges::count(names, name) > 1)
        throw std::domain_error("samba: parameter " + name);
      parameters_.push_back(*p);
      if (p->kind == Kind::facet) facet_ = static_cast<Index>(parameters_.size()) - 1;
    }
    const auto in_range = [&](std::size_t ball) {
      return ball < strategy.balls_mm.size();
    };
    for (const Indexation& at : strategy.indexations)
      if (!std::ranges::all_of(at.balls, in_range))
        throw std::domain_error(
            "samba: a measurement names a ball that is not in balls_mm");
    if (!std::ranges::all_of(strategy.scale_bar_ends, in_range) ||
        strategy.styli_mm.empty())
      throw std::domain_error("samba: two ends of the scale bar and a stylus");
    tip_ = static_cast<Index>(names.size() + 3 * strategy.balls_mm.size());
    size_ = samba_size(strategy, names);
    if (!size_.solvable())
      throw ModelRangeError(
          say("samba: {} equations of {} unknowns, at most {:.0e} equations times the "
              "square of the unknowns are solved",
              size_.equations, size_.unknowns, kMostSambaWork));
  }

  std::size_t count() const { return size_.equations; }
  std::size_t parameters() const { return parameters_.size(); }

  std::vector<std::string> unknowns() const {
    std::vector<std::string> out = names_;
    for (std::size_t i = 0; i < strategy_.balls_mm.size(); ++i)
      for (const char c : {'x', 'y', 'z'})
        out.push_back("ball" + std::to_string(i + 1) + '_' + c);
    for (const char c : {'x', 'y', 'z'}) out.push_back(std::string("tip_") + c);
    return out;
  }

  /// Calls use(row) for each equation; so all of them never stand in memory at once.
  template <class Use>
  void each(Use use) const {
    const Vector3d n = column(strategy_.facet_normal).normalized();
    each_probing(
        strategy_,
        [&](const Matrix3d& R, const Indexation& at, const Vec3& stylus, std::size_t b) {
          leave_if_asked();
          MatrixXd row = tip(R, at, stylus, strategy_.balls_mm[b], {});
          row.middleCols<3>(ball(b)) = -Matrix3d::Identity();  // Eq. (1)
          for (Index k = 0; k < 3; ++k) use(VectorXd(row.row(k)));
        },
        [&](const Matrix3d& R, const Indexation& at, const Vec3& stylus,
            const std::array<double, 3>& sign) {
          leave_if_asked();
          VectorXd row = tip(R, at, stylus, strategy_.facet_mm, sign).transpose() * n;
          if (facet_) row[*facet_] = -1;  // Eq. (2)
          use(row);
        });
    const auto [a, b] = strategy_.scale_bar_ends;
    const Vector3d u =
        (column(strategy_.balls_mm[b]) - column(strategy_.balls_mm[a])).normalized();
    VectorXd row = VectorXd::Zero(tip_ + 3);
    row.segment<3>(ball(a)) = -u;
    row.segment<3>(ball(b)) = u;
    use(row);
  }

 private:
  Index ball(std::size_t i) const { return static_cast<Index>(names_.size() + 3 * i); }

  /// The tip's error at `target`, by unknown.
  MatrixXd tip(const Matrix3d& R, const Indexation& at, const Vec3& stylus,
               const Vec3& target, const std::array<double, 3>& sign) const {
    Machine machine{std::string(kSambaChain), stylus, {}};
    for (const char c : kAxes) machine.axes.push_back({c, {}, default_Q(c)});
    const Position there = position(R, at, stylus, target, sign);
    const auto effects = Kinematics(machine).effects(there);
    MatrixXd row = MatrixXd::Zero(3, tip_ + 3);
    for (std::size_t j = 0; j < parameters_.size(); ++j)
      row.col(static_cast<Index>(j)) = sensitivity(parameters_[j], effects, there);
    row.middleCols<3>(tip_) = R.transpose();
    return row;
  }

  const SambaStrategy& strategy_;
  const std::vector<std::string>& names_;
  std::vector<Parameter> parameters_;
  std::optional<Index> facet_;
  Index tip_ = 0;
  SambaSize size_;
};

VectorXd scales(const std::vector<std::string>& unknowns) {
  VectorXd s(static_cast<Index>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    s[static_cast<Index>(j)] = is_angle(unknowns[j]) ? kLever : 1.0;
  return s;
}

/// As many columns of N as it has rows, each the longest across those before it, of equally
/// long ones the first.  They depend on what the rows span alone, and not on rounding.
std::vector<Index> pivots(MatrixXd N) {
  constexpr double kEquallyLong = 1e-6;
  std::vector<Index> out;
  while (static_cast<Index>(out.size()) < N.rows()) {
    const VectorXd length = N.colwise().norm();
    Index longest = 0;
    while (length[longest] < (1 - kEquallyLong) * length.maxCoeff()) ++longest;
    const VectorXd u = N.col(longest) / length[longest];
    N -= u * (u.transpose() * N).eval();
    out.push_back(longest);
  }
  return out;
}

/// Orthonormal rows of N span the null space.  Returns a basis with few components in each
/// vector: each has one of the pivots alone.
std::vector<NullVector> named(MatrixXd N, const std::vector<std::string>& unknowns) {
  std::vector<NullVector> out;
  if (N.rows() > 0) N = N(Eigen::all, pivots(N)).eval().partialPivLu().solve(N).eval();
  for (Index i = 0; i < N.rows(); ++i) {
    VectorXd v = N.row(i).normalized();
    // The first of the largest components is positive, independently of rounding.
    const double largest = v.cwiseAbs().maxCoeff() * (1 - 1e-9);
    Index first = 0;
    while (std::abs(v[first]) < largest) ++first;
    if (v[first] < 0) v = -v;
    NullVector vector;
    for (Index j = 0; j < v.size(); ++j)
      if (std::abs(v[j]) > kMoves) vector[unknowns[static_cast<std::size_t>(j)]] = v[j];
    out.push_back(std::move(vector));
  }
  std::ranges::sort(out);
  return out;
}

/// Equations, as they are added, reduced to a triangle R and Q^T b by Householder's
/// reflections, A = Q R: block by block, each together with the triangle so far.  Q is
/// orthogonal, so R has the singular values and right singular vectors of A, and
/// |R x - Q^T b| = |A x - b| for every x.
/// Source: [Golub 2013], 5.2 and 5.3.
class Triangle {
 public:
  Triangle(Index columns, std::size_t equations)
      : columns_(columns),
        block_(std::min(kBlock * (columns + 1), static_cast<Index>(equations)),
               columns + 1) {}

  void add(const VectorXd& row, double b) {
    if (filled_ == block_.rows()) reduce();
    block_.row(filled_).head(columns_) = row;
    block_(filled_++, columns_) = b;
  }

  void reduce() {
    leave_if_asked();
    auto rows = block_.topRows(filled_);
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> in_place(rows);
    rows.triangularView<Eigen::StrictlyLower>().setZero();
    filled_ = std::min(filled_, columns_ + 1);
  }

  auto R() const { return block_.topLeftCorner(filled_, columns_); }
  auto b() const { return block_.col(columns_).head(filled_); }

 private:
  static constexpr Index kBlock = 5;  // rows of a block by those of the triangle
  Index columns_, filled_ = 0;
  MatrixXd block_;
};

/// @param b  right-hand sides by equation; none: 0.
Triangle reduced(const Equations& equations, const VectorXd& scale, const VectorXd& b) {
  Triangle out(scale.size(), equations.count());
  Index i = 0;
  equations.each([&](const VectorXd& row) {
    out.add(row.cwiseQuotient(scale), b.size() > 0 ? b[i++] : 0);
  });
  out.reduce();
  return out;
}

struct Decomposition {
  Eigen::JacobiSVD<MatrixXd> svd;
  Identifiability of;
};

/// The singular values of R are those of A but for rounding, some 1e-14 of the largest by
/// Weyl's theorem, which is far below kRankTolerance: the rank is that of A.
Decomposition decomposed(const Equations& equations, const Triangle& triangle) {
  Decomposition d{
      Eigen::JacobiSVD<MatrixXd>(triangle.R(), Eigen::ComputeThinU | Eigen::ComputeFullV),
      {.unknowns = equations.unknowns(),
       .parameters = equations.parameters(),
       .equations = equations.count(),
       .rank = 0,
       .condition = 0,
       .identifiable = {},
       .null_vectors = {}}};
  const VectorXd& s = d.svd.singularValues();
  const auto rank = (s.array() > kRankTolerance * s[0]).count();
  d.of.rank = static_cast<std::size_t>(rank);
  d.of.condition = s[0] / s[rank - 1];
  const MatrixXd& V = d.svd.matrixV();
  const MatrixXd null = V.rightCols(V.cols() - rank);
  for (Index j = 0; j < V.rows(); ++j)
    d.of.identifiable.push_back(null.cols() == 0 || null.row(j).norm() < kMoves);
  d.of.null_vectors = named(null.transpose(), d.of.unknowns);
  return d;
}

/// The golden angle: its multiples never repeat, and follow no multiple of B.
constexpr double kGolden = 2.399963229728653;  // pi (3 - sqrt 5)

}  // namespace

const std::vector<std::string>& samba_parameters() {
  static const std::vector<std::string> kAll = [] {
    std::vector<std::string> all{"EC0Y", "EA0Y", "EB0Z", "EA0B",
                                 "EC0B", "EX0C", "EA0C", "EB0C"};
    const auto add = [&all](std::string_view axes, std::string_view directions,
                            std::string_view ends) {
      for (const char axis : axes)
        for (const char direction : directions)
          for (const char end : ends)
            all.push_back(std::string("E") + direction + axis + end);
    };
    for (const char c : {'X', 'Y', 'Z'}) all.push_back(std::string("E") + c + c + '1');
    add("XYZ", "XYZ", "23");
    add("XYZ", "ABC", "123");
    add("XYZ", "XYZ", "b");
    add("BC", "XYZABC", "123");
    all.emplace_back("facet");
    return all;
  }();
  return kAll;
}

bool is_samba_parameter(const std::string& name) { return parsed(name).has_value(); }

std::array<double, 9> table_rotation(const Indexation& at) {
  std::array<double, 9> out;
  Eigen::Map<Matrix3d>(out.data()) = rotation(at);
  return out;
}

SambaSize samba_size(const SambaStrategy& strategy,
                     const std::vector<std::string>& parameters) {
  SambaSize size{1, parameters.size() + 3 * strategy.balls_mm.size() + 3};
  for (const Indexation& at : strategy.indexations)
    size.equations +=
        strategy.styli_mm.size() * (3 * at.balls.size() + at.pre_moves.size());
  return size;
}

bool SambaSize::solvable() const {
  const auto n = static_cast<double>(unknowns);
  return static_cast<double>(equations) * n * n <= kMostSambaWork;
}

Identifiability identifiability(const SambaStrategy& strategy,
                                const std::vector<std::string>& parameters) {
  const Equations equations(strategy, parameters);
  return decomposed(equations, reduced(equations, scales(equations.unknowns()), {})).of;
}

SambaFit samba_fit(const SambaStrategy& strategy,
                   const std::vector<std::string>& parameters,
                   const std::vector<double>& readings_mm,
                   std::optional<double> noise_mm) {
  const Equations equations(strategy, parameters);
  if (readings_mm.size() + 1 != equations.count())
    throw std::domain_error("samba_fit: one reading for each equation but the scale bar");
  const VectorXd scale = scales(equations.unknowns());
  VectorXd b(static_cast<Index>(equations.count()));
  const auto [i, j] = strategy.scale_bar_ends;
  b << Eigen::Map<const VectorXd>(readings_mm.data(), b.size() - 1),
      strategy.scale_bar_mm -
          (column(strategy.balls_mm[j]) - column(strategy.balls_mm[i])).norm();  // (3)
  const Triangle triangle = reduced(equations, scale, b);
  Decomposition d = decomposed(equations, triangle);
  const auto rank = static_cast<Index>(d.of.rank);
  const MatrixXd inverse = d.svd.matrixV().leftCols(rank) *
                           d.svd.singularValues().head(rank).cwiseInverse().asDiagonal();
  const VectorXd y =
      inverse * (d.svd.matrixU().leftCols(rank).transpose() * triangle.b());
  const double rss = (triangle.b() - triangle.R() * y).squaredNorm();
  SambaFit fit{.of = std::move(d.of), .value = {}, .u = {}, .s0_mm = 0, .dof = 0};
  fit.dof = equations.count() - fit.of.rank;
  if (fit.dof > 0) fit.s0_mm = std::sqrt(rss / static_cast<double>(fit.dof));
  const double noise = noise_mm.value_or(fit.s0_mm);
  for (Index k = 0; k < y.size(); ++k) {
    const bool known = fit.of.identifiable[static_cast<std::size_t>(k)];
    fit.value.push_back(known ? y[k] / scale[k] : 0);
    fit.u.push_back(known ? noise * inverse.row(k).norm() / scale[k] : 0);
  }
  return fit;
}

std::vector<double> samba_readings(const SambaStrategy& strategy,
                                   const std::map<std::string, double>& errors) {
  std::vector<std::string> names;
  for (const auto& [name, value] : errors)
    if (is_samba_parameter(name)) names.push_back(name);
  const Equations equations(strategy, names);
  const auto unknowns = equations.unknowns();
  VectorXd x(static_cast<Index>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const auto given = errors.find(unknowns[j]);
    x[static_cast<Index>(j)] = given == errors.end() ? 0 : given->second;
  }
  std::vector<double> out;
  equations.each([&](const VectorXd& row) { out.push_back(row.dot(x)); });
  out.pop_back();  // of the scale bar
  return out;
}

std::vector<double> samba_readings(const SambaStrategy& s, const Machine& machine) {
  if (machine.chain != kSambaChain)
    throw std::domain_error("samba_readings: a machine " + std::string(kSambaChain));
  Machine m = machine;
  const auto error = [&](const Matrix3d& R, const Indexation& at, const Vec3& stylus,
                         const Vec3& target, const std::array<double, 3>& sign) {
    m.tool_point_mm = stylus;
    return column(Kinematics(m).tip_error_mm(position(R, at, stylus, target, sign)));
  };
  const Vector3d n = column(s.facet_normal).normalized();
  std::vector<double> out;
  each_probing(
      s,
      [&](const Matrix3d& R, const Indexation& at, const Vec3& stylus, std::size_t b) {
        const Vector3d e = error(R, at, stylus, s.balls_mm[b], {});
        out.insert(out.end(), e.begin(), e.end());
      },
      [&](const Matrix3d& R, const Indexation& at, const Vec3& stylus,
          const std::array<double, 3>& sign) {
        out.push_back(n.dot(error(R, at, stylus, s.facet_mm, sign)));
      });
  return out;
}

std::vector<Remedy> remedies(const SambaStrategy& strategy,
                             const Identifiability& found) {
  const std::vector<std::string> names(
      found.unknowns.begin(),
      found.unknowns.begin() + static_cast<std::ptrdiff_t>(found.parameters));
  SambaStrategy changed = strategy;
  Identifiability best = found;
  std::vector<Remedy> out;
  const auto try_out = [&](std::string what) {
    if (!samba_size(changed, names).solvable()) return;
    Identifiability now = identifiability(changed, names);
    if (now.rank <= best.rank) return;
    Remedy remedy{.what = std::move(what), .rank = now.rank, .gains = {}};
    for (std::size_t j = 0; j < now.parameters; ++j)
      if (now.identifiable[j] && !best.identifiable[j])
        remedy.gains.push_back(now.unknowns[j]);
    out.push_back(std::move(remedy));
    best = std::move(now);
  };
  double turn = 0;
  std::string turned;
  for (std::size_t i = 0; i < changed.indexations.size(); ++i) {
    Indexation& at = changed.indexations[i];
    if (at.balls.empty() || !at.pre_moves.empty()) continue;
    turn += kGolden;
    at.C_rad = std::remainder(turn, 2 * units::kPi);
    turned += fmt::format("{}{:.1f} ({})", turned.empty() ? "" : ", ",
                          units::deg_from_rad(at.C_rad), i + 1);
  }
  try_out(say("decouple C from B: C at, deg (indexation), {}", turned));
  const Vec3 tip = strategy.styli_mm.front();
  changed.styli_mm = {tip, {tip[0], tip[1], tip[2] - 60}};
  try_out(tr("probe with two stylus lengths, 60 mm apart"));
  changed.styli_mm.push_back({tip[0] + 60, tip[1], tip[2] - 30});
  changed.styli_mm.push_back({tip[0], tip[1] + 60, tip[2] - 30});
  try_out(tr("probe with a star of tips, 60 mm off the axis in X and Y"));
  return out;
}

}  // namespace turnwright::volumetric
