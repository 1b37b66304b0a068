#include "turnwright/chatter/sound.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "median.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kTurns = 32, kLeastTurns = 16, kBlock_s = 0.25, kLeast_s = 0.05;
constexpr double kMostSamples = 1 << 20;  // of a block: some 200 MB
constexpr double kBeside = 2.5;           // lines of resolution about a harmonic
constexpr double kUnsteady = 5e-4;        // of its frequency
constexpr double kStandsOut_dB = 15, kShare = 0.1;
constexpr std::size_t kTold = 10;  // lines, harmonics

double decibel(double power) { return 10 * std::log10(power); }

/// The mean power spectrum of the blocks.
class SoundSpectrum {
 public:
  SoundSpectrum(const Sound& sound, double block_s) : rate_Hz_(sound.rate_Hz) {
    const auto length =
        std::min(sound.value.size(), static_cast<std::size_t>(block_s * sound.rate_Hz));
    resolution_Hz_ = rate_Hz_ / static_cast<double>(length);
    std::size_t size = 1;
    constexpr std::size_t kFiner = 4;  // lines than the resolution
    while (size < kFiner * length) size *= 2;
    step_Hz_ = rate_Hz_ / static_cast<double>(size);
    power_.assign(size / 2, 0);
    for (const double x : sound.value) largest_ = std::max(largest_, std::abs(x));
    Eigen::FFT<double> fft;
    std::vector<double> block(size, 0);
    std::vector<std::complex<double>> transform;
    double blocks = 0;
    for (std::size_t from = 0; from + length <= sound.value.size(); from += length / 2) {
      leave_if_asked();
      double weights = 0, sum = 0;
      const auto weight = [length](std::size_t i) {
        return std::pow(std::sin(units::kPi * (static_cast<double>(i) + 0.5) /
                                 static_cast<double>(length)),
                        2);
      };
      for (std::size_t i = 0; i < length; ++i) {
        weights += weight(i);
        sum += weight(i) * sound.value[from + i];
      }
      for (std::size_t i = 0; i < length; ++i)  // without the mean, which leaks
        block[i] = weight(i) * (sound.value[from + i] - sum / weights);
      fft.fwd(transform, block);
      for (std::size_t i = 0; i < power_.size(); ++i)
        power_[i] += std::norm(2.0 / weights * transform[i]);
      ++blocks;
    }
    for (double& p : power_) p /= blocks;
  }

  double resolution_Hz() const { return resolution_Hz_; }
  /// Less is rounding, as beside a constant.
  double least_power() const {
    constexpr double kRounded = 1e-12;  // of the largest sample
    return std::max(std::pow(kRounded * largest_, 2), std::numeric_limits<double>::min());
  }
  double frequency_Hz(std::size_t line) const {
    return static_cast<double>(line) * step_Hz_;
  }
  std::size_t line(double f_Hz) const {
    const double at =
        std::clamp(f_Hz / step_Hz_, 1.0, static_cast<double>(power_.size()) - 2);
    return static_cast<std::size_t>(std::lround(at));
  }
  double power(std::size_t line) const { return power_[line]; }
  bool peaks(std::size_t line) const {
    return power_[line] > power_[line - 1] && power_[line] >= power_[line + 1];
  }
  /// The highest line of a range.
  std::size_t highest(double from_Hz, double to_Hz) const {
    const auto begin = power_.begin() + static_cast<std::ptrdiff_t>(line(from_Hz)),
               end = power_.begin() + static_cast<std::ptrdiff_t>(line(to_Hz)) + 1;
    return static_cast<std::size_t>(std::max_element(begin, end) - power_.begin());
  }
  /// A peak by the parabola through the logarithms of it and its neighbours.
  SoundLine peak(std::size_t at, double noise) const {
    const auto height = [&](std::size_t i) {  // finite also of silence
      return std::log(std::max(power_[i], std::numeric_limits<double>::min()));
    };
    const double a = height(at - 1), b = height(at), c = height(at + 1);
    const double shift = 0.5 * (a - c) / (a - 2 * b + c);
    return {(static_cast<double>(at) + shift) * step_Hz_, std::sqrt(power_[at]),
            decibel(power_[at] / noise)};
  }

 private:
  double rate_Hz_, resolution_Hz_ = 0, step_Hz_ = 0, largest_ = 0;
  std::vector<double> power_;
};

class Listener {
 public:
  Listener(const Sound& sound, const ListenOptions& o)
      : spectrum_(sound, std::min(std::max(kTurns * 60 / o.n_rpm, kBlock_s),
                                  kMostSamples / sound.rate_Hz)),
        turn_Hz_(o.n_rpm / 60) {
    out_.resolution_Hz = spectrum_.resolution_Hz();
    out_.from_Hz = std::max(o.from_Hz, 4 * out_.resolution_Hz);
    constexpr double kMirror = 4;  // lines of resolution, both main lobes
    out_.to_Hz = std::min(o.to_Hz.value_or(sound.rate_Hz),
                          sound.rate_Hz / 2 - kMirror * out_.resolution_Hz);
  }

  Heard heard() {
    out_.n_rpm = 60 * turn_Hz_;
    if (out_.to_Hz <= out_.from_Hz) return out_;
    find_noise(false);
    find_speed();
    constexpr double kTaken = 0.4;  // of the way between two harmonics, on either side
    const double last = (kTaken * turn_Hz_ - kBeside * out_.resolution_Hz) / kUnsteady;
    out_.to_Hz = std::min(out_.to_Hz, std::max(last, out_.from_Hz));
    find_noise(true);
    find_harmonics();
    find_others();
    const double strongest =
        out_.harmonics.empty() ? 0 : out_.harmonics.front().line.amplitude;
    if (!out_.others.empty() && out_.others.front().amplitude >= kShare * strongest)
      out_.chatter = out_.others.front();
    return out_;
  }

 private:
  double beside_Hz(double f_Hz) const {
    return kBeside * out_.resolution_Hz + kUnsteady * f_Hz;
  }
  double order(double f_Hz) const { return std::round(f_Hz / turn_Hz_); }
  bool on_harmonic(double f_Hz) const {
    return order(f_Hz) >= 1 && std::abs(f_Hz - order(f_Hz) * turn_Hz_) <= beside_Hz(f_Hz);
  }

  /// The noise about frequencies a tenth of an octave apart.
  void find_noise(bool without_harmonics) {
    constexpr double kWidth = 1.2, kNext = 1.07;
    constexpr std::size_t kLines = 40;  // at least, for a median
    noise_.clear();
    for (double f = out_.from_Hz; f < out_.to_Hz * kNext; f *= kNext) {
      std::vector<double> about;
      for (double wide = kWidth; about.size() < kLines && wide < 64; wide *= wide) {
        about.clear();
        const double to = std::min(f * wide, out_.to_Hz);
        for (double g = std::max(f / wide, out_.from_Hz); g < to; g += out_.resolution_Hz)
          if (!without_harmonics || !on_harmonic(g))
            about.push_back(spectrum_.power(spectrum_.line(g)));
      }
      noise_.push_back(std::max(median(std::move(about)) / std::numbers::ln2,
                                spectrum_.least_power()));
    }
    noise_step_ = std::log(kNext);
  }
  double noise_at(double f_Hz) const {
    const double i = std::log(std::max(f_Hz / out_.from_Hz, 1.0)) / noise_step_;
    return noise_[std::min(noise_.size() - 1, static_cast<std::size_t>(std::lround(i)))];
  }
  bool stands_out(std::size_t line) const {
    return decibel(spectrum_.power(line) / noise_at(spectrum_.frequency_Hz(line))) >=
           kStandsOut_dB;
  }

  /// The spindle's frequency from its harmonics that stand out: each narrows the range in
  /// which the next ones are looked for.  After the first, those whose place is not known to
  /// a line are not looked for: what stands out there may be chatter.
  void find_speed() {
    double unsure = 0.01;  // of the frequency
    double sum = 0, squares = 0;
    const double given = turn_Hz_;
    constexpr double kWide = 0.25, kLine = 0.2;  // of a turn's frequency; of a line
    for (double j = 1; j * given < out_.to_Hz && j * unsure < kWide; ++j) {
      const double f = j * turn_Hz_, about = std::max(unsure * f, out_.resolution_Hz);
      if (squares > 0 && about > out_.resolution_Hz) break;
      if (f - about < out_.from_Hz) continue;
      const std::size_t at = spectrum_.highest(f - about, f + about);
      if (!spectrum_.peaks(at) || !stands_out(at)) continue;
      sum += j * spectrum_.peak(at, 1).frequency_Hz;
      squares += j * j;
      turn_Hz_ = sum / squares;
      unsure = std::min(unsure, kLine * out_.resolution_Hz / f);
    }
    out_.n_rpm = 60 * turn_Hz_;
  }

  void find_harmonics() {
    for (double j = 1; j * turn_Hz_ < out_.to_Hz; ++j) {
      const double f = j * turn_Hz_, about = beside_Hz(f);
      if (f - about < out_.from_Hz) continue;
      const std::size_t at = spectrum_.highest(f - about, f + about);
      if (spectrum_.peaks(at) && stands_out(at))
        out_.harmonics.push_back({spectrum_.peak(at, noise_at(f)), static_cast<int>(j)});
    }
    std::ranges::stable_sort(out_.harmonics, std::ranges::greater(),
                             [](const Harmonic& h) { return h.line.amplitude; });
    if (out_.harmonics.size() > kTold) out_.harmonics.resize(kTold);
  }

  /// Peaks between the harmonics; not what the window leaves of a stronger one.
  void find_others() {
    constexpr double kOfWindow = 6;  // lines of resolution
    std::vector<SoundLine> all;
    for (std::size_t i = spectrum_.line(out_.from_Hz); i <= spectrum_.line(out_.to_Hz);
         ++i) {
      const double f = spectrum_.frequency_Hz(i);
      if (spectrum_.peaks(i) && stands_out(i) && !on_harmonic(f))
        all.push_back(spectrum_.peak(i, noise_at(f)));
    }
    std::ranges::stable_sort(all, std::ranges::greater(), &SoundLine::amplitude);
    for (const SoundLine& line : all) {
      const bool beside = std::ranges::any_of(out_.others, [&](const SoundLine& o) {
        return std::abs(o.frequency_Hz - line.frequency_Hz) <
               kOfWindow * out_.resolution_Hz;
      });
      if (!beside && out_.others.size() < kTold) out_.others.push_back(line);
    }
  }

  SoundSpectrum spectrum_;
  double turn_Hz_;
  std::vector<double> noise_;
  double noise_step_ = 1;
  Heard out_;
};

}  // namespace

Heard listen(const Sound& sound, const ListenOptions& options) {
  if (kLeastTurns * 60 / options.n_rpm * sound.rate_Hz > kMostSamples)
    throw ModelRangeError(
        tr("listen: 16 revolutions have more than 1,048,576 samples; record at a lower "
           "rate"));
  const double length_s = static_cast<double>(sound.value.size()) / sound.rate_Hz;
  if (!(length_s * options.n_rpm / 60 >= kLeastTurns && length_s >= kLeast_s))
    throw ModelRangeError(
        tr("listen: the sound is shorter than 16 revolutions or 0.05 s: the harmonics of "
           "the "
           "spindle cannot be told from chatter"));
  return Listener(sound, options).heard();
}

std::vector<SteadySpeed> steady_speeds(double chatter_Hz, double n_rpm, int teeth) {
  const double vibrations = 60 * chatter_Hz / (n_rpm * teeth);  // from tooth to tooth
  std::vector<SteadySpeed> out;
  for (double k = std::floor(vibrations) - 1; k <= std::floor(vibrations) + 2; ++k)
    if (k >= 1) out.push_back({60 * chatter_Hz / (teeth * k), static_cast<int>(k)});
  std::ranges::stable_sort(
      out, {}, [&](const SteadySpeed& s) { return std::abs(std::log(s.n_rpm / n_rpm)); });
  return out;
}

}  // namespace turnwright::chatter
