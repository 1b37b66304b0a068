#include "turnwright/learning/capability.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "simulated.hpp"
#include "turnwright/learning/advice.hpp"
#include "turnwright/learning/outliers.hpp"

namespace turnwright::learning {
namespace {

// Parts whose mean and standard deviation are given: equal steps to both sides.
Series of_moments(double mean, double s, int n) {
  Series series;
  const double step = s * std::sqrt((n - 1.0) / n);
  for (int i = 0; i < n; ++i)
    series.push_back({mean + (i % 2 == 0 ? step : -step), 0, 0, 0, 0});
  return series;
}

Capability of(const Series& s, const Limits& limits) {
  return *capability(s, *fit_trend(s, 0.95), limits, 0.95);
}

// The well known exercise of [Montgomery 2013]: limits 38 and 62, 20 parts, s = 1.75: Cp is
// 2.29, at most 3.01.
TEST(Capability, CpIsThatOfTheTextbook) {
  const auto c = of(of_moments(50, 1.75, 20), {50, 62, 38.0});
  EXPECT_NEAR(c.within.p->value, 2.29, 0.005);
  EXPECT_NEAR(c.within.p->upper, 3.01, 0.005);
  EXPECT_NEAR(c.within.p->lower, 2.2857 * std::sqrt(8.907 / 19), 0.002);
  EXPECT_NEAR(c.within.s_mm.lower, 1.75 * std::sqrt(19 / 32.852), 0.002);
  EXPECT_NEAR(c.overall.p->value, c.within.p->value, 1e-9);
  EXPECT_NEAR(c.overall.p->upper, c.within.p->upper, 1e-9);
}

// Bissell's interval as bisnetanalyst.com and others print it.
TEST(Capability, CpkHasBissellsInterval) {
  constexpr int n = 30;
  const auto c = of(of_moments(97, 1.6, n), {95, 100, 90.0});
  const double Cpk = 3 / 4.8;
  const double half =
      1.96 * Cpk * std::sqrt(1 / (9.0 * n * Cpk * Cpk) + 1 / (2.0 * (n - 1)));
  EXPECT_NEAR(c.within.pk.value, Cpk, 1e-9);
  EXPECT_NEAR(c.within.pk.lower, Cpk - half, 1e-4);
  EXPECT_NEAR(c.overall.pk.upper, Cpk + half, 1e-4);
}

TEST(Capability, WithoutLowerLimitTheUpperAloneCounts) {
  const auto c = of(of_moments(0.01, 0.002, 26), {0, 0.02, {}});
  EXPECT_FALSE(c.within.p);
  EXPECT_NEAR(c.within.pk.value, 0.01 / 0.006, 1e-9);
}

TEST(Capability, ATrendIsInPpAndNotInCp) {
  Series s;
  Draw draw(9);
  for (int i = 0; i < 400; ++i)
    s.push_back({0.001 * i + 0.02 * draw.normal(), 0, 0.1 * i, 0, 0});
  const auto c = of(s, {0.2, 1, -0.6});
  EXPECT_NEAR(c.within.s_mm.value, 0.02, 0.003);
  EXPECT_NEAR(c.overall.s_mm.value, 0.4 / std::sqrt(12), 0.003);
  EXPECT_GT(c.overall_degrees, 2000) << "the trend is repeated, not drawn again";
}

TEST(Capability, NothingThatScattersNotAtAllHasOne) {
  const Series s(20, {5, 0, 0, 0, 0});
  EXPECT_FALSE(capability(s, *fit_trend(s, 0.95), {5, 6, 4.0}, 0.95));
}

// How often intervals hold the truth they were made from.
class Coverage {
 public:
  void count(const std::string& of, const Estimate& e, double truth) {
    auto& [held, all] = counts_[of];
    held += holds(e, truth);
    ++all;
  }
  void add(const Truth& truth, Draw& draw) {
    const auto batch = simulated(truth, draw);
    const auto kept = without(batch.series, outliers(batch.series, 0.01));
    const auto t = *fit_trend(kept, 0.95);
    const Limits limits{25.004, 25.024, 24.984};
    const auto c = *capability(kept, t, limits, 0.95);
    const double room =
        std::min(limits.upper_mm - batch.mean_mm, batch.mean_mm - *limits.lower_mm);
    count("mean", t.mean_mm, batch.mean_mm);
    count("s", c.within.s_mm, truth.s_mm);
    count("s overall", c.overall.s_mm, batch.overall_mm);
    count("Cp", *c.within.p, 0.04 / (6 * truth.s_mm));
    count("Cpk", c.within.pk, room / (3 * truth.s_mm));
    count("Pp", *c.overall.p, 0.04 / (6 * batch.overall_mm));
    count("Ppk", c.overall.pk, room / (3 * batch.overall_mm));
    count("drift", *t.drift, truth.drift_mm_h);
    count("wear", *t.wear, truth.wear_mm);
    count("next part", expected_mm(t, batch.next, 0.95), batch.next_mm);
  }
  void expect_93_to_97_percent(const std::string& where) const {
    for (const auto& [of, count] : counts_) {
      const double percent = 100.0 * count.first / count.second;
      EXPECT_GE(percent, 93) << where << ": " << of;
      EXPECT_LE(percent, 97) << where << ": " << of;
    }
  }

 private:
  std::map<std::string, std::pair<int, int>> counts_;
};

// 200 batches of six characteristics each, whose truths are drawn.  Wear and drift run
// together, edges differ, offsets are corrected, times are uneven, 3 % of the rows are
// missing and 1 % are wrong.
TEST(Capability, IntervalsHoldTheTruthOf93To97PercentOfBatches) {
  Draw draw(2026);
  Coverage coverage;
  for (int batch = 0; batch < 200; ++batch)
    for (int characteristic = 0; characteristic < 6; ++characteristic) {
      const Truth truth{.mu_mm = 25 + draw.uniform(-0.004, 0.008),
                        .s_mm = draw.uniform(0.001, 0.004),
                        .drift_mm_h = draw.uniform(-0.004, 0.004),
                        .wear_mm = draw.uniform(0, 4e-4),
                        .edges_mm = draw.uniform(0.001, 0.004),
                        .edges = 6 + static_cast<int>(draw.uniform(0, 6)),
                        .parts_per_edge = 15 + static_cast<int>(draw.uniform(0, 20)),
                        .offset_every = batch % 2 == 0 ? 0.0 : 30.0};
      coverage.add(truth, draw);
    }
  coverage.expect_93_to_97_percent("drawn truths");
}

// What the estimator's own picture does not have by default: few edges, even times, edges
// that do not differ, one edge alone.
TEST(Capability, IntervalsHoldElsewhereToo) {
  Truth few{.edges = 3, .parts_per_edge = 30}, even{.edges = 6, .even_times = true},
      same{.edges_mm = 0, .edges = 8}, noisy{.s_mm = 0.004, .outliers = 0};
  int number = 0;
  for (const auto& truth : {few, even, same, noisy}) {
    Draw draw(31 + static_cast<std::uint64_t>(number));
    Coverage coverage;
    for (int k = 0; k < 800; ++k) coverage.add(truth, draw);
    coverage.expect_93_to_97_percent("case " + std::to_string(number++));
  }
}

}  // namespace
}  // namespace turnwright::learning
