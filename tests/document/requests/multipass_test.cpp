#include "turnwright/document/multipass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"

namespace turnwright::document::multipass_test {
namespace {

using nlohmann::json;

json answered(const json& request) {
  static const SchemaCheck kRequest("multipass.request.json");
  static const SchemaCheck kResult("multipass.result.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = multipass(request);
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) { return input_refusal(multipass, request); }

TEST(Multipass, AnswersTheLiterature) {
  const json r = answered(json::object());
  EXPECT_NEAR(r["UC"], 2.0350798, 1e-6);
  EXPECT_EQ(r["n"], 1);
  EXPECT_NEAR(r["rough"]["V"], 109.6631, 5e-5);
  EXPECT_NEAR(r["rough"]["F_kgf"], 200, 1e-6);
  EXPECT_NEAR(r["rough"]["T"], 45, 1e-6);
  EXPECT_NEAR(r["finish"]["T"], 25, 1e-6);
  EXPECT_EQ(r["certificate"]["kind"], "global");
  EXPECT_LE(r["certificate"]["lower_bound"], r["UC"]);
  EXPECT_LE(r["certificate"]["gap"], 1e-6);
  EXPECT_EQ(r["per_pass_count"].size(), 6u);
  EXPECT_EQ(r["per_pass_count"][0]["UC"], r["UC"]);
  EXPECT_TRUE(r["per_pass_count"][5]["UC"].is_null());
  const json& active = r["active"];
  for (const char* limit : {"rough:FU", "rough:T_max", "finish:T_min", "k4"})
    EXPECT_EQ(std::ranges::count(active, limit), 1) << limit << active;
  EXPECT_EQ(std::ranges::count(active, "rough:PU"), 0);
}

TEST(Multipass, EveryKeyCounts) {
  // Each value moved on its own moves the answer, or at least what it is held against.
  const json base = {{"dt_mm", 8}, {"theta", 0.6}};
  const json plain = answered(base);
  const json moved = {
      {"D_mm", 60},     {"L_mm", 200},     {"dt_mm", 7},    {"cost", "physical"},
      {"V", {50, 140}}, {"f", {0.1, 0.6}}, {"d", {1, 2.5}}, {"T", {30, 40}},
      {"k0", 0.6},      {"kt", 2},         {"h1", 1e-3},    {"h2", 0.4},
      {"tc", 1},        {"te", 2},         {"p", 4.9},      {"q", 1.7},
      {"r", 0.8},       {"C0", 5e11},      {"kf", 110},     {"mu", 0.7},
      {"nu", 0.9},      {"eta", 0.5},      {"FU", 180},     {"PU", 3},
      {"lambda", 1.2},  {"nu2", -4},       {"SC", 9000},    {"kq", 150},
      {"tau", 0.5},     {"phi", 0},        {"delta", 0.3},  {"QU", 850},
      {"R_mm", 0.4},    {"SRu_um", 4},     {"k3", 1.8},     {"k4", 3},
      {"k5", 1.2},      {"theta", 0.2},    {"VrU", 100},    {"n_max", 3}};
  for (const auto& [key, value] : moved.items()) {
    json request = base;
    request[key] = value;
    const json r = answered(request);
    EXPECT_NE(r["per_pass_count"], plain["per_pass_count"]) << key;
  }
}

TEST(Multipass, ExamplesOfTheSchemaAreAnswered) {
  const auto schema = parse_file(source_path("schemas/multipass.request.json"));
  for (const json& example : schema.at("examples"))
    EXPECT_EQ(answered(example)["status"], "ok") << example;
}

TEST(Multipass, InfeasibleIsAnAnswer) {
  const json r = answered({{"dt_mm", 30}});
  EXPECT_EQ(r["status"], "infeasible");
  EXPECT_TRUE(r["UC"].is_null());
  EXPECT_EQ(r["conflicts"], json({"rough:d_max", "finish:d_max", "n_max"}));
  EXPECT_EQ(r["relax"][2], json({{"limit", "n_max"}, {"now", 6.0}, {"needed", 9.0}}));
  EXPECT_EQ(answered({{"n_max", 9}, {"dt_mm", 30}})["status"], "ok");

  json ermer = parse_file(source_path("schemas/multipass.request.json"))["examples"][2];
  ermer["single_pass"]["limits"][0]["at_most"] = 1e-6;
  EXPECT_EQ(answered(ermer)["conflicts"], json({"V_min", "f_min", "power"}));
}

TEST(Multipass, ErmersSinglePass) {
  json ermer = parse_file(source_path("schemas/multipass.request.json"))["examples"][2];
  json r = answered(ermer);
  EXPECT_NEAR(r["UC"], 1.05451, 5e-6);
  EXPECT_NEAR(r["V"], 290.10, 5e-3);
  EXPECT_EQ(r["active"], json({"f_max", "power"}));
  ermer["single_pass"].erase("limits");
  r = answered(ermer);
  EXPECT_NEAR(r["UC"], 1.03782, 5e-6);
  EXPECT_NEAR(r["V"], 322.89, 5e-3);
}

TEST(Multipass, ListsAllThatIsWrong) {
  EXPECT_EQ(refused({{"dt_mm", -6},
                     {"V", {500, 50}},
                     {"T", {25}},
                     {"cost", "literall"},
                     {"theta", 1.5},
                     {"eta", 0},
                     {"n_max", 2.5},
                     {"k4", "2"},
                     {"FUU", 3}}),
            R"(multipass: /cost: got "literall", expected "literal" or "physical"
multipass: /dt_mm: got -6, expected a number > 0 and <= 1000000 mm
multipass: /eta: got 0, expected a number > 0 and <= 1
multipass: /k4: got "2", expected a number from 0 to 1000000
multipass: /theta: got 1.5, expected a number from 0 to 1
multipass: /V: got [500,50], expected [lower, upper] with lower <= upper
multipass: /T: got [25], expected a list of 2 entries
multipass: /n_max: got 2.5, expected a whole number from 1 to 100
multipass: /FUU: got 3, expected no such key (did you mean "FU"?))");
  EXPECT_EQ(refused({{"k0", 0}, {"kt", 0}}),
            R"(multipass: document: got an object, expected k0 or kt above 0)");
  EXPECT_EQ(refused(json::array()),
            R"(multipass: document: got an empty list, expected an object)");
  EXPECT_EQ(
      refused({{"dt_mm", 6}, {"single_pass", json::object()}}),
      R"(multipass: /single_pass/cost: got nothing, expected a list of 1 to 20 entries
multipass: /single_pass/V: got nothing, expected a list of 2 entries
multipass: /single_pass/f: got nothing, expected a list of 2 entries
multipass: /dt_mm: got 6, expected no such key)");
  EXPECT_EQ(
      refused({{"single_pass",
                {{"cost", json::array()},
                 {"V", {1, 2}},
                 {"f", {1, 2}},
                 {"limits",
                  {{{"name", "V_max"}, {"c", 0}, {"at_most", 1}},
                   {{"name", "a"}, {"c", 1}, {"at_most", 1}, {"at_least", 1}},
                   {{"name", "b"}, {"c", 1}, {"V", 99}, {"atmost", 1}}}}}}}),
      R"(multipass: /single_pass/cost: got an empty list, expected a list of 1 to 20 entries
multipass: /single_pass/limits/0/name: got "V_max", expected each name once, none of V_min, V_max, f_min, f_max
multipass: /single_pass/limits/0/c: got 0, expected a number > 0 and <= 1e+30
multipass: /single_pass/limits/1/at_least: got 1, expected either at_most or at_least
multipass: /single_pass/limits/2/V: got 99, expected a number from -20 to 20
multipass: /single_pass/limits/2/at_most: got nothing, expected a number > 0 and <= 1e+30
multipass: /single_pass/limits/2/atmost: got 1, expected no such key (did you mean "at_most"?))");
}

}  // namespace
}  // namespace turnwright::document::multipass_test
