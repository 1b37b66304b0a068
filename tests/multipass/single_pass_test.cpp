#include "turnwright/multipass/single_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace turnwright::multipass {
namespace {

// Ermer's constants as the literature repeats them: V in ft/min, f in in/rev.
SinglePass ermer(bool with_power) {
  SinglePass m{.cost = {{1.25664, -1, -1}, {1.7991e-8, 3, 0.16}},
               .limits = {},
               .V = {1, 1000},
               .f = {1e-4, 0.005}};
  if (with_power) m.limits.push_back({"power", {3.58, 0.91, 0.78}, 10, true});
  return m;
}

TEST(SinglePass, EqualsErmersOptima) {
  const auto plain = optimum(ermer(false));
  EXPECT_NEAR(*plain.UC, 1.03782, 5e-6);
  EXPECT_NEAR(plain.V, 322.89, 5e-3);
  // f at its limit; V by dUC/dV = 0: V^4 = 1.25664/(3 1.7991e-8 f^1.16)
  EXPECT_NEAR(plain.V, std::pow(1.25664 / (3 * 1.7991e-8 * std::pow(0.005, 1.16)), 0.25),
              1e-3);
  EXPECT_LE(plain.gap, 1e-9);

  const auto bound = optimum(ermer(true));
  EXPECT_NEAR(*bound.UC, 1.05451, 5e-6);
  EXPECT_NEAR(bound.V, 290.10, 5e-3);
  EXPECT_NEAR(bound.V, std::pow(10 / (3.58 * std::pow(0.005, 0.78)), 1 / 0.91), 1e-5);
  ASSERT_EQ(bound.limits.size(), 5u);
  EXPECT_TRUE(bound.limits[4].binding);
  EXPECT_EQ(bound.limits[4].name, "power");
  EXPECT_NEAR(bound.limits[4].value, 10, 1e-7);
}

TEST(SinglePass, NothingOnADenseGridIsCheaper) {
  std::mt19937 seed(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int solved = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SinglePass m{.cost = {}, .limits = {}, .V = {50, 400}, .f = {0.05, 0.8}};
    const auto law = [&] {
      PowerLaw x{0, 3 * unit(seed), 2 * unit(seed)};
      x.c = std::exp(unit(seed)) / (std::pow(140, x.V) * std::pow(0.2, x.f));
      return x;
    };
    for (int k = 0; k < 3; ++k) m.cost.push_back(law());
    for (int k = 0; k < 3; ++k)
      m.limits.push_back({std::string(1, static_cast<char>('a' + k)), law(), 1, k != 1});
    const auto value = [](const PowerLaw& x, double V, double f) {
      return x.c * std::pow(V, x.V) * std::pow(f, x.f);
    };
    double best = 1e99;
    for (int i = 0; i <= 150; ++i)
      for (int j = 0; j <= 150; ++j) {
        const double V = 50 * std::pow(8, i / 150.0), f = 0.05 * std::pow(16, j / 150.0);
        double cost = 0;
        for (const auto& x : m.cost) cost += value(x, V, f);
        const bool kept = std::ranges::all_of(m.limits, [&](const PowerLimit& l) {
          const double y = value(l.law, V, f);
          return l.upper ? y <= l.limit : y >= l.limit;
        });
        if (kept) best = std::min(best, cost);
      }
    const auto a = optimum(m);
    if (!a.UC) {
      EXPECT_EQ(best, 1e99);
      EXPECT_FALSE(a.conflict.empty());
      continue;
    }
    ++solved;
    EXPECT_LE(a.gap, 1e-8);
    EXPECT_LE(*a.UC, best * (1 + 1e-9));
    if (best < 1e99) {
      EXPECT_GE(*a.UC, best * 0.8);
    }
  }
  EXPECT_GT(solved, 20);
}

TEST(SinglePass, NamesWhatConflicts) {
  auto m = ermer(true);
  m.limits[0].limit = 1e-6;
  const auto a = optimum(m);
  EXPECT_FALSE(a.UC);
  EXPECT_EQ(a.conflict, (std::vector<std::string>{"V_min", "f_min", "power"}));
}

TEST(SinglePass, RefusesNumbersOutOfRange) {
  auto m = ermer(false);
  m.cost[0].c = 0;
  EXPECT_THROW(optimum(m), std::domain_error);
  m = ermer(false);
  m.f = {0.1, 0.01};
  EXPECT_THROW(optimum(m), std::domain_error);
  m = ermer(false);
  m.cost.clear();
  EXPECT_THROW(optimum(m), std::domain_error);
}

}  // namespace
}  // namespace turnwright::multipass
