#include "turnwright/deflection/deviation_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <stop_token>

#include "random_shafts.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {
namespace {

using random_shafts::between, random_shafts::normal;

std::vector<double> places(std::size_t n, double length) {
  std::vector<double> z(n);
  for (std::size_t i = 0; i < n; ++i)
    z[i] = length * static_cast<double>(i + 1) / static_cast<double>(n);
  return z;
}

template <class F>
std::vector<double> at(const std::vector<double>& z, const F& f) {
  std::vector<double> e;
  for (const double x : z) e.push_back(f(x));
  return e;
}

double cubic(double z) { return 0.002 + 1e-5 * z + 3e-9 * z * z * z; }

TEST(DeviationGraph, ExactGraphGivesItsPolynomialAndSteps) {
  const auto z = places(60, 120);
  const auto e = at(
      z, [](double x) { return cubic(x) + (x > 41 ? 0.015 : 0) - (x > 83 ? 0.012 : 0); });
  const auto g = deviation_graph(z, e);
  ASSERT_EQ(g.steps.size(), 2u);
  EXPECT_EQ(g.steps[0].after_mm, 40);
  EXPECT_EQ(g.steps[0].before_mm, 42);
  EXPECT_NEAR(g.steps[0].height_mm, 0.015, 1e-12);
  EXPECT_EQ(g.steps[1].after_mm, 82);
  EXPECT_NEAR(g.steps[1].height_mm, -0.012, 1e-12);
  ASSERT_EQ(g.coefficients.size(), 4u);
  EXPECT_NEAR(g.coefficients[0], 0.002, 1e-12);
  EXPECT_NEAR(g.coefficients[1], 1e-5, 1e-13);
  EXPECT_NEAR(g.coefficients[2], 0, 1e-14);
  EXPECT_NEAR(g.coefficients[3], 3e-9, 1e-16);
  EXPECT_NEAR(g.r2, 1, 1e-12);
  EXPECT_LT(g.r2_as_measured, 0.9);
  EXPECT_LT(g.steps[0].p, 1e-6);
  EXPECT_EQ(g.degrees_of_freedom, 60 - 4 - 2);
}

TEST(DeviationGraph, TakesTheLowestDegreeThatExplains) {
  const auto z = places(40, 100);
  for (int degree = 0; degree <= 3; ++degree) {
    const auto g = deviation_graph(
        z, at(z, [&](double x) { return 0.004 + 0.01 * std::pow(x / 100, degree); }));
    EXPECT_EQ(g.coefficients.size(), static_cast<std::size_t>(degree + 1));
    EXPECT_TRUE(g.steps.empty());
    EXPECT_EQ(g.r2, g.r2_as_measured);
  }
}

// The statement of [Valino 2008]: steps of 10 to 20 um where the section changes are not
// the part's. A bar with three sections, deflected, has none; with the carriage's it has two.
TEST(DeviationGraph, ASteppedBarMakesNoStepsACarriageDoes) {
  const Workpiece part(
      {210000, 0.3, {{40, 32, 32, 0, 0}, {40, 27, 27, 0, 0}, {40, 22, 22, 0, 0}}});
  const auto z = places(60, 120);
  std::vector<double> e;
  for (const auto& r : responses(part, {}, z, {300, 650, 180}))
    e.push_back(r.radius_error_mm);
  std::mt19937_64 random(4);
  for (double& x : e) x += 0.0005 * normal(random);
  const auto smooth = deviation_graph(z, e);
  EXPECT_TRUE(smooth.steps.empty());
  EXPECT_GT(smooth.r2, 0.95);

  for (std::size_t i = 0; i < z.size(); ++i)
    e[i] += (z[i] > 40 ? 0.014 : 0) + (z[i] > 80 ? -0.011 : 0);
  const auto stepped = deviation_graph(z, e);
  ASSERT_EQ(stepped.steps.size(), 2u);
  EXPECT_EQ(stepped.steps[0].after_mm, 40);
  EXPECT_NEAR(stepped.steps[0].height_mm, 0.014, 3 * stepped.steps[0].u_mm);
  EXPECT_EQ(stepped.steps[1].after_mm, 80);
  EXPECT_NEAR(stepped.steps[1].height_mm, -0.011, 3 * stepped.steps[1].u_mm);
  EXPECT_GT(stepped.r2, 0.95);
  EXPECT_LT(stepped.r2_as_measured, stepped.r2 - 0.2);
}

TEST(DeviationGraph, AGraphWithoutStepsHardlyEverGetsOne) {
  std::mt19937_64 random(1);
  for (const std::size_t n : {15U, 50U}) {
    const auto z = places(n, 150);
    int with = 0;
    for (int trial = 0; trial < 200; ++trial)
      with += !deviation_graph(
                   z, at(z, [&](double x) { return cubic(x) + 0.001 * normal(random); }))
                   .steps.empty();
    EXPECT_LE(with, 6) << n;  // 1 % and three standard deviations
  }
}

TEST(DeviationGraph, StepsInNoiseAreFoundWithTheErrorsTheyState) {
  std::mt19937_64 random(2);
  const auto z = places(50, 150);
  int found = 0, within_1 = 0, within_2 = 0;
  const int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    const auto g = deviation_graph(z, at(z, [&](double x) {
                                     return cubic(x) + (x > 61 ? 0.010 : 0) +
                                            0.0015 * normal(random);
                                   }));
    if (g.steps.size() != 1 || g.steps[0].after_mm != 60) continue;
    ++found;
    const double off = std::abs(g.steps[0].height_mm - 0.010) / g.steps[0].u_mm;
    within_1 += off < 1;
    within_2 += off < 2;
  }
  EXPECT_GT(found, 190);
  EXPECT_NEAR(within_1, 0.68 * found, 22);
  EXPECT_NEAR(within_2, 0.95 * found, 12);
}

// Every pair of places tried by brute force finds none better than the one told.
TEST(DeviationGraph, OnePairIsTheBestOfAll) {
  std::mt19937_64 random(9);
  const auto z = places(24, 120);
  const auto e = at(z, [&](double x) {
    return (x > 37 ? 0.009 : 0) + (x > 92 ? 0.007 : 0) + 0.001 * normal(random);
  });
  const auto g = deviation_graph(z, e, {.max_degree = 0, .max_steps = 2});
  ASSERT_EQ(g.steps.size(), 2u);
  const auto rss_of = [&](std::size_t a, std::size_t b) {  // three means
    double rss = 0;
    for (const auto& [from, to] : {std::pair{std::size_t{0}, a}, {a, b}, {b, e.size()}}) {
      double mean = 0;
      for (auto i = from; i < to; ++i) mean += e[i] / static_cast<double>(to - from);
      for (auto i = from; i < to; ++i) rss += (e[i] - mean) * (e[i] - mean);
    }
    return rss;
  };
  double least = 1;
  for (std::size_t a = 3; a + 6 <= e.size(); ++a)
    for (std::size_t b = a + 3; b + 3 <= e.size(); ++b)
      least = std::min(least, rss_of(a, b));
  EXPECT_NEAR(g.s_mm * g.s_mm * static_cast<double>(g.degrees_of_freedom), least,
              1e-12 * least);
}

TEST(DeviationGraph, ThreeStepsAndUnsortedPlaces) {
  auto z = places(80, 160);
  std::mt19937_64 random(6);
  std::shuffle(z.begin(), z.end(), random);
  const auto g = deviation_graph(z, at(z, [](double x) {
                                   return cubic(x) + (x > 31 ? 0.012 : 0) -
                                          (x > 75 ? 0.020 : 0) + (x > 121 ? 0.015 : 0);
                                 }));
  ASSERT_EQ(g.steps.size(), 3u);
  EXPECT_EQ(g.steps[0].after_mm, 30);
  EXPECT_EQ(g.steps[1].after_mm, 74);
  EXPECT_EQ(g.steps[2].after_mm, 120);
  EXPECT_NEAR(g.steps[1].height_mm, -0.020, 1e-11);
}

TEST(DeviationGraph, OneWrongPointIsNoStep) {
  const auto z = places(50, 150);
  std::mt19937_64 random(8);
  auto e = at(z, [&](double x) { return cubic(x) + 0.001 * normal(random); });
  e[25] += 0.02;
  EXPECT_TRUE(deviation_graph(z, e).steps.empty());
}

TEST(DeviationGraph, MovesAndScalesWithItsGraph) {
  std::mt19937_64 random(12);
  const auto z = places(50, 150);
  const auto e = at(z, [&](double x) {
    return cubic(x) + (x > 61 ? 0.010 : 0) + 0.001 * normal(random);
  });
  auto far = z, mirrored = e;
  for (double& x : far) x = 2 * x + 500;
  for (double& x : mirrored) x *= -3;
  const auto a = deviation_graph(z, e), b = deviation_graph(far, mirrored);
  ASSERT_EQ(b.steps.size(), 1u);
  EXPECT_NEAR(b.steps[0].after_mm, 2 * a.steps[0].after_mm + 500, 1e-9);
  EXPECT_NEAR(b.steps[0].height_mm, -3 * a.steps[0].height_mm, 1e-12);
  EXPECT_NEAR(b.steps[0].u_mm, 3 * a.steps[0].u_mm, 1e-12);
  EXPECT_NEAR(b.r2, a.r2, 1e-9);
  ASSERT_EQ(a.coefficients.size(), b.coefficients.size());
  const double top_a = a.coefficients.back(), top_b = b.coefficients.back();
  const auto degree = static_cast<double>(a.coefficients.size() - 1);
  EXPECT_NEAR(top_b / top_a, -3 / std::pow(2, degree), 1e-6);
  EXPECT_NEAR(b.u_coefficients.back() / a.u_coefficients.back(), 3 / std::pow(2, degree),
              1e-6);
}

TEST(DeviationGraph, ConstantGraphAndRefusals) {
  const auto z = places(10, 100);
  const auto g = deviation_graph(z, std::vector<double>(10, 0.003));
  EXPECT_EQ(g.coefficients.size(), 1u);
  EXPECT_NEAR(g.coefficients[0], 0.003, 1e-17);
  EXPECT_EQ(g.r2, 1);
  const std::vector<double> e(10, 0), five(5, 0);
  EXPECT_THROW(deviation_graph(z, five), std::domain_error);
  EXPECT_THROW(deviation_graph(places(5, 10), five), std::domain_error);
  EXPECT_NO_THROW(deviation_graph(places(5, 10), five, {.max_degree = 2}));
  EXPECT_THROW(deviation_graph(std::vector<double>(10, 7), e), std::domain_error);
  EXPECT_THROW(deviation_graph(z, e, {.max_degree = 7}), std::domain_error);
  EXPECT_THROW(deviation_graph(z, e, {.max_steps = -1}), std::domain_error);
  auto nan = e;
  nan[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(deviation_graph(z, nan), std::domain_error);
}

TEST(DeviationGraph, HearsThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const Listening listening(token);
  EXPECT_THROW(deviation_graph(places(20, 100), std::vector<double>(20, 0)), Cancelled);
}

}  // namespace
}  // namespace turnwright::deflection
