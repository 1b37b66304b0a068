#include "turnwright/catalogue/tool_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace turnwright::catalogue {
namespace {

constexpr double kRounding = 1e-12;

Tool tool(const std::string& insert, double kapr_deg, double re_mm) {
  Tool t;
  t.insert = insert;
  t.kapr_deg = kapr_deg;
  t.re_mm = re_mm;
  return t;
}

double distance(const OutlinePoint& a, const OutlinePoint& b) {
  return std::hypot(a.h_mm - b.h_mm, a.z_mm - b.z_mm);
}

// Of a point from the line through two others, positive to its right.
double right_of(const OutlinePoint& a, const OutlinePoint& b, const OutlinePoint& p) {
  const double dh = b.h_mm - a.h_mm, dz = b.z_mm - a.z_mm;
  return ((p.z_mm - a.z_mm) * dh - (p.h_mm - a.h_mm) * dz) / std::hypot(dh, dz);
}

double lowest(const ConvexOutline& all, double OutlinePoint::*axis) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& p : all) least = std::min(least, p.*axis);
  return least;
}

// Inscribed circles of ISO 1832's sizes, and sides l = d/sin(eps) of rhombi, as its table
// prints them.
struct KnownOutline {
  const char* designation;
  double kapr_deg, re_mm, circle_mm, side_mm;
  std::size_t corners;
};
const KnownOutline kOutlines[] = {
    {"CNMG 120408", 95, 0.8, 12.7, 12.9, 4},  {"DNMG 150604", 93, 0.4, 12.7, 15.5, 4},
    {"VBMT 160404", 93, 0.4, 9.525, 16.6, 4}, {"CCMT 09T304", 95, 0.4, 9.525, 9.7, 4},
    {"TNMG 160408", 91, 0.8, 9.525, 16.5, 3}, {"SNMG 120408", 75, 0.8, 12.7, 12.7, 4},
    {"WNMG 080408", 95, 0.8, 12.7, 8.7, 6},   {"PNMG 110408", 60, 0.8, 15.875, 11.5, 5},
    {"HNMG 070408", 45, 0.8, 12.7, 7.3, 6},   {"ONMG 050408", 43, 0.8, 12.7, 5.26, 8}};

TEST(ToolOutline, SidesOfAnInsertTouchTheCircleOfItsSize) {
  for (const auto& k : kOutlines) {
    SCOPED_TRACE(k.designation);
    const auto p = outline(tool(k.designation, k.kapr_deg, k.re_mm)).insert;
    ASSERT_EQ(p.size(), k.corners);
    OutlinePoint centre;
    for (const auto& v : p) {
      centre.h_mm += v.h_mm / static_cast<double>(p.size());
      centre.z_mm += v.z_mm / static_cast<double>(p.size());
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto& next = p[(i + 1) % p.size()];
      EXPECT_NEAR(distance(p[i], next), k.side_mm, 0.05);
      EXPECT_NEAR(right_of(p[i], next, centre), k.circle_mm / 2, 1e-9);
    }
  }
}

TEST(ToolOutline, EdgesLieAtTheirAnglesAndTouchTheCorner) {
  for (const auto& k : kOutlines) {
    SCOPED_TRACE(k.designation);
    const auto p = outline(tool(k.designation, k.kapr_deg, k.re_mm)).insert;
    const auto deg = [](double dh, double dz) {
      return std::atan2(dh, dz) * 180 / std::numbers::pi;
    };
    EXPECT_NEAR(deg(p[1].h_mm - p[0].h_mm, p[0].z_mm - p[1].z_mm), k.kapr_deg, 1e-9);
    EXPECT_NEAR(deg(p.back().h_mm - p[0].h_mm, p.back().z_mm - p[0].z_mm),
                *minor_angle_deg(k.kapr_deg, decode_iso1832(k.designation)), 1e-9);
    const OutlinePoint centre{k.re_mm, k.re_mm};
    EXPECT_NEAR(right_of(p[0], p[1], centre), k.re_mm, kRounding);
    EXPECT_NEAR(right_of(p.back(), p[0], centre), k.re_mm, kRounding);
  }
}

// The distance m from the corner to the inscribed circle's far tangent less d, of a rhombus:
// m = (d/2 - r) (1/sin(eps/2) - 1).  Makers print 3.088 mm for CNMG 1204 with the 0.794 mm
// that the code 08 rounds.
TEST(ToolOutline, TheRoundedCornerHasItsMeasureM) {
  auto t = tool("CNMG 120408", 95, 0.79375);
  const auto o = outline(t);
  const auto rounded = rounded_insert(o, 1e-6);
  OutlinePoint middle;
  for (const auto& v : o.insert) {
    middle.h_mm += v.h_mm / 4;
    middle.z_mm += v.z_mm / 4;
  }
  double furthest = 0;
  for (const auto& v : rounded)
    if (distance(v, o.insert[0]) < 3) furthest = std::max(furthest, distance(v, middle));
  EXPECT_NEAR(furthest - 12.7 / 2, 3.088, 5e-4);
}

// With edges beyond the axes, as of most finishing tools, the tip is where both tangents
// meet.
TEST(ToolOutline, TheTipIsWhereTheCornersTangentsMeet) {
  for (const auto& [insert, kapr] : {std::pair{"CNMG 120408", 95.0},
                                     {"DNMG 150608", 93.0},
                                     {"VNMG 160408", 93.0},
                                     {"RCMT 1204M0", 90.0}}) {
    auto t = tool(insert, kapr, insert[0] == 'R' ? 6 : 0.8);
    const auto all = rounded_insert(outline(t), 1e-7);
    EXPECT_NEAR(lowest(all, &OutlinePoint::h_mm), 0, 1e-7) << insert;
    EXPECT_NEAR(lowest(all, &OutlinePoint::z_mm), 0, 1e-7) << insert;
  }
}

TEST(ToolOutline, ChordsOfTheCornersAreAsCloseAsAsked) {
  const double r = 0.8, chord = 1e-4;
  const auto o = outline(tool("DNMG 150608", 93, r));
  const auto p = rounded_insert(o, chord);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto& next = p[(i + 1) % p.size()];
    if (distance(p[i], {r, r}) > r + 1e-9 || distance(next, {r, r}) > r + 1e-9) continue;
    const OutlinePoint middle{(p[i].h_mm + next.h_mm) / 2, (p[i].z_mm + next.z_mm) / 2};
    EXPECT_GE(distance(middle, {r, r}), r - chord * (1 + 1e-6));
  }
}

Tool external() {
  auto t = tool("DNMG 150604", 93, 0.4);
  t.holder = Holder{"PDJNL 2525M 15", 25, 25, 150, 40, 32};
  return t;
}

TEST(ToolOutline, AHeadLiesBehindBothEdgesAndAHolderWithinItsDimensions) {
  const auto o = outline(external());
  ASSERT_EQ(o.holder.size(), 2u);
  for (const auto& p : o.holder[1]) {
    EXPECT_GE(right_of(o.insert[0], o.insert[1], p), kSeatBehind_mm - 1e-9);
    EXPECT_GE(right_of(o.insert.back(), o.insert[0], p), kSeatBehind_mm - 1e-9);
  }
  double far = 0, high = 0;
  for (const auto& piece : o.holder)
    for (const auto& p : piece) {
      far = std::max(far, p.z_mm);
      high = std::max(high, p.h_mm);
    }
  EXPECT_EQ(far, 32);    // WF
  EXPECT_EQ(high, 150);  // LF
  EXPECT_EQ(lowest(o.holder[0], &OutlinePoint::z_mm), 32 - 25);
  EXPECT_EQ(lowest(o.holder[0], &OutlinePoint::h_mm), 40);  // LH
  // Of the head: where the lines of both edges meet behind the sharp corner S, on the
  // bisector at the distance seat/sin(27.5 deg), its height S.h + seat/sin(27.5) sin(59.5).
  EXPECT_NEAR(lowest(o.holder[1], &OutlinePoint::h_mm),
              o.insert[0].h_mm + kSeatBehind_mm / std::sin(27.5 * M_PI / 180) *
                                     std::sin(59.5 * M_PI / 180),
              1e-9);
}

TEST(ToolOutline, WithoutAHolderItIsTheInsertAlone) {
  auto t = external();
  t.holder.reset();
  EXPECT_TRUE(outline(t).holder.empty());
  EXPECT_FALSE(outline(t).insert.empty());
}

TEST(ToolOutline, ABoringBarIsItsSegmentsAboutItsAxis) {
  auto t = tool("CCMT 09T304", 95, 0.4);
  t.bar = BoringBar{};
  t.bar->segments = {{44, 16, 4}, {12, 14, 4}};
  t.bar->tip_offset_mm = 11;
  const auto o = outline(t);
  ASSERT_EQ(o.holder.size(), 2u);
  double low = 1e9, high = 0, end = 0;
  for (const auto& p : o.holder[0]) {  // next to the tip
    low = std::min(low, p.h_mm);
    high = std::max(high, p.h_mm);
    end = std::max(end, p.z_mm);
    EXPECT_GE(right_of(o.insert[0], o.insert[1], p), kSeatBehind_mm - 1e-9);
  }
  EXPECT_DOUBLE_EQ(low, 4);
  EXPECT_DOUBLE_EQ(high, 18);
  EXPECT_DOUBLE_EQ(end, 12);
  for (const auto& p : o.holder[1]) end = std::max(end, p.z_mm);
  EXPECT_DOUBLE_EQ(end, 56);
}

}  // namespace
}  // namespace turnwright::catalogue
