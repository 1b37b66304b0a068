#include "turnwright/chatter/sound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/random.hpp"

namespace turnwright::chatter {
namespace {

/// A cut that is heard: harmonics of the spindle, those of the teeth stronger, noise.
struct Cut {
  double n_rpm = 6000;
  int teeth = 4;
  double noise = 0.02, seconds = 1.2, rate_Hz = 16000;
  double chatter_Hz = 0, chatter = 0;
  int only = 0;  ///< order of the only harmonic; 0: all
};

Sound sound_of(const Cut& cut, std::uint64_t seed) {
  std::uint64_t k = 0;
  const auto uniform = [&] { return uniform_draw(splitmix64(seed, k++)); };
  Sound out{cut.rate_Hz, {}};
  out.value.resize(static_cast<std::size_t>(cut.seconds * cut.rate_Hz));
  const auto add = [&](double f_Hz, double amplitude) {
    const double phase = 2 * M_PI * uniform();
    for (std::size_t i = 0; i < out.value.size(); ++i)
      out.value[i] +=
          amplitude *
          std::sin(2 * M_PI * f_Hz * static_cast<double>(i) / cut.rate_Hz + phase);
  };
  for (int j = 1; j <= 40 && j * cut.n_rpm / 60 < cut.rate_Hz / 2; ++j) {
    if (cut.only > 0 && j != cut.only) continue;
    const bool tooth = j % cut.teeth == 0;
    add(j * cut.n_rpm / 60, (tooth ? 1 : 0.15) * uniform() / (1 + 0.1 * j));
  }
  if (cut.chatter > 0) add(cut.chatter_Hz, cut.chatter);
  for (double& x : out.value) {
    const double u = uniform(), w = uniform();
    x += cut.noise * normal_draw(u, w);
  }
  return out;
}

/// A frequency in [300, 5000] Hz that is a quarter of a turn's off harmonics at least.
double between_harmonics(double n_rpm, std::uint64_t seed) {
  const double turn = n_rpm / 60;
  const double f = 300 + 4700 * uniform_draw(splitmix64(seed + 999, 0));
  return (std::floor(f / turn) + 0.25 + 0.5 * uniform_draw(splitmix64(seed + 999, 1))) *
         turn;
}

TEST(Sound, ChatterIsHeardAtItsFrequency) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Cut cut;
    cut.n_rpm = 2000 + 14000 * uniform_draw(splitmix64(seed, 7777));
    cut.teeth = 1 + static_cast<int>(seed % 6);
    cut.noise = seed % 2 == 0 ? 0.02 : 0.3;
    cut.chatter_Hz = between_harmonics(cut.n_rpm, seed);
    cut.chatter = 0.3;
    const double stated =
        cut.n_rpm * (1 + 0.008 * (uniform_draw(splitmix64(seed, 8888)) - 0.5));
    const auto heard =
        listen(sound_of(cut, seed), {.n_rpm = stated, .teeth = cut.teeth, .to_Hz = {}});
    ASSERT_TRUE(heard.chatter) << seed;
    EXPECT_NEAR(heard.chatter->frequency_Hz / cut.chatter_Hz, 1, 1e-3) << seed;
    EXPECT_NEAR(heard.chatter->amplitude, 0.3, 0.06) << seed;
    EXPECT_NEAR(heard.n_rpm / cut.n_rpm, 1, 1e-3) << seed;
  }
}

/// Without what lies above 0.45 of the rate, as behind a filter against aliases: the mean
/// square falls by 60 dB up to half the rate.
Sound filtered(const Sound& sound) {
  constexpr int kHalf = 200;
  Sound out{sound.rate_Hz, std::vector<double>(sound.value.size())};
  std::vector<double> taps;
  for (int k = -kHalf; k <= kHalf; ++k) {
    const double x = 2 * M_PI * 0.46 * k,
                 window = std::pow(std::cos(M_PI * k / (2.0 * kHalf + 2)), 2);
    taps.push_back((k == 0 ? 2 * 0.46 : std::sin(x) / (M_PI * k)) * window);
  }
  for (std::size_t i = 0; i < out.value.size(); ++i)
    for (std::size_t k = 0; k < taps.size(); ++k)
      if (i + k >= kHalf && i + k - kHalf < sound.value.size())
        out.value[i] += taps[k] * sound.value[i + k - kHalf];
  return out;
}

// Up to four lines of resolution below half the rate.
TEST(Sound, ChatterIsHeardUpToHalfTheRate) {
  for (const double share : {0.4313, 0.4513, 0.4688, 0.4813, 0.4938, 0.4963})
    for (const bool behind_filter : {false, true}) {
      if (behind_filter && share > 0.46) continue;
      SCOPED_TRACE(share);
      Cut cut;
      cut.rate_Hz = 8000;
      cut.seconds = 2;
      cut.chatter_Hz = share * cut.rate_Hz;
      cut.chatter = 0.5;
      const Sound sound = sound_of(cut, 9);
      const auto heard = listen(behind_filter ? filtered(sound) : sound,
                                {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
      ASSERT_TRUE(heard.chatter.has_value());
      EXPECT_NEAR(heard.chatter->frequency_Hz / cut.chatter_Hz, 1, 1e-3);
      EXPECT_NEAR(heard.chatter->amplitude, 0.5, 0.1);
      EXPECT_NEAR(heard.to_Hz, 4000 - 4 * heard.resolution_Hz, 1e-9);
    }
}

// One early harmonic says too little of the speed to tell what stands out far above it from
// another.
TEST(Sound, ChatterFarAboveTheOnlyHarmonicIsHeard) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Cut cut{.teeth = 2, .only = 2};
    cut.chatter_Hz = 3 * between_harmonics(cut.n_rpm, seed) / 2;
    const double turn = cut.n_rpm / 60;
    if (std::abs(std::remainder(cut.chatter_Hz, turn)) < 0.15 * turn) continue;
    cut.chatter = 0.3;
    const auto heard = listen(sound_of(cut, seed),
                              {.n_rpm = cut.n_rpm, .teeth = cut.teeth, .to_Hz = {}});
    ASSERT_TRUE(heard.chatter) << seed << ' ' << cut.chatter_Hz;
    EXPECT_NEAR(heard.chatter->frequency_Hz, cut.chatter_Hz, 0.5) << seed;
  }
}

TEST(Sound, NoiseBehindAFilterIsNoChatter) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Sound noise{8000, {}};
    for (std::uint64_t i = 0; i < 16000; ++i)
      noise.value.push_back(normal_draw(uniform_draw(splitmix64(seed, 2 * i)),
                                        uniform_draw(splitmix64(seed, 2 * i + 1))));
    const auto heard = listen(filtered(noise), {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
    EXPECT_FALSE(heard.chatter.has_value()) << seed;
    EXPECT_TRUE(heard.others.empty()) << seed;
  }
}

TEST(Sound, HarmonicsAloneAreNoChatter) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Cut cut;
    cut.n_rpm = 1000 + 15000 * uniform_draw(splitmix64(seed, 7777));
    cut.teeth = 1 + static_cast<int>(seed % 6);
    cut.noise = std::pow(10, -4 + 4 * uniform_draw(splitmix64(seed, 6666)));
    const double stated =
        cut.n_rpm * (1 + 0.008 * (uniform_draw(splitmix64(seed, 8888)) - 0.5));
    const auto heard =
        listen(sound_of(cut, seed), {.n_rpm = stated, .teeth = cut.teeth, .to_Hz = {}});
    EXPECT_FALSE(heard.chatter)
        << seed << ' ' << heard.chatter->frequency_Hz << " Hz at " << cut.n_rpm;
  }
}

TEST(Sound, NoiseAloneIsNoChatter) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Sound noise{8000, {}};
    for (std::uint64_t k = 0; k < 16000; k += 2)
      noise.value.push_back(normal_draw(uniform_draw(splitmix64(seed, k)),
                                        uniform_draw(splitmix64(seed, k + 1))));
    const auto heard = listen(noise, {.n_rpm = 3000, .teeth = 2, .to_Hz = {}});
    EXPECT_FALSE(heard.chatter) << seed;
    EXPECT_TRUE(heard.harmonics.empty()) << seed;
    EXPECT_EQ(heard.n_rpm, 3000);
  }
}

TEST(Sound, AFaintLineIsToldButIsNoChatter) {
  Cut cut;
  cut.noise = 1e-4;
  cut.chatter_Hz = 1430;
  cut.chatter = 0.004;
  const auto heard = listen(sound_of(cut, 3), {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
  ASSERT_FALSE(heard.others.empty());
  EXPECT_NEAR(heard.others[0].frequency_Hz, 1430, 0.5);
  EXPECT_GT(heard.harmonics[0].line.amplitude, 0.04);
  EXPECT_FALSE(heard.chatter);
}

TEST(Sound, HarmonicsAreToldWithTheirOrders) {
  Cut cut;
  cut.noise = 1e-3;
  const auto heard = listen(sound_of(cut, 5), {.n_rpm = 6030, .teeth = 4, .to_Hz = {}});
  EXPECT_NEAR(heard.n_rpm, 6000, 0.2);
  for (const Harmonic& h : heard.harmonics)
    EXPECT_NEAR(h.line.frequency_Hz, 100 * h.order, 0.5);
  EXPECT_EQ(heard.harmonics[0].order % 4, 0);
  EXPECT_NEAR(heard.resolution_Hz, 100.5 / 32, 1e-3);
}

TEST(Sound, OutsideTheBandNothingIsHeard) {
  Cut cut;
  cut.chatter_Hz = 1430;
  cut.chatter = 1;
  EXPECT_TRUE(listen(sound_of(cut, 1), {.n_rpm = 6000, .teeth = 4, .to_Hz = {}}).chatter);
  EXPECT_FALSE(
      listen(sound_of(cut, 1), {.n_rpm = 6000, .teeth = 4, .from_Hz = 1500, .to_Hz = {}})
          .chatter);
  EXPECT_FALSE(
      listen(sound_of(cut, 1), {.n_rpm = 6000, .teeth = 4, .to_Hz = 1400}).chatter);
}

// A sensor that is off leaves a constant; what the transform rounds is no sound.
TEST(Sound, AConstantIsSilence) {
  for (const double x : {0.1, 5000 / 32768.0, -1e30, 1e-40}) {
    const Sound sound{48000, std::vector<double>(48000, x)};
    const auto heard = listen(sound, {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
    EXPECT_TRUE(heard.harmonics.empty()) << x;
    EXPECT_TRUE(heard.others.empty()) << x;
    EXPECT_FALSE(heard.chatter) << x;
    EXPECT_DOUBLE_EQ(heard.n_rpm, 6000) << x;
  }
}

// Nor does one beside the sound, as of an accelerometer under gravity, change what is heard.
TEST(Sound, AConstantBesideItIsNotHeard) {
  Cut cut;
  for (const double chatter : {0.0, 1.0}) {
    cut.chatter_Hz = 1430;
    cut.chatter = chatter;
    auto sound = sound_of(cut, 1);
    const auto alone = listen(sound, {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
    for (double& x : sound.value) x += 1e4;
    const auto beside = listen(sound, {.n_rpm = 6000, .teeth = 4, .to_Hz = {}});
    EXPECT_NEAR(beside.n_rpm, alone.n_rpm, 1e-6);
    ASSERT_EQ(beside.chatter.has_value(), alone.chatter.has_value());
    if (!alone.chatter) continue;
    EXPECT_NEAR(beside.chatter->frequency_Hz, alone.chatter->frequency_Hz, 1e-6);
  }
}

TEST(Sound, RefusesWhatIsTooShort) {
  Cut cut;
  cut.seconds = 0.15;  // 15 revolutions
  EXPECT_THROW(listen(sound_of(cut, 1), {.n_rpm = 6000, .teeth = 4, .to_Hz = {}}),
               ModelRangeError);
  const Sound slow{48000, std::vector<double>(2'000'000)};  // 16 turns of 1 s: 768,000
  EXPECT_NO_THROW(listen(slow, {.n_rpm = 60, .teeth = 1, .to_Hz = {}}));
  EXPECT_THROW(listen(slow, {.n_rpm = 40, .teeth = 1, .to_Hz = {}}), ModelRangeError);
}

// 1430 Hz at 12,000/min with 4 teeth: 1.79 vibrations from tooth to tooth.
TEST(Sound, SteadySpeedsHoldWholeVibrations) {
  const auto all = steady_speeds(1430, 12000, 4);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].harmonic, 2);
  EXPECT_NEAR(all[0].n_rpm, 10725, 1e-9);
  EXPECT_EQ(all[1].harmonic, 3);
  EXPECT_NEAR(all[1].n_rpm, 7150, 1e-9);
  EXPECT_EQ(all[2].harmonic, 1);
  EXPECT_NEAR(all[2].n_rpm, 21450, 1e-9);
}

}  // namespace
}  // namespace turnwright::chatter
