#include "regression.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "turnwright/base/distributions.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/least_squares.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSpare = 3;  // measurements beyond the unknowns that are always kept

struct Regression {
  VectorXd c;
  MatrixXd inverse;  // (X'X)^-1
  VectorXd residual, leverage;
  double s2 = 0;
  int degrees = 0;

  Regression(const MatrixXd& X, const VectorXd& y) {
    const auto solved = least_squares(X, y);
    if (solved.rank < X.cols())
      throw ModelRangeError(tr("material_fit: the cuts do not tell the exponents apart"));
    c = solved.x;
    inverse = solved.root * solved.root.transpose();
    residual = y - X * c;
    leverage = (X * inverse).cwiseProduct(X).rowwise().sum();
    degrees = static_cast<int>(X.rows() - X.cols());
    s2 = residual.squaredNorm() / degrees;
  }
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
  return largest > student_quantile(1 - p / (2 * n), r.degrees - 1) ? worst
                                                                    : std::nullopt;
}

}  // namespace

Line robust_line(const MatrixXd& X, const VectorXd& y, double p, Evidence& e) {
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
    e.s_prediction = prediction_s(e.s, e.used.size());
    return {r.c, r.s2 * r.inverse, e.s, static_cast<double>(r.degrees)};
  }
}

double prediction_s(double s, std::size_t n) {
  return s * std::sqrt(1 + 1 / static_cast<double>(n));
}

double student(double confidence, double degrees) {
  return student_quantile((1 + confidence) / 2, degrees);
}

double spread(const MatrixXd& before, const VectorXd& column) {
  const VectorXd c = least_squares(before, column).x;
  return std::sqrt((column - before * c).squaredNorm() /
                   static_cast<double>(column.size()));
}

Estimate ends(double value, double one, double other) {
  return {value, std::min(one, other), std::max(one, other)};
}

Estimate interval(const Line& line, Index j, double times, double confidence) {
  const double half =
      student(confidence, line.degrees) * std::sqrt(line.covariance(j, j));
  const double c = line.c[j];
  return ends(times * c, times * (c - half), times * (c + half));
}

Estimate ratio(const Line& line, Index i, Index j, double t) {
  const double a = line.c[i], b = line.c[j], t2 = t * t;
  const double vaa = line.covariance(i, i), vab = line.covariance(i, j),
               vbb = line.covariance(j, j);
  const double A = b * b - t2 * vbb, B = a * b - t2 * vab, C = a * a - t2 * vaa;
  const double root = std::sqrt(std::max(0.0, B * B - A * C));
  return ends(-a / b, -(B - root) / A, -(B + root) / A);
}

Estimate exponential(const Estimate& e) {
  const Estimate out{std::exp(e.value), std::exp(e.lower), std::exp(e.upper)};
  if (!std::isfinite(out.upper))
    throw ModelRangeError(tr("material_fit: the cuts scatter beyond every bound"));
  return out;
}

}  // namespace turnwright::cutting
