#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Units as the headers of measured data name them.
namespace turnwright::document {

/// length^l time^t force^f times `scale`, in mm, s and N.
struct MeasuredUnit {
  double scale = 1;
  int length = 0, time = 0, force = 0;
  bool of_dimensions(int l, int t, int f) const {
    return length == l && time == t && force == f;
  }
  friend bool operator==(const MeasuredUnit&, const MeasuredUnit&) = default;
};

/// What a product of units means: factors divided by "/" (which holds for the next factor
/// alone) or joined by "*", "·" or a blank, in brackets or not, with exponents written s2,
/// s^2, s^-2 or s².  Lengths: m, cm, mm, um, nm, in, mil, ft; times: s, ms, us; forces: N,
/// mN, kN, lbf, lb (a pound that divides a motion is a force), kgf, kp; g, the standard
/// acceleration 9.80665 m/s2; ips, in/s; kg.  Nothing for other text.
/// Exact by definition: 1 in = 25.4 mm, 1 lbf = 0.45359237 kg times g.
std::optional<MeasuredUnit> measured_unit(std::string_view text);

/// A motion per force: its order of derivative by time, and the value of one unit in
/// mm/(s^d N).
struct ResponseUnit {
  int derivative = 0;  ///< 0 receptance, 1 mobility, 2 accelerance
  double mm = 1;
  friend bool operator==(const ResponseUnit&, const ResponseUnit&) = default;
};
std::optional<ResponseUnit> response_unit(const MeasuredUnit& unit);
std::optional<ResponseUnit> response_unit(std::string_view text);

/// Hz of one Hz, kHz, rad/s (rad/sec, radians/s), rpm or cpm, in any case.
std::optional<double> hertz_of_unit(std::string_view text);

/// The order of derivative by time of a motion: 0 length, 1 speed, 2 acceleration.
std::optional<int> motion_derivative(const MeasuredUnit& unit);

/// "receptance", "mobility", "accelerance".
std::string quantity_of(int derivative);

}  // namespace turnwright::document
