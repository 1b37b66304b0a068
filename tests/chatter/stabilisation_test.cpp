#include "turnwright/chatter/stabilisation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::chatter::stabilisation_test {
namespace {

using Complex = std::complex<double>;
using units::kPi;
using Stable = DiagramPole::Stable;

struct True {
  double f_Hz, zeta, k_N_mm;
};
using Modes = std::vector<True>;

/// 1/(k - m w^2 + i c w) summed, by the Laplace variable.
Complex receptance(const Modes& modes, Complex s) {
  Complex H = 0;
  for (const True& t : modes) {
    const double wn = 2 * kPi * t.f_Hz;
    H += wn * wn / t.k_N_mm / (s * s + 2 * t.zeta * wn * s + wn * wn);
  }
  return H;
}

FrequencyResponse measured(const Modes& modes, double from_Hz, double to_Hz, int lines,
                           int derivative = 0, double decay_1_s = 0) {
  FrequencyResponse r{.derivative = derivative, .w_rad_s = {}, .value = {}};
  r.decay_1_s = decay_1_s;
  for (int i = 0; i < lines; ++i) {
    const double w = 2 * kPi * (from_Hz + (to_Hz - from_Hz) * i / (lines - 1));
    r.w_rad_s.push_back(w);
    r.value.push_back(receptance(modes, {decay_1_s, w}) *
                      std::pow(Complex(0, w), derivative));
  }
  return r;
}

/// Flat noise, a share of the highest line.
void add_noise(FrequencyResponse& r, double share, unsigned seed) {
  double highest = 0;
  for (const Complex& y : r.value) highest = std::max(highest, std::abs(y));
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> error(0, share * highest / std::sqrt(2));
  for (Complex& y : r.value) y += Complex(error(bits), error(bits));
}

ModalFit fit(const FrequencyResponse& r, std::optional<int> modes = {}) {
  const auto out = modal_fit(r, modes);
  if (!std::holds_alternative<ModalFit>(out)) throw std::runtime_error("no fit");
  return std::get<ModalFit>(out);
}

unsigned trials(unsigned usual, unsigned many) {
  return std::getenv("TURNWRIGHT_LONG_TESTS") ? many : usual;
}

enum class Neighbours { near, apart };

/// 1 to 6 modes, apart by two half widths of both or anywhere; lines 1 to 5 Hz apart.
struct Random {
  Modes modes;
  FrequencyResponse response;
  Random(unsigned trial, int derivative, double noise, Neighbours neighbours) {
    std::mt19937 bits(900 + trial);
    const auto within = [&](double a, double b) {
      return std::uniform_real_distribution<>(a, b)(bits);
    };
    while (modes.size() <= trial % 6) {
      const double f = within(150, 2500), zeta = within(0.01, 0.05);
      const bool near = std::ranges::any_of(modes, [&](const True& t) {
        return std::abs(std::log(f / t.f_Hz)) < 2 * (zeta + t.zeta);
      });
      if (!near || neighbours == Neighbours::near)
        modes.push_back({f, zeta, std::exp(within(std::log(3e3), std::log(6e4)))});
    }
    response =
        measured(modes, 50, 3000, 1 + static_cast<int>(2950 / within(1, 5)), derivative);
    add_noise(response, noise, trial);
  }
};

const Modes kThree{{610, 0.03, 21000}, {940, 0.02, 9000}, {1720, 0.012, 40000}};

/// The least stable depth of a cut along the axis, to a factor, by a fine search.
double least_depth(const Modes& modes) {
  double least = 0;
  for (double f = 20; f < 4000; f += 0.25)
    least = std::min(least, receptance(modes, {0, 2 * kPi * f}).real());
  return -1 / least;
}

TEST(Stabilisation, WithoutNoiseThePolesAreTheModes) {
  for (const int derivative : {0, 1, 2}) {
    SCOPED_TRACE(derivative);
    const FrequencyResponse r = measured(kThree, 200, 2500, 500, derivative);
    const Stabilisation s = stabilisation(r, fit(r));
    ASSERT_EQ(s.orders.size(), 40U);
    const DiagramOrder& last = s.orders.back();
    EXPECT_EQ(last.order, 40);
    for (const True& t : kThree) {
      const auto pole = std::ranges::min_element(last.poles, {}, [&](const auto& p) {
        return std::abs(p.wn_rad_s - 2 * kPi * t.f_Hz);
      });
      EXPECT_NEAR(pole->wn_rad_s / (2 * kPi * t.f_Hz), 1, 1e-5);
      EXPECT_NEAR(pole->zeta / t.zeta, 1, 1e-3);
      EXPECT_LT(std::abs(pole->compliance_mm_N * t.k_N_mm - 1.0), 1e-3);
      EXPECT_EQ(pole->stable, Stable::all);
    }
    for (const SettledMode& m : s.modes) {
      EXPECT_LE(m.from_order.value_or(99), 10);
      EXPECT_GE(m.orders, 30);
    }
    EXPECT_TRUE(s.unfitted.empty());
  }
}

// Both poles of a pair are near the one mode that is asked.
TEST(Stabilisation, AnOrderCountsOnceForAMode) {
  const FrequencyResponse r =
      measured({{900, 0.003, 9000}, {908, 0.003, 9000}}, 700, 1100, 400);
  const Stabilisation s = stabilisation(r, fit(r, 1));
  const auto stable = [](const DiagramPole& p) { return p.stable == Stable::all; };
  ASSERT_EQ(std::ranges::count_if(s.orders.back().poles, stable), 2);
  const auto orders = std::ranges::count_if(
      s.orders, [&](const auto& o) { return std::ranges::any_of(o.poles, stable); });
  EXPECT_EQ(s.modes.at(0).orders, orders);
}

/// The mark of a pole by the definitions, and how many orders it has been stable.
std::pair<Stable, int> mark(const DiagramPole& p, const std::vector<DiagramPole>& below) {
  std::pair<Stable, int> out{Stable::no, 0};
  double nearest = 0.01;
  for (const DiagramPole& q : below) {
    const double apart = std::abs(std::log(p.wn_rad_s / q.wn_rad_s));
    if (apart > nearest) continue;
    nearest = apart;
    const bool damping = std::abs(p.zeta / q.zeta - 1) <= 0.05;
    const bool all =
        damping && std::abs(p.compliance_mm_N / q.compliance_mm_N - 1.0) <= 0.1;
    out.first = all ? Stable::all : damping ? Stable::damping : Stable::frequency;
    out.second = all ? q.in_a_row + 1 : 0;
  }
  return out;
}

TEST(Stabilisation, MarksFollowFromTheOrderBelow) {
  int marks[4] = {};
  for (const unsigned trial : {3U, 4U, 5U}) {
    const Random random(trial, 0, 0.03, Neighbours::near);
    const Stabilisation s = stabilisation(random.response, fit(random.response));
    for (std::size_t n = 1; n < s.orders.size(); ++n) {
      EXPECT_TRUE(std::ranges::is_sorted(s.orders[n].poles, {}, &DiagramPole::wn_rad_s));
      for (const DiagramPole& p : s.orders[n].poles) {
        ++marks[static_cast<int>(p.stable)];
        EXPECT_GT(p.zeta, 0);
        EXPECT_EQ(std::pair(p.stable, p.in_a_row), mark(p, s.orders[n - 1].poles));
      }
    }
  }
  for (const int count : marks) EXPECT_GT(count, 0);
}

// A model of rising order finds in noise another pole each time, and those that would grow
// are not told: so a mode alone stays alone.
TEST(Stabilisation, NoiseDoesNotSettle) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    FrequencyResponse r = measured({{922, 0.011, 1340}}, 300, 2000, 400, seed % 3);
    add_noise(r, 0.02, seed);
    const Stabilisation s = stabilisation(r, fit(r));
    EXPECT_TRUE(s.unfitted.empty());
    ASSERT_EQ(s.modes.size(), 1U);
    EXPECT_LE(s.modes[0].from_order.value_or(99), 15);
    EXPECT_FALSE(s.modes[0].depth_without.has_value());
  }
}

// Frequency 0.1 %, damping 5 %; where the lines do not hold as much, four standard
// uncertainties, which are the Cramer-Rao bound of the fit.
TEST(Stabilisation, ModesThatSettleAreModes) {
  int settled = 0, known = 0;
  for (const int derivative : {0, 2})
    for (unsigned trial = 0; trial < trials(12, 60); ++trial) {
      SCOPED_TRACE(testing::Message() << "response " << trial << " of " << derivative);
      const Random random(trial, derivative, 0.01, Neighbours::apart);
      const ModalFit found = fit(random.response);
      const Stabilisation s = stabilisation(random.response, found);
      ASSERT_EQ(s.modes.size(), found.modes.size());
      EXPECT_TRUE(s.unfitted.empty());
      for (std::size_t i = 0; i < found.modes.size(); ++i) {
        if (!s.modes[i].from_order) continue;
        ++settled;
        const FittedMode& m = found.modes[i];
        const True t = *std::ranges::min_element(random.modes, {}, [&](const True& x) {
          return std::abs(x.f_Hz - m.wn_rad_s.value / (2 * kPi));
        });
        const double wn = 2 * kPi * t.f_Hz;
        EXPECT_NEAR(m.wn_rad_s.value, wn, std::max(1e-3 * wn, 4 * m.wn_rad_s.u));
        EXPECT_NEAR(m.zeta.value, t.zeta, std::max(0.05 * t.zeta, 4 * m.zeta.u));
        if (4 * m.wn_rad_s.u < 1e-3 * wn && 4 * m.zeta.u < 0.05 * t.zeta) ++known;
      }
    }
  EXPECT_GE(settled, 50);
  EXPECT_GE(known, 25);
}

// Asked for one mode of three, the fit tells one; the others settle all the same.
TEST(Stabilisation, AModeThatTheFitLeavesOutIsTold) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    FrequencyResponse r = measured(kThree, 200, 2500, 500, seed % 3);
    add_noise(r, 0.005, seed);
    const ModalFit found = fit(r, 1);
    const FittedMode& one = found.modes[0];
    const True told{one.wn_rad_s.value / (2 * kPi), one.zeta.value, one.k_N_mm.value};
    const Stabilisation s = stabilisation(r, found);
    ASSERT_EQ(s.unfitted.size(), 2U) << seed;
    for (const UnfittedMode& u : s.unfitted) {
      const True t = *std::ranges::min_element(kThree, {}, [&](const True& x) {
        return std::abs(x.f_Hz - u.wn_rad_s / (2 * kPi));
      });
      EXPECT_NEAR(u.wn_rad_s / (2 * kPi * t.f_Hz), 1, 0.01);
      EXPECT_NEAR(u.k_N_mm / t.k_N_mm, 1, 0.2);
      EXPECT_GE(u.to_order - u.from_order, 4);
      EXPECT_NEAR(u.depth_with, least_depth({told, t}) / least_depth({told}), 0.02);
    }
  }
}

// 1 % of noise: what is lost or taken for one mode makes the least depth too large by less
// than a twentieth, or `hidden` tells that it may.
TEST(Stabilisation, WhatIsLostInNoiseIsTold) {
  int lost = 0;
  for (const int derivative : {0, 2})
    for (unsigned trial = 0; trial < trials(12, 60); ++trial) {
      SCOPED_TRACE(testing::Message() << "response " << trial << " of " << derivative);
      const Random random(trial, derivative, 0.01, Neighbours::near);
      const ModalFit found = fit(random.response);
      Modes told;
      for (const FittedMode& m : found.modes)
        told.push_back({m.wn_rad_s.value / (2 * kPi), m.zeta.value, m.k_N_mm.value});
      if (told.size() < random.modes.size()) ++lost;
      const bool warned = std::ranges::any_of(
          found.hidden, [](const HiddenMode& m) { return m.share > 0.1; });
      EXPECT_TRUE(warned || least_depth(told) < 1.05 * least_depth(random.modes));
    }
  EXPECT_GE(lost, 3);
}

TEST(Stabilisation, WhatAModeDoesToTheLeastDepth) {
  const Modes two{{500, 0.03, 9000}, {620, 0.02, 12000}};
  const FrequencyResponse r = measured(two, 200, 1500, 400);
  const Stabilisation s = stabilisation(r, fit(r));
  const double both = least_depth(two);
  EXPECT_NEAR(*s.modes[0].depth_without, least_depth({two[1]}) / both, 2e-3);
  EXPECT_NEAR(*s.modes[1].depth_without, least_depth({two[0]}) / both, 2e-3);
}

TEST(Stabilisation, TheWindowsDampingIsTakenOut) {
  const FrequencyResponse r = measured(kThree, 200, 2500, 500, 2, 60);
  const Stabilisation s = stabilisation(r, fit(r));
  const auto& poles = s.orders.back().poles;
  for (const True& t : kThree) {
    const auto pole = std::ranges::min_element(poles, {}, [&](const auto& p) {
      return std::abs(p.wn_rad_s - 2 * kPi * t.f_Hz);
    });
    EXPECT_NEAR(pole->zeta / t.zeta, 1, 1e-3);
    EXPECT_LT(std::abs(pole->compliance_mm_N * t.k_N_mm - 1.0), 1e-3);
  }
}

TEST(Stabilisation, UnitsOfTimeAndForceScale) {
  FrequencyResponse r = measured(kThree, 200, 2500, 300);
  add_noise(r, 0.01, 3);
  const ModalFit found = fit(r, 3);
  const Stabilisation s = stabilisation(r, found);
  for (double& w : r.w_rad_s) w *= 10;
  for (Complex& y : r.value) y /= 7;
  const Stabilisation scaled = stabilisation(r, fit(r, 3));
  for (std::size_t n = 0; n < 20; ++n) {
    const auto &a = s.orders[n].poles, &b = scaled.orders[n].poles;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(b[i].wn_rad_s / a[i].wn_rad_s, 10, 1e-6);
      EXPECT_NEAR(b[i].zeta / a[i].zeta, 1, 1e-6);
      EXPECT_LT(std::abs(7.0 * b[i].compliance_mm_N / a[i].compliance_mm_N - 1.0), 1e-6);
    }
  }
}

// Errors that grow with the response are largest at its peaks.
TEST(Stabilisation, ErrorsThatGrowWithTheResponseDoNotSettle) {
  for (unsigned trial = 0; trial < 12; ++trial) {
    Random random(trial, 2, 0, Neighbours::near);
    std::mt19937_64 bits(trial);
    std::normal_distribution<double> error(0, 0.1 / std::sqrt(2));
    for (Complex& y : random.response.value) y *= 1.0 + Complex(error(bits), error(bits));
    const ModalFit found = fit(random.response);
    EXPECT_TRUE(stabilisation(random.response, found).unfitted.empty()) << trial;
  }
}

// Every fifth line is noise alone, and is said to be.
TEST(Stabilisation, LinesOfLargeErrorsWeighLess) {
  FrequencyResponse r = measured(kThree, 200, 2500, 400);
  add_noise(r, 1e-3, 4);
  std::mt19937_64 bits(5);
  std::normal_distribution<double> error(0, 1e-2);  // of a highest line of 3e-3
  for (std::size_t i = 0; i < r.value.size(); ++i) {
    const bool bad = i % 5 == 0;
    if (bad) r.value[i] += Complex(error(bits), error(bits));
    r.error.push_back(bad ? 1e-2 : 3e-6);
  }
  for (const SettledMode& m : stabilisation(r, fit(r)).modes)
    EXPECT_LE(m.from_order.value_or(99), 15);
}

TEST(Stabilisation, FewLinesHaveFewOrders) {
  const FrequencyResponse r = measured({{900, 0.04, 9000}}, 830, 970, 7);
  const Stabilisation s = stabilisation(r, fit(r, 1));
  EXPECT_EQ(s.orders.size(), 2U);
  EXPECT_FALSE(s.modes[0].from_order.has_value());
}

}  // namespace
}  // namespace turnwright::chatter::stabilisation_test
