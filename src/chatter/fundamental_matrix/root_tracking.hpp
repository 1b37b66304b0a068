#pragma once
#include <complex>

#include "characteristic.hpp"

namespace turnwright::chatter {

/// Range of depths over which a cut is shown to be unstable.
struct Tracked {
  double w_mm = 0;  ///< unstable on all of [from, w_mm]
  Complex z;        ///< the zero followed, at w_mm
};

/// Follows a zero z of f(z, w (1 - z)) inside the unit circle from the depth `from` to
/// `to` at most, in steps over each of which Newton's operator
///
///     z -> z - f/F_z,   F_z the slope at the middle of the step
///
/// maps a disc inside the unit circle into itself for every w of the step, so that a
/// multiplier stays outside the circle throughout.  It stops earlier where the zero
/// leaves the circle or meets another one.
/// Source: the Newton operator as a contraction, as in [Krawczyk 1969]; its use here
/// derived here.
Tracked unstable_until(const Characteristic& f, double from_mm, double to_mm, Complex z);

/// A zero near z by Newton's method; its real part is NaN if the method does not
/// converge.
Complex zero_near(const Characteristic& f, double w_mm, Complex z);

}  // namespace turnwright::chatter
