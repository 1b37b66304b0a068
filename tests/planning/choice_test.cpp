#include "turnwright/planning/choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "parts.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

ChosenPlan chosen(const json& document) {
  const auto all = document::prepared_candidates(document, shop(), "part");
  std::vector<Candidate> candidates;
  for (const auto& [name, d] : all.usable)
    candidates.push_back({name, d.part, d.what_if});
  return choose(candidates, [](const PreparedPart&, ProcessPlan&) {});
}

json without(json document, const std::string& key) {
  document.erase(key);
  return document;
}

json with(json document, const std::string& pointer, const json& value) {
  document[json::json_pointer(pointer)] = value;
  return document;
}

json left_then_right() { return {{{"hold", "left"}}, {{"hold", "right"}}}; }
json right_then_left() { return {{{"hold", "right"}}, {{"hold", "left"}}}; }

// The same part planned once for each member of the product by hand.
double cheapest(const json& document, const std::vector<json>& machines,
                const std::vector<json>& setups) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& m : machines)
    for (const auto& s : setups) try {
        const auto alone = plan(part(with(with(document, "/machine", m), "/setups", s)));
        if (alone.status == PlanStatus::ok) least = std::min(least, alone.cost_per_part);
      } catch (const InputError&) {  // not to be held there
      }
  return least;
}

TEST(Choice, IsTheCheapestOfAllCombinationsPlannedAlone) {
  const std::vector<json> machines{"lathe-small", "lathe-medium"};
  const std::vector<json> setups{left_then_right(), right_then_left(),
                                 json::array({{{"hold", "left"}}}),
                                 json::array({{{"hold", "right"}}})};
  for (const char* name : {"coupling-shaft", "titanium-pin", "drilled-bush"}) {
    SCOPED_TRACE(name);
    const json bare = without(without(reference_part(name), "setups"), "machine");
    const auto c =
        chosen(with(bare, "/choose", {{"machine", machines}, {"setups", "auto"}}));
    EXPECT_EQ(c.plan.cost_per_part, cheapest(bare, machines, setups));
    EXPECT_LE(c.plan.certificate.lower_bound, c.plan.cost_per_part);
    EXPECT_EQ(c.plan.certificate.kind, CertificateKind::global);
    for (const auto& a : c.plan.alternatives)
      if (a.feasible) {
        EXPECT_GE(*a.cost_per_part, c.plan.cost_per_part) << a.name;
        EXPECT_GE(*a.lower_bound, c.plan.certificate.lower_bound) << a.name;
      }
  }
}

TEST(Choice, OneEndAloneIsNoPlanOfAPartWithTwo) {
  const auto c = chosen(with(without(pin(), "setups"), "/choose", {{"setups", "auto"}}));
  ASSERT_EQ(c.plan.alternatives.size(), 4u);
  EXPECT_EQ(c.plan.setups.size(), 2u);
  EXPECT_FALSE(c.plan.alternatives[2].feasible);
  EXPECT_FALSE(c.plan.alternatives[2].why.empty());
}

TEST(Choice, TheStocksPriceIsPartOfTheCost) {
  const json bars = {
      {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}, {"price", 9}},
      {{"kind", "bar"}, {"diameter_mm", 45}, {"length_mm", 92}, {"price", 3}}};
  const auto c = chosen(with(without(pin(), "stock"), "/choose", {{"stock", bars}}));
  EXPECT_EQ(c.chosen, 1u);
  const auto thick = plan(part(with(pin(), "/stock", without(bars[1], "price"))));
  EXPECT_NEAR(c.plan.cost_per_part, thick.cost_per_part + 3, 1e-12);
  EXPECT_NEAR(c.plan.certificate.lower_bound, thick.certificate.lower_bound + 3, 1e-9);
  EXPECT_EQ(c.plan.breakdown.stock.cost, 3);
  EXPECT_NEAR(c.plan.breakdown.total().cost, c.plan.cost_per_part, 1e-12);
}

TEST(Choice, TheShortestTimeDoesNotLookAtThePrice) {
  const json bars = {
      {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}, {"price", 90}},
      {{"kind", "bar"}, {"diameter_mm", 60}, {"length_mm", 92}, {"price", 1}}};
  const json p = with(without(pin(), "stock"), "/choose", {{"stock", bars}});
  EXPECT_EQ(chosen(with(p, "/objective", "time")).chosen, 0u);
  EXPECT_EQ(chosen(p).chosen, 1u);
}

TEST(Choice, ABarThatIsTooThinIsRefusedByName) {
  const json bars = {{{"kind", "bar"}, {"diameter_mm", 30}, {"length_mm", 92}},
                     {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}}};
  const auto all = document::prepared_candidates(
      with(without(pin(), "stock"), "/choose", {{"stock", bars}}), shop(), "part");
  ASSERT_EQ(all.usable.size(), 1u);
  EXPECT_EQ(all.usable[0].name, "bar 42 x 92 mm");
  ASSERT_EQ(all.refused.size(), 1u);
  EXPECT_EQ(all.refused[0].name, "bar 30 x 92 mm");
  EXPECT_EQ(all.refused[0].why.rfind("/choose/stock/0/diameter_mm", 0), 0u)
      << all.refused[0].why;
}

TEST(Choice, TheChangeOfEdgesIsTheCheapestOfThoseGiven) {
  json p = reference_part("coupling-shaft");
  if (p.contains("budget")) p["budget"].erase("edge_wear_mm");
  const std::vector<double> lands{0.1, 0.2, 0.3};
  const auto c = chosen(with(p, "/choose", {{"edge_wear_mm", lands}}));
  double least = std::numeric_limits<double>::infinity();
  for (const double land : lands) {
    const auto alone = plan(part(with(p, "/budget/edge_wear_mm", land)));
    if (alone.status == PlanStatus::ok) least = std::min(least, alone.cost_per_part);
  }
  EXPECT_EQ(c.plan.cost_per_part, least);
}

TEST(Choice, WithoutAPlanTheFirstCandidateSaysWhy) {
  json p = without(without(reference_part("infeasible-as-drawn"), "machine"), "setups");
  const auto c = chosen(with(
      p, "/choose",
      {{"setups", {left_then_right()}}, {"machine", {"lathe-small", "lathe-medium"}}}));
  EXPECT_EQ(c.plan.status, PlanStatus::infeasible);
  EXPECT_EQ(c.chosen, 0u);
  EXPECT_FALSE(c.plan.conflicts.empty());
  for (const auto& a : c.plan.alternatives) EXPECT_FALSE(a.chosen);
}

}  // namespace
}  // namespace turnwright::planning
