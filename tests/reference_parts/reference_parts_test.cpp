#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "global_search.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/file.hpp"
#include "turnwright/document/process_plan.hpp"

// The plans of parts/ against an independent search, against costs.json (that search with
// full effort) and against themselves.
namespace turnwright::reference {
namespace {

using planning::CertificateKind;
using planning::PlanStatus;
using planning::ProcessPlan;
using planning::Verdict;

constexpr double kGap = 1e-4;        // what a certificate may leave open
constexpr double kBeyond = 1e-9;     // of a limit: what an optimum may be over it
constexpr double kRounding = 1e-12;  // of sums of some ten costs

document::LoadedPart loaded(const std::string& name) {
  const std::string root = TURNWRIGHT_SOURCE_DIR;
  return document::load_part_plan(document::parse_file(root + "/parts/" + name + ".json"),
                                  document::load_catalogue(root), name);
}

nlohmann::json stored(const std::string& name) {
  std::ifstream in(TURNWRIGHT_SOURCE_DIR "/tests/reference_parts/costs.json");
  return nlohmann::json::parse(in).at(name);
}

void expect_global(const planning::Certificate& c, const std::string& of) {
  EXPECT_EQ(c.kind, CertificateKind::global) << of << ": " << c.reason;
  EXPECT_GE(c.gap, 0) << of;
  EXPECT_LE(c.gap, kGap) << of;
}

class ReferencePart : public testing::TestWithParam<const char*> {
 protected:
  const std::string name = GetParam();
  const document::LoadedPart part = loaded(name);
  const ProcessPlan plan = planning::plan(part.plan);
};

TEST_P(ReferencePart, HasAPlanThatMeetsEveryTolerance) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_TRUE(plan.conflicts.empty());
  ASSERT_EQ(plan.tolerances.size(), part.plan.drawing.tolerances.size());
  for (const auto& t : plan.tolerances) {
    EXPECT_EQ(t.verdict, Verdict::met) << t.id << ' ' << t.of;
    EXPECT_GE(t.margin_mm, -kBeyond * t.allowed_mm.back()) << t.id << ' ' << t.of;
  }
}

TEST_P(ReferencePart, KeepsEveryLimitItLists) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) {
      EXPECT_FALSE(o.constraints.empty()) << o.id;
      for (const auto& c : o.constraints) {
        const double margin = (c.at_most ? -1 : 1) * std::log(c.value / c.limit);
        EXPECT_GE(margin, -kBeyond) << o.id << ' ' << c.name;
        EXPECT_NEAR(c.margin, margin, kBeyond) << o.id << ' ' << c.name;
      }
    }
}

TEST_P(ReferencePart, KeepsEveryLimitAndCostsWhatItSaysWhenComputedAnew) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const auto anew = as_planned(part.plan, plan);
  for (const auto& setup : anew.setups)
    for (const auto& x : setup.surfaces) EXPECT_LE(x.excess, kBeyond) << x.surface;
  EXPECT_NEAR(plan.cost_per_part, anew.objective, kRounding * anew.objective);
}

TEST_P(ReferencePart, IsCertifiedAsAWholeAndInEveryOperation) {
  ASSERT_EQ(plan.status, PlanStatus::ok);
  expect_global(plan.certificate, "plan");
  EXPECT_NEAR(plan.certificate.lower_bound,
              plan.cost_per_part * (1 - plan.certificate.gap),
              kRounding * plan.cost_per_part);
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) expect_global(o.certificate, o.id);
}

TEST_P(ReferencePart, CostsWhatTheSearchWithFullEffortFound) {
  const double cost = stored(name).at("cost_per_part");
  EXPECT_NEAR(plan.cost_per_part, cost, kGap * cost);
  EXPECT_GE(cost, plan.certificate.lower_bound);
}

TEST_P(ReferencePart, IsNotBeatenByAShortSearch) {
  const auto found = search(part.plan, kShort);
  EXPECT_GE(found.objective, plan.certificate.lower_bound);
  EXPECT_GE(found.objective, plan.cost_per_part * (1 - kGap));
  EXPECT_NEAR(found.objective, plan.cost_per_part, kGap * plan.cost_per_part);
}

TEST_P(ReferencePart, HasTheSameBytesWhenPlannedAgain) {
  EXPECT_EQ(document::to_json(plan, part.assumed).dump(),
            document::to_json(planning::plan(part.plan), part.assumed).dump());
}

INSTANTIATE_TEST_SUITE_P(Parts, ReferencePart,
                         testing::Values("gearbox-input-shaft", "piston-rod",
                                         "spindle-nose"),
                         [](const auto& at) {
                           std::string name = at.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(X, Y) {
  const auto part = loaded("infeasible-as-drawn");
  const auto plan = planning::plan(part.plan);
  for (auto& c : plan.conflicts)
    std::cerr << c.limit << '|' << c.where << '|' << c.value << '|' << c.allowed << '|'
              << c.sentence << '\n';
  for (auto& c : plan.relax)
    std::cerr << c.limit << '|' << c.now << '|' << c.needed << '|' << c.sentence << '\n';
  for (auto& t : part.plan.drawing.tolerances)
    std::cerr << t.id << ' ' << t.of << ' ' << t.value_mm << '\n';
  for (auto& s : plan.setups)
    for (auto& r : s.rejected) std::cerr << r.why << '\n';
}

}  // namespace
}  // namespace turnwright::reference
