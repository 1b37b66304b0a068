#include "document/tool_library/printed_designations.hpp"

#include <gtest/gtest.h>

namespace turnwright::document::printed_designations_test {
namespace {

PrintedDesignations found(const std::string& text) {
  return printed_designations({text});
}

TEST(PrintedDesignations, StandAnywhereInAText) {
  EXPECT_EQ(found("3602069-DCLNR 2020K-12 - Basic-mm.stp").holder->kapr_deg, 95);
  EXPECT_EQ(found("my dclnr2020k12").holder->h_mm, 20);
  EXPECT_EQ(found("A16M SCLCR-09 - Basic").bar->diameter_mm, 16);
  EXPECT_EQ(found("OD CNMG_120408-PM").insert->re_mm, 0.8);
  EXPECT_EQ(found("OD CNMG-432 MP").insert->re_mm, 25.4 / 32);
  EXPECT_EQ(found("ccmt 32.51.stp").insert->thickness_mm, 3.97);
  EXPECT_EQ(found("CCMT09T304").insert->thickness_mm, 3.97);
  EXPECT_EQ(found("CNMG 120408 in PCLNL 2525M 12").insert->shape, 'C');
}

TEST(PrintedDesignations, ProseIsNone) {
  for (const char* text : {"", "-", "OD rougher 80 deg", "TURNING GENERAL", "XCNMG120408",
                           "CNMGX 120408", "25252525", "DCLNR", "P20", "CNMG 43",
                           "CNMG 4325", "roughing tool with 12 04 08"}) {
    const auto p = found(text);
    EXPECT_FALSE(p.insert || p.holder || p.bar) << text;
    EXPECT_EQ(p.holder_text, "") << text;
  }
}

TEST(PrintedDesignations, LettersOfAnInsertStandAlone) {
  EXPECT_EQ(found("CNMG 16mm ID").insert_letters, "CNMG");
  EXPECT_EQ(found("DEEP CUTS").insert_letters, "");  // type P
  EXPECT_EQ(found("CCMT070204R").unreadable, "CCMT070204");
  EXPECT_EQ(found("CCMT070204R").insert_letters, "CCMT");
}

TEST(PrintedDesignations, TheFirstOfAKindCounts) {
  const auto p = printed_designations({"CNMG 120408", "DNMG 150604 DDJNL 2525M 15"});
  EXPECT_EQ(p.insert->shape, 'C');
  EXPECT_EQ(p.holder_text, "DDJNL 2525M 15");
}

}  // namespace
}  // namespace turnwright::document::printed_designations_test
