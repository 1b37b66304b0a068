#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/chatter/frf.hpp"

/// A frequency response from taps: time series of a hammer's force and of the motion.
namespace turnwright::chatter {

/// A record without gaps, one tap or several.
struct TapRecord {
  double from_s = 0;            ///< time of its first sample
  std::vector<double> force_N;  ///< of either sign
  std::vector<double> motion;   ///< [mm/s^d], as many
};

struct TapOptions {
  int derivative = 2;  ///< d: 0 displacement, 1 velocity, 2 acceleration
  double step_s = 0;   ///< between samples
  /// Length of a tap's block; none: as long as every tap has it before the next one.
  std::optional<double> block_s = {};
  /// What the exponential window leaves at the end of a block, in (0, 1]; 1: no window.
  /// none: 1 where the vibration has died away by then, else 0.01.
  std::optional<double> left = {};
};

struct Tap {
  enum class Fault {
    none,
    double_hit,  ///< a second pulse inside its block
    overload,    ///< samples in a row at the end of the range of force or motion
    cut_off      ///< the record, or the next tap, ends its block
  } fault = Fault::none;
  double at_s = 0, peak_N = 0;
  double again_s = 0;  ///< the second pulse, or the first sample at the end of the range
};

struct TapTest {
  std::vector<Tap> taps;  ///< in their order; the response is that of those without fault
  double block_s = 0;
  double left = 1;                ///< by the exponential window
  FrequencyResponse response;     ///< with decay_1_s of the window; no lines: no good tap
  std::vector<double> coherence;  ///< for each line; none of a single tap
};

/// Finds the taps of records and averages those without fault.
///
/// A pulse is where the force, less its median, stands above a twentieth of the highest of
/// all and above eight standard deviations of its noise (1.4826 times the median deviation).
/// Pulses belong to one tap, which is then a double hit, if they lie in one block; where
/// `block_s` is not given, if they are closer than 0.2 s and than a fifth of the longest
/// time from a pulse to the next or to the end of its record, as only a hammer that bounces
/// is.  A block begins the width of the pulse (4 samples at least) before it.  A tap whose
/// block would be less than half as long as their median is cut off.
///
/// Force window: outside the pulse and its width on both sides the force is zero.
/// Exponential window: both series times e^(-A t), t from the beginning of the block, e^(-A
/// T) = left.  As the motion begins with the block, their ratio is exactly that of the
/// transforms at i w + A, which modal_fit changes back, so that the window adds no damping.
/// It is told here as (i w)^d H(i w + A), at every line if A T <= 3, else at every (A T/2)th:
/// the window correlates the noise of lines that are nearer.  A vibration has died away if
/// the motion's power in the last tenth of the blocks, less that before the first pulse, is
/// below 4e-4 of the first tenth's.
///
/// With F and X the transforms of the taps, sums over the taps:
///
///     Y = sum X F* / sum F F*                                    (1)  H1
///     coherence = |sum X F*|^2 / (sum F F* sum X X*)             (2)
///
/// Lines are told from the first on until the force's power is below 1 % of its highest,
/// at most to the 2.56th part of the sampling rate.  Blocks with more than 2000 lines are
/// shortened.  Overload: three samples in a row or more that are equal and the highest or
/// lowest of their record, more than half of its largest distance from the median, where a
/// sample beside them is 10 of the least steps away.
/// Source: [Bendat 2010] for (1) and (2); the rules are derived here, checked in
/// tap_test_test against simulated modes.
TapTest tap_test(std::span<const TapRecord> records, const TapOptions& options);

}  // namespace turnwright::chatter
