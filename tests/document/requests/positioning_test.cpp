#include "turnwright/document/positioning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/geometry.hpp"

namespace turnwright::document::positioning_test {
namespace {

using nlohmann::json;

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("positioning.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("positioning.result.json");
  EXPECT_EQ(request_schema().fault(request), "");
  json result = positioning(request);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) { return refusal(positioning, request); }

std::vector<json> examples() {
  return parse_file(source_path("schemas/positioning.request.json"))["examples"];
}

/// Five runs at 0, 57, .. whose mean in + rises by 35 um/m, 4 um below that in -.
json laser() {
  json q = json::array(), plus = json::array(), minus = json::array();
  for (int run = -2; run <= 2; ++run)
    for (const double at : {0.0, 57.0, 121.0, 178.0, 243.0}) {
      q.push_back(at);
      plus.push_back(0.035 * at - 4 + 0.1 * run);
      minus.push_back(0.035 * at + 0.2 * run);
    }
  return {{"axis", "X"},
          {"readings", {{"q_mm", q}, {"plus", plus}, {"minus", minus}, {"unit", "um"}}}};
}

// Standard deviations are sqrt(2.5) times 0.1 and 0.2 um.
TEST(Positioning, AnswersWithTheValuesOfIso230_2) {
  const json result = answered(laser());
  const double s = std::sqrt(2.5), rise = 0.035 * 243;
  const json& v = result["iso230_2"];
  const auto near = [&v](const char* key, double value) {
    EXPECT_NEAR(v[key].get<double>(), value, 1e-9) << key;
  };
  near("B_um", 4);
  near("B_mean_um", -4);
  near("M_um", rise);
  near("E_um", rise + 4);
  near("E_plus_um", rise);
  near("R_plus_um", 0.4 * s);
  near("R_minus_um", 0.8 * s);
  near("R_um", 0.6 * s + 4);
  near("A_um", rise + 4 + 0.6 * s);
  near("A_minus_um", rise + 0.8 * s);
  ASSERT_EQ(result["positions"].size(), 5u);
  EXPECT_EQ(result["positions"][1]["q_mm"], 57);
  EXPECT_EQ(result["positions"][1]["approaches_minus"], 5);
  EXPECT_EQ(result["warnings"], json::array());
  EXPECT_FALSE(result.contains("comp_file"));
}

// The same in mm, as a table with other names, and with the decimal commas of a German one.
TEST(Positioning, TablesAreReadAsTheyAreExported) {
  const json lists = laser();
  const auto& r = lists["readings"];
  std::string csv = "rück;vor;Lauf;Soll\n";
  const auto comma = [](double x) {
    std::string text = std::to_string(x);
    std::ranges::replace(text, '.', ',');
    return text;
  };
  for (std::size_t i = 0; i < r["q_mm"].size(); ++i)
    csv += comma(r["minus"][i]) + ';' + comma(r["plus"][i]) + ";1;" +
           comma(r["q_mm"][i]) + '\n';
  const json table{
      {"axis", "X"},
      {"readings",
       {{"csv", csv},
        {"unit", "um"},
        {"columns", {{"q_mm", "Soll"}, {"plus", "vor"}, {"minus", "rück"}}}}}};
  const json a = answered(lists), b = answered(table);
  for (const auto& [key, value] : a["iso230_2"].items())
    EXPECT_NEAR(value.get<double>(), b["iso230_2"][key].get<double>(), 1e-5) << key;
  // One column is enough.
  const json one = answered(
      {{"axis", "Z"},
       {"readings",
        {{"unit", "mm"},
         {"csv", {"q_mm,minus", "0,0.001", "0,0.003", "50,0.004", "50,0.006"}}}}});
  EXPECT_NEAR(one["iso230_2"]["E_minus_um"].get<double>(), 3, 1e-12);
  EXPECT_FALSE(one["iso230_2"].contains("B_um"));
  EXPECT_FALSE(one["table"].contains("plus"));
}

TEST(Positioning, SaysWhatTheTestLacks) {
  const json result = answered(
      {{"axis", "X"},
       {"readings",
        {{"q_mm", {0, 100, 200, 300}}, {"plus", {0, 1, 2, 3}}, {"unit", "um"}}}});
  const json wanted = {
      "The axis was measured in one direction: what needs both is missing.",
      "Positions were approached once: repeatability and accuracy are missing.",
      "ISO 230-2 approaches each position 5 times from each side; here it is 1.",
      "ISO 230-2 has at least 5 positions over 300 mm; here are 4.",
      "The positions stand at one interval of 100 mm: an error that repeats with it is "
      "not "
      "seen."};
  EXPECT_EQ(result["warnings"], wanted);
  // Beyond 2 m positions some 250 mm apart are approached once.
  const json long_axis =
      answered({{"axis", "X"},
                {"readings",
                 {{"q_mm", {0, 260, 490, 760, 1010, 1240, 1500, 1760, 2010, 2250}},
                  {"plus", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}},
                  {"minus", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}},
                  {"unit", "um"}}}});
  EXPECT_EQ(
      long_axis["warnings"],
      json({"Positions were approached once: repeatability and accuracy are missing."}));
  // A machine and a file are not measured here.
  for (const json& example : examples())
    if (!example.contains("readings")) {
      EXPECT_EQ(answered(example)["warnings"], json::array());
    }
}

// Lines of type 1 read as those of type 0, and readings in um as if they were in mm.
TEST(Positioning, DoubtsDeviationsThatNoAxisHas) {
  json request{{"axis", "X"},
               {"comp_file", {{"type", 0}, {"text", "0 0 0.004\n100 0.01 0.002"}}}};
  EXPECT_EQ(answered(request)["warnings"],
            json({"The deviation changes by 100 mm over 100 mm at 100 mm: are unit and "
                  "type of the file right?"}));
  request["comp_file"]["type"] = 1;
  EXPECT_EQ(answered(request)["warnings"], json::array());
  // Readings where the axis really stopped scatter.
  request["comp_file"]["text"] = "0 0 0\n1e-4 0.005 -0.005";
  EXPECT_EQ(answered(request)["warnings"], json::array());
  request = laser();
  request["readings"]["unit"] = "mm";
  EXPECT_EQ(answered(request)["warnings"].size(), 1u);
}

// The file of a table, read as a table again, and in the other type and unit.
TEST(Positioning, ACompensationFileComesBack) {
  json request = laser();
  request["write_comp_file"] = {{"type", 1}, {"unit", "inch"}};
  const json written = answered(request);
  EXPECT_EQ(written["comp_file"]["text"].get<std::string>().substr(0, 30),
            "0.0000000 0.0001575 0.0000000\n");
  const json back = answered({{"axis", "X"},
                              {"comp_file", written["comp_file"]},
                              {"write_comp_file", json::object()}});
  for (std::size_t i = 0; i < 5; ++i)
    for (const char* key : {"q_mm", "mean_plus_um", "mean_minus_um", "B_um"})
      EXPECT_NEAR(written["positions"][i][key].get<double>(),
                  back["positions"][i][key].get<double>(), 5e-3)
          << key;
  EXPECT_EQ(back["comp_file"]["type"], 0);
  EXPECT_EQ(back["comp_file"]["unit"], "mm");
  const auto text = back["comp_file"]["text"].get<std::string>();
  const auto second = text.substr(text.find('\n') + 1);
  EXPECT_EQ(second.substr(0, second.find(' ')), "57.000000");
}

// "table" is what an error of a machine document holds: the axis' own scale and reversal.
TEST(Positioning, TheTableIsOneOfMachineDocuments) {
  const json table = answered(laser())["table"];
  for (const char* chain : {"wYfXZt", "wXfYZt"}) {  // X on the tool's side and the other
    const json machine{{"chain", chain},
                       {"tool_point_mm", {0, 0, 0}},
                       {"axes",
                        {{{"name", "X"}, {"err", {{"EXX", {{"table", table}}}}}},
                         {{"name", "Y"}},
                         {{"name", "Z"}}}},
                       {"points",
                        {{{"q", {{"X", 100}}}, {"sign", {{"X", 1}}}},
                         {{"q", {{"X", 100}}}, {"sign", {{"X", -1}}}}}}};
    const json result = geometry(machine);
    EXPECT_NEAR(result["points"][0]["tip_error_mm"][0].get<double>(), -0.5e-3, 1e-7);
    EXPECT_NEAR(result["points"][1]["tip_error_mm"][0].get<double>(), 3.5e-3, 1e-7);
    // And back: the machine's axis has the deviations that were measured.
    const json model = answered({{"axis", "X"},
                                 {"model",
                                  {{"chain", chain},
                                   {"axes", machine["axes"]},
                                   {"from_mm", 0},
                                   {"to_mm", 200},
                                   {"positions", 3}}}});
    EXPECT_NEAR(model["positions"][1]["mean_plus_um"].get<double>(), -0.5, 1e-9) << chain;
    EXPECT_NEAR(model["positions"][2]["mean_minus_um"].get<double>(), 7, 1e-9) << chain;
    EXPECT_NEAR(model["iso230_2"]["B_um"].get<double>(), 4, 1e-9);
  }
}

TEST(Positioning, RefusesFilesThatLinuxCncWouldNotTake) {
  const auto of = [](const json& text) {
    return refused({{"axis", "X"}, {"comp_file", {{"text", text}}}});
  };
  EXPECT_EQ(of("# a comment\n0 0 0"),
            "positioning: /comp_file/text#line 1: got \"# a comment\", expected three "
            "numbers a line: nominal, forward, reverse; LinuxCNC reads no further");
  EXPECT_NE(of(std::string(79, 'x') + "\u00e9").find("got \"xxxx"), std::string::npos);
  EXPECT_EQ(of("0 0 0\n1 1 1\n1 1 1\n"),
            "positioning: /comp_file/text#line 3: got \"1 1 1\", expected a nominal "
            "position above that of the line before");
  EXPECT_NE(of("0 0 1e300").find("#line 1"), std::string::npos);
  EXPECT_NE(of("\n \n").find("got no row"), std::string::npos);
  EXPECT_EQ(
      of(5),
      "positioning: /comp_file/text: got 5, expected three numbers a line: nominal, "
      "forward, reverse");
  std::string many;
  for (int i = 0; i < 257; ++i) many += std::to_string(i) + " 0 0\n";
  EXPECT_EQ(of(many),
            "positioning: /comp_file/text: got 257 rows, expected at most 256 rows, as "
            "LinuxCNC takes them");
  EXPECT_EQ(of("0 0 0\r\n1 1 1\r\n\r\n"), "");
  // What cannot be written.
  const auto write = [](json readings) {
    readings["unit"] = "um";
    return refused(
        {{"axis", "X"}, {"readings", readings}, {"write_comp_file", json::object()}});
  };
  EXPECT_NE(write({{"q_mm", {0, 1}}, {"plus", {0, 1}}}).find("both directions"),
            std::string::npos);
  EXPECT_NE(write({{"q_mm", {0, 1e-5}}, {"plus", {0, 1}}, {"minus", {0, 1}}})
                .find("at least 0.0001 mm apart"),
            std::string::npos);
  std::vector<double> q(257);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = static_cast<double>(i);
  EXPECT_NE(write({{"q_mm", q}, {"plus", q}, {"minus", q}}).find("there are 257"),
            std::string::npos);
}

TEST(Positioning, RefusesWhatDoesNotFit) {
  EXPECT_EQ(
      refused({{"axis", "X"}}),
      "positioning: document: got none, expected one of readings, comp_file and model");
  json two = laser();
  two["comp_file"] = {{"text", "0 0 0"}};
  EXPECT_NE(refused(two).find("got more than one"), std::string::npos);
  json odd = laser();
  odd["readings"]["plus"].erase(0);
  EXPECT_NE(
      refused(odd).find("/readings/plus: got a list of 24 entries, expected as many"),
      std::string::npos)
      << refused(odd);
  json model = examples()[3];
  model["axis"] = "Y";
  EXPECT_NE(refused(model).find("a chain with the axis Y"), std::string::npos);
  model["axis"] = "X";
  model["model"]["to_mm"] = 0;
  EXPECT_NE(refused(model).find("a position above from_mm"), std::string::npos);
}

TEST(Positioning, SchemaAndReaderAgreeOnEverySlip) {
  for (const json& example : examples()) {
    // What columns a table has, which rows a file has, which axes a chain needs and that a
    // file is written from both directions is beyond the schema.
    const auto beyond = [](const std::string& what) {
      return what.starts_with("/readings/columns") ||
             what.starts_with("/readings/csv/") || what.starts_with("/comp_file/text/") ||
             what == "/model/axes = []" || what.starts_with("/model/from_mm") ||
             what.starts_with("/model/to_mm") ||
             what.find("/name") != std::string::npos ||
             what.starts_with("/model/chain") || what == "/readings/plus left out" ||
             what == "/readings/minus left out";
    };
    EXPECT_GT(SlipsOf(request_schema(), refused, example, beyond).try_all(), 10);
  }
}

}  // namespace
}  // namespace turnwright::document::positioning_test
