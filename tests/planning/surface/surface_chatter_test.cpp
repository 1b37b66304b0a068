#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"
#include "planning/operation/bar_tip.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/deflection/beam.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

// Regenerative chatter as a limit of every pass.
namespace turnwright::planning {
namespace {

constexpr const char* kName = "chatter stiffness";

const ConstraintValue& chatter_of(const OperationPlan& o) {
  for (const auto& c : o.constraints)
    if (c.name == kName) return c;
  throw std::out_of_range(o.id);
}

// One cylinder of 30 mm that stands 150 mm out of the jaws, finished in the chuck.
nlohmann::json slender(double zeta) {
  return {
      {"material", "C45"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", 32},
        {"length_mm", 180},
        {"left_allowance_mm", 0}}},
      {"outer",
       {{{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 31}},
        {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 150}, {"diameter_mm", 30}}}},
      {"machine", "lathe-medium"},
      {"tools", {"PDJNL-DNMG150604-PF"}},
      {"setups",
       {{{"hold", "left"}, {"grip_mm", 30}, {"clampings", {"chuck"}}},
        {{"hold", "right"}, {"grip_mm", 100}, {"clampings", {"chuck"}}}}},
      {"operations",
       {{{"id", "cut"},
         {"setup", 0},
         {"kind", "finish"},
         {"on", {"d2"}},
         {"tool", "PDJNL-DNMG150604-PF"},
         {"conditions", {{"passes", 1}}}},
        {{"id", "rest"},
         {"setup", 1},
         {"kind", "finish"},
         {"on", {"d1"}},
         {"tool", "PDJNL-DNMG150604-PF"}}}},
      {"rates", {{"machine_per_min", 1.0}}},
      {"general", "ISO 2768-c"},
      {"machine_share_um", 0},
      {"damping_ratio", zeta}};
}

// Stable at every speed below 2 k zeta (1 + zeta)/K, unstable at some just above.
TEST(Chatter, LimitIsThatOfTheStabilityOfTurning) {
  const double k = 4000, zeta = 0.03, K_MPa = 700;
  const double limit_mm = 2 * k * zeta * (1 + zeta) / K_MPa;
  chatter::System s;
  s.exit_rad = 2 * units::kPi;
  s.force = chatter::ConstantForce{K_MPa};
  s.modes = {{chatter::Axis::x, 2 * units::kPi * 120, zeta, k}};
  double least = 1e9;
  for (double n = 1920; n < 2040; n += 4)
    if (const auto at = chatter::speed_limits(s, n, 3 * limit_mm).limit_mm())
      least = std::min(least, *at);
  EXPECT_GE(least, limit_mm * (1 - 1e-9));
  EXPECT_LE(least, limit_mm * 1.002);
}

// With the sum of static compliances for two modes, safe at every speed.
TEST(Chatter, StaticComplianceIsSafeForSeveralModes) {
  const double zeta = 0.03, K_MPa = 700;
  chatter::System s;
  s.exit_rad = 2 * units::kPi;
  s.force = chatter::ConstantForce{K_MPa};
  s.modes = {{chatter::Axis::x, 2 * units::kPi * 120, zeta, 6000},
             {chatter::Axis::x, 2 * units::kPi * 310, 0.05, 9000}};
  const double limit_mm =
      1 / (K_MPa * (1 / (6000 * 2 * 0.03 * 1.03) + 1 / (9000 * 2 * 0.05 * 1.05)));
  for (double n = 2500; n < 6000; n += 125)
    EXPECT_EQ(chatter::multipliers(s, n, 0.999 * limit_mm).unstable, 0) << n;
}

TEST(Chatter, IsAConstraintWithItsValueAndLimitInClosedForm) {
  const double zeta = 0.03;
  const auto p = part(slender(zeta));
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& o = operation(r, "cut");
  const auto& c = chatter_of(o);
  const auto& pass = o.passes.at(0);
  const auto cut = cutting::cut_of(p.material, p.tools[0]);
  const auto F = cutting::forces_N(cut, pass.ap_mm, pass.f_mm_rev);
  const double u = cutting::flow_cotangent(cut, pass.ap_mm, pass.f_mm_rev);
  EXPECT_NEAR(c.value, 0.4 * F.Fc_N * u * u / std::hypot(1, u) / pass.f_mm_rev,
              1e-9 * c.value);
  // Worst where the cut begins, at the free end: the blank is still whole.
  const deflection::Beam beam(
      part::Shaft{p.material.E_MPa, p.material.nu, {{150, 32, 32, 0, 0}}});
  const auto& m = p.machine;
  const auto& chuck = m.chuck.radial;
  const double f_ww = beam.at(150, {deflection::Method::chuck,
                                    {chuck.c0_mm_N, chuck.c1_rad_N, chuck.c2_rad_Nmm}})
                          .f_ww_mm_N;
  EXPECT_NEAR(c.limit, 2 * zeta * (1 + zeta) / (f_ww + m.tool_rr_mm_N), 1e-6 * c.limit);
  EXPECT_NEAR(c.margin, -std::log(c.value / c.limit), 1e-9);
  EXPECT_EQ(c.unit, "N/mm");
}

// Without a given damping the part bends with 0.012, and what holds and cuts it has 0.03.
TEST(Chatter, BendingAndSupportsHaveTheirOwnDamping) {
  auto d = slender(1);
  d.erase("damping_ratio");
  const auto p = part(d);
  const auto r = plan(p);
  const auto& c = chatter_of(operation(r, "cut"));
  const auto& m = p.machine;
  const auto& chuck = m.chuck.radial;
  const double L = 150, arm = L * L * chuck.c2_rad_Nmm + 2 * L * chuck.c1_rad_N;
  const double supports = chuck.c0_mm_N + arm;  // a rigid body in the chuck
  const deflection::Beam beam(
      part::Shaft{p.material.E_MPa, p.material.nu, {{L, 32, 32, 0, 0}}});
  const double bending = beam.at(L, {deflection::Method::chuck, {0, 0, 0}}).f_ww_mm_N;
  const auto damped = [](double zeta) { return 2 * zeta * (1 + zeta); };
  EXPECT_NEAR(c.limit,
              1 / (bending / damped(0.012) + (supports + m.tool_rr_mm_N) / damped(0.03)),
              2e-3 * c.limit);
}

// One pass of 95 deg over a stiff shaft in the chuck at given conditions, on a machine whose
// toolpost yields along the feed.
nlohmann::json given_pass(double ap_mm, double tool_zz_mm_N) {
  constexpr double kD_mm = 60;
  const double blank = kD_mm + 2 * ap_mm;
  auto machine = file("machines/lathe-medium.json");
  if (tool_zz_mm_N > 0) machine["stiffness"]["tool_zz_mm_N"] = tool_zz_mm_N;
  return {
      {"format", "turnwright-part/1"},
      {"name", "shaft"},
      {"material", "C45"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", blank},
        {"length_mm", 120},
        {"left_allowance_mm", 0}}},
      {"outer",
       {{{"id", "held"},
         {"kind", "cylinder"},
         {"length_mm", 60},
         {"diameter_mm", blank - 0.1}},
        {{"id", "d"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", kD_mm}}}},
      {"machine", machine},
      {"tools", {"PCLNL-CNMG120408-PM"}},
      {"damping_ratio", 0.03},
      {"setups", {{{"hold", "left"}, {"grip_mm", 50}, {"clampings", {"chuck"}}}}},
      {"operations",
       {{{"id", "turn"},
         {"kind", "finish"},
         {"on", {"d"}},
         {"tool", "PCLNL-CNMG120408-PM"},
         {"setup", 0},
         {"conditions",
          {{"passes", 1}, {"vc_m_min", 200}, {"f_mm_rev", 0.2}, {"ap_mm", ap_mm}}}}}}};
}

ConstraintValue chatter_at(const nlohmann::json& d) {
  return chatter_of(operation(predict(part_to_predict(d)), "turn"));
}
double gain_of(const nlohmann::json& d) {
  const auto c = chatter_at(d);
  return c.value / c.limit;
}

// What yields along the feed adds K_zz of its compliance, written anew.
TEST(Chatter, AToolpostThatYieldsAlongTheFeedAddsToIt) {
  constexpr double kAp_mm = 3, kFeed_mm = 0.2, kAxial_mm_N = 1e-5, kZeta = 0.03;
  const auto d = given_pass(kAp_mm, kAxial_mm_N);
  const auto p = part_to_predict(d);
  const auto radial = chatter_at(given_pass(kAp_mm, 0)), c = chatter_at(d);
  const auto cut = cutting::cut_of(p.material, p.tools.at(0));
  const double u = cutting::flow_cotangent(cut, kAp_mm, kFeed_mm);
  const double K_zz =
      0.4 * cutting::forces_N(cut, kAp_mm, kFeed_mm).Fc_N / std::hypot(1, u) / kFeed_mm;
  EXPECT_NEAR(c.value, K_zz * (1 + u * u), 1e-9 * c.value);
  EXPECT_NEAR(radial.value, K_zz * u * u, 1e-9 * radial.value);
  const double yields = (kAxial_mm_N + p.machine.chuck.axial_mm_N) / (2 * kZeta * 1.03);
  EXPECT_NEAR(c.value / c.limit, radial.value / radial.limit + K_zz * yields,
              1e-9 * c.value / c.limit);
  EXPECT_NEAR(c.margin, -std::log(c.value / c.limit), 1e-9);
}

// Measured chatter grows with the depth of cut.  By radial motion alone that of a 95 deg
// edge falls beyond its corner.
TEST(Chatter, AlongTheFeedDeepCutsComeCloserToIt) {
  double radial = 1e9, both = 0;
  for (const double ap : {1.5, 2.5, 4.0}) {
    const double alone = gain_of(given_pass(ap, 0)), now = gain_of(given_pass(ap, 1e-5));
    EXPECT_LT(alone, radial) << ap;
    EXPECT_GT(now, both) << ap;
    EXPECT_GT(now, alone) << ap;
    radial = alone;
    both = now;
  }
}

// A plan in which it binds is certified, and dearer than one that does not count it.
TEST(Chatter, AlongTheFeedItBindsAndIsCertified) {
  auto d = pin();
  d["stock"]["diameter_mm"] = 60;
  const auto radial = plan(part(d));
  ASSERT_EQ(radial.status, PlanStatus::ok);
  d["machine"] = file("machines/lathe-medium.json");
  d["machine"]["stiffness"]["tool_zz_mm_N"] = 4e-5;
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  EXPECT_GT(r.cost_per_part, radial.cost_per_part * (1 + 1e-3));
  double least = 1;
  for (const auto& s : r.setups)
    for (const auto& o : s.operations)
      if (o.kind != OperationKind::fixed) {
        EXPECT_GE(chatter_of(o).margin, -1e-9) << o.id;
        least = std::min(least, chatter_of(o).margin);
      }
  EXPECT_LT(least, 1e-6);
}

// The tip lies beside the bar's axis, so that a bar that bends moves it along the feed: by
// f^2 (L/EI + c2) per feed force.
TEST(Chatter, TheSlopeOfABoringBarCounts) {
  catalogue::BoringBar bar;
  bar.E_MPa = 210000;
  bar.nu = 0.3;
  bar.segments = {{100, 25, 0}};
  bar.tip_offset_mm = 17;
  bar.holder.c2_rad_Nmm = 3e-10;
  const double EI = 210000 * units::kPi * std::pow(25, 4) / 64;
  EXPECT_NEAR(tip_of(bar).z, 17 * 17 * (100 / EI + 3e-10), 1e-15);
  auto p = part(reference_part("flanged-bush"));
  const auto r = plan(p);
  auto given = part_to_predict(as_planned(reference_part("flanged-bush"), r));
  const auto most = [&] {
    double gain = 0;
    for (const auto& s : predict(given).setups)
      for (const auto& o : s.operations)
        if (o.kind == OperationKind::bore_finish)
          gain = std::max(gain, chatter_of(o).value / chatter_of(o).limit);
    return gain;
  };
  const double before = most();
  EXPECT_GT(before, 0);
  for (auto& t : given.tools)
    if (t.bar) t.bar->tip_offset_mm *= 1.5;
  EXPECT_GT(most(), before * 1.001);
}

// Where it binds, the plan is dearer than with more damping, says so, and is certified.
TEST(Chatter, BindsOnSlenderWorkAndHasAPrice) {
  auto d = reference_part("titanium-pin");
  d["damping_ratio"] = 0.009;
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  const auto& c = chatter_of(operation(r, "s1-finish-d2"));
  EXPECT_TRUE(c.binding);
  EXPECT_GE(c.margin, -1e-9);
  d["damping_ratio"] = 0.4;
  const auto damped = plan(part(d));
  ASSERT_EQ(damped.status, PlanStatus::ok);
  EXPECT_FALSE(chatter_of(operation(damped, "s1-finish-d2")).binding);
  EXPECT_GT(r.cost_per_part, damped.cost_per_part * (1 + 1e-3));
}

// d cost/d ln(zeta) against two plans.
TEST(Chatter, ItsPriceIsTheSlopeOfTheCost) {
  auto d = reference_part("titanium-pin");
  const auto with = [&](double share) {
    d["damping_ratio"] = 0.009 * share;
    return plan(part(d));
  };
  const double h = 0.01;
  double told = 0;
  for (const auto& price : with(1).prices)
    if (price.limit.find("damping ratio of ") == 0)
      told += price.saves_per_part_for_10_percent / std::log(1.1);
  const double slope = (with(1 - h).cost_per_part - with(1 + h).cost_per_part) /
                       (std::log(1 + h) - std::log(1 - h));
  EXPECT_GT(told, 0);
  EXPECT_NEAR(told, slope, 0.02 * slope);
}

TEST(Chatter, WhatNothingKeepsIsAConflict) {
  const auto r = plan(part(slender(0.002)));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_TRUE(std::any_of(r.conflicts.begin(), r.conflicts.end(),
                          [](const Conflict& x) { return x.limit == kName; }));
  EXPECT_TRUE(std::any_of(r.relax.begin(), r.relax.end(), [](const Relaxation& x) {
    return x.limit == kName && x.needed > x.now;
  }));
}

TEST(Chatter, PredictSaysWhatThePlanSays) {
  const auto d = slender(0.03);
  const auto r = plan(part(d));
  const auto& o = operation(r, "cut");
  const auto again = predict(part_to_predict(as_planned(d, r)));
  const auto &a = chatter_of(o), &b = chatter_of(operation(again, "cut"));
  EXPECT_NEAR(a.value, b.value, 1e-9 * a.value);
  EXPECT_NEAR(a.limit, b.limit, 1e-9 * a.limit);
}

// Of every shipped part each turned or bored operation has the constraint, kept.
TEST(Chatter, EveryOperationOfAReferencePartKeepsIt) {
  for (const auto* name : {"flanged-bush", "piston-rod"}) {
    const auto r = plan(part(reference_part(name)));
    ASSERT_EQ(r.status, PlanStatus::ok) << name;
    for (const auto& s : r.setups)
      for (const auto& o : s.operations)
        if (o.kind != OperationKind::fixed) {
          EXPECT_GE(chatter_of(o).margin, -1e-9) << o.id;
        }
  }
}

// The bar's own damping counts for the bar alone.
TEST(Chatter, ADampedBarBearsMore) {
  auto p = part(reference_part("flanged-bush"));
  const auto limit = [&] {
    double least = 1e300;
    for (const auto& s : plan(p).setups)
      for (const auto& o : s.operations)
        if (o.kind == OperationKind::bore_finish)
          least = std::min(least, chatter_of(o).limit);
    return least;
  };
  const double before = limit();
  for (auto& t : p.tools)
    if (t.bar) t.bar->damping_ratio = 0.1;
  EXPECT_GT(limit(), before);
}

}  // namespace
}  // namespace turnwright::planning
