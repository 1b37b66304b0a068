#include "turnwright/document/calibrate_material.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/cutting/cut.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

const Catalogue& catalogue() {
  static const Catalogue kCatalogue = load_catalogue(source_path("tests/data/catalogue"));
  return kCatalogue;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("calibrate-material.request.json");
  static const SchemaCheck kResult("calibrate-material.result.json");
  static const SchemaCheck kMaterial("material.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = calibrate_material(request, catalogue());
  EXPECT_EQ(kResult.fault(result), "") << result;
  if (!result["material"].is_null()) {
    EXPECT_EQ(kMaterial.fault(result["material"]), "") << result["material"];
  }
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { calibrate_material(r, catalogue()); },
                       request);
}

json tool() {
  return {{"name", "CNMG 120408"}, {"re_mm", 0.8}, {"kapr_deg", 95}, {"rake_deg", 4}};
}

/// Cuts that the planner's own laws would make with an invented material.
json campaign() {
  cutting::Cut c;
  c.kc = {1700, 0.22};
  c.kf = catalogue::Kienzle{420, 0.6};
  c.kp = catalogue::Kienzle{310, 0.55};
  c.taylor = {380, 0.28, 0.3, 0.12};
  c.corner = cutting::corner_of(0.8, 95 * M_PI / 180);
  json cuts = json::array();
  for (const double vc : {120.0, 180.0})
    for (const double f : {0.1, 0.2, 0.35})
      for (const double ap : {0.4, 2.0}) {
        const auto F = cutting::forces_N(c, ap, f);
        cuts.push_back({{"vc_m_min", vc},
                        {"f_mm_rev", f},
                        {"ap_mm", ap},
                        {"Fc_N", F.Fc_N},
                        {"Ff_N", F.Ff_N},
                        {"Fp_N", F.Fp_N},
                        {"T_min", cutting::tool_life_min(c, vc, f, ap)}});
      }
  return {{"material", "test-steel"}, {"id", "lot-7"}, {"tool", tool()}, {"cuts", cuts}};
}

TEST(CalibrateMaterial, TurnsThePlannersLawsAround) {
  const json r = answered(campaign());
  EXPECT_NEAR(r["cutting"]["kc11_MPa"]["value"], 1700, 1e-7);
  EXPECT_NEAR(r["cutting"]["mc"]["value"], 0.22, 1e-11);
  EXPECT_NEAR(r["feed"]["mf"]["value"], 0.6, 1e-11);
  EXPECT_NEAR(r["passive"]["kp11_MPa"]["value"], 310, 1e-7);
  EXPECT_NEAR(r["taylor"]["C"]["value"], 380, 1e-7);
  EXPECT_NEAR(r["taylor"]["n"]["value"], 0.28, 1e-10);
  EXPECT_NEAR(r["taylor"]["a"]["value"], 0.3, 1e-10);
  EXPECT_NEAR(r["taylor"]["b"]["value"], 0.12, 1e-10);
  EXPECT_EQ(r["warnings"], json::array());
  const json& m = r["material"];
  EXPECT_EQ(m["id"], "lot-7");
  EXPECT_EQ(m["name"], "Invented steel for tests");
  EXPECT_NEAR(m["kienzle"]["kc11_MPa"], 1700, 1e-7);
  EXPECT_EQ(m["kienzle"]["rake_deg"], 4);
  EXPECT_EQ(m["kienzle"]["vc_m_min"], json({120.0, 180.0}));
  EXPECT_NEAR(m["feed_passive"]["kf11_MPa"], 420, 1e-7);
  EXPECT_EQ(r["feed_and_passive_by"], "feed_passive");  // other depths follow it exactly
  ASSERT_EQ(r["left_out"].size(), 2u);
  EXPECT_NEAR(r["left_out"][1]["Fp_rms_pct"], 0, 1e-7);
  EXPECT_NEAR(m["taylor"]["n"], 0.28, 1e-10);
  EXPECT_EQ(m["taylor"]["f_mm_rev"], json({0.1, 0.35}));
  EXPECT_EQ(m["elastic"], catalogue().material_documents.at("test-steel")["elastic"]);
}

TEST(CalibrateMaterial, CsvIsTheSameAsCuts) {
  const json q = campaign();
  std::string csv = "T_min,Fc_N, vc_m_min,f_mm_rev,ap_mm,Ff_N,Fp_N\r\n\n";
  for (const json& c : q["cuts"])
    csv += c["T_min"].dump() + ',' + c["Fc_N"].dump() + ',' + c["vc_m_min"].dump() + ',' +
           c["f_mm_rev"].dump() + ',' + c["ap_mm"].dump() + ',' + c["Ff_N"].dump() + ',' +
           c["Fp_N"].dump() + "\r\n";
  json with_csv = q;
  with_csv.erase("cuts");
  with_csv["csv"] = csv;
  EXPECT_EQ(answered(with_csv), answered(q));
}

TEST(CalibrateMaterial, KeepsWhatWasNotMeasured) {
  json q = campaign();
  for (json& c : q["cuts"]) {
    for (const char* key : {"Ff_N", "Fp_N", "T_min"}) c.erase(key);
  }
  json r = answered(q);
  const json base = catalogue().material_documents.at("test-steel");
  EXPECT_EQ(r["material"]["taylor"], base["taylor"]);
  EXPECT_EQ(r["material"]["feed_passive"], base["feed_passive"]);
  EXPECT_FALSE(r.contains("taylor") || r.contains("thrust"));
  EXPECT_EQ(r["warnings"], json::array());
  q["material"] = base;  // the document itself
  EXPECT_EQ(answered(q), r);
  q.erase("material");
  r = answered(q);
  EXPECT_TRUE(r["material"].is_null());
  EXPECT_EQ(r["warnings"].back(),
            "no material given, whose document the constants could go into");
}

TEST(CalibrateMaterial, NamesOutliersAndTakesWhatItIsGiven) {
  json q = campaign();
  int k = 0;
  for (json& c : q["cuts"]) {
    c["Fc_N"] = c["Fc_N"].get<double>() * (1 + 0.01 * std::sin(7.0 * ++k));
    c["f_mm_rev"] = 0.2;  // nothing tells a
    c["T_min"] = std::pow(380 / (c["vc_m_min"].get<double>() * std::pow(0.2, 0.3) *
                                 std::pow(c["ap_mm"].get<double>(), 0.12)),
                          1 / 0.28);
    for (const char* key : {"Ff_N", "Fp_N", "Fc_N"}) c.erase(key);
  }
  json r = answered(q);
  EXPECT_EQ(r["taylor"]["a"], json({{"value", 0.3}, {"given", true}}));  // test-steel's
  EXPECT_NEAR(r["taylor"]["C"]["value"], 380, 1e-6);
  EXPECT_EQ(r["warnings"][0],
            "a stays at its given 0.3; it takes a tool life at another feed, speed "
            "unchanged");
  q = campaign();
  k = 0;
  for (json& c : q["cuts"])
    c["Fc_N"] = c["Fc_N"].get<double>() * (1 + 0.01 * std::sin(7.0 * ++k));
  q["cuts"][5]["Fc_N"] = 3000;
  EXPECT_EQ(answered(q)["cutting"]["outliers"], json({5}));
}

// The thrust force that the planner assumes, with other constants.
json thrust_campaign() {
  cutting::Cut c;
  c.kc = {1700, 0.22};
  c.thrust = {0.5, 44, 20};
  c.corner = cutting::corner_of(0.8, 95 * M_PI / 180);
  json cuts = json::array();
  for (const double f : {0.08, 0.12, 0.2})
    for (const double ap : {0.3, 0.6, 1.0}) {
      const auto F = cutting::forces_N(c, ap, f);
      cuts.push_back({{"vc_m_min", 200},
                      {"f_mm_rev", f},
                      {"ap_mm", ap},
                      {"Fc_N", F.Fc_N},
                      {"Ff_N", F.Ff_N},
                      {"Fp_N", F.Fp_N}});
    }
  return {{"material", "test-steel"}, {"tool", tool()}, {"cuts", cuts}};
}

TEST(CalibrateMaterial, ThrustTakesThePlaceOfTheComponentsWhereItTurnsWithTheDepth) {
  const json r = answered(thrust_campaign());
  EXPECT_EQ(r["feed_and_passive_by"], "thrust");
  EXPECT_NEAR(r["thrust"]["ratio"]["value"], 0.5, 1e-9);
  EXPECT_NEAR(r["thrust"]["edge_N_mm"]["value"], 44, 1e-7);
  EXPECT_FALSE(r["thrust"]["scaled"]);
  EXPECT_NEAR(r["material"]["thrust"]["edge_N_mm"], 44, 1e-7);
  EXPECT_FALSE(r["material"].contains("feed_passive"));
  ASSERT_EQ(r["left_out"].size(), 3u);
  EXPECT_EQ(r["left_out"][0]["ap_mm"], 0.3);
  EXPECT_NEAR(r["left_out"][0]["Fp_rms_pct"], 0, 1e-7);
}

// What was not measured stays, also inside a group; without a material the rest is told.
TEST(CalibrateMaterial, KeepsThePressureOnTheWearLand) {
  json q = thrust_campaign();
  q["material"] = catalogue().material_documents.at("test-steel");
  q["material"]["thrust"] = {{"ratio", 0.4},
                             {"edge_N_mm", 50},
                             {"land_MPa", 1234},
                             {"uncertainty_pct", 20},
                             {"source", "test"}};
  EXPECT_EQ(answered(q)["material"]["thrust"]["land_MPa"], 1234);
  q.erase("material");
  for (json& c : q["cuts"]) c["f_mm_rev"] = 0.1;  // one feed and, with it, no kc1.1
  for (json& c : q["cuts"]) c["ap_mm"] = 0.5;
  q["cuts"][0]["T_min"] = 20;
  EXPECT_NE(refused(q).find("cannot tell kc11_MPa and mc"), std::string::npos);
  q = thrust_campaign();
  q.erase("material");
  for (json& c : q["cuts"]) c.erase("Fc_N"), c.erase("Ff_N");
  const json r = answered(q);
  EXPECT_TRUE(r["material"].is_null());
  EXPECT_FALSE(r.contains("thrust") || r.contains("feed_and_passive_by"));
  EXPECT_TRUE(
      r["warnings"][0].get<std::string>().starts_with("not determined: the thrust force"))
      << r["warnings"];
}

// An exponent that no material has keeps its own group from being written, and only that.
TEST(CalibrateMaterial, WritesWhatIsGoodBesideWhatIsNot) {
  json q = thrust_campaign();
  for (json& c : q["cuts"])
    c["Fc_N"] = c["Fc_N"].get<double>() *
                std::pow(c["f_mm_rev"].get<double>() / 0.1, 0.5);  // rises with h
  json r = answered(q);
  EXPECT_LT(r["cutting"]["mc"]["value"], 0);
  const json base = catalogue().material_documents.at("test-steel");
  EXPECT_EQ(r["material"]["kienzle"], base["kienzle"]);
  EXPECT_TRUE(r["material"].contains("thrust"));
  ASSERT_EQ(r["warnings"].size(), 1u);
  EXPECT_TRUE(r["warnings"][0].get<std::string>().starts_with(
      "kienzle is not replaced: /kienzle/mc: got -0."))
      << r["warnings"];
  q = thrust_campaign();
  for (json& c : q["cuts"]) c["T_min"] = 15;  // at one speed
  r = answered(q);
  EXPECT_EQ(r["material"]["taylor"], base["taylor"]);
  EXPECT_TRUE(r["material"].contains("thrust"));
  EXPECT_EQ(
      r["warnings"],
      json({"not determined: 9 cuts with T_min that cannot tell n and C; it takes a "
            "tool life at another cutting speed"}));
}

TEST(CalibrateMaterial, RefusesCutsThatCannotTell) {
  json q = campaign();
  json one = json::array();
  for (const json& c : q["cuts"])
    if (c["f_mm_rev"] == 0.2 && c["ap_mm"] == 2.0) one.push_back(c);
  for (json& c : one) c["vc_m_min"] = 120;
  q["cuts"] = one;
  EXPECT_EQ(
      refused(q),
      R"(calibrate-material: /cuts: got 2 cuts with Fc_N that cannot tell kc11_MPa and mc, expected a cut at another chip thickness (another feed)
calibrate-material: /cuts: got 2 cuts with Ff_N that cannot tell kf11_MPa and mf, expected a cut at another chip thickness (another feed)
calibrate-material: /cuts: got 2 cuts with Fp_N that cannot tell kp11_MPa and mp, expected a cut at another chip thickness (another feed)
calibrate-material: /cuts: got 2 cuts with T_min that cannot tell n and C, expected a tool life at another cutting speed)");
}

TEST(CalibrateMaterial, ListsAllThatIsWrong) {
  EXPECT_EQ(
      refused({{"material", "C45x"},
               {"id", "no id"},
               {"confidence", 1},
               {"tool", {{"name", ""}, {"re_mm", -1}, {"kapr_deg", 0}}},
               {"cuts",
                {{{"vc_m_min", 0}, {"f_mm_rev", "x"}, {"ap_mm", 1}, {"Fc_N", -3}},
                 {{"vc_m_min", 100}, {"f_mm_rev", 0.2}, {"ap_mm", 1}}}},
               {"lots", 1}}),
      R"(calibrate-material: /material: got "C45x", expected a material of the catalogue: "test-steel"
calibrate-material: /id: got "no id", expected an id of 1 to 64 letters, digits or _.+-, a letter or digit first
calibrate-material: /tool/name: got "", expected a text of 1 to 200 bytes
calibrate-material: /tool/re_mm: got -1, expected a number from 0 to 100 mm
calibrate-material: /tool/kapr_deg: got 0, expected a number > 0 and <= 120 deg
calibrate-material: /tool/rake_deg: got nothing, expected a number from -30 to 45 deg
calibrate-material: /confidence: got 1, expected a number from 0.5 to 0.999
calibrate-material: /cuts/0/vc_m_min: got 0, expected a number > 0 and <= 5000 m/min
calibrate-material: /cuts/0/f_mm_rev: got "x", expected a number > 0 and <= 5 mm/rev
calibrate-material: /cuts/0/Fc_N: got -3, expected a number > 0 and <= 1000000 N
calibrate-material: /cuts/1: got an object, expected a measured Fc_N, Ff_N, Fp_N or T_min
calibrate-material: /lots: got 1, expected no such key (did you mean "cuts"?))");
  EXPECT_EQ(
      refused({{"tool", tool()}, {"csv", "vc_m_min,f,ap_mm\n100,0.1,2\n"}}),
      R"(calibrate-material: /csv#line 1: got column "f", expected columns of vc_m_min, f_mm_rev, ap_mm, Fc_N, Ff_N, Fp_N, T_min
calibrate-material: /csv#line 1: got no column "f_mm_rev", expected one)");
  EXPECT_EQ(refused({{"tool", tool()},
                     {"csv",
                      "vc_m_min,f_mm_rev,ap_mm,Fc_N\n100,0.1,2\n"
                      "100,0.1,ten,500\n"}}),
            R"(calibrate-material: /csv#line 2: got 3 cells, expected 4 as in the header
calibrate-material: /csv#line 3/ap_mm: got "ten", expected a number > 0 and <= 50 mm)");
  EXPECT_EQ(refused({{"tool", tool()}, {"csv", "vc_m_min"}, {"cuts", json::array()}}),
            R"(calibrate-material: /csv: got "vc_m_min", expected either cuts or csv)");
  EXPECT_EQ(refused(nullptr),
            R"(calibrate-material: document: got null, expected an object)");
}

}  // namespace
}  // namespace turnwright::document
