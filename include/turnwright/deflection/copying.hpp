#pragma once
#include <span>

#include "turnwright/deflection/feedback.hpp"

namespace turnwright::deflection {

/// The run-out of a blank is copied, reduced, to the turned surface.  A run-out eps makes
/// the set depth vary over a revolution, ap(psi) = ap + eps cos(psi).  The part yields
/// more where the depth is larger, so that the surface keeps the run-out
///
///     eps' = (e(ap + eps) - e(ap - eps))/2                                      (1)
///
/// In the linear case (x = 1, B = 0) eps' = eps mu/(1 + mu) in every pass, and n passes
/// leave (mu/(1 + mu))^n.  e(ap) is the equilibrium of feedback.hpp; valid while the
/// spindle's frequency is low against the part's lowest natural frequency.
/// Source: derived here from feedback.hpp (1), (2).
///
/// @return eps' after each of the passes with set depths `ap_mm`.
/// @throws std::domain_error as `equilibrium`, or unless 0 <= eps < the depth to cut,
/// because the tool would otherwise leave the part.
std::vector<double> copied_runout_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential,
                                            const ForceLaw& law, double runout_mm,
                                            std::span<const double> ap_mm);

}  // namespace turnwright::deflection
