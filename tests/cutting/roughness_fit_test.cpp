#include "turnwright/cutting/roughness_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

namespace turnwright::cutting {
namespace {

Cut edge_of(double re_mm, double hmin_mm) {
  Cut c;
  c.corner = corner_of(re_mm, 95 * std::numbers::pi / 180);
  c.hmin_mm = hmin_mm;
  return c;
}

std::vector<RoughnessPoint> turned(const Cut& c, const std::function<double()>& noise) {
  std::vector<RoughnessPoint> cuts;
  for (const double f : {0.05, 0.07, 0.1, 0.14, 0.2, 0.28})
    cuts.push_back(
        {.f_mm_rev = f, .Ra_um = Ra_um(c, f) * std::exp(noise()), .Rz_um = {}});
  return cuts;
}

double silent() { return 0; }

TEST(RoughnessFit, ExactRoughnessGivesTheLeastChip) {
  for (const double h : {0.0005, 0.002, 0.01})
    for (const double factor : {1.0, 0.5}) {
      Cut c = edge_of(0.8, h);
      c.surface_factor = factor;
      auto cuts = turned(c, silent);
      c.hmin_mm = 9;  // what the material had counts for nothing
      EXPECT_NEAR(fit_roughness(cuts, c).hmin_mm->value, h, 1e-8);
      for (auto& p : cuts) {
        p.Rz_um = *p.Ra_um * 18 * std::sqrt(3.0) / 8;
        p.Ra_um.reset();
      }
      const auto fit = fit_roughness(cuts, c);
      EXPECT_NEAR(fit.hmin_mm->value, h, 1e-8);
      EXPECT_NEAR(fit.hmin_mm->upper, h, 1e-7);
      EXPECT_FALSE(fit.below_corner);
    }
}

// At the ends S is 1 + t^2/(n - 1) times the least: t(0.975, 5) = 2.570582.
TEST(RoughnessFit, EndsOfTheIntervalAreThoseOfTheFTest) {
  std::mt19937 seed(2);
  std::normal_distribution<double> normal(0, 0.1);
  const auto cuts = turned(edge_of(0.4, 0.004), [&] { return normal(seed); });
  const auto fit = fit_roughness(cuts, edge_of(0.4, 0));
  const auto S = [&](double h) {
    double sum = 0;
    for (const auto& p : cuts) {
      const double f = p.f_mm_rev, Rt = f * f / 3.2 + h / 2 * (1 + 0.4 * h / (f * f));
      sum += std::pow(std::log(*p.Ra_um / (1000 * Rt * 8 / (18 * std::sqrt(3.0)))), 2);
    }
    return sum;
  };
  const double least = S(fit.hmin_mm->value),
               most = least * (1 + 2.570582 * 2.570582 / 5);
  EXPECT_NEAR(S(fit.hmin_mm->lower) / most, 1, 1e-6);
  EXPECT_NEAR(S(fit.hmin_mm->upper) / most, 1, 1e-6);
  EXPECT_NEAR(fit.evidence.s, std::sqrt(least / 5), 1e-12);
  for (double h = 0; h < 0.02; h += 1e-5) EXPECT_GE(S(h), least * (1 - 1e-12));
}

TEST(RoughnessFit, SmootherThanTheCornerIsNoLeastChip) {
  auto cuts = turned(edge_of(0.8, 0), silent);
  for (auto& p : cuts) *p.Ra_um *= 0.9 + 0.05 * p.f_mm_rev;
  const auto fit = fit_roughness(cuts, edge_of(0.8, 0));
  EXPECT_EQ(fit.hmin_mm->value, 0);
  EXPECT_EQ(fit.hmin_mm->lower, 0);
  EXPECT_TRUE(fit.below_corner);
  EXPECT_GT(fit.hmin_mm->upper, 0);
}

// Of 300 trials 285 cover on average, with a standard deviation of 3.8.
TEST(RoughnessFit, IntervalsCoverAsOftenAsTheySay) {
  std::mt19937 seed(4);
  std::normal_distribution<double> normal(0, 0.15);
  int covered = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto fit = fit_roughness(
        turned(edge_of(0.8, 0.002), [&] { return normal(seed); }), edge_of(0.8, 0));
    covered += fit.hmin_mm->lower <= 0.002 && 0.002 <= fit.hmin_mm->upper;
  }
  EXPECT_GE(covered, 274);
  EXPECT_LE(covered, 296);
}

TEST(RoughnessFit, TakesTwoCutsAndACorner) {
  auto cuts = turned(edge_of(0.8, 0.002), silent);
  cuts.resize(1);
  EXPECT_FALSE(fit_roughness(cuts, edge_of(0.8, 0)).hmin_mm);
  EXPECT_THROW(fit_roughness(cuts, edge_of(0, 0)), std::domain_error);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    auto slip = cuts;
    slip[0].Ra_um = bad;
    EXPECT_THROW(fit_roughness(slip, edge_of(0.8, 0)), std::domain_error);
    slip = cuts;
    slip[0].f_mm_rev = bad;
    EXPECT_THROW(fit_roughness(slip, edge_of(0.8, 0)), std::domain_error);
  }
  cuts[0].Ra_um.reset();
  EXPECT_THROW(fit_roughness(cuts, edge_of(0.8, 0)), std::domain_error);
}

}  // namespace
}  // namespace turnwright::cutting
