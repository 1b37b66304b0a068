#pragma once

#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {

/// The tailstock's live centre as a body that tools must clear: a point of 60 deg that goes
/// on as a cylinder, and the body with its bearings.  The numbers are estimates for an
/// extended point with Morse taper 4, for machines whose document has none.
struct LiveCentre {
  double point_mm = 16;         ///< diameter of the cylinder behind the cone
  double point_length_mm = 55;  ///< from the tip of the cone to the body
  double body_mm = 60;          ///< diameter of the body
};

/// The least radius [mm] at which the tip of a turning tool may stand z_mm in front of the
/// free face while insert and holder clear the centre.  The cone sits in a countersink of a
/// diameter hole_mm, so that the centre has the radius
///
///     R(z) = hole/2 + z tan 30 deg, at most point/2, and from
///     z = point_length - hole/2/tan 30 deg on body/2,                             (1)
///
/// In a bore wider than the point a bull-nose centre is taken to sit that is as wide as the
/// bore, on the same body.  The tip must be at max over z of R(z + z_tip) - h(z), with the lowest points h(z) of
/// the outline (tool_outline.hpp).  Both are piecewise linear: the maximum is at a corner of
/// one of them.  The insert has sharp corners, on the
/// safe side; a tool whose document has no holder is its insert alone.
/// Source: derived here.
/// @throws std::domain_error if the insert's designation cannot be read.
double clear_radius_mm(const Tool& tool, const LiveCentre& centre, double hole_mm,
                       double z_mm);

}  // namespace turnwright::catalogue
