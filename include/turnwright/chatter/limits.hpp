#pragma once
#include <span>

#include "turnwright/chatter/stability_limits.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// Every crossing in (0, ap_max], including those of islands.
///
/// On the boundary q(t - tau) = q(t)/mu with |mu| = 1, so that a fundamental matrix
/// Phi(kappa), kappa = w (1 - 1/mu), of a motion without delay decides: the cut is
/// unstable if det(I - z Phi(w (1 - z))) has a zero z = 1/mu inside the unit circle.  The
/// depths at which a zero lies on the circle are found by a search that cannot miss one
/// (stability_crossings.hpp), on one series in kappa as far as that is precise
/// (series.hpp).  Beyond it, above a loss, a zero is followed through the inside of the
/// circle as far as it stays there (root_tracking.hpp).  These files are in
/// src/chatter/fundamental_matrix/.
///
/// Of the chatter frequencies of a multiplier e^(i theta),
///
///     (k +- theta / 2 pi) / tau,   k = 0, 1, ..                                     (1)
///
/// the one nearest to a natural frequency is given.  For turning, which cuts the same at
/// every angle and needs no Phi (src/chatter/turning.hpp), it is the true frequency.
///
/// Valid for any number of modes and teeth; the work grows with wn tau and with the ratio
/// of the depth to the first limit.  Unlike the zero-order method of [Altintas 1995],
/// which averages the directional factors over a tooth period, it finds flips and islands
/// at any immersion.
/// Source: the equation of motion is that of [Altintas 1995] and [Insperger 2004]; the
/// method is derived here, checked in accuracy_test against direct integration and in
/// limits_test against printed charts of the literature's benchmark, semi-discretisation
/// and simulation.
/// @param depths_mm  rising, up to ap_max; the unstable multipliers are counted there, by
///   the crossings below, or by winding numbers where a zero was followed past the depth.
/// @throws ModelRangeError if the search takes longer than a few seconds, or if a
///   multiplier lies on the circle at one of the depths to within rounding.
SpeedLimits speed_limits(const System& system, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm = {});

/// Multipliers of one cut.  The count is a winding number, each of whose chords is shown
/// to represent its arc.  Where that would take too long (a tooth period of very many
/// vibrations) the multipliers are counted by collocation, which always gives the
/// spectral radius; see src/chatter/collocation/collocation.hpp.
/// @throws ModelRangeError if a multiplier lies on the unit circle to within rounding, or
///   if a tooth period holds too many vibrations for either.
Multipliers multipliers(const System& system, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
