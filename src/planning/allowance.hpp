#pragma once
#include <vector>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/tolerance/budget.hpp"

/// What else than the cut takes its part of a tolerance.
namespace turnwright::planning {

/// How a surface is made, as far as its budget depends on it.
struct Making {
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  const catalogue::Tool* last = nullptr;  ///< the tool of its last pass
};

inline constexpr const char* kMachine = "machine";  ///< sources, below
inline constexpr const char* kHeat = "heat";
inline constexpr const char* kMeasurement = "measurement";

/// Sizes (diameter, length, a profile located by datums) are moved up and down, zones
/// widened:
///
///     source        takes                          of
///     machine       machine_share_um, all kinds, and what machine_share.hpp says of
///                   an error model; its uncertainty is normal
///                                                  the whole width
///     jaw-squeeze   deflection/ring.hpp (1), a tube in jaws: its lobes of the zone of
///                   circularity, cylindricity, run-out and profile without datum; twice
///                   its largest displacement of a located profile
///     measurement   U of a zone, 2 U of a size     the whole width
///     drift         +- drift_um, uniform           sizes; axial ones of lengths
///     repeatability normal                         sizes
///     wear          +- r u/2, uniform, shop_errors.hpp (2), r of the whole life
///     heat          +- alpha dT D/4 of the radius, alpha dT L/2 of a length, uniform
///     rechucking    rayleigh, to a datum of another setup: twice of run-out, coaxiality
///                   and position, once of a profile; of what tilts, sqrt(2) D/grip, D
///                   the face's diameter or the axis' length
///
/// Two faces of a length that one setup cuts stand minutes apart in the same drift and,
/// cut by one tool, with the same edge; both look at the free end, so that their errors
/// d + w_1 and d + w_2 are of one sign and the length between them has w_2 - w_1,
///
///     one tool: neither drift nor wear;  two tools: each one's wear                  (0)
///
/// Source: derived here; drawn anew in allowance_test.  Each face is indexed on its own,
/// so that the repeatability counts for both.
///
/// Three lobes leave two-point diameters as they are, but for their even orders (a
/// tenth).
struct Allowance {
  std::vector<Share> fixed;               ///< [um] of the width
  std::vector<tolerance::Source> spread;  ///< of one end, sensitivities included
  double ends = 1;  ///< of the width: 1 of a zone, 2 of a size, for each face of a length
};
Allowance allowance(const PreparedPart& plan, std::size_t tolerance,
                    const Making& making);

/// Of the width, by all of it: what is fixed, and at each end the root of the sum of
/// squares of the spread, (3) of tolerance/budget.hpp [mm].
double taken_mm(const Allowance& allowance);

/// Of what is fixed that which parts have [um]: all but their measurement.
double fixed_in_parts_um(const Allowance& allowance);

/// Relative standard deviation of what the cut leaves: of forces and of stiffness.
double force_spread(const PreparedPart& plan);

/// What the cut has to do with a tolerance: nothing, an error, or one that its path is
/// corrected for.
enum class Cut { none, error, corrected };

/// Of a width w, for what the cut leaves: w - taken.  A robust plan asks of the parts
/// themselves, not of their measurement: at each of the ends, h = (w - fixed)/ends from
/// the middle of a size, or from 0 of a zone, the largest E of which parts whose force
/// and stiffness spread by r keep the limit with the wanted probability,
///
///     P(S + r E Z <= h - E) = p                                                     (1)
///
/// S the spread, Z standard normal; each face of a length may fail with (1 - p)/faces.
/// A size also fails at its other limit,
///
///     P(-h + E <= S + r E Z <= h - E) = p                                           (2)
///
/// With a constant offset (demand.hpp) the error reaches equally far to both sides and E
/// is half its range: (2) is then what P_conform is asked to be, no more and no less.
/// Without one E is the end that goes further, for which (2) suffices.  What a force or
/// stiffness that is not known scales is what the offset leaves: it is set by gauging the
/// first part, which shows the middle as it is.  With the path corrected E leaves nothing
/// but what is not known of it,
///
///     P(|S + r E Z| <= h) = p                                                       (3)
///
/// Where the cut has no part E is what S leaves over, (1) with r = 0.
/// Source: derived here; the left sides fall as E grows.
/// @param cut without effect on a plan that is not robust.
/// @return ends E [mm].
double left_mm(const PreparedPart& plan, std::size_t tolerance,
               const Allowance& allowance, Cut cut);

/// What each source takes of the width on its own, a spread by its reach; both faces of a
/// length together.
std::vector<Share> shares(const Allowance& allowance);

/// Upper less lower limit, or the zone's width [mm].
double width_mm(const part::Tolerance& tolerance);

/// That width so many times as large, limits about their middle.
void widen(part::Tolerance& tolerance, double times);

/// Faces of a `length` that this plan cuts: they share what the tolerance leaves.
double faces_cut(const PreparedPart& plan, const part::Tolerance& tolerance);

}  // namespace turnwright::planning
