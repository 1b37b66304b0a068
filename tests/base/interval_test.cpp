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

// Of members drawn from each interval, ends among them: none of their results lies outside,
// and two of them come to the ends.
template <typename Of>
void encloses(const char* name, double least, Of&& of) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-5, 5), size(0, 4);
  for (int i = 0; i < 200; ++i) {
    const auto drawn = [&] {
      const double lo = std::max(at(random), least);
      return Interval{lo, lo + size(random)};
    };
    const Interval x = drawn(), y = drawn(), told = of(x, y);
    if (told.lo == Interval::whole().lo) continue;
    constexpr int kSamples = 40;
    Interval seen{Interval::whole().hi, Interval::whole().lo};
    for (int j = 0; j <= kSamples; ++j)
      for (int k = 0; k <= kSamples; ++k) {
        const double z = of(Interval(std::lerp(x.lo, x.hi, j / double{kSamples})),
                            Interval(std::lerp(y.lo, y.hi, k / double{kSamples})))
                             .lo;
        seen = {std::min(seen.lo, z), std::max(seen.hi, z)};
      }
    const double rounding = 1e-14 * std::max(std::abs(told.lo), std::abs(told.hi));
    EXPECT_LE(told.lo, seen.lo + rounding) << name;
    EXPECT_GE(told.hi, seen.hi - rounding) << name;
    EXPECT_NEAR(told.lo, seen.lo, rounding + 0.02) << name;
    EXPECT_NEAR(told.hi, seen.hi, rounding + 0.02) << name;
  }
}

TEST(Interval, ArithmeticIsEnclosedTightly) {
  encloses("+", -5, [](auto x, auto y) { return x + y; });
  encloses("-", -5, [](auto x, auto y) { return x - y; });
  encloses("*", -5, [](auto x, auto y) { return x * y; });
  encloses("/", 0.1, [](auto x, auto y) { return x / y; });
  encloses("/ of negatives", 0.1, [](auto x, auto y) { return x / -y; });
  encloses("min", -5, [](auto x, auto y) { return min(x, y); });
  encloses("max", -5, [](auto x, auto y) { return max(x, y); });
  encloses("sqr", -5, [](auto x, auto) { return sqr(x); });
  encloses("exp", -5, [](auto x, auto) { return exp(x + -Interval{5}); });
  encloses("log", 0.1, [](auto x, auto) { return log(x); });
  encloses("sqrt", 0, [](auto x, auto) { return sqrt(x); });
  encloses("acos", 0, [](auto x, auto) { return acos(x * Interval{0.1}); });
  encloses("x^1.5", 0, [](auto x, auto) { return pow(x, 1.5); });
  encloses("x^-0.5", 0.1, [](auto x, auto) { return pow(x, -0.5); });
}

// Where an operation has no meaning, the rest of its argument counts; where nothing is
// known, the whole line.
TEST(Interval, WhatHasNoMeaningIsLeftOut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto is = [](const Interval& x, double lo, double hi) {
    return x.lo == lo && x.hi == hi;
  };
  EXPECT_TRUE(is(log({-1, 1}), -kInfinity, 0));
  EXPECT_TRUE(is(sqrt({-1, 4}), 0, 2));
  EXPECT_TRUE(is(pow({-1, 4}, 0.5), 0, 2));
  EXPECT_TRUE(is(pow({-1, 4}, -0.5), 0.5, kInfinity));
  EXPECT_TRUE(is(acos({-2, 2}), 0, std::acos(-1)));
  EXPECT_TRUE(is(Interval{1} / Interval{-1, 1}, -kInfinity, kInfinity));
  EXPECT_TRUE(is(Interval{1} / Interval{0, 1}, -kInfinity, kInfinity));
  EXPECT_TRUE(is(Interval{0, 1} * Interval::whole(), -kInfinity, kInfinity));
}

TEST(Dual, SlopesOfSineAndCosine) {
  const auto x = variable<double, 1>(0.7, 0);
  EXPECT_DOUBLE_EQ(sin(2 * x).d[0], 2 * std::cos(1.4));
  EXPECT_DOUBLE_EQ(cos(2 * x).d[0], -2 * std::sin(1.4));
}

}  // namespace
}  // namespace turnwright
