#pragma once
#include <vector>

#include "turnwright/base/language.hpp"
#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"
#include "turnwright/tolerance/budget.hpp"

/// Shares of a tolerance that sources other than the cut take.
namespace turnwright::planning {

/// The conditions of making a surface that its budget depends on.
struct Making {
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  const catalogue::Tool* last = nullptr;  ///< the tool of its last pass
};

inline constexpr const char* kMachine = to_translate("machine");  ///< sources, below
inline constexpr const char* kHeat = to_translate("heat");
inline constexpr const char* kLife = to_translate("life");
inline constexpr const char* kMeasurement = to_translate("measurement");

/// Contributions of the sources.  They move a size (diameter, length, a profile located
/// by datums) up and down, and widen a zone:
///
///     source        takes                          of
///     machine       machine_share_um, of all kinds, and the share of the error model
///                   (machine_share.hpp); its uncertainty is normal
///                                                  the whole width
///     jaw-squeeze   deflection/ring.hpp (1), a tube in jaws: its lobes of the zone of
///                   circularity, cylindricity, run-out and profile without datum; twice
///                   its largest displacement of a located profile
///     chain         twice the distance of a length from the middle of its limits where not
///                   all lengths of a chain can be there (programmed_faces.hpp)
///                                                  the whole width
///     measurement   U of a zone, 2 U of a size     the whole width
///     drift         +- drift_um, uniform           sizes; axial ones of lengths
///     repeatability normal                         sizes
///     wear          +- r u/2, uniform, shop_errors.hpp (2), r of the whole life
///     life          normal, life_spread() of r u/2: an edge that wears out sooner than
///                   thought recedes faster, be it this edge or any in this material
///     heat          +- alpha dT D/4 of the radius, alpha dT L/2 of a length, uniform
///     rechucking    rayleigh, to a datum that another setup cuts: twice for run-out,
///                   coaxiality and position, once for a profile; sqrt(2) D/grip times
///                   for tolerances of tilt, D the face's diameter or the axis' length;
///                   of a common datum by (1) and (2) of common_datum.hpp: of its two
///                   elements those count that another setup cuts, at the worse end of the
///                   surface; a tilt between elements of two setups is D/|z_B - z_A| times
///     forces        normal, force_spread() times the error itself; in `shares` of a
///                   robust plan, not among the sources here
///     life          likewise life_spread() of the error by worn edges: the land is larger
///                   where the edge is changed
///     damping       what left_mm leaves less than it would if the limits of chatter were
///                   known (uncertain_limits.hpp)
///
/// Two faces of a length that one setup cuts stand minutes apart in the same drift and,
/// cut by one tool, with the same edge; both look at the free end, so that their errors
/// d + w_1 and d + w_2 are of one sign and the length between them has w_2 - w_1,
///
///     one tool: neither drift nor wear;  two tools: each one's wear                  (0)
///
/// Source: derived here, checked against random draws in tolerance_allocation_test.  Each face is
/// indexed separately, so the repeatability counts for both.
///
/// Three lobes do not change two-point diameters, except for their even orders (a tenth),
/// which are neglected.
struct ToleranceAllocation {
  std::vector<Share> fixed;               ///< [um] of the width
  std::vector<tolerance::Source> spread;  ///< of one end, sensitivities included
  double ends = 1;  ///< of the width: 1 of a zone, 2 of a size, for each face of a length
};
ToleranceAllocation tolerance_allocation(const PreparedPart& plan, std::size_t tolerance,
                                         const Making& making);

/// Share of the width [mm] that all sources together take: the fixed ones, and at each
/// end the root of the sum of squares of those that spread, (3) of tolerance/budget.hpp.
double taken_mm(const ToleranceAllocation& allocation);

/// Fixed contributions that are present in the part itself [um]: all except the
/// uncertainty of its measurement.
double fixed_in_parts_um(const ToleranceAllocation& allocation);

/// Recession of an edge [mm] by the share `life_used` of its life, to the wear land where it
/// is changed ((2) of deflection/shop_errors.hpp).
double recession_mm(const PreparedPart& plan, const catalogue::Tool& tool,
                    double life_used);

/// Relative standard deviation of the passive force.
double passive_spread(const PreparedPart& plan);

/// Relative standard deviation of the deflection, from those of forces and stiffness alone.
double force_spread(const PreparedPart& plan);

/// Relative standard deviation of the wear land at a given time, normal.  The land is in
/// proportion to 1/T; a normal land that is as large at 3 s as the lognormal one of a
/// spread s of ln T,
///
///     g(s) = (exp(3 s) - 1)/3,                                                       (4)
///
/// is on the safe side of it for all edges between there and the middle.  Edges scatter
/// among each other by s, `scatter_pct` of the material.  Taylor's C is uncertain by u for
/// all of them, and T by u/n; a land N = `wear_noticed_times` as large as the law says is
/// noticed, which counts as two standard deviations:
///
///     hypot(g(s), min(g(u/n), (N - 1)/2))                                            (5)
///
/// Source: derived here; uncertain_limits_test draws edges.
double life_spread(const PreparedPart& plan);

/// Relative standard deviation of the deflection.  With forces of worn edges life_spread() is
/// counted of the whole of it, on the safe side, because a part of it is the new edge's.
double error_spread(const PreparedPart& plan);

/// The cut's part in a tolerance: none, its deflection, or the remainder of a deflection
/// for which the tool path is corrected.
enum class Cut { none, error, corrected };

/// Room that a tolerance of width w leaves to the cut.  In a nominal plan it is
/// w - taken.  A robust plan judges the parts themselves, not their measurement: at each
/// end, at the distance h = (w - fixed)/ends from the middle of a size or from 0 of a zone, it
/// is the largest E with which parts whose deflection spreads by r = error_spread() keep the limit
/// with the required probability p,
///
///     P(S + r E Z <= h - E) = p                                                     (1)
///
/// where S is the sum of the sources that spread and Z is standard normal; each face of a
/// length may fail with the probability (1 - p)/faces.  A size can also fail at its other
/// limit,
///
///     P(-h + E <= S + r E Z <= h - E) = p                                           (2)
///
/// With a constant offset (cut_tolerance.hpp) the error reaches equally far to both sides, and E
/// is half its range: (2) is then necessary and sufficient for P_conform >= p.  Without
/// an offset E is the larger extreme, for which (2) is sufficient.  Uncertain forces and
/// stiffness scale only the error that the offset does not remove, because the offset is
/// set by gauging the first part, which shows the true middle.  With a corrected path the
/// uncertainty of the deflection E remains, and between the places of its table a
/// remainder d, for which h/200 is kept,
///
///     P(|S + r E Z| <= h - d) = p                                                   (3)
///
/// p is `conformance`, or with uncertain damping (1 + conformance)/2.
/// Where the cut has no part in the tolerance, E is the room that S leaves, (1) with
/// r = 0.
/// Source: derived here; the left sides fall as E grows.
/// @param cut  has no effect in a nominal plan
/// @return ends E [mm]
double left_mm(const PreparedPart& plan, std::size_t tolerance,
               const ToleranceAllocation& allocation, Cut cut);

/// What a corrected path may leave of the deflection [mm]: ends d of (3), all the room of a
/// nominal plan.
double remainder_mm(const PreparedPart& plan, std::size_t tolerance,
                    const ToleranceAllocation& allocation);

/// Share of the width [mm] that uncertain limits of chatter take of a robust plan.
double damping_share_mm(const PreparedPart& plan, std::size_t tolerance,
                        const Making& making, Cut cut);

/// Share of the width that each source takes alone, for sources that spread their reach;
/// both faces of a length together.
std::vector<Share> shares(const ToleranceAllocation& allocation);

/// Number of faces of a `length` that this plan cuts: they share the room left by the
/// other sources.
double faces_cut(const PreparedPart& plan, const part::Tolerance& tolerance);

}  // namespace turnwright::planning
