#include "censored_line.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeast_s = 1e-9;

// A logarithm of a probability, with its slope and curvature in z.
struct Term {
  double value, slope, curvature;
};

// ln(1 - Phi(z)); beyond kTail by Mills' ratio, whose next term is below 1e-6 of it.
Term normal_survival(double z) {
  constexpr double kTail = 30;
  const double ln_root = 0.5 * std::log(2 * std::numbers::pi);
  const double ln_S = z > kTail
                          ? -z * z / 2 - ln_root - std::log(z) + std::log1p(-1 / (z * z))
                          : std::log(0.5 * std::erfc(z / std::numbers::sqrt2));
  const double hazard = z > kTail ? z + 1 / z : std::exp(-z * z / 2 - ln_root - ln_S);
  const double curvature = z > kTail ? -1 + 1 / (z * z) : -hazard * (hazard - z);
  return {ln_S, -hazard, curvature};
}

Term term(double z, bool longer, LifeErrors errors) {
  if (errors == LifeErrors::normal) {
    if (longer) return normal_survival(z);
    return {-z * z / 2 - 0.5 * std::log(2 * std::numbers::pi), -z, -1};
  }
  const double e = std::exp(std::min(z, 500.0));
  return longer ? Term{-e, -e, -e} : Term{z - e, 1 - e, -e};
}

// (1) in d = (c/s, 1/s), with gradient and Hessian.
struct Likelihood {
  MatrixXd A;  // z = A d
  const std::vector<bool>& longer;
  LifeErrors errors;
  Index known;

  double value = 0;
  VectorXd gradient;
  MatrixXd hessian;

  void at(const VectorXd& d) {
    const Index last = d.size() - 1;
    const VectorXd z = A * d;
    const auto r = static_cast<double>(known);
    value = r * std::log(d[last]);
    VectorXd slope(z.size()), curvature(z.size());
    for (Index i = 0; i < z.size(); ++i) {
      const Term t = term(z[i], longer[static_cast<std::size_t>(i)], errors);
      value += t.value;
      slope[i] = t.slope;
      curvature[i] = t.curvature;
    }
    gradient = A.transpose() * slope;
    gradient[last] += r / d[last];
    hessian = A.transpose() * curvature.asDiagonal() * A;
    hessian(last, last) -= r / (d[last] * d[last]);
  }
};

// Newton's method with halved steps; ends at the least s or where steps are rounding.
VectorXd most_likely(Likelihood& l, VectorXd d, double most_theta) {
  constexpr int kSteps = 200;
  constexpr double kRounding = 1e-11;
  const Index last = d.size() - 1;
  l.at(d);
  for (int step = 0; step < kSteps; ++step) {
    VectorXd move = (-l.hessian).ldlt().solve(l.gradient);
    const double before = l.value, floor = 1e-12 * (1 + std::abs(before));
    const VectorXd from = d;
    for (int halving = 0; halving < 60; ++halving, move /= 2) {
      d = from + move;
      if (!(d[last] > 0)) continue;
      l.at(d);
      if (l.value >= before - floor) break;
    }
    if (d[last] >= most_theta || move.norm() <= kRounding * d.norm()) break;
  }
  return d;
}

}  // namespace

CensoredLine censored_line(const MatrixXd& X, const VectorXd& y,
                           const std::vector<bool>& longer, LifeErrors errors) {
  std::vector<Index> known;
  for (Index i = 0; i < y.size(); ++i)
    if (!longer[static_cast<std::size_t>(i)]) known.push_back(i);
  const Index p = X.cols(), r = static_cast<Index>(known.size());
  const MatrixXd Xk = X(known, Eigen::all);
  const auto start = least_squares(Xk, y(known));
  if (start.rank < p || r <= p)
    throw ModelRangeError(tr("censored_line: the known values do not determine a line"));
  const VectorXd rest = y - X * start.x;
  const auto degrees = static_cast<double>(r - p);
  const double s0 = std::max(kLeast_s, std::sqrt(rest(known).squaredNorm() / degrees));

  Likelihood l{.A = MatrixXd(y.size(), p + 1),
               .longer = longer,
               .errors = errors,
               .known = r,
               .gradient = {},
               .hessian = {}};
  l.A << -X, rest / s0;  // in units of s0, from the line of the known values on
  const VectorXd d = most_likely(l, VectorXd::Unit(p + 1, p), s0 / kLeast_s);
  const double theta = d[p];

  CensoredLine out;
  out.s_likely = s0 / theta;
  out.line.c = start.x + s0 / theta * d.head(p);
  out.ln_likelihood = l.value;
  MatrixXd J = MatrixXd::Zero(p + 1, p + 1);  // of c and ln s by d
  J.topLeftCorner(p, p).diagonal().setConstant(s0 / theta);
  J.topRightCorner(p, 1) = -s0 / (theta * theta) * d.head(p);
  J(p, p) = -1 / theta;
  const double widened = static_cast<double>(r) / degrees;
  const MatrixXd information = -l.hessian;
  out.joint = widened * J * information.ldlt().solve(J.transpose());
  out.line.covariance = out.joint.topLeftCorner(p, p);
  out.line.s = out.s_likely * std::sqrt(widened);
  out.line.degrees = degrees;
  return out;
}

}  // namespace turnwright::cutting
