// What a result says would help is tried: every remedy, relaxation and price is planned
// again from its own changed request.  TURNWRIGHT_REMEDY_PARTS sets how many infeasible
// parts are drawn, 100 by default (scripts/remedies draws 1000).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "../planning/parts.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/limit.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

constexpr double kTwoGaps = 2.5e-4;  // what two certificates may hide of a cost

/// Parts that are often too slender, too tightly toleranced, badly held, or all of it.
class HardParts {
 public:
  explicit HardParts(unsigned seed) : random_(seed) {}

  json next() {
    const bool tube = chance(0.2);
    json d{{"format", "turnwright-part/1"}, {"name", "Hard part"}};
    d["material"] = pick<const char*>({"C45", "42CrMo4-QT", "X5CrNi18-10", "AlMgSi"});
    d["machine"] = pick<const char*>({"lathe-medium", "lathe-worn", "lathe-small"});
    d["batch"] = 50;
    if (d["material"] == "C45" || d["material"] == "42CrMo4-QT")  // else the catalogue
      d["tools"] = pick<json>({{"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"},
                               {"PCLNL-CNMG120408-PM"},
                               {"PCLNL-CNMG120412-PR", "SVJBL-VBMT160404-PF"}});
    draw_elements(d, tube);
    draw_tolerances(d);
    draw_setups(d, tube);
    return d;
  }

 private:
  double uniform(double low, double high) {
    return std::round(10 * std::uniform_real_distribution<>(low, high)(random_)) / 10;
  }
  bool chance(double share) {
    return std::uniform_real_distribution<>(0, 1)(random_) < share;
  }
  template <class T>
  T pick(const std::vector<T>& all) {
    return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random_)];
  }

  void draw_elements(json& d, bool tube) {
    const int count = tube ? 2 : pick<int>({2, 3, 4});
    const int largest = count - 1 - pick<int>({0, 0, 1});
    double D = tube ? uniform(62, 78) : uniform(24, 60), length = 0;
    std::vector<double> diameters(static_cast<std::size_t>(count));
    for (int i = largest; i >= 0; --i)
      diameters[static_cast<std::size_t>(i)] = D - (largest - i) * uniform(2, 5);
    for (int i = largest; i < count; ++i)
      diameters[static_cast<std::size_t>(i)] = D - (i - largest) * uniform(2, 5);
    d["outer"] = json::array();
    for (int i = 0; i < count; ++i) {
      const double l = tube ? uniform(20, 45) : uniform(15, 110);
      length += l;
      d["outer"].push_back({{"id", "d" + std::to_string(i + 1)},
                            {"kind", "cylinder"},
                            {"length_mm", l},
                            {"diameter_mm", diameters[static_cast<std::size_t>(i)]}});
    }
    d["stock"] = {{"length_mm", length + 2}, {"left_allowance_mm", 1}};
    if (tube)
      d["stock"].update(
          {{"kind", "tube"}, {"outer_mm", D + 3}, {"inner_mm", uniform(34, 42)}});
    else
      d["stock"].update({{"kind", "bar"}, {"diameter_mm", D + 3}});
  }

  void draw_tolerances(json& d) {
    auto& outer = d["outer"];
    d["tolerances"] = json::array();
    for (auto& e : outer) {
      if (chance(0.5)) e["fit"] = pick<const char*>({"h5", "h6", "h7", "k6", "h9"});
      if (chance(0.3)) e["Ra_um"] = pick<double>({0.4, 0.8, 1.6, 3.2});
    }
    if (chance(0.6))
      d["tolerances"].push_back({{"id", "t1"},
                                 {"kind", "cylindricity"},
                                 {"of", outer[outer.size() - 1]["id"]},
                                 {"value_mm", pick<double>({0.003, 0.006, 0.01, 0.02})}});
    if (chance(0.4))
      d["tolerances"].push_back({{"id", "t2"},
                                 {"kind", "total-radial-runout"},
                                 {"of", outer[0]["id"]},
                                 {"datum", outer[outer.size() - 1]["id"]},
                                 {"value_mm", pick<double>({0.005, 0.015, 0.03})}});
  }

  void draw_setups(json& d, bool tube) {
    d["setups"] = json::array();
    const auto& outer = d["outer"];
    for (const char* hold : {"left", "right"}) {
      const auto& held = hold == std::string("left") ? outer[0] : outer[outer.size() - 1];
      json s{{"hold", hold}};
      s["clampings"] =
          tube ? json{"chuck"}
               : pick<json>(
                     {{"chuck"}, {"chuck"}, {"chuck-tailstock"}, {"between-centres"}});
      if (chance(0.2)) s["jaws"] = "hard";
      if (chance(0.7))
        s["grip_mm"] =
            std::clamp(std::round(held["length_mm"].get<double>() * uniform(0.3, 1.3)),
                       5.0, std::floor(d["stock"]["length_mm"].get<double>()) - 3);
      d["setups"].push_back(s);
    }
  }

  std::mt19937_64 random_;
};

/// The document of a part, changed as a remedy says.
void apply(const json& change, json& d) {
  const auto what = change["change"].get<std::string>();
  if (what == "tool") return d["tools"].push_back(change["tool"]);
  auto& setup = d["setups"][change["setup"].get<std::size_t>()];
  if (what == "grip") setup["grip_mm"] = change["grip_mm"];
  if (what != "clamping") return;
  setup["clampings"].push_back(change["clamping"]);
  if (change.contains("steady_mm")) setup["steady_mm"] = change["steady_mm"];
}

/// One relaxation of every set, by the limits' own names: tolerances and roughness.
/// Nothing if a set has only limits of the machine or the tools, or if there is a conflict
/// that no limit can resolve.
std::vector<Relaxation> of_the_drawing(const ProcessPlan& r) {
  std::map<std::size_t, Relaxation> chosen;
  for (const auto& c : r.conflicts)
    if (c.set == 0) return {};
  std::size_t sets = 0;
  for (const auto& relax : r.relax) {
    sets = std::max(sets, relax.set);
    if (relax.unit == "mm" || relax.unit == "um") chosen.try_emplace(relax.set, relax);
  }
  std::vector<Relaxation> all;
  for (const auto& [set, relax] : chosen) all.push_back(relax);
  return all.size() == sets ? all : std::vector<Relaxation>{};
}

bool relax(PlanRequest& p, const Relaxation& by) {
  for (auto& t : p.drawing.tolerances) {
    if (by.limit.rfind(t.id + " " + part::name(t.kind), 0) != 0) continue;
    t.value_mm = by.needed;
    if (t.limits) {
      const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
      t.limits = part::Limits{middle - by.needed / 2, middle + by.needed / 2};
    }
    return true;
  }
  bool found = false;
  const auto roughness = [&](auto& surfaces) {
    for (auto& s : surfaces) {
      if (s.Ra_um && by.limit == "Ra of " + s.id) s.Ra_um = by.needed, found = true;
      if (s.Rz_um && by.limit == "Rz of " + s.id) s.Rz_um = by.needed, found = true;
    }
  };
  roughness(p.drawing.outer);
  roughness(p.drawing.inner);
  roughness(p.drawing.faces);
  return found;
}

int wanted_parts() {
  const char* given = std::getenv("TURNWRIGHT_REMEDY_PARTS");
  return given ? std::atoi(given) : 100;
}

class WhatWouldHelp : public testing::Test {
 protected:
  static void check_remedies(const json& d, const ProcessPlan& r) {
    const json result = document::to_json(r, {});
    for (const auto& remedy : result.value("remedies", json::array())) {
      auto changed = d;
      apply(remedy, changed);
      if (remedy.contains("together_with")) apply(remedy["together_with"], changed);
      const auto planned = plan(part(changed));
      EXPECT_EQ(planned.status, PlanStatus::ok) << remedy["sentence"] << "\n" << d.dump();
      EXPECT_NEAR(planned.cost_per_part, remedy["cost_per_part"].get<double>(),
                  kTwoGaps * planned.cost_per_part)
          << remedy["sentence"] << "\n"
          << d.dump();
      ++remedies;
    }
  }

  static void check_relaxations(const json& d, const PreparedPart& p,
                                const ProcessPlan& r) {
    const auto all = of_the_drawing(r);
    if (all.empty()) return;
    PlanRequest changed = p;
    std::string sentences;
    for (const auto& by : all) {
      if (!relax(changed, by)) return;
      sentences += by.sentence + "; ";
    }
    const auto planned = plan(prepare(std::move(changed)));
    EXPECT_EQ(planned.status, PlanStatus::ok) << sentences << "\n" << d.dump();
    ++relaxations;
  }

  static double price_of(const ProcessPlan& r, const std::string& limit) {
    for (const auto& price : r.prices)
      if (price.limit == limit) return price.saves_per_part_for_10_percent;
    return 0;
  }

  // The best choice of the plan still stands, so that no less is saved than it would save
  // alone.  A price is a slope, which falls as the limit is opened: the saving lies between
  // the slopes before and after.
  static void check_price(const json& d, const PreparedPart& p, const ProcessPlan& r) {
    if (r.prices.empty()) return;
    const auto& dearest = r.prices.front();
    const double step = 0.01, share = std::log1p(step) / std::log(1.1);
    for (const auto& l : limits(p)) {
      if (l.name != dearest.limit) continue;
      PlanRequest changed = p;
      l.scale(changed, l.at_most ? 1 + step : 1 / (1 + step));
      const auto planned = plan(prepare(std::move(changed)));
      EXPECT_EQ(planned.status, PlanStatus::ok) << dearest.sentence;
      const double slope =
          std::min(dearest.saves_per_part_for_10_percent, price_of(planned, l.name));
      EXPECT_GT(r.cost_per_part - planned.cost_per_part,
                0.9 * share * slope - kTwoGaps * r.cost_per_part)
          << dearest.sentence << "\n"
          << d.dump();
      prices += share * slope > 4 * kTwoGaps * r.cost_per_part;
    }
  }

  inline static int remedies = 0, relaxations = 0, prices = 0;
};

TEST_F(WhatWouldHelp, HoldsWhenItIsDone) {
  HardParts draw(22);
  const int wanted = wanted_parts();
  int infeasible = 0, helpless = 0;
  for (int k = 0; infeasible < wanted && k < 20 * wanted; ++k) {
    const auto d = draw.next();
    const auto p = part(d);
    const auto r = plan(p);
    if (r.status == PlanStatus::ok) {
      check_price(d, p, r);
      continue;
    }
    ++infeasible;
    ASSERT_FALSE(r.conflicts.empty()) << d.dump();
    EXPECT_FALSE(r.remedies.empty() && r.relax.empty() && r.tried.empty()) << d.dump();
    helpless += r.remedies.empty() && r.relax.empty();
    check_remedies(d, r);
    check_relaxations(d, p, r);
  }
  EXPECT_EQ(infeasible, wanted);
  EXPECT_GT(remedies, wanted / 4);
  EXPECT_GT(relaxations, wanted / 6);
  EXPECT_GT(prices, wanted / 20);
  EXPECT_LT(helpless, wanted / 3);
  RecordProperty("remedies", remedies);
  RecordProperty("relaxations", relaxations);
  RecordProperty("prices", prices);
  RecordProperty("helpless", helpless);
  printf("%d remedies, %d relaxations, %d prices, %d parts that nothing helps\n",
         remedies, relaxations, prices, helpless);
}

// Between centres and in the chuck the machine takes most of the tolerance: neither is
// said to help the other.
TEST_F(WhatWouldHelp, IsNoClampingThatTheMachineRulesOut) {
  for (const auto& clampings : {json{"chuck"}, json{"between-centres"}}) {
    auto d = file("docs/examples/guide/worn.json");
    d["setups"][0]["clampings"] = clampings;
    const auto r = plan(part(d));
    EXPECT_EQ(r.status, PlanStatus::infeasible);
    check_remedies(d, r);
    auto both = d;
    both["setups"][0]["clampings"] = {"chuck", "between-centres"};
    EXPECT_EQ(plan(part(both)).status, PlanStatus::infeasible);
  }
}

// A grip of half the diameter would hide the flange's rim in the jaws.
TEST(Grip, LeftOpenIsShortEnoughForEverySurface) {
  json d{
      {"format", "turnwright-part/1"},
      {"material", "C45"},
      {"stock", {{"kind", "bar"}, {"diameter_mm", 80}, {"length_mm", 44}}},
      {"outer",
       {{{"id", "rim"}, {"kind", "cylinder"}, {"length_mm", 12}, {"diameter_mm", 76}},
        {{"id", "body"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 50}}}},
      {"machine", "lathe-medium"}};
  const auto p = part(d);
  EXPECT_TRUE(p.work.unreachable.empty());
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 40}, {"clampings", {"chuck"}}},
                 {{"hold", "right"}, {"grip_mm", 20}, {"clampings", {"chuck"}}}};
  const auto r = plan(part(d));
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.remedies.empty());
  EXPECT_EQ(r.remedies.front().changes.front().kind, RequestChange::Kind::grip);
}

}  // namespace
}  // namespace turnwright::planning
