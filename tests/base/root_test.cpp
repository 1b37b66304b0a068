#include "turnwright/base/root.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace turnwright {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

TEST(BracketedRoot, OfSmoothFunctionsByNewton) {
  int calls = 0;
  const auto g = [&calls](double x) {
    ++calls;
    return std::pair{x * x - 2, 2 * x};
  };
  EXPECT_DOUBLE_EQ(bracketed_root(g, 0, 2, 2, kEpsilon), std::sqrt(2.0));
  EXPECT_LE(calls, 7);
}

// Newton's steps leave the bracket, run in circles, or have no finite slope.
TEST(BracketedRoot, WhereNewtonFails) {
  const auto steep = [](double x) {
    return std::pair{std::cbrt(x - 0.3), 1 / (3 * std::pow(std::cbrt(x - 0.3), 2))};
  };
  EXPECT_NEAR(bracketed_root(steep, 0, 1, 0.9, kEpsilon), 0.3, 1e-15);
  const auto circles = [](double x) {  // from 0 to 1 and back
    return std::pair{x * x * x - 2 * x + 2, 3 * x * x - 2};
  };
  EXPECT_NEAR(bracketed_root(circles, -3, 2, 0, kEpsilon), -1.7692923542386314, 1e-15);
  const auto wavy = [](double x) {  // three roots; falls between them
    return std::pair{x + 2 * std::sin(5 * x) - 0.9, 1 + 10 * std::cos(5 * x)};
  };
  const double x = bracketed_root(wavy, 0, 3, 0.35, kEpsilon);
  EXPECT_NEAR(wavy(x).first, 0, 1e-14);
}

TEST(BracketedRoot, AtTheSmallestNumbers) {
  int calls = 0;
  const auto g = [&calls](double x) {
    ++calls;
    return std::pair{x - 1e-300, 0.0};
  };
  EXPECT_DOUBLE_EQ(bracketed_root(g, 0, 1, 1, kEpsilon), 1e-300);
  EXPECT_LT(calls, 200);
}

}  // namespace
}  // namespace turnwright
