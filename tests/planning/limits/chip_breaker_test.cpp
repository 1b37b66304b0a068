#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"
#include "turnwright/catalogue/chip_window.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

// Chip breakers whose window is a polygon.
namespace turnwright::planning {
namespace {

nlohmann::json rougher() { return file("tests/data/heavy-rougher.json"); }

// The pin with stock enough for one deep pass, roughed by that tool.
nlohmann::json rough_pin(const nlohmann::json& tool) {
  auto d = pin();
  d["stock"]["diameter_mm"] = 44;
  d["tools"] = {tool, "PDJNL-DNMG150604-PF"};
  return d;
}

std::vector<catalogue::ChipPiece> pieces(const nlohmann::json& window) {
  std::vector<catalogue::ChipPoint> polygon;
  for (const auto& corner : window) polygon.push_back({corner[0], corner[1]});
  return catalogue::convex_pieces(polygon);
}

TEST(ChipBreaker, PassesLieInItsPolygonAndThePlanIsCertified) {
  const auto tool = rougher();
  const auto r = plan(part(rough_pin(tool)));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(r.certificate.kind, CertificateKind::global);
  const auto all = pieces(tool["window"]["chip_window"]);
  EXPECT_GT(all.size(), 1u);
  int roughed = 0;
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) {
      if (o.tool != "heavy-rougher") continue;
      for (const auto& pass : o.passes) {
        ++roughed;
        EXPECT_TRUE(std::any_of(
            all.begin(), all.end(),
            [&](const auto& piece) {
              catalogue::ChipPiece wider = piece;  // by what a plan may be over
              for (auto* range : {&wider.ap_mm, &wider.f_mm_rev}) {
                range->lower *= 1 - 1e-9;
                range->upper *= 1 + 1e-9;
              }
              for (auto& e : wider.edges) e.f1_mm_rev *= e.upper ? 1 + 1e-9 : 1 - 1e-9;
              return catalogue::holds(wider, {pass.ap_mm, pass.f_mm_rev});
            }))
            << o.id << ' ' << pass.ap_mm << ' ' << pass.f_mm_rev;
      }
    }
  EXPECT_GT(roughed, 0);
}

// Two halves of a window by hand, each convex: the better one is the plan of the whole.
TEST(ChipBreaker, TheBestPieceIsThePlanOfTheWhole) {
  const auto cost = [](const nlohmann::json& window) {
    auto tool = rougher();
    tool["window"]["chip_window"] = window;
    auto d = rough_pin(tool);
    d["operations"] = {{{"id", "r"},
                        {"setup", 0},
                        {"kind", "rough"},
                        {"on", {"d2"}},
                        {"tool", "heavy-rougher"}},
                       {{"id", "e"}, {"setup", 0}, {"kind", "finish"}, {"on", {"d2"}}},
                       {{"id", "f"},
                        {"setup", 0},
                        {"kind", "face"},
                        {"on", {"right"}},
                        {"tool", "PCLNL-CNMG120408-PM"}},
                       {{"id", "g"},
                        {"setup", 1},
                        {"kind", "face"},
                        {"on", {"left"}},
                        {"tool", "PCLNL-CNMG120408-PM"}},
                       {{"id", "h"}, {"setup", 1}, {"kind", "finish"}, {"on", {"d1"}}}};
    d["tools"].push_back("PCLNL-CNMG120408-PM");
    const auto r = plan(part(d));
    return r.status == PlanStatus::ok ? r.cost_per_part : 1e9;
  };
  const double whole = cost(
      {{0.8, 0.2}, {3, 0.22}, {6, 0.35}, {6, 0.6}, {3, 0.6}, {2.5, 0.4}, {0.8, 0.4}});
  // Cut from the inward corner (2.5, 0.4) to (3, 0.22); that at (3, 0.22) bends outwards
  // to the right and inwards nowhere on either side.
  const double shallow = cost({{0.8, 0.2}, {3, 0.22}, {2.5, 0.4}, {0.8, 0.4}});
  const double deep = cost({{3, 0.22}, {6, 0.35}, {6, 0.6}, {3, 0.6}, {2.5, 0.4}});
  ASSERT_LT(whole, 1e8);
  EXPECT_NEAR(whole, std::min(shallow, deep), 1e-4 * whole);
}

TEST(ChipBreaker, PolygonOfARectangleIsItsRanges) {
  auto tool = rougher(), ranges = tool;
  tool["window"]["chip_window"] = {{0.8, 0.2}, {5, 0.2}, {5, 0.5}, {0.8, 0.5}};
  ranges["window"].erase("chip_window");
  ranges["window"]["ap_mm"] = {0.8, 5};
  ranges["window"]["f_mm_rev"] = {0.2, 0.5};
  const auto a = plan(part(rough_pin(tool))), b = plan(part(rough_pin(ranges)));
  ASSERT_EQ(a.status, PlanStatus::ok);
  EXPECT_NEAR(a.cost_per_part, b.cost_per_part, 1e-9);
}

}  // namespace
}  // namespace turnwright::planning
