#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {
namespace {

// As makers' catalogues print them.
struct KnownHolder {
  std::string designation;
  char shape;
  double kapr_deg, clearance_deg;
  char hand;
  double h_mm, b_mm, lf_mm;
  int edge;
};
const KnownHolder kHolders[] = {{"PCLNL 2525M 12", 'C', 95, 0, 'L', 25, 25, 150, 12},
                                {"PDJNL 2525M15", 'D', 93, 0, 'L', 25, 25, 150, 15},
                                {"SVJBR 2020K16", 'V', 93, 5, 'R', 20, 20, 125, 16},
                                {"SSDCN1616H09", 'S', 45, 7, 'N', 16, 16, 100, 9},
                                {"PRGNR3225P12", 'R', 90, 0, 'R', 32, 25, 170, 12}};

TEST(Iso5608, EqualsTheMakersDimensions) {
  for (const auto& k : kHolders) {
    SCOPED_TRACE(k.designation);
    const auto holder = decode_iso5608(k.designation);
    EXPECT_EQ(holder.insert_shape, k.shape);
    EXPECT_EQ(holder.kapr_deg, k.kapr_deg);
    EXPECT_EQ(holder.clearance_deg, k.clearance_deg);
    EXPECT_EQ(holder.hand, k.hand);
    EXPECT_EQ(holder.h_mm, k.h_mm);
    EXPECT_EQ(holder.b_mm, k.b_mm);
    EXPECT_EQ(holder.lf_mm, k.lf_mm);
    EXPECT_EQ(holder.edge_code, k.edge);
  }
}

TEST(Iso5608, ADashOrXCodesNoLength) {
  for (const char* text : {"PCLNL 2525-12", "PCLNL 2525X12"})
    EXPECT_FALSE(decode_iso5608(text).lf_mm.has_value()) << text;
}

std::string told(const std::string& designation) {
  try {
    decode_iso5608(designation);
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "";
}

TEST(Iso5608, TellsTheSymbolThatCannotBeRead) {
  EXPECT_EQ(told("PCZNL 2525M 12"),
            "decode_iso5608: \"PCZNL 2525M 12\": symbol 3 (\"Z\") must be one of "
            "ABCDEFGHJKLMNRSTUVWY");
  EXPECT_EQ(told("PCLNL 25"), "decode_iso5608: \"PCLNL 25\": symbol 7 (\"\") is missing");
  EXPECT_EQ(told("PCLNL 2525M"),
            "decode_iso5608: \"PCLNL 2525M\": symbol 9 (\"\") is missing");
}

}  // namespace
}  // namespace turnwright::catalogue
