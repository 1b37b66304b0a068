#pragma once
#include <functional>
#include <optional>

#include "turnwright/review/program.hpp"

/// Ways of the tip where a program has tool nose radius compensation.
namespace turnwright::review {

/// The round nose of a tool; its tip is where its tangents along both axes meet.
struct Nose {
  double radius_mm = 0;
  bool inner = false;  ///< of a bar: the tip lies outwards of the nose's centre
};

/// The same program with moves of the tip alone.  Of a contour with G41 or G42 the nose's
/// centre goes the nose's radius r beside it, around outer corners on an arc about them,
/// in inner corners to where both ways meet; the tip is
///
///     x_tip = x - r (x + r in a bore),  z_tip = z - r.                                 (1)
///
/// The first move with compensation ends square to the beginning of the second, the last
/// one square to its end; the next after G40 ends in its place.  Listed as unknown are
/// corners that the nose cannot enter, whose ways are joined straight, and threads, which
/// stay.  Tools without a nose, of which `nose_of` gives none, keep their moves.
/// Source: derived here; linuxcnc_test compares with LinuxCNC's interpreter.
TurningProgram with_nose_paths(
    const TurningProgram& program,
    const std::function<std::optional<Nose>(int tool)>& nose_of);

}  // namespace turnwright::review
