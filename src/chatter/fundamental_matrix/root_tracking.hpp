#pragma once
#include <complex>

#include "characteristic.hpp"

namespace turnwright::chatter {

/// How far a cut is shown to stay unstable.
struct Tracked {
  double w_mm = 0;  ///< unstable on all of [from, w_mm]
  Complex z;        ///< the zero followed, at w_mm
};

/// Follows a zero z of f(z, w (1 - z)) inside the unit circle from the depth `from` to
/// `to` at most, in steps over each of which Newton's operator
///
///     z -> z - f/F_z,   F_z the slope at the middle of the step
///
/// maps one disc inside the unit circle into itself for every w of the step, so that a
/// multiplier stays outside the circle throughout.  Stops short where the zero leaves or
/// meets another one.
/// Source: derived here.
Tracked unstable_until(const Characteristic& f, double from_mm, double to_mm, Complex z);

/// Newton's method for a zero near z; empty real part NaN if it does not settle.
Complex zero_near(const Characteristic& f, double w_mm, Complex z);

}  // namespace turnwright::chatter
