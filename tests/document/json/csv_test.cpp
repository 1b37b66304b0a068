#include "document/json/csv.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::csv_test {
namespace {

using nlohmann::json;

const std::vector<CsvColumn>& columns() {
  static const std::vector<CsvColumn> kAll{{.name = "setup", .text = true},
                                           {.name = "z_mm"},
                                           {.name = "F_N"},
                                           {.name = "e_mm", .required = false}};
  return kAll;
}

struct Read {
  json rows = json::array();
  std::string pointers, problems;
};

Read read(const json& csv, OtherColumns others = OtherColumns::refused,
          std::size_t most_rows = 5) {
  Problems problems{.document = "cuts"};
  Read out;
  for (const CsvRow& row :
       csv_rows(Reader(csv, problems, "/csv"), columns(), others, most_rows)) {
    out.rows.push_back(row.value);
    out.pointers += row.pointer + "\n";
  }
  try {
    problems.throw_if_any();
  } catch (const InputError& e) {
    out.problems = e.what();
  }
  return out;
}

std::string refused(const json& csv, OtherColumns others = OtherColumns::refused) {
  return read(csv, others).problems;
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  for (auto at = text.find(old); at != text.npos; at = text.find(old, at + now.size()))
    text.replace(at, old.size(), now);
  return text;
}

const std::string kPlain =
    "F_N,setup,z_mm\n"
    "100,A,20\n"
    "400,A,80.5\n"
    "-4,007,80\n";

TEST(Csv, RowsAreObjectsOfNumbersAndTexts) {
  const Read plain = read(kPlain);
  EXPECT_EQ(plain.rows, (json{{{"setup", "A"}, {"z_mm", 20}, {"F_N", 100}},
                              {{"setup", "A"}, {"z_mm", 80.5}, {"F_N", 400}},
                              {{"setup", "007"}, {"z_mm", 80}, {"F_N", -4}}}));
  EXPECT_EQ(plain.pointers, "/csv#line 2\n/csv#line 3\n/csv#line 4\n");
  EXPECT_EQ(plain.problems, "");
  // what is empty is absent, what is no number stays text
  EXPECT_EQ(read("setup,z_mm,F_N,e_mm\nA,,1e400,nan").rows,
            (json{{{"setup", "A"}, {"F_N", "1e400"}, {"e_mm", "nan"}}}));
}

TEST(Csv, OneTableInManyHands) {
  const json expected = read(kPlain).rows;
  const auto same = [&](const json& csv) {
    const Read now = read(csv);
    EXPECT_EQ(now.rows, expected) << csv;
    EXPECT_EQ(now.problems, "") << csv;
  };
  same(with(kPlain, "\n", "\r\n"));
  same("\xEF\xBB\xBF" + kPlain);
  same(with(kPlain, "\n", "\n\r\n \t\n"));
  same(with(kPlain, ",", ";"));
  same(with(kPlain, ",", "\t"));
  same(with(kPlain, ",", " \t, "));
  same(with(kPlain, "\n", ",,\n"));
  same(kPlain + ",,,,,,\n,,\n");
  same("# lathe 3, \"Monday\n\n  # more\n" + kPlain);
  same(with(with(kPlain, "100", "+1.00e+2"), "-4", "-4."));
  same(with(with(kPlain, "A", " \"A\" "), "80.5", "\"80.5\""));
  same(with(with(kPlain, ",", "\t"), "A", " \"A\" "));
  same({"F_N,setup,z_mm", "100,A,20", "", "400,A,80.5\r", "-4,007,80"});
  same({"\xEF\xBB\xBF# a list of lines", "F_N;setup;z_mm", "100;A;20", "400;A;80.5",
        "-4;007;80", ""});
}

TEST(Csv, QuotesHoldSeparatorsAndQuotes) {
  const Read quoted =
      read("setup,\"z_mm\",F_N\n\"3\"\" jaws, soft\",\" 2 \",3\n#1,2,3\n");
  EXPECT_EQ(quoted.problems, "");
  EXPECT_EQ(quoted.rows[0]["setup"], "3\" jaws, soft");
  EXPECT_EQ(quoted.rows[0]["z_mm"], " 2 ");  // no number, as its quotes say
  EXPECT_EQ(quoted.rows[1]["setup"], "#1");  // a remark stands before the header only
  EXPECT_EQ(read("setup,z_mm,F_N\n3\" jaws,1,2").rows[0]["setup"], "3\" jaws");
  EXPECT_EQ(
      refused("setup,z_mm,F_N\n\"A,1,2\nB,1,2\n\"C\"D,1,2\n\"E\nF,1,2\n"),
      R"(cuts: /csv#line 2: got a quote out of place, expected cells as "text", on one line, with "" for a quote
cuts: /csv#line 4: got a quote out of place, expected cells as "text", on one line, with "" for a quote
cuts: /csv#line 5: got a quote out of place, expected cells as "text", on one line, with "" for a quote)");
}

TEST(Csv, RowsOfAnotherLengthAreToldByLine) {
  const Read uneven = read(
      "setup,z_mm,F_N\n"
      "A,1\n"
      "\n"
      "A,1,2\n"
      "A,1,2,3\n");
  EXPECT_EQ(uneven.rows.size(), 1u);
  EXPECT_EQ(uneven.pointers, "/csv#line 4\n");
  EXPECT_EQ(uneven.problems,
            R"(cuts: /csv#line 2: got 2 cells, expected 3 as in the header
cuts: /csv#line 5: got 4 cells, expected 3 as in the header)");
}

TEST(Csv, HeadersMustNameTheColumns) {
  EXPECT_EQ(
      refused("\nsetup,z_m,F_N,F_N,\"a\"\"\",,e_mm\nA,1,2,3,4,5,6"),
      R"(cuts: /csv#line 2: got column "z_m", expected columns of setup, z_mm, F_N, e_mm
cuts: /csv#line 2: got column "F_N" again, expected each column once
cuts: /csv#line 2: got column "a\"", expected columns of setup, z_mm, F_N, e_mm
cuts: /csv#line 2: got column "", expected columns of setup, z_mm, F_N, e_mm
cuts: /csv#line 2: got no column "z_mm", expected perhaps "z_m")");
  // where others are ignored, only what is wanted counts
  const Read loose = read("z_mm,\"x,y\",Setup,F_N,note,note,,\n1,\"2,3\",A,4,ten,1,,\n",
                          OtherColumns::ignored);
  EXPECT_EQ(loose.rows, json::array());
  EXPECT_EQ(loose.problems,
            R"(cuts: /csv#line 1: got no column "setup", expected perhaps "Setup")");
  EXPECT_EQ(read("z_mm,\"x,y\",setup,F_N,note,note,,\n1,\"2,3\",A,4,ten,1,,\n",
                 OtherColumns::ignored)
                .rows,
            (json{{{"setup", "A"}, {"z_mm", 1}, {"F_N", 4}}}));
  EXPECT_EQ(refused("z_mm,z_mm,setup,F_N\n1,1,1,1", OtherColumns::ignored),
            R"(cuts: /csv#line 1: got column "z_mm" again, expected each column once)");
  EXPECT_EQ(refused("20,100,A\n80,100,A", OtherColumns::ignored),
            R"(cuts: /csv#line 1: got no column "setup", expected one
cuts: /csv#line 1: got no column "z_mm", expected one
cuts: /csv#line 1: got no column "F_N", expected one)");
}

TEST(Csv, OneDecimalMarkIsThatOfAllNumbers) {
  const auto row = [](const std::string& table) { return read(table).rows.at(0); };
  const json wanted{{"setup", "A"}, {"z_mm", 3.5}, {"F_N", -1e-3}};
  EXPECT_EQ(row("setup;z_mm;F_N\nA;3,5;-0,1e-2"), wanted);
  EXPECT_EQ(row("setup\tz_mm\tF_N\nA\t3,5\t\"-1e-3\""), wanted);
  EXPECT_EQ(row("setup;z_mm;F_N\nA;3.5;-0.001"), wanted);
  // a text with a comma has none
  EXPECT_EQ(row("setup;z_mm;F_N\n1,2;x,y;1,2,3"),
            (json{{"setup", "1,2"}, {"z_mm", "x,y"}, {"F_N", "1,2,3"}}));
}

TEST(Csv, AnotherDecimalMarkIsToldOnce) {
  const std::string point =
      "got \"0,5\", expected a decimal point, here and in all numbers";
  EXPECT_EQ(refused("setup;z_mm;F_N\n1,2;1;2\nA;3.1;0,5\nA;0,5;0,5\n"),
            "cuts: /csv#line 3/F_N: " + point);
  EXPECT_EQ(refused("setup,z_mm,F_N\nA,\"0,5\",2\n"), "cuts: /csv#line 2/z_mm: " + point);
  EXPECT_EQ(
      refused("setup;z_mm;F_N\nA;0,5;1.2\nA;1.2;2\n"),
      "cuts: /csv#line 2/F_N: got \"1.2\", expected a decimal comma, here and in all "
      "numbers");
}

TEST(Csv, WhatIsNoTableIsRefusedAtOnce) {
  const std::string form = ", expected the text of a table, or the list of its lines";
  EXPECT_EQ(refused(7), "cuts: /csv: got 7" + form);
  EXPECT_EQ(refused({"setup", 7}), "cuts: /csv: got [\"setup\",7]" + form);
  EXPECT_EQ(refused(nullptr), "cuts: /csv: got null" + form);
  const std::string rows =
      "cuts: /csv: got no rows, expected a header with columns of setup, z_mm, F_N, e_mm "
      "and 1 to 5 rows";
  for (const json& empty : {json(""), json("\n \r\n"), json::array(), json("# nothing"),
                            json("setup,z_mm,F_N\n"), json("setup,z_mm,F_N\n,,\n")})
    EXPECT_EQ(refused(empty), rows) << empty;
  EXPECT_EQ(
      refused(std::string("setup,z_mm,F_N\nA,\0\0,2\n\x01", 22)),
      "cuts: /csv#line 2: got the control character 0 in column 3, expected a table "
      "as text");
  EXPECT_EQ(refused("setup,z_mm,F_N\rA,1,2\rB,1,2"),  // line ends of the last century
            "cuts: /csv#line 1: got the control character 13 in column 15, expected a "
            "table as text");
  EXPECT_EQ(refused({"setup,z_mm,F_N\nA,1,2"}),
            "cuts: /csv#line 1: got the control character 10 in column 15, expected a "
            "table as text");
}

TEST(Csv, AHugeTableIsRefusedBeforeItIsKept) {
  std::string text = "setup,z_mm,F_N\n";
  for (int i = 0; i < 5; ++i) text += "A,1,2\n";
  EXPECT_EQ(read(text).rows.size(), 5u);
  EXPECT_EQ(read(text).problems, "");
  for (int i = 0; i < 100000; ++i) text += "A,1,2\n";
  const Read huge = read(text);
  EXPECT_EQ(huge.rows.size(), 6u);
  EXPECT_EQ(huge.problems,
            "cuts: /csv: got more rows, expected a header with columns of setup, z_mm, "
            "F_N, e_mm and 1 to 5 rows");
  // a header of a hundred thousand columns: a hundred problems and their number
  const std::string wide(100000, ',');
  EXPECT_LT(refused(wide + "x\n").size(), 20000u);
}

TEST(Csv, IsGivenUpIfNobodyWaits) {
  std::stop_source source;
  source.request_stop();
  const auto stop = source.get_token();
  const Listening listening(stop);
  EXPECT_THROW(read(kPlain), Cancelled);
  Problems problems{.document = "cuts"};
  const json csv = kPlain;
  EXPECT_THROW(
      csv_cells(Reader(csv, problems, "/csv"), 5, [](const CsvCells&) { return true; }),
      Cancelled);
}

TEST(Csv, AMissingMemberIsReportedByItsReaderAlone) {
  Problems problems{.document = "cuts"};
  const json request = json::object();
  Reader r(request, problems);
  EXPECT_TRUE(csv_rows(r.at("csv"), columns(), OtherColumns::refused, 5).empty());
  ASSERT_EQ(problems.list.size(), 1u);
  EXPECT_EQ(problems.list[0].pointer, "/csv");
}

}  // namespace
}  // namespace turnwright::document::csv_test
