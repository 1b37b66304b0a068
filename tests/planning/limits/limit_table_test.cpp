#include "planning/limits/limit_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "../parts.hpp"
#include "planning/limits/relaxation.hpp"
#include "turnwright/planning/limit.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A tube with eased jaws, two roughnesses, a chuck slower than the spindle, a damped bar,
// and operations that give conditions.
PlanRequest with_every_limit() {
  auto p = part(reference_part("aluminium-tube"));
  p.drawing.outer[0].Rz_um = 20;
  p.machine.chuck.n_max_rpm = 0.5 * p.machine.n_max_rpm;
  for (auto& t : p.tools)
    if (t.bar) t.bar->damping_ratio = 0.1;
  p.operations = {
      {.id = "o1",
       .on = {p.drawing.outer[0].id},
       .tool = {},
       .conditions = {.passes = 1, .ap_mm = 0.01, .f_mm_rev = 9, .vc_m_min = 9000}}};
  return p;
}
const PlanRequest& request() {
  static const auto kRequest = with_every_limit();
  return kRequest;
}
const PreparedPart& prepared() {
  static const auto kPart = prepare(request());
  return kPart;
}

// ---- Rows -----------------------------------------------------------------------------

TEST(LimitTable, EveryCheckHasARowWithWords) {
  std::set<std::string> names;
  for (const auto& row : limit_table()) {
    ASSERT_TRUE(row.name && row.unit);
    if (row.check) {
      EXPECT_EQ(limit_row(*row.check).name, row.name);
    }
    const auto unique = names.insert(row.name).second;
    EXPECT_TRUE(unique || row.check == Check::milled_vc_max) << row.name;
  }
}

TEST(LimitTable, WhatIsNeverRelaxedSaysWhy) {
  std::set<std::string> never;
  for (const auto& row : limit_table()) {
    EXPECT_EQ(row.relaxing == Relaxing::never, row.reason != nullptr) << row.name;
    EXPECT_TRUE(row.relaxing == Relaxing::never || !row.numbers.empty()) << row.name;
    EXPECT_EQ(row.given(), !row.check.has_value()) << row.name;
    if (row.reason) never.insert(row.name);
  }
  EXPECT_EQ(never, (std::set<std::string>{"torque", "least feed of the chip breaker",
                                          "largest feed of the chip breaker",
                                          "cutting speed", "stable depth with its margin",
                                          "compliance of the part", "depth of cut",
                                          "chip thickness", "least chip thickness",
                                          "spindle speed", "feed speed"}));
}

TEST(LimitTable, OneMotorSetsPowerAndTorque) {
  EXPECT_TRUE(sets(limit_row(Check::power), Check::torque));
  EXPECT_FALSE(sets(limit_row(Check::torque), Check::power));
  EXPECT_TRUE(sets(limit_row(Check::Ra), Check::Ra));
  EXPECT_FALSE(sets(limit_row(Check::Ra), Check::Rz));
}

// ---- Numbers of the request, by their names ---------------------------------------------

using Numbers = std::map<std::string, std::vector<double>>;

void add_surfaces(const auto& surfaces, Numbers& all) {
  for (const auto& e : surfaces) {
    if (e.Ra_um) all["roughness Ra of " + e.id] = {*e.Ra_um};
    if (e.Rz_um) all["roughness Rz of " + e.id] = {*e.Rz_um};
  }
}

void add_tool(const catalogue::Tool& t, Numbers& all) {
  const auto range = [&](const std::string& what, const catalogue::Range& r,
                         const char* largest = "largest ") {
    all["least " + what + " of " + t.id] = {r.lower};
    all[largest + what + " of " + t.id] = {r.upper};
  };
  range("depth of cut", t.ap_mm);
  range("feed", t.f_mm_rev);
  range("cutting speed", t.vc_m_min);
  range("tool life", t.T_min, "longest ");
  all["cutting force of " + t.id] = {t.Fc_max_N};
  if (t.bar && t.bar->damping_ratio)
    all["damping ratio of " + t.id] = {*t.bar->damping_ratio};
}

// Written down without the table.
Numbers numbers(const PlanRequest& p) {
  Numbers all;
  for (const auto& t : p.drawing.tolerances)
    all[t.id] = {t.limits ? t.limits->upper_mm - t.limits->lower_mm : t.value_mm};
  add_surfaces(p.drawing.outer, all);
  add_surfaces(p.drawing.inner, all);
  add_surfaces(p.drawing.faces, all);
  const auto& m = p.machine;
  for (const auto& point : m.curve) {
    all["power of " + m.id].push_back(point.P_kW);
    all["power of " + m.id].push_back(point.M_Nm);
  }
  all["damping ratio of " + m.id] = {p.damping_ratio};
  all["damping ratio of chuck and toolpost of " + m.id] = {p.machine_damping_ratio};
  all["feed force of " + m.id] = {m.feed_force_max_N};
  all["largest spindle speed of " + m.id] = {std::min(m.n_max_rpm, m.curve.back().n_rpm)};
  all["least spindle speed of " + m.id] = {m.n_min_rpm};
  all["largest speed of the chuck"] = {m.chuck.n_max_rpm};
  const auto jaws = prepare(p).jaws;
  for (std::size_t s = 0; s < p.setups.size(); ++s) {
    if (!jaws[s].spares_tube)
      all[fmt::format("grip force in setup {}", s + 1)] = {jaws[s].roughing_N};
    if (jaws[s].finishing_N != jaws[s].roughing_N)
      all[fmt::format("finishing grip force in setup {}", s + 1)] = {jaws[s].finishing_N};
  }
  for (const auto& t : p.tools) add_tool(t, all);
  return all;
}

TEST(Limits, AreEveryNumberOfTheRequestThatBoundsACut) {
  std::set<std::string> found, expected;
  for (const auto& l : limits(prepared())) found.insert(l.name);
  for (const auto& [name, values] : numbers(request())) expected.insert(name);
  EXPECT_EQ(found, expected);
}

// The curve ends at the spindle's largest speed; jaws are eased by what the tolerances
// leave of their full force.
bool moves_with(const std::string& limit, const std::string& other) {
  const auto& tolerances = request().drawing.tolerances;
  if (limit.starts_with("largest spindle speed")) return other.starts_with("power");
  return other.starts_with("finishing grip force") &&
         (limit.starts_with("grip force") ||
          std::ranges::count(tolerances, limit, &part::Tolerance::id));
}

TEST(Limits, ScaleTheirNumberAndNoOtherBothWays) {
  const auto before = numbers(request());
  for (const auto& l : limits(prepared())) {
    EXPECT_GT(std::ranges::count(before.at(l.name), l.now), 0) << l.name;
    for (const double k : {2.0, 0.5}) {
      auto p = request();
      l.scale(p, k);
      for (const auto& [name, values] : numbers(p)) {
        if (name != l.name && moves_with(l.name, name)) continue;
        const double factor = name == l.name ? k : 1;
        for (std::size_t i = 0; i < values.size(); ++i)
          EXPECT_NEAR(values[i], factor * before.at(name)[i], 1e-9 * values[i])
              << l.name << " moves " << name;
      }
    }
  }
}

TEST(Limits, SayHowTheyAreMoved) {
  const auto& p = request();
  for (const auto& l : limits(prepared())) {
    const bool least = l.name.starts_with("least ");
    const bool width =
        std::ranges::count(p.drawing.tolerances, l.name, &part::Tolerance::id) > 0;
    EXPECT_EQ(l.at_most, !least) << l.name;
    const auto name = width ? l.called : (least ? "lowering " : "raising ") + l.name;
    EXPECT_EQ(l.called, name);
    EXPECT_EQ(l.called.starts_with("opening "), width) << l.called;
  }
}

// ---- Relaxed --------------------------------------------------------------------------

std::string called(const PreparedPart& p, const RelaxableLimit& l) {
  const auto v = value_of(p, l);
  return v.name + (l.row->is_width || l.surface.empty() ? "" : " of " + l.surface);
}

TEST(Relaxation, GivenConditionsThenWindowsThenTheDrawingThenTheShop) {
  const auto& p = prepared();
  std::vector<std::string> names;
  for (const auto& l : relaxable_limits(p)) names.push_back(called(p, l));
  const std::vector<std::string> first{
      "passes of o1",        "ap_mm of o1",          "f_mm_rev of o1", "vc_m_min of o1",
      "least depth of cut",  "largest depth of cut", "least feed",     "largest feed",
      "least cutting speed", "largest cutting speed"};
  ASSERT_GE(names.size(), first.size());
  EXPECT_EQ(std::vector(names.begin(), names.begin() + 10), first);
  const auto place = [&](const std::string& name) {
    return std::ranges::find(names, name) - names.begin();
  };
  EXPECT_EQ(place("t1 cylindricity"), 10);
  EXPECT_LT(place("t2 flatness"), place("roughness Ra of d1"));
  EXPECT_EQ(place("roughness Rz of d1"), place("roughness Ra of d1") + 1);
  EXPECT_LT(place("roughness Ra of right"), place("power"));
  EXPECT_EQ(place("chatter stiffness") + 1, static_cast<long>(names.size()));
}

TEST(Relaxation, WithoutAGivenConditionItsWindowsAreNoLimits) {
  auto p = request();
  (*p.operations)[0].conditions.f_mm_rev.reset();
  const auto part = prepare(p);
  for (const auto& l : relaxable_limits(part)) {
    const auto name = called(part, l);
    EXPECT_TRUE(name != "f_mm_rev of o1" && name != "least feed" &&
                name != "largest feed");
  }
}

TEST(Relaxation, IsSoManyTimesAsWide) {
  const auto& p = prepared();
  for (const auto& l : relaxable_limits(p)) {
    if (l.row->whole()) continue;
    const auto wider = prepare(relaxed(p, {l}, {3}));
    const auto before = value_of(p, l), after = value_of(wider, l);
    const bool grip = l.row->check == Check::grip;  // by friction: its force stays
    const double times = grip ? 1 : before.at_most ? 3 : 1.0 / 3;
    EXPECT_NEAR(after.now, times * before.now, 1e-9 * after.now) << before.name;
    EXPECT_NEAR(relaxed_value(before, 3), (before.at_most ? 3 : 1.0 / 3) * before.now,
                1e-9 * before.now);
  }
  const auto grip = prepare(relaxed(p, {{&limit_row(Check::grip)}}, {3})).machine.chuck;
  EXPECT_NEAR(grip.friction, 3 * p.machine.chuck.friction, 1e-12);
  EXPECT_NEAR(3 * grip.jaw_mass_radius_kg_m, p.machine.chuck.jaw_mass_radius_kg_m, 1e-12);
}

// Every tool's, not only the one that a result names.
TEST(Relaxation, LimitsOfToolsAreRelaxedTogether) {
  const auto& p = prepared();
  for (const Check check : {Check::force, Check::life_min, Check::life_max}) {
    const auto wider = numbers(relaxed(p, {{&limit_row(check)}}, {4}));
    const std::string name = limit_row(check).name;
    for (const auto& t : p.tools) {
      const auto before = numbers(p).at(name + " of " + t.id)[0];
      EXPECT_NEAR(wider.at(name + " of " + t.id)[0],
                  before * (check == Check::life_min ? 0.25 : 4), 1e-9 * before);
    }
  }
}

PlanRequest without(const PreparedPart& p, const std::string& name) {
  for (const auto& l : relaxable_limits(p))
    if (called(p, l) == name) return relaxed(p, {l}, {kWithout});
  throw std::out_of_range(name);
}

TEST(Relaxation, WithoutALimitItIsGone) {
  const auto& p = prepared();
  EXPECT_EQ(without(p, "t1 cylindricity").drawing.tolerances.size() + 1,
            p.drawing.tolerances.size());
  EXPECT_EQ(without(p, "t1 cylindricity").drawing.tolerances[0].id, "t2");
  EXPECT_FALSE(without(p, "roughness Ra of b1").drawing.inner[0].Ra_um);
  EXPECT_TRUE(without(p, "roughness Ra of b1").drawing.outer[0].Ra_um);
  EXPECT_FALSE((*without(p, "passes of o1").operations)[0].conditions.passes);
  EXPECT_FALSE((*without(p, "vc_m_min of o1").operations)[0].conditions.vc_m_min);
  EXPECT_EQ(without(p, "feed force").machine.feed_force_max_N,
            kFar * p.machine.feed_force_max_N);
}

TEST(Relaxation, WindowsOpenToWhatIsGivenAndNoFurther) {
  const auto& p = prepared();
  const auto ap = without(p, "least depth of cut"), f = without(p, "largest feed"),
             vc = without(p, "largest cutting speed");
  for (std::size_t i = 0; i < p.tools.size(); ++i) {
    EXPECT_EQ(ap.tools[i].ap_mm.lower, std::min(0.01, p.tools[i].ap_mm.lower));
    EXPECT_LE(ap.tools[i].re_mm, 0.015);  // 2/3 of the corner is the least depth
    EXPECT_EQ(f.tools[i].f_mm_rev.upper, std::max(9.0, p.tools[i].f_mm_rev.upper));
    EXPECT_GE(0.8 * f.tools[i].re_mm, 9 * (1 - 1e-12));
    EXPECT_EQ(vc.tools[i].vc_m_min.upper, 9000);
    EXPECT_EQ(vc.tools[i].vc_m_min.lower, p.tools[i].vc_m_min.lower);
  }
  const auto same = without(p, "largest depth of cut");  // already above what is given
  for (std::size_t i = 0; i < p.tools.size(); ++i)
    EXPECT_EQ(same.tools[i].ap_mm.upper, p.tools[i].ap_mm.upper);
}

// All at once: windows open to conditions before these go, and later tolerances go before
// earlier ones move to their places.
TEST(Relaxation, TheOrderOfManyDoesNotMatter) {
  const auto& p = prepared();
  const auto all = relaxable_limits(p);
  const auto open = relaxed(p, all, RelaxationFactors(all.size(), kWithout));
  EXPECT_TRUE(open.drawing.tolerances.empty());
  EXPECT_FALSE((*open.operations)[0].conditions.vc_m_min);
  EXPECT_GE(open.tools[0].vc_m_min.upper, 9000);
}

TEST(Relaxation, BearsOnTheSurfacesThatHaveToKeepIt) {
  const auto& p = prepared();
  std::map<std::string, std::set<std::string>> of;
  for (const auto& l : relaxable_limits(p))
    for (const auto* surface : {"d1", "d2", "b1", "left", "right"})
      if (bears_on(p, l, surface)) of[called(p, l)].insert(surface);
  using Surfaces = std::set<std::string>;
  EXPECT_EQ(of["t1 cylindricity"], Surfaces{"b1"});
  EXPECT_EQ(of["part:length length"], (Surfaces{"left", "right"}));
  EXPECT_EQ(of["roughness Ra of d2"], Surfaces{"d2"});
  EXPECT_EQ(of["ap_mm of o1"], Surfaces{"d1"});
  for (const auto* name : {"power", "cutting force", "largest feed", "grip of the chuck"})
    EXPECT_EQ(of[name].size(), 5u) << name;
}

TEST(Relaxation, IsReportedToFourDigitsAndNeverTooLow) {
  EXPECT_NEAR(reported_factor({"power", "kW", 7, true}, 1.23456) * 7, 8.642, 1e-9);
  EXPECT_NEAR(reported_factor({"least tool life", "min", 7, false}, 1.23456), 1.235,
              1e-9);
  for (double x = 1; x < 3; x += 0.0137)
    EXPECT_GE(reported_factor({"power", "kW", 7, true}, x), x * (1 - 1e-12));
}

}  // namespace
}  // namespace turnwright::planning
