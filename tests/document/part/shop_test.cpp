#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../test_catalogue.hpp"
#include "document/catalogue/entries.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document::shop_test {
namespace {

using nlohmann::json;

const Catalogue& shipped() {
  static const auto all = load_catalogue(source_path(""));
  return all;
}

json part() {
  auto document = parse_file(source_path("parts/drilled-bush.json"));
  document.erase("tools");
  return document;
}

json with(const std::string& key, const json& value) {
  auto document = part();
  document[key] = value;
  return document;
}

planning::PlanRequest read(const json& document) {
  return load_part_plan(document, shipped(), "t").plan;
}

std::string refusal(const json& document) {
  try {
    prepared_part(document, shipped(), "t");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

json shop_of(const std::vector<std::string>& tools) {
  return {
      {"format", "turnwright-shop/1"}, {"id", "own"}, {"name", "Own"}, {"tools", tools}};
}

TEST(Shop, APartWithoutToolsHasThoseOfTheWorkshop) {
  const auto loaded = load_part_plan(part(), shipped(), "t");
  const auto& workshop = shipped().shops.front();
  EXPECT_EQ(workshop.id, "workshop");
  auto all = ids(loaded.plan.tools);
  EXPECT_EQ(all.size(), 19u);
  for (const auto& more : {ids(loaded.plan.fixed_tools)})
    all.insert(all.end(), more.begin(), more.end());
  for (const auto& id : all)
    EXPECT_NE(std::ranges::find(workshop.tools, id), workshop.tools.end()) << id;
  EXPECT_TRUE(loaded.plan.spare_tools.empty());
  const auto told = std::ranges::find(loaded.assumed, "/tools", &Assumption::pointer);
  ASSERT_NE(told, loaded.assumed.end());
  EXPECT_EQ(told->why, "the tools of workshop");
}

TEST(Shop, TheWholeCatalogueIsThereForTheAsking) {
  EXPECT_EQ(ids(read(with("tools", "all")).tools), ids(shipped().tools));
  EXPECT_NE(refusal(with("tools", "al")).find("/tools: got \"al\", expected"),
            std::string::npos);
  auto bare = shipped();
  bare.shops.clear();
  // All but those that go behind shoulders, of which this drawing has none to go behind.
  const auto behind =
      std::ranges::count_if(shipped().tools, catalogue::goes_behind_shoulders);
  EXPECT_EQ(load_part_plan(part(), bare, "t").plan.tools.size() +
                static_cast<std::size_t>(behind),
            shipped().tools.size());
  EXPECT_GT(behind, 0);
}

// A spindle that may not turn as fast as its slowest has no speed at all.
TEST(Shop, ARuleLeavesTheSpindleSomeSpeed) {
  auto d = with("rules", {{"n_max_rpm", 30}});
  d["machine"] = "lathe-medium";
  EXPECT_NE(refusal(d).find("/rules/n_max_rpm: got 30, expected more than the 40 1/min"),
            std::string::npos)
      << refusal(d);
  d["rules"]["n_max_rpm"] = 41;
  EXPECT_EQ(refusal(d), refusal(with("machine", "lathe-medium")));
}

TEST(Shop, AShopMayStandInThePart) {
  const auto own = read(with("shop", shop_of({"PCLNL-CNMG120408-PM", "PART-2"})));
  EXPECT_EQ(ids(own.tools), std::vector<std::string>{"PCLNL-CNMG120408-PM"});
  std::vector<std::string> parting, drilling;
  for (const auto& t : own.fixed_tools) {
    if (t.use == catalogue::FixedUse::parting) parting.push_back(t.id);
    if (t.use == catalogue::FixedUse::drilling) drilling.push_back(t.id);
  }
  EXPECT_EQ(parting, std::vector<std::string>{"PART-2"});
  EXPECT_GE(drilling.size(), 4u);  // the shop has none: the catalogue's
  const auto listed = read([] {
    auto document = with("shop", shop_of({"PCLNL-CNMG120408-PM", "PCLNL-CNMG120412-PR"}));
    document["tools"] = {"PCLNL-CNMG120412-PR"};
    return document;
  }());
  EXPECT_EQ(ids(listed.tools), std::vector<std::string>{"PCLNL-CNMG120412-PR"});
  EXPECT_EQ(ids(listed.spare_tools), std::vector<std::string>{"PCLNL-CNMG120408-PM"});
}

TEST(Shop, RulesOfTheShopAndOfThePartHoldTogether) {
  auto shop = shop_of({});
  shop["rules"] = {
      {"forbidden_tools", {"PART-2"}},
      {"speeds", {{{"vc_m_min", {10, 200}}, {"material", "1.0503"}, {"group", "P"}}}},
      {"n_max_rpm", 3000},
      {"proven",
       {{"within_pct", 7},
        {"conditions", {{{"tool", "PART-3"}, {"material", "C45"}, {"ap_mm", {1, 2}}}}}}}};
  auto document = with("shop", shop);
  document["rules"] = {
      {"forbidden_tools", {"PART-4"}}, {"n_max_rpm", 2000}, {"speeds", json::array()}};
  const auto& rules = read(document).rules;
  EXPECT_EQ(rules.forbidden_tools, (std::vector<std::string>{"PART-2", "PART-4"}));
  ASSERT_EQ(rules.speeds.size(), 1u);
  EXPECT_EQ(rules.speeds[0].material, "C45");
  EXPECT_EQ(rules.speeds[0].tool, std::nullopt);
  EXPECT_EQ(rules.speeds[0].group, catalogue::IsoGroup::P);
  EXPECT_EQ(rules.speeds[0].vc_m_min.upper, 200);
  EXPECT_EQ(rules.n_max_rpm, 2000);
  EXPECT_EQ(rules.proven_within_pct, 7);
  ASSERT_EQ(rules.proven.size(), 1u);
  EXPECT_EQ(rules.proven[0].ap_mm->upper, 2);
  EXPECT_EQ(rules.proven[0].f_mm_rev, std::nullopt);
}

TEST(Shop, EveryProblemOfItsRulesIsToldAtItsPlace) {
  const auto said = refusal(with(
      "rules",
      {{"forbidden_tools", {"PART-9", "PART-2", "PART-2"}},
       {"speeds", {{{"vc_m_min", {200, 10}}, {"material", "1.7225"}}, {{"group", "Q"}}}},
       {"n_max_rpm", 0},
       {"prefer", true},
       {"proven",
        {{"within_pct", 101},
         {"conditions",
          {{{"tool", "PART-2"}, {"material", "C45"}},
           {{"tool", "PART-2"}, {"material", "AISI 1045"}},
           {{"material", "C46"}}}}}}}));
  for (const char* place :
       {"/rules/forbidden_tools/0: got \"PART-9\", expected a tool of the catalogue",
        "/rules/forbidden_tools/2: got \"PART-2\", expected each tool once",
        "/rules/speeds/0/vc_m_min: ",
        "/rules/speeds/0/material: got \"1.7225\", expected "
        "one of the materials that are called so: \"42CrMo4-A\"",
        "/rules/speeds/1/vc_m_min: got nothing", "/rules/speeds/1/group: got \"Q\"",
        "/rules/n_max_rpm: got 0", "/rules/prefer: got true, expected no such key",
        "/rules/proven/within_pct: got 101",
        "/rules/proven/conditions/1: got an object, expected each tool and material once",
        "/rules/proven/conditions/2/tool: got nothing",
        "/rules/proven/conditions/2/material: got \"C46\""})
    EXPECT_NE(said.find(place), std::string::npos) << place << '\n' << said;
}

TEST(Shop, AGivenOperationMayNotUseAForbiddenTool) {
  auto document = part();
  document["rules"] = {{"forbidden_tools", {"PCLNL-CNMG120408-PM"}}};
  document["operations"] = {{{"id", "r1"},
                             {"setup", 0},
                             {"kind", "rough"},
                             {"on", {document["outer"][0]["id"]}},
                             {"tool", "PCLNL-CNMG120408-PM"}}};
  EXPECT_NE(refusal(document).find("/operations/0/tool: got \"PCLNL-CNMG120408-PM\", "
                                   "expected a tool that the rules of the shop leave"),
            std::string::npos)
      << refusal(document);
}

TEST(Shop, APartMayNameOneAndHoldRules) {
  const SchemaCheck part_schema("part.json");
  auto document = with("rules", {{"n_max_rpm", 2500}});
  document["shop"] = shop_of({});
  document["tools"] = "all";
  document["material"] = "AISI 1045";
  EXPECT_EQ(part_schema.fault(document), "");
  document["rules"]["n_max_rpm"] = 0;
  EXPECT_NE(part_schema.fault(document), "");
}

}  // namespace
}  // namespace turnwright::document::shop_test
