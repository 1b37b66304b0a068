// Taps on simulated modes: half-sine pulses, the motion integrated exactly, noise on both.
#include "turnwright/chatter/tap_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "turnwright/chatter/coherence.hpp"

namespace turnwright::chatter::tap_test_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct True {
  double f_Hz, zeta, k_N_mm;
};
const std::vector<True> kTwo{{640, 0.03, 9000}, {1180, 0.02, 16000}};

struct Stroke {
  double at_s, peak_N, width_s = 0.4e-3;
};

/// Half sines.
double force_at(const std::vector<Stroke>& strokes, double t) {
  double out = 0;
  for (const Stroke& s : strokes)
    if (t > s.at_s && t < s.at_s + s.width_s)
      out += s.peak_N * std::sin(kPi * (t - s.at_s) / s.width_s);
  return out;
}

/// A mode under a force that is linear in each step: q'' + 2 zeta w q' + w^2 q = w^2/k F,
/// whose particular solution is a + b t, b = F'/k, a = (F - 2 zeta/w F')/k.
struct Oscillator {
  True mode;
  double q = 0, v = 0;
  double w() const { return 2 * kPi * mode.f_Hz; }
  double acceleration(double F) const {
    return w() * w() / mode.k_N_mm * F - 2 * mode.zeta * w() * v - w() * w() * q;
  }
  void step(double F, double slope, double h) {
    const double z = mode.zeta, W = w(), wd = W * std::sqrt(1 - z * z);
    const double b = slope / mode.k_N_mm, a = (F - 2 * z / W * slope) / mode.k_N_mm;
    const double A = q - a, B = (v - b + z * W * A) / wd;
    const double e = std::exp(-z * W * h), c = std::cos(wd * h), s = std::sin(wd * h);
    q = a + b * h + e * (A * c + B * s);
    v = b + e * (-z * W * (A * c + B * s) + wd * (B * c - A * s));
  }
};

/// Samples of force and of motion, the `derivative` of displacement.
TapRecord simulated(const std::vector<True>& modes, const std::vector<Stroke>& strokes,
                    double length_s, double step_s, int derivative = 2) {
  constexpr int kFine = 16;
  std::vector<Oscillator> all;
  for (const True& mode : modes) all.push_back({mode});
  TapRecord out;
  const double h = step_s / kFine;
  for (int i = 0; i * step_s < length_s; ++i) {
    const double t = i * step_s, F = force_at(strokes, t);
    double motion = 0;
    for (const Oscillator& o : all)
      motion += derivative == 0 ? o.q : derivative == 1 ? o.v : o.acceleration(F);
    out.force_N.push_back(F);
    out.motion.push_back(motion);
    for (int k = 0; k < kFine; ++k) {
      const double from = force_at(strokes, t + k * h),
                   to = force_at(strokes, t + (k + 1) * h);
      for (Oscillator& o : all) o.step(from, (to - from) / h, h);
    }
  }
  return out;
}

void add_noise(std::vector<double>& x, double share, unsigned seed) {
  std::mt19937_64 bits(seed);
  double top = 0;
  for (const double v : x) top = std::max(top, std::abs(v));
  std::normal_distribution<double> noise(0, share * top);
  for (double& v : x) v += noise(bits);
}

constexpr double kStep = 1 / 25600.0;

std::vector<Stroke> five() {
  return {{0.05, 300}, {0.47, 410}, {0.95, 250}, {1.38, 330}, {1.87, 290}};
}

/// The modes, with errors by the coherence.
ModalFit fitted(const TapTest& test, std::optional<int> modes = {}) {
  FrequencyResponse response = test.response;
  if (!test.coherence.empty())
    response.error = errors_by_coherence(response.value, test.coherence);
  const auto out = modal_fit(response, modes);
  EXPECT_TRUE(std::holds_alternative<ModalFit>(out));
  return std::holds_alternative<ModalFit>(out) ? std::get<ModalFit>(out) : ModalFit{};
}

void expect_modes(const ModalFit& found, const std::vector<True>& modes, double frequency,
                  double damping, double stiffness) {
  ASSERT_EQ(found.modes.size(), modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const FittedMode& m = found.modes[i];
    EXPECT_NEAR(m.wn_rad_s.value / (2 * kPi * modes[i].f_Hz), 1, frequency);
    EXPECT_NEAR(m.zeta.value / modes[i].zeta, 1, damping);
    EXPECT_NEAR(m.k_N_mm.value / modes[i].k_N_mm, 1, stiffness);
  }
}

// The bounds: frequencies within 0.1 %, damping within 5 %.
TEST(TapTest, ModesComeBackFromNoisyTaps) {
  for (const int derivative : {0, 1, 2})
    for (unsigned seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(testing::Message() << derivative << ' ' << seed);
      TapRecord r = simulated(kTwo, five(), 2.4, kStep, derivative);
      add_noise(r.force_N, 0.002, seed);
      add_noise(r.motion, 0.01, seed + 100);
      const TapTest test =
          tap_test(std::vector{r}, {.derivative = derivative, .step_s = kStep});
      ASSERT_EQ(test.taps.size(), 5U);
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(test.taps[i].fault, Tap::Fault::none);
        EXPECT_NEAR(test.taps[i].at_s, five()[i].at_s, 4 * kStep);
        EXPECT_NEAR(test.taps[i].peak_N, five()[i].peak_N, 0.05 * five()[i].peak_N);
      }
      ASSERT_EQ(test.coherence.size(), test.response.w_rad_s.size());
      expect_modes(fitted(test), kTwo, 1e-3, 0.05, 0.05);
    }
}

// Without noise what remains is sampling: neither window, however sharp, adds damping.
TEST(TapTest, WindowsAddNoDamping) {
  const TapRecord r = simulated(kTwo, five(), 2.4, kStep);
  for (const double left : {1.0, 0.1, 0.01, 1e-6}) {
    SCOPED_TRACE(left);
    const TapTest test = tap_test(std::vector{r}, {.step_s = kStep, .left = left});
    expect_modes(fitted(test, 2), kTwo, 3e-4, 0.01, 0.01);
    for (const double c : test.coherence) EXPECT_GT(c, 0.999);
  }
}

// The response at i w + A of the true modes, line by line.
TEST(TapTest, TheResponseIsThatOfTheModes) {
  const TapTest test =
      tap_test(std::vector{simulated(kTwo, five(), 2.4, kStep)}, {.step_s = kStep});
  ASSERT_GT(test.response.w_rad_s.size(), 200U);
  double most = 0, top = 0;
  for (std::size_t i = 0; i < test.response.w_rad_s.size(); ++i) {
    const std::complex<double> iw(0, test.response.w_rad_s[i]),
        s = iw + test.response.decay_1_s;
    std::complex<double> H = 0;
    for (const True& m : kTwo) {
      const double wn = 2 * kPi * m.f_Hz;
      H += wn * wn / m.k_N_mm / (s * s + 2 * m.zeta * wn * s + wn * wn);
    }
    most = std::max(most, std::abs(test.response.value[i] - iw * iw * H));
    top = std::max(top, std::abs(iw * iw * H));
  }
  EXPECT_LT(most, 1e-2 * top);
}

TEST(TapTest, AHammerThatPushesTheOtherWayTurnsTheSign) {
  TapRecord r = simulated(kTwo, five(), 2.4, kStep);
  const auto there = tap_test(std::vector{r}, {.step_s = kStep});
  for (double& F : r.force_N) F = 3 - F;  // and an offset
  const auto back = tap_test(std::vector{r}, {.step_s = kStep});
  ASSERT_EQ(back.response.value.size(), there.response.value.size());
  for (std::size_t i = 0; i < back.response.value.size(); ++i)
    EXPECT_NEAR(std::abs(back.response.value[i] + there.response.value[i]), 0,
                1e-9 * std::abs(there.response.value[i]) + 1e-9);
}

std::vector<Tap::Fault> faults(const TapTest& test) {
  std::vector<Tap::Fault> out;
  for (const Tap& tap : test.taps) out.push_back(tap.fault);
  return out;
}

TEST(TapTest, DoubleHitsCountNowhere) {
  using enum Tap::Fault;
  auto strokes = five();
  strokes.insert(strokes.begin() + 2, {0.482, 60});  // 12 ms behind the second
  TapRecord r = simulated(kTwo, strokes, 2.4, kStep);
  add_noise(r.motion, 0.005, 3);
  const TapTest test = tap_test(std::vector{r}, {.step_s = kStep});
  EXPECT_EQ(faults(test), (std::vector{none, double_hit, none, none, none}));
  EXPECT_NEAR(test.taps[1].again_s, 0.482, 4 * kStep);
  expect_modes(fitted(test), kTwo, 1e-3, 0.05, 0.05);
  // With a block as long as that, the third is no hit of its own either.
  EXPECT_EQ(faults(tap_test(std::vector{r}, {.step_s = kStep, .block_s = 0.5})),
            (std::vector{double_hit, double_hit, none}));
}

TEST(TapTest, OverloadAndCutOffTapsCountNowhere) {
  using enum Tap::Fault;
  auto strokes = five();
  strokes.push_back({2.37, 300});  // 30 ms before the end
  TapRecord r = simulated(kTwo, strokes, 2.4, kStep);
  for (double& F : r.force_N) F = std::min(F, 350.0);  // the second one alone
  const TapTest test = tap_test(std::vector{r}, {.step_s = kStep});
  EXPECT_EQ(faults(test), (std::vector{none, overload, none, none, none, cut_off}));
  EXPECT_NEAR(test.taps[1].again_s, 0.47, 0.4e-3);
  expect_modes(fitted(test, 2), kTwo, 1e-3, 0.02, 0.02);

  TapRecord s = simulated(kTwo, five(), 2.4, kStep);
  double top = 0;
  for (const double a : s.motion) top = std::max(top, std::abs(a));
  for (double& a : s.motion) a = std::clamp(a, -0.9 * top, 0.9 * top);
  EXPECT_EQ(faults(tap_test(std::vector{s}, {.step_s = kStep}))[1], overload);
}

// A smooth peak printed with few digits has equal samples too.
TEST(TapTest, RoundedPeaksAreNoOverload) {
  TapRecord r = simulated(kTwo, five(), 2.4, kStep);
  for (double& F : r.force_N) F = std::round(F);
  for (double& a : r.motion) a = std::round(a / 100) * 100;
  const TapTest test = tap_test(std::vector{r}, {.step_s = kStep});
  for (const Tap& tap : test.taps) EXPECT_EQ(tap.fault, Tap::Fault::none);
}

TEST(TapTest, ARecordForEachTapIsTheSame) {
  std::vector<TapRecord> all;
  for (int i = 0; i < 3; ++i) {
    all.push_back(simulated(kTwo, {{0.01, 200.0 + 50 * i}}, 0.3, kStep));
    all.back().from_s = 10 * i;
    add_noise(all.back().motion, 0.003, static_cast<unsigned>(i));
  }
  const TapTest test = tap_test(all, {.step_s = kStep});
  ASSERT_EQ(test.taps.size(), 3U);
  EXPECT_NEAR(test.taps[2].at_s, 20.01, 4 * kStep);
  expect_modes(fitted(test), kTwo, 1e-3, 0.05, 0.05);
}

// Noise behind a motion: 1/coherence - 1 is its power over that of the motion, both over
// taps alike.
TEST(TapTest, CoherenceFallsWithNoise) {
  const auto mean = [](double noise) {
    TapRecord r = simulated(kTwo, five(), 2.4, kStep);
    add_noise(r.motion, noise, 7);
    const TapTest test = tap_test(std::vector{r}, {.step_s = kStep});
    double sum = 0;
    for (const double c : test.coherence) {
      EXPECT_GE(c, 0);
      EXPECT_LE(c, 1);
      sum += c;
    }
    return sum / static_cast<double>(test.coherence.size());
  };
  const double quiet = mean(1e-4), loud = mean(0.03);
  EXPECT_GT(quiet, 0.99);
  EXPECT_LT(loud, quiet - 0.02);
}

TEST(TapTest, OneTapHasNoCoherence) {
  const TapTest test = tap_test(std::vector{simulated(kTwo, {{0.02, 300}}, 0.5, kStep)},
                                {.step_s = kStep});
  EXPECT_TRUE(test.coherence.empty());
  expect_modes(fitted(test, 2), kTwo, 3e-4, 0.01, 0.01);
}

TEST(TapTest, NoTapNoResponse) {
  TapRecord quiet{.from_s = 0,
                  .force_N = std::vector<double>(5000),
                  .motion = std::vector<double>(5000)};
  EXPECT_TRUE(tap_test(std::vector{quiet}, {.step_s = kStep}).taps.empty());
  std::mt19937_64 bits(1);
  std::normal_distribution<double> noise(0, 1);
  for (double& F : quiet.force_N) F = noise(bits);
  EXPECT_TRUE(tap_test(std::vector{quiet}, {.step_s = kStep}).taps.empty());
}

}  // namespace
}  // namespace turnwright::chatter::tap_test_test
