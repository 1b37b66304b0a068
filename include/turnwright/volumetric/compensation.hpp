#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/gcode/read_nc.hpp"
#include "turnwright/volumetric/machine.hpp"

namespace turnwright::volumetric {

using gcode::NcMove;
using gcode::NcProgram;
using gcode::NcSetup;

enum class Method {
  full_field,  ///< every point is corrected by the error there
  affine,      ///< by the affine map that fits the corrections of all points best
  average      ///< by their mean, which is a shift of the origin
};

enum class AtRest {
  last,  ///< an axis at rest keeps the side of its backlash from its last motion
  none   ///< s = 0, whatever its correction does
};

struct CompensationOptions {
  Method method = Method::full_field;
  AtRest at_rest = AtRest::last;
  int passes = 2;    ///< of the fixed-point iteration
  int decimals = 6;  ///< decimals written in mm; inches get two more
  /// Straight feed moves are split until the correction is linear within this.
  double tolerance_mm = 1e-3;
};

/// Distances of the tip from its targets at the ends of all moves.
struct Deviation {
  double max_mm = 0, rms_mm = 0;
};

struct Compensated {
  std::vector<std::string> lines;
  Deviation before, after;            ///< after: by the coordinates as written
  std::size_t points = 0, added = 0;  ///< moves written, and those added to the source's
  double largest_correction_mm = 0;
  /// Distance of the tip from its target at each point, before and after.
  std::vector<std::array<float, 2>> distances_mm;
};

/// The corrected program: on the machine with its errors its moves end at the targets of
/// the source.  For a tip T(q) = nominal + error and a target P,
///
///     q_0 = q(P),   q_{k+1} = q_k - (T(q_k) - P)                                     (1)
///
/// in which each pass reduces the error by the size of the errors' slopes (1e-4).  Rotary
/// axes stand at 0.  The spindle of a lathe turns; its harmonics have no mean effect and
/// are omitted.  Only the machine's own axes are corrected and counted (tangential errors
/// of a lathe act by y^2/2R).  Signs of motion are those of the corrected motions, down
/// to half the last decimal written, so an axis that stands still in the source but
/// follows a bow has them, too.
///
/// Where an axis reverses in a feed move its backlash is taken up first.  Added moves
/// approach the start of the feed from the feed's own side, overshooting if necessary;
/// offsets of one unit of the last decimal are left.
/// @throws std::domain_error as Kinematics; ModelRangeError if (1) reduces an error by
///   less than half, because the errors change by as much as the position.
Compensated compensate(const NcProgram& program, const Machine& machine,
                       const NcSetup& setup, const CompensationOptions& options = {});

}  // namespace turnwright::volumetric
