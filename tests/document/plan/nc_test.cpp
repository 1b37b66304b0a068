#include "turnwright/document/nc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <tuple>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/compensate.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::document::nc_test {
namespace {

using nlohmann::json;

const Catalogue& catalogue() {
  static const auto kCatalogue = load_catalogue(source_path(""));
  return kCatalogue;
}

json request(const std::string& part) {
  return {{"part", parse_file(source_path("parts/" + part + ".json"))}};
}

json answered(const json& request) {
  static const SchemaCheck kRequest("nc.request.json"), kResult("nc.result.json");
  EXPECT_EQ(kRequest.fault(request), "");
  const auto [candidates, settings] = load_nc_request(request, catalogue());
  const auto& part = candidates.usable.front().document.part;
  const auto plan = planning::plan(part);
  json result = to_json(nc::programs(part, plan), plan, settings);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) {
  return refusal(
      [](const json& r) { return load_nc_request(r, catalogue()).part.refused.size(); },
      request);
}

TEST(NcDoor, GivesAProgramForEverySetup) {
  const json result = answered(request("drilled-bush"));
  EXPECT_EQ(result["status"], "ok");
  ASSERT_EQ(result["programs"].size(), 2u);
  EXPECT_EQ(result["programs"][0]["name"], "setup-1.ngc");
  const std::string text = result["programs"][0]["text"];
  for (const char* word :
       {"G96 D", "G95", "M8", "M30", "setup 1 of 2", "operation s1-finish-d2"})
    EXPECT_NE(text.find(word), text.npos) << word;
  EXPECT_NE(result["tool_table"].get<std::string>().find("T1 P1"), std::string::npos);
}

TEST(NcDoor, ItsProgramsAreTakenForCompensation) {
  json machine = json::parse(R"({"chain": "wCfZXt", "diameter": true, "lathe": true,
      "axes": [{"name": "C"}, {"name": "Z", "sq": {"EB0Z": 2e-5}}, {"name": "X"}]})");
  for (int tool = 1; tool < 9; ++tool)
    machine["tool_offsets_mm"][std::to_string(tool)] = {0, 0, 0};
  for (const char* control : {"linuxcnc", "fanuc", "fanuc-b", "haas"}) {
    json asked = request("drilled-bush");
    asked["control"] = control;
    const auto answer = answered(asked);
    for (const auto& program : answer["programs"]) {
      machine["program"] = program["text"];
      const auto corrected = compensate(machine);
      EXPECT_GT(corrected["residual"]["before"]["max_mm"], 1e-4) << control;
      EXPECT_LT(corrected["residual"]["after"]["max_mm"], 1e-4) << control;
    }
  }
}

TEST(NcDoor, SpeaksAnotherControlsWords) {
  json asked = request("threaded-spindle");
  asked["control"] = "fanuc";
  const json result = answered(asked);
  EXPECT_EQ(result["programs"][1]["name"], "setup-2.nc");
  const std::string text = result["programs"][1]["text"];
  for (const char* word : {"O0002\n", "G50 S", "G32 ", "G99", "T0101"})
    EXPECT_NE(text.find(word), text.npos) << word;
  for (const char* word : {"G96 D", "G33", "G95", " M6"})
    EXPECT_EQ(text.find(word), text.npos) << word;
}

// Whole numbers without a point may count steps there, S takes no decimals, and a percent
// sign ends the program wherever it stands.
TEST(NcDoor, WritesAnotherControlsNumbers) {
  json asked = request("threaded-spindle");
  asked["control"] = "fanuc";
  asked["part"]["name"] = "50 % (shaft)";
  std::istringstream lines(answered(asked)["programs"][0]["text"].get<std::string>());
  const std::regex word("([XZIKFS])(-?[0-9.]+)");
  int numbers = 0, ends = 0;
  for (std::string line; std::getline(lines, line);) {
    ends += static_cast<int>(std::ranges::count(line, '%'));
    if (line[0] == '(') continue;
    for (std::sregex_iterator it(line.begin(), line.end(), word), end; it != end; ++it) {
      ++numbers;
      EXPECT_EQ((*it)[2].str().find('.') != std::string::npos, (*it)[1] != "S") << line;
    }
  }
  EXPECT_GT(numbers, 100);
  EXPECT_EQ(ends, 2);
}

TEST(NcDoor, EchoesTheShopsSettings) {
  json asked = request("threaded-spindle");
  asked["control"] = "haas";
  asked["program_number"] = 4711;
  asked["tools"] = {{{"id", "THREAD-EXT-60"}, {"number", 9}, {"offset", 19}},
                    {{"id", "NOT-THERE"}, {"number", 1}}};
  const json result = answered(asked), settings = result["settings"];
  EXPECT_EQ(settings["control"], "haas");
  EXPECT_EQ(settings["program_number"], 4711);
  EXPECT_EQ(settings["work_offset"], "G54");
  EXPECT_EQ(settings["block_numbers"], "tools");
  EXPECT_EQ(settings["spindle"], "M3");
  EXPECT_EQ(settings["coolant"], "M8");
  EXPECT_EQ(settings["optional_stops"], false);
  EXPECT_EQ(settings["reference_returns"], false);
  EXPECT_EQ(settings["drill_cycles"], false);
  EXPECT_FALSE(settings.contains("milling"));
  std::map<std::string, std::pair<int, int>> numbers;
  for (const auto& tool : settings["tools"])
    numbers[tool["id"]] = {tool["number"], tool["offset"]};
  EXPECT_EQ(numbers.at("THREAD-EXT-60"), std::pair(9, 19));
  EXPECT_FALSE(numbers.contains("NOT-THERE"));
  for (const auto& [id, number] : numbers) EXPECT_NE(number.first, 1) << id;

  json again = asked;
  again.update(settings);
  EXPECT_EQ(answered(again)["programs"], result["programs"]);
}

TEST(NcDoor, EchoesTheCodesForMilling) {
  json asked = request("pump-shaft");
  asked["control"] = "fanuc";
  asked["drill_cycles"] = true;
  asked["milling"] = {{"c_axis_on", "M35"},
                      {"c_axis_off", "M34"},
                      {"lock", "M68"},
                      {"tool_on", "S{S} M13"},
                      {"tool_off", "M15"}};
  const auto settings = answered(asked)["settings"];
  EXPECT_EQ(settings["milling"], asked["milling"]);
  EXPECT_EQ(settings["drill_cycles"], true);
}

TEST(NcDoor, RefusesSettingsThatTheControlDoesNotKnow) {
  const std::vector<std::tuple<json, const char*>> wrong{
      {{{"control", "okuma"}, {"work_offset", "G54"}},
       "/work_offset: got \"G54\", expected none: Okuma OSP has no such words"},
      {{{"control", "siemens"}, {"work_offset", "G58"}},
       "/work_offset: got \"G58\", expected one of \"G54\", \"G55\", \"G56\", \"G57\""},
      {{{"program_number", 5}},
       "/program_number: got 5, expected none: programs of LinuxCNC go by their file's "
       "name"},
      {{{"control", "fanuc"}, {"program_number", 10000}}, "/program_number: got 10000"},
      {{{"coolant", "on"}},
       "/coolant: got \"on\", expected \"off\" or a code like \"M8\""},
      {{{"coolant", "M12345"}}, "/coolant: got \"M12345\""},
      {{{"milling", {{"tool_on", "M13"}}}},
       "/milling/tool_on: got \"M13\", expected codes like \"S{S} M13\", with {S} for "
       "the speed"},
      {{{"milling", {{"tool_on", "S{S} {S}"}}}}, "/milling/tool_on: got"},
      {{{"milling", {{"lock", "M68\nM30"}}}}, "/milling/lock: got"},
      {{{"milling", {{"c_axis_on", "m35"}}}},
       "/milling/c_axis_on: got \"m35\", expected codes like \"M35\""},
      {{{"milling", {{"brake", "M68"}}}}, "/milling/brake: got"},
      {{{"spindle", "M5"}}, "/spindle: got \"M5\""},
      {{{"block_numbers", true}}, "/block_numbers: got true"},
      {{{"tools", {{{"id", "A"}, {"number", 1}}, {{"id", "A"}, {"number", 1}}}}},
       "/tools/1/id: got \"A\", expected one that no other tool has"},
      {{{"control", "haas"},
        {"tools",
         {{{"id", "A"}, {"number", 1}, {"offset", 2}}, {{"id", "B"}, {"number", 2}}}}},
       "/tools/1/offset: got nothing, expected one that no other tool has"},
      {{{"tools", {{{"id", "A"}, {"number", 1}, {"offset", 2}}}}},
       "/tools/0/offset: got 2, expected none: the offset of LinuxCNC is that of the "
       "tool's number"},
      {{{"tools", {{{"id", "A"}, {"number", 100}}}}}, "/tools/0/number: got 100"}};
  for (const auto& [settings, expected] : wrong) {
    json asked = request("pump-shaft");
    asked.update(settings);
    const auto told = refused(asked);
    EXPECT_NE(told.find(expected), told.npos) << told;
  }
  json asked = request("pump-shaft");
  asked["control"] = "siemens";
  asked["tools"] = {{{"id", "A"}, {"number", 1}, {"offset", 1}},
                    {{"id", "B"}, {"number", 2}, {"offset", 1}}};
  EXPECT_EQ(refused(asked), "");
}

TEST(NcDoor, SaysWhatHasNoProgram) {
  EXPECT_EQ(answered(request("infeasible-as-drawn"))["status"], "infeasible");
}

TEST(NcDoor, PointsIntoThePart) {
  json wrong = request("pump-shaft");
  wrong["part"]["outer"][0]["diameter_mm"] = -1;
  wrong["control"] = "heidenhain";
  const auto told = refused(wrong);
  EXPECT_NE(told.find("/part/outer/0/diameter_mm: got -1"), told.npos) << told;
  EXPECT_NE(told.find("/control: got \"heidenhain\""), told.npos) << told;
  EXPECT_NE(refused(json{{"control", "fanuc"}}).find("/part"), std::string::npos);
  EXPECT_NE(refused(json::array()).find("object"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::nc_test
