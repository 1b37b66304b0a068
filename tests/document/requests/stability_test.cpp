#include "turnwright/document/stability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::stability_test {
namespace {

using nlohmann::json;

const json& example(std::size_t i) {
  static const json kAll =
      parse_file(source_path("schemas/stability.request.json")).at("examples");
  return kAll.at(i);
}

const Catalogue& files() {
  static const Catalogue kAll = load_catalogue(source_path(""));
  return kAll;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("stability.request.json"),
      kResult("stability.result.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = stability(request, files());
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { stability(r, files()); }, request);
}

TEST(Stability, TellsTheIsland) {
  const json r = answered(example(0));
  const json& crossings = r["speeds"][0]["crossings"];
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_EQ(crossings[0]["sense"], "loss");
  EXPECT_EQ(crossings[0]["kind"], "flip");
  EXPECT_EQ(crossings[1]["sense"], "regain");
  EXPECT_EQ(crossings[2]["kind"], "hopf");
  EXPECT_EQ(r["speeds"][0]["limit_mm"], crossings[0]["ap_mm"]);
  // A flip's frequency is an odd multiple of half the tooth frequency, 18000 2/60/2 Hz.
  EXPECT_NEAR(crossings[0]["frequency_Hz"], 900, 1e-9);
  EXPECT_EQ(r["points"][0]["stable"], true);
  EXPECT_EQ(r["points"][0]["unstable_multipliers"], 0);
  EXPECT_LT(r["points"][0]["spectral_radius"], 1);
}

TEST(Stability, ExamplesAreAnswered) {
  for (std::size_t i = 0; i < 13; ++i) answered(example(i));
}

TEST(Stability, SlotIsFullImmersionAndMassIsStiffness) {
  json slot = example(1);
  slot["ap_max_mm"] = 0.4;
  json down = slot;
  down["direction"] = "down";
  down["radial_immersion"] = 1;
  for (json* request : {&slot, &down}) request->erase("points");
  const double wn = 922 * 2 * M_PI;
  down["modes"][0].erase("mass_kg");
  down["modes"][0]["stiffness_N_mm"] = 0.03993 * wn * wn / 1000;
  const json a = answered(slot)["speeds"], b = answered(down)["speeds"];
  ASSERT_EQ(a.size(), 3u);
  EXPECT_EQ(a[1]["n_rpm"], 9000);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i]["limit_mm"].get<double>() / b[i]["limit_mm"].get<double>(), 1, 1e-9);
}

TEST(Stability, NoLossUpToTheDepthIsNull) {
  json q = example(0);
  q["ap_max_mm"] = 0.5;
  q["speeds_rpm"] = {18000, 17000};
  const json r = answered(q);
  EXPECT_TRUE(r["speeds"][0]["limit_mm"].is_null());
  EXPECT_EQ(r["speeds"][0]["crossings"], json::array());
  EXPECT_EQ(r["best"]["n_rpm"], 18000);
  EXPECT_EQ(r["best"]["limited_by"], "ap_max_mm");
}

TEST(Stability, MagicSpeedOfTheSlotCutter) {
  json q = example(2);
  q["speeds_rpm"] = {{"from", 17900}, {"to", 18800}, {"count", 10}};
  const json r = answered(q);
  ASSERT_EQ(r["magic_speeds"].size(), 1u);
  EXPECT_EQ(r["magic_speeds"][0]["n_rpm"], 18300);
}

TEST(Stability, TurningTellsTheAbsoluteLimitAndTheDampingAssumed) {
  const json r = answered(example(3));
  const double zeta = 0.03,
               least = 2 * 4000 * zeta * (1 + zeta) * std::tan(75 * M_PI / 180) / 900;
  EXPECT_NEAR(r["absolute_limit_mm"], least, 1e-12);
  EXPECT_EQ(r["assumed"][0]["pointer"], "/modes/0/damping_ratio");
  for (const json& speed : r["speeds"]) EXPECT_GE(speed["limit_mm"], least * (1 - 1e-8));
}

TEST(Stability, PointsComeBackInTheOrderAsked) {
  json q = example(0);
  q.erase("speeds_rpm");
  q.erase("ap_max_mm");
  q["points"] = {{{"n_rpm", 18000}, {"ap_mm", 2}},
                 {{"n_rpm", 5000}, {"ap_mm", 0}},
                 {{"n_rpm", 18000}, {"ap_mm", 3.5}}};
  const json r = answered(q);
  EXPECT_FALSE(r.contains("speeds"));
  ASSERT_EQ(r["points"].size(), 3u);
  EXPECT_EQ(r["points"][0]["stable"], false);
  EXPECT_EQ(r["points"][0]["unstable_multipliers"], 1);
  EXPECT_GT(r["points"][0]["spectral_radius"], 1);
  EXPECT_EQ(r["points"][1]["ap_mm"], 0);
  EXPECT_EQ(r["points"][2]["stable"], true);
}

TEST(Stability, OtherMethodsAnswerInTheSameForm) {
  const json tfea = answered(example(4));
  EXPECT_NEAR(tfea["speeds"][0]["limit_mm"], 56.03, 0.005);
  EXPECT_TRUE(tfea["speeds"][0]["crossings"][0]["relative_error"].is_null());
  const double radius = answered(example(0))["points"][0]["spectral_radius"];
  json finer = example(5);
  finer["intervals"] = 120;
  const json semi = answered(finer)["points"][0];
  EXPECT_EQ(semi["unstable_multipliers"], 0);
  EXPECT_NEAR(semi["spectral_radius"], radius, 3e-3);
  const json simulated = answered(example(6))["points"][0];
  EXPECT_TRUE(simulated["unstable_multipliers"].is_null());
  EXPECT_NEAR(simulated["spectral_radius"], radius, 1e-3);

  json q = example(5);
  q.erase("intervals");
  q["elements"] = 4;
  EXPECT_EQ(refused(q),
            "stability: /intervals: got nothing, expected a whole number from 1 to 200\n"
            "stability: /elements: got 4, expected no such key");
  q = example(6);
  q["points"] = json::array();
  for (int i = 0; i < 201; ++i) q["points"].push_back(example(6)["points"][0]);
  EXPECT_EQ(refused(q),
            "stability: /points: got a list of 201 entries, expected at most 200 with "
            "this method");
}

TEST(Stability, AllProblemsAtOnce) {
  json q = example(0);
  q["teeth"] = 0;
  q["Kt_MPa"] = -1;
  q["radial_immersion"] = 1.5;
  q["modes"][0]["damping_ratio"] = 0;
  q["modes"][0]["mass_kg"] = -0.1;
  q["modes"][0]["axsi"] = "x";
  q["speeds_rpm"] = {5000, 0};
  q["points"][0]["ap_mm"] = "deep";
  EXPECT_EQ(refused(q),
            R"(stability: /teeth: got 0, expected a whole number from 1 to 100
stability: /Kt_MPa: got -1, expected a number from 0.001 to 1000000 MPa
stability: /radial_immersion: got 1.5, expected a number from 1e-06 to 1
stability: /modes/0/damping_ratio: got 0, expected a number from 1e-06 to 10
stability: /modes/0/mass_kg: got -0.1, expected a number from 1e-09 to 1000000000 kg
stability: /modes/0/axsi: got "x", expected no such key (did you mean "axis"?)
stability: /speeds_rpm/1: got 0, expected a number from 1 to 1000000 1/min
stability: /points/0/ap_mm: got "deep", expected a number from 0 to 1000 mm)");
}

TEST(Stability, RefusesWhatDoesNotGoTogether) {
  json q = example(1);
  q["radial_immersion"] = 0.5;
  q["modes"][0]["stiffness_N_mm"] = 1000;
  q["modes"][1].erase("stiffness_N_mm");
  q["speeds_rpm"] = {{"from", 9000}, {"to", 8000}, {"count", 1000000}};
  q.erase("ap_max_mm");
  EXPECT_EQ(refused(q),
            R"(stability: /radial_immersion: got 0.5, expected 1 or none, for a slot
stability: /modes/0/mass_kg: got 0.03993, expected either mass_kg or stiffness_N_mm
stability: /modes/1/stiffness_N_mm: got nothing, expected stiffness_N_mm or mass_kg
stability: /speeds_rpm/to: got 8000, expected a speed not below from
stability: /speeds_rpm/count: got 1000000, expected a whole number from 1 to 10000
stability: /ap_max_mm: got nothing, expected a number > 0 and <= 1000 mm to search up to)");
  EXPECT_EQ(refused({{"model", "drilling"}}),
            "stability: /model: got \"drilling\", expected \"milling\", \"power-law\" or "
            "\"turning\"\n"
            "stability: /speeds_rpm: got nothing, expected speeds_rpm or points");
  EXPECT_EQ(refused(json::array()).substr(0, 58),
            "stability: document: got an empty list, expected an object");
}

TEST(Stability, CountsAtDepthsAgreeWithPoints) {
  json q = example(7);
  q.erase("uncertainty");
  for (const double n : {9000, 12000})
    for (int i = 1; i <= 12; ++i)
      q["points"].push_back({{"n_rpm", n}, {"ap_mm", 0.5 * i}});
  const json r = answered(q);
  ASSERT_EQ(r["depths_mm"].size(), 12u);
  EXPECT_EQ(r["depths_mm"][11], 6);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(r["speeds"][0]["unstable_multipliers"][i],
              r["points"][i]["unstable_multipliers"]);
    EXPECT_EQ(r["speeds"][3]["unstable_multipliers"][i],
              r["points"][12 + i]["unstable_multipliers"]);
  }
}

TEST(Stability, BestIsWithinTheMachinesSpeeds) {
  json q = example(7);
  q["uncertainty"]["samples"] = 2;
  q["machine_rpm"]["to"] = 25000;
  EXPECT_EQ(answered(q)["best"]["n_rpm"], 10000);
  q["machine_rpm"]["to"] = 9500;
  EXPECT_EQ(answered(q)["best"]["n_rpm"], 9000);
  q["machine_rpm"] = {{"from", 100}, {"to", 8999}};
  EXPECT_EQ(refused(q).substr(0, 25), "stability: /machine_rpm: ");
}

TEST(Stability, RobustLimitIsNoDeeperThanAnyOther) {
  const json r = answered(example(7));
  for (const json& speed : r["speeds"]) {
    const json& u = speed["uncertain"];
    EXPECT_LE(u["robust_mm"], speed["limit_mm"].get<double>() / 1.1 * (1 + 1e-9));
    EXPECT_LE(u["robust_mm"], u["p05_mm"]);
    EXPECT_LE(u["p05_mm"], u["p50_mm"]);
    EXPECT_LE(u["p50_mm"], u["p95_mm"]);
  }
  EXPECT_EQ(r, answered(example(7)));
}

TEST(Stability, RefusesTooManyCutsAndSearches) {
  json q = example(7);
  q["speeds_rpm"]["count"] = 10000;
  q["depths"] = 101;
  q["uncertainty"]["samples"] = 11;
  q["uncertainty"]["force"] = 1;
  EXPECT_EQ(
      refused(q),
      R"(stability: /depths: got 101, expected at most 1000000 depths over all speeds
stability: /uncertainty/force: got 1, expected a number from 0 to 0.9
stability: /uncertainty/samples: got 11, expected at most 100000 samples over all speeds)");
  q = example(7);
  q.erase("speeds_rpm");
  q.erase("machine_rpm");
  q["points"] = {{{"n_rpm", 9000}, {"ap_mm", 1}}};
  EXPECT_EQ(refused(q),
            "stability: /depths: got 12, expected no such key without speeds_rpm\n"
            "stability: /uncertainty: got an object, expected no such key without "
            "speeds_rpm");
}

// What a tooth removes in a revolution is fz ae per depth: with the specific force Kt that
// is the mean power, P = Kt fz ae z n ap, and the mean torque P/(2 pi n).
TEST(Stability, BestIsWithinThePowerAndTorqueOfTheMachine) {
  json q = example(16);
  q.erase("points");
  const double ae = 0.1 * 16, fz = 0.1;
  const auto power_kW = [&](const json& best) {
    return 600 * fz * ae * 2 * best["n_rpm"].get<double>() * best["ap_mm"].get<double>() /
           6e7;
  };
  json best = answered(q)["best"];
  EXPECT_EQ(best["limited_by"], "chatter");
  EXPECT_NEAR(best["power_kW"], power_kW(best), 1e-12);
  EXPECT_NEAR(best["power_kW"],
              best["torque_Nm"].get<double>() * best["n_rpm"].get<double>() / 9549.2966,
              1e-8);
  EXPECT_NEAR(best["removed_cm3_min"], power_kW(best) * 6e7 / 600 / 1000, 1e-9);
  EXPECT_EQ(best["margin_mm"],
            best["limit_mm"].get<double>() - best["ap_mm"].get<double>());
  q["machine_power_kW"] = 0.05;
  best = answered(q)["best"];
  EXPECT_EQ(best["limited_by"], "machine_power_kW");
  EXPECT_NEAR(power_kW(best), 0.05, 1e-12);
  q["machine_torque_Nm"] = 0.01;
  best = answered(q)["best"];
  EXPECT_EQ(best["limited_by"], "machine_torque_Nm");
  EXPECT_NEAR(best["torque_Nm"], 0.01, 1e-15);
  q["direction"] = "slot";
  q.erase("radial_immersion");
  EXPECT_NEAR(answered(q)["best"]["ap_mm"], 0.1 * best["ap_mm"].get<double>(), 1e-12);
  q.erase("feed_mm");
  q.erase("diameter_mm");
  EXPECT_EQ(refused(q),
            "stability: /feed_mm: got nothing, expected a feed per tooth, for the "
            "machine's power and torque\nstability: /diameter_mm: got nothing, expected "
            "a diameter, for the machine's power and torque");
  q = example(3);
  q["machine_power_kW"] = 1;
  EXPECT_EQ(refused(q), "stability: /machine_power_kW: got 1, expected no such key");
}

TEST(Stability, MarginsAreAssumedOrThoseOfTheRequest) {
  json q = example(16);
  q.erase("stability_margin");
  q.erase("speed_margin");
  const json r = answered(q);
  EXPECT_EQ(r["assumed"][0]["pointer"], "/stability_margin");
  EXPECT_EQ(r["assumed"][0]["value"], 0.2);
  EXPECT_EQ(r["assumed"][1]["pointer"], "/speed_margin");
  EXPECT_EQ(r["assumed"][1]["value"], 0.02);
  EXPECT_GT(r["best"]["limit_mm"].get<double>(), 1.2 * r["best"]["ap_mm"].get<double>());
  EXPECT_LT(r["best"]["stable_rpm"]["from"].get<double>(),
            0.98 * r["best"]["n_rpm"].get<double>());
  q["stability_margin"] = 0;
  q["speed_margin"] = 0;
  const json edge = answered(q);
  EXPECT_EQ(edge["assumed"], json::array());
  EXPECT_EQ(edge["best"]["margin_mm"], 0);
  EXPECT_EQ(edge["best"]["speeds_judged"], 1);
  q.erase("speeds_rpm");
  q.erase("machine_rpm");
  EXPECT_EQ(
      refused(q),
      "stability: /stability_margin: got 0, expected no such key without speeds_rpm\n"
      "stability: /speed_margin: got 0, expected no such key without speeds_rpm\n"
      "stability: /machine_power_kW: got 0.5, expected no such key without "
      "speeds_rpm\nstability: /machine_torque_Nm: got 2, expected no such key "
      "without speeds_rpm");
}

TEST(Stability, ACutThatChattersIsToldItsFrequencyAndItsCure) {
  json q = example(16);
  q["points"].push_back({{"n_rpm", 9200}, {"ap_mm", 1}});
  const json points = answered(q)["points"];
  EXPECT_EQ(points[0]["stable"], false);
  // A flip: an odd multiple of half the tooth frequency, 10000 2/60/2 Hz.
  EXPECT_NEAR(points[0]["chatter_Hz"], 5 * 10000.0 / 60, 1e-9);
  EXPECT_NEAR(points[0]["margin_mm"].get<double>() + 3,
              points[0]["limit_mm"].get<double>(), 1e-12);
  const json& cure = points[0]["cure"];
  EXPECT_GE(cure["limit_mm"].get<double>(), 1.1 * 3);
  json at_cure = q;
  at_cure["points"] = {{{"n_rpm", cure["n_rpm"]}, {"ap_mm", 3}}};
  const json cured = answered(at_cure)["points"][0];
  EXPECT_EQ(cured["stable"], true);
  EXPECT_NEAR(cured["margin_mm"], cure["margin_mm"], 1e-9);
  EXPECT_FALSE(cured.contains("cure"));
  EXPECT_EQ(points[1]["stable"], true);
  q["machine_rpm"] = {{"from", 9900}, {"to", 11500}};
  EXPECT_TRUE(answered(q)["points"][0]["cure"].is_null());
  q.erase("machine_rpm");
  for (const char* key : {"machine_power_kW", "machine_torque_Nm", "speeds_rpm",
                          "stability_margin", "speed_margin"})
    q.erase(key);
  EXPECT_FALSE(answered(q)["points"][0].contains("cure"));
  EXPECT_TRUE(answered(q)["points"][0].contains("chatter_Hz"));
  q.erase("ap_max_mm");
  EXPECT_FALSE(answered(q)["points"][0].contains("limit_mm"));
}

TEST(Stability, LimitsWithASwingingSpeedStandBesideThoseWithout) {
  json q = example(17);
  const json speeds = answered(q)["speeds"];
  for (const json& s : speeds) {
    ASSERT_EQ(s["varied"].size(), 2u);
    EXPECT_EQ(s["varied"][0]["rva"], 0.1);
    EXPECT_EQ(s["varied"][1]["rva"], 0.3);
  }
  q["speed_variation"]["rva"] = {0};
  q["ap_max_mm"] = 5;
  const json deeper = answered(q)["speeds"];
  for (const json& s : deeper)
    EXPECT_NEAR(s["varied"][0]["limit_mm"].get<double>() / s["limit_mm"].get<double>(), 1,
                1e-7);
  q["speeds_rpm"] = {1};
  q["ap_max_mm"] = 0.05;
  q["speed_variation"]["rva"] = {0.2};
  EXPECT_TRUE(answered(q)["speeds"][0]["varied"][0]["limit_mm"].is_null());
  q["ap_max_mm"] = 5;
  EXPECT_TRUE(answered(q)["speeds"][0]["varied"][0].contains("why"));
  q["speed_variation"] = {{"rva", {1}}, {"rvf", json::array()}};
  q["process_damping"] = {{"C_N_mm", 100}};
  q["diameter_mm"] = 60;
  EXPECT_EQ(
      refused(q),
      "stability: /speed_variation/rva/0: got 1, expected a number from 0 to 0.9\n"
      "stability: /speed_variation/rvf: got an empty list, expected a list of 1 to 20 "
      "entries\n"
      "stability: /process_damping: got an object, expected no such key with "
      "speed_variation");
}

// A key whose value changes nothing changes no limit.
TEST(Stability, EvenTeethAsPitchesAreThoseOfTheCutter) {
  json q = example(0);
  const json plain = answered(q);
  q["pitch_deg"] = {180, 180};
  q["feed_mm"] = 0.05;
  const json even = answered(q);
  const json &a = plain["speeds"][0]["crossings"], &b = even["speeds"][0]["crossings"];
  ASSERT_EQ(b.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i]["ap_mm"].get<double>() / b[i]["ap_mm"].get<double>(), 1, 1e-8);
  EXPECT_EQ(b[0]["kind"], "fold");  // -1 of a tooth is 1 of a revolution of two
  EXPECT_EQ(b[2]["kind"], "hopf");
  // No mode along y: the wall is where the path is.
  const json& walls = even["points"][0]["walls"];
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0]["milled"], "down");
  for (const json& left : walls[0]["left_mm"]) EXPECT_EQ(left, 0);
}

TEST(Stability, WallsOfAnUnstableCutAreNotTold) {
  json q = example(0);
  q["feed_mm"] = 0.05;
  q["points"][0]["ap_mm"] = 5;
  EXPECT_TRUE(answered(q)["points"][0]["walls"].is_null());
}

TEST(Stability, RefusesHalfToldCutters) {
  json q = example(8);
  q.erase("diameter_mm");
  q.erase("feed_mm");
  q["pitch_deg"] = {90, 90, 90, 80};
  q["runout_mm"] = {0, 0, 0};
  q["helix_deg"] = 90;
  q["method"] = "simulation";
  q["process_damping"] = {{"friction", -1}};
  EXPECT_EQ(refused(q),
            R"(stability: /helix_deg: got 90, expected a number from 0 to 80 deg
stability: /pitch_deg: got [90,90,90,80], expected angles that add up to 360 deg
stability: /runout_mm: got [0,0,0], expected a list of 4 entries
stability: /process_damping/C_N_mm: got nothing, expected a number from 0 to 1000000 N/mm
stability: /process_damping/friction: got -1, expected a number from 0 to 2
stability: /diameter_mm: got nothing, expected a diameter, for helix_deg and process_damping
stability: /method: got "simulation", expected no such key with helix_deg, pitch_deg, runout_mm or process_damping)");
  q = example(8);
  q.erase("feed_mm");
  EXPECT_EQ(refused(q),
            "stability: /feed_mm: got nothing, expected a feed per tooth, for runout_mm");
  q = example(2);
  q["helix_deg"] = 30;
  EXPECT_EQ(refused(q), "stability: /helix_deg: got 30, expected no such key");
}

json without(json request, const std::vector<std::string>& keys) {
  for (const auto& key : keys) request.erase(key);
  return request;
}

// The CSV of example 11 was written from these two modes, three decimals of m/s2/N.
TEST(Stability, FittedModesAreThoseOfTheResponse) {
  const json r = answered(example(11))["frf"][0];
  EXPECT_EQ(r["axis"], "x");
  EXPECT_EQ(r["lines"], 31);
  EXPECT_EQ(r["from_Hz"], 700);
  EXPECT_EQ(r["to_Hz"], 1300);
  ASSERT_EQ(r["modes"].size(), 2u);
  const double truth[2][3] = {{922, 0.03, 9000}, {1180, 0.025, 16000}};
  for (std::size_t i = 0; i < 2; ++i) {
    const json& mode = r["modes"][i];
    const char* keys[] = {"frequency_Hz", "damping_ratio", "stiffness_N_mm"};
    for (std::size_t k = 0; k < 3; ++k) {
      const double u = mode[std::string("u_") + keys[k]];
      EXPECT_NEAR(mode[keys[k]], truth[i][k], 4 * u);
      EXPECT_LT(u, 1e-2 * truth[i][k]);
    }
    const double wn = 2 * M_PI * mode["frequency_Hz"].get<double>();
    EXPECT_NEAR(mode["mass_kg"].get<double>() * wn * wn / 1000 /
                    mode["stiffness_N_mm"].get<double>(),
                1, 1e-12);
  }
  // Rounding to 0.001 m/s2/N: 0.001/sqrt(12) in each part, over the response's size.
  EXPECT_GT(r["explained"], 0.9999);
  EXPECT_LT(r["relative_rest"], 1e-3);
}

TEST(Stability, LimitsAreThoseOfTheFittedModes) {
  json asked = example(11);
  asked["ap_max_mm"] = 20;
  const json measured = answered(asked);
  json q = without(asked, {"frf"});
  for (const json& mode : measured["frf"][0]["modes"])
    q["modes"].push_back({{"axis", "x"},
                          {"frequency_Hz", mode["frequency_Hz"]},
                          {"damping_ratio", mode["damping_ratio"]},
                          {"stiffness_N_mm", mode["stiffness_N_mm"]}});
  const json given = answered(q);
  EXPECT_NEAR(given["speeds"][0]["limit_mm"].get<double>() /
                  measured["speeds"][0]["limit_mm"].get<double>(),
              1, 1e-9);
  EXPECT_FALSE(given.contains("frf"));
}

TEST(Stability, UnitOfTheResponseScalesIt) {
  json q = example(12);
  const json um = answered(q)["frf"][0]["modes"][0];
  EXPECT_NEAR(um["stiffness_N_mm"], 4000, 5);
  q["frf"][0]["unit"] = "m/N";
  EXPECT_NEAR(answered(q)["frf"][0]["modes"][0]["stiffness_N_mm"].get<double>() /
                  um["stiffness_N_mm"].get<double>(),
              1e-6, 1e-12);
  json g = example(11);
  g["frf"][0]["unit"] = "g/N";
  EXPECT_NEAR(
      answered(g)["frf"][0]["modes"][0]["stiffness_N_mm"].get<double>() * 9.80665 /
          answered(example(11))["frf"][0]["modes"][0]["stiffness_N_mm"].get<double>(),
      1, 1e-9);
}

TEST(Stability, TableAsOneTextIsTheSameResponse) {
  json q = example(12);
  std::string text = "# tap test\r\n";
  for (const json& line : q["frf"][0]["csv"]) text += line.get<std::string>() + "\r\n";
  const json as_lines = answered(q);
  q["frf"][0]["csv"] = text;
  EXPECT_EQ(answered(q), as_lines);
}

TEST(Stability, RefusesResponsesThatHoldNoMode) {
  const auto with = [](const json& change) {
    json q = example(12);
    q["frf"][0].update(change);
    return q;
  };
  json lines = example(12)["frf"][0]["csv"];
  EXPECT_EQ(refused(with({{"from_Hz", 170}, {"to_Hz", 180}})),
            "stability: /frf/0/csv: got 3 lines, expected at least 5 of the band, 3 for "
            "each mode and 2");
  EXPECT_EQ(refused(with({{"from_Hz", 200}, {"modes", 1}})),
            "stability: /frf/0/csv#line 20: got no peak, the nearest to one at 180 Hz, "
            "expected a mode among the lines, damped by less than 0.5");
  EXPECT_EQ(refused(with({{"from_Hz", 174}, {"to_Hz", 175}})).substr(0, 43),
            "stability: /frf/0/csv: got 1 line, expected");
  lines[5] = "142,0.5,x";
  lines[7] = "1;2;3";
  EXPECT_EQ(
      refused(with({{"csv", lines}, {"unit", "mm"}})),
      R"(stability: /frf/0/unit: got "mm", expected "mm/N", "um/N", "m/N", "mm/s/N", "m/s/N", "mm/s2/N", "m/s2/N", "g/N", "nm/N", "in/lbf", "mil/lbf", "in/s/lbf", "in/s2/lbf" or "g/lbf" (did you mean "mm/N"?)
stability: /frf/0/csv#line 6/imaginary: got "x", expected a number from -1000000000000 to 1000000000000
stability: /frf/0/csv#line 8: got 1 cells, expected 3 as in the header
stability: /frf/0/csv#line 6/frequency_Hz: got 142, expected more than 142 Hz of the line before)");
}

TEST(Stability, AResponseOfAnotherQuantityIsToldAtItsUnit) {
  json q = example(12);  // a receptance
  q["frf"][0]["unit"] = "mm/s/N";
  EXPECT_EQ(refused(q),
            "stability: /frf/0/unit: got the unit of a mobility, expected that of a "
            "receptance, whose modes explain these lines far better");
  q = example(11);
  q["frf"][0]["unit"] = "um/N";
  EXPECT_EQ(refused(q).substr(0, 61),
            "stability: /frf/0/unit: got the unit of a receptance, expecte");
}

TEST(Stability, DoubtfulResponsesComeWithAWarning) {
  EXPECT_EQ(answered(example(12))["warnings"], json::array());
  json q = example(12);
  q["frf"][0]["unit"] = "mm/N";  // of um/N
  const json r = answered(q)["warnings"];
  ASSERT_EQ(r.size(), 1u);
  EXPECT_EQ(r[0],
            "/frf/0/unit: the most compliant mode has a stiffness of 4, where a number "
            "from 100 to 1000000 N/mm is usual; is the unit right?");
  q = example(11);
  q["frf"][0]["modes"] = 1;  // of two
  const json one = answered(q);
  EXPECT_LT(one["frf"][0]["explained"], 0.9);
  ASSERT_EQ(one["warnings"].size(), 3u);
  EXPECT_EQ(one["warnings"][0].get<std::string>().substr(0, 25),
            "/frf/0: the modes explain");
  double most = 0;
  for (const json& mode : one["frf"][0]["hidden"])
    most = std::max(most, mode["share"].get<double>());
  EXPECT_GT(most, 0.1);  // the second one
  EXPECT_EQ(one["warnings"][1].get<std::string>().substr(0, 24),
            "/frf/0: up to the octave");
  EXPECT_EQ(one["warnings"][2].get<std::string>().substr(0, 17), "/frf/0: a pole at");
  ASSERT_EQ(one["frf"][0]["stabilisation"]["unfitted"].size(), 1u);
  EXPECT_LT(one["frf"][0]["stabilisation"]["unfitted"][0]["least_depth_with"], 1);
}

TEST(Stability, TheDiagramOfAResponseIsTold) {
  const json r = answered(example(11))["frf"][0];
  const json& diagram = r["stabilisation"];
  ASSERT_EQ(r["modes"].size(), 2u);
  for (const json& mode : r["modes"]) {
    const int from = mode["stable_from_order"], orders = mode["stable_orders"];
    const double f = mode["frequency_Hz"], zeta = mode["damping_ratio"];
    EXPECT_LE(from, 10);
    EXPECT_GT(std::abs(mode["least_depth_without"].get<double>() - 1), 0.05);
    int stable = 0;
    for (const json& pole : diagram["poles"])
      if (pole["stable"] == "all" &&
          std::abs(pole["frequency_Hz"].get<double>() / f - 1) < std::max(0.01, zeta / 2))
        ++stable;
    EXPECT_EQ(stable, orders);
  }
  EXPECT_EQ(diagram["unfitted"], json::array());
  EXPECT_EQ(diagram["orders"].get<std::size_t>(),
            std::min<std::size_t>(40, r["lines"].get<std::size_t>() / 3));
  EXPECT_EQ(diagram["curve"]["frequency_Hz"].size(),
            diagram["curve"]["magnitude"].size());
}

TEST(Stability, LinesThatDoNotCountAreTold) {
  json q = example(12);
  const std::size_t all = answered(q)["frf"][0]["lines"];
  EXPECT_EQ(answered(q)["frf"][0]["left_out"], 0);
  json& csv = q["frf"][0]["csv"];
  csv.insert(csv.begin() + 1, "0,0.25,0");
  json r = answered(q)["frf"][0];
  EXPECT_EQ(r["lines"], all);
  EXPECT_EQ(r["left_out"], 1);
  q["frf"][0]["to_Hz"] = 215;
  r = answered(q)["frf"][0];
  EXPECT_GT(r["left_out"], 1);
  EXPECT_EQ(r["lines"].get<std::size_t>() + r["left_out"].get<std::size_t>(), all + 1);
}

TEST(Stability, RefusesAResponseOfNegativeMass) {
  json q = example(12);
  for (json& line : q["frf"][0]["csv"]) {
    auto text = line.get<std::string>();
    for (std::size_t at = 0; (at = text.find(',', at)) != text.npos; ++at)
      if (text[at + 1] == '-')
        text.erase(at + 1, 1);
      else if (std::isdigit(text[at + 1]) != 0)
        text.insert(at + 1, "-");
    line = text;
  }
  EXPECT_EQ(
      refused(q),
      "stability: /frf/0/csv#line 14: got a mode of negative mass at 178 Hz, "
      "expected the receptance of a drive point under e^(+i w t): imaginary part < "
      "0 at a peak; is the unit that of the quantity measured, and is motion along the "
      "force counted as positive (else \"reversed\": true)?");
}

TEST(Stability, ModesResponsesAndCutterDoNotOverlap) {
  json q = example(11);
  q["frf"].push_back(q["frf"][0]);
  EXPECT_EQ(refused(q),
            "stability: /frf/1/axis: got \"x\", expected an axis without modes");
  EXPECT_EQ(refused(without(example(11), {"frf", "modes"})),
            "stability: /modes: got nothing, expected modes, frf or cutter");
  EXPECT_EQ(refused(without(example(12), {"frf"})),
            "stability: /modes: got nothing, expected modes or frf");
  q = example(12);
  q["modes"] = example(3)["modes"];
  EXPECT_EQ(refused(q).substr(0, 16), "stability: /frf:");
}

// kc of C45 at the mean chip, written out; kc1.1, mc and rake as the file has them.
TEST(Stability, MaterialAndCutterOfTheCatalogue) {
  const json r = answered(example(10));
  const json C45 = parse_file(source_path("materials/C45.json")),
             mill = parse_file(source_path("tools/milling/ENDMILL-HM-10.json"));
  const json& modes = mill["tool_point"]["modes"];
  ASSERT_EQ(r["modes"].size(), modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i)
    for (const auto& [key, value] : modes[i].items())
      if (value.is_number())
        EXPECT_NEAR(r["modes"][i][key], value, 1e-12 * value.get<double>());
      else
        EXPECT_EQ(r["modes"][i][key], value);
  const double hm = 0.05 * 2 * 0.3 / std::acos(1 - 2 * 0.3);
  EXPECT_NEAR(r["force"]["hm_mm"], hm, 1e-12);
  const double rake = mill["geometry"]["gamma_deg"].get<double>() -
                      C45["kienzle"]["rake_deg"].get<double>();
  const double Kt = C45["kienzle"]["kc11_MPa"].get<double>() *
                    std::pow(hm, -C45["kienzle"]["mc"].get<double>()) * (1 - rake / 100);
  EXPECT_NEAR(r["force"]["Kt_MPa"].get<double>() / Kt, 1, 1e-9);

  json q = without(example(10), {"material", "cutter", "feed_mm"});
  q["teeth"] = mill["geometry"]["zefp"];
  q["modes"] = r["modes"];
  q["Kt_MPa"] = r["force"]["Kt_MPa"];
  q["Kn_MPa"] = r["force"]["Kn_MPa"];
  const json given = answered(q);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(given["speeds"][i]["limit_mm"].get<double>() /
                    r["speeds"][i]["limit_mm"].get<double>(),
                1, 1e-9);
  EXPECT_TRUE(r["points"][0].contains("walls"));
  EXPECT_FALSE(given.contains("modes"));
}

TEST(Stability, MeasuredModesStandInForThoseOfTheCutter) {
  json q = example(10);
  q["modes"] = example(11)["modes"];
  const json r = answered(q);
  EXPECT_FALSE(r.contains("modes"));
  EXPECT_NE(r["speeds"], answered(example(10))["speeds"]);
}

TEST(Stability, RefusesWhatCatalogueIdsTell) {
  json q = example(10);
  q["teeth"] = 2;
  q["diameter_mm"] = 8;
  q["Kt_MPa"] = 600;
  q["cutter"] = "ENDMILL-HM-11";
  q["material"] = "C46";
  q.erase("feed_mm");
  EXPECT_EQ(refused(q),
            R"(stability: /teeth: got 2, expected no such key beside cutter
stability: /diameter_mm: got 8, expected no such key beside cutter
stability: /cutter: got "ENDMILL-HM-11", expected a milling cutter of the catalogue (did you mean "ENDMILL-HM-10"?)
stability: /Kt_MPa: got 600, expected no such key beside material
stability: /material: got "C46", expected a material of the catalogue (did you mean "C45"?)
stability: /feed_mm: got nothing, expected a number > 0 and <= 10 mm)");
  q = without(example(10), {"cutter"});
  q["teeth"] = 4;
  q["modes"] = example(11)["modes"];
  EXPECT_EQ(answered(q)["assumed"][0]["pointer"], "/cutter/geometry/gamma_deg");
}

TEST(Stability, EverySpeedAndPointIsTold) {
  std::vector<std::size_t> done;
  stability(example(7), {}, {}, [&](std::size_t now, std::size_t all) {
    done.push_back(now);
    EXPECT_EQ(all, 4u);
  });
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4}));
}

TEST(Stability, IsLeftSoonAfterAStopWasAskedFor) {
  std::stop_source source;
  source.request_stop();
  for (const std::size_t i : {0, 4, 5}) {
    EXPECT_THROW(stability(example(i), {}, source.get_token()), Cancelled);
    json points = example(i);
    points.erase("speeds_rpm");
    points.erase("ap_max_mm");
    points["points"] = {{{"n_rpm", 9000}, {"ap_mm", 1}}};
    EXPECT_THROW(stability(points, {}, source.get_token()), Cancelled);
  }
}

std::string out_of_range(const json& request) {
  try {
    stability(request);
  } catch (const ModelRangeError& e) {
    return e.what();
  }
  return "answered";
}

TEST(Stability, WhatTakesTooLongIsToldWithItsSpeed) {
  json q = example(0);
  q["speeds_rpm"] = {1};
  q["ap_max_mm"] = 1000;
  q.erase("points");
  EXPECT_EQ(out_of_range(q).substr(0, 37), "stability: /speeds_rpm/0: at 1 1/min:");
  q["speeds_rpm"] = {{"from", 1}, {"to", 1}, {"count", 1}};
  EXPECT_EQ(out_of_range(q).substr(0, 35), "stability: /speeds_rpm: at 1 1/min:");
}

TEST(Stability, ASpeedTooSlowDoesNotEndTheOthers) {
  json q = example(0);
  q["ap_max_mm"] = 1000;
  q["speeds_rpm"] = {1, 18000, 1, 17000};
  q["machine_rpm"] = {{"from", 1}, {"to", 100}};
  q.erase("points");
  const json r = answered(q);
  ASSERT_EQ(r["speeds"].size(), 2u);
  EXPECT_EQ(r["speeds"][0]["n_rpm"], 18000);
  EXPECT_EQ(r["speeds"][1]["n_rpm"], 17000);
  EXPECT_TRUE(r["best"].is_null());  // none of the machine's speeds is told
  ASSERT_EQ(r["undecided"].size(), 2u);
  EXPECT_EQ(r["undecided"][0]["pointer"], "/speeds_rpm/0");
  EXPECT_EQ(r["undecided"][1]["pointer"], "/speeds_rpm/2");
  EXPECT_EQ(r["undecided"][1]["why"], "not tried, as 1 1/min would take too long");
}

// At the crossings themselves, in both directions of stability.
TEST(Stability, APointOnALimitDoesNotEndTheOthers) {
  json q = example(0);
  const json crossings = answered(q)["speeds"][0]["crossings"];
  q.erase("speeds_rpm");
  q.erase("ap_max_mm");
  q["points"] = json::array();
  for (const json& at : crossings)
    for (const double by : {1.0, 1 + 1e-9})
      q["points"].push_back(
          {{"n_rpm", 18000}, {"ap_mm", at["ap_mm"].get<double>() * by}});
  const json r = answered(q);
  ASSERT_EQ(r["undecided"].size(), 3u);
  ASSERT_EQ(r["points"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(r["undecided"][i]["pointer"], "/points/" + std::to_string(2 * i));
    EXPECT_EQ(r["undecided"][i]["ap_mm"], crossings[i]["ap_mm"]);
    EXPECT_EQ(r["points"][i]["stable"], crossings[i]["sense"] == "regain");
  }
  q["points"] = {q["points"][2]};
  EXPECT_EQ(
      out_of_range(q),
      "stability: /points/0: at 18000 1/min: milling: a multiplier lies on the unit "
      "circle to within rounding, so the cut is on a limit of stability; ask for a "
      "slightly different speed or depth");
}

TEST(Stability, SpeedsOutOfBoundsAreToldWithTheirPlace) {
  json q = example(0);
  q["points"][0]["n_rpm"] = 0.001;
  q["speeds_rpm"] = {18000, 0.001};
  EXPECT_EQ(refused(q),
            "stability: /speeds_rpm/1: got 0.001, expected a number from 1 to 1000000 "
            "1/min\nstability: /points/0/n_rpm: got 0.001, expected a number from 1 to "
            "1000000 1/min");
}

}  // namespace
}  // namespace turnwright::document::stability_test
