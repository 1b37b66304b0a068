#include "turnwright/exchange/step.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "exchange/solid/step_contour.hpp"
#include "reference_outlines.hpp"
#include "same_outline.hpp"
#include "step_file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kSame_mm = compared::kSame_mm;

Outline read_case(const std::string& name) {
  return read_step(step_text("cases/" + name + ".step"));
}

std::string step_refusal(const std::string& text, const std::string& body = "") {
  try {
    read_step(text, {.body = body});
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

/// A reference part as its shape alone shows it: threads are cylinders, and the hollow of a
/// tube is a bore that nobody drew.
std::map<std::string, Outline> shapes() {
  auto all = reference::outlines();
  for (auto& [name, o] : all)
    for (auto& e : o.outer)
      if (e.shape == Shape::thread) e.shape = Shape::cylinder, e.pitch_mm = 0;
  const auto tube = [&all](const char* name, double length, double d) {
    all.at(name).inner.push_back({.id = "b2",
                                  .shape = Shape::cylinder,
                                  .length_mm = length,
                                  .left_mm = d,
                                  .right_mm = d});
  };
  tube("aluminium-tube", 30, 40);
  tube("roller-tube", 390, 30);
  return all;
}

void expect_milled(const Outline& read, const Outline& drawn) {
  ASSERT_EQ(read.milled.size(), drawn.milled.size());
  for (const auto& m : drawn.milled) {
    const auto found = std::find_if(read.milled.begin(), read.milled.end(),
                                    [&m](const Milled& r) { return r.kind == m.kind; });
    ASSERT_NE(found, read.milled.end());
    EXPECT_EQ(found->on, m.on);
    EXPECT_NEAR(found->z_mm, m.z_mm, kSame_mm);
    EXPECT_NEAR(found->length_mm, m.length_mm, kSame_mm);
    EXPECT_NEAR(found->width_mm, m.width_mm, kSame_mm);
    EXPECT_NEAR(found->depth_mm, m.depth_mm, kSame_mm);
  }
  if (read.milled.size() != 2) return;
  // Wherever zero is, they stand a quarter turn apart.
  const double apart = read.milled[0].angle_deg - read.milled[1].angle_deg;
  EXPECT_NEAR(std::abs(std::remainder(apart, 360)), 90, 1e-9);
}

class Reference : public testing::TestWithParam<const char*> {};

TEST_P(Reference, PartsComeBackAsTheyWereDrawn) {
  int read = 0;
  for (const auto& [name, drawn] : shapes()) {
    const auto text = step_text(fmt::format("reference/{}/{}.step", GetParam(), name));
    if (text.empty()) continue;
    SCOPED_TRACE(name);
    const auto outline = read_step(text);
    compared::expect_same(outline, drawn);
    expect_milled(outline, drawn);
    EXPECT_TRUE(outline.ignored.empty());
    for (const auto& e : outline.outer) EXPECT_FALSE(e.sources.empty());
    ++read;
  }
  EXPECT_EQ(read, GetParam() == std::string("placed") ? 6 : 16);
}

// `placed`: rolled by 37 deg about an oblique axis and moved, in inches, in metres, of AP242,
// of two halves; README.md of the data says which is which.
INSTANTIATE_TEST_SUITE_P(Step, Reference, testing::Values("occt", "freecad", "placed"));

/// The file with a note at the diameter of a face.
std::string with_note(std::string text, const std::string& face, double d_mm,
                      const std::string& note, int first) {
  const auto before = [&text](const std::string& entity) {
    const auto eq = text.rfind(" = ", text.find(entity));
    return text.substr(text.rfind('#', eq), eq - text.rfind('#', eq));
  };
  const auto id = [first](int i) { return fmt::format("#{}", first + i); };
  const std::string added =
      id(0) + "=SHAPE_ASPECT('','',#4,.T.);" + id(1) +
      "=GEOMETRIC_ITEM_SPECIFIC_USAGE('',''," + id(0) + "," +
      before("ADVANCED_BREP_SHAPE_REPRESENTATION") + "," + face + ");" + id(2) +
      "=DIMENSIONAL_SIZE(" + id(0) + ",'diameter');" + id(3) +
      fmt::format(
          "=MEASURE_REPRESENTATION_ITEM('nominal "
          "value',POSITIVE_LENGTH_MEASURE({:.6f}),{});",
          d_mm, before("( LENGTH_UNIT()")) +
      id(4) + "=DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note','" + note + "');" +
      id(5) + "=SHAPE_DIMENSION_REPRESENTATION('',(" + id(3) + "," + id(4) + "),$);" +
      id(6) + "=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(" + id(2) + "," + id(5) + ");";
  return text.insert(text.rfind("ENDSEC;"), added + "\n");
}

TEST(Step, WhatStandardsDescribeIsKnownByItsSizes) {
  for (const auto& [name, drawn] : reference::outlines(reference::kFeatures)) {
    SCOPED_TRACE(name);
    auto text = step_text("features/" + name + ".step");
    const auto shape = read_step(text);
    int next = 100000;
    for (std::size_t i = 0; i < drawn.outer.size(); ++i) {
      const Element& e = drawn.outer[i];
      if (e.shape != Shape::thread) continue;
      const auto note = e.pitch_mm > 0 ? fmt::format("M{:g}x{:g}", e.left_mm, e.pitch_mm)
                                       : fmt::format("M{:g}", e.left_mm);
      text = with_note(text, shape.outer[i].sources.at(0), e.left_mm, note, next += 10);
    }
    const auto outline = read_step(text);
    compared::expect_same(outline, drawn);
    EXPECT_TRUE(outline.ignored.empty());
  }
}

TEST(Step, AnUndercutOfAThreadThatNobodyNamesIsTold) {
  const auto o = read_step(step_text("features/threaded-shaft.step"));
  EXPECT_EQ(o.edges.size(), 2U);  // the chamfers
  ASSERT_EQ(o.ignored.size(), 2U);
  EXPECT_EQ(o.ignored[0].at[0], '#');
  EXPECT_EQ(
      o.ignored[0].text,
      "The undercut at d1|d2 is left out: it is the DIN 76-A of a thread with a pitch "
      "of 1.5 mm, and d1 is no thread; if it is M24x1.5, say so.");
}

/// Volume of the body that a half profile sweeps, by Pappus: 2 pi times the integral of
/// r dA, as a sum over the sides, which the theorem of Green makes of it:
/// V = pi * integral of r^2 dz.
double volume_mm3(const Profile& profile) {
  double sum = 0;
  for (const auto& s : profile.sides) {
    const double dz = s.to.z_mm - s.from.z_mm, a = s.from.r_mm, b = s.to.r_mm;
    if (!s.centre) {
      sum += dz * (a * a + a * b + b * b) / 3;
      continue;
    }
    // r = c + R sin t, dz = -R sin t dt.
    const double c = s.centre->r_mm, z = s.centre->z_mm;
    const double R = std::hypot(s.from.z_mm - z, a - c);
    const double t0 = std::atan2(a - c, s.from.z_mm - z);
    const double turn =
        std::remainder(std::atan2(b - c, s.to.z_mm - z) - t0, 2 * std::numbers::pi);
    const auto primitive = [&](double t) {
      const double cos = std::cos(t);
      return c * c * cos - 2 * c * R * (t / 2 - std::sin(2 * t) / 4) +
             R * R * (cos - cos * cos * cos / 3);
    };
    sum += R * (primitive(t0 + turn) - primitive(t0));
  }
  return std::numbers::pi * sum;
}

TEST(Step, VolumesAgreeWithOpenCascade) {
  std::ifstream in(step_folder() + "/reference/volumes.json");
  const auto volumes = nlohmann::json::parse(in);
  EXPECT_EQ(volumes.size(), 16U);
  for (const auto& [name, of] : volumes.items())
    for (const char* writer : {"occt", "freecad"}) {
      SCOPED_TRACE(name);
      const auto text = step_text(fmt::format("reference/{}/{}.step", writer, name));
      const auto file = read_part21(text);
      const auto faces = step_faces(file, step_body(file, {}));
      const double volume = volume_mm3(step_contour(faces, turning_axis(faces)).profile);
      const double expected = of[std::string(writer) + "_mm3"];
      EXPECT_NEAR(volume, expected, 1e-9 * expected) << writer;
    }
}

struct Bands {
  const char* name;
  std::vector<std::pair<double, double>> outer;  // length, diameter
  std::vector<std::pair<double, double>> inner = {};
};

// The lengths and diameters that corpus-turned-steps-v1.json of draftwright expects.
TEST(Step, TurnedStepsOfTheCorpusAreTheBandsExpected) {
  const std::vector<std::pair<double, double>> topology{{17, 32}, {23, 22}, {19, 12}};
  for (const auto& c :
       {Bands{"turned-x", {{20, 30}, {30, 20}, {15, 12}}},
        Bands{"turned-y", {{12, 24}, {18, 14}}}, Bands{"turned-z", {{18, 28}, {22, 18}}},
        Bands{"translated-blind-bore", {{30, 30}, {30, 16}}, {{25, 8}}},
        Bands{"repeated-lengths", {{10, 20}, {10, 14}, {10, 8}}},
        Bands{"through-bore", {{24, 30}, {26, 18}}, {{50, 8}}},
        Bands{"groove", {{28, 20}, {4, 16}, {28, 20}}}, Bands{"topology-a", topology},
        Bands{"topology-b", topology}}) {
    SCOPED_TRACE(c.name);
    const auto outline = read_case(c.name);
    ASSERT_EQ(outline.outer.size(), c.outer.size());
    for (std::size_t i = 0; i < c.outer.size(); ++i) {
      EXPECT_NEAR(outline.outer[i].length_mm, c.outer[i].first, kSame_mm);
      EXPECT_NEAR(outline.outer[i].left_mm, c.outer[i].second, kSame_mm);
    }
    ASSERT_EQ(outline.inner.size(), c.inner.size());
    for (std::size_t i = 0; i < c.inner.size(); ++i) {
      EXPECT_NEAR(outline.inner[i].length_mm, c.inner[i].first, kSame_mm);
      EXPECT_NEAR(outline.inner[i].left_mm, c.inner[i].second, kSame_mm);
    }
    EXPECT_TRUE(outline.ignored.empty());
  }
  EXPECT_EQ(read_case("groove").outer[1].shape, Shape::groove);
}

// The name that Open CASCADE writes for want of any is no name of the part.
TEST(Step, TheWritersNameIsNotTheParts) {
  auto text = step_text("cases/turned-x.step");
  const std::string name = "'turned-x'", own = "'Open CASCADE STEP translator 7.6 1'";
  ASSERT_NE(text.find(name), text.npos);
  EXPECT_EQ(read_step(text).name, "turned-x");
  for (auto at = text.find(name); at != text.npos; at = text.find(name, at + 1))
    text.replace(at, name.size(), own);
  const auto outline = read_step(text);
  EXPECT_EQ(outline.name, "");
  EXPECT_EQ(outline.title.drawing_number, "");
}

TEST(Step, OneOfSeveralSolidsIsChosen) {
  const auto text = step_text("cases/compound.step");
  const auto said = step_refusal(text);
  EXPECT_NE(said.find("got 2 solids, expected one of these, by name or number: 1 \""),
            said.npos)
      << said;
  EXPECT_EQ(read_step(text, {.body = "1"}).outer[0].length_mm, 20);
  EXPECT_NEAR(read_step(text, {.body = "2"}).outer[1].left_mm, 16, kSame_mm);
  EXPECT_NE(step_refusal(text, "3").find("0 solids \"3\""), said.npos);
}

TEST(Step, MilledPlacesAreReadWithTheBandsWhole) {
  struct Place {
    const char* name;
    Milled::Kind kind;
    const char* on;
    double z, length, width, depth, angle;
  };
  using enum Milled::Kind;
  for (const auto& c : {Place{"slot", slot, "d2", 76, 24, 8, 5, 0},
                        Place{"round-keyway", keyway, "d2", 60, 30, 8, 5, 0},
                        Place{"round-keyway-off-seam", keyway, "d2", 60, 30, 8, 5, 90},
                        Place{"open-slot-off-seam", slot, "d1", 0, 29, 8, 5, 90},
                        Place{"square-keyway", keyway, "d2", 60, 30, 8, 5, 0},
                        Place{"d-shaft", flat, "d1", 0, 40, 0, 4, 0},
                        Place{"oblique-flat", flat, "d2", 70, 25, 0, 3, 33}}) {
    SCOPED_TRACE(c.name);
    const auto outline = read_case(c.name);
    ASSERT_EQ(outline.milled.size(), 1U);
    const auto& m = outline.milled[0];
    EXPECT_EQ(m.kind, c.kind);
    EXPECT_EQ(m.on, c.on);
    EXPECT_NEAR(m.z_mm, c.z, kSame_mm);
    EXPECT_NEAR(m.length_mm, c.length, kSame_mm);
    EXPECT_NEAR(m.width_mm, c.width, kSame_mm);
    EXPECT_NEAR(m.depth_mm, c.depth, kSame_mm);
    EXPECT_NEAR(m.angle_deg, c.angle, 1e-9);
    ASSERT_EQ(outline.outer.size(), 2U);
    EXPECT_NEAR(outline.outer[0].length_mm, 40, kSame_mm);
    EXPECT_NEAR(outline.outer[1].length_mm, 60, kSame_mm);
    EXPECT_TRUE(outline.ignored.empty());
  }
  const auto both = read_case("double-d");
  ASSERT_EQ(both.milled.size(), 2U);
  EXPECT_NEAR(std::abs(both.milled[0].angle_deg - both.milled[1].angle_deg), 180, 1e-9);
}

// The cutter was turned by +33 deg about x, which points at who looks from the right end.
TEST(Step, AnglesAreCountedCounterclockwiseFromTheRightEnd) {
  EXPECT_NEAR(read_case("oblique-flat").milled[0].angle_deg, 33, 1e-9);
}

// Blind, beyond the axis, out of the other side and into a bore, at any angle.
TEST(Step, CrossHolesComeBackAsTheyWereDrawn) {
  int holes = 0;
  for (const auto& [name, drawn] : reference::outlines("tests/data/step/cross-holes")) {
    const auto read = read_step(step_text("cross-holes/" + name + ".step"));
    compared::expect_same(read, drawn);
    EXPECT_TRUE(read.ignored.empty());
    ASSERT_EQ(read.milled.size(), drawn.milled.size()) << name;
    for (const auto& m : drawn.milled) {
      SCOPED_TRACE(name + " " + m.id);
      const auto found = std::ranges::find_if(read.milled, [&m](const Milled& r) {
        return std::abs(r.z_mm - m.z_mm) < 1e-9;
      });
      ASSERT_NE(found, read.milled.end());
      EXPECT_EQ(found->kind, Milled::Kind::cross_hole);
      EXPECT_EQ(found->on, m.on);
      EXPECT_EQ(found->through, m.through);
      EXPECT_NEAR(found->width_mm, m.width_mm, 1e-9);
      EXPECT_NEAR(found->depth_mm, m.depth_mm, 1e-9);
      EXPECT_NEAR(found->angle_deg, m.angle_deg, 1e-9);
      ++holes;
    }
  }
  EXPECT_EQ(holes, 7);
}

TEST(Step, WhatNoDrillLeavesAcrossTheAxisIsNoCrossHole) {
  const auto through = read_case("cross-hole");
  ASSERT_EQ(through.milled.size(), 1U);
  EXPECT_EQ(through.milled[0].through, Milled::Through::part);
  EXPECT_TRUE(through.ignored.empty());
  const auto flat = read_case("cross-hole-flat");
  ASSERT_EQ(flat.milled.size(), 1U);
  EXPECT_NEAR(flat.milled[0].depth_mm, 11, 1e-9);
  ASSERT_FALSE(flat.assumed.empty());
  EXPECT_EQ(flat.assumed[0].text, "m1 has a flat bottom; a drill leaves a point.");
  for (const char* other : {"cross-hole-beside-the-axis", "cross-hole-countersunk"}) {
    EXPECT_TRUE(read_case(other).milled.empty()) << other;
    EXPECT_FALSE(read_case(other).ignored.empty()) << other;
  }
}

TEST(Step, WhatIsNotTurnedIsNamedFaceByFace) {
  const auto cross = read_case("cross-hole-beside-the-axis");
  ASSERT_EQ(cross.ignored.size(), 1U);
  EXPECT_EQ(cross.ignored[0].at[0], '#');
  EXPECT_EQ(cross.ignored[0].text,
            "A hole or hollow of 6 mm diameter across the axis is not part of what is "
            "turned.");
  const auto bolts = read_case("bolt-circle");
  ASSERT_EQ(bolts.ignored.size(), 4U);
  EXPECT_EQ(bolts.ignored[3].text,
            "A hole or hollow of 9 mm diameter along the axis, 32 mm from it is not part "
            "of what is turned.");
  EXPECT_EQ(read_case("bore-keyway").ignored.size(), 3U);
  EXPECT_EQ(read_case("bore-keyway").inner.size(), 1U);
}

TEST(Step, DiametersOfThreadsAreOffered) {
  const auto pin = read_case("through-bore");
  ASSERT_EQ(pin.assumed.size(), 1U);
  EXPECT_EQ(pin.assumed[0].at, "d1");
  EXPECT_NE(pin.assumed[0].text.find("M30; if it is a thread, say so."),
            std::string::npos);
}

TEST(Step, PartsThatAreNotTurnedAreRefusedWithTheReason) {
  const auto expect = [](const std::string& name, const std::string& part) {
    const auto said = step_refusal(step_text("cases/" + name + ".step"));
    EXPECT_NE(said.find(part), said.npos) << name << ": " << said;
  };
  expect("block", "a body without a cylinder, a cone or a torus");
  expect("housing", "a body with no face about its axis on the outside");
  expect("blended-block", "a corner 27.4874 mm from the axis");
  expect("square-bar", "% of a circle of 54 mm diameter");
  expect("hexagon-head", "a corner 20 mm from the axis");
  expect("hollow", "a hollow inside the body");
}

}  // namespace
}  // namespace turnwright::exchange
