#include "turnwright/tolerance/budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::tolerance {
namespace {

using enum Distribution;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Source source(Distribution d, double value_um, double sensitivity = 1) {
  return {
      .name = "x", .distribution = d, .value_um = value_um, .sensitivity = sensitivity};
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Sum of n uniforms on [0, 1] (Irwin and Hall): F(x) = sum_k (-1)^k C(n, k) (x - k)^n /
/// n! over k <= x.
double irwin_hall_cdf(double x, int n) {
  double sum = 0, choose = 1, factorial = 1;
  for (int i = 2; i <= n; ++i) factorial *= i;
  for (int k = 0; k <= n && k <= x; ++k) {
    sum += (k % 2 ? -1 : 1) * choose * std::pow(x - k, n);
    choose *= static_cast<double>(n - k) / (k + 1);
  }
  return sum / factorial;
}

/// Holds the draws' share below many places against a distribution, within 4 standard
/// errors (one of 16000 would miss by chance; seeds are fixed).
void expect_distribution(const std::vector<Source>& sources,
                         const std::function<double(double)>& cdf, double from,
                         double to) {
  constexpr std::size_t kCount = 200'000;
  for (const std::uint64_t seed : {1u, 77u}) {
    const auto rising = rising_sum_um(sources, {.seed = seed, .count = kCount});
    for (int i = 1; i < 20; ++i) {
      const double x = from + (to - from) * i / 20, p = cdf(x);
      const double error = std::sqrt(p * (1 - p) / static_cast<double>(kCount));
      EXPECT_NEAR(share_within(rising, {-kInfinity, x}), p, 4 * error + 1e-12)
          << x << " seed " << seed;
    }
  }
}

// --- The draws -----------------------------------------------------------------------

std::vector<Source> one_of_each() {
  return {source(normal, 1.5),       source(uniform, 3, 2), source(triangular, 4, -1),
          source(arcsine, 2),        source(fixed, -1.25),  source(rayleigh, 0.8, -2),
          source(normal, 0.7, -1.25)};
}

TEST(Draws, AreBitIdenticalForAnyNumberOfThreads) {
  const auto one = rising_sum_um(one_of_each(), {.seed = 9, .count = 100'003});
  for (const unsigned threads : {2u, 3u, 7u, 64u, 1000u, 0u})
    EXPECT_EQ(one, rising_sum_um(one_of_each(),
                                 {.seed = 9, .count = 100'003, .threads = threads}))
        << threads;
  EXPECT_EQ(rising_sum_um(one_of_each(), {.count = 3, .threads = 2}).size(), 3u);
}

TEST(Draws, DependOnTheSeedAndAreNotSharedBySources) {
  const auto a = rising_sum_um(std::vector{source(normal, 1)}, {.seed = 1, .count = 9});
  const auto b = rising_sum_um(std::vector{source(normal, 1)}, {.seed = 2, .count = 9});
  EXPECT_NE(a, b);
  // were the two sources one stream, X - X would be 0
  const auto difference = rising_sum_um(
      std::vector{source(normal, 1), source(normal, 1, -1)}, {.count = 1000});
  EXPECT_LT(difference.front(), -2);
  EXPECT_GT(difference.back(), 2);
}

// A draw does not depend on how many follow it: the first draws are among the more.
TEST(Draws, MoreDrawsKeepTheFirst) {
  const auto few = rising_sum_um(one_of_each(), {.count = 100});
  const auto many = rising_sum_um(one_of_each(), {.count = 1000});
  EXPECT_TRUE(std::ranges::includes(many, few));
}

// --- Distributions, against their closed forms ---------------------------------------

TEST(Distributions, OfOneSource) {
  expect_distribution(
      {source(normal, 2)}, [](double x) { return normal_cdf(x / 2); }, -6, 6);
  expect_distribution(
      {source(uniform, 2)}, [](double x) { return (x + 2) / 4; }, -2, 2);
  expect_distribution(
      {source(triangular, 2)},
      [](double x) {
        const double tail = (2 - std::abs(x)) * (2 - std::abs(x)) / 8;
        return x < 0 ? tail : 1 - tail;
      },
      -2, 2);
  expect_distribution(
      {source(arcsine, 2)}, [](double x) { return 0.5 + std::asin(x / 2) / units::kPi; },
      -2, 2);
  expect_distribution(
      {source(rayleigh, 2)}, [](double x) { return 1 - std::exp(-x * x / 8); }, 0, 8);
  expect_distribution(
      {source(rayleigh, 2, -1)}, [](double x) { return std::exp(-x * x / 8); }, -8, 0);
}

TEST(Distributions, SumsOfNormalsAreNormal) {
  const double sigma = std::sqrt(9 + 16 + 4 * 1.44);
  expect_distribution(
      {source(normal, 3), source(normal, 4), source(normal, 1.2, -2), source(fixed, 5)},
      [=](double x) { return normal_cdf((x - 5) / sigma); }, 5 - 15, 5 + 15);
}

// Irwin and Hall's closed form, 2 to 6 uniforms.
TEST(Distributions, SumsOfUniforms) {
  for (int n = 2; n <= 6; ++n)
    expect_distribution(
        std::vector<Source>(static_cast<std::size_t>(n), source(uniform, 0.5)),
        [n](double x) { return irwin_hall_cdf(x + n / 2.0, n); }, -n / 2.0, n / 2.0);
}

TEST(Distributions, MeanAndSigmaOfEachInClosedForm) {
  for (const Distribution d : {normal, uniform, triangular, arcsine, fixed, rayleigh}) {
    const Source one = source(d, 3, -2);
    const auto rising = rising_sum_um(std::vector{one}, {.count = 400'000});
    double mean = 0, square = 0;
    for (const double x : rising) mean += x / 400'000;
    for (const double x : rising) square += (x - mean) * (x - mean) / 400'000;
    const Budget b = budget({.sources = {one}}, {-1, 1});
    EXPECT_NEAR(b.mean_um, mean, 4 * b.sigma_um / std::sqrt(4e5) + 1e-10)
        << static_cast<int>(d);
    // a variance's relative error is at most sqrt(2/n) for these (excess <= 0.25)
    EXPECT_NEAR(b.sigma_um, std::sqrt(square), 4 * b.sigma_um / std::sqrt(4e5) + 1e-10)
        << static_cast<int>(d);
  }
}

// --- Worst case, root of sum of squares, shares ---------------------------------------

TEST(ClosedForms, WorstCaseAddsTheReach) {
  const Budget b = budget({.sources = {source(uniform, 4), source(triangular, 3, -2),
                                       source(normal, 1), source(fixed, 5)}},
                          {-100, 100});
  EXPECT_DOUBLE_EQ(b.worst_case_um.up_um, 4 + 6 + 3 + 5);
  EXPECT_DOUBLE_EQ(b.worst_case_um.down_um, -4 - 6 - 3 + 5);
  EXPECT_DOUBLE_EQ(b.rss_um.up_um, 5 + std::sqrt(16.0 + 36 + 9));
  EXPECT_DOUBLE_EQ(b.rss_um.down_um, 5 - std::sqrt(16.0 + 36 + 9));
  EXPECT_DOUBLE_EQ(b.mean_um, 5);
  EXPECT_DOUBLE_EQ(b.sigma_um, std::sqrt(16 / 3.0 + 6 + 1));
  ASSERT_EQ(b.shares.size(), 4u);
  const double variance = 16 / 3.0 + 6 + 1;
  EXPECT_DOUBLE_EQ(b.shares[0].variance_share, 16 / 3.0 / variance);
  EXPECT_DOUBLE_EQ(b.shares[1].variance_share, 6 / variance);
  EXPECT_DOUBLE_EQ(b.shares[1].worst_case_um, 6);
  EXPECT_DOUBLE_EQ(b.shares[2].variance_share, 1 / variance);
  EXPECT_DOUBLE_EQ(b.shares[3].variance_share, 0);
  EXPECT_DOUBLE_EQ(b.shares[3].worst_case_um, 5);
}

// Known biases cancel; an eccentricity only adds.
TEST(ClosedForms, SignsCount) {
  const Budget b = budget({.sources = {source(fixed, 5), source(fixed, 5, -1)}}, {-1, 1});
  EXPECT_EQ(b.worst_case_um.up_um, 0);
  EXPECT_EQ(b.worst_case_um.down_um, 0);
  const Budget e = budget({.sources = {source(rayleigh, 2)}}, {-1, 10});
  EXPECT_DOUBLE_EQ(e.worst_case_um.down_um, 0);
  const double reach = e.worst_case_um.up_um;
  EXPECT_NEAR(std::exp(-reach * reach / 8), 0.00135, 1e-15);
  EXPECT_DOUBLE_EQ(e.rss_um.up_um, e.worst_case_um.up_um);  // one source
  EXPECT_NEAR(e.rss_um.down_um, 0, 1e-15);
  const Budget turned = budget({.sources = {source(rayleigh, 2, -1)}}, {-10, 1});
  EXPECT_DOUBLE_EQ(turned.worst_case_um.down_um, -e.worst_case_um.up_um);
  EXPECT_DOUBLE_EQ(turned.rss_um.down_um, -e.rss_um.up_um);
  EXPECT_DOUBLE_EQ(turned.shares[0].worst_case_um, reach);
}

TEST(ClosedForms, RssLiesWithinTheWorstCase) {
  const Budget b = budget({.sources = one_of_each()}, {-1, 1});
  EXPECT_LT(b.worst_case_um.down_um, b.rss_um.down_um);
  EXPECT_LT(b.rss_um.up_um, b.worst_case_um.up_um);
}

TEST(ClosedForms, FitTheRoomOrNot) {
  const std::vector<Source> two{source(uniform, 3), source(uniform, 4)};  // 7 and 5
  EXPECT_TRUE(budget({.sources = two}, {-7, 7}).worst_case_fits);
  EXPECT_FALSE(budget({.sources = two}, {-6.9, 7}).worst_case_fits);
  EXPECT_FALSE(budget({.sources = two}, {-7, 6.9}).worst_case_fits);
  EXPECT_TRUE(budget({.sources = two}, {-5, 5}).rss_fits);
  EXPECT_FALSE(budget({.sources = two}, {-4.9, 5}).rss_fits);
  EXPECT_FALSE(budget({.sources = two}, {-5, 4.9}).rss_fits);
}

// --- Conformity ----------------------------------------------------------------------

// Normal sum against two limits: P = Phi((u - m)/s) - Phi((l - m)/s).
TEST(Conformity, OfNormalsIsTheClosedForm) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Budget b =
        budget({.sources = {source(normal, 3), source(normal, 2, 2), source(fixed, 1)},
                .draws = {.seed = seed}},
               {-6, 9});
    const double p = normal_cdf(8 / 5.0) - normal_cdf(-7 / 5.0);
    EXPECT_NEAR(b.P_conform, p, 4 * std::sqrt(p * (1 - p) / 1e5));
    EXPECT_LT(b.P_low, p);
    EXPECT_GT(b.P_high, p);
    // quantiles: error sqrt(p (1 - p)/n)/density
    const auto quantile = [&](double z, double share, double found) {
      const double density = std::exp(-z * z / 2) / std::sqrt(2 * units::kPi) / 5;
      EXPECT_NEAR(found, 1 + 5 * z, 4 * std::sqrt(share * (1 - share) / 1e5) / density);
    };
    quantile(-3, 0.00135, b.Q0_135_um);
    quantile(0, 0.5, b.Q50_um);
    quantile(3, 0.00135, b.Q99_865_um);
    // C_pk of a normal: min(8, 7)/(3 sigma)
    EXPECT_NEAR(*b.index, 7 / 15.0, 0.02);
  }
}

// One-sided: a run-out with eccentricity alone, P = 1 - exp(-room^2/(2 a^2)); the index
// is (room - Q50)/(Q99.865 - Q50) with Q50 = a sqrt(2 ln 2).
TEST(Conformity, OfAnEccentricityIsTheClosedForm) {
  const Budget b = budget({.sources = {source(rayleigh, 2)}}, {-kInfinity, 5});
  const double p = 1 - std::exp(-25 / 8.0);
  EXPECT_NEAR(b.P_conform, p, 4 * std::sqrt(p * (1 - p) / 1e5));
  const double q50 = 2 * std::sqrt(2 * std::log(2)),
               q99 = 2 * std::sqrt(-2 * std::log(0.00135));
  EXPECT_NEAR(*b.index, (5 - q50) / (q99 - q50), 0.02);
  // and turned round, against a lower limit alone near enough to matter
  const Budget low = budget({.sources = {source(rayleigh, 2, -1)}}, {-5, 100});
  EXPECT_NEAR(*low.index, (5 - q50) / (q99 - q50), 0.02);
}

// Uniform +-3 and normal 1: P by integrating over the uniform; without the normal the
// share of the width.
TEST(Conformity, ASpreadGivesEveryRoomItsShare) {
  const Spread both(
      std::vector{source(uniform, 3), source(normal, 1), source(fixed, 0.5)});
  const Spread bare(std::vector{source(uniform, 3)});
  for (const double up : {-2.0, 0.0, 1.5, 2.8, 4.0, 6.0}) {
    double P = 0;
    constexpr int kParts = 20000;
    for (int k = 0; k < kParts; ++k) {
      const double x = 3 * (2 * (k + 0.5) / kParts - 1) + 0.5;
      P += (normal_cdf((up - x) / 2) - normal_cdf((-4 - x) / 2)) / kParts;
    }
    EXPECT_NEAR(both.within({-4, up}, std::sqrt(3.0)), P,
                4 * std::sqrt(P * (1 - P) / 20000) + 1e-6)
        << up;
    EXPECT_NEAR(bare.within({-kInfinity, up}), std::clamp((up + 3) / 6, 0.0, 1.0),
                4 * std::sqrt(0.25 / 20000));
  }
  const Spread normals(std::vector{source(normal, 0.6, 2), source(fixed, -1)});
  EXPECT_NEAR(normals.within({-kInfinity, 1}, 1.6), normal_cdf(1), 1e-15);
}

// Three uniform widths and a normal by integrating over all but the last; a triangular
// one is two halves.
TEST(Conformity, UniformSourcesAddUpInClosedForm) {
  const double a = 2, b = 0.7, c = 0.05, sigma = 0.6;
  const Spread three(std::vector{source(uniform, a), source(uniform, b, -1),
                                 source(uniform, c), source(normal, sigma)});
  const Spread sharp(std::vector{source(uniform, a), source(triangular, b)});
  constexpr int n = 400;
  const auto mid = [](double half, int k) { return half * (2 * (k + 0.5) / n - 1); };
  for (const double up : {-2.9, -1.0, 0.0, 0.3, 2.0, 2.7, 3.5}) {
    double P = 0, Q = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const double x = up - mid(a, i) - mid(b, k);
        // c by its own integral of the normal's share to third order.
        const double d = normal_cdf((x + c) / sigma) + normal_cdf((x - c) / sigma);
        P += (4 * normal_cdf(x / sigma) + d) / 6 / n / n;
        const double t = mid(b, k);
        Q += (1 - std::abs(t) / b) * 2 / n *
             std::clamp((up - t + a) / (2 * a), 0.0, 1.0) / n;
      }
    EXPECT_NEAR(three.within({-kInfinity, up}), P, 1e-5) << up;
    EXPECT_NEAR(sharp.within({-kInfinity, up}), Q, 1e-5) << up;
  }
  EXPECT_NEAR(three.within({-20, 20}), 1, 1e-12);
}

TEST(Conformity, AnEccentricityAndANormalAddUpInClosedForm) {
  const double a = 2, sigma = 0.8;
  const Spread both(std::vector{source(rayleigh, 1, 2), source(normal, sigma)});
  for (const double up : {-1.0, 0.5, 2.0, 5.0, 9.0}) {
    double P = 0;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
      const double r = 12 * a * (k + 0.5) / n;
      P += r / a / a * std::exp(-r * r / 2 / a / a) * normal_cdf((up - r) / sigma) * 12 *
           a / n;
    }
    EXPECT_NEAR(both.within({-kInfinity, up}), P, 1e-7) << up;
  }
}

// What is neither is drawn.
TEST(Conformity, OtherSumsAreDrawn) {
  const Spread drawn(std::vector{source(uniform, 1), source(rayleigh, 2)});
  double P = 0;
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double left = 4 - (2 * (k + 0.5) / n - 1);
    P += -std::expm1(-left * left / 8) / n;
  }
  EXPECT_NEAR(drawn.within({-kInfinity, 4}), P, 4 * std::sqrt(P * (1 - P) / 20000));
}

TEST(Conformity, WithoutSpreadIsAllOrNothing) {
  const Budget in = budget({.sources = {source(fixed, 2)}}, {-1, 2});
  EXPECT_EQ(in.P_conform, 1);
  EXPECT_FALSE(in.index);
  EXPECT_EQ(in.sigma_um, 0);
  EXPECT_EQ(in.shares[0].variance_share, 0);
  EXPECT_EQ(budget({.sources = {source(fixed, 2.001)}}, {-1, 2}).P_conform, 0);
  EXPECT_EQ(budget({.sources = {}}, {0, 0}).P_conform, 1);
  EXPECT_EQ(budget({.sources = {}}, {1, 2}).P_conform, 0);
  EXPECT_EQ(budget({.sources = {}}, {1, -1}).P_conform, 0);  // wider than the zone
}

// Wilson 1927's interval: at p = 1 its lower end is n/(n + z^2).
TEST(Conformity, IntervalIsHonestAtTheEnds) {
  const Budget all = budget({.sources = {}, .draws = {.count = 100}}, {0, 0});
  EXPECT_NEAR(all.P_low, 100 / (100 + 3.8415), 1e-6);
  EXPECT_EQ(all.P_high, 1);
  const Budget none = budget({.sources = {}, .draws = {.count = 100}}, {1, 2});
  EXPECT_EQ(none.P_low, 0);
  EXPECT_NEAR(none.P_high, 3.8415 / (100 + 3.8415), 1e-6);
}

// --- ISO 14253-1 ---------------------------------------------------------------------

TEST(Decisions, OfOneMeasuredPart) {
  const auto decision = [](double bias_um, double U_um) {
    return budget({.sources = {source(fixed, bias_um)}, .measurement_U_um = U_um},
                  {-10, 10})
        .decision;
  };
  EXPECT_EQ(decision(7, 2), Decision::conforms);
  EXPECT_EQ(decision(8, 2), Decision::conforms);
  EXPECT_EQ(decision(8.01, 2), Decision::not_proven);
  EXPECT_EQ(decision(-8.01, 2), Decision::not_proven);
  EXPECT_EQ(decision(12, 2), Decision::not_proven);
  EXPECT_EQ(decision(12.01, 2), Decision::does_not_conform);
  EXPECT_EQ(decision(-12.01, 2), Decision::does_not_conform);
  EXPECT_EQ(decision(10, 0), Decision::conforms);
  EXPECT_EQ(decision(10.01, 0), Decision::does_not_conform);
  EXPECT_EQ(decision(0, 10), Decision::conforms);
  EXPECT_EQ(decision(0, 10.01), Decision::not_proven);  // nothing is left of the zone
}

// A lot of sigma 3 in +-9 um: 0.9973 conform, 0.9876 of them within +-7.5 um.
TEST(Decisions, OfALot) {
  const auto of = [](double conformance, double U_um) {
    return budget({.sources = {source(normal, 3)},
                   .conformance = conformance,
                   .measurement_U_um = U_um},
                  {-9, 9});
  };
  EXPECT_NEAR(of(0.99, 1.5).P_accept, 2 * normal_cdf(2.5) - 1,
              4 * std::sqrt(0.0124 * 0.9876 / 1e5));
  EXPECT_EQ(of(0.98, 1.5).decision, Decision::conforms);
  EXPECT_EQ(of(0.995, 1.5).decision, Decision::not_proven);
  EXPECT_EQ(of(0.9999, 0).decision, Decision::does_not_conform);
}

// --- Room of a case -------------------------------------------------------------------

Case sampled(part::ToleranceKind kind, std::vector<double> e_mm) {
  return {.kind = kind, .e_mm = Samples{.e_mm = std::move(e_mm)}};
}

TEST(Room, OfEachKind) {
  using enum part::ToleranceKind;
  Case d = sampled(diameter, {0.004, 0.011});
  d.limits = part::Limits{.lower_mm = -0.001, .upper_mm = 0.030};
  const auto expect = [](const Case& c, double down_um, double up_um) {
    const Span r = room_um(verdict(c));
    if (std::isinf(down_um))
      EXPECT_EQ(r.down_um, down_um);
    else
      EXPECT_NEAR(r.down_um, down_um, 1e-11);
    EXPECT_NEAR(r.up_um, up_um, 1e-11);
  };
  expect(d, -9, 8);  // 8 .. 22 of -1 .. 30
  d.envelope = Envelope::shaft;
  d.machine_mm = 0.003;
  expect(d, -9, 5);
  d.envelope = Envelope::bore;
  expect(d, -6, 8);
  Case l = sampled(length, {0.004, 0.011});
  l.other_mm = Samples{.e_mm = {-0.002, 0.001}};
  l.limits = part::Limits{.lower_mm = -0.020, .upper_mm = 0.020};
  expect(l, -22, 8);  // 2 .. 12
  Case p = sampled(profile, {-0.002, 0.006});
  p.value_mm = 0.010;
  p.half_angle_rad = units::kPi / 3;
  expect(p, -4, 2);  // -1 .. 3 of -5 .. 5
  for (const auto kind : {flatness, cylindricity, parallelism, perpendicularity}) {
    Case f = sampled(kind, {-0.002, 0.006});
    f.value_mm = 0.010;
    expect(f, -kInfinity, 2);
  }
  Case r = sampled(total_radial_runout, {-0.002, 0.006});
  r.value_mm = 0.010;
  r.machine_mm = 0.0015;
  expect(r, -kInfinity, 0.5);
  r.kind = coaxiality;
  expect(r, -kInfinity, 8.5);
}

// A part on its limit conforms, also when the budget asks.
TEST(Room, ForgivesRoundingAsTheVerdictDoes) {
  for (int low = -40; low <= 40; ++low) {
    Case c = sampled(part::ToleranceKind::diameter, {low / 1000.0, (low + 7) / 1000.0});
    c.limits =
        part::Limits{.lower_mm = 2 * low / 1000.0, .upper_mm = 2 * (low + 7) / 1000.0};
    EXPECT_EQ(
        budget({.sources = {}, .draws = {.count = 1}}, room_um(verdict(c))).P_conform, 1)
        << low;
  }
}

// A relative uncertainty r of e, as the header says to enter it, is never too favourable:
// the exact P is that of Z with l <= 2 e_min (1 + r Z), 2 e_max (1 + r Z) <= u.
TEST(Room, ScalingAsAShiftIsNeverTooFavourable) {
  struct Row {
    double low_um, high_um, lower_um, upper_um;
  };
  for (const Row& w : std::vector<Row>{{2, 14, -1, 16},
                                       {-6, 9, -8, 10},
                                       {10, 20, 8, 24},
                                       {-20, -12, -22, -10},
                                       {0, 10, -1, 11}}) {
    const double r = 0.15;
    double z_low = -kInfinity, z_high = kInfinity;
    const auto cut = [&](double value, double limit, bool above) {
      if (value == 0) return;
      const double z = (limit / value - 1) / r;
      if ((value > 0) == above)
        z_high = std::min(z_high, z);
      else
        z_low = std::max(z_low, z);
    };
    cut(w.high_um, w.upper_um, true);
    cut(w.low_um, w.lower_um, false);
    const double exact = normal_cdf(z_high) - normal_cdf(z_low);
    const double largest = std::max(std::abs(w.low_um), std::abs(w.high_um));
    const Budget b = budget({.sources = {source(normal, r, largest)}},
                            {w.lower_um - w.low_um, w.upper_um - w.high_um});
    EXPECT_LE(b.P_conform, exact + 4 * std::sqrt(0.25 / 1e5));
  }
}

// --- Quantiles and refusals -----------------------------------------------------------

TEST(Quantiles, AreLinearBetweenRanks) {
  const std::vector<double> x{1, 2, 4, 8, 16};
  EXPECT_EQ(quantile_um(x, 0), 1);
  EXPECT_EQ(quantile_um(x, 1), 16);
  EXPECT_EQ(quantile_um(x, 0.5), 4);
  EXPECT_DOUBLE_EQ(quantile_um(x, 0.625), 6);
  EXPECT_THROW(quantile_um({}, 0.5), std::domain_error);
  EXPECT_THROW(quantile_um(x, 1.01), std::domain_error);
  EXPECT_THROW(quantile_um(x, std::nan("")), std::domain_error);
  EXPECT_DOUBLE_EQ(share_within(x, {2, 8}), 0.6);
  EXPECT_DOUBLE_EQ(share_within(x, {2.1, 3.9}), 0);
  EXPECT_THROW(share_within({}, {0, 1}), std::domain_error);
}

// The room that planning must leave for a wanted conformance: one-sided Phi^-1(0.95).
TEST(Quantiles, AreTheRoomToLeave) {
  const auto rising = rising_sum_um(std::vector{source(normal, 3)}, {});
  EXPECT_NEAR(quantile_um(rising, 0.95), 3 * 1.644854, 0.1);
  EXPECT_NEAR(quantile_um(rising, 0.975), 3 * 1.959964, 0.1);
}

std::string message(const BudgetDemand& demand, const Span& room = {-1, 1}) {
  try {
    budget(demand, room);
  } catch (const std::domain_error& e) {
    return e.what();
  }
  return "accepted";
}

TEST(BudgetRefusals, NameTheRule) {
  const double nan = std::nan("");
  const std::string value = "budget: the value of 'x' must be >= 0 um and finite";
  EXPECT_EQ(message({.sources = {source(normal, -1)}}), value);
  EXPECT_EQ(message({.sources = {source(rayleigh, nan)}}), value);
  EXPECT_EQ(message({.sources = {source(fixed, -1)}}), "accepted");
  EXPECT_EQ(message({.sources = {source(fixed, kInfinity)}}),
            "budget: the value of 'x' must be finite");
  EXPECT_EQ(message({.sources = {source(normal, 1, nan)}}),
            "budget: the sensitivity of 'x' must be finite");
  EXPECT_EQ(message({.sources = {}, .conformance = nan}),
            "budget: the wanted conformance must lie in [0, 1]");
  EXPECT_EQ(message({.sources = {}, .measurement_U_um = -1}),
            "budget: the measurement's uncertainty must be >= 0 um and finite");
  EXPECT_EQ(message({.sources = {}, .draws = {.count = 0}}),
            "budget: there must be a draw");
  EXPECT_EQ(message({.sources = {}}, {nan, 1}),
            "budget: the ends of the range that the sources may use must not be NaN");
}

TEST(Budget, IsLeftWhenNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_THROW(rising_sum_um(std::vector{source(normal, 1)}, {.count = 100}), Cancelled);
}

}  // namespace
}  // namespace turnwright::tolerance
