#include "eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace turnwright::chatter {

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return {};  // which Eigen does not take
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

Eigenpairs eigenpairs(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {.values = solver.eigenvalues(),
          .vectors = solver.eigenvectors().colwise().normalized()};
}

Dominant dominant(const Eigen::MatrixXd& monodromy) {
  Dominant out{.multiplier = 0, .unstable = 0};
  for (const auto& x : eigenvalues(monodromy)) {
    if (std::abs(x) > std::abs(out.multiplier)) out.multiplier = x;
    if (std::abs(x) > 1) ++*out.unstable;
  }
  return out;
}

}  // namespace turnwright::chatter
