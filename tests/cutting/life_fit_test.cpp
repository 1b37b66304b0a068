#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <stdexcept>

#include "turnwright/cutting/life_scatter.hpp"

namespace turnwright::cutting {
namespace {

using LnNoise = std::function<double()>;

double taylor_min(double vc, double f, double ap) {
  return std::pow(450 / (vc * std::pow(f, 0.35) * std::pow(ap, 0.15)), 1 / 0.255);
}

// Two edges at each of twelve conditions; longer than `stop_min` is all that is known of
// those that last longer.
std::vector<LifePoint> tested(const LnNoise& noise, double stop_min) {
  std::vector<LifePoint> all;
  for (const double vc : {150.0, 190.0, 240.0})
    for (const double f : {0.15, 0.4})
      for (const double ap : {1.0, 3.0})
        for (int edge = 0; edge < 2; ++edge) {
          const double T = taylor_min(vc, f, ap) * std::exp(noise());
          all.push_back({vc, f, ap, std::min(T, stop_min), T > stop_min});
        }
  return all;
}

constexpr double kEver = 1e9;
double no_noise() { return 0; }

bool within(const Estimate& e, double truth) {
  return e.lower <= truth && truth <= e.upper && e.lower <= e.value && e.value <= e.upper;
}

std::vector<LifePoint> fourteen_edges() {
  return {{150, 0.15, 1, 52.1},     {150, 0.15, 1, 60, true}, {150, 0.4, 1, 18.3},
          {150, 0.4, 3, 10.9},      {190, 0.15, 1, 28.4},     {190, 0.15, 3, 13.2},
          {190, 0.4, 1, 7.6},       {190, 0.4, 1, 8, true},   {240, 0.15, 1, 9.4},
          {240, 0.15, 1, 13},       {240, 0.15, 3, 5.1},      {240, 0.4, 3, 2},
          {240, 0.4, 3, 2.5, true}, {240, 0.4, 1, 3.9}};
}

// Numbers of SciPy 1.10: norm and weibull_min, logpdf of the lives that ended and logsf of
// the others, maximised by scipy.optimize.minimize; second derivatives by differences.
TEST(LifeFit, CensoredLivesAreThoseOfAnotherProgram) {
  const auto t = fit_taylor(fourteen_edges(), 0, 0);
  EXPECT_NEAR(t.n->value, 0.2891341581, 1e-8);
  EXPECT_NEAR(t.n->lower, 0.2502154059, 1e-8);
  EXPECT_NEAR(t.n->upper, 0.3423898043, 1e-8);
  EXPECT_NEAR(t.C->value, 268.7289853, 1e-5);
  EXPECT_NEAR(t.a->value, 0.3073720665, 1e-8);
  EXPECT_NEAR(t.b->value, 0.1620027012, 1e-8);
  EXPECT_NEAR(t.evidence.s, 0.1586525389, 1e-8);
  EXPECT_EQ(t.evidence.degrees_of_freedom, 7);
  EXPECT_EQ(t.evidence.used.size(), 14u);
}

TEST(LifeFit, ScatterIsThatOfAnotherProgram) {
  auto lives = fourteen_edges();
  const auto s = scatter_of_lives(lives, fit_taylor(lives, 0, 0), 0, 0);
  EXPECT_EQ(s.distribution, LifeDistribution::lognormal);
  EXPECT_NEAR(s.ln_likelihood_ratio, 4.6486032291 - 3.5685731482, 1e-8);
  EXPECT_NEAR(s.weibull_shape, 8.95984457, 1e-6);
  EXPECT_NEAR(s.T50_min.value, 10.6114841457, 1e-7);
  EXPECT_NEAR(s.T50_min.lower, 9.5528195931, 1e-5);
  EXPECT_NEAR(s.T90_min.value, 8.6591400398, 1e-7);
  EXPECT_NEAR(s.T90_min.lower, 7.3983119548, 1e-5);
  EXPECT_NEAR(s.T90_min.upper, 10.134839770, 1e-5);
  EXPECT_NEAR(s.vc_m_min, 196.29233866, 1e-7);
}

// Repeats at three speeds: sums of squares by hand, F and chi-squared by SciPy.
TEST(LifeFit, ScatterBetweenEdgesIsPureError) {
  std::vector<LifePoint> lives;
  for (const auto& [vc, T] : {std::pair{150., 44.},
                              {150., 61.},
                              {150., 50.},
                              {200., 14.5},
                              {200., 19.8},
                              {200., 17.},
                              {270., 7.7},
                              {270., 6.1},
                              {270., 9.3}})
    lives.push_back({vc, 0.2, 1, T});
  const auto t = fit_taylor(lives, 0, 0);
  EXPECT_NEAR(t.evidence.s, 0.1889656376, 1e-9);
  const auto s = scatter_of_lives(lives, t, 0, 0);
  ASSERT_TRUE(s.s_between && s.s_lack_of_fit);
  EXPECT_NEAR(s.s_between->value, 0.1788791768, 1e-8);
  EXPECT_NEAR(s.s_between->lower, 0.1152685623, 1e-8);
  EXPECT_NEAR(s.s_between->upper, 0.3939037735, 1e-8);
  EXPECT_NEAR(*s.s_lack_of_fit, 0.0930443731, 1e-7);
  EXPECT_NEAR(*s.lack_of_fit_p, 0.2269341904, 1e-7);
}

TEST(LifeFit, ExactLivesGiveTheConstantsAlsoWhereSomeWereStopped) {
  auto lives = tested(no_noise, kEver);
  for (const std::size_t i : {0u, 7u, 13u}) {
    lives[i].longer = true;
    lives[i].T_min *= 0.6;
  }
  const auto t = fit_taylor(lives, 9, 9);
  EXPECT_NEAR(t.C->value, 450, 1e-6);
  EXPECT_NEAR(t.n->value, 0.255, 1e-9);
  EXPECT_NEAR(t.a->value, 0.35, 1e-9);
  EXPECT_NEAR(t.b->value, 0.15, 1e-9);
  EXPECT_EQ(t.evidence.degrees_of_freedom, 21 - 4);
}

TEST(LifeFit, AnEdgeStoppedAtOnceSaysNothing) {
  std::mt19937 seed(7);
  std::normal_distribution<double> normal(0, 0.2);
  auto lives = tested([&] { return normal(seed); }, kEver);
  const FitOptions keep_all{.outlier_p = 0};
  const auto without = fit_taylor(lives, 0, 0, keep_all);
  lives.push_back({150, 0.15, 1, 1e-3, true});
  const auto with = fit_taylor(lives, 0, 0, keep_all);
  EXPECT_NEAR(with.C->value, without.C->value, 1e-6);
  EXPECT_NEAR(with.n->value, without.n->value, 1e-9);
  EXPECT_NEAR(with.n->upper, without.n->upper, 1e-8);
  EXPECT_NEAR(with.evidence.s, without.evidence.s, 1e-9);
}

TEST(LifeFit, LongerThanIsMoreThanEndedThen) {
  auto lives = fourteen_edges();
  for (auto& p : lives) p.longer = false;
  const auto life = [&] {
    return scatter_of_lives(lives, fit_taylor(lives, 0, 0), 0, 0).T50_min.value;
  };
  double before = life();
  for (const std::size_t i : {1u, 7u, 12u}) {
    lives[i].longer = true;
    const double after = life();
    EXPECT_GT(after, before);
    before = after;
  }
}

// In other minutes, T k, C is C k^n, and the lives of edges are k times as long.
TEST(LifeFit, ScalesWithTheUnitOfTime) {
  auto lives = fourteen_edges();
  const auto t = fit_taylor(lives, 0, 0);
  const auto s = scatter_of_lives(lives, t, 0, 0);
  for (auto& p : lives) p.T_min *= 60;
  const auto t60 = fit_taylor(lives, 0, 0);
  const auto s60 = scatter_of_lives(lives, t60, 0, 0);
  EXPECT_NEAR(t60.n->value, t.n->value, 1e-9);
  EXPECT_NEAR(t60.C->value, t.C->value * std::pow(60, t.n->value), 1e-5);
  EXPECT_NEAR(s60.T90_min.lower, 60 * s.T90_min.lower, 1e-6);
  EXPECT_NEAR(s60.weibull_shape, s.weibull_shape, 1e-7);
}

TEST(LifeFit, SaysWhatIsMissingWhereLivesAreCensored) {
  auto lives = tested(no_noise, kEver);
  for (auto& p : lives) p.longer = true;
  auto t = fit_taylor(lives, 0, 0);
  EXPECT_FALSE(t.n);
  EXPECT_EQ(t.missing.at(0).test, "tool lives that ended, at two cutting speeds");
  for (auto& p : lives) p.longer = p.vc_m_min != 190;
  EXPECT_EQ(fit_taylor(lives, 0, 0).missing.at(0).test,
            "a tool life at another cutting speed");
  for (std::size_t i = 0; i < lives.size(); ++i) lives[i].longer = i % 6 != 0;
  EXPECT_EQ(fit_taylor(lives, 0, 0).missing.at(0).test,
            "as many tool lives that ended as there are constants and one more: 5");
  for (auto& p : lives)
    p.longer = p.f_mm_rev == 0.4;  // no feed beside, of those that ended
  t = fit_taylor(lives, 0.35, 9);
  EXPECT_FALSE(t.a);
  EXPECT_EQ(t.missing.at(0).parameter, "a");
}

TEST(LifeFit, RefusesWhatIsNotPositive) {
  for (const double bad : {0.0, -5.0, std::nan(""), static_cast<double>(INFINITY)}) {
    auto lives = fourteen_edges();
    lives[1].T_min = bad;
    EXPECT_THROW(fit_taylor(lives, 0, 0), std::domain_error);
  }
}

// Of 300 trials 285 cover on average, with a standard deviation of 3.8.
TEST(LifeFit, IntervalsOfCensoredLivesCoverAsOftenAsTheySay) {
  std::mt19937 seed(11);
  std::normal_distribution<double> normal(0, 0.3);
  int C = 0, n = 0, a = 0, b = 0, T50 = 0, T90 = 0, between = 0, censored = 0, misfit = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto lives = tested([&] { return normal(seed); }, 300);
    censored += static_cast<int>(std::ranges::count(lives, true, &LifePoint::longer));
    const auto t = fit_taylor(lives, 0, 0);
    ASSERT_TRUE(t.n);
    C += within(*t.C, 450);
    n += within(*t.n, 0.255);
    a += within(*t.a, 0.35);
    b += within(*t.b, 0.15);
    const auto s = scatter_of_lives(lives, t, 0, 0);
    const double median = taylor_min(s.vc_m_min, s.f_mm_rev, s.ap_mm);
    T50 += within(s.T50_min, median);
    T90 += within(s.T90_min, median * std::exp(-1.2815516 * 0.3));
    between += within(*s.s_between, 0.3);
    misfit += *s.lack_of_fit_p < 0.05;
  }
  EXPECT_GT(censored, 300 * 6);  // a quarter of the 24
  for (const int covered : {C, n, a, b, T50, T90, between}) {
    EXPECT_GE(covered, 274);
    EXPECT_LE(covered, 297);
  }
  EXPECT_LE(misfit, 30);  // 15 expected
}

TEST(LifeFit, ChoosesTheDistributionThatMadeTheLives) {
  std::mt19937 seed(5);
  std::normal_distribution<double> normal(0, 0.3);
  std::exponential_distribution<double> exponential;
  int lognormal = 0, weibull = 0, T90 = 0;
  double shape = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<LifePoint> l, w;
    for (int k = 0; k < 4; ++k) {
      for (const auto& p : tested([&] { return normal(seed); }, kEver)) l.push_back(p);
      for (const auto& p :
           tested([&] { return 0.3 * std::log(exponential(seed)); }, kEver))
        w.push_back(p);
    }
    const FitOptions keep_all{.outlier_p = 0};
    const auto chosen = [&](const std::vector<LifePoint>& lives) {
      return scatter_of_lives(lives, fit_taylor(lives, 0, 0, keep_all), 0, 0, keep_all);
    };
    lognormal += chosen(l).distribution == LifeDistribution::lognormal;
    const auto s = chosen(w);
    weibull += s.distribution == LifeDistribution::weibull;
    shape += s.weibull_shape / kTrials;
    T90 += within(s.T90_min, taylor_min(s.vc_m_min, s.f_mm_rev, s.ap_mm) *
                                 std::pow(-std::log(0.9), 0.3));
  }
  EXPECT_GE(lognormal, 85);
  EXPECT_GE(weibull, 85);
  EXPECT_NEAR(shape, 1 / 0.3, 0.15);
  EXPECT_GE(T90, 88);
}

// A law with a bend in it: the means miss the line by what no scatter explains.
TEST(LifeFit, TellsLackOfFitFromScatter) {
  std::mt19937 seed(3);
  std::normal_distribution<double> normal(0, 0.05);
  auto lives = tested([&] { return normal(seed); }, kEver);
  for (auto& p : lives)
    if (p.vc_m_min == 190) p.T_min *= 1.5;
  const FitOptions keep_all{.outlier_p = 0};
  const auto s =
      scatter_of_lives(lives, fit_taylor(lives, 0, 0, keep_all), 0, 0, keep_all);
  EXPECT_NEAR(s.s_between->value, 0.05, 0.025);
  EXPECT_GT(*s.s_lack_of_fit, 0.1);
  EXPECT_LT(*s.lack_of_fit_p, 1e-3);
}

TEST(LifeFit, WithoutRepeatsTheScatterBetweenEdgesIsNotTold) {
  std::vector<LifePoint> lives;
  for (const double vc : {150.0, 200.0, 240.0, 270.0, 300.0})
    lives.push_back({vc, 0.2, 1, taylor_min(vc, 0.2, 1) * (1 + 0.03 * std::sin(vc))});
  const auto s = scatter_of_lives(lives, fit_taylor(lives, 0, 0), 0, 0);
  EXPECT_FALSE(s.s_between || s.s_lack_of_fit || s.lack_of_fit_p);
  EXPECT_LT(s.T90_min.value, s.T50_min.value);
}

}  // namespace
}  // namespace turnwright::cutting
