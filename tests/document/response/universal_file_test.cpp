// Universal files that others wrote (tests/data/uff/README.md) give back the modes in them;
// malformed ones are refused with the text beside them.
#include "document/response/universal_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stop_token>

#include "document/response/measured_file.hpp"
#include "responses.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document::universal_file_test {
namespace {

namespace fs = std::filesystem;
using namespace responses;

const std::vector<True> kTwo{{640, 0.03, 9000}, {880, 0.025, 16000}};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A file of tests/data/uff as a member of "frf".
json frf(const std::string& name) {
  return measured_file(bytes_of(source_path("tests/data/uff/" + name + ".uff")));
}

json with(json frf, const json& more) {
  frf["uff"].update(more);
  return frf;
}

TEST(UniversalFile, EveryFormOfValuesGivesTheModesBack) {
  struct File {
    const char *name, *quantity, *unit;
    double relative;  // of five or twelve digits
  };
  for (const File& f :
       {File{"accelerance-even-double", "accelerance", "m/s^2/N", 1e-9},
        {"accelerance-even-single", "accelerance", "m/s^2/N", 1e-4},
        {"accelerance-uneven-double", "accelerance", "m/s^2/N", 1e-9},
        {"receptance-uneven-single", "receptance", "um/N", 1e-4},
        {"mobility-dataset-164", "mobility", "length/s/force of dataset 164", 1e-9}}) {
    SCOPED_TRACE(f.name);
    const json r = told(frf(f.name));
    expect_modes(r, kTwo, f.relative);
    EXPECT_EQ(r["lines"], 51);
    EXPECT_EQ(r["from_Hz"], 500);
    EXPECT_EQ(r["quantity"], f.quantity);
    EXPECT_EQ(r["unit"], f.unit);
    EXPECT_EQ(r["record"]["response"], "7+X");
    EXPECT_EQ(r["record"]["name"], "H1 drive point");
  }
}

TEST(UniversalFile, TheListOfItsLinesIsTheSame) {
  json asked = frf("accelerance-even-double");
  const json as_text = told(asked);
  std::istringstream text(asked["uff"]["text"].get<std::string>());
  json lines = json::array();
  for (std::string line; std::getline(text, line);) lines.push_back(line + "\r");
  asked["uff"]["text"] = lines;
  EXPECT_EQ(told(asked), as_text);
}

// Records 3 and 5 are at drive points, 2 is across nodes, 4 is the coherence of 3, 1 a time
// series.  Record 5 was counted against the force: -Y by +Y, and is half as compliant.
TEST(UniversalFile, RecordsAreChosenByNumberNodeAndDirection) {
  const json all = frf("several-records");
  EXPECT_EQ(refused(all),
            "stability: /frf/0/uff: got the records 3 (7+X by 7+X), 5 (7-Y by 7+Y), "
            "expected one of them, chosen by record, response and reference");
  const json third = told(with(all, {{"record", 3}}));
  expect_modes(third, kTwo, 1e-9);
  EXPECT_EQ(third["record"]["number"], 3);
  EXPECT_DOUBLE_EQ(third["coherence"]["least"], 0.3);
  EXPECT_DOUBLE_EQ(third["coherence"]["at_Hz"], 500);
  EXPECT_EQ(told(with(all, {{"response", {{"node", 7}, {"direction", "+X"}}}})), third);
  const std::vector<True> half{{640, 0.03, 18000}, {880, 0.025, 32000}};
  const json fifth = told(with(all, {{"reference", {{"direction", "+Y"}}}}));
  expect_modes(fifth, half, 1e-9);
  EXPECT_FALSE(fifth.contains("coherence"));
  expect_modes(told(with(all, {{"response", {{"node", 9}}}})),
               {{640, 0.03, 30000}, {880, 0.025, 16000 / 0.3}}, 1e-9);
  EXPECT_EQ(refused(with(all, {{"record", 4}})),
            "stability: /frf/0/uff: got none of the records asked for, expected of the "
            "records 2 (9+X by 7+X), 3 (7+X by 7+X), 5 (7-Y by 7+Y)");
}

/// The file with mobilities, one text in it replaced.
json edited(const std::string& text, const std::string& with) {
  auto bytes = bytes_of(source_path("tests/data/uff/mobility-dataset-164.uff"));
  const auto at = bytes.find(text);
  EXPECT_NE(at, bytes.npos) << text;
  return measured_file(bytes.replace(at, text.size(), with));
}

// The file's units are mm and N.
TEST(UniversalFile, LabelsDoNotContradictDataset164) {
  const std::string ordinate = "        11    0    0    0 NONE                 ";
  const std::string force = "        13    0    0    0 NONE                 ";
  expect_modes(told(edited(ordinate + "NONE", ordinate + "mm/s")), kTwo, 1e-9);
  expect_modes(told(edited(force + "NONE", force + "N")), kTwo, 1e-9);
  for (const char* unit : {"g", "m/s", "mm/s2", "ips's"}) {
    const auto asked = edited(ordinate + "NONE", ordinate + unit);
    EXPECT_NE(refused(asked).find("line 27"), std::string::npos)
        << unit << ": " << refused(asked);
  }
  EXPECT_NE(refused(edited(force + "NONE", force + "lbf")).find("dataset 164"),
            std::string::npos);
}

// Fortran reads blanks of a number's columns as 0.
TEST(UniversalFile, BlankColumnsAreZero) {
  const json r = told(edited("  5.00000e+02  1.20000e+01", "               1.20000e+01"));
  EXPECT_EQ(r["from_Hz"], 12) << "a mobility says nothing at 0 Hz";
  EXPECT_EQ(r["to_Hz"], 600);
}

TEST(UniversalFile, ARecordThatIsNoDrivePointIsTold) {
  const auto warned = [](const json& frf) {
    const json told = answer(request(frf));
    return told.value("warnings", json::array()).dump().find("is no drive point") !=
           std::string::npos;
  };
  const json all = frf("several-records");
  EXPECT_TRUE(warned(with(all, {{"response", {{"node", 9}}}})));
  EXPECT_FALSE(warned(with(all, {{"record", 3}})));
}

TEST(UniversalFile, TheUnitOfTheRequestCounts) {
  json asked = frf("accelerance-even-double");
  asked["unit"] = "g/N";
  expect_modes(told(asked), {{640, 0.03, 9000 / 9.80665}, {880, 0.025, 16000 / 9.80665}},
               1e-9);
  asked["unit"] = "m/N";
  EXPECT_EQ(
      refused(asked),
      R"(stability: /frf/0/unit: got "m/N", expected that of accelerance, as data type 12 of the file says)");
}

TEST(UniversalFile, OneFormIsGiven) {
  json asked = frf("accelerance-even-double");
  asked["csv"] = "f,re [m/N],im\n1,2,3";
  EXPECT_EQ(refused(asked).substr(0, 73),
            "stability: /frf/0: got several of them, expected one of csv, uff and taps");
}

std::vector<UniversalFunction> functions(const json& text) {
  Problems problems{.document = "file"};
  auto out = read_universal_file(Reader(text, problems));
  problems.throw_if_any();
  return out;
}

// Its line states 408 bytes, half of what there are.
TEST(UniversalFile, BinaryValuesAreThoseOfTheText) {
  json binary = told(frf("binary-58b")), text = told(frf("accelerance-even-double"));
  expect_modes(binary, kTwo, 1e-9);
  for (const char* key : {"lines", "unit", "record", "from_Hz", "to_Hz"})
    EXPECT_EQ(binary[key], text[key]) << key;
}

/// A number of `size` bytes, the highest first or last.
std::string bytes_of(double x, std::size_t size, bool big_endian) {
  std::string out(size, '\0');
  const auto single = static_cast<float>(x);
  std::memcpy(out.data(), size == 8 ? static_cast<const void*>(&x) : &single, size);
  if ((std::endian::native == std::endian::big) != big_endian) std::ranges::reverse(out);
  return out;
}

// By hand from the layout of [SDRC 58]: single and double, even and uneven, both orders of
// bytes, a single abscissa before doubles, a line end behind the bytes.
TEST(UniversalFile, EveryFormOfBytesGivesTheModesBack) {
  const auto head = bytes_of(source_path("tests/data/uff/binary-58b.uff"));
  const auto line = [&](std::size_t n) {
    std::size_t at = 0;
    while (n-- > 0) at = head.find('\n', at) + 1;
    return head.substr(at, head.find('\n', at) - at);
  };
  const auto padded = [](std::size_t x, std::size_t width) {
    const auto digits = std::to_string(x);
    return std::string(width - digits.size(), ' ') + digits;
  };
  for (const bool big : {false, true})
    for (const bool even : {false, true})
      for (const auto& [y_bytes, x_bytes] :
           {std::pair<std::size_t, std::size_t>{4, 4}, {8, 4}, {8, 8}}) {
        SCOPED_TRACE(testing::Message() << big << even << y_bytes << x_bytes);
        std::string block;
        for (int i = 0; i <= 50; ++i) {
          const double f = 500 + 12 * i;
          const Complex y = response_of(kTwo, f, 2) / 1e3;
          if (!even) block += bytes_of(f, x_bytes, big);
          block += bytes_of(y.real(), y_bytes, big) + bytes_of(y.imag(), y_bytes, big);
        }
        std::string file = "    -1\n    58b" + padded(big ? 2 : 1, 6) + padded(2, 6) +
                           padded(11, 12) + padded(block.size(), 12) + "\n";
        for (std::size_t n = 2; n < 13; ++n)
          file += (n == 8 ? padded(y_bytes == 4 ? 5 : 6, 10) + padded(51, 10) +
                                padded(even ? 1 : 0, 10) + "  5.00000e+02  1.20000e+01"
                          : line(n)) +
                  "\r\n";
        file += block + (big ? "\r\n" : "") + "    -1\n";
        expect_modes(told(measured_file(file)), kTwo, y_bytes == 4 ? 1e-4 : 1e-9);
      }
}

TEST(UniversalFile, BytesThatDoNotFitTheirHeaderAreRefused) {
  const std::string file = bytes_of(source_path("tests/data/uff/binary-58b.uff"));
  const auto refusal = [&](const std::string& old, const std::string& now) {
    std::string text = file;
    const auto at = text.find(old);
    EXPECT_NE(at, text.npos);
    return refused(measured_file(text.replace(at, old.size(), now)));
  };
  const auto other_format = refusal("58b     1     2", "58b     1     1");
  EXPECT_NE(other_format.find("/uff/text#line 2: got \"58b     1     1 "),
            std::string::npos);
  EXPECT_NE(other_format.find("expected 58b, 1 or 2 (the order of bytes), 2 (IEEE 754)"),
            std::string::npos);
  EXPECT_EQ(other_format.find('\n'), std::string::npos);
  EXPECT_NE(refusal("         6        51  ", "         6        52  ").find("numbers"),
            std::string::npos);
  const std::string one(8, '\xFF');                           // not a number
  const std::string last = file.substr(file.size() - 15, 8);  // before "    -1\n"
  EXPECT_NE(refusal(last, one).find("no finite number in place 102 of"),
            std::string::npos);
  json lines = json::array();
  std::istringstream text(frf("binary-58b")["uff"]["text"].get<std::string>());
  for (std::string l; std::getline(text, l);) lines.push_back(l);
  EXPECT_NE(refused({{"uff", {{"text", lines}}}}), "");
}

TEST(UniversalFile, MoreBytesThanAreThereAreThoseOfTheValues) {
  std::string text = frf("binary-58b")["uff"]["text"];
  const std::string stated = "11         408";
  text.replace(text.find(stated), stated.size(), "11    99999999");
  expect_modes(told({{"uff", {{"text", text}}}}), kTwo, 1e-9);
}

TEST(UniversalFile, BytesCanBeLeft) {
  std::stop_source work;
  const auto stop = work.get_token();
  const Listening listening(stop);
  const json text = frf("binary-58b")["uff"]["text"];
  EXPECT_EQ(functions(text).size(), 1U);
  work.request_stop();
  EXPECT_THROW(functions(text), Cancelled);
}

TEST(UniversalFile, ADatasetAnnouncedWithinAHeaderOfBytesIsRefused) {
  std::string text = bytes_of(source_path("tests/data/uff/binary-58b.uff"));
  text.insert(text.find('\n', text.find("58b")) + 1, "    -1\n    58b\n");
  EXPECT_NE(refused(measured_file(text))
                .find("got a dataset 58 of 0 records, expected 11 and its values"),
            std::string::npos);
}

TEST(UniversalFile, BytesOfOtherFunctionsAreSkipped) {
  const auto all = functions(frf("pyuff-binary-time-history")["uff"]["text"]);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].type, 1);
  EXPECT_EQ(all[0].ordinate.units, "g");
}

// Values as its text has them; the label's second power is one byte of ISO 8859-1.
TEST(UniversalFile, AHeaderThatIsNotAscii) {
  const auto all = functions(frf("pyuff-non-ascii-header")["uff"]["text"]);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].type, UniversalFunction::kResponse);
  EXPECT_EQ(all[0].ordinate.units, "(1/N)*(m/s\u00b2)");
  ASSERT_EQ(all[0].y.size(), 6U);
  EXPECT_DOUBLE_EQ(all[0].x[1], 0.195313);
  EXPECT_EQ(all[0].y[5], std::complex(3.75037, 2.93363));
  EXPECT_EQ(all[0].lines[5], 15U);
}

TEST(UniversalFile, OtherFunctionsAreNamedWithoutTheirValues) {
  const auto all = functions(frf("pyuff-time-history")["uff"]["text"]);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].type, 1);
  EXPECT_TRUE(all[0].y.empty());
  EXPECT_EQ(
      refused(frf("pyuff-time-history")),
      "stability: /frf/0/uff/text: got no frequency response, expected a dataset 58 of "
      "function type 4");
}

// Fields that touch each other stand in the columns of the format.
TEST(UniversalFile, FieldsWithoutBlanksBetweenThem) {
  std::string text = frf("accelerance-even-single")["uff"]["text"];
  const auto change = [&](const std::string& old, const std::string& now) {
    const auto at = text.find(old);
    ASSERT_NE(at, text.npos);
    text.replace(at, old.size(), now);
  };
  change(" -4.11428e+00  4.61366e-01", "-4.114280e+00-4.613660e-01");
  change("  9.77899e-01", "  9.77899D-01");
  const auto f = functions(text);
  EXPECT_EQ(f[0].y[1], std::complex(-4.11428, -0.461366));
  EXPECT_EQ(f[0].y[4], std::complex(-5.96741, 0.977899));
}

TEST(UniversalFile, MalformedFilesAreRefusedWithTheirText) {
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(source_path("tests/data/uff/malformed"))) {
    if (entry.path().extension() != ".uff") continue;
    ++files;
    auto expected = entry.path();
    expected.replace_extension(".expected");
    json asked = {{"uff", {{"text", bytes_of(entry.path())}}}};
    EXPECT_EQ(refused(asked) + "\n", bytes_of(expected)) << entry.path();
  }
  EXPECT_EQ(files, 20);
}

TEST(UniversalFile, DamagedFilesAreTakenOrRefusedAndNothingElse) {
  const std::string good = bytes_of(source_path("tests/data/uff/several-records.uff"));
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) { return random() % n; };
  int refusals = 0;
  for (int i = 0; i < 400; ++i) {
    std::string text = good;
    for (std::size_t slips = 1 + below(3); slips > 0; --slips) {
      const auto at = below(text.size());
      if (below(3) == 0)
        text.erase(at, 1 + below(200));
      else if (below(2) == 0)
        text.insert(at, text.substr(below(text.size()), below(200)));
      else
        text[at] = "-+ 0158EeD\n.x"[below(13)];
    }
    if (refused({{"uff", {{"text", text}, {"record", 3}}}}) != "") ++refusals;
  }
  EXPECT_GT(refusals, 200);
  EXPECT_LT(refusals, 400);
}

TEST(UniversalFile, DamagedBytesAreTakenOrRefusedAndNothingElse) {
  const std::string good = bytes_of(source_path("tests/data/uff/binary-58b.uff"));
  std::mt19937 random(4);
  const auto below = [&](std::size_t n) { return random() % n; };
  int refusals = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = good;
    const auto at = below(bytes.size());
    if (below(3) == 0)
      bytes.erase(at, 1 + below(30));
    else if (below(2) == 0)
      bytes.insert(at, bytes.substr(below(bytes.size()), below(30)));
    else
      bytes[at] = static_cast<char>(below(256));
    try {
      if (refused(measured_file(bytes)) != "") ++refusals;
    } catch (const ModelRangeError&) {  // modes of damaged values
      ++refusals;
    }
  }
  EXPECT_GT(refusals, 50);
  EXPECT_LT(refusals, 300);
}

TEST(MeasuredFile, IsRecognisedByItsFirstLine) {
  EXPECT_TRUE(measured_file("    -1\r\n    58\r\n").contains("uff"));
  EXPECT_TRUE(measured_file("-1,2\n").contains("csv"));
  EXPECT_TRUE(measured_file("-1").contains("csv"));
  EXPECT_EQ(measured_file("f,\xB5m/N\n")["csv"], "f,\u00b5m/N\n");
  EXPECT_EQ(measured_file("f,\u00b5m/N\n")["csv"], "f,\u00b5m/N\n");
}

// As a public script, Matlab2CutPro.m, writes them for CutPro: values with tabs behind them,
// labels behind the first.
TEST(MeasuredFile, AFrfOfCutProGivesTheModesBack) {
  std::string file;
  for (int i = 0; i <= 200; ++i) {
    const double f = 400 + 4 * i;
    const Complex y = response_of(kTwo, f) / 1e3;  // m/N
    char line[100];
    std::snprintf(line, sizeof line, "%14.6e\t%14.12e\t%14.12e\t", f, y.real(), y.imag());
    file +=
        std::string(line) + (i == 0 ? "Freq\tHz\tReal\tm/N\tImag\tReal\t\r\n" : "\r\n");
  }
  const json r = told(measured_file(file));
  expect_modes(r, kTwo, 1e-6);
  EXPECT_EQ(r["lines"], 201);
  EXPECT_EQ(r["unit"], "m/N");
  EXPECT_EQ(measured_file("1\t2\t3\tno labels\n")["csv"], "1\t2\t3\tno labels\n");
}

}  // namespace
}  // namespace turnwright::document::universal_file_test
