#include "turnwright/document/calibrate_material.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/cutting/cut.hpp"

namespace turnwright::document::calibrate_material_test {
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
calibrate-material: /cuts/1: got an object, expected a measured Fc_N, Ff_N, Fp_N, T_min, T_longer_than_min, wear, Ra_um or Rz_um
calibrate-material: /lots: got 1, expected no such key (did you mean "cuts"?))");
  EXPECT_EQ(
      refused({{"tool", tool()}, {"csv", "vc_m_min,f,ap_mm\n100,0.1,2\n"}}),
      R"(calibrate-material: /csv#line 1: got column "f", expected columns of vc_m_min, f_mm_rev, ap_mm, Fc_N, Ff_N, Fp_N, T_min, T_longer_than_min, Ra_um, Rz_um, edge, lab, replica
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

// ---- Lives of edges ------------------------------------------------------------------

double life_min(double vc, double f, double ap) {
  return std::pow(380 / (vc * std::pow(f, 0.3) * std::pow(ap, 0.12)), 1 / 0.28);
}

// Two edges at each of eight conditions, which last `scatter` longer and shorter.
json edges(double scatter) {
  json cuts = json::array();
  for (const double vc : {160.0, 220.0})
    for (const double f : {0.15, 0.3})
      for (const double ap : {1.0, 2.0})
        for (const double sign : {-1.0, 1.0})
          cuts.push_back({{"vc_m_min", vc},
                          {"f_mm_rev", f},
                          {"ap_mm", ap},
                          {"edge", std::to_string(cuts.size() + 1)},
                          {"T_min", life_min(vc, f, ap) * std::exp(sign * scatter)}});
  return {{"material", "test-steel"}, {"tool", tool()}, {"cuts", cuts}};
}

// The pairs lie symmetrically about the law: what scatters is the edges, nothing else.
TEST(CalibrateMaterial, EdgesScatterAboutTheLaw) {
  const json r = answered(edges(0.1));
  EXPECT_NEAR(r["taylor"]["n"]["value"], 0.28, 1e-9);
  const json& e = r["taylor"]["edges"];
  EXPECT_NEAR(e["scatter_pct"]["value"], 10 * std::sqrt(16.0 / 8), 1e-6);
  EXPECT_NEAR(r["material"]["taylor"]["scatter_pct"], 10 * std::sqrt(16.0 / 8), 1e-6);
  EXPECT_NEAR(e["lack_of_fit_pct"], 0, 1e-6);
  EXPECT_NEAR(e["lack_of_fit_p"], 1, 1e-6);
  EXPECT_NEAR(e["at"]["vc_m_min"], std::sqrt(160.0 * 220), 1e-9);
  const double law =
      life_min(std::sqrt(160.0 * 220), std::sqrt(0.15 * 0.3), std::sqrt(2.0));
  EXPECT_NEAR(e["T50_min"]["value"].get<double>() / law, 1, 0.02);
  EXPECT_LT(e["T90_min"]["value"], e["T50_min"]["value"]);
  EXPECT_EQ(r["warnings"], json::array());
  json plain = edges(0.1);  // edges without a name are cuts, as they were
  for (json& c : plain["cuts"]) c.erase("edge");
  json same = answered(plain);
  EXPECT_FALSE(same["taylor"].contains("edges"));
  same["taylor"]["edges"] = e;
  same["material"]["taylor"]["scatter_pct"] = e["scatter_pct"]["value"];
  EXPECT_EQ(same, r);
}

TEST(CalibrateMaterial, LivesMayBeLongerThanTheirTest) {
  json q = edges(0.1);
  for (const std::size_t i : {1u, 5u}) {
    json& c = q["cuts"][i];
    c["T_longer_than_min"] = 0.5 * c["T_min"].get<double>();
    c.erase("T_min");
  }
  const json r = answered(q);
  EXPECT_EQ(r["taylor"]["censored"], 2);
  EXPECT_EQ(r["taylor"]["cuts"], 16);
  EXPECT_EQ(r["taylor"]["degrees_of_freedom"], 14 - 4);
  EXPECT_NEAR(r["taylor"]["n"]["value"], 0.28, 0.02);
  EXPECT_NEAR(r["material"]["taylor"]["C"], 380, 20);
  for (json& c : q["cuts"])
    if (c.contains("T_min")) {
      c["T_longer_than_min"] = c["T_min"];
      c.erase("T_min");
    }
  EXPECT_EQ(
      refused(q),
      "calibrate-material: /cuts: got 16 cuts with a tool life that cannot tell n and C, "
      "expected tool lives that ended, at two cutting speeds");
}

// A curve that reaches the criterion at T is the life T, one that ends before it a life
// that is longer.
TEST(CalibrateMaterial, WearCurvesAreLives) {
  json lives = edges(0.1), curves = lives;
  json& last = lives["cuts"][15];
  for (json& c : curves["cuts"]) {
    const double T = c["T_min"];
    c["wear"] = {{T / 2, 0.11}, {T, 0.2}, {1.2 * T, 0.3}};
    c.erase("T_min");
  }
  curves["wear_land_mm"] = 0.2;
  curves["cuts"][15]["wear"].erase(2);
  curves["cuts"][15]["wear"][1][1] = 0.19;
  last["T_longer_than_min"] = last["T_min"];
  last.erase("T_min");
  json r = answered(curves);
  const json from_wear = r["taylor"]["from_wear"];
  ASSERT_EQ(from_wear.size(), 16u);
  EXPECT_EQ(from_wear[3]["cut"], 3);
  EXPECT_NEAR(from_wear[3]["T_min"], lives["cuts"][3]["T_min"], 1e-12);
  EXPECT_EQ(from_wear[15],
            json({{"cut", 15}, {"T_longer_than_min", last["T_longer_than_min"]}}));
  const json by_lives = answered(lives);
  EXPECT_NEAR(r["taylor"]["C"]["lower"], by_lives["taylor"]["C"]["lower"], 1e-6);
  EXPECT_NEAR(r["taylor"]["edges"]["T90_min"]["upper"],
              by_lives["taylor"]["edges"]["T90_min"]["upper"], 1e-6);
  curves.erase("wear_land_mm");  // 0.3
  r = answered(curves);
  EXPECT_NEAR(r["taylor"]["from_wear"][3]["T_min"],
              1.2 * lives["cuts"][3]["T_min"].get<double>(), 1e-9);
}

TEST(CalibrateMaterial, WarnsWhereEdgesAreNotRepeatedOrMissTheLaw) {
  json q = edges(0.1);
  json once = json::array();
  for (std::size_t i = 0; i < 16; i += 2) once.push_back(q["cuts"][i + (i % 3 == 0)]);
  q["cuts"] = once;
  EXPECT_EQ(answered(q)["warnings"],
            json({"the scatter between edges is not told apart from what the law of tool "
                  "life misses; it takes two edges at the same speed, feed and depth"}));
  q = edges(0.02);
  for (std::size_t i = 0; i < 16; ++i) {  // an interaction, which no product has
    const double sign = (i / 4 + i / 8 + i / 2) % 2 == 0 ? 1 : -1;
    q["cuts"][i]["T_min"] = q["cuts"][i]["T_min"].get<double>() * std::exp(0.2 * sign);
  }
  const json r = answered(q);
  EXPECT_NEAR(r["taylor"]["edges"]["scatter_pct"]["value"], 2 * std::sqrt(2.0), 1e-6);
  EXPECT_TRUE(r["warnings"][0].get<std::string>().starts_with(
      "tool lives miss Taylor's law by more than edges scatter: by 2"))
      << r["warnings"];
}

// ---- Labs, replicas, roughness -------------------------------------------------------

TEST(CalibrateMaterial, EachLabHasItsFactor) {
  json q = campaign();
  json all = json::array();
  for (json c : q["cuts"]) {
    for (const auto& [lab, factor] : {std::pair{"ours", 1.25}, {"maker", 0.8}}) {
      json of_lab = c;
      of_lab["lab"] = lab;
      of_lab["Fc_N"] = c["Fc_N"].get<double>() * factor;
      of_lab["T_min"] = c["T_min"].get<double>() * std::pow(factor, 1 / 0.28);
      all.push_back(of_lab);
    }
  }
  q["cuts"] = all;
  json r = answered(q);
  EXPECT_NEAR(r["cutting"]["kc11_MPa"]["value"], 1700, 1e-6);
  EXPECT_NEAR(r["taylor"]["C"]["value"], 380, 1e-6);
  ASSERT_EQ(r["labs"].size(), 2u);
  EXPECT_EQ(r["labs"][0]["lab"], "ours");
  EXPECT_NEAR(r["labs"][0]["kc11_factor"]["value"], 1.25, 1e-9);
  EXPECT_NEAR(r["labs"][1]["C_factor"]["value"], 0.8, 1e-8);
  EXPECT_NEAR(r["labs"][0]["kf11_factor"]["value"], 1, 1e-9);
  EXPECT_EQ(r["labs"][0]["kc11_factor"]["cuts"], 12);
  // of ln 1.25 and -ln 1.25
  const double between = 100 * std::sqrt(2.0) * std::log(1.25);
  EXPECT_NEAR(r["between_labs"]["kc11_factor_pct"], between, 1e-6);
  EXPECT_NEAR(r["between_labs"]["C_factor_pct"], between, 1e-5);
  // and that of their mean, half the square
  EXPECT_NEAR(r["material"]["kienzle"]["uncertainty_pct"], between * std::sqrt(1.5),
              1e-5);
  EXPECT_NEAR(r["material"]["taylor"]["uncertainty_pct"], between * std::sqrt(1.5), 1e-4);
  EXPECT_EQ(r["warnings"], json::array());

  json few = json::array();
  for (const json& c : all)
    if (c["lab"] == "ours" || few.size() == 1) few.push_back(c);
  q["cuts"] = few;
  r = answered(q);
  EXPECT_EQ(
      r["warnings"],
      json({"lab \"maker\" has one cut with a tool life, on which alone its factor "
            "rests",
            "lab \"maker\" has one cut with Fc_N, on which alone its factor rests",
            "lab \"maker\" has one cut with Ff_N, on which alone its factor rests",
            "lab \"maker\" has one cut with Fp_N, on which alone its factor rests"}));
}

TEST(CalibrateMaterial, TellsOfLabsThatSayLittle) {
  json q = edges(0.1);
  for (json& c : q["cuts"]) c["lab"] = "A";
  EXPECT_EQ(
      answered(q)["warnings"],
      json({"the cuts with a tool life that tell a constant are of one lab; how labs "
            "differ is not known"}));
  json b = q["cuts"][0];
  b["lab"] = "B";
  b["edge"] = "B1";
  b["T_longer_than_min"] = b["T_min"];
  b.erase("T_min");
  q["cuts"].push_back(b);
  const json r = answered(q);
  EXPECT_EQ(r["warnings"].back(),
            "lab \"B\" has no tool life that ended; its lives are not used");
  EXPECT_EQ(r["labs"], json({{{"lab", "A"}}, {{"lab", "B"}}}));
  EXPECT_FALSE(r.contains("between_labs"));
}

// Three replicas of three depths and three feeds, every force off by 5 %.
json replicas() {
  std::mt19937 seed(17);
  std::normal_distribution<double> normal(0, 0.05);
  const json plan = thrust_campaign()["cuts"];
  json cuts = json::array();
  for (const char* run : {"first", "second", "third"})
    for (json c : plan) {
      for (const char* force : {"Fc_N", "Ff_N", "Fp_N"})
        c[force] = c[force].get<double>() * std::exp(normal(seed));
      c["replica"] = run;
      cuts.push_back(c);
    }
  return {{"material", "test-steel"}, {"tool", tool()}, {"cuts", cuts}};
}

void expect_written(const json& q) {
  const json r = answered(q);
  const json& old = catalogue().material_documents.at("test-steel");
  ASSERT_FALSE(r["material"].is_null());
  EXPECT_NE(r["material"]["kienzle"], old["kienzle"]);
  ASSERT_TRUE(r.contains("feed_and_passive_by"));
  const std::string by = r["feed_and_passive_by"];
  EXPECT_NE(r["material"][by], old.contains(by) ? old[by] : json());
  EXPECT_EQ(r["warnings"], json::array());
}

TEST(CalibrateMaterial, EverySplitOfDepthsAndReplicasIsWritten) {
  const json all = replicas();
  for (const char* key : {"ap_mm", "replica"}) {
    std::set<json> values;
    for (const json& c : all["cuts"]) values.insert(c[key]);
    ASSERT_EQ(values.size(), 3u);
    for (const json& left : values) {
      json q = all;
      q["cuts"] = json::array();
      for (const json& c : all["cuts"])
        if (c[key] != left) q["cuts"].push_back(c);
      SCOPED_TRACE(left.dump());
      expect_written(q);
      const json r = answered(q);
      EXPECT_EQ(r["left_out"].size(), std::string(key) == "ap_mm" ? 2u : 3u);
      EXPECT_EQ(r["left_out_replicas"].size(), std::string(key) == "ap_mm" ? 3u : 2u);
      for (const char* kind : {"left_out", "left_out_replicas"})
        for (const json& l : r[kind]) {
          EXPECT_LT(l["Fc_rms_pct"], 15) << l;
          EXPECT_LT(l["Fp_rms_pct"], 15) << l;
        }
    }
  }
  EXPECT_EQ(answered(all)["left_out_replicas"][1]["replica"], "second");
}

TEST(CalibrateMaterial, RoughnessGivesTheLeastChip) {
  cutting::Cut c;
  c.corner = cutting::corner_of(0.8, 95 * M_PI / 180);
  c.hmin_mm = 0.004;
  c.surface_factor = 0.5;
  json q{{"material", "test-steel"}, {"tool", tool()}};
  q["tool"]["wiper"] = true;
  for (const double f : {0.08, 0.12, 0.2, 0.3}) {
    json cut{{"vc_m_min", 200}, {"f_mm_rev", f}, {"ap_mm", 0.5}};
    if (f < 0.15)
      cut["Ra_um"] = cutting::Ra_um(c, f);
    else
      cut["Rz_um"] = cutting::Rz_um(c, f);
    q["cuts"].push_back(cut);
  }
  json r = answered(q);
  EXPECT_NEAR(r["roughness"]["hmin_mm"]["value"], 0.004, 1e-8);
  EXPECT_EQ(r["roughness"]["cuts"], 4);
  EXPECT_NEAR(r["material"]["chip"]["hmin_mm"], 0.004, 1e-8);
  EXPECT_EQ(r["material"]["chip"]["source"], "measured cuts of the own shop");
  EXPECT_EQ(r["warnings"], json::array());
  q["tool"].erase("wiper");  // smoother than the corner is
  for (json& cut : q["cuts"])
    for (const char* key : {"Ra_um", "Rz_um"})
      if (cut.contains(key)) cut[key] = 0.2 * cut[key].get<double>();
  r = answered(q);
  EXPECT_EQ(r["roughness"]["hmin_mm"]["value"], 0);
  EXPECT_EQ(r["material"]["chip"]["uncertainty_pct"], 100);
  EXPECT_EQ(r["warnings"][0],
            "hmin_mm is 0: the cuts are as smooth as the corner alone makes them, or "
            "smoother");
  q["cuts"] = json::array({q["cuts"][0]});
  EXPECT_EQ(refused(q),
            "calibrate-material: /cuts: got 1 cuts with Ra_um or Rz_um that cannot tell "
            "hmin_mm, expected a second cut with a roughness");
  q["tool"]["re_mm"] = 0;
  EXPECT_EQ(refused(q),
            "calibrate-material: /tool/re_mm: got 0, expected a corner radius, which the "
            "roughness depends on");
}

TEST(CalibrateMaterial, CsvHasLivesLabsAndRoughness) {
  json q = edges(0.1);
  std::size_t i = 0;
  std::string csv =
      "vc_m_min,f_mm_rev,ap_mm,T_min,T_longer_than_min,edge,lab,replica,Ra_um\n";
  for (json& c : q["cuts"]) {
    c["lab"] = i % 4 < 2 ? "1" : "2";
    c["replica"] = i % 2 == 0 ? "a" : "b";
    c["Ra_um"] = 1.5 + 0.01 * static_cast<double>(i);
    if (++i == 3) c["T_longer_than_min"] = c["T_min"], c.erase("T_min");
    const auto cell = [&](const char* key) {
      return c.contains(key)
                 ? c[key].is_string() ? c[key].get<std::string>() : c[key].dump()
                 : "";
    };
    for (const char* key : {"vc_m_min", "f_mm_rev", "ap_mm", "T_min", "T_longer_than_min",
                            "edge", "lab", "replica"})
      csv += cell(key) + ',';
    csv += cell("Ra_um") + '\n';
  }
  json with_csv = q;
  with_csv.erase("cuts");
  with_csv["csv"] = csv;
  EXPECT_EQ(answered(with_csv), answered(q));
}

TEST(CalibrateMaterial, ListsAllThatIsWrongWithLives) {
  const auto cut = [](json members) {
    members.update({{"vc_m_min", 100}, {"f_mm_rev", 0.2}, {"ap_mm", 1}});
    return members;
  };
  EXPECT_EQ(
      refused({{"tool", tool()},
               {"wear_land_mm", 0},
               {"cuts",
                {cut({{"T_min", 5}, {"T_longer_than_min", 4}, {"lab", "A"}}),
                 cut({{"T_min", 5}, {"wear", {{3, 0.1}}}, {"edge", "e"}, {"lab", "A"}}),
                 cut({{"wear", {{3, 0.1}, {3, 0.2}, {4, -1}}}, {"lab", "B"}}),
                 cut({{"wear", {{1, 2, 3}}}, {"lab", ""}}),
                 cut({{"wear", json::array()}, {"T_longer_than_min", 0}, {"lab", "A"}}),
                 cut({{"T_min", 3}, {"edge", "e"}, {"lab", "A"}}),
                 cut({{"Ra_um", 0}, {"Rz_um", "rough"}})}}}),
      R"(calibrate-material: /wear_land_mm: got 0, expected a number > 0 and <= 5 mm
calibrate-material: /cuts/0/T_longer_than_min: got 4, expected one life: T_min, T_longer_than_min or wear
calibrate-material: /cuts/1/wear: got a list of 1 entry, expected one life: T_min, T_longer_than_min or wear
calibrate-material: /cuts/2/wear/1/0: got 3, expected a time after the one before, 3 min
calibrate-material: /cuts/2/wear/2/1: got -1, expected a number from 0 to 10 mm
calibrate-material: /cuts/3/wear/0: got [1,2,3], expected a list of 2 entries
calibrate-material: /cuts/3/lab: got "", expected a text of 1 to 200 bytes
calibrate-material: /cuts/4/T_longer_than_min: got 0, expected a number > 0 and <= 1000000 min
calibrate-material: /cuts/4/wear: got an empty list, expected a list of 1 to 1000 entries
calibrate-material: /cuts/4/wear: got an empty list, expected one life: T_min, T_longer_than_min or wear
calibrate-material: /cuts/6/Ra_um: got 0, expected a number > 0 and <= 1000 um
calibrate-material: /cuts/6/Rz_um: got "rough", expected a number > 0 and <= 1000 um
calibrate-material: /cuts/5: got edge "e", expected an edge without a life yet
calibrate-material: /cuts/6: got an object, expected a lab, as other cuts have)");
  json many{{"tool", tool()}, {"cuts", json::array()}};
  for (int k = 0; k < 13; ++k)
    many["cuts"].push_back(cut({{"Fc_N", 5}, {"lab", std::to_string(k)}}));
  EXPECT_EQ(
      refused(many),
      "calibrate-material: /cuts: got a list of 13 entries, expected 12 labs at most");
}

}  // namespace
}  // namespace turnwright::document::calibrate_material_test
