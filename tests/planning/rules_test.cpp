#include "turnwright/planning/rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "parts.hpp"
#include "turnwright/planning/choice.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

const char* const kRougher = "PCLNL-CNMG120408-PM";

// The pin, for which there is more than one tool of every use.
json free_pin() {
  auto document = pin();
  document["tools"] = {kRougher, "PCLNL-CNMG120412-PR", "PCLNL-CNMG120404-PF",
                       "PDJNL-DNMG150604-PF", "SVJBL-VBMT160404-PF"};
  return document;
}

json pin_with(const json& rules) {
  auto document = free_pin();
  document["rules"] = rules;
  return document;
}

PlanRequest request(const json& document) {
  return document::load_part_plan(document, shop(), "part").plan;
}

ProcessPlan planned(const json& document) {
  const auto all = document::prepared_candidates(document, shop(), "part");
  std::vector<Candidate> candidates;
  for (const auto& u : all.usable)
    candidates.push_back({u.name, u.document.part, {}, u.without, u.unless_within});
  return choose(candidates, [](const PreparedPart&, ProcessPlan&) {}).plan;
}

const catalogue::Tool* tool(const PlanRequest& r, const std::string& id) {
  const auto at = std::ranges::find(r.tools, id, &catalogue::Tool::id);
  return at == r.tools.end() ? nullptr : &*at;
}

std::vector<const OperationPlan*> turned(const ProcessPlan& plan) {
  std::vector<const OperationPlan*> all;
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) all.push_back(&o);
  return all;
}

TEST(Rules, ForbiddenToolsAreInNoListOfTheRequest) {
  const auto r = ruled(request(pin_with({{"forbidden_tools", {kRougher, "PART-3"}}})));
  EXPECT_EQ(tool(r, kRougher), nullptr);
  for (const auto& t : r.fixed_tools) EXPECT_NE(t.id, "PART-3");
  EXPECT_NE(tool(ruled(request(free_pin())), kRougher), nullptr);
}

// The window's speeds are cut, and the edge lasts by its law where it runs slower.
TEST(Rules, HouseSpeedsCutTheWindowsOfFixedTools) {
  const auto drill = [](const json& rules) {
    const auto r = ruled(request(pin_with(rules)));
    return *std::ranges::find(r.fixed_tools, "DRILL-HM-5D", &catalogue::FixedTool::id)
                ->conditions_in(r.material.group);
  };
  const auto own = drill(json::object());
  const auto slow = drill({{"speeds", {{{"vc_m_min", {60, 75}}}}}});
  EXPECT_EQ(slow.vc_m_min, 75);
  EXPECT_EQ(slow.window->vc_m_min.lower, 60);
  EXPECT_EQ(slow.window->vc_m_min.upper, 75);
  EXPECT_NEAR(catalogue::at(slow, 70, 0.018).T_min, catalogue::at(own, 70, 0.018).T_min,
              1e-9);
  const auto slower = drill({{"speeds", {{{"vc_m_min", {1, 40}}}}}});
  EXPECT_EQ(slower.window->vc_m_min.lower, 40);
  EXPECT_EQ(slower.window->vc_m_min.upper, 40);
}

TEST(Rules, HouseSpeedsCutTheRangesOfTheToolsTheyConcern) {
  const auto with = [](const json& speed) {
    return ruled(request(pin_with({{"speeds", {speed}}})));
  };
  const auto free = request(free_pin());
  const auto all = with({{"vc_m_min", {100, 200}}});
  for (const auto& t : all.tools) {
    EXPECT_EQ(t.vc_m_min.lower, std::max(100.0, tool(free, t.id)->vc_m_min.lower));
    EXPECT_EQ(t.vc_m_min.upper, 200);
  }
  const auto one = with({{"vc_m_min", {100, 200}}, {"tool", kRougher}});
  for (const auto& t : one.tools)
    EXPECT_EQ(t.vc_m_min.upper,
              t.id == kRougher ? 200 : tool(free, t.id)->vc_m_min.upper);
  for (const json& other : {json{{"vc_m_min", {100, 200}}, {"material", "C15"}},
                            json{{"vc_m_min", {100, 200}}, {"group", "M"}}})
    EXPECT_EQ(tool(with(other), kRougher)->vc_m_min.upper,
              tool(free, kRougher)->vc_m_min.upper);
  // Drills and blades run no faster, though their speed is one number.
  for (const auto& t : all.fixed_tools) {
    const auto* c = t.conditions_in(free.material.group);
    EXPECT_LE(c ? c->vc_m_min : 0, 200) << t.id;
  }
  EXPECT_EQ(tool(with({{"vc_m_min", {4000, 5000}}, {"tool", kRougher}}), kRougher),
            nullptr);
}

TEST(Rules, NoSpindleRunsFasterThanTheHouseAllows) {
  EXPECT_EQ(ruled(request(pin_with({{"n_max_rpm", 900}}))).machine.n_max_rpm, 900);
  const double own = request(free_pin()).machine.n_max_rpm;
  EXPECT_EQ(ruled(request(pin_with({{"n_max_rpm", 1e5}}))).machine.n_max_rpm, own);
}

json proven(double within_pct, const json& vc_m_min) {
  return {
      {"proven",
       {{"within_pct", within_pct},
        {"conditions",
         {{{"tool", kRougher}, {"material", "AISI 1045"}, {"vc_m_min", vc_m_min}}}}}}};
}

TEST(Rules, AToolOfProvenConditionsServesItsUsesAlone) {
  const auto r = ruled(request(pin_with(proven(5, {150, 180}))));
  EXPECT_EQ(tool(r, kRougher)->vc_m_min.upper, 180);
  for (const auto& t : r.tools)
    for (const auto use : t.uses)
      EXPECT_EQ(t.id == kRougher,
                use == catalogue::ToolUse::roughing || use == catalogue::ToolUse::facing)
          << t.id;
  auto other = pin_with(proven(5, {150, 180}));
  other["material"] = "C15";  // nothing is proven in it
  EXPECT_FALSE(prefers_proven(request(other)));
}

TEST(Rules, AppliedTwiceTheyChangeNothingMore) {
  auto rules = proven(5, {150, 180});
  rules["speeds"] = {{{"vc_m_min", {100, 170}}}};
  rules["n_max_rpm"] = 900;
  const auto once = ruled(request(pin_with(rules)));
  const auto twice = ruled(once);
  ASSERT_EQ(once.tools.size(), twice.tools.size());
  for (std::size_t i = 0; i < once.tools.size(); ++i) {
    EXPECT_EQ(once.tools[i].vc_m_min.upper, twice.tools[i].vc_m_min.upper);
    EXPECT_EQ(once.tools[i].uses, twice.tools[i].uses);
  }
}

// What a rule costs is the difference of two plans, each of which is made without the
// other's request being known.
TEST(Rules, TheirPricesAreThoseOfSeparatePlans) {
  const json rules{{"forbidden_tools", {kRougher, "DRILL-HM-3D"}},
                   {"speeds", {{{"vc_m_min", {50, 150}}}, {{"vc_m_min", {1, 5000}}}}}};
  const auto plan = planned(pin_with(rules));
  ASSERT_EQ(plan.status, PlanStatus::ok);
  ASSERT_EQ(plan.rules.size(), 2u);  // the other two change nothing
  auto allowed = rules, faster = rules;
  allowed["forbidden_tools"] = {"DRILL-HM-3D"};
  faster["speeds"] = json::array();
  const auto without = {planned(pin_with(allowed)), planned(pin_with(faster))};
  auto told = plan.rules.begin();
  for (const auto& other : without) {
    EXPECT_NEAR(*told->saves_per_part, plan.cost_per_part - other.cost_per_part, 1e-9);
    EXPECT_GT(*told->saves_per_part, 0) << told->sentence;
    ++told;
  }
  for (const auto* o : turned(plan))
    for (const auto& pass : o->passes) EXPECT_LE(pass.vc_m_min, 150 * (1 + 1e-9));
}

TEST(Rules, ProvenConditionsAreTakenIfTheyCostNoMoreThanTheShareAllowed) {
  const auto best = planned(free_pin());
  const auto slow = [](double within_pct) {
    return planned(pin_with(proven(within_pct, {100, 120})));
  };
  const auto taken = slow(100), refused = slow(0);
  const double more = taken.cost_per_part / best.cost_per_part - 1;
  ASSERT_GT(more, 0.001);
  EXPECT_NEAR(refused.cost_per_part, best.cost_per_part, 1e-9);
  EXPECT_TRUE(taken.alternatives[0].chosen);
  EXPECT_TRUE(refused.alternatives[1].chosen);
  EXPECT_LE(slow(100 * more * 0.99).cost_per_part, best.cost_per_part + 1e-9);
  EXPECT_NEAR(slow(100 * more * 1.01).cost_per_part, taken.cost_per_part, 1e-9);
  for (const auto* o : turned(taken))
    for (const auto& pass : o->passes)
      EXPECT_LE(pass.vc_m_min, (o->tool == kRougher ? 120 : 500) * (1 + 1e-9));
  // The proof is that of the plans at proven conditions, not of cheaper ones set aside.
  EXPECT_EQ(taken.certificate.kind, CertificateKind::global);
  EXPECT_LT(taken.certificate.gap, 1e-3);
  ASSERT_EQ(taken.rules.size(), 1u);
  EXPECT_NEAR(*taken.rules[0].saves_per_part, taken.cost_per_part - best.cost_per_part,
              1e-9);
}

}  // namespace
}  // namespace turnwright::planning
