#pragma once
#include <optional>
#include <vector>

#include "rows.hpp"

/// Whether any passes keep all limits, and an irreducible conflict if none do.
namespace turnwright::multipass {

/// Least t >= 0 with soft limits g(Y) <= t and hard ones g(Y) <= 0 for the pass count of
/// `depths`, to kFeasibility; none if t would exceed `most` or the hard limits alone
/// cannot be kept.
std::optional<double> least_violation(const std::vector<Row>& soft,
                                      const std::vector<Row>& hard, const Depths& depths,
                                      double most, double gap);

/// Whether some Y meets all rows.
bool feasible(const std::vector<Row>& rows, const Depths& depths);

/// For a problem without a feasible point: an irreducible set of limits that no n up to
/// n_max can keep together, although without any one of them the others can be kept.  The
/// name "n_max" may be among them.
std::vector<Relief> conflict(const Problem& problem);

}  // namespace turnwright::multipass
