#include <gtest/gtest.h>

#include <cmath>

#include "parts.hpp"
#include "turnwright/cutting/cut.hpp"

namespace turnwright::planning {
namespace {

// A pin whose finishing edges are changed at a wear land.
nlohmann::json worn_pin(double VB_mm) {
  auto d = pin();
  d["outer"][1]["limits_mm"] = {-0.02, 0.02};
  d["tolerances"] = {
      {{"id", "t"}, {"kind", "cylindricity"}, {"of", "d2"}, {"value_mm", 0.012}}};
  d["damping_ratio"] = 0.1;
  d["budget"]["edge_wear_mm"] = VB_mm;
  return d;
}

const Deviation& deviation_of(const ProcessPlan& r, const std::string& on) {
  for (const auto& d : r.deviations)
    if (d.on == on) return d;
  throw std::runtime_error("no deviation of " + on);
}

// The plan holds at every wear up to that of the change, by predictions of its conditions;
// more wear never widens a margin, and never lets an edge make more parts.
TEST(EdgeWear, ThePlanHoldsFromTheNewEdgeToTheChange) {
  const auto d = worn_pin(0.3);
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  double margin = 1, life = 0;
  for (const double VB : {0.001, 0.1, 0.2, 0.3}) {
    auto given = as_planned(d, r);
    given["budget"]["edge_wear_mm"] = VB;
    const auto at = predict(part_to_predict(given));
    for (const char* id : {"d2:diameter", "t"})
      EXPECT_GE(tolerance(at, id).margin_mm, -1e-9) << id << ' ' << VB;
    EXPECT_LE(tolerance(at, "t").margin_mm, margin + 1e-12);
    margin = tolerance(at, "t").margin_mm;
    const double T = operation(at, "s1-finish-d2").passes[0].T_min;
    EXPECT_GT(T, life);
    life = T;
  }
}

TEST(EdgeWear, NewEdgesAreToldBesideThoseDueForChange) {
  auto d = worn_pin(0.3);
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  d = as_planned(d, r);
  d["budget"]["edge_wear_mm"] = 0;
  const auto fresh = predict(part_to_predict(d));
  for (const auto& worn : r.deviations)
    for (const auto& alone : fresh.deviations)
      if (worn.on == alone.on) {
        ASSERT_EQ(worn.at_change_mm.size(), worn.table_mm.size());
        EXPECT_TRUE(alone.at_change_mm.empty());
        for (std::size_t k = 0; k < worn.table_mm.size(); ++k)
          EXPECT_NEAR(worn.table_mm[k].second, alone.table_mm[k].second, 1e-12);
      }
  EXPECT_GT(tolerance(fresh, "t").margin_mm, tolerance(r, "t").margin_mm);
  const auto& d2 = deviation_of(r, "d2");
  EXPECT_GT(std::abs(d2.at_change_mm.back().second),
            1.5 * std::abs(d2.table_mm.back().second));
}

// Forces written anew: three times the passive force of a new edge at VB 0.3 mm.
TEST(EdgeWear, ForcesAreThoseOfTheWornEdge) {
  const auto d = worn_pin(0.3);
  const auto p = part(d);
  const auto r = plan(p);
  const auto& pass = operation(r, "s1-finish-d2").passes[0];
  const auto fresh = cutting::cut_of(p.material, p.tools[1]);
  const auto F = cutting::forces_N(fresh, pass.ap_mm, pass.f_mm_rev);
  const double L = cutting::engaged_edge_mm(fresh, pass.ap_mm, pass.f_mm_rev);
  const double land = 0.58 * 1600 * 0.3 * L;
  EXPECT_NEAR(pass.Fc_N, F.Fc_N + 0.4 * land, 1e-9 * pass.Fc_N);
  EXPECT_NEAR(std::hypot(pass.Ff_N, pass.Fp_N), std::hypot(F.Ff_N, F.Fp_N) + land,
              1e-9 * land);
  EXPECT_NEAR(pass.Fp_N / pass.Ff_N, F.Fp_N / F.Ff_N, 1e-12);
  const double life =
      cutting::tool_life_min(fresh, pass.vc_m_min, pass.f_mm_rev, pass.ap_mm);
  EXPECT_NEAR(pass.T_min, life, 1e-9 * life);  // the whole life
}

// The price of changing earlier: fewer parts of an edge, where its wear binds nothing.
// What is told of it is the plan of that request.
TEST(EdgeWear, AnEarlierChangeHasAPriceThatIsTold) {
  auto d = worn_pin(0.3);
  d.erase("tolerances");
  d["outer"][1]["limits_mm"] = {-0.2, 0.2};
  d["what_if"] = {{{"name", "change at 0.2"}, {"set", {{"/budget/edge_wear_mm", 0.2}}}}};
  const auto loaded = document::prepared_part(d, shop(), "part");
  const auto r = plan(loaded.part, loaded.what_if);
  d.erase("what_if");
  d["budget"]["edge_wear_mm"] = 0.2;
  const auto early = plan(part(d));
  EXPECT_GT(early.cost_per_part, r.cost_per_part);
  ASSERT_EQ(r.what_if.size(), 1u);
  EXPECT_NEAR(*r.what_if[0].saves_per_part, r.cost_per_part - early.cost_per_part, 1e-9);
  EXPECT_TRUE(r.what_if[0].sentence.starts_with("change at 0.2"))
      << r.what_if[0].sentence;
}

// Rougher and finisher are changed when each is due: a new finisher meets what a worn
// rougher has left, written anew as a prediction in which nothing but that is worn.
TEST(EdgeWear, EitherEdgeMayBeNewWhileTheOtherIsWorn) {
  auto d = worn_pin(0.3);
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  auto given = as_planned(d, r);
  given["budget"]["edge_wear_mm"] = 1e-6;  // the finisher is new, the rougher at 0.3
  const auto at = predict(part_to_predict(given));
  EXPECT_GE(tolerance(r, "t").predicted_mm[0], tolerance(at, "t").predicted_mm[0]);
  EXPECT_LE(tolerance(r, "t").P_conform, tolerance(at, "t").P_conform + 1e-12);
  given["budget"]["edge_wear_mm"] = 0;
  const auto fresh = predict(part_to_predict(given));
  EXPECT_GE(tolerance(at, "t").predicted_mm[0], tolerance(fresh, "t").predicted_mm[0]);
}

// No path is corrected for a force that grows, neither in a plan nor in a prediction.
TEST(EdgeWear, ACorrectedPathIsNotProposed) {
  auto d = worn_pin(0.3);
  const auto wide = plan(part(d));
  d["outer"][1]["limits_mm"] = {-0.0015, 0.0015};
  const auto r = plan(part(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  EXPECT_TRUE(r.compensation.empty());
  double most = 0;
  for (const auto& [z, e] : deviation_of(wide, "d2").at_change_mm)
    most = std::max(most, std::abs(e));
  d.erase("tolerances");
  d["outer"][1]["limits_mm"] = {-1.5 * most, 1.5 * most};
  const auto given = predict(part_to_predict(as_planned(d, wide)));
  EXPECT_TRUE(given.compensation.empty());
  EXPECT_EQ(tolerance(given, "d2:diameter").verdict, Verdict::not_met);
}

// An offset that is corrected rarely lags behind: fewer parts conform.
TEST(EdgeWear, AnOffsetThatLagsTakesItsShare) {
  auto d = worn_pin(0.3);
  d.erase("tolerances");
  d["outer"][1]["limits_mm"] = {-0.008, 0.008};
  d["budget"]["first_part_gauged"] = true;
  d["budget"]["wear_land_mm"] = 0.3;
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_EQ(r.offsets.size(), 1u);
  EXPECT_GT(std::abs(*r.offsets[0].at_change_mm), 2 * std::abs(r.offsets[0].offset_mm));
  auto given = as_planned(d, r);
  const auto always = predict(part_to_predict(given));
  given["budget"]["life_between_offsets"] = 1;
  const auto never = predict(part_to_predict(given));
  EXPECT_LT(tolerance(never, "d2:diameter").P_conform,
            tolerance(always, "d2:diameter").P_conform);
}

}  // namespace
}  // namespace turnwright::planning
