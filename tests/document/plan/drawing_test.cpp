#include "turnwright/document/drawing.hpp"

#include <gtest/gtest.h>

#include "../schema_check.hpp"
#include "document/json/file.hpp"

namespace turnwright::document::drawing_test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const Catalogue& catalogue() {
  static const auto kAll = load_catalogue(source_path(""));
  return kAll;
}

// A tube of three elements and a bore, held left, then right.
json tube() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "Tube", "material": "C45",
    "stock": {"kind": "tube", "outer_mm": 60, "inner_mm": 20, "length_mm": 84,
              "left_allowance_mm": 3},
    "outer": [{"id": "a", "kind": "cylinder", "length_mm": 30, "diameter_mm": 50},
              {"id": "b", "kind": "cone", "length_mm": 10, "left_mm": 50, "right_mm": 40},
              {"id": "c", "kind": "cylinder", "length_mm": 40, "diameter_mm": 36,
               "fit": "h7", "Ra_um": 1.6}],
    "inner": [{"id": "e", "kind": "cylinder", "from": "right", "length_mm": 25,
               "diameter_mm": 24}],
    "faces": [{"id": "b|c", "Ra_um": 3.2}],
    "tolerances": [{"id": "t", "kind": "length", "between": ["left", "b|c"],
                    "limits_mm": [-0.1, 0.2]}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 30, "clampings": ["chuck"]}]})");
}

ordered_json drawn(const json& request) {
  return drawing(prepared_part(request, catalogue(), "drawing"));
}

ordered_json named(const ordered_json& list, const std::string& id) {
  for (const auto& member : list)
    if (member.at("id") == id) return member;
  ADD_FAILURE() << "no " << id;
  return {};
}

TEST(Drawing, PlacesEverySurface) {
  const auto d = drawn(tube());
  EXPECT_EQ(d.at("length_mm"), 80.0);
  EXPECT_EQ(d.at("stock").at("z_mm"), json({-3.0, 81.0}));
  EXPECT_EQ(d.at("stock").at("inner_mm"), 20.0);
  EXPECT_EQ(named(d.at("elements"), "b").at("z_mm"), json({30.0, 40.0}));
  EXPECT_EQ(named(d.at("elements"), "b").at("diameters_mm"), json({50.0, 40.0}));
  EXPECT_EQ(named(d.at("elements"), "e").at("z_mm"), json({55.0, 80.0}));
  EXPECT_EQ(named(d.at("elements"), "e").at("side"), "inner");
  EXPECT_EQ(named(d.at("faces"), "b|c").at("z_mm"), 40.0);
  EXPECT_EQ(named(d.at("faces"), "right").at("z_mm"), 80.0);
}

TEST(Drawing, RepeatsTheEdges) {
  auto document = document::parse_file(source_path("parts/motor-shaft.json"));
  const auto d = drawn(document);
  const auto seat = named(d.at("elements"), "d2");
  EXPECT_EQ(seat.at("right_undercut"), "E0.8x0.3");
  EXPECT_EQ(seat.at("left_chamfer_mm").at(0), 1);
  EXPECT_FALSE(seat.contains("right_chamfer_mm"));
  EXPECT_EQ(named(d.at("elements"), "d1").at("right_fillet_mm"), 0.8);
}

TEST(Drawing, RepeatsRoundedEdges) {
  auto document = document::parse_file(source_path("parts/motor-shaft.json"));
  document["edges"] = {{{"at", "left"}, {"radius_mm", 1.5}}};
  const auto first = named(drawn(document).at("elements"), "d1");
  EXPECT_EQ(first.at("left_radius_mm"), 1.5);
  EXPECT_FALSE(first.contains("left_chamfer_mm") || first.contains("right_radius_mm"));
}

TEST(Drawing, RepeatsTheTitleBlock) {
  auto document = tube();
  EXPECT_FALSE(drawn(document).contains("drawing_number"));
  document["drawing_number"] = "4711-02";
  document["revision"] = "C";
  document["customer"] = "Works";
  const auto d = drawn(document);
  EXPECT_EQ(d.at("drawing_number"), "4711-02");
  EXPECT_EQ(d.at("revision"), "C");
  EXPECT_EQ(d.at("customer"), "Works");
}

TEST(Drawing, TellsLimitsAndWhoAskedForThem) {
  const auto d = drawn(tube());
  // ISO 286-1: IT7 of 30 to 50 mm is 25 um, h lies below the nominal size.
  const auto size = named(d.at("tolerances"), "c:diameter");
  EXPECT_NEAR(size.at("limits_mm").at(0).get<double>(), -0.025, 1e-12);
  EXPECT_NEAR(size.at("limits_mm").at(1).get<double>(), 0, 1e-12);
  EXPECT_NEAR(size.at("value_mm").get<double>(), 0.025, 1e-12);
  EXPECT_EQ(named(d.at("elements"), "c").at("fit"), "h7");
  EXPECT_EQ(named(d.at("tolerances"), "t").at("between"), json({"left", "b|c"}));
}

TEST(Drawing, TellsJawsAndWhichSetupCutsWhat) {
  const auto d = drawn(tube());
  // 20 mm of the stock, which begins at -3; then 30 mm of the finished part's right end.
  EXPECT_EQ(d.at("setups").at(0).at("jaws_z_mm"), 17.0);
  EXPECT_EQ(d.at("setups").at(1).at("jaws_z_mm"), 50.0);
  EXPECT_FALSE(d.at("setups").at(1).contains("steady_z_mm"));
  auto steadied = tube();
  steadied["setups"][1]["clampings"].push_back("chuck-steady");
  steadied["setups"][1]["steady_mm"] = 20;
  EXPECT_EQ(drawn(steadied).at("setups").at(1).at("steady_z_mm"), 20.0);
  EXPECT_EQ(named(d.at("elements"), "c").at("setup"), 0);
  EXPECT_EQ(named(d.at("elements"), "a").at("setup"), 1);  // it begins in the jaws
  EXPECT_EQ(named(d.at("faces"), "left").at("setup"), 1);
  EXPECT_TRUE(d.at("unreachable").empty());
}

TEST(Drawing, SaysWhatNoSetupCanMake) {
  auto request = tube();
  request["setups"].erase(1);
  const auto d = drawn(request);
  EXPECT_FALSE(named(d.at("elements"), "a").contains("setup"));
  ASSERT_FALSE(d.at("unreachable").empty());
  EXPECT_NE(d.at("unreachable").at(0).get<std::string>().find("a"), std::string::npos);
}

TEST(Drawing, FitsItsSchemaForEveryReferencePart) {
  const SchemaCheck schema("drawing.result.json");
  for (const auto& entry : std::filesystem::directory_iterator(source_path("parts"))) {
    if (entry.path().extension() != ".json") continue;
    auto result = drawn(parse_file(entry.path()));
    result["format"] = "turnwright-drawing-result/1";
    result["turnwright_version"] = "0.1.0";
    result["request_digest"] = std::string(64, '0');
    EXPECT_EQ(schema.fault(json::parse(result.dump())), "") << entry.path();
  }
}

}  // namespace
}  // namespace turnwright::document::drawing_test
