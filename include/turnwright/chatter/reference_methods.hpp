#pragma once
#include <functional>

#include "turnwright/chatter/dominant.hpp"
#include "turnwright/chatter/stability_limits.hpp"
#include "turnwright/chatter/system.hpp"

/// Independent methods by which limits.hpp is checked.  No result rests on them.
namespace turnwright::chatter {

/// First-order semi-discretisation: the period in `intervals` equal steps, the
/// directional factors averaged over each, the delayed displacement interpolated
/// linearly.  The error falls with the square of the interval.
/// Source: [Insperger 2002] and [Insperger 2004], the method; formulas derived here.
/// @param intervals  >= 1.
Dominant semi_discretisation(const System& system, double n_rpm, double ap_mm,
                             int intervals);

/// Time finite elements: cubic Hermite polynomials on `elements` equal parts of the
/// period, residuals weighted by 1 and theta/t_k - 1/2.
/// Source: [Ozoegwu 2013], Eqs. (4) to (15), here for any number of modes; its Eq. (11),
/// lost in print, is a_k1 = a_(k-1)3, a_k2 = a_(k-1)4.  The method is that of
/// [Bayly 2003].
/// @param elements  >= 1.
Dominant time_finite_elements(const System& system, double n_rpm, double ap_mm,
                              int elements);

/// The delay equation integrated step by step over `periods` tooth periods from a given
/// history by a fourth-order Runge-Kutta method; the last nine states, a period apart,
/// are fitted by a linear map, whose eigenvalues are the dominant multipliers.
struct SimulationOptions {
  int periods = 120;          ///< with more periods the lesser multipliers have decayed
  double steps_per_rad = 20;  ///< of the fastest mode
  double most_steps = 1e5;    ///< of a period; each takes a kilobyte
};
/// @throws ModelRangeError if a period takes more steps than the options allow.
Dominant simulation(const System& system, double n_rpm, double ap_mm,
                    const SimulationOptions& options = {});

/// Steps that simulation() takes a period; its time is proportional to them and to the
/// number of periods.
double simulation_steps(const System& system, double n_rpm,
                        const SimulationOptions& options = {});

/// The limits of stability that `method` finds on `depths` equal steps up to ap_max, each
/// change of its verdict bisected.  Islands thinner than a step are missed;
/// relative_error is not estimated (NaN).
SpeedLimits scanned_limits(const System& system, double n_rpm, double ap_max_mm,
                           int depths,
                           const std::function<Dominant(double ap_mm)>& method);

}  // namespace turnwright::chatter
