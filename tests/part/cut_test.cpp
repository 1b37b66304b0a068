#include "turnwright/part/cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace turnwright::part {
namespace {

TEST(Holes, AreAsDeepInTheWallAsTheirToolsCut) {
  const auto r = reamed(10, 9.8, 1.5);
  EXPECT_EQ(r.blank.left_mm, 10);
  EXPECT_NEAR(r.cut.depth_mm, 0.1, 1e-12);
  EXPECT_EQ(r.cut.drilled_mm, 9.8);
}

TEST(Groove, IsAsDeepAsItsFloorIsAway) {
  EXPECT_EQ(groove(30, 26, 26).cut.depth_mm, 2);
  EXPECT_EQ(groove(30, 36, 36).cut.depth_mm, 3);  // in a bore
  EXPECT_EQ(groove(30, 26, 26).blank.left_mm, 30);
  EXPECT_EQ(groove(30, 26, 26).cut.core.right_mm, 26);
}

// The circle through both ends by its own equation, at many places.
struct Measured {
  double most = -INFINITY, least = INFINITY, path = 0, below_blank = 0;
};
Measured measured(double l, const Ends& ends, double R, bool convex, const Ends& blank) {
  const double r0 = ends.left_mm / 2, r1 = ends.right_mm / 2;
  // Centre by intersecting the circles of radius R about both ends.
  const double c2 = l * l + (r1 - r0) * (r1 - r0), k = std::sqrt(R * R / c2 - 0.25);
  const double side = convex ? 1 : -1;
  const double zc = l / 2 + side * k * (r1 - r0), rc = (r0 + r1) / 2 - side * k * l;
  Measured m;
  double z_before = 0, r_before = r0;
  constexpr int kSteps = 200000;
  for (int i = 0; i <= kSteps; ++i) {
    const double z = l * i / kSteps;
    const double r = rc + side * std::sqrt(std::max(0.0, R * R - (z - zc) * (z - zc)));
    m.most = std::max(m.most, r);
    m.least = std::min(m.least, r);
    m.path += std::hypot(z - z_before, r - r_before);
    const double of_blank =
        (blank.left_mm + (blank.right_mm - blank.left_mm) * z / l) / 2;
    m.below_blank = std::max(m.below_blank, of_blank - r);
    z_before = z;
    r_before = r;
  }
  return m;
}

struct Case {
  double l;
  Ends ends;
  double R;
  bool convex;
};

TEST(Arc, IsWhatItsCircleMeasures) {
  for (const auto& c : {Case{20, {30, 40}, 40, true}, Case{20, {40, 30}, 40, false},
                        Case{30, {40, 40}, 25, true}, Case{30, {40, 40}, 25, false},
                        Case{8, {20, 30}, 8.5, false}, Case{50, {30, 31}, 200, true}}) {
    const auto s = arc(c.l, c.ends, c.R, c.convex);
    const auto m = measured(c.l, c.ends, c.R, c.convex, s.blank);
    EXPECT_NEAR(s.cut.path_mm, m.path, 1e-6 * m.path);
    EXPECT_NEAR(s.cut.depth_mm, m.below_blank, 1e-6);
    if (c.convex) {
      EXPECT_NEAR(s.blank.left_mm, 2 * m.most, 1e-6);
      EXPECT_EQ(s.blank.left_mm, s.blank.right_mm);
      EXPECT_EQ(s.cut.core.left_mm, c.ends.left_mm);
    } else {
      EXPECT_EQ(s.blank.left_mm, c.ends.left_mm);
      EXPECT_NEAR(s.cut.core.left_mm, 2 * m.least, 1e-6);
      EXPECT_EQ(s.cut.core.left_mm, s.cut.core.right_mm);
    }
  }
}

TEST(Arc, FallsAsItsSlopesAre) {
  for (const auto& c : {Case{8, {40, 40}, 20, true}, Case{8, {40, 40}, 20, false},
                        Case{20, {30, 40}, 40, true}, Case{7, {38, 42}, 9, false},
                        Case{7, {42, 38}, 9, true}}) {
    const auto cut = arc(c.l, c.ends, c.R, c.convex).cut;
    const double chord = (c.ends.right_mm - c.ends.left_mm) / 2;
    const double a = std::atan2(chord, c.l);
    // The tangents at the ends lie as far from the chord as half of the arc's angle.
    const double half = std::asin(std::hypot(chord, c.l) / 2 / c.R);
    const double at_left = a + (c.convex ? half : -half);
    const double at_right = a - (c.convex ? half : -half);
    EXPECT_NEAR(cut.falls_to_left_rad, std::max({at_left, at_right, 0.0}), 1e-12);
    EXPECT_NEAR(cut.falls_to_right_rad, std::max({-at_left, -at_right, 0.0}), 1e-12);
  }
}

// The material that is pressed out of the grooves is that of the teeth: the blank's height
// over the root is the mean height of V-shaped teeth, of pyramids, or of what pyramids leave.
TEST(Knurl, IsAsHighOnTheMeanAsItsBlank) {
  constexpr int kSteps = 400;
  const auto tooth = [](int i) { return 1 - std::abs(2 * (i + 0.5) / kSteps - 1); };
  double straight = 0, raised = 0, indented = 0;
  for (int i = 0; i < kSteps; ++i) {
    straight += tooth(i) / kSteps;
    for (int j = 0; j < kSteps; ++j) {
      raised += std::min(tooth(i), tooth(j)) / kSteps / kSteps;
      indented += std::max(tooth(i), tooth(j)) / kSteps / kSteps;
    }
  }
  const double d1 = 20, t = 0.8;
  for (const auto& [type, mean] :
       {std::pair{KnurlType::RAA, straight}, std::pair{KnurlType::RBL, straight},
        std::pair{KnurlType::RBR, straight}, std::pair{KnurlType::RGE, raised},
        std::pair{KnurlType::RGV, indented}, std::pair{KnurlType::RKE, raised},
        std::pair{KnurlType::RKV, indented}}) {
    const auto s = knurled(d1, {type, t});
    EXPECT_NEAR(s.blank.left_mm, d1 - t + mean * t, 1e-4) << designation({type, t});
    EXPECT_NEAR(s.blank.left_mm - 2 * s.cut.depth_mm, d1 - t, 1e-12);
    EXPECT_EQ(s.cut.drawn.left_mm, d1);
    EXPECT_NEAR(s.cut.core.right_mm, d1 - t, 1e-12);
  }
  // DIN 82, 2.4: d1 - 0.33 t of RKV, to the digits that it has.
  EXPECT_NEAR(knurled(d1, {KnurlType::RKV, 1}).blank.left_mm, d1 - 0.33, 0.005);
}

TEST(Knurl, IsNamedByTypeAndPitch) {
  const auto named = [](const char* text) {
    const auto k = knurl(text);
    return k ? designation(*k) : std::string("none");
  };
  EXPECT_EQ(named("RAA0.8"), "RAA0.8");
  EXPECT_EQ(named("DIN 82-RGE 1,2"), "RGE1.2");
  EXPECT_EQ(named("DIN 82 RKV 1"), "RKV1");
  for (const char* no : {"RAA0.7", "RAA", "RAB0.8", "0.8", "", "RAA0.8x2", "raa0.8"})
    EXPECT_EQ(named(no), "none") << no;
}

// A corner rounded by a quarter circle: nothing but the square that is left of it.
TEST(Arc, QuarterCircleIsTakenWhole) {
  const auto s = arc(5, {20, 30}, 5, true);
  EXPECT_NEAR(s.cut.path_mm, std::numbers::pi / 2 * 5, 1e-9);
  EXPECT_NEAR(s.cut.depth_mm, 5, 1e-9);
  EXPECT_NEAR(s.blank.left_mm, 30, 1e-9);
  EXPECT_NO_THROW(arc(5, {20, 30}, 5, false));
}

TEST(Arc, ThatCannotBeIsRefused) {
  EXPECT_THROW(arc(20, {30, 30}, 9.9, true), std::domain_error);
  EXPECT_THROW(arc(5, {20, 40}, 5.8, true), std::domain_error);  // turns back
  EXPECT_THROW(arc(5, {20, 40}, 5.8, false), std::domain_error);
  EXPECT_THROW(arc(20, {4, 4}, 11, false), std::domain_error);  // through the axis
  EXPECT_THROW(arc(20, {4, 4}, NAN, false), std::domain_error);
}

}  // namespace
}  // namespace turnwright::part
