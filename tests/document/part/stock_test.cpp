#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "refusal.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/part_plan.hpp"
#include "turnwright/planning/quote.hpp"

namespace turnwright::document::stock_test {
namespace {

using nlohmann::json;

/// A spigot before a head that stays as a hexagon bar of 27 mm is.
json fitting() {
  return json::parse(R"({
    "material": "test-steel",
    "stock": {"kind": "hexagon", "across_flats_mm": 27, "length_mm": 60},
    "outer": [{"id": "head", "kind": "as-stock", "length_mm": 20},
              {"id": "spigot", "kind": "cylinder", "length_mm": 30, "diameter_mm": 20,
               "fit": "h9"}],
    "general": "ISO 2768-mK"})");
}

part::Drawing read(const json& document) {
  return load_part_plan(document, test_catalogue(), "t").plan.drawing;
}

// A hexagon of 27 mm across flats is 2/sqrt(3) wider through its corners and has an area of
// sqrt(3)/2 s^2; a square sqrt(2) and s^2.
TEST(Stock, OfBarsWithCornersIsKnownAcrossFlats) {
  auto document = fitting();
  const auto hexagon = read(document).stock;
  EXPECT_NEAR(hexagon.outer_mm, 27 * 2 / std::sqrt(3), 1e-12);
  EXPECT_NEAR(part::across_mm(hexagon), 27, 1e-12);
  EXPECT_NEAR(part::section_mm2(hexagon), std::sqrt(3) / 2 * 27 * 27, 1e-9);

  document["stock"]["kind"] = "square";
  const auto square = read(document).stock;
  EXPECT_NEAR(square.outer_mm, 27 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(part::section_mm2(square), 27 * 27, 1e-9);
}

TEST(Stock, AnElementKeepsItUncutAndWithoutTolerances) {
  const auto d = read(fitting());
  ASSERT_TRUE(d.outer[0].as_stock);
  EXPECT_EQ(d.outer[0].left_mm, d.stock.outer_mm);
  const auto is_of_head = [](const part::Tolerance& t) { return t.of == "head"; };
  EXPECT_TRUE(std::ranges::none_of(d.tolerances, is_of_head));
  EXPECT_FALSE(d.outer[0].limits);
}

TEST(Stock, WhatKeepsItHasNoDemandsOfItsOwn) {
  auto document = fitting();
  document["outer"][0]["diameter_mm"] = 27;
  EXPECT_EQ(refusal_of(document),
            "t: /outer/0/diameter_mm: got 27, expected no such key");
  document = fitting();
  document["tolerances"] = {
      {{"id", "r"}, {"kind", "circularity"}, {"of", "head"}, {"value_mm", 0.01}}};
  EXPECT_NE(refusal_of(document).find("/tolerances/0/of"), std::string::npos)
      << refusal_of(document);
  document = fitting();
  document["inner"] = {
      {{"id", "b"}, {"kind", "as-stock"}, {"from", "right"}, {"length_mm", 10}}};
  EXPECT_NE(refusal_of(document).find("/inner/0/kind"), std::string::npos)
      << refusal_of(document);
}

TEST(Stock, WithCornersRunsInNoRestAndOtherElementsAreSmaller) {
  auto document = fitting();
  document["outer"][1]["diameter_mm"] = 28;  // flats would stay on it
  EXPECT_EQ(refusal_of(document),
            "t: /stock/across_flats_mm: got 27, expected more than the largest element, "
            "28 mm");
  document = fitting();
  document["setups"] = {
      {{"hold", "left"}, {"clampings", {"chuck-steady"}}, {"steady_mm", 45}}};
  EXPECT_NE(refusal_of(document).find("no rest, which runs on no bar with corners"),
            std::string::npos)
      << refusal_of(document);
}

// Their blanks would be turned to the stock's own diameter.
TEST(Stock, WhatKeepsItHasNoGroovesOrNecksBetween) {
  auto document = fitting();
  document["outer"] = {
      {{"id", "head"}, {"kind", "as-stock"}, {"length_mm", 20}},
      {{"id", "n"}, {"kind", "cylinder"}, {"length_mm", 5}, {"diameter_mm", 20}},
      {{"id", "rim"}, {"kind", "as-stock"}, {"length_mm", 25}}};
  const std::string told =
      "t: /outer/1/kind: got \"cylinder\", expected no groove or neck there: its blank "
      "would be turned to the diameter of head beside it, which stays as the stock is";
  EXPECT_EQ(refusal_of(document), told);
  document["outer"][1]["kind"] = "groove";
  EXPECT_NE(refusal_of(document).find("no groove or neck there"), std::string::npos)
      << refusal_of(document);
}

// A hexagon of 400 mm is 461.9 mm wide through its corners, and has no circle from which a
// keyway's depth would count.
TEST(Stock, SwingsWithItsCornersAndIsNotMilledAtThem) {
  auto document = fitting();
  document["stock"]["across_flats_mm"] = 400;
  document["machine"] = "lathe-medium";
  const auto shop = load_catalogue(source_path(""));
  const auto told = [&] {
    try {
      load_part_plan(document, shop, "t");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  document["material"] = "C45";
  EXPECT_NE(told().find("got 400, expected corners within the swing of lathe-medium, "
                        "450 mm"),
            std::string::npos)
      << told();
  document["machine"] = "turn-mill";
  document["stock"]["across_flats_mm"] = 27;
  document["milling"] = {{{"id", "k"},
                          {"kind", "flat"},
                          {"on", "head"},
                          {"z_mm", 5},
                          {"length_mm", 10},
                          {"depth_mm", 3}}};
  EXPECT_NE(told().find("/milling/0/on: got \"head\""), std::string::npos) << told();
  document["milling"][0]["on"] = "spigot";
  document["milling"][0]["z_mm"] = 30;
  EXPECT_EQ(told().find("/milling/0/on"), std::string::npos) << told();
}

TEST(Stock, ThatIsMissingIsToldOnce) {
  auto document = fitting();
  document["stock"].erase("across_flats_mm");
  EXPECT_EQ(
      refusal_of(document),
      "t: /stock/across_flats_mm: got nothing, expected a number > 0 and <= 20000 mm");
}

/// A flange with a spigot on both sides, forged, its rim as it is.
json forging() {
  return json::parse(R"({
    "material": "test-steel",
    "stock": {"kind": "forging", "limits_mm": [-1, 2], "left_allowance_mm": 3,
              "outline": [{"length_mm": 30, "left_mm": 34, "right_mm": 38},
                          {"length_mm": 20, "diameter_mm": 80},
                          {"length_mm": 40, "diameter_mm": 46}]},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 29, "diameter_mm": 30},
              {"id": "rim", "kind": "as-stock", "length_mm": 15},
              {"id": "d2", "kind": "cylinder", "length_mm": 41, "diameter_mm": 40}],
    "general": "ISO 2768-mK"})");
}

// It reaches from z = -3 to 87 mm; the step at z = 27 stands 2 mm over d1, that at z = 47
// 3 mm over d2.
TEST(Stock, OfAForgingFollowsItsOutlineWithinItsLimits) {
  const auto d = read(forging());
  EXPECT_EQ(d.stock.length_mm, 90);
  EXPECT_EQ(d.stock.outer_mm, 82);
  EXPECT_EQ(part::held_mm(d, 0, part::End::left), 33);
  EXPECT_EQ(part::held_mm(d, 0, part::End::right), 45);
  const auto before = part::stock_between(d.stock, 7, 17);
  EXPECT_NEAR(before.least_mm, 34 + 4 * 10 / 30. - 1, 1e-9);
  EXPECT_NEAR(before.most_mm, 34 + 4 * 20 / 30. + 2, 1e-9);
  EXPECT_NEAR(part::stock_of(d, 0).least_mm, 33, 1e-9);
  EXPECT_EQ(part::stock_of(d, 0).most_mm, 82);
  EXPECT_EQ(part::stock_of(d, 2).least_mm, 45);
  EXPECT_EQ(part::stock_of(d, 2).most_mm, 82);
  EXPECT_EQ(d.outer[1].left_mm, 80);
}

// A frustum of 30 mm, and cylinders of 20 and 40 mm, by hand.
TEST(Stock, OfAForgingIsAsHeavyAsDrawn) {
  const auto loaded = load_part_plan(forging(), test_catalogue(), "t");
  const double mm3 =
      M_PI / 4 * ((34 * 34 + 34 * 38 + 38 * 38) / 3. * 30 + 80 * 80 * 20 + 46 * 46 * 40);
  EXPECT_NEAR(part::section_mm2(loaded.plan.drawing.stock) * 90, mm3, 1e-6);
  EXPECT_NEAR(planning::stock_mass_kg(loaded.plan),
              mm3 * 1e-9 * loaded.plan.material.rho_kg_m3, 1e-9);
}

TEST(Stock, OfAForgingStandsAboveWhatIsTurned) {
  auto document = forging();
  document["outer"][0]["diameter_mm"] = 33;
  EXPECT_EQ(refusal_of(document),
            "t: /stock/outline: got a list of 3 entries, expected more than the 33 mm of "
            "d1 all over it; it may be 33 mm");
  document = forging();
  document["outer"][1]["length_mm"] = 20;
  document["outer"][2]["length_mm"] = 36;
  EXPECT_EQ(
      refusal_of(document),
      "t: /outer/1: got a stretch on which the outline of the stock is no cylinder, "
      "expected an element within one cylinder of the outline");
  document = forging();
  document["stock"]["inner_mm"] = 33;
  EXPECT_NE(refusal_of(document).find("/stock/outline: got a list of 3 entries, expected "
                                      "diameters above its hole, 33 mm; the least may be "
                                      "33 mm"),
            std::string::npos);
  document = forging();
  document["stock"]["length_mm"] = 90;
  EXPECT_NE(refusal_of(document).find("/stock/length_mm"), std::string::npos);
}

TEST(Stock, OfAForgingIsTakenAsDrawnWhereItsLimitsAreNotSaid) {
  auto document = forging();
  document["stock"].erase("limits_mm");
  const auto loaded = load_part_plan(document, test_catalogue(), "t");
  EXPECT_EQ(loaded.plan.drawing.stock.outer_mm, 80);
  EXPECT_TRUE(std::ranges::any_of(
      loaded.assumed, [](const auto& a) { return a.pointer == "/stock/limits_mm"; }));
}

// What cannot be read is told alone, without what would follow from it.
TEST(Stock, OfAForgingThatCannotBeReadIsToldAlone) {
  auto document = forging();
  document["stock"]["outline"][0].erase("left_mm");
  EXPECT_EQ(
      refusal_of(document),
      "t: /stock/outline/0/left_mm: got nothing, expected a number > 0 and <= 20000 "
      "mm");
  document = forging();
  document["stock"]["outline"] = nlohmann::json::array();
  EXPECT_EQ(refusal_of(document),
            "t: /stock/outline: got an empty list, expected a list of 1 to 100 entries");
  document = forging();
  document["stock"]["left_allowance_mm"] = -1;
  EXPECT_EQ(refusal_of(document),
            "t: /stock/left_allowance_mm: got -1, expected a number from 0 to 20000 mm");
}

}  // namespace
}  // namespace turnwright::document::stock_test
