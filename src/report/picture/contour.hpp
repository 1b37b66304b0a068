#pragma once
#include <cstddef>
#include <vector>

#include "planning/clamping/made_surfaces.hpp"
#include "planning/clamping/positions.hpp"
#include "turnwright/planning/plan_request.hpp"

/// The part's outline between its setups.
namespace turnwright::report {

/// A run from z0 to z1 > z0, over which the radius is linear from r0 to r1 [mm].
struct Run {
  double z0 = 0, z1 = 0, r0 = 0, r1 = 0;
};
/// End to end, left to right.
using Runs = std::vector<Run>;

struct Contour {
  Runs outer, inner;  ///< both over the whole length; inner 0 where there is no bore
};

/// The part after `setup`; surfaces that no setup up to it has cut are stock.
Contour contour_after(const planning::PreparedPart& part, std::size_t setup);

/// The largest outside of a stock.
Runs stock_runs(const part::Stock& stock);
/// An element as drawn: one run, or for an arc a dozen chords.
Runs outer_runs(const part::Drawing& drawing, std::size_t i);
Runs inner_runs(const part::Drawing& drawing, std::size_t i);

/// The radius on the line through a run, also outside the run.
double radius_mm(const Run& run, double z_mm);
/// The runs between two positions.
Runs between(const Runs& runs, double from_z_mm, double to_z_mm);

}  // namespace turnwright::report
