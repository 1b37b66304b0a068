#pragma once
#include <optional>
#include <span>
#include <vector>

#include "taylor_patch.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/chatter/stability_limits.hpp"
#include "turnwright/chatter/system.hpp"

namespace turnwright::chatter {

inline constexpr const char* kOnCircle = to_translate(
    "milling: a multiplier lies on the unit circle to within rounding, so the "
    "cut is on a limit of stability; ask for a slightly different speed or "
    "depth");

/// A depth at which a multiplier e^(i theta) lies on the unit circle.
struct OnCircle {
  double w_mm = 0;
  double theta = 0;  ///< of mu, in (0, pi]
  int change = 0;    ///< change of the number of unstable multipliers as w rises past it
  double relative_error = 0;                ///< estimated, of w
  std::optional<double> frequency_Hz = {};  ///< if it is known and not only theta
  bool flip() const;                        ///< mu = -1
};

/// The crossing of a chart for a depth on the circle: a loss of stability, or a gain.
Crossing crossing(const OnCircle& at, bool loss, const System& system, double tau_s);

/// The crossings among all rising depths on the circle, and counts at `depths_mm`.
SpeedLimits charted(const std::vector<OnCircle>& zeros, const System& system,
                    double n_rpm, double tau_s, std::span<const double> depths_mm);

/// Every depth in (from, to] at which a multiplier lies on the unit circle, rising.
///
/// g(w, theta) of taylor_patch.hpp is searched for zeros over (from, to] x [0, pi], box
/// by box.  A box is settled once its linear part is farther from 0 than the remainder
/// can reach, or once Krawczyk's operator shows that it holds exactly one zero or none;
/// otherwise it is halved.  So no zero is missed unless the bound on rounding errors
/// fails. Zeros are then refined by Newton's method on `fine`; the difference between the
/// zeros of `coarse` and `fine` is the error estimate.
///
/// Zeros at mu = -1 lie on the border of the search, where g is real.  The boxes at the
/// border are symmetric about it, so a single zero in one lies on the border.  At theta =
/// 0 there are no zeros, because kappa = 0 for every w: a cyclic fold cannot occur.
///
/// Source: [Krawczyk 1969], the operator; the search derived here.
/// @throws ModelRangeError if the search needs more than `kBoxes` boxes, see
///   krawczyk_search.hpp.
std::vector<OnCircle> on_circle(const Characteristic& coarse, const Characteristic& fine,
                                double from_mm, double to_mm);

/// The same in (0, to] by a series that is valid for kappa up to 2.2 `to`.  The errors of
/// the zeros follow from the noise of the series; where that is large they are refined as
/// above.
std::vector<OnCircle> on_circle(const Series& series, const Characteristic& coarse,
                                const Characteristic& fine, double to_mm);

/// Number of zeros z of f(z, w (1 - z)) inside |z| = rho, that is of multipliers outside
/// |mu| = 1/rho: the winding number of g.  Its chords represent arcs that are shown to
/// stay on one side of 0.
/// @throws ModelRangeError if a zero lies on the circle to within rounding.
int multipliers_outside(const Characteristic& f, double w_mm, double rho = 1);
int multipliers_outside(const Series& series, double w_mm);

}  // namespace turnwright::chatter
