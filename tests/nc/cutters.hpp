#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plans.hpp"
#include "review/cut/section.hpp"

/// The bodies of tools while operations of a plan use them.
namespace turnwright::nc::test {

using namespace review;

/// In the tool's coordinates: x out of the material into the air, z towards the free end,
/// the origin in the programmed point.
struct Cutter {
  bool inner = false, drills = false, threads = false;
  bool plunges = false;   ///< a blade: beside its own plunges
  bool finishes = false;  ///< a contour; faces apart
  double re_mm = 0;
  Polygon edge;                 ///< what cuts: the whole insert, a blade, a drill
  std::vector<Polygon> holder;  ///< what must not touch; convex pieces
};
Cutter cutter(const Planned& p, const planning::OperationPlan& operation);

/// The largest corner that finishes each element, or a shoulder of it.
std::map<std::string, double> finishing_corners_mm(const Planned& p);

/// Tip to full diameter of a drill and its diameter, as a planned operation uses it.
struct Drilled {
  double D_mm = 0, point_mm = 0, depth_mm = 0;  ///< depth of the full diameter
};
std::optional<Drilled> drilled(const Planned& p, std::size_t setup,
                               const planning::OperationPlan& operation);

}  // namespace turnwright::nc::test
