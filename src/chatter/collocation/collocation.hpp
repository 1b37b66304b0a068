#pragma once
#include "chatter/model/map_spectrum.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// The largest multipliers, by collocation of the delayed motion on the nodes of
/// collocation_grid.hpp.  The displacements at the nodes of one period and the state at
/// its end are mapped to those of the next period.  spectrum_of() finds its eigenvalues.
///
/// On a collocation interval, with the Volterra matrix K of (2) of collocation_grid.hpp,
/// H of the directional factors and the displacements d of the period before,
///
///     (1 + w K H) q = e^(A t) u(begin) + w K H d                                    (1)
///     u(end) = e^(A length) u(begin) - w int e^(A (length - s)) B (q - d) ds        (2)
///
/// Valid at any speed, because only unstable motions grow over a period.
/// Source: derived here; checked in multipliers_test against a closed form and in
/// reference_methods_test against simulation.
/// @throws ModelRangeError if a period needs too many nodes, or if several multipliers
///   have so similar moduli that the largest does not converge to 1e-6.
Spectrum spectrum(const System& system, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
