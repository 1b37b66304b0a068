#pragma once
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// The chatter frequency [Hz] of a multiplier e^(i theta): the one of limits.hpp (1) that
/// is nearest to a natural frequency.
double chatter_frequency_Hz(const System& system, double tau_s, double theta_rad);

}  // namespace turnwright::chatter
