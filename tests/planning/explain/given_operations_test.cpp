// Given operations are carried out as they are given, or it is told why not.
#include <gtest/gtest.h>

#include <algorithm>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A collar with a hole of 11 mm, counterbored to 18 mm and chamfered there.
json counterbored() {
  const auto cylinder = [](const char* id, double length, double d) {
    return json{
        {"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
  };
  const auto hole = [](const char* id, double length, double d) {
    return json{{"id", id},
                {"kind", "hole"},
                {"from", "right"},
                {"length_mm", length},
                {"diameter_mm", d}};
  };
  return {{"material", "C45"},
          {"machine", "lathe-medium"},
          {"stock",
           {{"kind", "bar"},
            {"diameter_mm", 60},
            {"length_mm", 84},
            {"left_allowance_mm", 2}}},
          {"outer", {cylinder("d1", 40, 40), cylinder("d2", 40, 55)}},
          {"inner", {hole("cb", 12, 18), hole("h", 20, 11)}},
          {"edges", {{{"at", "right|cb"}, {"chamfer_mm", 0.5}}}},
          {"setups",
           {{{"hold", "left"}, {"clampings", {"chuck"}}},
            {{"hold", "right"}, {"clampings", {"chuck"}}}}}};
}

// Its planned operations, given back under names of their own.
const json& given() {
  static const json kGiven = [] {
    const auto d = counterbored();
    auto all = as_planned(d, plan(part(d)));
    for (auto& o : all["operations"]) o["id"] = "own-" + o["id"].get<std::string>();
    return all;
  }();
  return kGiven;
}

json& operation(json& d, const std::string& id) {
  return *std::ranges::find_if(d["operations"],
                               [&](const json& o) { return o["id"] == id; });
}

std::string told(const ProcessPlan& r) {
  std::string all;
  for (const auto& c : r.conflicts) all += c.sentence + "\n";
  return all;
}

// Of plan and predict alike.
void expect_told(const json& d, const std::string& what) {
  for (const auto& r : {plan(part(d)), predict(part_to_predict(d))}) {
    EXPECT_EQ(r.status, PlanStatus::infeasible);
    EXPECT_NE(told(r).find(what), std::string::npos) << told(r);
  }
}

TEST(GivenOperations, OfHolesAreCarriedOut) {
  for (const auto& r : {plan(part(given())), predict(part_to_predict(given()))}) {
    ASSERT_EQ(r.status, PlanStatus::ok) << told(r);
    std::size_t carried_out = 0;
    for (const auto& s : r.setups)
      for (const auto& o : s.operations) {
        EXPECT_TRUE(o.id.starts_with("own-")) << o.id;
        ++carried_out;
      }
    EXPECT_EQ(carried_out, given()["operations"].size());
  }
}

// The drill of an end is named after its outermost bore, which a threading tool cuts too.
TEST(GivenOperations, OfAThreadAtTheMouthOfADrilledBoreAreCarriedOut) {
  auto d = counterbored();
  d["stock"]["diameter_mm"] = 70;
  d["outer"] = json::parse(R"([
    {"id": "d1", "kind": "cylinder", "length_mm": 40, "diameter_mm": 66},
    {"id": "d2", "kind": "cylinder", "length_mm": 40, "diameter_mm": 58}])");
  d["inner"] = json::parse(R"([
    {"id": "t", "kind": "thread", "from": "right", "length_mm": 20, "designation": "M42x2"},
    {"id": "g", "kind": "groove", "from": "right", "length_mm": 5, "diameter_mm": 42.5},
    {"id": "b", "kind": "cylinder", "from": "right", "length_mm": 55, "diameter_mm": 30}])");
  d["edges"] = {{{"at", "right|t"}, {"chamfer_mm", 1.2}}};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok) << told(r);
  auto own = as_planned(d, r);
  for (auto& o : own["operations"]) o["id"] = "own-" + o["id"].get<std::string>();
  const auto again = predict(part_to_predict(own));
  ASSERT_EQ(again.status, PlanStatus::ok) << told(again);
  EXPECT_NEAR(again.cost_per_part, r.cost_per_part, 1e-9 * r.cost_per_part);
  // Given conditions of the drill are its conditions.
  auto& drill = operation(own, "own-s1-drill-t");
  drill["conditions"]["f_mm_rev"] = 0.9 * drill["conditions"]["f_mm_rev"].get<double>();
  EXPECT_GT(predict(part_to_predict(own)).time_per_part_min, r.time_per_part_min);
  // The drill alone does not cut the thread.
  auto& all = own["operations"];
  all.erase(std::ranges::find_if(
      all, [](const json& o) { return o["id"] == "own-s1-thread-t"; }));
  expect_told(own,
              "t has no operation of kind \"fixed\": only its blank would be made\n");
}

// The pass of the undercut makes a shoulder of which the drawing says the roughness alone.
TEST(GivenOperations, NeedNotFaceAShoulderBehindAnUndercut) {
  auto d = counterbored();
  d.erase("inner");
  d["edges"] = {{{"at", "d1|d2"}, {"undercut", "E0.8x0.3"}}};
  d["faces"] = {{{"id", "d1|d2"}, {"Ra_um", 3.2}}};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok) << told(r);
  auto own = as_planned(d, r);
  const auto again = predict(part_to_predict(own));
  ASSERT_EQ(again.status, PlanStatus::ok) << told(again);
  EXPECT_NEAR(again.cost_per_part, r.cost_per_part, 1e-9 * r.cost_per_part);
  // Faced all the same it takes longer; without the undercut it has to be.
  auto face = operation(own, "s2-finish-d1");
  face.update({{"id", "faced"}, {"kind", "face"}, {"on", {"d1|d2"}}});
  own["operations"].push_back(face);
  const auto faced = predict(part_to_predict(own));
  EXPECT_GT(faced.cost_per_part, r.cost_per_part) << told(faced);
  own["operations"].erase(own["operations"].size() - 1);
  own.erase("edges");
  EXPECT_EQ(told(predict(part_to_predict(own))),
            "d1|d2 has no operation: it would stay as the stock is\n");
}

TEST(GivenOperations, InAnotherSetupThanTheHoleAreTold) {
  for (const std::string id :
       {"own-s1-counterbore-cb", "own-s1-countersink-cb", "own-s1-drill-cb"}) {
    auto d = given();
    operation(d, id)["setup"] = 1;
    expect_told(d, id + " does not cut cb in setup 2: that is made in setup 1\n");
  }
}

TEST(GivenOperations, BesideThoseThatMakeTheHoleAreTold) {
  auto twice = given();
  auto second = operation(twice, "own-s1-drill-cb");
  second["id"] = "again";
  second["on"] = {"h"};
  twice["operations"].push_back(second);
  expect_told(twice,
              "again does not cut h in setup 1: that is made by own-s1-drill-cb, "
              "own-s1-counterbore-cb, own-s1-countersink-cb\n");
  auto bored = given();
  bored["operations"].push_back(
      {{"id", "bored"},
       {"setup", 0},
       {"kind", "bore-finish"},
       {"on", {"h"}},
       {"tool", "E08K-SCLCR-CCMT060204-PF"},
       {"conditions",
        {{"passes", 1}, {"ap_mm", 0.3}, {"f_mm_rev", 0.1}, {"vc_m_min", 100}}}});
  expect_told(bored, "bored does not cut h in setup 1: that is made by own-s1-drill-cb");
}

// No roughness and no tolerance asks for the shoulder; it is made with the smaller element.
TEST(GivenOperations, OfAFaceThatIsNotCutByItselfAreTold) {
  auto d = given();
  auto face = operation(d, "own-s2-face-left");
  face["id"] = "wall";
  face["on"] = {"d1|d2"};
  d["operations"].push_back(face);
  expect_told(d, "wall does not cut d1|d2 in setup 2: no setup cuts that by itself\n");
}

// Speeds and feeds of drills keep the tool's window and the spindle's limit as those of
// turning do.
TEST(GivenOperations, OutsideTheWindowOfTheirToolAreTold) {
  const auto with = [](const char* key, double value) {
    auto d = given();
    operation(d, "own-s1-counterbore-cb")["conditions"][key] = value;
    return d;
  };
  const auto p = part(given());
  const auto t =
      std::ranges::find(p.fixed_tools, "FLAT-HM-2D", &catalogue::FixedTool::id);
  const auto window =
      *catalogue::of_size(*t->conditions_in(p.material.group), t->use, 18).window;
  const std::string of = "own-s1-counterbore-cb: ";
  expect_told(with("vc_m_min", 1.01 * window.vc_m_min.upper),
              of + "largest cutting speed");
  expect_told(with("vc_m_min", 0.99 * window.vc_m_min.lower), of + "least cutting speed");
  expect_told(with("f_mm_rev", 1.01 * window.f_mm_rev.upper), of + "largest feed");
  expect_told(with("f_mm_rev", 0.99 * window.f_mm_rev.lower), of + "least feed");
  expect_told(with("vc_m_min", 1000), of + "largest spindle speed");
  for (const double vc : {window.vc_m_min.lower, window.vc_m_min.upper}) {
    const auto r = plan(part(with("vc_m_min", vc)));
    EXPECT_EQ(r.status, PlanStatus::ok) << told(r);
  }
}

// Where the spindle is slower than the window, its own speed may be given.
TEST(GivenOperations, MayHaveTheSpindlesHighestSpeed) {
  auto d = counterbored();
  d["inner"] = {{{"id", "h"},
                 {"kind", "hole"},
                 {"from", "right"},
                 {"length_mm", 8},
                 {"diameter_mm", 3}}};
  d.erase("edges");
  const auto p = part(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto again = predict(part_to_predict(as_planned(d, r)));
  EXPECT_EQ(again.status, PlanStatus::ok) << told(again);
  double slowest = 0;
  for (const auto& t : p.fixed_tools)
    if (t.id == operation(r, "s1-drill-h").tool)
      slowest = t.conditions_in(p.material.group)->window->vc_m_min.lower;
  EXPECT_LT(operation(r, "s1-drill-h").passes[0].vc_m_min, slowest);
}

}  // namespace
}  // namespace turnwright::planning
