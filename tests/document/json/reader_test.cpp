#include "document/json/reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "document/json/parse.hpp"

namespace turnwright::document::reader_test {
namespace {

// What the list of problems reads like, one per line, without the document's name.
std::string told(const Problems& problems) {
  std::string text;
  for (const auto& p : problems.list)
    text +=
        p.pointer + ": got " + p.got + ", expected " + p.expected + " [" + p.code + "]\n";
  return text;
}

enum class Colour { red, green };
const Choices<Colour> kColours{{"red", Colour::red}, {"green", Colour::green}};

TEST(Reader, ReadsWhatIsThere) {
  const auto document = parse(
      R"({"d_mm": 40, "n": 3, "name": "shaft", "hard": true, "colour": "green",
          "list_mm": [1, 2.5], "inner": {"x": 0}})",
      "test");
  Problems problems;
  Reader r(document, problems);
  EXPECT_EQ(r.number("d_mm", above(0, "mm")), 40);
  EXPECT_EQ(r.integer("n", 1, 6), 3);
  EXPECT_EQ(r.text("name"), "shaft");
  EXPECT_TRUE(r.boolean("hard"));
  EXPECT_EQ(r.choice<Colour>("colour", kColours), Colour::green);
  EXPECT_EQ(r.numbers("list_mm", at_least(0, "mm"), 1, 3), (std::vector{1.0, 2.5}));
  EXPECT_EQ(r.object("inner").number("x", within(0, 1)), 0);
  EXPECT_EQ(r.number_or("absent", any_number(), 7), 7);
  EXPECT_FALSE(r.optional_integer("gone", 0, 1).has_value());
  EXPECT_TRUE(r.items("list_mm", 2, 2)[1].is_number());
  r.finish();
  EXPECT_EQ(told(problems), "");
  EXPECT_NO_THROW(problems.throw_if_any());
}

TEST(Reader, ListsEveryProblemWithPointerValueUnitAndLimits) {
  const auto document = parse(
      R"({"d_mm": -40, "n": 3.7, "name": 5, "colour": "blue", "list": [1, "x", 9],
          "inner": 3, "x/y": {"z": 2}, "diamter_mm": 1, "zzz": 1})",
      "test");
  Problems problems;
  Reader r(document, problems);
  EXPECT_TRUE(std::isnan(r.number("d_mm", above(0, "mm"))));
  EXPECT_EQ(r.integer("n", 1, 6), 1);
  EXPECT_EQ(r.text("name"), "");
  EXPECT_EQ(r.choice<Colour>("colour", kColours), Colour::red);
  r.numbers("list", at_least_below(0, 9, "mm"), 1, 3);
  auto inner = r.object("inner");
  inner.number("unreadable", any_number());  // the missing object is told once
  inner.finish();
  r.object("x/y").number("z", above_up_to(0, 1, "kg"));
  r.number("diameter_mm", within(1, 2, "mm"));
  r.finish();
  EXPECT_EQ(told(problems),
            "/d_mm: got -40, expected a number > 0 mm [range]\n"
            "/n: got 3.7, expected a whole number from 1 to 6 [type]\n"
            "/name: got 5, expected a text of 1 to 200 bytes [type]\n"
            "/colour: got \"blue\", expected \"red\" or \"green\" [choice]\n"
            "/list/1: got \"x\", expected a number >= 0 and < 9 mm [type]\n"
            "/list/2: got 9, expected a number >= 0 and < 9 mm [range]\n"
            "/inner: got 3, expected an object [type]\n"
            "/x~1y/z: got 2, expected a number > 0 and <= 1 kg [range]\n"
            "/diameter_mm: got nothing, expected a number from 1 to 2 mm [missing]\n"
            "/diamter_mm: got 1, expected no such key (did you mean \"diameter_mm\"?) "
            "[unknown-key]\n"
            "/zzz: got 1, expected no such key [unknown-key]\n");
  EXPECT_THROW(problems.throw_if_any(), InputError);
}

TEST(Reader, ARangeEndsWhereItsSignSays) {
  EXPECT_FALSE(contains(above(0), 0));
  EXPECT_TRUE(contains(at_least(0), 0));
  EXPECT_TRUE(contains(within(0, 1), 1));
  EXPECT_FALSE(contains(at_least_below(0, 1), 1));
  EXPECT_FALSE(contains(above_up_to(0, 1), 0));
  EXPECT_TRUE(contains(above_up_to(0, 1), 1));
  EXPECT_FALSE(contains(any_number(), std::nan("")));
  EXPECT_FALSE(contains(any_number(), HUGE_VAL));
}

// Lengths that no shape has, and what overflows once it is divided by.
TEST(Reader, WhatIsTooSmallToComputeWithIsZero) {
  const auto document =
      parse(R"({"a_mm": 1e-10, "b_mm": 1e-8, "c_mm": 1e-10, "d_mm": -1e-10,
                              "e": 5e-324, "f": 1e-99, "g": 5e-324})",
            "test");
  Problems problems;
  Reader r(document, problems);
  r.number("a_mm", above(0, "mm"));
  EXPECT_EQ(r.number("b_mm", above(0, "mm")), 1e-8);
  EXPECT_EQ(r.number("c_mm", at_least(0, "mm")), 1e-10);
  EXPECT_EQ(r.number("d_mm", within(-1, 1, "mm")), -1e-10);
  r.number("e", above(0));
  EXPECT_EQ(r.number("f", above(0)), 1e-99);
  EXPECT_EQ(r.number("g", at_least(0)), 0);
  EXPECT_EQ(told(problems),
            "/a_mm: got 1e-10, expected a number > 0 mm [range]\n"
            "/e: got 5e-324, expected a number > 0 [range]\n");
}

TEST(Reader, AnIntegerNeverWraps) {
  const auto document = parse("[18446744073709551615, 5.0, 1e3, -1]", "test");
  Problems problems;
  for (const auto& item : Reader(document, problems).as_items(4, 4))
    item.as_integer(0, 10);
  EXPECT_EQ(told(problems),
            "/0: got 18446744073709551615, expected a whole number from 0 to 10 [range]\n"
            "/1: got 5.0, expected a whole number from 0 to 10 [type]\n"
            "/2: got 1000.0, expected a whole number from 0 to 10 [type]\n"
            "/3: got -1, expected a whole number from 0 to 10 [range]\n");
}

TEST(Reader, AValueIsShownEvenIfItsTextEndsWithinALetter) {
  EXPECT_EQ(shown(std::string("1 \u00e9").substr(0, 3)), "\"1 \\ufffd\"");
  EXPECT_EQ(shown(std::string(100, 'x')).size(), 63U);  // of 60 and "..."
}

TEST(Reader, SuggestsOnlyWhatIsNear) {
  EXPECT_EQ(nearest("diamter_mm", {"length_mm", "diameter_mm"}), "diameter_mm");
  EXPECT_EQ(nearest("colour", {"id", "kind"}), "");
  EXPECT_EQ(nearest("xy", {"id"}), "");  // two edits make any two letters
}

}  // namespace
}  // namespace turnwright::document::reader_test
