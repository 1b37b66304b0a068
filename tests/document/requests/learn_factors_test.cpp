// The factors that measured parts update, and the documents with them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../../learning/simulated.hpp"
#include "../../planning/parts.hpp"
#include "../schema_check.hpp"
#include "planning/budget/tolerance_allocation.hpp"
#include "turnwright/document/learn.hpp"
#include "turnwright/planning/factor_effects.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::document::learn_factors_test {
namespace {

using nlohmann::json;
using planning::as_planned;
using planning::part_to_predict;
using planning::shop;

// A pin of three diameters, the thinner ones far from the jaws.
json shaft() {
  auto d = planning::pin();
  d["stock"]["length_mm"] = 142;
  d["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 40}, {"diameter_mm", 40}},
      {{"id", "d2"},
       {"kind", "cylinder"},
       {"length_mm", 50},
       {"diameter_mm", 32},
       {"limits_mm", {-0.02, 0.02}}},
      {{"id", "d3"},
       {"kind", "cylinder"},
       {"length_mm", 50},
       {"diameter_mm", 24},
       {"limits_mm", {-0.02, 0.02}}}};
  d["tolerances"] = {{{"id", "r3"},
                      {"kind", "circular-radial-runout"},
                      {"of", "d3"},
                      {"datum", "d1"},
                      {"value_mm", 0.04}}};
  d["damping_ratio"] = 0.5;  // sizes are what matters here, not chatter
  d.erase("budget");
  d.erase("robust");
  d.erase("machine_share_um");
  return d;
}

const planning::ProcessPlan& planned() {
  static const auto kPlan = planning::plan(planning::part(shaft()));
  return kPlan;
}

std::map<std::string, planning::FactorEffect> effects() {
  std::map<std::string, planning::FactorEffect> all;
  for (const auto& e : planning::factor_effects(planning::part(shaft()), planned()))
    all[e.surface] = e;
  return all;
}

// Middle of each diameter's error at the plan's conditions, with nothing corrected.
std::map<std::string, double> predicted_mm(const json& part) {
  auto given = as_planned(part, planned());
  given["budget"] = planning::no_shop_errors();
  given["robust"] = false;
  given["tolerances"] = json::array();
  for (auto& element : given["outer"]) element["limits_mm"] = {-0.5, 0.5};
  std::map<std::string, double> all;
  for (const auto& d : planning::predict(part_to_predict(given)).deviations) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& [z, e] : d.table_mm) {
      low = std::min(low, e);
      high = std::max(high, e);
    }
    all[d.on] = low + high;
  }
  return all;
}

constexpr double kForce = 1.3;  // of the true passive forces over the documents'

json true_part() {
  auto d = shaft();
  d["material"] = shop().material_documents.at("C45");
  d["material"]["thrust"] = {{"ratio", kForce * 0.4},
                             {"edge_N_mm", kForce * 0.033 * 1600},
                             {"uncertainty_pct", 20},
                             {"source", "test"}};
  return d;
}

// Forty-eight parts on six edges, both sizes by one tool that is set 9 um off; drift of the
// radius 1.5 um/h, wear twice the plan's, scatter of the radius 0.5 um, run-outs of a
// Rayleigh vector of 5 um.
json batch() {
  const auto of = effects();
  const auto before = predicted_mm(shaft()), now = predicted_mm(true_part());
  learning::Draw draw(8);
  json rows = json::array();
  double hours = 0;
  for (int n = 0; n < 48; ++n) {
    hours += draw.uniform(0.1, 0.25);
    for (const char* id : {"d2", "d3"}) {
      const auto& e = of.at(id);
      const double size = id == std::string("d2") ? 32 : 24;
      rows.push_back({{"part", n},
                      {"characteristic", std::string(id) + ":diameter"},
                      {"time_s", 3600 * hours},
                      {"edge", n / 8},
                      {"value_mm", size + e.made_mm + now.at(id) - before.at(id) + 0.009 +
                                       0.003 * hours + 2 * e.wear_mm_part * (n % 8) +
                                       0.001 * draw.normal()}});
    }
    rows.push_back({{"part", n},
                    {"characteristic", "r3"},
                    {"value_mm", 0.01 * std::hypot(draw.normal(), draw.normal())}});
  }
  return {{"part", shaft()}, {"rows", rows}, {"update", true}};
}

const json& learned() {
  static const json kResult = learn(batch(), shop());
  return kResult;
}

json factor(const std::string& name) {
  for (const auto& f : learned()["factors"])
    if (f["name"] == name) return f;
  return {};
}

bool holds(const json& factor, double truth) {
  return factor["posterior"]["lower"] <= truth && truth <= factor["posterior"]["upper"];
}

// 30 % more force by the documents, not by the function's own step.
TEST(LearnFactors, EffectsAreThoseOfPredictionsByOtherDocuments) {
  for (const auto& c : planned().conflicts) ADD_FAILURE() << c.sentence;
  const auto of = effects();
  const auto before = predicted_mm(shaft()), now = predicted_mm(true_part());
  for (const char* id : {"d2", "d3"}) {
    const double change = now.at(id) - before.at(id);
    EXPECT_NEAR(of.at(id).by_force_mm * (kForce - 1), change, 0.1 * std::abs(change))
        << id;
    EXPECT_GT(of.at(id).by_force_mm, of.at(id).by_compliance_mm) << "the part bends too";
    EXPECT_GT(of.at(id).by_compliance_mm, 0);
    EXPECT_GT(of.at(id).wear_mm_part, 0);
  }
  EXPECT_GT(of.at("d3").by_force_mm, of.at("d2").by_force_mm);
}

TEST(LearnFactors, TruthLiesInTheIntervals) {
  static const SchemaCheck kRequest("learn.request.json"), kResult("learn.result.json");
  EXPECT_EQ(kRequest.fault(batch()), "");
  EXPECT_EQ(kResult.fault(learned()), "");
  EXPECT_TRUE(holds(factor("passive_force"), kForce)) << factor("passive_force");
  EXPECT_TRUE(holds(factor("drift"), 0.0015)) << factor("drift");
  EXPECT_TRUE(holds(factor("wear"), 2)) << factor("wear");
  EXPECT_TRUE(holds(factor("repeatability"), 0.5)) << factor("repeatability");
  EXPECT_TRUE(holds(factor("rechucking"), 5)) << factor("rechucking");
  EXPECT_EQ(factor("rechucking")["by"], "soft_jaws");
}

TEST(LearnFactors, TheNextPlanTakesTheDocumentsAndHasAnotherConformance) {
  static const SchemaCheck kMaterial("material.json"), kMachine("lathe.json");
  const auto& documents = learned()["documents"];
  EXPECT_EQ(kMaterial.fault(documents["material"]), "");
  EXPECT_EQ(kMachine.fault(documents["machine"]), "");
  EXPECT_EQ(documents["material"]["thrust"]["source"], "learned from 48 parts of Pin");
  EXPECT_EQ(documents["machine"]["budget"]["source"], "learned from 48 parts of Pin");
  EXPECT_EQ(documents["material"]["kienzle"]["kc11_MPa"], 1600) << "no part tells Fc";
  auto next = shaft();
  next["material"] = documents["material"];
  next["machine"] = documents["machine"];
  const auto before = planning::predict(part_to_predict(as_planned(shaft(), planned()))),
             after = planning::predict(part_to_predict(as_planned(next, planned())));
  EXPECT_LT(planning::tolerance(after, "r3").P_conform,
            planning::tolerance(before, "r3").P_conform)
      << "these jaws centre worse than was thought";
  EXPECT_NE(planning::tolerance(after, "d3:diameter").P_conform,
            planning::tolerance(before, "d3:diameter").P_conform);
  EXPECT_LT(planning::passive_spread(part_to_predict(as_planned(next, planned()))),
            planning::passive_spread(part_to_predict(as_planned(shaft(), planned()))));
}

TEST(LearnFactors, WhatOneSizeCannotTellStaysAtItsPrior) {
  auto request = batch();
  json rows = json::array();
  for (const auto& row : request["rows"])
    if (row["characteristic"] == "d3:diameter") rows.push_back(row);
  request["rows"] = rows;
  const json result = learn(request, shop());
  for (const auto& f : result["factors"]) {
    const bool of_errors = f["name"] == "passive_force" || f["name"] == "compliance";
    EXPECT_EQ(f["identified"], !of_errors) << f;
    if (of_errors) {
      EXPECT_EQ(f["not_identified"],
                "stays at its prior; it takes two diameters of one tool, at places that "
                "yield differently");
    }
  }
  EXPECT_FALSE(result["documents"]["material"].contains("thrust"));
}

TEST(LearnFactors, WithoutADiameterNothingIsUpdated) {
  auto request = batch();
  json rows = json::array();
  for (const auto& row : request["rows"])
    if (row["characteristic"] == "r3") rows.push_back(row);
  request["rows"] = rows;
  const json result = learn(request, shop());
  EXPECT_TRUE(result["factors"].empty());
  EXPECT_TRUE(result["documents"].empty());
}

}  // namespace
}  // namespace turnwright::document::learn_factors_test
