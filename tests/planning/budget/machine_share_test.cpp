#include "planning/budget/machine_share.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stop_token>

#include "../parts.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A tube 60/10 of two elements: d1, 40 long and gripped whole in setup 0, d2, 100 long,
// whose left end stands where the jaws end; both end faces are cut.
json tube() {
  auto d = pin();
  d["stock"] = {{"kind", "tube"},
                {"outer_mm", 62},
                {"inner_mm", 10},
                {"length_mm", 142},
                {"left_allowance_mm", 1}};
  d["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 60.5}},
      {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 100}, {"diameter_mm", 60}}};
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 41}, {"clampings", {"chuck"}}},
                 {{"hold", "right"}, {"grip_mm", 99}, {"clampings", {"chuck"}}}};
  d["machine_share_um"] = 0;
  return d;
}

json lathe(json axes, double jaws_z_mm = 20) {
  auto m = file("machines/lathe-medium.json");
  json all = json::array();
  for (const std::string name : {"X", "Z", "C"}) {
    json axis = axes.value(name, json::object());
    axis["name"] = name;
    all.push_back(axis);
  }
  m["errors"] = {{"chain", "wCfZXt"}, {"axes", all}, {"jaws_z_mm", jaws_z_mm}};
  return m;
}

json err(const char* name, json c, double b = 0) {
  return {{"err", {{name, {{"c", std::move(c)}, {"b", b}}}}}};
}
json lobes(const char* name, json f) {
  return {{"err", {{name, {{"f", std::move(f)}}}}}};
}
json square(const char* name, double rad) { return {{"sq", {{name, rad}}}}; }

json zone(const char* kind, const char* of, const char* datum = nullptr) {
  json t{{"id", "t"}, {"kind", kind}, {"of", of}, {"value_mm", 0.1}};
  if (datum) t["datum"] = datum;
  return t;
}
json length(const char* from, const char* to) {
  return {{"id", "t"},
          {"kind", "length"},
          {"between", {from, to}},
          {"limits_mm", {-0.05, 0.05}}};
}

PreparedPart with(const json& tolerance, json axes, json d = tube()) {
  d["tolerances"] = {tolerance};
  d["machine"] = lathe(std::move(axes));
  return part(d);
}

// What the first tolerance is taken of, cut in a setup.
MachineTake take(const PreparedPart& p, std::size_t setup = 0) {
  return machine_take(p, 0, setup, Clamping::chuck);
}
double um(const json& tolerance, json axes, std::size_t setup = 0) {
  return take(with(tolerance, std::move(axes)), setup).fixed_um;
}

double machine_um(const std::vector<Share>& shares) {
  const auto machine = std::find_if(shares.begin(), shares.end(),
                                    [](const Share& s) { return s.source == "machine"; });
  return machine == shares.end() ? 0 : machine->um;
}

constexpr double kUm = 1e-4;  // of a micrometre: rounding, and errors' products

// The map from errors to turned parts, through the documents.
TEST(MachineShare, OfTheTurningMapsExamples) {
  auto d = tube();
  d["outer"][1]["limits_mm"] = {-0.05, 0.05};
  d["machine"] = lathe({{"X", err("EXX", {0, 3e-3, 0, 0})}});
  const auto p = part(d);
  ASSERT_EQ(p.drawing.tolerances[0].id, "d2:diameter");
  EXPECT_NEAR(take(p).fixed_um, 2 * 1.80, kUm);  // 30 ppm of 60 mm, either side
  EXPECT_NEAR(um(zone("cylindricity", "d2"), {{"Z", square("EB0Z", 20e-6)}}), 2.0, kUm);
  EXPECT_NEAR(um(zone("flatness", "right"), {{"X", square("EB0X", 20e-6)}}), 0.50, kUm);
  EXPECT_NEAR(um(zone("perpendicularity", "right", "d2"), {{"X", square("EB0X", 20e-6)}}),
              0.50, kUm);
  EXPECT_NEAR(um(zone("cylindricity", "d2"), {{"Z", err("EXZ", {0, 0, 5e-3, 0})}}), 7.0,
              kUm);  // z 20 .. 120
  EXPECT_NEAR(um(zone("straightness", "d2"), {{"Z", err("EXZ", {0, 0, 5e-3, 0})}}), 1.25,
              kUm);
  const json two = {{"C", lobes("EXC", {{0, 0}, {1e-3, 0}})}};
  EXPECT_NEAR(um(zone("circularity", "d2"), two), 2.0, kUm);
  EXPECT_NEAR(um(zone("circularity", "d2"), {{"C", lobes("EXC", {{1e-3, 0}})}}), 0, kUm);
}

// d1 is cut with the part turned round: its right end stands 1 mm before the jaws.
TEST(MachineShare, IsThatOfThePlaceInTheSetup) {
  const json bow = {{"Z", err("EXZ", {0, 0, 5e-3, 0})}};
  EXPECT_NEAR(um(zone("cylindricity", "d1"), bow, 1), 5 * (0.61 * 0.61 - 0.21 * 0.21),
              kUm);
  auto d = tube();
  d["setups"][0]["grip_mm"] = 31;  // d2 is 10 mm further out
  EXPECT_NEAR(take(with(zone("cylindricity", "d2"), bow, d)).fixed_um,
              5 * (1.3 * 1.3 - 0.3 * 0.3), kUm);
}

TEST(MachineShare, OfALengthIsTheScaleOfWhatLiesBetween) {
  const json scale = {{"Z", err("EZZ", {0, 2e-3, 0, 0})}};  // 20 ppm
  EXPECT_NEAR(um(length("left", "right"), scale, 0), 2 * 2.8, kUm);
  EXPECT_NEAR(um(length("right", "left"), scale, 1), 2 * 2.8, kUm);
  EXPECT_NEAR(um(length("right", "d1|d2"), scale), 2 * 2.0, kUm);
  // The shoulder from the left end: 140 mm in setup 1 less 100 mm in setup 0.
  EXPECT_NEAR(um(length("left", "d1|d2"), scale, 0), 2 * 0.8, kUm);
  EXPECT_NEAR(um(length("left", "d1|d2"), scale, 1), 2 * 0.8, kUm);
  // An offset of the tool drops out.
  EXPECT_NEAR(um(length("left", "right"), {{"Z", err("EZZ", {0.03, 0, 0, 0})}}), 0, kUm);
}

// Between a bore of 10 mm and one of 24 mm, 20 mm behind the right end.
TEST(MachineShare, OfAShoulderBetweenBoresIsThatOfItsRingAndPlace) {
  auto d = tube();
  d["stock"]["inner_mm"] = 9;
  d["inner"] = {{{"id", "seat"},
                 {"kind", "cylinder"},
                 {"from", "right"},
                 {"diameter_mm", 24},
                 {"length_mm", 20}},
                {{"id", "bore"},
                 {"kind", "cylinder"},
                 {"from", "right"},
                 {"diameter_mm", 10},
                 {"length_mm", 120}}};
  d["tools"] = "all";
  const auto of = [&](const json& tolerance, json axes) {
    return take(with(tolerance, std::move(axes), d)).fixed_um;
  };
  const json leans = {{"X", square("EB0X", 20e-6)}};
  EXPECT_NEAR(of(zone("flatness", "seat|bore"), leans), 20e-3 * (12 - 5), kUm);
  EXPECT_NEAR(of(zone("perpendicularity", "bore|seat", "d2"), leans), 20e-3 * (12 - 5),
              kUm);
  EXPECT_NEAR(of(length("right", "seat|bore"), {{"Z", err("EZZ", {0, 2e-3, 0, 0})}}),
              2 * 20e-3 * 20, kUm);
}

TEST(MachineShare, OffsetsDropOutIfTheFirstPartIsGauged) {
  auto d = tube();
  d["outer"][1]["limits_mm"] = {-0.05, 0.05};
  const json off = {{"X", err("EXX", {2e-3, 0, 0, 0}, -1e-3)},
                    {"Z", square("EB0Z", 20e-6)}};
  d["machine"] = lathe(off);
  // 2 (2 + 1) um of setting and play, and the taper from 20 to 120 mm.
  EXPECT_NEAR(take(part(d)).fixed_um, 2 * (2 * 3 + 2 * 0.020 * 120), 2 * kUm);
  d["budget"]["first_part_gauged"] = true;
  EXPECT_NEAR(take(part(d)).fixed_um, 2 * 0.020 * 100, kUm);
}

// The tube with d2 ending in a smaller d3, both cut in setup 0.
json stepped() {
  auto d = tube();
  d["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 60.5}},
      {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 60}},
      {{"id", "d3"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 50}}};
  return d;
}

TEST(MachineShare, OfARunOutCountsADatumOfTheSameSetupAsItIsCut) {
  const auto d = stepped();
  const json once = {{"C", lobes("EXC", {{1e-3, 0}})}};
  EXPECT_NEAR(take(with(zone("total-radial-runout", "d3", "d2"), once, d)).fixed_um, 0,
              kUm);
  EXPECT_NEAR(take(with(zone("coaxiality", "d3", "d2"), once, d)).fixed_um, 0, kUm);
  // Of another setup: 1 um off there and 1 um here, in the worst direction.
  EXPECT_NEAR(take(with(zone("total-radial-runout", "d3", "d1"), once, d)).fixed_um, 4,
              3 * kUm);
  EXPECT_NEAR(take(with(zone("coaxiality", "d3", "d1"), once, d)).fixed_um, 4, 3 * kUm);
}

// A cone of the generator gives its sections no run-out, two lobes all of it.
TEST(MachineShare, OfCircularRunOutsIsThatOfTheSections) {
  const auto d = stepped();
  const json taper = {{"Z", square("EB0Z", 20e-6)}};
  const json lobed = {{"C", lobes("EXC", {{0, 0}, {1e-3, 0}})}};
  const auto of_d3 = [&](const char* kind, const json& axes) {
    return take(with(zone(kind, "d3", "d2"), axes, d)).fixed_um;
  };
  EXPECT_NEAR(of_d3("circular-radial-runout", taper), 0, kUm);
  EXPECT_NEAR(of_d3("total-radial-runout", taper), 0.020 * 40, kUm);
  EXPECT_NEAR(of_d3("circular-radial-runout", lobed), 2, kUm);
  // d1 is cut in the other setup: 1 um off there, 1 um here.
  const json once = {{"C", lobes("EXC", {{1e-3, 0}})}};
  EXPECT_NEAR(take(with(zone("circular-radial-runout", "d3", "d1"), once, d)).fixed_um, 4,
              3 * kUm);

  const auto of_face = [&](const char* kind, const json& axes) {
    return um(zone(kind, "right", "d2"), axes);
  };
  const json cone = {{"X", square("EB0X", 20e-6)}};
  EXPECT_NEAR(of_face("circular-axial-runout", cone), 0, kUm);
  EXPECT_NEAR(of_face("total-axial-runout", cone), 0.50, kUm);
  EXPECT_NEAR(of_face("circular-axial-runout", {{"C", lobes("EZC", {{1e-3, 0}})}}), 2,
              kUm);
}

// A taper of 20 urad from 20 to 120 mm: 2.4 um at its end, half of a zone about the drawing.
TEST(MachineShare, OfAProfileCountsItsPlaceAndOfAnAngleItsForm) {
  const json taper = {{"Z", square("EB0Z", 20e-6)}};
  EXPECT_NEAR(um(zone("profile", "d2", "right"), taper), 2 * 2.4, kUm);
  EXPECT_NEAR(um(zone("angularity", "d2", "right"), taper), 2.0, kUm);
  EXPECT_NEAR(um(zone("perpendicularity", "d2", "right"), taper), 0, kUm);  // of its axis
  EXPECT_NEAR(um(zone("angularity", "right", "d2"), {{"X", square("EB0X", 20e-6)}}), 0.50,
              kUm);
  auto gauged = tube();
  gauged["budget"]["first_part_gauged"] = true;
  EXPECT_NEAR(take(with(zone("profile", "d2", "right"), taper, gauged)).fixed_um, 2.0,
              kUm);
}

// Play of 1 um on either side of 2 um of setting: less towards the chuck, more from it.
TEST(MachineShare, IsThatOfTheDirectionAsked) {
  auto d = tube();
  d["outer"][1]["limits_mm"] = {-0.05, 0.05};
  d["machine"] = lathe({{"Z", err("EXZ", {2e-3, 0, 0, 0}, 1e-3)}});
  for (const auto& [direction, off_um] :
       {std::pair{"to-chuck", 1.0}, {"from-chuck", 3.0}}) {
    d["operations"] = {{{"id", "f"},
                        {"setup", 0},
                        {"kind", "finish"},
                        {"on", {"d2"}},
                        {"direction", direction}}};
    EXPECT_NEAR(take(part(d)).fixed_um, 2 * 2 * off_um, kUm) << direction;
  }
}

TEST(MachineShare, OfAFaceCountsTheTiltOfAFaceOfAnotherSetup) {
  // Once per turn of EZC: cos at every radius, 2 um across.  The plane of least squares
  // through it on the left face, by the sums of 21 radii from 30.25 down to 5 mm.
  double r1 = 0, r2 = 0;
  for (int j = 0; j <= 20; ++j) {
    const double r = 30.25 + (5 - 30.25) * j / 20;
    r1 += r;
    r2 += r * r;
  }
  EXPECT_NEAR(
      um(zone("parallelism", "right", "left"), {{"C", lobes("EZC", {{1e-3, 0}})}}),
      2 + 2 * 30 * r1 / r2, 1e-3);
}

TEST(MachineShare, IsNoneWithoutAnErrorModel) {
  auto d = tube();
  d["tolerances"] = {zone("cylindricity", "d2")};
  const auto p = part(d);
  EXPECT_TRUE(p.machine_takes.empty());
  EXPECT_EQ(take(p).fixed_um, 0);
  EXPECT_EQ(take(with(zone("cylindricity", "d2"), json::object())).fixed_um, 0);
}

TEST(MachineShare, UncertaintyOfOneErrorIsItsOwnEffect) {
  auto d = tube();
  d["tolerances"] = {zone("cylindricity", "d2")};
  d["machine"] = lathe({{"Z", square("EB0Z", 20e-6)}});
  d["machine"]["errors"]["u"] = {{{"name", "Z"},
                                  {"sq", {{"EB0Z", 3e-6}}},
                                  {"err", {{"EXZ", {{"c", {0, 0, 4e-4, 0}}}}}}}};
  d["machine"]["errors"]["uncertainty_pct"] = 20;
  // 20 % of 20 urad and 3 urad, over 100 mm; a bow of 0.4 um per (100 mm)^2.
  const double taper = std::hypot(4, 3) * 0.1, bow = 0.4 * (1.44 - 0.04);
  EXPECT_NEAR(take(part(d)).u_um, std::hypot(taper, bow), kUm);
  const auto p = part(d);
  const auto a = tolerance_allocation(p, 0, {0, Clamping::chuck, nullptr});
  EXPECT_NEAR(machine_um(shares(a)), 2.0 + 3 * std::hypot(taper, bow), kUm);
}

// A length has two faces, but the machine only one scale.
TEST(MachineShare, UncertaintyOfALengthIsCountedOnce) {
  auto d = tube();
  d["tolerances"] = {length("left", "right")};
  d["machine"] = lathe({{"Z", err("EZZ", {0, 2e-3, 0, 0})}});
  d["machine"]["errors"]["uncertainty_pct"] = 50;
  const auto result = plan(part(d));
  ASSERT_EQ(result.status, PlanStatus::ok);
  EXPECT_NEAR(machine_um(result.tolerances[0].shares), 2 * 2.8 + 2 * 3 * 1.4, 1e-3);
}

// Zones of machines drawn from the model's uncertainty against what (3) makes of them.
TEST(MachineShare, HoldsDrawnMachinesAsOftenAsItSays) {
  std::mt19937 random(5);
  std::normal_distribution<> gauss;
  const json known = {
      {"Z",
       {{"sq", {{"EB0Z", 2e-5}}}, {"err", {{"EXZ", {{"c", {0, 0, -2e-3, 1e-3}}}}}}}}};
  const double u_square = 4e-6, u_bow = 6e-4, u_cubic = 3e-4;
  for (const char* kind : {"cylindricity", "straightness", "total-radial-runout"}) {
    auto d = tube();
    const bool datum = kind == std::string("total-radial-runout");
    d["tolerances"] = {zone(kind, "d2", datum ? "d1" : nullptr)};
    d["machine"] = lathe(known);
    d["machine"]["errors"]["u"] = {{{"name", "Z"},
                                    {"sq", {{"EB0Z", u_square}}},
                                    {"err", {{"EXZ", {{"c", {0, 0, u_bow, u_cubic}}}}}}}};
    const auto p = part(d);
    const MachineTake said = take(p);
    int over_2 = 0, over_3 = 0;
    constexpr int kDraws = 300;
    for (int i = 0; i < kDraws; ++i) {
      auto drawn = p;
      auto& g = *drawn.machine.errors;
      g.u.clear();
      for (auto& axis : g.chain.axes) {
        if (axis.name != 'Z') continue;
        axis.location[4] += u_square * gauss(random);
        axis.errors[0].c[2] += u_bow * gauss(random);
        axis.errors[0].c[3] += u_cubic * gauss(random);
      }
      drawn.machine_takes = machine_takes(drawn);
      const double found = take(drawn).fixed_um;
      over_2 += found > said.fixed_um + 2 * said.u_um;
      over_3 += found > said.fixed_um + 3 * said.u_um;
    }
    // One-sided 2.3 % and 0.13 %, with what 300 draws may stray by.
    EXPECT_LE(over_2, kDraws * 0.0228 + 8) << kind;
    EXPECT_LE(over_3, 2) << kind;
  }
}

const ToleranceResult& result_of(const ProcessPlan& p, const std::string& id) {
  for (const auto& t : p.tolerances)
    if (t.id == id) return t;
  throw std::out_of_range(id);
}

TEST(MachineShare, ComesOffWhatTheCutMayUse) {
  auto d = tube();
  d["tolerances"] = {zone("cylindricity", "d2")};
  d["tolerances"][0]["value_mm"] = 0.012;
  d["machine_share_um"] = 1;
  const auto before = plan(part(d));
  d["machine"] = lathe({{"Z", square("EB0Z", 20e-6)}});
  const auto after = plan(part(d));
  ASSERT_EQ(before.status, PlanStatus::ok);
  ASSERT_EQ(after.status, PlanStatus::ok);
  const auto &b = result_of(before, "t"), &a = result_of(after, "t");
  EXPECT_NEAR(b.allowed_mm[0] - a.allowed_mm[0], 0.002, 1e-7);
  EXPECT_NEAR(machine_um(b.shares), 1, 1e-12);
  EXPECT_NEAR(machine_um(a.shares), 1 + 2, kUm);
  EXPECT_GE(after.cost_per_part, before.cost_per_part * (1 - 1e-4));
}

TEST(MachineShare, TooLargeForAToleranceIsTheFirstConflict) {
  auto d = tube();
  d["tolerances"] = {zone("cylindricity", "d2")};
  d["tolerances"][0]["value_mm"] = 0.008;
  d["machine"] = lathe({{"Z", square("EB0Z", 1e-4)}});  // 10 um over 100 mm
  const auto p = part(d);
  EXPECT_NEAR(least_machine_mm(p, 0), 0.010, 1e-7);
  const auto result = plan(p);
  EXPECT_EQ(result.status, PlanStatus::infeasible);
  ASSERT_FALSE(result.conflicts.empty());
  EXPECT_EQ(result.conflicts[0].limit, "t cylindricity");
  EXPECT_NE(result.conflicts[0].sentence.find("used up (machine 10 um"),
            std::string::npos)
      << result.conflicts[0].sentence;
}

TEST(MachineShare, ACancelledComputationIsLeft) {
  auto d = tube();
  d["tolerances"] = {zone("cylindricity", "d2")};
  d["machine"] = lathe({{"Z", square("EB0Z", 1e-4)}});
  const auto p = part(d);
  std::stop_source stop;
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_NO_THROW(machine_takes(p));
  stop.request_stop();
  EXPECT_THROW(machine_takes(p), Cancelled);
}

}  // namespace
}  // namespace turnwright::planning
