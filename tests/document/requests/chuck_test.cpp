#include "turnwright/document/chuck.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/deflection.hpp"

namespace turnwright::document::chuck_test {
namespace {

using nlohmann::json;

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("chuck.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("chuck.result.json");
  EXPECT_EQ(request_schema().fault(request), "") << request;
  json result = chuck(request);
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) { return input_refusal(chuck, request); }

/// A bar in a chuck with a tool that yields, as the door `deflection` sees it.
const double kC0 = 1.8e-5, kC1 = 8.6e-8, kC2 = 1.1e-9, kTool = 4e-6;

json shaft() {
  return {{"E_MPa", 210000},
          {"nu", 0.3},
          {"segments",
           {{{"length_mm", 160}, {"outer_left_mm", 60}, {"outer_right_mm", 60}}}}};
}

json clamping() {
  return {{"method", "chuck"},
          {"chuck",
           {{"radial", {{"c0_mm_N", kC0}, {"c1_rad_N", kC1}, {"c2_rad_Nmm", kC2}}},
            {"tangential",
             {{"c0_mm_N", 1.5e-5}, {"c1_rad_N", 7e-8}, {"c2_rad_Nmm", 8.9e-10}}}}}};
}

json cut(const std::string& setup, double z, double Fr) {
  return {{"setup", setup}, {"z_mm", z},        {"D_mm", 60},
          {"Fr_N", Fr},     {"Ft_N", 2.2 * Fr}, {"Fa_N", 0.6 * Fr}};
}

json load_of(const json& cut) {
  return {{"Fr_N", cut.at("Fr_N")}, {"Ft_N", cut.at("Ft_N")}, {"Fa_N", cut.at("Fa_N")}};
}

/// Twelve cuts in two setups, their errors computed by `deflection`.
json campaign() {
  json tests = json::array();
  for (const char* setup : {"A", "B"})
    for (const double Fr : {150.0, 700.0})
      for (const double z : {20.0, 90.0, 150.0}) {
        json test = cut(setup, z, Fr);
        const json at = deflection({{"shaft", shaft()},
                                    {"clamping", clamping()},
                                    {"positions_mm", {z}},
                                    {"load", load_of(test)}})["positions"][0];
        test["radius_error_mm"] = at["radius_error_mm"].get<double>() + kTool * Fr +
                                  (*setup == 'A' ? 0.01 : -0.02);
        test["delta_t_mm"] = at["delta_t_mm"];
        tests.push_back(test);
      }
  return {{"tests", tests}, {"shaft", shaft()}, {"tool_rr_mm_N", kTool}};
}

TEST(Chuck, TurnsTheDoorDeflectionAround) {
  json q = campaign();
  json at = cut("", 120, 250);
  at.erase("setup");
  q["predict"] = {at};
  const json r = answered(q);
  EXPECT_NEAR(r["chuck"]["radial"]["c0_mm_N"], kC0, 1e-8 * kC0);
  EXPECT_NEAR(r["chuck"]["radial"]["c1_rad_N"], kC1, 1e-8 * kC1);
  EXPECT_NEAR(r["chuck"]["radial"]["c2_rad_Nmm"], kC2, 1e-8 * kC2);
  EXPECT_NEAR(r["chuck"]["tangential"]["c2_rad_Nmm"], 8.9e-10, 1e-17);
  EXPECT_NEAR(r["radial"]["offsets"][0]["offset_mm"], 0.01, 1e-10);
  EXPECT_EQ(r["radial"]["offsets"][1]["setup"], "B");
  EXPECT_EQ(r["radial"]["degrees_of_freedom"], 12 - 3 - 2);
  EXPECT_EQ(r["identifiability"]["radial"]["rank"], 3);
  EXPECT_EQ(r["warnings"], json::array());
  EXPECT_EQ(r["tests"].size(), 12u);

  EXPECT_EQ(r["predictions"][0]["z_mm"], 120);
  EXPECT_EQ(r["predictions"][0]["Fr_N"], 250);

  // what it found goes into `deflection` as it is; less the part, that is the prediction
  const auto through = [&](const json& with) {
    return deflection({{"shaft", shaft()},
                       {"clamping", {{"method", "chuck"}, {"chuck", with}}},
                       {"positions_mm", {120}},
                       {"load", load_of(at)}})["positions"][0]["delta_r_mm"]
        .get<double>();
  };
  EXPECT_NEAR(r["predictions"][0]["delta_r_mm"],
              through(r["chuck"]) - through(json::object()), 1e-12);
}

TEST(Chuck, ExamplesOfTheSchemaAreAnswered) {
  const auto schema = parse_file(source_path("schemas/chuck.request.json"));
  for (const json& example : schema.at("examples")) answered(example);
}

TEST(Chuck, CsvIsTheSameAsTests) {
  const json q = campaign();
  std::string csv = " delta_t_mm , setup,Fr_N,Ft_N,Fa_N,z_mm,D_mm,radius_error_mm\r\n\n";
  for (const json& t : q["tests"])
    csv += t["delta_t_mm"].dump() + ",  " + t["setup"].get<std::string>() + "," +
           t["Fr_N"].dump() + "," + t["Ft_N"].dump() + "," + t["Fa_N"].dump() + "," +
           t["z_mm"].dump() + "," + t["D_mm"].dump() + "," + t["radius_error_mm"].dump() +
           "\r\n";
  json lines = json::array();
  for (std::size_t at = 0, end; (end = csv.find('\n', at)) != csv.npos; at = end + 1)
    lines.push_back(csv.substr(at, end - at));
  for (const json& table : {json(csv), lines}) {
    json with_csv = q;
    with_csv.erase("tests");
    with_csv["csv"] = table;
    EXPECT_EQ(answered(with_csv), answered(q));
  }
}

TEST(Chuck, CsvSaysWhichLineIsWrong) {
  const auto with = [](const std::string& csv) { return refused({{"csv", csv}}); };
  EXPECT_EQ(with("setup,z_mm,D_mm,Fr_N,Ft_N,Fa_N,radius_error_mm\n"
                 "A,10,50,100,200,60\n"
                 "\n"
                 "A,ten,50,1e7,200,60,0.01\n"
                 "A,10,50,,inf,60,0.01\n"
                 ",10,50,100,200,60,0.01\n"),
            R"(chuck: /csv#line 2: got 6 cells, expected 7 as in the header
chuck: /csv#line 4/z_mm: got "ten", expected a number from 0 to 1000000 mm
chuck: /csv#line 4/Fr_N: got 10000000.0, expected a number from -1000000 to 1000000 N
chuck: /csv#line 5/Fr_N: got nothing, expected a number from -1000000 to 1000000 N
chuck: /csv#line 5/Ft_N: got "inf", expected a number from -1000000 to 1000000 N
chuck: /csv#line 6/setup: got nothing, expected a text of 1 to 64 bytes)");
  EXPECT_EQ(
      with("setup,z,D_mm,Fr_N,Ft_N,Fa_N\nA,1,2,3,4,5"),
      R"(chuck: /csv#line 1: got column "z", expected columns of setup, z_mm, D_mm, Fr_N, Ft_N, Fa_N, radius_error_mm, delta_t_mm
chuck: /csv#line 1: got no column "z_mm", expected one)");
}

TEST(Chuck, OutliersAndWhatIsPoorlyKnownAreTold) {
  json q = campaign();
  q["tests"][4]["radius_error_mm"] =
      q["tests"][4]["radius_error_mm"].get<double>() + 0.03;
  q["tests"][7]["delta_t_mm"] = 0.5;
  q["tests"][0].erase("delta_t_mm");
  q.erase("tool_rr_mm_N");
  const json r = answered(q);
  EXPECT_EQ(r["radial"]["outliers"], json({4}));
  EXPECT_EQ(r["tangential"]["outliers"], json({7}));
  EXPECT_EQ(r["tests"][4]["outlier"], true);
  EXPECT_EQ(r["tests"][5]["outlier"], false);
  EXPECT_NEAR(r["tests"][4]["residual_mm"], 0.03, 1e-9);
  EXPECT_NEAR(r["chuck"]["radial"]["c0_mm_N"], kC0 + kTool, 1e-8 * kC0);
  EXPECT_EQ(r["warnings"],
            json({"tool_rr_mm_N is not given: c0 holds the compliance of tool and slide "
                  "too"}));
  // forces that hardly differ in cuts that scatter by micrometres
  const std::vector<double> scatter{1, -1, -2, 2, 1, -1, 2, 0, -1, 1, -2, 0};
  q = campaign();
  for (std::size_t i = 0; i < 12; ++i) {
    json& t = q["tests"][i];
    const double F = i % 6 < 3 ? 150 : 160;
    t["Fr_N"] = F;
    t["radius_error_mm"] = 0.01 + 0.001 * scatter[i];
    t.erase("delta_t_mm");
  }
  const std::string warned = answered(q)["warnings"].dump();
  EXPECT_NE(warned.find("most useful next: a cut at another force in setup A"),
            std::string::npos)
      << warned;
}

TEST(Chuck, RefusesCutsThatCannotTell) {
  json one_force{{"tests", json::array()}};
  for (const double z : {20.0, 60.0, 110.0, 150.0, 155.0}) {
    one_force["tests"].push_back(cut("A", z, 300));
    one_force["tests"].back()["radius_error_mm"] = 0.01;
  }
  EXPECT_EQ(request_schema().fault(one_force), "");
  EXPECT_EQ(
      refused(one_force),
      "chuck: /tests: got 5 radial cuts that cannot tell c0 with the setups' offsets, "
      "expected a cut at another force in setup A");
  json no_couple{{"tests", json::array()}};  // at two places: c1 and c2 act as one
  for (const double Fr : {150.0, 400.0, 700.0})
    for (const double z : {30.0, 140.0}) {
      no_couple["tests"].push_back(cut("A", z, Fr));
      no_couple["tests"].back()["Fa_N"] = 0;
      no_couple["tests"].back()["radius_error_mm"] = 0.01;
    }
  EXPECT_EQ(refused(no_couple),
            "chuck: /tests: got 6 radial cuts that cannot tell c0 with c1 with c2, "
            "expected a cut at a third z in setup A");
  json one_place{{"tests", json::array()}};
  for (const double Fr : {100.0, 300.0, 500.0, 700.0, 600.0}) {
    one_place["tests"].push_back(cut("x", 80, Fr));
    one_place["tests"].back()["radius_error_mm"] = 0.01;
    one_place["tests"].back()["delta_t_mm"] = 0.01;
  }
  const std::string text = refused(one_place);
  EXPECT_NE(text.find("chuck: /tests: got 5 tangential cuts that cannot tell "),
            std::string::npos);
  EXPECT_NE(text.find("chuck: /tests: got 5 radial cuts that cannot tell "),
            std::string::npos);
  EXPECT_NE(text.find("expected a cut at a second z in setup x and a cut at a third z in "
                      "setup x"),
            std::string::npos)
      << text;
  json few = campaign();
  few["tests"] = {few["tests"][0], few["tests"][1], few["tests"][2], few["tests"][3]};
  for (json& t : few["tests"]) t.erase("delta_t_mm");
  EXPECT_EQ(refused(few),
            "chuck: /tests: got 4 radial cuts that leave no error to judge by, expected "
            "at least 5 cuts");
}

TEST(Chuck, WithoutErrorsItTellsWhatTheCutsWouldTell) {
  json q = campaign();
  for (json& t : q["tests"]) {
    t.erase("radius_error_mm");
    t.erase("delta_t_mm");
  }
  json r = answered(q);
  EXPECT_FALSE(r.contains("chuck"));
  EXPECT_EQ(r["identifiability"]["radial"]["rank"], 3);
  EXPECT_EQ(r["identifiability"]["radial"]["degrees_of_freedom"], 7);
  // one setup, one force
  q["tests"] = {cut("A", 20, 300), cut("A", 80, 300), cut("A", 140, 300)};
  r = answered(q)["identifiability"]["radial"];
  EXPECT_EQ(r["rank"], 2);
  EXPECT_EQ(r["null_directions"][0]["words"], "c0 with the setups' offsets");
  EXPECT_EQ(r["missing"], json({"a cut at another force in setup A"}));
  EXPECT_EQ(r["setups_of_one_force"], json({"A"}));
  EXPECT_FALSE(r.contains("condition"));
}

TEST(Chuck, SpringsAreAViewForAnArm) {
  json q = campaign();
  q["Lc_mm"] = 110;
  json k = answered(q)["radial"]["springs"];
  EXPECT_NEAR(k["k2_Nmm_rad"], 110 / kC1, 1e-6 * 110 / kC1);
  EXPECT_NEAR(k["k1_N_mm"], 1 / (kC0 - 110 * kC1), 1);
  EXPECT_NEAR(k["k3_Nmm_rad"], 1 / (kC2 - kC1 / 110), 1e5);
  // cuts without scatter leave no error; u(k2)/k2 is u(c1)/c1, the arm being given
  EXPECT_LT(k["u_k1_N_mm"].get<double>(), 1e-6 * k["k1_N_mm"].get<double>());
  std::size_t i = 0;
  for (const double scatter : {1, -1, -2, 2, 1, -1, 2, 0, -1, 1, -2, 0}) {
    json& error = q["tests"][i++]["radius_error_mm"];
    error = error.get<double>() + 2e-4 * scatter;
  }
  const json noisy = answered(q);
  k = noisy["radial"]["springs"];
  const double relative = noisy["radial"]["u"]["c1_rad_N"].get<double>() /
                          noisy["chuck"]["radial"]["c1_rad_N"].get<double>();
  EXPECT_GT(relative, 0.001);
  EXPECT_NEAR(k["u_k2_Nmm_rad"].get<double>() / k["k2_Nmm_rad"].get<double>(), relative,
              1e-9 * relative);
  q = campaign();
  k = answered(q)["radial"]["springs"];
  EXPECT_NEAR(k["Lc_range_mm"][0], kC1 / kC2, 1e-5);
  EXPECT_NEAR(k["Lc_range_mm"][1], kC0 / kC1, 1e-5);
  q["Lc_mm"] = 300;
  const json r = answered(q);
  EXPECT_FALSE(r["radial"].contains("springs"));
  EXPECT_EQ(r["warnings"][0],
            "radial: no three springs with this Lc_mm give this compliance");
  q.erase("Lc_mm");
  EXPECT_NEAR(answered(q)["radial"]["springs"]["Lc_mm"], std::sqrt(kC0 / kC2), 1e-5);
}

// Errors that shrink with the force: no elastic chuck does that.
TEST(Chuck, ContradictionIsTold) {
  json q = campaign();
  double ripple = 2e-4;
  for (json& t : q["tests"]) {
    const double F = t["Fr_N"], z = t["z_mm"];
    t["radius_error_mm"] =
        -6e-6 * F + 1.6e-7 * z * F + 7e-10 * z * z * F + (ripple = -ripple);
    t.erase("delta_t_mm");
  }
  const json r = answered(q);
  EXPECT_EQ(r["radial"]["on_border"], true);
  EXPECT_GT(r["radial"]["contradiction"], 9);
  EXPECT_LT(r["radial"]["unconstrained"]["c0_mm_N"], 0);
  EXPECT_NE(r["warnings"][0].get<std::string>().find("contradict every elastic chuck"),
            std::string::npos);
  // and what is told instead is one
  const json s = r["chuck"]["radial"];
  EXPECT_NO_THROW(deflection({{"shaft", shaft()},
                              {"clamping", {{"method", "chuck"}, {"chuck", r["chuck"]}}},
                              {"positions_mm", {20}},
                              {"load", load_of(q["tests"][0])}}));
}

TEST(Chuck, GraphAloneAndItsCorrection) {
  json z = json::array(), e = json::array();
  for (int i = 1; i <= 30; ++i) {
    z.push_back(5 * i);
    e.push_back(0.001 + 2e-5 * i + (i > 14 ? 0.012 : 0));
  }
  const json g = answered({{"graph", {{"z_mm", z}, {"e_mm", e}}}})["graph"];
  ASSERT_EQ(g["steps"].size(), 1u);
  EXPECT_EQ(g["steps"][0]["after_mm"], 70);
  EXPECT_EQ(g["steps"][0]["before_mm"], 75);
  EXPECT_NEAR(g["steps"][0]["height_mm"], 0.012, 1e-12);
  EXPECT_EQ(g["coefficients"].size(), 2u);
  EXPECT_NEAR(g["coefficients"][1], 4e-6, 1e-15);
  for (int i = 0; i < 30; ++i)
    EXPECT_NEAR(g["corrected_mm"][static_cast<std::size_t>(i)], 0.001 + 2e-5 * (i + 1),
                1e-12);
}

TEST(Chuck, AllProblemsAtOnce) {
  json q = campaign();
  q["format"] = "turnwright-chuck/2";
  q["tests"][0]["z_mm"] = 161;
  q["tests"][1].erase("radius_error_mm");
  q["tests"][2]["setup"] = 7;
  q["tests"][3]["Dmm"] = 3;
  q["Lc_mm"] = 0;
  q["predict"] = {{{"z_mm", 1}, {"D_mm", 0}, {"Fr_N", 1}, {"Ft_N", 1}}};
  q["graph"] = {{"z_mm", {1, 2, 3, 3}}, {"e_mm", {1, 2, 3}}};
  EXPECT_EQ(refused(q),
            R"(chuck: /format: got "turnwright-chuck/2", expected "turnwright-chuck/1"
chuck: /tests/0/z_mm: got 161, expected a number from 0 to 160 mm
chuck: /tests/2/setup: got 7, expected a text of 1 to 64 bytes
chuck: /tests/3/Dmm: got 3, expected no such key (did you mean "D_mm"?)
chuck: /tests/1/radius_error_mm: got nothing, expected an error for every cut, or for none to plan them
chuck: /predict/0/D_mm: got 0, expected a number > 0 and <= 100000 mm
chuck: /predict/0/Fa_N: got nothing, expected a number from -1000000 to 1000000 N
chuck: /Lc_mm: got 0, expected a number > 0 and <= 1000000 mm
chuck: /graph/e_mm: got [1,2,3], expected as many errors as z_mm has values
chuck: /graph/z_mm: got [1,2,3,3], expected at least max_degree + 3 = 6 different places)");
}

TEST(Chuck, MembersThatExcludeEachOtherAndNothingAtAll) {
  json q = campaign();
  q["csv"] = "setup";
  EXPECT_NE(request_schema().fault(q), "");
  EXPECT_EQ(refused(q), R"(chuck: /csv: got "setup", expected either tests or csv)");
  EXPECT_NE(request_schema().fault(json::object()), "");
  EXPECT_EQ(refused(json::object()),
            "chuck: /tests: got nothing, expected a list of 1 to 2000 entries");
  for (const json& nothing : {json(nullptr), json(3), json::array(), json("x")})
    EXPECT_NE(refused(nothing), "");
}

}  // namespace
}  // namespace turnwright::document::chuck_test
