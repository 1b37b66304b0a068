// Every tool of the catalogue to choose from, millions of combinations.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

ProcessPlan plan_with(const nlohmann::json& tools) {
  auto d = reference_part("drilled-bush");
  d["tools"] = tools;
  return plan(part(d));
}

double corner_mm(const std::string& id) {
  return std::ranges::find(shop().tools, id, &catalogue::Tool::id)->re_mm;
}

std::set<std::string> rejected(const ProcessPlan& plan) {
  std::set<std::string> ids;
  for (const auto& s : plan.setups)
    for (const auto& r : s.rejected_tools) ids.insert(r.tool);
  return ids;
}

/// The tools of the plan; and one with the largest corner, for which ways are left whether it
/// is used or not.
std::set<std::string> chosen(const ProcessPlan& plan) {
  const auto others = rejected(plan);
  std::set<std::string> ids{*std::ranges::max_element(others, {}, corner_mm)};
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations) ids.insert(o.tool);
  return ids;
}

TEST(AllTools, AreAtLeastAsGoodAsTheChosenWithAnyOther) {
  const auto best = plan_with("all");
  ASSERT_EQ(best.status, PlanStatus::ok);
  EXPECT_EQ(best.certificate.kind, CertificateKind::global);
  const auto own = chosen(best);
  EXPECT_NEAR(plan_with(own).cost_per_part, best.cost_per_part,
              2e-4 * best.cost_per_part);
  int tried = 0;
  for (const auto& id : rejected(best)) {
    if (++tried % 9 != 0) continue;
    auto more = own;
    more.insert(id);
    const auto other = plan_with(more);
    ASSERT_EQ(other.status, PlanStatus::ok);
    EXPECT_GE(other.cost_per_part, best.certificate.lower_bound) << id;
  }
  EXPECT_GE(tried, 50);
}

}  // namespace
}  // namespace turnwright::planning
