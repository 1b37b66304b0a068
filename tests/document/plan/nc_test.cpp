#include "turnwright/document/nc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/document/compensate.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::document {
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
  const auto [part, control] = load_nc_request(request, catalogue());
  const auto plan = planning::plan(part.part);
  json result = to_json(nc::programs(part.part, plan), plan, control);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) {
  return refusal(
      [](const json& r) { return load_nc_request(r, catalogue()).part.part.batch; },
      request);
}

TEST(NcDoor, GivesAProgramForEverySetup) {
  const json result = answered(request("drilled-bush"));
  EXPECT_EQ(result["status"], "ok");
  ASSERT_EQ(result["programs"].size(), 2u);
  EXPECT_EQ(result["programs"][0]["name"], "setup-0.ngc");
  const std::string text = result["programs"][0]["text"];
  for (const char* word : {"G96 D", "G95", "M8", "M30", "operation s0-finish-d2"})
    EXPECT_NE(text.find(word), text.npos) << word;
  EXPECT_NE(result["tool_table"].get<std::string>().find("T1 P1"), std::string::npos);
}

TEST(NcDoor, ItsProgramsAreTakenForCompensation) {
  json machine = json::parse(R"({"chain": "wCfZXt", "diameter": true, "lathe": true,
      "axes": [{"name": "C"}, {"name": "Z", "sq": {"EB0Z": 2e-5}}, {"name": "X"}]})");
  for (int tool = 1; tool < 9; ++tool)
    machine["tool_offsets_mm"][std::to_string(tool)] = {0, 0, 0};
  for (const char* control : {"linuxcnc", "fanuc"}) {
    json asked = request("drilled-bush");
    asked["control"] = control;
    for (const auto& program : answered(asked)["programs"]) {
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
  EXPECT_EQ(result["programs"][1]["name"], "setup-1.nc");
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

TEST(NcDoor, SaysWhatHasNoProgram) {
  EXPECT_EQ(answered(request("infeasible-as-drawn"))["status"], "infeasible");
}

TEST(NcDoor, PointsIntoThePart) {
  json wrong = request("pump-shaft");
  wrong["part"]["outer"][0]["diameter_mm"] = -1;
  wrong["control"] = "siemens";
  const auto told = refused(wrong);
  EXPECT_NE(told.find("/part/outer/0/diameter_mm: got -1"), told.npos) << told;
  EXPECT_NE(told.find("/control: got \"siemens\""), told.npos) << told;
  EXPECT_NE(refused(json{{"control", "fanuc"}}).find("/part"), std::string::npos);
  EXPECT_NE(refused(json::array()).find("object"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::document
