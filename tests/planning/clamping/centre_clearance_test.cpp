// Tools beside the live centre.
#include "planning/clamping/centre_clearance.hpp"

#include <gtest/gtest.h>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

PreparedPart supported() {
  auto d = pin();
  d["setups"][0]["clampings"] = {"chuck-tailstock"};
  return part(d);
}

TEST(CentreClearance, TheCountersinkIsTheLargestBelowAThirdOfTheEnd) {
  const auto p = supported();
  const double size = countersink_mm(p, 0);
  EXPECT_LE(size, 0.35 * 32);
  for (const auto& t : p.fixed_tools)
    if (t.use == catalogue::FixedUse::centring) {
      for (const double other : t.sizes_mm)
        EXPECT_TRUE(other <= size || other > 0.35 * 32) << other;
    }
}

// The far side of a holder, 32 mm from its tip, meets a body that stands nearer.
TEST(CentreClearance, ACentreWithAShortPointLetsNoToolPass) {
  auto p = supported();
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
  p.machine.live_centre = {40, 35, 90};
  const auto answer = plan(p);
  EXPECT_EQ(answer.status, PlanStatus::infeasible);
  std::string told;
  for (const auto& c : answer.conflicts) told += c.sentence + "\n";
  EXPECT_NE(told.find("no tools that clear the live centre, with a point of 40 mm and a "
                      "body of 90 mm 35 mm behind its tip"),
            std::string::npos)
      << told;
}

// What no tool can cut beside the centre is cut in the chuck alone, with any tools.
TEST(CentreClearance, AChuckAloneNeedsNoToolThatClearsIt) {
  const auto in = [](const std::vector<std::string>& clampings) {
    auto d = pin();
    d["setups"][0]["clampings"] = clampings;
    d["tools"] = "all";
    auto p = part(d);
    p.machine.live_centre = {40, 35, 90};
    return plan(p);
  };
  const auto alone = in({"chuck"}), both = in({"chuck-tailstock", "chuck"});
  ASSERT_EQ(alone.status, PlanStatus::ok);
  ASSERT_EQ(both.status, PlanStatus::ok);
  EXPECT_NEAR(both.cost_per_part, alone.cost_per_part, 1e-9 * alone.cost_per_part);
}

// Between the two the tools that pass are chosen, and no program meets the centre.
TEST(CentreClearance, ASlenderPointNeverCostsMore) {
  auto p = supported();
  double before = 0;
  for (const double point : {8.0, 16.0, 20.0, 24.0}) {
    p.machine.live_centre.point_mm = point;
    const auto answer = plan(p);
    if (answer.status != PlanStatus::ok) break;
    EXPECT_GE(answer.cost_per_part, before * (1 - 1e-9)) << point;
    before = answer.cost_per_part;
  }
  EXPECT_GT(before, 0);
}

}  // namespace
}  // namespace turnwright::planning
