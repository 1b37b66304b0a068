#include "turnwright/document/compensate.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "document/json/parse.hpp"

namespace turnwright::document::compensate_test {
namespace {

using nlohmann::json;

const SchemaCheck& request_schema() {
  static const SchemaCheck kSchema("compensate.request.json");
  return kSchema;
}

json answered(const json& request) {
  static const SchemaCheck kResult("compensate.result.json");
  EXPECT_EQ(request_schema().fault(request), "");
  json result = compensate(request);
  EXPECT_EQ(kResult.fault(result), "");
  return result;
}

std::string refused(const json& request) { return refusal(compensate, request); }

json example() {
  return parse_file(source_path("schemas/compensate.request.json"))["examples"][0];
}

TEST(CompensateDoor, CorrectsALathesProgram) {
  json request = example();
  const json result = answered(request);
  EXPECT_GT(result["residual"]["before"]["max_mm"], 1e-3);
  EXPECT_LT(result["residual"]["after"]["max_mm"], 1e-5);  // five decimals
  EXPECT_EQ(result["program"][0], "N10 T0101");
  EXPECT_EQ(result["program"].back(), "N70 M30");
  EXPECT_EQ(result["assumed"], json::array());
  request["decimals"] = 7;
  EXPECT_LT(answered(request)["residual"]["after"]["max_mm"], 1e-6);
  // Text and lines are the same program.
  std::string text;
  for (const json& line : request["program"]) text += line.get<std::string>() + "\r\n";
  const json lines = answered(request);
  request["program"] = text;
  EXPECT_EQ(answered(request), lines);
}

TEST(CompensateDoor, TakesLongProgramsAsText) {
  json request = example();
  std::string text = "T0101 G1 F0.2";
  for (int i = 0; i < 5000; ++i) text += "\nX" + std::to_string(20 + i % 7) + " Z-1";
  request["program"] = text;
  const std::string document = request.dump();
  const json result = answered(parse(document, "t"));
  EXPECT_EQ(result["points"].get<int>() - result["added_moves"].get<int>(), 5000);
}

TEST(CompensateDoor, RefusesWithLineNumbers) {
  json request = example();
  request["program"] = {"G1 X1 F0.1", "G41 X5", "G1 Y3", "#1=4", "G55"};
  const std::string all = refused(request);
  for (const char* part :
       {"/program#line 2: got G41, expected a code that can be compensated",
        "/program#line 3: got Y3, expected axes of the machine: XZ",
        "/program#line 4: got \"#\"",
        "/program#line 5: got G55, expected a work offset that is given"})
    EXPECT_NE(all.find(part), std::string::npos) << all;
  request["program"] = json::array();
  EXPECT_NE(refused(request).find("/program"), std::string::npos);
  request["program"] = "";
  EXPECT_NE(refused(request).find("/program"), std::string::npos);
  request["program"] = {"G0 X1\nG41"};
  EXPECT_NE(refused(request).find("/program/0"), std::string::npos);
  request = example();
  request.erase("tool_offsets_mm");
  EXPECT_NE(refused(request).find("/program#line 1: got tool offset 1"),
            std::string::npos);
}

// However short the program is, what it makes is bounded.
TEST(CompensateDoor, ArcsOfTooManyChordsAreRefused) {
  json request{{"chain", "wXYfZt"},
               {"axes", {{{"name", "X"}}, {{"name", "Y"}}, {{"name", "Z"}}}},
               {"tolerance_mm", 1e-6},
               {"program", {"G17 G1 X0 Y0 F100", "G2 I20000", "G2 I20000"}}};
  EXPECT_NE(refused(request).find("/program#line 3: got more than 500000 moves"),
            std::string::npos);
}

TEST(CompensateDoor, AssumptionsAreSaid) {
  json request = example();
  request.erase("start_mm");
  request.erase("diameter");
  request["program"] = {"T0101", "X40 Z2", "G1 Z0"};
  const json assumed = answered(request)["assumed"];
  ASSERT_EQ(assumed.size(), 3u);
  EXPECT_EQ(assumed[0]["pointer"], "/start_mm");
  EXPECT_EQ(assumed[1]["pointer"], "/diameter");
  EXPECT_EQ(assumed[1]["value"], false);
  EXPECT_EQ(assumed[2]["pointer"], "/program#line 2");
  EXPECT_EQ(assumed[2]["value"], "G0");
}

TEST(CompensateDoor, SchemaAndReaderAgreeOnEverySlip) {
  const auto beyond = [](const std::string& what) {
    const bool line_taken_out =
        what.starts_with("/program/") && what.ends_with(R"(= "")");
    return line_taken_out || what.starts_with("/axes = []") ||
           what.starts_with("/tool_offsets_mm") || what.starts_with("/program/0") ||
           what == "/lathe left out" || what == "/diameter left out";
  };
  EXPECT_GT(SlipsOf(request_schema(), refused, example(), beyond).try_all(), 50);
}

}  // namespace
}  // namespace turnwright::document::compensate_test
