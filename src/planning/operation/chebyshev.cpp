#include "chebyshev.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace turnwright::planning {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kRounding = 1e-14;  // of the largest term

double angle(std::size_t k, std::size_t n) {
  return (2.0 * static_cast<double>(k) + 1) * std::numbers::pi /
         (2.0 * static_cast<double>(n));
}

// Terms of the Chebyshev series of the polynomials through values at n points, without
// those that are only rounding, which monomials of high degree would magnify a
// thousandfold.
MatrixXd series(const std::function<Eigen::VectorXd(double u)>& values, std::size_t n) {
  const auto rows = static_cast<Index>(n);
  MatrixXd c;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::VectorXd v = values(std::cos(angle(i, n)));
    if (i == 0) c = MatrixXd::Zero(rows, v.size());
    for (Index k = 0; k < rows; ++k)
      c.row(k) += (k == 0 ? 1.0 : 2.0) / static_cast<double>(n) *
                  std::cos(static_cast<double>(k) * angle(i, n)) * v.transpose();
  }
  for (auto column : c.colwise()) {
    const double rounding = kRounding * column.cwiseAbs().maxCoeff();
    column = (column.array().abs() > rounding).select(column, 0);
  }
  return c;
}

bool ends_within(const MatrixXd& series, double share) {
  const Eigen::RowVectorXd most = share * series.cwiseAbs().colwise().maxCoeff();
  return (series.bottomRows(2).cwiseAbs().array() <= most.replicate(2, 1).array()).all();
}

// By T_k+1 = 2 u T_k - T_k-1.
MatrixXd monomials(const MatrixXd& series) {
  const Index n = series.rows();
  MatrixXd T = MatrixXd::Identity(n, n);  // row k: the coefficients of T_k
  for (Index k = 2; k < n; ++k) {
    T(k, 0) = 0;
    T.row(k).tail(n - 1) = 2 * T.row(k - 1).head(n - 1);
    T.row(k) -= T.row(k - 2);
  }
  return T.transpose() * series;
}

}  // namespace

std::vector<double> chebyshev(std::size_t n) {
  std::vector<double> u(n);
  for (std::size_t k = 0; k < n; ++k) u[k] = std::cos(angle(k, n));
  return u;
}

MatrixXd through(const std::vector<double>& points, const MatrixXd& values) {
  const auto n = static_cast<Index>(points.size());
  MatrixXd V(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      V(i, j) = std::pow(points[static_cast<std::size_t>(i)], static_cast<double>(j));
  return V.partialPivLu().solve(values);
}

MatrixXd following(const std::function<Eigen::VectorXd(double u)>& values) {
  constexpr double kEnd = 1e-11;
  constexpr std::size_t kFirst = 11, kMore = 7, kMost = 25;
  std::size_t n = kFirst;
  MatrixXd c = series(values, n);
  while (n < kMost && !ends_within(c, kEnd)) c = series(values, n += kMore);
  return monomials(c);
}

Polynomial polynomial(const Eigen::VectorXd& c, double centre, double half) {
  Polynomial p{centre, half, {c.data(), c.data() + c.size()}};
  const double size = c.cwiseAbs().maxCoeff();
  while (p.c.size() > 1 && std::abs(p.c.back()) <= 1e-13 * size) p.c.pop_back();
  return p;
}

}  // namespace turnwright::planning
