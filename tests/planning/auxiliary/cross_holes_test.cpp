// Cross holes of whole plans: time, forces and cost in closed form, the choice of speed and
// feed against a lattice, what stops them.
#include "planning/auxiliary/cross_holes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../parts.hpp"
#include "placed_pin.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/preparation/assignment.hpp"
#include "planning/values/tool_label.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning::cross_holes_test {
namespace {

using nlohmann::json;
using std::numbers::pi;

constexpr double kD_mm = 6, kR_mm = 20, kMinute = 1.5;

// A pin of 40 mm, 80 mm long, with a hole across it, held at the left.
json pin(const json& own, const char* drill = "DRILL-HM-5D") {
  json hole{{"id", "h1"},
            {"kind", "cross-hole"},
            {"on", "d1"},
            {"at_mm", 60},
            {"diameter_mm", kD_mm}};
  hole.update(own);
  return placed_pin(hole, 2 * kR_mm, 40,
                    {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", drill});
}

json hollow(json document, double bore_mm) {
  document["stock"] = {{"kind", "tube"},
                       {"outer_mm", 44},
                       {"inner_mm", bore_mm},
                       {"length_mm", 142},
                       {"left_allowance_mm", 60}};
  return document;
}

AuxiliaryWork work_of(const PreparedPart& p) {
  return auxiliary_work(p, 0, Clamping::chuck, assign(p).setups[0],
                        {p.machine_per_min, 1});
}

AuxiliaryOperation only(const AuxiliaryWork& work) {
  EXPECT_EQ(work.after.size(), 1U)
      << (work.conflicts.empty() ? "" : work.conflicts[0].sentence);
  return work.after.at(0);
}

std::string refusal(const PreparedPart& p) {
  const auto work = work_of(p);
  EXPECT_TRUE(work.after.empty());
  return work.conflicts.empty() ? "" : work.conflicts[0].sentence;
}

double limit_of(const OperationPlan& o, const char* name) {
  const auto c = std::ranges::find(o.constraints, name, &ConstraintValue::name);
  return c == o.constraints.end() ? NAN : c->value;
}

// Of a drill without pecks: from 1 mm above the cylinder to the depth of its tip and back.
TEST(CrossHole, TimeForcesAndCostInClosedForm) {
  const double vc = 80, f = 0.09;
  const auto p =
      part(pin({{"depth_mm", 10}, {"conditions", {{"vc_m_min", vc}, {"f_mm_rev", f}}}}));
  const auto o = only(work_of(p));
  const auto& plan = o.plan;
  EXPECT_EQ(plan.kind, OperationKind::cross_drill);
  EXPECT_EQ(plan.id, "s1-drill-h1");
  EXPECT_EQ(plan.on, std::vector<std::string>{"h1"});
  EXPECT_EQ(plan.tool, "DRILL-HM-5D");
  EXPECT_EQ(tool_label(p, plan), "DRILL-HM-5D 6 mm, driven");

  const double half = 70 * pi / 180, n = 1000 * vc / (pi * kD_mm);
  const double tip = 10 + kD_mm / 2 / std::tan(half), vf = f * n;
  ASSERT_EQ(plan.passes.size(), 1U);
  EXPECT_NEAR(plan.passes[0].n_rpm, n, 1e-9 * n);
  EXPECT_NEAR(plan.time_min, tip / vf, 1e-12);
  EXPECT_NEAR(o.air_min, 1 / vf + (1 + tip) / 36000, 1e-12);
  // Life by Taylor's equation, T0 = 45 min at 90 m/min and 0.018 D.
  const double T = 45 * std::pow(90 / vc, 4) * std::pow(0.018 * kD_mm / f, 1.5);
  EXPECT_NEAR(plan.passes[0].T_min, T, 1e-9 * T);
  EXPECT_NEAR(plan.edges, tip / vf / T, 1e-12);
  EXPECT_NEAR(o.plan.cost,
              kMinute * (tip / vf + 1 / vf + (1 + tip) / 36000 + tip / vf / T) +
                  25 * tip / vf / T,
              1e-9);
  // Kienzle's law with two edges, h = f/2 sin(sigma/2).
  const auto kc = cutting::kienzle_at(p.material, 6);
  const double specific = kc.k11_MPa * std::pow(f / 2 * std::sin(half), -kc.m);
  EXPECT_NEAR(plan.passes[0].Ff_N, 0.5 * specific * f * kD_mm / 2 * std::sin(half), 1e-6);
  const double M = specific * f * kD_mm * kD_mm / 8 / 1000;
  EXPECT_NEAR(limit_of(plan, "torque"), M, 1e-9);
  EXPECT_NEAR(limit_of(plan, "power"), M * 2 * pi * n / 60 / 1000, 1e-9);
  EXPECT_NEAR(limit_of(plan, "feed speed"), vf, 1e-9);
  // The thrust points at the axis: nothing turns the part in the jaws or draws it out.
  EXPECT_FALSE(std::ranges::any_of(plan.constraints, [](const ConstraintValue& c) {
    return c.name.find("grip") != std::string::npos;
  }));
}

// From 50 mm outside the stock of 44 mm and before the end that is faced, to 1 mm above the
// hole's middle, 20 mm behind that end, and back.
TEST(CrossHole, TheDrillComesAndGoes) {
  const auto with = pin({{"depth_mm", 10}});
  auto without = with;
  without.erase("milling");
  const auto air_min = [](const json& d) {
    const auto r = plan(part(d));
    EXPECT_EQ(r.status, PlanStatus::ok);
    return r.breakdown.air.time_min;
  };
  const double way = (22 + 50 - (kR_mm + 1)) + (50 + 20);
  EXPECT_NEAR(air_min(with) - air_min(without),
              only(work_of(part(with))).air_min + 2 * way / 36000, 1e-9);
}

// HSS drills go 3 D deep, then draw out every D: here after 18 and 24 mm of 25.8.
TEST(CrossHole, PecksTakeTheirTime) {
  const auto p =
      part(pin({{"depth_mm", 24}, {"conditions", {{"vc_m_min", 25}, {"f_mm_rev", 0.08}}}},
               "DRILL-HSS-5D"));
  const auto o = only(work_of(p));
  const double tip = 24 + 3 / std::tan(59 * pi / 180), vf = 0.08 * 25e3 / (pi * kD_mm);
  const double pecks = std::ceil((tip - 18) / 6), step = (tip - 18) / pecks;
  ASSERT_EQ(pecks, 2);
  EXPECT_NEAR(o.plan.time_min, (tip + 2 * 0.5) / vf, 1e-12);
  const double rapid = 1 + tip + 2 * (18 + 1) - 0.5 + 2 * (18 + step + 1) - 0.5;
  EXPECT_NEAR(o.air_min, 1 / vf + rapid / 36000, 1e-12);
}

// Nothing of the drill's window on a lattice is cheaper, and the best keeps the limits.
TEST(CrossHole, NothingOnALatticeOfTheWindowIsCheaper) {
  for (const double torque : {1.0, 0.1}) {
    auto p = part(pin({{"depth_mm", 10}}));
    for (auto& point : p.machine.driven_tools->curve) {
      point.M_Nm *= torque;
      point.P_kW *= torque;
    }
    const auto best = only(work_of(p)).plan;
    const auto& kept = best.constraints;
    EXPECT_TRUE(std::ranges::all_of(
        kept, [](const ConstraintValue& c) { return c.margin >= -1e-9; }));
    int allowed = 0;
    for (double vc = 54; vc <= 110; vc += 2)
      for (double f = 0.011; f <= 0.018; f += 0.00035) {
        auto q = p;
        q.milled_places[0].drilling.vc_m_min = vc;
        q.milled_places[0].drilling.f_mm_rev = f * kD_mm;
        const auto o = only(work_of(q)).plan;
        if (!std::ranges::all_of(o.constraints,
                                 [](const ConstraintValue& c) { return c.margin >= 0; }))
          continue;
        ++allowed;
        EXPECT_GE(o.cost, best.cost * (1 - 1e-8)) << vc << ' ' << f;
      }
    EXPECT_GT(allowed, 10) << torque;
    if (torque < 1) {
      EXPECT_LT(best.passes[0].f_mm_rev, 0.018 * kD_mm * (1 - 1e-6));
    } else {
      EXPECT_NEAR(best.passes[0].f_mm_rev, 0.018 * kD_mm, 1e-9);
    }
  }
}

// Through the wall the last corner leaves the bore's surface at sqrt(r^2 - D^2/4), through
// the part at the other side of the cylinder; 0.2 mm beyond it and the point come on top.
TEST(CrossHole, GoesThroughTheWallOrThePart) {
  const double point = kD_mm / 2 / std::tan(70 * pi / 180);
  const auto depth = [&](const json& document) {
    const auto p = part(document);
    const auto o = only(work_of(p));
    const auto& drill =
        *std::ranges::find(p.fixed_tools, o.plan.tool, &catalogue::FixedTool::id);
    return cross_hole_tip_mm(p.milled_places[0], drill);
  };
  EXPECT_NEAR(depth(hollow(pin({{"through", "wall"}}), 20)),
              kR_mm - std::sqrt(10 * 10 - kD_mm * kD_mm / 4) + 0.2 + point, 1e-12);
  EXPECT_NEAR(depth(pin({{"through", "part"}}, "DRILL-HM-8D")), 2 * kR_mm + 0.2 + point,
              1e-12);
}

TEST(CrossHole, IsRefusedWhereNoDrillMakesIt) {
  EXPECT_EQ(
      refusal(part(pin({{"through", "part"}}))),
      "drill h1: none of the drills is for C45 heat-treatable steel, normalised, "
      "190 HB, 6 mm in diameter, reaches 40 mm with its holder clear of what stands "
      "beside the hole");
  EXPECT_NE(refusal(part(pin({{"depth_mm", 5}, {"diameter_mm", 6.1}}))).find("6.1 mm"),
            std::string::npos);
  // A shoulder in the jaws, as high as the stock, 17 mm above the cylinder and within 25 mm
  // of the hole: the holder would meet it.
  auto stepped = pin({{"depth_mm", 18}});
  EXPECT_EQ(only(work_of(part(stepped))).plan.tool, "DRILL-HM-5D");
  stepped["stock"]["diameter_mm"] = 74;
  stepped["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 65}, {"diameter_mm", 2 * kR_mm}},
      {{"id", "d2"},
       {"kind", "cylinder"},
       {"length_mm", 15},
       {"diameter_mm", 2 * kR_mm + 30}}};
  stepped["setups"] = {{{"hold", "right"}, {"grip_mm", 10}, {"clampings", {"chuck"}}}};
  stepped["stock"]["left_allowance_mm"] = 2;
  EXPECT_NE(refusal(part(stepped)).find("reaches 35 mm"), std::string::npos)
      << refusal(part(stepped));
  // The point of a hole 9.5 mm deep over a bore that is 10 mm below.
  EXPECT_NE(refusal(part(hollow(pin({{"depth_mm", 9.5}}), 20)))
                .find("has a point that ends before 10 mm"),
            std::string::npos);
}

TEST(CrossHole, StopsThePlanWhereTheDrivenSpindleIsTooWeak) {
  auto p = part(pin({{"depth_mm", 10}}));
  for (auto& point : p.machine.driven_tools->curve) {
    point.M_Nm /= 100;
    point.P_kW /= 100;
  }
  const auto conflicts = auxiliary_conflicts(p, 0, Clamping::chuck, assign(p).setups[0]);
  ASSERT_FALSE(conflicts.empty());
  EXPECT_TRUE(std::ranges::any_of(conflicts, [](const Conflict& c) {
    return c.limit == "torque" && c.where == "setup 1, s1-drill-h1" &&
           c.value > c.allowed;
  }));
}

TEST(CrossHole, SeveralAreAlike) {
  const auto work = work_of(part(pin({{"depth_mm", 10}, {"count", 3}})));
  ASSERT_EQ(work.after.size(), 3U);
  EXPECT_EQ(work.after[2].plan.id, "s1-drill-h1-3");
  EXPECT_EQ(work.after[2].plan.time_min, work.after[0].plan.time_min);
}

// The plan's own conditions given: the same time and cost, of the whole part too.
TEST(CrossHole, PredictFindsWhatThePlanSays) {
  const PlanRequest p = part(pin({{"depth_mm", 10}}));
  const auto made = plan(p);
  ASSERT_EQ(made.status, PlanStatus::ok);
  auto given = p;
  given.operations.emplace();
  for (const auto& o : made.setups[0].operations) {
    const auto& pass = o.passes.front();
    if (o.kind == OperationKind::cross_drill) {
      given.milled[0].drills = {o.tool};
      given.milled[0].drilling = {{}, {}, pass.f_mm_rev, pass.vc_m_min};
      continue;
    }
    given.operations->push_back(
        {o.id,
         0,
         o.kind,
         o.on,
         o.tool,
         o.direction,
         {static_cast<int>(o.passes.size()), pass.ap_mm, pass.f_mm_rev, pass.vc_m_min}});
  }
  const auto predicted = predict(given);
  ASSERT_EQ(predicted.status, PlanStatus::ok)
      << (predicted.conflicts.empty() ? "" : predicted.conflicts[0].sentence);
  EXPECT_NEAR(predicted.cost_per_part, made.cost_per_part, 1e-9);
  EXPECT_NEAR(predicted.time_per_part_min, made.time_per_part_min, 1e-9);
  EXPECT_LE(made.certificate.gap, 1e-4);
}

// A drill in a driven holder is another tool than the same drill on the axis.
TEST(CrossHole, HasAToolOfItsOwn) {
  auto document = pin({{"depth_mm", 10}});
  document["inner"] = {{{"id", "b1"},
                        {"kind", "hole"},
                        {"from", "right"},
                        {"length_mm", 8},
                        {"diameter_mm", kD_mm}}};
  const auto made = plan(part(document));
  ASSERT_EQ(made.status, PlanStatus::ok)
      << (made.conflicts.empty() ? "" : made.conflicts[0].sentence);
  std::vector<std::string> tools;
  for (const auto& e : made.setups[0].edges) tools.push_back(e.tool);
  for (const auto* tool : {"DRILL-HM-5D 6 mm", "DRILL-HM-5D 6 mm, driven"})
    EXPECT_EQ(std::ranges::count(tools, tool), 1) << tool;
}

}  // namespace
}  // namespace turnwright::planning::cross_holes_test
