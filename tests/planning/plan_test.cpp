#include <gtest/gtest.h>

#include <cmath>

#include "parts.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

ProcessPlan planned(const nlohmann::json& document) { return plan(part(document)); }

const OperationPlan& operation(const ProcessPlan& p, const std::string& id) {
  for (const auto& s : p.setups)
    for (const auto& o : s.operations)
      if (o.id == id) return o;
  throw std::out_of_range(id);
}

double length_of(const PartPlan& p, const std::string& id) {
  for (const auto& e : p.drawing.outer)
    if (e.id == id) return e.length_mm;
  throw std::out_of_range(id);
}

TEST(Plan, CylinderCostsWhatItsPassesTake) {
  const auto p = part(pin());
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) {
      if (o.on[0] == "left" || o.on[0] == "right") continue;
      const auto tool = std::find_if(p.tools.begin(), p.tools.end(),
                                     [&](const auto& t) { return t.id == o.tool; });
      const double l = length_of(p, o.on[0]);
      double t = 0, edges = 0;
      for (const auto& pass : o.passes) {
        const double D = 1000 * pass.vc_m_min / (units::kPi * pass.n_rpm);
        const double cut = units::kPi * D * l / (1000 * pass.vc_m_min * pass.f_mm_rev);
        EXPECT_NEAR(pass.time_min, cut, 1e-9 * cut);
        const auto taylor = p.material.taylor;
        EXPECT_NEAR(
            pass.T_min,
            std::pow(taylor.C / (pass.vc_m_min * std::pow(pass.f_mm_rev, taylor.a) *
                                 std::pow(pass.ap_mm, taylor.b)),
                     1 / taylor.n),
            1e-9 * pass.T_min);
        t += cut;
        edges += cut / pass.T_min;
      }
      const double rapid =
          2 * static_cast<double>(o.passes.size()) * (l + 2) / p.machine.rapid_mm_min;
      EXPECT_NEAR(o.cost,
                  1.0 * (t + rapid + edges * tool->change_min) + edges * tool->edge_cost,
                  1e-9);
    }
}

// The pin's second setup: one finishing pass over d1, everything known in closed form:
// feed at its limit, life at the economic one or its least.
TEST(Plan, SinglePassHasTheEconomicLife) {
  const auto p = part(pin());
  const auto r = plan(p);
  const auto& pass = operation(r, "s1-finish-d1").passes.at(0);
  const auto& tool = p.tools.at(1);
  const double economic =
      (1 / p.material.taylor.n - 1) * (tool.change_min + tool.edge_cost);
  EXPECT_NEAR(pass.ap_mm, 1, 1e-12);
  EXPECT_NEAR(pass.f_mm_rev, tool.f_mm_rev.upper, 1e-9);
  EXPECT_NEAR(pass.T_min, std::max(economic, tool.T_min.lower), 1e-6);
}

TEST(Plan, EveryPlanIsCertified) {
  const auto r = planned(pin());
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  EXPECT_LE(r.certificate.gap, 1e-4);
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) {
      EXPECT_EQ(o.certificate.kind, CertificateKind::global);
      EXPECT_LE(o.certificate.gap, 1e-4);
      for (const auto& c : o.constraints) EXPECT_GE(c.margin, -1e-9) << o.id << c.name;
    }
}

// d cost/d ln(limit) of the certificate against two plans with the limit moved.
TEST(Plan, PricesAreSlopesOfTheCost) {
  const auto with_Ra = [](double Ra) {
    auto d = pin();
    d["outer"][1]["Ra_um"] = Ra;
    return planned(d);
  };
  const double h = 0.01, Ra = 1.0;
  const auto at = with_Ra(Ra);
  const double slope =
      (with_Ra(Ra * (1 - h)).cost_per_part - with_Ra(Ra * (1 + h)).cost_per_part) /
      (std::log(1 + h) - std::log(1 - h));
  double told = 0;
  for (const auto& price : at.prices)
    if (price.limit == "s0-finish-d2: roughness Ra")
      told = price.saves_per_part_for_10_percent / std::log(1.1);
  EXPECT_GT(told, 0);
  EXPECT_NEAR(told, slope, 0.01 * slope);
}

TEST(Plan, TighterToleranceNeverCostsLess) {
  double before = 0;
  for (const double half : {0.02, 0.006, 0.004, 0.003}) {
    auto d = pin();
    d["outer"][1]["limits_mm"] = {-half, half};
    const auto r = planned(d);
    if (r.status == PlanStatus::infeasible) {
      EXPECT_GT(before, 0);
      break;
    }
    EXPECT_GE(r.cost_per_part, before * (1 - 1e-4)) << half;
    before = r.cost_per_part;
  }
}

TEST(Plan, EachObjectiveIsBestAtItsOwn) {
  const auto with = [](const char* objective) {
    auto d = pin();
    d["objective"] = objective;
    return planned(d);
  };
  const auto cost = with("cost"), time = with("time"), profit = with("profit");
  EXPECT_LE(cost.cost_per_part, profit.cost_per_part * (1 + 1e-4));
  EXPECT_LE(profit.cost_per_part, time.cost_per_part * (1 + 1e-4));
  EXPECT_LE(time.time_per_part_min, profit.time_per_part_min * (1 + 1e-4));
  EXPECT_LE(profit.time_per_part_min, cost.time_per_part_min * (1 + 1e-4));
  ASSERT_TRUE(cost.profit_per_min && time.profit_per_min && profit.profit_per_min);
  EXPECT_GE(*profit.profit_per_min, *cost.profit_per_min * (1 - 1e-4));
  EXPECT_GE(*profit.profit_per_min, *time.profit_per_min * (1 - 1e-4));
}

TEST(Plan, GivenConditionsAreKeptAndTheRestChosen) {
  auto d = pin();
  d["operations"] = {
      {{"id", "f"}, {"setup", 0}, {"kind", "face"}, {"on", {"right"}}},
      {{"id", "r"},
       {"setup", 0},
       {"kind", "rough"},
       {"on", {"d2"}},
       {"tool", "PCLNL-CNMG120408-PM"},
       {"conditions", {{"passes", 2}, {"vc_m_min", 180}}}},
      {{"id", "e"},
       {"setup", 0},
       {"kind", "finish"},
       {"on", {"d2"}},
       {"conditions", {{"passes", 1}, {"ap_mm", 0.4}, {"f_mm_rev", 0.12}}}},
      {{"id", "g"}, {"setup", 1}, {"kind", "face"}, {"on", {"left"}}},
      {{"id", "h"}, {"setup", 1}, {"kind", "finish"}, {"on", {"d1"}}}};
  const auto r = planned(d);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& rough = operation(r, "r");
  ASSERT_EQ(rough.passes.size(), 2u);
  EXPECT_NEAR(rough.passes[0].vc_m_min, 180, 1e-9);
  EXPECT_NEAR(2 * rough.passes[0].ap_mm + 0.4, 5, 1e-12);
  const auto& finish = operation(r, "e");
  EXPECT_NEAR(finish.passes[0].ap_mm, 0.4, 1e-12);
  EXPECT_NEAR(finish.passes[0].f_mm_rev, 0.12, 1e-12);
  EXPECT_GE(r.cost_per_part, planned(pin()).cost_per_part * (1 - 1e-4));
}

nlohmann::json long_pin(const std::vector<std::string>& clampings) {
  auto d = pin();
  d["stock"]["length_mm"] = 202;
  d["outer"][1]["length_mm"] = 160;
  d["outer"][1]["diameter_mm"] = 26;
  d["outer"][1]["limits_mm"] = {-0.008, 0.008};
  d["setups"][0]["clampings"] = clampings;
  return d;
}

TEST(Plan, CompensatesOnlyWhereNoClampingDoesWithout) {
  const auto alone = planned(long_pin({"chuck"}));
  ASSERT_EQ(alone.status, PlanStatus::ok);
  ASSERT_EQ(alone.compensation.size(), 1u);
  EXPECT_EQ(alone.compensation[0].on, "d2");
  for (const auto& t : alone.tolerances)
    if (t.id == "d2:diameter") {
      EXPECT_EQ(t.verdict, Verdict::met_with_offset);
    }
  // The path is moved in where the part springs back most: at its free end.
  const auto& table = alone.compensation[0].table_mm;
  EXPECT_LT(table.back().second, table.front().second);
  EXPECT_LT(table.back().second, -0.005);

  const auto held = planned(long_pin({"chuck", "chuck-tailstock"}));
  ASSERT_EQ(held.status, PlanStatus::ok);
  EXPECT_TRUE(held.compensation.empty());
  EXPECT_EQ(held.setups[0].clamping, Clamping::chuck_tailstock);
  ASSERT_EQ(held.setups[0].rejected.size(), 1u);
  EXPECT_EQ(held.setups[0].rejected[0].clamping, Clamping::chuck);
}

TEST(Plan, SameRequestSameBytes) {
  const auto document = reference_part("spindle-nose");
  const auto once = document::to_json(planned(document), {}).dump();
  EXPECT_EQ(once, document::to_json(planned(document), {}).dump());
}

TEST(Plan, WhatNoSetupReachesIsSaid) {
  auto d = pin();
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 30}, {"clampings", {"chuck"}}}};
  const auto r = planned(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_NE(r.conflicts[0].sentence.find("d1"), std::string::npos)
      << r.conflicts[0].sentence;
}

TEST(Plan, ToleranceOnlyTheMachineUsesUpIsToldAsSuch) {
  auto d = pin();
  d["machine_share_um"] = 30;
  d["outer"][1]["limits_mm"] = {-0.01, 0.01};
  const auto r = planned(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  bool told = false;
  for (const auto& c : r.conflicts)
    told = told || c.sentence.find("d2:diameter") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(Plan, InfeasibleAsDrawnTellsWhatFailsAndWhatWouldHaveToGive) {
  const auto r = planned(reference_part("infeasible-as-drawn"));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_EQ(r.conflicts.size(), 2u);
  ASSERT_EQ(r.relax.size(), 2u);
  for (const auto& c : r.conflicts) EXPECT_GT(c.value, c.allowed);
  for (const auto& x : r.relax) EXPECT_GT(x.needed, x.now);
}

}  // namespace
}  // namespace turnwright::planning
