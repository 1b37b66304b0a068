#include "turnwright/volumetric/ball_bar.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"
#include "turnwright/volumetric/kinematics.hpp"
#include "turnwright/volumetric/minimum_zone.hpp"

namespace turnwright::volumetric {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kQ = 100;  // reference travel of the straightness terms [mm]

double sign(double x) { return std::abs(x) < 1e-12 ? 0 : (x > 0 ? 1 : -1); }

double range(const VectorXd& v) { return v.maxCoeff() - v.minCoeff(); }

void check(const Trace& t) {
  if (t.theta_rad.empty() || t.ccw_mm.size() != t.theta_rad.size() ||
      t.cw_mm.size() != t.theta_rad.size() || !(t.R_mm > 0))
    throw std::domain_error("ball bar: R > 0 and as many values as angles");
}

Eigen::Map<const VectorXd> vector(const std::vector<double>& v) {
  return {v.data(), static_cast<Index>(v.size())};
}

/// Columns cos, sin.
MatrixXd circle(const std::vector<double>& theta) {
  MatrixXd A(static_cast<Index>(theta.size()), 2);
  A.col(0) = vector(theta).array().cos();
  A.col(1) = vector(theta).array().sin();
  return A;
}

/// Width between two circles about the centre that `zone` finds, which is minimum_zone or
/// least_squares_zone.
double width(decltype(minimum_zone) zone, const std::vector<double>& theta,
             const std::vector<double>& path) {
  const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> A = circle(theta);
  return zone({A.data(), static_cast<std::size_t>(A.size())}, 2, path).width;
}

/// Terms of (2) that are the same on both paths, and those that change sign with dir.
constexpr std::array<std::size_t, 7> kAlike = {0, 1, 2, 3, 4, 9, 10};
constexpr std::array<std::size_t, 5> kOpposed = {5, 6, 7, 8, 11};

/// Eq. (2) for dir = 1, the columns of kAlike and of kOpposed.
struct Basis {
  MatrixXd alike, opposed;
};

Basis basis(const Trace& t) {
  const auto n = static_cast<Index>(t.theta_rad.size());
  Basis b{MatrixXd(n, kAlike.size()), MatrixXd(n, kOpposed.size())};
  const double R = t.R_mm, bow = R / kQ * (R / kQ);
  for (Index i = 0; i < n; ++i) {
    const double theta = t.theta_rad[static_cast<std::size_t>(i)];
    const double c = std::cos(theta), s = std::sin(theta);
    b.alike.row(i) << c, s, R * c * c, R * s * s, R * s * c, bow * c * c * s,
        bow * s * s * c;
    b.opposed.row(i) << -sign(s) * c, sign(c) * s, -std::abs(s), std::abs(c), 2 * s * c;
  }
  return b;
}

/// Least squares of one group of terms; `inverse` is the diagonal of (A^T A)^-1.
struct Part {
  Index rank = 0;
  VectorXd x, inverse;
  double rss = 0;
};

Part solved(const MatrixXd& A, const VectorXd& v) {
  const Index m = A.cols();
  const VectorXd norms = A.colwise().norm();
  if (!(norms.minCoeff() > 0)) return {};
  const auto unit = least_squares(A * norms.cwiseInverse().asDiagonal(), v);
  if (unit.rank < m) return {.rank = unit.rank, .x = {}, .inverse = {}};
  const VectorXd x = unit.x.cwiseQuotient(norms);
  return {m, x, unit.root.rowwise().squaredNorm().cwiseQuotient(norms.cwiseAbs2()),
          (v - A * x).squaredNorm()};
}

std::vector<Contribution> ranked(const Basis& b, const VectorXd& alike,
                                 const VectorXd& opposed) {
  const double mean = (alike[2] + alike[3]) / 2, mismatch = (alike[2] - alike[3]) / 2;
  std::vector<Contribution> out = {
      {"centre_offset", range(b.alike.leftCols(2) * alike.head(2))},
      {"mean_scale",
       std::abs(mean) * (b.alike.col(2) + b.alike.col(3)).cwiseAbs().maxCoeff()},
      {"scale_mismatch", std::abs(mismatch) * range(b.alike.col(2) - b.alike.col(3))}};
  const auto one = [&](const char* name, Index k) {
    out.push_back({name, std::abs(alike[k]) * range(b.alike.col(k))});
  };
  one("squareness", 4);
  one("straightness_v_of_u", 5);
  one("straightness_u_of_v", 6);
  const std::array<const char*, kOpposed.size()> names = {
      "backlash_u", "backlash_v", "lateral_play_v_of_u", "lateral_play_u_of_v",
      "servo_mismatch"};
  for (Index k = 0; k < opposed.size(); ++k)  // on one path +, on the other -
    out.push_back({names[static_cast<std::size_t>(k)],
                   2 * std::abs(opposed[k]) * b.opposed.col(k).cwiseAbs().maxCoeff()});
  std::ranges::stable_sort(out, std::ranges::greater(), &Contribution::range_mm);
  return out;
}

}  // namespace

std::array<char, 2> axes_of(Plane plane) {
  switch (plane) {
    case Plane::XY:
      return {'X', 'Y'};
    case Plane::YZ:
      return {'Y', 'Z'};
    case Plane::ZX:
      break;
  }
  return {'Z', 'X'};
}

Trace simulate(const Machine& machine, const BallBarTest& test) {
  const auto axes = axes_of(test.plane);
  const char U = axes[0], V = axes[1];
  Trace out{test.plane, test.R_mm, test.theta_rad, {}, {}};
  const double turn = 2 * units::kPi / static_cast<double>(test.n);
  if (out.theta_rad.empty())
    for (std::size_t k = 0; k < test.n; ++k)
      out.theta_rad.push_back(test.theta0_rad.value_or(turn / 2) +
                              turn * static_cast<double>(k));
  if (out.theta_rad.empty() || !(test.R_mm > 0) ||
      machine.chain.find(U) == std::string::npos ||
      machine.chain.find(V) == std::string::npos)
    throw std::domain_error("simulate: angles, R > 0 and both axes in the chain");
  Machine at_origin = machine;
  at_origin.tool_point_mm = {};
  const Kinematics kinematics(at_origin);
  Position centre;
  std::ranges::copy(test.centre_mm, centre.q.begin());
  Vec3 o = kinematics.nominal(centre).tip_mm;
  for (std::size_t k = 0; k < 3; ++k) o[k] += test.centre_offset_mm[k];
  const auto length = [&](double theta, double dir) {
    const double c = std::cos(theta), s = std::sin(theta);
    Position at = centre;
    at.q[letter_index(U)] += test.R_mm * c;
    at.q[letter_index(V)] += test.R_mm * s;
    at.sign[letter_index(U)] = -dir * sign(s);
    at.sign[letter_index(V)] = dir * sign(c);
    const Vec3 tip = kinematics.actual_tip_mm(at);
    return std::hypot(tip[0] - o[0], tip[1] - o[1], tip[2] - o[2]) - test.R_mm;
  };
  for (const double theta : out.theta_rad) {
    out.ccw_mm.push_back(length(theta, 1));
    out.cw_mm.push_back(length(theta, -1));
  }
  return out;
}

Iso230_4 iso230_4(const Trace& t) {
  check(t);
  const MatrixXd A = circle(t.theta_rad);
  const Index n = A.rows();
  MatrixXd both(2 * n, 3);
  both << VectorXd::Ones(2 * n), A.replicate(2, 1);
  VectorXd v(2 * n);
  v << vector(t.ccw_mm), vector(t.cw_mm);
  const Eigen::Vector3d common = least_squares(both, v).x;
  const VectorXd F = v - both.rightCols(2) * common.tail(2);
  return {.G_ccw_mm = width(least_squares_zone, t.theta_rad, t.ccw_mm),
          .G_cw_mm = width(least_squares_zone, t.theta_rad, t.cw_mm),
          .G_ccw_mz_mm = width(minimum_zone, t.theta_rad, t.ccw_mm),
          .G_cw_mz_mm = width(minimum_zone, t.theta_rad, t.cw_mm),
          .G_bi_mm = range(F),
          .H_mm = (vector(t.ccw_mm) - vector(t.cw_mm)).cwiseAbs().maxCoeff(),
          .F_max_mm = F.maxCoeff(),
          .F_min_mm = F.minCoeff(),
          .D_mm = common[0]};
}

// Half the sum of both paths contains only the terms that are the same on both, half
// their difference only the opposed ones.  Multiplied by sqrt 2 they are the values
// transformed by an orthogonal matrix, so two small fits, in which every row counts
// twice, are the least squares of the whole.
BallBarFit decompose(const Trace& t) {
  check(t);
  const Basis b = basis(t);
  const auto ccw = vector(t.ccw_mm), cw = vector(t.cw_mm);
  const Part alike = solved(b.alike, (ccw + cw) / 2),
             opposed = solved(b.opposed, (ccw - cw) / 2);
  constexpr auto m = static_cast<Index>(kBallBarTerms.size());
  if (const Index rank = alike.rank + opposed.rank; rank < m)
    throw ModelRangeError(
        say("decompose: the angles tell only {} of the 12 terms apart; "
            "more angles over the whole circle do",
            rank));
  const double values = 2 * static_cast<double>(t.theta_rad.size());
  const double rss = 2 * (alike.rss + opposed.rss);
  const double s = std::sqrt(rss / (values - static_cast<double>(m)));
  BallBarFit out{.rms_mm = std::sqrt(rss / values),
                 .ranking = ranked(b, alike.x, opposed.x)};
  const auto take = [&](const auto& terms, const Part& part) {
    for (std::size_t k = 0; k < terms.size(); ++k) {
      out.value[terms[k]] = part.x[static_cast<Index>(k)];
      out.u[terms[k]] = s * std::sqrt(part.inverse[static_cast<Index>(k)] / 2);
    }
  };
  take(kAlike, alike);
  take(kOpposed, opposed);
  return out;
}

double fitted_mm(const BallBarFit& fit, double R_mm, double theta_rad, double dir) {
  const Basis b = basis({Plane::XY, R_mm, {theta_rad}, {}, {}});
  double sum = 0;
  for (std::size_t k = 0; k < kAlike.size(); ++k)
    sum += fit.value[kAlike[k]] * b.alike(0, static_cast<Index>(k));
  for (std::size_t k = 0; k < kOpposed.size(); ++k)
    sum += dir * fit.value[kOpposed[k]] * b.opposed(0, static_cast<Index>(k));
  return sum;
}

std::vector<std::string> confounded(Plane plane) {
  const auto [u, v] = axes_of(plane);
  return {say("cos 3 theta carries E{0}{0}2 - E{0}{1}2: E{0}{1}2 is read as if E{0}{0}2 "
              "were 0",
              u, v),
          say("sin 3 theta carries E{1}{1}2 - E{1}{0}2: E{1}{0}2 is read as if E{1}{1}2 "
              "were 0",
              u, v),
          say("cos 2 theta carries the scale mismatch and the cubic E{0}{0}3, E{1}{1}3",
              u, v),
          say("sin 2 theta carries the squareness and the cubic straightness E{1}{0}3, "
              "E{0}{1}3",
              u, v)};
}

}  // namespace turnwright::volumetric
