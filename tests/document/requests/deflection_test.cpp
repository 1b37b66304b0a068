#include "turnwright/document/deflection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "../slips.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::deflection_test {
namespace {

using nlohmann::json;

json from_file(const std::string& path) {
  return json::parse(std::ifstream(source_path(path)));
}

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("deflection.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("deflection.result.json");
  EXPECT_EQ(request_schema().fault(request), "") << request;
  json result = deflection(request);
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) { return input_refusal(deflection, request); }

json bar_segment(double length, double d) {
  return {{"length_mm", length},
          {"outer_left_mm", d},
          {"outer_right_mm", d},
          {"inner_left_mm", 0},
          {"inner_right_mm", 0}};
}

json request(const char* method = "chuck") {
  return {{"shaft",
           {{"E_MPa", 210000},
            {"nu", 0.3},
            {"segments", {bar_segment(80, 60), bar_segment(120, 40)}}}},
          {"clamping", {{"method", method}}},
          {"positions_mm", {40, 80, 120}},
          {"load", {{"Fr_N", 250}, {"Ft_N", 600}, {"Fa_N", 180}}}};
}

TEST(Deflection, ReferenceFileThroughTheDoor) {
  const json file = from_file("tests/data/deflection_reference.json");
  const json shafts = file.at("shafts");
  for (const json& c : file.at("cases")) {
    json q = request();
    for (const json& s : shafts)
      if (s.at("id") == c.at("shaft")) {
        q["shaft"] = {
            {"E_MPa", s.at("E")}, {"nu", s.at("nu")}, {"segments", json::array()}};
        for (const json& g : s.at("segments"))
          q["shaft"]["segments"].push_back({{"length_mm", g.at("len")},
                                            {"outer_left_mm", g.at("de0")},
                                            {"outer_right_mm", g.at("de1")},
                                            {"inner_left_mm", g.at("di0")},
                                            {"inner_right_mm", g.at("di1")}});
      }
    const std::string clamp = c.at("clamp");
    q["clamping"]["method"] = clamp == "chuck"     ? "chuck"
                              : clamp == "centres" ? "between-centres"
                                                   : "chuck-tailstock";
    const json k = file.at("supports").at(c.at("support").get<std::string>());
    if (!k.at("rigid").get<bool>())
      for (const auto& [plane, p] :
           {std::pair{"radial", "r"}, std::pair{"tangential", "t"}}) {
        const auto spring = [&](const std::string& name) {
          return k.at(name + p).get<double>();
        };
        const double Lc = k.at("Lc"), k2 = spring("k2");
        q["clamping"]["chuck"][plane] = {{"c0_mm_N", 1 / spring("k1") + Lc * Lc / k2},
                                         {"c1_rad_N", Lc / k2},
                                         {"c2_rad_Nmm", 1 / k2 + 1 / spring("k3")}};
        const std::string key = std::string(plane) + "_mm_N";
        q["clamping"]["tail_centre"][key] = 1 / spring("kt");
        q["clamping"]["head_centre"][key] = 1 / spring("kh");
      }
    q["positions_mm"] = c.at("positions");
    const json result = answered(q);

    const auto compare = [&](const std::string& name, const json::json_pointer& at) {
      const std::vector<double> expected = c.at(name);
      double largest = 0;
      for (const double x : expected) largest = std::max(largest, std::abs(x));
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(result["positions"][i].at(at), expected[i], 1e-12 * largest)
            << c.at("shaft") << clamp << name;
    };
    compare("f_ww_r", "/radial/f_ww_mm_N"_json_pointer);
    compare("f_wp_r", "/radial/f_wp_rad_N"_json_pointer);
    compare("f_pp_r", "/radial/f_pp_rad_Nmm"_json_pointer);
    compare("f_ww_t", "/tangential/f_ww_mm_N"_json_pointer);
    compare("f_wp_t", "/tangential/f_wp_rad_N"_json_pointer);
    compare("f_pp_t", "/tangential/f_pp_rad_Nmm"_json_pointer);
    compare("delta_r", "/delta_r_mm"_json_pointer);
    compare("delta_t", "/delta_t_mm"_json_pointer);
    compare("theta_r", "/theta_r_rad"_json_pointer);
    compare("radius_error", "/radius_error_mm"_json_pointer);
    compare("positions", "/a_mm"_json_pointer);
    // the tail carries its share of Fr and of the couple -Fa D/2
    for (std::size_t i = 0; i < result["positions"].size(); ++i) {
      const double RF = c.at("RF_r").at(i), RC = c.at("RC_r").at(i),
                   D = c.at("D_tool").at(i);
      EXPECT_NEAR(result["positions"][i]["tail_reaction_N"], RF * 250 - RC * 180 * D / 2,
                  1e-10);
      EXPECT_GE(result["envelope"]["max_mm"].get<double>() * (1 + 1e-12),
                std::abs(result["positions"][i]["radius_error_mm"].get<double>()));
    }
  }
}

TEST(Deflection, ExamplesOfTheSchemaAreAnswered) {
  const auto schema = from_file("schemas/deflection.request.json");
  for (const json& example : schema["examples"]) answered(example);
}

TEST(Deflection, EnvelopeCountsBothSidesOfAStep) {
  // right of the step the couple is smaller (D = 40, not 60) and the error larger than
  // what the door says of the position itself
  json q = request("between-centres");
  q["shaft"]["segments"] = {bar_segment(100, 60), bar_segment(100, 59)};
  q["positions_mm"] = {100};
  const json r = answered(q);
  EXPECT_GT(r["envelope"]["max_mm"], r["positions"][0]["radius_error_mm"]);
}

TEST(Deflection, ForceLawIsTheLinearFormulaWhereThatHolds) {
  json q = request();
  q.erase("load");
  q["force_law"] = {
      {"c_N", 400}, {"x", 1}, {"Fa_over_Fr", 0.6}, {"Ft_over_Fr", 0}, {"ap_mm", 1.5}};
  const json r = answered(q);
  for (const json& p : r["positions"]) {
    const double mu = p["loop_gain"], D = p["a_mm"] <= 80 ? 60 : 40;
    const double A = p["radial"]["f_ww_mm_N"].get<double>() -
                     p["radial"]["f_wp_rad_N"].get<double>() * 0.6 * D / 2;
    EXPECT_NEAR(mu, 400 * A, 1e-15);
    EXPECT_NEAR(p["radius_error_mm"], 1.5 * mu / (1 + mu), 1e-15);
    EXPECT_NEAR(p["radius_error_without_feedback_mm"], 1.5 * mu, 1e-15);
    EXPECT_NEAR(p["Fr_N"], 400 * 1.5 / (1 + mu), 1e-10);
    EXPECT_NEAR(p["delta_r_mm"], p["radius_error_mm"], 1e-15);
  }
}

TEST(Deflection, ADigInIsOutsideTheModel) {
  json q = request();
  q.erase("load");
  q["force_law"] = {
      {"c_N", 1e7}, {"x", 1}, {"Fa_over_Fr", 50}, {"Ft_over_Fr", 0}, {"ap_mm", 1.5}};
  EXPECT_THROW(deflection(q), ModelRangeError);
}

TEST(Deflection, InProcessAndShouldersChangeTheStiffness) {
  const double plain = answered(request())["positions"][2]["delta_t_mm"];
  json q = request();
  q["in_process"] = {{"ap_mm", 2}, {"feed_towards", "chuck"}};
  EXPECT_LT(answered(q)["positions"][2]["delta_t_mm"], plain);
  q["in_process"]["feed_towards"] = "tail";
  EXPECT_EQ(answered(q)["positions"][2]["delta_t_mm"], plain);
  q = request();
  q["shoulder_correction"] = true;
  EXPECT_GT(answered(q)["positions"][2]["delta_t_mm"], plain);
}

TEST(Deflection, ASteadyRestHoldsThePartWhereItStands) {
  // two equal spans between centres, so slender that shear is nothing: 23 F l^3/1536 EI
  // under a force in the middle of one, the rest takes 11/16, the far centre is lifted
  // by 3/32
  json q = request("between-centres");
  const double l = 1e4, d = 1, EI = 210000 * 3.14159265358979324 / 64;
  q["shaft"]["segments"] = {bar_segment(2 * l, d)};
  q["clamping"]["steady"] = {{"at_mm", l}};
  q["positions_mm"] = {l / 2, l};
  q["load"] = {{"Fr_N", 2}, {"Ft_N", 0}, {"Fa_N", 0}};
  const json r = answered(q)["positions"];
  EXPECT_NEAR(r[0]["delta_r_mm"].get<double>() / (2 * 23 * l * l * l / (1536 * EI)), 1,
              1e-7);
  EXPECT_NEAR(r[0]["rest_reaction_N"], 2 * 11.0 / 16, 1e-7);
  EXPECT_NEAR(r[0]["tail_reaction_N"], -2 * 3.0 / 32, 1e-7);
  EXPECT_NEAR(r[1]["delta_r_mm"], 0, 1e-12);
  EXPECT_NEAR(r[1]["rest_reaction_N"], 2, 1e-12);
  // no rest, no word of it
  q["clamping"].erase("steady");
  EXPECT_FALSE(answered(q)["positions"][0].contains("rest_reaction_N"));
}

TEST(Deflection, ASoftSteadyRestIsNoneInAllThatIsAsked) {
  json q = request("chuck-tailstock");
  q["in_process"] = {{"ap_mm", 1}, {"feed_towards", "chuck"}};
  q["face"] = {
      {"z_mm", 150}, {"rho_min_mm", 2}, {"rho_max_mm", 20}, {"Ff_N", 90}, {"Fp_N", 260}};
  q.erase("load");
  q["force_law"] = {
      {"c_N", 220}, {"x", 1}, {"Fa_over_Fr", 0.6}, {"Ft_over_Fr", 2.2}, {"ap_mm", 1}};
  const json without = answered(q);
  q["clamping"]["steady"] = {{"at_mm", 110}, {"radial_mm_N", 1}, {"tangential_mm_N", 1}};
  const json soft = answered(q);
  q["clamping"]["steady"] = {{"at_mm", 110}};
  const json rigid = answered(q);
  const auto near = [](const json& x, const json& y, double part) {
    EXPECT_NEAR(x.get<double>() / y.get<double>(), 1, part);
  };
  near(soft["positions"][2]["radius_error_mm"],
       without["positions"][2]["radius_error_mm"], 1e-3);
  near(soft["envelope"]["max_mm"], without["envelope"]["max_mm"], 1e-3);
  near(soft["face"]["peak_to_valley_mm"], without["face"]["peak_to_valley_mm"], 1e-3);
  EXPECT_LT(rigid["envelope"]["max_mm"], without["envelope"]["max_mm"]);
  EXPECT_LT(rigid["positions"][2]["radius_error_mm"],
            without["positions"][2]["radius_error_mm"]);
  // at equilibrium the rest carries what the loads of that force ask for
  const json& p = rigid["positions"][2];
  EXPECT_GT(p["rest_reaction_N"].get<double>(), 0);
  EXPECT_LT(p["rest_reaction_N"].get<double>(), 1.2 * p["Fr_N"].get<double>());
}

TEST(Deflection, ASteadyRestStandsBetweenTheEnds) {
  json q = request();
  for (const int z : {0, 200}) {
    q["clamping"]["steady"] = {{"at_mm", z}, {"radial_mm_N", -1}};
    EXPECT_EQ(refused(q),
              "deflection: /clamping/steady/at_mm: got " + std::to_string(z) +
                  ", expected a number > 0 and < 200 mm\n"
                  "deflection: /clamping/steady/radial_mm_N: got -1, expected a number "
                  "from 0 to 1 mm/N");
  }
  q = request("boring-bar");
  q["clamping"]["tip_offset_mm"] = 13;
  q["clamping"]["bore_diameter_mm"] = 60;
  q["clamping"]["steady"] = {{"at_mm", 50}};
  EXPECT_NE(request_schema().fault(q), "");
  EXPECT_EQ(refused(q),
            "deflection: /clamping/steady: got an object, expected no such key");
}

TEST(Deflection, ShouldersAgainstThreeDimensionalElasticity) {
  const json file = from_file("tests/data/stepped_cantilevers.json");
  EXPECT_GE(file.at("cases").size(), 7u);
  for (const json& c : file.at("cases")) {
    json q = request();
    q["shaft"] = {{"E_MPa", file.at("E_MPa")}, {"nu", file.at("nu")}, {"segments", {}}};
    double end = 0;
    for (const json& s : c.at("segments")) {
      q["shaft"]["segments"].push_back(
          bar_segment(s.at("length_mm"), s.at("diameter_mm")));
      end += s.at("length_mm").get<double>();
    }
    q["positions_mm"] = {end};
    q["load"] = {{"Fr_N", 1000}, {"Ft_N", 0}, {"Fa_N", 0}};
    q["shoulder_correction"] = true;
    const double f = c.at("meshes").back().at("f_mm_N");
    EXPECT_NEAR(answered(q)["positions"][0]["delta_r_mm"].get<double>() / (1000 * f), 1,
                0.03)
        << c.at("name");
  }
}

TEST(Deflection, FaceNeedsNeitherPositionsNorLoad) {
  json q = request();
  q.erase("load");
  q.erase("positions_mm");
  q["face"] = {
      {"z_mm", 200}, {"rho_min_mm", 0}, {"rho_max_mm", 20}, {"Ff_N", 90}, {"Fp_N", 0}};
  const json r = answered(q);
  json end = request();
  end["positions_mm"] = {200};
  const double f_wp = answered(end)["positions"][0]["radial"]["f_wp_rad_N"];
  EXPECT_NEAR(r["face"]["peak_to_valley_mm"], f_wp * 90 * 20, 1e-17);
  EXPECT_EQ(r["face"]["profile"]["g_mm"].size(), r["face"]["profile"]["rho_mm"].size());
  EXPECT_TRUE(r["positions"].empty());
}

TEST(Deflection, BoringBarTellsItsTip) {
  json q = request();
  q.erase("positions_mm");
  q["clamping"] = {
      {"method", "boring-bar"}, {"tip_offset_mm", 13}, {"bore_diameter_mm", 60}};
  const json r = answered(q);
  EXPECT_FALSE(r.contains("envelope"));
  const double y_r = r["y_r_mm"], y_t = r["y_t_mm"];
  EXPECT_NEAR(r["bore_radius_error_mm"], -y_r + y_t * y_t / 60, 1e-18);
  q["positions_mm"] = {200};
  const json tip = answered(q)["positions"][0];
  const double f_ww = tip["radial"]["f_ww_mm_N"], f_wp = tip["radial"]["f_wp_rad_N"];
  EXPECT_NEAR(y_r, 250 * f_ww - 180 * 13 * f_wp, 1e-16);
  EXPECT_NEAR(y_t, 600 * (f_ww + 169 * r["twist_rad_Nmm"].get<double>()), 1e-16);
}

// x = 1 and no tangential force: e_n = (ap_n + e_(n-1)) mu/(1 + mu), and the run-out is
// multiplied by mu/(1 + mu) in every pass, spring passes included.
TEST(Deflection, PassesInARowLeaveAndCopyWhatTheLinearLawSays) {
  json q = request();
  q.erase("load");
  q["force_law"] = {
      {"c_N", 4000},           {"x", 1},     {"Fa_over_Fr", 0},
      {"Ft_over_Fr", 0},       {"ap_mm", 1}, {"passes_ap_mm", {1, 0.3, 0, 0}},
      {"blank_runout_mm", 0.2}};
  const json answer = answered(q);
  for (const json& at : answer.at("positions")) {
    const double mu = at.at("loop_gain"), keeps = mu / (1 + mu);
    double e = 0, runout = 0.2;
    for (std::size_t i = 0; i < 4; ++i) {
      e = (q["force_law"]["passes_ap_mm"][i].get<double>() + e) * keeps;
      runout *= keeps;
      EXPECT_NEAR(at.at("errors_of_passes_mm")[i], e, 1e-12);
      EXPECT_NEAR(at.at("copied_runout_mm")[i], runout, 1e-12);
    }
  }
  q["force_law"]["blank_runout_mm"] = 1;
  EXPECT_EQ(
      refused(q),
      "deflection: /force_law/blank_runout_mm: got 1, expected a number >= 0 and < 1 "
      "mm");
  q["force_law"]["passes_ap_mm"] = {0, 1};
  q["force_law"].erase("blank_runout_mm");
  EXPECT_EQ(refused(q),
            "deflection: /force_law/passes_ap_mm: got [0,1], expected a first pass that "
            "cuts: above 0 mm");
  q["force_law"].erase("passes_ap_mm");
  q["force_law"]["blank_runout_mm"] = 0.1;
  EXPECT_EQ(refused(q),
            "deflection: /force_law/blank_runout_mm: got 0.1, expected nothing without "
            "passes_ap_mm");
}

// Two opposite flats at h: xx and yy of the middle strip by integration over x; a uniform
// cantilever bends by a^3/(3 E I) each way.
TEST(Deflection, AShaftWithFlatsIsSofterAcrossThem) {
  const double R = 20, h = 14, L = 200;
  json q = request();
  json segment = bar_segment(L, 2 * R);
  segment["slots"] = {{{"floor_mm", h}, {"angle_deg", 30}},
                      {{"floor_mm", h}, {"angle_deg", -150}}};
  q["shaft"]["segments"] = json::array({segment});
  q["positions_mm"] = {150};
  double across = 0, along = 0;  // int x^2 dA and int y^2 dA, x towards a flat
  constexpr int kStrips = 200000;
  for (int k = 0; k < kStrips; ++k) {
    const double dx = 2 * h / kStrips, x = -h + (k + 0.5) * dx;
    const double half = std::sqrt(R * R - x * x);
    across += x * x * 2 * half * dx;
    along += 2 * half * half * half / 3 * dx;
  }
  const double soft = std::pow(150, 3) / (3 * 210000 * across),
               stiff = std::pow(150, 3) / (3 * 210000 * along);
  const json oval = answered(q).at("positions")[0].at("oval");
  EXPECT_NEAR(oval.at("mean_mm_N"), (soft + stiff) / 2, 1e-9 * soft);
  EXPECT_NEAR(oval.at("lobe_mm_N"), (soft - stiff) / 2, 1e-9 * soft);
  EXPECT_NEAR(oval.at("softest_deg"), 30, 1e-6);
  EXPECT_NEAR(oval.at("amplitude_mm"), (soft - stiff) / 2 * std::hypot(250, 600),
              1e-9 * soft * 650);
}

TEST(Deflection, SlotsLieInTheRimOfACylinder) {
  const auto with = [](json slots) {
    json q = request();
    q["shaft"]["segments"][0]["slots"] = std::move(slots);
    return q;
  };
  const json key{{"width_mm", 18}, {"floor_mm", 23}};
  const json one = json::array({key});
  EXPECT_NE(answered(with(one)).at("positions")[0].at("oval").at("lobe_mm_N"), 0);
  EXPECT_EQ(
      refused(with({{{"width_mm", 61}, {"floor_mm", 1}}})),
      "deflection: /shaft/segments/0/slots/0/width_mm: got 61, expected a number > 0 "
      "and <= 60 mm");
  EXPECT_EQ(
      refused(with({{{"width_mm", 36}, {"floor_mm", 24}}})),
      "deflection: /shaft/segments/0/slots/0/floor_mm: got 24, expected a number >= 0 "
      "and < 24 mm");
  EXPECT_EQ(refused(with(json::array({key, key}))),
            "deflection: /shaft/segments/0/slots/1: got an object, expected a slot that "
            "does not meet another");
  // Apart at the rim, by 30 degrees, but wide and deep enough to meet further in.
  const json wide{{"width_mm", 30}, {"floor_mm", 1}};
  json across = wide;
  across["angle_deg"] = 90;
  EXPECT_NE(refused(with({wide, across})).find("slots/1: "), std::string::npos);
  across["floor_mm"] = 16;  // beside the other's side
  EXPECT_NO_THROW(answered(with({wide, across})));
  // Halves: one may go, down to a floor that is the middle's but for rounding.
  EXPECT_NO_THROW(answered(with({{{"floor_mm", 1e-9}}})));
  EXPECT_NE(refused(with({{{"floor_mm", 0}}, {{"floor_mm", 0}, {"angle_deg", 180}}}))
                .find("slots/1: "),
            std::string::npos);
  json cone = with(one);
  cone["shaft"]["segments"][1]["outer_right_mm"] = 39;
  EXPECT_NE(refused(cone).find("/shaft/segments: "), std::string::npos) << refused(cone);
  json rest = with(one);
  rest["clamping"]["steady"] = {{"at_mm", 100}};
  EXPECT_NE(refused(rest).find("no slots with a steady rest"), std::string::npos)
      << refused(rest);
}

TEST(Deflection, ThinWallsWarn) {
  json q = request();
  q["shaft"]["segments"][1]["inner_left_mm"] = 33;
  const json r = answered(q);
  ASSERT_EQ(r["warnings"].size(), 1u);
  EXPECT_EQ(
      r["warnings"][0],
      "/shaft/segments/1: the wall is thinner than 0.2 of the radius; rings ovalise "
      "and the beam model is void");
  EXPECT_TRUE(answered(request())["warnings"].empty());
}

TEST(Deflection, AllProblemsAtOnce) {
  json q = request("chuk");
  q["shaft"]["nu"] = 0.5;
  q["shaft"]["segments"][0]["length_mm"] = -40;
  q["shaft"]["segments"][1]["inner_right_mm"] = 41;
  q["shaft"]["segments"][1]["diamter_mm"] = 3;
  q["positions_mm"] = {10, "x"};
  q["load"].erase("Ft_N");
  q["shoulder_correction"] = 1;
  EXPECT_EQ(refused(q),
            R"(deflection: /shaft/nu: got 0.5, expected a number >= 0 and < 0.5
deflection: /shaft/segments/0/length_mm: got -40, expected a number > 0 and <= 1000000 mm
deflection: /shaft/segments/1/diamter_mm: got 3, expected no such key
deflection: /shaft/segments/1/inner_right_mm: got 41, expected a number >= 0 and < 40 mm
deflection: /clamping/method: got "chuk", expected "chuck", "between-centres", "chuck-tailstock" or "boring-bar" (did you mean "chuck"?)
deflection: /positions_mm/1: got "x", expected a number >= 0 mm
deflection: /shoulder_correction: got 1, expected true or false
deflection: /load/Ft_N: got nothing, expected a number from -1000000000 to 1000000000 N)");
}

TEST(Deflection, PlacesMustBeOnTheShaft) {
  json q = request();
  q["positions_mm"] = {-1, 0, 200, 200.001};
  EXPECT_EQ(refused(q),
            R"(deflection: /positions_mm/0: got -1, expected a number from 0 to 200 mm
deflection: /positions_mm/3: got 200.001, expected a number from 0 to 200 mm)");
  q = request();
  q["face"] = {
      {"z_mm", 201}, {"rho_min_mm", 20}, {"rho_max_mm", 20}, {"Ff_N", 90}, {"Fp_N", 0}};
  EXPECT_EQ(refused(q),
            R"(deflection: /face/z_mm: got 201, expected a number from 0 to 200 mm
deflection: /face/rho_min_mm: got 20, expected a number >= 0 and < 20 mm)");
}

TEST(Deflection, AFaceLiesOnTheShaft) {
  json q = request();
  q["shaft"]["segments"][1]["outer_right_mm"] = 30;
  q["shaft"]["segments"][1]["inner_left_mm"] = 10;
  const auto with = [&](double z, double rho_min, double rho_max) {
    q["face"] = {{"z_mm", z},
                 {"rho_min_mm", rho_min},
                 {"rho_max_mm", rho_max},
                 {"Ff_N", 90},
                 {"Fp_N", 0}};
    EXPECT_EQ(request_schema().fault(q), "");
    return refused(q);
  };
  // 40 to 30 mm outside, 10 to 0 mm inside: half way 35 and 5 mm
  EXPECT_EQ(with(140, 2.5, 17.5), "");
  EXPECT_EQ(with(140, 2.5 * (1 - 1e-15), 17.5 * (1 + 1e-15)), "");
  EXPECT_EQ(
      with(140, 2.4, 17.6),
      R"(deflection: /face/rho_min_mm: got 2.4, expected a number >= 2.5 and < 17.5 mm
deflection: /face/rho_max_mm: got 17.6, expected a number > 0 and <= 17.5 mm)");
  EXPECT_EQ(
      with(140, 9, 8),
      R"(deflection: /face/rho_min_mm: got 9.0, expected a number >= 2.5 and < 8 mm)");
  // at a step the face of either side: 30 mm radius left of it, no bore there
  EXPECT_EQ(with(80, 0, 30), "");
  EXPECT_EQ(
      with(80, 0, 31),
      R"(deflection: /face/rho_max_mm: got 31.0, expected a number > 0 and <= 30 mm)");
  EXPECT_EQ(with(104, 0, 30),
            R"(deflection: /face/rho_min_mm: got 0.0, expected a number >= 4 and < 19 mm
deflection: /face/rho_max_mm: got 30.0, expected a number > 0 and <= 19 mm)");
  EXPECT_EQ(with(0, 0, 30), "");
  EXPECT_EQ(with(200, 0, 15), "");
  // without a place no radius is too large
  EXPECT_EQ(with(201, 0, 1000),
            "deflection: /face/z_mm: got 201.0, expected a number from 0 to 200 mm");
}

TEST(Deflection, ABoringBarFitsItsBore) {
  json q = request();
  q["shaft"]["segments"] = {bar_segment(60, 32), bar_segment(80, 25)};
  const auto with = [&](double tip_offset, double bore) {
    q["clamping"] = {{"method", "boring-bar"},
                     {"tip_offset_mm", tip_offset},
                     {"bore_diameter_mm", bore}};
    return refused(q);
  };
  EXPECT_EQ(with(16, 32), "");
  EXPECT_EQ(with(44, 60), "");
  EXPECT_EQ(with(16, 31.9),
            "deflection: /clamping/bore_diameter_mm: got 31.9, expected a number >= 32 "
            "mm, the bar's largest diameter");
  EXPECT_EQ(with(44.1, 60),
            "deflection: /clamping/tip_offset_mm: got 44.1, expected a number from 0 to "
            "44 mm");
  // a bar that is no body is no measure
  q["shaft"]["segments"][0]["length_mm"] = 0;
  EXPECT_EQ(with(44.1, 60),
            "deflection: /shaft/segments/0/length_mm: got 0, expected a number > 0 and "
            "<= 1000000 mm");
}

TEST(Deflection, ABarWiderThanItsTipReachesIsWarnedOf) {
  json q = request();
  q["shaft"]["segments"] = {bar_segment(60, 32), bar_segment(80, 25)};
  q["positions_mm"] = {140};
  q["clamping"] = {
      {"method", "boring-bar"}, {"tip_offset_mm", 15.9}, {"bore_diameter_mm", 60}};
  EXPECT_EQ(answered(q)["warnings"],
            json({"/clamping/tip_offset_mm: the bar's radius is larger; where it is "
                  "widest it touches the bore before its tip does"}));
  q["clamping"]["tip_offset_mm"] = 16;
  EXPECT_TRUE(answered(q)["warnings"].empty());
}

TEST(Deflection, RoundingInASumOfLengthsIsForgiven) {
  json q = request();
  q["shaft"]["segments"] = {bar_segment(0.1, 1), bar_segment(0.2, 1)};
  q["positions_mm"] = {0.1 + 0.2, 0.3};
  EXPECT_EQ(refused(q), "");
}

TEST(Deflection, TheClampingMustBeAnElasticBody) {
  json q = request();
  q["clamping"]["chuck"]["radial"] = {
      {"c0_mm_N", 1e-5}, {"c1_rad_N", 1e-6}, {"c2_rad_Nmm", 1e-9}};
  q["clamping"]["tail_centre"] = {{"radial_mm_N", -1}};
  EXPECT_EQ(
      refused(q),
      R"(deflection: /clamping/chuck/radial: got an object, expected c0_mm_N times c2_rad_Nmm at least c1_rad_N squared
deflection: /clamping/tail_centre/radial_mm_N: got -1, expected a number from 0 to 1 mm/N)");
}

TEST(Deflection, MembersThatExcludeEachOther) {
  json q = request();
  q["force_law"] = {
      {"c_N", 220}, {"x", 1}, {"Fa_over_Fr", 0.6}, {"Ft_over_Fr", 2.2}, {"ap_mm", 1}};
  EXPECT_NE(request_schema().fault(q), "");
  EXPECT_EQ(
      refused(q),
      R"(deflection: /force_law: got an object, expected either load or force_law)");
  q = request();
  q.erase("load");
  EXPECT_NE(request_schema().fault(q), "");
  EXPECT_EQ(refused(q), R"(deflection: /load: got nothing, expected load or force_law)");
  q = request("boring-bar");
  q["in_process"] = {{"ap_mm", 2}, {"feed_towards", "chuck"}};
  EXPECT_NE(request_schema().fault(q), "");
  EXPECT_EQ(
      refused(q),
      R"(deflection: /clamping/tip_offset_mm: got nothing, expected a number from 0 to 100000 mm
deflection: /clamping/bore_diameter_mm: got nothing, expected a number > 0 and <= 100000 mm
deflection: /in_process: got an object, expected nothing: a boring bar is not turned)");
}

TEST(Deflection, ResultsBeyondADoubleAreOutsideTheModel) {
  json q = request();
  q["shaft"]["E_MPa"] = 1e-99;
  for (json& segment : q["shaft"]["segments"]) {
    segment["length_mm"] = 1e6;
    segment["outer_left_mm"] = segment["outer_right_mm"] = 2e-9;
    segment["inner_left_mm"] = segment["inner_right_mm"] = 0;
  }
  q["positions_mm"] = {1e6};
  EXPECT_THROW(deflection(q), ModelRangeError);
}

TEST(Deflection, AnythingButAnObjectIsRefused) {
  for (const json& q : {json(nullptr), json(3), json::array(), json("x")})
    EXPECT_NE(refused(q), "");
}

}  // namespace
}  // namespace turnwright::document::deflection_test
