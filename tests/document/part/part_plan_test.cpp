#include "turnwright/document/part_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../test_catalogue.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document::part_plan_test {
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

LoadedPart load(const json& document, Purpose purpose = Purpose::plan) {
  return load_part_plan(document, test_catalogue(), "t", purpose);
}

std::string refusal(const json& document, Purpose purpose = Purpose::plan) {
  try {
    prepared_part(document, test_catalogue(), "t", purpose);
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

TEST(PartPlan, TheTitleBlockIsReadAndNotNeeded) {
  const auto title = load(full()).plan.drawing.title;
  EXPECT_EQ(title.drawing_number, "4711-02");
  EXPECT_EQ(title.revision, "C");
  EXPECT_EQ(title.customer, "Gear works");
  const auto none = load(smallest()).plan.drawing.title;
  EXPECT_EQ(none.drawing_number + none.revision + none.customer, "");
  auto document = full();
  document["customer"] = std::string(64, 'x');
  EXPECT_EQ(refusal(document), "accepted");
  document["customer"] = std::string(65, 'x');
  document["revision"] = "";
  document["drawing_number"] = 4711;
  const auto said = refusal(document);
  EXPECT_NE(said.find("/drawing_number: got 4711, expected a text of 1 to 64 bytes"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("/revision: got "), std::string::npos) << said;
  EXPECT_NE(said.find("/customer: got "), std::string::npos) << said;
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
  EXPECT_EQ(plan.material.life_scatter_pct, 25);
  EXPECT_EQ(plan.material.taylor.b_shallow, 0.04);
  EXPECT_EQ(plan.material.hmin_edge_um, 40);
  EXPECT_EQ(plan.material.hmin_uncertainty_pct, 50);
  EXPECT_EQ(plan.damping_uncertainty_pct, 20);
  EXPECT_EQ(plan.roughness_conformance, 0.95);
  EXPECT_EQ(plan.machine.id, "lathe-medium");
  ASSERT_EQ(plan.tools.size(), 1U);
  EXPECT_EQ(plan.tools[0].id, "test-rougher");
  EXPECT_EQ(plan.tools[0].edge_um, 40);
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

// The part's own, else the machine's, else an estimate; of bars too.
TEST(PartPlan, DampingIsTheMachinesWhereThePartSaysNone) {
  auto document = smallest();
  document["machine"] =
      parse_file(source_path("tests/data/catalogue/machines/lathe-medium.json"));
  document["machine"]["stiffness"]["damping_ratio"] = 0.05;
  const auto loaded = load(document);
  EXPECT_EQ(loaded.plan.damping_ratio, 0.05);
  const auto why = assumed(loaded, "/damping_ratio")->why;
  EXPECT_TRUE(why.starts_with("the machine's own; the toolpost is taken as rigid"))
      << why;
  document["machine"]["stiffness"]["tool_zz_mm_N"] = 1e-5;
  EXPECT_EQ(assumed(load(document), "/damping_ratio")->why, "the machine's own");
  document["damping_ratio"] = 0.02;
  EXPECT_EQ(load(document).plan.damping_ratio, 0.02);
  EXPECT_EQ(load(document).plan.machine_damping_ratio, 0.02);
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
  EXPECT_EQ(d.tolerances.size(), 6U + 4U + 1U + 2U);
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

// Jaws hold the stock where it is longer than the part; 162 mm are drawn.
TEST(PartPlan, ASteadyRestStandsBesideTheJaws) {
  struct Case {
    const char* hold;
    double grip_mm, left_allowance_mm, steady_mm;
    bool beside;
  };
  for (const auto& c : {Case{"left", 50, 40, 11, true}, Case{"left", 50, 40, 9, false},
                        Case{"left", 50, 0, 49, false}, Case{"left", 50, 40, 162, false},
                        Case{"right", 50, 0, 151, true}, Case{"right", 50, 0, 153, false},
                        Case{"right", 50, 40, 111, true}}) {
    auto document = smallest();
    document["machine"] = "lathe-medium";
    document["stock"]["length_mm"] = 202;
    document["stock"]["left_allowance_mm"] = c.left_allowance_mm;
    document["setups"] = {{{"hold", c.hold},
                           {"grip_mm", c.grip_mm},
                           {"clampings", {"chuck-steady"}},
                           {"steady_mm", c.steady_mm}}};
    const auto said = refusal(document);
    const bool refused = said.find("/setups/0/steady_mm: got ") != std::string::npos &&
                         said.find("outside the jaws") != std::string::npos;
    EXPECT_NE(refused, c.beside) << document["setups"] << said;
    EXPECT_TRUE(refused || said.find("steady_mm") == std::string::npos) << said;
  }
}

TEST(PartPlan, TheBudgetKeepsWhatIsGiven) {
  auto document = full();
  document["budget"] = {{"drift_um", 1},
                        {"drift_axial_um", 2},
                        {"repeatability_um", 3},
                        {"part_warm_K", 4},
                        {"life_between_offsets", 0.5},
                        {"wear_land_mm", 0.2},
                        {"rechucking_um", 6},
                        {"measurement_U_um", 7},
                        {"first_part_gauged", true},
                        {"wear_noticed_times", 3}};
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  const auto& shop = load(document).plan.shop;
  EXPECT_EQ(shop.drift_um, 1);
  EXPECT_EQ(shop.drift_axial_um, 2);
  EXPECT_EQ(shop.repeatability_um, 3);
  EXPECT_EQ(shop.part_warm_K, 4);
  EXPECT_EQ(shop.life_between_offsets, 0.5);
  EXPECT_EQ(shop.wear_land_mm, 0.2);
  EXPECT_EQ(shop.wear_noticed_times, 3);
  EXPECT_EQ(shop.rechucking.hard_jaws_um, 6);
  EXPECT_EQ(shop.rechucking.centres_um, 6);
  EXPECT_EQ(shop.measurement_U_um, 7);
  EXPECT_TRUE(shop.first_part_gauged);
}

TEST(PartPlan, WhatTheBudgetLeavesOpenIsTheMachines) {
  auto document = full();
  document["machine"] = "lathe-medium";
  document["budget"] = {{"drift_um", 1}};
  const auto loaded = load(document);
  const auto own = parse_file(source_path("machines/lathe-medium.json"))["budget"];
  const auto& shop = loaded.plan.shop;
  EXPECT_EQ(shop.drift_um, 1);
  EXPECT_EQ(shop.repeatability_um, own["repeatability_um"]);
  EXPECT_EQ(shop.rechucking.soft_jaws_um, own["rechucking_um"]["soft_jaws"]);
  EXPECT_EQ(shop.wear_land_mm, 0.3);
  EXPECT_EQ(shop.measurement_U_um, 0);
  EXPECT_TRUE(shop.first_part_gauged);
  const auto told = std::ranges::find(loaded.assumed, "/budget", &Assumption::pointer);
  ASSERT_NE(told, loaded.assumed.end());
  EXPECT_EQ(told->value["drift_um"], 1);
  EXPECT_EQ(told->value["rechucking_um"], own["rechucking_um"]);
  document["budget"] = {{"rechucking_um", {{"hard_jaws", 4}}}};
  EXPECT_NE(SchemaCheck("part.json").fault(document), "");
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

PreparedDocument prepared(const json& document) {
  return prepared_part(document, test_catalogue(), "t");
}

json assumed_of(const PreparedDocument& loaded, const std::string& pointer) {
  for (const auto& a : loaded.assumed)
    if (a.pointer == pointer) return a.value;
  return nullptr;
}

TEST(PartPlan, TheSmallestDocumentTellsEveryDefaultUsed) {
  const auto document = smallest();
  EXPECT_EQ(SchemaCheck("part.json").fault(document), "");
  const auto loaded = prepared(document);
  json told = json::object();
  for (const auto& a : loaded.assumed) {
    EXPECT_FALSE(a.why.empty()) << a.pointer;
    told[a.pointer] = a.value;
  }
  // 165 mm stock for 162 mm; jaws on 50 mm stock, then on the finished 46 mm.
  const json all{"chuck", "chuck-tailstock", "between-centres"};
  auto budget = parse_file(source_path("machines/lathe-medium.json"))["budget"];
  for (const auto* text : {"source", "note", "uncertainty_pct"}) budget.erase(text);
  budget.update({{"wear_land_mm", 0.3},
                 {"edge_wear_mm", 0.0},
                 {"wear_noticed_times", 2.0},
                 {"measurement_U_um", 0.0},
                 {"first_part_gauged", true}});
  EXPECT_EQ(told, json({{"/name", "part"},
                        {"/machine", "lathe-medium"},
                        {"/tools", {"test-rougher"}},
                        {"/stock/left_allowance_mm", 1.5},
                        {"/setups",
                         {{{"hold", "left"}, {"clampings", all}},
                          {{"hold", "right"}, {"clampings", all}, {"jaws", "soft"}}}},
                        {"/setups/0/grip_mm", 25.0},
                        {"/setups/1/grip_mm", 24.0},
                        {"/operations", "auto"},
                        {"/objective", "cost"},
                        {"/batch", nullptr},
                        {"/rates/machine_per_min", 1.0},
                        {"/machine_share_um", 0.0},
                        {"/budget", budget},
                        {"/robust", true},
                        {"/window_percent", 5.0},
                        {"/damping_ratio", 0.012},
                        {"/conformance", 0.9973}}));
  EXPECT_EQ(loaded.part.drawing.stock.left_allowance_mm, 1.5);
  EXPECT_EQ(loaded.part.grips_mm[1], 24);  // three diameters stand out
  EXPECT_EQ(loaded.part.setups[1].clampings.size(), 3U);
  EXPECT_EQ(loaded.part.machine_per_min, 1);
  EXPECT_FALSE(loaded.part.batch.has_value());
  EXPECT_FALSE(loaded.part.operations.has_value());
}

TEST(PartPlan, WhatWasAssumedMayBeWrittenDown) {
  // Every assumption put where its pointer says gives the same plan without assumptions.
  auto document = smallest();
  for (const auto& a : prepared(document).assumed)
    document[json::json_pointer(a.pointer)] = a.value;
  const auto again = prepared(document);
  for (const auto& a : again.assumed) ADD_FAILURE() << a.pointer << " " << a.value;
  EXPECT_EQ(again.part.setups[0].grip_mm, 25);
}

// Programs cut lengths to the middles of their limits; a middle that turns an element inside
// out once ended them in a crash.
TEST(PartPlan, LengthsWhoseMiddlesLieFarOffAreRefused) {
  auto document = smallest();
  document["stock"]["length_mm"] = 84;
  document["outer"] = {
      {{"id", "a"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 30}},
      {{"id", "b"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 40}},
      {{"id", "c"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 30}}};
  const auto with = [&](double upper_mm) {
    document["tolerances"] = {{{"id", "t1"},
                               {"kind", "length"},
                               {"between", {"b|c", "right"}},
                               {"limits_mm", {0.0, upper_mm}}}};
    return refusal(document);
  };
  EXPECT_EQ(with(19.9).find("length_mm"), std::string::npos);
  EXPECT_EQ(with(42),
            "t: /outer/1/length_mm: got 20 mm, expected a length that the middles of the "
            "limits in tolerances change by at most a half: they make -1 mm of it\n"
            "t: /outer/2/length_mm: got 40 mm, expected a length that the middles of the "
            "limits in tolerances change by at most a half: they make 61 mm of it");
}

TEST(PartPlan, AThinPartIsHeldByAtLeast15mm) {
  auto document = smallest();
  document["stock"] = {{"kind", "bar"}, {"diameter_mm", 24}, {"length_mm", 82}};
  document["outer"] = {
      {{"id", "d"}, {"kind", "cylinder"}, {"length_mm", 80}, {"diameter_mm", 20}}};
  const auto loaded = prepared(document);
  EXPECT_EQ(loaded.part.grips_mm[0], 15);
  EXPECT_EQ(loaded.part.grips_mm[1], 15);
}

// 18.8 + 152.9 is more than 171.7 by a rounding.
TEST(PartPlan, StockMayBeAsLongAsThePart) {
  auto document = smallest();
  document["stock"]["length_mm"] = 171.7;
  document["stock"]["left_allowance_mm"] = 0;
  document["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 18.8}, {"diameter_mm", 30}},
      {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 152.9}, {"diameter_mm", 20}}};
  const auto drawing = load(document).plan.drawing;
  EXPECT_EQ(drawing.stock.length_mm, part::length_mm(drawing));
}

TEST(PartPlan, AGripThatNobodyGaveIsToldAsTheDefault) {
  auto document = smallest();
  document["stock"]["diameter_mm"] = 100;
  document["stock"]["length_mm"] = 44;
  document["outer"] = {
      {{"id", "d"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 96}}};
  const auto loaded = prepared(document);
  EXPECT_EQ(loaded.part.grips_mm[0], 22);  // half of the stock's length
  EXPECT_EQ(assumed_of(loaded, "/setups/0/grip_mm"), 22);
}

// A shaft of 50 mm stock with what is cut at fixed conditions, tools of the catalogue.
json with_cuts() {
  json document = {
      {"material", full()["material"]},
      {"stock", {{"kind", "bar"}, {"diameter_mm", 50}, {"length_mm", 130}}},
      {"outer",
       {{{"id", "th1"}, {"kind", "thread"}, {"length_mm", 20}, {"diameter_mm", 20}},
        {{"id", "g1"}, {"kind", "groove"}, {"length_mm", 3}, {"diameter_mm", 16}},
        {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 30}},
        {{"id", "a1"},
         {"kind", "arc"},
         {"length_mm", 20},
         {"left_mm", 30},
         {"right_mm", 30},
         {"radius_mm", 40}},
        {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 30}}}}};
  return document;
}

TEST(PartPlan, BlanksAreTurnedAndWhatIsCutIntoThemKept) {
  auto document = with_cuts();
  document["general"] = "ISO 2768-mK";
  document["outer"][0]["fit"] = "6g";
  document["outer"][1]["limits_mm"] = {-0.1, 0};
  const auto loaded = load(document);
  const auto& outer = loaded.plan.drawing.outer;
  EXPECT_EQ(outer[0].left_mm, 20);
  EXPECT_EQ(outer[0].cut->pitch_mm, 2.5);  // coarse
  EXPECT_EQ(outer[1].left_mm, 20);         // the smaller neighbour's
  EXPECT_EQ(outer[1].cut->drawn.left_mm, 16);
  EXPECT_NEAR(outer[1].cut->core.left_mm, 15.95, 1e-12);
  const double crests = 20 + (19.958 + 19.623 - 40) / 2;  // M20-6g of ISO 965-2
  EXPECT_NEAR(outer[1].cut->depth_mm, (crests - 15.95) / 2, 0.003);
  EXPECT_NEAR(outer[3].left_mm, 30 + 2 * (40 - std::sqrt(1500)), 1e-9);
  EXPECT_FALSE(outer[2].cut);
  for (const auto& t : loaded.plan.drawing.tolerances)
    EXPECT_TRUE(t.of == "d1" || t.of == "d2" || t.of == "right" || t.of == "left" ||
                t.of.empty())
        << t.id;
  ASSERT_TRUE(assumed(loaded, "/outer/0/pitch_mm"));
  EXPECT_EQ(assumed(loaded, "/outer/0/pitch_mm")->value, 2.5);
  ASSERT_TRUE(assumed(loaded, "/outer/0/fit"));
  EXPECT_EQ(assumed(loaded, "/outer/0/fit")->value, "6g");
  ASSERT_TRUE(assumed(loaded, "/outer/1/limits_mm"));
  EXPECT_EQ(assumed(loaded, "/outer/3/bulge")->value, "convex");
}

TEST(PartPlan, ADesignationIsDiameterAndPitch) {
  auto document = with_cuts();
  document["outer"][0].erase("diameter_mm");
  for (const auto& [text, pitch] : {std::pair{"M20x1.5", 1.5}, {"M20", 2.5}}) {
    document["outer"][0]["designation"] = text;
    const auto part = load(document).plan.drawing;
    EXPECT_EQ(part.outer[0].cut->drawn.left_mm, 20) << text;
    EXPECT_EQ(part.outer[0].cut->pitch_mm, pitch) << text;
  }
  document["outer"][0]["designation"] = "M0x1";
  EXPECT_EQ(refusal(document),
            "t: /outer/0/designation: got \"M0x1\", expected a diameter > 0 and <= 20000 "
            "mm and a pitch > 0 mm");
}

TEST(PartPlan, AGrooveInABoreHasTheLargerNeighboursBlank) {
  auto document = with_cuts();
  document["stock"] = {
      {"kind", "tube"}, {"outer_mm", 80}, {"inner_mm", 10}, {"length_mm", 110}};
  document["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 100}, {"diameter_mm", 70}}};
  for (const char* from : {"right", "left"}) {
    const auto bore = [&](const char* id, const char* kind, double length, double d) {
      return json{{"id", id},
                  {"kind", kind},
                  {"from", from},
                  {"length_mm", length},
                  {"diameter_mm", d}};
    };
    document["inner"] = {bore("b1", "cylinder", 20, 30), bore("g1", "groove", 3, 34),
                         bore("t1", "thread", 20, 24)};
    document["inner"][2]["pitch_mm"] = 2;
    const auto inner = load(document).plan.drawing.inner;
    EXPECT_EQ(inner[1].left_mm, 30) << from;
    EXPECT_NEAR(inner[2].left_mm, 24 - 1.0825318 * 2, 1e-6) << from;
    // M24x2-6H of ISO 965-2: D1 21.835 to 22.210, pitch diameter 0 to 0.224 above.
    EXPECT_NEAR(inner[2].limits->upper_mm, 22.210 - 21.835, 0.012) << from;
    EXPECT_NEAR(inner[2].cut->core.left_mm, 24.112, 0.004) << from;
    document["inner"][1]["diameter_mm"] = 30;
    EXPECT_EQ(
        refusal(document),
        "t: /inner/1/diameter_mm: got 30, expected more than the 30 mm of b1 beside "
        "the groove");
  }
}

TEST(PartPlan, AGroovesFloorIsCutToTheMiddleOfItsLimits) {
  auto document = with_cuts();
  auto& groove = document["outer"][1];
  groove["fit"] = "h11";  // 0 to -0.11 of 16 mm
  const auto floor = [&] { return load(document).plan.drawing.outer[1].cut->core; };
  EXPECT_NEAR(floor().left_mm, 16 - 0.055, 1e-12);
  EXPECT_EQ(floor().left_mm, floor().right_mm);
  groove.erase("fit");
  EXPECT_EQ(floor().left_mm, 16);
  groove["limits_mm"] = {3, 5};
  EXPECT_EQ(
      refusal(document),
      "t: /outer/1/limits_mm: got [3,5], expected limits whose middle, 20 mm, leaves "
      "a groove in th1 beside it, which is cut to 19.7927 mm");
}

// Beside a cylinder, on either side, that is cut lower than it is drawn.
TEST(PartPlan, AGrooveLiesBelowWhatIsCutBesideIt) {
  for (const bool mirrored : {false, true}) {
    auto document = with_cuts();
    auto& outer = document["outer"];
    outer = {
        {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 30}},
        {{"id", "g1"}, {"kind", "groove"}, {"length_mm", 3}, {"diameter_mm", 29.8}},
        {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 30}}};
    auto& lower = outer[mirrored ? 0 : 2];
    EXPECT_NO_THROW(load(document));
    lower["limits_mm"] = {-0.4, -0.2};
    EXPECT_EQ(refusal(document),
              "t: /outer/1/diameter_mm: got 29.8, expected a groove in d1 "
              "beside it, which is cut to 29.7 mm");
    outer[1]["limits_mm"] = {-0.4, 0};
    const auto groove = load(document).plan.drawing.outer[1];
    EXPECT_NEAR(groove.cut->depth_mm, (29.7 - 29.6) / 2, 1e-12);
    ASSERT_TRUE(groove.limits);  // of its blank
    EXPECT_EQ(groove.limits->lower_mm, -0.4);
  }
}

TEST(PartPlan, ANecksFloorsAreCutToTheMiddleOfTheirLimits) {
  auto document = with_cuts();
  document["outer"] = {
      {{"id", "a"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 40}},
      {{"id", "n"},
       {"kind", "cylinder"},
       {"length_mm", 5},
       {"diameter_mm", 30},
       {"limits_mm", {-0.4, 0.2}}},
      {{"id", "b"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 44}}};
  const auto neck = load(document).plan.drawing.outer[1];
  ASSERT_TRUE(part::is_groove(neck));
  EXPECT_EQ(neck.left_mm, 40);
  EXPECT_EQ(neck.cut->drawn.left_mm, 30);
  EXPECT_NEAR(neck.cut->core.left_mm, 29.9, 1e-12);
}

TEST(PartPlan, AThreadHasTheLimitsOfItsClass) {
  auto document = with_cuts();
  auto& thread = document["outer"][0];
  const auto expect = [&](double lower_mm, double upper_mm) {
    const auto limits = load(document).plan.drawing.outer[0].limits;
    ASSERT_TRUE(limits);
    EXPECT_NEAR(limits->lower_mm, lower_mm, 0.006) << thread;
    EXPECT_NEAR(limits->upper_mm, upper_mm, 0.001) << thread;
  };
  expect(19.623 - 20, 19.958 - 20);  // 6g of ISO 965-2
  EXPECT_EQ(assumed(load(document), "/outer/0/fit")->value, "6g");
  thread["fit"] = "6h";
  expect(19.665 - 20, 0);
  thread.erase("fit");
  thread["limits_mm"] = {-0.3, -0.1};  // of the crests
  expect(-0.3, -0.1);
  thread.erase("limits_mm");
  thread.erase("diameter_mm");
  thread["designation"] = "3/4-10 UNC-3A";  // 0.7500 to 0.7371 in of ASME B1.1
  expect(25.4 * (0.7371 - 0.75), 0);
  EXPECT_FALSE(assumed(load(document), "/outer/0/fit"));
  thread["designation"] = "3/4-10 UNC";
  EXPECT_EQ(assumed(load(document), "/outer/0/fit")->value, "2A");
  for (const auto& t : load(document).plan.drawing.tolerances) EXPECT_NE(t.of, "th1");
}

TEST(PartPlan, AThreadsCrestsStandAboveItsRoot) {
  auto document = with_cuts();
  document["outer"][0]["limits_mm"] = {-1.3, -1};
  EXPECT_EQ(refusal(document),
            "t: /outer/0/limits_mm: got [-1.3,-1], expected limits of the crests within "
            "half the pitch, 1.25 mm, of the diameter");
  document["outer"][0]["limits_mm"] = {-1.2, -1};
  EXPECT_NO_THROW(load(document));
}

TEST(PartPlan, DiameterAndPitchOfAnInchThreadHaveItsUsualClass) {
  auto document = with_cuts();
  auto& thread = document["outer"][0];
  thread["diameter_mm"] = 25.4 / 2;
  thread["pitch_mm"] = 25.4 / 13;
  document["outer"][1]["diameter_mm"] = 9;
  EXPECT_EQ(assumed(load(document), "/outer/0/fit")->value, "2A");
}

TEST(PartPlan, AThreadsClassIsOneOfItsSide) {
  auto document = with_cuts();
  auto& thread = document["outer"][0];
  thread["fit"] = "6H";
  EXPECT_EQ(
      refusal(document),
      "t: /outer/0/fit: got \"6H\", expected an outer thread's tolerance class like "
      "\"6g\" or \"2A\"");
  thread.erase("diameter_mm");
  thread["fit"] = "1A";
  thread["designation"] = "3/4-10 UNC-2A";
  EXPECT_EQ(refusal(document),
            "t: /outer/0/fit: got \"1A\", expected 2A as in the designation, or no fit");
  thread.erase("fit");
  thread["designation"] = "3/4-10 UNC-2B";
  EXPECT_EQ(refusal(document),
            "t: /outer/0/designation: got \"3/4-10 UNC-2B\", expected an outer thread's "
            "tolerance class like \"6g\" or \"2A\"");
}

TEST(PartPlan, FixedToolsAreThoseListedAndElseTheCatalogues) {
  auto document = with_cuts();
  document["tools"] = {"test-rougher"};
  EXPECT_EQ(load(document).plan.fixed_tools.size(), 1U);
  auto inline_tool =
      parse_file(source_path("tests/data/catalogue/tools/fixed/test-profiler.json"));
  inline_tool["id"] = "my-profiler";
  document["tools"].push_back(inline_tool);
  const auto tools = load(document).plan.fixed_tools;
  ASSERT_EQ(tools.size(), 1U);  // in place of the catalogue's of this use
  EXPECT_EQ(tools[0].id, "my-profiler");
  document["tools"].push_back("my-profiler");
  EXPECT_EQ(refusal(document),
            "t: /tools/2: got \"my-profiler\", expected a tool of the catalogue: "
            "\"test-rougher\", \"test-profiler\"");
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

TEST(PartPlan, AGrooveThatReachesTheHoleLeavesNoWall) {
  auto document = smallest();
  document["stock"] = {
      {"kind", "tube"}, {"outer_mm", 70}, {"inner_mm", 40}, {"length_mm", 84}};
  document["outer"] = {
      {{"id", "a"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 66}},
      {{"id", "g"}, {"kind", "groove"}, {"length_mm", 4}, {"diameter_mm", 40}},
      {{"id", "b"}, {"kind", "cylinder"}, {"length_mm", 36}, {"diameter_mm", 66}}};
  EXPECT_NE(refusal(document).find("a wall of 0 of the radius"), std::string::npos)
      << refusal(document);
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

TEST(PartPlan, ACommonDatumIsTwoElementsApart) {
  const auto with = [](const char* kind, const char* of, const json& datum) {
    auto document = full();
    document["tolerances"] = {
        {{"id", "t"}, {"kind", kind}, {"of", of}, {"datum", datum}, {"value_mm", 0.01}}};
    return document;
  };
  for (const auto& [kind, of] : {std::pair("coaxiality", "d2"),
                                 {"coaxiality", "d1"},
                                 {"profile", "c1"},
                                 {"perpendicularity", "right"},
                                 {"total-axial-runout", "d2|d3"}})
    EXPECT_EQ(refusal(with(kind, of, {"d1", "d3"})), "accepted") << kind;
  const auto read =
      prepared_part(with("coaxiality", "d2", {"d1", "d3"}), test_catalogue(), "t");
  EXPECT_EQ(find(read.part.drawing, "t")->datum, "d1");
  EXPECT_EQ(find(read.part.drawing, "t")->common_datum, "d3");
  EXPECT_EQ(part::datum_words(*find(read.part.drawing, "t")), "d1-d3");

  const auto starts = [](const json& document, const std::string& said) {
    const auto text = refusal(document);
    EXPECT_EQ(text.rfind("t: /tolerances/0/" + said, 0), 0U) << text;
  };
  starts(with("coaxiality", "d2", {"d1", "left"}),
         "datum/1: got \"left\", expected a cylinder or cone, for only elements");
  starts(with("coaxiality", "d2", {"d1", "d9"}), "datum/1: got \"d9\"");
  starts(with("coaxiality", "d2", {"d1"}), "datum: got");
  starts(with("coaxiality", "d2", {"d1", "d1"}), "datum: got");
  starts(with("perpendicularity", "d1", {"left", "right"}), "datum: got");
  starts(with("parallelism", "left", {"d1", "d3"}), "datum: got");
  starts(with("flatness", "left", {"d1", "d3"}), "datum: got");
}

// ---- what_if --------------------------------------------------------------------------

json asked(const json& what_if) {
  auto document = smallest();
  document["what_if"] = what_if;
  return document;
}

TEST(WhatIf, EachChangeIsReadAsTheDocumentItMakes) {
  const auto loaded = prepared_part(
      asked({{{"name", "wider"}, {"set", {{"/outer/d1/fit", "k7"}, {"/batch", 20}}}},
             {{"name", "shorter"}, {"set", {{"/outer/3/length_mm", 41}}}},
             {{"limit", "roughness Ra of d1"}, {"change_percent", -25}}}),
      test_catalogue(), "part");
  ASSERT_EQ(loaded.what_if.size(), 3u);
  EXPECT_EQ(loaded.part.drawing.outer[0].fit, "k6");
  EXPECT_EQ(loaded.what_if[0].name, "wider");
  EXPECT_EQ(loaded.what_if[0].part.drawing.outer[0].fit, "k7");
  EXPECT_EQ(loaded.what_if[0].part.batch, 20);
  EXPECT_EQ(loaded.what_if[1].part.drawing.outer[3].length_mm, 41);
  EXPECT_EQ(loaded.what_if[2].name, "roughness Ra of d1 -25 %");
  EXPECT_NEAR(*loaded.what_if[2].part.drawing.outer[0].Ra_um, 0.6, 1e-12);
}

TEST(WhatIf, RefusalsNameTheChange) {
  const auto one = [](json entry) {
    return refusal(asked(json::array({std::move(entry)})));
  };
  EXPECT_EQ(refusal(asked("wider")),
            "t: /what_if: got \"wider\", expected a list of 0 to 20 entries");
  EXPECT_EQ(one(3), "t: /what_if/0: got 3, expected an object");
  EXPECT_EQ(one({{"name", "x"}}), "t: /what_if/0/set: got nothing, expected an object");
  EXPECT_EQ(one({{"name", "x"}, {"set", json::object()}}),
            "t: /what_if/0/set: got an object, expected 1 to 50 changes, as "
            "{\"/outer/d1/fit\": \"h7\"}");
  EXPECT_EQ(one({{"name", "x"}, {"set", {{"/outer/d9/fit", "h7"}}}}),
            "t: /what_if/0/set: got \"/outer/d9/fit\", expected the place of a value in "
            "this document, as /outer/d1/fit or /setups/0/clampings");
  EXPECT_EQ(one({{"name", "x"}, {"set", {{"batch", 2}}}}),
            "t: /what_if/0/set: got \"batch\", expected the place of a value in this "
            "document, as /outer/d1/fit or /setups/0/clampings");
  EXPECT_EQ(one({{"name", "x"}, {"set", {{"/batch", 0}}}}),
            "t: /what_if/0/set/batch: got 0, expected a whole number from 1 to 1000000");
  EXPECT_NE(one({{"name", "x"}, {"set", {{"/what_if", json::array()}}}})
                .find("expected no change of what_if itself"),
            std::string::npos);
  EXPECT_EQ(one({{"limit", "roughness Ra of d"}, {"change_percent", 10}}),
            "t: /what_if/0/limit: got \"roughness Ra of d\", expected a limit of this "
            "request (did you mean \"roughness Ra of d1\"?)");
  EXPECT_EQ(one({{"limit", "roughness Ra of d1"}, {"change_percent", 0}}),
            "t: /what_if/0/change_percent: got 0, expected a change other than 0");
  EXPECT_NE(one({{"limit", "roughness Ra of d1"}, {"change_percent", -95}})
                .find("/what_if/0/change_percent: got -95"),
            std::string::npos);
  EXPECT_NE(one({{"limit", "roughness Ra of d1"}, {"change_percent", 5}, {"set", 1}})
                .find("/what_if/0/set"),
            std::string::npos);
  EXPECT_NE(
      refusal(asked(json::array()), Purpose::predict)
          .find("t: /what_if: got an empty list, expected nothing: only plan answers "
                "what_if"),
      std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::part_plan_test
