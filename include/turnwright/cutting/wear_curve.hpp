#pragma once
#include <span>

namespace turnwright::cutting {

/// Width VB of the wear land on the flank after a time of cutting.
struct WearPoint {
  double t_min = 0, VB_mm = 0;
};

struct CurveLife {
  double T_min = 0;
  bool longer =
      false;  ///< the criterion was not reached: T_min is the last time measured
};

/// Life of an edge by its measured wear curve: the first time at which VB reaches the
/// criterion, by straight lines from point to point and from the new edge, VB = 0 at t =
/// 0, to the first.  The curve is not continued beyond its last point.
/// Between points of a curve that bends upwards the chord lies above it, so that the life
/// comes out short; with a point every tenth of the life by less than 1 % of it.
/// Source: derived here, checked in wear_curve_test.
/// @throws std::domain_error unless times rise from above 0, VB is not negative and the
///   criterion is positive, all of them finite, with at least one point.
CurveLife life_of_curve(std::span<const WearPoint> curve, double criterion_mm);

}  // namespace turnwright::cutting
