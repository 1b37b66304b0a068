#include "report/text/terminal.hpp"

#include <gtest/gtest.h>

namespace turnwright::report {
namespace {

TEST(Terminal, HeadingsAreBoldAndTheStatusTellsByItsColour) {
  EXPECT_EQ(styled("PROCESS PLAN  Pin"), "\x1b[1mPROCESS PLAN\x1b[0m  Pin");
  EXPECT_EQ(styled("SETUP 1  hold left end"), "\x1b[1mSETUP 1\x1b[0m  hold left end");
  EXPECT_EQ(styled("CONFLICTS"), "\x1b[1mCONFLICTS\x1b[0m");
  EXPECT_EQ(styled("status  every limit is kept"),
            "status  \x1b[32mevery limit is kept\x1b[0m");
  EXPECT_EQ(styled("status  kept nominally only: 90 %"),
            "status  \x1b[33mkept nominally only: 90 %\x1b[0m");
  EXPECT_EQ(styled("status  infeasible"), "status  \x1b[31minfeasible\x1b[0m");
}

TEST(Terminal, OtherLinesStayAsTheyAre) {
  for (const char* line : {"", "cost    4.39 EUR per part", "  PCLNL-CNMG120408-PM  1",
                           "M24x2  10.6", "NC of setup 1", "45  P", "Ra  P"})
    EXPECT_EQ(styled(line), line);
}

}  // namespace
}  // namespace turnwright::report
