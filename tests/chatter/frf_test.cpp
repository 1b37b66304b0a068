#include "turnwright/chatter/frf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using units::kPi;

struct True {
  double f_Hz, zeta, k_N_mm;
};

/// Eq. (1) written with moduli and mass: 1/(k - m w^2 + i c w).
Complex receptance(const std::vector<True>& modes, double w) {
  Complex H = 0;
  for (const True& t : modes) {
    const double wn = 2 * kPi * t.f_Hz, m = t.k_N_mm / (wn * wn);
    H += 1.0 / Complex(t.k_N_mm - m * w * w, 2 * t.zeta * wn * m * w);
  }
  return H;
}

FrequencyResponse measured(const std::vector<True>& modes, double from_Hz, double to_Hz,
                           int lines, int derivative = 0) {
  FrequencyResponse r{.derivative = derivative, .w_rad_s = {}, .value = {}};
  for (int i = 0; i < lines; ++i) {
    const double w = 2 * kPi * (from_Hz + (to_Hz - from_Hz) * i / (lines - 1));
    r.w_rad_s.push_back(w);
    r.value.push_back(receptance(modes, w) * std::pow(Complex(0, w), derivative));
  }
  return r;
}

/// Errors of a normal distribution in both parts, as large at every line.
void add_noise(FrequencyResponse& r, double sigma, unsigned seed) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> error(0, sigma);
  for (Complex& y : r.value) y += Complex(error(bits), error(bits));
}

ModalFit fit(const FrequencyResponse& r, std::optional<int> modes = {}) {
  const auto out = modal_fit(r, modes);
  if (const auto* no = std::get_if<NoFit>(&out))
    throw std::runtime_error("no fit: " + std::to_string(static_cast<int>(no->why)) +
                             " at " + std::to_string(no->w_rad_s / (2 * kPi)) + " Hz");
  return std::get<ModalFit>(out);
}

NoFit::Why refused(const FrequencyResponse& r, std::optional<int> modes = {}) {
  return std::get<NoFit>(modal_fit(r, modes)).why;
}

void expect_same(const ModalFit& found, const std::vector<True>& modes,
                 double tolerance) {
  ASSERT_EQ(found.modes.size(), modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const FittedMode& m = found.modes[i];
    EXPECT_NEAR(m.wn_rad_s.value / (2 * kPi * modes[i].f_Hz), 1, tolerance);
    EXPECT_NEAR(m.zeta.value / modes[i].zeta, 1, tolerance);
    EXPECT_NEAR(m.k_N_mm.value / modes[i].k_N_mm, 1, tolerance);
  }
}

const std::vector<True> kOne{{922, 0.011, 1340}},
    kThree{{610, 0.03, 21000}, {940, 0.02, 9000}, {1720, 0.012, 40000}},
    kClose{{900, 0.02, 8000}, {915, 0.025, 12000}};

TEST(Frf, WithoutNoiseTheModesComeBack) {
  for (int derivative : {0, 1, 2}) {
    expect_same(fit(measured(kOne, 300, 2000, 200, derivative)), kOne, 1e-9);
    expect_same(fit(measured(kThree, 200, 2500, 400, derivative)), kThree, 1e-9);
  }
}

TEST(Frf, ModesCloserThanTheirWidthComeBack) {
  expect_same(fit(measured(kClose, 500, 1400, 300)), kClose, 1e-9);
  expect_same(fit(measured(kClose, 500, 1400, 300, 2), 2), kClose, 1e-9);
}

TEST(Frf, RandomModesComeBack) {
  std::mt19937_64 bits(11);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(bits);
  };
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<True> modes;
    double f = between(300, 500);
    for (int i = 0; i < 1 + trial % 5; ++i, f *= between(1.1, 1.5))
      modes.push_back({f, between(0.008, 0.04), std::exp(between(8, 11))});
    SCOPED_TRACE(trial);
    expect_same(fit(measured(modes, 150, 1.3 * f, 600)), modes, 1e-8);
  }
}

// Modes beyond the lines act as c and b.
TEST(Frf, WhatIsBeyondTheLinesIsTold) {
  std::vector<True> modes = kOne;
  modes.push_back({40000, 0.01, 25000});
  modes.push_back({2, 0.01, 2e-2});  // m = k/wn^2
  const ModalFit found = fit(measured(modes, 400, 2000, 400), 1);
  expect_same(found, kOne, 1e-4);
  EXPECT_NEAR(found.above_mm_N.value * 25000, 1, 2e-3);
  const double mass = 2e-2 / std::pow(2 * kPi * 2, 2);  // tonnes
  EXPECT_NEAR(found.below_mm_N_s2.value * mass, 1, 1e-3);
}

TEST(Frf, ReceptanceOfTheFitIsTheOneMeasured) {
  const FrequencyResponse r = measured(kThree, 200, 2500, 300);
  const ModalFit found = fit(r);
  for (std::size_t i = 0; i < r.w_rad_s.size(); ++i)
    EXPECT_LT(std::abs(receptance_mm_N(found, r.w_rad_s[i]) - r.value[i]),
              1e-9 * std::abs(r.value[i]));
  EXPECT_NEAR(found.explained, 1, 1e-12);
  EXPECT_LT(found.rms_left, 1e-9 * found.rms_measured);
}

// With normal errors 68.3 % of the values lie within their standard uncertainty; of the
// trials a share that a binomial distribution leaves by four standard deviations or less.
TEST(Frf, UncertaintiesCoverWithNoise) {
  constexpr int kTrials = 150;
  const std::vector<True> modes{{800, 0.03, 9000}, {1100, 0.025, 14000}};
  const FrequencyResponse clean = measured(modes, 400, 1600, 250);
  constexpr double kSigma = 4e-5;
  std::array<int, 8> within{};
  double left = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    FrequencyResponse noisy = clean;
    add_noise(noisy, kSigma, 1000 + static_cast<unsigned>(trial));
    const ModalFit found = fit(noisy, 2);
    const auto covered = [](const Measured& x, double truth) {
      return std::abs(x.value - truth) <= x.u ? 1 : 0;
    };
    for (std::size_t i = 0; i < 2; ++i) {
      const FittedMode& m = found.modes[i];
      within[3 * i] += covered(m.wn_rad_s, 2 * kPi * modes[i].f_Hz);
      within[3 * i + 1] += covered(m.zeta, modes[i].zeta);
      within[3 * i + 2] += covered(m.k_N_mm, modes[i].k_N_mm);
    }
    within[6] += covered(found.above_mm_N, 0);
    within[7] += covered(found.below_mm_N_s2, 0);
    left += found.rms_left / kTrials;
    EXPECT_LT(std::abs(found.correlation), 0.25);
  }
  const double spread = std::sqrt(kTrials * 0.683 * 0.317);
  for (const int count : within) EXPECT_NEAR(count, 0.683 * kTrials, 4 * spread);
  EXPECT_NEAR(left / (kSigma * std::sqrt(2.0)), 1, 0.03);  // both parts
}

// With few lines the mean of u^2 is the variance of the values: s^2 counts what is free.
TEST(Frf, FewLinesHaveTheUncertaintyTheyShow) {
  constexpr int kTrials = 400;
  const True mode{900, 0.04, 9000};
  const FrequencyResponse clean = measured({mode}, 830, 970, 7);
  double variance = 0, told = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    FrequencyResponse noisy = clean;
    add_noise(noisy, 2e-6, seed);
    const Measured wn = fit(noisy, 1).modes[0].wn_rad_s;
    variance += std::pow(wn.value - 2 * kPi * mode.f_Hz, 2) / kTrials;
    told += wn.u * wn.u / kTrials;
  }
  // 9 degrees of freedom of 14; both means are good to some 7 %.
  EXPECT_NEAR(told / variance, 1, 0.25);
}

// A mode whose share of the squares is 90 variances of the noise stands out; so large a
// gain noise alone has not.
TEST(Frf, AWeakModeIsFound) {
  const True weak{1500, 0.02, 4e5};
  const FrequencyResponse alone = measured({weak}, 300, 2000, 500);
  double squares = 0;
  for (const Complex& y : alone.value) squares += std::norm(y);
  FrequencyResponse both = measured({kOne[0], weak}, 300, 2000, 500);
  for (unsigned seed = 0; seed < 8; ++seed) {
    FrequencyResponse noisy = both;
    add_noise(noisy, std::sqrt(squares / 90), seed);
    const ModalFit found = fit(noisy);
    ASSERT_EQ(found.modes.size(), 2u) << seed;
    EXPECT_NEAR(found.modes[1].wn_rad_s.value / (2 * kPi), 1500, 30);
  }
}

// Two modes in one peak: as the noise rises they are refused, never told vaguely.
TEST(Frf, NothingVagueIsTold) {
  const FrequencyResponse pair =
      measured({{900, 0.02, 8000}, {908, 0.03, 8000}}, 700, 1100, 150);
  int told = 0, refused = 0;
  for (unsigned seed = 0; seed < 6; ++seed)
    for (const double sigma : {1e-6, 3e-6, 1e-5, 3e-5, 1e-4}) {
      FrequencyResponse noisy = pair;
      add_noise(noisy, sigma, seed);
      const auto out = modal_fit(noisy, 2);
      if (std::holds_alternative<NoFit>(out)) {
        ++refused;
        continue;
      }
      ++told;
      for (const FittedMode& m : std::get<ModalFit>(out).modes)
        for (const Measured& x : {m.wn_rad_s, m.zeta, m.k_N_mm})
          EXPECT_LE(x.u, 0.5 * x.value) << sigma << ' ' << seed;
    }
  EXPECT_GE(told, 6);
  EXPECT_GE(refused, 6);
}

TEST(Frf, TheNumberOfModesIsFoundInNoise) {
  FrequencyResponse r = measured(kThree, 200, 2500, 500);
  for (unsigned seed = 0; seed < 5; ++seed) {
    FrequencyResponse noisy = r;
    add_noise(noisy, 1e-5, seed);
    const ModalFit found = fit(noisy);
    ASSERT_EQ(found.modes.size(), 3u) << seed;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT(std::abs(found.modes[i].wn_rad_s.value - 2 * kPi * kThree[i].f_Hz),
                5 * found.modes[i].wn_rad_s.u);
  }
}

TEST(Frf, OneModeForTwoLeavesACorrelatedRest) {
  const ModalFit found = fit(measured(kThree, 400, 1300, 300), 1);
  EXPECT_GT(found.correlation, 0.8);
  EXPECT_LT(found.explained, 0.999);
}

TEST(Frf, UnitsOfTimeAndForceScale) {
  FrequencyResponse r = measured(kThree, 200, 2500, 300);
  add_noise(r, 1e-5, 3);
  const ModalFit found = fit(r, 3);
  for (double& w : r.w_rad_s) w *= 10;
  for (Complex& y : r.value) y /= 7;
  const ModalFit scaled = fit(r, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const FittedMode &a = found.modes[i], &b = scaled.modes[i];
    EXPECT_NEAR(b.wn_rad_s.value / a.wn_rad_s.value, 10, 1e-8);
    EXPECT_NEAR(b.zeta.value / a.zeta.value, 1, 1e-8);
    EXPECT_NEAR(b.k_N_mm.value / a.k_N_mm.value, 7, 1e-7);
    EXPECT_NEAR(b.k_N_mm.u / a.k_N_mm.u, 7, 1e-5);
  }
}

TEST(Frf, ChartOfTheFittedModesIsThatOfTheTrueOnes) {
  const auto tool = [](const std::vector<Mode>& modes) {
    const Engagement cut = down_milling(0.1);
    return System{.modes = modes,
                  .teeth = 2,
                  .entry_rad = cut.entry_rad,
                  .exit_rad = cut.exit_rad,
                  .force = LinearForce{.Kt_MPa = 600, .Kn_MPa = 200}};
  };
  std::vector<Mode> given, found;
  for (const True& t : kClose)
    given.push_back({Axis::x, 2 * kPi * t.f_Hz, t.zeta, t.k_N_mm});
  for (const FittedMode& m : fit(measured(kClose, 500, 1400, 300, 2)).modes)
    found.push_back({Axis::x, m.wn_rad_s.value, m.zeta.value, m.k_N_mm.value});
  for (const double n : {6000, 9000, 18000}) {
    const auto a = speed_limits(tool(given), n, 60), b = speed_limits(tool(found), n, 60);
    ASSERT_EQ(a.crossings.size(), b.crossings.size());
    ASSERT_FALSE(a.crossings.empty());
    for (std::size_t i = 0; i < a.crossings.size(); ++i)
      EXPECT_NEAR(b.crossings[i].ap_mm / a.crossings[i].ap_mm, 1, 1e-8);
  }
}

TEST(Frf, RefusesWhatIsNoMode) {
  using Why = NoFit::Why;
  const FrequencyResponse few = measured(kOne, 800, 1000, 4);
  EXPECT_EQ(refused(few), Why::too_few_lines);
  EXPECT_EQ(refused(measured(kThree, 200, 2500, 10), 3), Why::too_few_lines);
  EXPECT_EQ(refused(FrequencyResponse{}), Why::too_few_lines);

  FrequencyResponse noise = measured({}, 200, 2000, 200);
  EXPECT_EQ(refused(noise), Why::no_peak);  // nothing moves
  EXPECT_EQ(refused(measured({{1000, 0.9, 5000}}, 200, 2000, 200)), Why::no_peak);
  EXPECT_EQ(refused(measured({{5000, 0.02, 5000}}, 200, 2000, 200), 1), Why::no_peak);

  FrequencyResponse turned = measured(kOne, 300, 2000, 200);
  for (Complex& y : turned.value) y = -y;
  EXPECT_EQ(refused(turned), Why::negative);
  for (Complex& y : turned.value) y = -std::conj(y);
  EXPECT_EQ(refused(turned), Why::negative);
  const std::vector<True> cross{{600, 0.02, 8000}, {900, 0.02, -12000}};
  EXPECT_EQ(refused(measured(cross, 300, 1500, 300)), Why::negative);
  EXPECT_EQ(refused(measured(cross, 300, 1500, 300), 2), Why::negative);

  EXPECT_EQ(refused(measured(kOne, 300, 2000, 200), 2), Why::not_told);
}

/// Modes apart by more than their width.
std::vector<True> random_modes(int count, std::mt19937_64& bits) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(bits);
  };
  std::vector<True> modes;
  double f = between(300, 500);
  for (int i = 0; i < count; ++i, f *= between(1.15, 1.4))
    modes.push_back({f, between(0.01, 0.04), std::exp(between(8, 10.5))});
  return modes;
}

// Errors in proportion to the response are largest at the peaks.
TEST(Frf, ErrorsThatGrowWithTheResponseHideNoMode) {
  for (int trial = 0; trial < 15; ++trial) {
    SCOPED_TRACE(trial);
    std::mt19937_64 bits(100 + static_cast<unsigned>(trial));
    const auto modes = random_modes(1 + trial % 5, bits);
    const double sigma = trial % 2 == 0 ? 0.05 : 0.1;
    FrequencyResponse r = measured(modes, 150, 1.3 * modes.back().f_Hz, 400, trial % 3);
    std::normal_distribution<double> error(0, sigma / std::sqrt(2.0));
    for (Complex& y : r.value) y *= 1.0 + Complex(error(bits), error(bits));
    const ModalFit found = fit(r);
    EXPECT_LE(found.error_floor.value_or(1), 0.1);
    EXPECT_GT(found.explained, 1 - 4 * sigma * sigma);
    ASSERT_EQ(found.modes.size(), modes.size());
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const FittedMode& m = found.modes[i];
      EXPECT_NEAR(m.wn_rad_s.value, 2 * kPi * modes[i].f_Hz, 5 * m.wn_rad_s.u);
      EXPECT_NEAR(m.zeta.value, modes[i].zeta, 5 * m.zeta.u);
      EXPECT_NEAR(m.k_N_mm.value, modes[i].k_N_mm, 5 * m.k_N_mm.u);
      EXPECT_LT(m.k_N_mm.u, 0.1 * m.k_N_mm.value);
    }
  }
}

TEST(Frf, ErrorsAlikeAreToldAsSuch) {
  FrequencyResponse r = measured(kThree, 200, 2500, 500);
  add_noise(r, 1e-5, 1);
  EXPECT_FALSE(fit(r).error_floor.has_value());
}

double printed(double x, int digits) {
  const double step = std::pow(10, std::floor(std::log10(std::abs(x))) + 1 - digits);
  return x == 0 ? 0 : std::round(x / step) * step;
}

TEST(Frf, RoundingOfPrintedValuesIsNoMode) {
  for (int trial = 0; trial < 8; ++trial)
    for (const int digits : {3, 6}) {
      SCOPED_TRACE(testing::Message() << trial << ", digits " << digits);
      std::mt19937_64 bits(200 + static_cast<unsigned>(trial));
      const auto modes = random_modes(1 + trial % 5, bits);
      FrequencyResponse r = measured(modes, 150, 1.3 * modes.back().f_Hz, 400, trial % 3);
      for (Complex& y : r.value)
        y = {printed(y.real(), digits), printed(y.imag(), digits)};
      expect_same(fit(r), modes, 5 * std::pow(10, -digits));
    }
}

// A peak of 3e-4 of the other's moves no limit, whoever asks.
TEST(Frf, AModeTooLowToMatterIsLeftOut) {
  const std::vector<True> both{{900, 0.02, 8000}, {1500, 0.02, 2.7e7}};
  const FrequencyResponse r = measured(both, 300, 2000, 400);
  expect_same(fit(r), {both[0]}, 1e-9);
  EXPECT_EQ(refused(r, 2), NoFit::Why::not_told);
  const std::vector<True> higher{both[0], {1500, 0.02, 6e6}};
  expect_same(fit(measured(higher, 300, 2000, 400)), higher, 1e-9);
}

// A fit of fewer modes than there are may need one of negative stiffness at first.
TEST(Frf, CoarseLinesOfManyModes) {
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    std::mt19937_64 bits(300 + static_cast<unsigned>(trial));
    const auto modes = random_modes(5, bits);
    expect_same(fit(measured(modes, 150, 1.3 * modes.back().f_Hz, 60, trial % 3)), modes,
                1e-8);
  }
}

TEST(Frf, AnotherQuantityIsTold) {
  for (const int is : {0, 1, 2})
    for (const int named : {0, 1, 2}) {
      if (is == named) continue;
      SCOPED_TRACE(testing::Message() << is << " named " << named);
      for (const auto& modes : {kOne, kThree, kClose})
        for (const double sigma : {0.0, 0.02}) {
          FrequencyResponse r = measured(modes, 300, 2500, 120, is);
          double highest = 0;
          for (const Complex& y : r.value) highest = std::max(highest, std::abs(y));
          add_noise(r, sigma * highest, 5);
          r.derivative = named;
          const auto out = modal_fit(r);
          ASSERT_TRUE(std::holds_alternative<NoFit>(out));
          const NoFit& no = std::get<NoFit>(out);
          if (no.why == NoFit::Why::negative && sigma > 0) continue;  // noise hides which
          EXPECT_EQ(no.why, NoFit::Why::other_quantity);
          EXPECT_EQ(no.derivative, is);
        }
    }
}

// An impact test from 2 Hz on: at its lowest lines the accelerance is noise alone, whose
// receptance is far larger than the mode's.
TEST(Frf, NoiseAtTheLowestLinesDoesNotTurnTheSign) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    auto r = measured({{1200, 0.03, 20000}}, 2, 3200, 1600, 2);
    double sum = 0;
    for (const Complex& y : r.value) sum += std::norm(y);
    add_noise(r, 0.01 * std::sqrt(sum / 1600), seed);
    const auto f = fit(r);
    ASSERT_EQ(f.modes.size(), 1U) << seed;
    EXPECT_NEAR(f.modes[0].k_N_mm.value, 20000, 400) << seed;
    for (Complex& y : r.value) y = std::conj(y);
    EXPECT_EQ(std::get<NoFit>(modal_fit(r)).why, NoFit::Why::negative) << seed;
  }
}

TEST(Frf, AResponseAcrossAxesIsRefusedInNoiseToo) {
  const std::vector<True> cross{{600, 0.02, 8000}, {900, 0.02, -12000}};
  for (unsigned seed = 0; seed < 5; ++seed) {
    FrequencyResponse r = measured(cross, 300, 1500, 300);
    add_noise(r, 5e-5, seed);  // of a highest peak of 3e-3
    EXPECT_EQ(refused(r), NoFit::Why::negative);
  }
}

/// The highest hidden mode of the octave in which a frequency lies.
double hidden_share(const ModalFit& f, double from_Hz, double f_Hz) {
  double out = 0;
  for (const HiddenMode& m : f.hidden)
    if (std::abs(std::log2(m.wn_rad_s / (2 * kPi * f_Hz))) < 1)
      out = std::max(out, m.share);
  return f_Hz < from_Hz ? 0 : out;
}

// Of 1 to 6 modes, lines 1 to 5 Hz apart, 1 % of noise, the weak ones may be lost; then
// the fit tells that modes as high as they could be.
TEST(Frf, WhatNoiseMayHideIsBounded) {
  constexpr double kFrom = 50, kTo = 3000;
  const int responses = std::getenv("TURNWRIGHT_LONG_TESTS") ? 40 : 12;
  int lost = 0;
  for (const int derivative : {0, 2})
    for (int i = 0; i < responses; ++i) {
      SCOPED_TRACE(testing::Message() << "response " << i << " of " << derivative);
      std::mt19937 bits(500 + static_cast<unsigned>(i));
      const auto within = [&](double a, double b) {
        return std::uniform_real_distribution<>(a, b)(bits);
      };
      std::vector<True> modes;
      for (int k = 0; k <= i % 6; ++k)
        modes.push_back({within(150, 2500), within(0.01, 0.05),
                         std::exp(within(std::log(3e3), std::log(6e4)))});
      auto r = measured(modes, kFrom, kTo,
                        1 + static_cast<int>((kTo - kFrom) / within(1, 5)), derivative);
      double top = 0;
      for (const Complex& y : r.value) top = std::max(top, std::abs(y));
      add_noise(r, 0.01 * top / std::sqrt(2), static_cast<unsigned>(i));
      const auto out = modal_fit(r);
      const auto* found = std::get_if<ModalFit>(&out);
      if (!found) continue;  // refused is told
      double highest = 0;
      for (const FittedMode& m : found->modes)
        highest = std::max(highest, 1 / (2 * m.zeta.value * m.k_N_mm.value));
      for (const True& t : modes) {
        const bool is_found = std::ranges::any_of(found->modes, [&](const FittedMode& m) {
          return std::abs(std::log(m.wn_rad_s.value / (2 * kPi * t.f_Hz))) < 3 * t.zeta;
        });
        if (is_found) continue;
        ++lost;
        EXPECT_LE(1 / (2 * t.zeta * t.k_N_mm) / highest,
                  hidden_share(*found, kFrom, t.f_Hz))
            << t.f_Hz << " Hz";
      }
    }
  EXPECT_GE(lost, 3);
}

TEST(Frf, WithoutNoiseNothingIsHidden) {
  const ModalFit f = fit(measured(kThree, 50, 3000, 900));
  for (const HiddenMode& m : f.hidden) EXPECT_LT(m.share, 1e-6);
}

// Ten times the noise hides ten times the mode; a mode of accelerance four times the mode
// an octave below.
TEST(Frf, HiddenModesGrowWithTheNoise) {
  const auto hidden = [](double noise, int derivative) {
    auto r = measured(kOne, 50, 3000, 1200, derivative);
    add_noise(r, noise, 7);
    return fit(r, 1).hidden;
  };
  const auto once = hidden(1e-4, 0), ten = hidden(1e-3, 0);
  ASSERT_EQ(once.size(), ten.size());
  ASSERT_GE(once.size(), 5u);
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_NEAR(ten[i].share / once[i].share, 10, 0.5);
  const auto accelerance = hidden(1e3, 2);
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    const double fall = accelerance[i].share / accelerance[i + 1].share;
    EXPECT_GT(fall, 4);  // and more lines in the wider peak
    EXPECT_LT(fall, 8);
  }
}

// Both series times e^(-A t): the transform at i w + A, here written out of the modes.
TEST(Frf, TheWindowsDampingIsTakenOut) {
  constexpr double kA = 60;  // 1/s; the first mode has zeta wn = 91/s
  for (const int derivative : {0, 1, 2}) {
    FrequencyResponse r = measured(kThree, 200, 2500, 400, derivative);
    r.decay_1_s = kA;
    for (std::size_t i = 0; i < r.w_rad_s.size(); ++i) {
      const Complex s(kA, r.w_rad_s[i]);
      Complex H = 0;
      for (const True& t : kThree) {
        const double wn = 2 * kPi * t.f_Hz;
        H += wn * wn / t.k_N_mm / (s * s + 2 * t.zeta * wn * s + wn * wn);
      }
      r.value[i] = H * std::pow(Complex(0, r.w_rad_s[i]), derivative);
    }
    expect_same(fit(r), kThree, 1e-8);
  }
}

TEST(Frf, AModeThatOnlyTheWindowDampsIsNotTold) {
  FrequencyResponse r = measured(kOne, 300, 2000, 300);
  r.decay_1_s = 1.01 * kOne[0].zeta * 2 * kPi * kOne[0].f_Hz;
  EXPECT_EQ(refused(r), NoFit::Why::not_told);
}

TEST(Frf, GivenErrorsThatAreAlikeChangeNothing) {
  FrequencyResponse r = measured(kThree, 200, 2500, 400);
  add_noise(r, 1e-5, 4);
  const ModalFit without = fit(r);
  r.error.assign(r.value.size(), 0.7);
  const ModalFit with = fit(r);
  ASSERT_EQ(with.modes.size(), without.modes.size());
  for (std::size_t i = 0; i < with.modes.size(); ++i) {
    EXPECT_NEAR(with.modes[i].k_N_mm.value / without.modes[i].k_N_mm.value, 1, 1e-7);
    EXPECT_NEAR(with.modes[i].k_N_mm.u / without.modes[i].k_N_mm.u, 1, 1e-5);
  }
  EXPECT_NEAR(with.explained, without.explained, 1e-9);
}

// Lines that are all noise and said to be so: the others alone tell the modes, within the
// uncertainties told.
TEST(Frf, LinesOfLargeErrorsWeighLess) {
  FrequencyResponse r = measured(kThree, 200, 2500, 400);
  add_noise(r, 1e-6, 4);
  FrequencyResponse noise = measured({}, 200, 2500, 400);
  add_noise(noise, 1e-2, 5);
  for (std::size_t i = 0; i < r.value.size(); ++i) {
    const bool bad = i % 5 == 0;
    if (bad) r.value[i] += noise.value[i];
    r.error.push_back(bad ? 1e-2 : 1e-6);
  }
  const ModalFit found = fit(r);
  ASSERT_EQ(found.modes.size(), 3u);
  EXPECT_GT(found.explained, 0.99);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.modes[i].zeta.value, kThree[i].zeta, 5 * found.modes[i].zeta.u);
    EXPECT_LT(found.modes[i].zeta.u, 1e-2 * kThree[i].zeta);
  }
}

TEST(Frf, NoiseIsNoMode) {
  for (unsigned seed = 0; seed < 15; ++seed) {
    FrequencyResponse noise = measured({}, 200, 2000, 200);
    add_noise(noise, 1e-4, seed);
    EXPECT_TRUE(std::holds_alternative<NoFit>(modal_fit(noise))) << seed;
    EXPECT_TRUE(std::holds_alternative<NoFit>(modal_fit(noise, 1))) << seed;
    FrequencyResponse one = measured(kOne, 300, 2000, 200);
    add_noise(one, 1e-4, seed);
    EXPECT_TRUE(std::holds_alternative<NoFit>(modal_fit(one, 2))) << seed;
    EXPECT_EQ(fit(one).modes.size(), 1u) << seed;
  }
}

}  // namespace
}  // namespace turnwright::chatter
