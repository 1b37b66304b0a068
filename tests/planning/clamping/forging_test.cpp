// Castings and forgings.
#include <gtest/gtest.h>

#include <algorithm>

#include "../parts.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/setup_body.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A collar of 22 mm stands 2 mm beside the flange, over the end of `b`.
json flange() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "Flange", "material": "C45",
    "stock": {"kind": "forging", "limits_mm": [-0.5, 1], "left_allowance_mm": 2,
              "outline": [{"length_mm": 60, "diameter_mm": 47},
                          {"length_mm": 24, "diameter_mm": 96},
                          {"length_mm": 42, "left_mm": 58, "right_mm": 56}]},
    "outer": [
      {"id": "a", "kind": "cylinder", "length_mm": 60, "diameter_mm": 40, "fit": "h8"},
      {"id": "rim", "kind": "cylinder", "length_mm": 20, "diameter_mm": 90},
      {"id": "b", "kind": "cylinder", "length_mm": 42, "diameter_mm": 50}],
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "setups": [{"hold": "left", "grip_mm": 30, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 30, "clampings": ["chuck"]}]})");
}

TEST(Forging, ThatIsACylinderIsPlannedAsABar) {
  auto bar = flange();
  bar["stock"] = {{"kind", "bar"}, {"diameter_mm", 96}, {"length_mm", 126}};
  auto forging = bar;
  forging["stock"] = {{"kind", "forging"},
                      {"outline",
                       {{{"length_mm", 26}, {"diameter_mm", 96}},
                        {{"length_mm", 100}, {"left_mm", 96}, {"right_mm", 96}}}}};
  const auto one = plan(part(bar)), other = plan(part(forging));
  ASSERT_EQ(one.status, PlanStatus::ok);
  EXPECT_EQ(one.cost_per_part, other.cost_per_part);
  EXPECT_EQ(one.certificate.lower_bound, other.certificate.lower_bound);
}

// The jaws end 28 mm right of the face; the free end is 122 mm from it.
TEST(Forging, IsHeldAndBendsByItsLeastDiameters) {
  const auto p = part(flange());
  EXPECT_EQ(grip_diameter_mm(p, 0, Clamping::chuck), 46.5);
  const SetupBody body(p, 0, Clamping::chuck, nothing_finished(p.drawing));
  const auto shaft = body.shaft();
  EXPECT_EQ(shaft.segments.front().outer_left_mm, 46.5);
  const auto widest = std::ranges::max_element(
      shaft.segments, {}, [](const auto& s) { return s.outer_left_mm; });
  EXPECT_EQ(widest->outer_left_mm, 95.5) << "its collars not counted";
  EXPECT_EQ(widest->length_mm, 20);
  EXPECT_NEAR(shaft.segments.back().outer_left_mm, 55.5, 1e-12);
}

// Of 16 passes from 97 to 50 mm those above the shaft's own stock, which is 59 mm wide at
// the collar and 57 mm at the end, begin at the collar, 40 mm from the free end.
TEST(Forging, IsPassedOverWhereItStands) {
  const auto p = part(flange());
  const auto outline = outline_over(p, 0, 2);
  EXPECT_EQ(outline.drawn_h, 25);
  EXPECT_EQ(outline.most_h, 48.5);
  const int n = 16;
  for (int i = 0; i < n; ++i) {
    const double left = 50 + 47 * (1 - (i + 1.0) / n);
    const auto z = reaches_stock_z(outline, i, n);
    if (left >= 59)
      EXPECT_NEAR(z.value(), -40, 1e-9) << i;
    else if (left > 57 + 2 / 42. * 2)
      EXPECT_NEAR(z.value(), 2 - (left - 57) * 21, 1e-9) << i;
    else
      EXPECT_FALSE(z) << i;
  }
}

// The shaft's own stock stands 2.75 mm over b at least; the finishing tool could take more.
TEST(Forging, IsFinishedNoDeeperThanItStandsEverywhere) {
  auto document = flange();
  document["stock"]["outline"][2] = {{"length_mm", 42}, {"diameter_mm", 51.5}};
  const auto planned = plan(part(document));
  ASSERT_EQ(planned.status, PlanStatus::ok);
  for (const auto& s : planned.setups)
    for (const auto& o : s.operations)
      if (o.on[0] == "b" && o.kind == OperationKind::finish) {
        double depth = 0;
        for (const auto& pass : o.passes) depth += pass.ap_mm;
        EXPECT_LE(depth, 0.5 * (1 + 1e-6));
      }
  document["stock"]["outline"][2]["diameter_mm"] = 50.8;  // no finishing tool takes 0.15
  const auto thin = plan(part(document));
  EXPECT_EQ(thin.status, PlanStatus::infeasible);
}

TEST(Forging, WithMoreStockCostsMore) {
  const auto planned = plan(part(flange()));
  auto document = flange();
  document["stock"]["limits_mm"] = {-0.5, 3};
  const auto wider = plan(part(document));
  EXPECT_GT(wider.certificate.lower_bound, planned.cost_per_part);
}

}  // namespace
}  // namespace turnwright::planning
