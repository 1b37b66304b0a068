#pragma once
#include <cstddef>
#include <map>

#include "turnwright/planning/prepared_part.hpp"

/// What the lathe's own geometric errors take of the tolerances.
namespace turnwright::planning {

/// By tolerance, by setup and place of what is cut there, as PreparedPart::machine_takes
/// holds it; empty without an error model.  Needs `work` of the part.
///
/// Every surface is cut by the machine as calibrated (volumetric/lathe_part.hpp), where
/// it stands in its setup,
///
///     z_machine = jaws_z + |z - z_root|                                              (1)
///
/// z_root where the jaws end (between centres: the held end), the free end in +Z
/// whichever end of the part it is; outside surfaces with X coming from outside, bores
/// from inside, both towards the chuck unless an operation says otherwise, faces inwards,
/// the tool brought up in -Z.  Then the surface is measured:
///
///     kind                           takes of the width
///     diameter                       2 max |d|, d of every two-point diameter
///     length                         2 max |d|, d between the faces' extremes; faces of
///                                    two setups by (2)
///     profile                        2 max |e|, datum's axis besides
///     circularity, straightness, flatness, cylindricity, profile without datum
///                                    narrowest zone
///     runout, coaxiality, position, parallelism, perpendicularity, angularity
///                                    zone about the datum of least squares
///
/// If the first part is gauged its mean offset drops out: max d - min d of sizes.  A
/// later setup stands on its held end H; the faces A, B it has from two setups are apart
/// by
///
///     d = (e_B - e_H) - (e_H - e_A) in the setups of B and of A                      (2)
///
/// with the sign of A's place.  A datum of another setup lies off the spindle there by
/// its own offset and tilt, at an unknown angle to the toleranced surface: twice the
/// largest offset, or the tilt across the face, is added.
///
/// The narrowest zone, 2 max |d| and every range above are seminorms: what the cut and
/// the machine do to a surface together never takes more than both alone.  The same holds
/// of each uncertain parameter x_k: the field of u(x_k) is measured like the whole, and
///
///     u^2 = sum_k width(u(x_k))^2 (3)
///
/// is taken for the standard uncertainty of what the machine takes: exact for one
/// parameter, and of several as often kept as a normal (by drawing machines, in the
/// test). Source: derived here, checked by Monte Carlo in machine_share_test.
std::map<MachinePlace, MachineTake> machine_takes(const PreparedPart& plan);

/// Of a tolerance whose surface is cut in this setup and clamping; none without an error
/// model.
/// @throws std::domain_error of a surface that is not cut there.
MachineTake machine_take(const PreparedPart& plan, std::size_t tolerance,
                         std::size_t setup, Clamping clamping);

/// The least that the machine, error model and machine_share_um, takes of a tolerance in
/// any clamping of each setup that cuts it; 3 u of what is uncertain unless the plan is
/// robust [mm].
double least_machine_mm(const PreparedPart& plan, std::size_t tolerance);

}  // namespace turnwright::planning
