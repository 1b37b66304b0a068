#pragma once
#include <cstddef>
#include <optional>

/// Cuts that stay stable with a margin in depth and in speed, and how far a cut is from
/// chatter.
namespace turnwright::chatter {

struct OperatingPoint {
  double n_rpm = 0, ap_mm = 0;
};

struct SpeedRange {
  double from_rpm = 0, to_rpm = 0;
  bool holds(double n_rpm) const { return n_rpm >= from_rpm && n_rpm <= to_rpm; }
};

/// A depth ap at the speed n is safe if
///
///     ap (1 + depth) <= B(u)   for every u in [n (1 - speed), n (1 + speed)]         (1)
///
/// B the depth of the first loss of stability.  An error of all natural frequencies by a
/// factor has the same effect as one of the speed, so `speed` covers it, too: where forces
/// do not depend on the speed, motions at (n, wn) and (c n, c wn) are the same in t/tau.
/// B is computed at the chart's speeds within the range and, where that is quick, at
/// speeds a sixteenth of `speed` apart; nothing is shown between them.
struct Margins {
  double depth = 0.2;   ///< >= 0
  double speed = 0.02;  ///< in [0, 1)
};

/// What the spindle bears: mean torque and power over a revolution,
///
///     M = torque_Nm_mm ap,   P = 2 pi n M                                            (2)
struct SpindleLoad {
  double torque_Nm_mm = 0;          ///< mean torque per depth, > 0
  std::optional<double> power_kW;   ///< limit
  std::optional<double> torque_Nm;  ///< limit

  /// P of (2).
  double power_at_kW(const OperatingPoint& cut) const;
};

/// What ends the depth of a safe cut.
enum class DepthEnd { chatter, ap_max, power, torque };

struct SafeCut {
  OperatingPoint at;
  DepthEnd limited_by = DepthEnd::chatter;
  std::optional<double> limit_mm;  ///< B(n); none: it is stable up to ap_max
  /// About n: the speeds between which `at.ap_mm` is stable without a margin, looked for
  /// within 10 % of n at speeds 1 % apart.  None where that takes long.
  std::optional<SpeedRange> stable;
  /// Where chatter limits the depth: frequency at the least B of (1).
  std::optional<double> chatter_Hz;
  std::size_t speeds_judged = 0;  ///< of (1)
};

/// How far a cut is from chatter at its own speed.
struct PointMargin {
  /// B(n); none: it is stable up to ap_max or, if that is deeper, its own depth.
  std::optional<double> limit_mm;
  /// Of a cut that chatters: frequency of the loss of stability next below its depth.
  std::optional<double> chatter_Hz;
  /// Of a cut that chatters: B at the chart's speed nearest in ratio at which its depth is
  /// safe by (1), and which the machine has and can drive.
  struct Cure {
    double n_rpm = 0;
    std::optional<double> limit_mm;  ///< none: stable up to ap_max
  };
  std::optional<Cure> cure;
};

}  // namespace turnwright::chatter
