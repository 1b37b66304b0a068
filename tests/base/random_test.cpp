#include "turnwright/base/random.hpp"

#include <gtest/gtest.h>

namespace turnwright {
namespace {

// Rosetta Code, "Pseudo-random numbers/Splitmix64": the first five of seed 1234567.
TEST(SplitMix64, FirstNumbersAsPublished) {
  const std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u,
                                     9817491932198370423u, 4593380528125082431u,
                                     16408922859458223821u};
  for (std::uint64_t k = 0; k < 5; ++k)
    EXPECT_EQ(splitmix64(1234567, k), published[k]) << k;
}

TEST(Draws, AreWithinTheirEnds) {
  EXPECT_GT(uniform_draw(0), 0);
  EXPECT_LE(uniform_draw(~std::uint64_t{0}), 1);
  EXPECT_TRUE(std::isfinite(normal_draw(uniform_draw(0), 0.5)));
}

TEST(Draws, NormalOnesHaveTheMomentsOfANormalDistribution) {
  constexpr std::uint64_t kCount = 200'000;
  double moments[4] = {};
  for (std::uint64_t k = 0; k < kCount; ++k) {
    const double x = normal_draw(uniform_draw(splitmix64(1, 2 * k)),
                                 uniform_draw(splitmix64(1, 2 * k + 1)));
    double power = 1;
    for (double& m : moments) m += (power *= x) / kCount;
  }
  // five standard deviations of each mean: sqrt of 1, 2, 15, 96 over the count
  const double normal[] = {0, 1, 0, 3}, variance[] = {1, 2, 15, 96};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(moments[i], normal[i], 5 * std::sqrt(variance[i] / kCount)) << i + 1;
}

}  // namespace
}  // namespace turnwright
