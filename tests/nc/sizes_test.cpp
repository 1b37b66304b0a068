// Sizes are turned to the middles of their limits by passes that are as deep as planned.
#include <gtest/gtest.h>

#include <algorithm>

#include "cut_simulation.hpp"

namespace turnwright::nc {
namespace {

using namespace test;
using nlohmann::json;

json cylinder(const std::string& id, double diameter_mm, double length_mm,
              double lower_mm, double upper_mm) {
  return {{"id", id},
          {"kind", "cylinder"},
          {"diameter_mm", diameter_mm},
          {"length_mm", length_mm},
          {"limits_mm", {lower_mm, upper_mm}}};
}

json bush(const json& outer, const json& inner) {
  auto d = json::parse(R"({
    "format": "turnwright-part/1", "name": "Bush", "material": "C45",
    "stock": {"kind": "tube", "outer_mm": 70, "inner_mm": 20, "length_mm": 64},
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "setups": [{"hold": "left", "grip_mm": 15, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 15, "clampings": ["chuck"]}]})");
  d["outer"] = outer;
  d["inner"] = inner;
  for (auto& e : d["inner"]) e["from"] = "right";
  return d;
}

// Drawn at the middle of their limits or aside, sizes ask for the same cuts; bodies that
// are drawn thinner by some tenths yield a little more.
TEST(NcSizes, DrawnAtAnEndOfTheirLimitsHaveTheSameDepths) {
  const auto& drawn = planned(bush(json::array({cylinder("d1", 65.9, 30, -0.1, 0.1),
                                                cylinder("d2", 55.8, 30, -0.1, 0.1)}),
                                   json::array({cylinder("b", 30.2, 60, -0.1, 0.1)})));
  const auto& aside = planned(bush(
      json::array({cylinder("d1", 66, 30, -0.2, 0), cylinder("d2", 56, 30, -0.3, -0.1)}),
      json::array({cylinder("b", 30, 60, 0.1, 0.3)})));
  ASSERT_EQ(drawn.plan.status, planning::PlanStatus::ok);
  ASSERT_EQ(aside.plan.status, planning::PlanStatus::ok);
  int turned = 0;
  for (std::size_t s = 0; s < drawn.plan.setups.size(); ++s) {
    const auto &a = drawn.plan.setups[s].operations, &b = aside.plan.setups[s].operations;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].id, b[i].id);
      ASSERT_EQ(a[i].passes.size(), b[i].passes.size()) << a[i].id;
      for (std::size_t k = 0; k < a[i].passes.size(); ++k)
        EXPECT_NEAR(a[i].passes[k].ap_mm, b[i].passes[k].ap_mm, 2e-3) << a[i].id;
      turned += a[i].kind != planning::OperationKind::fixed;
    }
  }
  EXPECT_GE(turned, 5);
  EXPECT_NEAR(aside.plan.cost_per_part / drawn.plan.cost_per_part, 1, 1e-3);
}

// Comparisons of what roughing leaves above the middle of each size with what its finishing
// is planned to take.
int expect_roughed_as_planned(const Planned& p) {
  std::map<std::string, double> finishing;
  for (const auto& s : p.plan.setups)
    for (const auto& o : s.operations)
      if (o.kind == planning::OperationKind::finish ||
          o.kind == planning::OperationKind::bore_finish)
        for (const auto& pass : o.passes) finishing[o.on[0]] += pass.ap_mm;
  int compared = 0;
  for (const auto& program : programs(p.part, p.plan).setups)
    for (const auto& step : program.steps)
      for (const auto& t : p.part.drawing.tolerances) {
        if (t.kind != part::ToleranceKind::diameter || step.comments.empty() ||
            step.comments[0].find("rough-" + t.of + ": ") == std::string::npos)
          continue;
        const auto e = part::extent(p.part.drawing, t.of);
        const double radius =
            e->left_mm / 2 + (t.limits->lower_mm + t.limits->upper_mm) / 4;
        double nearest = INFINITY;
        for (const auto& m : step.moves)
          if (m.kind == Move::Kind::feed)
            nearest = std::min(nearest, (e->inner ? -1 : 1) * (m.x_mm - radius));
        EXPECT_NEAR(nearest, finishing.at(t.of), 1e-6) << step.comments[0];
        ++compared;
      }
  return compared;
}

TEST(NcSizes, AreRoughedToThePlannedDepthAboveTheirMiddle) {
  const auto& p = planned(bush(
      json::array({cylinder("d1", 66, 30, -0.2, 0), cylinder("d2", 56, 30, -0.6, -0.4)}),
      json::array({cylinder("b", 30, 60, 0.4, 0.6)})));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  EXPECT_EQ(expect_roughed_as_planned(p), 3);
}

// Those of a size with other limits, with a collar between them, do not concern each other.
TEST(NcSizes, BehindACollarAreRoughedAsPlanned) {
  const auto& p = planned(bush(
      json::array({cylinder("d1", 58, 20, -0.85, -0.8), cylinder("d2", 66, 20, -0.1, 0.1),
                   cylinder("d3", 58, 20, 0.8, 0.85)}),
      json::array({cylinder("b", 30, 60, -0.1, 0.1)})));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  EXPECT_GE(expect_roughed_as_planned(p), 3);
}

std::string found(const Planned& p, const std::vector<Fault>& faults) {
  auto findings = simulated(p, programs(p.part, p.plan));
  std::erase_if(findings, [&](const Finding& f) {
    return std::ranges::find(faults, f.fault) == faults.end();
  });
  return listed(findings);
}

// Drawn as one cylinder, or one bore, with limits further apart than finishing is deep:
// roughing of what has less material keeps off the other, on either side of it.
TEST(NcSizes, RoughingKeepsOffALevelNeighbourWithOtherLimits) {
  for (const double apart : {0.5, 1.6, -0.5, -1.6}) {
    SCOPED_TRACE(apart);
    const double first = std::min(apart, 0.0), second = std::min(-apart, 0.0);
    const auto& p =
        planned(bush(json::array({cylinder("d1", 66, 30, first - 0.1, first),
                                  cylinder("d2", 66, 30, second - 0.1, second)}),
                     json::array({cylinder("a", 40, 30, -first, 0.1 - first),
                                  cylinder("b", 40, 30, -second, 0.1 - second)})));
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    EXPECT_EQ(found(p, {Fault::gouge, Fault::rapid}), "");
  }
}

// In one setup finishing goes up the step between them, which may be higher than the
// corner is large.
TEST(NcSizes, AStepBetweenLevelNeighboursIsMade) {
  for (const double step : {0.3, 0.5, 1.0}) {
    SCOPED_TRACE(step);
    const auto& p = planned(
        bush(json::array({cylinder("d1", 66, 20, -0.1, 0.1),
                          cylinder("d2", 60, 20, -0.05, 0.05),
                          cylinder("d3", 60, 20, -2 * step - 0.05, -2 * step + 0.05)}),
             json::array({cylinder("b", 30, 60, -0.1, 0.1)})));
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
    EXPECT_EQ(found(p, {Fault::gouge, Fault::left, Fault::rapid}), "");
  }
}

// The tool that faces the wall between them clears the narrower bore as it is made.
TEST(NcSizes, ABoreFarBelowItsDrawnSizeIsClearedByRapids) {
  auto d = bush(
      json::array({cylinder("d1", 66, 30, -0.1, 0.1), cylinder("d2", 60, 30, -0.1, 0.1)}),
      json::array({cylinder("a", 44, 20, 0, 0.2), cylinder("b", 34, 40, -0.9, -0.7)}));
  d["tolerances"] = {{{"id", "depth"},
                      {"kind", "length"},
                      {"between", {"right", "a|b"}},
                      {"limits_mm", {-0.05, 0.05}}}};
  const auto& p = planned(d);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  EXPECT_EQ(found(p, {Fault::gouge, Fault::left, Fault::rapid}), "");
}

// Steep cones before sizes that are cut a little lower than the cone ends, in the drawing
// higher or level: the corner leaves the cone where the cone ends.
TEST(NcSizes, BehindASteepConeMayBeLowerThanItsEnd) {
  for (const double drawn_mm : {27.8, 28.}) {
    const auto cone = [](const char* id, double left_mm, double right_mm) {
      return json{{"id", id},
                  {"kind", "cone"},
                  {"length_mm", 1},
                  {"left_mm", left_mm},
                  {"right_mm", right_mm}};
    };
    const double up = 28.03 - drawn_mm, down = 59.94 - (88 - drawn_mm);
    auto document =
        bush(json::array({cylinder("d", 88 - drawn_mm, 59, down - 0.02, down + 0.02),
                          cone("c", 60, 58)}),
             json::array(
                 {cone("m", 28, 30), cylinder("b", drawn_mm, 59, up - 0.02, up + 0.02)}));
    document["stock"].update({{"length_mm", 92}, {"left_allowance_mm", 30}});
    document["setups"] = {{{"hold", "left"}, {"grip_mm", 28}, {"clampings", {"chuck"}}}};
    const auto& p = planned(document);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok) << drawn_mm;
    EXPECT_EQ(found(p, {Fault::gouge, Fault::left, Fault::lean}), "") << drawn_mm;
  }
}

// A cone behind a cylinder that is drawn a little higher than the cylinder and cut lower, or
// the reverse.
TEST(NcSizes, AConeMayBeginLowerThanTheCylinderInFrontIsCut) {
  for (const double drawn_mm : {39.9, 40.}) {
    auto document =
        bush(json::array({{{"id", "c"},
                           {"kind", "cone"},
                           {"length_mm", 6},
                           {"left_mm", 44},
                           {"right_mm", 40}},
                          cylinder("d", drawn_mm, 20, 40.4 - drawn_mm, 40.5 - drawn_mm)}),
             json::array({cylinder("b", 30, 20, -0.25, -0.2),
                          {{"id", "m"},
                           {"kind", "cone"},
                           {"length_mm", 6},
                           {"left_mm", 28},
                           {"right_mm", 29.9}}}));
    document["stock"].update(
        {{"outer_mm", 48}, {"length_mm", 58}, {"left_allowance_mm", 30}});
    document["setups"] = {{{"hold", "left"}, {"grip_mm", 28}, {"clampings", {"chuck"}}}};
    const auto& p = planned(document);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok) << drawn_mm;
    EXPECT_EQ(found(p, {Fault::gouge, Fault::left, Fault::lean}), "") << drawn_mm;
  }
}

// The least X of the feeds, or the largest in a bore, of the step that makes an element.
double deepest_x_mm(const Planned& p, const std::string& step_of, bool inside) {
  double deepest = inside ? 0 : INFINITY;
  for (const auto& setup : programs(p.part, p.plan).setups)
    for (const auto& step : setup.steps) {
      if (step.comments.empty() ||
          step.comments[0].find("-" + step_of + ": ") == std::string::npos)
        continue;
      for (const auto& m : step.moves)
        if (m.kind != Move::Kind::rapid)
          deepest = inside ? std::max(deepest, m.x_mm) : std::min(deepest, m.x_mm);
    }
  return 2 * deepest;
}

// DIN 471's groove for a shaft of 40 mm, 37.5 h11; a DIN 472 groove of 31.4 H12 for 30 mm;
// M36x2-6g and M30x1.5-6H of ISO 965-2.
TEST(NcSizes, GroovesAndThreadsAreCutToTheMiddleOfTheirLimits) {
  const auto element = [](const char* id, const char* kind, double length_mm, json more) {
    more.update({{"id", id}, {"kind", kind}, {"length_mm", length_mm}});
    return more;
  };
  const auto& p = planned(bush(
      json::array(
          {element("th", "thread", 20, {{"designation", "M36x2"}}),
           element("relief", "groove", 5, {{"diameter_mm", 33}}),
           cylinder("seat", 40, 25, -0.016, 0),
           element("ring", "groove", 1.85, {{"diameter_mm", 37.5}, {"fit", "h11"}}),
           cylinder("end", 40, 8.15, -0.016, 0)}),
      json::array(
          {cylinder("bore", 30, 10, 0, 0.021),
           element("inner-ring", "groove", 3, {{"diameter_mm", 31.4}, {"fit", "H12"}}),
           cylinder("floor", 26, 47, 0, 0.1)})));
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  EXPECT_NEAR(deepest_x_mm(p, "groove-ring", false), 37.5 - 0.08, 1e-6);
  EXPECT_NEAR(deepest_x_mm(p, "groove-relief", false), 33, 1e-6);
  EXPECT_NEAR(deepest_x_mm(p, "groove-inner-ring", true), 31.4 + 0.125, 1e-6);
  // Pitch diameter 34.663 to 34.493, 34.701 of the basic profile.
  EXPECT_NEAR(deepest_x_mm(p, "thread-th", false), 36 - 1.22687 * 2 - (34.701 - 34.578),
              0.005);
  EXPECT_NEAR(deepest_x_mm(p, "finish-th", false), (35.962 + 35.682) / 2, 0.004);
}

// The blank of a groove beside a thread is cut as low as the thread's crests; its finishing
// takes what the plan says, and a chamfer at its rim ends above its floor.
TEST(NcSizes, AGroovesBlankIsAsLowAsTheThreadBesideIt) {
  auto document = bush(
      json::array(
          {{{"id", "t"}, {"kind", "thread"}, {"length_mm", 20}, {"designation", "M36"}},
           {{"id", "g"}, {"kind", "groove"}, {"length_mm", 6}, {"diameter_mm", 34}},
           cylinder("d", 52, 34, -0.1, 0.1)}),
      json::array({cylinder("b", 24, 60, -0.1, 0.1)}));
  document["edges"] = {{{"at", "g|t"}, {"chamfer_mm", 0.75}}};
  const auto& p = planned(document);
  ASSERT_EQ(p.plan.status, planning::PlanStatus::ok);
  // M36-6g of ISO 965-2, whose widths are rounded by up to 6 %.
  EXPECT_NEAR(deepest_x_mm(p, "finish-g", false), (35.940 + 35.465) / 2, 0.015);
  EXPECT_NEAR(deepest_x_mm(p, "groove-g", false), 34, 1e-6);
  int compared = 0;
  for (const auto& s : p.plan.setups)
    for (const auto& o : s.operations)
      if (o.on[0] == "g" && o.kind == planning::OperationKind::finish) {
        const double roughed = deepest_x_mm(p, "rough-g", false);
        EXPECT_NEAR((roughed - deepest_x_mm(p, "finish-g", false)) / 2, o.passes[0].ap_mm,
                    1e-3);
        ++compared;
      }
  EXPECT_EQ(compared, 1);
  document["edges"][0]["chamfer_mm"] = 0.9;
  EXPECT_ANY_THROW(planned(document));
}

}  // namespace
}  // namespace turnwright::nc
