#include "turnwright/chatter/speed_variation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "turnwright/base/errors.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

System turning(std::vector<Mode> modes) {
  System s;
  s.modes = std::move(modes);
  s.exit_rad = 2 * M_PI;
  s.force = ConstantForce{1000};
  return s;
}

const System kOneMode = turning({{Axis::x, 2 * M_PI * 150, 0.03, 5000}});
const System kTwoModes = turning(
    {{Axis::x, 2 * M_PI * 150, 0.03, 5000}, {Axis::x, 2 * M_PI * 240, 0.02, 9000}});

// Without amplitude it is the constant speed, whose limits are a closed form.
TEST(SpeedVariation, WithoutAmplitudeItIsTheConstantSpeed) {
  for (const System& system : {kOneMode, kTwoModes})
    for (const double n : {900.0, 1700.0, 3300.0})
      for (const double rvf : {0.2, 0.37, 1.0}) {
        const double expected = *speed_limits(system, n, 5).limit_mm();
        const auto found = varied_limit(system, n, {0, rvf}, 5);
        ASSERT_TRUE(found.limit_mm) << n;
        EXPECT_NEAR(*found.limit_mm / expected, 1, 1e-7) << n << ' ' << rvf;
        EXPECT_LE(std::abs(*found.limit_mm / expected - 1), found.relative_error);
      }
}

TEST(SpeedVariation, ASmallAmplitudeChangesLittle) {
  const double constant = *speed_limits(kOneMode, 1700, 5).limit_mm();
  double before = 1;
  for (const double rva : {1e-2, 1e-3, 1e-4}) {
    const double change =
        std::abs(*varied_limit(kOneMode, 1700, {rva, 0.25}, 5).limit_mm / constant - 1);
    EXPECT_LT(change, 0.2 * before) << rva;
    before = change;
  }
  EXPECT_LT(before, 1e-5);
}

/// Semi-discretisation of first order over time: the delayed displacement is constant over a
/// step, taken from the line between two earlier ones at the time that lies a revolution
/// back.  One mode.  Growth of the motion per revolution.
class Discretised {
 public:
  Discretised(const System& system, double n_rpm, SpeedVariation v, int steps_per_turn)
      : mode_(system.modes[0]),
        K_(std::get<ConstantForce>(system.force).K_MPa),
        n0_(n_rpm / 60),
        v_(v),
        h_(1 / (n0_ * steps_per_turn)) {
    per_period_ = static_cast<int>(std::lround(steps_per_turn / v.rvf));
    h_ = 1 / (n0_ * v.rvf * per_period_);
    for (int i = 0; i < per_period_; ++i) back_.push_back(delay_steps((i + 0.5) * h_));
  }

  double growth(double w) const {
    const double k = mode_.wn_rad_s * mode_.wn_rad_s, z = mode_.zeta * mode_.wn_rad_s;
    const double stiff = k * (1 + K_ * w / mode_.k_N_mm), b = std::sqrt(stiff - z * z);
    const double e = std::exp(-z * h_), c = std::cos(b * h_), s = std::sin(b * h_) / b;
    const double push = k * K_ * w / mode_.k_N_mm / stiff;  // static, of a delayed unit
    const int longest = static_cast<int>(*std::ranges::max_element(back_)) + 2;
    std::vector<double> x(static_cast<std::size_t>(longest) + 1);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::cos(0.07 * static_cast<double>(i));
    double velocity = 0, log_scale = 0, start = 0;
    constexpr int kSettle = 60, kMeasure = 240;
    for (int turn = 0; turn < kSettle + kMeasure; ++turn) {
      const std::size_t first = x.size();
      for (int i = 0; i < per_period_; ++i) {
        const double at =
            static_cast<double>(x.size()) - 0.5 - back_[static_cast<std::size_t>(i)];
        const auto j = static_cast<std::size_t>(at);
        const double delayed = x[j] + (at - static_cast<double>(j)) * (x[j + 1] - x[j]);
        const double rest = push * delayed, q = x.back() - rest;
        x.push_back(rest + e * ((c + z * s) * q + s * velocity));
        velocity = e * (-stiff * s * q + (c - z * s) * velocity);
      }
      double size = 0;
      for (std::size_t i = std::max(first, x.size() - static_cast<std::size_t>(longest));
           i < x.size(); ++i)
        size += x[i] * x[i];
      size = std::sqrt(size);
      x.erase(x.begin(), x.end() - longest - 1);
      for (double& value : x) value /= size;
      velocity /= size;
      log_scale += std::log(size);
      if (turn == kSettle - 1) start = log_scale;
    }
    return (log_scale - start) / kMeasure * v_.rvf;
  }

 private:
  /// Steps from a time back to where the spindle was a revolution earlier.
  double delay_steps(double t) const {
    const double w = 2 * M_PI * v_.rvf * n0_;
    const auto angle = [&](double s) {
      return n0_ * s + v_.rva * n0_ / w * (1 - std::cos(w * s));
    };
    double a = 0, b = 2 / (n0_ * (1 - v_.rva));
    for (int i = 0; i < 80; ++i) {
      const double m = (a + b) / 2;
      (angle(t) - angle(t - m) < 1 ? a : b) = m;
    }
    return a / h_;
  }

  Mode mode_;
  double K_, n0_;
  SpeedVariation v_;
  double h_;
  int per_period_ = 0;
  std::vector<double> back_;
};

TEST(SpeedVariation, AgreesWithSemiDiscretisation) {
  struct Swing {
    double n_rpm;
    SpeedVariation v;
  };
  for (const auto& [n, v] :
       {Swing{900, {0.1, 0.2}}, Swing{1700, {0.2, 0.3}}, Swing{1100, {0.3, 0.1}},
        Swing{2600, {0.15, 0.5}}, Swing{700, {0.25, 0.05}}}) {
    const auto found = varied_limit(kOneMode, n, v, 10);
    ASSERT_TRUE(found.limit_mm) << n;
    EXPECT_LT(found.relative_error, 1e-6) << n;
    const Discretised other(kOneMode, n, v, static_cast<int>(60 * 150 / n * 160));
    const double low = 0.995 * *found.limit_mm, high = 1.005 * *found.limit_mm;
    const double a = other.growth(low), b = other.growth(high);
    EXPECT_LT(a, 0) << n;
    EXPECT_GT(b, 0) << n;
    EXPECT_NEAR((low - a / (b - a) * (high - low)) / *found.limit_mm, 1, 1e-3) << n;
    for (const double share : {0.9, 1.1})
      EXPECT_NEAR(growth_per_revolution(kOneMode, n, v, share * *found.limit_mm, 12),
                  other.growth(share * *found.limit_mm), 1e-3)
          << n << ' ' << share;
  }
}

// Between two lobes the constant speed is best; at the foot of a lobe variation helps.
TEST(SpeedVariation, HelpsAtTheFootOfALobe) {
  double least = 1e9, at = 0;
  for (double n = 900; n < 1100; n += 2)
    if (const double w = speed_limits(kOneMode, n, 5).limit_mm().value_or(5); w < least) {
      least = w;
      at = n;
    }
  EXPECT_GT(*varied_limit(kOneMode, at, {0.3, 0.1}, 5).limit_mm, 1.2 * least);
}

// The small gain of (4) is below every limit.
TEST(SpeedVariation, NoLimitIsBelowTheSmallGain) {
  const double k = 5000, zeta = 0.03;
  for (const double rva : {0.05, 0.3, 0.6}) {
    const double gain = 2 * k * zeta * std::sqrt(1 - zeta * zeta) / 1000 /
                        (1 + std::sqrt((1 + rva) / (1 - rva)));
    for (const double n : {800.0, 1900.0}) {
      EXPECT_GT(*varied_limit(kOneMode, n, {rva, 0.2}, 10).limit_mm, gain);
      EXPECT_LT(growth_per_revolution(kOneMode, n, {rva, 0.2}, gain, 10), 0);
    }
  }
}

TEST(SpeedVariation, WhatIsStableUpToTheDepthHasNoLimit) {
  EXPECT_FALSE(varied_limit(kOneMode, 1700, {0.2, 0.2}, 0.1).limit_mm);
}

TEST(SpeedVariation, ScalesWithForceAndTime) {
  System other = kOneMode;
  other.force = ConstantForce{2000};
  other.modes[0].wn_rad_s *= 2;
  const SpeedVariation v{0.2, 0.3};
  EXPECT_NEAR(*varied_limit(other, 3400, v, 10).limit_mm * 2 /
                  *varied_limit(kOneMode, 1700, v, 10).limit_mm,
              1, 1e-8);
}

TEST(SpeedVariation, RefusesWhatTakesTooLong) {
  EXPECT_THROW(varied_limit(kOneMode, 1, {0.2, 0.01}, 10), ModelRangeError);
}

}  // namespace
}  // namespace turnwright::chatter
