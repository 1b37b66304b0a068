#include "turnwright/chatter/lobes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace turnwright::chatter {
namespace {

System cutter(double immersion, double Kt, double Kn) {
  const double wn = 2 * std::numbers::pi * 922;
  System s;
  for (const auto axis : {Axis::x, Axis::y}) s.modes.push_back({axis, wn, 0.011, 1340});
  s.modes[1].wn_rad_s *= 1.1;
  s.teeth = 2;
  const auto arc = down_milling(immersion);
  s.entry_rad = arc.entry_rad;
  s.exit_rad = arc.exit_rad;
  s.force = LinearForce{Kt, Kn};
  return s;
}

// Depth times force is what decides: unit force tells N/mm.
TEST(Lobes, AreFirstLossesTimesTheForce) {
  const Lobes lobes({cutter(0.1, 1, 0.3)});
  const auto real = cutter(0.1, 700, 210);
  for (const double n : {4000.0, 9876.5, 15000.0, 18000.0}) {
    const auto loss = speed_limits(real, n, 20).limit_mm();
    ASSERT_TRUE(loss) << n;
    EXPECT_NEAR(lobes.stable_to_N_mm(n, 1e5), 700 * *loss, 1e-8 * 700 * *loss) << n;
  }
}

TEST(Lobes, TellNoMoreThanIsAskedFor) {
  const Lobes lobes({cutter(0.1, 1, 0.3)});
  const double loss = lobes.stable_to_N_mm(9000, 1e6);
  EXPECT_EQ(lobes.stable_to_N_mm(9000, 0.3 * loss), 0.3 * loss);
  EXPECT_EQ(lobes.stable_to_N_mm(9000, 1e6), loss);
}

TEST(Lobes, AnswerTheSameInAnyOrder) {
  const Lobes at_once({cutter(0.05, 1, 0.3)}), slowly({cutter(0.05, 1, 0.3)});
  for (const double n : {5000.0, 12000.0, 20000.0}) {
    const double loss = at_once.stable_to_N_mm(n, 1e6);
    for (double enough = 1; enough < 4 * loss; enough *= 1.7)
      slowly.stable_to_N_mm(n, enough);
    EXPECT_EQ(slowly.stable_to_N_mm(n, 1e6), loss);
  }
}

TEST(Lobes, TheLeastOfSeveralCutsCounts) {
  const auto narrow = cutter(0.1, 1, 0.3), slot = cutter(1, 1, 0.3);
  const Lobes both({narrow, slot}), first({narrow}), second({slot});
  for (const double n : {5000.0, 9000.0, 16000.0})
    EXPECT_EQ(both.stable_to_N_mm(n, 1e6),
              std::min(first.stable_to_N_mm(n, 1e6), second.stable_to_N_mm(n, 1e6)));
}

// A tooth period of hundreds of thousands of vibrations: no depth is called stable.
TEST(Lobes, WhatCannotBeToldIsNotStable) {
  const Lobes lobes({cutter(0.5, 1, 0.3)});
  EXPECT_LT(lobes.stable_to_N_mm(0.05, 1e6), 1e6);
  EXPECT_EQ(lobes.stable_to_N_mm(0.05, 1e6), lobes.stable_to_N_mm(0.05, 2e6));
}

}  // namespace
}  // namespace turnwright::chatter
