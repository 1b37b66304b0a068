#include "turnwright/learning/advice.hpp"

#include <gtest/gtest.h>

#include "simulated.hpp"

namespace turnwright::learning {
namespace {

// y = 10.002 + 0.0005 k, scattering by +- 0.001 in turn; corrected by -0.004 before.
Series worn() {
  Series s;
  for (int k = 0; k < 40; ++k)
    s.push_back({10.002 + 5e-4 * k + (k % 2 == 0 ? 1e-3 : -1e-3) - 0.004, -0.004, 0.1 * k,
                 0, static_cast<double>(k)});
  return s;
}

TEST(Advice, CorrectsTheNextPartAndSaysWhenAgain) {
  const auto series = worn();
  const auto trend = *fit_trend(series, 0.95);
  const auto next = next_part(series);
  EXPECT_NEAR(next.step, 0.1, 1e-12);
  EXPECT_EQ(next.part.age, 40);
  const Limits limits{10, 10.02, 9.985};
  const auto a = advice(trend, next.part, next.step, limits, 0.95);
  EXPECT_NEAR(a.expected_mm.value, 10.018, 2e-4);
  EXPECT_NEAR(a.correction_mm.value, 10 - a.expected_mm.value, 1e-12);
  EXPECT_NEAR(a.correction_mm.upper - a.correction_mm.value,
              a.expected_mm.value - a.expected_mm.lower, 1e-12);
  EXPECT_TRUE(a.worthwhile);
  EXPECT_NEAR(a.per_part_mm, 5e-4, 2e-5);
  EXPECT_NEAR(a.room_mm, 0.015 - 3 * trend.s_mm, 1e-12);
  EXPECT_EQ(a.due_in, static_cast<long>(a.room_mm / a.per_part_mm));
}

TEST(Advice, ScatterThatFillsTheLimitsLeavesNoRoom) {
  const auto series = worn();
  const auto trend = *fit_trend(series, 0.95);
  const auto next = next_part(series);
  const auto a = advice(trend, next.part, next.step, {10, 10.002, 9.998}, 0.95);
  EXPECT_LT(a.room_mm, 0);
  EXPECT_EQ(a.due_in, 0);
}

TEST(Advice, WithoutTrendNothingFallsDue) {
  Series s;
  for (int k = 0; k < 20; ++k) s.push_back({k % 2 == 0 ? 1.0 : -1.0, 0, 0, 0, 0});
  const auto trend = *fit_trend(s, 0.95);
  const auto a = advice(trend, next_part(s).part, 0, {0, 50, -50}, 0.95);
  EXPECT_FALSE(a.due_in);
  EXPECT_FALSE(a.worthwhile);
}

}  // namespace
}  // namespace turnwright::learning
