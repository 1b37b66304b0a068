#pragma once
#include <string>
#include <vector>

#include "machined_surface.hpp"

/// The discrete choices of a surface: numbers of passes, speed ranges and tools.
namespace turnwright::planning {

/// Finishing passes that `auto` may take on an element or a bore.
inline constexpr int kFinishingPasses = 2;

/// Every number of passes that the depths of the tools allow, or the given number, with
/// every speed range; on elements and bores at most kFinishingPasses finishing passes
/// unless their number is given.  At most kMostPasses passes, and as many numbers from the
/// fewest on as make 100,000 recipes.
std::vector<Recipe> recipes(const PreparedPart& plan, const MachinedSurface& feature,
                            const SurfaceRequest& wanted, const catalogue::Tool* rough,
                            const catalogue::Tool* finish);

}  // namespace turnwright::planning
