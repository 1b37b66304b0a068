#include "spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace turnwright::milling {

Dominant dominant(const Eigen::MatrixXd& monodromy) {
  const Eigen::VectorXcd mu =
      Eigen::EigenSolver<Eigen::MatrixXd>(monodromy, false).eigenvalues();
  Dominant out{.multiplier = 0, .unstable = 0};
  for (const auto& x : mu) {
    if (std::abs(x) > std::abs(out.multiplier)) out.multiplier = x;
    if (std::abs(x) > 1) ++*out.unstable;
  }
  return out;
}

}  // namespace turnwright::milling
