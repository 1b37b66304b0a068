#include "report/picture/path_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "../../nc/plans.hpp"
#include "planning/clamping/positions.hpp"
#include "report/picture/contour.hpp"
#include "report/picture/program_removal.hpp"
#include "svg_check.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::report::path_drawing_test {
namespace {

using nc::test::Planned;

double radius(const Runs& runs, double z) {
  for (const auto& run : runs)
    if (z >= run.z0 && z <= run.z1) return radius_mm(run, z);
  return 0;
}

double nominal(const Contour& contour, double z, bool inner) {
  return radius(inner ? contour.inner : contour.outer, z);
}

// Share of the rings, behind the finished face and before the jaws, whose radii are those
// of the part as drawn, up to offsets in the middle of the limits and the fillets of
// corners: 0.12 mm.
double share_as_drawn(const Planned& p, const toolpath::SetupProgram& program) {
  const auto s = program.setup;
  const auto work = removal(p.part, p.plan.setups[s], program).left;
  const auto drawn = contour_after(p.part, s);
  const double sign = p.part.setups[s].hold == part::End::left ? 1 : -1;
  const double free_z = planning::free_z_mm(p.part, s);
  const double root =
      sign * (planning::root_z_mm(p.part, s, p.plan.setups[s].clamping) - free_z);
  std::size_t as_drawn = 0, count = 0;
  for (std::size_t i = 0; i < work.rings.size(); ++i) {
    const double Z = work.z(i), z = free_z + sign * Z;
    if (Z < root || Z > 0 || z < drawn.outer.front().z0 || z > drawn.outer.back().z1)
      continue;
    ++count;
    const auto& ring = work.rings[i];
    as_drawn += std::abs(ring.outer_mm - nominal(drawn, z, false)) < 0.12 &&
                std::abs(ring.inner_mm - nominal(drawn, z, true)) < 0.12;
  }
  EXPECT_GT(count, 100u);
  return static_cast<double>(as_drawn) / static_cast<double>(count);
}

// What the moves leave, against the drawing: two ways to the same part.  The rest are
// walls, fillets, and holes deeper than their bores.
TEST(PathDrawings, WhatThePassesLeaveIsThePartAsDrawn) {
  for (const char* name : {"coupling-shaft", "drilled-bush", "flanged-bush"}) {
    const auto p = nc::test::planned_reference(name);
    const auto programs = nc::programs(p.part, p.plan);
    ASSERT_EQ(programs.setups.size(), 2u) << name;
    for (const auto& program : programs.setups)
      EXPECT_GT(share_as_drawn(p, program), 0.93) << name << ' ' << program.setup;
  }
}

TEST(PathDrawings, APassNeverAddsMaterialAndFollowsThePassBefore) {
  const auto p = nc::test::planned_reference("coupling-shaft");
  for (const auto& program : nc::programs(p.part, p.plan).setups) {
    const auto [all, left] = removal(p.part, p.plan.setups[program.setup], program);
    ASSERT_GT(all.size(), 2u);
    auto rings = work_before(p.part, program.setup).rings;
    for (const auto& pass : all)
      for (std::size_t i = 0; i < pass.before.size(); ++i) {
        EXPECT_LE(pass.after[i].outer_mm, pass.before[i].outer_mm);
        EXPECT_GE(pass.after[i].inner_mm, pass.before[i].inner_mm);
        auto& ring = rings[pass.from + i];
        EXPECT_EQ(pass.before[i], ring);
        ring = pass.after[i];
      }
    EXPECT_EQ(rings, left.rings);
  }
}

// A pass over one diameter of many keeps no picture of the whole part, or thousands of them
// would fill the memory.
TEST(PathDrawings, APassKeepsTheRingsThatItChanges) {
  const auto p = nc::test::planned_reference("coupling-shaft");
  for (const auto& program : nc::programs(p.part, p.plan).setups)
    for (const auto& pass :
         removal(p.part, p.plan.setups[program.setup], program).passes) {
      ASSERT_EQ(pass.before.size(), pass.after.size());
      if (pass.before.empty()) continue;
      EXPECT_NE(pass.before.front(), pass.after.front());
      EXPECT_NE(pass.before.back(), pass.after.back());
    }
}

TEST(PathDrawings, AreGivenUpIfNobodyWaits) {
  const auto p = nc::test::planned_reference("coupling-shaft");
  const auto programs = nc::programs(p.part, p.plan);
  std::stop_source source;
  source.request_stop();
  const auto stop = source.get_token();
  const Listening listening(stop);
  EXPECT_THROW(path_drawings(p.part, p.plan, programs), Cancelled);
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(PathDrawings, FeedsRapidsAndToolsAreTold) {
  const auto p = nc::test::planned_reference("drilled-bush");
  const auto programs = nc::programs(p.part, p.plan);
  const auto all = path_drawings(p.part, p.plan, programs);
  ASSERT_EQ(all.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& program = programs.setups[k];
    EXPECT_TRUE(well_formed(all[k]));
    EXPECT_EQ(crowded(all[k]), "");
    EXPECT_NE(all[k].find("Setup " + std::to_string(k + 1) + ": the cut"),
              std::string::npos);
    std::size_t rapids = 0, passes_ = 0;
    for (const auto& step : program.steps) {
      bool cutting = false;
      for (const auto& move : step.moves) {
        const bool rapid = move.kind == toolpath::Move::Kind::rapid;
        rapids += rapid;
        passes_ += !rapid && !cutting;
        cutting = !rapid;
      }
    }
    EXPECT_EQ(occurrences(all[k], "<line class=\"rapid\""),
              rapids + 1);  // and the legend's
    EXPECT_EQ(occurrences(all[k], "<polyline class=\"feed"), passes_);
    for (const auto& tool : program.tools)
      EXPECT_NE(all[k].find("T" + std::to_string(tool.number) + " " + tool.id),
                std::string::npos);
  }
  EXPECT_EQ(all, path_drawings(p.part, p.plan, programs));
}

// The programmed points of a pass are where the picture's scales put them.
TEST(PathDrawings, TheAxesAreTheProgramsOwn) {
  const auto p = nc::test::planned_reference("gearbox-input-shaft");
  const auto programs = nc::programs(p.part, p.plan);
  const auto svg = path_drawings(p.part, p.plan, programs)[0];
  // Z-100 and Z0 are ticks below the frame, X0 is its axis.
  const auto place = [&](const std::string& text) {
    for (const auto& box : texts(svg))
      if (box.text == text) return (box.x0 + box.x1) / 2;
    return std::nan("");
  };
  const double scale = (place("-20") - place("-100")) / 80;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      svg, found, std::regex("<polyline class=\"feed \\w+\" points=\"(\\S+),\\S+ ")));
  const auto pass = removal(p.part, p.plan.setups[0], programs.setups[0]).passes.front();
  EXPECT_NEAR(std::stod(found[1]), place("-100") + scale * (pass.way.front().z_mm + 100),
              0.05);
}

TEST(PathDrawings, AnotherPlansProgramsAreRefused) {
  const auto p = nc::test::planned_reference("gearbox-input-shaft");
  const auto programs = nc::programs(p.part, p.plan);
  auto plan = p.plan;
  plan.setups[0].operations.pop_back();
  EXPECT_THROW(path_drawings(p.part, plan, programs), std::domain_error);
  plan = p.plan;
  plan.setups[0].operations.push_back(plan.setups[0].operations.front());
  EXPECT_THROW(path_drawings(p.part, plan, programs), std::domain_error);
}

}  // namespace
}  // namespace turnwright::report::path_drawing_test
