#include "turnwright/document/acceptance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "../schema_check.hpp"
#include "../slips.hpp"
#include "turnwright/part/tolerance_kind.hpp"

namespace turnwright::document::acceptance_test {
namespace {

using nlohmann::json;

json from_file(const std::string& path) {
  std::ifstream in(std::string(TURNWRIGHT_SOURCE_DIR) + "/" + path);
  return json::parse(in);
}

bool valid_request(const json& d) {
  return SchemaCheck("acceptance.request.json").fault(d).empty();
}
bool valid_result(const json& d) {
  return SchemaCheck("acceptance.result.json").fault(d).empty();
}

json one(json request_case) {
  const json request{{"cases", json::array({std::move(request_case)})}};
  EXPECT_TRUE(valid_request(request)) << request;
  const json result = acceptance(request);
  EXPECT_TRUE(valid_result(result)) << result;
  EXPECT_EQ(result["cases"].size(), 1u);
  return result["cases"][0];
}

// Everything wrong with a request whose `cases` is one case, one problem per line.
std::string refused(const json& request) { return input_refusal(acceptance, request); }
std::string refused_case(const json& c) { return refused({{"cases", json::array({c})}}); }

// The specified example: 8 .. 22 um on 0 .. 16 um.
TEST(Acceptance, SpecifiedExample) {
  const json v = one(json::parse(
      R"({"id": "a", "tolerance": "diameter", "e_mm": [0.004, 0.011], "upper_mm": 0.016,
          "lower_mm": 0})"));
  EXPECT_EQ(v["id"], "a");
  EXPECT_EQ(v["accepted"], false);
  EXPECT_EQ(v["accepted_after_offset"], true);
  EXPECT_DOUBLE_EQ(v["offset_mm"], -0.0075);
  EXPECT_DOUBLE_EQ(v["offset_into_limits_mm"], -0.0035);
  EXPECT_EQ(v["published_verdict"], true);
  EXPECT_EQ(v["extremes_mm"], json({0.004, 0.011}));
  EXPECT_DOUBLE_EQ(v["measured_mm"], 0.014);
  EXPECT_DOUBLE_EQ(v["allowed_mm"], 0.016);
  EXPECT_NEAR(v["margin_mm"], -0.006, 1e-17);
  EXPECT_NEAR(v["margin_after_offset_mm"], 0.002, 1e-17);
  EXPECT_EQ(v["why"],
            "diameter deviates by +8.00 to +22.00 um, limits +0.00 to +16.00 um: 6.00 um "
            "outside; an offset of -3.50 um brings it inside");
}

TEST(Acceptance, ExamplesOfTheSchemaAreAnswered) {
  const auto schema = from_file("schemas/acceptance.request.json");
  for (const json& example : schema["examples"]) {
    EXPECT_TRUE(valid_request(example));
    EXPECT_TRUE(valid_result(acceptance(example)));
  }
}

TEST(Acceptance, EveryKindHasItsRow) {
  const json e{0.001, 0.009};
  for (const auto& kind : part::tolerance_kinds()) {
    json c{{"tolerance", kind.name}, {"e_mm", e}};
    if (kind.rule == part::ToleranceRule::size)
      c.update({{"upper_mm", 0.018}, {"lower_mm", 0.001}});
    else
      c["value_mm"] = 0.02;
    const json v = one(c);
    EXPECT_EQ(v["accepted"], true) << kind.name;
    EXPECT_FALSE(v.contains("id"));
  }
}

// A top between the breaks: 4 s (40 - s)/160000, 10 um high at s = 20.
TEST(Acceptance, PolynomialsUseTheLocalVariable) {
  const json v = one(json::parse(
      R"({"tolerance": "cylindricity", "value_mm": 0.0099, "e_mm":
          {"breaks_mm": [10, 50, 60], "coefficients": [[0, 0.001, -0.000025], [0]]}})"));
  EXPECT_EQ(v["accepted"], false);
  EXPECT_EQ(v["extremes_mm"][0], 0);
  EXPECT_NEAR(v["extremes_mm"][1], 0.01, 1e-17);
}

TEST(Acceptance, ALengthMayHaveBothFaces) {
  json c = json::parse(
      R"({"tolerance": "length", "upper_mm": 0.05, "lower_mm": -0.05, "e_mm":
          [[-0.03, 0.02], {"breaks_mm": [2, 20], "coefficients": [[-0.02, 0.0025]]}]})");
  EXPECT_NEAR(one(c)["extremes_mm"][0], -0.05, 1e-17);
  EXPECT_NEAR(one(c)["extremes_mm"][1], 0.045, 1e-17);
  EXPECT_EQ(one(c)["accepted"], true);
  c["e_mm"][0] = {-0.03, 0.03};
  EXPECT_EQ(one(c)["accepted"], false);
}

TEST(Acceptance, OptionalKeysReachTheVerdict) {
  json c{{"tolerance", "profile"}, {"e_mm", {0.0, 0.01}}, {"value_mm", 0.0101}};
  EXPECT_EQ(one(c)["accepted"], false);
  c["half_angle_deg"] = 60;  // 2 * 10 cos 60 = 10 um
  EXPECT_EQ(one(c)["accepted"], true);
  c = {{"tolerance", "total-radial-runout"}, {"e_mm", {0.0, 0.01}}, {"value_mm", 0.012}};
  EXPECT_EQ(one(c)["accepted"], true);
  c["machine_mm"] = 0.003;
  EXPECT_EQ(one(c)["accepted"], false);
  EXPECT_EQ(one(c)["accepted_after_offset"], false);
  EXPECT_EQ(one(c)["published_verdict"], true);
  c = {{"tolerance", "perpendicularity"}, {"e_mm", {0.0, 0.01}}, {"value_mm", 0.009}};
  EXPECT_EQ(one(c)["accepted"], false);
  c["controlled"] = "axis";
  EXPECT_EQ(one(c)["accepted"], true);
  c.erase("e_mm");
  EXPECT_EQ(one(c)["extremes_mm"], json({0.0, 0.0}));
  c = {{"tolerance", "diameter"},
       {"e_mm", {0.0, 0.005}},
       {"upper_mm", 0.01},
       {"lower_mm", -0.01},
       {"envelope", "bore"}};
  EXPECT_EQ(one(c)["accepted"], true);
  c["machine_mm"] = 0.004;
  EXPECT_EQ(one(c)["accepted"], true);
  c["envelope"] = "shaft";
  EXPECT_EQ(one(c)["accepted"], false);
  // points (0,0) (1,3) (4,4) um: 2 um with their places, 1 um equally spaced
  c = {
      {"tolerance", "straightness"}, {"e_mm", {0.0, 0.003, 0.004}}, {"value_mm", 0.0019}};
  EXPECT_EQ(one(c)["accepted"], true);
  c["z_mm"] = {0, 1, 4};
  EXPECT_EQ(one(c)["accepted"], false);
}

// A case's verdict is the same alone, first or last among others.
TEST(Acceptance, CasesDoNotTouchEachOther) {
  json cases = from_file("schemas/acceptance.request.json")["examples"][0]["cases"];
  const json together = acceptance({{"cases", cases}})["cases"];
  for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(one(cases[i]), together[i]);
  std::reverse(cases.begin(), cases.end());
  const json reversed = acceptance({{"cases", cases}})["cases"];
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(reversed[i], together[cases.size() - 1 - i]);
}

std::string kinds_in_words() {
  const auto& all = part::tolerance_kinds();
  std::string words;
  for (std::size_t k = 0; k < all.size(); ++k)
    words += (k == 0               ? ""
              : k + 1 < all.size() ? ", "
                                   : " or ") +
             ('"' + std::string(all[k].name) + '"');
  return words;
}

TEST(Acceptance, ListsEveryProblem) {
  EXPECT_EQ(
      refused(json::parse(
          R"({"cases": [
              {"tolerance": "diameter", "e_mm": [0.1, "x"], "value_mm": 1, "upper_mm": 0},
              {"tolerance": "flat", "e_mm": [0], "value_mm": 1},
              {"tolerance": "profile", "e_mm": [], "value_mm": 0, "half_angle_deg": 90},
              {"tolerance": "flatness", "e_mm": 3, "value_mm": 1, "machine_mm": 0.1},
              5],
              "case": 1})")),
      "acceptance: /cases/0/e_mm/1: got \"x\", expected a number from -1000 to 1000 mm\n"
      "acceptance: /cases/0/lower_mm: got nothing, expected a number from -1000 to 1000 "
      "mm\n"
      "acceptance: /cases/0/value_mm: got 1, expected no such key\n"
      "acceptance: /cases/1/tolerance: got \"flat\", expected " +
          kinds_in_words() +
          "\n"
          "acceptance: /cases/2/e_mm: got an empty list, expected a list of 1 to 100000 "
          "entries\n"
          "acceptance: /cases/2/value_mm: got 0, expected a number > 0 and <= 1000 mm\n"
          "acceptance: /cases/2/half_angle_deg: got 90, expected a number >= 0 and < 90 "
          "deg\n"
          "acceptance: /cases/3/e_mm: got 3, expected a list of samples or an object "
          "with "
          "breaks_mm and coefficients\n"
          "acceptance: /cases/3/machine_mm: got 0.1, expected no such key\n"
          "acceptance: /cases/4: got 5, expected an object\n"
          "acceptance: /case: got 1, expected no such key (did you mean \"cases\"?)");
}

TEST(Acceptance, RefusesPolynomialsThatAreNone) {
  const auto e = [](const char* text) {
    return refused_case(
        {{"tolerance", "flatness"}, {"value_mm", 1}, {"e_mm", json::parse(text)}});
  };
  const std::string at = "acceptance: /cases/0/e_mm/";
  EXPECT_EQ(e(R"({"breaks_mm": [0, 1, 1], "coefficients": [[1], [2]]})"),
            at + "breaks_mm: got [0,1,1], expected rising places");
  EXPECT_EQ(e(R"({"breaks_mm": [0, 1], "coefficients": [[1], [1], [1]]})"),
            at + "coefficients: got a list of 3 entries, expected one list for each "
                 "piece between "
                 "two breaks");
  EXPECT_EQ(e(R"({"breaks_mm": [0, 10, 20], "coefficients": [[0, 99, 1], [0]]})"),
            at + "coefficients: got a list of 2 entries, expected terms that add up to "
                 "1000 mm at "
                 "most");
  EXPECT_EQ(e(R"({"breaks_mm": [0, 1], "coefficients": [[]]})"),
            at + "coefficients/0: got an empty list, expected a list of 1 to 16 entries");
  EXPECT_EQ(e(R"({"breaks_mm": [0, 1]})"),
            at + "coefficients: got nothing, expected a list of 1 to 2000 entries");
  EXPECT_EQ(e(R"({"breaks_mm": [0, 1], "coefficients": [[1]], "z_mm": [1]})"),
            at + "z_mm: got [1], expected no such key");
}

TEST(Acceptance, RefusesLimitsAndPlacesThatDoNotFit) {
  EXPECT_EQ(
      refused_case(
          {{"tolerance", "length"}, {"e_mm", {0, 1}}, {"upper_mm", 1}, {"lower_mm", 1}}),
      "acceptance: /cases/0/lower_mm: got 1, expected less than upper_mm");
  const auto z = [](const json& e_mm, const json& z_mm) {
    return refused_case(
        {{"tolerance", "straightness"}, {"value_mm", 1}, {"e_mm", e_mm}, {"z_mm", z_mm}});
  };
  EXPECT_EQ(z({0, 1}, {0, 1, 2}),
            "acceptance: /cases/0/z_mm: got [0,1,2], expected as many places as e_mm "
            "has samples");
  EXPECT_EQ(z({0, 1}, {1, 0}),
            "acceptance: /cases/0/z_mm: got [1,0], expected places that do not fall");
  EXPECT_EQ(z(json::parse(R"({"breaks_mm": [0, 1], "coefficients": [[1]]})"), {1, 0}),
            "acceptance: /cases/0/z_mm: got [1,0], expected none beside breaks_mm");
  EXPECT_EQ(refused_case({{"tolerance", "cylindricity"}, {"value_mm", 1}}),
            "acceptance: /cases/0/e_mm: got nothing, expected a list of samples or a "
            "piecewise polynomial");
  EXPECT_EQ(refused(5), "acceptance: document: got 5, expected an object");
  EXPECT_EQ(refused(json::object()),
            "acceptance: /cases: got nothing, expected a list of 1 to 10000 entries");
}

TEST(Acceptance, TheSchemaRefusesWhatTheReaderRefuses) {
  for (const char* text :
       {R"({"tolerance": "diameter", "e_mm": [0], "value_mm": 1})",
        R"({"tolerance": "flatness", "e_mm": [0], "upper_mm": 1, "lower_mm": 0})",
        R"({"tolerance": "flat", "e_mm": [0], "value_mm": 1})",
        R"({"tolerance": "flatness", "e_mm": [], "value_mm": 1})",
        R"({"tolerance": "flatness", "e_mm": [0], "value_mm": 0})",
        R"({"tolerance": "profile", "e_mm": [0], "value_mm": 1, "half_angle_deg": 90})",
        R"({"tolerance": "flatness", "e_mm": {"breaks_mm": [0, 1]}, "value_mm": 1})",
        R"({"tolerance": "flatness", "e_mm": [0], "value_mm": 1, "valu_mm": 1})"}) {
    const json c = json::parse(text);
    EXPECT_FALSE(valid_request({{"cases", json::array({c})}})) << text;
    EXPECT_NE(refused_case(c), "") << text;
  }
}

// 2 .. 8 um of 0 .. 21 um leave S from -2 to 13 um; S is normal with mean 3 and sigma
// hypot(3, 2 * 2) = 5: P = Phi(2) - Phi(-1).
TEST(Budget, OfADiameter) {
  json c = json::parse(
      R"({"tolerance": "diameter", "e_mm": [0.001, 0.004], "upper_mm": 0.021, "lower_mm": 0,
          "budget": {"measurement_U_um": 1, "conformance": 0.8, "seed": 5, "draws": 200000,
            "sources": [{"name": "repeatability", "distribution": "normal", "value_um": 3},
              {"name": "setting", "distribution": "normal", "value_um": 2,
               "sensitivity": 2},
              {"name": "offset", "distribution": "fixed", "value_um": -3,
               "sensitivity": -1}]}})");
  const json b = one(c)["budget"];
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
  EXPECT_NEAR(b["room_um"][0], -2, 1e-11);
  EXPECT_NEAR(b["room_um"][1], 13, 1e-11);
  EXPECT_NEAR(b["worst_case_um"][0], 3 - 21, 1e-12);
  EXPECT_NEAR(b["worst_case_um"][1], 3 + 21, 1e-12);
  EXPECT_EQ(b["worst_case_fits"], false);
  EXPECT_NEAR(b["rss_um"][0], 3 - 15, 1e-12);
  EXPECT_NEAR(b["rss_um"][1], 3 + 15, 1e-12);
  EXPECT_EQ(b["rss_fits"], false);
  EXPECT_NEAR(b["mean_um"], 3, 1e-15);
  EXPECT_NEAR(b["sigma_um"], 5, 1e-15);
  EXPECT_EQ(b["shares"][1]["name"], "setting");
  EXPECT_NEAR(b["shares"][1]["variance_share"], 0.64, 1e-15);
  EXPECT_NEAR(b["shares"][1]["worst_case_um"], 12, 1e-15);
  EXPECT_EQ(b["shares"][2]["variance_share"], 0);
  const double P = below(2) - below(-1), accept = below(1.8) - below(-0.8);
  EXPECT_NEAR(b["P_conform"], P, 4 * std::sqrt(P * (1 - P) / 2e5));
  EXPECT_LT(b["P_interval"][0], P);
  EXPECT_GT(b["P_interval"][1], P);
  EXPECT_NEAR(b["P_accept"], accept, 4 * std::sqrt(accept * (1 - accept) / 2e5));
  EXPECT_NEAR(b["percentiles_um"]["p0_135"], 3 - 15, 0.4);
  EXPECT_NEAR(b["percentiles_um"]["p50"], 3, 0.06);
  EXPECT_NEAR(b["percentiles_um"]["p99_865"], 3 + 15, 0.4);
  EXPECT_NEAR(b["index"], 5.0 / 15, 0.02);
  EXPECT_EQ(b["decision"], "not-proven");  // 0.752 < 0.8 < 0.819
  c["budget"]["conformance"] = 0.7;
  EXPECT_EQ(one(c)["budget"]["decision"], "conforms");
  c["budget"]["conformance"] = 0.95;
  EXPECT_EQ(one(c)["budget"]["decision"], "does-not-conform");
}

TEST(Budget, OfAZoneHasNoLowerEnd) {
  const json b = one(json::parse(
      R"({"tolerance": "circular-radial-runout", "value_mm": 0.01, "machine_mm": 0.002,
          "budget": {"sources": [{"name": "chuck", "distribution": "fixed",
                                  "value_um": 5}]}})"))["budget"];
  EXPECT_TRUE(b["room_um"][0].is_null());
  EXPECT_NEAR(b["room_um"][1], 8, 1e-11);
  EXPECT_TRUE(b["index"].is_null());
  EXPECT_EQ(b["P_conform"], 1);
  EXPECT_EQ(b["decision"], "conforms");
}

TEST(Budget, IsTheSameEveryTimeAndOfNoOtherCase) {
  const json c = json::parse(
      R"({"tolerance": "flatness", "e_mm": [0, 0.004], "value_mm": 0.01, "budget":
          {"sources": [{"name": "a", "distribution": "rayleigh", "value_um": 3}]}})");
  json other = c;
  other["budget"]["seed"] = 2;
  const json both = acceptance({{"cases", {other, c}}});
  EXPECT_EQ(both["cases"][1], one(c));
  EXPECT_NE(both["cases"][0]["budget"]["P_conform"],
            both["cases"][1]["budget"]["P_conform"]);
  EXPECT_FALSE(one({{"tolerance", "flatness"}, {"e_mm", {0}}, {"value_mm", 1}})
                   .contains("budget"));
}

TEST(Budget, RefusesWhatIsNone) {
  const auto with = [](const char* budget) {
    return json{{"tolerance", "flatness"},
                {"e_mm", {0}},
                {"value_mm", 1},
                {"budget", json::parse(budget)}};
  };
  const auto message = [&](const char* budget) { return refused_case(with(budget)); };
  EXPECT_EQ(
      message("{}"),
      "acceptance: /cases/0/budget/sources: got nothing, expected a list of 1 to 100 "
      "entries");
  EXPECT_EQ(message(R"({"sources": [{"name": "a", "distribution": "normal",
                                     "value_um": -1}]})"),
            "acceptance: /cases/0/budget/sources/0/value_um: got -1, expected a number "
            "from 0 to 1000000 um");
  EXPECT_EQ(message(R"({"sources": [{"name": "a", "distribution": "fixed",
                                     "value_um": -1}]})"),
            "");
  for (const char* text :
       {R"({"sources": []})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": -1}]})",
        R"({"sources": [{"name": "a", "distribution": "gauss", "value_um": 1}]})",
        R"({"sources": [{"distribution": "normal", "value_um": 1}]})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": 1}],
            "conformance": 1.1})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": 1}],
            "measurement_U_um": -1})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": 1}],
            "seed": -1})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": 1}],
            "draws": 999})",
        R"({"sources": [{"name": "a", "distribution": "normal", "value_um": 1}],
            "drows": 1000})"}) {
    EXPECT_FALSE(valid_request({{"cases", json::array({with(text)})}})) << text;
    EXPECT_NE(message(text), "") << text;
  }
}

// Half a minute's work is the most one request may ask for.
TEST(Budget, RefusesTooMuchWork) {
  json budget{{"draws", 10'000'000}, {"sources", json::array()}};
  for (int i = 0; i < 100; ++i)
    budget["sources"].push_back(
        {{"name", "a"}, {"distribution", "fixed"}, {"value_um", 0}});
  const json c{
      {"tolerance", "flatness"}, {"e_mm", {0}}, {"value_mm", 1}, {"budget", budget}};
  const std::string expected =
      ", expected budgets of 1e9 draws times sources in all, three sources more for each "
      "budget to sort its draws";
  EXPECT_EQ(refused({{"cases", {c, c}}}),
            "acceptance: /cases: got a list of 2 entries" + expected);
  // Sorting alone takes longer.
  json small = c;
  small["budget"]["sources"] = {budget["sources"][0]};
  EXPECT_EQ(refused({{"cases", json::array_t(26, small)}}),
            "acceptance: /cases: got a list of 26 entries" + expected);
}

}  // namespace
}  // namespace turnwright::document::acceptance_test
