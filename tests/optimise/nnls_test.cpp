#include "turnwright/optimise/nnls.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace turnwright::optimise {
namespace {

TEST(Nnls, IsTheProjectionWhereThatIsPositive) {
  Eigen::MatrixXd A(3, 2);
  A << 1, 0, 0, 2, 0, 0;
  const Eigen::Vector3d b(3, 4, 7);
  const auto x = non_negative_least_squares(A, b);
  EXPECT_NEAR(x[0], 3, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
}

TEST(Nnls, StopsAtZeroWhereTheProjectionIsNegative) {
  const Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
  const auto x = non_negative_least_squares(A, Eigen::Vector2d(-1, 5));
  EXPECT_EQ(x[0], 0);
  EXPECT_NEAR(x[1], 5, 1e-14);
}

TEST(Nnls, KeepsTheOptimalityConditions) {
  // x >= 0, w = A'(b - A x) <= 0, x w = 0: necessary and sufficient, the problem is
  // convex.
  std::mt19937 seed(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const int m = 2 + trial % 5, n = 1 + trial % 9;
    Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(m, n, [&] { return normal(seed); });
    if (trial % 3 == 0 && n > 1) A.col(0) = A.col(n - 1);  // dependent columns
    const Eigen::VectorXd b =
        Eigen::VectorXd::NullaryExpr(m, [&] { return normal(seed); });
    const auto x = non_negative_least_squares(A, b);
    const Eigen::VectorXd w = A.transpose() * (b - A * x);
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_LE(w.maxCoeff(), 1e-9);
    EXPECT_NEAR(x.dot(w), 0, 1e-9);
  }
}

}  // namespace
}  // namespace turnwright::optimise
