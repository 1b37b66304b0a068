#include "turnwright/deflection/shoulder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "random_shafts.hpp"

namespace turnwright::deflection {
namespace {

using part::Segment;

void expect_shape(const std::vector<Segment>& got, const std::vector<Segment>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i].length_mm, expected[i].length_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].outer_left_mm, expected[i].outer_left_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].outer_right_mm, expected[i].outer_right_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].inner_left_mm, expected[i].inner_left_mm, 1e-12) << i;
    EXPECT_NEAR(got[i].inner_right_mm, expected[i].inner_right_mm, 1e-12) << i;
  }
}

TEST(Shoulder, TableLinearBetweenAndHeldAtTheEnds) {
  EXPECT_EQ(shoulder_lambda(0.85), 0.035);
  EXPECT_EQ(shoulder_lambda(0.7), 0.105);
  EXPECT_EQ(shoulder_lambda(0.6), 0.145);
  EXPECT_EQ(shoulder_lambda(0.5), 0.17);
  EXPECT_EQ(shoulder_lambda(0.4), 0.19);
  EXPECT_EQ(shoulder_lambda(0.3), 0.205);
  EXPECT_NEAR(shoulder_lambda(0.65), 0.125, 1e-15);
  EXPECT_NEAR(shoulder_lambda(0.35), 0.1975, 1e-15);
  EXPECT_EQ(shoulder_lambda(0.1), 0.205);
  EXPECT_EQ(shoulder_lambda(0.99), 0.035);
  EXPECT_EQ(shoulder_lambda(1), 0);
  for (const double bad : {0.0, 1.01, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(shoulder_lambda(bad), std::domain_error);
}

TEST(Shoulder, TheThinSectionReachesIntoTheThickOneOnEitherSide) {
  // d/D = 0.5: lambda d = 0.17 20 = 3.4
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{80, 40, 40, 0, 0}, {100, 20, 20, 0, 0}}),
      {{76.6, 40, 40, 0, 0}, {3.4, 20, 20, 0, 0}, {100, 20, 20, 0, 0}});
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 6, 6}, {80, 40, 30, 10, 10}}),
      {{50, 20, 20, 6, 6}, {3.4, 20, 20, 6, 6}, {76.6, 40 - 10 * 3.4 / 80, 30, 10, 10}});
}

TEST(Shoulder, NoStepNoChange) {
  const std::vector<Segment> smooth{{80, 40, 30, 0, 5}, {60, 30, 30, 20, 20}};
  expect_shape(shoulder_corrected(smooth), smooth);
}

TEST(Shoulder, AtMostTheThickLength) {
  // a collar of 2 mm: 3.4 from the right is cut to 2, 0.035 36 = 1.26 from the left lies
  // within it; the thinner section stands
  expect_shape(shoulder_corrected(std::vector<Segment>{
                   {50, 36, 36, 0, 0}, {2, 40, 40, 0, 0}, {50, 20, 20, 0, 0}}),
               {{50, 36, 36, 0, 0},
                {1.26, 20, 20, 0, 0},
                {0.74, 20, 20, 0, 0},
                {50, 20, 20, 0, 0}});
  // a cone, and one that is thinner than d after 2.5 mm
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 0, 0}, {4, 40, 60, 0, 0}}),
      {{50, 20, 20, 0, 0}, {3.4, 20, 20, 0, 0}, {0.6, 57, 60, 0, 0}});
  expect_shape(
      shoulder_corrected(std::vector<Segment>{{50, 20, 20, 0, 0}, {4, 40, 8, 0, 0}}),
      {{50, 20, 20, 0, 0}, {2.5, 20, 20, 0, 0}, {1.5, 20, 8, 0, 0}});
}

TEST(Shoulder, CuttingSegmentsInTwoChangesNothing) {
  for (const auto& [name, shaft] : random_shafts::all(23)) {
    part::Shaft halves = shaft, one = shaft;
    halves.segments.clear();
    for (const Segment& s : shaft.segments) {
      const auto [left, right] = part::split(s, 0.02 * s.length_mm);
      halves.segments.insert(halves.segments.end(), {left, right});
    }
    one.segments = shoulder_corrected(shaft.segments);
    halves.segments = shoulder_corrected(halves.segments);
    const Beam x(one), y(halves);
    for (const double u : {0.2, 0.6, 1.0}) {
      const double a = u * x.length_mm();
      EXPECT_NEAR(y.at(a, {}).f_ww_mm_N / x.at(a, {}).f_ww_mm_N, 1, 1e-9) << name;
    }
  }
}

}  // namespace
}  // namespace turnwright::deflection
