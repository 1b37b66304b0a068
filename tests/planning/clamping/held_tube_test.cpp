// Jaws that would strain a hollow part.
#include "planning/clamping/held_tube.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"
#include "turnwright/deflection/ring.hpp"
#include "turnwright/planning/limit.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A bush of brass with a wall of 7.5 mm, held at 20 mm by its finished outside in setup 2.
json bush() {
  return {
      {"format", "turnwright-part/1"},
      {"name", "Bush"},
      {"material", "CuZn39Pb3"},
      {"stock",
       {{"kind", "tube"}, {"outer_mm", 58}, {"inner_mm", 39}, {"length_mm", 44}}},
      {"outer",
       {{{"id", "body"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 55}},
        {{"id", "rim"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 56}}}},
      {"inner",
       {{{"id", "bore"},
         {"kind", "cylinder"},
         {"from", "right"},
         {"length_mm", 40},
         {"diameter_mm", 40}}}},
      {"machine", "lathe-medium"},
      {"setups",
       {{{"hold", "right"}, {"grip_mm", 15}, {"clampings", {"chuck"}}},
        {{"hold", "left"}, {"grip_mm", 18}, {"clampings", {"chuck"}}}}}};
}

// (5) of ring.hpp with a wall of 7.5 mm on a mean radius of 23.75 mm, by hand: the couple
// 0.1888 F R bends an almost straight wall to 6 M/(b t^2), of which a curved one has some
// tenths more inside, and F/2 cot(60 deg) presses it together.
TEST(HeldTube, IsStrainedByThreeJaws) {
  const auto p = part(bush());
  const auto tube = held_tube(p, 1, Clamping::chuck);
  EXPECT_EQ(tube.outer_mm, 55);
  EXPECT_EQ(tube.inner_mm, 40);
  const double F = 20000, R = 23.75, t = 7.5, b = 18;
  const double bent = 6 * 0.1888 * F * R / (b * t * t);
  const double pressed = F / 2 / std::tan(M_PI / 3) / (b * t);
  const double MPa = squeeze_MPa(p, 1, Clamping::chuck, 3 * F);
  EXPECT_GT(MPa, bent - pressed);
  EXPECT_LT(MPa, 1.3 * bent - pressed);
}

TEST(HeldTube, JawsOfTheirOwnAccordCloseWithinTwoThirdsOfYield) {
  const auto p = part(bush());
  ASSERT_TRUE(p.jaws[1].spares_tube);
  EXPECT_LT(p.jaws[1].roughing_N, 60000);
  EXPECT_NEAR(squeeze_MPa(p, 1, Clamping::chuck, p.jaws[1].roughing_N), 220 * 2.0 / 3,
              1e-9);
}

TEST(HeldTube, AGivenForceBeyondThatIsRefusedWithTheLargest) {
  auto d = bush();
  d["setups"][1]["grip_force_N"] = 60000;
  const auto answer = plan(part(d));
  EXPECT_EQ(answer.status, PlanStatus::infeasible);
  std::string told;
  for (const auto& c : answer.conflicts) told += c.sentence + "\n";
  EXPECT_NE(told.find("more than two thirds of its yield strength, 220 MPa: at most"),
            std::string::npos)
      << told;
  d["setups"][1]["grip_force_N"] =
      std::floor(elastic_grip_N(part(d), 1, Clamping::chuck));
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
}

TEST(HeldTube, SolidPartsColletsAndUnknownStrengthsHaveNoLimit) {
  EXPECT_EQ(elastic_grip_N(part(pin()), 0, Clamping::chuck), INFINITY);
  auto collet = bush();
  collet["setups"][1]["jaws"] = "collet";
  EXPECT_EQ(elastic_grip_N(part(collet), 1, Clamping::chuck), INFINITY);
  auto unknown = part(bush());
  unknown.material.yield_MPa.reset();
  EXPECT_EQ(elastic_grip_N(unknown, 1, Clamping::chuck), INFINITY);
}

// What the planner chooses is no limit that somebody may open.
TEST(HeldTube, ItsForceIsNoLimitToRelax) {
  for (const auto& limit : limits(part(bush())))
    EXPECT_EQ(limit.name.find("grip force in setup 2"), std::string::npos) << limit.name;
}

}  // namespace
}  // namespace turnwright::planning
