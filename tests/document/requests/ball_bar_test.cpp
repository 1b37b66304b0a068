#include "turnwright/document/ball_bar.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::ball_bar_test {
namespace {

using nlohmann::json;

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("ballbar.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("ballbar.result.json");
  EXPECT_EQ(request_schema().fault(request), "");
  json result = ball_bar(request);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) { return refusal(ball_bar, request); }

json example(std::size_t i) {
  return parse_file(source_path("schemas/ballbar.request.json"))["examples"][i];
}

TEST(BallBarDoor, WhatIsSimulatedIsFoundAgain) {
  json request = example(0);
  request["simulate"]["n"] = 72;
  const json trace = answered(request);
  const json found = answered({{"analyse",
                                {{"plane", "XY"},
                                 {"R_mm", 150},
                                 {"theta_rad", trace["theta_rad"]},
                                 {"ccw_mm", trace["ccw_mm"]},
                                 {"cw_mm", trace["cw_mm"]}}}});
  const json& fit = found["fit"];
  EXPECT_NEAR(fit["scale_u"], 3e-5, 1e-9);
  EXPECT_NEAR(fit["square_rad"], -1.2e-5, 1e-9);
  EXPECT_NEAR(fit["EUUb_mm"], -0.0012, 1e-7);
  EXPECT_NEAR(fit["EVU2_mm"], 0.0009, 1e-6);
  EXPECT_NEAR(fit["centre_u_mm"], -0.004, 1e-7);
  EXPECT_NEAR(found["derived"]["backlash_v_mm"], 0.004, 1e-6);
  EXPECT_NEAR(found["derived"]["straightness_v_of_u_mm"], 0.0009 * 2.25, 1e-6);
  EXPECT_NEAR(found["derived"]["scale_mismatch_ppm"], 50, 1e-2);
  EXPECT_EQ(found["confounded"].size(), 4u);
  EXPECT_GE(found["ranking"][0]["range_mm"], found["ranking"][1]["range_mm"]);
}

TEST(BallBarDoor, AngleByListByFirstAndByDefaultAreTheSame) {
  json request = example(1);
  const json first = answered(request);
  request["analyse"].erase("theta0_rad");  // pi/n there too
  const json standard = answered(request);
  EXPECT_NEAR(standard["fit"]["EUUb_mm"], first["fit"]["EUUb_mm"].get<double>(), 1e-12);
  for (int k = 0; k < 12; ++k)
    request["analyse"]["theta_rad"].push_back((2 * k + 1) * std::acos(-1.0) / 12);
  EXPECT_NEAR(answered(request)["fit"]["EUUb_mm"], first["fit"]["EUUb_mm"].get<double>(),
              1e-12);
}

TEST(BallBarDoor, TablesDeclareUnitAndSign) {
  json lists = example(1);
  lists["analyse"]["plane"] = "XY";
  lists["analyse"]["R_mm"] = 100;
  json table = example(2);
  const json expected = answered(lists), found = answered(table);
  EXPECT_NEAR(found["fit"]["EUUb_mm"], expected["fit"]["EUUb_mm"].get<double>(), 1e-9);
  EXPECT_NEAR(found["iso230_4"]["H_mm"], expected["iso230_4"]["H_mm"].get<double>(),
              1e-9);
  table["analyse"]["sign"] = "shorter-positive";
  EXPECT_NEAR(answered(table)["fit"]["EUUb_mm"],
              -expected["fit"]["EUUb_mm"].get<double>(), 1e-9);
}

TEST(BallBarDoor, TellsEveryFaultWithItsPlace) {
  const auto spoilt = [](std::size_t which, auto spoil) {
    json request = example(which);
    spoil(request);
    return refused(request);
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(spoilt(0, [](json& r) { r["simulate"]["n"] = 0; }), "/simulate/n");
  has(spoilt(0, [](json& r) { r["simulate"]["plane"] = "XZ"; }), "/simulate/plane");
  has(spoilt(0,
             [](json& r) {
               r["simulate"]["chain"] = "wfXYt";
               r["simulate"]["axes"].erase(2);
               r["simulate"]["plane"] = "YZ";
             }),
      "/simulate/plane: got \"YZ\", expected a plane of two axes of the chain, which has "
      "no Z");
  has(spoilt(1, [](json& r) { r["analyse"]["cw_mm"].erase(3); }),
      "/analyse/cw_mm: got a list of 11 entries, expected as many values as ccw_mm has");
  has(spoilt(1,
             [](json& r) {
               r["analyse"]["ccw_mm"] = {0.001};
               r["analyse"]["cw_mm"] = {0.001};
             }),
      "/analyse/ccw_mm: got [0.001], expected a list of 7 to 20000 entries");
  has(spoilt(1, [](json& r) { r["analyse"]["theta_rad"] = {1, 2, 3, 4, 5, 6, 7}; }),
      "/analyse/theta_rad: got a list of 7 entries, expected as many angles");
  has(spoilt(1, [](json& r) { r["analyse"]["ccw_mm"][4] = "NaN"; }),
      "/analyse/ccw_mm/4: got \"NaN\"");
  has(spoilt(2, [](json& r) { r["analyse"]["csv"][3] = "75,nan,1"; }),
      "/analyse/csv#line 4/feed_ccw: got \"nan\"");
  has(spoilt(2, [](json& r) { r["analyse"].erase("sign"); }),
      "/analyse/sign: got nothing");
  has(refused(json::object()), "either simulate or analyse");
  json both = example(0);
  both["analyse"] = example(1)["analyse"];
  has(refused(both), "either simulate or analyse");
}

TEST(BallBarDoor, AnglesThatTellTooLittleAreBeyondTheModel) {
  json request = example(1);
  request["analyse"].erase("theta0_rad");
  request["analyse"]["ccw_mm"] = std::vector<double>(8, 0.001);
  request["analyse"]["cw_mm"] = std::vector<double>(8, 0.001);
  EXPECT_THROW(ball_bar(request), ModelRangeError);
}

TEST(BallBarDoor, SchemaAndReaderAgreeOnEverySlip) {
  for (std::size_t i = 0; i < 3; ++i) {
    // Names of columns that a table lacks are beyond the schema.
    const auto beyond = [](const std::string& what) {
      return what.starts_with("/analyse/columns") || what.starts_with("/analyse/angle") ||
             what.starts_with("/analyse/csv") || what == "/simulate/axes = []";
    };
    EXPECT_GT(SlipsOf(request_schema(), refused, example(i), beyond).try_all(), 15);
  }
}

}  // namespace
}  // namespace turnwright::document::ball_bar_test
