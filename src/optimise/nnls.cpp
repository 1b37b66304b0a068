#include "turnwright/optimise/nnls.hpp"

#include <vector>

#include "turnwright/base/least_squares.hpp"

namespace turnwright::optimise {
namespace {

using Eigen::Index;

// Least squares over the passive columns, zero elsewhere.
Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                      const std::vector<Index>& passive) {
  const Eigen::VectorXd z = least_squares(A(Eigen::all, passive), b).x;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  for (std::size_t k = 0; k < passive.size(); ++k)
    x[passive[k]] = z[static_cast<Index>(k)];
  return x;
}

}  // namespace

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A,
                                           const Eigen::VectorXd& b) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  std::vector<Index> passive;
  // A column enters while it still points along the residual, beyond rounding.
  const double tolerance = 1e-13 * (1 + A.cwiseAbs().sum()) * (1 + b.norm());
  for (Index step = 0; step < 3 * A.cols(); ++step) {
    Eigen::VectorXd w = A.transpose() * (b - A * x);
    for (const Index p : passive) w[p] = 0;
    Index enter = 0;
    if (w.size() == 0 || w.maxCoeff(&enter) <= tolerance) break;
    passive.push_back(enter);
    Eigen::VectorXd z = solve(A, b, passive);
    while (true) {  // retreat until every passive entry is positive
      double alpha = 1;
      for (const Index p : passive)
        if (z[p] <= 0) alpha = std::min(alpha, x[p] / (x[p] - z[p]));
      if (!(alpha < 1)) break;
      x += alpha * (z - x);
      std::erase_if(passive, [&](Index p) { return x[p] <= 1e-15 * (1 + x.maxCoeff()); });
      if (passive.empty()) break;
      z = solve(A, b, passive);
    }
    if (passive.empty()) break;
    x = z;
  }
  return x.cwiseMax(0.0);
}

}  // namespace turnwright::optimise
