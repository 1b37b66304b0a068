#include "turnwright/document/overhang.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document::overhang_test {
namespace {

using nlohmann::json;

const json& example(std::size_t i) {
  static const json kAll =
      parse_file(source_path("schemas/overhang.request.json")).at("examples");
  return kAll.at(i);
}

/// The first example along x alone, which takes less time.
json along_x() {
  json q = example(0);
  q["spindle"].erase(1);
  return q;
}

const Catalogue& files() {
  static const Catalogue kAll = load_catalogue(source_path(""));
  return kAll;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("overhang.request.json"),
      kResult("overhang.result.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = overhang(request, files());
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { overhang(r, files()); }, request);
}

TEST(Overhang, ExamplesAreAnswered) {
  for (std::size_t i = 0; i < 3; ++i) {
    const json result = answered(example(i));
    for (const json& o : result["overhangs"]) EXPECT_FALSE(o.contains("why")) << o;
  }
}

TEST(Overhang, LimitsAreThoseOfTheModesTold) {
  const json q = along_x(), r = answered(q);
  ASSERT_EQ(r["overhangs"].size(), 2u);
  for (const json& o : r["overhangs"]) {
    json cut = q["cut"];
    for (const json& tip : o["tip"])
      for (json mode : tip["modes"]) {
        mode["axis"] = tip["axis"];
        cut["modes"].push_back(mode);
      }
    const json chart = stability(cut, files());
    EXPECT_EQ(o["best"], chart["best"]);
    EXPECT_EQ(o["points"], chart["points"]);
    double least = 1e9;
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(o["limits"][i]["limit_mm"], chart["speeds"][i]["limit_mm"]);
      if (!o["limits"][i]["limit_mm"].is_null())
        least = std::min(least, o["limits"][i]["limit_mm"].get<double>());
    }
    EXPECT_EQ(o["least_mm"], least);
  }
  EXPECT_EQ(r["assumed"][0]["pointer"], "/cut/stability_margin");
}

TEST(Overhang, ALongerToolIsSofter) {
  const json r = answered(along_x())["overhangs"];
  EXPECT_GT(r[1]["tip"][0]["peak"]["receptance_mm_N"],
            r[0]["tip"][0]["peak"]["receptance_mm_N"]);
  EXPECT_LT(r[1]["least_mm"], r[0]["least_mm"]);
}

// The third mode, at 5046 Hz with 40 mm, is slightly above the band.
TEST(Overhang, ABandThatEndsBelowAModeIsExtended) {
  json q = along_x();
  q["overhangs_mm"] = {40};
  q["cut"] = {{"model", "milling"},  {"teeth", 2},
              {"Kt_MPa", 600},       {"Kn_MPa", 200},
              {"direction", "slot"}, {"points", {{{"n_rpm", 9000}, {"ap_mm", 0.1}}}}};
  const json near = answered(q)["overhangs"][0]["tip"][0];
  EXPECT_EQ(near["to_Hz"], 6250);
  q["to_Hz"] = 6500;
  const json far = answered(q)["overhangs"][0]["tip"][0];
  EXPECT_EQ(far["to_Hz"], 6500);
  ASSERT_EQ(near["modes"].size(), 3u);
  ASSERT_EQ(far["modes"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(near["modes"][i]["frequency_Hz"].get<double>() /
                    far["modes"][i]["frequency_Hz"].get<double>(),
                1, 1e-3);
  EXPECT_LE(near["relative_rest"], 0.01);
}

// On a spindle as stiff as a rock: 1.8751^2 sqrt(EI/rho A)/l^2, at the tip a quarter of the
// mass, half of the loss factor as damping.
TEST(Overhang, OnAStiffSpindleTheToolIsACantilever) {
  json q = example(1);
  q["spindle"][0]["modes"][0] = {
      {"frequency_Hz", 1e5}, {"damping_ratio", 0.05}, {"stiffness_N_mm", 1e12}};
  q["modes"] = 1;
  q["from_Hz"] = 900;
  q["to_Hz"] = 2600;
  q["lines"] = 2000;
  const json r = answered(q);
  const double rho = 7850e-12, A = M_PI / 4 * 625, E = 205000;
  const double I = M_PI / 64 * std::pow(25, 4);
  for (const json& o : r["overhangs"]) {
    const double l = o["overhang_mm"],
                 w = std::pow(1.87510406871196 / l, 2) * std::sqrt(E * I / (rho * A));
    const json& mode = o["tip"][0]["modes"][0];
    EXPECT_NEAR(mode["frequency_Hz"].get<double>() * 2 * M_PI / w, 1, 1e-4);
    EXPECT_NEAR(mode["stiffness_N_mm"].get<double>() / (w * w * rho * A * l / 4), 1,
                5e-3);
    EXPECT_NEAR(mode["damping_ratio"], 0.005, 1e-4);
    const json& response = o["tip"][0]["response"];
    ASSERT_EQ(response["frequency_Hz"].size(), 2000u);
    EXPECT_EQ(response["frequency_Hz"][0], 900);
    EXPECT_NEAR(response["frequency_Hz"][1999], 2600, 1e-9);
  }
  EXPECT_EQ(r["assumed"][0]["pointer"], "/spindle/0/pivot_mm");
}

TEST(Overhang, AFaceThatTiltsIsSofterAtTheTip) {
  json q = example(1);
  q["from_Hz"] = 250;
  q["to_Hz"] = 550;
  q["modes"] = 1;
  const auto peak = [](const json& r) {
    return r["overhangs"][0]["tip"][0]["peak"]["receptance_mm_N"].get<double>();
  };
  const double stiff = peak(answered(q));
  q["spindle"][0]["modes"][0]["pivot_mm"] = 100;
  const json r = answered(q);
  EXPECT_GT(peak(r), 2 * stiff);  // (1 + 100/100)^2 = 4 of a tool without mass
  EXPECT_TRUE(std::ranges::none_of(
      r["assumed"], [](const json& a) { return a["pointer"] == "/spindle/0/pivot_mm"; }));
}

TEST(Overhang, WithoutAModeInTheBandItIsSaid) {
  json q = example(1);
  q["from_Hz"] = 1;
  q["to_Hz"] = 20;
  q["response"] = false;
  const json r = answered(q);
  EXPECT_EQ(r["overhangs"][0]["tip"][0]["modes"], json::array());
  EXPECT_NE(r["overhangs"][0]["why"].get<std::string>().find("a band that holds"),
            std::string::npos);
  EXPECT_FALSE(r["overhangs"][0].contains("limits"));
}

TEST(Overhang, AllProblemsAtOnce) {
  json q = example(0);
  q["spindle"][1]["axis"] = "x";
  q["spindle"][0]["modes"][0]["pivot_mm"] = 0.5;
  q["spindle"][0]["pivot_mm"] = 3;
  q["holder"][0]["bore_mm"] = 45;
  q["tool"][0]["length_mm"] = 3;
  q["overhangs_mm"] = {40, 26};
  q["to_Hz"] = 100;
  q["cut"]["modes"] = json::array();
  EXPECT_EQ(refused(q),
            R"(overhang: /holder/0/bore_mm: got 45, expected a bore less than the diameter
overhang: /tool/0/length_mm: got 3, expected no such key
overhang: /overhangs_mm/1: got 26, expected more than the 26 mm of the tool's other segments
overhang: /to_Hz: got 100, expected a frequency above from_Hz
overhang: /cut/modes: got an empty list, expected no such key in the cut of an overhang
overhang: /spindle/0/modes/0/pivot_mm: got 0.5, expected at least 1 mm before or behind the face
overhang: /spindle/0/pivot_mm: got 3, expected no such key
overhang: /spindle/1/axis: got "x", expected an axis once)");
}

TEST(Overhang, ProblemsOfTheCutAreToldWithTheirPlace) {
  json q = example(0);
  q["cut"]["teeth"] = 0;
  q["cut"]["speeds_rpm"]["count"] = 6000;
  q["cut"].erase("feed_mm");
  EXPECT_EQ(refused(q),
            "overhang: /cut/teeth: got 0, expected a whole number from 1 to 100");
  q["cut"]["teeth"] = 2;
  EXPECT_EQ(
      refused(q),
      "overhang: /cut/speeds_rpm: got an object, expected at most 10000 speeds over "
      "all overhangs");
  q["cut"]["model"] = "power-law";
  EXPECT_EQ(refused(q).substr(0, 37), "overhang: /cut/model: got \"power-law\"");
}

TEST(Overhang, LeavesWhenNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(overhang(example(0), files(), stop.get_token()), Cancelled);
}

TEST(Overhang, SchemaAgreesWithTheReaderOnEverySlip) {
  const SchemaCheck schema("overhang.request.json");
  const auto refused_by_reader = refused;
  const auto of_the_table = [](const std::string& slip) {
    return slip.find("/frf/columns") != std::string::npos ||
           slip.find("/frf/csv/0 ") != std::string::npos ||
           slip.ends_with("/frf/unit left out");
  };
  for (std::size_t i = 0; i < 3; ++i) {
    json q = example(i);
    q["overhangs_mm"] = {q["overhangs_mm"][0]};
    q["lines"] = 50;
    if (q["cut"].contains("speeds_rpm")) q["cut"]["speeds_rpm"] = {9000};
    EXPECT_GT(SlipsOf(schema, refused_by_reader, q, of_the_table).try_all(), 40);
  }
}

}  // namespace
}  // namespace turnwright::document::overhang_test
