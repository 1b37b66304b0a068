#include "planning/values/readable.hpp"

#include <gtest/gtest.h>

#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

using Two = std::pair<std::string, std::string>;

TEST(Readable, NumbersHaveFourDigits) {
  EXPECT_EQ(readable(0.0123456), "0.01235");
  EXPECT_EQ(readable(123456.7), "123457");
}

TEST(Readable, TwoNumbersHaveAsManyDigitsAsTellThemApart) {
  EXPECT_EQ(readable_apart(6.2, 5.5), (Two{"6.2", "5.5"}));
  EXPECT_EQ(readable_apart(1.500012, 1.5), (Two{"1.50001", "1.5"}));
  EXPECT_EQ(readable_apart(0.0160003, 0.016), (Two{"0.0160003", "0.016"}));
  EXPECT_EQ(readable_apart(0, 0), (Two{"0", "0"}));
}

TEST(Readable, WhatLeavesNothingIsNotComparedWithItself) {
  ConstraintValue c;
  c.name = "flatness";
  c.unit = "mm";
  c.value = 0.0300001;
  c.limit = 0.03;
  EXPECT_EQ(exceeded("right", c),
            "right: flatness is 0.0300001 mm where 0.03 mm is allowed");
  c.value = c.limit = 0;
  EXPECT_EQ(exceeded("right", c), "right: nothing is left for flatness");
}

}  // namespace
}  // namespace turnwright::planning
