// Elements that turning leaves for the grinder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "refusal.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"

namespace turnwright::document::grinding_test {
namespace {

using nlohmann::json;

// A seat of 30 k6 between 20 and 40 mm, ground by 0.3 mm, with a shoulder behind it.
json shaft() {
  const auto cylinder = [](const char* id, double length, double d) {
    return json{
        {"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
  };
  auto seat = cylinder("seat", 30, 30);
  seat["fit"] = "k6";
  seat["Ra_um"] = 0.4;
  seat["grinding_allowance_mm"] = 0.3;
  return {{"material", "test-steel"},
          {"stock", {{"kind", "bar"}, {"diameter_mm", 45}, {"length_mm", 125}}},
          {"outer", {cylinder("big", 40, 40), seat, cylinder("end", 50, 20)}}};
}

LoadedPart read(const json& document) {
  return load_part_plan(document, test_catalogue(), "t");
}
part::OuterElement seat_of(const json& document) {
  return read(document).plan.drawing.outer.at(1);
}
bool tells(const LoadedPart& loaded, const std::string& pointer, const char* why) {
  return std::ranges::any_of(loaded.assumed, [&](const Assumption& a) {
    return a.pointer == pointer && a.why.find(why) != std::string::npos;
  });
}

TEST(Grinding, IsLeftOnTheDiameterWithAThirdAsTolerance) {
  const auto loaded = read(shaft());
  const auto& e = loaded.plan.drawing.outer.at(1);
  EXPECT_NEAR(e.left_mm, 30.3, 1e-12);
  EXPECT_NEAR(e.right_mm, 30.3, 1e-12);
  ASSERT_TRUE(e.limits);
  EXPECT_NEAR(e.limits->lower_mm, -0.05, 1e-12);
  EXPECT_NEAR(e.limits->upper_mm, 0.05, 1e-12);
  EXPECT_FALSE(e.fit || e.Ra_um);
  EXPECT_TRUE(tells(loaded, "/outer/1/fit", "made by grinding"));
  EXPECT_TRUE(tells(loaded, "/outer/1/Ra_um", "made by grinding"));
  EXPECT_TRUE(tells(loaded, "/outer/1/limits_mm", "30.3 mm that are turned"));
}

TEST(Grinding, OfABoreIsLeftInside) {
  auto d = shaft();
  d["inner"] = {{{"id", "b"},
                 {"kind", "cone"},
                 {"from", "right"},
                 {"length_mm", 20},
                 {"left_mm", 10},
                 {"right_mm", 12},
                 {"grinding_allowance_mm", 0.2}}};
  const auto e = read(d).plan.drawing.inner.at(0);
  EXPECT_NEAR(e.left_mm, 9.8, 1e-12);
  EXPECT_NEAR(e.right_mm, 11.8, 1e-12);
  d["inner"][0]["left_mm"] = 0.15;
  EXPECT_NE(
      refusal_of(d).find("/inner/0/grinding_allowance_mm: got 0.2, expected less than"),
      std::string::npos)
      << refusal_of(d);
}

// The line of a chamfer of 1 mm at 30 deg goes through the finished surface 1 mm from the
// end, whatever stands on it.
TEST(Grinding, LeavesChamfersAsDrawn) {
  auto d = shaft();
  d["outer"][0]["diameter_mm"] = 20;
  d["edges"] = {{{"at", "seat|big"}, {"chamfer_mm", 1}, {"angle_deg", 30}}};
  const auto e = seat_of(d);
  ASSERT_TRUE(e.left_chamfer);
  const double z_mm = 1;
  EXPECT_NEAR(e.left_mm / 2 - part::chamfered_mm(e, z_mm), 30.0 / 2, 1e-12);
  EXPECT_NEAR(e.left_mm / 2 - part::chamfered_mm(e, 0), 30.0 / 2 - std::tan(M_PI / 6),
              1e-12);
}

// A flat chamfer goes on further than it is drawn, but not beyond its element.
TEST(Grinding, ChamfersStayWithinTheirElements) {
  auto d = shaft();
  d["outer"][0]["diameter_mm"] = 20;
  const double length_mm = d["outer"][1]["length_mm"];
  d["outer"][1]["grinding_allowance_mm"] = 1.1;
  d["edges"] = {{{"at", "seat|big"}, {"chamfer_mm", 1}, {"angle_deg", 1}}};
  ASSERT_GT(1 + 0.55 / std::tan(M_PI / 180), length_mm);
  EXPECT_TRUE(refusal_of(d).find("/edges/0/chamfer_mm: got 1, expected less than the") !=
              std::string::npos)
      << refusal_of(d);
}

// Edges that the drawing breaks alike are as it asks once their elements are ground.
TEST(Grinding, LeavesGeneralEdgesAsDrawn) {
  auto d = shaft();
  d["outer"][0]["diameter_mm"] = 20;
  d["general_edges_mm"] = {0.2, 0.4};
  const auto e = seat_of(d);
  ASSERT_TRUE(e.left_chamfer);
  EXPECT_NEAR(e.left_chamfer->axial_mm, 0.3 + 0.15, 1e-12);
  EXPECT_NEAR(e.left_chamfer->radial_mm, 0.3 + 0.15, 1e-12);
}

TEST(Grinding, AWrongAllowanceIsToldOnce) {
  for (const json& wrong : {json("0.3"), json(-0.3), json(true), json(6)}) {
    auto d = shaft();
    d["outer"][1]["grinding_allowance_mm"] = wrong;
    const auto text = refusal_of(d);
    const auto first = text.find("/outer/1/grinding_allowance_mm");
    EXPECT_NE(first, std::string::npos) << wrong;
    EXPECT_EQ(text.find("/outer/1/grinding_allowance_mm", first + 1), std::string::npos)
        << text;
  }
}

// So does the floor of an undercut, and where it begins on the finished surface.
TEST(Grinding, LeavesUndercutsAsDrawn) {
  auto d = shaft();
  d["edges"] = {{{"at", "big|seat"}, {"undercut", "E0.8x0.3"}}};
  const auto e = seat_of(d);
  ASSERT_TRUE(e.left_undercut);
  EXPECT_NEAR(e.left_mm / 2 - e.left_undercut->depth_mm, 30.0 / 2 - 0.3, 1e-12);
  EXPECT_NEAR(e.left_mm / 2 - part::undercut_mm(e, 2.5), 30.0 / 2, 1e-9);
}

TEST(Grinding, LeavesKeywaysAsDrawn) {
  auto d = shaft();
  d["material"] = "C45";
  d["machine"] = "turn-mill";
  d["milling"] = {{{"id", "m1"},
                   {"kind", "keyway"},
                   {"on", "seat"},
                   {"z_mm", 42},
                   {"length_mm", 20},
                   {"width_mm", 8},
                   {"depth_mm", 4}}};
  static const auto kShipped = load_catalogue(TURNWRIGHT_SOURCE_DIR);
  const auto loaded = load_part_plan(d, kShipped, "t");
  ASSERT_EQ(loaded.plan.milled.size(), 1U);
  EXPECT_NEAR(loaded.plan.milled[0].depth_mm, 4.15, 1e-12);
}

TEST(Grinding, AnswersForItsOwnTolerances) {
  auto d = shaft();
  d["general"] = "ISO 2768-mK";
  d["tolerances"] = {
      {{"id", "t1"}, {"kind", "cylindricity"}, {"of", "seat"}, {"value_mm", 0.004}},
      {{"id", "t2"},
       {"kind", "coaxiality"},
       {"of", "end"},
       {"datum", "seat"},
       {"value_mm", 0.1}}};
  const auto loaded = read(d);
  EXPECT_TRUE(tells(loaded, "/tolerances/0", "made by grinding"));
  for (const auto& t : loaded.plan.drawing.tolerances)
    EXPECT_FALSE(t.of == "seat" && t.kind != part::ToleranceKind::diameter) << t.id;
  EXPECT_TRUE(std::ranges::any_of(loaded.plan.drawing.tolerances,
                                  [](const auto& t) { return t.id == "t2"; }));
}

TEST(Grinding, IsOfCylindersAndCones) {
  auto d = shaft();
  d["outer"][1]["grinding_allowance_mm"] = 6;
  EXPECT_NE(refusal_of(d).find("/outer/1/grinding_allowance_mm: got 6"),
            std::string::npos);
  d["outer"][1] = {{"id", "seat"},
                   {"kind", "thread"},
                   {"length_mm", 30},
                   {"designation", "M30x1.5"},
                   {"grinding_allowance_mm", 0.3}};
  EXPECT_NE(
      refusal_of(d).find("/outer/1/grinding_allowance_mm: got 0.3, expected no such key"),
      std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::grinding_test
