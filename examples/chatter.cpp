// The depth up to which milling with one mode is stable, over the spindle speed.
#include <cstdio>

#include "turnwright/base/units.hpp"
#include "turnwright/chatter/limits.hpp"

int main() {
  using namespace turnwright;
  const auto engagement = chatter::down_milling(0.1);
  const chatter::System system{
      .modes = {{.wn_rad_s = 2 * units::kPi * 922, .zeta = 0.011, .k_N_mm = 1340}},
      .teeth = 2,
      .entry_rad = engagement.entry_rad,
      .exit_rad = engagement.exit_rad,
      .force = chatter::LinearForce{.Kt_MPa = 600, .Kn_MPa = 200}};
  const double most_mm = 10;
  for (const double n_rpm : {9000.0, 12000.0, 15000.0, 18000.0}) {
    const auto limit_mm = chatter::speed_limits(system, n_rpm, most_mm).limit_mm();
    std::printf("%5.0f 1/min: stable %s %.2f mm\n", n_rpm, limit_mm ? "below" : "to",
                limit_mm.value_or(most_mm));
  }
}
