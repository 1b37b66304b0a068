#pragma once
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// Multipliers of one cut as collocation has them.
struct Spectrum {
  double radius = 0;  ///< the largest modulus
  int outside = 0;    ///< how many have a modulus above 1
};

/// The largest multipliers, by collocation of the delayed motion on the nodes
/// of collocation_grid.hpp: what the tool has left at the nodes of one period and its state
/// at the end are mapped to those of the next, and the largest eigenvalue of that map is
/// found by Arnoldi's method, with all beyond the unit circle (of a small map, all are).
///
/// On a stretch, with (2) of collocation_grid.hpp for the Volterra matrix K, H of the
/// directional factors and d the displacements a period before,
///
///     (1 + w K H) q = e^(A t) u(begin) + w K H d                                    (1)
///     u(end) = e^(A length) u(begin) - w int e^(A (length - s)) B (q - d) ds        (2)
///
/// Valid at any speed: nothing grows over a period but what is unstable.
/// Source: derived here; checked in multipliers_test against a closed form and in
/// reference_methods_test against simulation.
/// @throws ModelRangeError if a period needs too many nodes, or several multipliers are
/// so
///   near to each other in modulus that the largest does not settle to 1e-6.
Spectrum spectrum(const System& system, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
