#include "turnwright/part/inch_thread.hpp"

#include <gtest/gtest.h>

namespace turnwright::part {
namespace {

TEST(InchThread, IsReadAsDrawingsWriteIt) {
  struct Row {
    const char* text;
    double size_in, per_inch;
    const char* tolerance_class;
  };
  for (const auto& row :
       {Row{"1/2-13 UNC", 0.5, 13, ""}, Row{"1/2-13", 0.5, 13, ""},
        Row{"1/2-13UNC-2A", 0.5, 13, "2A"}, Row{"1/2-13-2B", 0.5, 13, "2B"},
        Row{"3/8-24 UNF 3A", 0.375, 24, "3A"}, Row{"1-1/4-7 UNC", 1.25, 7, ""},
        Row{"1 1/4-7 UNC", 1.25, 7, ""}, Row{"2-4.5 UNC", 2, 4.5, ""},
        Row{"1-8", 1, 8, ""}, Row{".500-20 UNF-2A", 0.5, 20, "2A"},
        Row{"0.3125-18", 0.3125, 18, ""}, Row{"#10-24 UNC", 0.19, 24, ""},
        Row{"#0-80 UNF", 0.06, 80, ""}, Row{"15/16-16 UN", 0.9375, 16, ""},
        Row{"1/4-32 UNEF", 0.25, 32, ""}}) {
    SCOPED_TRACE(row.text);
    const auto read = inch_thread(row.text);
    ASSERT_TRUE(read);
    EXPECT_NEAR(read->d_mm, 25.4 * row.size_in, 1e-12);
    EXPECT_NEAR(read->pitch_mm, 25.4 / row.per_inch, 1e-12);
    EXPECT_EQ(read->tolerance_class, row.tolerance_class);
  }
}

TEST(InchThread, IsNothingElse) {
  for (const char* text : {"",
                           "1x45",
                           "M24x1.5",
                           "1/2",
                           "1/2-",
                           "1/0-13",
                           "0-13",
                           "1/2-0",
                           "1/2-999",
                           "#13-24",
                           "#1/2-13",
                           "1/2-13 UNC 4A",
                           "1/2-13 UNC 2C",
                           "1/2-13 UNC2A",
                           "1/2-13 X",
                           "1/2-13 UNC 2A 2A",
                           "-13",
                           "99-8",
                           "1-5/4-7",
                           "+0.02/-0.01",
                           "50-40",
                           "1/2--13"})
    EXPECT_FALSE(inch_thread(text)) << text;
}

// Every size of a sixteenth up to four inches and every number, with every whole pitch.
TEST(InchThread, IsNamedSoThatItIsReadBack) {
  for (int n = 4; n <= 80; ++n) {
    const double P = 25.4 / n;
    for (int k = 1; k <= 64; ++k) {
      const double d = 25.4 * (k / 16.0);
      const auto text = inch_designation(d, P);
      ASSERT_TRUE(text);
      EXPECT_EQ(inch_thread(*text)->d_mm, d) << *text;
      EXPECT_EQ(inch_thread(*text)->pitch_mm, P) << *text;
    }
    for (int k = 0; k <= 12; ++k) {
      const auto small = inch_thread('#' + std::to_string(k) + '-' + std::to_string(n));
      ASSERT_TRUE(small);
      const auto text = inch_designation(small->d_mm, P);
      ASSERT_TRUE(text);
      EXPECT_EQ(inch_thread(*text)->d_mm, small->d_mm) << *text;
    }
  }
  EXPECT_EQ(inch_designation(12.7, 25.4 / 13), "1/2-13 UN");
  EXPECT_EQ(inch_designation(31.75, 25.4 / 7), "1-1/4-7 UN");
  EXPECT_EQ(inch_designation(25.4, 25.4 / 8), "1-8 UN");
}

TEST(InchThread, MetricOnesHaveNoNameInInches) {
  for (const double P :
       {0.5, 0.7, 0.8, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 0.0})
    for (int d = 1; d <= 100; ++d) EXPECT_FALSE(inch_designation(d, P)) << d << 'x' << P;
}

}  // namespace
}  // namespace turnwright::part
