#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stop_token>

#include "../document/schema_check.hpp"
#include "document/json/parse.hpp"
#include "service/requests.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::service::answer_test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json twice(const json& request, const Context&) {
  return {{"twice", 2 * request.at("x").get<double>()}};
}
ordered_json deep_nan(const json&, const Context&) {
  return {{"list", {1.0, {{"x", std::numeric_limits<double>::quiet_NaN()}}}}};
}

const Request kTwice{"twice", "doubles x", R"({"x": 1})", twice};
const document::Catalogue kNothing;

TEST(Answer, SaysWhatItAnswersAndWhoAnswered) {
  const auto result = answer(kTwice, {{"x", 4}}, {kNothing});
  EXPECT_EQ(result.at("twice"), 8.0);
  EXPECT_EQ(result.at("format"), "turnwright-twice-result/1");
  EXPECT_EQ(result.at("turnwright_version"), version());
  // printf '{"x":4}' | sha256sum
  EXPECT_EQ(result.at("request_digest"),
            "81148b1be37b2b7b90cb11cda4b18ede67721435053c0c0e0f077a5d1b8a36d7");
}

TEST(Answer, DigestKnowsContentsNotLayout) {
  const auto digest = [](const char* text) {
    return answer(kTwice, document::parse(text, "test"), {kNothing})
        .at("request_digest")
        .get<std::string>();
  };
  EXPECT_EQ(digest(R"({"x": 4, "y": 5})"), digest("{ \"y\":5,\n\t\"x\":4 }"));
  EXPECT_NE(digest(R"({"x": 4, "y": 5})"), digest(R"({"x": 4, "y": 6})"));
}

TEST(Answer, KeepsTheFormatARowGives) {
  const Request row{"own", "", "{}", [](const json&, const Context&) -> ordered_json {
                      return {{"format", "own/7"}};
                    }};
  EXPECT_EQ(answer(row, json::object(), {kNothing}).at("format"), "own/7");
}

TEST(Answer, RefusesNumbersJsonCannotHold) {
  const Request row{"broken", "", "{}", deep_nan};
  try {
    answer(row, json::object(), {kNothing});
    FAIL() << "NaN went out";
  } catch (const ModelRangeError& e) {
    EXPECT_STREQ(e.what(),
                 "broken/list/1/x: the result is not a finite number, so the request is "
                 "outside the model's range");
  }
}

TEST(Answer, OnlyAnInfeasibleStatusIsInfeasible) {
  EXPECT_TRUE(infeasible({{"status", "infeasible"}}));
  EXPECT_FALSE(infeasible({{"status", "ok"}}));
  EXPECT_FALSE(infeasible(json::object()));
}

TEST(Requests, EveryRowIsNamedOnceAndItsExampleIsAnsweredAsItsSchemaSays) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  std::set<std::string> names;
  for (const auto& row : requests()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second);
    EXPECT_FALSE(row.summary.empty());
    const auto result = answer(row, document::parse(row.example, row.name), {catalogue});
    EXPECT_TRUE(result.contains("format"));
    EXPECT_FALSE(infeasible(result));
    EXPECT_EQ(document::SchemaCheck(result_schema(row)).fault(result), "");
  }
}

TEST(Requests, LongListsOfExamplesHearThatNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  for (const char* name :
       {"deflection", "acceptance", "geometry", "ballbar", "compare"}) {
    const Request& row = *find_request(name);
    EXPECT_THROW(answer(row, document::parse(row.example, row.name),
                        {.catalogue = kNothing, .stop = source.get_token()}),
                 Cancelled)
        << name;
  }
}

}  // namespace
}  // namespace turnwright::service::answer_test
