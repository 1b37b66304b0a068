#include "turnwright/document/learn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document::learn_test {
namespace {

using nlohmann::json;

const Catalogue& catalogue() {
  static const Catalogue kCatalogue = load_catalogue(source_path(""));
  return kCatalogue;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("learn.request.json"), kResult("learn.result.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = learn(request, catalogue());
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { learn(r, catalogue()); }, request);
}

json example(std::size_t i) {
  return parse_file(source_path("schemas/learn.request.json")).at("examples").at(i);
}

json seat() {
  return {{"id", "seat"}, {"nominal_mm", 30}, {"upper_mm", 30.02}, {"lower_mm", 29.98}};
}

// Two edges of ten parts each: wear 1 um a part, the second edge 5 um higher, scatter of
// 0.5 um to both sides in turn.
json worn() {
  json rows = json::array();
  for (int n = 0; n < 20; ++n)
    rows.push_back({{"part", n + 1},
                    {"characteristic", "seat"},
                    {"value_mm",
                     30 + 1e-3 * (n % 10) + (n < 10 ? 0 : 5e-3) + (n % 2 ? 5e-4 : -5e-4)},
                    {"edge", n < 10 ? "old" : "new"}});
  return {{"characteristics", {seat()}}, {"rows", rows}};
}

// What rows say of each other, and of the list of characteristics, the schema cannot tell.
TEST(Learn, SchemaAndReaderAgreeOnEverySlip) {
  const auto beyond = [](const std::string& slip) {
    for (const char* key : {"/characteristic", "/part ", "/edge", "/time_s", "/machine",
                            "/parts_on_edge left out"})
      if (slip.find(key) != std::string::npos) return slip.starts_with("/rows");
    return slip.starts_with("/characteristics/0/id");
  };
  const SchemaCheck schema("learn.request.json");
  EXPECT_GT(SlipsOf(schema, refused, example(1), beyond).try_all(), 100);
}

TEST(Learn, TellsWearAndTheJumpOfTheEdge) {
  const auto c = answered(worn())["characteristics"][0];
  EXPECT_EQ(c["n"], 20);
  EXPECT_NEAR(c["mean_mm"]["value"].get<double>(), 30.007, 1e-9);
  const double wear = c["wear_mm_part"]["value"];
  // The least-squares line through +-0.5 in turn over ten parts rises by 0.0303.
  EXPECT_NEAR(wear, 1e-3 + 3.0303e-5, 1e-9);
  EXPECT_EQ(c["edges"]["jumps"][0]["to"], "new");
  EXPECT_NEAR(c["edges"]["jumps"][0]["value"].get<double>(), 5e-3 - 10 * wear, 1e-9);
  EXPECT_EQ(c["not_identified"].size(), 3U) << c["not_identified"];
}

TEST(Learn, AdviceCountsCorrectionsInForce) {
  auto request = worn();
  const auto before = answered(request)["characteristics"][0]["advice"];
  for (auto& row : request["rows"]) {
    row["offset_mm"] = -0.004;
    row["value_mm"] = row["value_mm"].get<double>() - 0.004;
  }
  request["characteristics"][0]["parts_per_edge"] = 14;
  const auto after = answered(request)["characteristics"][0]["advice"];
  EXPECT_NEAR(after["correction_mm"]["value"].get<double>(),
              before["correction_mm"]["value"].get<double>() + 0.004, 1e-9);
  EXPECT_EQ(after["due_in_parts"], before["due_in_parts"]);
  EXPECT_EQ(after["edge_due_in_parts"], 4);
  EXPECT_FALSE(before.contains("edge_due_in_parts"));
}

TEST(Learn, RowsTableAndWideTableAreOne) {
  const auto request = worn();
  json tall = {"characteristic;part;edge;value_mm"},
       wide = {"# gauge 7", "part,seat,edge"};
  for (const auto& row : request["rows"]) {
    const auto value = row["value_mm"].dump(), part = row["part"].dump();
    const auto edge = row["edge"].get<std::string>();
    tall.push_back("seat;" + part + ";" + edge + ";" + value);
    wide.push_back(part + "," + value + "," + edge);
  }
  json of_tall{{"characteristics", request["characteristics"]}, {"csv", tall}},
      of_wide{{"characteristics", request["characteristics"]}, {"csv", wide}};
  EXPECT_EQ(answered(of_tall)["characteristics"], answered(request)["characteristics"]);
  EXPECT_EQ(answered(of_wide)["characteristics"], answered(request)["characteristics"]);
}

TEST(Learn, OrderOfRowsDoesNotMatterWherePartsOrTimesTellIt) {
  auto request = worn();
  std::reverse(request["rows"].begin(), request["rows"].end());
  EXPECT_EQ(answered(request)["characteristics"], answered(worn())["characteristics"]);
}

TEST(Learn, MixUpsAreNamedAndCountNowhere) {
  auto request = worn();
  request["characteristics"].push_back(
      {{"id", "end"}, {"nominal_mm", 20}, {"upper_mm", 20.02}, {"lower_mm", 19.98}});
  for (int n = 0; n < 20; ++n)
    request["rows"].push_back(
        {{"part", n + 1}, {"characteristic", "end"}, {"value_mm", 20 + 1e-3 * (n % 3)}});
  const auto clean = answered(request);
  EXPECT_TRUE(clean["left_out"].empty());
  auto& rows = request["rows"];
  rows[3]["value_mm"] = rows[3]["value_mm"].get<double>() / 25.4;
  rows[25]["value_mm"] = rows[25]["value_mm"].get<double>() / 2;
  std::swap(rows[12]["value_mm"], rows[32]["value_mm"]);
  const auto result = answered(request);
  ASSERT_EQ(result["left_out"].size(), 4U);
  EXPECT_EQ(result["left_out"][0]["kind"], "inch");
  EXPECT_EQ(result["left_out"][0]["at"], "/rows/3");
  EXPECT_EQ(result["left_out"][1]["kind"], "swapped");
  EXPECT_EQ(result["left_out"][1]["with"], "end");
  EXPECT_EQ(result["left_out"][2]["kind"], "radius");
  EXPECT_EQ(result["left_out"][3]["with"], "seat");
  EXPECT_NEAR(result["characteristics"][0]["within"]["s_mm"]["value"].get<double>(),
              clean["characteristics"][0]["within"]["s_mm"]["value"].get<double>(), 1e-4);
}

TEST(Learn, AColumnInInchesHasNoStatistics) {
  auto request = worn();
  for (auto& row : request["rows"])
    row["value_mm"] = row["value_mm"].get<double>() / 25.4;
  const auto result = answered(request);
  EXPECT_EQ(result["characteristics"][0]["n"], 0);
  EXPECT_FALSE(result["characteristics"][0].contains("mean_mm"));
  EXPECT_EQ(result["left_out"].size(), 20U);
  EXPECT_EQ(result["warnings"][0],
            "seat: every value belongs if it is in inches; none counts");
}

TEST(Learn, CharacteristicsMayBeThoseOfAPart) {
  auto part = parse_file(source_path("docs/examples/guide/pin.json"));
  json rows = json::array();
  for (int n = 0; n < 12; ++n) {
    rows.push_back({{"part", n},
                    {"characteristic", "pin:diameter"},
                    {"value_mm", 21.985 + 1e-3 * (n * 7 % 5)}});
    rows.push_back({{"part", n},
                    {"characteristic", "t1"},
                    {"value_mm", 0.003 + 5e-4 * (n * 3 % 5)}});
  }
  const auto result = answered({{"part", part}, {"rows", rows}});
  json by_id;
  for (const auto& c : result["characteristics"]) by_id[c["id"]] = c;
  EXPECT_EQ(by_id["pin:diameter"]["nominal_mm"], 22);
  EXPECT_NEAR(by_id["pin:diameter"]["lower_mm"].get<double>(), 21.979, 1e-9) << "22 h7";
  EXPECT_EQ(by_id["t1"]["upper_mm"], 0.008);
  EXPECT_FALSE(by_id["t1"].contains("advice"));
  EXPECT_FALSE(by_id["t1"]["within"].contains("Cp"));
}

TEST(Learn, EveryFaultIsNamedAtItsPlace) {
  auto request = worn();
  request["characteristics"][0]["lower_mm"] = 31;
  request["rows"][2].erase("part");
  request["rows"][4]["characteristic"] = "seet";
  request["rows"][5]["value_mm"] = "30";
  const auto all = refused(request);
  for (const auto* problem :
       {"/characteristics/0/upper_mm: got 30.02, expected more than the lower limit, 31 "
        "mm",
        "/rows/2/part: got nothing", "/rows/4/characteristic: got \"seet\"",
        "did you mean \"seat\"?", "/rows/5/value_mm: got \"30\""})
    EXPECT_NE(all.find(problem), std::string::npos) << problem << "\n" << all;
}

TEST(Learn, RowsContradictEachOther) {
  auto request = worn();
  request["rows"][1]["time_s"] = 3;
  EXPECT_NE(
      refused(request).find(
          "/rows/1/time_s: got a value, expected none, as the first row of seat has"),
      std::string::npos)
      << refused(request);
  request = worn();
  request["rows"][7].erase("edge");
  EXPECT_NE(refused(request).find("/rows/7/edge: got nothing"), std::string::npos);
  request = worn();
  request["rows"][7]["part"] = 3;
  EXPECT_NE(refused(request).find("/rows/7: got part \"3\" twice"), std::string::npos);
  request = worn();
  request["rows"][19]["edge"] = "old";
  EXPECT_NE(refused(request).find("/rows/19/edge: got \"old\", expected an edge that was "
                                  "not changed before"),
            std::string::npos);
  request = worn();
  request["rows"][0]["machine"] = "A";
  request["rows"][1]["machine"] = 2;
  EXPECT_NE(refused(request).find("parts of one machine"), std::string::npos);
}

// Each row may have to be compared with every characteristic.
TEST(Learn, HearsThatNobodyWaitsWhileItReadsRows) {
  std::stop_source source;
  source.request_stop();
  const auto stop = source.get_token();
  const Listening listening(stop);
  EXPECT_THROW(learn(worn(), catalogue()), Cancelled);
}

// A hundred problems are told; the others are counted, without a look for near names.
TEST(Learn, UnknownCharacteristicsOfManyRowsAreCounted) {
  json request = worn();
  for (int n = 0; n < 200; ++n)
    request["rows"].push_back(
        {{"part", n + 100}, {"characteristic", "seet"}, {"value_mm", 30}});
  const auto said = refused(request);
  EXPECT_NE(said.find("/rows/119/characteristic: got \"seet\", expected a "
                      "characteristic (did you mean \"seat\"?)"),
            std::string::npos);
  EXPECT_EQ(said.find("/rows/120"), std::string::npos);
  EXPECT_NE(said.find("100 more problems"), std::string::npos);
}

TEST(Learn, ATableWithoutItsColumnsIsRefused) {
  json request{{"characteristics", {seat()}}, {"csv", "part,time_s\n1,2\n"}};
  EXPECT_NE(refused(request).find("columns characteristic and value_mm, or columns named "
                                  "by characteristics: \"seat\""),
            std::string::npos)
      << refused(request);
  request["csv"] = "part,seat\n1,30,5\n2,30\n";
  EXPECT_NE(refused(request).find("/csv#line 2: got 3 cells"), std::string::npos);
}

TEST(Learn, AProblemOfThePartStandsBelowIt) {
  EXPECT_NE(refused({{"part", {{"name", 3}}}, {"rows", json::array({1})}}).find("/part/"),
            std::string::npos);
}

TEST(Learn, AnUpdateTakesAPart) {
  auto request = worn();
  request["update"] = true;
  EXPECT_NE(refused(request).find("/update: got true, expected a part"),
            std::string::npos)
      << refused(request);
}

TEST(Learn, FewValuesHaveAWarning) {
  auto request = worn();
  request["rows"].erase(request["rows"].begin() + 3, request["rows"].end());
  const auto result = answered(request);
  EXPECT_NE(result["warnings"][0].get<std::string>().find("3 values are too few"),
            std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::learn_test
