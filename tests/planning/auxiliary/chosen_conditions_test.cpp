// Speed and feed of drills, blades, threading and profiling tools, chosen in the windows of
// their documents: against all conditions of a lattice, and against closed forms.
#include "planning/auxiliary/chosen_conditions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using catalogue::ConditionsWindow;
using nlohmann::json;

constexpr double kTaylor = 0.25, kLifeFeed = 1.5;

/// The window from `low` to `high` times the conditions of every tool.
PreparedPart with_windows(PlanRequest p, double low, double high) {
  for (auto& t : p.fixed_tools)
    for (auto& c : t.conditions)
      c.window = ConditionsWindow{{low * c.vc_m_min, high * c.vc_m_min},
                                  {low * c.f_mm_rev, high * c.f_mm_rev},
                                  kTaylor,
                                  kLifeFeed};
  return prepare(std::move(p));
}

/// All tools at a multiple of their speeds and feeds, and nothing to choose.
PreparedPart at_multiple(const PlanRequest& request, double of_vc, double of_f) {
  auto p = with_windows(request, 1, 1);
  for (auto& t : p.fixed_tools)
    for (auto& c : t.conditions)
      c = catalogue::at(c, of_vc * c.vc_m_min, of_f * c.f_mm_rev);
  return prepare(without_windows(p));
}

std::vector<AuxiliaryOperation> operations(const PreparedPart& p) {
  std::vector<AuxiliaryOperation> all;
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    for (const auto& o :
         auxiliary_work(p, s, Clamping::chuck, p.work.setups[s], {p.machine_per_min, 1})
             .all())
      all.push_back(o);
  return all;
}

AuxiliaryOperation operation(const PreparedPart& p, const std::string& id) {
  for (const auto& o : operations(p))
    if (o.plan.id == id) return o;
  throw std::invalid_argument(id);
}

double cost(const PreparedPart& p, const AuxiliaryOperation& o) {
  return p.machine_per_min * o.minutes() + o.edges_cost;
}

bool keeps_all(const AuxiliaryOperation& o) {
  return std::ranges::all_of(o.plan.constraints,
                             [](const ConstraintValue& c) { return c.margin >= 0; });
}

bool same_tool(const AuxiliaryOperation& a, const AuxiliaryOperation& b) {
  return a.plan.tool == b.plan.tool && a.plan.passes[0].ap_mm == b.plan.passes[0].ap_mm;
}

// Drill, groove, thread, arc and parting off: nothing on a lattice of 61 x 61 is cheaper,
// and the best of the lattice is dearer by its step at most.
void compare_with_lattice(const PlanRequest& request) {
  constexpr double kLow = 0.5, kHigh = 1.5;
  const auto p = with_windows(request, kLow, kHigh);
  const auto chosen = operations(p);
  std::vector<double> least(chosen.size(), INFINITY);
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 60; ++j) {
      const auto at = [](int k) { return kLow + (kHigh - kLow) * k / 60; };
      const auto lattice = operations(at_multiple(request, at(i), at(j)));
      ASSERT_EQ(lattice.size(), chosen.size());
      for (std::size_t k = 0; k < chosen.size(); ++k)
        if (keeps_all(lattice[k]) && same_tool(lattice[k], chosen[k]))
          least[k] = std::min(least[k], cost(p, lattice[k]));
    }
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto& o = chosen[k];
    ASSERT_TRUE(std::isfinite(least[k])) << o.plan.id;
    EXPECT_TRUE(keeps_all(o)) << o.plan.id;
    EXPECT_LE(cost(p, o), least[k] * (1 + 1e-9)) << o.plan.id;
    EXPECT_GE(cost(p, o), least[k] * (1 - 1.5e-2)) << o.plan.id;
  }
}

TEST(ChosenConditions, AreNoDearerThanAnyOfALattice) {
  for (const char* name : {"drilled-bush", "threaded-spindle"})
    compare_with_lattice(part(reference_part(name)));
}

// Where power, feed drive and grip bind the feed depends on the speed.
TEST(ChosenConditions, AreNoDearerThanAnyOfALatticeOnAWeakMachine) {
  auto request = with_one_drill(part(bored_bush()));
  request.machine.feed_force_max_N =
      0.8 * operation(at_multiple(request, 1, 1), "s1-drill-b1").plan.passes[0].Ff_N;
  for (auto& point : request.machine.curve) point.P_kW *= 0.5, point.M_Nm *= 0.5;
  compare_with_lattice(request);
}

// A drill whose feed ends at its window: at the speed of least cost the edges cost n/(1-n) of
// what the time does that goes with 1/v, the way to the hole fed included (Taylor's speed of
// least cost).
TEST(ChosenConditions, OfADrillAreTaylorsSpeedOfLeastCost) {
  const auto p = with_windows(part(bored_bush()), 0.3, 3);
  auto narrow = static_cast<PlanRequest>(p);
  for (auto& t : narrow.fixed_tools)
    for (auto& c : t.conditions) c.window->f_mm_rev = {c.f_mm_rev, c.f_mm_rev};
  const auto q = prepare(std::move(narrow));
  const auto o = operation(q, "s1-drill-b1");
  const auto& pass = o.plan.passes[0];
  const double fed_min = o.plan.time_min + 2 / (pass.f_mm_rev * pass.n_rpm);
  const double edges = q.machine_per_min * o.change_min + o.edges_cost;
  EXPECT_NEAR(edges, kTaylor / (1 - kTaylor) * q.machine_per_min * fed_min, 1e-6 * edges);
  EXPECT_EQ(o.plan.certificate.reason, "the best of the tool's window");
}

// The drive cannot push the drill at the catalogue's feed.
TEST(ChosenConditions, KeepALimitThatTheCatalogueBreaks) {
  auto request = with_one_drill(part(bored_bush()));
  const double Ff =
      operation(at_multiple(request, 1, 1), "s1-drill-b1").plan.passes[0].Ff_N;
  request.machine.feed_force_max_N = 0.8 * Ff;
  EXPECT_FALSE(keeps_all(operation(at_multiple(request, 1, 1), "s1-drill-b1")));
  const auto o = operation(with_windows(request, 0.5, 1.5), "s1-drill-b1");
  EXPECT_TRUE(keeps_all(o));
  EXPECT_NEAR(o.plan.passes[0].Ff_N, 0.8 * Ff, 1e-6 * Ff);
}

TEST(ChosenConditions, OfAWiderWindowAreNeverDearer) {
  const auto request = part(reference_part("threaded-spindle"));
  double before = INFINITY;
  for (const double width : {1.0, 1.1, 1.3, 1.7, 2.5}) {
    const auto p = with_windows(request, 1 / width, width);
    double sum = 0;
    for (const auto& o : operations(p)) sum += cost(p, o);
    EXPECT_LE(sum, before * (1 + 1e-12)) << width;
    before = sum;
  }
}

// A slow spindle's least speed counts as reached, whatever rounding says of it.
TEST(ChosenConditions, AtTheLeastSpeedOfTheSpindleAreKept) {
  auto request = with_one_drill(part(bored_bush()));
  const double most_Ff =
      0.8 * operation(at_multiple(request, 1, 1), "s1-drill-b1").plan.passes[0].Ff_N;
  request.machine.feed_force_max_N = most_Ff;
  for (const double n : {700.0, 767.0, 811.3, 901.7, 950.1}) {
    request.machine.n_min_rpm = n;
    const auto o = operation(with_windows(request, 0.01, 1.5), "s1-drill-b1");
    EXPECT_NEAR(o.plan.passes[0].Ff_N, most_Ff, 1e-6 * most_Ff) << n;
    EXPECT_GE(o.plan.passes[0].n_rpm, n * (1 - 1e-9));
  }
}

// What the request gives is not chosen, and the edge lasts as long as it does there: a plan's
// own conditions, given back, take its time and its edges.
TEST(ChosenConditions, GivenBackCostTheSame) {
  const auto d = reference_part("threaded-spindle");
  const auto p = with_windows(part(d), 0.5, 1.5);
  const auto given = with_windows(part(as_planned(d, plan(p))), 0.9, 1.1);
  for (const auto& o : operations(p)) {
    const auto back = operation(given, o.plan.id);
    EXPECT_NEAR(cost(p, back), cost(p, o), 1e-9 * cost(p, o)) << o.plan.id;
    EXPECT_NEAR(back.plan.passes[0].T_min, o.plan.passes[0].T_min,
                1e-9 * o.plan.passes[0].T_min);
  }
}

TEST(ChosenConditions, StandInAWindowAroundTheToolsOwn) {
  const auto told = [](const json& window) {
    auto d = bored_bush();
    auto drill = file("tools/fixed/DRILL-HM-5D.json");
    drill["conditions"][0]["window"] = window;
    d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF",
                  "S16R-SCLCR-CCMT09T304-PF", drill};
    try {
      part(d);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  json window{{"vc_m_min", {60, 110}},
              {"taylor_n", 0.25},
              {"f_per_mm", {0.01, 0.02}},
              {"life_feed", 1.5}};
  EXPECT_EQ(told(window), "");
  window["vc_m_min"] = {50, 50};
  EXPECT_NE(told(window).find("vc_m_min: got [50,50], expected a range around 90"),
            std::string::npos);
  window["vc_m_min"] = {95, 110};
  window["f_per_mm"] = {0.02, 0.01};
  window["life_feed"] = -1;
  const auto all = told(window);
  for (const char* each :
       {"/tools/3/conditions/0/window/vc_m_min: got [95,110], expected a range around 90",
        "/tools/3/conditions/0/window/f_per_mm: got [0.02,0.01], expected [lower, upper]",
        "/tools/3/conditions/0/window/life_feed: got -1"})
    EXPECT_NE(all.find(each), std::string::npos) << all;
}

}  // namespace
}  // namespace turnwright::planning
