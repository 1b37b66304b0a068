// Programs make lengths in the middles of their limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "plans.hpp"

namespace turnwright::nc {
namespace {

using namespace test;
using nlohmann::json;

json stepped(double shoulder_mm, const json& outer_limits, double depth_mm,
             const json& inner_limits) {
  auto d = json::parse(R"({
    "format": "turnwright-part/1", "name": "Stepped bush", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 80, "length_mm": 64},
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "setups": [{"hold": "left", "grip_mm": 15, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 15, "clampings": ["chuck"]}]})");
  d["outer"] = {{{"id", "d1"},
                 {"kind", "cylinder"},
                 {"diameter_mm", 76},
                 {"length_mm", 60 - shoulder_mm}},
                {{"id", "d2"},
                 {"kind", "cylinder"},
                 {"diameter_mm", 60},
                 {"length_mm", shoulder_mm}}};
  d["inner"] = {{{"id", "seat"},
                 {"kind", "cylinder"},
                 {"from", "right"},
                 {"diameter_mm", 44},
                 {"length_mm", depth_mm}},
                {{"id", "bore"},
                 {"kind", "cylinder"},
                 {"from", "right"},
                 {"diameter_mm", 30},
                 {"length_mm", 60 - depth_mm}}};
  d["tolerances"] = {{{"id", "shoulder"},
                      {"kind", "length"},
                      {"between", {"right", "d1|d2"}},
                      {"limits_mm", outer_limits}},
                     {{"id", "depth"},
                      {"kind", "length"},
                      {"between", {"right", "seat|bore"}},
                      {"limits_mm", inner_limits}}};
  return d;
}

// Least z that each operation's tool reaches at feed.
std::map<std::string, double> reached(const Planned& p) {
  std::map<std::string, double> all;
  const auto made = programs(p.part, p.plan);
  EXPECT_TRUE(made.cannot.empty());
  for (const auto& program : made.setups)
    for (const auto& step : program.steps) {
      double least = INFINITY;
      for (const auto& m : step.moves)
        if (m.kind != Move::Kind::rapid) least = std::min(least, m.z_mm);
      if (!step.comments.empty()) all[step.comments[0].substr(0, 29)] = least;
    }
  return all;
}

double offset_mm(const Planned& p, const std::string& on) {
  const auto found = std::ranges::find(p.plan.offsets, on, &planning::ToolOffset::on);
  return found == p.plan.offsets.end() ? 0 : found->offset_mm;
}

// What is drawn at the middle of its limits is made there; the same part drawn at an end of
// them has the same program.
TEST(NcLengths, AreMadeInTheMiddleOfTheirLimits) {
  const auto& drawn = planned(stepped(30.1, {-0.1, 0.1}, 12.025, {-0.025, 0.025}));
  const auto& aside = planned(stepped(30, {0, 0.2}, 12, {0, 0.05}));
  ASSERT_EQ(drawn.plan.status, planning::PlanStatus::ok);
  ASSERT_EQ(aside.plan.status, planning::PlanStatus::ok);
  const auto a = reached(drawn), b = reached(aside);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_NEAR(a.at("operation s1-face-seat-bore: "),
              -12.025 + offset_mm(drawn, "seat|bore"), 1e-9);
  EXPECT_NEAR(a.at("operation s1-face-d1-d2: d1|d"), -30.1 + offset_mm(drawn, "d1|d2"),
              1e-9);
  for (const auto& [operation, z] : a) {
    ASSERT_TRUE(b.contains(operation)) << operation;
    EXPECT_NEAR(b.at(operation), z, 1e-4) << operation;  // offsets for their own forces
  }
}

// A cone stays where it is drawn and ends at the displaced face: a straight way between the
// same points as without, but longer.
TEST(NcLengths, DoNotMoveCones) {
  auto d = stepped(30, {-0.1, 0.1}, 12, {-0.1, 0.1});
  d["outer"][1] = {{"id", "d2"},
                   {"kind", "cone"},
                   {"left_mm", 66},
                   {"right_mm", 60},
                   {"length_mm", 30}};
  auto aside = d;
  aside["tolerances"][0]["limits_mm"] = {0, 0.2};
  // Points of the way that finishes the cone, without the tool's offset.
  const auto cone = [](const Planned& p) {
    std::vector<Point> way;
    const auto made = programs(p.part, p.plan);
    for (const auto& step : made.setups.at(0).steps)
      if (!step.comments.empty() &&
          step.comments[0].starts_with("operation s1-finish-d2"))
        for (const auto& m : step.moves)
          if (m.kind == Move::Kind::feed)
            way.push_back({m.x_mm - offset_mm(p, "d2"), m.z_mm});
    return way;
  };
  const auto a = cone(planned(d)), b = cone(planned(aside));
  ASSERT_GE(a.size(), 2u);
  ASSERT_EQ(a.size(), b.size());
  const auto x_at = [](const std::vector<Point>& way, double z) {
    for (std::size_t i = 1; i < way.size(); ++i)
      if (way[i].z_mm <= z && z <= way[i - 1].z_mm)
        return std::lerp(way[i - 1].h_mm, way[i].h_mm,
                         (z - way[i - 1].z_mm) / (way[i].z_mm - way[i - 1].z_mm));
    return 0.0;
  };
  for (const double z : {-5.0, -15.0, -25.0}) EXPECT_NEAR(x_at(a, z), x_at(b, z), 1e-4);
  EXPECT_NEAR(b.back().z_mm, a.back().z_mm - 0.1, 1e-9);
}

}  // namespace
}  // namespace turnwright::nc
