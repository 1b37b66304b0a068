#include "turnwright/base/least_squares.hpp"

#include <Eigen/QR>

namespace turnwright {

LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& v,
                           double dependent) {
  using Eigen::MatrixXd;
  if (A.cols() == 0) return {0, Eigen::VectorXd(0), MatrixXd(0, 0)};
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A.rows(), A.cols());
  if (dependent > 0) qr.setThreshold(dependent);
  qr.compute(A);
  LeastSquares out{qr.rank(), {}, {}};
  MatrixXd inverse = MatrixXd::Zero(A.cols(), out.rank);
  inverse.topRows(out.rank) = qr.matrixR()
                                  .topLeftCorner(out.rank, out.rank)
                                  .triangularView<Eigen::Upper>()
                                  .solve(MatrixXd::Identity(out.rank, out.rank));
  out.root = qr.colsPermutation() * inverse;
  const Eigen::VectorXd along = qr.householderQ().adjoint() * v;
  out.x = out.root * along.head(out.rank);
  return out;
}

}  // namespace turnwright
