#include "drawn_part.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "paper_program.hpp"

namespace turnwright::nc::test {
namespace {

/// Two cylinders with a step between, finished with a corner of 0.4 mm.
Planned stepped(double large_mm, double small_mm) {
  auto d = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 122,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30},
              {"id": "d2", "kind": "cylinder", "length_mm": 30}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})");
  d["outer"][0]["diameter_mm"] = large_mm;
  d["outer"][1]["diameter_mm"] = small_mm;
  return Paper(d)
      .operation(planning::OperationKind::finish, {"d1", "d2"}, "PDJNL-DNMG150604-PF")
      .planned();
}

// In an inner corner of 90 deg the fillet of r stays: at t from both sides that is
// r - sqrt 2 (r - t) beyond its arc.
TEST(DrawnPart, AllowsTheFilletOfTheCornerThatFinishesIt) {
  const auto p = stepped(40, 30);
  const DrawnPart drawn(p);
  const double r = 0.4, fillet = r * (1 - std::sqrt(0.5));
  for (const double t : {0.02, 0.1, fillet - 1e-6})
    EXPECT_EQ(drawn.beyond_mm({15 + t, 30 + t}), 0) << t;
  for (const double t : {fillet + 1e-4, fillet + 0.05, 0.3})
    EXPECT_NEAR(drawn.beyond_mm({15 + t, 30 + t}), r - std::sqrt(2) * (r - t), 1e-6) << t;
  // On the cylinder's side of the fillet, a tenth of a millimetre from its end.
  const double foot = r - std::sqrt(r * r - 0.01);
  EXPECT_EQ(drawn.beyond_mm({15 + foot - 1e-6, 30.3}), 0);
  EXPECT_NEAR(drawn.beyond_mm({15 + foot + 0.01, 30.3}),
              r - std::hypot(0.1, r - foot - 0.01), 1e-6);
}

TEST(DrawnPart, AllowsNothingElse) {
  const auto p = stepped(40, 30);
  const DrawnPart drawn(p);
  EXPECT_NEAR(drawn.beyond_mm({15.001, 45}), 0.001, 1e-9);  // on a cylinder
  EXPECT_NEAR(drawn.beyond_mm({18, 30.002}), 0.002, 1e-9);  // before the wall
  EXPECT_NEAR(drawn.beyond_mm({20.003, 10}), 0.003, 1e-9);
  EXPECT_NEAR(drawn.beyond_mm({22, 10}), 2, 1e-9);  // where nothing was cut
  // Beside an edge: its corner keeps r from there, and nothing stays.
  EXPECT_NEAR(drawn.beyond_mm({20 + 3e-3, 30 + 4e-3}), 5e-3, 2e-6);  // chords round it
}

// A step of h < r counts as high: within the arc that touches both lines.
TEST(DrawnPart, AllowsTheFilletOfALowStepTooAsIfItWereHigh) {
  const auto p = stepped(30.2, 30);
  const DrawnPart drawn(p);
  const double r = 0.4, h = 0.05;
  const double z = 30 + r - std::sqrt(r * r - (r - h) * (r - h));
  EXPECT_EQ(drawn.beyond_mm({15 + h, z - 1e-6}), 0);
  EXPECT_NEAR(drawn.beyond_mm({15 + h, z + 1e-3}),
              r - std::hypot(r - h, 30 + r - z - 1e-3), 1e-6);
}

TEST(DrawnPart, KnowsItsWallsAboveTheirFillets) {
  const auto p = stepped(40, 30);
  const auto walls = DrawnPart(p).walls();
  ASSERT_EQ(walls.size(), 1u);  // no end is faced
  EXPECT_EQ(walls[0].name, "d1|d2");
  EXPECT_FALSE(walls[0].material_right);
  EXPECT_EQ(walls[0].z, 30);
  EXPECT_NEAR(walls[0].from_x, 15.4, 0.03);
  EXPECT_NEAR(walls[0].to_x, 20, 0.03);
}

}  // namespace
}  // namespace turnwright::nc::test
