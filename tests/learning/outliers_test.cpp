#include "turnwright/learning/outliers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "simulated.hpp"

namespace turnwright::learning {
namespace {

// The sample of [Rosner 1983] as PMCMRplus has it in its example of gesdTest; NIST's
// e-Handbook finds three outliers in it at 5 %, the third though the second alone is none.
TEST(Outliers, RosnersSampleHasThree) {
  const std::vector<double> sample{
      -0.25, 0.68, 0.94, 1.15, 1.20, 1.26, 1.26, 1.34, 1.38, 1.43, 1.49, 1.49, 1.55, 1.56,
      1.58,  1.65, 1.69, 1.70, 1.76, 1.77, 1.81, 1.91, 1.94, 1.96, 1.99, 2.06, 2.09, 2.10,
      2.14,  2.15, 2.23, 2.24, 2.26, 2.35, 2.37, 2.40, 2.47, 2.54, 2.62, 2.64, 2.90, 2.92,
      2.92,  2.93, 3.21, 3.26, 3.30, 3.59, 3.68, 4.30, 4.64, 5.34, 5.42, 6.01};
  Series s;
  for (const double y : sample) s.push_back({y, 0, 0, 0, 0});
  EXPECT_EQ(outliers(s, 0.05), (std::vector<std::size_t>{51, 52, 53}));
  EXPECT_TRUE(outliers(s, 0).empty());
}

// A few good values in hundreds of batches are named, as p says; every wrong one is.
TEST(Outliers, AreNamedAndGoodValuesKept) {
  Draw draw(2);
  int batches_with_a_good_one = 0, planted = 0;
  constexpr int kBatches = 300;
  for (int k = 0; k < kBatches; ++k) {
    const auto batch = simulated({}, draw);
    const auto named = outliers(batch.series, 0.01);
    EXPECT_TRUE(std::ranges::includes(named, batch.wrong)) << k;
    batches_with_a_good_one += named.size() > batch.wrong.size();
    planted += static_cast<int>(batch.wrong.size());
  }
  EXPECT_GT(planted, 300);
  EXPECT_LE(batches_with_a_good_one, 10);
}

TEST(Outliers, ATrendIsNone) {
  Series s;
  Draw draw(4);
  for (int i = 0; i < 200; ++i)
    s.push_back(
        {0.01 * i + 0.001 * draw.normal(), 0, 0.1 * i, 0, static_cast<double>(i)});
  EXPECT_TRUE(outliers(s, 1e-6).empty());
}

// A third of the values in inches hides from no test of deviations about a mean.
TEST(Outliers, AThirdOfTheValuesMayBeWrong) {
  Series s;
  Draw draw(6);
  for (int i = 0; i < 90; ++i) {
    const double y = 30 + 0.002 * draw.normal();
    s.push_back({i % 3 == 0 ? y / 25.4 : y, 0, 0, 0, 0});
  }
  const auto named = outliers(s, 0.01);
  EXPECT_EQ(named.size(), 30U);
  for (const auto i : named) EXPECT_EQ(i % 3, 0U);
}

TEST(Outliers, EqualOrFewValuesHaveNone) {
  EXPECT_TRUE(outliers({}, 0.01).empty());
  EXPECT_TRUE(outliers(Series(20, {5, 0, 0, 0, 0}), 0.01).empty());
  EXPECT_TRUE(
      outliers({{1, 0, 0, 0, 0}, {2, 0, 0, 0, 0}, {900, 0, 0, 0, 0}}, 0.01).size() <= 1);
}

}  // namespace
}  // namespace turnwright::learning
