#include "turnwright/base/log_dual.hpp"

#include <gtest/gtest.h>

#include <random>

namespace turnwright {
namespace {

using L = LogDual<2>;
using D = Dual<double, 2>;

// One expression over any positive scalar: sums, products, powers, corners.
template <class T>
std::vector<T> expressions(const T& x, const T& y) {
  using std::max;
  using std::min;
  using std::pow;
  using std::sqrt;
  const T sum = 2.0 * x * y + 3.0 / y + 0.5;
  const auto below = [&](const T& v) -> T { return v * y; };
  const auto above = [&](const T& v) -> T {
    return T(T(sqr(v) / 1.5) - T(1e-3)) * y / (1 - 1e-3 / 1.5);
  };
  return {sum,
          pow(sum, -1.7) * sqr(x) / sqrt(y),
          max(x, T(sum / 4.0)),
          min(max(T(1.0), T(x * y)), T(5.0 / x)),
          T(T(12.0) - x),
          difference(T(4.0), T(x * y), 0.3),
          branch(x, 1.5, below, above)};
}

TEST(LogDual, BoxesHoldValuesAndElasticitiesOfTheirPoints) {
  std::mt19937 seed(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 4000; ++trial) {
    const double size = 2 * std::pow(unit(seed), 3);
    const double a = -1 + 2 * unit(seed), b = -1 + 2 * unit(seed);
    const std::array<Interval, 2> box{Interval(a, a + size * unit(seed)),
                                      Interval(b, b + size * unit(seed))};
    const L::Half half{width(box[0]) / 2, width(box[1]) / 2};
    const auto over =
        expressions(L::variable(box[0], 0, half), L::variable(box[1], 1, half));
    for (int k = 0; k < 6; ++k) {
      const double u = box[0].lo + unit(seed) * width(box[0]);
      const double v = box[1].lo + unit(seed) * width(box[1]);
      const auto at =
          expressions(exp(variable<double, 2>(u, 0)), exp(variable<double, 2>(v, 1)));
      for (std::size_t i = 0; i < at.size(); ++i) {
        const D ln = log(at[i]);
        EXPECT_LE(over[i].ln.lo, ln.v + 1e-12) << i;
        EXPECT_GE(over[i].ln.hi, ln.v - 1e-12) << i;
        for (std::size_t j = 0; j < 2; ++j) {
          EXPECT_LE(over[i].d[j].lo, ln.d[j] + 1e-11) << i << j;
          EXPECT_GE(over[i].d[j].hi, ln.d[j] - 1e-11) << i << j;
        }
      }
    }
    const auto middle = expressions(std::exp(mid(box[0])), std::exp(mid(box[1])));
    for (std::size_t i = 0; i < middle.size(); ++i)
      EXPECT_NEAR(over[i].centre, std::log(middle[i]), 1e-12) << i;
  }
}

TEST(LogDual, MonomialsAreExactOnAnyBox) {
  const std::array<Interval, 2> y{Interval(-3, 2), Interval(0, 4)};
  const L::Half half{2.5, 2};
  const L x = L::variable(y[0], 0, half), z = L::variable(y[1], 1, half);
  const L m = pow(x, 0.7) * pow(z, -1.3) * x / sqrt(z) * 5.0;
  EXPECT_NEAR(m.d[0].lo, 1.7, 1e-15);
  EXPECT_NEAR(m.d[0].hi, 1.7, 1e-15);
  EXPECT_NEAR(m.d[1].lo, -1.8, 1e-15);
  EXPECT_NEAR(m.ln.lo, std::log(5.0) - 1.7 * 3 - 1.8 * 4, 1e-13);
  EXPECT_NEAR(m.ln.hi, std::log(5.0) + 1.7 * 2, 1e-13);
  // x/x is one, not the quotient of two ranges.
  EXPECT_NEAR((x / x).ln.hi, 0, 1e-15);
}

TEST(LogDual, ElasticityOfASumStaysBetweenThoseOfItsTerms) {
  const std::array<Interval, 2> y{Interval(-9, 9), Interval(0)};
  const L::Half half{9, 0};
  const L x = L::variable(y[0], 0, half);
  const L s = pow(x, 3.0) + 1.0 / x;
  EXPECT_GE(s.d[0].lo, -1);
  EXPECT_LE(s.d[0].hi, 3);
  EXPECT_LE(s.ln.lo, std::log(std::pow(3.0, -0.75) + std::pow(3.0, 0.25)));
}

// A quantity whose centre is not known keeps every later one from using (2).
TEST(LogDual, AnUnknownCentreStaysUnknown) {
  std::mt19937 seed(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 500; ++trial) {
    const Interval x(1 + unit(seed), 2.1 + unit(seed)), v(-0.5, 0.4);
    const L::Half half{0, width(v) / 2};
    const L known = L::variable(v, 1, half);
    const auto over = expressions(positive(Dual<Interval, 2>(x, {})), known);
    for (int k = 0; k < 5; ++k) {
      const double at_x = x.lo + unit(seed) * width(x);
      const double at_v = v.lo + unit(seed) * width(v);
      const auto at = expressions(D(at_x), exp(variable<double, 2>(at_v, 1)));
      for (std::size_t i = 0; i < at.size(); ++i) {
        const D ln = log(at[i]);
        EXPECT_LE(over[i].ln.lo, ln.v + 1e-12) << i;
        EXPECT_GE(over[i].ln.hi, ln.v - 1e-12) << i;
        EXPECT_LE(over[i].d[1].lo, ln.d[1] + 1e-11) << i;
        EXPECT_GE(over[i].d[1].hi, ln.d[1] - 1e-11) << i;
      }
    }
  }
}

TEST(LogDual, ZeroIsNeutral) {
  const L::Half half{1, 0};
  const L x = L::variable(Interval(-1, 1), 0, half), zero(0.0);
  EXPECT_TRUE(zero.zero());
  EXPECT_EQ((x + zero).ln.hi, x.ln.hi);
  EXPECT_EQ((zero + x).d[0].lo, 1);
  EXPECT_EQ(max(zero, x).ln.lo, x.ln.lo);
}

}  // namespace
}  // namespace turnwright
