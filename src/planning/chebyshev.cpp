#include "chebyshev.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace turnwright::planning {

std::vector<double> chebyshev(std::size_t n) {
  std::vector<double> u(n);
  for (std::size_t k = 0; k < n; ++k)
    u[k] = std::cos((2.0 * static_cast<double>(k) + 1) * std::numbers::pi /
                    (2.0 * static_cast<double>(n)));
  return u;
}

Eigen::MatrixXd through(const std::vector<double>& points,
                        const Eigen::MatrixXd& values) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd V(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      V(i, j) = std::pow(points[static_cast<std::size_t>(i)], static_cast<double>(j));
  return V.partialPivLu().solve(values);
}

Polynomial polynomial(const Eigen::VectorXd& c, double centre, double half) {
  Polynomial p{centre, half, {c.data(), c.data() + c.size()}};
  const double size = c.cwiseAbs().maxCoeff();
  while (p.c.size() > 1 && std::abs(p.c.back()) <= 1e-13 * size) p.c.pop_back();
  return p;
}

}  // namespace turnwright::planning
