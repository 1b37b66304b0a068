#include "turnwright/cutting/spindle.hpp"

#include <algorithm>

namespace turnwright::cutting {
namespace {

using catalogue::CurvePoint;

// Torques that differ by less are one, printed with few digits.
constexpr double kRoundedTorque = 1e-3;

// Line through two points of a curve P(n), log-log; of the lesser torque where both have the
// same: an exponent that rounding has moved off 1 would make every speed hang on the last
// digit of the curve.
PowerLine through(double n1, double P1, double n2, double P2, double efficiency,
                  bool torque) {
  const double M1 = P1 / n1, M2 = P2 / n2;
  if (std::abs(std::log(M2 / M1)) < kRoundedTorque)
    return {efficiency * std::min(M1, M2), 1.0, torque};
  const double s = std::log(P2 / P1) / std::log(n2 / n1);
  return {efficiency * P1 / std::pow(n1, s), s, torque};
}

double torque_power_kW(const CurvePoint& p) {
  return units::shaft_power_kW(p.M_Nm, p.n_rpm);
}

// Whether the slope of either curve rises at point i.  At such a dip the lines around it
// do not lie above the curve.  1e-9 allows for the rounding of points on one line.
bool dip(const std::vector<CurvePoint>& c, std::size_t i) {
  const auto slope = [&](auto value, std::size_t a, std::size_t b) {
    return std::log(value(c[b]) / value(c[a])) / std::log(c[b].n_rpm / c[a].n_rpm);
  };
  const auto power = [](const CurvePoint& p) { return p.P_kW; };
  return slope(power, i, i + 1) > slope(power, i - 1, i) + 1e-9 ||
         slope(torque_power_kW, i, i + 1) > slope(torque_power_kW, i - 1, i) + 1e-9;
}

void add_unless_there(std::vector<PowerLine>& lines, const PowerLine& line) {
  const bool there = std::any_of(lines.begin(), lines.end(), [&](const PowerLine& l) {
    return l.torque == line.torque && std::abs(l.s - line.s) < 1e-9 &&
           std::abs(std::log(l.c / line.c)) < 1e-9;
  });
  if (!there) lines.push_back(line);
}

// Speed ranges of the main spindle or of a driven tool.
template <class Drive>
std::vector<SpeedRange> ranges_of(const Drive& drive) {
  const auto& c = drive.curve;
  const double eta = drive.efficiency;
  const double n_max = std::min(drive.n_max_rpm, c.back().n_rpm);
  std::vector<SpeedRange> ranges;
  SpeedRange now{drive.n_min_rpm, n_max, {}};
  // Below the first point the motor gives that point's torque: P ~ n.
  const double M0 =
      std::min(c.front().M_Nm, c.front().P_kW / units::shaft_power_kW(1, c[0].n_rpm));
  now.lines.push_back({eta * units::shaft_power_kW(M0, 1), 1.0, true});
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    if (i > 0 && dip(c, i)) {
      now.n_max_rpm = std::min(n_max, c[i].n_rpm);
      if (now.n_max_rpm > now.n_min_rpm) ranges.push_back(now);
      now = {std::max(drive.n_min_rpm, c[i].n_rpm), n_max, {}};
    }
    const auto &a = c[i], &b = c[i + 1];
    add_unless_there(now.lines, through(a.n_rpm, a.P_kW, b.n_rpm, b.P_kW, eta, false));
    add_unless_there(now.lines, through(a.n_rpm, torque_power_kW(a), b.n_rpm,
                                        torque_power_kW(b), eta, true));
  }
  if (now.n_max_rpm > now.n_min_rpm) ranges.push_back(now);
  return ranges;
}

}  // namespace

std::vector<SpeedRange> speed_ranges(const catalogue::Lathe& machine) {
  return ranges_of(machine);
}

std::vector<SpeedRange> speed_ranges(const catalogue::DrivenTools& spindle) {
  return ranges_of(spindle);
}

}  // namespace turnwright::cutting
