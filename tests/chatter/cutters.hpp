#pragma once
#include <cmath>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/system.hpp"

/// The cutters of the literature's charts.
namespace turnwright::chatter {

/// Insperger and Stepan's benchmark tool: 922 Hz, zeta 0.011, 0.03993 kg, two teeth.
inline Mode benchmark_mode(Axis axis) {
  const double wn = 922 * 2 * units::kPi;
  return {
      .axis = axis, .wn_rad_s = wn, .zeta = 0.011, .k_N_mm = 0.03993 * wn * wn / 1000};
}

enum class Directions { one, two };

inline System benchmark(Directions directions, const Engagement& cut) {
  System s{.modes = {benchmark_mode(Axis::x)},
           .teeth = 2,
           .entry_rad = cut.entry_rad,
           .exit_rad = cut.exit_rad,
           .force = LinearForce{.Kt_MPa = 600, .Kn_MPa = 200}};
  if (directions == Directions::two) s.modes.push_back(benchmark_mode(Axis::y));
  return s;
}

/// The benchmark's cutter with modes 15 % apart on x and y in turn.
inline System many_modes(int modes, const Engagement& cut) {
  System s = benchmark(Directions::one, cut);
  for (int i = 1; i < modes; ++i) {
    s.modes.push_back(benchmark_mode(i % 2 == 0 ? Axis::x : Axis::y));
    s.modes.back().wn_rad_s *= std::pow(1.15, i);
  }
  return s;
}

/// The three-tooth slot cutter of Ozoegwu, Omenyi and Ofochebe.
inline System slot_cutter() {
  return {.modes = {{.axis = Axis::x,
                     .wn_rad_s = 5700,
                     .zeta = 0.02,
                     .k_N_mm = 0.431 * 5700 * 5700 / 1000}},
          .teeth = 3,
          .entry_rad = 0,
          .exit_rad = units::kPi,
          .force = PowerLawForce{
              .C = 3.5e7, .gamma = 0.75, .feed_speed_m_s = 0.0025, .normal_ratio = 0.3}};
}

}  // namespace turnwright::chatter
