#include "turnwright/base/least_squares.hpp"

#include <gtest/gtest.h>

namespace turnwright {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns that are far from orthogonal, and values that no x meets.
MatrixXd slanted() {
  return MatrixXd{{1, 2, 0}, {0, 1, 3}, {2, 0, 1}, {1, 1, 1}, {3, -1, 2}};
}
VectorXd values() { return VectorXd{{1, -2, 0.5, 4, 3}}; }

TEST(LeastSquares, ResidualIsNormalToEveryColumn) {
  const MatrixXd A = slanted();
  const auto s = least_squares(A, values());
  EXPECT_EQ(s.rank, 3);
  EXPECT_LE((A.transpose() * (values() - A * s.x)).norm(), 1e-13);
  EXPECT_GE((values() - A * s.x).norm(), 1);
}

TEST(LeastSquares, RootIsOfTheInverseOfTheNormalMatrix) {
  const MatrixXd A = slanted();
  const MatrixXd root = least_squares(A, values()).root;
  EXPECT_LE(
      (A.transpose() * A * root * root.transpose() - MatrixXd::Identity(3, 3)).norm(),
      1e-13);
}

TEST(LeastSquares, ColumnThatDependsIsLeftOut) {
  MatrixXd A = slanted();
  A.col(1) = 0.25 * A.col(0) - 0.5 * A.col(2);
  const auto s = least_squares(A, values());
  EXPECT_EQ(s.rank, 2);
  const MatrixXd two{{A(0, 0), A(0, 2)},
                     {A(1, 0), A(1, 2)},
                     {A(2, 0), A(2, 2)},
                     {A(3, 0), A(3, 2)},
                     {A(4, 0), A(4, 2)}};
  const auto without = least_squares(two, values());
  EXPECT_NEAR(s.x[0], without.x[0], 1e-13);
  EXPECT_EQ(s.x[1], 0);
  EXPECT_NEAR(s.x[2], without.x[1], 1e-13);
  EXPECT_EQ(s.root.rows(), 3);
  EXPECT_EQ(s.root.cols(), 2);
  EXPECT_EQ(s.root.row(1).norm(), 0);
  EXPECT_NEAR(s.root.row(0).norm(), without.root.row(0).norm(), 1e-13);
}

TEST(LeastSquares, DependentAsToldToBe) {
  MatrixXd A = slanted();
  A.col(1) = A.col(0) + 1e-6 * A.col(1);
  EXPECT_EQ(least_squares(A, values()).rank, 3);
  const auto s = least_squares(A, values(), 1e-5);
  EXPECT_EQ(s.rank, 2);
  const bool first = s.x[0] == 0;  // one of two columns that are nearly one
  EXPECT_EQ(s.x[first ? 0 : 1], 0);
  EXPECT_EQ(s.root.row(first ? 0 : 1).norm(), 0);
  const MatrixXd two = A(Eigen::all, {first ? 1 : 0, 2});
  const auto without = least_squares(two, values());
  EXPECT_NEAR(s.x[first ? 1 : 0], without.x[0], 1e-12);
  EXPECT_NEAR(s.x[2], without.x[1], 1e-12);
}

TEST(LeastSquares, NothingFromNoColumns) {
  const auto s = least_squares(MatrixXd(5, 0), values());
  EXPECT_EQ(s.rank, 0);
  EXPECT_EQ(s.x.size(), 0);
}

}  // namespace
}  // namespace turnwright
