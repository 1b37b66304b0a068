// Requests for quotes, and routings.
#include "turnwright/document/quote.hpp"

#include <gtest/gtest.h>

#include "../test_catalogue.hpp"
#include "document/requests/routing.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::quote_test {
namespace {

using nlohmann::json;

json pin() {
  return json::parse(R"({
    "format": "turnwright-part/1", "name": "Pin", "material": "test-steel",
    "stock": {"kind": "bar", "diameter_mm": 35, "length_mm": 84, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 80, "diameter_mm": 32}],
    "machine": "lathe-medium",
    "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}]})");
}

std::vector<std::string> pointers(const json& request) {
  std::vector<std::string> all;
  try {
    load_quote(request, test_catalogue());
  } catch (const InputError& e) {
    for (const auto& p : e.problems()) all.push_back(p.pointer);
  }
  return all;
}

TEST(QuoteRequest, DefaultsAreTheUsualBatchesAndNoCharges) {
  const auto q = load_quote({{"parts", {pin()}}}, test_catalogue());
  EXPECT_EQ(q.batches, (std::vector<double>{1, 10, 100, 1000}));
  EXPECT_EQ(q.parts.size(), 1U);
  EXPECT_FALSE(q.charges.setter_per_min);
  EXPECT_EQ(q.charges.overhead, 0);
  EXPECT_TRUE(q.charges.scrap);
}

TEST(QuoteRequest, TellsAllProblemsAtTheirPlaces) {
  auto wrong = pin();
  wrong["outer"][0]["diameter_mm"] = -1;
  wrong["stock"]["price"] = 3;
  auto priced = pin();
  priced["stock"]["price"] = 3;
  auto quick = pin();
  quick["objective"] = "time";
  const json request{{"parts", {pin(), wrong, priced, quick}},
                     {"batches", {1, 1.5, 1}},
                     {"stock", {{"price_per_kg", 1}, {"price_per_bar", 2}}},
                     {"charges", {{"margin_pct", 96}, {"overheads", 1}}},
                     {"energy", {{"idle_kW", -1}}}};
  const auto all = pointers(request);
  for (const char* at :
       {"/batches/1", "/batches/2", "/stock", "/stock/bar_length_mm",
        "/charges/margin_pct", "/charges/overheads", "/energy/idle_kW",
        "/parts/1/outer/0/diameter_mm", "/parts/2/stock", "/parts/3/objective"})
    EXPECT_NE(std::find(all.begin(), all.end(), at), all.end()) << at;
  EXPECT_EQ(pointers(json::object()), std::vector<std::string>{"/parts"});
}

TEST(QuoteRequest, RatesAndPricesAreOfOneCurrency) {
  auto in_euros = pin(), in_dollars = pin();
  in_euros["rates"]["currency"] = "EUR";
  in_dollars["rates"]["currency"] = "USD";
  EXPECT_EQ(load_quote({{"parts", {pin()}}}, test_catalogue()).currency, "");
  EXPECT_EQ(load_quote({{"parts", {pin(), in_euros}}}, test_catalogue()).currency, "EUR");
  EXPECT_EQ(pointers({{"parts", {in_euros, in_dollars}}}),
            std::vector<std::string>{"/currency"});
  EXPECT_EQ(pointers({{"parts", {in_euros}}, {"currency", "USD"}}),
            std::vector<std::string>{"/currency"});
}

TEST(Routing, IsCsvThatASpreadsheetTakesForText) {
  const auto row = [](const char* part) {
    return nlohmann::ordered_json{
        {"part", part},          {"made_by", "lathe-small; bar 35 x 84 mm"},
        {"operation", 10},       {"machine", "lathe-small"},
        {"description", "turn"}, {"setup_min", 15.5},
        {"run_min", 2.25}};
  };
  EXPECT_EQ(routing_csv({row("Pin"), row("=1+1"), row("A \"pin\", long")}),
            "part,made_by,operation,machine,description,setup_min,run_min\r\n"
            "Pin,\"lathe-small; bar 35 x 84 mm\",10,lathe-small,turn,15.5,2.25\r\n"
            "'=1+1,\"lathe-small; bar 35 x 84 mm\",10,lathe-small,turn,15.5,2.25\r\n"
            "\"A \"\"pin\"\", long\",\"lathe-small; bar 35 x 84 "
            "mm\",10,lathe-small,turn,15.5,2.25\r\n");
}

}  // namespace
}  // namespace turnwright::document::quote_test
