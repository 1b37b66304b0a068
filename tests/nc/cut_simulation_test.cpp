// Programs cut in the half section with whole tools: what remains is the drawing.
#include "cut_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_parts.hpp"

namespace turnwright::nc {
namespace {

using namespace test;

// Programs do not draw walls out: these lean as the major edge does, stock stays before
// them, and blades that come down beside one meet it.  Elements are finished one by one,
// from inside their neighbours, and nothing knows the tailstock's centre.
constexpr auto kOfWalls = {Fault::left, Fault::lean, Fault::start, Fault::again,
                           Fault::centre};
constexpr auto kBesideWalls = {Fault::rapid, Fault::holder};

std::string found_beside(const Planned& p, const Programs& all,
                         std::initializer_list<Fault> known,
                         std::initializer_list<Fault> also = {}) {
  auto findings = simulated(p, all);
  std::erase_if(findings, [&](const Finding& f) {
    return std::ranges::count(known, f.fault) || std::ranges::count(also, f.fault);
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

TEST(CutSimulation, OfReferencePartsFindsNothingCutThatIsDrawnAndNoCollision) {
  for_reference_parts([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), kOfWalls), "");
  });
}

TEST(CutSimulation, DISABLED_OfReferencePartsLeavesTheDrawing) {
  for_reference_parts([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), {}), "");
  });
}

void for_awkward_parts(const std::function<void(const Planned&)>& check) {
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json"))) {
    SCOPED_TRACE(one["part"]["name"].get<std::string>());
    const auto p = planned(one["part"]);
    if (p.plan.status == planning::PlanStatus::ok) check(p);
  }
}

TEST(CutSimulation, OfAwkwardPartsFindsNothingCutThatIsDrawn) {
  for_awkward_parts([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), kOfWalls, kBesideWalls), "");
  });
}

TEST(CutSimulation, DISABLED_OfAwkwardPartsLeavesTheDrawing) {
  for_awkward_parts([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), {}), "");
  });
}

/// Thirty parts each, so that they run side by side.
class CutSimulationOfRandomParts : public testing::TestWithParam<std::uint32_t> {
 protected:
  void for_each(const std::function<void(const Planned&)>& check) {
    int made = 0;
    for (auto seed = 30 * GetParam() + 1; seed <= 30 * GetParam() + 30; ++seed) {
      const auto document = RandomPart(seed).document();
      SCOPED_TRACE(document);
      const auto p = planned(document);
      if (p.plan.status != planning::PlanStatus::ok) continue;
      check(p);
      ++made;
    }
    EXPECT_GT(made, 12);
  }
};

TEST_P(CutSimulationOfRandomParts, FindsNothingCutThatIsDrawn) {
  for_each([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), kOfWalls, kBesideWalls), "");
  });
}

TEST_P(CutSimulationOfRandomParts, DISABLED_LeavesTheDrawing) {
  for_each([](const Planned& p) {
    EXPECT_EQ(found_beside(p, programs(p.part, p.plan), {}), "");
  });
}

INSTANTIATE_TEST_SUITE_P(Thirty, CutSimulationOfRandomParts,
                         testing::Range(std::uint32_t{0}, std::uint32_t{10}));

}  // namespace
}  // namespace turnwright::nc
