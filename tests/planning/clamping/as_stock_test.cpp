// What stays as the stock is, and bars with corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../parts.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/setup_body.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A head of a hexagon bar of 27 mm between two spigots.
json fitting() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "Fitting", "material": "C45",
    "stock": {"kind": "hexagon", "across_flats_mm": 27, "length_mm": 84},
    "outer": [
      {"id": "a", "kind": "cylinder", "length_mm": 30, "diameter_mm": 22},
      {"id": "head", "kind": "as-stock", "length_mm": 20},
      {"id": "b", "kind": "cylinder", "length_mm": 30, "diameter_mm": 20}],
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}]})");
}

TEST(AsStock, IsMadeFromTheStartAndByNoOperation) {
  const auto p = part(fitting());
  EXPECT_EQ(nothing_finished(p.drawing).outer, (std::vector<bool>{false, true, false}));
  EXPECT_TRUE(p.work.unreachable.empty());
  for (const auto& s : p.work.setups) EXPECT_EQ(std::ranges::count(s.elements, 1u), 0);
  const auto planned = plan(p);
  ASSERT_EQ(planned.status, PlanStatus::ok);
  for (const auto& s : planned.setups)
    for (const auto& o : s.operations)
      EXPECT_EQ(std::ranges::count(o.on, "head"), 0) << o.id;
}

// Jaws and stiffness count with the circle in the section.
TEST(AsStock, IsHeldAndBendsAsWideAsItsFlats) {
  const auto p = part(fitting());
  EXPECT_NEAR(grip_diameter_mm(p, 0, Clamping::chuck), 27, 1e-12);
  EXPECT_NEAR(grip_diameter_mm(p, 1, Clamping::chuck), 20, 1e-12) << "jaws on both";
  const SetupBody body(p, 0, Clamping::chuck, nothing_finished(p.drawing));
  EXPECT_NEAR(body.shaft().segments.front().outer_left_mm, 27, 1e-12);
}

// Without the second spigot the jaws stand on the head.
TEST(AsStock, MayBeHeldInALaterSetup) {
  auto document = fitting();
  document["outer"].erase(2);
  document["setups"] = {{{"hold", "right"}, {"grip_mm", 15}, {"clampings", {"chuck"}}},
                        {{"hold", "right"}, {"grip_mm", 15}, {"clampings", {"chuck"}}}};
  const auto p = part(document);
  EXPECT_NEAR(grip_diameter_mm(p, 1, Clamping::chuck), 27, 1e-12);
}

// A hexagon's corners reach 27/cos 30 deg, which the first pass meets.
TEST(AsStock, IsRoughedFromItsCorners) {
  const auto planned = plan(part(fitting()));
  double depth = 0;
  for (const auto& o : planned.setups[0].operations)
    if (o.kind != OperationKind::face && std::ranges::count(o.on, "b") > 0)
      for (const auto& pass : o.passes) depth += pass.ap_mm;
  EXPECT_NEAR(depth, (27 / std::cos(M_PI / 6) - 20) / 2, 1e-9);
}

}  // namespace
}  // namespace turnwright::planning
