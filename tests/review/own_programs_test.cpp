// Programs of `nc`, reviewed: their plans' forces, times and tolerances come back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "../nc/plans.hpp"
#include "planning/values/tool_label.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/review/review.hpp"

namespace turnwright::review {
namespace {

using nc::test::Planned;
using planning::OperationPlan;

/// The tool that an operation of a plan has in the program.
MountedTool mounted(const Planned& p, std::size_t setup, const OperationPlan& o,
                    int number) {
  MountedTool m{.number = number};
  for (const auto& t : p.part.tools)
    if (t.id == o.tool) m.turning = t;
  for (const auto& t : p.part.fixed_tools) {
    if (t.id != o.tool) continue;
    m.fixed = t;
    const bool round =
        t.use == catalogue::FixedUse::drilling || t.use == catalogue::FixedUse::centring;
    m.size_mm = t.sizes_mm.empty() ? 0 : (round ? 2 : 1) * o.passes[0].ap_mm;
    if (t.use == catalogue::FixedUse::countersinking) {
      const auto& inner = p.part.drawing.inner;
      const auto& e = *std::ranges::find(inner, o.on[0], &part::InnerElement::id);
      const bool left_is_free = p.part.setups[setup].hold == part::End::right;
      const auto& c = left_is_free ? e.left_chamfer : e.right_chamfer;
      const double D = e.left_mm + 2 * c->radial_mm;
      m.size_mm = *std::ranges::lower_bound(t.sizes_mm, D);
    }
    if (t.use == catalogue::FixedUse::reaming ||
        t.use == catalogue::FixedUse::counterboring)
      m.size_mm = part::extent(p.part.drawing, o.on[0])->left_mm;
  }
  return m;
}

std::vector<MountedTool> turret(const Planned& p, const nc::Programs& programs) {
  std::vector<MountedTool> all;
  for (const auto& s : programs.setups)
    for (const auto& t : s.tools)
      for (std::size_t k = 0; k < p.plan.setups.size(); ++k)
        for (const auto& o : p.plan.setups[k].operations) {
          const auto m = mounted(p, k, o, t.number);
          if ((m.turning || m.fixed) && planning::tool_label(p.part, o) == t.id &&
              std::ranges::find(all, t.number, &MountedTool::number) == all.end())
            all.push_back(m);
        }
  return all;
}

struct Reviewed {
  nc::Programs programs;
  std::vector<MountedTool> tools;
  Review review;
};

// Here somebody mills.
nc::Programs turning_programs(const Planned& p) {
  auto part = p.part;
  if (part.machine.driven_tools) part.machine.driven_tools->c_axis = false;
  return nc::programs(part, p.plan);
}

/// The programs of the setups from `first` on.
Reviewed reviewed(const Planned& p, const nc::Settings& settings, std::size_t first = 0) {
  Reviewed r{turning_programs(p), {}, {}};
  nc::number_tools(r.programs.setups, settings);
  r.tools = turret(p, r.programs);
  std::vector<ReviewedProgram> programs;
  for (const auto& s : r.programs.setups)
    if (s.setup >= first)
      programs.push_back(
          {s.setup,
           read_program(nc::text(s, settings), {.control = settings.control,
                                                .n_max_rpm = p.part.machine.n_max_rpm})});
  r.review = review(p.part, programs, r.tools);
  return r;
}

/// The cut that an operation became: on its surface, with its tool, feed and speed.
const Cut* cut_of(const ReviewedSetup& s, const OperationPlan& o) {
  const Cut* found = nullptr;
  for (const auto& c : s.cuts)
    if (c.on == o.on[0] && c.tool_id == o.tool &&
        std::abs(c.at.f_mm_rev - o.passes[0].f_mm_rev) < 2e-4 &&
        (!c.at.constant_surface_speed || std::abs(c.at.S - o.passes[0].vc_m_min) < 1))
      found = &c;
  return found;
}

/// A plan takes stock off down to the middle of the limits, its program cuts with what the
/// plan corrects: a finishing pass is deeper by what the program moves the surface.
double moved_mm(const Reviewed& r, const Planned& p, const OperationPlan& o) {
  const auto size = std::ranges::find(r.review.sizes, o.on[0], &MadeSize::on);
  const bool finishes = o.kind == planning::OperationKind::finish ||
                        o.kind == planning::OperationKind::bore_finish;
  if (size == r.review.sizes.end() || !finishes) return 0;
  const auto e = part::extent(p.part.drawing, o.on[0]);
  const double middle =
      size->limits ? (size->limits->lower_mm + size->limits->upper_mm) / 2 : 0;
  return (size->nominal_mm + middle - size->diameter_mm) / 2 * (e->inner ? -1 : 1);
}

double force_N(const Planned& p, const OperationPlan& o, double ap_mm) {
  for (const auto& t : p.part.tools)
    if (t.id == o.tool)
      return cutting::forces_N(cutting::cut_of(p.part.material, t), ap_mm,
                               o.passes[0].f_mm_rev)
          .Fc_N;
  return o.passes[0].Fc_N;
}

void expect_forces_of_plan(const std::string& name, const Planned& p, const Reviewed& r) {
  for (const auto& s : r.review.setups)
    for (const auto& o : p.plan.setups[s.setup].operations) {
      const auto where = name + " " + o.id;
      const auto e = part::extent(p.part.drawing, o.on[0]);
      // On cones depths are normal to the way; what parts off finds the hole bored; arcs
      // have a depth of their own everywhere.
      const bool cone = e && e->left_mm != e->right_mm;
      if (o.milled || cone || part::has_cut(p.part.drawing, o.on[0])) continue;
      if (s.setup > 0 && p.part.drawing.stock.parted_mm) continue;
      const auto* c = cut_of(s, o);
      ASSERT_TRUE(c) << where;
      const bool profiles = o.tool.starts_with("PROFILE");
      if (profiles) continue;
      const double moved = moved_mm(r, p, o);
      const double n = static_cast<double>(o.passes.size());
      // On shoulders roughing leaves a wedge of its lead angle.
      const bool shoulder = o.on[0].find('|') != std::string::npos;
      EXPECT_NEAR(c->loads.Fc_N / force_N(p, o, o.passes[0].ap_mm + moved / n), 1,
                  shoulder ? 0.05 : 0.01)
          << where;
    }
}

// The largest share of a step's speed that a word S without decimals cuts off.
double cut_off(const toolpath::SetupProgram& program) {
  double most = 0;
  for (const auto& step : program.steps)
    if (step.S > 0) most = std::max(most, 1 - std::floor(step.S) / step.S);
  return most;
}

// Per setup: how the time divides between cuts that follow each other is not the plan's.
void expect_times_of_plan(const std::string& name, const Planned& p, const Reviewed& r,
                          bool whole_S) {
  for (std::size_t i = 0; i < r.review.setups.size(); ++i) {
    const auto& s = r.review.setups[i];
    const auto& b = p.plan.setups[s.setup].breakdown;
    const auto& m = r.programs.setups[i].minutes;
    const auto& o = p.plan.setups[s.setup].operations;
    if (std::ranges::any_of(o, [](const auto& x) { return x.milled.has_value(); }))
      continue;
    // The way to the first place is not known to a reader.
    const auto& program = r.programs.setups[i];
    const auto& first = program.steps.front().moves.front();
    const double begin_min = std::max(std::abs(first.x_mm - program.change_x_mm),
                                      std::abs(first.z_mm - program.change_z_mm)) /
                             p.part.machine.rapid_mm_min;
    const double read = s.minutes.total() + begin_min;
    const double planned = b.cutting.time_min + b.air.time_min + b.tool_changes.time_min;
    EXPECT_NEAR((read - m.entering) / planned, 1, 0.01) << name << s.setup;
    const double slower = read / (m.total() - m.operator_stops);
    EXPECT_GE(slower, 1 - 0.002) << name;
    EXPECT_LE(slower, 1 + 0.002 + (whole_S ? cut_off(program) : 0)) << name;
  }
}

void expect_tolerances_of_plan(const std::string& name, const Planned& p,
                               const Reviewed& r) {
  const auto all = reconstructed(p.part, r.review);
  for (const auto& why : all.cannot) ADD_FAILURE() << name << ": " << why;
  if (!all.cannot.empty()) return;
  auto q = with_operations(p.part, all.operations, r.tools);
  for (std::size_t s = 0; s < q.setups.size(); ++s)
    q.setups[s].clampings = {p.plan.setups[s].clamping};
  const auto predicted = planning::predict(q);
  ASSERT_EQ(predicted.tolerances.size(), p.plan.tolerances.size()) << name;
  for (std::size_t i = 0; i < predicted.tolerances.size(); ++i) {
    const auto &a = predicted.tolerances[i], &b = p.plan.tolerances[i];
    EXPECT_EQ(a.verdict, b.verdict) << name << " " << a.id;
    for (std::size_t k = 0; k < a.predicted_mm.size(); ++k)
      EXPECT_NEAR(a.predicted_mm[k], b.predicted_mm[k], 0.01 * b.width_mm)
          << name << " " << a.id;
  }
  EXPECT_NEAR(predicted.cost_per_part / p.plan.cost_per_part, 1, 0.01) << name;
}

void expect_review_of_plan(const std::string& name, const Planned& p,
                           const nc::Settings& settings) {
  if (p.plan.status != planning::PlanStatus::ok) return;
  const auto r = reviewed(p, settings);
  for (const auto& s : r.review.setups) {
    for (const auto& u : s.unknown)
      ADD_FAILURE() << name << " line " << u.line << ": " << u.what << ": " << u.why;
    EXPECT_TRUE(s.rapids.empty()) << name << " line " << s.rapids[0].line;
  }
  expect_forces_of_plan(name, p, r);
  expect_times_of_plan(name, p, r, settings.control != gcode::Control::linuxcnc);
  expect_tolerances_of_plan(name, p, r);
}

// The plans of some parts take most of the time: TURNWRIGHT_ALL_PARTS=1 has them too.
std::vector<std::string> parts() {
  auto all = nc::test::reference_parts();
  const std::set<std::string> slow{"gearbox-input-shaft", "infeasible-as-drawn",
                                   "keyed-shaft"};
  if (!std::getenv("TURNWRIGHT_ALL_PARTS"))
    std::erase_if(all, [&](const auto& name) { return slow.contains(name); });
  return all;
}

TEST(ReviewOfOwnPrograms, GivesForcesTimesAndTolerancesOfThePlanInLinuxCnc) {
  for (const auto& name : parts())
    expect_review_of_plan(name, nc::test::planned_reference(name),
                          {.control = gcode::Control::linuxcnc});
}

// Two finishing passes without a rapid between them, each of which climbs its wall: the one
// of d2 is the higher, and a fifth of the pass's time, the cut of d1 the larger.
TEST(ReviewOfOwnPrograms, GivesWallsToThePassThatClimbsThem) {
  const auto& p = nc::test::planned_reference("spindle-nose");
  const auto r = reviewed(p, {.control = gcode::Control::linuxcnc});
  const auto& s = r.review.setups.at(1);
  int finished = 0;
  for (const auto& o : p.plan.setups.at(1).operations) {
    if (o.kind != planning::OperationKind::finish) continue;
    ++finished;
    const auto* c = cut_of(s, o);
    ASSERT_TRUE(c) << o.id;
    EXPECT_NEAR(c->passes.at(0).time_min / o.passes.at(0).time_min, 1, 0.01) << o.id;
  }
  EXPECT_EQ(finished, 2);
}

// What stands before a second setup is as drawn where the first has no program.
TEST(ReviewOfOwnPrograms, OfSecondSetupsAloneFindTheSameCuts) {
  for (const auto& name : parts()) {
    const auto& p = nc::test::planned_reference(name);
    const auto both = reviewed(p, {}), second = reviewed(p, {}, 1);
    if (both.review.setups.size() < 2) continue;
    const auto &expected = both.review.setups[1].cuts,
               &cuts = second.review.setups[0].cuts;
    ASSERT_EQ(cuts.size(), expected.size()) << name;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      EXPECT_EQ(cuts[i].on, expected[i].on) << name;
      EXPECT_NEAR(cuts[i].passes[0].ap_mm, expected[i].passes[0].ap_mm, 0.05)
          << name << " " << cuts[i].on;
    }
  }
}

TEST(ReviewOfOwnPrograms, GivesForcesTimesAndTolerancesOfThePlanInFanuc) {
  for (const char* name : {"drilled-bush", "pump-shaft", "threaded-spindle"})
    expect_review_of_plan(name, nc::test::planned_reference(name),
                          {.control = gcode::Control::fanuc});
}

// Shoulders between bores, which a bar faces.
TEST(ReviewOfOwnPrograms, GivesShouldersBetweenBoresToThePassThatFacesThem) {
  for (const char* name : {"toleranced-counterbores-plain", "toleranced-low-shoulder",
                           "toleranced-shoulder-before-a-thread"}) {
    const auto& p = nc::test::planned_awkward(name);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    expect_review_of_plan(name, p, {});
  }
}

/// A forged flange between two shafts, one behind a cone.
nlohmann::json forging(bool cone) {
  using nlohmann::json;
  json outer{
      {{"id", "a"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 40}},
      {{"id", "rim"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 90}}};
  json outline{{{"length_mm", 60}, {"diameter_mm", 47}},
               {{"length_mm", 24}, {"diameter_mm", 96}}};
  if (cone) {
    outer.push_back({{"id", "k"},
                     {"kind", "cone"},
                     {"length_mm", 30},
                     {"left_mm", 70},
                     {"right_mm", 50}});
    outline.push_back({{"length_mm", 30}, {"left_mm", 80}, {"right_mm", 74}});
  }
  outer.push_back(
      {{"id", "b"}, {"kind", "cylinder"}, {"length_mm", 42}, {"diameter_mm", 50}});
  outline.push_back({{"length_mm", 42}, {"left_mm", 58}, {"right_mm", 56}});
  return {{"name", cone ? "forging with a cone" : "forging"},
          {"material", "C45"},
          {"machine", "lathe-medium"},
          {"stock",
           {{"kind", "forging"},
            {"left_allowance_mm", 2},
            {"outline", outline},
            {"limits_mm", {-0.5, 1}}}},
          {"outer", outer},
          {"setups",
           {{{"hold", "left"}, {"grip_mm", 30}, {"clampings", {"chuck"}}},
            {{"hold", "right"}, {"grip_mm", 30}, {"clampings", {"chuck"}}}}}};
}

// Passes that first reach the forged flange, or a collar that was turned before, take what
// stands there; blocks with three decimals leave a finishing tool 0.2 um less than planned.
TEST(ReviewOfOwnPrograms, KeepsTheLimitsOverLowerStockOfForgings) {
  for (const bool cone : {false, true}) {
    const auto& p = nc::test::planned(forging(cone));
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    const auto r = reviewed(p, {.control = gcode::Control::fanuc});
    double thinnest = 1;
    for (const auto& s : r.review.setups) {
      EXPECT_TRUE(s.unknown.empty());
      for (const auto& c : s.cuts) {
        for (const auto& pass : c.passes) thinnest = std::min(thinnest, pass.ap_mm);
        for (const auto& l : c.limits)
          EXPECT_TRUE(l.margin > -0.01) << cone << " " << c.on << ": " << l.name << " "
                                        << l.value << " " << l.limit;
      }
    }
    if (!cone) {
      EXPECT_LT(thinnest, 0.6);  // what a roughing tool takes at least
    }
    const auto again = reconstructed(p.part, r.review);
    EXPECT_TRUE(again.cannot.empty());
    const auto q = with_operations(p.part, again.operations, r.tools);
    const auto predicted = planning::predict(q);
    EXPECT_EQ(predicted.status, planning::PlanStatus::ok) << cone;
    // As many passes over the cone, and as deep, as the plan has.
    for (const auto& o : again.operations)
      for (const auto& setup : p.plan.setups)
        for (const auto& planned : setup.operations)
          if (planned.id == o.id && o.kind == planning::OperationKind::rough) {
            EXPECT_EQ(o.conditions.passes, static_cast<int>(planned.passes.size()))
                << o.id;
            EXPECT_NEAR(*o.conditions.ap_mm, planned.passes[0].ap_mm, 1e-3) << o.id;
          }
  }
}

// Only the first pass over a forging's blank may be thin: neither the second nor the first at
// another feed.
TEST(ReviewOfOwnPrograms, TellsThinPassesOverForgingsBehindTheFirst) {
  const auto& p = nc::test::planned(forging(false));
  const auto& tool =
      *std::ranges::find(p.part.tools, "PCLNL-CNMG120408-PM", &catalogue::Tool::id);
  const auto told = [&](const std::string& text) {
    const auto read = read_program(
        "G99 T0101\nG97 S1000 M3\n" + text,
        {.control = gcode::Control::fanuc, .n_max_rpm = p.part.machine.n_max_rpm});
    const auto r = review(p.part, {{0, read}}, {{.number = 1, .turning = tool}});
    for (const auto& c : r.setups[0].cuts)
      for (const auto& l : c.limits)
        if (l.name == "least depth of cut" && l.margin < -0.01) return true;
    return false;
  };
  const std::string first = "G0 X57. Z4.\nG1 Z-20. F0.25\nG0 X60.\nZ4.\n";
  EXPECT_FALSE(told(first));
  EXPECT_TRUE(told(first + "X56.4\nG1 Z-20.\nG0 X60.\n"));
  EXPECT_TRUE(told(first + "X56.4\nG1 Z-20. F0.3\nG0 X60.\n"));
  EXPECT_FALSE(told(first + "X55.\nG1 Z-20. F0.3\nG0 X60.\n"));
}

/// A collar whose edge the first setup chamfers, with the wall before it, while the collar is
/// stock.
nlohmann::json chamfered_collar(double chamfer_mm, double grip_mm = 50) {
  return {
      {"name", "collar"},
      {"material", "C45"},
      {"machine", "lathe-medium"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", 60},
        {"length_mm", 123},
        {"left_allowance_mm", 1.5}}},
      {"outer",
       {{{"id", "seat"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 40}},
        {{"id", "collar"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 54}},
        {{"id", "end"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 44}}}},
      {"edges", {{{"at", "collar|end"}, {"chamfer_mm", chamfer_mm}}}},
      {"setups",
       {{{"hold", "left"}, {"grip_mm", grip_mm}, {"clampings", {"chuck"}}},
        {{"hold", "right"}, {"grip_mm", 40}, {"clampings", {"chuck"}}}}}};
}

// A facing tool takes the ring of stock on the edge, several times as deep as the rest of its
// pass, from outside.
TEST(ReviewOfOwnPrograms, KeepsTheLimitsWhereAChamferIsCutIntoStock) {
  for (const double chamfer_mm : {2.0, 0.5}) {
    const auto& p = nc::test::planned(chamfered_collar(chamfer_mm));
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok) << chamfer_mm;
    const auto r = reviewed(p, {.control = gcode::Control::fanuc});
    double deepest = 0;
    for (const auto& c : r.review.setups[0].cuts) {
      if (c.on.starts_with("collar"))
        for (const auto& pass : c.passes) deepest = std::max(deepest, pass.most_mm);
      for (const auto& l : c.limits)
        EXPECT_GT(l.margin, -0.01) << chamfer_mm << " " << c.on << ": " << l.name << " "
                                   << l.value << " " << l.limit;
    }
    EXPECT_GT(deepest, chamfer_mm + 0.6) << chamfer_mm;
    auto operations = reconstructed(p.part, r.review).operations;
    const auto predicted = [&] {
      return planning::predict(with_operations(p.part, operations, r.tools)).status;
    };
    EXPECT_EQ(predicted(), planning::PlanStatus::ok) << chamfer_mm;
    // The tool that finishes the end would meet the whole height of the ring.
    std::erase_if(operations, [](const auto& o) { return o.on[0] == "collar|end"; });
    EXPECT_EQ(predicted(), planning::PlanStatus::infeasible) << chamfer_mm;
  }
}

// Where the setup turns the collar too, no tool needs to face its shoulder.
TEST(ReviewOfOwnPrograms, FacesNoShoulderForAChamferOfAnElementOfTheSameSetup) {
  const auto& p = nc::test::planned(chamfered_collar(0.5, 30));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  for (const auto& o : p.plan.setups[0].operations) EXPECT_NE(o.on[0], "collar|end");
}

// A facing tool takes a little of the seat at an undercut: no second pass that finishes it.
TEST(ReviewOfOwnPrograms, CountsNoFinishingPassesBesideAShoulder) {
  using nlohmann::json;
  const json document{{"name", "seat"},
                      {"material", "42CrMo4-QT"},
                      {"machine", "lathe-medium"},
                      {"damping_ratio", 0.4},
                      {"batch", 20},
                      {"stock",
                       {{"kind", "bar"},
                        {"diameter_mm", 69},
                        {"length_mm", 46},
                        {"left_allowance_mm", 1.5}}},
                      {"outer",
                       {{{"id", "d0"},
                         {"kind", "cylinder"},
                         {"length_mm", 25},
                         {"diameter_mm", 64},
                         {"fit", "k6"}},
                        {{"id", "d1"},
                         {"kind", "cylinder"},
                         {"length_mm", 18},
                         {"diameter_mm", 60},
                         {"fit", "k6"},
                         {"Ra_um", 1.6}}}},
                      {"inner",
                       {{{"id", "b"},
                         {"kind", "cylinder"},
                         {"length_mm", 43},
                         {"diameter_mm", 18},
                         {"from", "right"}}}},
                      {"faces", {{{"id", "d0|d1"}, {"Ra_um", 1.6}}}},
                      {"tolerances",
                       {{{"id", "t0"},
                         {"kind", "length"},
                         {"between", {"d0|d1", "right"}},
                         {"limits_mm", {0, 0.4}}}}},
                      {"edges", {{{"at", "d0|d1"}, {"undercut", "E0.6x0.3"}}}},
                      {"setups",
                       {{{"hold", "left"}, {"clampings", {"chuck"}}},
                        {{"hold", "right"}, {"clampings", {"chuck"}}}}}};
  const auto& p = nc::test::planned(document);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  const auto r = reviewed(p, {.control = gcode::Control::fanuc});
  bool beside = false;
  for (const auto& c : r.review.setups[0].cuts)
    for (const auto& pass : c.passes) beside = beside || (c.on == "d1" && pass.beside);
  EXPECT_TRUE(beside);
  for (const auto& o : reconstructed(p.part, r.review).operations)
    if (o.kind == planning::OperationKind::finish) {
      EXPECT_EQ(o.conditions.passes, 1) << o.id;
    }
}

// Reamers and taps, whose words differ most.
TEST(ReviewOfOwnPrograms, FollowsReamersAndTapsInEveryControl) {
  for (const char* name : nc::test::kWithHoles)
    for (const auto& d : gcode::dialects()) {
      SCOPED_TRACE(d.id);
      const auto& p = nc::test::planned_awkward(name);
      expect_review_of_plan(name, p, {.control = d.control});
      for (const auto& s : reviewed(p, {.control = d.control}).review.setups)
        for (const auto& o : p.plan.setups[s.setup].operations) {
          if (!o.tool.starts_with("REAM") && !o.tool.starts_with("TAP") &&
              !o.tool.starts_with("CSINK"))
            continue;
          const auto* c = cut_of(s, o);
          ASSERT_TRUE(c) << name << " " << o.id;
          EXPECT_EQ(c->passes.size(), 1U) << o.id;
          EXPECT_NEAR(c->loads.Fc_N / o.passes[0].Fc_N, 1, 0.02) << o.id;
          EXPECT_NEAR(c->loads.Pc_kW / o.passes[0].Pc_kW, 1, 0.03) << o.id;
        }
    }
}

// A part with a drill, a groove and a thread in every control, holes and threads by cycles
// too.
TEST(ReviewOfOwnPrograms, IsTheSameInEveryControl) {
  const auto& p = nc::test::planned_reference("threaded-spindle");
  const auto one = reviewed(p, {.control = gcode::Control::linuxcnc});
  for (const auto& d : gcode::dialects())
    for (const bool cycles : {false, true}) {
      const auto r = reviewed(p, {.control = d.control,
                                  .cycles = cycles && !d.thread_cycle.empty(),
                                  .drill_cycles = cycles});
      for (std::size_t i = 0; i < r.review.setups.size(); ++i) {
        const auto &a = one.review.setups[i], &b = r.review.setups[i];
        EXPECT_TRUE(b.unknown.empty()) << d.id << ": " << b.unknown[0].what;
        ASSERT_EQ(a.cuts.size(), b.cuts.size()) << d.id;
        for (std::size_t k = 0; k < a.cuts.size(); ++k) {
          EXPECT_EQ(a.cuts[k].on, b.cuts[k].on) << d.id;
          EXPECT_NEAR(b.cuts[k].loads.Fc_N / a.cuts[k].loads.Fc_N, 1, 0.02)
              << d.id << " " << a.cuts[k].on;
        }
        EXPECT_NEAR(b.minutes.total() / a.minutes.total(), 1, cycles ? 0.02 : 0.005)
            << d.id;
      }
    }
}

// A keyway and a flat are named with their tools and take their time; the surfaces turned
// before and behind them are reviewed as without them.
TEST(ReviewOfOwnPrograms, TellsOfMillingThatItIsNotReviewed) {
  const auto& p = nc::test::planned_reference("keyed-shaft");
  const auto turned = reviewed(p, {.control = gcode::Control::linuxcnc});
  for (const auto& d : gcode::dialects()) {
    if (!d.y_axis) continue;  // the flat needs it
    nc::Settings settings{.control = d.control};
    const bool builders = d.c_axis_is_builders || d.tool_on.empty();
    if (d.c_axis_is_builders)
      settings.milling = {.c_axis_on = "M35", .c_axis_off = "M34"};
    if (builders)
      settings.milling.tool_on =
          d.control == gcode::Control::siemens ? "S2={S} M2=3" : "S{S} M13";
    if (builders)
      settings.milling.tool_off = d.control == gcode::Control::siemens ? "M2=5" : "M15";
    auto programs = nc::programs(p.part, p.plan);
    nc::number_tools(programs.setups, settings);
    std::vector<ReviewedProgram> read;
    for (const auto& s : programs.setups)
      read.push_back({s.setup, read_program(nc::text(s, settings),
                                            {.control = d.control,
                                             .n_max_rpm = p.part.machine.n_max_rpm})});
    const auto r = review(p.part, read, turret(p, programs));
    ASSERT_EQ(r.setups[0].unknown.size(), 2U) << d.id;
    EXPECT_TRUE(r.setups[1].unknown.empty()) << d.id;
    for (const auto& u : r.setups[0].unknown)
      EXPECT_TRUE(u.what.starts_with("milling by T")) << d.id << u.what << u.why;
    ASSERT_EQ(r.setups[0].cuts.size(), turned.review.setups[0].cuts.size()) << d.id;
    EXPECT_TRUE(r.setups[0].rapids.empty()) << d.id;
    const auto& minutes = programs.setups[0].minutes;
    EXPECT_NEAR(r.setups[0].minutes.total() / (minutes.total() - minutes.operator_stops),
                1, 0.005)
        << d.id;
  }
}

// A knurling wheel cuts nothing, and what it does is told.
TEST(ReviewOfOwnPrograms, TellsThatKnurlingIsNotFollowed) {
  const auto& p = nc::test::planned_awkward("knurl before a wall");
  const auto r = reviewed(p, {.control = gcode::Control::linuxcnc});
  const auto& first = r.review.setups.at(0);
  ASSERT_EQ(first.unknown.size(), 1u);
  EXPECT_NE(first.unknown[0].why.find("knurling"), std::string::npos);
  EXPECT_TRUE(std::ranges::none_of(
      first.cuts, [](const auto& c) { return c.tool_id.starts_with("KNURL"); }));
}

}  // namespace
}  // namespace turnwright::review
