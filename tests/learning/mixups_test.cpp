#include "turnwright/learning/mixups.hpp"

#include <gtest/gtest.h>

namespace turnwright::learning {
namespace {

const std::vector<Expected> kExpected{{25, 25.004, 0.003},
                                      {40, 39.99, 0.003},
                                      {0, 0.012, 0.002},
                                      {0.5, 0.5, 0.02},
                                      {25, 25.1, 0.3}};

MixUp kind(std::size_t characteristic, double y) {
  const std::vector<Suspect> one{{characteristic, 7, y}};
  return mix_ups(one, kExpected)[0].kind;
}

TEST(MixUps, UnitsRadiiAndSignsAreNamed) {
  EXPECT_EQ(kind(0, 25.004 / 25.4), MixUp::inch);
  EXPECT_EQ(kind(0, 25.004 * 25.4), MixUp::inch_twice);
  EXPECT_EQ(kind(0, 25004), MixUp::micrometre);
  EXPECT_EQ(kind(0, 0.025004), MixUp::metre);
  EXPECT_EQ(kind(0, 12.502), MixUp::radius);
  EXPECT_EQ(kind(0, 50.008), MixUp::diameter);
  EXPECT_EQ(kind(0, -25.004), MixUp::sign);
  EXPECT_EQ(kind(1, -0.0105), MixUp::deviation);
  EXPECT_EQ(kind(1, 0.0105), MixUp::deviation_sign);
  EXPECT_EQ(kind(0, 25.05), MixUp::outlier);
}

TEST(MixUps, OfFormOnlyUnitsAreTold) {
  EXPECT_EQ(kind(2, 12.0), MixUp::micrometre);
  EXPECT_EQ(kind(2, 0.024), MixUp::outlier) << "twice a run-out is a run-out";
}

TEST(MixUps, WhereScatterIsWideNothingIsToldApart) {
  EXPECT_EQ(kind(3, 1.0), MixUp::outlier);
}

TEST(MixUps, TheNearestOfSeveralExplanationsCounts) {
  EXPECT_EQ(kind(4, 0.2), MixUp::deviation) << "25.2 is nearer to 25.1 than 24.8";
  EXPECT_EQ(kind(4, -0.2), MixUp::deviation_sign);
}

TEST(MixUps, TwoValuesOfAPartMayBeSwapped) {
  const std::vector<Suspect> suspects{{0, 3, 39.991}, {1, 4, 25.0}, {1, 3, 25.001}};
  const auto named = mix_ups(suspects, kExpected);
  EXPECT_EQ(named[0].kind, MixUp::swapped);
  EXPECT_EQ(named[0].with, 1U);
  EXPECT_EQ(named[2].with, 0U);
  EXPECT_EQ(named[1].kind, MixUp::outlier) << "of another part";
}

TEST(MixUps, AWholeSeriesMayBeOne) {
  Series inch, good, bad;
  for (int i = 0; i < 9; ++i) {
    const double y = 25 + 0.001 * i;
    inch.push_back({y / 25.4, 0, 0, 0, 0});
    good.push_back({y, 0, 0, 0, 0});
    bad.push_back({y + 0.3, 0, 0, 0, 0});
  }
  const Limits limits{25, 25.02, 24.98};
  EXPECT_EQ(mix_up_of_all(inch, limits, 25), MixUp::inch);
  EXPECT_FALSE(mix_up_of_all(good, limits, 25));
  EXPECT_FALSE(mix_up_of_all(bad, limits, 25));
  EXPECT_FALSE(mix_up_of_all(inch, {25, 25.02, {}}, 25));
}

}  // namespace
}  // namespace turnwright::learning
