// Programs cut in the half section with whole tools: what remains is the drawing.
#include "cut_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_parts.hpp"

namespace turnwright::nc {
namespace {

using namespace test;

constexpr int kSideBySide = 5;

bool beside_a_form(const Planned& p, const std::string& id) {
  const auto& outer = p.part.drawing.outer;
  const auto found = std::ranges::find(outer, id, &part::OuterElement::id);
  if (found == outer.end()) return id == "hole";
  const auto from = found == outer.begin() ? found : std::prev(found);
  const auto to = std::next(found) == outer.end() ? found : std::next(found);
  return std::any_of(from, std::next(to),
                     [](const auto& e) { return e.cut.has_value(); });
}

// Feet of arcs and grooves, cones of drills, and what a program says that it cannot cut.
bool left_by_form(const Planned& p, const Programs& all, const Finding& f) {
  if (f.fault != Fault::left && f.fault != Fault::lean) return false;
  const auto bar = f.where.find('|');
  return !all.cannot.empty() || beside_a_form(p, f.where.substr(0, bar)) ||
         (bar != std::string::npos && beside_a_form(p, f.where.substr(bar + 1)));
}

std::string found_beside(const Planned& p, bool forms = false) {
  const auto all = programs(p.part, p.plan);
  auto findings = simulated(p, all);
  std::erase_if(findings, [&](const Finding& f) {
    return is_told(f, all) || (forms && left_by_form(p, all, f));
  });
  return listed(findings);
}

void for_reference_parts(const std::function<void(const Planned&)>& check) {
  for (const auto& name : reference_parts()) {
    SCOPED_TRACE(name);
    const auto p = planned_reference(name);
    if (p.plan.status == planning::PlanStatus::ok) check(p);
  }
}

TEST(CutSimulation, OfReferencePartsLeavesTheDrawing) {
  for_reference_parts([](const Planned& p) { EXPECT_EQ(found_beside(p), ""); });
}

void for_awkward_parts(const std::function<void(const Planned&)>& check) {
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    SCOPED_TRACE(one["part"]["name"].get<std::string>());
    const auto p = planned(one["part"]);
    if (p.plan.status == planning::PlanStatus::ok) check(p);
  }
}

TEST(CutSimulation, OfAwkwardPartsLeavesTheDrawing) {
  for_awkward_parts([](const Planned& p) { EXPECT_EQ(found_beside(p, true), ""); });
}

/// In five parts that run side by side.
class CutSimulationOfRandomParts : public testing::TestWithParam<int> {};

TEST_P(CutSimulationOfRandomParts, LeavesTheDrawing) {
  const int parts = parts_to_try(60);
  int made = 0;
  for (int seed = 1 + GetParam(); seed <= parts; seed += kSideBySide) {
    const auto document =
        RandomPart(static_cast<std::uint32_t>(seed), SizeLimits::aside).document();
    SCOPED_TRACE(document);
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_EQ(found_beside(p, true), "");
    ++made;
  }
  EXPECT_GT(made, 0.4 * parts / kSideBySide);
}

TEST_P(CutSimulationOfRandomParts, OfAForgingLeavesTheDrawing) {
  const int parts = parts_to_try(40);
  int made = 0;
  for (int seed = 1 + GetParam(); seed <= parts; seed += kSideBySide) {
    const auto n = static_cast<std::uint32_t>(seed);
    const auto document = forged(RandomPart(n).document(), n);
    SCOPED_TRACE(document);
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_EQ(found_beside(p, true), "");
    ++made;
  }
  EXPECT_GT(made, 0.4 * parts / kSideBySide);
}

// No tool meets the live centre either.
TEST_P(CutSimulationOfRandomParts, OnALiveCentreLeavesTheDrawing) {
  const int parts = parts_to_try(50);
  int made = 0, solid = 0;
  for (int seed = 1 + GetParam(); seed <= parts; seed += kSideBySide) {
    auto document = RandomPart(static_cast<std::uint32_t>(seed)).document();
    if (document.contains("inner") || document["stock"]["kind"] == "tube") continue;
    for (auto& s : document["setups"])
      s["clampings"] = {"chuck-tailstock", "between-centres"};
    SCOPED_TRACE(document);
    ++solid;
    const auto p = planned(document);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_EQ(found_beside(p, true), "");
    ++made;
  }
  EXPECT_GT(made, 0.3 * solid);
}

INSTANTIATE_TEST_SUITE_P(Some, CutSimulationOfRandomParts,
                         testing::Range(0, kSideBySide));

}  // namespace
}  // namespace turnwright::nc
