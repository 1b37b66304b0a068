#pragma once
#include <span>

#include "turnwright/deflection/feedback.hpp"

namespace turnwright::deflection {

/// A blank that runs out by eps makes the set depth swing over a revolution,
/// ap(psi) = ap + eps cos(psi), and the part, giving way with the depth, keeps
///
///     eps' = (e(ap + eps) - e(ap - eps))/2                                      (1)
///
/// of it; in the linear case (x = 1, B = 0) eps' = eps mu/(1 + mu) in every pass, so n
/// passes leave (mu/(1 + mu))^n.  e(ap) is the equilibrium of feedback.hpp: valid while
/// the spindle is slow against the part's lowest natural frequency.
/// Source: derived here from feedback.hpp (1), (2).
///
/// @return eps' after each of the passes with set depths `ap_mm`.
/// @throws std::domain_error as `equilibrium`, or unless 0 <= eps < the depth to cut: the
/// tool would leave the part.
std::vector<double> copied_runout_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential,
                                            const ForceLaw& law, double runout_mm,
                                            std::span<const double> ap_mm);

}  // namespace turnwright::deflection
