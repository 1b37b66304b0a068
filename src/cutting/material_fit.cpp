#include "turnwright/cutting/material_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastThickness = 0.04879;  // ln 1.05
constexpr double kLeastSpread = 0.02;
constexpr int kSpare = 3;  // measurements beyond the unknowns that are always kept

double quantile(double p, int degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), p);
}

/// y = X c + error.
struct Regression {
  VectorXd c;
  MatrixXd inverse;  // (X'X)^-1
  VectorXd residual, leverage;
  double s2 = 0;
  int degrees = 0;

  Regression(const MatrixXd& X, const VectorXd& y) {
    const auto solved = least_squares(X, y);
    if (solved.rank < X.cols())
      throw ModelRangeError("material_fit: the cuts do not tell the exponents apart");
    c = solved.x;
    inverse = solved.root * solved.root.transpose();
    residual = y - X * c;
    leverage = (X * inverse).cwiseProduct(X).rowwise().sum();
    degrees = static_cast<int>(X.rows() - X.cols());
    s2 = residual.squaredNorm() / degrees;
  }
  double covariance(Index i, Index j) const { return s2 * inverse(i, j); }
};

MatrixXd rows_of(const MatrixXd& X, const std::vector<std::size_t>& rows) {
  return X(rows, Eigen::all);
}

// The row that fits the others least, if it is less likely than p over their number.
std::optional<std::size_t> outlier(const Regression& r, double p) {
  std::optional<std::size_t> worst;
  double largest = 0;
  for (Index i = 0; i < r.residual.size(); ++i) {
    const double room = 1 - r.leverage[i];
    if (!(room > 1e-9)) continue;
    const double e2 = r.residual[i] * r.residual[i] / room;
    const double rest = (r.degrees * r.s2 - e2) / (r.degrees - 1);
    const double t = std::sqrt(e2 / std::max(rest, 1e-300));
    if (t > largest) {
      largest = t;
      worst = static_cast<std::size_t>(i);
    }
  }
  const auto n = static_cast<double>(r.residual.size());
  if (r.s2 < 1e-24 || !(p > 0)) return std::nullopt;  // nothing but rounding
  return largest > quantile(1 - p / (2 * n), r.degrees - 1) ? worst : std::nullopt;
}

Regression robust(const MatrixXd& X, const VectorXd& y, double p, Evidence& e) {
  e.used.resize(static_cast<std::size_t>(X.rows()));
  std::iota(e.used.begin(), e.used.end(), std::size_t{0});
  const std::size_t most = e.used.size() / 5;
  for (;;) {
    Regression r(rows_of(X, e.used), y(e.used));
    if (e.outliers.size() < most && r.degrees > kSpare)
      if (const auto i = outlier(r, p)) {
        e.outliers.push_back(e.used[*i]);
        e.used.erase(e.used.begin() + static_cast<std::ptrdiff_t>(*i));
        continue;
      }
    std::sort(e.outliers.begin(), e.outliers.end());
    e.degrees_of_freedom = r.degrees;
    e.s = std::sqrt(r.s2);
    e.s_prediction =
        e.s * std::sqrt(1 + 1 / static_cast<double>(e.used.size()));  // at the mean
    return r;
  }
}

/// Root mean square of the part of a column that a constant and the columns before it do
/// not explain.
double spread(const MatrixXd& before, const VectorXd& column) {
  const VectorXd c = least_squares(before, column).x;
  return std::sqrt((column - before * c).squaredNorm() /
                   static_cast<double>(column.size()));
}

void require(bool good) {
  if (!good) throw std::domain_error("material_fit: a measurement is not positive");
}
bool positive(double x) { return x > 0 && std::isfinite(x); }

Estimate ends(double value, double one, double other) {
  return {value, std::min(one, other), std::max(one, other)};
}

/// c_j by Student's t, times a number.
Estimate interval(const Regression& r, Index j, double times, const FitOptions& options) {
  const double t = quantile((1 + options.confidence) / 2, r.degrees);
  const double half = t * std::sqrt(r.covariance(j, j));
  return ends(times * r.c[j], times * (r.c[j] - half), times * (r.c[j] + half));
}

/// -c_i/c_j by Fieller's theorem; c_j differs from 0 by more than its interval.
Estimate ratio(const Regression& r, Index i, Index j, double t) {
  const double a = r.c[i], b = r.c[j], t2 = t * t;
  const double vaa = r.covariance(i, i), vab = r.covariance(i, j),
               vbb = r.covariance(j, j);
  const double A = b * b - t2 * vbb, B = a * b - t2 * vab, C = a * a - t2 * vaa;
  const double root = std::sqrt(std::max(0.0, B * B - A * C));
  return ends(-a / b, -(B - root) / A, -(B + root) / A);
}

Estimate exponential(const Estimate& e) {
  const Estimate out{std::exp(e.value), std::exp(e.lower), std::exp(e.upper)};
  if (!std::isfinite(out.upper))
    throw ModelRangeError("material_fit: the cuts scatter beyond every bound");
  return out;
}

}  // namespace

void Evidence::rename(const std::vector<std::size_t>& names) {
  for (auto* list : {&used, &outliers})
    for (std::size_t& i : *list) i = names[i];
}

KienzleFit fit_kienzle(std::span<const ForcePoint> cuts, const FitOptions& options) {
  KienzleFit fit;
  const auto n = static_cast<Index>(cuts.size());
  MatrixXd X(n, 2);
  VectorXd y(n);
  for (Index i = 0; i < n; ++i) {
    const ForcePoint& p = cuts[static_cast<std::size_t>(i)];
    require(positive(p.h_mm) && positive(p.b_mm) && positive(p.F_N));
    X.row(i) << 1, std::log(p.h_mm);
    y[i] = std::log(p.F_N / (p.b_mm * p.h_mm));  // (1)
  }
  if (n == 0 || X.col(1).maxCoeff() - X.col(1).minCoeff() < kLeastThickness) {
    for (const char* name : {"k1.1", "m"})
      fit.missing.push_back({name, "a cut at another chip thickness (another feed)"});
    return fit;
  }
  if (n < 3) {
    for (const char* name : {"k1.1", "m"})
      fit.missing.push_back({name, "a third cut, to judge the errors by"});
    return fit;
  }
  const Regression r = robust(X, y, options.outlier_p, fit.evidence);
  fit.k11_MPa = exponential(interval(r, 0, 1, options));
  fit.m = interval(r, 1, -1, options);
  return fit;
}

namespace {

// Eq. (3) for F = A theta; none if the columns cannot be told apart or a force would not be
// positive.  A theta/F = 1 is the start.
std::optional<Regression> thrust_regression(const MatrixXd& A, const VectorXd& F,
                                            const FitOptions& options,
                                            Evidence& evidence) {
  constexpr int kSteps = 50;
  constexpr double kNear = 1e-13;
  if (A.rows() <= A.cols() + 1 && A.cols() > 1) return std::nullopt;
  try {
    VectorXd theta =
        least_squares(F.cwiseInverse().asDiagonal() * A, VectorXd::Ones(F.size())).x;
    for (int step = 0;; ++step) {
      const VectorXd said = A * theta;
      if (!(said.minCoeff() > 0)) return std::nullopt;
      const MatrixXd J = said.cwiseInverse().asDiagonal() * A;
      const VectorXd y = F.cwiseQuotient(said).array().log() + 1;  // J theta = 1
      evidence = {};
      const Regression r = robust(J, y, options.outlier_p, evidence);
      if ((r.c - theta).norm() <= kNear * theta.norm() || step == kSteps) return r;
      theta = r.c;
    }
  } catch (const ModelRangeError&) {
    return std::nullopt;
  }
}

}  // namespace

ThrustFit fit_thrust(std::span<const ThrustPoint> cuts, const catalogue::Thrust& given,
                     const FitOptions& options) {
  ThrustFit fit;
  const auto n = static_cast<Index>(cuts.size());
  MatrixXd A(n, 2);
  VectorXd F(n);
  for (Index i = 0; i < n; ++i) {
    const ThrustPoint& p = cuts[static_cast<std::size_t>(i)];
    require(positive(p.Fc_N) && positive(p.L_mm) && positive(p.share) && positive(p.F_N));
    A.row(i) << p.Fc_N * p.share, p.L_mm * p.share;
    F[i] = p.F_N;
  }
  if (n < 3) return fit;
  const auto both = thrust_regression(A, F, options, fit.evidence);
  if (both && both->c.minCoeff() >= 0) {
    fit.ratio = interval(*both, 0, 1, options);
    fit.edge_N_mm = interval(*both, 1, 1, options);
    return fit;
  }
  fit.scaled = true;
  const MatrixXd whole = A * Eigen::Vector2d(given.ratio, given.edge_N_mm);
  const auto one = thrust_regression(whole, F, options, fit.evidence);
  fit.ratio = interval(*one, 0, given.ratio, options);
  fit.edge_N_mm = interval(*one, 0, given.edge_N_mm, options);
  return fit;
}

TaylorFit fit_taylor(std::span<const LifePoint> lives, double given_a, double given_b,
                     const FitOptions& options) {
  TaylorFit fit;
  const auto n = static_cast<Index>(lives.size());
  VectorXd v(n), f(n), d(n), y(n);
  for (Index i = 0; i < n; ++i) {
    const LifePoint& p = lives[static_cast<std::size_t>(i)];
    require(positive(p.vc_m_min) && positive(p.f_mm_rev) && positive(p.ap_mm) &&
            positive(p.T_min));
    v[i] = std::log(p.vc_m_min);
    f[i] = std::log(p.f_mm_rev);
    d[i] = std::log(p.ap_mm);
    y[i] = std::log(p.T_min);
  }
  // Columns: 1, ln vc with the terms of the given exponents, then ln f and ln ap if they
  // vary enough.
  const auto nothing = [&](const std::string& test) {
    fit.missing.insert(fit.missing.begin(), {{"n", test}, {"C", test}});
    return fit;
  };
  MatrixXd X = MatrixXd::Ones(n, 1);
  if (n == 0 || spread(X, v) < kLeastSpread)
    return nothing("a tool life at another cutting speed");
  X.conservativeResize(n, 2);
  X.col(1) = v;
  const auto add = [&](const VectorXd& column, double given, const char* name,
                       const char* test) {
    if (spread(X, column) >= kLeastSpread) {
      X.conservativeResize(n, X.cols() + 1);
      X.col(X.cols() - 1) = column;
      return true;
    }
    fit.missing.push_back({name, test});
    X.col(1) += given * column;
    return false;
  };
  const bool with_a =
      add(f, given_a, "a", "a tool life at another feed, speed unchanged");
  const bool with_b =
      add(d, given_b, "b", "a tool life at another depth, speed and feed unchanged");
  if (n < X.cols() + 1)
    return nothing("as many tool lives as there are constants and one more: " +
                   std::to_string(X.cols() + 1));

  const Regression r = robust(X, y, options.outlier_p, fit.evidence);
  const double t = quantile((1 + options.confidence) / 2, r.degrees);
  const double half = t * std::sqrt(r.covariance(1, 1));
  if (!(r.c[1] + half < 0))
    return nothing(
        "tool lives at speeds further apart, for the life does not fall with "
        "the speed beyond doubt");
  fit.n = ends(-1 / r.c[1], -1 / (r.c[1] - half), -1 / (r.c[1] + half));
  fit.C = exponential(ratio(r, 0, 1, t));
  const auto exponent = [&](Index j) {  // a = c_j/c_1
    const Estimate e = ratio(r, j, 1, t);
    return Estimate{-e.value, -e.upper, -e.lower};
  };
  if (with_a) fit.a = exponent(2);
  if (with_b) fit.b = exponent(with_a ? 3 : 2);
  return fit;
}

}  // namespace turnwright::cutting
