#include "document/json/parse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "turnwright/base/errors.hpp"

namespace turnwright::document::parse_test {
namespace {

std::string refusal(std::string_view text, const ParseLimits& limits = {}) {
  try {
    parse(text, "t", limits);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Parse, EqualsTheLibraryOnGoodDocuments) {
  for (const auto* text :
       {"{}", "[]", "3", "\"x\"", "null",
        R"({"a":[1,{"b":[[],{}]},-2.5e3],"c":"\u00e4"})", " [true , false]\n"})
    EXPECT_EQ(parse(text, "t"), nlohmann::json::parse(text)) << text;
}

TEST(Parse, NamesTheSecondOfTwoKeysWhereverItStands) {
  EXPECT_EQ(refusal(R"({"a": 1, "a": 2})"),
            "t: /a: got the key a second time, expected each key once");
  EXPECT_EQ(refusal(R"({"x": [0, {"b": [3, {}], "c": {}, "b": 1}, {"d": 1, "d": 1}]})"),
            "t: /x/1/b: got the key a second time, expected each key once\n"
            "t: /x/2/d: got the key a second time, expected each key once");
  EXPECT_EQ(refusal(R"([[], [{"a/b~": 1, "a/b~": 2}]])"),
            "t: /1/0/a~1b~0: got the key a second time, expected each key once");
}

TEST(Parse, RefusesNumbersADoubleCannotHold) {
  EXPECT_EQ(
      refusal("[1,\n {\"f\": 1e999}]"),
      "t: /1/f: got a number too large (line 2, column 12), expected a number that a "
      "double can hold");
  EXPECT_EQ(refusal(R"([0, -1e-400])"),
            "t: /1: got -1e-400, expected a number that a double can hold");
  EXPECT_EQ(refusal("[0.0, 0e9, -0.0, 0e-999]"), "accepted");
}

TEST(Parse, PointsAtTheFirstByteThatIsNoJson) {
  EXPECT_EQ(refusal("{\"a\": 1,\n  \"b\": }"),
            "t: document: got broken JSON at line 2, column 8: unexpected '}' in value, "
            "expected '[', '{', or a literal");
  for (const auto* text : {"NaN", "[Infinity]", "{'a': 1}", "[1] 2", "[1,]", "// c\n1",
                           "{", "01", "+1", ".5", "\"\\x\"", "\"tab\tinside\""})
    EXPECT_NE(refusal(text).find("broken JSON at line 1"), std::string::npos) << text;
  EXPECT_EQ(refusal(" \n"),
            "t: document: got an empty document, expected a JSON document");
}

TEST(Parse, NamesNumbersThatJsonDoesNotKnow) {
  EXPECT_EQ(refusal("NaN"),
            "t: document: got broken JSON at line 1, column 1: NaN, expected a number; "
            "JSON knows no NaN");
  EXPECT_EQ(refusal("{\"a\": [1,\n -Infinity]}"),
            "t: /a/1: got broken JSON at line 2, column 3: -Infinity, expected a number; "
            "JSON knows no "
            "-Infinity");
  EXPECT_NE(refusal("[nano]").find("broken JSON"), std::string::npos);
}

TEST(Parse, SaysThatUtf8IsWanted) {
  using namespace std::string_view_literals;
  for (const auto text : {"\xff\xfe{\0}\0"sv, "\xfe\xff\0{\0}"sv, "{\0}\0"sv, "\0{\0}"sv})
    EXPECT_EQ(refusal(text), "t: document: got UTF-16 or UTF-32, expected JSON in UTF-8");
}

TEST(Parse, ReadsOnBehindANul) {
  using namespace std::string_view_literals;
  for (const auto text : {"{}\0"sv, "{}\0{}"sv, "[1,\n2]\0 x"sv})
    EXPECT_THROW(parse(text, "t"), InputError);
}

TEST(Parse, HoldsItsLimits) {
  EXPECT_EQ(refusal("[[[]]]", {.depth = 3}), "accepted");
  EXPECT_EQ(refusal("[[[[]]]]", {.depth = 3}),
            "t: document: got objects and lists nested too deeply, expected at most 3 "
            "levels");
  EXPECT_EQ(refusal("[1,2,3]", {.bytes = 6}),
            "t: document: got 7 bytes, expected at most 6 bytes");
  EXPECT_EQ(refusal(R"({"a": {"bcd": 1}})", {.key_bytes = 2}),
            "t: /a: got a key of 3 bytes, expected at most 2 bytes");
  EXPECT_EQ(refusal(R"(["abc", "abcd"])", {.string_bytes = 3}),
            "t: /1: got a text of 4 bytes, expected at most 3 bytes");
  for (const std::size_t bytes : {6u, 7u}) {
    std::istringstream in("[1,2,3]");
    if (bytes == 7)
      EXPECT_EQ(parse(in, "t", {.bytes = bytes}).size(), 3u);
    else
      EXPECT_THROW(parse(in, "t", {.bytes = bytes}), InputError);
  }
  EXPECT_NE(refusal(std::string(1'900'000, '[')).find("nested too deeply"),
            std::string::npos);
}

TEST(Parse, ListsAHundredProblemsAndCountsTheRest) {
  std::string text = "{\"a\":1";
  for (int i = 0; i < 150; ++i) text += ",\"a\":1";
  const std::string message = refusal(text + "}");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 100);
  EXPECT_NE(message.find("t: document: got 50 more problems"), std::string::npos);
}

TEST(Parse, AnswersInPrintableAscii) {
  for (const auto& text :
       {std::string("\x00\x01\xff\xfe{", 5), std::string("[\"\xc3\x28\"]"),
        std::string("\x80\x81"), std::string("[\"\xed\xa0\x80\"]")}) {
    const std::string message = refusal(text);
    EXPECT_NE(message, "accepted");
    for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~') << message;
  }
}

TEST(Parse, SaysWhatIsMeantWhereASlipIsAUsualOne) {
  const auto told = [](const char* text, const char* slip) {
    const auto message = refusal(text);
    EXPECT_NE(message.find(slip), std::string::npos) << text << '\n' << message;
  };
  told(R"({"Ra_um": 1,6, "fit": "h7"})", ": 1,6, expected 1.6, with a decimal point");
  told(R"({"limits_mm": -0,025})", ": -0,025, expected -0.025, with a decimal point");
  told(R"({"a": 1, })", ": a comma before }, expected no comma behind the last one");
  told("[1, 2,\n]", "line 2, column 1: a comma before ], expected no comma behind");
  told("{\"a\": 1 // of the shaft\n}", ": //, expected no comment: JSON has none");
  told("{/* of the shaft */}", ": /*, expected no comment");
  told("{\"a\": 1}\n# more", ": #, expected no comment");
  told("{'a': 1}", ": ', expected double quotes");
  told("{a_mm: 1}", R"(: a_mm, expected "a_mm", in double quotes)");
  told(R"({"a": .5})", ": .5, expected 0.5");
  told(R"({"a": +5})", ": +5, expected 5");
  told(R"({"a": -.5})", ": -.5, expected -0.5");
  told(R"({"a": True})", ": True, expected true");
  told(R"([None])", ": None, expected null");
  told(R"({"a": 1; "b": 2})", ": ;, expected a comma between members");
  told(R"({"a" = 1})", ": =, expected a colon");
  told(R"({"a": 020})", ": 020, expected no zero before the other digits");
  told("{\"a\": 1\n\"b\": 2}", ": two members or values side by side, expected a comma");
  told(R"([{"a": 1} {"a": 2}])", "expected a comma between them");
}

// A number behind a comma is no decimal comma if the list may go on with it.
TEST(Parse, NumbersOfListsAreNoDecimals) {
  EXPECT_EQ(parse("[1,6]", "t"), (nlohmann::json{1, 6}));
  EXPECT_EQ(refusal("[1,6,,7]").find("decimal"), std::string::npos);
  EXPECT_EQ(refusal(R"({"a": 1,6,7})").find("1.6.7"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::parse_test
