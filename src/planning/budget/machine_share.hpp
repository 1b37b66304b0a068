#pragma once
#include <cstddef>
#include <map>

#include "turnwright/planning/prepared_part.hpp"

/// The share of the lathe's own geometric errors in every tolerance.
namespace turnwright::planning {

/// The shares by tolerance, setup and clamping, as PreparedPart::machine_takes stores
/// them; empty without an error model.  Needs `work` of the part.
///
/// Every surface is cut by the calibrated machine (volumetric/lathe_part.hpp) at its
/// position in the setup,
///
///     z_machine = jaws_z + |z - z_root|                                              (1)
///
/// where z_root is the end of the jaws (between centres: the held end), and the free end
/// of the part is in +Z.  Outside surfaces are approached from outside, bores from
/// inside; both are cut towards the chuck unless an operation has another direction.
/// Faces are cut inwards after the tool has been brought up in -Z.  Then the surface is
/// measured:
///
///     kind                           share of the width
///     diameter                       2 max |d|, d of every two-point diameter
///     length                         2 max |d|, d between the faces' extremes; faces of
///                                    two setups by (2)
///     profile                        2 max |e|, and the datum's axis
///     circularity, straightness, flatness, cylindricity, profile without datum
///                                    narrowest zone
///     runout, coaxiality, position, parallelism, perpendicularity, angularity
///                                    zone about the datum of least squares
///
/// If the first part is gauged an offset removes its mean: max d - min d for sizes.  In a
/// later setup the part rests on its held end H; two faces A, B from different setups are
/// then apart by
///
///     d = (e_B - e_H) - (e_H - e_A) in the setups of B and of A                      (2)
///
/// with the sign of A's position.  A datum that was cut in another setup has an offset
/// and a tilt against the spindle, at an unknown angle to the toleranced surface: twice
/// the largest offset, or the tilt across the face, is added.  The axis of a common datum
/// goes through the middles of its two elements (common_datum.hpp); what each of the other
/// setups cut of it is added likewise.
///
/// The narrowest zone, 2 max |d| and every range above are seminorms, so the share of the
/// cut and the machine together is at most the sum of both.  The same holds for each
/// uncertain parameter x_k: the field of u(x_k) is measured like the whole, and
///
///     u^2 = sum_k width(u(x_k))^2 (3)
///
/// is used as the standard uncertainty of the machine's share.  It is exact for one
/// parameter; for several it is exceeded as often as that of a normal distribution.
/// Source: derived here, checked by Monte Carlo in machine_share_test.
std::map<MachinePlace, MachineTake> machine_takes(const PreparedPart& plan);

/// The share in a tolerance whose surface is cut in this setup and clamping; zero without
/// an error model.
/// @throws std::domain_error for a surface that is not cut there.
MachineTake machine_take(const PreparedPart& plan, std::size_t tolerance,
                         std::size_t setup, Clamping clamping);

/// Least share of the machine (error model and machine_share_um) in a tolerance over the
/// clampings of each setup that cuts it [mm]; unless the plan is robust it includes 3 u
/// of the uncertainty.
double least_machine_mm(const PreparedPart& plan, std::size_t tolerance);

}  // namespace turnwright::planning
