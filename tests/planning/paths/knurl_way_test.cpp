// Where a knurling wheel goes along an element.
#include <gtest/gtest.h>

#include <cmath>

#include "planning/paths/approach.hpp"
#include "planning/paths/pass_lengths.hpp"

namespace turnwright::planning {
namespace {

constexpr double kWheel_mm = 8;

void expect_way(const std::optional<KnurlWay>& way, double from, double to) {
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->from_mm, from, 1e-12);
  EXPECT_NEAR(way->to_mm, to, 1e-12);
}

TEST(KnurlWay, BeginsWithHalfTheWheelAndEndsWithTheElement) {
  expect_way(knurl_way({INFINITY, 0, false}, -10, -30, kWheel_mm), -14, -30);
  expect_way(knurl_way({INFINITY, 0, true}, -10, -30, kWheel_mm), -14, -30 + kBehind_mm);
  // Where half the wheel is longer than the element, it is pressed in alone.
  expect_way(knurl_way({INFINITY, 0, false}, -10, -13, kWheel_mm), -13, -13);
}

TEST(KnurlWay, BeginsWithAllOfTheWheelBehindWhatIsHigher) {
  expect_way(knurl_way({0, 0, false}, -10, -30, kWheel_mm), -18, -30);
  expect_way(knurl_way({INFINITY, 0.5, false}, -10, -30, kWheel_mm), -18, -30);
  expect_way(knurl_way({4.2, 0, false}, -10, -30, kWheel_mm), -14, -30);
  EXPECT_FALSE(knurl_way({0, 0, false}, -10, -17, kWheel_mm));
  EXPECT_FALSE(knurl_way({0, 0, true}, -10, -18, kWheel_mm));
  EXPECT_TRUE(knurl_way({0, 0, false}, -10, -18, kWheel_mm));
}

}  // namespace
}  // namespace turnwright::planning
