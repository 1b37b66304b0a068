#include "turnwright/learning/trend.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "simulated.hpp"

namespace turnwright::learning {
namespace {

constexpr double k95 = 0.95;

double t95(double degrees) { return quantile(boost::math::students_t(degrees), 0.975); }

// Four edges of three parts, neither time nor age known.
Series balanced() {
  const double y[4][3] = {{7, 9, 8}, {12, 13, 11}, {9, 7, 8}, {14, 15, 16}};
  Series s;
  for (std::size_t e = 0; e < 4; ++e)
    for (const double value : y[e]) s.push_back({value, 0, 0, e, 0});
  return s;
}

// One-way analysis of variance by hand: means 8, 12, 8, 15; every edge has a sum of squares
// of 2; between 3 (2.75^2 + 1.25^2 + 2.75^2 + 4.25^2) = 104.25.
TEST(Trend, ABalancedTableIsItsAnalysisOfVariance) {
  const auto t = *fit_trend(balanced(), k95);
  EXPECT_DOUBLE_EQ(t.degrees, 8);
  EXPECT_DOUBLE_EQ(t.s_mm, 1);
  EXPECT_NEAR(t.standardised[0], -1 / std::sqrt(2 / 3.0), 1e-12) << "leverage 1/3";
  EXPECT_FALSE(t.edges) << "three degrees of freedom compare too little";
  Series longer = balanced();
  for (auto o : balanced()) {
    o.edge += 4;
    longer.push_back(o);
  }
  const auto twice = *fit_trend(longer, k95);
  const double MS = 2 * 104.25 / 7;
  EXPECT_NEAR(twice.edges->variance_mm2, (MS - 1) / 3, 1e-12);
  EXPECT_NEAR(twice.edges->p, cdf(complement(boost::math::fisher_f(7, 16), MS)), 1e-12);
  EXPECT_NEAR(twice.mean_mm.u, 1 / std::sqrt(24.0), 1e-12);
  EXPECT_NEAR(twice.mean_mm.upper - twice.mean_mm.value, t95(16) / std::sqrt(24.0), 1e-9);
}

// Means of edges against their mean times are a straight line of their own: with balanced
// edges at even times that is what drift is, with E - 2 degrees of freedom.
TEST(Trend, DriftOfBalancedEdgesIsTheLineThroughTheirMeans) {
  Draw draw(3);
  Series s;
  std::vector<double> mean(6);
  for (std::size_t e = 0; e < 6; ++e) {
    const double level = draw.normal();
    for (int age = 0; age < 10; ++age) {
      const double at = 10.0 * static_cast<double>(e) + age;
      const double y = 0.1 * at + 0.2 * age + level + 0.3 * draw.normal();
      s.push_back({y, 0, at, e, static_cast<double>(age)});
      mean[e] += y / 10;
    }
  }
  double sxy = 0, sxx = 0, my = 0, rss = 0;
  for (const double m : mean) my += m / 6;
  for (std::size_t e = 0; e < 6; ++e) {
    const double x = 10 * (static_cast<double>(e) - 2.5);
    sxy += x * (mean[e] - my);
    sxx += x * x;
  }
  for (std::size_t e = 0; e < 6; ++e)
    rss += std::pow(mean[e] - my - sxy / sxx * 10 * (static_cast<double>(e) - 2.5), 2);
  const auto t = *fit_trend(s, k95);
  ASSERT_TRUE(t.drift && t.wear);
  EXPECT_NEAR(t.drift->value, sxy / sxx, 1e-9);
  EXPECT_NEAR(t.drift->u, std::sqrt(rss / 4 / sxx), 1e-9);
  EXPECT_NEAR(t.drift->upper - t.drift->value, t95(4) * t.drift->u, 1e-9);
}

// Ages alike on every edge: how edges stand says nothing of wear, whose interval has the
// degrees of freedom within edges.
TEST(Trend, WearOfBalancedEdgesIsThatWithinThem) {
  Draw draw(13);
  Series s;
  for (std::size_t e = 0; e < 6; ++e) {
    const double level = draw.normal();
    for (int age = 0; age < 3; ++age)
      s.push_back({level + 0.1 * draw.normal(), 0, 0, e, static_cast<double>(age)});
  }
  const auto t = *fit_trend(s, k95);
  EXPECT_NEAR(t.wear->u, t.s_mm / std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(t.wear->upper - t.wear->value, t95(11) * t.wear->u, 1e-9);
}

TEST(Trend, AnExactSeriesGivesItsConstantsBack) {
  Series s;
  for (std::size_t e = 0; e < 5; ++e)
    for (int age = 0; age < 8; ++age) {
      const double at = 3 * static_cast<double>(e) + 0.1 * age * age,
                   offset = -0.01 * age;
      s.push_back(
          {20 + 0.02 * at + 0.003 * age + 0.01 * static_cast<double>(e % 2) + offset,
           offset, at, e, static_cast<double>(age)});
    }
  const auto t = *fit_trend(s, k95);
  EXPECT_NEAR(t.s_mm, 0, 1e-12);
  ASSERT_EQ(t.jumps.size(), 4U);
  // Eight parts of wear are taken back, and the time since one more step of the old edge.
  const double later = 3 - 4.9 - (4.9 - 3.6);
  EXPECT_NEAR(t.jumps[0].step_mm.value, 0.01 - 8 * 0.003 + 0.02 * later, 1e-9);
  EXPECT_NEAR(t.jumps[1].step_mm.value, -0.01 - 8 * 0.003 + 0.02 * later, 1e-9);
}

TEST(Trend, OneEdgeAtEvenTimesTellsOneTrendAlone) {
  Truth truth{.edges = 1, .parts_per_edge = 60, .even_times = true};
  Draw draw(5);
  const auto t = *fit_trend(simulated(truth, draw).series, k95);
  EXPECT_TRUE(t.drift_in_wear);
  EXPECT_FALSE(t.drift);
  ASSERT_TRUE(t.wear);
  EXPECT_TRUE(holds(*t.wear, truth.wear_mm + truth.drift_mm_h * 4 / 60));
}

TEST(Trend, EdgesOfOnePartEachAreTakenAsAlike) {
  Series s;
  Draw draw(1);
  for (std::size_t e = 0; e < 9; ++e)
    s.push_back({draw.normal(), 0, 1.0 * static_cast<double>(e), e, 0});
  const auto t = *fit_trend(s, k95);
  EXPECT_TRUE(t.edges_ignored);
  EXPECT_DOUBLE_EQ(t.degrees, 7);
}

TEST(Trend, TooFewPartsHaveNone) {
  EXPECT_FALSE(fit_trend({}, k95));
  EXPECT_FALSE(fit_trend({{1, 0, 0, 0, 0}, {2, 0, 1, 0, 1}, {3, 0, 3, 0, 2}}, k95));
}

// Neither a shift of time, nor of the size, nor other units of either change anything.
TEST(Trend, FollowsTheUnits) {
  Draw draw(11);
  const auto one = simulated({}, draw).series;
  auto other = one;
  for (auto& o : other) {
    o.y_mm = 1000 * (o.y_mm - 3);
    o.offset_mm *= 1000;
    o.at = 60 * o.at + 77;
  }
  const auto a = *fit_trend(one, k95), b = *fit_trend(other, k95);
  EXPECT_NEAR(b.s_mm, 1000 * a.s_mm, 1e-9);
  EXPECT_NEAR(b.drift->lower, 1000.0 / 60 * a.drift->lower, 1e-7);
  EXPECT_NEAR(b.wear->upper, 1000 * a.wear->upper, 1e-7);
  EXPECT_NEAR(b.jumps[2].step_mm.u, 1000 * a.jumps[2].step_mm.u, 1e-7);
}

}  // namespace
}  // namespace turnwright::learning
