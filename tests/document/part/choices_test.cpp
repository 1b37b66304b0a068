#include "document/part/choices.hpp"

#include <gtest/gtest.h>

#include "../test_catalogue.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/document/prepared_part.hpp"

namespace turnwright::document::choices_test {
namespace {

using nlohmann::json;

std::vector<std::string> names(const json& request) {
  Problems problems{.document = "t"};
  std::vector<std::string> all;
  for (const auto& v : variants(request, problems)) all.push_back(v.name);
  problems.throw_if_any();
  return all;
}

std::string refusal(const json& request) {
  try {
    names(request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Choices, WithoutAChoiceTheRequestIsItsOwnOnlyVariant) {
  Problems problems{.document = "t"};
  const json request{{"machine", "lathe-small"}};
  const auto all = variants(request, problems);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].document, request);
  EXPECT_EQ(all[0].name, "");
}

TEST(Choices, AreAllCombinationsInTheOrderOfTheLists) {
  const json request{
      {"choose",
       {{"machine", {"lathe-small", "lathe-medium"}},
        {"stock",
         {{{"kind", "bar"}, {"diameter_mm", 50}, {"length_mm", 120}},
          {{"kind", "tube"}, {"outer_mm", 52}, {"inner_mm", 20}, {"length_mm", 120}}}},
        {"edge_wear_mm", {0.2}}}}};
  EXPECT_EQ(names(request),
            (std::vector<std::string>{
                "lathe-small; bar 50 x 120 mm; edges changed at 0.2 mm",
                "lathe-small; tube 52/20 x 120 mm; edges changed at 0.2 mm",
                "lathe-medium; bar 50 x 120 mm; edges changed at 0.2 mm",
                "lathe-medium; tube 52/20 x 120 mm; edges changed at 0.2 mm"}));
  Problems problems{.document = "t"};
  const auto all = variants(request, problems);
  EXPECT_EQ(all[1].document["stock"]["kind"], "tube");
  EXPECT_EQ(all[1].document["budget"]["edge_wear_mm"], 0.2);
  EXPECT_FALSE(all[1].document.contains("choose"));
}

TEST(Choices, AutomaticSetupsAreBothOrdersAndEachEndAlone) {
  EXPECT_EQ(names({{"choose", {{"setups", "auto"}}}}),
            (std::vector<std::string>{"held left, then right", "held right, then left",
                                      "held left", "held right"}));
}

// 100 mm of part in a bar of 110, 4 mm of it to the left.
TEST(Choices, AutomaticSetupsMayPartTheFinishedPartOffALongerBar) {
  json request{{"stock",
                {{"kind", "bar"},
                 {"diameter_mm", 50},
                 {"length_mm", 110},
                 {"left_allowance_mm", 4}}},
               {"outer", {{{"length_mm", 60}}, {{"length_mm", 40}}}},
               {"choose", {{"setups", "auto"}}}};
  Problems problems{.document = "t"};
  const auto all = variants(request, problems);
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[4].name, "held left, parted off a bar");
  EXPECT_EQ(all[4].document["setups"], json::parse(R"([{"hold": "left"}])"));
  EXPECT_EQ(all[4].document["stock"],
            json::parse(R"({"kind": "bar", "diameter_mm": 50, "length_mm": 156.0,
                            "left_allowance_mm": 50.0, "part_off_allowance_mm": 0})"));
  EXPECT_EQ(all[5].name, "held right, parted off a bar");
  EXPECT_EQ(all[5].document["stock"]["length_mm"], 154);
  EXPECT_EQ(all[5].document["stock"]["left_allowance_mm"], 4);
  EXPECT_EQ(all[0].document["stock"], request["stock"]);

  // The blade leaves the end as it is.
  const auto asked = [&](const char* list, const json& member) {
    json with = request;
    with[list] = json::array({member});
    return names(with);
  };
  for (const auto& [list, member] :
       {std::pair{"faces", json{{"id", "left"}, {"Ra_um", 1.6}}},
        {"edges", json{{"at", "left"}, {"chamfer_mm", 1}}},
        {"tolerances", json{{"of", "left"}}},
        {"tolerances", json{{"of", "d1"}, {"datum", "left"}}},
        {"tolerances", json{{"between", {"left", "d1|d2"}}}}})
    EXPECT_EQ(asked(list, member).back(), "held right, parted off a bar") << list;
  EXPECT_EQ(asked("faces", {{"id", "left"}}).size(), 5u);
  EXPECT_EQ(asked("faces", {{"id", "d1|d2"}}).size(), 6u);

  request["stock"]["part_off_allowance_mm"] = 0.6;  // says itself how it is parted
  EXPECT_EQ(names(request).size(), 4u);
  request["stock"] = {{"kind", "tube"}, {"outer_mm", 50}, {"inner_mm", 20}};
  EXPECT_EQ(names(request).size(), 4u);
}

TEST(Choices, StocksOfOneSizeAreCounted) {
  json cheap{{"kind", "bar"}, {"diameter_mm", 50}, {"length_mm", 120}, {"price", 3}};
  json dear = cheap, other = cheap;
  dear["price"] = 9, other["diameter_mm"] = 55;
  EXPECT_EQ(names({{"choose", {{"stock", {cheap, other, dear}}}}}),
            (std::vector<std::string>{"bar 50 x 120 mm, no. 1", "bar 55 x 120 mm",
                                      "bar 50 x 120 mm, no. 3"}));
}

TEST(Choices, WrongListsAreToldWithTheirPlaces) {
  EXPECT_EQ(refusal({{"choose", 3}}), "t: /choose: got 3, expected an object");
  EXPECT_EQ(refusal({{"choose", {{"machine", json::array()}}}}),
            "t: /choose/machine: got an empty list, expected a list of 1 to 20 entries");
  EXPECT_EQ(refusal({{"choose", {{"setups", "any"}}}}),
            "t: /choose/setups: got \"any\", expected \"auto\", or a list of lists of "
            "setups");
  EXPECT_EQ(refusal({{"machine", "lathe-small"}, {"choose", {{"machine", {"a"}}}}}),
            "t: /choose/machine: got [\"a\"], expected no choice, for /machine is "
            "given");
  EXPECT_EQ(refusal({{"choose", {{"colour", {"red"}}}}}).rfind("t: /choose/colour", 0),
            0u);
  json many = json::array();
  for (int i = 0; i < 11; ++i) many.push_back(0.1 + 0.01 * i);
  EXPECT_EQ(refusal({{"choose",
                      {{"machine", {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}},
                       {"edge_wear_mm", many}}}}),
            "t: /choose/edge_wear_mm: got a list of 11 entries, expected at most 100 "
            "combinations in all");
}

TEST(Choices, AProblemOfAMemberStandsWhereTheRequestHasIt) {
  json request = parse_file(source_path("tests/data/every_key_of_a_part.json"));
  json stock = request["stock"];
  stock["length_mm"] = -4;
  request.erase("stock");
  request["choose"] = {{"stock", {stock}}};
  try {
    load_part_plan(request, test_catalogue(), "t");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].pointer, "/choose/stock/0/length_mm");
  }
}

TEST(Choices, OnlyAPlanChooses) {
  json request = parse_file(source_path("tests/data/every_key_of_a_part.json"));
  request["choose"] = {{"edge_wear_mm", {0.1}}};
  try {
    load_part_plan(request, test_catalogue(), "t", Purpose::predict);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems()[0].expected, "nothing: only plan chooses");
  }
}

// Costs of two machines are compared only in one currency.
TEST(Choices, MachinesNameTheSameCurrency) {
  auto catalogue = test_catalogue();
  auto other = catalogue.machines.at(0);
  other.id = "other";
  catalogue.machines.push_back(other);
  const json part = json::parse(R"({
    "format": "turnwright-part/1", "name": "Pin", "material": "test-steel",
    "stock": {"kind": "bar", "diameter_mm": 35, "length_mm": 84, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 80, "diameter_mm": 32}],
    "choose": {"machine": ["lathe-medium", "other"]},
    "setups": [{"hold": "left", "grip_mm": 20, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 40, "clampings": ["chuck"]}]})");
  const auto told = [&](const char* first, const char* second) {
    catalogue.machines[0].currency = first;
    catalogue.machines[1].currency = second;
    try {
      const auto all = currencies(prepared_candidates(part, catalogue, "t"));
      return all.empty() ? std::string("none") : *all.begin();
    } catch (const InputError& error) {
      return error.problems().front().pointer + " " + error.problems().front().got;
    }
  };
  EXPECT_EQ(told("", ""), "none");
  EXPECT_EQ(told("EUR", ""), "EUR");
  EXPECT_EQ(told("EUR", "EUR"), "EUR");
  EXPECT_EQ(told("USD", "EUR"), "/choose/machine rates in EUR, USD");
}

}  // namespace
}  // namespace turnwright::document::choices_test
