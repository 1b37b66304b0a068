#include "turnwright/part/shaft.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace turnwright::part {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const std::vector<Segment> kShaft{{40, 30, 30, 10, 12}, {20, 30, 40, 0, 0}};

TEST(Shaft, LengthIsTheRoundedTrueSum) {
  EXPECT_EQ(length_mm(kShaft), 60);
  // ten times the double nearest 0.1 is 1 + 5.6e-17; plain summation gives 1 - 1.1e-16
  const std::vector<Segment> tenths(10, Segment{0.1, 1, 1, 0, 0});
  EXPECT_EQ(length_mm(tenths), 1.0);
  EXPECT_EQ(ends_mm(tenths).front(), 0.0);
  EXPECT_EQ(ends_mm(tenths).size(), 11u);
}

TEST(Shaft, SplittingCutsDiametersWhereTheLineIs) {
  const auto [left, right] = split(kShaft[0], 10);
  EXPECT_EQ(left.length_mm, 10);
  EXPECT_EQ(right.length_mm, 30);
  EXPECT_EQ(left.outer_left_mm, 30);
  EXPECT_EQ(left.inner_left_mm, 10);
  EXPECT_EQ(left.inner_right_mm, 10.5);
  EXPECT_EQ(right.inner_left_mm, 10.5);
  EXPECT_EQ(right.inner_right_mm, 12);
  const auto cone = split(kShaft[1], 15);
  EXPECT_EQ(cone.left.outer_left_mm, 30);
  EXPECT_EQ(cone.left.outer_right_mm, 37.5);
  EXPECT_EQ(cone.right.outer_left_mm, 37.5);
  EXPECT_EQ(cone.right.outer_right_mm, 40);
  for (const double at : {0.0, 40.0, -1.0, kNaN})
    EXPECT_THROW(split(kShaft[0], at), std::domain_error);
}

TEST(Shaft, TheUncutSideIsThickerByTwiceTheDepth) {
  const auto to_chuck = in_process(kShaft, 30, 1.5, FeedTowards::chuck);
  ASSERT_EQ(to_chuck.size(), 3u);
  EXPECT_EQ(to_chuck[0].outer_left_mm, 33);
  EXPECT_EQ(to_chuck[0].outer_right_mm, 33);
  EXPECT_EQ(to_chuck[0].length_mm, 30);
  EXPECT_EQ(to_chuck[0].inner_left_mm, 10);
  EXPECT_EQ(to_chuck[1].outer_left_mm, 30);
  EXPECT_EQ(to_chuck[1].inner_left_mm, to_chuck[0].inner_right_mm);
  EXPECT_EQ(to_chuck[2].outer_right_mm, 40);

  const auto to_tail = in_process(kShaft, 40, 1.5, FeedTowards::tail);
  ASSERT_EQ(to_tail.size(), 2u);
  EXPECT_EQ(to_tail[0].outer_right_mm, 30);
  EXPECT_EQ(to_tail[1].outer_left_mm, 33);
  EXPECT_EQ(to_tail[1].outer_right_mm, 43);
  EXPECT_EQ(to_tail[1].inner_right_mm, 0);
}

TEST(Shaft, AtTheEndsTheToolLeavesOneSideOnly) {
  for (const double a : {0.0, 60.0}) {
    const bool all = a == 60.0;
    const auto body = in_process(kShaft, a, 1, FeedTowards::chuck);
    ASSERT_EQ(body.size(), 2u);
    EXPECT_EQ(body[0].outer_left_mm, all ? 32 : 30);
    EXPECT_EQ(body[1].outer_right_mm, all ? 42 : 40);
  }
}

TEST(Shaft, RefusesWhatIsNoCut) {
  for (const double a : {-0.1, 60.1, kNaN})
    EXPECT_THROW(in_process(kShaft, a, 1, FeedTowards::tail), std::domain_error);
  for (const double ap : {-0.1, kNaN, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(in_process(kShaft, 10, ap, FeedTowards::tail), std::domain_error);
}

}  // namespace
}  // namespace turnwright::part
