#include "turnwright/part/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace turnwright::part {
namespace {

Drawing three_steps() {
  Drawing d;
  d.stock = {.outer_mm = 50, .length_mm = 166, .left_allowance_mm = 2.5};
  d.outer = {{.id = "d1", .length_mm = 40},
             {.id = "c1", .length_mm = 20},
             {.id = "d2", .length_mm = 102}};
  return d;
}

TEST(Drawing, ElementsStandOneAfterTheOther) {
  const Drawing d = three_steps();
  EXPECT_EQ(length_mm(d), 162);
  EXPECT_EQ(left_z_mm(d, 0), 0);
  for (std::size_t i = 0; i + 1 < d.outer.size(); ++i)
    EXPECT_EQ(left_z_mm(d, i) + d.outer[i].length_mm, left_z_mm(d, i + 1));
  EXPECT_EQ(left_z_mm(d, 2) + d.outer[2].length_mm, length_mm(d));
  EXPECT_THROW(left_z_mm(d, 3), std::domain_error);
}

TEST(Drawing, BoresGoInwardsFromTheirEnd) {
  Drawing d = three_steps();  // 162 long
  d.inner = {{.id = "r1", .from = End::right, .length_mm = 30},
             {.id = "l1", .from = End::left, .length_mm = 12},
             {.id = "r2", .from = End::right, .length_mm = 50},
             {.id = "l2", .from = End::left, .length_mm = 8}};
  EXPECT_EQ(inner_left_z_mm(d, 0), 132);
  EXPECT_EQ(inner_left_z_mm(d, 1), 0);
  EXPECT_EQ(inner_left_z_mm(d, 2), 82);
  EXPECT_EQ(inner_left_z_mm(d, 3), 12);
  EXPECT_THROW(inner_left_z_mm(d, 4), std::domain_error);
}

// 162 long: 20 mm wide from 112, 30 mm wide from 132 on.
TEST(Drawing, TheLeastHoleIsZeroWhereThePartIsSolid) {
  Drawing d = three_steps();
  d.inner = {
      {.id = "r1", .from = End::right, .length_mm = 30, .left_mm = 30, .right_mm = 30},
      {.id = "r2", .from = End::right, .length_mm = 20, .left_mm = 20, .right_mm = 20}};
  EXPECT_EQ(least_hole_mm(d, 135, 140), 30);
  EXPECT_EQ(least_hole_mm(d, 130, 140), 20);
  EXPECT_EQ(least_hole_mm(d, 112, 120), 20);
  EXPECT_EQ(least_hole_mm(d, 111, 120), 0);
  EXPECT_EQ(least_hole_mm(d, 10, 20), 0);
  d.stock.inner_mm = 8;  // of a tube
  EXPECT_EQ(least_hole_mm(d, 111, 120), 8);
  EXPECT_EQ(least_hole_mm(d, 10, 20), 8);
  EXPECT_EQ(least_hole_mm(d, 135, 140), 30);
}

TEST(Drawing, AllowancesAndPartFillTheStock) {
  const Drawing d = three_steps();
  EXPECT_EQ(right_allowance_mm(d), 1.5);  // 166 - 2.5 - 162
  EXPECT_EQ(d.stock.left_allowance_mm + length_mm(d) + right_allowance_mm(d),
            d.stock.length_mm);
}

// At 30 deg from where it meets the face a point of a rounded edge lies R (1 - sin 30) below
// the surface.
TEST(Drawing, ARoundedEdgeIsACircle) {
  const Chamfer edge{.axial_mm = 2, .radial_mm = 2, .round = true};
  EXPECT_EQ(into_radius_mm(edge, 0), 2);
  EXPECT_NEAR(into_radius_mm(edge, 2 * (1 - std::cos(std::numbers::pi / 6))), 1, 1e-12);
  EXPECT_EQ(into_radius_mm(edge, 2), 0);
  EXPECT_FALSE(fits_countersink(edge, 90));

  // The chamfer that roughing leaves touches the circle half way.
  const auto straight = roughed(edge);
  const double touches = 2 * (1 - std::sqrt(0.5));
  EXPECT_FALSE(straight.round);
  EXPECT_NEAR(into_radius_mm(straight, touches), into_radius_mm(edge, touches), 1e-12);
  for (double x = 0; x < 2; x += 0.01)
    EXPECT_LE(into_radius_mm(straight, x), into_radius_mm(edge, x) + 1e-12) << x;
}

TEST(Drawing, ChamfersAndUndercutsGoIntoTheRadius) {
  OuterElement e{.id = "d1", .length_mm = 20, .left_mm = 30, .right_mm = 30};
  e.left_chamfer = Chamfer{2, 1};
  e.right_chamfer = Chamfer{1, 3};
  EXPECT_EQ(chamfered_mm(e, 0), 1);
  EXPECT_EQ(chamfered_mm(e, 1), 0.5);
  EXPECT_EQ(chamfered_mm(e, 2), 0);
  EXPECT_EQ(chamfered_mm(e, 19), 0);
  EXPECT_EQ(chamfered_mm(e, 20), 3);
  e.left_undercut = undercut('E', 0.8, 0.3);
  ASSERT_TRUE(e.left_undercut);
  EXPECT_EQ(undercut_mm(e, 0), 0.3);
  EXPECT_NEAR(undercut_mm(e, 2), 0.5 * std::tan(std::acos(-1) / 12), 1e-12);
  EXPECT_EQ(undercut_mm(e, 2.5), 0);
  EXPECT_FALSE(undercut('E', 0.8, 0.4));
}

// g of DIN 509's table, to the 0.1 mm that it is printed in.
TEST(Drawing, FormFComesBackToTheShoulderWhereTheStandardSays) {
  const double table[][3]{{0.2, 0.1, 0.9}, {0.4, 0.2, 1.1}, {0.6, 0.2, 1.4},
                          {0.6, 0.3, 2.1}, {0.8, 0.3, 2.3}, {1, 0.2, 1.8},
                          {1, 0.4, 3.2},   {1.2, 0.2, 2},   {1.2, 0.4, 3.4},
                          {1.6, 0.3, 3.1}, {2.5, 0.4, 4.8}, {4, 0.5, 6.4}};
  for (const auto& [r, t, g] : table) {
    const auto f = undercut('F', r, t), e = undercut('E', r, t);
    ASSERT_TRUE(f && e) << r << " x " << t;
    EXPECT_NEAR(height_mm(*f), g, 0.05) << r << " x " << t;
    EXPECT_EQ(height_mm(*e), r);
    EXPECT_EQ(centre_mm(*e), r);
    EXPECT_EQ(f->width_mm, e->width_mm);
  }
  EXPECT_EQ(designation(*undercut('F', 0.8, 0.3)), "F0.8x0.3");
  EXPECT_EQ(designation(*undercut('E', 1, 0.4)), "E1x0.4");
}

// Half of what a right angle is more than the insert's: 55 deg of a rhombus, 60 deg of a
// triangle.  With that angle on both sides of a tangent radius f and g are those of the
// table, to the 0.1 mm that it is printed in; f is at most 0.2 mm more.
TEST(Drawing, FormsGAndHHaveTheShapeOfInserts) {
  struct Row {
    char form;
    double r, t1, t2, f, g, insert_deg;
  };
  for (const auto& row :
       {Row{'G', 0.4, 0.2, 0.2, 0.9, 1.1, 55}, Row{'H', 0.8, 0.3, 0.05, 2, 1.1, 60},
        Row{'H', 1.2, 0.3, 0.05, 2.4, 1.5, 60}}) {
    const auto u = undercut(row.form, row.r, row.t1);
    ASSERT_TRUE(u) << row.form;
    EXPECT_EQ(u->recess_mm, row.t2);
    const double a = (90 - row.insert_deg) / 2 * std::acos(-1) / 180;
    EXPECT_NEAR(falls_rad(*u), a, 1e-12);
    EXPECT_NEAR(leans_rad(*u), a, 1e-12);
    const auto beyond = [&](double deep) {  // from the deepest place to the other surface
      return row.r * (1 + std::sin(a)) + (deep - row.r * (1 - std::cos(a))) / std::tan(a);
    };
    EXPECT_NEAR(beyond(row.t2), row.g, 0.05) << row.form;
    EXPECT_NEAR(height_mm(*u), beyond(row.t2), 1e-12);
    const double tangent = beyond(row.t1) - row.t2;
    EXPECT_NEAR(tangent, row.f, 0.05) << row.form;
    EXPECT_GE(u->width_mm, std::max(row.f, tangent)) << row.form;
    EXPECT_LE(u->width_mm, row.f + 0.05) << row.form;
    EXPECT_GT(u->width_mm - fall_mm(*u), centre_mm(*u)) << "a floor before the radius";
  }
  EXPECT_EQ(designation(*undercut('G', 0.4, 0.2)), "G0.4x0.2");
  EXPECT_EQ(designation(*undercut('H', 1.2, 0.3)), "H1.2x0.3");
  EXPECT_FALSE(undercut('H', 0.4, 0.2));
  EXPECT_FALSE(undercut('G', 0.8, 0.3));
  EXPECT_FALSE(undercut('I', 0.8, 0.3));
}

// DIN 76's other columns: pitch, d - dg, g1 of the forms A and B.  The flank of 30 deg takes
// what g2 is more than g1, to the 0.1 mm and more that the table rounds to.
TEST(Drawing, ThreadUndercutsAreThoseOfTheStandard) {
  const double table[][4]{
      {0.5, 0.8, 1.1, 0.5}, {0.8, 1.3, 1.7, 0.9}, {1, 1.6, 2.1, 1.1},
      {1.25, 2, 2.7, 1.5},  {1.5, 2.3, 3.2, 1.8}, {1.75, 2.6, 3.9, 2.1},
      {2, 3, 4.5, 2.5},     {2.5, 3.6, 5.6, 3.2}, {3, 4.4, 6.7, 3.7},
      {3.5, 5, 7.7, 4.7},   {4, 5.7, 9, 5},       {5, 7, 11.5, 6.5},
      {6, 8.3, 14, 8}};
  const double rises = std::tan(std::acos(-1) / 6);
  for (const auto& [pitch, reduced, g1_a, g1_b] : table) {
    const auto a = thread_undercut('A', pitch), b = thread_undercut('B', pitch);
    ASSERT_TRUE(a && b) << pitch;
    EXPECT_NEAR(a->depth_mm, reduced / 2, 1e-12) << pitch;
    EXPECT_NEAR(a->width_mm - g1_a, reduced / 2 / rises, 0.25) << pitch;
    EXPECT_NEAR(b->width_mm - g1_b, reduced / 2 / rises, 0.25) << pitch;
    EXPECT_GT(2 * a->depth_mm, 1.22687 * pitch) << pitch;  // below the thread's root
    EXPECT_EQ(designation(*a), "DIN 76-A");
    EXPECT_EQ(designation(*b), "DIN 76-B");
  }
  EXPECT_FALSE(thread_undercut('A', 1.6));
  EXPECT_FALSE(thread_undercut('C', 1.5));

  OuterElement e{.id = "t", .length_mm = 20, .left_mm = 24, .right_mm = 24};
  e.right_undercut = thread_undercut('A', 1.5);
  EXPECT_NEAR(undercut_mm(e, 20 - 5.2), 0, 1e-12);
  EXPECT_NEAR(undercut_mm(e, 20 - 4.2), rises, 1e-12);
  EXPECT_EQ(undercut_mm(e, 20), 1.15);
}

TEST(CentreHole, HasTheDiametersOfTheTable) {
  EXPECT_EQ(designation(*centre_hole('A', 4, 8.5)), "ISO 6411-A4/8.5");
  EXPECT_EQ(designation(*centre_hole('B', 2.5, 8)), "ISO 6411-B2.5/8");
  EXPECT_TRUE(centre_hole('R', 3.15, 6.7));
  EXPECT_FALSE(centre_hole('B', 4, 8.5)) << "that is form A's";
  EXPECT_FALSE(centre_hole('C', 4, 8.5));
  EXPECT_FALSE(centre_hole('A', 4, 8));
}

// Half the cone's angle from the axis: radius by length.
TEST(Countersinks, CutTheChamferOfHalfTheirAngle) {
  EXPECT_TRUE(fits_countersink({1, 1}, 90));
  EXPECT_TRUE(fits_countersink({1, std::sqrt(3)}, 120));
  EXPECT_FALSE(fits_countersink({std::sqrt(3), 1}, 120));
}

}  // namespace
}  // namespace turnwright::part
