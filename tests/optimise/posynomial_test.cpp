#include "turnwright/optimise/posynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "turnwright/optimise/local.hpp"

namespace turnwright::optimise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Posynomial box(Index n, double lower, double upper) {
  return {.terms = {MatrixXd::Zero(1, n), VectorXd::Zero(1)},
          .limits = {MatrixXd(0, n), VectorXd(0)},
          .lower = VectorXd::Constant(n, lower),
          .upper = VectorXd::Constant(n, upper)};
}

double value(const Monomials& terms, const VectorXd& y) {
  return std::log((terms.c + terms.a * y).array().exp().sum());
}

TEST(Posynomial, ClosedForms) {
  // x + 1/x: 2 at x = 1.  x + y with x y >= 1: 2, the limit's elasticity 1/2.
  auto p = box(1, -3, 5);
  p.terms = {MatrixXd{{1}, {-1}}, VectorXd::Zero(2)};
  auto r = minimise(p);
  EXPECT_NEAR(r.f, std::log(2), 1e-10);
  EXPECT_NEAR(r.lower_bound, std::log(2), 1e-9);
  EXPECT_NEAR(r.y[0], 0, 1e-5);

  auto q = box(2, -3, 3);
  q.terms = {MatrixXd::Identity(2, 2), VectorXd::Zero(2)};
  q.limits = {MatrixXd{{-1, -1}}, VectorXd::Zero(1)};
  r = minimise(q);
  EXPECT_NEAR(r.f, std::log(2), 1e-9);
  EXPECT_NEAR(r.multipliers[0], 0.5, 1e-6);
  EXPECT_LE(r.lower_bound, std::log(2) + 1e-13);
}

TEST(Posynomial, AtACornerOfTheBoxAndOnASingleValue) {
  auto p = box(2, -1, 2);
  p.terms.a << 1, 2;
  EXPECT_NEAR(minimise(p).f, -3, 1e-9);
  p.lower[1] = p.upper[1] = 0.7;  // does not move
  EXPECT_NEAR(minimise(p).f, -1 + 1.4, 1e-9);
  p.lower[0] = p.upper[0] = 0.1;
  EXPECT_NEAR(minimise(p).f, 0.1 + 1.4, 1e-9);
  EXPECT_NEAR(minimise(p).lower_bound, 0.1 + 1.4, 1e-9);
}

TEST(Posynomial, TwoLimitsThatLeaveOneValue) {
  auto p = box(2, -4, 4);
  p.terms = {MatrixXd{{1, 0}, {0, 1}, {-1, -1}}, VectorXd::Zero(3)};
  p.limits = {MatrixXd{{1, 2}, {-1, -2}}, VectorXd{{-1, 1}}};  // y0 + 2 y1 = 1
  const auto r = minimise(p);
  double best = 1e9;
  for (int i = -40000; i <= 40000; ++i) {
    const double y1 = i * 1e-4;
    best = std::min(best, value(p.terms, VectorXd{{1 - 2 * y1, y1}}));
  }
  EXPECT_NEAR(r.f, best, 1e-7);
  EXPECT_LE(r.lower_bound, best);
  EXPECT_NEAR(r.lower_bound, best, 1e-7);
  EXPECT_LE(r.violation, 1e-9);
}

TEST(Posynomial, WhatIsNotPossibleHasABoundAboveEverything) {
  auto p = box(2, 0, 1);
  p.terms.a << 1, 1;
  p.limits = {MatrixXd{{1, 1}, {-1, -1}}, VectorXd{{-1, 1.001}}};
  const auto r = minimise(p, {.cutoff = 2.0});  // f <= 2 in the box
  EXPECT_GT(r.lower_bound, 2);
  EXPECT_GT(r.violation, 1e-4);
}

TEST(Posynomial, RefusesSizesThatDiffer) {
  auto p = box(2, 0, 1);
  p.upper.conservativeResize(1);
  EXPECT_THROW(minimise(p), std::domain_error);
  p = box(2, 1, 0);
  EXPECT_THROW(minimise(p), std::domain_error);
}

// Random programs: NLopt finds nothing lower, samples neither, and both ends meet.
TEST(Posynomial, AgreesWithNloptOnRandomPrograms) {
  std::mt19937 seed(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto random = [&](Index rows, Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return 2 * unit(seed); }).eval();
  };
  int possible = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 2 + trial % 5, m = trial % 17;
    auto p = box(n, -2, 3);
    p.terms = {random(4, n), 3 * random(4, 1)};
    p.limits = {random(m, n), random(m, 1).array() - 0.7};
    const auto r = minimise(p);
    if (r.violation > 1e-9) {
      EXPECT_GT(r.lower_bound, 60) << trial;  // above what the terms can be in the box
      continue;
    }
    ++possible;
    EXPECT_LE(r.f - r.lower_bound, 2e-9) << trial;
    Problem same;
    same.lower.assign(p.lower.begin(), p.lower.end());
    same.upper.assign(p.upper.begin(), p.upper.end());
    same.constraints = static_cast<std::size_t>(m);
    same.evaluate = [&](std::span<const double> y, Values& out) {
      const VectorXd at = Eigen::Map<const VectorXd>(y.data(), n);
      const VectorXd e = (p.terms.c + p.terms.a * at).array().exp();
      out.f = std::log(e.sum());
      const VectorXd df = p.terms.a.transpose() * e / e.sum(),
                     g = p.limits.c + p.limits.a * at;
      out.df.assign(df.begin(), df.end());
      out.g.assign(g.begin(), g.end());
      for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j)
          out.dg[static_cast<std::size_t>(i * n + j)] = p.limits.a(i, j);
    };
    const auto other =
        local_minimum(same, std::vector<double>(static_cast<std::size_t>(n), 0.5));
    ASSERT_NE(other.status, Status::no_feasible_point_met) << trial;
    EXPECT_GE(other.f, r.lower_bound - 1e-8) << trial;
    EXPECT_LE(r.f, other.f + 1e-8) << trial;
    const double over = m > 0 ? (p.limits.c + p.limits.a * r.y).maxCoeff() : 0;
    EXPECT_LE(over, 1e-9) << trial;
    for (int k = 0; k < 200; ++k) {
      const VectorXd y = VectorXd::NullaryExpr(n, [&] { return 0.5 + 2.5 * unit(seed); });
      if (m == 0 || (p.limits.c + p.limits.a * y).maxCoeff() <= 0) {
        EXPECT_GE(value(p.terms, y), r.lower_bound) << trial;
      }
    }
  }
  EXPECT_GT(possible, 100);
}

}  // namespace
}  // namespace turnwright::optimise
