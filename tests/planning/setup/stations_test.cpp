// Tools of a setup and the stations of the turret.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "../parts.hpp"
#include "planning/setup/setup_planner.hpp"
#include "planning/values/tool_label.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// Faced, roughed, finished and grooved in one setup.
json grooved() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "Grooved", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 80, "length_mm": 132, "left_allowance_mm": 30},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 20, "diameter_mm": 50},
              {"id": "g", "kind": "groove", "length_mm": 4, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 76, "diameter_mm": 46,
               "Ra_um": 0.8}],
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "tools": ["PCLNL-CNMG120408-PM", "PCLNL-CNMG120412-PR", "PDJNL-DNMG150604-PF",
              "SVJBL-VBMT160404-PF", "PCLNL-CNMG120404-PF", "GROOVE-EXT"],
    "setups": [{"hold": "left", "grip_mm": 25, "clampings": ["chuck"]}]})");
}

// One of the tools faces and finishes, but is too weak to do without roughing.
json with_a_tool_for_both() {
  auto document = grooved();
  document["tools"][2] = "PCLNL20-CNMG120404-PF";
  return document;
}

PlanRequest with_stations(PlanRequest p, int n) {
  p.machine.stations = n;
  return p;
}

std::set<std::string> tools(const PlanRequest& p, const SetupPlan& setup) {
  std::set<std::string> all;
  for (const auto& o : setup.operations) all.insert(tool_label(p, o));
  return all;
}

// Corners alike: passes overrun by the largest of all tools.
PlanRequest with_equal_corners(PlanRequest p) {
  for (auto& t : p.tools) t.re_mm = 0.8;
  return p;
}

// The least cost over every set of at most so many turning tools: plans of requests in which
// the others have no use, on a turret that takes them all.
double least_cost(const PlanRequest& p, int turning_tools) {
  double least = INFINITY;
  for (unsigned subset = 1; subset < 1U << p.tools.size(); ++subset) {
    if (std::popcount(subset) > turning_tools) continue;
    auto few = p;
    for (std::size_t i = 0; i < p.tools.size(); ++i)
      if ((subset >> i & 1U) == 0) few.tools[i].uses.clear();
    const auto made = plan(with_stations(few, catalogue::kAnyStations));
    if (made.status == PlanStatus::ok) least = std::min(least, made.cost_per_part);
  }
  return least;
}

const Conflict* about_stations(const ProcessPlan& p) {
  const auto it =
      std::ranges::find(p.conflicts, "stations of the turret", &Conflict::limit);
  return it == p.conflicts.end() ? nullptr : &*it;
}

TEST(Stations, BoundTheToolsOfASetupAtLeastCost) {
  const auto p = with_equal_corners(part(grooved()));
  const auto free = plan(with_stations(p, catalogue::kAnyStations));
  ASSERT_EQ(free.status, PlanStatus::ok);
  const auto needed = tools(p, free.setups[0]).size();
  ASSERT_GE(needed, 4U);
  double before = INFINITY;
  for (std::size_t n = 3; n <= needed + 1; ++n) {
    const auto made = plan(with_stations(p, static_cast<int>(n)));
    ASSERT_EQ(made.status, PlanStatus::ok) << n;
    EXPECT_LE(tools(p, made.setups[0]).size(), n);
    const double least = least_cost(p, static_cast<int>(n) - 1);  // beside the blade
    EXPECT_NEAR(made.cost_per_part, least, 1e-4 * least) << n;
    EXPECT_LE(made.certificate.lower_bound, least) << n;
    EXPECT_LE(made.certificate.gap, 1e-4) << n;
    EXPECT_LE(made.cost_per_part, before) << n;
    before = made.cost_per_part;
    if (n >= needed) {
      EXPECT_EQ(made.cost_per_part, free.cost_per_part);
    } else {
      EXPECT_GT(made.cost_per_part, free.cost_per_part);
    }
  }
}

TEST(Stations, ToolsWithoutARoomAreRejectedForIt) {
  const auto made = plan(with_stations(part(grooved()), 3));
  ASSERT_EQ(made.status, PlanStatus::ok);
  int without_room = 0;
  for (const auto& r : made.setups[0].rejected_tools) {
    EXPECT_EQ(r.why.find("grades"), std::string::npos) << r.tool << r.why;
    without_room += r.why == "the turret has too few stations for it" ? 1 : 0;
  }
  EXPECT_GT(without_room, 0);
}

TEST(Stations, ThatAreTooFewAreAConflict) {
  const auto none = plan(with_stations(part(with_a_tool_for_both()), 1));
  ASSERT_EQ(none.status, PlanStatus::infeasible);
  EXPECT_EQ(none.certificate.reason,
            "no conditions of turning and boring can resolve the conflicts");
  const auto* c = about_stations(none);
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->value, 2);
  EXPECT_EQ(c->allowed, 1);
  EXPECT_EQ(c->where, "setup 1");
  EXPECT_EQ(c->sentence,
            "setup 1 needs 2 tools at least, GROOVE-EXT 4 mm, PCLNL20-CNMG120404-PF; the "
            "turret of CNC lathe, 15 kW, chuck 210 mm has 1 station. Another setup for "
            "some of them, a tool that serves two uses, one cutter for several milled "
            "places or a turret with more stations would do");
  ASSERT_EQ(none.relax.size(), 1U);
  EXPECT_EQ(none.relax[0].needed, 3);  // with two no tools make it
  EXPECT_EQ(none.relax[0].sentence,
            "stations of the turret would have to go from 1 to 3");
}

// Each size of a drill is a tool of its own, and so are centre drill, blade and cutters.
TEST(Stations, EveryToolOfTheSetupCounts) {
  for (const auto* name : {"drilled-bush", "keyed-shaft"}) {
    const PlanRequest request = part(reference_part(name));
    const auto made = plan(request);
    ASSERT_EQ(made.status, PlanStatus::ok);
    auto done = nothing_finished(request.drawing);
    for (std::size_t s = 0; s < made.setups.size(); ++s) {
      std::set<std::string> others;
      for (const auto& o : made.setups[s].operations)
        if (o.kind == OperationKind::fixed || o.kind == OperationKind::mill)
          others.insert(tool_label(request, o));
      const auto p = prepare(with_stations(request, static_cast<int>(others.size())));
      SharedMemory shared;
      const auto conflicts = SetupPlanner(p, s, made.setups[s].clamping, p.work.setups[s],
                                          done, {p.machine_per_min, 1}, shared)
                                 .conflicts();
      ASSERT_EQ(conflicts.size(), 1U) << name;
      EXPECT_GT(conflicts[0].value, conflicts[0].allowed);
      for (const auto& tool : others)
        EXPECT_NE(conflicts[0].sentence.find(tool), std::string::npos)
            << conflicts[0].sentence;
      finish(done, p.work.setups[s]);
    }
  }
}

TEST(Stations, ThatLeaveNoToolsWhichMakeEverySurfaceAreNamed) {
  const auto none = plan(with_stations(part(with_a_tool_for_both()), 2));
  ASSERT_EQ(none.status, PlanStatus::infeasible);
  const auto* c = about_stations(none);
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->value, 3);
  EXPECT_EQ(c->allowed, 2);
  EXPECT_EQ(
      c->sentence,
      "the turret of CNC lathe, 15 kW, chuck 210 mm has 2 stations, and no tools for "
      "which they suffice make every surface; 3 would do");
  EXPECT_TRUE(std::ranges::any_of(none.relax, [](const Relaxation& r) {
    return r.limit == "stations of the turret" && r.needed == 3;
  }));
}

}  // namespace
}  // namespace turnwright::planning
