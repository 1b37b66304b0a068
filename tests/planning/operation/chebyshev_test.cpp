#include "planning/operation/chebyshev.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace turnwright::planning {
namespace {

using Eigen::VectorXd;

struct Followed {
  Eigen::MatrixXd c;
  int points = 0;

  double at(double u, Eigen::Index column = 0) const {
    double sum = 0;
    for (Eigen::Index k = c.rows(); k-- > 0;) sum = sum * u + c(k, column);
    return sum;
  }
};

template <class F>
Followed followed(const F& f) {
  Followed out;
  out.c = following([&](double u) {
    ++out.points;
    return VectorXd{f(u)};
  });
  return out;
}

template <class F>
double largest_error(const Followed& p, const F& f) {
  double most = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double u = i / 500.0 - 1;
    most = std::max(most, std::abs(p.at(u) / f(u)(0) - 1));
  }
  return most;
}

TEST(Following, AQuarticIsItsOwnPolynomial) {
  const auto p = followed([](double u) {
    return VectorXd{{3 - u + 0.5 * u * u * u * u, 0.0}};
  });
  EXPECT_EQ(p.points, 11);
  const VectorXd expected{{3, -1, 0, 0, 0.5}};
  for (Eigen::Index k = 0; k < p.c.rows(); ++k) {
    EXPECT_NEAR(p.c(k, 0), k < expected.size() ? expected[k] : 0, 1e-13) << k;
    EXPECT_EQ(p.c(k, 1), 0) << k;
  }
}

// A bar of radius 1 to 3 yields as 1/(2 + u)^4: eleven points are not enough.
TEST(Following, WhatVariesFastGetsMorePoints) {
  const auto f = [](double u) { return VectorXd{{std::pow(2 + u, -4)}}; };
  const auto p = followed(f);
  EXPECT_GT(p.points, 11 + 18);
  EXPECT_LE(largest_error(p, f), 1e-9);
}

TEST(Following, TheMostDemandingOfSeveralDecides) {
  const auto p = followed([](double u) { return VectorXd{{1 + u, 1 / (3 + u)}}; });
  EXPECT_EQ(p.points, 11 + 18);
  for (const double u : {-0.99, -0.3, 0.77}) {
    EXPECT_NEAR(p.at(u, 0), 1 + u, 1e-13);
    EXPECT_NEAR(p.at(u, 1), 1 / (3 + u), 1e-11);
  }
}

TEST(Following, EndsWithAKinkToo) {
  const auto f = [](double u) { return VectorXd{{1 + std::abs(u)}}; };
  const auto p = followed(f);
  EXPECT_EQ(p.points, 11 + 18 + 25);
  EXPECT_LE(largest_error(p, f), 0.05);
}

}  // namespace
}  // namespace turnwright::planning
