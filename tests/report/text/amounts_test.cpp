#include "report/text/amounts.hpp"

#include <gtest/gtest.h>

namespace turnwright::report::amounts_test {
namespace {

TEST(Amounts, TimesAreToldAsPeopleSayThem) {
  EXPECT_EQ(duration(0.0), "0.0 s");
  EXPECT_EQ(duration(0.043), "2.6 s");  // 2.58 s
  EXPECT_EQ(duration(0.683), "41 s");   // 40.98 s
  EXPECT_EQ(duration(0.9999), "1 min 0 s");
  EXPECT_EQ(duration(3.4), "3 min 24 s");
  EXPECT_EQ(duration(31.121), "31 min");
  EXPECT_EQ(duration({}), "-");
}

// A duration below ten minutes and its number of seconds say the same.
TEST(Amounts, NoRoundingMakesSixtySeconds) {
  for (int s = 0; s < 6000; ++s) {
    const auto text = duration(s / 600.0);
    EXPECT_EQ(text.find(" 60 s"), std::string::npos) << text;
    EXPECT_NE(text, "60 s");
    EXPECT_NE(text, "10.0 s");
  }
}

TEST(Amounts, SecondsOfAColumnHaveOneDecimal) {
  EXPECT_EQ(seconds(0.75), "45.0");
  EXPECT_EQ(seconds({}), "-");
}

TEST(Amounts, MoneyHasTwoDecimalsAndThreeDigits) {
  EXPECT_EQ(money(3.8103), "3.81");
  EXPECT_EQ(money(1234.5), "1234.50");
  EXPECT_EQ(money(0.5), "0.500");
  EXPECT_EQ(money(0.01315), "0.0132");
  EXPECT_EQ(money(-0.0001234), "-0.000123");
  EXPECT_EQ(money(0.0), "0.00");
  EXPECT_EQ(money({}), "-");
}

}  // namespace
}  // namespace turnwright::report::amounts_test
