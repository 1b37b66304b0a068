// How long a program runs, against its moves integrated step by step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "plans.hpp"
#include "random_parts.hpp"

namespace turnwright::nc {
namespace {

using namespace test;
using Kind = Move::Kind;

catalogue::Lathe lathe() {
  catalogue::Lathe m;
  m.rapid_mm_min = 12000;
  m.index_min = 0.04;
  return m;
}

Step turning(double vc, double n_max, double f, InCut in_cut, std::vector<Move> moves) {
  Step s;
  s.tool = 1;
  s.constant_surface_speed = true;
  s.S = vc;
  s.n_max_rpm = n_max;
  s.f_mm_rev = f;
  s.in_cut = in_cut;
  s.moves = std::move(moves);
  return s;
}

/// Feed along a straight line by the rule of midpoints.
double integrated(const Move& a, const Move& b, const Step& s) {
  constexpr int kSteps = 200000;
  const double l = std::hypot(b.x_mm - a.x_mm, b.z_mm - a.z_mm);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = std::abs(std::lerp(a.x_mm, b.x_mm, (i + 0.5) / kSteps));
    const double n = std::min(s.n_max_rpm, 1000 * s.S / (2 * M_PI * x));
    sum += l / kSteps / (s.f_mm_rev * n);
  }
  return sum;
}

// From outside past the axis, along a cone through the spindle's limit, along the axis.
TEST(MinutesOfAProgram, IntegrateTheFeedUnderTheSpindlesLimit) {
  const std::vector<std::pair<Move, Move>> ways{
      {{Kind::rapid, 40, 0}, {Kind::feed, -0.8, 0}},
      {{Kind::rapid, 5, 2}, {Kind::feed, 35, -40}},
      {{Kind::rapid, 4, 2}, {Kind::feed, 9, -3}},
      {{Kind::rapid, 30, 2}, {Kind::feed, 30, -40}},
      {{Kind::rapid, 6, 2}, {Kind::feed, 6, -40}}};
  for (const auto& [from, to] : ways) {
    SetupProgram p;
    p.change_x_mm = from.x_mm;
    p.change_z_mm = from.z_mm;
    p.steps = {turning(220, 2500, 0.17, {false, -1e9, 1e9}, {to})};
    const auto t = minutes(p, lathe());
    EXPECT_NEAR(t.cutting, integrated(from, to, p.steps[0]), 1e-6 * t.cutting);
    EXPECT_EQ(t.air, 0);
    EXPECT_EQ(t.tool_changes, 0.04);
  }
}

TEST(MinutesOfAProgram, CountAsCutWhatIsOverTheSurface) {
  SetupProgram p;
  p.change_x_mm = 80;
  p.change_z_mm = 60;
  p.steps = {turning(157.0796326794896619, 5000, 0.2, {false, -30, 0},
                     {{Kind::rapid, 26, 60},
                      {Kind::rapid, 26, 2},
                      {Kind::feed, 25, 2},
                      {Kind::feed, 25, -32},
                      {Kind::rapid, 26, -31}})};
  const auto t = minutes(p, lathe());
  // 157.08 m/min on 50 mm are 1000 1/min, 200 mm/min.
  EXPECT_NEAR(t.cutting, 30.0 / 200, 1e-12);
  const double outwards =
      integrated({Kind::rapid, 26, 2}, {Kind::feed, 25, 2}, p.steps[0]);
  EXPECT_NEAR(t.air, 4.0 / 200 + outwards + (54.0 + 58.0 + 1.0) / 12000, 1e-9);
}

// A quarter of a circle at a constant spindle speed, a thread, a stop, another tool.
TEST(MinutesOfAProgram, CountArcsThreadsStopsAndTools) {
  SetupProgram p;
  p.change_x_mm = 20;
  p.change_z_mm = 0;
  Step arc;
  arc.tool = 3;
  arc.S = 800;
  arc.f_mm_rev = 0.25;
  arc.in_cut = {false, -10, 0};
  arc.moves = {{Kind::arc, 30, -10, {30, 0}, true}};
  Step stop;
  stop.stop = true;
  stop.stop_min = 0.5;
  Step thread = arc;
  thread.tool = 4;
  thread.f_mm_rev = 2;
  thread.in_cut = {false, -30, -15};
  thread.moves = {{Kind::rapid, 30, -9}, {Kind::thread, 30, -30}};
  p.steps = {arc, stop, thread};
  const auto t = minutes(p, lathe());
  EXPECT_NEAR(t.cutting, M_PI / 2 * 10 / 200 + 15.0 / 1600, 1e-9);
  EXPECT_NEAR(t.air, 1.0 / 12000 + 6.0 / 1600, 1e-12);
  EXPECT_EQ(t.operator_stops, 0.5);
  EXPECT_EQ(t.tool_changes, 2 * 0.04);
  EXPECT_NEAR(t.total(), t.cutting + t.air + 0.58, 1e-15);
}

// Feed by the minute, a plunge at a share of it, and a rapid of which Y is the longest.
TEST(MinutesOfAProgram, CountMillingByTheMinute) {
  SetupProgram p;
  p.change_x_mm = 20;
  p.change_z_mm = 0;
  Step mill;
  mill.tool = 5;
  mill.milling = Milling{.n_rpm = 4000, .f_mm_min = 300};
  mill.in_cut = {false, -INFINITY, INFINITY};
  Move plunge{Kind::feed, 17, 0}, along{Kind::feed, 17, -40}, aside{Kind::feed, 17, -40},
      away{Kind::rapid, 18, -41};
  plunge.feed_share = 0.3;
  aside.y_mm = 3;
  away.y_mm = -9;
  mill.moves = {plunge, along, aside, away};
  p.steps = {mill};
  const auto t = minutes(p, lathe());
  EXPECT_NEAR(t.cutting, (3 / 0.3 + 40 + 3) / 300, 1e-12);
  EXPECT_NEAR(t.air, 12.0 / 12000, 1e-12);
  EXPECT_EQ(t.tool_changes, 0.04);
  // Where it is a stop instead, somebody else's time counts.
  std::vector<SetupProgram> all{p};
  all[0].tools = {{5, "CUTTER", 5, 0, kCutterOrientation}};
  fit_to_control(all, {.control = Control::fanuc}, lathe());
  EXPECT_TRUE(all[0].steps[0].stop);
  EXPECT_TRUE(all[0].tools.empty());
  EXPECT_EQ(all[0].minutes.total(), 0);
}

/// Minutes of a setup that its program has too.
double machine_min(const planning::Breakdown& b) {
  return b.cutting.time_min + b.air.time_min + b.tool_changes.time_min +
         b.operator_stops.time_min;
}

/// The largest difference between plan and program of a setup, relative; told where it is
/// more than a per cent.  What a program enters down a slope, between surfaces that go on
/// from each other and are left unlike by roughing, is apart.
double apart(const std::string& name, const Planned& p, const Programs& all) {
  double most = 0;
  for (const auto& program : all.setups) {
    const auto& s = p.plan.setups[program.setup];
    const auto& m = program.minutes;
    const auto& b = s.breakdown;
    const double off = machine_min(b) / (m.total() - m.entering) - 1;
    most = std::max(most, std::abs(off));
    if (std::getenv("TURNWRIGHT_TELL") || !(std::abs(off) <= 0.01))
      fmt::print(
          "{} setup {}: {:+.2f} %, plan {:.4f} program {:.4f}; cut {:.4f} {:.4f}, "
          "air {:.4f} {:.4f}, tools {:.3f} {:.3f}, stops {:.3f} {:.3f}\n",
          name, program.setup, 100 * off, machine_min(b), m.total(), b.cutting.time_min,
          m.cutting, b.air.time_min, m.air, b.tool_changes.time_min, m.tool_changes,
          b.operator_stops.time_min, m.operator_stops);
  }
  return most;
}

constexpr double kAlike = 0.01;

TEST(PlanAndProgram, OfReferencePartsTakeTheSameTime) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    const auto all = programs(p.part, p.plan);
    EXPECT_TRUE(all.cannot.empty()) << name;
    EXPECT_LE(apart(name, p, all), kAlike) << name;
  }
}

// Passes over a forging begin where they reach stock.
TEST(PlanAndProgram, OfForgingsTakeTheSameTime) {
  int made = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    auto document = forged(RandomPart(seed).document(), seed);
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_LE(apart(fmt::format("forging {}", seed), p, programs(p.part, p.plan)),
              kAlike);
    ++made;
  }
  EXPECT_GT(made, 15);
}

// Undercuts are cut by the operations that face their shoulders, or finish their threads;
// knurls have one of their own.
TEST(PlanAndProgram, OfShouldersWithUndercutsAndKnurlsTakeTheSameTime) {
  int made = 0;
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    const auto name = one["part"]["name"].get<std::string>();
    if (!name.ends_with("run true") && !name.ends_with("runs true") &&
        name.find("thread with undercut") == std::string::npos &&
        name.find("knurl") == std::string::npos)
      continue;
    ++made;
    const auto p = planned(one["part"]);
    EXPECT_LE(apart(name, p, programs(p.part, p.plan)), kAlike) << name;
  }
  EXPECT_EQ(made, 13);
}

// Driven tools come and go for every place; in a later setup somebody drills at a stop.
TEST(PlanAndProgram, OfCrossHolesTakeTheSameTime) {
  const auto& p = planned_awkward("cross-holes");
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  auto all = programs(p.part, p.plan);
  ASSERT_EQ(all.setups.at(0).setup, 0u);
  all.setups.resize(1);
  EXPECT_LE(apart("cross-holes", p, all), kAlike);
}

// Over the shoulder a facing pass takes as long as planned, but for the middle of the bore's
// limits; the way out along the bore is no part of it.
TEST(PlanAndProgram, OfFacedShouldersBetweenBoresTakeTheSameTime) {
  constexpr double kOfLimits = 0.005;
  int made = 0;
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    const auto name = one["part"]["name"].get<std::string>();
    if (!name.starts_with("toleranced-")) continue;
    const auto p = planned(one["part"]);
    const auto all = programs(p.part, p.plan);
    EXPECT_LE(apart(name, p, all), kAlike) << name;
    for (const auto& program : all.setups)
      for (const auto& o : p.plan.setups[program.setup].operations) {
        if (o.on[0].find('|') == std::string::npos) continue;
        const auto step = std::ranges::find_if(program.steps, [&](const Step& s) {
          return !s.comments.empty() &&
                 s.comments[0].starts_with("operation " + o.id + ":");
        });
        ASSERT_NE(step, program.steps.end()) << o.id;
        SetupProgram alone;
        alone.steps = {*step};
        auto& moves = alone.steps[0].moves;
        while (moves.back().kind == Kind::rapid ||
               moves.back().x_mm == moves[moves.size() - 2].x_mm)
          moves.pop_back();
        const auto slopes = [&](std::size_t i) {
          return moves[i].kind != Kind::rapid && moves[i].z_mm != moves[i - 1].z_mm;
        };
        bool edge = false;  // an edge that another setup leaves is cut on the way
        for (std::size_t i = 1; i < moves.size(); ++i) edge = edge || slopes(i);
        if (edge) continue;
        EXPECT_NEAR(minutes(alone, p.part.machine).cutting, o.time_min,
                    kOfLimits * o.time_min)
            << name << " " << o.id;
        ++made;
      }
  }
  EXPECT_EQ(made, 11);
}

// Facing goes on along the edge of an element that the setup before has made.
TEST(PlanAndProgram, OfEdgesAtFacedShouldersTakeTheSameTime) {
  for (const char* key : {"radius_mm", "chamfer_mm"}) {
    auto document = nlohmann::json::parse(R"({
      "format": "turnwright-part/1", "name": "collar", "material": "C45",
      "stock": {"kind": "bar", "diameter_mm": 64, "length_mm": 94, "left_allowance_mm": 2},
      "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 40, "diameter_mm": 30},
                {"id": "d2", "kind": "cylinder", "length_mm": 20, "diameter_mm": 60},
                {"id": "d3", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40}],
      "faces": [{"id": "d1|d2", "Ra_um": 1.6}], "machine": "lathe-medium",
      "damping_ratio": 0.4,
      "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
                 {"hold": "right", "grip_mm": 20, "clampings": ["chuck"]}]})");
    document["edges"] = {{{"at", "d1|d2"}, {key, 8}}};
    const auto p = planned(document);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    EXPECT_LE(apart(key, p, programs(p.part, p.plan)), kAlike);
  }
}

// The tip comes up to a rounded edge on a slope, and a corner's radius below it on a wall.
TEST(PlanAndProgram, OfRoundedEdgesTakeTheSameTime) {
  const auto p = planned(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "shaft", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 54, "length_mm": 84, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 30},
              {"id": "d2", "kind": "cylinder", "length_mm": 20, "diameter_mm": 50},
              {"id": "d3", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40}],
    "edges": [{"at": "d2|d3", "radius_mm": 4}, {"at": "right", "radius_mm": 4}],
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "tools": ["PCLNL-CNMG120412-PM", "PDJNL-DNMG150608-PF"],
    "setups": [{"hold": "left", "clampings": ["chuck"]},
               {"hold": "right", "clampings": ["chuck"]}]})"));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  EXPECT_LE(apart("rounded", p, programs(p.part, p.plan)), kAlike);
}

TEST(PlanAndProgram, OfReamedAndTappedPartsTakeTheSameTime) {
  for (const char* name : kWithHoles) {
    const auto& p = planned_awkward(name);
    EXPECT_LE(apart(name, p, programs(p.part, p.plan)), kAlike) << name;
  }
}

TEST(PlanAndProgram, OfRandomPartsTakeTheSameTimeAndArePrograms) {
  const int parts = parts_to_try(100);
  int made = 0;
  for (int seed = 1; seed <= parts; ++seed) {
    const auto document = RandomPart(static_cast<std::uint32_t>(seed)).document();
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    ++made;
    const auto all = programs(p.part, p.plan);
    for (const auto& why : all.cannot) ADD_FAILURE() << seed << ": " << why;
    EXPECT_LE(apart(std::to_string(seed), p, all), kAlike) << seed;
  }
  EXPECT_GT(made, parts / 4);
}

}  // namespace
}  // namespace turnwright::nc
