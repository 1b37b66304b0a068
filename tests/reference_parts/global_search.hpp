#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// The cheapest plan of a part by brute force, to hold the planner's optimum against.
///
/// Of planning/ it uses what a surface is and what a pass does (MachinedSurface, Chain, evaluate,
/// errors), what the drawing asks (cut_tolerances) and the rule of when the tool path may follow
/// the error: in a setup that no clamping can make otherwise.  Its own are the pass
/// counts, the speeds (a scan over the speed window, no economic speed), the conditions
/// (a lattice over ln f of each operation and ln of the finishing depth, then lattices
/// that shrink around the best points, then COBYLA over speeds, feeds and depth at once)
/// and the tolerances (errors at 41 places).  Nothing here is a bound: it finds points,
/// and a point cheaper than a certificate's bound refutes the certificate.
namespace turnwright::reference {

/// How fine the lattices are.
struct Effort {
  int feeds = 24, depths = 16, speeds = 33;
  int starts = 4;        ///< lattice points that are refined
  double finest = 1e-7;  ///< spacing at which refining ends, in ln
};
inline constexpr Effort kShort{14, 6, 17, 2, 3e-6};

/// Tolerances are kept to 1 - this, so that what is found holds between the places too.
inline constexpr double kReserve = 1e-6;

/// The cheapest conditions found for one surface.
struct SurfaceFound {
  std::string surface, rough, finish;  ///< tools; empty: none
  int rough_passes = 0, finish_passes = 0;
  double v_m_min[2] = {0, 0}, f_mm_rev[2] = {0, 0}, a_mm = 0;
  double objective = 0;  ///< infinite: nothing found
  double excess = 0;     ///< largest value/limit - 1, errors at 1601 places
};

struct SetupFound {
  planning::Clamping clamping = planning::Clamping::chuck;
  std::vector<SurfaceFound> surfaces;
  int indexings = 0;
  double objective = 0;  ///< infinite: nothing found
};

struct Found {
  std::vector<SetupFound> setups;
  double objective = 0;  ///< per part; infinite: nothing found
};

/// Cost or time per part as `objective` says; not `profit`, and not with operations
/// given.
Found search(const planning::PreparedPart& plan, const Effort& effort);

/// A plan's clampings, tools and conditions computed anew: costs, tools brought in, and
/// by how much each surface is over its limits.
Found as_planned(const planning::PreparedPart& part, const planning::ProcessPlan& plan);

}  // namespace turnwright::reference
