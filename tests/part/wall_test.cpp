#include "turnwright/part/wall.hpp"

#include <gtest/gtest.h>

namespace turnwright::part {
namespace {

Drawing sleeve() {
  Drawing d;
  d.outer = {{.id = "d1", .length_mm = 40, .left_mm = 60, .right_mm = 60},
             {.id = "d2", .length_mm = 30, .left_mm = 40, .right_mm = 40}};
  d.inner = {
      {.id = "b1", .from = End::right, .length_mm = 50, .left_mm = 24, .right_mm = 24}};
  return d;
}

TEST(Wall, OfABarIsTheRadius) {
  Drawing d = sleeve();
  d.inner.clear();
  EXPECT_EQ(thinnest_wall(d).share, 1);
}

TEST(Wall, IsThinnestUnderTheSmallerOfTwoSteps) {
  const Wall wall = thinnest_wall(sleeve());
  EXPECT_NEAR(wall.share, 1 - 24.0 / 40, 1e-12);
  EXPECT_GE(wall.z_mm, 40);  // there the smaller step begins
}

TEST(Wall, OfATubeCountsItsHoleWhereNothingIsBored) {
  Drawing d = sleeve();
  d.stock.inner_mm = 10;
  d.inner[0].length_mm = 20;  // ends inside d2, bored wider
  d.inner[0].left_mm = d.inner[0].right_mm = 12;
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 12.0 / 40, 1e-12);
  d.inner.clear();
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 10.0 / 40, 1e-12);
}

TEST(Wall, OfABoredConeIsThinnestAtAnEndOfIt) {
  Drawing d = sleeve();
  d.inner[0].length_mm = 25;  // 45 to 70, opening to the right
  d.inner[0].right_mm = 36;
  const Wall wall = thinnest_wall(d);
  EXPECT_NEAR(wall.share, 1 - 36.0 / 40, 1e-12);
  EXPECT_EQ(wall.z_mm, 70);
}

TEST(Wall, OfACutCountsItsCore) {
  Drawing d = sleeve();
  d.outer[1].cut = Cut{.kind = CutKind::groove, .core = {30, 30}};
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 24.0 / 30, 1e-12);
}

// The widest radius is 30 mm: up to 6 mm long it is borne.
TEST(Wall, AShortGrooveIsBorneByTheWallBesideItUnlessItCutsTooDeep) {
  Drawing d = sleeve();
  d.inner.push_back(d.inner[0]);
  d.inner[0].length_mm = 20;
  auto& groove = d.inner[1];
  groove.length_mm = 6;
  groove.cut = Cut{.kind = CutKind::groove, .core = {34, 34}};
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 24.0 / 40, 1e-12);
  groove.length_mm = 6.1;
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 34.0 / 40, 1e-12);
  groove.length_mm = 6;
  groove.cut->core = {36.1, 36.1};
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 36.1 / 40, 1e-12);
  groove.cut->kind = CutKind::thread;
  groove.cut->core = {34, 34};
  EXPECT_NEAR(thinnest_wall(d).share, 1 - 34.0 / 40, 1e-12);
}

TEST(Wall, WhereTheBoreIsWiderThanThePartThereIsNone) {
  Drawing d = sleeve();
  d.inner[0].left_mm = d.inner[0].right_mm = 45;
  EXPECT_LT(thinnest_wall(d).share, 0);
}

}  // namespace
}  // namespace turnwright::part
