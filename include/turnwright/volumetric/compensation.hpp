#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/volumetric/machine.hpp"
#include "turnwright/volumetric/nc_program.hpp"

namespace turnwright::volumetric {

enum class Method {
  full_field,  ///< every point by the error there
  affine,      ///< by the affine map nearest to the errors at all points
  average      ///< by their mean: a shift of the origin
};

enum class AtRest {
  last,  ///< an axis at rest keeps the side of its play that its last motion left
  none   ///< s = 0, whatever its correction does
};

struct CompensationOptions {
  Method method = Method::full_field;
  AtRest at_rest = AtRest::last;
  int passes = 2;    ///< of the fixed-point iteration
  int decimals = 6;  ///< written, of a mm; inches get two more
  /// Straight feed moves are split until the correction is straight within this.
  double tolerance_mm = 1e-3;
};

/// Distances of the tip from where it should be, at the ends of all moves.
struct Deviation {
  double max_mm = 0, rms_mm = 0;
};

struct Compensated {
  std::vector<std::string> lines;
  Deviation before, after;            ///< after: of the coordinates as written
  std::size_t points = 0, added = 0;  ///< moves written; those not in the source's moves
  double largest_correction_mm = 0;
  /// Distances of the tip from where it should be at each point, before and after.
  std::vector<std::array<float, 2>> distances_mm;
};

/// The program whose moves, made by the machine with its errors, end where the source's
/// should.  For a tip T(q) = nominal + error and a target P,
///
///     q_0 = q(P),   q_{k+1} = q_k - (T(q_k) - P)                                     (1)
///
/// which gains the size of the errors' slopes (1e-4) with each pass.  Rotary axes stand
/// at 0, a lathe's spindle turns: its harmonics shift nothing in the mean and are left
/// out.  Only axes the machine has are corrected and counted (tangential errors of a
/// lathe act by y^2/2R).  Signs are those of the corrected motions, down to half the last
/// decimal written: an axis that stands in the source and follows a bow has them too.
/// Where an axis turns back in a feed move, play is taken up first by moves of its own, so
/// that all axes start on the side on which the feed keeps them: those which would have to
/// go there against it go beyond and come again; for one of the last decimal they stay.
/// @throws std::domain_error as Kinematics; ModelRangeError if (1) leaves more than
///   half of an error, errors changing by as much as the way.
Compensated compensate(const NcProgram& program, const Machine& machine,
                       const NcSetup& setup, const CompensationOptions& options = {});

}  // namespace turnwright::volumetric
