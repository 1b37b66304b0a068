#pragma once
#include <optional>

#include "turnwright/chatter/system.hpp"

/// Turning with a spindle speed that swings about its mean, which lets the waves of two
/// revolutions no longer keep step.
///
///     n(t) = n0 (1 + RVA sin(2 pi f t)),     f = RVF n0/60                           (1)
///     x'' + 2 zeta wn x' + wn^2 x = -(wn^2/k) K w (x(t) - x(t - tau(t)))             (2)
///     int from t - tau to t of n dt' = 1 revolution                                  (3)
///
/// for each mode, x their sum at the cut.  Over the angle s of the spindle, counted in
/// revolutions, the delay is 1, and 1/RVF revolutions are a period.
///
/// Valid for a force that does not depend on the cutting speed, without process damping,
/// and a spindle that follows (1).  The tool's edge stays in the cut.
/// Source: [Insperger 2004b] for (1) and (2) by semi-discretisation; the method derived
/// here, checked in speed_variation_test against semi-discretisation and the constant speed.
namespace turnwright::chatter {

struct SpeedVariation {
  double rva = 0;  ///< RVA, amplitude over the mean, in [0, 0.9]
  double rvf = 0;  ///< RVF, frequency over that of the spindle, in [0.01, 1]
};

struct VariedLimit {
  std::optional<double> limit_mm;  ///< the first loss; none up to the largest depth
  double relative_error = 0;       ///< estimated, of limit_mm
};

/// The least depth found at which the cut turns unstable.  Over a period the motion is
/// collocated on pieces of a revolution, of which one is the same as the next, so that
/// delayed values need no interpolation; at the end of the period the last revolution is
/// interpolated by the polynomials of its pieces.  The largest multiplier follows by
/// spectrum_of() in src/chatter/model.
///
/// Depths below
///
///     w K sum_i 1/(2 k_i zeta_i sqrt(1 - zeta_i^2)) (1 + sqrt((1 + RVA)/(1 - RVA))) < 1  (4)
///
/// are stable: there the delayed force cannot return as much energy as it takes
/// (small gain; the root bounds the norm of x(t - tau(t)) by that of x(t)).  From there
/// depths 5 % apart are judged, and the first change is resolved; an island of instability
/// narrower than that is missed.  `relative_error` is three times the difference between 10
/// and 14 nodes a piece, and at least 1e-9.
/// @param system  with a constant force and modes along x, damping ratios below 0.7.
/// @throws ModelRangeError if a period has too many vibrations.
VariedLimit varied_limit(const System& system, double n_rpm,
                         const SpeedVariation& variation, double ap_max_mm);

/// Growth of the largest multiplier per revolution, ln |mu| RVF, with `nodes` a piece.
double growth_per_revolution(const System& system, double n_rpm,
                             const SpeedVariation& variation, double ap_mm,
                             std::size_t nodes);

}  // namespace turnwright::chatter
