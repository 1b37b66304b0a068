#pragma once
#include <cstddef>
#include <functional>
#include <span>

#include "turnwright/deflection/workpiece.hpp"

namespace turnwright::deflection {

/// The largest |e| over the length of a part, and its position.
struct Envelope {
  double max_mm = 0;
  double at_mm = 0;
};

/// Errors e [mm] at positions that all lie on one segment, its ends included: at a step
/// the two segments give their own one-sided limits.
using ErrorOnSegment = std::function<void(
    std::size_t segment, std::span<const double> a_mm, std::span<double> e_mm)>;

/// Largest |e| over all segments.
///
/// On every segment e is smooth.  The segment is halved until the polynomial of degree 8
/// through 9 Chebyshev points agrees with e at the 8 points between them to 1e-6 of the
/// largest |e|.  Such a polynomial exceeds its largest value at the 17 points by a factor
/// of at most 1/cos(pi/4) = 1.42 (Ehlich, Zeller), so only sampled peaks within that
/// factor of the largest sample have to be refined (Brent) on e itself.
/// Exact to rounding for every e that is smooth on the segments; of equal peaks the
/// leftmost is returned.
/// @throws ModelRangeError if ten thousand parts of segments are not enough, as happens
///   where e is nothing but rounding.
/// Source: derived here, checked in envelope_test.
Envelope envelope(std::span<const double> ends_mm, const ErrorOnSegment& error);

}  // namespace turnwright::deflection
