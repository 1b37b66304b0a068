#include "turnwright/document/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::geometry_test {
namespace {

using nlohmann::json;

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("geometry.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("geometry.result.json");
  EXPECT_EQ(request_schema().fault(request), "");
  json result = geometry(request);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) { return refusal(geometry, request); }

json example() {
  return parse_file(source_path("schemas/geometry.request.json"))["examples"][0];
}

TEST(Geometry, ReproducesTheReferenceChains) {
  const auto reference = parse_file(source_path("tests/data/volumetric_reference.json"));
  for (json chain : reference["chains"]) {
    json request{{"chain", chain["chain"]}, {"tool_point_mm", chain["tool_point"]}};
    for (json axis : chain["axes"]) {
      axis["p_mm"] = axis["p"];
      axis.erase("p");
      request["axes"].push_back(axis);
    }
    for (const json& p : chain["points"])
      request["points"].push_back({{"q", p["q"]}, {"sign", p["sign"]}});
    const json result = answered(request);
    ASSERT_EQ(result["points"].size(), chain["points"].size());
    for (std::size_t i = 0; i < chain["points"].size(); ++i) {
      const json &found = result["points"][i], &expected = chain["points"][i];
      for (const auto& [key, name] :
           {std::pair{"tip_nominal_mm", "tip_nominal"},
            {"tip_error_mm", "tip_error"},
            {"tip_error_first_order_mm", "tip_error_first_order"},
            {"direction_error_rad", "tooldir_error"}})
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(found[key][k], expected[name][k].get<double>(), 1e-10) << key;
    }
  }
}

TEST(Geometry, WhatIsLeftOutIsZero) {
  const json bare{{"chain", "wXft"},
                  {"tool_point_mm", {1, 2, 3}},
                  {"axes", {{{"name", "X"}}}},
                  {"points", json::array({json::object()})}};
  const json whole{
      {"chain", "wXft"},
      {"tool_point_mm", {1, 2, 3}},
      {"axes",
       {{{"name", "X"},
         {"p_mm", {0, 0, 0}},
         {"Q", 100},
         {"err", {{"EXX", {{"c", {0, 0, 0, 0}}, {"b", 0}, {"f", json::array()}}}}},
         {"sq", {{"EB0X", 0}, {"EC0X", 0}}},
         {"loc", json::object()}}}},
      {"points", {{{"q", {{"X", 0}}}, {"sign", {{"X", 0}}}}}}};
  EXPECT_EQ(answered(bare), answered(whole));
  EXPECT_EQ(answered(bare)["points"][0]["tip_nominal_mm"], json({1, 2, 3}));
}

TEST(Geometry, ErrorsMayBeReadings) {
  json request{{"chain", "wXft"}, {"tool_point_mm", {0, 0, 0}}};
  request["points"] = {{{"q", {{"X", 50}}}, {"sign", {{"X", 1}}}}};
  // 30 ppm and 2 um of lost motion, b = -1 um, of the table that X moves.
  const json table{{"q", {0, 100, 200}}, {"plus", {-1, 2, 5}}, {"minus", {1, 4, 7}},
                   {"unit", "um"},       {"degree", 1},        {"sign", "physical"}};
  request["axes"] = {{{"name", "X"}, {"err", {{"EXX", {{"table", table}}}}}}};
  EXPECT_NEAR(answered(request)["points"][0]["tip_error_mm"][0], -(0.0015 - 0.001),
              1e-12);
  json& given = request["axes"][0]["err"]["EXX"]["table"];
  given["sign"] = "tool-minus-workpiece";
  EXPECT_NEAR(answered(request)["points"][0]["tip_error_mm"][0], 0.0015 - 0.001, 1e-12);
  given["plus"].push_back(1);
  EXPECT_NE(refused(request).find("/axes/0/err/EXX/table/plus: got [-1,2,5,1], expected "
                                  "as many readings as q has positions"),
            std::string::npos)
      << refused(request);
  given.erase("plus");
  given.erase("degree");
  EXPECT_NE(refused(request).find("/table/q: got [0,100,200], expected 4 positions"),
            std::string::npos)
      << refused(request);
  given.erase("minus");
  EXPECT_NE(refused(request).find("plus, minus or both"), std::string::npos);
  given["minus"] = {1, 4, 7};
  given["unit"] = "urad";
  EXPECT_NE(refused(request).find("/table/unit"), std::string::npos);
}

TEST(Geometry, TellsEveryFaultWithItsPlace) {
  const auto spoilt = [](auto spoil) {
    json request = example();
    spoil(request);
    return refused(request);
  };
  EXPECT_NE(spoilt([](json& r) { r["chain"] = "wCfZZt"; })
                .find("/chain: got \"wCfZZt\", expected a chain such as wCfZXt: each "
                      "axis comes once"),
            std::string::npos);
  EXPECT_NE(spoilt([](json& r) { r["chain"] = "wCZXt"; }).find("one bed f"),
            std::string::npos);
  EXPECT_NE(spoilt([](json& r) {
              r["axes"][1]["name"] = "Y";
            }).find("/axes/1/name: got \"Y\", expected an axis of the chain wCfZXt"),
            std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["axes"].erase(1); })
          .find("/axes: got no axis Z, expected an entry for each axis of the chain "
                "wCfZXt"),
      std::string::npos);
  EXPECT_NE(spoilt([](json& r) {
              r["axes"].push_back(r["axes"][0]);
            }).find("/axes/3/name: got \"C\", expected each axis once"),
            std::string::npos);
  EXPECT_NE(spoilt([](json& r) { r["points"][0]["q"]["Y"] = 1; }).find("/points/0/q/Y"),
            std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["points"][1]["sign"]["X"] = 0.5; }).find("/points/1/sign/X"),
      std::string::npos);
  EXPECT_NE(spoilt([](json& r) {
              r["points"][1]["q"]["X"] = "NaN";
            }).find("/points/1/q/X: got \"NaN\""),
            std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["axes"][1]["err"]["EXX"] = json::object(); })
          .find("/axes/1/err/EXX: got an object, expected no such key (did you mean "
                "\"EXZ\"?)"),
      std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["axes"][1]["sq"]["EC0Z"] = 0; }).find("/axes/1/sq/EC0Z"),
      std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["axes"][2]["loc"]["EX0X"] = 0; }).find("/axes/2/loc/EX0X"),
      std::string::npos);
  EXPECT_NE(
      spoilt([](json& r) { r["axes"][0]["sq"]["EA0C"] = 0; }).find("/axes/0/sq/EA0C"),
      std::string::npos);
  EXPECT_NE(spoilt([](json& r) {
              r["axes"][1]["err"]["EZZ"]["f"] = {{1e-3, 0}};
            }).find("/axes/1/err/EZZ/f"),
            std::string::npos);
  EXPECT_NE(spoilt([](json& r) {
              r["axes"][1]["err"]["EZZ"]["c"].push_back(0);
            }).find("/axes/1/err/EZZ/c"),
            std::string::npos);
  const std::string two = spoilt([](json& r) {
    r["axes"][0]["Q"] = 0;
    r.erase("tool_point_mm");
  });
  EXPECT_NE(two.find("/axes/0/Q"), std::string::npos);
  EXPECT_NE(two.find("/tool_point_mm: got nothing"), std::string::npos);
  for (const json& nothing : {json(), json(3), json::array(), json::object()})
    EXPECT_NE(refused(nothing), "");
}

TEST(Geometry, SchemaAndReaderAgreeOnEverySlip) {
  // Which axes a chain needs, and each once, is beyond the schema.
  const auto beyond = [](const std::string& what) { return what == "/axes = []"; };
  EXPECT_GT(SlipsOf(request_schema(), refused, example(), beyond).try_all(), 60);
}

json lathe(const json& axis, const json& surfaces) {
  json axes = {{{"name", "X"}}, {{"name", "Z"}}, {{"name", "C"}}};
  for (json& one : axes)
    if (one["name"] == axis["name"]) one = axis;
  return {{"chain", "wCfZXt"},
          {"tool_point_mm", {0, 0, 0}},
          {"axes", axes},
          {"turned", surfaces}};
}

json surface(const char* id, json from, json to) {
  return {{"id", id}, {"from_mm", std::move(from)}, {"to_mm", std::move(to)}};
}

// The map from a lathe's errors to the parts it turns, each by hand.
TEST(GeometryTurned, ReproducesTheTurningMap) {
  constexpr double kUm = 1e-6;
  const json shaft = json::array({surface("d", {30, 0}, {30, 100})});
  const auto first = [](const json& request) { return answered(request)["turned"][0]; };
  json s =
      first(lathe({{"name", "X"}, {"err", {{"EXX", {{"c", {0, 3e-3, 0, 0}}}}}}}, shaft));
  EXPECT_NEAR(s["diameter_mm"], 1.80e-3, kUm);
  EXPECT_NEAR(s["profile_mm"], 1.80e-3, kUm);
  s = first(lathe({{"name", "Z"}, {"sq", {{"EB0Z", 20e-6}}}}, shaft));
  EXPECT_NEAR(s["taper_mm"], 4.0e-3, kUm);
  EXPECT_NEAR(s["cylindricity"]["minimum_zone_mm"], 2.0e-3, kUm);
  s = first(lathe({{"name", "Z"}, {"err", {{"EXZ", {{"c", {0, 0, 5e-3, 0}}}}}}},
                  json::array({surface("d", {30, 20}, {30, 120})})));
  EXPECT_NEAR(s["cylindricity"]["minimum_zone_mm"], 7.0e-3, kUm);
  s = first(
      lathe({{"name", "C"}, {"err", {{"EXC", {{"f", {{0, 0}, {1e-3, 0}}}}}}}}, shaft));
  EXPECT_NEAR(s["roundness"]["minimum_zone_mm"], 2.0e-3, kUm);
  s = first(lathe({{"name", "X"}, {"sq", {{"EB0X", 20e-6}}}},
                  json::array({surface("f", {30, 50}, {5, 50})})));
  EXPECT_NEAR(s["flatness"]["minimum_zone_mm"], 0.50e-3, kUm);
  EXPECT_NEAR(s["total_axial_runout_mm"], 0.50e-3, kUm);
}

TEST(GeometryTurned, MeasuresAgainstItsDatum) {
  json surfaces = {surface("left", {30, 10}, {5, 10}),
                   surface("right", {30, 90}, {5, 90})};
  surfaces[1]["datum"] = "left";
  const json scale = {{"name", "Z"}, {"err", {{"EZZ", {{"c", {0, 2e-3, 0, 0}}}}}}};
  const json faces = answered(lathe(scale, surfaces))["turned"];
  EXPECT_NEAR(faces[1]["length_mm"], 1.6e-3, 1e-7);
  EXPECT_NEAR(faces[1]["parallelism_mm"], 0, 1e-9);
  EXPECT_FALSE(faces[0].contains("length_mm"));
  const json once = {{"name", "C"}, {"err", {{"EXC", {{"f", {{1e-3, 0}}}}}}}};
  surfaces = {surface("d1", {30, 0}, {30, 40}), surface("d2", {20, 40}, {20, 80}),
              surface("d3", {20, 40}, {20, 80})};
  surfaces[2]["datum"] = "d1";
  const json shafts = answered(lathe(once, surfaces))["turned"];
  EXPECT_NEAR(shafts[1]["total_radial_runout_mm"], 2e-3, 1e-6);
  EXPECT_NEAR(shafts[2]["total_radial_runout_mm"], 0, 1e-6);
  // A bore's last approach is from inside: play has the other sign there.
  const json play = {{"name", "X"},
                     {"err", {{"EXX", {{"c", {0, 0, 0, 0}}, {"b", -1e-3}}}}}};
  surfaces = {surface("shaft", {30, 0}, {30, 40}), surface("bore", {20, 40}, {20, 0})};
  surfaces[1]["approach"] = {{"X", 1}};
  const json both = answered(lathe(play, surfaces))["turned"];
  EXPECT_NEAR(both[0]["diameter_mm"], 2e-3, 1e-8);
  EXPECT_NEAR(both[1]["diameter_mm"], -2e-3, 1e-8);
}

TEST(GeometryTurned, IsRefusedWithItsPlace) {
  json request = lathe({{"name", "X"}},
                       {surface("a", {30, 0}, {30, 0}), surface("a", {-1, 0}, {30, 9})});
  request["turned"][1]["datum"] = "b";
  request["turned"][1]["approach"] = {{"X", 0}};
  EXPECT_EQ(
      refused(request),
      "geometry: /turned/0/to_mm: got [30,0], expected another place than from_mm\n"
      "geometry: /turned/1/from_mm: got [-1,0], expected [r, z] with a radius of 0 mm or "
      "more\n"
      "geometry: /turned/1/approach/X: got 0, expected -1 or 1\n"
      "geometry: /turned/1/id: got \"a\", expected an id no other has\n"
      "geometry: /turned/1/datum: got \"b\", expected the id of a surface before");
  request = lathe({{"name", "X"}}, json::array({surface("a", {30, 0}, {30, 9})}));
  request["chain"] = "wfZXt";
  request["axes"].erase(2);
  EXPECT_EQ(refused(request),
            "geometry: /chain: got \"wfZXt\", expected a chain with X, Z and C for what "
            "is turned");
}

TEST(GeometryTurned, SlipsAreSeenBySchemaAndReader) {
  const json good = lathe(
      {{"name", "X"}}, {surface("a", {30, 0}, {30, 9}), surface("b", {30, 9}, {5, 9})});
  const auto names = [](const std::string& at) {
    return at.find("/name") != std::string::npos || at.rfind("/chain", 0) == 0 ||
           at == "/axes = []";
  };
  EXPECT_GT(SlipsOf(request_schema(), refused, good, names).try_all(), 20);
}

}  // namespace
}  // namespace turnwright::document::geometry_test
