#include "planning/setup/edge_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

const EdgeSchedule& schedule(const SetupPlan& s, const std::string& tool) {
  const auto e = std::ranges::find(s.edges, tool, &EdgeSchedule::tool);
  if (e == s.edges.end()) throw std::out_of_range(tool);
  return *e;
}

// Schedules of one tool of which a part uses so much.
EdgeSchedule alone(double edges, std::optional<int> batch) {
  auto d = pin();
  if (batch)
    d["batch"] = *batch;
  else
    d["batch"] = nullptr;
  OperationPlan o;
  o.tool = "PDJNL-DNMG150604-PF";
  o.edges = edges;
  return edge_schedules(part(d), {}, {o}, {}).front();
}

TEST(EdgeSchedule, EdgesAreChangedAfterWholeParts) {
  EXPECT_EQ(alone(0.3, 10).parts_per_edge, 3);
  EXPECT_EQ(alone(0.3, 10).edges_per_batch, 4);  // 3 + 3 + 3 + 1
  EXPECT_EQ(alone(0.1, 10).parts_per_edge, 10);  // however 1/0.1 is rounded
  EXPECT_EQ(alone(0.1, 10).edges_per_batch, 1);
  EXPECT_EQ(alone(1e-3, 2001).edges_per_batch, 3);
  EXPECT_EQ(alone(0.3, std::nullopt).edges_per_batch, std::nullopt);
}

TEST(EdgeSchedule, AnEdgeMayNotLastForOnePart) {
  EXPECT_EQ(alone(1.4, 10).parts_per_edge, 0);
  EXPECT_EQ(alone(1.4, 10).edges_per_batch, 14);
}

TEST(EdgeSchedule, PartsUntilAShareIsUsedAreWhole) {
  EXPECT_EQ(parts_until(1, 0.25), 4);
  EXPECT_EQ(parts_until(1, 0.3), 3);
  EXPECT_EQ(parts_until(0.03, 0.01), 3);
  EXPECT_EQ(parts_until(1, 0), std::nullopt);
  EXPECT_EQ(parts_until(0, 0.1), std::nullopt);
}

double change_min(const PreparedPart& p, const std::string& tool) {
  for (const auto& t : p.tools)
    if (t.id == tool) return t.change_min;
  for (const auto& t : p.fixed_tools)
    if (tool.starts_with(t.id)) return t.change_min;
  return std::nan("");
}

// Tools of catalogue conditions included: the bush is drilled, grooved and parted off.
TEST(EdgeSchedule, EdgesAreThoseThatThePlansCostCounts) {
  const auto p = part(reference_part("drilled-bush"));
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& s : r.setups) {
    double all_min = 0;
    for (const auto& e : s.edges) all_min += change_min(p, e.tool) * e.edges_per_part;
    EXPECT_NEAR(all_min, s.breakdown.edges.time_min, 1e-12);
    for (const auto& e : s.edges) {
      double own = 0, most = 0;  // of faces t/T at most: T is that of their highest speed
      for (const auto& o : s.operations)
        if (e.tool.starts_with(o.tool))
          for (const auto& pass : o.passes) {
            most += pass.time_min / pass.T_min;
            if (o.kind != OperationKind::face) own += pass.time_min / pass.T_min;
          }
      EXPECT_LE(own, e.edges_per_part * (1 + 1e-9)) << e.tool;
      EXPECT_GE(most, e.edges_per_part * (1 - 1e-9)) << e.tool;
      double used = 0;  // counted part by part
      long parts = 0;
      for (; used + e.edges_per_part <= 1 + 1e-9 && parts < 100000; ++parts)
        used += e.edges_per_part;
      EXPECT_EQ(e.parts_per_edge, parts) << e.tool;
    }
  }
}

// A pin whose finishing edge is followed, in a batch of several edges.
nlohmann::json followed_pin() {
  auto d = pin();
  d["outer"][1]["limits_mm"] = {-0.012, 0.012};
  d["batch"] = 1000;
  d["damping_ratio"] = 0.1;
  d["budget"]["first_part_gauged"] = true;
  d["budget"]["life_between_offsets"] = 0.1;
  d["budget"]["edge_wear_mm"] = 0.3;
  return d;
}

const FollowedOffset& followed(const ProcessPlan& r, const std::string& on) {
  for (const auto& s : r.setups)
    for (const auto& e : s.edges)
      for (const auto& o : e.offsets)
        if (o.on == on) return o;
  throw std::out_of_range(on);
}

double programmed_mm(const ProcessPlan& r, const std::string& on) {
  for (const auto& o : r.offsets)
    if (o.on == on) return o.offset_mm;
  return 0;
}

// The error of d2's radius at a wear land without any offset, predicted anew.
std::vector<double> bare_mm(nlohmann::json d, double VB_mm) {
  d["budget"]["edge_wear_mm"] = VB_mm;
  const auto at = predict(part_to_predict(d));
  double offset = 0;
  for (const auto& o : at.offsets)
    if (o.on == "d2") offset = *o.at_change_mm;
  std::vector<double> all;
  for (const auto& e : at.deviations)
    if (e.on == "d2")
      for (const auto& [z, mm] : e.at_change_mm) all.push_back(mm - offset);
  return all;
}

// Each part measured on paper: what the worn edge leaves, how far it has receded (a land
// of VB on a flank of 6 deg below a rake of -6 deg), and the offset that is then set.
TEST(EdgeSchedule, FollowedOffsetsKeepEveryPartOfAnEdgeWithinItsLimits) {
  const auto d = followed_pin();
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto given = as_planned(d, r);
  const auto& e = schedule(r.setups[0], "PDJNL-DNMG150604-PF");
  const auto& steps = followed(r, "d2").steps;
  ASSERT_GE(steps.size(), 10u);
  ASSERT_EQ(steps.front().after_part, 0);
  double worst = 0, moved = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const long end = k + 1 < steps.size() ? steps[k + 1].after_part : e.parts_per_edge;
    ASSERT_GT(end, steps[k].after_part);
    for (const long parts : {steps[k].after_part, end}) {
      const double t = static_cast<double>(parts) * e.edges_per_part;
      const double VB = std::max(0.3 * t, 1e-6);
      const double flank = std::tan(6 * M_PI / 180);
      const double receded = VB * flank / (1 + flank * flank);
      for (const double mm : bare_mm(given, VB)) {
        const double diameter =
            2 * (mm + receded + programmed_mm(r, "d2")) + steps[k].um / 1000;
        worst = std::max(worst, std::abs(diameter));
      }
      moved = 2 * receded;
    }
  }
  EXPECT_LE(worst, 0.012);
  EXPECT_GT(moved, 0.05);  // without steps no part of the second half would be kept
}

TEST(EdgeSchedule, StepsAreNoFurtherApartThanThePlanCounts) {
  auto d = followed_pin();
  const auto r = plan(part(d));
  const auto& e = schedule(r.setups[0], "PDJNL-DNMG150604-PF");
  const auto& steps = followed(r, "d2").steps;
  for (std::size_t k = 1; k < steps.size(); ++k)
    EXPECT_LE(static_cast<double>(steps[k].after_part - steps[k - 1].after_part) *
                  e.edges_per_part,
              0.1 * (1 + 1e-9));
  d["batch"] = steps[1].after_part + 1;
  const auto few = plan(part(d));
  EXPECT_LE(followed(few, "d2").steps.size(), 3u);
}

// Followed as closely as controls can: by 1 um on the diameter.
TEST(EdgeSchedule, StepsAreNoFinerThanAnIncrementOfTheControl) {
  auto d = followed_pin();
  d["budget"]["life_between_offsets"] = 0;
  d["budget"].erase("edge_wear_mm");
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& e = schedule(r.setups[0], "PDJNL-DNMG150604-PF");
  const auto& steps = followed(r, "d2").steps;
  ASSERT_GT(steps.size(), 10u);
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const double by = std::abs(steps[k].um - steps[k - 1].um);
    const long parts = steps[k].after_part - steps[k - 1].after_part;
    if (parts > 1) {
      EXPECT_LE(by, 1 + 1e-9);
    }
    EXPECT_GE(by * static_cast<double>(parts + 1) / static_cast<double>(parts), 0.5);
  }
  EXPECT_LE(static_cast<double>(steps.back().after_part), e.parts_per_edge);
}

// A receding edge leaves a shaft too large and a bore too small.
TEST(EdgeSchedule, TheEdgeIsMovedTowardsTheMaterial) {
  auto d = reference_part("drilled-bush");
  d["batch"] = 5000;
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  int outer = 0, inner = 0;
  for (const auto& s : r.setups)
    for (const auto& e : s.edges)
      for (const auto& o : e.offsets) {
        const auto at = part::extent(p.drawing, o.on);
        const bool bore = at && at->inner;
        (bore ? inner : outer) += 1;
        for (const auto& step : o.steps) EXPECT_GT(bore ? step.um : -step.um, 0) << o.on;
      }
  EXPECT_GT(outer, 0);
  EXPECT_GT(inner, 0);
}

TEST(EdgeSchedule, APlanThatFailsHasNone) {
  auto d = followed_pin();
  d["outer"][1]["limits_mm"] = {-0.0001, 0.0001};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  for (const auto& s : r.setups) EXPECT_TRUE(s.edges.empty());
}

}  // namespace
}  // namespace turnwright::planning
