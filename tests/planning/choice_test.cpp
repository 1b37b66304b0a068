#include "turnwright/planning/choice.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "parts.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

ChosenPlan chosen(const json& document) {
  const auto all = document::prepared_candidates(document, shop(), "part");
  std::vector<Candidate> candidates;
  for (const auto& u : all.usable)
    candidates.push_back(
        {u.name, u.document.part, u.document.what_if, u.without, u.unless_within});
  return choose(candidates, [](const PreparedPart&, ProcessPlan&) {});
}

json without(json document, const std::string& key) {
  document.erase(key);
  return document;
}

json having(json document, const std::string& pointer, const json& value) {
  document[json::json_pointer(pointer)] = value;
  return document;
}

json left_then_right() { return {{{"hold", "left"}}, {{"hold", "right"}}}; }
json right_then_left() { return {{{"hold", "right"}}, {{"hold", "left"}}}; }

// How a part may be held and what it is made of, without asking the choice.
struct Way {
  json setups, stock;
};

// A piece of the same bar of which 40 mm or a diameter is held, to part the whole part off.
json longer_bar(const json& document, const char* hold) {
  double length_mm = 0;
  for (const auto& e : document["outer"]) length_mm += e["length_mm"].get<double>();
  json bar = document["stock"];
  const double spare_mm = bar["length_mm"].get<double>() - length_mm;
  const double left_mm = bar.value("left_allowance_mm", spare_mm / 2);
  const double held_mm = std::max(40.0, bar["diameter_mm"].get<double>());
  const bool left = hold == std::string("left");
  bar["left_allowance_mm"] = left ? held_mm : left_mm;
  bar["length_mm"] = length_mm + held_mm + (left ? spare_mm - left_mm : left_mm);
  bar["part_off_allowance_mm"] = 0;
  return bar;
}

std::vector<Way> ways(const json& document) {
  const json &stock = document["stock"], left{{"hold", "left"}}, right{{"hold", "right"}};
  std::vector<Way> all{{left_then_right(), stock},
                       {right_then_left(), stock},
                       {json::array({left}), stock},
                       {json::array({right}), stock}};
  if (stock["kind"] != "bar" || stock.contains("part_off_allowance_mm")) return all;
  const auto free = [&](const std::string& end) {  // nothing is asked of it
    return (document.value("faces", json()).dump() +
            document.value("edges", json()).dump() +
            document.value("tolerances", json()).dump())
               .find('"' + end + '"') == std::string::npos;
  };
  if (free("left")) all.push_back({json::array({left}), longer_bar(document, "left")});
  if (free("right")) all.push_back({json::array({right}), longer_bar(document, "right")});
  return all;
}

// The same part planned once for each machine and way, alone.
double cheapest(const json& document, const std::vector<json>& machines) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& m : machines)
    for (const auto& way : ways(document)) try {
        auto d = having(having(document, "/machine", m), "/setups", way.setups);
        d["stock"] = way.stock;
        const auto alone = chosen(d).plan;
        if (alone.status == PlanStatus::ok) least = std::min(least, alone.cost_per_part);
      } catch (const InputError&) {  // not to be held there
      }
  return least;
}

// All of the machines with `ctest -C slow`.
std::vector<json> machines() {
  if (std::getenv("TURNWRIGHT_SLOW")) return {"lathe-small", "lathe-medium", "turn-mill"};
  return {"lathe-medium"};
}

class OfTen : public testing::TestWithParam<const char*> {};

TEST_P(OfTen, IsTheCheapestOfAllCombinationsPlannedAlone) {
  const json bare = without(without(reference_part(GetParam()), "setups"), "machine");
  const auto c =
      chosen(having(bare, "/choose", {{"machine", machines()}, {"setups", "auto"}}));
  EXPECT_EQ(c.plan.cost_per_part, cheapest(bare, machines()));
  EXPECT_LE(c.plan.certificate.lower_bound, c.plan.cost_per_part);
  EXPECT_EQ(c.plan.certificate.kind, CertificateKind::global);
  for (const auto& a : c.plan.alternatives)
    if (a.feasible) {
      EXPECT_GE(*a.cost_per_part, c.plan.cost_per_part) << a.name;
      EXPECT_GE(*a.lower_bound, c.plan.certificate.lower_bound) << a.name;
    }
}
INSTANTIATE_TEST_SUITE_P(Choice, OfTen,
                         testing::Values("bearing-seat", "coupling-shaft", "drilled-bush",
                                         "flanged-bush", "gearbox-input-shaft",
                                         "iron-hub", "piston-rod", "pump-shaft",
                                         "spindle-nose", "titanium-pin"));

TEST(Choice, OneEndAloneIsNoPlanOfAPartWithTwo) {
  auto d = having(without(pin(), "setups"), "/choose", {{"setups", "auto"}});
  d["outer"][0]["diameter_mm"] = 30;  // no end from which all of it is reached
  d["outer"].push_back(d["outer"][0]);
  d["outer"][2]["id"] = "d3";
  d["stock"]["length_mm"] = 132;
  const auto c = chosen(d);
  ASSERT_EQ(c.plan.alternatives.size(), 6u);
  EXPECT_EQ(c.plan.setups.size(), 2u);
  EXPECT_FALSE(c.plan.alternatives[2].feasible);
  EXPECT_FALSE(c.plan.alternatives[2].why.empty());
}

// A pin that falls towards its free end is done in one setup.
TEST(Choice, APinIsPartedOffABar) {
  const auto c =
      chosen(having(without(pin(), "setups"), "/choose", {{"setups", "auto"}}));
  ASSERT_EQ(c.plan.status, PlanStatus::ok);
  ASSERT_EQ(c.plan.setups.size(), 1u);
  EXPECT_TRUE(c.plan.alternatives[4].chosen);
  EXPECT_EQ(c.plan.alternatives[4].name, "held left, parted off a bar");
  EXPECT_LT(c.plan.cost_per_part, *c.plan.alternatives[0].cost_per_part);
}

TEST(Choice, IsTheSameOnOneThreadAndOnMany) {
  const json d = having(without(pin(), "setups"), "/choose", {{"setups", "auto"}});
  tbb::task_arena one(1);
  const auto alone = one.execute([&] { return chosen(d); });
  const auto together = chosen(d);
  EXPECT_EQ(alone.chosen, together.chosen);
  EXPECT_EQ(alone.plan.cost_per_part, together.plan.cost_per_part);
  EXPECT_EQ(alone.plan.certificate.nodes, together.plan.certificate.nodes);
  ASSERT_EQ(alone.plan.alternatives.size(), together.plan.alternatives.size());
  for (std::size_t i = 0; i < alone.plan.alternatives.size(); ++i)
    EXPECT_EQ(alone.plan.alternatives[i].sentence,
              together.plan.alternatives[i].sentence);
}

TEST(Choice, ACancelledRequestLeavesOnEveryThread) {
  std::stop_source stop;
  stop.request_stop();
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_THROW(chosen(having(without(pin(), "setups"), "/choose", {{"setups", "auto"}})),
               Cancelled);
}

TEST(Choice, TheStocksPriceIsPartOfTheCost) {
  const json bars = {
      {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}, {"price", 9}},
      {{"kind", "bar"}, {"diameter_mm", 45}, {"length_mm", 92}, {"price", 3}}};
  const auto c = chosen(having(without(pin(), "stock"), "/choose", {{"stock", bars}}));
  EXPECT_EQ(c.chosen, 1u);
  const auto thick = plan(part(having(pin(), "/stock", without(bars[1], "price"))));
  EXPECT_NEAR(c.plan.cost_per_part, thick.cost_per_part + 3, 1e-12);
  EXPECT_NEAR(c.plan.certificate.lower_bound, thick.certificate.lower_bound + 3, 1e-9);
  EXPECT_EQ(c.plan.breakdown.stock.cost, 3);
  EXPECT_NEAR(c.plan.breakdown.total().cost, c.plan.cost_per_part, 1e-12);
}

TEST(Choice, TheShortestTimeDoesNotLookAtThePrice) {
  const json bars = {
      {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}, {"price", 90}},
      {{"kind", "bar"}, {"diameter_mm", 60}, {"length_mm", 92}, {"price", 1}}};
  const json p = having(without(pin(), "stock"), "/choose", {{"stock", bars}});
  EXPECT_EQ(chosen(having(p, "/objective", "time")).chosen, 0u);
  EXPECT_EQ(chosen(p).chosen, 1u);
}

TEST(Choice, ABarThatIsTooThinIsRefusedByName) {
  const json bars = {{{"kind", "bar"}, {"diameter_mm", 30}, {"length_mm", 92}},
                     {{"kind", "bar"}, {"diameter_mm", 42}, {"length_mm", 92}}};
  const auto all = document::prepared_candidates(
      having(without(pin(), "stock"), "/choose", {{"stock", bars}}), shop(), "part");
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
  const auto c = chosen(having(p, "/choose", {{"edge_wear_mm", lands}}));
  double least = std::numeric_limits<double>::infinity();
  for (const double land : lands) {
    const auto alone = plan(part(having(p, "/budget/edge_wear_mm", land)));
    if (alone.status == PlanStatus::ok) least = std::min(least, alone.cost_per_part);
  }
  EXPECT_EQ(c.plan.cost_per_part, least);
}

// A collar with an edge in the stock of the second setup.
json collar(double bar_mm, const json& edges) {
  return {
      {"name", "collar"},
      {"material", "C45"},
      {"machine", "lathe-medium"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", bar_mm},
        {"length_mm", 123},
        {"left_allowance_mm", 1.5}}},
      {"outer",
       {{{"id", "seat"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 40}},
        {{"id", "collar"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 54}},
        {{"id", "end"}, {"kind", "cylinder"}, {"length_mm", 50}, {"diameter_mm", 44}}}},
      {"edges", edges},
      {"setups",
       {{{"hold", "left"}, {"grip_mm", 50}, {"clampings", {"chuck"}}},
        {{"hold", "right"}, {"grip_mm", 40}, {"clampings", {"chuck"}}}}}};
}

json chamfered(double mm) { return {{{"at", "collar|end"}, {"chamfer_mm", mm}}}; }

bool faces_collar(const ProcessPlan& plan) {
  return std::ranges::any_of(plan.setups[0].operations,
                             [](const auto& o) { return o.on[0] == "collar|end"; });
}

// A low ring of stock on an edge is cheapest left to the tool that finishes in front; a high
// one is deeper than that tool may cut.
TEST(Choice, EdgesInStockAreFacedWhereThatIsCheaper) {
  const auto low = chosen(collar(55, chamfered(0.3)));
  ASSERT_EQ(low.plan.alternatives.size(), 2u);
  EXPECT_EQ(low.chosen, 1u);
  EXPECT_FALSE(faces_collar(low.plan));
  EXPECT_TRUE(low.plan.alternatives[0].feasible);
  EXPECT_LT(low.plan.cost_per_part, *low.plan.alternatives[0].cost_per_part);

  const auto high = chosen(collar(60, chamfered(0.5)));
  ASSERT_EQ(high.plan.alternatives.size(), 2u);
  EXPECT_EQ(high.chosen, 0u);
  EXPECT_TRUE(faces_collar(high.plan));
}

TEST(Choice, WithoutATurnedEdgeInStockNothingMoreIsFaced) {
  const auto ways = [](const json& d) {
    return document::prepared_candidates(d, shop(), "part").usable;
  };
  const auto shallow_grip = having(collar(60, chamfered(0.5)), "/setups/0/grip_mm", 30);
  EXPECT_EQ(ways(shallow_grip).size(), 1u) << "the first setup turns the collar";
  EXPECT_EQ(ways(collar(60, json::array())).size(), 1u) << "no edge";
  const auto before_jaws = having(collar(60, chamfered(4)), "/setups/0/grip_mm", 69);
  EXPECT_EQ(ways(before_jaws).size(), 1u) << "the jaws stand there";
  EXPECT_EQ(ways(collar(60, chamfered(4))).size(), 2u) << "further from the jaws";
  const auto low_wall =
      ways(having(collar(60, chamfered(1.5)), "/outer/1/diameter_mm", 48));
  EXPECT_EQ(low_wall.size(), 1u) << "less wall than a facing tool's corner needs";
  EXPECT_TRUE(low_wall[0].document.part.work.unreachable.empty());
}

// The other way round, from right to left.
json mirrored(json d) {
  const auto other = [](const std::string& end) {
    return end == "left" ? "right" : "left";
  };
  std::ranges::reverse(d["outer"]);
  for (auto& e : d["edges"]) e["at"] = "end|collar";
  for (auto& s : d["setups"]) s["hold"] = other(s["hold"]);
  return d;
}

TEST(Choice, EdgesInStockAreFacedAlikeFromEitherSide) {
  for (const auto& d : {collar(55, chamfered(0.3)), collar(60, chamfered(0.5))}) {
    const auto one = chosen(d), other = chosen(mirrored(d));
    EXPECT_EQ(one.chosen, other.chosen);
    for (const int way : {0, 1}) {
      const auto &a = one.plan.alternatives.at(way), &b = other.plan.alternatives.at(way);
      EXPECT_EQ(a.name, b.name);
      ASSERT_EQ(a.feasible, b.feasible) << a.name;
      if (a.feasible) {
        EXPECT_NEAR(*a.cost_per_part / *b.cost_per_part, 1, 1e-9) << a.name;
      }
    }
  }
}

TEST(Choice, WaysOfFacingHaveNames) {
  auto d = collar(55, chamfered(0.3));
  d["choose"] = {{"machine", {"lathe-medium", "lathe-heavy"}}};
  d.erase("machine");
  std::vector<std::string> names;
  for (const auto& a : chosen(d).plan.alternatives) names.push_back(a.name);
  const std::string faced = "; shoulders before edges in stock faced",
                    left = "; edges in stock left to the tools that finish in front";
  EXPECT_EQ(names, (std::vector{"lathe-medium" + faced, "lathe-medium" + left,
                                "lathe-heavy" + faced, "lathe-heavy" + left}));
}

// Whether shoulders are faced or not, the best plan at proven conditions is held against the
// best at any.
TEST(Choice, ProvenConditionsAreComparedOverAllWaysOfFacing) {
  const auto cost = [](double within_pct, const json& condition) {
    auto d = collar(55, chamfered(0.3));
    d["rules"] = {{"proven", {{"within_pct", within_pct}, {"conditions", {condition}}}}};
    const auto plan = chosen(d).plan;
    double least[2] = {INFINITY, INFINITY};  // at proven conditions, at any
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& a = plan.alternatives.at(i);
      if (a.feasible) least[i % 2] = std::min(least[i % 2], *a.cost_per_part);
    }
    EXPECT_GT(least[0], least[1]);
    const bool proven = least[0] <= (1 + within_pct / 100) * least[1];
    EXPECT_EQ(plan.cost_per_part, proven ? least[0] : least[1]);
    EXPECT_EQ(plan.status, PlanStatus::ok);
    return proven;
  };
  // The tool that finishes is not deep enough for the ring at proven conditions.
  const json shallow{
      {"tool", "PDJNL-DNMG150604-PF"}, {"material", "C45"}, {"ap_mm", {0.2, 0.5}}};
  EXPECT_TRUE(cost(5, shallow));
  EXPECT_FALSE(cost(1, shallow));
  const json slow{
      {"tool", "PCLNL-CNMG120408-PM"}, {"material", "C45"}, {"vc_m_min", {110, 150}}};
  EXPECT_TRUE(cost(4.35, slow));
  EXPECT_FALSE(cost(2, slow));
}

// Whether edges in stock are faced is chosen anew for what is changed, as for a request of
// its own, but the first-order saving is that of the plan's own operations.
TEST(Choice, WhatIfChoosesFacingAnew) {
  const auto changed = [](const json& d, const char* key, const json& value) {
    auto asked = d;
    asked["what_if"] = {{{"name", "changed"}, {"set", {{key, value}}}}};
    const auto own = chosen(asked).plan;
    const auto& a = own.what_if.at(0);
    const auto direct = chosen(having(d, key, value)).plan;
    EXPECT_TRUE(a.feasible) << key;
    EXPECT_NEAR(a.cost_per_part, direct.cost_per_part, 1e-12) << key;
    for (const auto& u : document::prepared_candidates(asked, shop(), "part").usable)
      EXPECT_EQ(u.document.what_if.at(0).part.face_edges_in_stock,
                u.document.part.face_edges_in_stock);
  };
  changed(collar(55, chamfered(0.3)), "/batch", 10);
  changed(collar(55, chamfered(0.3)), "/stock/diameter_mm", 60);
  changed(collar(60, chamfered(0.3)), "/stock/diameter_mm", 55);
  changed(collar(55, chamfered(0.3)), "/edges/0/chamfer_mm", 4);
}

TEST(Choice, WithoutAPlanNoneIsChosen) {
  json p = without(without(reference_part("infeasible-as-drawn"), "machine"), "setups");
  const auto c = chosen(having(
      p, "/choose",
      {{"setups", {left_then_right()}}, {"machine", {"lathe-small", "lathe-medium"}}}));
  EXPECT_EQ(c.plan.status, PlanStatus::infeasible);
  EXPECT_FALSE(c.plan.conflicts.empty());
  for (const auto& a : c.plan.alternatives) EXPECT_FALSE(a.chosen);
}

// A slender bore that no bar can cut without chattering, and a reamer that can make it.
json shaft_with_narrow_bore() {
  return {
      {"format", "turnwright-part/1"},
      {"name", "Shaft with a narrow bore"},
      {"material", "C45"},
      {"stock", {{"kind", "bar"}, {"diameter_mm", 45}, {"length_mm", 164}}},
      {"outer",
       {{{"id", "seat"},
         {"kind", "cylinder"},
         {"length_mm", 65},
         {"diameter_mm", 30},
         {"Ra_um", 0.8}},
        {{"id", "collar"}, {"kind", "cylinder"}, {"length_mm", 35}, {"diameter_mm", 42}},
        {{"id", "end"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 25}}}},
      {"inner",
       {{{"id", "b1"},
         {"from", "right"},
         {"kind", "cylinder"},
         {"length_mm", 30},
         {"diameter_mm", 14},
         {"fit", "H8"}}}},
      {"machine", "lathe-medium"}};
}

TEST(Choice, WithoutAPlanTheCandidateThatComesClosestSaysWhy) {
  const auto d = shaft_with_narrow_bore();
  ASSERT_EQ(chosen(d).plan.status, PlanStatus::ok);
  const auto asked = having(d, "/outer/0/Ra_um", 0.05);  // no tool can do that
  const auto c = chosen(asked);
  ASSERT_EQ(c.plan.alternatives.size(), 2u);
  EXPECT_FALSE(c.plan.alternatives[0].feasible || c.plan.alternatives[1].feasible);
  EXPECT_EQ(c.chosen, 1u);
  EXPECT_TRUE(c.plan.alternatives[1].sentence.starts_with(
      "b1 reamed: comes closest, its conflicts are told; no feasible plan"))
      << c.plan.alternatives[1].sentence;
  // The same as where the drawing leaves no choice: only the roughness is in the way.
  const auto alone = chosen(having(asked, "/inner/0/kind", "hole"));
  ASSERT_EQ(c.plan.conflicts.size(), 1u);
  EXPECT_EQ(c.plan.conflicts[0].limit, "roughness Ra");
  ASSERT_EQ(alone.plan.conflicts.size(), 1u);
  EXPECT_EQ(c.plan.conflicts[0].sentence, alone.plan.conflicts[0].sentence);
}

}  // namespace
}  // namespace turnwright::planning
