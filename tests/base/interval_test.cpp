#include "turnwright/base/interval.hpp"

#include <gtest/gtest.h>

#include <random>

#include "turnwright/base/dual.hpp"

namespace turnwright {
namespace {

// Every value lies inside, and the ends are values.
TEST(Interval, SinesAndCosinesAreEnclosedTightly) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-20, 20), size(0, 8);
  for (int i = 0; i < 500; ++i) {
    const double lo = at(random);
    const Interval x{lo, lo + size(random)};
    constexpr int kSamples = 4000;
    Interval s{2, -2}, c{2, -2};
    for (int k = 0; k <= kSamples; ++k) {
      const double t = x.lo + width(x) * k / kSamples;
      s = {std::min(s.lo, std::sin(t)), std::max(s.hi, std::sin(t))};
      c = {std::min(c.lo, std::cos(t)), std::max(c.hi, std::cos(t))};
    }
    for (const auto& [told, seen] : {std::pair{sin(x), s}, std::pair{cos(x), c}}) {
      EXPECT_LE(told.lo, seen.lo + 1e-14);
      EXPECT_GE(told.hi, seen.hi - 1e-14);
      EXPECT_NEAR(told.lo, seen.lo, 1e-6);
      EXPECT_NEAR(told.hi, seen.hi, 1e-6);
    }
  }
}

TEST(Dual, SlopesOfSineAndCosine) {
  const auto x = variable<double, 1>(0.7, 0);
  EXPECT_DOUBLE_EQ(sin(2 * x).d[0], 2 * std::cos(1.4));
  EXPECT_DOUBLE_EQ(cos(2 * x).d[0], -2 * std::sin(1.4));
}

}  // namespace
}  // namespace turnwright
