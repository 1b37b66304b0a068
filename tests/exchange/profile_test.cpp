#include "turnwright/exchange/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drawn_profile.hpp"
#include "exchange/contour/thread_undercut.hpp"
#include "same_outline.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

using compared::expect_same;

Element cylinder(const char* id, double d_mm, double length_mm,
                 part::End from = part::End::right) {
  return {
      .id = id, .length_mm = length_mm, .left_mm = d_mm, .right_mm = d_mm, .from = from};
}

Outline motor_shaft() {
  Outline o;
  o.outer = {cylinder("d1", 32, 60), cylinder("d2", 40, 35), cylinder("d3", 50, 170),
             cylinder("d4", 40, 35), cylinder("d5", 35, 60)};
  o.edges = {{.at = "left", .chamfer_mm = 1.5},
             {.at = "d1|d2", .chamfer_mm = 1},
             {.at = "d1|d2", .fillet_mm = 0.8},
             {.at = "d2|d3", .chamfer_mm = 1},
             {.at = "d2|d3", .undercut = "E0.8x0.3"},
             {.at = "d3|d4", .chamfer_mm = 1, .angle_deg = 30},
             {.at = "d3|d4", .undercut = "E0.8x0.3"},
             {.at = "right", .chamfer_mm = 2, .angle_deg = 15}};
  return o;
}

TEST(Profile, RoundedEdgesAreAttributesToo) {
  Outline drawn;
  drawn.outer = {cylinder("d1", 40, 40), cylinder("d2", 60, 30), cylinder("d3", 45, 50)};
  drawn.inner = {cylinder("b1", 25, 40)};
  drawn.edges = {{.at = "left", .radius_mm = 1},       {.at = "d1|d2", .radius_mm = 2},
                 {.at = "d1|d2", .fillet_mm = 0.8},    {.at = "d2|d3", .radius_mm = 2.5},
                 {.at = "right|b1", .radius_mm = 1.5}, {.at = "right", .radius_mm = 3}};
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

TEST(Profile, EdgesAreAttributesOfTheElementsTheyAreCutFrom) {
  const Outline drawn = motor_shaft();
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

TEST(Profile, ABoreGoesWithTheEndItIsReachedFrom) {
  Outline drawn;
  drawn.outer = {cylinder("d1", 90, 30), cylinder("d2", 70, 60)};
  drawn.inner = {cylinder("b1", 50, 20), cylinder("b2", 40, 30),
                 cylinder("b3", 60, 25, part::End::left),
                 cylinder("b4", 45, 15, part::End::left)};
  drawn.edges = {{.at = "right|b1", .chamfer_mm = 1},
                 {.at = "left|b3", .chamfer_mm = 1.5, .angle_deg = 30}};
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);  // through: 20 + 30 + 25 + 15

  drawn.outer[1].length_mm = 80;  // and with 20 mm of material in the middle
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

TEST(Profile, AGrooveIsANarrowBandBetweenLargerOnes) {
  Outline drawn;
  drawn.outer = {cylinder("d1", 40, 30), cylinder("d2", 36, 3), cylinder("d3", 40, 30),
                 cylinder("d4", 30, 25), cylinder("d5", 40, 30)};
  drawn.outer[1].shape = Shape::groove;
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

TEST(Profile, AnArcWithoutAWallIsAnElement) {
  Outline drawn;
  drawn.outer = {cylinder("d1", 40, 30), cylinder("d2", 28, 6), cylinder("d3", 28, 50)};
  drawn.outer[1] = {.id = "d2",
                    .shape = Shape::arc,
                    .length_mm = 6,
                    .left_mm = 40,
                    .right_mm = 28,
                    .radius_mm = 6,
                    .convex = false};
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

TEST(Profile, AConeAtTheEndIsNoChamfer) {
  Outline drawn;
  drawn.outer = {
      cylinder("d1", 100, 18),
      {.id = "d2", .shape = Shape::cone, .length_mm = 24, .left_mm = 76, .right_mm = 70}};
  expect_same(outline_of(drawn::profile_of(drawn)), drawn);
}

// Shafts and bores with edges drawn at random come back as they were drawn.
TEST(Profile, RandomPartsComeBackAsDrawn) {
  std::mt19937 random(7);
  const auto number = [&](double lower, double upper) {
    const double x = std::uniform_real_distribution<>(lower, upper)(random);
    return std::round(x * 100) / 100;
  };
  for (int part = 0; part < 300; ++part) {
    SCOPED_TRACE(part);
    Outline drawn;
    const int steps = 1 + static_cast<int>(random() % 6);
    double length = 0, before = 0;
    for (int i = 0; i < steps; ++i) {
      double d = number(40, 100);
      if (std::abs(d - before) < 8) d = before > 70 ? before - 12 : before + 12;
      drawn.outer.push_back(
          cylinder(("d" + std::to_string(i + 1)).c_str(), d, number(12, 60)));
      length += drawn.outer.back().length_mm;
      before = d;
    }
    double hole = 30, depth = 0;
    for (int i = 0; i < static_cast<int>(random() % 4) && depth < length / 2; ++i) {
      drawn.inner.push_back(cylinder(("b" + std::to_string(i + 1)).c_str(), hole,
                                     std::min(number(4, 20), length / 2)));
      depth += drawn.inner.back().length_mm;
      hole -= 6;
    }
    const auto chamfer = [&](const std::string& at) {
      if (random() % 4 == 0)
        drawn.edges.push_back({.at = at, .radius_mm = number(0.3, 1.5)});
      else if (random() % 2)
        drawn.edges.push_back(
            {.at = at, .chamfer_mm = number(0.3, 1.5), .angle_deg = number(20, 60)});
    };
    chamfer("left");
    for (std::size_t i = 1; i < drawn.outer.size(); ++i) {
      const std::string at = drawn.outer[i - 1].id + "|" + drawn.outer[i].id;
      chamfer(at);
      if (random() % 3 == 0)
        drawn.edges.push_back({.at = at, .fillet_mm = number(0.2, 1.2)});
      else if (random() % 2)
        drawn.edges.push_back({.at = at, .undercut = "E0.8x0.3"});
    }
    chamfer("right");
    if (!drawn.inner.empty()) chamfer("right|b1");
    if (drawn.inner.empty() && random() % 2)
      drawn.centre_holes.push_back({part::End::right, "ISO 6411-B2.5/8"});
    if (random() % 2) drawn.centre_holes.push_back({part::End::left, "ISO 6411-R4/8.5"});
    expect_same(outline_of(drawn::profile_of(drawn)), drawn);
  }
}

TEST(Profile, DividedFacesAreOneElement) {
  Outline drawn;
  drawn.outer = {cylinder("d1", 32, 60), cylinder("d2", 40, 35)};
  Profile whole = drawn::profile_of(drawn), divided;
  for (const Side& s : whole.sides) {
    const Point middle{(s.from.z_mm + s.to.z_mm) / 2, (s.from.r_mm + s.to.r_mm) / 2};
    divided.sides.push_back({.from = s.from, .to = middle});
    divided.sides.push_back({.from = middle, .to = s.to});
  }
  expect_same(outline_of(divided), drawn);
  std::rotate(divided.sides.begin(), divided.sides.begin() + 3, divided.sides.end());
  expect_same(outline_of(divided), drawn);
}

TEST(Profile, ADrillsPointIsLeftToTheDrill) {
  Profile p;
  const auto to = [&](double z, double r) {
    p.sides.push_back(
        {.from = p.sides.empty() ? Point{} : p.sides.back().to, .to = {z, r}});
  };
  for (const auto& [z, r] :
       std::vector<std::array<double, 2>>{{0, 20}, {60, 20}, {60, 5}, {30, 5}, {27, 0}})
    to(z, r);
  const Outline o = outline_of(p);
  ASSERT_EQ(o.inner.size(), 1u);
  expect_same(o.inner[0], cylinder("b1", 10, 30));
  ASSERT_EQ(o.assumed.size(), 1u);
  EXPECT_EQ(o.assumed[0].text,
            "The conical bottom of the bore is left to the drill's point.");
}

Profile solid(const std::vector<Point>& corners) {
  Profile p;
  for (const Point& to : corners)
    p.sides.push_back({.from = p.sides.empty() ? Point{} : p.sides.back().to, .to = to});
  return p;
}

TEST(Profile, CentreHolesAreTheRowOfTheirSizes) {
  for (const auto& [d, a, b] : drawn::kCentreHoles_mm)
    for (const auto& [form, D] :
         {std::pair{'A', a}, std::pair{'R', a}, std::pair{'B', b}})
      for (const auto at : {part::End::left, part::End::right}) {
        Outline drawn;
        drawn.outer = {cylinder("d1", 40, 60), cylinder("d2", 50, 60)};
        drawn.centre_holes.push_back(
            {at, part::designation(part::CentreHole{form, d, D})});
        SCOPED_TRACE(drawn.centre_holes[0].designation);
        const Outline o = outline_of(drawn::profile_of(drawn));
        expect_same(o, drawn);
        EXPECT_TRUE(o.assumed.empty());
        EXPECT_TRUE(o.ignored.empty());
      }
}

// The hole of form A 4/8.5 with one size changed, in the right end of a pin of 40 mm.
struct Hole {
  double pilot_mm = 4, mouth_mm = 8.5, half_deg = 30, bottom_mm = 0, deep_mm = 5;
};
Outline drilled(const Hole& h) {
  const double r = h.pilot_mm / 2, R = h.mouth_mm / 2;
  const double z = 60 - (R - r) / std::tan(h.half_deg * std::acos(-1) / 180);
  return outline_of(solid({{0, 20},
                           {60, 20},
                           {60, R},
                           {z, r},
                           {z - h.deep_mm, r},
                           {z - h.deep_mm - h.bottom_mm, 0}}));
}

TEST(Profile, ACentreHoleMayEndFlatOrInAPoint) {
  for (const double bottom : {0.0, 1.2, 2 / std::tan(59 * std::acos(-1) / 180)}) {
    const Outline o = drilled({.bottom_mm = bottom});
    ASSERT_EQ(o.centre_holes.size(), 1u);
    EXPECT_EQ(o.centre_holes[0].designation, "ISO 6411-A4/8.5");
  }
  EXPECT_TRUE(drilled({.bottom_mm = 2.5}).centre_holes.empty());  // a point of 77 deg
}

// Its sizes are in no row: it is told, and left to the clamping.
TEST(Profile, ACentreHoleOfOtherSizesIsTold) {
  for (const Hole& h : {Hole{.pilot_mm = 3.9}, Hole{.mouth_mm = 8.52},
                        Hole{.pilot_mm = 2, .mouth_mm = 8}}) {
    const Outline o = drilled(h);
    EXPECT_TRUE(o.inner.empty());
    EXPECT_TRUE(o.centre_holes.empty());
    ASSERT_EQ(o.assumed.size(), 1u);
    EXPECT_EQ(o.assumed[0].text,
              "The centre hole at the right end is drilled where a clamping needs it.");
  }
  // Drawings round: ISO 6411 gives two decimals.
  EXPECT_EQ(drilled({.pilot_mm = 4.004, .mouth_mm = 8.496}).centre_holes.size(), 1u);
}

TEST(Profile, WhatIsNoCentreHoleIsABore) {
  EXPECT_EQ(drilled({.half_deg = 31}).inner.size(), 2u);
  EXPECT_EQ(drilled({.half_deg = 45}).inner.size(), 2u);
  EXPECT_EQ(drilled({.deep_mm = 10}).inner.size(), 2u);  // deeper than 1.5 x 8.5 mm
  EXPECT_EQ(drilled({.mouth_mm = 12.5}).centre_holes.size(),
            0u);  // form B without its cone
}

// An arc of 10 mm that a centre of 60 deg would touch beyond its ends, and one that bulges
// into the material, are bores.
TEST(Profile, AnArcThatCarriesNoCentreIsNoFormR) {
  const auto arc = [](Point centre, bool left_turn) {
    Profile p = solid({{0, 20}, {60, 20}, {60, 4.25}, {55, 2}, {50, 2}, {49, 0}});
    const Point a{60, 4.25}, b{55, 2};
    const double half = std::hypot(5, 2.25) / 2, R = centre.r_mm;
    const double off = std::sqrt(R * R - half * half) / (2 * half) * (left_turn ? 1 : -1);
    p.sides[3].centre =
        Point{(a.z_mm + b.z_mm) / 2 + off * 2.25, (a.r_mm + b.r_mm) / 2 - off * 5};
    p.sides[3].counterclockwise = left_turn;
    return outline_of(p);
  };
  EXPECT_EQ(arc({0, 10}, false).centre_holes.size(), 1u);
  EXPECT_TRUE(arc({0, 10}, true).centre_holes.empty());
  EXPECT_TRUE(arc({0, 200}, false).centre_holes.empty());
}

TEST(Profile, ACountersunkBoreIsNoCentreHole) {
  const double cone = 4 / std::tan(std::acos(-1) / 6);  // 60 deg from Ø16 to Ø8
  const auto o =
      outline_of(solid({{0, 30}, {60, 30}, {60, 8}, {60 - cone, 4}, {20, 4}, {17.6, 0}}));
  ASSERT_EQ(o.inner.size(), 2u);
  EXPECT_EQ(o.inner[1].left_mm, 8);
  EXPECT_NEAR(o.inner[1].length_mm, 40 - cone, 1e-9);
}

TEST(Profile, ARadiusThatNoToolsCornerLeavesIsTurned) {
  Profile p = solid({{0, 25}, {30, 25}, {38, 33}, {38, 45}, {60, 45}, {60, 0}});
  p.sides[2].centre = Point{30, 33};
  p.sides[2].counterclockwise = true;
  const auto o = outline_of(p);
  ASSERT_EQ(o.outer.size(), 3u);
  EXPECT_EQ(o.outer[1].shape, Shape::arc);
  EXPECT_EQ(o.outer[1].radius_mm, 8);
  EXPECT_FALSE(o.outer[1].convex);
  EXPECT_TRUE(o.edges.empty());
}

// The pitches of DIN 76's table.
constexpr double kPitches_mm[]{0.5, 0.6, 0.7, 0.75, 0.8, 1,   1.25, 1.5, 1.75,
                               2,   2.5, 3,   3.5,  4,   4.5, 5,    5.5, 6};

// A shaft whose two ends of 60 mm have undercuts of DIN 76 before the band between them.
Outline undercut_shaft(const std::string& form, double pitch_mm) {
  Outline o;
  o.outer = {cylinder("d1", 60, 50), cylinder("d2", 80, 40), cylinder("d3", 60, 50)};
  for (const char* at : {"d1|d2", "d2|d3"})
    o.edges.push_back({.at = at, .undercut = form, .pitch_mm = pitch_mm});
  return o;
}

TEST(Profile, UndercutsBehindThreadsAreTheRowOfTheirSizes) {
  for (const double pitch : kPitches_mm)
    for (const char* form : {"DIN 76-A", "DIN 76-B"}) {
      SCOPED_TRACE(testing::Message() << form << " " << pitch);
      const Outline drawn = undercut_shaft(form, pitch),
                    o = outline_of(drawn::profile_of(drawn));
      expect_same(o, drawn);
      ASSERT_EQ(o.edges.size(), 2u);
      for (const Edge& e : o.edges) EXPECT_EQ(e.pitch_mm, pitch);
    }
}

// DIN 76-A of a pitch of 1.5 mm, drawn by its sizes, before a shoulder of 40 mm.
struct Recess {
  double width_mm = 5.2, depth_mm = 1.15, radius_mm = 0.8, falls_deg = 30;
};
Outline recessed(const Recess& u) {
  const double run = u.depth_mm / std::tan(u.falls_deg * std::acos(-1) / 180);
  const double x = 40 - u.width_mm, low = 12 - u.depth_mm;
  Profile p = solid({{0, 12},
                     {x, 12},
                     {x + run, low},
                     {40 - u.radius_mm, low},
                     {40, low + u.radius_mm},
                     {40, 20},
                     {60, 20},
                     {60, 0}});
  p.sides[4].centre = Point{40 - u.radius_mm, low + u.radius_mm};
  p.sides[4].counterclockwise = true;
  return outline_of(p);
}
std::string undercut_in(const Outline& o) {
  for (const Edge& e : o.edges)
    if (e.undercut) return *e.undercut;
  return "";
}

TEST(Profile, AnUndercutBehindAThreadHasTheSizesOfItsRow) {
  EXPECT_EQ(undercut_in(recessed({})), "DIN 76-A");
  // By the floor's g1 = 3.2 mm: 3.2 mm and the flank's length.
  EXPECT_EQ(undercut_in(recessed({.width_mm = 3.2 + 1.15 * std::sqrt(3)})), "DIN 76-A");
  EXPECT_EQ(undercut_in(recessed({.width_mm = 3.8})), "DIN 76-B");
  for (const Recess& other :
       {Recess{.width_mm = 4.5}, Recess{.depth_mm = 1.2}, Recess{.depth_mm = 1.1},
        Recess{.radius_mm = 1}, Recess{.falls_deg = 28}, Recess{.falls_deg = 45}}) {
    const Outline o = recessed(other);
    EXPECT_EQ(undercut_in(o), "");
    EXPECT_EQ(o.outer.size(), 4u);  // the recess is turned as it is drawn
  }
}

// Inner threads have the forms C and D, of other sizes.
TEST(Profile, TheSameRecessInABoreIsNoUndercutOfAThread) {
  const double run = 1.15 * std::sqrt(3);
  Profile p = solid({{0, 30},
                     {60, 30},
                     {60, 12},
                     {25.2, 12},
                     {25.2 - run, 13.15},
                     {20.8, 13.15},
                     {20, 12.35},
                     {20, 8},
                     {10, 8},
                     {10, 0}});
  p.sides[6].centre = Point{20.8, 12.35};
  p.sides[6].counterclockwise = true;
  EXPECT_EQ(undercut_in(outline_of(p)), "");
}

TEST(ThreadUndercut, StaysBehindAThreadOfItsPitch) {
  const auto settled = [](Shape shape, double d_mm, double pitch_mm) {
    Outline o = undercut_shaft("DIN 76-A", 3);
    for (Element* e : {&o.outer.front(), &o.outer.back()})
      e->shape = shape, e->left_mm = e->right_mm = d_mm, e->pitch_mm = pitch_mm;
    o.edges.push_back({.at = "left", .chamfer_mm = 1});
    settle_thread_undercuts(o);
    return o;
  };
  EXPECT_EQ(settled(Shape::thread, 60, 3).edges.size(), 3u);
  EXPECT_TRUE(settled(Shape::thread, 60, 3).ignored.empty());
  EXPECT_EQ(settled(Shape::thread, 24, 0).edges.size(), 3u);  // M24's coarse pitch
  const Outline other = settled(Shape::thread, 60, 2),
                none = settled(Shape::cylinder, 60, 0);
  for (const Outline& o : {other, none}) {
    ASSERT_EQ(o.edges.size(), 1u);
    EXPECT_TRUE(o.edges[0].chamfer_mm);
    ASSERT_EQ(o.ignored.size(), 2u);
  }
  EXPECT_EQ(
      other.ignored[1].text,
      "The undercut at d2|d3 is left out: it is the DIN 76-A of a thread with a pitch "
      "of 3 mm, and d3 has a pitch of 2 mm.");
  EXPECT_EQ(
      none.ignored[0].text,
      "The undercut at d1|d2 is left out: it is the DIN 76-A of a thread with a pitch "
      "of 3 mm, and d1 is no thread; if it is M60x3, say so.");
}

std::string profile_refused(const Profile& p) {
  try {
    outline_of(p);
  } catch (const InputError& error) {
    return error.problems().front().got;
  }
  return "";
}

// A recess into the cylinder at 15 deg and into the face at 8 deg: form F 0.8 x 0.3.
TEST(Profile, AnUndercutOfFormFIsKnownByItsSlopes) {
  const double turn = std::acos(-1) / 22.5, run = 0.3 / std::tan(std::acos(-1) / 12);
  const Point centre{39.4, 15.5};
  const Point end{centre.z_mm + 0.8 * std::cos(turn), centre.r_mm + 0.8 * std::sin(turn)};
  const Point wall{40, end.r_mm + (end.z_mm - 40) / std::tan(turn)};
  Profile p;
  p.sides = {{.from = {0, 0}, .to = {0, 15}}};
  drawn::line(p.sides, {37.5, 15});
  drawn::line(p.sides, {37.5 + run, 14.7});
  drawn::line(p.sides, {39.4, 14.7});
  drawn::arc(p.sides, end, centre, true);
  for (const Point to : {wall, Point{40, 25}, Point{60, 25}, Point{60, 0}})
    drawn::line(p.sides, to);
  const Outline o = outline_of(p);
  ASSERT_EQ(o.outer.size(), 2u);
  EXPECT_NEAR(o.outer[0].length_mm, 40, 1e-9);
  EXPECT_NEAR(o.outer[0].left_mm, 30, 1e-9);
  EXPECT_TRUE(o.ignored.empty());
  ASSERT_EQ(o.edges.size(), 1u);
  EXPECT_EQ(o.edges[0].at, "d1|d2");
  EXPECT_EQ(o.edges[0].undercut, "F0.8x0.3");
}

// From the cylinder of 30 mm a slope that is tangent to a radius, and from there one as steep
// back to the wall at 40 mm.
Outline between_slopes(double radius, double depth, double recess, double deg) {
  const double a = deg * std::acos(-1) / 180;
  const Point centre{40 + recess - radius, 15 - depth + radius};
  const Point down{centre.z_mm - radius * std::sin(a),
                   centre.r_mm - radius * std::cos(a)};
  const Point back{centre.z_mm + radius * std::cos(a),
                   centre.r_mm + radius * std::sin(a)};
  Profile p;
  p.sides = {{.from = {0, 0}, .to = {0, 14}}};
  drawn::line(p.sides, {1, 15});
  drawn::line(p.sides, {down.z_mm - (15 - down.r_mm) / std::tan(a), 15});
  drawn::line(p.sides, down);
  drawn::arc(p.sides, back, centre, true);
  drawn::line(p.sides, {40, back.r_mm + (back.z_mm - 40) / std::tan(a)});
  for (const Point to : {Point{40, 25}, Point{60, 25}, Point{60, 0}})
    drawn::line(p.sides, to);
  return outline_of(p);
}

TEST(Profile, UndercutsOfTheFormsGAndHAreKnownByTheirSlopes) {
  const auto only = [](const Outline& o) {
    return o.edges.size() == 2 && o.ignored.empty() ? o.edges[1].undercut.value_or("none")
                                                    : "other edges";
  };
  EXPECT_EQ(only(between_slopes(0.4, 0.2, 0.2, 17.5)), "G0.4x0.2");
  EXPECT_EQ(only(between_slopes(0.8, 0.3, 0.05, 15)), "H0.8x0.3");
  EXPECT_EQ(only(between_slopes(1.2, 0.3, 0.05, 15)), "H1.2x0.3");
  const Outline other = between_slopes(0.8, 0.3, 0.2, 12);
  ASSERT_EQ(other.ignored.size(), 1u);
  EXPECT_EQ(
      other.ignored[0].text,
      "The recess in the corner at d1|d2 is left out: it is none of DIN 509's forms "
      "F, G and H with the sizes of their table, the corner stays sharp.");
}

TEST(Profile, WhatIsNoHalfProfileIsRefused) {
  EXPECT_EQ(profile_refused({}), "no sides");
  Profile gap = drawn::profile_of(motor_shaft());
  gap.sides[4].to.z_mm += 0.01;
  gap.sides[4].from.z_mm += 0.01;
  EXPECT_EQ(profile_refused(gap).rfind("a gap of 0.01 mm", 0), 0u)
      << profile_refused(gap);
  Profile nan = drawn::profile_of(motor_shaft());
  nan.sides[2].to.r_mm = std::nan("");
  EXPECT_EQ(profile_refused(nan), "a place that is no number");
  Profile below = drawn::profile_of(motor_shaft());
  for (Side& s : below.sides) s.from.r_mm = -s.from.r_mm, s.to.r_mm = -s.to.r_mm;
  EXPECT_EQ(profile_refused(below), "a side below the axis");
  Profile tip{{{.from = {0, 0}, .to = {30, 10}}, {.from = {30, 10}, .to = {30, 0}}}};
  EXPECT_EQ(profile_refused(tip), "no plane at the left end");
  EXPECT_EQ(profile_refused(solid({{0, 30}, {60, 30}, {60, 20}, {40, 20}, {10, 0}})),
            "a bore that ends in a point of 67.38 deg");
}

}  // namespace
}  // namespace turnwright::exchange
