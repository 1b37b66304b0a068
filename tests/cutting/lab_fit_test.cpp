// Labs as a random sample, in fit_kienzle and fit_taylor.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "turnwright/cutting/life_fit.hpp"
#include "turnwright/cutting/material_fit.hpp"

namespace turnwright::cutting {
namespace {

using Random = std::function<double()>;

std::vector<ForcePoint> forces_of(const std::vector<double>& factors,
                                  const Random& noise) {
  std::vector<ForcePoint> cuts;
  for (std::size_t lab = 0; lab < factors.size(); ++lab)
    for (const double h : {0.08, 0.12, 0.2, 0.3})
      cuts.push_back({h, 1.5,
                      1600 * factors[lab] * 1.5 * std::pow(h, 0.75) * std::exp(noise()),
                      lab});
  return cuts;
}

std::vector<LifePoint> lives_of(const std::vector<double>& factors, const Random& noise) {
  std::vector<LifePoint> all;
  for (std::size_t lab = 0; lab < factors.size(); ++lab)
    for (const double vc : {150.0, 190.0, 240.0})
      for (const double f : {0.15, 0.4})
        all.push_back(
            {vc, f, 1,
             std::pow(450 * factors[lab] / (vc * std::pow(f, 0.35)), 1 / 0.255) *
                 std::exp(noise()),
             false, lab});
  return all;
}

double quiet() { return 0; }

bool includes(const Estimate& e, double truth) {
  return e.lower <= truth && truth <= e.upper;
}

TEST(LabFit, ExactCutsGiveTheFactors) {
  const std::vector<double> factors{1.1, 1 / 1.1, 1};  // of the mean 1
  const auto k = fit_kienzle(forces_of(factors, quiet));
  EXPECT_NEAR(k.k11_MPa->value, 1600, 1e-7);
  EXPECT_NEAR(k.m->value, 0.25, 1e-11);
  EXPECT_NEAR(k.m->upper, 0.25, 1e-9);
  const auto t = fit_taylor(lives_of(factors, quiet), 0, 0);
  EXPECT_NEAR(t.C->value, 450, 1e-6);
  EXPECT_NEAR(t.n->value, 0.255, 1e-10);
  EXPECT_NEAR(t.a->value, 0.35, 1e-10);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(k.labs->each.at(i).factor.value, factors[i], 1e-10);
    EXPECT_NEAR(t.labs->each.at(i).factor.value, factors[i], 1e-9);
    EXPECT_EQ(k.labs->each[i].lab, i);
    EXPECT_EQ(k.labs->each[i].measurements, 4u);
  }
  // of ln 1.1, -ln 1.1 and 0
  EXPECT_NEAR(k.labs->s_between, std::log(1.1), 1e-9);
  EXPECT_NEAR(t.labs->s_between, std::log(1.1) / 0.255, 1e-8);
}

TEST(LabFit, OneLabIsNoLab) {
  std::mt19937 seed(1);
  std::normal_distribution<double> normal(0, 0.05);
  auto cuts = forces_of({1}, [&] { return normal(seed); });
  auto lives = lives_of({1}, [&] { return normal(seed); });
  const auto k = fit_kienzle(cuts);
  const auto t = fit_taylor(lives, 0, 0.15);
  for (auto& c : cuts) c.lab = 7;
  for (auto& l : lives) l.lab = 7;
  EXPECT_EQ(fit_kienzle(cuts).k11_MPa->upper, k.k11_MPa->upper);
  EXPECT_EQ(fit_taylor(lives, 0, 0.15).C->upper, t.C->upper);
  EXPECT_FALSE(k.labs || t.labs);
}

// Chips of ln h = -1 and 1, so that k1.1 is at the middle; errors +-d cancel in each lab's
// mean a.
TEST(LabFit, ThreeLabsByHand) {
  const double d = 0.02;
  const std::vector<double> a{0.1, -0.05, -0.05};
  std::vector<ForcePoint> cuts;
  for (std::size_t lab = 0; lab < 3; ++lab)
    for (const double x : {-1.0, 1.0})
      for (const double e : {-d, d})
        cuts.push_back({std::exp(x), 1, std::exp(7 + a[lab] + e + x), lab});
  const auto k = fit_kienzle(cuts);
  // Slope 0.  Twelve residuals of d over 12 - 4 degrees; intercepts have the variance
  // s^2/4, those of the labs (0.1^2 + 2 0.05^2)/2 = 0.0075.
  const double s2 = 12 * d * d / 8;
  EXPECT_NEAR(k.m->value, 0, 1e-12);
  EXPECT_NEAR(k.evidence.s, std::sqrt(s2), 1e-12);
  EXPECT_EQ(k.evidence.degrees_of_freedom, 8);
  EXPECT_NEAR(k.labs->s_between, std::sqrt(0.0075 - s2 / 4), 1e-8);
  // t(0.975, 2) = 4.302653, t(0.975, 8) = 2.306004
  EXPECT_NEAR(std::log(k.k11_MPa->value), 7, 1e-12);
  EXPECT_NEAR(std::log(k.k11_MPa->upper) - 7, 4.302653 * std::sqrt(0.0075 / 3), 1e-6);
  const auto& lab = k.labs->each[0].factor;  // variance s^2/4 (1 - 1/3)
  EXPECT_NEAR(std::log(lab.value), 0.1, 1e-12);
  EXPECT_NEAR(std::log(lab.upper) - 0.1, 2.306004 * std::sqrt(s2 / 4 * 2 / 3), 1e-6);
  EXPECT_NEAR(k.evidence.s_prediction, std::sqrt(s2 + 0.0075 - s2 / 4 + 0.0075 / 3),
              1e-8);
}

TEST(LabFit, LabsThatAgreeHaveNoScatterBetween) {
  std::vector<ForcePoint> cuts;
  for (std::size_t lab = 0; lab < 3; ++lab)
    for (const double x : {-1.0, 1.0})
      for (const double e : {-0.02, 0.02})
        cuts.push_back({std::exp(x), 1, std::exp(7 + e + x), lab});
  const auto k = fit_kienzle(cuts);
  EXPECT_EQ(k.labs->s_between, 0);
  EXPECT_NEAR(k.labs->each[1].factor.value, 1, 1e-12);
}

// Of 300 trials 285 cover on average, with a standard deviation of 3.8.
TEST(LabFit, IntervalsCoverAsOftenAsTheySay) {
  std::mt19937 seed(9);
  std::normal_distribution<double> normal;
  int k11 = 0, m = 0, kc_factor = 0, C = 0, n = 0, C_factor = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> u;
    double mean = 0;
    for (int lab = 0; lab < 4; ++lab) {
      u.push_back(0.08 * normal(seed));
      mean += u.back() / 4;
    }
    std::vector<double> factors;
    for (const double each : u) factors.push_back(std::exp(each));
    const auto k = fit_kienzle(forces_of(factors, [&] { return 0.04 * normal(seed); }));
    k11 += includes(*k.k11_MPa, 1600);
    m += includes(*k.m, 0.25);
    kc_factor += includes(k.labs->each[1].factor, std::exp(u[1] - mean));
    const auto t =
        fit_taylor(lives_of(factors, [&] { return 0.2 * normal(seed); }), 0, 0.15);
    C += includes(*t.C, 450);
    n += includes(*t.n, 0.255);
    C_factor += includes(t.labs->each[2].factor, std::exp(u[2] - mean));
  }
  for (const int covered : {k11, m, kc_factor, C, n, C_factor}) {
    EXPECT_GE(covered, 274);
    EXPECT_LE(covered, 297);
  }
}

// Labs with one to eight cuts: never less than they say, at most a little more.
TEST(LabFit, PooledConstantOfUnevenLabsIsCovered) {
  std::mt19937 seed(3);
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<ForcePoint> cuts;
    for (std::size_t lab = 0; lab < 5; ++lab) {
      const double factor = std::exp(0.15 * normal(seed));
      const auto all = forces_of({factor, factor}, [&] { return 0.04 * normal(seed); });
      const std::size_t n = std::vector<std::size_t>{1, 8, 8, 3, 1}[lab];
      for (std::size_t i = 0; i < n; ++i) {
        cuts.push_back(all[i]);
        cuts.back().lab = lab;
      }
    }
    covered += includes(*fit_kienzle(cuts).k11_MPa, 1600);
  }
  EXPECT_GE(covered, 274);
}

TEST(LabFit, ALabWithOneCutHasAFactorOfItsOwn) {
  auto cuts = forces_of({1, 1.2}, quiet);
  cuts.resize(5);  // one of the second lab
  std::size_t i = 0;
  for (auto& c : cuts) c.F_N *= 1 + 0.01 * std::sin(5.0 * static_cast<double>(++i));
  const auto k = fit_kienzle(cuts);
  ASSERT_TRUE(k.m);
  EXPECT_EQ(k.labs->each[1].measurements, 1u);
  EXPECT_NEAR(k.labs->each[1].factor.value / k.labs->each[0].factor.value, 1.2, 0.05);
  EXPECT_TRUE(k.evidence.outliers.empty());
  cuts.resize(4);
  cuts[3].lab = 1;
  cuts[2].lab = 2;
  EXPECT_EQ(fit_kienzle(cuts).missing.at(0).test,
            "as many cuts as there are labs and two more");
}

TEST(LabFit, ChipsMustDifferWithinALab) {
  std::vector<ForcePoint> cuts;
  for (std::size_t lab = 0; lab < 2; ++lab)
    for (int k = 0; k < 3; ++k) cuts.push_back({lab == 0 ? 0.1 : 0.3, 1, 300, lab});
  EXPECT_EQ(fit_kienzle(cuts).missing.at(0).test,
            "a cut at another chip thickness (another feed) in the same lab");
}

TEST(LabFit, ALabWhoseEdgesAllLastedSaysNothing) {
  std::mt19937 seed(6);
  std::normal_distribution<double> normal(0, 0.1);
  auto lives = lives_of({1, 1.3}, [&] { return normal(seed); });
  const auto both = fit_taylor(lives, 0, 0.15);
  ASSERT_TRUE(both.labs);
  for (auto& l : lives) l.longer = l.lab == 1;
  const auto one = fit_taylor(lives, 0, 0.15);
  EXPECT_FALSE(one.labs);
  lives.resize(6);
  EXPECT_EQ(one.C->value, fit_taylor(lives, 0, 0.15).C->value);
  EXPECT_EQ(one.evidence.used.size(), 6u);
}

TEST(LabFit, CensoredLivesOfSeveralLabsKeepTheirFactors) {
  auto lives = lives_of({1.1, 1 / 1.1}, quiet);
  lives[3].longer = lives[8].longer = true;
  lives[3].T_min *= 0.5;
  lives[8].T_min *= 0.7;
  const auto t = fit_taylor(lives, 0, 0.15);
  EXPECT_NEAR(t.labs->each[0].factor.value, 1.1, 1e-7);
  EXPECT_NEAR(t.C->value, 450, 1e-4);
}

}  // namespace
}  // namespace turnwright::cutting
