#pragma once
#include <limits>
#include <string>
#include <vector>

#include "limit_table.hpp"

/// Limits of a request, relaxed to find what would make an infeasible part feasible.  The
/// ends of the tools' windows bound the search and are not relaxed, unless the request
/// gives a condition outside them.
namespace turnwright::planning {

/// A limit of a request that can be relaxed.
struct RelaxableLimit {
  const LimitRow* row = nullptr;
  std::size_t owner = 0;     ///< 0 where all owners have the limit in common
  std::string surface = {};  ///< that a tolerance or roughness is of
};

/// In the order of the table; of operations, tolerances and surfaces one after another.
std::vector<RelaxableLimit> relaxable_limits(const PreparedPart& part);

/// How many times as wide each limit is: 1 as it is, infinity without it.
using RelaxationFactors = std::vector<double>;
inline constexpr double kWithout = std::numeric_limits<double>::infinity();
/// A limit of a machine or tool so many times as wide counts as none.
inline constexpr double kFar = 1e4;

/// The request with its limits relaxed: upper ones times as large, lower ones times as
/// small, sizes about their middle.  A given condition cannot be scaled: any relaxation
/// leaves it to the planner.
PlanRequest relaxed(const PreparedPart& part, const std::vector<RelaxableLimit>& limits,
                    const RelaxationFactors& factors);

/// Whether a surface has to keep it.
bool bears_on(const PreparedPart& part, const RelaxableLimit& limit,
              const std::string& surface);

/// A limit with its value, as a result names it: a tolerance by its width, the motor by
/// its largest power, a tool's limit by the widest of all tools.
struct LimitValue {
  std::string name, unit;
  double now = 0;
  bool at_most = true;
};
LimitValue value_of(const PreparedPart& part, const RelaxableLimit& limit);

/// The value of a limit once it is relaxed.
double relaxed_value(const LimitValue& limit, double factor);

/// The factor that takes the limit to its relaxed value, rounded up to four digits: what a
/// result reports.
double reported_factor(const LimitValue& limit, double factor);

}  // namespace turnwright::planning
