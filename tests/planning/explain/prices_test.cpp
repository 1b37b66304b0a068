#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "../parts.hpp"
#include "turnwright/planning/limit.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Prices against plans made anew with the limit moved in the documents.
namespace turnwright::planning {
namespace {

using nlohmann::json;

// A part with its machine, tools and assumed grips written out, so that each can be
// moved.
json written_out(json d) {
  const auto p = part(d);
  if (!d.contains("machine") || d["machine"].is_string())
    d["machine"] = file("machines/" + p.machine.id + ".json");
  auto tools = json::array();
  for (const auto& t : p.tools) tools.push_back(file("tools/" + t.id + ".json"));
  d["tools"] = tools;
  const double full = p.machine.chuck.grip_force_N;
  d["machine"]["chuck"]["grip_force_N"] = 2 * full;  // setups take no more than that
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    d["setups"][s]["grip_force_N"] = p.setups[s].grip_force_N.value_or(full);
  for (std::size_t s = 0; s < p.setups.size(); ++s)
    if (const auto force = p.setups[s].finishing_grip_force_N)
      d["setups"][s]["finishing_grip_force_N"] = *force;
  return d;
}

json& member(json& list, const std::string& id) {
  for (auto& item : list)
    if (item["id"] == id) return item;
  throw std::out_of_range(id);
}
bool has(const json& list, const std::string& id) {
  return std::any_of(list.begin(), list.end(),
                     [&](const json& x) { return x["id"] == id; });
}
void times(json& number, double k) { number = number.get<double>() * k; }
json about_middle(double low, double high, double k) {
  const double m = (low + high) / 2;
  return {m + k * (low - m), m + k * (high - m)};
}

// The document with the limit a price names times k; false if it is nowhere written.
bool moved(json& d, const std::string& limit, double k) {
  const auto after = [&](const std::string& lead) {
    return limit.starts_with(lead) ? limit.substr(lead.size()) : std::string();
  };
  const auto in_tools = [&](const std::string& lead, const char* group, const char* key,
                            int index) {
    const auto id = after(lead + " of ");
    if (id.empty() || !has(d["tools"], id)) return false;
    auto& value = member(d["tools"], id)[group][key];
    times(index < 0 ? value : value[static_cast<std::size_t>(index)], k);
    return true;
  };
  for (const char* list : {"outer", "inner", "faces"})
    for (const char* key : {"Ra", "Rz"}) {
      const auto id = after(std::string("roughness ") + key + " of ");
      if (id.empty() || !d.contains(list) || !has(d[list], id)) continue;
      times(member(d[list], id)[std::string(key) + "_um"], k);
      return true;
    }
  auto& m = d["machine"];
  if (!after("power of ").empty()) {
    for (auto& point : m["spindle"]["curve"])
      for (const char* key : {"P_kW", "M_Nm"}) times(point[key], k);
    return true;
  }
  if (!after("feed force of ").empty())
    return times(m["feed"]["feed_force_max_N"], k), true;
  if (!after("least spindle speed of ").empty())
    return times(m["spindle"]["n_min_rpm"], k), true;
  for (const char* key : {"grip_force_N", "finishing_grip_force_N"}) {
    const auto s =
        after(key[0] == 'g' ? "grip force in setup " : "finishing grip force in setup ");
    if (s.empty()) continue;
    times(d["setups"][std::stoul(s) - 1][key], k);
    return true;
  }
  if (!after("largest spindle speed of ")
           .empty()) {  // the last line of the curve goes on
    auto& curve = m["spindle"]["curve"];
    auto &a = curve[curve.size() - 2], &b = curve.back();
    for (const char* key : {"P_kW", "M_Nm"}) {
      const double slope = std::log(b[key].get<double>() / a[key].get<double>()) /
                           std::log(b["n_rpm"].get<double>() / a["n_rpm"].get<double>());
      times(b[key], std::pow(k, slope));
    }
    times(b["n_rpm"], k);
    times(m["spindle"]["n_max_rpm"], k);
    times(m["chuck"]["n_max_rpm"], k);
    return true;
  }
  if (in_tools("cutting force", "strength", "Fc_max_N", -1) ||
      in_tools("least depth of cut", "window", "ap_mm", 0) ||
      in_tools("largest depth of cut", "window", "ap_mm", 1) ||
      in_tools("least feed", "window", "f_mm_rev", 0) ||
      in_tools("largest feed", "window", "f_mm_rev", 1) ||
      in_tools("least cutting speed", "window", "vc_m_min", 0) ||
      in_tools("largest cutting speed", "window", "vc_m_min", 1) ||
      in_tools("least tool life", "life", "T_min", 0))
    return true;
  if (d.contains("tolerances") && has(d["tolerances"], limit)) {
    auto& t = member(d["tolerances"], limit);
    if (t.contains("value_mm")) return times(t["value_mm"], k), true;
    t["limits_mm"] = about_middle(t["limits_mm"][0], t["limits_mm"][1], k);
    return true;
  }
  const auto id = limit.substr(0, limit.find(":diameter"));
  for (const char* list : {"outer", "inner"})
    if (d.contains(list) && has(d[list], id)) {
      const auto loaded = part(d);
      for (const auto& t : loaded.drawing.tolerances)
        if (t.id == limit) {
          auto& e = member(d[list], id);
          e.erase("fit");
          e["limits_mm"] = about_middle(t.limits->lower_mm, t.limits->upper_mm, k);
          return true;
        }
    }
  return false;
}

// What is chosen and what has a price: the same on both sides of a slope.
std::set<std::string> active(const ProcessPlan& r) {
  std::set<std::string> all;
  for (const auto& s : r.setups)
    for (const auto& o : s.operations)
      all.insert(o.id + " " + o.tool + " " + std::to_string(o.passes.size()));
  for (const auto& p : r.prices)
    if (p.saves_per_part_for_10_percent > 1e-5 * r.cost_per_part) all.insert(p.limit);
  return all;
}

constexpr double kStep = 0.002;

struct Slopes {
  double told = 0, found = 0;
  bool same = false;  ///< the same limits bind
};

Slopes slopes(const json& d, const ProcessPlan& r, const Price& price) {
  Slopes x{price.saves_per_part_for_10_percent / std::log(1.1), 0, false};
  auto less = d, more = d;
  if (!moved(less, price.limit, 1 / (1 + kStep)) || !moved(more, price.limit, 1 + kStep))
    return x;
  const auto a = plan(part(less)), b = plan(part(more));
  if (a.status != PlanStatus::ok || b.status != PlanStatus::ok) return x;
  x.same = active(a) == active(b) && active(a) == active(r);
  x.found = std::abs(a.cost_per_part - b.cost_per_part) / (2 * std::log1p(kStep));
  return x;
}

// Every way in which a limit can bind, on a pin.
struct Case {
  std::string limit;
  std::function<void(json&)> change;
};

json cone_pin() {
  auto d = pin();
  d["outer"][1] = {{"id", "d2"},    {"kind", "cone"}, {"length_mm", 50},
                   {"left_mm", 34}, {"right_mm", 30}, {"Ra_um", 3.2}};
  return d;
}

json slender() {
  auto d = pin();
  d["stock"]["length_mm"] = 142;
  d["outer"][1]["length_mm"] = 100;
  d["outer"][1]["diameter_mm"] = 30;
  d["setups"][0]["clampings"] = {"chuck"};
  return d;
}

void tolerance(json& d, const char* kind, double value, const char* of = "d2",
               const char* datum = "") {
  json t{{"id", "t"}, {"kind", kind}, {"of", of}, {"value_mm", value}};
  if (*datum) t["datum"] = datum;
  d["tolerances"] = {t};
}

std::vector<Case> cases() {
  const std::string rougher = "PCLNL-CNMG120408-PM", finisher = "PDJNL-DNMG150604-PF";
  const auto tool = [](json& d, const std::string& id) -> json& {
    return member(d["tools"], id);
  };
  return {
      {"roughness Ra of d2", [](json&) {}},
      {"roughness Rz of d2", [](json& d) { d["outer"][1]["Rz_um"] = 6; }},
      {"roughness Ra of right",
       [](json& d) {
         d["faces"] = {{{"id", "right"}, {"Ra_um", 2.0}}};
       }},
      {"d2:diameter",
       [](json& d) {
         d = written_out(slender());
         d["outer"][1]["limits_mm"] = {-0.004, 0.004};
       }},
      {"t",
       [](json& d) { d = written_out(slender()), tolerance(d, "cylindricity", 0.003); }},
      {"t",
       [](json& d) {
         d = written_out(slender());
         tolerance(d, "total-radial-runout", 0.0028, "d2", "d1");
       }},
      {"t",
       [](json& d) {
         d = written_out(cone_pin());
         tolerance(d, "profile", 0.003, "d2", "d1");
       }},
      {"t", [](json& d) { tolerance(d, "flatness", 0.0017, "right"); }},
      {"power of lathe-medium", [](json& d) { moved(d, "power of lathe-medium", 0.2); }},
      {"power of lathe-medium",  // its torque, at a base speed that no cut exceeds
       [](json& d) {
         auto& curve = d["machine"]["spindle"]["curve"];
         for (auto& x : curve)
           times(x["n_rpm"], 3), times(x["P_kW"], 0.5), times(x["M_Nm"], 1.0 / 6);
         d["machine"]["spindle"]["n_min_rpm"] = 120;
         d["machine"]["spindle"]["n_max_rpm"] = 13500;
       }},
      {"feed force of lathe-medium",
       [](json& d) { d["machine"]["feed"]["feed_force_max_N"] = 900; }},
      {"largest spindle speed of lathe-medium",
       [](json& d) { moved(d, "largest spindle speed of lathe-medium", 0.6); }},
      {"grip force in setup 1", [](json& d) { d["setups"][0]["grip_force_N"] = 17000; }},
      {"cutting force of " + rougher,
       [=](json& d) { tool(d, rougher)["strength"]["Fc_max_N"] = 1500; }},
      {"largest feed of " + finisher,
       [=](json& d) {
         tool(d, finisher)["window"]["f_mm_rev"][1] = 0.15;
         d["outer"][1].erase("Ra_um");
       }},
      {"least tool life of " + finisher,
       [=](json& d) { tool(d, finisher)["life"]["T_min"][0] = 40; }},
      {"largest cutting speed of " + finisher,
       [=](json& d) { tool(d, finisher)["window"]["vc_m_min"][1] = 180; }},
      {"largest depth of cut of " + finisher,
       [](json& d) {
         d = written_out(slender());
         tolerance(d, "cylindricity", 0.003);
       }},
  };
}

class PriceOf : public testing::TestWithParam<std::size_t> {};

TEST_P(PriceOf, ALimitIsWhatReSolvingSaves) {
  const auto x = cases()[GetParam()];
  SCOPED_TRACE(x.limit);
  auto d = written_out(pin());
  x.change(d);
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok) << r.conflicts[0].sentence;
  const auto price = std::find_if(r.prices.begin(), r.prices.end(),
                                  [&](const Price& p) { return p.limit == x.limit; });
  ASSERT_NE(price, r.prices.end());
  const auto s = slopes(d, r, *price);
  EXPECT_TRUE(s.same);
  EXPECT_NEAR(s.told, s.found, 0.01 * s.found);
  EXPECT_GT(s.found, 1e-5 * r.cost_per_part);
  EXPECT_FALSE(price->binds_in.empty());
  EXPECT_EQ(price->saves_per_batch_for_10_percent,
            10 * price->saves_per_part_for_10_percent);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PriceOf, testing::Range<std::size_t>(0, cases().size()));

// All prices of some parts drawn at random.
TEST(Prices, OfRandomPinsAreWhatReSolvingSaves) {
  int compared = 0;
  for (unsigned k = 0; k < 4; ++k) {
    SCOPED_TRACE(k);
    std::mt19937 seed(k);
    const auto between = [&](double a, double b) {
      return std::uniform_real_distribution<double>(a, b)(seed);
    };
    auto d = pin();
    d["outer"][1]["diameter_mm"] = between(26, 36);
    d["outer"][1]["Ra_um"] = between(0.8, 4);
    const double half = between(0.004, 0.02);
    d["outer"][1]["limits_mm"] = {-half, half};
    d["rates"]["machine_per_min"] = between(0.3, 2);
    tolerance(d, "cylindricity", between(0.003, 0.01));
    d = written_out(d);
    const auto r = plan(part(d));
    if (r.status != PlanStatus::ok) continue;
    for (const auto& price : r.prices) {
      if (price.saves_per_part_for_10_percent < 1e-5 * r.cost_per_part) continue;
      const auto s = slopes(d, r, price);
      if (!s.same) continue;
      ++compared;
      EXPECT_NEAR(s.told, s.found, 0.01 * s.found) << price.limit;
    }
  }
  EXPECT_GE(compared, 10);
}

TEST(Prices, AreRankedAndSayWhatTheyAreOf) {
  const auto r = plan(part(pin()));
  ASSERT_FALSE(r.prices.empty());
  std::set<std::string> names;
  for (std::size_t k = 0; k < r.prices.size(); ++k) {
    EXPECT_TRUE(names.insert(r.prices[k].limit).second) << r.prices[k].limit;
    if (k > 0) {
      EXPECT_LE(r.prices[k].saves_per_part_for_10_percent,
                r.prices[k - 1].saves_per_part_for_10_percent);
    }
  }
  EXPECT_EQ(names.count("roughness Ra of d2"), 1u);
}

// ---- What if --------------------------------------------------------------------------

ProcessPlan asked(json d, const json& what_if) {
  d["what_if"] = what_if;
  const auto loaded = document::prepared_part(d, shop(), "part");
  return plan(loaded.part, loaded.what_if);
}

TEST(WhatIf, IsThePlanOfTheChangedDocument) {
  auto d = pin();
  d["outer"][1]["fit"] = "h6";
  const auto r =
      asked(d, {{{"name", "open d2 to h8"}, {"set", {{"/outer/d2/fit", "h8"}}}},
                {{"limit", "roughness Ra of d2"}, {"change_percent", 10}},
                {{"name", "dearer"}, {"set", {{"/rates/machine_per_min", 1.1}}}}});
  ASSERT_EQ(r.what_if.size(), 3u);
  const auto same = [&](const WhatIfAnswer& a, json changed) {
    const auto own = plan(part(changed));
    EXPECT_TRUE(a.feasible);
    EXPECT_EQ(a.cost_per_part, own.cost_per_part);
    EXPECT_EQ(a.time_per_part_min, own.time_per_part_min);
    EXPECT_DOUBLE_EQ(*a.saves_per_part, r.cost_per_part - own.cost_per_part);
    EXPECT_DOUBLE_EQ(*a.saves_per_batch, 10 * *a.saves_per_part);
  };
  auto changed = d;
  changed["outer"][1]["fit"] = "h8";
  same(r.what_if[0], changed);
  changed = d;
  changed["outer"][1]["Ra_um"] = 3.2 * 1.1;
  same(r.what_if[1], changed);
  EXPECT_EQ(r.what_if[1].name, "roughness Ra of d2 +10 %");
  changed = d;
  changed["rates"]["machine_per_min"] = 1.1;
  same(r.what_if[2], changed);
  // A minute that costs 0.1 more costs the plan's minutes, to first order.
  EXPECT_NEAR(*r.what_if[2].first_order_saves_per_part, -0.1 * r.time_per_part_min,
              0.01 * r.time_per_part_min * 0.1);
}

TEST(WhatIf, FirstOrderIsTheSlopeOfAnyChange) {
  const auto d = written_out(pin());
  for (const auto& [path, value] :
       {std::pair{"/machine/times/index_min", 0.03003},
        {"/machine/times/load_min", 0.5005},
        {"/tools/PDJNL-DNMG150604-PF/economics/edge_cost", 2.401},
        {"/tools/PCLNL-CNMG120408-PM/economics/change_min", 1.001}}) {
    const auto r = asked(d, {{{"name", "x"}, {"set", {{path, value}}}}});
    const auto& a = r.what_if[0];
    ASSERT_TRUE(a.first_order_saves_per_part && a.saves_per_part);
    EXPECT_LT(*a.saves_per_part, 0) << path;
    EXPECT_NEAR(*a.first_order_saves_per_part, *a.saves_per_part,
                0.01 * std::abs(*a.saves_per_part))
        << path;
  }
}

TEST(WhatIf, SaysWhenAChangeLeavesNoPlanOrMakesOne) {
  auto d = pin();
  const auto r = asked(
      d, {{{"name", "too fine"}, {"set", {{"/outer/1/limits_mm", {-0.0001, 0.0001}}}}}});
  EXPECT_FALSE(r.what_if[0].feasible);
  EXPECT_FALSE(r.what_if[0].saves_per_part);
  EXPECT_TRUE(r.what_if[0].sentence.starts_with("too fine: no feasible plan"))
      << r.what_if[0].sentence;
  d["outer"][1]["limits_mm"] = {-0.0001, 0.0001};
  const auto other =
      asked(d, {{{"name", "open"}, {"set", {{"/outer/d2/limits_mm", {-0.1, 0.1}}}}}});
  EXPECT_EQ(other.status, PlanStatus::infeasible);
  EXPECT_TRUE(other.what_if[0].feasible);
  EXPECT_TRUE(other.what_if[0].sentence.starts_with("open: makes the part feasible"));
}

}  // namespace
}  // namespace turnwright::planning
