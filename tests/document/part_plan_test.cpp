#include "turnwright/document/part_plan.hpp"

#include <gtest/gtest.h>

#include "schema_check.hpp"
#include "turnwright/document/file.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using part::ToleranceKind;

json full() { return parse_file(source_path("tests/data/every_key_of_a_part.json")); }

// Stock, three lengths and the material: the rest is assumed.
json smallest() {
  auto document = full();
  return {{"material", document["material"]},
          {"stock", {{"kind", "bar"}, {"diameter_mm", 50}, {"length_mm", 165}}},
          {"outer", document["outer"]}};
}

const Catalogue& test_catalogue() {
  static const auto kCatalogue = load_catalogue(source_path("tests/data/catalogue"));
  return kCatalogue;
}

LoadedPart load(const json& document, Purpose purpose = Purpose::plan) {
  return load_part_plan(document, test_catalogue(), "t", purpose);
}

std::string refusal(const json& document, Purpose purpose = Purpose::plan) {
  try {
    load(document, purpose);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const part::Tolerance* find(const part::Drawing& drawing, const std::string& id) {
  for (const auto& t : drawing.tolerances)
    if (t.id == id) return &t;
  return nullptr;
}

const Assumption* assumed(const LoadedPart& loaded, const std::string& pointer) {
  for (const auto& a : loaded.assumed)
    if (a.pointer == pointer) return &a;
  return nullptr;
}

TEST(PartPlan, EveryFieldComesFromItsKey) {
  const auto loaded = load(full());
  const auto& plan = loaded.plan;
  const auto& d = plan.drawing;
  EXPECT_EQ(d.name, "Shaft that uses every key");
  EXPECT_EQ(d.stock.kind, part::StockKind::bar);
  EXPECT_EQ(d.stock.outer_mm, 50);
  EXPECT_EQ(d.stock.inner_mm, 0);
  EXPECT_EQ(d.stock.length_mm, 166);
  EXPECT_EQ(d.stock.left_allowance_mm, 2);
  ASSERT_EQ(d.outer.size(), 4U);
  EXPECT_EQ(d.outer[0].id, "d1");
  EXPECT_EQ(d.outer[0].length_mm, 40);
  EXPECT_EQ(d.outer[0].left_mm, 30);
  EXPECT_EQ(d.outer[0].right_mm, 30);
  EXPECT_EQ(d.outer[0].fit, "k6");
  EXPECT_EQ(d.outer[0].Ra_um, 0.8);
  EXPECT_EQ(d.outer[0].Rz_um, 4);
  EXPECT_EQ(d.outer[1].kind, part::ElementKind::cone);
  EXPECT_EQ(d.outer[1].left_mm, 30);
  EXPECT_EQ(d.outer[1].right_mm, 40);
  EXPECT_EQ(d.outer[1].Rz_um, std::nullopt);
  EXPECT_EQ(d.outer[2].limits->lower_mm, -0.025);
  EXPECT_EQ(d.outer[2].limits->upper_mm, 0);
  ASSERT_EQ(d.faces.size(), 2U);
  EXPECT_EQ(d.faces[1].id, "d2|d3");
  EXPECT_EQ(d.faces[1].Rz_um, 10);
  EXPECT_EQ(d.faces[1].Ra_um, std::nullopt);
  EXPECT_EQ(plan.material.id, "test-steel");
  EXPECT_EQ(plan.machine.id, "lathe-medium");
  ASSERT_EQ(plan.tools.size(), 1U);
  EXPECT_EQ(plan.tools[0].id, "test-rougher");
  ASSERT_EQ(plan.setups.size(), 2U);
  EXPECT_EQ(plan.setups[0].hold, part::End::left);
  EXPECT_EQ(plan.setups[1].hold, part::End::right);
  EXPECT_EQ(plan.setups[0].grip_mm, 30);
  EXPECT_EQ(plan.setups[1].grip_mm, 35);
  using enum planning::Clamping;
  EXPECT_EQ(plan.setups[0].clampings, (std::vector{chuck, chuck_tailstock}));
  EXPECT_EQ(plan.objective, planning::Objective::profit);
  EXPECT_EQ(plan.batch, 50);
  EXPECT_EQ(plan.machine_per_min, 1.2);
  EXPECT_EQ(plan.price, 40);
  EXPECT_EQ(plan.machine_share_um, 1);
  EXPECT_EQ(plan.conformance, 0.9973);
  EXPECT_EQ(plan.window_percent, 8);
  EXPECT_EQ(plan.damping_ratio, 0.04);
  EXPECT_EQ(assumed(loaded, "/damping_ratio"), nullptr);
}

// The part's own, else the machine's, else 0.03.
TEST(PartPlan, DampingIsTheMachinesWhereThePartSaysNone) {
  auto document = smallest();
  document["machine"] =
      parse_file(source_path("tests/data/catalogue/machines/lathe-medium.json"));
  document["machine"]["stiffness"]["damping_ratio"] = 0.05;
  const auto loaded = load(document);
  EXPECT_EQ(loaded.plan.damping_ratio, 0.05);
  EXPECT_EQ(assumed(loaded, "/damping_ratio")->why, "the machine's own");
  document["damping_ratio"] = 0.02;
  EXPECT_EQ(load(document).plan.damping_ratio, 0.02);
}

TEST(PartPlan, OperationsKeepWhatIsFixedAndLeaveTheRestOpen) {
  const auto loaded = load(full());
  const auto& ops = loaded.plan.operations.value();
  ASSERT_EQ(ops.size(), 3U);
  EXPECT_EQ(ops[0].kind, planning::OperationKind::face);
  EXPECT_EQ(ops[0].on, std::vector<std::string>{"right"});
  EXPECT_EQ(ops[0].direction, planning::Direction::to_chuck);
  EXPECT_NE(assumed(loaded, "/operations/0/direction"), nullptr);
  EXPECT_EQ(ops[1].id, "op2");
  EXPECT_EQ(ops[1].setup, 0U);
  EXPECT_EQ(ops[1].kind, planning::OperationKind::rough);
  EXPECT_EQ(ops[1].tool, "test-rougher");
  EXPECT_EQ(ops[1].direction, planning::Direction::from_chuck);
  EXPECT_EQ(ops[1].conditions.passes, 2);
  EXPECT_EQ(ops[1].conditions.ap_mm, 1.5);
  EXPECT_EQ(ops[1].conditions.f_mm_rev, 0.3);
  EXPECT_EQ(ops[1].conditions.vc_m_min, 200);
  EXPECT_EQ(ops[2].setup, 1U);
  EXPECT_EQ(ops[2].kind, planning::OperationKind::finish);
  EXPECT_EQ(ops[2].tool, std::nullopt);
  EXPECT_EQ(ops[2].conditions.ap_mm, std::nullopt);
  EXPECT_EQ(ops[2].conditions.vc_m_min, 250);
}

TEST(PartPlan, SizesBecomeTolerancesOnce) {
  const auto loaded = load(full());
  const auto& d = loaded.plan.drawing;
  // Listed, one a diameter, overall length, form by ISO 2768-K.
  EXPECT_EQ(d.tolerances.size(), 5U + 4U + 1U + 2U);
  // ISO 286: 30 k6 = +2 .. +15 um.
  const auto* fit = find(d, "d1:diameter");
  ASSERT_NE(fit, nullptr);
  EXPECT_EQ(fit->kind, ToleranceKind::diameter);
  EXPECT_EQ(fit->of, "d1");
  EXPECT_DOUBLE_EQ(fit->limits->lower_mm, 0.002);
  EXPECT_DOUBLE_EQ(fit->limits->upper_mm, 0.015);
  EXPECT_DOUBLE_EQ(fit->value_mm, 0.013);
  EXPECT_DOUBLE_EQ(find(d, "d2:diameter")->value_mm, 0.025);
  EXPECT_EQ(assumed(loaded, "/outer/0/limits_mm"), nullptr);  // drawn, not assumed
  // ISO 2768-m: +-0.2 over 6 to 30 mm, +-0.3 over 30 to 120, +-0.5 over 120 to 400.
  EXPECT_EQ(find(d, "c1:diameter")->limits->upper_mm, 0.2);
  EXPECT_EQ(find(d, "d3:diameter")->limits->lower_mm, -0.3);
  EXPECT_EQ(assumed(loaded, "/outer/3/limits_mm")->value, json({-0.3, 0.3}));
  EXPECT_EQ(assumed(loaded, "/outer/3/limits_mm")->why, "ISO 2768-mK");
  const auto* length = find(d, "part:length");
  ASSERT_NE(length, nullptr);
  EXPECT_EQ(length->between, (std::array<std::string, 2>{"left", "right"}));
  EXPECT_EQ(length->limits->upper_mm, 0.5);
}

// ISO 2768-2, class K: 0.2 mm straight over 30 to 100 mm, 0.1 mm flat up to 30 mm across.
TEST(PartPlan, GeneralFormIsAskedWhereNothingHoldsItAsClosely) {
  const auto loaded = load(full());
  const auto& d = loaded.plan.drawing;
  // d3 may vary by 0.3 mm of its radius over its 42 mm; d1 and d2 by far less; c1 and the
  // right face have closer zones.
  ASSERT_NE(find(d, "d3:straightness"), nullptr);
  EXPECT_EQ(find(d, "d3:straightness")->kind, ToleranceKind::straightness);
  EXPECT_EQ(find(d, "d3:straightness")->value_mm, 0.2);
  for (const char* id :
       {"d1:straightness", "d2:straightness", "c1:straightness", "right:flatness"})
    EXPECT_EQ(find(d, id), nullptr) << id;
  EXPECT_EQ(find(d, "left:flatness")->value_mm, 0.1);
  EXPECT_EQ(assumed(loaded, "/tolerances")->why, "ISO 2768-mK");
  auto coarser = full();
  coarser["general"] = "ISO 2768-K";  // form alone: no size is asked of d3
  EXPECT_NE(find(load(coarser).plan.drawing, "d3:straightness"), nullptr);
  EXPECT_EQ(find(load(coarser).plan.drawing, "d3:diameter"), nullptr);
  coarser["general"] = "ISO 2768-m";
  EXPECT_EQ(find(load(coarser).plan.drawing, "d3:straightness"), nullptr);
}

TEST(PartPlan, JawForcesAreThoseGivenOrTheChucks) {
  auto document = full();
  EXPECT_EQ(load(document).plan.setups[0].grip_force_N, std::nullopt);
  document["setups"][0]["grip_force_N"] = 20000;
  document["setups"][0]["finishing_grip_force_N"] = 8000;
  const auto loaded = load(document);
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  EXPECT_EQ(loaded.plan.setups[0].grip_force_N, 20000);
  EXPECT_EQ(loaded.plan.setups[0].finishing_grip_force_N, 8000);
}

TEST(PartPlan, TheBudgetKeepsWhatIsGiven) {
  auto document = full();
  document["budget"] = {
      {"drift_um", 1},      {"drift_axial_um", 2},         {"repeatability_um", 3},
      {"part_warm_K", 4},   {"life_between_offsets", 0.5}, {"wear_land_mm", 0.2},
      {"rechucking_um", 6}, {"measurement_U_um", 7}};
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  const auto& shop = load(document).plan.shop;
  EXPECT_EQ(shop.drift_um, 1);
  EXPECT_EQ(shop.drift_axial_um, 2);
  EXPECT_EQ(shop.repeatability_um, 3);
  EXPECT_EQ(shop.part_warm_K, 4);
  EXPECT_EQ(shop.life_between_offsets, 0.5);
  EXPECT_EQ(shop.wear_land_mm, 0.2);
  EXPECT_EQ(shop.rechucking_um, 6);
  EXPECT_EQ(shop.measurement_U_um, 7);
  document["budget"] = {{"drift_um", 1}};
  EXPECT_EQ(load(document).plan.shop.wear_land_mm, 0.3);
}

TEST(PartPlan, AListedSizeTakesTheGeneralOnesPlace) {
  auto document = full();
  document["tolerances"] = {{{
                                 "id",
                                 "s",
                             },
                             {"kind", "diameter"},
                             {"of", "d3"},
                             {"limits_mm", {-0.1, 0}}},
                            {{"id", "l"},
                             {"kind", "length"},
                             {"between", {"right", "left"}},
                             {"limits_mm", {0, 1}}}};
  const auto loaded = load(document);
  const auto& d = loaded.plan.drawing;
  EXPECT_EQ(find(d, "d3:diameter"), nullptr);
  EXPECT_EQ(find(d, "part:length"), nullptr);
  EXPECT_EQ(find(d, "s")->value_mm, 0.1);
  EXPECT_EQ(d.outer[3].limits->lower_mm, -0.1);
  document.erase("general");
  EXPECT_EQ(find(load(document).plan.drawing, "c1:diameter"), nullptr);  // stays open
}

TEST(PartPlan, ListedTolerancesKeepFeatureDatumAndWidth) {
  const auto loaded = load(full());
  const auto& d = loaded.plan.drawing;
  EXPECT_EQ(find(d, "t2")->kind, ToleranceKind::perpendicularity);
  EXPECT_EQ(find(d, "t2")->of, "right");
  EXPECT_EQ(find(d, "t2")->datum, "d2");
  EXPECT_EQ(find(d, "t2")->value_mm, 0.01);
  EXPECT_EQ(find(d, "t3")->between, (std::array<std::string, 2>{"left", "d2|d3"}));
  EXPECT_DOUBLE_EQ(find(d, "t3")->value_mm, 0.1);
  EXPECT_EQ(find(d, "t4")->kind, ToleranceKind::profile);
  EXPECT_EQ(find(d, "t5")->kind, ToleranceKind::profile_without_datum);
  EXPECT_EQ(assumed(loaded, "/tolerances/4/kind")->value, "profile-without-datum");
}

TEST(PartPlan, TheSmallestDocumentTellsEveryDefaultUsed) {
  const auto document = smallest();
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  const auto loaded = load(document);
  json told = json::object();
  for (const auto& a : loaded.assumed) {
    EXPECT_FALSE(a.why.empty()) << a.pointer;
    told[a.pointer] = a.value;
  }
  // 165 mm stock for 162 mm; jaws on 50 mm stock, then on the finished 46 mm.
  const json all{"chuck", "chuck-tailstock", "between-centres"};
  EXPECT_EQ(told, json({{"/name", "part"},
                        {"/machine", "lathe-medium"},
                        {"/tools", {"test-rougher"}},
                        {"/stock/left_allowance_mm", 1.5},
                        {"/setups",
                         {{{"hold", "left"}, {"grip_mm", 25.0}, {"clampings", all}},
                          {{"hold", "right"}, {"grip_mm", 23.0}, {"clampings", all}}}},
                        {"/operations", "auto"},
                        {"/objective", "cost"},
                        {"/batch", 1},
                        {"/rates/machine_per_min", 1.0},
                        {"/machine_share_um", 0.0},
                        {"/budget", json::object()},
                        {"/robust", false},
                        {"/window_percent", 5.0},
                        {"/damping_ratio", 0.03},
                        {"/conformance", 0.9973}}));
  EXPECT_EQ(loaded.plan.drawing.stock.left_allowance_mm, 1.5);
  EXPECT_EQ(loaded.plan.setups[1].grip_mm, 23);
  EXPECT_EQ(loaded.plan.setups[1].clampings.size(), 3U);
  EXPECT_EQ(loaded.plan.machine_per_min, 1);
  EXPECT_EQ(loaded.plan.batch, 1);
  EXPECT_FALSE(loaded.plan.operations.has_value());
}

TEST(PartPlan, WhatWasAssumedMayBeWrittenDown) {
  // Every assumption put where its pointer says gives the same plan without assumptions.
  auto document = smallest();
  for (const auto& a : load(document).assumed)
    document[json::json_pointer(a.pointer)] = a.value;
  const auto again = load(document);
  EXPECT_TRUE(again.assumed.empty());
  EXPECT_EQ(again.plan.setups[0].grip_mm, 25);
}

TEST(PartPlan, AThinPartIsHeldByAtLeast15mm) {
  auto document = smallest();
  document["stock"]["diameter_mm"] = 24;
  document["outer"] = {
      {{"id", "d"}, {"kind", "cylinder"}, {"length_mm", 80}, {"diameter_mm", 20}}};
  const auto loaded = load(document);
  EXPECT_EQ(loaded.plan.setups[0].grip_mm, 15);
  EXPECT_EQ(loaded.plan.setups[1].grip_mm, 15);
}

TEST(PartPlan, DocumentsMayStandInsteadOfIds) {
  auto document = full();
  auto example = [](const std::string& file) {
    return parse_file(source_path("tests/data/catalogue") / file);
  };
  document["material"] = example("materials/test-steel.json");
  document["material"]["id"] = "own-steel";
  document["machine"] = example("machines/lathe-medium.json");
  document["machine"]["id"] = "own-lathe";
  document["tools"].push_back(example("tools/test-rougher.json"));
  document["tools"][1]["id"] = "own-tool";
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  const auto plan = load(document).plan;
  EXPECT_EQ(plan.material.id, "own-steel");
  EXPECT_EQ(plan.machine.id, "own-lathe");
  ASSERT_EQ(plan.tools.size(), 2U);
  EXPECT_EQ(plan.tools[1].id, "own-tool");
  document["machine"]["spindle"]["efficiency"] = 2;
  document["tools"][1]["life"]["T_min"] = {5};
  EXPECT_EQ(refusal(document),
            "t: /machine/spindle/efficiency: got 2, expected a number > 0 and <= 1\n"
            "t: /tools/1/life/T_min: got [5], expected a list of 2 entries");
}

TEST(PartPlan, ATubeHasAWall) {
  auto document = full();
  document["stock"] = {{"kind", "tube"},
                       {"outer_mm", 50},
                       {"inner_mm", 20},
                       {"length_mm", 166},
                       {"left_allowance_mm", 2}};
  const auto stock = load(document).plan.drawing.stock;
  EXPECT_EQ(stock.kind, part::StockKind::tube);
  EXPECT_EQ(stock.outer_mm, 50);
  EXPECT_EQ(stock.inner_mm, 20);
}

TEST(PartPlan, PredictNeedsEveryConditionAndTool) {
  auto document = full();
  EXPECT_EQ(
      refusal(document, Purpose::predict),
      "t: /operations/0/conditions: got nothing, expected an object\n"
      "t: /operations/2/tool: got nothing, expected the id of a tool\n"
      "t: /operations/2/conditions/passes: got nothing, expected a value: predict "
      "chooses none\n"
      "t: /operations/2/conditions/ap_mm: got nothing, expected a value: predict "
      "chooses none\n"
      "t: /operations/2/conditions/f_mm_rev: got nothing, expected a value: predict "
      "chooses none");
  document["operations"].erase(2);
  document["operations"][0]["conditions"] = document["operations"][1]["conditions"];
  EXPECT_EQ(refusal(document, Purpose::predict), "accepted");
  for (const json& none : {json("auto"), json(nullptr)}) {
    document["operations"] = none;
    if (none.is_null()) document.erase("operations");
    EXPECT_NE(refusal(document, Purpose::predict).find("t: /operations: got"),
              std::string::npos);
  }
}

TEST(PartPlan, EveryToleranceKindTakesItsFeatureAndDatum) {
  // Kind, feature, datum and what is wrong: nothing, the feature or the datum.
  struct Row {
    const char *kind, *of, *datum, *wrong;
  };
  for (const auto& row :
       std::vector<Row>{{"straightness", "c1", "", ""},
                        {"straightness", "left", "", "of"},
                        {"circularity", "c1", "", ""},
                        {"circularity", "right", "", "of"},
                        {"flatness", "d2|d3", "", ""},
                        {"flatness", "d3", "", "of"},
                        {"cylindricity", "d3", "", ""},
                        {"cylindricity", "c1", "", "of"},
                        {"profile", "c1", "d1", ""},
                        {"profile", "d1", "left", ""},
                        {"profile", "left", "d1", "of"},
                        {"profile-without-datum", "c1", "", ""},
                        {"profile-without-datum", "c1", "d1", "datum"},
                        {"parallelism", "left", "right", ""},
                        {"parallelism", "left", "d1", "datum"},
                        {"parallelism", "d1", "left", "of"},
                        {"perpendicularity", "left", "d1", ""},
                        {"perpendicularity", "d1", "left", ""},
                        {"perpendicularity", "d1", "d2", "datum"},
                        {"angularity", "c1", "d1", ""},
                        {"angularity", "c1", "", "datum"},
                        {"position", "d2", "d1", ""},
                        {"position", "left", "d1", "of"},
                        {"coaxiality", "d2", "d1", ""},
                        {"coaxiality", "d2", "left", "datum"},
                        {"circular-radial-runout", "c1", "d1", ""},
                        {"circular-radial-runout", "left", "d1", "of"},
                        {"circular-axial-runout", "left", "d1", ""},
                        {"circular-axial-runout", "d2", "d1", "of"},
                        {"total-radial-runout", "d2", "d1", ""},
                        {"total-radial-runout", "c1", "d1", "of"},
                        {"total-axial-runout", "left", "d1", ""},
                        {"total-axial-runout", "left", "right", "datum"}}) {
    auto document = full();
    json t{{"id", "t"}, {"kind", row.kind}, {"of", row.of}, {"value_mm", 0.01}};
    if (*row.datum) t["datum"] = row.datum;
    document["tolerances"] = {t};
    const auto text = refusal(document);
    if (*row.wrong)
      EXPECT_EQ(text.rfind(std::string("t: /tolerances/0/") + row.wrong + ": got", 0), 0U)
          << row.kind << ": " << text;
    else
      EXPECT_EQ(text, "accepted") << row.kind;
  }
}

}  // namespace
}  // namespace turnwright::document
