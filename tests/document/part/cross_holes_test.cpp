// Cross holes of a part document.
#include <gtest/gtest.h>

#include <cmath>

#include "../slips.hpp"
#include "document/exchange/outline.hpp"
#include "document/json/file.hpp"
#include "refusal.hpp"

namespace turnwright::document::cross_holes_test {
namespace {

using nlohmann::json;
using planning::Through;

const Catalogue& shop() {
  static const auto all = load_catalogue(source_path(""));
  return all;
}

// A bush: solid at the left, with a bore of 20 mm, 40 mm deep, at the right.
json part() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "bush", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 50, "length_mm": 104, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 50, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 50, "diameter_mm": 46}],
    "inner": [{"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 40,
               "diameter_mm": 20}],
    "machine": "turn-mill",
    "setups": [{"hold": "left", "grip_mm": 40, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}],
    "milling": [
      {"id": "h1", "kind": "cross-hole", "on": "d2", "at_mm": 80, "diameter_mm": 6,
       "through": "wall", "fit": "H12", "count": 3, "angle_deg": 10, "setup": 0,
       "tool": "DRILL-HM-5D", "conditions": {"vc_m_min": 80, "f_mm_rev": 0.1}},
      {"id": "h2", "kind": "cross-hole", "on": "d1", "at_mm": 20, "diameter_mm": 5,
       "depth_mm": 8, "limits_mm": [-0.1, 0.1]},
      {"id": "h3", "kind": "cross-hole", "on": "d1", "at_mm": 40, "diameter_mm": 8,
       "through": "part"}]})");
}

PreparedDocument load(const json& document, Purpose purpose = Purpose::plan) {
  return prepared_part(document, shop(), "t", purpose);
}

std::string refused(const json& document, Purpose purpose = Purpose::plan) {
  return problems_of(document, shop(), purpose);
}

std::string refused_with(const std::string& pointer, const json& value) {
  auto document = part();
  document[json::json_pointer(pointer)] = value;
  return refused(document);
}

TEST(CrossHoles, EveryKeyIsRead) {
  const auto plan = load(part()).part;
  ASSERT_EQ(plan.milled_places.size(), 5U);
  const auto& a = plan.milled_places[0];
  EXPECT_EQ(a.id, "h1-1");
  EXPECT_EQ(a.kind, planning::MilledKind::cross_hole);
  EXPECT_EQ(a.element, 1U);
  EXPECT_EQ(a.z_mm, 77);
  EXPECT_EQ(a.length_mm, 6);
  EXPECT_EQ(a.width_mm, 6);
  EXPECT_EQ(a.through, Through::wall);
  EXPECT_NEAR(a.depth_mm, 23 - std::sqrt(10 * 10 - 3 * 3), 1e-12);
  EXPECT_EQ(a.angle_deg, 10);
  EXPECT_EQ(a.setup, 0U);
  EXPECT_EQ(a.drills, std::vector<std::string>{"DRILL-HM-5D"});
  EXPECT_EQ(a.drilling.vc_m_min, 80);
  EXPECT_EQ(a.drilling.f_mm_rev, 0.1);
  EXPECT_NEAR(plan.milled_places[2].angle_deg, 250, 1e-12);
  const auto& b = plan.milled_places[3];
  EXPECT_EQ(b.depth_mm, 8);
  EXPECT_EQ(b.setup, 1U);  // d1 is in the jaws in setup 0
  EXPECT_FALSE(b.drills.empty());
  EXPECT_EQ(plan.milled_places[4].depth_mm, 40);
  EXPECT_TRUE(plan.milled_places[4].drills.empty());
}

TEST(CrossHoles, ShapesThatCannotBeAreRefused) {
  EXPECT_EQ(refused_with("/milling/1/at_mm", 2),
            "/milling/1/at_mm: got 2, expected a hole that lies on d1, its middle from "
            "2.5 mm to 47.5 mm\n");
  EXPECT_EQ(refused_with("/milling/1/at_mm", 48),
            "/milling/1/at_mm: got 48, expected a hole that lies on d1, its middle from "
            "2.5 mm to 47.5 mm\n");
  EXPECT_NE(
      refused_with("/milling/2/diameter_mm", 40)
          .find("/milling/2/diameter_mm: got 40, expected less than the diameter of "
                "d1, 40 mm\n"),
      std::string::npos);
  EXPECT_EQ(refused_with("/milling/1/depth_mm", 40),
            "/milling/1/depth_mm: got 40, expected less than the diameter, 40 mm, or "
            "through in its place\n");
  // The wall over the bore, and bores that are not behind all of a hole.
  auto document = part();
  auto& hole = document["milling"][0];
  hole.erase("through");
  hole["depth_mm"] = 13;
  EXPECT_EQ(refused(document),
            "/milling/0/depth_mm: got 13, expected less than the wall over the hole, "
            "13 mm, or through in its place\n");
  EXPECT_EQ(
      refused_with("/milling/2/through", "wall"),
      "/milling/2/through: got \"wall\", expected part, or a hole with a bore behind "
      "all of its width\n");
  EXPECT_EQ(
      refused_with("/milling/0/at_mm", 61),
      "/milling/0/through: got \"wall\", expected part, or a hole with a bore behind "
      "all of its width\n");
  document = part();
  document["milling"][0].update({{"diameter_mm", 20}, {"count", 1}});
  EXPECT_EQ(
      refused(document),
      "/milling/0/through: got \"wall\", expected part, or a hole narrower than the "
      "bore behind it, 20 mm\n");
  document = part();
  document["milling"][1]["through"] = "part";
  EXPECT_EQ(refused(document).substr(0, 20), "/milling/1/through: ");
}

// Programs cut lengths to the middles of their limits, and drill where a hole is drawn.
TEST(CrossHoles, LieOnTheirCylinderAsProgramsMakeIt) {
  const auto with = [](const char* face, double lower_mm, double upper_mm) {
    auto document = part();
    document["milling"][0]["at_mm"] = 63;  // over the bore from 60 mm on
    document["milling"][2]["at_mm"] = 46;  // to the end of d1 at 50 mm
    document["tolerances"] = {{{"id", "t"},
                               {"kind", "length"},
                               {"between", {face, "right"}},
                               {"limits_mm", {lower_mm, upper_mm}}}};
    return refused(document);
  };
  EXPECT_EQ(with("d1|d2", -0.2, 0.2), "");
  EXPECT_EQ(with("d1|d2", -0.2, 0), "");  // d1 is longer
  EXPECT_EQ(
      with("d1|d2", 0, 0.2),
      "/milling/2/at_mm: got 46 mm, expected a hole that lies on d1 where the middles "
      "of the limits in tolerances have it, from 0 mm to 49.9 mm\n");
}

// A hole from 60 mm on into a wider bore, which is made shorter by 0.1 mm.
TEST(CrossHoles, OpenIntoTheBoreThatProgramsMake) {
  auto document = part();
  document["inner"] = json::parse(R"([
    {"id": "b1", "kind": "cylinder", "from": "right", "length_mm": 40, "diameter_mm": 20},
    {"id": "b2", "kind": "cylinder", "from": "right", "length_mm": 60, "diameter_mm": 5}])");
  document["milling"] = {document["milling"][0]};
  document["milling"][0]["at_mm"] = 63;
  document["tolerances"] = json::parse(R"([
    {"id": "t", "kind": "length", "between": ["right", "b1|b2"], "limits_mm": [0, 0.2]}])");
  EXPECT_EQ(refused(document), "");
  document["tolerances"][0]["limits_mm"] = {-0.2, 0};
  EXPECT_EQ(refused(document),
            "/milling/0/at_mm: got 63 mm, expected a hole with a bore behind all of its "
            "width where the middles of the limits in tolerances have the bore\n");
}

TEST(CrossHoles, TighterFitsThanADrillLeavesAreRefused) {
  const auto text = refused_with("/milling/0/fit", "H7");
  EXPECT_EQ(
      text,
      "/milling/0/fit: got \"H7\", expected no more than a drill leaves (DRILL-HM-5D "
      "IT10 and Ra 3.2 um): a cross hole is not reamed\n");
  EXPECT_NE(refused_with("/milling/1/limits_mm", {0, 0.01}).find("/milling/1/limits_mm"),
            std::string::npos);
  EXPECT_EQ(refused_with("/milling/1/diameter_mm", 5.05),
            "/milling/1/limits_mm: got [-0.1,0.1], expected none: of no drill of "
            "this diameter it is known what it leaves\n");
  EXPECT_EQ(refused_with("/milling/0/fit", "H10"), "");
  EXPECT_EQ(refused_with("/milling/0/fit", "X77").substr(0, 15), "/milling/0/fit:");
  EXPECT_EQ(refused_with("/milling/0/tool", "FLAT-HM-2D").substr(0, 16),
            "/milling/0/tool:");
}

TEST(CrossHoles, DoNotMeetOtherPlaces) {
  // Holes through the part at one place meet in the middle and on the other side.
  EXPECT_EQ(refused_with("/milling/2/count", 2),
            "/milling/2: got an object, expected a place that does not meet h3-1\n");
  EXPECT_EQ(refused_with("/milling/2/at_mm", 23),
            "/milling/2: got an object, expected a place that does not meet h2\n");
  EXPECT_EQ(refused_with("/milling/2/at_mm", 27), "");
  auto document = part();
  document["milling"].push_back({{"id", "f"},
                                 {"kind", "flat"},
                                 {"on", "d1"},
                                 {"z_mm", 30},
                                 {"length_mm", 15},
                                 {"depth_mm", 0.2},
                                 {"angle_deg", 180}});
  EXPECT_EQ(refused(document),
            "/milling/3: got an object, expected a place that does not meet h3\n");
  document["milling"][3]["angle_deg"] = 90;
  EXPECT_EQ(refused(document), "");
  // Into one bore from both sides.
  EXPECT_EQ(refused_with("/milling/0/count", 2), "");
}

// Through a hollow part holes begin where the bore leaves off: ten holes of 6 mm stand 36
// degrees apart around a bore of 20 mm, of which each takes 2 asin(6/20), 34.9 degrees.
TEST(CrossHoles, ThroughAHollowPartDoNotMeetInItsBore) {
  auto document = part();
  auto& hole = document["milling"][0];
  hole["through"] = "part";
  hole["count"] = 5;
  EXPECT_EQ(refused(document), "");
  hole["diameter_mm"] = 6.2;  // 36.1 degrees
  hole.erase("fit");
  EXPECT_EQ(refused(document),
            "/milling/0: got an object, expected a place that does not meet h1-1, h1-2, "
            "h1-3\n");
  // In the solid part of the same cylinder they meet on the axis.
  hole.update({{"diameter_mm", 6}, {"count", 1}, {"at_mm", 55}});
  document["milling"].push_back(hole);
  document["milling"][3].update({{"id", "h4"}, {"angle_deg", 100}});
  EXPECT_EQ(refused(document),
            "/milling/3: got an object, expected a place that does not meet h1\n");
}

TEST(CrossHoles, ProblemsOfAnEntryAreToldOnce) {
  EXPECT_EQ(refused_with("/milling/0/count", 15),
            "/milling/0: got an object, expected a place that does not meet h1-1, h1-2, "
            "h1-3, h1-4, h1-5, h1-6, h1-7, h1-8, h1-9, h1-10, h1-11, h1-12, h1-13, "
            "h1-14\n");
  auto document = part();
  document["milling"][1].update({{"id", "h1"}, {"count", 3}, {"at_mm", 10}});
  EXPECT_EQ(refused(document),
            "/milling/1/id: got \"h1\", expected an id no other milled place has\n");
  // No fit is asked of a drill that there is not, and none of limits that are none.
  EXPECT_EQ(refused_with("/milling/0/tool", "DRILL"),
            "/milling/0/tool: got \"DRILL\", expected a drill of the tools: "
            "\"DRILL-HM-5D\", \"DRILL-HM-8D\", \"DRILL-INDEX-4D\"\n");
  EXPECT_EQ(refused_with("/milling/0/fit", 12),
            "/milling/0/fit: got 12, expected a text of 1 to 8 bytes\n");
  EXPECT_EQ(refused_with("/milling/1/limits_mm", {0.1, 0.05}),
            "/milling/1/limits_mm: got [0.1,0.05], expected [lower, upper] with lower < "
            "upper\n");
}

TEST(CrossHoles, NeedDrivenTools) {
  EXPECT_EQ(refused_with("/machine", "lathe-medium"),
            "/milling: got a list of 3 entries, expected none: lathe-medium has no "
            "driven_tools, as turn-mill has\n");
}

// What they leave open predict takes from the drill, as of all fixed operations.
TEST(CrossHoles, AreReadForPredictToo) {
  auto document = part();
  document["operations"] = json::array();
  for (auto& setup : document["setups"]) setup["clampings"] = {"chuck"};
  EXPECT_EQ(refused(document, Purpose::predict).find("/milling"), std::string::npos)
      << refused(document, Purpose::predict);
}

std::string refused_part(const json& document) {
  const auto text = refused(document);
  return text.substr(0, text.find(':'));
}

TEST(CrossHoles, SchemaAgreesWithTheReaderOnEverySlip) {
  const auto skip = [](const std::string& slip) {  // the hole needs a bore, and a machine
    return slip.starts_with("/inner") || slip == "/machine left out";
  };
  EXPECT_GT(SlipsOf(SchemaCheck("part.json"), refused_part, part(), skip).try_all(), 100);
}

TEST(CrossHoles, ComeBackFromTheirNotation) {
  const auto text = part_notation(part());
  EXPECT_NE(text.find("cross-hole d6 H12 through wall on d2 at 80 angle 10 times 3\n"
                      "cross-hole d5 ±0.1 x 8 on d1 at 20\n"
                      "cross-hole d8 through part on d1 at 40\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace turnwright::document::cross_holes_test
