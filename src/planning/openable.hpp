#pragma once
#include <limits>
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

/// The limits of a plan that a reader can change, whatever the recipe: those of the
/// drawing, of the machine and of the tools, and what the request has given.  Where the
/// tools' windows end no condition is known to cut: they are no limits but the range of
/// what can be chosen, except for conditions that are given.
namespace turnwright::planning {

struct Openable {
  enum class Kind {
    tolerance,
    Ra,
    Rz,
    power,  ///< and torque: the motor's curve
    feed_force,
    grip,
    spindle_max,
    spindle_min,
    tool_force,
    life_min,
    life_max,
    chatter,
    passes,  ///< given, as are the next three
    ap,
    f,
    vc,
    depth_min,  ///< of the tools, for given depths, as are the next five for theirs
    depth_max,
    feed_min,
    feed_max,
    vc_min,
    vc_max
  };
  Kind kind = Kind::tolerance;
  std::size_t index = 0;     ///< of a tolerance, or of the operation that is given
  std::string surface = {};  ///< that a tolerance or roughness is of

  friend bool operator==(const Openable&, const Openable&) = default;
};

/// What is given first, then what the tools, the drawing and the machine ask: a conflict
/// is told with the earlier limits where it can be.
std::vector<Openable> limits_of(const PlanRequest& plan);

/// How often each limit is opened: 1 as it is, infinity without it.
using Openings = std::vector<double>;
inline constexpr double kWithout = std::numeric_limits<double>::infinity();
/// A limit of a machine or tool so far off counts as none.
inline constexpr double kFar = 1e4;

/// The plan with its limits opened: upper ones times as large, lower ones times as small,
/// sizes about their middle, the grip by friction and lighter jaws, so that tubes keep
/// their shape.  A given condition is given or, opened at all, not.
PlanRequest opened(const PlanRequest& plan, const std::vector<Openable>& limits,
                   const Openings& times);

/// Whether a surface has to keep it.
bool bears_on(const PlanRequest& plan, const Openable& limit, const std::string& surface);

/// A limit as a result tells it: the drawing's width of a tolerance, the motor's largest
/// power.
struct LimitName {
  std::string name, unit;
  double now = 0;
  bool at_most = true;
};
LimitName name_of(const PlanRequest& plan, const Openable& limit);

/// Given by the request, and there or not.
bool is_given(const Openable& limit);

}  // namespace turnwright::planning
