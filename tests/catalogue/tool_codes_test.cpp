#include "turnwright/catalogue/tool_codes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace turnwright::catalogue {
namespace {

template <class Call>
std::string refusal_of(Call call) {
  try {
    call();
  } catch (const std::domain_error& e) {
    return e.what();
  }
  return "";
}

// Sizes as makers print them, to 0.1 mm, and as inch inserts are: 1/2 in, 3/16 in, 1/32 in.
TEST(ToolCodes, AnInsertIsNamedByItsSizes) {
  EXPECT_EQ(encode_iso1832({'C', 80, 0, 'M', 'G', 12.9, 4.8, 0.8}), "CNMG 120408");
  EXPECT_EQ(encode_iso1832({'C', 80, 7, 'M', 'T', 9.7, 4.0, 0.4}), "CCMT 09T304");
  EXPECT_EQ(encode_iso1832({'V', 35, 5, 'M', 'T', 16.6, 4.76, 0.4}), "VBMT 160404");
  const double inch = 25.4;
  EXPECT_EQ(encode_iso1832({'W', 80, 0, 'M', 'G', edge_length_mm('W', inch / 2),
                            inch * 3 / 16, inch / 32}),
            "WNMG 080408");
  EXPECT_EQ(encode_iso1832({'T', 60, 11, 'M', 'R', 11.0, 3.18, inch / 8}), "TPMR 110332");
}

TEST(ToolCodes, ADesignationReadAndWrittenIsItself) {
  for (const std::string d :
       {"CNMG 120408", "DNMG 150604", "VCGT 160402", "SNMG 120408", "TNMG 160408",
        "WNMG 060404", "DCMT 070204", "EPMW 130404", "MNMG 120408"})
    EXPECT_EQ(encode_iso1832(decode_iso1832(d)), d);
}

TEST(ToolCodes, SizesWithoutACodeAreNamed) {
  const Insert1832 good = decode_iso1832("CNMG 120408");
  const auto refused = [&](auto change) {
    Insert1832 insert = good;
    change(insert);
    return refusal_of([&] { encode_iso1832(insert); });
  };
  EXPECT_EQ(refused([](auto& i) { i.edge_length_mm = 12.7; }),
            "encode_iso1832: an edge of 12.7 mm is none of the standard");
  EXPECT_EQ(refused([](auto& i) { i.thickness_mm = 4.5; }),
            "encode_iso1832: a thickness of 4.5 mm is none of the standard");
  EXPECT_EQ(refused([](auto& i) { i.re_mm = 0.75; }),
            "encode_iso1832: a corner of 0.75 mm is none of the standard");
  EXPECT_NE(refused([](auto& i) { i.re_mm = std::nan(""); }), "");
  EXPECT_NE(refused([](auto& i) { i.edge_length_mm = std::nan(""); }), "");
  EXPECT_NE(refused([](auto& i) { i.clearance_deg = 6; }), "");
  EXPECT_NE(refused([](auto& i) { i.shape = 'R'; }), "");
}

// Both designations of one insert, as makers print them side by side.
TEST(ToolCodes, InchDesignationsAreThoseOfTheMetricInserts) {
  const std::pair<const char*, const char*> kSame[] = {
      {"CNMG 432", "CNMG 120408"},    {"CNMG 431", "CNMG 120404"},
      {"CNMG 433-MP", "CNMG 120412"}, {"CCMT 32.51", "CCMT 09T304"},
      {"CCMT21.51", "CCMT 060204"},   {"DCMT 32.52", "DCMT 11T308"},
      {"DNMG 442", "DNMG 150608"},    {"TNMG332", "TNMG 160408"},
      {"VBMT 331", "VBMT 160404"},    {"WNMG 432", "WNMG 080408"},
      {"SNMG 643", "SNMG 190612"},    {"TPGH 1.81.51", "TPGH 090204"}};
  for (const auto& [inch, metric] : kSame) {
    const auto insert = decode_inch_insert(inch);
    EXPECT_EQ(encode_iso1832(insert), metric) << inch;
    EXPECT_EQ(insert.edge_length_mm, decode_iso1832(metric).edge_length_mm) << inch;
    EXPECT_TRUE(is_corner_of(decode_iso1832(metric), insert.re_mm)) << inch;
  }
  EXPECT_EQ(decode_inch_insert("CNMG 432").re_mm, 25.4 / 32);
  for (const char* wrong :
       {"", "CNMG", "CNMG 43", "CNMG 4321", "CNMG 432.5", "CNMG 732", "CNMG 435",
        "CNMG 4.332", "RNMG 43", "CNMG 120408", "SEAT 101"})
    EXPECT_NE(refusal_of([&] { decode_inch_insert(wrong); }), "") << wrong;
}

// [sumitomo]: 04 is 1/64 in = 0.397 mm, 08 0.794 mm, 12 1.191 mm, 16 1.588 mm.
TEST(ToolCodes, ACornerIsThatOfItsCodeInMillimetresOrInches) {
  const auto corner = [](const char* designation, double re_mm) {
    return is_corner_of(decode_iso1832(designation), re_mm);
  };
  EXPECT_TRUE(corner("CNMG 120408", 0.8));
  EXPECT_TRUE(corner("CNMG 120408", 0.03125 * 25.4));
  EXPECT_TRUE(corner("CNMG 120404", 0.397));
  EXPECT_TRUE(corner("CNMG 120412", 1.191));
  EXPECT_TRUE(corner("CNMG 120416", 1.588));
  EXPECT_FALSE(corner("CNMG 120408", 0.79));
  EXPECT_FALSE(corner("CNMG 120408", 0.4));
  EXPECT_FALSE(corner("CNMG 120408", std::nan("")));
}

TEST(ToolCodes, LettersOfClearanceGoBothWays) {
  for (const char letter : std::string("ABCDEFGNP"))
    EXPECT_EQ(clearance_letter(*clearance_of_letter_deg(letter)), letter);
  EXPECT_EQ(clearance_of_letter_deg('C'), 7);
  EXPECT_FALSE(clearance_of_letter_deg('X'));
  EXPECT_FALSE(clearance_letter(8));
  EXPECT_EQ(style_kapr_deg('L'), 95);
  EXPECT_EQ(style_kapr_deg('J'), 93);
  EXPECT_FALSE(style_kapr_deg('I'));
}

// The circle touches the sides: of a rhombus of angle e the side is d/sin e.
TEST(ToolCodes, EdgesFollowFromTheInscribedCircle) {
  EXPECT_NEAR(edge_length_mm('C', 9.525), 9.525 / std::sin(80 * std::acos(-1) / 180),
              1e-12);
  EXPECT_NEAR(edge_length_mm('S', 12.7), 12.7, 1e-12);
  EXPECT_NEAR(edge_length_mm('T', 12.7), 12.7 * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(edge_length_mm('?', 12.7), 0);
  EXPECT_EQ(included_angle_deg('D'), 55);
  EXPECT_FALSE(included_angle_deg('R'));
}

TEST(ToolCodes, AHolderIsNamedByItsSizes) {
  const auto holder = decode_iso5608("DDJNL 2525M 15");
  EXPECT_EQ(encode_iso5608('D', 'J', holder), "DDJNL 2525M 15");
  auto odd = holder;
  odd.lf_mm = 137;
  EXPECT_EQ(encode_iso5608('D', 'J', odd), "DDJNL 2525X 15");
  odd.h_mm = 25.4;
  EXPECT_NE(refusal_of([&] { encode_iso5608('D', 'J', odd); }), "");
  odd.h_mm = 125;
  EXPECT_NE(refusal_of([&] { encode_iso5608('D', 'J', odd); }), "");
  EXPECT_NE(refusal_of([&] { encode_iso5608('Z', 'J', holder); }), "");
}

// [makers-bars]: A, S steel, E carbide; M 150 mm, T 300 mm.
TEST(ToolCodes, BarsAreReadAsMakersPrintThem) {
  const auto bar = decode_iso5609("A16M SCLCR 09");
  EXPECT_EQ(bar.shank, 'A');
  EXPECT_EQ(bar.diameter_mm, 16);
  EXPECT_EQ(bar.length_mm, 150);
  EXPECT_EQ(bar.insert_shape, 'C');
  EXPECT_EQ(bar.kapr_deg, 95);
  EXPECT_EQ(bar.clearance_deg, 7);
  EXPECT_EQ(bar.hand, 'R');
  EXPECT_EQ(bar.edge_code, 9);
  EXPECT_EQ(decode_iso5609("S25TSCLCR09").length_mm, 300);
  EXPECT_FALSE(decode_iso5609("E08XSTUPR11").length_mm);
  for (const char* wrong : {"", "Q16M SCLCR 09", "A00M SCLCR 09", "A16M SCLC",
                            "A16M SILCR 09", "A1", "A16M XCLCR 09"})
    EXPECT_NE(refusal_of([&] { decode_iso5609(wrong); }), "") << wrong;
}

}  // namespace
}  // namespace turnwright::catalogue
