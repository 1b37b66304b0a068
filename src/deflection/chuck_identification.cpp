#include "turnwright/deflection/chuck_identification.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "base/say.hpp"
#include "turnwright/base/least_squares.hpp"
#include "turnwright/base/random.hpp"

namespace turnwright::deflection {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using std::numbers::pi;

constexpr double kTukey = 4.685;  // 95 % efficient on normal errors: handbook value
constexpr double kMad = 1.4826;   // median of |normal| times this is sigma
constexpr double kNoRank = 1e-6;  // see identifiability()
constexpr double kRoundingOfFit = 1e-13;  // of y: residuals below it are rounding
constexpr double kLeastZ_mm = 1e-12;      // all cuts at the jaws: z has no scale then

Vector3d row(double z, double F, double C) {  // Eq. (2)
  return {F, 2 * z * F + C, z * z * F + z * C};
}

double largest_z(std::span<const PlaneTest> tests) {
  double Z = 0;
  for (const PlaneTest& t : tests) Z = std::max(Z, std::abs(t.z_mm));
  return Z > kLeastZ_mm ? Z : 100;
}

/// Rows in units of the largest force and |z|, divided by the root of their number, so
/// that singular values can be compared with a fixed threshold.
struct Design {
  Rows X;
  VectorXd y;
  Vector3d unit;  // a parameter is unit times its scaled one
  std::vector<std::size_t> setup;
  std::vector<std::string> names;
  double rounding;  // of y; residuals below it count as zero

  std::size_t tests() const { return setup.size(); }
  Eigen::Index rows() const { return X.rows(); }
};

Design design(std::span<const PlaneTest> tests) {
  Design d;
  const auto n = static_cast<Eigen::Index>(tests.size());
  d.X.resize(n, 3);
  d.y.resize(n);
  std::map<std::string, std::size_t> index;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PlaneTest& t = tests[static_cast<std::size_t>(i)];
    d.X.row(i) = row(t.z_mm, t.F_N, t.C_Nmm);
    d.y[i] = t.y_mm;
    const auto [at, is_new] = index.try_emplace(t.setup, d.names.size());
    if (is_new) d.names.push_back(t.setup);
    d.setup.push_back(at->second);
  }
  const double Z = largest_z(tests);
  double F = 0;
  for (const PlaneTest& t : tests)
    F = std::max({F, std::abs(t.F_N), std::abs(t.C_Nmm) / Z});
  if (F == 0) F = 1;
  d.unit = Vector3d(1, 1 / Z, 1 / (Z * Z)) / (F * std::sqrt(static_cast<double>(n)));
  d.X *= d.unit.asDiagonal();
  d.rounding = std::max(kRoundingOfFit * d.y.cwiseAbs().maxCoeff(),
                        std::numeric_limits<double>::min());
  return d;
}

/// Weighted means over each setup; one without weight keeps zeros.
struct Means {
  Rows X;
  VectorXd y, weight;
};

Means means(const Design& d, const VectorXd& w) {
  const auto setups = static_cast<Eigen::Index>(d.names.size());
  Means m{Rows::Zero(setups, 3), VectorXd::Zero(setups), VectorXd::Zero(setups)};
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    const auto s = static_cast<Eigen::Index>(d.setup[static_cast<std::size_t>(i)]);
    m.X.row(s) += w[i] * d.X.row(i);
    m.y[s] += w[i] * d.y[i];
    m.weight[s] += w[i];
  }
  for (Eigen::Index s = 0; s < setups; ++s)
    if (m.weight[s] > 0) {
      m.X.row(s) /= m.weight[s];
      m.y[s] /= m.weight[s];
    }
  return m;
}

/// The design with the free offsets eliminated: rows less their setup's mean, times
/// sqrt(w).
struct Centred {
  Rows X;
  VectorXd y;
  Means mean;
};

Centred centred(const Design& d, const VectorXd& w) {
  Centred c{Rows(d.rows(), 3), VectorXd(d.rows()), means(d, w)};
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    const auto s = static_cast<Eigen::Index>(d.setup[static_cast<std::size_t>(i)]);
    c.X.row(i) = std::sqrt(w[i]) * (d.X.row(i) - c.mean.X.row(s));
    c.y[i] = std::sqrt(w[i]) * (d.y[i] - c.mean.y[s]);
  }
  return c;
}

VectorXd residuals(const Design& d, const Means& mean, const Vector3d& theta) {
  VectorXd r(d.rows());
  for (Eigen::Index i = 0; i < d.rows(); ++i) {
    const auto s = static_cast<Eigen::Index>(d.setup[static_cast<std::size_t>(i)]);
    r[i] = d.y[i] - mean.y[s] - (d.X.row(i) - mean.X.row(s)).dot(theta);
  }
  return r;
}

int rank(const Matrix3d& H) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> spectrum(H, Eigen::EigenvaluesOnly);
  return static_cast<int>((spectrum.eigenvalues().array() > kNoRank * kNoRank).count());
}
int rank(const Centred& c) { return rank(Matrix3d(c.X.transpose() * c.X)); }

struct Fit {
  Vector3d theta;
  VectorXd r;
};

Fit weighted_least_squares(const Design& d, const VectorXd& w) {
  const Centred c = centred(d, w);
  const Vector3d theta = turnwright::least_squares(c.X, c.y).x;
  return {theta, residuals(d, c.mean, theta)};
}

/// Least absolute deviations by reweighting, good enough as one of the starts.
Fit absolute_deviations(const Design& d) {
  Fit fit = weighted_least_squares(d, VectorXd::Ones(d.rows()));
  double floor = fit.r.cwiseAbs().maxCoeff();
  for (int step = 0; step < 60; ++step) {
    floor = std::max(floor / 2, d.rounding);
    fit = weighted_least_squares(d, fit.r.cwiseAbs().cwiseMax(floor).cwiseInverse());
  }
  return fit;
}

std::vector<bool> within(const VectorXd& r, double limit) {
  std::vector<bool> in(static_cast<std::size_t>(r.size()));
  for (std::size_t i = 0; i < in.size(); ++i)
    in[i] = std::abs(r[static_cast<Eigen::Index>(i)]) <= limit;
  return in;
}

VectorXd as_weights(const std::vector<bool>& in) {
  VectorXd w(static_cast<Eigen::Index>(in.size()));
  for (std::size_t i = 0; i < in.size(); ++i)
    w[static_cast<Eigen::Index>(i)] = in[i] ? 1 : 0;
  return w;
}

/// The `h` smallest squares of residuals: their sum and a weight of 1.
struct Trimmed {
  double sum = 0;
  VectorXd w;
};

Trimmed trimmed(const VectorXd& r, Eigen::Index h) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(r.size()));
  std::iota(order.begin(), order.end(), 0);
  std::nth_element(order.begin(), order.begin() + h - 1, order.end(),
                   [&](auto a, auto b) { return std::abs(r[a]) < std::abs(r[b]); });
  Trimmed t{0, VectorXd::Zero(r.size())};
  for (Eigen::Index k = 0; k < h; ++k) {
    const Eigen::Index i = order[static_cast<std::size_t>(k)];
    t.sum += r[i] * r[i];
    t.w[i] = 1;
  }
  return t;
}

/// As many cuts as there are unknowns, one of each setup and three more, have weight 1.
/// A fixed sequence chooses them, so that the same cuts give the same answer.
VectorXd elemental(const Design& d, std::uint64_t start) {
  std::vector<std::size_t> order(d.tests());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size() - 1; i > 0; --i)
    std::swap(order[i], order[splitmix64(0, start * d.tests() + i) % (i + 1)]);
  VectorXd w = VectorXd::Zero(d.rows());
  std::vector<bool> seen(d.names.size(), false);
  int others = 0;
  for (const std::size_t i : order) {
    const bool first = !seen[d.setup[i]];
    seen[d.setup[i]] = true;
    if (first || others++ < 3) w[static_cast<Eigen::Index>(i)] = 1;
  }
  return w;
}

/// Least trimmed squares: the best of many starts, each improved by refitting to the h
/// cuts that fit best.  Of n cuts with p unknowns (n - p)/3 may be outliers.
Fit least_trimmed(const Design& d) {
  const auto n = d.rows(), unknowns = static_cast<Eigen::Index>(3 + d.names.size());
  const Eigen::Index h = n - (n - unknowns) / 3;
  Fit best = absolute_deviations(d);
  double least = std::numeric_limits<double>::infinity();
  const auto lead_down = [&](Fit fit, int steps) {
    Trimmed t = trimmed(fit.r, h);
    for (int step = 0; step < steps; ++step) {
      Fit next = weighted_least_squares(d, t.w);
      Trimmed lower = trimmed(next.r, h);
      if (!(lower.sum < t.sum)) break;
      fit = std::move(next);
      t = std::move(lower);
    }
    // h cuts that all lie in a plane of the design fit it, whatever the other cuts are
    if (t.sum < least && rank(centred(d, t.w)) == 3) {
      least = t.sum;
      best = std::move(fit);
    }
  };
  lead_down(best, 20);
  const std::uint64_t starts = 40 + static_cast<std::uint64_t>(10000 / n);
  for (std::uint64_t k = 0; k < starts; ++k)
    lead_down(weighted_least_squares(d, elemental(d, k)), 3);
  lead_down(best, 20);
  return best;
}

/// Robust scale; the factor in n corrects small samples (Rousseeuw, Leroy: handbook
/// value).
double scale(const Design& d, const VectorXd& r) {
  VectorXd size = r.cwiseAbs();
  const auto middle = size.begin() + size.size() / 2;
  std::nth_element(size.begin(), middle, size.end());
  const auto free = static_cast<double>(d.tests() - 3 - d.names.size());
  return std::max(kMad * (1 + 5 / free) * *middle, d.rounding);
}

Fit tukey(const Design& d, Fit fit, double s) {
  for (int step = 0; step < 50; ++step) {
    const VectorXd u = fit.r / (kTukey * s);
    const VectorXd w = (1 - u.array().square()).cwiseMax(0).square();
    const Fit next = weighted_least_squares(d, w);
    const double moved = (next.r - fit.r).cwiseAbs().maxCoeff();
    fit = next;
    if (moved < 1e-6 * s) break;
  }
  return fit;
}

/// The cuts used, the fit through them and its residuals.
struct Chosen {
  std::vector<bool> used;
  Fit fit;
  Centred centred;
  Matrix3d H;
  long degrees_of_freedom;
  double s;

  bool tells() const { return degrees_of_freedom > 0 && rank(H) == 3; }
};

Chosen fit_through(const Design& d, std::vector<bool> used) {
  const VectorXd w = as_weights(used);
  Centred c = centred(d, w);
  const Matrix3d H = c.X.transpose() * c.X;
  Fit fit = weighted_least_squares(d, w);
  const long free = static_cast<long>(w.sum()) - 3 -
                    static_cast<long>((c.mean.weight.array() > 0).count());
  const double rss = fit.r.cwiseAbs2().dot(w);
  const double s = free > 0 ? std::sqrt(rss / static_cast<double>(free)) : 0;
  return {std::move(used),        std::move(fit), std::move(c), H, free,
          std::max(s, d.rounding)};
}

Chosen choose(const Design& d) {
  const Fit start = least_trimmed(d);
  const double s = scale(d, start.r);
  Chosen now = fit_through(d, within(tukey(d, start, s).r, kOutlier * s));
  // A cut that alone determines a parameter fits exactly and is kept; where two such cuts
  // disagree it cannot be decided which one is wrong.
  if (!now.tells()) return fit_through(d, std::vector<bool>(d.tests(), true));
  // A cut changes the fit by little compared with kOutlier, so few rounds suffice; their
  // number ends the rare case of two sets that lead to each other.
  for (int round = 0; round < 20; ++round) {
    auto used = within(now.fit.r, kOutlier * now.s);
    if (used == now.used) break;
    Chosen next = fit_through(d, std::move(used));
    if (!next.tells()) break;
    now = std::move(next);
  }
  return now;
}

/// The elastic S nearest `theta` in the metric H, for a theta that is not elastic: the
/// best q (cos^2, cos sin, sin^2), q >= 0.  `stretch` turns parameters into H's units.
Vector3d on_border(const Vector3d& theta, const Matrix3d& H, const Vector3d& stretch) {
  const auto direction = [&](double phi) -> Vector3d {
    const double a = std::cos(phi), b = std::sin(phi);
    return stretch.cwiseProduct(Vector3d(a * a, a * b, b * b));
  };
  const auto length = [&](const Vector3d& m) {
    return std::max(0.0, m.dot(H * theta) / m.dot(H * m));
  };
  const auto excess = [&](double phi) {  // sum of squares above the best's, but for a sum
    const Vector3d m = direction(phi);
    const double q = length(m);
    return -q * q * m.dot(H * m);
  };
  // The angle's function is a quotient of trigonometric polynomials of degree 4 at most;
  // the grid has 90 points for each of its waves.
  constexpr int kGrid = 720;
  double best = 0;
  for (int k = 0; k < kGrid; ++k)
    if (excess(k * pi / kGrid) < excess(best)) best = k * pi / kGrid;
  std::uintmax_t steps = 200;
  best = boost::math::tools::brent_find_minima(excess, best - pi / kGrid,
                                               best + pi / kGrid, 52, steps)
             .first;
  const Vector3d m = direction(best);
  return length(m) * m;
}

Root as_root(const Vector3d& theta) { return {theta[0], theta[1], theta[2]}; }

void elastic_root(PlaneFit& out, Vector3d& theta, const Design& d, const Chosen& chosen) {
  const Vector3d unit = d.unit;
  out.unconstrained = as_root(unit.cwiseProduct(theta));
  out.root = out.unconstrained;
  if (elastic(out.root)) return;
  // In lengths of z that make c0 and c2 z^2 alike, the angle moves both evenly.
  const double z = std::sqrt(unit[0] / unit[2]);
  const Vector3d best = on_border(theta, chosen.H, {1, unit[0] / (unit[1] * z), 1});
  const Vector3d moved = best - theta;
  theta = best;
  out.root = as_root(unit.cwiseProduct(theta));
  out.on_border = true;
  out.contradiction = moved.dot(chosen.H * moved) / (chosen.s * chosen.s);
}

void uncertainties(PlaneFit& out, const Vector3d& theta, const Design& d,
                   const Chosen& chosen) {
  const Matrix3d P = chosen.s * chosen.s * chosen.H.inverse();
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      out.covariance[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] =
          d.unit[j] * P(j, k) * d.unit[k];
  const Means& mean = chosen.centred.mean;
  for (std::size_t s = 0; s < d.names.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(s);
    if (mean.weight[i] == 0) continue;
    const Vector3d x = mean.X.row(i);
    out.offsets.push_back(
        {.setup = d.names[s],
         .mm = mean.y[i] - x.dot(theta),
         .u_mm = std::sqrt(chosen.s * chosen.s / mean.weight[i] + x.dot(P * x))});
  }
}

}  // namespace

PlaneTest radial_test(const TestCut& cut, const Root& tangential) {
  const double z = cut.z_mm, Fr = cut.load.Fr_N, C = -cut.load.Fa_N * cut.D_mm / 2;
  const double t =
      tangential.c0_mm_N + 2 * tangential.c1_rad_N * z + tangential.c2_rad_Nmm * z * z;
  const double delta_t = (cut.part.f_ww_mm_N + t) * cut.load.Ft_N;
  return {.setup = cut.setup,
          .z_mm = z,
          .F_N = Fr,
          .C_Nmm = C,
          .y_mm = cut.radius_error_mm - cut.part.f_ww_mm_N * Fr -
                  cut.part.f_wp_rad_N * C - cut.tool_mm -
                  delta_t * delta_t / cut.D_mm};  // Eq. (1)
}

PlaneTest tangential_test(const TestCut& cut) {
  if (!cut.delta_t_mm) throw std::domain_error("tangential_test: delta_t not measured");
  return {.setup = cut.setup,
          .z_mm = cut.z_mm,
          .F_N = cut.load.Ft_N,
          .C_Nmm = 0,
          .y_mm = *cut.delta_t_mm - cut.part.f_ww_mm_N * cut.load.Ft_N};
}

PlaneFit identify(std::span<const PlaneTest> tests, Plane plane) {
  for (const PlaneTest& t : tests)
    if (!std::isfinite(t.z_mm + t.F_N + t.C_Nmm + t.y_mm))
      throw std::domain_error("identify: a test is not finite");
  const Identifiability can = identifiability(tests, plane);
  if (can.rank < 3 || can.degrees_of_freedom < 1)
    throw std::domain_error("identify: the cuts cannot tell the compliance");

  const Design d = design(tests);
  const Chosen chosen = choose(d);
  PlaneFit out;
  out.s_mm = chosen.s;
  out.degrees_of_freedom = chosen.degrees_of_freedom;
  for (std::size_t i = 0; i < d.tests(); ++i)
    if (!chosen.used[i]) out.outliers.push_back(i);
  Vector3d theta = chosen.fit.theta;
  elastic_root(out, theta, d, chosen);
  uncertainties(out, theta, d, chosen);
  const VectorXd r = residuals(d, chosen.centred.mean, theta);
  out.residual_mm.assign(r.begin(), r.end());
  return out;
}

namespace {

/// The design's normal matrix with the setups' offsets taken out, growing cut by cut.
class Knowledge {
 public:
  Knowledge(const Design& d, const Means& mean, const Matrix3d& H)
      : unit_(d.unit), mean_(mean), H_(H), X_(d.X) {}

  /// One more cut in a setup: sum of squares about the mean, updated.
  void add(std::size_t setup, const PlaneTest& t) {
    const auto s = static_cast<Eigen::Index>(setup);
    const Vector3d x = unit_.cwiseProduct(row(t.z_mm, t.F_N, t.C_Nmm));
    const Vector3d off = x - mean_.X.row(s).transpose();
    const double n = mean_.weight[s];
    H_ += n / (n + 1) * off * off.transpose();
    mean_.X.row(s) += off.transpose() / (n + 1);
    mean_.weight[s] += 1;
  }

  Eigen::SelfAdjointEigenSolver<Matrix3d> spectrum() const {
    return Eigen::SelfAdjointEigenSolver<Matrix3d>(H_);
  }
  int rank() const { return turnwright::deflection::rank(H_); }
  /// Over the cuts of the design itself.
  double largest_u() const {
    const Matrix3d P = H_.inverse();
    double largest = 0;
    for (Eigen::Index i = 0; i < X_.rows(); ++i)
      largest = std::max(largest, X_.row(i).dot(P * X_.row(i).transpose()));
    return std::sqrt(largest);
  }
  const Means& mean() const { return mean_; }

 private:
  Vector3d unit_;
  Means mean_;
  Matrix3d H_;
  Rows X_;
};

/// The number of distinct values; those nearer than 1e-6 of the largest count once.
int distinct(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  double largest = 0;
  for (const double v : x) largest = std::max(largest, std::abs(v));
  int n = x.empty() ? 0 : 1;
  for (std::size_t i = 1; i < x.size(); ++i) n += x[i] - x[i - 1] > kNoRank * largest;
  return n;
}

struct Candidate {
  MissingTest::Kind kind;
  PlaneTest cut;
};

/// Candidates for a further cut in a setup: variations of its extreme cuts.
std::vector<Candidate> candidates(const std::vector<PlaneTest>& setup, double Z,
                                  Plane plane) {
  const auto force = [](const PlaneTest& t) { return std::abs(t.F_N); };
  const auto place = [](const PlaneTest& t) { return t.z_mm; };
  const std::array base{*std::ranges::max_element(setup, {}, force),
                        *std::ranges::max_element(setup, {}, place),
                        *std::ranges::min_element(setup, {}, place)};
  std::vector<Candidate> all;
  for (PlaneTest t : base) {
    t.C_Nmm *= 2;
    t.F_N = t.F_N == 0 ? 1 : 2 * t.F_N;
    all.push_back({MissingTest::Kind::force, t});
  }
  for (const double u : {0.382, 0.786, 1.0}) {
    PlaneTest t = base[0];
    t.z_mm = u * Z;
    all.push_back({MissingTest::Kind::position, t});
  }
  if (plane == Plane::radial)
    for (PlaneTest t : base) {
      t.C_Nmm -= 0.2 * Z * t.F_N;
      all.push_back({MissingTest::Kind::couple, t});
    }
  return all;
}

int ordinal(MissingTest::Kind kind, const std::vector<PlaneTest>& setup) {
  std::vector<double> values;
  for (const PlaneTest& t : setup) switch (kind) {
      case MissingTest::Kind::force:
        values.push_back(t.F_N);
        break;
      case MissingTest::Kind::position:
        values.push_back(t.z_mm);
        break;
      case MissingTest::Kind::couple:
        values.push_back(t.F_N != 0 ? t.C_Nmm / t.F_N : 0);
    }
  return distinct(std::move(values)) + 1;
}

/// The rows span the null space; made as sparse as elimination makes them.
void reduce(Eigen::MatrixXd& rows) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::Index pivot = 0;
    rows.row(i).cwiseAbs().maxCoeff(&pivot);
    rows.row(i) /= rows(i, pivot);
    for (Eigen::Index k = 0; k < rows.rows(); ++k)
      if (k != i) rows.row(k) -= rows(k, pivot) * rows.row(i);
  }
}

std::vector<NullDirection> null_directions(const Knowledge& known, const Design& d,
                                           double Z) {
  const auto spectrum = known.spectrum();
  const auto deficiency = 3 - known.rank();
  Eigen::MatrixXd null = spectrum.eigenvectors().leftCols(deficiency).transpose();
  const Vector3d to_weight(d.unit[0], d.unit[1] * Z, d.unit[2] * Z * Z);
  null = null * to_weight.asDiagonal();
  reduce(null);
  std::vector<NullDirection> all;
  for (Eigen::Index i = 0; i < deficiency; ++i) {
    const Vector3d v = null.row(i) / null.row(i).cwiseAbs().maxCoeff();
    const Vector3d theta = v.cwiseQuotient(to_weight);
    all.push_back({.weight = {v[0], v[1], v[2]},
                   .moves_offsets = (known.mean().X * theta).cwiseAbs().maxCoeff() >
                                    kNoRank * theta.cwiseAbs().maxCoeff()});
  }
  return all;
}

std::vector<std::string> setups_of_one_force(std::span<const PlaneTest> tests,
                                             const Design& d) {
  std::vector<std::vector<double>> forces(d.names.size());
  for (std::size_t i = 0; i < tests.size(); ++i)
    forces[d.setup[i]].push_back(tests[i].F_N);
  std::vector<std::string> names;
  for (std::size_t s = 0; s < forces.size(); ++s)
    if (distinct(std::move(forces[s])) == 1) names.push_back(d.names[s]);
  return names;
}

}  // namespace

Identifiability identifiability(std::span<const PlaneTest> tests, Plane plane) {
  Identifiability out;
  if (tests.empty()) return out;
  const Design d = design(tests);
  const Centred c = centred(d, VectorXd::Ones(d.rows()));
  Knowledge known(d, c.mean, c.X.transpose() * c.X);
  const double Z = largest_z(tests);
  out.rank = known.rank();
  out.degrees_of_freedom =
      static_cast<long>(tests.size()) - 3 - static_cast<long>(d.names.size());
  out.null_directions = null_directions(known, d, Z);
  out.one_force = setups_of_one_force(tests, d);

  // Further cuts are proposed for the setup that has most cuts already.
  Eigen::Index most = 0;
  c.mean.weight.head(static_cast<Eigen::Index>(d.names.size())).maxCoeff(&most);
  const auto s = static_cast<std::size_t>(most);
  std::vector<PlaneTest> setup;
  for (std::size_t i = 0; i < tests.size(); ++i)
    if (d.setup[i] == s) setup.push_back(tests[i]);

  while (known.rank() < 3) {
    const int rank = known.rank();
    const auto options = candidates(setup, Z, plane);
    const auto better = std::ranges::find_if(options, [&](const Candidate& option) {
      Knowledge more = known;
      more.add(s, option.cut);
      return more.rank() > rank;
    });
    if (better == options.end()) break;
    out.missing.push_back({better->kind, d.names[s], ordinal(better->kind, setup)});
    known.add(s, better->cut);
    setup.push_back(better->cut);
  }
  if (out.rank < 3) return out;

  const auto sigma2 = known.spectrum().eigenvalues();
  out.condition = std::sqrt(sigma2[2] / sigma2[0]);
  out.largest_u = known.largest_u();
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& option : candidates(setup, Z, plane)) {
    Knowledge more = known;
    more.add(s, option.cut);
    if (const double u = more.largest_u(); u < least) {
      least = u;
      out.most_useful = {option.kind, d.names[s], ordinal(option.kind, setup)};
    }
  }
  return out;
}

std::string words(const MissingTest& missing) {
  const bool second = missing.ordinal == 2, third = missing.ordinal == 3;
  const auto& setup = missing.setup;
  switch (missing.kind) {
    case MissingTest::Kind::force:
      return say("a cut at another force in setup {}", setup);
    case MissingTest::Kind::position:
      return second  ? say("a cut at a second z in setup {}", setup)
             : third ? say("a cut at a third z in setup {}", setup)
                     : say("a cut at another z in setup {}", setup);
    case MissingTest::Kind::couple:
      break;
  }
  return second  ? say("a cut with a second D or Fa/Fr ratio in setup {}", setup)
         : third ? say("a cut with a third D or Fa/Fr ratio in setup {}", setup)
                 : say("a cut with another D or Fa/Fr ratio in setup {}", setup);
}

std::string words(const NullDirection& direction) {
  std::string text;
  const auto add = [&text](const std::string& name) {
    text = text.empty() ? name : say("{} with {}", text, name);
  };
  const std::array<const char*, 3> names{"c0", "c1", "c2"};
  for (std::size_t j = 0; j < 3; ++j)
    if (std::abs(direction.weight[j]) > kNoRank) add(names[j]);
  if (direction.moves_offsets) add(tr("the setups' offsets"));
  return text;
}

namespace {

/// Of x . (c0, c1, c2).
double standard_error(const PlaneFit& fit, const Vector3d& x) {
  double variance = 0;
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      variance +=
          x[j] * x[k] *
          fit.covariance[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
  return std::sqrt(std::max(variance, 0.0));
}

}  // namespace

Estimate predicted_deflection(const PlaneFit& fit, double z_mm, double F_N,
                              double C_Nmm) {
  const Vector3d x = row(z_mm, F_N, C_Nmm);
  const Vector3d c(fit.root.c0_mm_N, fit.root.c1_rad_N, fit.root.c2_rad_Nmm);
  return {x.dot(c), standard_error(fit, x)};
}

Estimate predicted_radius_error(const PlaneFit& radial, const PlaneFit* tangential,
                                double z_mm, double D_mm, const Load& load) {
  if (!(D_mm > 0)) throw std::domain_error("predicted_radius_error: D must be > 0 mm");
  const Estimate r = predicted_deflection(radial, z_mm, load.Fr_N, -load.Fa_N * D_mm / 2);
  if (!tangential) return r;
  const Estimate t = predicted_deflection(*tangential, z_mm, load.Ft_N, 0);
  return {r.value + t.value * t.value / D_mm, std::hypot(r.u, 2 * t.value * t.u / D_mm)};
}

std::optional<ArmRange> arms(const Root& root) {
  if (!(elastic(root) && root.c1_rad_N > 0)) return std::nullopt;
  return ArmRange{root.c1_rad_N / root.c2_rad_Nmm, root.c0_mm_N / root.c1_rad_N};
}

std::optional<Springs> springs(const Root& root, double Lc_mm) {
  const auto range = arms(root);
  if (!range ||
      !(Lc_mm >= range->least_mm * (1 - 1e-9) && Lc_mm <= range->largest_mm * (1 + 1e-9)))
    return std::nullopt;
  const auto spring = [](double x, double of) { return x > 1e-9 * of ? x : 0; };
  return Springs{
      .Lc_mm = Lc_mm,
      .per_k1_mm_N = spring(root.c0_mm_N - Lc_mm * root.c1_rad_N, root.c0_mm_N),
      .per_k2_rad_Nmm = root.c1_rad_N / Lc_mm,
      .per_k3_rad_Nmm = spring(root.c2_rad_Nmm - root.c1_rad_N / Lc_mm, root.c2_rad_Nmm)};
}

Springs spring_errors(const PlaneFit& fit, double Lc_mm) {
  return {.Lc_mm = Lc_mm,
          .per_k1_mm_N = standard_error(fit, {1, -Lc_mm, 0}),
          .per_k2_rad_Nmm = standard_error(fit, {0, 1 / Lc_mm, 0}),
          .per_k3_rad_Nmm = standard_error(fit, {0, -1 / Lc_mm, 1})};
}

}  // namespace turnwright::deflection
