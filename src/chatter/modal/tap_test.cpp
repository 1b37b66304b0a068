// H1 of taps.  Departure from the usual: the exponential window is not corrected mode by
// mode afterwards with approximate damping, but taken as the shift of the transform's line.
#include "turnwright/chatter/tap_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "median.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using Fault = Tap::Fault;

constexpr double kPulse = 0.05, kNoise = 8;  // of the highest pulse; deviations
constexpr std::size_t kLeastMargin = 4;      // samples
constexpr std::size_t kMostLines = 2000;

/// The force less its median, the highest pulses of all records positive.
struct Force {
  std::vector<double> value;
  double noise = 0;  // standard deviation
};

/// Samples of a record in which the force stands out.
struct Pulse {
  std::size_t record = 0, begin = 0, end = 0;
  double peak = 0;
  std::size_t margin() const { return std::max(kLeastMargin, end - begin); }
  std::size_t block() const { return begin - std::min(begin, margin()); }
};

/// A tap and the samples that its block may have.
struct Hit {
  Pulse pulse;
  std::size_t available = 0;
  std::optional<std::size_t> again;  // first sample of a second pulse
  Fault fault = Fault::none;
  std::size_t fault_at = 0;
};

std::vector<Force> forces(std::span<const TapRecord> records) {
  std::vector<Force> out;
  double extreme = 0;
  for (const TapRecord& r : records) {
    Force f;
    const double middle = median(r.force_N);
    std::vector<double> off;
    for (const double F : r.force_N) {
      f.value.push_back(F - middle);
      off.push_back(std::abs(F - middle));
      if (off.back() > std::abs(extreme)) extreme = f.value.back();
    }
    f.noise = 1.4826 * median(std::move(off));
    out.push_back(std::move(f));
  }
  if (extreme < 0)
    for (Force& f : out)
      for (double& F : f.value) F = -F;
  return out;
}

std::vector<Pulse> pulses(const std::vector<Force>& all) {
  constexpr std::size_t kOneGap = 2;  // samples of noise inside a pulse
  double highest = 0;
  for (const Force& f : all) highest = std::max(highest, std::ranges::max(f.value));
  std::vector<Pulse> out;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const double level = std::max(kPulse * highest, kNoise * all[r].noise);
    const auto& F = all[r].value;
    for (std::size_t i = 0; i < F.size(); ++i) {
      if (!(F[i] > level)) continue;
      if (out.empty() || out.back().record != r || i > out.back().end + kOneGap)
        out.push_back({.record = r, .begin = i, .end = i, .peak = F[i]});
      out.back().end = i + 1;
      out.back().peak = std::max(out.back().peak, F[i]);
    }
  }
  return out;
}

/// The samples from a pulse to the next or to the end of its record.
std::size_t to_next(const std::vector<Pulse>& all, std::size_t i,
                    std::span<const TapRecord> records) {
  const bool last = i + 1 == all.size() || all[i + 1].record != all[i].record;
  return (last ? records[all[i].record].force_N.size() : all[i + 1].begin) - all[i].begin;
}

std::vector<Hit> hits(const std::vector<Pulse>& all, std::span<const TapRecord> records,
                      const TapOptions& options) {
  constexpr double kBounce_s = 0.2, kOfLongest = 0.2;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    longest = std::max(longest, to_next(all, i, records));
  const double bounce =
      std::min(kBounce_s / options.step_s, kOfLongest * static_cast<double>(longest));
  std::vector<Hit> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool same = !out.empty() && out.back().pulse.record == all[i].record;
    const std::size_t since =
        !same ? 0
              : all[i].begin - (options.block_s ? out.back().pulse : all[i - 1]).begin;
    const double within = options.block_s ? *options.block_s / options.step_s : bounce;
    if (same && static_cast<double>(since) < within) {
      if (!out.back().again) out.back().again = all[i].begin;
      continue;
    }
    if (same) out.back().available = all[i].block() - out.back().pulse.block();
    out.push_back({.pulse = all[i],
                   .available = records[all[i].record].force_N.size() - all[i].block(),
                   .again = {}});
  }
  return out;
}

/// The largest number up to n without prime factors above 5, for the transform.
std::size_t smooth(std::size_t n) {
  for (; n > 1; --n) {
    std::size_t rest = n;
    for (const std::size_t p : {2U, 3U, 5U})
      while (rest % p == 0) rest /= p;
    if (rest == 1) return n;
  }
  return n;
}

/// Samples of every block; taps with less are cut off.
std::size_t block_of(std::vector<Hit>& all, const TapOptions& options) {
  std::vector<double> available;
  for (const Hit& hit : all) available.push_back(static_cast<double>(hit.available));
  const double least = options.block_s ? std::floor(*options.block_s / options.step_s)
                                       : median(available) / 2;
  double block = std::numeric_limits<double>::infinity();
  for (Hit& hit : all) {
    const auto samples = static_cast<double>(hit.available);
    if (samples < least) {
      hit.fault = Fault::cut_off;
      hit.fault_at = hit.pulse.block() + hit.available;
    } else {
      block = std::min(block, samples);
    }
    if (hit.again) {
      hit.fault = Fault::double_hit;
      hit.fault_at = *hit.again;
    }
  }
  if (options.block_s) block = std::min(block, least);
  return smooth(static_cast<std::size_t>(std::isfinite(block) ? block : 0));
}

/// The values of a series: their ends, the one in the middle, and the smallest step.
struct ValueRange {
  double lowest = 0, highest = 0, rest = 0;
  double step = std::numeric_limits<double>::infinity();
};
ValueRange range_of(const std::vector<double>& x) {
  const auto [lowest, highest] = std::ranges::minmax(x);
  ValueRange out{lowest, highest, median(x)};
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] != x[i - 1]) out.step = std::min(out.step, std::abs(x[i] - x[i - 1]));
  return out;
}

/// The first sample of a series at the end of its range, among those of a block.
std::optional<std::size_t> overload(const std::vector<double>& x, const ValueRange& range,
                                    std::size_t from, std::size_t to) {
  constexpr std::size_t kInARow = 3;
  constexpr double kSteps = 10;
  const double lowest = range.lowest, highest = range.highest, rest = range.rest;
  const double far = std::max(highest - rest, rest - lowest) / 2;
  for (std::size_t i = from; i < to;) {
    std::size_t end = i + 1;
    while (end < x.size() && x[end] == x[i]) ++end;
    const auto away = [&](std::size_t k) {
      return k < x.size() && std::abs(x[k] - x[i]) > kSteps * range.step;
    };
    if ((x[i] == lowest || x[i] == highest) && std::abs(x[i] - rest) > far &&
        end - i >= kInARow && (away(i - 1) || away(end)))
      return i;
    i = end;
  }
  return std::nullopt;
}

void find_overload(std::vector<Hit>& all, std::span<const TapRecord> records,
                   std::size_t block) {
  std::vector<std::array<ValueRange, 2>> ranges;
  for (const TapRecord& r : records)
    ranges.push_back({range_of(r.force_N), range_of(r.motion)});
  for (Hit& hit : all) {
    leave_if_asked();
    const TapRecord& r = records[hit.pulse.record];
    const std::size_t from = hit.pulse.block(),
                      to = std::min(from + block, r.force_N.size());
    for (const std::size_t k : {0U, 1U}) {
      const auto& series = k == 0 ? r.force_N : r.motion;
      const auto at = overload(series, ranges[hit.pulse.record][k], from, to);
      if (!at || hit.fault != Fault::none) continue;
      hit.fault = Fault::overload;
      hit.fault_at = *at;
    }
  }
}

/// Sums over taps, line by line.
struct Spectra {
  std::vector<double> FF, XX;
  std::vector<Complex> XF;
};

/// The motion before the first pulse of a record; 0 where that is too short to tell.
struct Rest {
  double mean = 0, variance = 0;
};

Rest rest_of(const TapRecord& r, const std::vector<Hit>& all, std::size_t record) {
  constexpr std::size_t kEnough = 32;
  const auto first = std::ranges::find_if(
      all, [&](const Hit& hit) { return hit.pulse.record == record; });
  if (first == all.end() || first->pulse.block() < kEnough) return {};
  const std::span quiet(r.motion.data(), first->pulse.block());
  Rest out;
  for (const double x : quiet) out.mean += x / static_cast<double>(quiet.size());
  for (const double x : quiet)
    out.variance += std::pow(x - out.mean, 2) / static_cast<double>(quiet.size());
  return out;
}

/// Whether the vibration has died away by the end of the blocks.
bool died_away(const std::vector<Hit>& all, std::span<const TapRecord> records,
               std::size_t block) {
  constexpr double kLeft = 4e-4;  // of the power
  double first = 0, last = 0;
  const std::size_t tenth = block / 10;
  for (const Hit& hit : all) {
    if (hit.fault != Fault::none) continue;
    const TapRecord& r = records[hit.pulse.record];
    const Rest rest = rest_of(r, all, hit.pulse.record);
    const auto power = [&](std::size_t from) {
      double sum = 0;
      for (std::size_t i = from; i < from + tenth; ++i)
        sum += std::pow(r.motion[hit.pulse.block() + i] - rest.mean, 2) - rest.variance;
      return sum;
    };
    first += power(0);
    last += power(block - tenth);
  }
  return last < kLeft * first;
}

Spectra spectra(const std::vector<Hit>& all, const std::vector<double>& middle,
                std::span<const TapRecord> records, std::size_t block, double decay) {
  Eigen::FFT<double> fft;
  const std::size_t lines = block / 2 + 1;
  Spectra out{std::vector<double>(lines), std::vector<double>(lines),
              std::vector<Complex>(lines)};
  for (const Hit& hit : all) {
    if (hit.fault != Fault::none) continue;
    leave_if_asked();
    const TapRecord& r = records[hit.pulse.record];
    const double rest = rest_of(r, all, hit.pulse.record).mean;
    const std::size_t from = hit.pulse.block(), end = hit.pulse.end + hit.pulse.margin();
    std::vector<double> force(block), motion(block);
    for (std::size_t i = 0; i < block; ++i) {
      const double window = std::exp(-decay * static_cast<double>(i));
      if (from + i < end)
        force[i] = window * (r.force_N[from + i] - middle[hit.pulse.record]);
      motion[i] = window * (r.motion[from + i] - rest);
    }
    std::vector<Complex> F, X;
    fft.fwd(F, force);
    fft.fwd(X, motion);
    for (std::size_t k = 0; k < lines; ++k) {
      out.FF[k] += std::norm(F[k]);
      out.XX[k] += std::norm(X[k]);
      out.XF[k] += X[k] * std::conj(F[k]);
    }
  }
  return out;
}

/// Every how many lines the noise is independent behind a window that leaves `left`.
std::size_t stride(double left) {
  return static_cast<std::size_t>(std::max(1.0, std::round(-std::log(left) / 2)));
}

/// Lines from the first on at which the force is strong enough.
std::size_t band(const Spectra& s, std::size_t block) {
  constexpr double kWeak = 0.01, kAntiAlias = 2.56;
  const double top = std::ranges::max(s.FF);
  const auto most = static_cast<std::size_t>(static_cast<double>(block) / kAntiAlias);
  std::size_t k = 1;
  while (k < s.FF.size() && k <= most && s.FF[k] >= kWeak * top) ++k;
  return k - 1;
}

void tell_response(const Spectra& s, std::size_t lines, std::size_t taps,
                   const TapOptions& options, TapTest& out) {
  const double decay_1_s = -std::log(out.left) / out.block_s;
  out.response.derivative = options.derivative;
  out.response.decay_1_s = decay_1_s;
  const std::size_t each = stride(out.left);
  for (std::size_t k = each; k <= lines; k += each) {
    const double w = 2 * units::kPi * static_cast<double>(k) / out.block_s;
    const Complex iw(0, w), turn = iw / (iw + decay_1_s);
    out.response.w_rad_s.push_back(w);
    out.response.value.push_back(std::pow(turn, options.derivative) * s.XF[k] /
                                 s.FF[k]);  // Eq. (1)
    if (taps > 1)
      out.coherence.push_back(
          std::min(1.0, std::norm(s.XF[k]) / (s.FF[k] * s.XX[k])));  // Eq. (2)
  }
}

/// The taps as they are told.
std::vector<Tap> described(const std::vector<Hit>& all,
                           std::span<const TapRecord> records, double step_s) {
  std::vector<Tap> out;
  for (const Hit& hit : all) {
    const double from = records[hit.pulse.record].from_s;
    out.push_back({.fault = hit.fault,
                   .at_s = from + step_s * static_cast<double>(hit.pulse.begin),
                   .peak_N = hit.pulse.peak,
                   .again_s = hit.fault == Fault::none
                                  ? 0
                                  : from + step_s * static_cast<double>(hit.fault_at)});
  }
  return out;
}

}  // namespace

TapTest tap_test(std::span<const TapRecord> records, const TapOptions& options) {
  const auto force = forces(records);
  auto all = hits(pulses(force), records, options);
  TapTest out;
  if (all.empty()) return out;
  std::size_t block = block_of(all, options);
  find_overload(all, records, block);
  out.taps = described(all, records, options.step_s);
  const auto good =
      static_cast<std::size_t>(std::ranges::count(all, Fault::none, &Hit::fault));
  if (good == 0 || block < 2 * kLeastMargin) return out;
  std::vector<double> middle;
  for (const TapRecord& r : records) middle.push_back(median(r.force_N));
  const auto transformed = [&] {
    out.left = options.left.value_or(died_away(all, records, block) ? 1 : 0.01);
    return spectra(all, middle, records, block,
                   -std::log(out.left) / static_cast<double>(block));
  };
  Spectra s = transformed();
  if (const std::size_t lines = band(s, block) / stride(out.left); lines > kMostLines) {
    block = smooth(block * kMostLines / lines);
    s = transformed();
  }
  out.block_s = options.step_s * static_cast<double>(block);
  tell_response(s, band(s, block), good, options, out);
  return out;
}

}  // namespace turnwright::chatter
