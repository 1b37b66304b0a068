#include "turnwright/document/import.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "../slips.hpp"
#include "document/exchange/outline.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/exchange/notation.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::document::import_test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const Catalogue& shop() {
  static const Catalogue kShop = load_catalogue(source_path(""));
  return kShop;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("import.request.json"), kPart("part.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = import(request, shop());
  EXPECT_EQ(kPart.fault(result["part"]), "") << result["part"];
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { import(r, shop()); }, request);
}

json line(const std::string& text) { return {{"text", text}, {"material", "C45"}}; }

TEST(Import, ALineOfTextIsAPart) {
  const json part = answered(line("d50 h7 x 40 Ra1.6; 1x45; d30 k6 x 32"))["part"];
  EXPECT_EQ(part["outer"], json::parse(R"([
    {"id": "d1", "kind": "cylinder", "length_mm": 40.0, "diameter_mm": 50.0,
     "fit": "h7", "Ra_um": 1.6},
    {"id": "d2", "kind": "cylinder", "length_mm": 32.0, "diameter_mm": 30.0,
     "fit": "k6"}])"));
  EXPECT_EQ(part["edges"], json::parse(R"([{"at": "d1|d2", "chamfer_mm": 1.0}])"));
  EXPECT_EQ(part["stock"], json::parse(R"({"kind": "bar", "diameter_mm": 52.0,
    "length_mm": 76.0, "left_allowance_mm": 2.0})"));
  EXPECT_EQ(part["general"], "ISO 2768-mK");
  EXPECT_EQ(part["choose"], json::parse(R"({"setups": "auto"})"));
}

// What a reference part's drawing says comes back from its notation, named anew.
TEST(Import, ReferencePartsComeBackFromTheirNotation) {
  for (const auto& entry : std::filesystem::directory_iterator(source_path("parts"))) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    const json document = parse_file(entry.path());
    const auto outline = outline_of_part(document);
    const auto text = exchange::notation(outline);
    const json part = answered({{"text", text},
                                {"stock", document["stock"]},
                                {"machine", document["machine"]}})["part"];
    const auto again = outline_of_part(part);
    EXPECT_EQ(exchange::notation(again), text);
    ASSERT_EQ(again.outer.size(), outline.outer.size());
    for (std::size_t i = 0; i < again.outer.size(); ++i) {
      EXPECT_EQ(again.outer[i].length_mm, outline.outer[i].length_mm);
      EXPECT_EQ(again.outer[i].left_mm, outline.outer[i].left_mm);
      EXPECT_EQ(again.outer[i].right_mm, outline.outer[i].right_mm);
    }
    EXPECT_EQ(again.tolerances.size(), outline.tolerances.size());
    EXPECT_NO_THROW(prepared_part(part, shop(), "part"));
  }
}

// What the drawing does not say stands in the document: how the part is held, the shop.
json with_the_shop_of(const json& document, json part) {
  static const std::set<std::string> kDrawn{
      "name",  "material",   "outer",   "inner",   "edges",
      "faces", "tolerances", "general", "milling", "centre_holes"};
  part.erase("choose");
  for (const auto& [key, value] : document.items())
    if (!kDrawn.contains(key)) part[key] = value;
  return part;
}

double cost(const json& document) {
  const auto plan = planning::plan(prepared_part(document, shop(), "part").part);
  EXPECT_EQ(plan.status, planning::PlanStatus::ok);
  return plan.cost_per_part;
}

// AP242 with PMI: the file says all that the document says of the part.
TEST(Import, Ap242FilesArePlannedAtTheCostOfTheirDocuments) {
  for (const std::string name :
       {"gearbox-input-shaft", "motor-shaft", "threaded-spindle"}) {
    SCOPED_TRACE(name);
    const json document = parse_file(source_path("parts/" + name + ".json"));
    std::ifstream file(source_path("tests/data/step/pmi/" + name + ".stp"));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const json result = answered({{"text", text}});
    EXPECT_TRUE(result["ignored"].empty()) << result["ignored"];
    const json& part = result["part"];
    EXPECT_EQ(part["material"], document["material"]);
    EXPECT_EQ(part["tolerances"].size(), document["tolerances"].size());
    const double expected = cost(document);
    EXPECT_NEAR(cost(with_the_shop_of(document, part)), expected, 1e-9 * expected);
  }
}

std::string step_of(const std::string& name) {
  std::ifstream file(source_path("tests/data/step/features/" + name + ".step"));
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Import, CentreHolesOfAShapeAreThoseOfThePart) {
  const json result = answered({{"text", step_of("centred-shaft")}, {"material", "C45"}});
  EXPECT_TRUE(result["ignored"].empty()) << result["ignored"];
  const auto drawing = prepared_part(result["part"], shop(), "part").part.drawing;
  ASSERT_TRUE(drawing.left_centre && drawing.right_centre);
  EXPECT_EQ(part::designation(*drawing.left_centre), "ISO 6411-B4/12.5");
  EXPECT_EQ(part::designation(*drawing.right_centre), "ISO 6411-R4/8.5");
  EXPECT_NE(part_notation(result["part"]).find("centre left B4/12.5"), std::string::npos);
}

TEST(Import, UndercutsBehindThreadsAreThoseOfThePart) {
  std::ifstream file(source_path("tests/data/dxf/threaded-shaft-half.dxf"));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const json result = answered({{"text", text}, {"material", "C45"}});
  const auto drawing = prepared_part(result["part"], shop(), "part").part.drawing;
  ASSERT_TRUE(drawing.outer[0].right_undercut && drawing.outer[2].left_undercut);
  EXPECT_EQ(drawing.outer[0].right_undercut->width_mm, 5.2);
  EXPECT_EQ(drawing.outer[2].left_undercut->pitch_mm, 3.5);
  EXPECT_NE(part_notation(result["part"]).find("DIN76-B"), std::string::npos);
}

TEST(Import, WritesThePartThatItsOutlineIsReadFrom) {
  for (const auto& entry : std::filesystem::directory_iterator(source_path("parts"))) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path());
    const json document = parse_file(entry.path());
    const json members = part_members(outline_of_part(document));
    for (const char* key : {"inner", "edges", "faces", "tolerances", "milling"})
      EXPECT_EQ(members.value(key, json()), document.value(key, json())) << key;
  }
}

TEST(Import, TheBytesInBase64AreTheSameDrawing) {
  const json text = answered(line("d50 x 40"))["part"];
  const json base64 =
      answered({{"base64", "ZDUw\nIHggNDA="}, {"material", "C45"}})["part"];
  EXPECT_EQ(base64, text);
  EXPECT_EQ(refused({{"base64", "ZDUwIHggNDA"}, {"material", "C45"}}),
            "import: /base64: got \"ZDUwIHggNDA\", expected base64 (RFC 4648) of the "
            "drawing's bytes");
}

TEST(Import, BytesThatAreNoTextGoInBase64) {
  EXPECT_EQ(import_request("d50 x 40"), (json{{"text", "d50 x 40"}}));
  EXPECT_EQ(import_request("d50 x 40\xE9"), (json{{"base64", "ZDUwIHggNDDp"}}));
}

TEST(Import, ADrawingNamesItsMaterial) {
  const json result = answered({{"text", "d50 x 40; material: 42 CrMo 4 A"}});
  EXPECT_EQ(result["part"]["material"], "42CrMo4-A");
  const json numbered = answered({{"text", "d50 x 40; material: 1.0503"}});
  EXPECT_EQ(numbered["part"]["material"], "C45");
  const auto several = refused({{"text", "d50 x 40; material: 1.7225"}});
  EXPECT_NE(several.find("/material: got nothing, expected for the drawing's \"1.7225\" "
                         "one of the materials that are called so: \"42CrMo4-A\""),
            std::string::npos)
      << several;
  const auto none = refused({{"text", "d50 x 40"}});
  EXPECT_EQ(none.rfind("import: /material: got nothing, expected a material, which the "
                       "drawing does not name",
                       0),
            0u)
      << none;
  const auto unknown = refused({{"text", "d50 x 40; material: Kryptonite"}});
  EXPECT_NE(unknown.find("for the drawing's \"Kryptonite\""), unknown.npos) << unknown;
}

// Its tap's countersink was sought at the end of a part without elements.
TEST(Import, ATappedBoreWithoutAPartAroundItIsTold) {
  for (const char* text : {"bore M5 x 2", "bore left M4 x 4"}) {
    const json ignored = import(line(text), shop())["ignored"];
    ASSERT_FALSE(ignored.empty()) << text;
    EXPECT_EQ(ignored[0]["at"], "/outer") << text;
  }
}

TEST(Import, MistakesInTheDrawingStandAtTheDrawing) {
  const auto wrong = refused(line("d50 x 4O; d30 y"));
  EXPECT_EQ(wrong.rfind("import: /text: got line 1, column", 0), 0u) << wrong;
  EXPECT_NE(wrong.find('\n'), wrong.npos) << "both mistakes: " << wrong;
  EXPECT_EQ(refused({{"material", "C45"}}),
            "import: document: got no drawing, expected \"text\" with the drawing, or "
            "\"base64\" with its bytes");
  EXPECT_NE(refused(line("")), "");
}

TEST(Import, WhatThePlannerRefusesIsToldAtOnce) {
  json request = line("d50 x 40");
  request["stock"] = {{"kind", "bar"}, {"diameter_mm", 49}, {"length_mm", 44}};
  request["machine"] = "lathe-unknown";
  const auto wrong = refused(request);
  EXPECT_NE(wrong.find("import: /stock/diameter_mm: got 49"), wrong.npos) << wrong;
  EXPECT_NE(wrong.find("import: /machine: got \"lathe-unknown\""), wrong.npos) << wrong;
  const json ignored = answered(line("d50 x 40 h7; 30x45; d30 x 20"))["ignored"];
  ASSERT_EQ(ignored.size(), 1u) << ignored;
  EXPECT_EQ(ignored[0]["at"], "/edges/0/chamfer_mm");
}

TEST(Import, APartOfOneDiameterIsPartedOffABar) {
  const json stock = answered(line("d30 x 60; left: 1x45"))["part"]["stock"];
  EXPECT_EQ(stock, json::parse(R"({"kind": "bar", "diameter_mm": 32.0,
    "length_mm": 102.0, "left_allowance_mm": 40.0, "part_off_allowance_mm": 0.6})"));
}

TEST(Import, APartOfWhatStaysAsTheBarIsIsMadeOfThatBar) {
  const auto whole = answered(line("stock hex27 x 14; 1x45; d20 x 30"));
  EXPECT_EQ(whole["part"]["stock"], json::parse(R"({"kind": "hexagon",
    "across_flats_mm": 27.0, "length_mm": 48.0, "left_allowance_mm": 2.0})"));
  EXPECT_EQ(whole["ignored"], json::array());

  const auto mixed = answered(line("stock hex27 x 14; d20 x 30; stock square27 x 9"));
  EXPECT_EQ(mixed["part"]["stock"]["kind"], "hexagon");
  EXPECT_EQ(mixed["ignored"][0]["text"],
            "d3 keeps another bar than d1, of which the part is made.");
}

TEST(Import, ABarHoldsTheBulgeOfAnArc) {
  // Centre (10, 15), radius hypot(10, 5): the top is at 15 + 11.18.
  const json part =
      answered(line("d40 x 30; arc d40-d40 x 20 R11.180339887 convex"))["part"];
  EXPECT_EQ(part["stock"]["diameter_mm"], 55) << part;
}

TEST(Import, AnotherMaterialThanTheDrawingsIsTold) {
  const json a =
      answered({{"text", "d50 x 40; material: 42CrMo4-A"}, {"material", "C45"}});
  EXPECT_EQ(a["part"]["material"], "C45");
  EXPECT_EQ(a["assumed"][0]["text"],
            "The request's material is taken, not the drawing's 42CrMo4-A.");
}

TEST(Import, TheNextBarLeavesAMillimetre) {
  for (const auto& [largest, bar] :
       std::map<double, double>{{50, 52}, {51, 52}, {51.5, 55}, {250, 260}, {5, 6}}) {
    const json part =
        answered(line("d" + std::to_string(largest) + " x 40; d4 x 10"))["part"];
    EXPECT_EQ(part["stock"]["diameter_mm"], bar) << largest;
  }
}

}  // namespace
}  // namespace turnwright::document::import_test
