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

double power_kW(const CurvePoint& p) { return p.P_kW; }

double torque_power_kW(const CurvePoint& p) {
  return units::shaft_power_kW(p.M_Nm, p.n_rpm);
}

// Makers round to about 1 %, and power and torque of a point may differ by 3 %.
constexpr double kRoundedDip = 0.03;

// A line through two points of a curve, on or above those between.
struct Chord {
  std::size_t from = 0, to = 0;
  double above = 0;  // log of the greatest ratio of the line to a point between
  bool deep() const { return above > kRoundedDip; }
};

// Least concave majorant of a curve P(n), log-log, from left to right.
class Majorant {
 public:
  using Power = double (*)(const CurvePoint&);
  Majorant(const std::vector<CurvePoint>& curve, Power power)
      : c_(curve), power_(power) {}

  // The chord by which point i would be added.  1e-9 allows for the rounding of points on
  // one line.
  Chord chord_to(std::size_t i) const {
    Chord chord{i - 1, i};
    for (auto before = chords_.rbegin(); before != chords_.rend(); ++before) {
      if (slope(chord.from, i) <= slope(before->from, before->to) + 1e-9) break;
      chord.from = before->from;
    }
    for (auto j = chord.from + 1; j < i; ++j) {
      const double run = std::log(c_[j].n_rpm / c_[chord.from].n_rpm);
      chord.above =
          std::max(chord.above, slope(chord.from, i) * run - rise(chord.from, j));
    }
    return chord;
  }

  void add(const Chord& chord) {
    while (!chords_.empty() && chords_.back().to > chord.from) chords_.pop_back();
    chords_.push_back(chord);
  }

  // The lines of its chords, each lowered to lie on or under the points between.
  std::vector<PowerLine> lines(double efficiency, bool torque) const {
    std::vector<PowerLine> lines;
    for (const auto& chord : chords_) {
      const auto &a = c_[chord.from], &b = c_[chord.to];
      auto line = through(a.n_rpm, power_(a), b.n_rpm, power_(b), efficiency, torque);
      line.c *= std::exp(-chord.above);
      lines.push_back(line);
    }
    return lines;
  }

 private:
  double rise(std::size_t a, std::size_t b) const {
    return std::log(power_(c_[b]) / power_(c_[a]));
  }
  double slope(std::size_t a, std::size_t b) const {
    return rise(a, b) / std::log(c_[b].n_rpm / c_[a].n_rpm);
  }

  const std::vector<CurvePoint>& c_;
  Power power_;
  std::vector<Chord> chords_;
};

void add_unless_there(std::vector<PowerLine>& lines, const PowerLine& line) {
  const bool there = std::any_of(lines.begin(), lines.end(), [&](const PowerLine& l) {
    return l.torque == line.torque && std::abs(l.s - line.s) < 1e-9 &&
           std::abs(std::log(l.c / line.c)) < 1e-9;
  });
  if (!there) lines.push_back(line);
}

// Adds the lines of the curve from a point on, up to the first deep dip of power or torque.
// Returns the point where they end.
std::size_t add_range(std::vector<PowerLine>& lines, const std::vector<CurvePoint>& c,
                      std::size_t first, double efficiency) {
  Majorant power(c, power_kW), torque(c, torque_power_kW);
  auto last = first;
  while (last + 1 < c.size()) {
    const auto p = power.chord_to(last + 1), t = torque.chord_to(last + 1);
    if (p.deep() || t.deep()) break;
    power.add(p);
    torque.add(t);
    ++last;
  }
  for (const auto& line : power.lines(efficiency, false)) add_unless_there(lines, line);
  for (const auto& line : torque.lines(efficiency, true)) add_unless_there(lines, line);
  return last;
}

// The points of a curve on and around the speeds of a spindle.
std::vector<CurvePoint> around(const std::vector<CurvePoint>& c, double n_min_rpm,
                               double n_max_rpm) {
  std::vector<CurvePoint> all;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const bool below = i + 1 < c.size() && c[i + 1].n_rpm <= n_min_rpm;
    const bool above = i > 0 && c[i - 1].n_rpm >= n_max_rpm;
    if (!below && !above) all.push_back(c[i]);
  }
  return all;
}

// Speed ranges of the main spindle or of a driven tool.
template <class Drive>
std::vector<SpeedRange> ranges_of(const Drive& drive) {
  const double eta = drive.efficiency;
  const double n_max = std::min(drive.n_max_rpm, drive.curve.back().n_rpm);
  const auto c = around(drive.curve, drive.n_min_rpm, n_max);
  std::vector<SpeedRange> ranges;
  // Below the first point the motor gives that point's torque: P ~ n.
  const auto& least = drive.curve.front();
  const double M0 =
      std::min(least.M_Nm, least.P_kW / units::shaft_power_kW(1, least.n_rpm));
  SpeedRange now{
      drive.n_min_rpm, n_max, {{eta * units::shaft_power_kW(M0, 1), 1.0, true}}};
  for (std::size_t first = 0, last = 0; first + 1 < c.size(); first = last) {
    last = add_range(now.lines, c, first, eta);
    now.n_max_rpm = last + 1 < c.size() ? std::min(n_max, c[last].n_rpm) : n_max;
    if (now.n_max_rpm > now.n_min_rpm) ranges.push_back(now);
    now = {std::max(drive.n_min_rpm, c[last].n_rpm), n_max, {}};
  }
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
