#include "turnwright/volumetric/axis_table.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "turnwright/base/least_squares.hpp"

namespace turnwright::volumetric {

AxisFit fit_axis(const AxisTable& table, double Q, int degree) {
  const auto fits = [&](const std::vector<double>& v) {
    return v.empty() || v.size() == table.q.size();
  };
  const std::set<double> places(table.q.begin(), table.q.end());
  if (!(Q > 0) || degree < 0 || degree > 3 || !fits(table.plus) || !fits(table.minus) ||
      (table.plus.empty() && table.minus.empty()) ||
      places.size() < static_cast<std::size_t>(degree) + 1)
    throw std::domain_error("fit_axis: columns of one length at degree + 1 positions");
  const bool both = !table.plus.empty() && !table.minus.empty();
  const Eigen::Index columns = degree + 1 + (both ? 1 : 0),
                     n = static_cast<Eigen::Index>(table.plus.size() +
                                                   table.minus.size());
  Eigen::MatrixXd A(n, columns);
  Eigen::VectorXd v(n);
  Eigen::Index row = 0;
  for (const double sign : {1.0, -1.0}) {
    const auto& readings = sign > 0 ? table.plus : table.minus;
    for (std::size_t i = 0; i < readings.size(); ++i, ++row) {
      for (Eigen::Index k = 0; k <= degree; ++k)
        A(row, k) = std::pow(table.q[i] / Q, static_cast<double>(k));
      if (both) A(row, degree + 1) = sign;
      v[row] = readings[i];
    }
  }
  const auto [rank, x, root] = least_squares(A, v);
  AxisFit fit;
  if (rank < columns) {
    fit.u.fill(std::numeric_limits<double>::infinity());
    return fit;
  }
  if (n > columns)
    fit.s = std::sqrt((v - A * x).squaredNorm() / static_cast<double>(n - columns));
  for (Eigen::Index k = 0; k < columns; ++k) {
    const bool reversal = k > degree;
    (reversal ? fit.error.b : fit.error.c[static_cast<std::size_t>(k)]) = x[k];
    fit.u[reversal ? 4 : static_cast<std::size_t>(k)] = fit.s * root.row(k).norm();
  }
  return fit;
}

}  // namespace turnwright::volumetric
