#pragma once
#include <optional>
#include <vector>

#include "rows.hpp"

/// Whether the limits leave anything, and which ones are to blame if not.
namespace turnwright::multipass {

/// Least t >= 0 with soft limits g(Y) <= t and hard ones g(Y) <= 0 for the pass count of
/// `depths`, to kFeasibility; none if t would pass `most` or the hard limits leave
/// nothing.
std::optional<double> least_violation(const std::vector<Row>& soft,
                                      const std::vector<Row>& hard, const Depths& depths,
                                      double most, double gap);

/// Whether some Y meets all rows.
bool feasible(const std::vector<Row>& rows, const Depths& depths);

/// An irreducible set of limits that no n up to n_max can meet together: with any of them
/// left out the rest can be met.  The name "n_max" may be among them.
/// For a problem that has no feasible point.
std::vector<Relief> conflict(const Problem& problem);

}  // namespace turnwright::multipass
