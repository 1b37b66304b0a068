#include "planning/budget/uncertain_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../parts.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

// z with P(Z > z) = q, by halving erfc.
double beyond(double q) {
  double low = -10, high = 10;
  for (int k = 0; k < 100; ++k) {
    const double z = (low + high) / 2;
    (std::erfc(z / std::sqrt(2.0)) / 2 > q ? low : high) = z;
  }
  return low;
}

PlanRequest with(double damping_pct, bool robust) {
  PlanRequest p;
  p.damping_uncertainty_pct = damping_pct;
  p.conformance = 0.99;
  p.robust = robust;
  return p;
}

TEST(UncertainLimits, WhatIsKnownIsTakenAsItIs) {
  for (const bool robust : {true, false}) {
    const auto p = with(0, robust);
    EXPECT_EQ(chatter_factor(p), 1);
    EXPECT_EQ(left_by_chatter(p), 1);
    EXPECT_EQ(stable_probability(p, 1.5), 1);
    EXPECT_EQ(roughness_factor(p, 50), 1);
  }
}

TEST(UncertainLimits, ACutAtTheLimitOfARobustPlanChattersInAQuarterOfTheFailures) {
  const auto p = with(20, true);
  const double z = beyond(0.01 / 4);
  EXPECT_NEAR(chatter_factor(p), std::exp(-0.2 * z), 1e-9);
  EXPECT_NEAR(stable_probability(p, 1), 1 - 0.01 / 4, 1e-12);
  EXPECT_NEAR(stable_probability(p, std::exp(0.2 * z)), 0.5, 1e-9);
  EXPECT_EQ(left_by_chatter(p), 0.5);
  // Two faces and what the sizes may fail by are the whole.
  EXPECT_NEAR(2 * 0.25 + left_by_chatter(p), 1, 1e-15);
}

TEST(UncertainLimits, ANominalPlanIsStableInHalfOfTheCasesAtItsLimit) {
  const auto p = with(20, false);
  EXPECT_EQ(chatter_factor(p), 1);
  EXPECT_NEAR(stable_probability(p, 1), 0.5, 1e-15);
  EXPECT_NEAR(stable_probability(p, std::exp(-0.2 * 3)), 1 - std::erfc(3 / M_SQRT2) / 2,
              1e-12);
}

TEST(UncertainLimits, MoreSpreadNeverMakesACutSafer) {
  double factor = 1;
  for (const double pct : {1, 5, 20, 60, 100}) {
    const auto p = with(pct, true);
    EXPECT_LT(chatter_factor(p), factor);
    factor = chatter_factor(p);
    double probability = 1;
    for (const double share : {0.1, 0.5, 0.9, 1.0, 1.1, 2.0}) {
      EXPECT_LE(stable_probability(p, share), probability);
      probability = stable_probability(p, share);
    }
  }
}

TEST(UncertainLimits, RoughnessIsJudgedWithTheQuantileOfWhatIsUncertain) {
  auto p = with(0, true);
  p.roughness_conformance = 0.95;
  EXPECT_NEAR(roughness_factor(p, 50), 1 + 0.5 * beyond(0.05), 1e-9);
  p.roughness_conformance = 0.5;
  EXPECT_NEAR(roughness_factor(p, 50), 1, 1e-9);
}

// A pin whose worn edges decide, with lives of edges that scatter and a Taylor's C that is
// uncertain for all of them.
nlohmann::json scattering_pin(double scatter_pct, double law_pct = 0,
                              double half_mm = 0.06) {
  auto d = pin();
  d["material"] = file("materials/C45.json");
  auto& taylor = d["material"]["taylor"];
  if (scatter_pct > 0) taylor["scatter_pct"] = scatter_pct;
  taylor["uncertainty_pct"] = law_pct;
  d["outer"][1]["limits_mm"] = {-half_mm, half_mm};
  d["damping_ratio"] = 0.1;
  d["robust"] = true;
  d["budget"]["edge_wear_mm"] = 0.3;
  return d;
}

double share_um(const ToleranceResult& t, const std::string& source) {
  for (const auto& s : t.shares)
    if (s.source == source) return s.um;
  return 0;
}

TEST(UncertainLife, WhatIsKnownTakesNothing) {
  auto d = scattering_pin(0);
  const auto without = plan(part(d));
  ASSERT_EQ(without.status, PlanStatus::ok);
  EXPECT_EQ(share_um(tolerance(without, "d2:diameter"), "life"), 0);
  d["material"]["taylor"]["scatter_pct"] = 0;
  EXPECT_EQ(plan(part(d)).cost_per_part, without.cost_per_part);
  // Every edge is changed in time, whatever C is.
  d = scattering_pin(0, 30);
  d["budget"]["wear_noticed_times"] = 1;
  EXPECT_EQ(plan(part(d)).cost_per_part, without.cost_per_part);
}

// C of the catalogue's C45 is known to 30 %, its lives not even to a factor of two: without
// being asked a plan counts as much of it as is not noticed.
TEST(UncertainLife, TheCataloguesIsCounted) {
  const auto known = plan(part(scattering_pin(0, 0, 0.04)));
  ASSERT_EQ(known.status, PlanStatus::ok);
  auto d = as_planned(scattering_pin(0, 0, 0.04), known);
  d["material"] = "C45";
  const auto p = part_to_predict(d);
  EXPECT_EQ(life_spread(p), 0.5);
  const auto predicted = predict(p);
  const auto& t = tolerance(predicted, "d2:diameter");
  EXPECT_GT(share_um(t, "life"), 0);
  EXPECT_LT(t.P_conform, tolerance(known, "d2:diameter").P_conform - 1e-3);
}

double spread_of(double scatter_pct, double law_pct, double noticed = 2) {
  auto d = scattering_pin(scatter_pct, law_pct);
  d["budget"]["wear_noticed_times"] = noticed;
  return life_spread(part(d));
}

// n of C45 is 0.255: a life is uncertain by four times as much as C.
TEST(UncertainLife, FollowsFromEdgesAndFromTheLaw) {
  EXPECT_NEAR(spread_of(20, 0), (std::exp(0.6) - 1) / 3, 1e-12);
  EXPECT_NEAR(spread_of(0, 2.55), (std::exp(0.3) - 1) / 3, 1e-12);
  EXPECT_NEAR(spread_of(0, 30, 3), 1, 1e-12);
  EXPECT_NEAR(spread_of(20, 5.1), std::sqrt(2.0) * (std::exp(0.6) - 1) / 3, 1e-12);
  double spread = 0;
  for (const double law : {0, 1, 3, 10, 100}) {
    EXPECT_GE(spread_of(10, law), spread);
    spread = spread_of(10, law);
  }
  for (const double noticed : {2.0, 2.5, 10.0}) {
    EXPECT_GE(spread_of(10, 30, noticed), spread);
    spread = spread_of(10, 30, noticed);
  }
}

// Edges drawn one by one: each has a land of its own when it is changed, VB exp(-s Z) of
// a lognormal life, which makes the error that the new edge does not.  What all lives of
// the material are off by is drawn likewise, up to where it is noticed.
TEST(UncertainLife, EdgesThatWearOutEarlyAreCounted) {
  struct Lives {
    double s, law;
  };
  for (const auto& [s, law] :
       {Lives{0.15, 0}, Lives{0.3, 0}, Lives{0, 0.05}, Lives{0, 0.3}, Lives{0.2, 0.3}}) {
    const auto d = scattering_pin(100 * s, 100 * law);
    const auto p = part(d);
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok) << s << ' ' << law;
    const auto& t = tolerance(r, "d2:diameter");
    EXPECT_GT(share_um(t, "life"), 0);
    EXPECT_GE(t.P_conform, 0.9973 - 1e-6);
    const Deviation* d2 = nullptr;
    for (const auto& e : r.deviations)
      if (e.on == "d2") d2 = &e;
    ASSERT_NE(d2, nullptr);
    std::mt19937_64 random(2026);
    std::normal_distribution<double> normal;
    int kept = 0;
    constexpr int kEdges = 100'000;
    for (int k = 0; k < kEdges; ++k) {
      const double all = std::exp(law / p.material.taylor.n * normal(random));
      const double land = std::exp(s * normal(random)) * std::min(all, 2.0);
      const double force = 1 + force_spread(p) * normal(random);
      double worst = 0;
      for (std::size_t i = 0; i < d2->table_mm.size(); ++i) {
        const double fresh = d2->table_mm[i].second, worn = d2->at_change_mm[i].second;
        worst = std::max(worst, 2 * force * (fresh + land * (worn - fresh)));
      }
      kept += worst <= 0.06 - 0.0005;  // and the machine's share at each limit
    }
    EXPECT_GE(static_cast<double>(kept) / kEdges, t.P_conform - 0.001) << s << ' ' << law;
  }
}

TEST(UncertainLife, MoreScatterNeverMakesPartsSafer) {
  const auto r = plan(part(scattering_pin(0)));
  ASSERT_EQ(r.status, PlanStatus::ok);
  double P = 1;
  for (const double pct : {0, 10, 25, 50, 90}) {
    const auto at = predict(part_to_predict(as_planned(scattering_pin(pct), r)));
    const double now = tolerance(at, "d2:diameter").P_conform;
    EXPECT_LE(now, P) << pct;
    P = now;
  }
  EXPECT_LT(P, 0.99);
  P = 1;
  for (const double law_pct : {0, 1, 3, 6, 30}) {
    const auto at =
        predict(part_to_predict(as_planned(scattering_pin(0, law_pct, 0.03), r)));
    const double now = tolerance(at, "d2:diameter").P_conform;
    EXPECT_LE(now, P) << law_pct;
    P = now;
  }
  EXPECT_LT(P, 0.99);
}

// With new edges only what they recede by between two corrections counts.
TEST(UncertainLife, WidensTheWearBetweenCorrections) {
  auto d = scattering_pin(30);
  d["budget"].erase("edge_wear_mm");
  d["budget"]["life_between_offsets"] = 0.1;
  const auto p = part(d);
  const auto a = tolerance_allocation(p, 0, {0, Clamping::chuck, &p.tools[1]});
  double wear = 0, life = 0;
  for (const auto& s : a.spread) {
    if (s.name == "wear") wear = s.value_um;
    if (s.name == "life") life = s.value_um;
  }
  EXPECT_GT(wear, 0);
  EXPECT_NEAR(life, wear * (std::exp(0.9) - 1) / 3, 1e-12 * wear);
}

// A slender pin, for which chatter decides.
nlohmann::json slender_pin(double damping_pct) {
  auto d = pin();
  d["stock"]["length_mm"] = 180;
  d["outer"][0]["limits_mm"] = {-0.05, 0.05};
  d["outer"][1]["length_mm"] = 138;
  d["outer"][1]["limits_mm"] = {-0.05, 0.05};
  d["robust"] = true;
  d["budget"]["first_part_gauged"] = true;
  if (damping_pct > 0) d["damping_uncertainty_pct"] = damping_pct;
  return d;
}

double chatter_share(const ProcessPlan& r) {
  double most = 0;
  for (const auto& s : r.setups)
    for (const auto& o : s.operations)
      for (const auto& c : o.constraints)
        if (c.name == "chatter stiffness") most = std::max(most, c.value / c.limit);
  return most;
}

TEST(UncertainDamping, ARobustPlanKeepsClearOfChatter) {
  const auto known = plan(part(slender_pin(0)));
  ASSERT_EQ(known.status, PlanStatus::ok);
  ASSERT_NEAR(chatter_share(known), 1, 1e-6) << "chatter is to decide";
  EXPECT_EQ(share_um(tolerance(known, "d1:diameter"), "damping"), 0);
  const auto unsure = plan(part(slender_pin(3)));
  ASSERT_EQ(unsure.status, PlanStatus::ok);
  EXPECT_GT(unsure.cost_per_part, known.cost_per_part);
  EXPECT_LE(chatter_share(unsure), 1 + 1e-6);
  EXPECT_GT(share_um(tolerance(unsure, "d1:diameter"), "damping"), 0);
  EXPECT_GE(tolerance(unsure, "d1:diameter").P_conform, 0.9973 - 1e-6);
  // The plan that takes the ratios as they are chatters in every other case.
  auto given = as_planned(slender_pin(3), known);
  const auto at = predict(part_to_predict(given));
  EXPECT_EQ(at.status, PlanStatus::infeasible);
  given["robust"] = false;
  const auto nominal = predict(part_to_predict(given));
  EXPECT_LT(tolerance(nominal, "d1:diameter").P_conform, 0.51);
  EXPECT_GT(tolerance(nominal, "d1:diameter").P_conform, 0.4);
}

// hmin 2 um with 50 %: Ra of the formula with the quantile in place of hmin.
TEST(UncertainRoughness, IsKeptWithTheProbabilityThatIsAskedFor) {
  auto d = pin();
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  auto given = as_planned(d, r);
  const auto Ra_um = [&] {
    const auto at = predict(part_to_predict(given));
    for (const auto& c : operation(at, "s1-finish-d2").constraints)
      if (c.name == "roughness Ra") return c.value;
    return 0.0;
  };
  const double before = Ra_um();
  given["roughness_conformance"] = 0.95;
  const auto& pass = operation(r, "s1-finish-d2").passes[0];
  const double h = 0.002 * (1 + 0.5 * beyond(0.05)), corner = 0.4;
  const double f = pass.f_mm_rev;
  const double Rz = f * f / (8 * corner) + h / 2 * (1 + corner * h / (f * f));
  EXPECT_NEAR(Ra_um(), 1000 * Rz * 8 / (18 * std::sqrt(3.0)), 1e-6);
  EXPECT_GT(Ra_um(), before);
}

// Grooves of 5 um per mm of land, 30 %, at VB 0.2 mm beside the profile of the feed.
TEST(UncertainRoughness, CountsTheWornEdgesGrooves) {
  auto d = pin();
  d["material"] = file("materials/C45.json");
  d["material"]["worn_roughness"] = {
      {"land_Ra_um_mm", 5}, {"uncertainty_pct", 30}, {"source", "this test"}};
  d["budget"]["edge_wear_mm"] = 0.2;
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  auto given = as_planned(d, r);
  const auto Ra_um = [&](double VB_mm) {
    given["budget"]["edge_wear_mm"] = VB_mm;
    const auto at = predict(part_to_predict(given));
    for (const auto& c : operation(at, "s1-finish-d2").constraints)
      if (c.name == "roughness Ra") return c.value;
    return 0.0;
  };
  const double fresh = Ra_um(0);
  EXPECT_GT(fresh, 0);
  EXPECT_NEAR(Ra_um(0.2), std::hypot(fresh, 1.0), 1e-9);
  given["roughness_conformance"] = 0.95;
  const double chip = Ra_um(0);
  EXPECT_NEAR(Ra_um(0.2), std::hypot(chip, 1 + 0.3 * beyond(0.05)), 1e-9);
}

}  // namespace
}  // namespace turnwright::planning
