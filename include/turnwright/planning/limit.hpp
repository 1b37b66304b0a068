#pragma once
#include <functional>
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

namespace turnwright::planning {

/// A limit of a request: a number that restricts the cuts and that the user can change.
struct Limit {
  std::string name;    ///< "t1", "roughness Ra of d1", "power of lathe-medium"
  std::string called;  ///< in a sentence: "opening t1, the cylindricity of d1,"
  std::string unit;
  bool at_most = true;  ///< an upper limit, which a larger value relaxes
  double now = 0;
  std::function<void(PlanRequest&, double factor)> scale;
};

/// Every limit of a plan, each name once: tolerances by their ids; roughness per surface;
/// power and torque, damping, feed force and spindle speeds of the machine, the chuck's
/// speed and the grip of each setup; depth, feed, speed, force and life of each tool.
///
/// The curve of power and torque is scaled at all its points; the largest spindle speed
/// is scaled together with the curve's last point, which moves along its own line.  A
/// size is relaxed about its middle.
std::vector<Limit> limits(const PreparedPart& part);

}  // namespace turnwright::planning
