#pragma once
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// Of the chatter frequencies of a multiplier e^(i theta), limits.hpp (1), the one
/// nearest a natural frequency [Hz].
double chatter_frequency_Hz(const System& system, double tau_s, double theta_rad);

}  // namespace turnwright::chatter
