// Milled places of a part document.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "refusal.hpp"

namespace turnwright::document::milling_test {
namespace {

using nlohmann::json;

// A keyway, a flat and a slot on a stepped bar; d1 in the jaws first.
json part() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "keyed", "material": "test-steel",
    "stock": {"kind": "bar", "diameter_mm": 50, "length_mm": 154, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 50, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 50, "diameter_mm": 46},
              {"id": "d3", "kind": "cylinder", "length_mm": 50, "diameter_mm": 36}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 40, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}],
    "milling": [
      {"id": "k1", "kind": "keyway", "on": "d3", "z_mm": 110, "length_mm": 30,
       "width_mm": 10, "depth_mm": 5, "angle_deg": 10, "corner_mm": 0.6,
       "tool": "test-cutter", "setup": 0, "stability_margin": 0.3, "speed_margin": 0.05,
       "conditions": {"passes": 4, "n_rpm": 3000, "fz_mm": 0.03}},
      {"id": "f1", "kind": "flat", "on": "d2", "z_mm": 60, "length_mm": 20,
       "depth_mm": 2, "conditions": {"lanes": 3}},
      {"id": "s1", "kind": "slot", "on": "d1", "z_mm": 0, "length_mm": 15,
       "width_mm": 12, "depth_mm": 4}],
    "objective": "cost", "batch": 10, "rates": {"machine_per_min": 1}})");
}

PreparedDocument load(const json& document, Purpose purpose = Purpose::plan) {
  return prepared_part(document, test_catalogue(), "t", purpose);
}

std::string refused(const json& document) {
  return problems_of(document, test_catalogue());
}

std::string refused_with(const std::string& pointer, const json& value) {
  auto document = part();
  document[json::json_pointer(pointer)] = value;
  return refused(document);
}

TEST(Milling, EveryKeyIsRead) {
  const auto plan = load(part()).part;
  ASSERT_EQ(plan.milled.size(), 3U);
  const auto& k = plan.milled_places[0];
  EXPECT_EQ(k.id, "k1");
  EXPECT_EQ(k.kind, planning::MilledKind::keyway);
  EXPECT_EQ(k.element, 2U);
  EXPECT_EQ(k.z_mm, 110);
  EXPECT_EQ(k.length_mm, 30);
  EXPECT_EQ(k.width_mm, 10);
  EXPECT_EQ(k.depth_mm, 5);
  EXPECT_EQ(k.angle_deg, 10);
  EXPECT_EQ(k.corner_mm, 0.6);
  EXPECT_EQ(k.setup, 0U);
  EXPECT_EQ(k.depth_margin, 0.3);
  EXPECT_EQ(k.speed_margin, 0.05);
  ASSERT_EQ(k.cutters.size(), 1U);
  EXPECT_EQ(k.cutters[0].id, "test-cutter");
  EXPECT_EQ(k.passes, 4);
  EXPECT_EQ(k.n_rpm, 3000);
  EXPECT_EQ(k.fz_mm, 0.03);
  ASSERT_EQ(k.ways.size(), 1U);
  const auto& f = plan.milled_places[1];
  EXPECT_EQ(f.kind, planning::MilledKind::flat);
  EXPECT_NEAR(f.width_mm, 2 * std::sqrt(23.0 * 23 - 21 * 21), 1e-12);
  EXPECT_EQ(f.lanes, 3);
  ASSERT_GT(f.ways.size(), 1U);  // mf is not mc
  for (std::size_t i = 0; i < f.ways.size(); ++i) {
    EXPECT_EQ(f.ways[i].lanes, 3);
    EXPECT_LT(f.ways[i].fz_from_mm, f.ways[i].fz_to_mm);
    if (i > 0) {
      EXPECT_NEAR(f.ways[i].fz_from_mm, f.ways[i - 1].fz_to_mm, 1e-12);
    }
  }
  EXPECT_EQ(plan.milled_places[2].kind, planning::MilledKind::slot);
}

TEST(Milling, WhatIsLeftOutIsAssumed) {
  const auto loaded = load(part());
  const auto assumed = [&](const std::string& pointer) {
    for (const auto& a : loaded.assumed)
      if (a.pointer == pointer) return a.value.dump();
    return std::string("nothing");
  };
  EXPECT_EQ(assumed("/milling/0/setup"), "nothing");
  EXPECT_EQ(assumed("/milling/1/setup"), "0");  // d2 is turned in setup 0
  EXPECT_EQ(assumed("/milling/2/setup"), "1");  // d1 in the jaws in setup 0
  EXPECT_EQ(assumed("/milling/1/stability_margin"), "0.2");
  EXPECT_EQ(assumed("/milling/1/speed_margin"), "0.02");
  EXPECT_EQ(assumed("/milling/1/tool"), "\"any\"");
  EXPECT_EQ(loaded.part.milled_places[1].depth_margin, 0.2);
  EXPECT_EQ(loaded.part.milled_places[1].speed_margin, 0.02);
  EXPECT_EQ(loaded.part.milled_places[2].setup, 1U);
}

// Flats on both sides count together.
TEST(Milling, WeakenedSectionsAreTold) {
  const auto told = [](double depth_mm) {
    auto j = part();
    auto flat = j["milling"][1];
    flat["depth_mm"] = depth_mm;
    j["milling"] = json::array({flat});
    flat["id"] = "other", flat["angle_deg"] = 180 + flat.value("angle_deg", 0.0);
    j["milling"].push_back(flat);
    std::string all;
    for (const auto& a : load(j).assumed)
      if (a.pointer.ends_with("depth_mm")) all += a.why + "\n";
    return all;
  };
  EXPECT_EQ(told(0.5), "");
  const double R = 23, h = 17, a = std::acos(h / R);
  const double I = std::numbers::pi * std::pow(R, 4) / 4;
  const double segment = std::pow(R, 4) / 4 * (a - std::sin(4 * a) / 4);  // int x^2 dA
  const double left = 1 - 2 * segment / I;
  const auto sentence = "the section keeps " +
                        std::to_string(static_cast<int>(100 * left)) +
                        " % of its stiffness here, which later cuts do not count\n";
  EXPECT_EQ(told(R - h), sentence + sentence);
}

TEST(Milling, ShapesThatCannotBeAreRefused) {
  EXPECT_EQ(refused_with("/milling/0/conditions/n_rpm", 0.001),
            "/milling/0/conditions/n_rpm: got 0.001, expected a number from 45 to 5500 "
            "1/min\n");
  EXPECT_EQ(refused_with("/milling/0/z_mm", 95),
            "/milling/0/z_mm: got 95, expected a place on d3, from 100 mm to 150 mm\n");
  EXPECT_EQ(refused_with("/milling/0/length_mm", 41),
            "/milling/0/length_mm: got 41, expected at most 40 mm, to the end of d3\n");
  EXPECT_EQ(refused_with("/milling/0/length_mm", 9),
            "/milling/0/length_mm: got 9, expected at least its width, 10 mm\n");
  EXPECT_EQ(refused_with("/milling/0/depth_mm", 18),
            "/milling/0/depth_mm: got 18, expected less than the radius of d3, 18 mm\n");
  EXPECT_EQ(refused_with("/milling/0/width_mm", 36),
            "/milling/0/width_mm: got 36, expected less than the diameter of d3, 36 mm\n"
            "/milling/0/length_mm: got 30, expected at least its width, 36 mm\n");
  EXPECT_EQ(refused_with("/milling/0/depth_mm", 0.5)
                .find("/milling/0/depth_mm: got 0.5, "
                      "expected a floor below the "
                      "edges, more than 0.70"),
            0U);
  auto bored = part();
  bored["stock"] = {{"kind", "tube"},
                    {"outer_mm", 50},
                    {"inner_mm", 26},
                    {"length_mm", 154},
                    {"left_allowance_mm", 2}};
  EXPECT_EQ(refused(bored),
            "/milling/0/depth_mm: got 5, expected less than the wall over the hole, 5 "
            "mm\n");
}

TEST(Milling, IdsElementsAndPlacesAreOnesOwn) {
  EXPECT_EQ(refused_with("/milling/1/id", "k1"),
            "/milling/1/id: got \"k1\", expected an id no other milled place has\n");
  EXPECT_EQ(refused_with("/milling/1/id", "d2"),
            "/milling/1/id: got \"d2\", expected an id no element or face has\n");
  EXPECT_EQ(refused_with("/milling/1/on", "d4"),
            "/milling/1/on: got \"d4\", expected an outer cylinder (did you mean "
            "\"d1\"?)\n");
  auto meeting = part();
  meeting["milling"][1] = {{"id", "k2"},    {"kind", "keyway"}, {"on", "d3"},
                           {"z_mm", 120},   {"length_mm", 20},  {"width_mm", 10},
                           {"depth_mm", 5}, {"angle_deg", 30}};
  EXPECT_EQ(refused(meeting),
            "/milling/1: got an object, expected a place that does not meet k1\n");
  meeting["milling"][1]["angle_deg"] = 190;
  EXPECT_EQ(refused(meeting), "");
}

TEST(Milling, SetupsThatCannotMillItAreRefused) {
  EXPECT_EQ(refused_with("/milling/0/setup", 1),
            "/milling/0/setup: got 1, expected a setup that can mill k1: in this one the "
            "jaws hold the part up to z = 110 mm\n");
  EXPECT_EQ(refused_with("/milling/2/setup", 0),
            "/milling/2/setup: got 0, expected a setup that can mill s1: in this one d1 "
            "is turned in setup 2 only\n");
  auto held = part();
  held["setups"].erase(1);
  EXPECT_NE(refused(held).find("/milling/2: got an object, expected a place that some "
                               "setup leaves free once d1 is turned"),
            std::string::npos);
}

TEST(Milling, AMachineWithoutDrivenToolsMillsNothing) {
  auto document = part();
  auto lathe = parse_file(source_path("tests/data/catalogue/machines/lathe-medium.json"));
  lathe.erase("driven_tools");
  lathe["id"] = "plain";
  document["machine"] = lathe;
  EXPECT_EQ(
      refused(document),
      "/milling: got a list of 3 entries, expected none: plain has no driven_tools, "
      "as lathe-medium has\n");
}

TEST(Milling, CuttersOfTheToolsListAreTheChoice) {
  auto document = part();
  auto own =
      parse_file(source_path("tests/data/catalogue/tools/milling/test-cutter.json"));
  own["id"] = "own";
  document["tools"] = {"test-rougher", own};
  EXPECT_EQ(load(document).part.milled_places[1].cutters.size(), 1U);
  EXPECT_EQ(load(document).part.milled_places[1].cutters[0].id, "own");
  document["tools"] = {"test-rougher", "test-cutter", "test-cutter"};
  EXPECT_EQ(refused(document),
            "/tools/2: got \"test-cutter\", expected each tool once\n");
  EXPECT_EQ(refused_with("/milling/0/tool", "test-cuter"),
            "/milling/0/tool: got \"test-cuter\", expected a milling cutter of the "
            "catalogue (did you mean \"test-cutter\"?)\n");
}

TEST(Milling, PredictNeedsEverything) {
  auto document = part();
  document["operations"] = json::array();
  try {
    load(document, Purpose::predict);
    FAIL();
  } catch (const InputError& error) {
    const std::string all = error.what();
    for (const auto* pointer : {"/milling/1/tool", "/milling/1/conditions/passes",
                                "/milling/1/conditions/n_rpm",
                                "/milling/1/conditions/fz_mm", "/milling/2/conditions"})
      EXPECT_NE(all.find(pointer), std::string::npos) << pointer << all;
    EXPECT_EQ(all.find("/milling/0"), std::string::npos) << all;
  }
}

std::string refused_part(const json& document) {
  const auto text = refused(document);
  return text.substr(0, text.find(':'));
}

TEST(Milling, SchemaAgreesWithTheReaderOnEverySlip) {
  EXPECT_GT(SlipsOf(SchemaCheck("part.json"), refused_part, part()).try_all(), 100);
}

// A hexagon of 30 mm on 36 mm lies 3 mm below the rim, at every 60 deg.
TEST(Milling, SeveralPlacesAreAlikeAtEqualAngles) {
  auto document = part();
  document["milling"] = json::parse(R"([
    {"id": "sw", "kind": "flat", "on": "d3", "z_mm": 105, "length_mm": 20,
     "across_flats_mm": 30, "count": 6, "angle_deg": 15},
    {"id": "s1", "kind": "slot", "on": "d1", "z_mm": 0, "length_mm": 15, "width_mm": 12,
     "depth_mm": 4, "count": 2}])");
  const auto plan = load(document).part;
  ASSERT_EQ(plan.milled_places.size(), 8U);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& m = plan.milled_places[i];
    EXPECT_EQ(m.id, "sw-" + std::to_string(i + 1));
    EXPECT_EQ(m.entry, 0U);
    EXPECT_NEAR(m.depth_mm, 3, 1e-12);
    EXPECT_NEAR(m.angle_deg, 15 + 60.0 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(m.ways.size(), plan.milled_places[0].ways.size());
  }
  EXPECT_EQ(plan.milled_places[7].id, "s1-2");
  EXPECT_EQ(plan.milled_places[7].angle_deg, 180);
}

TEST(Milling, FlatsAcrossHaveOppositeOnesAndOthersMayNotMeet) {
  auto document = part();
  auto& flat = document["milling"][1];
  flat.erase("depth_mm");
  flat["across_flats_mm"] = 40;
  flat["count"] = 3;
  EXPECT_NE(refused(document).find("/milling/1/across_flats_mm: got 40, expected an even "
                                   "count"),
            std::string::npos)
      << refused(document);
  flat["count"] = 2;
  flat["across_flats_mm"] = 46;
  EXPECT_NE(refused(document).find("less than the diameter, 46 mm"), std::string::npos)
      << refused(document);
  flat["across_flats_mm"] = 40;
  flat["depth_mm"] = 3;
  EXPECT_NE(refused(document).find("depth_mm or across_flats_mm, not both"),
            std::string::npos)
      << refused(document);
  document = part();
  document["milling"][2]["count"] = 12;  // of 12 mm on 40 mm
  EXPECT_NE(refused(document).find("a place that does not meet s1-1"), std::string::npos)
      << refused(document);
}

}  // namespace
}  // namespace turnwright::document::milling_test
