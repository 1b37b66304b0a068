#pragma once
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/volumetric/lathe_part.hpp"

/// The axis of a common datum A-B of ISO 5459, the datum of most shafts.
///
/// It goes through the middles z_A, z_B of two elements, whose own axes lie there off the
/// spindle of the toleranced surface by the vectors a, b.  At z it is off by
///
///     c(z) = w_A a + w_B b,   w_B = (z - z_A)/(z_B - z_A),   w_A = 1 - w_B          (1)
///
/// and leans by
///
///     c'   = (b - a)/(z_B - z_A)                                                    (2)
///
/// Beyond its elements a weight is negative and the other larger than 1: overhanging
/// places see a lever.  The tilt of each element's own axis is left to (2), because a seat
/// is short against the distance of two.  The worse end of a surface decides; where two
/// setups err independently either end may be the worse, which adds 2 to 3 % to the reach.
/// Source: derived here, checked by Monte Carlo in common_datum_test.
namespace turnwright::planning {

/// What an offset of each datum element's axis counts for in the datum's axis.
struct DatumWeights {
  double a = 1, b = 0;
};

/// The weights (1) at z; those of a single datum are 1 and 0.
DatumWeights datum_weights(const part::Drawing& drawing, const part::Tolerance& tolerance,
                           double z_mm);

/// Where an axis passes, across the spindle's axis.
struct Across {
  double x_mm = 0, y_mm = 0;
};

/// The axis through `a` at z_a and `b` at z_b, (1) and (2).
/// @throws std::domain_error if both have one place.
volumetric::DatumAxis axis_through(double z_a_mm, const Across& a, double z_b_mm,
                                   const Across& b);

/// Middle [mm] of an element along the part.
/// @throws std::domain_error if the drawing has no such element.
double middle_z_mm(const part::Drawing& drawing, const std::string& element);

}  // namespace turnwright::planning
