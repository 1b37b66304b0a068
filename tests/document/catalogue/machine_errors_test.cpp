#include <gtest/gtest.h>

#include <string>

#include "../slips.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "document/json/file.hpp"
#include "planning/budget/machine_share.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/document/ball_bar.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/geometry.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/document/samba.hpp"
#include "turnwright/volumetric/samba.hpp"

// The member "errors" of a machine's document.
namespace turnwright::document::machine_errors_test {
namespace {

using nlohmann::json;

json worn() { return parse_file(source_path("machines/lathe-worn.json")); }
json medium() { return parse_file(source_path("machines/lathe-medium.json")); }

catalogue::Lathe read(const json& machine) {
  Problems problems{.document = "lathe"};
  auto lathe = read_lathe(Reader(machine, problems));
  problems.throw_if_any();
  return lathe;
}

std::string refused(const json& machine) { return refusal(read, machine); }

const catalogue::Axis& axis(const std::vector<catalogue::Axis>& axes, char name) {
  for (const auto& a : axes)
    if (a.name == name) return a;
  throw std::out_of_range("axis");
}

TEST(MachineErrors, EveryFieldComesFromItsKey) {
  const auto lathe = read(worn());
  ASSERT_TRUE(lathe.errors);
  const auto& g = *lathe.errors;
  EXPECT_EQ(g.chain.chain, "wCfZXt");
  EXPECT_EQ(g.jaws_z_mm, 150);
  EXPECT_EQ(g.relative_u, 0.1);
  EXPECT_EQ(axis(g.chain.axes, 'Z').location[4], 1.2e-5);
  EXPECT_EQ(axis(g.chain.axes, 'X').errors[0].c[1], 0.0015);
  EXPECT_EQ(axis(g.chain.axes, 'C').errors[0].f.size(), 3u);
  EXPECT_EQ(axis(g.u, 'Z').location[4], 1.5e-6);
  EXPECT_EQ(axis(g.u, 'X').errors[0].b, 0.0002);
  EXPECT_FALSE(read(medium()).errors);
}

TEST(MachineErrors, WhatGeometryTakesIsTaken) {
  json bare = medium();
  bare["errors"] = {{"chain", "wCfZXt"},
                    {"axes", {{{"name", "C"}}, {{"name", "Z"}}, {{"name", "X"}}}}};
  EXPECT_EQ(refused(bare), "");
  EXPECT_EQ(SchemaCheck("lathe.json").fault(bare), "");
  EXPECT_EQ(SchemaCheck("lathe.json").fault(worn()), "");
}

// A laser's table is fitted while the document is read.
TEST(MachineErrors, TablesOfALaserAreFitted) {
  json m = medium();
  m["errors"] = {{"chain", "wCfZXt"},
                 {"axes",
                  {{{"name", "C"}},
                   {{"name", "Z"}},
                   {{"name", "X"},
                    {"err",
                     {{"EXX",
                       {{"table",
                         {{"q", {0, 50, 100, 150}},
                          {"plus", {1, 2, 3, 4}},
                          {"minus", {3, 4, 5, 6}},
                          {"unit", "um"},
                          {"sign", "physical"},
                          {"degree", 1}}}}}}}}}}};
  const auto machine = read(m);
  const auto& e = axis(machine.errors->chain.axes, 'X').errors[0];
  EXPECT_NEAR(e.c[0], 2e-3, 1e-12);
  EXPECT_NEAR(e.c[1], 2e-3, 1e-12);
  EXPECT_NEAR(e.b, -1e-3, 1e-12);
  // Scatter becomes uncertainty, but where the document states its own.
  json& X = m["errors"]["axes"][2];
  X["err"]["EXX"]["table"]["plus"] = {1, 2.2, 3, 4};
  EXPECT_GT(axis(read(m).errors->u, 'X').errors[0].c[1], 1e-5);
  m["errors"]["u"] = {{{"name", "X"}, {"err", {{"EXX", {{"b", 7e-4}}}}}}};
  EXPECT_EQ(axis(read(m).errors->u, 'X').errors[0].c[1], 0);
  EXPECT_EQ(axis(read(m).errors->u, 'X').errors[0].b, 7e-4);
  // Positions too near each other tell no polynomial.
  X["err"]["EXX"]["table"]["q"] = {0, 1e-9, 2e-9, 3e-9};
  EXPECT_EQ(refused(m),
            "lathe: /errors/axes/2/err/EXX/table: got a fit out of bounds, expected "
            "positions so far apart that each coefficient is a number from -1000 to 1000 "
            "mm");
  X["err"]["EXX"]["table"]["q"] = {0, 1e-300, 2e-300, 3e-300};
  EXPECT_NE(refused(m).find("a fit out of bounds"), std::string::npos);
}

TEST(MachineErrors, AreRefusedWithTheirPlace) {
  json m = worn();
  m["errors"]["chain"] = "wfZXt";
  m["errors"]["axes"].erase(0);
  EXPECT_EQ(refused(m),
            "lathe: /errors/chain: got \"wfZXt\", expected a lathe's chain, with X, Z "
            "and C, such as wCfZXt");
  m = worn();
  m["errors"]["axes"].erase(2);
  EXPECT_EQ(refused(m),
            "lathe: /errors/axes: got no axis X, expected an entry for each axis of the "
            "chain wCfZXt");
  m = worn();
  m["errors"]["u"][0]["sq"]["EB0Z"] = -1e-6;
  m["errors"]["u"][1]["name"] = "Y";
  m["errors"]["uncertainty_pct"] = 101;
  m["errors"]["jaws_z_m"] = 0.15;
  const std::string all = refused(m);
  for (const char* told :
       {"/errors/u/0/sq/EB0Z: got -1e-06, expected a number from 0 to 10 rad",
        "/errors/u/1/name: got \"Y\", expected an axis of the chain wCfZXt",
        "/errors/uncertainty_pct: got 101, expected a number from 0 to 100 %",
        "/errors/jaws_z_m: "})
    EXPECT_NE(all.find(told), std::string::npos) << told << "\n" << all;
}

// A part with its machine inline tells the place in the part's document.
TEST(MachineErrors, OfAnInlineMachineAreToldInThePart) {
  json part = parse_file(source_path("parts/bearing-seat.json"));
  part["machine"] = worn();
  part["machine"]["errors"]["axes"][1]["sq"]["EB0Z"] = "steep";
  part["machine"]["errors"]["u"][1]["err"]["EXX"]["table"] = json::object();
  const auto load = [](const json& p) {
    load_part_plan(p, load_catalogue(source_path("")), "part");
  };
  const std::string all = refusal(load, part);
  for (const char* told :
       {"part: /machine/errors/axes/1/sq/EB0Z: got \"steep\", expected ",
        "part: /machine/errors/u/1/err/EXX/table: "})
    EXPECT_NE(all.find(told), std::string::npos) << told << "\n" << all;
}

TEST(MachineErrors, SlipsAreSeenBySchemaAndReader) {
  json m = worn();
  const SchemaCheck schema("lathe.json");
  const auto outside = [](const std::string& pointer) {
    return pointer.rfind("/errors", 0) != 0 ||          // the rest has its own test
           pointer.find("/name") != std::string::npos;  // names axes of the chain
  };
  EXPECT_GT(SlipsOf(schema, refused, m, outside).try_all(), 100);
}

json simulated(const json& errors, const char* plane, const json& centre_mm = {0, 0, 0}) {
  json request = {{"simulate",
                   {{"chain", errors["chain"]},
                    {"axes", errors["axes"]},
                    {"plane", plane},
                    {"R_mm", 100},
                    {"centre_mm", centre_mm},
                    {"n", 72}}}};
  const json trace = ball_bar(request);
  return {{"analyse",
           {{"plane", plane},
            {"R_mm", 100},
            {"centre_mm", centre_mm},
            {"theta_rad", trace["theta_rad"]},
            {"ccw_mm", trace["ccw_mm"]},
            {"cw_mm", trace["cw_mm"]}}}};
}

// A lathe's circle in ZX, saved into the lathe's document and read by a plan.
TEST(Calibration, OfABallBarIsSavedAsAMachineThatPlanReads) {
  const json errors = {
      {"chain", "wCfZXt"},
      {"axes",
       {{{"name", "C"}},
        {{"name", "Z"},
         {"sq", {{"EB0Z", 2e-5}}},
         {"err",
          {{"EZZ", {{"c", {0, 1e-3, 0, 0}}, {"b", -1e-3}}},
           {"EXZ", {{"c", {0, 0, 5e-4, 0}}, {"b", 3e-4}}}}}},
        {{"name", "X"}, {"err", {{"EXX", {{"c", {0, 3e-3, 0, 0}}, {"b", -2e-3}}}}}}}}};
  json request = simulated(errors, "ZX");
  request["machine"] = medium();
  const json saved = ball_bar(request)["machine"];
  EXPECT_EQ(SchemaCheck("lathe.json").fault(saved), "");
  const auto g = *read(saved).errors;
  const auto &Z = axis(g.chain.axes, 'Z'), &X = axis(g.chain.axes, 'X');
  EXPECT_NEAR(Z.location[4], 2e-5, 1e-9);
  EXPECT_NEAR(Z.errors[2].c[1], 1e-3, 1e-7);
  EXPECT_NEAR(Z.errors[2].b, -1e-3, 1e-7);
  EXPECT_NEAR(Z.errors[0].c[2], 5e-4, 1e-7);
  EXPECT_NEAR(Z.errors[0].b, 3e-4, 1e-7);
  EXPECT_NEAR(X.errors[0].c[1], 3e-3, 1e-7);
  EXPECT_NEAR(X.errors[0].b, -2e-3, 1e-7);
  EXPECT_GT(axis(g.u, 'X').errors[0].c[1], 0);

  json part = parse_file(source_path("parts/bearing-seat.json"));
  part["machine"] = saved;
  const auto plan = prepared_part(part, load_catalogue(source_path("")), "part").part;
  ASSERT_EQ(plan.drawing.tolerances[0].id, "t1");  // cylindricity over 80 mm
  const auto take = planning::machine_take(plan, 0, 0, planning::Clamping::chuck);
  // Taper and bow alike from z = 5 to 85 mm: 20 urad z and 0.5 um (z/100 mm)^2.
  EXPECT_NEAR(take.fixed_um, 20e-3 * 80 + 0.5 * (0.85 * 0.85 - 0.05 * 0.05), 1e-3);
}

// On the workpiece's side the physical error is the negative of the relative one.
TEST(Calibration, KnowsTheSideOfEachAxis) {
  const json errors = {
      {"chain", "wCZfXt"},
      {"axes",
       {{{"name", "C"}},
        {{"name", "Z"}, {"err", {{"EZZ", {{"c", {0, 1e-3, 0, 0}}, {"b", -1e-3}}}}}},
        {{"name", "X"}, {"sq", {{"EB0X", -1e-5}}}}}}};
  json request = simulated(errors, "ZX");
  request["machine"] = medium();
  request["machine"]["errors"] = errors;
  request["machine"]["errors"]["axes"][1].erase("err");
  request["machine"]["errors"]["note"] = "kept";
  const json saved = ball_bar(request)["machine"];
  const auto g = *read(saved).errors;
  EXPECT_NEAR(axis(g.chain.axes, 'Z').errors[2].c[1], 1e-3, 1e-7);
  EXPECT_NEAR(axis(g.chain.axes, 'Z').errors[2].b, -1e-3, 1e-7);
  EXPECT_NEAR(axis(g.chain.axes, 'Z').location[4], 0, 1e-9);  // all of it is X's
  EXPECT_NEAR(axis(g.chain.axes, 'X').location[4], -1e-5, 1e-9);
  EXPECT_EQ(saved["errors"]["note"], "kept");
}

// What stays in the machine explains its part of the trace, cubics and bows along the
// axes too, wherever the circle lies: the machine that comes back makes the trace.
TEST(Calibration, WhatStaysIsNotFoundAgain) {
  for (const json& centre : {json{0, 0, 0}, json{35, 0, -60}}) {
    json errors = worn()["errors"];
    for (json& axis : errors["axes"])
      if (axis["name"] == "Z")
        axis["err"]["EZZ"] = {{"c", {0, 2e-3, 4e-3, 3e-3}}, {"b", -1e-3}};
    json request = simulated(errors, "ZX", centre);
    request["machine"] = worn();
    request["machine"]["errors"] = errors;
    for (json& axis : request["machine"]["errors"]["axes"])  // as not measured yet
      if (axis["name"] == "X") axis.erase("err");
    const json saved = ball_bar(request)["machine"]["errors"];
    const json again = simulated(saved, "ZX", centre)["analyse"];
    for (const char* path : {"ccw_mm", "cw_mm"}) {
      const std::vector<double> was = request["analyse"][path], is = again[path];
      for (std::size_t k = 0; k < 36; ++k)  // but for the centre
        EXPECT_NEAR(is[k] + is[k + 36] - was[k] - was[k + 36], 0, 4e-7) << path << k;
    }
  }
}

// Probed balls too: cubics and harmonics that the machine has and nobody asks for are not
// taken for scales and locations.
TEST(Calibration, OfProbedBallsLeavesWhatStays) {
  volumetric::SambaStrategy s;
  json strategy = {{"balls_mm", json::array()},
                   {"indexations_deg", json::array()},
                   {"balls_seen", json::array()},
                   {"scale_bar_mm", 240}};
  for (const volumetric::Vec3& ball : std::vector<volumetric::Vec3>{
           {-120, 0, 40}, {120, 0, 40}, {0, 130, 90}, {30, -110, 60}}) {
    s.balls_mm.push_back(ball);
    strategy["balls_mm"].push_back(ball);
  }
  s.scale_bar_mm = 240;
  for (int i = 0; i < 7; ++i) {
    const double B = 12.0 * i - 30, C = 50.0 * i * i;
    s.indexations.push_back(
        {units::rad_from_deg(B), units::rad_from_deg(C), {0, 1, 2, 3}, {}});
    strategy["indexations_deg"].push_back({B, C});
    strategy["balls_seen"].push_back({1, 2, 3, 4});
  }
  json errors = {{"chain", "wCBXfZYt"}, {"axes", json::array()}};
  for (const char* name : {"C", "B", "X", "Z", "Y"})
    errors["axes"].push_back({{"name", name}});
  json& X = errors["axes"][2];
  X["err"] = {{"EXX", {{"c", {0, 4e-4, 0, 3e-4}}}}, {"EYX", {{"c", {0, 0, 2e-4, 0}}}}};
  errors["axes"][1]["loc"] = {{"EC0B", 1e-5}};
  errors["axes"][0]["err"] = {{"EZC", {{"f", {{2e-4, 1e-4}}}}}};
  json machine = medium();
  machine["errors"] = errors;
  const auto truth = read(machine).errors->chain;
  json request = {{"strategy", strategy},
                  {"parameters", {"EXX1", "EC0B", "EYY1"}},
                  {"readings_mm", json::array()},
                  {"noise_mm", 1e-3}};
  const auto readings = volumetric::samba_readings(s, truth);
  for (std::size_t k = 0; k < readings.size(); k += 3)
    request["readings_mm"].push_back({readings[k], readings[k + 1], readings[k + 2]});
  request["machine"] = machine;
  request["machine"]["errors"]["axes"][1].erase("loc");
  request["machine"]["errors"]["axes"][2]["err"]["EXX"]["c"][1] = 0.7;  // replaced
  const auto found = *read(samba(request)["machine"]).errors;
  EXPECT_NEAR(axis(found.chain.axes, 'X').errors[0].c[1], 4e-4, 1e-7);
  EXPECT_NEAR(axis(found.chain.axes, 'B').location[5], 1e-5, 1e-9);
  EXPECT_NEAR(axis(found.chain.axes, 'Y').errors[1].c[1], 0, 1e-7);
  // Without the machine's help the cubic is read as a scale.
  EXPECT_GT(std::abs(samba(request)["parameters"]["EXX1"]["value"].get<double>() - 4e-4),
            1e-5);
}

TEST(Calibration, OfMachinesThatLackAnAxisIsRefused) {
  const json errors = {{"chain", "wfXYt"}, {"axes", {{{"name", "X"}}, {{"name", "Y"}}}}};
  json request = simulated(errors, "XY");
  request["machine"] = medium();
  EXPECT_EQ(refusal(ball_bar, request),
            "ballbar: /machine: got an object, expected a machine whose chain has the "
            "axis Y");
}

}  // namespace
}  // namespace turnwright::document::machine_errors_test
