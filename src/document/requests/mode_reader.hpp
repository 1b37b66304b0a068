#pragma once
#include <optional>

#include "document/json/reader.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::document {

inline const Bounds kModeDamping = within(1e-6, 10), kModeMass = within(1e-9, 1e9, "kg");

/// {"frequency_Hz", "damping_ratio", "mass_kg" or "stiffness_N_mm"}; refuses other keys that
/// have not been read before.
/// @param damping  ratio where none is given; none: it is required.
chatter::Mode read_mode(Reader r, chatter::Axis axis,
                        std::optional<double> damping = std::nullopt);

double stiffness_N_mm(double mass_kg, double wn_rad_s);

}  // namespace turnwright::document
