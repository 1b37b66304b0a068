#include "report/picture/removal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace turnwright::report::removal_test {
namespace {

using Shape = Cutter::Shape;

// A bar of radius 20, from -100 to 0, with a ring every 0.01 mm.
Work bar(double hole = 0) {
  Work work{-100, 0.01, {}};
  work.rings.assign(10001, {hole, 20});
  return work;
}

double at(const Work& work, double z, bool bore = false) {
  const auto i = static_cast<std::size_t>(std::lround((z - work.from_z) / work.step));
  return bore ? work.rings[i].inner_mm : work.rings[i].outer_mm;
}

// Area of the half section that is missing from a bar.
double taken(const Work& work, double hole = 0) {
  double sum = 0;
  for (const auto& ring : work.rings)
    sum += 20 - hole - std::max(0.0, ring.outer_mm - ring.inner_mm);
  return sum * work.step;
}

// Tip at radius 15 down to z = -40: 5 mm over 40 mm; at the end the corner leaves a fillet
// of area r^2 (1 - pi/4).
TEST(Removal, AStraightPassLeavesItsRadiusAndTheFilletOfTheCorner) {
  auto work = bar();
  take_off(work, {Shape::corner, 0.8}, {15, 2}, {15, -40});
  EXPECT_NEAR(at(work, -20), 15, 1e-9);
  EXPECT_DOUBLE_EQ(at(work, -40.01), 20);
  EXPECT_NEAR(at(work, -39.2), 15, 1e-9);  // a corner's radius before the end
  EXPECT_NEAR(at(work, -39.6), 15.8 - std::sqrt(0.64 - 0.16), 1e-9);
  EXPECT_NEAR(taken(work), 5 * 40 - 0.64 * (1 - std::numbers::pi / 4), 0.06);
}

// On a cone the tangent corner lies on a line parallel to the way of its tip, at the
// distance that toolpath/path.hpp Eq. (1) gives.
TEST(Removal, AConeIsTangentToTheCorner) {
  auto work = bar();
  const double r = 0.8, slope = 0.25;  // of the radius towards the chuck
  take_off(work, {Shape::corner, r}, {10, 0}, {20, -40});
  const double c = 1 / std::hypot(1, slope), s = slope * c;  // normal (c, s)
  for (const double z : {-10.0, -20.0, -30.0}) {
    // centre (x + r, z' + r), touches in centre - r (c, s)
    const double tip_z = z - r + r * s;
    EXPECT_NEAR(at(work, z), 10 + slope * -tip_z + r * (1 - c), 1e-6) << z;
  }
}

TEST(Removal, ThePartOnTheChucksSideStays) {
  auto work = bar();
  take_off(work, {Shape::corner, 0.4}, {12, -50}, {20, -50});  // a plunge
  EXPECT_EQ(at(work, -50.01), 20);
  EXPECT_LT(at(work, -49.8), 12.1);
  // behind the corner the edge rises at 30 degrees
  EXPECT_NEAR(at(work, -40) - at(work, -41), std::tan(std::numbers::pi / 6), 1e-9);
}

TEST(Removal, AnEndFaceLeavesNothingBeforeIt) {
  auto work = bar();
  take_off(work, {Shape::face, 0.8}, {22, -2}, {-0.8, -2});
  EXPECT_TRUE(work.rings.back().empty());
  EXPECT_EQ(at(work, -1), 0);
  EXPECT_EQ(at(work, -2.01), 20);
  EXPECT_NEAR(taken(work), 20 * 2, 0.25);
}

TEST(Removal, ABladeCutsItsWidth) {
  auto work = bar();
  take_off(work, {Shape::blade, 3}, {21, -30}, {14, -30});
  EXPECT_EQ(at(work, -29), 14);
  EXPECT_EQ(at(work, -26.99), 20);
  EXPECT_EQ(at(work, -30.01), 20);
  EXPECT_NEAR(taken(work), 6 * 3, 0.07);
}

TEST(Removal, ADrillLeavesItsHoleWithItsPoint) {
  auto work = bar();
  const double half = std::numbers::pi / 4;  // 90 degrees: the point is as long as wide
  take_off(work, {Shape::drill, 5, half}, {0, 2}, {0, -45});
  EXPECT_EQ(at(work, -10, true), 5);
  EXPECT_NEAR(at(work, -43, true), 2, 1e-9);
  EXPECT_EQ(at(work, -45.5, true), 0);
  EXPECT_NEAR(taken(work), 5 * 40 + 5 * 5 / 2.0, 0.06);
}

TEST(Removal, BoresGrowOutwards) {
  auto work = bar(5);
  take_off(work, {Shape::bore, 0.4}, {8, 2}, {8, -30});
  EXPECT_NEAR(at(work, -20, true), 8, 1e-9);
  EXPECT_EQ(at(work, -30.01, true), 5);
  EXPECT_EQ(at(work, -20), 20);
  take_off(work, {Shape::bore_blade, 2}, {7, -20}, {10, -20});
  EXPECT_EQ(at(work, -19, true), 10);
  EXPECT_NEAR(at(work, -17.9, true), 8, 1e-9);
}

TEST(Removal, NothingGrowsBack) {
  auto work = bar();
  take_off(work, {Shape::corner, 0.4}, {12, 2}, {12, -30});
  take_off(work, {Shape::corner, 0.4}, {16, 2}, {16, -30});
  EXPECT_NEAR(at(work, -10), 12, 1e-9);
}

// A quarter of a circle of radius 10 about (10, -10), from the face outwards: every point
// lies on the tip's circle; its chords stay within their sagitta of it.
TEST(Removal, AnArcIsPassedOnChords) {
  const toolpath::Move arc{toolpath::Move::Kind::arc, 20, -10, {10, -10}, false};
  const auto points = way({10, 0}, arc);
  ASSERT_GT(points.size(), 8u);
  for (const auto& p : points)
    EXPECT_NEAR(std::hypot(p.h_mm - 10, p.z_mm + 10), 10, 1e-9);
  EXPECT_EQ(points.back().h_mm, 20);
  auto work = bar();
  take_off(work, {Shape::corner, 0}, {10, 0}, arc);
  for (const double z : {-2.0, -5.0, -8.0})
    EXPECT_NEAR(at(work, z), 10 + std::sqrt(100 - (z + 10) * (z + 10)), 0.02) << z;
}

TEST(Removal, AThreadsToolTakesNothingOff) {
  auto work = bar();
  take_off(work, {}, {10, 2}, {10, -30});
  EXPECT_EQ(taken(work), 0);
}

}  // namespace
}  // namespace turnwright::report::removal_test
