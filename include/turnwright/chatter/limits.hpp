#pragma once
#include <span>

#include "turnwright/chatter/stability_limits.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

/// Every crossing in (0, ap_max], islands included.
///
/// On the boundary q(t - tau) = q(t)/mu with |mu| = 1, so that one fundamental matrix
/// Phi(kappa), kappa = w (1 - 1/mu), decides: the cut is unstable if
/// det(I - z Phi(w (1 - z))) has a zero z = 1/mu inside the unit circle.  Depths at which
/// a zero lies on the circle are found by a search that cannot miss one, see
/// stability_crossings.hpp, on one series in kappa as far as that is precise, see
/// series.hpp; beyond, above a loss, a zero is followed through the inside of the circle as
/// far as it stays there, see root_tracking.hpp (all of src/chatter/fundamental_matrix/).
///
/// Of the chatter frequencies of a multiplier e^(i theta),
///
///     (k +- theta / 2 pi) / tau,   k = 0, 1, ..                                     (1)
///
/// the one nearest a natural frequency is given; of turning, which cuts at every angle
/// alike and needs no Phi (src/chatter/turning.hpp), the true one.
///
/// Valid for any number of modes and teeth; the work grows with wn tau and with the depth
/// over the first limit.  Unlike the zero-order method of [Altintas 1995], which averages
/// the directional factors over a tooth period, it finds flips and islands at any
/// immersion.
/// Source: the equation of motion is that of [Altintas 1995] and [Insperger 2004]; the
/// method is derived here, checked in accuracy_test against direct integration and in
/// limits_test against printed charts of the literature's benchmark, semi-discretisation
/// and simulation.
/// @param depths_mm  rising, up to ap_max: counted too, by the multipliers that crossed
///   below; where a zero was followed past them, by winding numbers.
/// @throws ModelRangeError if the search becomes longer than a few seconds, or if a
///   multiplier lies on the circle at one of the depths to within rounding.
SpeedLimits speed_limits(const System& system, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm = {});

/// The count is a winding number whose every chord is shown to hide no turn; where that
/// would take too long (a tooth period of very many vibrations) it is that of the
/// multipliers which collocation finds, and so is the spectral radius always, see
/// src/chatter/collocation/collocation.hpp.
/// @throws ModelRangeError if a multiplier lies on the unit circle to within rounding, or
///   if a tooth period holds too many vibrations for either.
Multipliers multipliers(const System& system, double n_rpm, double ap_mm);

}  // namespace turnwright::chatter
