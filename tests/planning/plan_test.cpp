#include "turnwright/planning/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "parts.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

ProcessPlan certified_plan(const nlohmann::json& document) {
  return plan(part(document));
}

double length_of(const PreparedPart& p, const std::string& id) {
  for (const auto& e : p.drawing.outer)
    if (e.id == id) return e.length_mm;
  throw std::out_of_range(id);
}

// How far a pass runs past its end: d2 has a wall behind, d1 an edge that falls, over which
// go the finishing corner twice, the largest of the tools and 0.2 mm.
double behind_mm(const std::string& id) { return id == "d1" ? 2 * 0.4 + 0.8 + 0.2 : 0; }

// The passes of an operation on the pin, in a bar of 42 mm.  Roughing of d2 leaves its wall
// the least depth of the finishing tool and draws out as far as it was deep; finishing
// draws out to the top of d1, which stands as stock.
struct PinPasses {
  double wall_mm = 0;  // of a pass: what drawing out takes in revolutions of its cylinder
  double stock_mm = 0;  // left on the wall
  double rapid_mm = 0;
};
PinPasses passes_on_pin(bool d2, bool rough, int passes, double depth, double l) {
  constexpr double kBar = 21, kLeast = 2.0 / 3.0 * 0.4;
  const double finished = d2 ? 16 : 20, n = passes;
  const double later = rough ? kBar - finished - n * depth : 0;
  PinPasses all;
  all.stock_mm = d2 && rough ? kLeast : 0;
  for (int i = 0; i < passes; ++i) {
    const double h = finished + later + depth * (n - 1 - i);
    const double out = !d2 ? h : rough ? h + depth : kBar;
    all.wall_mm += (out * out - h * h) / (2 * h) / n;
    all.rapid_mm += kBar + 2 - h - 1 + (kBar + 2 - out);
  }
  all.rapid_mm += (n - 1) * (2 + l + behind_mm(d2 ? "d2" : "d1") - all.stock_mm - 1);
  return all;
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
      const auto beside =
          passes_on_pin(o.on[0] == "d2", o.kind == OperationKind::rough,
                        static_cast<int>(o.passes.size()), o.passes[0].ap_mm, l);
      const double in_cut = l + beside.wall_mm;
      double t = 0, edges = 0;
      for (const auto& pass : o.passes) {
        const double D = 1000 * pass.vc_m_min / (units::kPi * pass.n_rpm);
        const double cut =
            units::kPi * D * in_cut / (1000 * pass.vc_m_min * pass.f_mm_rev);
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
      // At feed 1 mm down to the pass and 2 mm before the surface.
      const double fed = (1 + 2 + in_cut - beside.stock_mm + behind_mm(o.on[0])) / in_cut;
      const double rapid = beside.rapid_mm / p.machine.rapid_mm_min;
      EXPECT_NEAR(
          o.cost,
          1.0 * (t * fed + rapid + edges * tool->change_min) + edges * tool->edge_cost,
          1e-9);
    }
}

// The pin's second setup: one finishing pass over d1, everything known in closed form:
// feed at its limit, life at the economic one or its least.
TEST(Plan, SinglePassHasTheEconomicLife) {
  const auto p = part(pin());
  const auto r = plan(p);
  const auto& pass = operation(r, "s2-finish-d1").passes.at(0);
  const auto& tool = p.tools.at(1);
  const double economic = (1 / p.material.taylor.n - 1) *
                          (tool.change_min + tool.edge_cost) /
                          ((1 + 2 + 40 + behind_mm("d1")) / 40);
  EXPECT_NEAR(pass.ap_mm, 1, 1e-12);
  EXPECT_NEAR(pass.f_mm_rev, tool.f_mm_rev.upper, 1e-9);
  EXPECT_NEAR(pass.T_min, std::max(economic, tool.T_min.lower), 1e-6);
}

TEST(Plan, EveryPlanIsCertified) {
  const auto r = certified_plan(pin());
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  EXPECT_LE(r.certificate.gap, 1e-4);
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) {
      EXPECT_EQ(o.certificate.kind, CertificateKind::global);
      EXPECT_LE(o.certificate.gap, 1e-4);
      for (const auto& c : o.constraints) EXPECT_GE(c.margin, -1e-9) << o.id << c.name;
    }
}

// Allowed no other finishing tool, a plan of one setup costs at least what was said.
TEST(Plan, ToolsNotChosenCostWhatIsSaidAtLeast) {
  auto d = pin();
  d.erase("tools");
  d["stock"]["length_mm"] = 132;
  d["stock"]["left_allowance_mm"] = 40;
  d["setups"].erase(1);
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  int judged = 0;
  for (const auto& rejected : r.setups[0].rejected_tools) {
    if (rejected.use != "finishing") continue;
    auto only = p;
    std::erase_if(only.tools, [&](const catalogue::Tool& t) {
      return t.id != rejected.tool &&
             std::count(t.uses.begin(), t.uses.end(), catalogue::ToolUse::finishing) > 0;
    });
    const auto with = plan(only);
    if (!rejected.at_least) {
      EXPECT_EQ(with.status, PlanStatus::infeasible) << rejected.tool;
      continue;
    }
    ++judged;
    EXPECT_GE(*rejected.at_least, r.cost_per_part * (1 - 1e-4));
    if (with.status == PlanStatus::ok) {
      EXPECT_GE(with.cost_per_part, *rejected.at_least * (1 - 1e-9)) << rejected.tool;
    }
  }
  EXPECT_GT(judged, 0);
}

TEST(Plan, TighterToleranceNeverCostsLess) {
  std::vector<double> costs;
  for (const double half : {0.02, 0.006, 0.004, 0.003}) {
    auto d = pin();
    d["outer"][1]["limits_mm"] = {-half, half};
    const auto r = certified_plan(d);
    if (r.status == PlanStatus::infeasible) break;
    if (!costs.empty()) {
      EXPECT_GE(r.cost_per_part, costs.back() * (1 - 1e-4)) << half;
    }
    costs.push_back(r.cost_per_part);
  }
  ASSERT_GE(costs.size(), 2U);
  EXPECT_GT(costs.back(), costs.front() * (1 + 1e-3));
}

TEST(Plan, EachObjectiveIsBestAtItsOwn) {
  const auto with = [](const char* objective) {
    auto d = pin();
    d["objective"] = objective;
    return certified_plan(d);
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

// Corners of a convex curve from the cheapest plan to the fastest; each is the plan of
// its own worth of a minute.
TEST(Plan, CostAgainstTimeIsAConvexCurveOfPlans) {
  auto d = pin();
  d["rates"]["machine_per_min"] = 0.15;  // so that edges count
  d["pareto"] = 6;
  const auto r = certified_plan(d);
  ASSERT_GE(r.pareto.size(), 3u);
  ASSERT_LE(r.pareto.size(), 6u);
  const auto& all = r.pareto;
  EXPECT_NEAR(all.front().cost_per_part, r.cost_per_part, 1e-4 * r.cost_per_part);
  d["objective"] = "time";
  EXPECT_LE(all.back().time_per_part_min,
            certified_plan(d).time_per_part_min * (1 + 1e-4));
  const auto slope = [&](std::size_t k) {  // cost of a minute saved
    return (all[k + 1].cost_per_part - all[k].cost_per_part) /
           (all[k].time_per_part_min - all[k + 1].time_per_part_min);
  };
  for (std::size_t k = 0; k + 2 < all.size(); ++k) {
    EXPECT_GT(slope(k), 0);
    EXPECT_LT(slope(k), slope(k + 1));
  }
  for (const auto& x : all) {
    if (!x.minute_worth || *x.minute_worth == 0) continue;
    auto worth = pin();
    worth["rates"]["machine_per_min"] = 0.15 + *x.minute_worth;
    const double least = certified_plan(worth).cost_per_part;
    EXPECT_NEAR(x.cost_per_part + *x.minute_worth * x.time_per_part_min, least,
                2e-4 * least);
  }
}

// Sizes that could fail at both limits: what conforms at one end alone would be cheaper.
TEST(Plan, CostAgainstTimeOfARobustPlanIsOfRobustPlans) {
  auto d = pin();
  d["rates"]["machine_per_min"] = 0.15;
  d["outer"][1]["limits_mm"] = {-0.015, 0.015};
  d["budget"]["repeatability_um"] = 2.1;
  d["robust"] = true;
  d["pareto"] = 4;
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_GE(r.pareto.size(), 3u);
  EXPECT_EQ(r.pareto.front().cost_per_part, r.cost_per_part);
  EXPECT_EQ(r.pareto.front().time_per_part_min, r.time_per_part_min);
  for (const auto& x : r.pareto) {
    auto worth = p;
    worth.pareto = 0;
    worth.machine_per_min += x.minute_worth.value_or(0);
    if (!x.minute_worth) worth.objective = Objective::time;
    const auto same = plan(worth);
    for (const auto& t : same.tolerances)
      EXPECT_GE(t.P_conform, p.conformance - 1e-6) << t.id;
    EXPECT_NEAR(x.time_per_part_min, same.time_per_part_min, 1e-9);
    EXPECT_NEAR(x.cost_per_part + x.minute_worth.value_or(0) * same.time_per_part_min,
                same.cost_per_part, 1e-9);
  }
}

TEST(Plan, GivenConditionsAreKeptAndTheRestChosen) {
  auto d = pin();
  d["damping_ratio"] = 0.03;
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
  const auto r = certified_plan(d);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& rough = operation(r, "r");
  ASSERT_EQ(rough.passes.size(), 2u);
  EXPECT_NEAR(rough.passes[0].vc_m_min, 180, 1e-9);
  EXPECT_NEAR(2 * rough.passes[0].ap_mm + 0.4, 5, 1e-12);
  const auto& finish = operation(r, "e");
  EXPECT_NEAR(finish.passes[0].ap_mm, 0.4, 1e-12);
  EXPECT_NEAR(finish.passes[0].f_mm_rev, 0.12, 1e-12);
  EXPECT_GE(r.cost_per_part, certified_plan(pin()).cost_per_part * (1 - 1e-4));
}

nlohmann::json long_pin(const std::vector<std::string>& clampings) {
  auto d = pin();
  d["stock"]["length_mm"] = 202;
  d["outer"][1]["length_mm"] = 160;
  d["outer"][1]["diameter_mm"] = 26;
  d["outer"][1]["limits_mm"] = {-0.01, 0.01};
  d["setups"][0]["clampings"] = clampings;
  d["damping_ratio"] = 0.5;  // tolerances are what matters here, not chatter
  return d;
}

TEST(Plan, CompensatesOnlyWhereNoClampingDoesWithout) {
  const auto alone = certified_plan(long_pin({"chuck"}));
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

  // Predicted of what was planned, the path is corrected alike.
  const auto again = predict(part_to_predict(as_planned(long_pin({"chuck"}), alone)));
  EXPECT_EQ(again.status, PlanStatus::ok);
  ASSERT_EQ(again.compensation.size(), 1u);
  EXPECT_EQ(again.compensation[0].on, "d2");
  for (std::size_t k = 0; k < table.size(); ++k)
    EXPECT_NEAR(again.compensation[0].table_mm[k].second, table[k].second, 1e-9);
  for (std::size_t i = 0; i < alone.tolerances.size(); ++i)
    EXPECT_EQ(again.tolerances[i].verdict, alone.tolerances[i].verdict);

  const auto held = certified_plan(long_pin({"chuck", "chuck-tailstock"}));
  ASSERT_EQ(held.status, PlanStatus::ok);
  EXPECT_TRUE(held.compensation.empty());
  EXPECT_EQ(held.setups[0].clamping, Clamping::chuck_tailstock);
  ASSERT_EQ(held.setups[0].rejected.size(), 1u);
  EXPECT_EQ(held.setups[0].rejected[0].clamping, Clamping::chuck);
}

// What the table's straight lines leave between its places has its share of the limits.
TEST(Plan, ACorrectedPathKeepsWhatARobustPlanPromises) {
  int corrected = 0;
  for (const double limit_mm : {0.02, 0.025, 0.03}) {
    auto d = long_pin({"chuck"});
    d["robust"] = true;
    d["outer"][1]["limits_mm"] = {-limit_mm, limit_mm};
    const auto r = certified_plan(d);
    if (r.compensation.empty()) continue;
    ++corrected;
    for (const auto& t : r.tolerances)
      EXPECT_GE(t.P_conform, 0.9973 - 1e-9) << limit_mm << " " << t.id;
  }
  EXPECT_EQ(corrected, 3);
}

// A size off its middle by much more than it varies: one number puts it right.
TEST(Plan, AnOffsetCentresASizeBeforeAnythingGetsDearer) {
  auto d = long_pin({"chuck"});
  d["outer"][1]["limits_mm"] = {-0.012, 0.012};
  const auto without = certified_plan(d);
  d["budget"]["first_part_gauged"] = true;
  const auto with = certified_plan(d);
  ASSERT_EQ(with.status, PlanStatus::ok);
  EXPECT_TRUE(with.compensation.empty());
  ASSERT_EQ(with.offsets.size(), 1u);
  EXPECT_EQ(with.offsets[0].on, "d2");
  EXPECT_EQ(with.offsets[0].setup, 0u);
  EXPECT_LT(with.offsets[0].offset_mm, 0);  // the pin springs back and is left too large
  const auto& t = tolerance(with, "d2:diameter");
  EXPECT_EQ(t.verdict, Verdict::met_with_offset);
  EXPECT_NEAR(t.predicted_mm[0] + t.predicted_mm[1], 0, 1e-12);
  if (without.status == PlanStatus::ok) {
    EXPECT_LE(with.cost_per_part, without.cost_per_part * (1 + 1e-4));
  }
  // The same conditions without it: the band is as wide, and off by the offset.
  auto given = as_planned(d, with);
  const auto again = predict(part_to_predict(given));
  ASSERT_EQ(again.offsets.size(), 1u);
  EXPECT_NEAR(again.offsets[0].offset_mm, with.offsets[0].offset_mm, 1e-9);
  given["outer"][1]["limits_mm"] = {-0.2, 0.2};
  const auto bare = predict(part_to_predict(given));
  EXPECT_TRUE(bare.offsets.empty());
  for (const std::size_t end : {0u, 1u})
    EXPECT_NEAR(
        tolerance(bare, "d2:diameter").predicted_mm[end] + 2 * with.offsets[0].offset_mm,
        t.predicted_mm[end], 1e-9);
  for (std::size_t k = 0; k < bare.deviations.size(); ++k) {
    const double by = bare.deviations[k].on == "d2" ? with.offsets[0].offset_mm : 0;
    for (std::size_t i = 0; i < bare.deviations[k].table_mm.size(); ++i)
      EXPECT_NEAR(with.deviations[k].table_mm[i].second,
                  bare.deviations[k].table_mm[i].second + by, 1e-9);
  }
}

// Preparing the machine is the same whatever is chosen: only its share is left out.
TEST(Plan, WithoutABatchPreparingTheMachineIsToldApart) {
  auto d = pin();
  const auto ten = certified_plan(d);
  d.erase("batch");
  const auto none = certified_plan(d);
  ASSERT_EQ(none.status, PlanStatus::ok);
  EXPECT_NEAR(none.setting_up.minutes, 2 * 20, 1e-12);  // lathe-medium, two setups
  EXPECT_NEAR(none.setting_up.cost, 40, 1e-12);         // at 1.0 per minute
  EXPECT_FALSE(none.setting_up.minutes_per_part);
  EXPECT_NEAR(none.time_per_part_min + 4, ten.time_per_part_min, 1e-9);
  EXPECT_NEAR(none.cost_per_part + 4, ten.cost_per_part, 1e-9);
  EXPECT_NEAR(*ten.setting_up.minutes_per_part, 4, 1e-12);
  EXPECT_NEAR(*ten.setting_up.cost_per_part, 4, 1e-12);
  ASSERT_FALSE(none.prices.empty());
  EXPECT_FALSE(none.prices[0].saves_per_batch_for_10_percent);
  EXPECT_EQ(none.prices[0].sentence.find("batch"), std::string::npos);
}

TEST(Plan, TheWorstConformanceIsThatOfTheToleranceFewestPartsKeep) {
  auto d = pin();
  d["outer"][1]["limits_mm"] = {-0.02, 0};
  const auto r = certified_plan(d);
  ASSERT_TRUE(r.worst_conformance);
  double least = 1;
  for (const auto& t : r.tolerances) least = std::min(least, t.P_conform);
  EXPECT_EQ(r.worst_conformance->P_conform, least);
  EXPECT_EQ(tolerance(r, r.worst_conformance->tolerance).P_conform, least);
  EXPECT_EQ(r.worst_conformance->wanted, 0.9973);
}

// A pin of one diameter in the chuck, both operations given.
nlohmann::json given_pin(const std::string& direction) {
  auto d = long_pin({"chuck"});
  d["outer"][1]["limits_mm"] = {-0.2, 0.2};
  d["outer"][1]["diameter_mm"] = 40.5;
  d["outer"][0]["diameter_mm"] = 41;
  const auto tool = "PDJNL-DNMG150604-PF";
  d["operations"] = {
      {{"id", "a"}, {"setup", 0}, {"kind", "face"}, {"on", {"right"}}},
      {{"id", "b"},
       {"setup", 0},
       {"kind", "finish"},
       {"on", {"d2"}},
       {"tool", tool},
       {"direction", direction},
       {"conditions", {{"f_mm_rev", 0.1}}}},
      {{"id", "c"}, {"setup", 1}, {"kind", "face"}, {"on", {"left"}}},
      {{"id", "d"}, {"setup", 1}, {"kind", "finish"}, {"on", {"d1"}}, {"tool", tool}}};
  d["damping_ratio"] = 0.5;
  return d;
}

// What a force and a couple do at the end of a stepped cantilever of cylinders.
struct Stretch {
  double length, outer, inner = 0;
};
struct Tip {
  double ww, wp, twist;
};
Tip tip(const std::vector<Stretch>& stretches, double E, double nu,
        const catalogue::RootCompliance& root) {
  double a = 0;
  for (const auto& s : stretches) a += s.length;
  Tip t{root.c0_mm_N + 2 * root.c1_rad_N * a + root.c2_rad_Nmm * a * a,
        root.c1_rad_N + root.c2_rad_Nmm * a, 0};
  const double G = E / (2 * (1 + nu));
  double far = a;
  for (const auto& s : stretches) {
    const double near = far - s.length, m2 = std::pow(s.inner / s.outer, 2);
    const double I = units::kPi * (std::pow(s.outer, 4) - std::pow(s.inner, 4)) / 64;
    const double A = units::kPi * (s.outer * s.outer - s.inner * s.inner) / 4;
    const double chi = ((7 + 6 * nu) * (1 + m2) * (1 + m2) + (20 + 12 * nu) * m2) /
                       (6 * (1 + nu) * (1 + m2) * (1 + m2));  // Cowper
    t.ww +=
        (std::pow(far, 3) - std::pow(near, 3)) / (3 * E * I) + chi * s.length / (G * A);
    t.wp += (far * far - near * near) / (2 * E * I);
    t.twist += s.length / (G * 2 * I);
    far = near;
  }
  return t;
}

// In the chuck, what stands at the tool's root side is stock when it goes towards the
// chuck and the finished pin when it comes from there.
//   e = law(ap - e),  law = (f_ww + c_rr) Fp -+ f_wp Ff D/2 + c_rt Fc + (f_ww,t Fc)^2/D
TEST(Plan, AFinishingCutAloneYieldsAsItsDirectionSays) {
  for (const std::string direction : {"to-chuck", "from-chuck"}) {
    const auto p = part(given_pin(direction));
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok) << direction;
    const auto& o = operation(r, "b");
    ASSERT_EQ(o.passes.size(), 1u);
    const auto& pass = o.passes[0];
    EXPECT_NEAR(pass.ap_mm, 0.75, 1e-12);

    // From the jaws at z = 29 on, 11 mm of d1 are stock whatever d2 is.
    const double D = 40.5, d = direction == "to-chuck" ? 42 : D;
    const auto& m = p.machine;
    const auto at = [&](const catalogue::RootCompliance& root) {
      return tip({{11, 42}, {160, d}}, p.material.E_MPa, p.material.nu, root);
    };
    const Tip radial = at(m.chuck.radial), tangential = at(m.chuck.tangential);
    const double sign = direction == "to-chuck" ? -1 : 1;
    const auto& tool = p.tools[1];
    const auto cut = cutting::cut_of(p.material, tool);
    double e = 0;  // by fixed point: the pin is stiff
    for (int k = 0; k < 200; ++k) {
      const auto F = cutting::forces_N(cut, 0.75 - e, 0.1);
      const double slip = tangential.ww * F.Fc_N;
      e = (radial.ww + m.tool_rr_mm_N) * F.Fp_N + sign * radial.wp * F.Ff_N * D / 2 +
          m.tool_rt_mm_N * F.Fc_N + slip * slip / D;
    }
    EXPECT_NEAR(tolerance(r, "d2:diameter").predicted_mm[1], 2 * e, 1e-10) << direction;
  }
}

nlohmann::json bush() {
  auto d = pin();
  d["stock"] = {{"kind", "tube"}, {"outer_mm", 64}, {"inner_mm", 36}, {"length_mm", 74}};
  d["outer"][0]["length_mm"] = 20;
  d["outer"][0]["diameter_mm"] = 62;
  d["outer"][1]["diameter_mm"] = 60;
  d["inner"] = {{{"id", "b"},
                 {"kind", "cylinder"},
                 {"from", "right"},
                 {"length_mm", 50},
                 {"diameter_mm", 40},
                 {"fit", "H7"},
                 {"Ra_um", 1.6}}};
  d["setups"][0]["grip_mm"] = 15;
  d["tools"].push_back("S25T-SCLCR-CCMT09T304-PF");
  return d;
}

// The wall springs away from the corner and the bar away from the wall: both leave the
// bore narrower, by m = law(ap - m) on the radius.
TEST(Plan, ABoreComesOutNarrowerByWhatWallAndBarYield) {
  const auto p = part(bush());
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& o = operation(r, "s1-bore-finish-b");
  ASSERT_EQ(o.passes.size(), 1u);
  const auto& pass = o.passes[0];
  const double middle = 0.025 / 2, D = 40 + middle, ap = 2 + middle / 2;  // of 40 H7
  EXPECT_NEAR(pass.ap_mm, ap, 1e-12);
  EXPECT_NEAR(pass.n_rpm, 1000 * pass.vc_m_min / (units::kPi * D), 1e-9 * pass.n_rpm);

  const auto& m = p.machine;
  const auto at = [&](const catalogue::RootCompliance& root) {
    return tip({{7, 64, 36}, {50, 60, 36}}, p.material.E_MPa, p.material.nu, root);
  };
  const Tip radial = at(m.chuck.radial), tangential = at(m.chuck.tangential);
  const auto& tool = p.tools[2];
  const double f = tool.bar->tip_offset_mm;
  // Its shank is as long as the bore needs.
  const double shank = tool.bar->segments[0].length_mm;
  EXPECT_LT(shank, 72);
  const Tip bar = tip({{shank, 25, 6}, {16, 22, 6}}, 210000, 0.3, tool.bar->holder);
  const auto cut = cutting::cut_of(p.material, tool);
  double left = 0;
  for (int k = 0; k < 200; ++k) {
    const auto F = cutting::forces_N(cut, ap - left, pass.f_mm_rev);
    const double slip = (tangential.ww + bar.ww + f * f * bar.twist) * F.Fc_N;
    left = (radial.ww + bar.ww + m.tool_rr_mm_N) * F.Fp_N +
           (radial.wp * D / 2 - bar.wp * f) * F.Ff_N - m.tool_rt_mm_N * F.Fc_N -
           slip * slip / D;
  }
  EXPECT_NEAR(tolerance(r, "b:diameter").predicted_mm[0], middle - 2 * left, 1e-10);
}

TEST(Plan, ToolsForAnotherMaterialAreTold) {
  auto d = pin();
  d["material"] = "AlMgSi";
  d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"};
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_EQ(r.conflicts[0].sentence,
            "d1: none of the tools for finishing has a grade for AlMgSi");
}

TEST(Plan, AHoleNoBarEntersIsTold) {
  auto d = bush();
  d["stock"]["inner_mm"] = 30;
  d["inner"][0]["diameter_mm"] = 34;
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_NE(r.conflicts[0].sentence.find("b: no boring bar is thin and long enough"),
            std::string::npos)
      << r.conflicts[0].sentence;
}

TEST(Plan, ASteadyRestHoldsWhereNoCentreCan) {
  auto d = nominal(reference_part("roller-tube"));
  d["damping_ratio"] = 0.5;
  const auto r = certified_plan(d);
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.setups[1].clamping, Clamping::chuck_steady);
  bool centre = false;
  for (const auto& x : r.setups[1].rejected)
    centre = centre || x.why == "the centre stands where bore b1 is cut";
  EXPECT_TRUE(centre);
  // A soft rest is none, a stiff one near the bore lets it yield least; with limits so
  // wide that no path need be corrected.
  d["inner"][0].erase("fit");
  d["inner"][0]["limits_mm"] = {-0.5, 0.5};
  double before = 1e9;
  for (const double c : {1.0, 1e-3, 1e-4, 1e-6}) {
    auto given = part_to_predict(as_planned(d, r));
    given.machine.steady_rest = {c, c};
    const auto q = predict(given);
    const double e = std::abs(tolerance(q, "b1:diameter").predicted_mm[0]);
    EXPECT_LT(e, before) << c;
    before = e;
  }
  auto soft = part_to_predict(as_planned(d, r)), none = soft;
  soft.machine.steady_rest = {1e6, 1e6};
  none.setups[1].clampings = {Clamping::chuck};
  EXPECT_NEAR(tolerance(predict(soft), "b1:diameter").predicted_mm[0],
              tolerance(predict(none), "b1:diameter").predicted_mm[0], 1e-8);
  d["setups"][1]["steady_mm"] = 375;  // on d3, which is cut there
  const auto on_d3 = certified_plan(d);
  EXPECT_EQ(on_d3.status, PlanStatus::ok);  // with an offset of the tool, in the chuck
  bool told = false;
  for (const auto& x : on_d3.setups[1].rejected)
    told = told || x.why ==
                       "the steady rest at z = 375 mm stands on d3, which this setup "
                       "cuts";
  EXPECT_TRUE(told);
}

// The law of yielding is no multiple of one force then; jaws that reach over the rest
// leave no room for it.
TEST(Plan, MaterialsWithMeasuredFeedAndPassiveForces) {
  auto d = reference_part("roller-tube");
  auto material = file("materials/" + d["material"].get<std::string>() + ".json");
  material["feed_passive"] =
      file("tests/data/catalogue/materials/test-steel.json")["feed_passive"];
  d["material"] = material;
  d["damping_ratio"] = 0.005;
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  for (const auto& remedy : r.remedies)
    for (const auto& change : remedy.changes)
      EXPECT_LT(change.grip_mm, d["setups"][1]["steady_mm"].get<double>())
          << remedy.sentence;
}

TEST(Plan, WhatNoOperationMakesIsAConflict) {
  auto d = given_pin("to-chuck");
  d["operations"].erase(1);
  auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_EQ(r.conflicts.size(), 1u);
  EXPECT_EQ(r.conflicts[0].sentence,
            "d2 has no operation: it would stay as the stock is");
  d = given_pin("to-chuck");
  d["operations"][1]["setup"] = 1;
  r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_EQ(r.conflicts[0].sentence,
            "d2 cannot be cut in the setup of its operations: it lies in the jaws, or "
            "behind a larger diameter");
  d = given_pin("to-chuck");
  d["faces"] = {{{"id", "d1|d2"}, {"Ra_um", 3.2}}};
  r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  d["operations"].push_back(
      {{"id", "s"}, {"setup", 0}, {"kind", "face"}, {"on", {"d1|d2"}}});
  r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(operation(r, "s").on, std::vector<std::string>{"d1|d2"});
}

TEST(Plan, RoughnessHoldsForTheLastOperationWhateverItIs) {
  auto d = given_pin("to-chuck");
  d["operations"][1]["kind"] = "rough";
  d["operations"][1]["conditions"] = nlohmann::json::object();
  d["outer"][1]["Ra_um"] = 0.8;
  const auto r = certified_plan(d);
  ASSERT_EQ(r.status, PlanStatus::ok);
  bool asked = false;
  for (const auto& c : operation(r, "b").constraints)
    if (c.name == "roughness Ra") {
      asked = true;
      EXPECT_EQ(c.limit, 0.8);
      EXPECT_GE(c.margin, -1e-9);
    }
  EXPECT_TRUE(asked);
}

TEST(Plan, GivenConditionsOutsideTheToolsWindowAreAConflict) {
  auto d = given_pin("to-chuck");
  d["operations"][1]["conditions"]["f_mm_rev"] = 0.35;  // the tool takes 0.3 mm/rev
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  bool told = false;
  for (const auto& c : r.conflicts) told = told || c.limit == "largest feed";
  EXPECT_TRUE(told);
}

// The corrected path, followed with the law of yielding written anew: y = law(ap + s - y)
// is what the pin springs back, y - s what is left of it on the radius.
TEST(Plan, ACorrectedPathLeavesNothing) {
  auto d = given_pin("to-chuck");
  d["outer"][1]["limits_mm"] = {-0.008, 0.008};
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_EQ(r.compensation.size(), 1u);
  const auto& t = tolerance(r, "d2:diameter");
  EXPECT_EQ(t.verdict, Verdict::met_with_offset);
  const auto& [z, dr] = r.compensation[0].table_mm.back();
  EXPECT_EQ(z, 200);
  const auto cut = cutting::cut_of(p.material, p.tools[1]);
  const auto& pass = operation(r, "b").passes[0];
  const auto F = cutting::forces_N(cut, pass.ap_mm, pass.f_mm_rev);
  // At the end the whole depth is cut again, and springs back by just as much.
  const double D = 40.5;
  const auto at = [&](const catalogue::RootCompliance& root) {
    return tip({{171, 42}}, p.material.E_MPa, p.material.nu, root);
  };
  const Tip radial = at(p.machine.chuck.radial);
  const double slip = at(p.machine.chuck.tangential).ww * F.Fc_N;
  const double s = (radial.ww + p.machine.tool_rr_mm_N) * F.Fp_N -
                   radial.wp * F.Ff_N * D / 2 + p.machine.tool_rt_mm_N * F.Fc_N +
                   slip * slip / D;
  EXPECT_NEAR(dr, -s, 1e-10);
  EXPECT_LT(t.predicted_mm[1] - t.predicted_mm[0], 1e-4);
  EXPECT_LT(t.P_conform, 1);  // the correction is no more certain than the forces
}

// Three sigma leave nothing for the cut, but most parts conform: a normal source alone.
TEST(Predict, WhatIsUsedUpWithoutTheCutStillSaysHowManyPartsConform) {
  auto d = pin();
  d["budget"]["repeatability_um"] = 2;
  d["outer"][1]["limits_mm"] = {-0.05, 0.05};
  d = as_planned(d, certified_plan(d));
  const auto size = [&](double half_mm) {
    d["outer"][1]["limits_mm"] = {-half_mm, half_mm};
    const auto r = predict(part_to_predict(d));
    return tolerance(r, "d2:diameter");
  };
  const auto loose = size(0.05), tight = size(0.01);  // 2 (2 3 2 um) + 1 um of 20 um
  EXPECT_EQ(loose.verdict, Verdict::met);
  EXPECT_EQ(tight.verdict, Verdict::not_met);
  const double low = loose.predicted_mm[0] * 1000, high = loose.predicted_mm[1] * 1000;
  const double sigma =
      std::hypot(4, force_spread(part_to_predict(d)) * std::max(high, -low));
  const auto below = [&](double um) { return std::erf(um / sigma / std::sqrt(2.0)) / 2; };
  EXPECT_NEAR(tight.P_conform, below(9.5 - high) - below(-9.5 - low), 1e-9);
}

// Stock is taken off down to the middle of the limits, 0.1 mm below what is drawn on the
// radius; given depths may lead to either or to a limit, and the last pass takes the rest.
TEST(Predict, GivenDepthsLeadToTheDrawnSizeOrIntoItsLimits) {
  auto d = pin();
  d["outer"][1]["limits_mm"] = {-0.3, -0.1};
  const auto planned_part = certified_plan(d);
  const double asked = operation(planned_part, "s1-finish-d2").passes[0].ap_mm;
  const auto given = as_planned(d, planned_part);
  const auto with = [&](double deeper_mm) {
    auto changed = given;
    for (auto& o : changed["operations"])
      if (o["id"] == "s1-finish-d2") o["conditions"]["ap_mm"] = asked + deeper_mm;
    return predict(part_to_predict(changed));
  };
  double sum = asked;
  for (const auto& pass : operation(planned_part, "s1-rough-d2").passes)
    sum += pass.ap_mm;
  EXPECT_NEAR(sum, (42 - 32) / 2.0 + 0.1, 1e-12);
  for (const double deeper : {-0.1, -0.05, 0.0, 0.05})
    EXPECT_NEAR(operation(with(deeper), "s1-finish-d2").passes[0].ap_mm, asked, 1e-12)
        << deeper;
  EXPECT_EQ(with(-0.11).status, PlanStatus::infeasible);
  EXPECT_EQ(with(0.11).status, PlanStatus::infeasible);
}

TEST(Plan, StockThatDoesNotStandAboveTheMiddleOfLimitsIsTold) {
  auto d = pin();
  for (const double upper : {4.0, 4.1}) {
    d["outer"][0]["limits_mm"] = {0, upper};
    const auto r = certified_plan(d);
    EXPECT_EQ(r.status, PlanStatus::infeasible);
    ASSERT_EQ(r.conflicts.size(), 1u);
    EXPECT_EQ(r.conflicts[0].sentence,
              "d1: the stock does not stand above the middle of its limits");
  }
}

TEST(Predict, APlansConditionsGiveWhatThePlanSays) {
  for (const auto* part_name : {"gearbox-input-shaft", "piston-rod", "spindle-nose"}) {
    const auto document = reference_part(part_name);
    const auto planned_part = certified_plan(document);
    const auto r = predict(part_to_predict(as_planned(document, planned_part)));
    EXPECT_EQ(r.status, PlanStatus::ok) << part_name;
    EXPECT_NEAR(r.cost_per_part, planned_part.cost_per_part, 1e-9) << part_name;
    EXPECT_NEAR(r.time_per_part_min, planned_part.time_per_part_min, 1e-9) << part_name;
    ASSERT_EQ(r.tolerances.size(), planned_part.tolerances.size());
    for (std::size_t i = 0; i < r.tolerances.size(); ++i) {
      const auto &a = r.tolerances[i], &b = planned_part.tolerances[i];
      EXPECT_NEAR(a.margin_mm, b.margin_mm, 1e-9) << part_name << ' ' << a.id;
      EXPECT_EQ(a.verdict, b.verdict) << part_name << ' ' << a.id;
    }
  }
}

// A face is turned through many spindle speeds, of which its speed range is a choice.
TEST(Predict, AcrossADipOfTheDriveTheConditionsGiveWhatThePlanSays) {
  auto document = pin();
  document["machine"] = file("machines/lathe-medium.json");
  auto& curve = document["machine"]["spindle"]["curve"];
  for (const double n : {400.0, 601.0, 1500.0}) {
    curve = json::array();
    for (const auto& [n_rpm, P_kW] : {std::pair{40.0, 1.0},
                                      {n / 2, 7.5},
                                      {n - 1, 7.5},
                                      {n, 4.0},
                                      {1.5 * n, 7.5},
                                      {4500.0, 7.5}})
      curve.push_back(
          {{"n_rpm", n_rpm}, {"P_kW", P_kW}, {"M_Nm", 9549.2966 * P_kW / n_rpm}});
    const auto planned_part = certified_plan(document);
    ASSERT_EQ(planned_part.status, PlanStatus::ok) << n;
    const auto r = predict(part_to_predict(as_planned(document, planned_part)));
    EXPECT_EQ(r.status, PlanStatus::ok) << n;
    EXPECT_NEAR(r.cost_per_part, planned_part.cost_per_part, 1e-9) << n;
  }
}

TEST(Predict, WhatIsNotKeptIsToldAndTheRestPredictedAllTheSame) {
  auto d = as_planned(pin(), certified_plan(pin()));
  for (auto& o : d["operations"])
    if (o["id"] == "s1-finish-d2") o["conditions"]["f_mm_rev"] = 0.29;
  d["outer"][1]["limits_mm"] = {-0.001, 0.001};
  d["machine_share_um"] = 0;
  const auto r = predict(part_to_predict(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  EXPECT_GT(r.cost_per_part, 0);
  EXPECT_EQ(tolerance(r, "d2:diameter").verdict, Verdict::not_met);
  EXPECT_TRUE(r.compensation.empty());
  bool roughness = false, size = false;
  for (const auto& c : r.conflicts) {
    roughness = roughness || c.limit == "roughness Ra";
    size = size || c.limit == "d2:diameter diameter";
  }
  EXPECT_TRUE(roughness);
  EXPECT_TRUE(size);
}

TEST(Predict, WhatNothingCutsIsNotMetAndTheRestIsPredicted) {
  auto d = as_planned(pin(), certified_plan(pin()));
  d["outer"][0]["limits_mm"] = {-0.1, 0.1};
  d["outer"][1]["limits_mm"] = {-0.1, 0.1};
  auto& all = d["operations"];
  for (std::size_t k = all.size(); k-- > 0;)
    if (all[k]["on"][0] == "d1") all.erase(k);
  const auto r = predict(part_to_predict(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  EXPECT_EQ(r.conflicts.at(0).sentence,
            "d1 has no operation: it would stay as the stock is");
  EXPECT_EQ(tolerance(r, "d1:diameter").verdict, Verdict::not_met);
  EXPECT_EQ(tolerance(r, "d1:diameter").predicted_mm[0], 2);  // stock 42, drawn 40
  EXPECT_EQ(tolerance(r, "d2:diameter").verdict, Verdict::met);
}

TEST(Predict, PassesThatDoNotAddUpAreTold) {
  auto d = as_planned(pin(), certified_plan(pin()));
  for (auto& o : d["operations"])
    if (o["id"] == "s1-finish-d2") o["conditions"]["ap_mm"] = 0.3;
  const auto r = predict(part_to_predict(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_EQ(r.conflicts.size(), 1u);
  EXPECT_EQ(r.conflicts[0].sentence,
            "d2: the given passes do not add up to the 5 mm to take off");
}

// Four millimetres off a radius of eight more than double what it yields: polynomials in
// the depth have to follow that to the last 5e-10 of a tolerance.
TEST(Plan, AThinShaftOfDeepCutsIsPlanned) {
  auto d = nlohmann::json::parse(R"({
      "format": "turnwright-part/1", "name": "thin", "material": "CuZn39Pb3",
      "stock": {"kind": "bar", "diameter_mm": 32, "length_mm": 146,
                "left_allowance_mm": 2},
      "outer": [
        {"id": "d1", "kind": "cylinder", "length_mm": 20, "diameter_mm": 21},
        {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 26},
        {"id": "d3", "kind": "cylinder", "length_mm": 54, "diameter_mm": 16,
         "fit": "k6", "Ra_um": 1.6},
        {"id": "d4", "kind": "cylinder", "length_mm": 38, "diameter_mm": 13}],
      "setups": [
        {"hold": "left", "grip_mm": 19,
         "clampings": ["chuck", "chuck-tailstock", "between-centres"]},
        {"hold": "right", "grip_mm": 30,
         "clampings": ["chuck", "chuck-tailstock", "between-centres"]}],
      "machine": "lathe-medium", "batch": 100})");
  for (const char* fit : {"k6", "k7", "h7", "h6"}) {
    d["outer"][2]["fit"] = fit;
    const auto r = certified_plan(d);
    EXPECT_EQ(r.status, PlanStatus::ok) << fit;
    EXPECT_LE(r.certificate.gap, 1e-4) << fit;
  }
}

TEST(Plan, SameRequestSameBytes) {
  const auto document = reference_part("spindle-nose");
  const auto once = document::to_json(certified_plan(document), {}).dump();
  EXPECT_EQ(once, document::to_json(certified_plan(document), {}).dump());
}

TEST(Plan, WhatNoSetupReachesIsSaid) {
  auto d = pin();
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 30}, {"clampings", {"chuck"}}}};
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_NE(r.conflicts[0].sentence.find("d1"), std::string::npos)
      << r.conflicts[0].sentence;
}

TEST(Plan, ToleranceOnlyTheMachineUsesUpIsToldAsSuch) {
  auto d = pin();
  d["machine_share_um"] = 30;
  d["outer"][1]["limits_mm"] = {-0.01, 0.01};
  const auto r = certified_plan(d);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  bool told = false;
  for (const auto& c : r.conflicts)
    told = told || c.sentence.find("d2:diameter") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(Plan, InfeasibleAsDrawnTellsWhatFailsAndWhatWouldHaveToGive) {
  const auto r = certified_plan(reference_part("infeasible-as-drawn"));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  std::set<std::string> limits;
  for (const auto& c : r.conflicts) limits.insert(c.limit);
  EXPECT_EQ(limits, (std::set<std::string>{"chatter stiffness", "d1:diameter diameter",
                                           "d2:diameter diameter", "t1 cylindricity"}));
  EXPECT_EQ(r.relax.size(), r.conflicts.size());
  for (const auto& c : r.conflicts) EXPECT_GT(c.value, c.allowed);
  for (const auto& x : r.relax) EXPECT_GT(x.needed, x.now);
}

// Optima stand on limits, to rounding: their own conditions are no conflict.
TEST(Plan, OfItsOwnConditionsIsThePlan) {
  for (const char* name :
       {"aluminium-tube", "drilled-bush", "motor-shaft", "spindle-nose"}) {
    auto d = file(std::string("parts/") + name + ".json");
    d.erase("what_if");
    d.erase("pareto_points");
    const auto r = plan(part(d));
    const auto again = plan(part(as_planned(d, r)));
    EXPECT_EQ(again.status, PlanStatus::ok) << name;
    EXPECT_NEAR(again.cost_per_part, r.cost_per_part, 1e-8 * r.cost_per_part) << name;
  }
}

}  // namespace
}  // namespace turnwright::planning
