#include "turnwright/exchange/part21.hpp"

#include <gtest/gtest.h>

#include <string>

#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

std::string part21_file(const std::string& data, const std::string& header = "") {
  return "ISO-10303-21;\nHEADER;\n" + header + "ENDSEC;\nDATA;\n" + data +
         "\nENDSEC;\nEND-ISO-10303-21;\n";
}

std::string part21_refusal(const std::string& text) {
  try {
    read_part21(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

TEST(Part21, EveryKindOfValueIsRead) {
  const auto text = part21_file(
      "#1=A($,*,42,-7,.5,1.,-2.5E-3,'it''s',.METRE.,\"0FF\",#2,(1,(2,#1),()),"
      "LENGTH_MEASURE(3.));#2=B();");
  const auto x = read_part21(text);
  const auto a = x.at(1).as("A");
  ASSERT_EQ(a.size(), 13U);
  EXPECT_TRUE(a[0].is(ValueKind::omitted));
  EXPECT_TRUE(a[1].is(ValueKind::derived));
  EXPECT_EQ(a[2].integer(), 42);
  EXPECT_EQ(a[3].real(), -7);
  EXPECT_EQ(a[4].real(), 0.5);
  EXPECT_EQ(a[5].real(), 1);
  EXPECT_EQ(a[6].real(), -2.5e-3);
  EXPECT_EQ(a[7].text(), "it's");
  EXPECT_EQ(a[8].word(), "METRE");
  EXPECT_EQ(a[9].binary(), "0FF");
  EXPECT_EQ(a[10].id(), 2U);
  EXPECT_EQ(a[11].size(), 3U);
  EXPECT_EQ(a[11][1][1].instance(), x.at(1));
  EXPECT_EQ(a[11][2].size(), 0U);
  EXPECT_EQ(a[12].type(), "LENGTH_MEASURE");
  EXPECT_EQ(a[12].inner().real(), 3);
  EXPECT_EQ(a[12].measure(), 3);
}

TEST(Part21, SpaceAndCommentsStandBetweenAnyTokens) {
  const auto text = part21_file(
      "#1 /* ; ' */ =\n A ( 1\t, 'a /* b' , /**/ ( ) )\r\n;\n\\N\\#2=A(2,'x','');");
  const auto x = read_part21(text);
  EXPECT_EQ(x.size(), 2U);
  EXPECT_EQ(x.at(1).as("A")[1].text(), "a /* b");
  EXPECT_EQ(x.at(1).line(), 5U);
  EXPECT_EQ(x.at(2).line(), 8U);
}

TEST(Part21, ComplexInstancesHaveTheirRecordsInOrder) {
  const auto text =
      part21_file("#7=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));");
  const auto x = read_part21(text);
  const auto unit = x.at(7);
  EXPECT_EQ(unit.name(), "LENGTH_UNIT+NAMED_UNIT+SI_UNIT");
  EXPECT_EQ(unit.as("SI_UNIT")[0].word(), "MILLI");
  EXPECT_FALSE(unit.is("PLANE"));
  EXPECT_EQ(x.all("NAMED_UNIT").size(), 1U);
}

TEST(Part21, HeaderAndSeveralSectionsAreRead) {
  const std::string text =
      "\xef\xbb\xbfISO-10303-21;HEADER;FILE_NAME('a.stp','',(''),(''),'','','');ENDSEC;"
      "ANCHOR;<top>=#2;ENDSEC;DATA('one',('AP242'));#1=A(#2);ENDSEC;"
      "DATA;#2=A(#1);ENDSEC;END-ISO-10303-21;SIGNATURE;MIIG;ENDSEC;";
  const auto x = read_part21(text);
  EXPECT_EQ(x.header("FILE_NAME")->operator[](0).text(), "a.stp");
  EXPECT_FALSE(x.header("FILE_SCHEMA"));
  EXPECT_EQ(x.at(1).users(), std::vector{x.at(2)});
  EXPECT_EQ(x.at(2).users(), std::vector{x.at(1)});  // a circle is no trouble
}

TEST(Part21, UsersAreToldOnceEach) {
  const auto text = part21_file("#3=A(#1,#1,(#1));#1=B();#2=A(#1);");
  const auto x = read_part21(text);
  EXPECT_EQ(x.at(1).users(), (std::vector{x.at(3), x.at(2)}));
  EXPECT_TRUE(x.at(3).users().empty());
}

// ISO 10303-21 gives \X2\ as UCS-2, \S\ as the upper half of a page of ISO 8859; the
// characters are those of the Unicode charts.
TEST(Part21Text, EveryEncodingBecomesUtf8) {
  EXPECT_EQ(part21_text("a''b\\\\c"), "a'b\\c");
  EXPECT_EQ(part21_text("W\\S\\dlle"), "W\u00e4lle");
  EXPECT_EQ(part21_text("\\X\\D8 30"), "\u00d8 30");
  EXPECT_EQ(part21_text("\\X2\\03B103B2\\X0\\x"), "\u03b1\u03b2x");
  EXPECT_EQ(part21_text("\\X4\\0001F529\\X0\\"), "\U0001f529");
  EXPECT_EQ(part21_text("\\X2\\D83DDD29\\X0\\"), "\U0001f529");  // a pair of surrogates
  EXPECT_EQ(part21_text("\\PE\\\\S\\2"), "\u0412");              // ISO 8859-5
  EXPECT_EQ(part21_text("\xc3\x98"), "\u00d8");                  // UTF-8 as it is
  EXPECT_EQ(part21_text("\xd8 30"), "\u00d8 30");                // ISO 8859-1
  EXPECT_EQ(part21_text("two\nlines"), "twolines");
}

TEST(Part21Text, WhatIsNoCharacterIsReplaced) {
  EXPECT_EQ(part21_text("\\X\\GG"), "\ufffd");
  EXPECT_EQ(part21_text("\\X2\\D83D\\X0\\."), ".");
  EXPECT_EQ(part21_text("\\X2\\00"), "\ufffd");
  EXPECT_EQ(part21_text("\\X4\\FFFFFFFF\\X0\\"), "\ufffd");
  EXPECT_EQ(part21_text("\\S\\"), "\\S\\");
}

TEST(Part21, AccessOfAWrongKindNamesThePlace) {
  const auto text =
      part21_file("#12=CIRCLE('',#13,'thick');#13=PLANE('',LENGTH_MEASURE(1.));");
  const auto x = read_part21(text);
  const auto says = [](const auto& access) -> std::string {
    try {
      access();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const auto circle = x.at(12).as("CIRCLE");
  EXPECT_EQ(says([&] { circle[2].real(); }),
            "STEP file: #12 CIRCLE parameter 3: got a string, expected a number");
  EXPECT_EQ(says([&] { circle[1].text(); }),
            "STEP file: #12 CIRCLE parameter 2: got #13 PLANE, expected a string");
  EXPECT_EQ(says([&] { circle[9].text(); }),
            "STEP file: #12 CIRCLE: got 3 parameters, expected 10 or more");
  EXPECT_EQ(says([&] { x.at(13).as("CIRCLE"); }),
            "STEP file: #13 PLANE: got PLANE, expected an instance of CIRCLE");
  EXPECT_EQ(
      says([&] { x.at(13).as("PLANE")[1].boolean(); }),
      "STEP file: #13 PLANE parameter 2: got LENGTH_MEASURE(..), expected .T. or .F.");
  EXPECT_EQ(
      says([&] { x.at(99); }),
      "STEP file: #99: got no such instance, expected a number that the file holds");
}

TEST(Part21, AllFaultsAreToldWithTheirLines) {
  const auto said =
      part21_refusal(part21_file("#1=A(1;\n#2=A(1.2.3);\n#3=A('',);\n#4 A();\n#5=A();"));
  EXPECT_NE(said.find("line 5: got ;"), said.npos) << said;
  EXPECT_NE(said.find("line 6: got 1.2.3"), said.npos) << said;
  EXPECT_NE(said.find("line 7: got )"), said.npos) << said;
  EXPECT_NE(said.find("line 8: got A();, expected = behind"), said.npos) << said;
  EXPECT_EQ(said.find("line 9"), said.npos) << said;
}

TEST(Part21, BrokenFilesAreRefusedWithTheReason) {
  const auto expect = [](const std::string& text, const std::string& part) {
    const auto said = part21_refusal(text);
    EXPECT_NE(said.find(part), said.npos) << said;
  };
  expect("", "line 1: got the end of the file, expected ISO-10303-21;");
  expect("solid cube", "line 1: got solid cube, expected ISO-10303-21;");
  expect("ISO-10303-21;HEADER;ENDSEC;END-ISO-10303-21;", "expected a section DATA");
  expect("ISO-10303-21;DATA;\n#1=A();\nEND-ISO-10303-21;",
         "line 3: got END-ISO-10303-21");
  expect("ISO-10303-21;HEADER;DATA;#1=A();ENDSEC;", "expected ENDSEC;");
  expect("ISO-10303-21;DATA;#1=A(", "line 1: got the end of the file");
  expect("ISO-10303-21;DATA;ENDSEC;", "expected END-ISO-10303-21; or a section");
  expect(part21_file("#1=A('never ends);"),
         "line 5: got 'never ends);, expected a string that");
  expect(part21_file("/* never ends"), "expected */ at the end of this comment");
  expect(part21_file("#1=A();\n#1=B();"), "line 6: got #1 a second time");
  expect(part21_file("#1=A();\n#2=B(#1,#7);"), "line 6: got #2 B referring to #7");
  expect(part21_file("#1=A(1.E999);"), "expected a finite number");
  expect(part21_file("#1=A(NAN);"), "expected ( behind a type's name");
  expect(part21_file("#1=A(INF(1));#2=A(-INF);"), "got -INF);");
  expect(part21_file("#1=A(99999999999999999999);"), "expected an integer of 64 bits");
  expect(part21_file("#1=A(LENGTH_MEASURE(1.,2.));"), "expected one value of a type");
  expect(part21_file("#99999999999999999999=A();"), "expected the number of an instance");
}

TEST(Part21, TinyNumbersAreZero) {
  const auto text = part21_file("#1=A(1.E-999);");
  EXPECT_EQ(read_part21(text).at(1).as("A")[0].real(), 0);
}

TEST(Part21, DeepListsAreRefusedWithoutRecursion) {
  const auto nested = [](std::size_t n) {
    return part21_file("#1=A(" + std::string(n, '(') + std::string(n, ')') + ");");
  };
  EXPECT_EQ(part21_refusal(nested(64)), "read");
  EXPECT_NE(part21_refusal(nested(65)).find("at most 64 levels"), std::string::npos);
  EXPECT_NE(part21_refusal(nested(1'000'000)).find("at most 64 levels"),
            std::string::npos);
}

TEST(Part21, FaultsBeyondAHundredAreCounted) {
  std::string data;
  for (int i = 1; i <= 250; ++i) data += "#" + std::to_string(i) + "=A(#999);\n";
  const auto said = part21_refusal(part21_file(data));
  EXPECT_NE(said.find("150 more problems"), said.npos) << said;
}

// Every prefix of a file is answered: read, or refused.
TEST(Part21, AFileCutAnywhereIsAnswered) {
  const auto whole =
      part21_file("#1=A('x',(1.,$),#2);\n#2=(B()C(.T.));", "FILE_NAME('');\n");
  for (std::size_t n = 0; n + 19 < whole.size(); ++n)
    EXPECT_NE(part21_refusal(whole.substr(0, n)), "read") << n;
  EXPECT_EQ(part21_refusal(whole), "read");
}

TEST(Part21, AMillionInstancesInAnyOrderAreRead) {
  std::string data;
  constexpr int kMany = 1'000'000;
  for (int i = kMany; i > 0; --i)
    data += "#" + std::to_string(i) + "=A(#" + std::to_string(i % kMany + 1) + ");\n";
  const auto text = part21_file(data);
  const auto x = read_part21(text);
  EXPECT_EQ(x.size(), 1'000'000U);
  EXPECT_EQ(x.at(500'000).as("A")[0].id(), 500'001U);
  EXPECT_EQ(x.at(1).users()[0].id(), 1'000'000U);
}

}  // namespace
}  // namespace turnwright::exchange
