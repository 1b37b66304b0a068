// Programs as ways: what their tools leave is the drawing.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "check.hpp"
#include "planning/clamping/clamping_speed.hpp"
#include "planning/clamping/jaws.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "random_parts.hpp"

namespace turnwright::nc {
namespace {

using namespace test;

// Tools that are changed near the work.
Faults near_changes(const Planned& p, const SetupProgram& program) {
  Faults near;
  const Step* last = nullptr;
  for (const auto& step : program.steps) {
    if (step.stop) continue;
    if (last && last->tool != step.tool) {
      const auto& at = last->moves.back();
      if (at.x_mm < p.part.drawing.stock.outer_mm / 2 + 49.9 || at.z_mm < 49.9)
        near.push_back(
            fmt::format("T{} comes in at X{} Z{}", step.tool, at.x_mm, at.z_mm));
    }
    last = &step;
  }
  return near;
}

Faults faults_of(const Planned& p, const Programs& all) {
  Check check(p);
  Faults faults;
  for (const auto& program : all.setups) {
    check.setup(program.setup, ways_of(program, p.plan.setups[program.setup]));
    const auto near = near_changes(p, program);
    faults.insert(faults.end(), near.begin(), near.end());
  }
  check.contour();
  faults.insert(faults.end(), check.faults().begin(), check.faults().end());
  return faults;
}

TEST(NcPrograms, OfEveryReferencePartMakeItsContour) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    const auto all = programs(p.part, p.plan);
    EXPECT_TRUE(all.cannot.empty()) << name;
    if (p.plan.status != planning::PlanStatus::ok) {
      EXPECT_TRUE(all.setups.empty()) << name;
      continue;
    }
    EXPECT_EQ(listed(faults_of(p, all)), "") << name;
  }
}

/// A correction for each finished element, another bow for each.
void correct_all(Planned& p, double bow) {
  const auto& d = p.part.drawing;
  const auto add = [&](const std::string& on, std::size_t setup, double z0, double z1) {
    planning::Compensation c{on, setup, {}};
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0})
      c.table_mm.push_back({std::lerp(z0, z1, u), bow * (u * u - 0.3)});
    p.plan.compensation.push_back(c);
    bow = -0.9 * bow;
  };
  for (std::size_t s = 0; s < p.plan.setups.size(); ++s)
    for (const auto& o : p.plan.setups[s].operations) {
      for (std::size_t i = 0; i < d.outer.size(); ++i) {
        const double z = part::left_z_mm(d, i);
        if (o.kind == planning::OperationKind::finish && o.on[0] == d.outer[i].id &&
            !d.outer[i].cut)
          add(o.on[0], s, z, z + d.outer[i].length_mm);
      }
      for (std::size_t i = 0; i < d.inner.size(); ++i) {
        const double z = part::inner_left_z_mm(d, i);
        if (o.kind == planning::OperationKind::bore_finish && o.on[0] == d.inner[i].id)
          add(o.on[0], s, z, z + d.inner[i].length_mm);
      }
    }
}

// Finished by one tool one after the other: an inner corner, an edge, a straight line.
nlohmann::json joined_surfaces_document() {
  return nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 142,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 20, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 20, "diameter_mm": 30},
              {"id": "d3", "kind": "cylinder", "length_mm": 20, "diameter_mm": 30},
              {"id": "c1", "kind": "cone", "length_mm": 10, "left_mm": 30, "right_mm": 26},
              {"id": "d4", "kind": "cylinder", "length_mm": 10, "diameter_mm": 26}],
    "machine": "lathe-medium",
    "tools": ["PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"],
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})");
}

// A part that is turned between centres is faced in the chuck, whose jaws lose their force
// at speed.
TEST(NcPrograms, FaceInTheChuckBeforeTheCentresComeIn) {
  const auto& p = planned_reference("motor-shaft");
  ASSERT_EQ(p.plan.setups[0].clamping, planning::Clamping::between_centres);
  const double force = planning::jaw_force_N(p.part, 0, planning::Clamping::chuck,
                                             planning::Stage::roughing);
  const double most = planning::grip_loss_rpm(p.part, planning::Clamping::chuck, force);
  ASSERT_LT(most, p.part.machine.n_max_rpm);
  int faces = 0, others = 0;
  const auto all = programs(p.part, p.plan);
  for (const auto& step : all.setups.at(0).steps) {
    if (step.stop) continue;
    const bool face = std::ranges::any_of(step.comments, [](const std::string& line) {
      return line.find("s1-face-right") != line.npos;
    });
    face ? ++faces : ++others;
    if (face) {
      EXPECT_LE(step.n_max_rpm, most);
    }
  }
  EXPECT_GT(faces, 0);
  EXPECT_GT(others, 0);
}

TEST(NcPrograms, LeaveTheStepsBetweenCorrections) {
  for (const double bow : {0.02, -0.02}) {
    auto p = planned(joined_surfaces_document());
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    correct_all(p, bow);
    ASSERT_EQ(p.plan.compensation.size(), 5U);
    EXPECT_EQ(listed(faults_of(p, programs(p.part, p.plan))), "") << bow;
  }
}

/// How far along the axis an operation's passes with a corner of `re_mm` have gone at a
/// radius.
double faced_to(const std::vector<Way>& ways, const std::string& operation, double re_mm,
                double rho_mm) {
  double lowest = INFINITY;
  for (const auto& w : ways) {
    if (w.rapid || w.operation != operation) continue;
    const int n = 1 + static_cast<int>(std::hypot(w.x1 - w.x0, w.z1 - w.z0) / 0.005);
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      const double s = rho_mm - std::lerp(w.x0, w.x1, u) - re_mm;
      if (std::abs(s) > re_mm) continue;
      lowest = std::min(
          lowest, std::lerp(w.z0, w.z1, u) + re_mm - std::sqrt(re_mm * re_mm - s * s));
    }
  }
  return lowest;
}

TEST(NcPrograms, FollowTheCorrectionsOfFaces) {
  auto document = joined_surfaces_document();
  document["faces"] = {{{"id", "right"}, {"Ra_um", 3.2}},
                       {{"id", "d1|d2"}, {"Ra_um", 3.2}}};
  auto p = planned(document);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  struct Face {
    const char* id;
    double z_mm, from_mm, to_mm;
  };
  constexpr Face kRight{"right", 0, 0, 13}, kShoulder{"d1|d2", -60, 15, 20};
  const auto dz = [](double u) { return 0.02 * (u * u - 0.3) + 0.01 * u; };
  for (const auto& f : {kRight, kShoulder}) {
    planning::Compensation c{f.id, 0, {}};
    for (int i = 0; i <= 100; ++i)
      c.table_mm.emplace_back(std::lerp(f.from_mm, f.to_mm, i / 100.0), dz(i / 100.0));
    p.plan.compensation.push_back(c);
  }
  const auto all = programs(p.part, p.plan);
  ASSERT_TRUE(all.cannot.empty());
  const auto ways = ways_of(all.setups.at(0), p.plan.setups[0]);
  for (const auto& f : {kRight, kShoulder}) {
    const auto& o = *std::find_if(
        p.plan.setups[0].operations.begin(), p.plan.setups[0].operations.end(),
        [&](const planning::OperationPlan& each) { return each.on[0] == f.id; });
    const auto tool = std::find_if(p.part.tools.begin(), p.part.tools.end(),
                                   [&](const auto& t) { return t.id == o.tool; });
    const double re = tool->re_mm, foot = f.from_mm > 0 ? f.from_mm + re : 0;
    for (double rho = foot; rho <= f.to_mm; rho += 0.05)
      EXPECT_NEAR(faced_to(ways, o.id, re, rho),
                  f.z_mm + dz((rho - f.from_mm) / (f.to_mm - f.from_mm)), 1e-4)
          << f.id << " at " << rho;
  }
  EXPECT_EQ(listed(faults_of(p, all)), "");
}

// The middle is between the jaws in the first two.
TEST(NcPrograms, OfAThirdSetupMakeTheRest) {
  const auto p = planned(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 92, "left_allowance_mm": 1},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 30},
              {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40},
              {"id": "d3", "kind": "cylinder", "length_mm": 30, "diameter_mm": 36}],
    "faces": [{"id": "left", "Ra_um": 3.2}, {"id": "right", "Ra_um": 3.2}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 50, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 50, "clampings": ["chuck"]},
               {"hold": "left", "grip_mm": 20, "clampings": ["chuck"]}]})"));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  ASSERT_FALSE(p.plan.setups.at(2).operations.empty());
  const auto all = programs(p.part, p.plan);
  EXPECT_EQ(listed(all.cannot), "");
  EXPECT_EQ(listed(faults_of(p, all)), "");
  for (const auto& w : ways_of(all.setups.at(2), p.plan.setups[2]))
    EXPECT_TRUE(w.rapid || w.z0 < -25) << "over what is finished, from Z" << w.z0;
}

/// A thread behind a cylinder as large as it is, with a groove between or without.
Planned behind_a_cylinder(double groove_mm, double pitch_mm) {
  auto d = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 142,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40},
              {"id": "t1", "kind": "thread", "length_mm": 20, "diameter_mm": 36}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})");
  d["outer"][1]["pitch_mm"] = pitch_mm;
  if (groove_mm > 0)
    d["outer"].push_back({{"id", "g1"},
                          {"kind", "groove"},
                          {"length_mm", groove_mm},
                          {"diameter_mm", 30}});
  d["outer"].push_back({{"id", "d2"},
                        {"kind", "cylinder"},
                        {"length_mm", 30 - groove_mm},
                        {"diameter_mm", 36}});
  return planned(d);
}

// Where cuts of threads begin first and end last, along the axis of their programs.
std::pair<double, double> threaded(const Planned& p, const Programs& all) {
  double first = -INFINITY, last = INFINITY;
  for (const auto& s : all.setups)
    for (const auto& w : ways_of(s, p.plan.setups[s.setup]))
      if (w.thread) {
        first = std::max(first, w.z0);
        last = std::min(last, w.z1);
      }
  return {first, last};
}

TEST(NcPrograms, ThreadsBehindWhatTheyDoNotClearNeedRoom) {
  const auto p = behind_a_cylinder(4, 1.5);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  const auto all = programs(p.part, p.plan);
  EXPECT_EQ(listed(all.cannot), "");
  EXPECT_EQ(listed(faults_of(p, all)), "");
  const auto [first, last] = threaded(p, all);
  EXPECT_NEAR(first, -30 + 4 - 0.75, 1e-9);  // half a pitch clear of the cylinder
  EXPECT_NEAR(last, -50 + 1.5, 1e-9);        // a pitch before a shoulder

  for (const auto& [groove_mm, pitch_mm] : {std::pair{0.0, 1.5}, {3.0, 2.5}}) {
    const auto tight = behind_a_cylinder(groove_mm, pitch_mm);
    EXPECT_EQ(tight.plan.status, planning::PlanStatus::infeasible);
    EXPECT_TRUE(programs(tight.part, tight.plan).setups.empty());
    ASSERT_EQ(tight.plan.conflicts.size(), 1U);
    EXPECT_EQ(tight.plan.conflicts[0].sentence,
              fmt::format("thread t1: its tool has {:.3g} mm to come in behind what is "
                          "higher than the thread's root, and needs {:.3g} mm",
                          groove_mm, 1.5 * pitch_mm));
  }
}

// A cone that rises to the thread is cut by the run-in, which begins before it.
TEST(NcPrograms, ThreadsBehindAConeBeginBeforeIt) {
  const auto d = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 142,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30, "diameter_mm": 40},
              {"id": "t1", "kind": "thread", "length_mm": 20, "diameter_mm": 36,
               "pitch_mm": 1.5},
              {"id": "c1", "kind": "cone", "length_mm": 11, "left_mm": 36, "right_mm": 31},
              {"id": "d2", "kind": "cylinder", "length_mm": 19, "diameter_mm": 31}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})");
  const auto p = planned(d);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  const auto all = programs(p.part, p.plan);
  // h3 of ISO 724, and half of what the middle of 6g is below the basic pitch diameter.
  const double below =
      (31.5 + 45 * std::pow(1.5, 0.4) * std::pow(22.4 * 45, 0.05)) / 1000;
  const double depth = 17 / 24.0 * std::sqrt(3) / 2 * 1.5 + below / 2;
  EXPECT_NEAR(threaded(p, all).first, -30 + 11 * depth / 2.5 + 0.75, 1e-4);
  EXPECT_EQ(listed(faults_of(p, all)), "");
}

TEST(RunIn, IsThreePitchesOrWhatTheRoomAllows) {
  using planning::run_in_mm;
  EXPECT_EQ(run_in_mm({.before_mm = 100}, 2), 6);
  EXPECT_EQ(run_in_mm({.before_mm = 5}, 2), 4);  // half a pitch clear
  EXPECT_EQ(run_in_mm({.before_mm = 2.9}, 2), std::nullopt);
  EXPECT_EQ(run_in_mm({.before_mm = 100, .rising_mm = 5.5}, 2), 6.5);
  EXPECT_EQ(run_in_mm({.before_mm = 7.5, .rising_mm = 5.5}, 2), 6.5);
  EXPECT_EQ(run_in_mm({.before_mm = 7.4, .rising_mm = 5.5}, 2), std::nullopt);
  EXPECT_EQ(run_in_mm({.before_mm = 100, .rising_mm = 6.1}, 2), std::nullopt);
}

TEST(NcPrograms, AThreadWhoseReliefWasCutInAnotherSetupEndsAtItsEnd) {
  const auto awkward = document::parse_file(source("tests/data/awkward_parts.json"));
  const auto one = std::find_if(awkward.begin(), awkward.end(), [](const auto& each) {
    return each["part"]["name"] == "thread-relief-other-setup";
  });
  ASSERT_NE(one, awkward.end());
  const auto p = planned((*one)["part"]);
  EXPECT_NEAR(threaded(p, programs(p.part, p.plan)).second, -14, 1e-9);
}

/// A tube of 50 mm with a thread in its end, all through or so far.
Planned threaded_tube(double length_mm) {
  auto d = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "nut", "material": "C45",
    "stock": {"kind": "tube", "outer_mm": 66, "inner_mm": 26, "length_mm": 51,
              "left_allowance_mm": 0},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 20, "diameter_mm": 64},
              {"id": "d2", "kind": "cylinder", "length_mm": 30, "diameter_mm": 62}],
    "inner": [{"id": "t1", "kind": "thread", "from": "right", "designation": "M36x2"}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 15, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 15, "clampings": ["chuck"]}]})");
  d["inner"][0]["length_mm"] = length_mm;
  return planned(d);
}

TEST(NcPrograms, AThreadInABoreEndsAPitchBeforeAShoulderAndWithThePart) {
  for (const auto& [length_mm, ends_mm] : {std::pair{25.0, -25 + 2.0}, {50.0, -50.0}}) {
    const auto p = threaded_tube(length_mm);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    const auto all = programs(p.part, p.plan);
    EXPECT_EQ(listed(all.cannot), "");
    EXPECT_EQ(listed(faults_of(p, all)), "");
    EXPECT_NEAR(threaded(p, all).second, ends_mm, 1e-9);
  }
}

TEST(NcPrograms, FollowTheCorrectionsOfThePlan) {
  for (const auto* name : {"bearing-seat", "iron-hub", "motor-shaft", "titanium-pin"}) {
    auto p = planned_reference(name);
    correct_all(p, 0.02);
    ASSERT_GE(p.plan.compensation.size(), 2U) << name;
    const auto all = programs(p.part, p.plan);
    EXPECT_TRUE(all.cannot.empty()) << name;
    EXPECT_EQ(listed(faults_of(p, all)), "") << name;
  }
}

// Corrections where neighbours are turned in one pass or stand apart: a groove's blank has
// none, and an arc and a bore from the other end may lose the step.
bool neighbours_follow(const Planned& p) {
  const auto cut = [](const auto& e) {
    return e.cut && e.cut->kind != part::CutKind::thread &&
           e.cut->kind != part::CutKind::knurl;
  };
  const auto& d = p.part.drawing;
  return d.inner.empty() && std::none_of(d.outer.begin(), d.outer.end(), cut);
}

TEST(NcPrograms, OfRandomPartsMakeTheirContours) {
  const int parts = parts_to_try(50);
  int made = 0, corrected = 0;
  for (int seed = 1; seed <= parts; ++seed) {
    const auto document = RandomPart(static_cast<std::uint32_t>(seed)).document();
    auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    if (neighbours_follow(p)) {
      correct_all(p, seed % 2 ? 0.02 : -0.02);
      ++corrected;
    }
    const auto all = programs(p.part, p.plan);
    if (!all.cannot.empty()) continue;
    ++made;
    EXPECT_EQ(listed(faults_of(p, all)), "") << document;
  }
  EXPECT_GT(made, parts / 4);
  EXPECT_GT(corrected, parts / 40);
}

TEST(NcPrograms, OfRandomForgingsMakeTheirContours) {
  const int parts = parts_to_try(30);
  int made = 0;
  for (int i = 1; i <= parts; ++i) {
    const auto seed = static_cast<std::uint32_t>(i);
    const auto document = forged(RandomPart(seed).document(), seed);
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    const auto all = programs(p.part, p.plan);
    if (!all.cannot.empty()) continue;
    ++made;
    EXPECT_EQ(listed(faults_of(p, all)), "") << document;
  }
  EXPECT_GT(made, parts / 3);
}

// Each was once cut wrong: its metal, a neighbour's, the jaws, or at a tool change.
TEST(NcPrograms, OfAwkwardPartsMakeTheirContoursOrTellWhyNot) {
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    const auto name = one["part"]["name"].get<std::string>();
    const auto p = planned(one["part"]);
    if (p.plan.status != planning::PlanStatus::ok) {
      std::string conflicts;
      for (const auto& c : p.plan.conflicts) conflicts += c.sentence + '\n';
      const auto told = one.value("told", std::string());
      EXPECT_TRUE(one.contains("infeasible") || one.contains("told")) << name;
      EXPECT_NE(conflicts.find(told), std::string::npos) << name << ": " << conflicts;
      continue;
    }
    const auto all = programs(p.part, p.plan);
    if (one.contains("told")) {
      EXPECT_NE(listed(all.cannot).find(one["told"]), std::string::npos)
          << name << ": " << listed(all.cannot);
      EXPECT_TRUE(all.setups.empty()) << name;
      continue;
    }
    EXPECT_EQ(listed(all.cannot), "") << name;
    EXPECT_EQ(listed(faults_of(p, all)), "") << name;
  }
}

// Between two cylinders, made from the right.
Planned with_arc(double left_mm, double right_mm, double length_mm, double radius_mm,
                 const char* bulge, double grip_mm) {
  auto d = nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 60, "length_mm": 82, "left_allowance_mm": 1},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 30},
              {"id": "a1", "kind": "arc"},
              {"id": "d2", "kind": "cylinder"}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 15, "clampings": ["chuck"]}]})");
  d["outer"][0]["diameter_mm"] = left_mm;
  d["outer"][1].update({{"length_mm", length_mm},
                        {"left_mm", left_mm},
                        {"right_mm", right_mm},
                        {"radius_mm", radius_mm},
                        {"bulge", bulge}});
  d["outer"][2].update({{"length_mm", 50 - length_mm}, {"diameter_mm", right_mm}});
  d["setups"][0]["grip_mm"] = grip_mm;
  return planned(d);
}

TEST(NcPrograms, FollowArcsThatFall) {
  for (const auto& p : {with_arc(46, 46, 8, 20, "concave", 15),   // a throat
                        with_arc(44, 44, 8, 20, "convex", 15),    // a crown
                        with_arc(42, 38, 7, 9, "concave", 15),    // undercuts its end
                        with_arc(46, 48, 10, 12, "convex", 15),   // over the top
                        with_arc(36, 46, 7, 9.5, "convex", 15)})  // from the left alone
  {
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    const auto all = programs(p.part, p.plan);
    EXPECT_EQ(listed(all.cannot), "");
    EXPECT_EQ(listed(faults_of(p, all)), "");
  }
}

TEST(NcPrograms, AnArcThatFallsTooSteeplyIsNone) {
  const auto p = with_arc(44, 44, 10, 7, "convex", 15);
  EXPECT_EQ(p.plan.status, planning::PlanStatus::infeasible);
  ASSERT_EQ(p.plan.conflicts.size(), 1U);
  EXPECT_EQ(
      p.plan.conflicts[0].sentence,
      "a1 cannot be cut in any setup: towards the chuck it falls by more than the 30 "
      "deg that profiling tools are taken to clear");
  EXPECT_TRUE(programs(p.part, p.plan).setups.empty());
}

// Two places on one pin: turned first, then a stop for each, with the spindle at rest,
// the cutter not among the tools and nothing moved.
TEST(NcPrograms, StopWhereAPlaceIsMilled) {
  auto p = planned(nlohmann::json::parse(R"({
    "format": "turnwright-part/1", "name": "pin", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 44, "length_mm": 142,
              "left_allowance_mm": 60},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 80, "diameter_mm": 40}],
    "machine": "turn-mill",
    "tools": ["PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"],
    "milling": [
      {"id": "k1", "kind": "keyway", "on": "d1", "z_mm": 40, "length_mm": 32,
       "width_mm": 8, "depth_mm": 4, "tool": "KEYWAY-HM-8"},
      {"id": "f1", "kind": "flat", "on": "d1", "z_mm": 40, "length_mm": 20,
       "depth_mm": 1, "angle_deg": 180, "tool": "ENDMILL-HM-10"}],
    "setups": [{"hold": "left", "grip_mm": 55, "clampings": ["chuck"]}]})"));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  p.part.machine.driven_tools->c_axis = false;
  const auto all = programs(p.part, p.plan);
  EXPECT_TRUE(all.cannot.empty());
  ASSERT_EQ(all.setups.size(), 1U);
  const auto& program = all.setups[0];

  std::vector<std::string> milled, stopped;
  for (const auto& o : p.plan.setups[0].operations)
    if (o.milled) milled.push_back(o.id + " with " + o.tool);
  for (const auto& step : program.steps) {
    if (!step.stop) {
      EXPECT_TRUE(stopped.empty()) << "turned after it was milled";
      continue;
    }
    const std::string lead = "stop: not in this program: ";
    if (step.comments[0].rfind(lead, 0) != 0) continue;
    ASSERT_EQ(step.comments.size(), 2U);
    EXPECT_EQ(step.comments[1], "no axis C");
    EXPECT_TRUE(step.moves.empty());
    stopped.push_back(
        step.comments[0].substr(lead.size(), step.comments[0].find(',') - lead.size()));
  }
  EXPECT_EQ(milled.size(), 2U);
  EXPECT_EQ(stopped, milled);
  for (const auto& tool : program.tools)
    EXPECT_EQ(tool.id.find("HM-"), std::string::npos);

  for (const auto control : {Control::linuxcnc, Control::fanuc}) {
    std::istringstream lines(text(program, {.control = control}));
    bool turns = false;
    int stops = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == '(') continue;
      if (line.ends_with(" M3")) turns = true;
      if (line == "M5") turns = false;
      if (line != "M0") continue;
      EXPECT_FALSE(turns);
      ++stops;
    }
    EXPECT_EQ(stops, std::ranges::count(program.steps, true, &Step::stop));
    EXPECT_FALSE(turns);
  }
}

}  // namespace
}  // namespace turnwright::nc
