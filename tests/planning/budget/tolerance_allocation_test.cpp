#include "planning/budget/tolerance_allocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../parts.hpp"
#include "planning/budget/cut_tolerance.hpp"
#include "planning/clamping/supports.hpp"
#include "planning/preparation/assignment.hpp"
#include "planning/surface/machined_surface.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/deflection/thrust.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

// A tube of steel, 60/40, 100 long, held 20 mm deep at its left end.
nlohmann::json tube(double grip_force_N) {
  auto d = pin();
  d["stock"] = {{"kind", "tube"}, {"outer_mm", 60}, {"inner_mm", 40}, {"length_mm", 104}};
  d["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 58}},
      {{"id", "d2"},
       {"kind", "cylinder"},
       {"length_mm", 40},
       {"diameter_mm", 56},
       {"limits_mm", {-0.04, 0}}}};
  d["tolerances"] = {
      {{"id", "c1"}, {"kind", "circularity"}, {"of", "d1"}, {"value_mm", 0.02}},
      {{"id", "c2"}, {"kind", "circularity"}, {"of", "d2"}, {"value_mm", 0.02}}};
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 20}, {"clampings", {"chuck"}}},
                 {{"hold", "right"}, {"grip_mm", 20}, {"clampings", {"chuck"}}}};
  if (grip_force_N > 0)
    for (auto& s : d["setups"]) s["finishing_grip_force_N"] = grip_force_N;
  return d;
}

nlohmann::json pin_with(const nlohmann::json& budget) {
  auto d = pin();
  d["outer"][1]["limits_mm"] = {-0.05, 0};
  d["budget"].update(budget);
  return d;
}

std::size_t tolerance(const PreparedPart& p, const std::string& id) {
  for (std::size_t i = 0; i < p.drawing.tolerances.size(); ++i)
    if (p.drawing.tolerances[i].id == id) return i;
  throw std::out_of_range(id);
}

Making in_chuck(const PreparedPart& p, std::size_t setup) {
  return {setup, Clamping::chuck, &p.tools.at(1)};
}

double share_um(const ToleranceAllocation& a, const std::string& source) {
  for (const auto& s : shares(a))
    if (s.source == source) return s.um;
  return 0;
}

// Sizes: each source by hand, then together.
TEST(ToleranceAllocation, OfADiameterIsTheRootOfTheSumOfSquaresAtBothLimits) {
  const auto p = part(pin_with({{"drift_um", 2},
                                {"repeatability_um", 0.5},
                                {"part_warm_K", 10},
                                {"life_between_offsets", 0.1},
                                {"measurement_U_um", 1.5}}));
  const auto a = tolerance_allocation(p, tolerance(p, "d2:diameter"), in_chuck(p, 0));
  const auto& tool = p.tools.at(1);
  const double tan_a = std::tan(tool.alpha_deg * units::kPi / 180);
  const double tan_g = std::tan(tool.gamma_deg * units::kPi / 180);
  const double drift = 2 * 2, repeat = 2 * 3 * 0.5;
  const double heat = 2 * p.material.expansion_1_K * 10 * 32 / 4 * 1000;
  const double wear = 2 * 0.3 * tan_a / (1 - tan_a * tan_g) * 0.1 / 2 * 1000;
  EXPECT_NEAR(share_um(a, "drift"), 2 * drift, 1e-12);
  EXPECT_NEAR(share_um(a, "repeatability"), 2 * repeat, 1e-12);
  EXPECT_NEAR(share_um(a, "heat"), 2 * heat, 1e-9);
  EXPECT_NEAR(share_um(a, "wear"), 2 * wear, 1e-9);
  EXPECT_NEAR(share_um(a, "measurement"), 3, 1e-12);
  // C45's lives are known to no factor of two: an edge with twice the land is noticed.
  const double life = 3 * 0.5 * wear;
  EXPECT_NEAR(share_um(a, "life"), 2 * life, 1e-9);
  const double rss = std::sqrt(drift * drift + repeat * repeat + heat * heat +
                               wear * wear + life * life);
  EXPECT_NEAR(taken_mm(a) * 1000, 1 + 3 + 2 * rss, 1e-9);
}

TEST(ToleranceAllocation, OfALengthCountsEveryFaceThatIsCut) {
  auto d = pin_with({{"drift_axial_um", 3}, {"part_warm_K", 8}});
  d["tolerances"] = {{{"id", "l"},
                      {"kind", "length"},
                      {"between", {"left", "right"}},
                      {"limits_mm", {-0.1, 0.1}}}};
  const auto p = part(d);
  const auto a = tolerance_allocation(p, tolerance(p, "l"), in_chuck(p, 0));
  const double heat =
      p.material.expansion_1_K * 8 * 90 / 2 * 1000;  // both faces together
  EXPECT_NEAR(taken_mm(a) * 1000, 1 + 4 * std::hypot(3, heat / 2), 1e-9);
  const auto asked = cut_tolerances(p, "right", Offset::none, in_chuck(p, 0));
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_NEAR(asked[0].upper, (0.2 - taken_mm(a)) / 4, 1e-15);
}

// Two lengths to one shoulder that ask for it at two places.
TEST(ToleranceAllocation, OfAChainCountsHowFarItsLengthsAreFromTheirMiddles) {
  auto d = pin();
  d["tolerances"] = {{{"id", "l"},
                      {"kind", "length"},
                      {"between", {"left", "d1|d2"}},
                      {"limits_mm", {-0.1, 0.1}}},
                     {{"id", "m"},
                      {"kind", "length"},
                      {"between", {"d1|d2", "right"}},
                      {"limits_mm", {-0.08, 0.12}}}};
  const auto p = part(d);
  for (const char* id : {"l", "m"}) {
    const auto a = tolerance_allocation(p, tolerance(p, id), in_chuck(p, 0));
    EXPECT_NEAR(share_um(a, "chain"), 2 * 10, 1e-9) << id;  // each 0.01 mm off
  }
  d["tolerances"][1]["limits_mm"] = {-0.1, 0.1};
  const auto q = part(d);
  EXPECT_EQ(share_um(tolerance_allocation(q, tolerance(q, "l"), in_chuck(q, 0)), "chain"),
            0);
}

// From a shoulder to the end, both cut in the first setup.
nlohmann::json stepped(const nlohmann::json& budget) {
  auto d = pin_with(budget);
  d["tolerances"] = {{{"id", "l"},
                      {"kind", "length"},
                      {"between", {"d1|d2", "right"}},
                      {"limits_mm", {-0.1, 0.1}}}};
  return d;
}

TEST(ToleranceAllocation, WhatShiftsBothFacesOfALengthLeavesItAsItIs) {
  const auto p = part(stepped(
      {{"drift_axial_um", 8}, {"life_between_offsets", 0.5}, {"wear_noticed_times", 1}}));
  const auto a = tolerance_allocation(p, tolerance(p, "l"), in_chuck(p, 0));
  EXPECT_TRUE(a.spread.empty());
  EXPECT_NEAR(taken_mm(a) * 1000, 1, 1e-12);  // the machine's share
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& t : r.tolerances)
    if (t.id == "l") {
      for (const auto& share : t.shares)
        EXPECT_TRUE(share.source == "deflection" || share.source == "machine")
            << share.source;
    }
}

// The finishing tool faces a shoulder behind an undercut, the facing tool the end.
TEST(ToleranceAllocation, TheShoulderBehindAnUndercutWearsAnotherTool) {
  auto d = stepped({{"life_between_offsets", 0.5}, {"wear_noticed_times", 1}});
  const auto wear = [&] {
    const auto p = part(d);
    return share_um(tolerance_allocation(p, tolerance(p, "l"), in_chuck(p, 0)), "wear");
  };
  EXPECT_EQ(wear(), 0);
  d["edges"] = {{{"at", "d1|d2"}, {"undercut", "E0.8x0.3"}}};
  EXPECT_GT(wear(), 0);
}

// Parts drawn one by one: the edges' wear is each tool's own, the drift that of both.
TEST(ToleranceAllocation, WithTwoToolsTheWearOfEachCounts) {
  auto d = stepped({{"drift_axial_um", 8}, {"life_between_offsets", 0.5}});
  d["tools"].push_back("PCLNL-CNMG120404-PF");
  d["budget"]["wear_noticed_times"] = 1;  // the wear is known
  const auto face = [](const char* id, int setup, const char* on, const char* tool) {
    return nlohmann::json{
        {"id", id}, {"setup", setup}, {"kind", "face"}, {"on", {on}}, {"tool", tool}};
  };
  d["operations"] = {face("a", 0, "right", "PCLNL-CNMG120408-PM"),
                     face("b", 0, "d1|d2", "PCLNL-CNMG120404-PF"),
                     face("c", 1, "left", "PCLNL-CNMG120408-PM"),
                     {{"id", "e"}, {"setup", 0}, {"kind", "finish"}, {"on", {"d2"}}},
                     {{"id", "f"}, {"setup", 1}, {"kind", "finish"}, {"on", {"d1"}}}};
  const auto p = part(d);
  const auto at = [&](const std::string& tool) {
    const auto it = std::find_if(p.tools.begin(), p.tools.end(),
                                 [&](const auto& t) { return t.id == tool; });
    return tolerance_allocation(p, tolerance(p, "l"), {0, Clamping::chuck, &*it});
  };
  const auto end = at("PCLNL-CNMG120408-PM"), shoulder = at("PCLNL-CNMG120404-PF");
  ASSERT_EQ(end.spread.size(), 1u);
  ASSERT_EQ(shoulder.spread.size(), 1u);
  const double w1 = end.spread[0].value_um, w2 = shoulder.spread[0].value_um;
  EXPECT_GT(w1, 0);
  std::mt19937 seed(5);
  const auto uniform = [&](double half) {
    return std::uniform_real_distribution<double>(-half, half)(seed);
  };
  double squares = 0;
  constexpr int kParts = 200000;
  for (int k = 0; k < kParts; ++k) {
    const double drift = uniform(8);
    const double length = (drift + uniform(w1)) - (drift + uniform(w2));
    squares += length * length;
  }
  EXPECT_NEAR(std::sqrt(squares / kParts), std::sqrt((w1 * w1 + w2 * w2) / 3), 0.01 * w1);
}

TEST(ToleranceAllocation, FormsAreLeftAloneByWhatMovesSizes) {
  auto d = pin_with({{"drift_um", 5}, {"repeatability_um", 2}, {"part_warm_K", 20}});
  d["tolerances"] = {
      {{"id", "z"}, {"kind", "cylindricity"}, {"of", "d2"}, {"value_mm", 0.01}}};
  const auto p = part(d);
  EXPECT_NEAR(taken_mm(tolerance_allocation(p, tolerance(p, "z"), in_chuck(p, 0))), 0.001,
              1e-15);
}

TEST(ToleranceAllocation, RechuckingCountsTowardsADatumOfAnotherSetup) {
  auto d = pin_with({{"rechucking_um", 2}});
  d["tolerances"] = {{{"id", "x"},
                      {"kind", "coaxiality"},
                      {"of", "d2"},
                      {"datum", "d1"},
                      {"value_mm", 0.03}}};
  const auto p = part(d);
  const auto x = tolerance(p, "x");
  // The vector that 0.135 % of rayleigh's exceed, a run-out of twice its length.
  EXPECT_NEAR(share_um(tolerance_allocation(p, x, in_chuck(p, 0)), "rechucking"),
              2 * 2 * std::sqrt(-2 * std::log(0.00135)), 1e-9);
  EXPECT_EQ(share_um(tolerance_allocation(p, x, in_chuck(p, 1)), "rechucking"), 0);
}

// Jaws and centres each with their own, the later of two setups deciding.
TEST(ToleranceAllocation, RechuckingIsThatOfWhatHoldsThePartInTheLaterSetup) {
  auto d =
      pin_with({{"rechucking_um",
                 {{"hard_jaws", 6}, {"soft_jaws", 2}, {"collet", 1}, {"centres", 0.5}}}});
  d["tolerances"] = {{{"id", "x"},
                      {"kind", "total-radial-runout"},
                      {"of", "d1"},
                      {"datum", "d2"},
                      {"value_mm", 0.1}}};
  const double reach = 2 * std::sqrt(-2 * std::log(0.00135));
  const auto share = [&](std::size_t setup, Clamping c) {
    const auto p = part(d);
    return share_um(tolerance_allocation(p, tolerance(p, "x"), {setup, c, nullptr}),
                    "rechucking");
  };
  EXPECT_NEAR(share(1, Clamping::chuck), 2 * reach, 1e-9);
  EXPECT_NEAR(share(1, Clamping::between_centres), 0.5 * reach, 1e-9);
  d["setups"][1]["jaws"] = "hard";
  EXPECT_NEAR(share(1, Clamping::chuck), 6 * reach, 1e-9);
  d["setups"][1]["jaws"] = "collet";
  EXPECT_NEAR(share(1, Clamping::chuck), 1 * reach, 1e-9);
  // Cut before its datum: whichever clamping the datum's setup will choose.
  std::swap(d["tolerances"][0]["of"], d["tolerances"][0]["datum"]);
  d["setups"][1]["clampings"] = {"between-centres"};
  EXPECT_NEAR(share(0, Clamping::chuck), 0.5 * reach, 1e-9);
  d["setups"][1]["clampings"] = {"between-centres", "chuck"};
  EXPECT_NEAR(share(0, Clamping::chuck), 1 * reach, 1e-9);
}

// Jaws 40 mm deep that are off by e at each end tilt a face of 40 mm by sqrt(2) e/40.
TEST(ToleranceAllocation, AFaceIsTiltedByJawsThatErrAtBothEndsOfTheGrip) {
  auto d = pin_with({{"rechucking_um", 2}});
  d["tolerances"] = {{{"id", "x"},
                      {"kind", "perpendicularity"},
                      {"of", "left"},
                      {"datum", "d2"},
                      {"value_mm", 0.03}}};
  const auto p = part(d);
  EXPECT_NEAR(
      share_um(tolerance_allocation(p, tolerance(p, "x"), in_chuck(p, 1)), "rechucking"),
      std::sqrt(2.0) * 2 * 40 / 40 * std::sqrt(-2 * std::log(0.00135)), 1e-9);
}

TEST(Squeeze, IsTheRingsAtTheJawsAndDiesAwayBeyond) {
  const auto p = part(tube(9000));
  const double R = 25, t = 10, EI = 20 * t * t * t / 12 * p.material.E_MPa;
  const double thick = 1 + 2.3 * (t / R) * (t / R);
  const double lobes = 0.0302 * 3000 * R * R * R / EI * thick * 1000;
  const auto c1 = share_um(tolerance_allocation(p, tolerance(p, "c1"), in_chuck(p, 0)),
                           "jaw-squeeze");
  EXPECT_NEAR(c1, lobes, 2e-3 * lobes);
  // d2 begins 42 mm beyond the jaws: 18 mm of grip are on the part.
  const double lambda = std::sqrt(9 * 8 * t / R / std::sqrt(48.0)) / R;
  const auto c2 = share_um(tolerance_allocation(p, tolerance(p, "c2"), in_chuck(p, 0)),
                           "jaw-squeeze");
  EXPECT_NEAR(c2, c1 * std::exp(-lambda * 42), 1e-9);
}

TEST(Squeeze, IsNoneOfASolidPartOrBetweenCentres) {
  auto d = pin();
  d["tolerances"] = {
      {{"id", "c"}, {"kind", "circularity"}, {"of", "d1"}, {"value_mm", 0.02}}};
  const auto solid = part(d);
  EXPECT_EQ(share_um(tolerance_allocation(solid, 0, in_chuck(solid, 0)), "jaw-squeeze"),
            0);
  const auto p = part(tube(9000));
  EXPECT_EQ(share_um(tolerance_allocation(p, tolerance(p, "c1"),
                                          {0, Clamping::between_centres, nullptr}),
                     "jaw-squeeze"),
            0);
}

TEST(Squeeze, OfATubeIsEasedToAQuarterOfTheZone) {
  const auto p = part(tube(0));
  ASSERT_TRUE(p.jaws[1].eased);
  EXPECT_LT(p.jaws[1].finishing_N, p.machine.chuck.grip_force_N);
  const auto a = tolerance_allocation(p, tolerance(p, "c1"), in_chuck(p, 1));
  EXPECT_NEAR(share_um(a, "jaw-squeeze"), 20.0 / 4, 1e-9);
}

// Only what has been bored: in setup 0 the jaws close on the tube as it was bought.
TEST(Squeeze, KnowsNoBoreThatALaterSetupMakes) {
  auto d = tube(9000);
  const auto lobes_um = [&](std::size_t setup) {
    const auto p = part(d);
    return share_um(tolerance_allocation(p, tolerance(p, "c1"), in_chuck(p, setup)),
                    "jaw-squeeze");
  };
  const double before = lobes_um(0);
  d["inner"] = {{{"id", "b"},
                 {"kind", "cylinder"},
                 {"from", "left"},
                 {"length_mm", 30},
                 {"diameter_mm", 46}}};
  EXPECT_EQ(lobes_um(0), before);
  // The same bore in the jaws of a later setup.
  std::swap(d["setups"][0], d["setups"][1]);
  const auto p = part(d);
  EXPECT_EQ(gripped_bore_mm(p, 0), 40);
  EXPECT_EQ(gripped_bore_mm(p, 1), 46);
}

// The width is what the shares take and, at each limit, the margin: of all that one
// source at most spreads.
TEST(Budget, SharesAndMarginsAreTheWholeWidth) {
  auto d = pin_with({{"drift_um", 3}});
  d["outer"][0] = {{"id", "d1"},
                   {"kind", "cone"},
                   {"length_mm", 40},
                   {"left_mm", 34},
                   {"right_mm", 40}};
  d["tolerances"] = {
      {{"id", "p"},
       {"kind", "profile"},
       {"of", "d1"},
       {"datum", "d2"},
       {"value_mm", 0.08}},
      {{"id", "z"}, {"kind", "cylindricity"}, {"of", "d2"}, {"value_mm", 0.02}}};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& t : r.tolerances) {
    double um = 0;
    for (const auto& s : t.shares) um += s.um;
    const double width = t.id == "p" ? 0.08 : t.id == "z" ? 0.02 : 0.05;
    // A profile's margin is that of its zone, both sides together.
    const double ends = t.id == "d2:diameter" ? 2 : 1;
    EXPECT_NEAR(um / 1000 + ends * t.margin_mm, width, 1e-9) << t.id;
  }
}

// A warm part is too long once: its uniform error of +-H and each face's drift of +-D,
// triangular together, by summing.
TEST(Budget, OfALengthCountsItsHeatOnce) {
  auto d = pin_with({{"drift_axial_um", 8}, {"part_warm_K", 30}});
  d["tolerances"] = {{{"id", "l"},
                      {"kind", "length"},
                      {"between", {"left", "right"}},
                      {"limits_mm", {-0.036, 0.036}}}};
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto t = std::find_if(r.tolerances.begin(), r.tolerances.end(),
                              [](const auto& x) { return x.id == "l"; });
  const double H = p.material.expansion_1_K * 30 * 90 / 2 * 1000, D = 8;
  ASSERT_EQ(t->shares.size(), 4u);  // deflection, machine, drift, heat
  EXPECT_NEAR(t->shares[2].um, 4 * D, 1e-9);
  EXPECT_NEAR(t->shares[3].um, 2 * H, 1e-9);
  const double low = t->predicted_mm[0] * 1000, high = t->predicted_mm[1] * 1000;
  const double sigma = force_spread(p) * std::max(high, -low);
  const double up = 35.5 - high, down = -35.5 - low;
  double P = 0;
  const int n = 600;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double u = 2 * (k + 0.5) / n - 1;
      const double x = H * (2 * (i + 0.5) / n - 1) + 2 * D * u;
      P += (1 - std::abs(u)) * 2 / n / n *
           (std::erf((up - x) / sigma / std::sqrt(2.0)) -
            std::erf((down - x) / sigma / std::sqrt(2.0))) /
           2;
    }
  EXPECT_NEAR(t->P_conform, P, 1.5e-3);
}

// What a plan says of each tolerance follows from its own shares.
TEST(Budget, NarrowsWhatThePlanAllowsAndItsPartsConformAsSaid) {
  const auto bare = plan(part(pin_with(nlohmann::json::object())));
  const auto p = part(pin_with({{"drift_um", 4}, {"repeatability_um", 1.5}}));
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_GE(r.cost_per_part, bare.cost_per_part * (1 - 1e-4));
  for (const auto& t : r.tolerances) {
    if (t.id != "d2:diameter") continue;
    const double rss = 2 * std::hypot(2 * 4, 2 * 4.5);
    EXPECT_NEAR(t.allowed_mm[1] - t.allowed_mm[0], 0.05 - 0.001 - rss / 1000, 1e-12);
    // P by summing the uniform drift over its range, the rest is normal.
    const double e =
        std::max(t.predicted_mm[1] + 0.025, -0.025 - t.predicted_mm[0]) * 1000;
    const double kc = p.material.kc_uncertainty_pct,
                 c = p.machine.stiffness_uncertainty_pct;
    const double thrust = catalogue::thrust_of(p.material).uncertainty_pct;
    const double sigma = std::hypot(2 * 1.5, std::hypot(kc, thrust, c) / 100 * e);
    const double up = (-0.0005 - t.predicted_mm[1]) * 1000,
                 down = (-0.0495 - t.predicted_mm[0]) * 1000;
    double P = 0;
    const int n = 2000;
    for (int k = 0; k < n; ++k) {
      const double x = 8 * (2 * (k + 0.5) / n - 1);
      P += (std::erf((up - x) / sigma / std::sqrt(2.0)) -
            std::erf((down - x) / sigma / std::sqrt(2.0))) /
           2 / n;
    }
    EXPECT_NEAR(t.P_conform, P, 1.5e-3);
  }
}

TEST(Budget, ThatIsUsedUpWithoutTheCutIsAConflict) {
  auto d = pin_with({{"drift_um", 30}});
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_EQ(r.conflicts.size(), 1u);
  EXPECT_EQ(r.conflicts[0].limit, "d2:diameter diameter");
  EXPECT_NEAR(r.conflicts[0].value, 0.001 + 0.12, 1e-12);
  EXPECT_NE(r.conflicts[0].sentence.find("drift 120 um"), std::string::npos)
      << r.conflicts[0].sentence;
  ASSERT_EQ(r.relax.size(), 1u);
  EXPECT_EQ(r.certificate.kind, CertificateKind::none);
  d["budget"]["rechucking_um"] = 20;  // every one of a surface is told
  d["tolerances"] = {{{"id", "x"},
                      {"kind", "coaxiality"},
                      {"of", "d2"},
                      {"datum", "d1"},
                      {"value_mm", 0.03}}};
  const auto both = plan(part(d));
  ASSERT_EQ(both.conflicts.size(), 2u);
  EXPECT_EQ(both.conflicts[0].limit, "x coaxiality");
  EXPECT_EQ(both.conflicts[1].limit, "d2:diameter diameter");
}

nlohmann::json robust(nlohmann::json d, double p) {
  d["robust"] = true;
  d["conformance"] = p;
  return d;
}

// Without other sources (1) is E (1 + r z) = h, z the normal's quantile.
TEST(Robust, AZoneKeepsRoomForWhatIsNotKnownOfTheForce) {
  auto d = pin_with(nlohmann::json::object());
  d["tolerances"] = {
      {{"id", "z"}, {"kind", "cylindricity"}, {"of", "d2"}, {"value_mm", 0.011}}};
  const auto p = part(robust(d, 0.99865));
  const auto z = tolerance(p, "z");
  const auto left = left_mm(p, z, tolerance_allocation(p, z, in_chuck(p, 0)), Cut::error);
  EXPECT_NEAR(left, 0.010 / (1 + 3 * force_spread(p)), 1e-7);
}

// The cut has no part in coaxiality: no room is kept for what is not known of it.
TEST(Robust, WhatTheCutLeavesAloneIsPredictedAsItIs) {
  auto d = pin_with(nlohmann::json::object());
  d["tolerances"] = {{{"id", "x"},
                      {"kind", "coaxiality"},
                      {"of", "d2"},
                      {"datum", "d1"},
                      {"value_mm", 0.03}}};
  const auto r = plan(part(robust(d, 0.9973)));
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_EQ(r.tolerances[0].id, "x");
  EXPECT_NEAR(r.tolerances[0].predicted_mm[0], 0.001, 1e-12);  // the machine's share
  EXPECT_EQ(r.tolerances[0].P_conform, 1);
}

// Parts made by a robust plan, drawn anew: the error scales by a normal force and
// stiffness, the edge drifts and repeats itself with errors of its own.
TEST(Robust, PartsDrawnAnewConformAsOftenAsAsked) {
  for (const double wanted : {0.9, 0.97, 0.9973}) {
    auto d = pin_with({{"drift_um", 2}, {"repeatability_um", 0.7}});
    d["outer"][1]["limits_mm"] = {-0.016, 0};
    const auto p = part(robust(d, wanted));
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok) << wanted;
    const auto t = std::find_if(r.tolerances.begin(), r.tolerances.end(),
                                [](const auto& x) { return x.id == "d2:diameter"; });
    std::mt19937_64 random(2026);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    int kept = 0;
    constexpr int kParts = 200'000;
    for (int k = 0; k < kParts; ++k) {
      const double scale = 1 + force_spread(p) * normal(random);
      const double moved = 2 * (0.002 * uniform(random) + 0.0007 * normal(random));
      const double middle = -0.008, share = 0.0005;  // of the machine, at each limit
      const double low = middle + (t->predicted_mm[0] - middle) * scale + moved;
      const double high = middle + (t->predicted_mm[1] - middle) * scale + moved;
      kept += low >= -0.016 + share && high <= -share;
    }
    const double P = static_cast<double>(kept) / kParts;
    EXPECT_GE(P, wanted - 0.003) << wanted;
    // Where it binds no more is given than asked of both limits; the error is on one side
    // of the middle, so that parts fail at one of them alone.
    const auto& o = operation(r, "s1-finish-d2");
    for (const auto& c : o.constraints) {
      if (c.name == "d2:diameter diameter" && c.binding) {
        EXPECT_NEAR(P, 1 - (1 - wanted) / 2, 0.002) << wanted;
      }
    }
  }
}

// The offset set by the first part leaves the range, and it alone scales.
TEST(Robust, PartsWithAnOffsetConformAsOftenAsAsked) {
  for (const double wanted : {0.9, 0.9973}) {
    auto d = pin_with(
        {{"drift_um", 2}, {"repeatability_um", 0.7}, {"first_part_gauged", true}});
    d["outer"][1]["limits_mm"] = {-0.016, 0};
    const auto p = part(robust(d, wanted));
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok) << wanted;
    const auto t = std::find_if(r.tolerances.begin(), r.tolerances.end(),
                                [](const auto& x) { return x.id == "d2:diameter"; });
    const double middle = -0.008, share = 0.0005;
    std::mt19937_64 random(2027);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    int kept = 0;
    constexpr int kParts = 200'000;
    for (int k = 0; k < kParts; ++k) {
      const double scale = 1 + force_spread(p) * normal(random);
      const double moved = 2 * (0.002 * uniform(random) + 0.0007 * normal(random));
      const double low = middle + (t->predicted_mm[0] - middle) * scale + moved;
      const double high = middle + (t->predicted_mm[1] - middle) * scale + moved;
      kept += low >= -0.016 + share && high <= -share;
    }
    EXPECT_NEAR(static_cast<double>(kept) / kParts, t->P_conform, 0.003) << wanted;
    EXPECT_GE(t->P_conform, wanted - 1e-6) << wanted;
  }
}

// Where the spread is nil and both limits are equally near, both tails count: with E
// small against h the wanted share lies within z of 0.9973 on both sides, 3 sigma.  A
// two-hundredth of h stays for what the path's straight lines leave.
TEST(Robust, ACorrectedSizeIsAskedForWhatCorrectingLeavesUnknown) {
  const auto p =
      part(robust(pin_with(nlohmann::json::object()), std::erf(3 / std::sqrt(2.0))));
  const auto i = tolerance(p, "d2:diameter");
  const auto left =
      left_mm(p, i, tolerance_allocation(p, i, in_chuck(p, 0)), Cut::corrected);
  EXPECT_NEAR(left, 2 * 0.0245 * 0.995 / (3 * force_spread(p)), 1e-7);
}

// The nominal plan leaves room for the measurement; parts that conform need none, so
// where it conforms the robust one costs no more.
TEST(Robust, PartsConformWhateverTheirMeasurement) {
  auto d =
      pin_with({{"drift_um", 2}, {"measurement_U_um", 1}, {"first_part_gauged", true}});
  d["outer"][1]["limits_mm"] = {-0.016, 0};
  const auto nominal = plan(part(d));
  ASSERT_EQ(nominal.status, PlanStatus::ok);
  double least = 1;
  for (const auto& t : nominal.tolerances) least = std::min(least, t.P_conform);
  ASSERT_GT(least, 0.5);
  const auto r = plan(part(robust(d, std::min(least, 0.999999))));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_LE(r.certificate.lower_bound, nominal.cost_per_part * (1 + 1e-9));
  EXPECT_LE(r.cost_per_part, nominal.cost_per_part * (1 + 1e-4));
}

TEST(Robust, PlansConformAsAskedAndCostNoLess) {
  auto d =
      pin_with({{"drift_um", 3}, {"repeatability_um", 1}, {"life_between_offsets", 0.1}});
  d["tolerances"] = {
      {{"id", "z"}, {"kind", "cylindricity"}, {"of", "d2"}, {"value_mm", 0.004}}};
  double before = 0;
  for (const double wanted : {0.6, 0.9, 0.99, 0.9973, 0.9999}) {
    const auto r = plan(part(robust(d, wanted)));
    ASSERT_EQ(r.status, PlanStatus::ok) << wanted;
    EXPECT_GE(r.cost_per_part, before * (1 - 1e-4)) << wanted;
    before = r.cost_per_part;
    for (const auto& t : r.tolerances) EXPECT_GE(t.P_conform, wanted - 1e-6) << t.id;
  }
}

// A thrust of half the buckling load doubles what the tailstock leaves of the deflection.
TEST(Tailstock, ItsThrustAddsToTheDeflection) {
  const auto slender = [](double thrust_N) {
    auto d = pin();
    d["machine"] = file("machines/lathe-medium.json");
    d["machine"]["stiffness"]["tail_thrust_N"] = thrust_N;
    d["damping_ratio"] = 0.5;
    d["stock"] = {{"kind", "bar"}, {"diameter_mm", 22}, {"length_mm", 404}};
    d["outer"] = {
        {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 20}},
        {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 360}, {"diameter_mm", 20}}};
    d["general"] = "ISO 2768-c";
    for (auto& setup : d["setups"]) setup["clampings"] = {"chuck-tailstock"};
    return d;
  };
  const auto p = part(slender(1));
  SetupWork work = assign(p).setups.at(0);
  auto done = nothing_finished(p.drawing);
  finish(done, work);
  const double P_cr = deflection::critical_thrust_N(
      SetupBody(p, 0, Clamping::chuck_tailstock, done).shaft(),
      planes(p.machine, Clamping::chuck_tailstock).radial);
  const auto error = [&](double thrust_N) {
    auto d = slender(thrust_N);
    const auto q = part(d);
    const auto f = MachinedSurface::element(q, 0, Clamping::chuck_tailstock, work,
                                            nothing_finished(q.drawing), 1, {});
    Recipe recipe;
    recipe.finish = &q.tools.at(1);
    recipe.finish_passes = 1;
    // Yield of the part alone: a rigid toolpost.
    auto chain = f.chain(recipe, {1, 1}, {200}, {});
    return chain->stations.at(0).passes.at(0).p(chain->a.lower) - q.machine.tool_rr_mm_N;
  };
  EXPECT_NEAR(error(P_cr / 2) / error(0), 2, 1e-9);
  EXPECT_EQ(plan(part(slender(0.49 * P_cr))).status, PlanStatus::ok);
  const auto r = plan(part(slender(0.51 * P_cr)));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_NE(r.conflicts[0].sentence.find("buckle the part"), std::string::npos)
      << r.conflicts[0].sentence;
}

// Held at the tool, a slender shaft may be cut as if it were short.
TEST(FollowRest, HoldsWhatIsTooSlenderForTheTailstockAlone) {
  const auto slender = [](const char* clamping) {
    auto d = pin();
    d["machine"] = file("machines/lathe-medium.json");
    d["machine"]["clampings"].push_back("tailstock-follow");
    d["machine"]["times"]["follow_min"] = 0.7;
    d["machine"]["stiffness"]["follow_rest"] = {{"radial_mm_N", 3e-5},
                                                {"tangential_mm_N", 3e-5}};
    d["machine"]["stiffness"]["tail_thrust_N"] = 100;
    d["damping_ratio"] = 0.5;
    d["stock"] = {{"kind", "bar"}, {"diameter_mm", 16}, {"length_mm", 404}};
    d["outer"] = {
        {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 15}},
        {{"id", "d2"},
         {"kind", "cylinder"},
         {"length_mm", 360},
         {"diameter_mm", 14},
         {"limits_mm", {-0.03, 0.03}}}};
    for (auto& setup : d["setups"]) setup["clampings"] = {clamping};
    return d;
  };
  EXPECT_EQ(plan(part(slender("chuck-tailstock"))).status, PlanStatus::infeasible);
  const auto p = part(slender("tailstock-follow"));
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.setups[0].clamping, Clamping::tailstock_follow);
}

}  // namespace
}  // namespace turnwright::planning
