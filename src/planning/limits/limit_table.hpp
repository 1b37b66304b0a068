#pragma once
#include <optional>
#include <vector>

#include "check.hpp"
#include "turnwright/planning/prepared_part.hpp"

/// The table of limits: a row for every check of the conditions and for every condition
/// that a request may give.  What the optimiser keeps, what a result names, what prices
/// and changed requests scale and what an infeasible part would need are these rows.
///
/// A limit is added by an enumerator of Check, the line of operation_checks.hpp that computes its
/// value, and its row; without a row limit_table.cpp does not compile.
namespace turnwright::planning {

enum class Side { at_most, at_least };

/// The kind of object that has the number of a limit; every such object of a request has
/// its own.
enum class Owner {
  operation,  ///< that the request gives
  tolerance,
  surface,  ///< outer elements, inner elements, faces
  machine,
  chuck,
  jaws,            ///< of a setup, while it roughs
  finishing_jaws,  ///< of a setup that finishes with another force
  tool
};

/// Scaling of a number from its value to `factor` times that.
struct Scaling {
  double now = 0, factor = 1;
};

/// A number of a request by which a limit is set.
struct LimitNumber {
  Owner owner = Owner::machine;
  /// Its value; nothing where this owner has no such limit.
  std::optional<double> (*now)(const PreparedPart&, std::size_t owner) = nullptr;
  void (*scale)(PlanRequest&, std::size_t owner, const Scaling&) = nullptr;
  const char* name = nullptr;  ///< absent: the limit's
  const char* unit = nullptr;  ///< absent: the limit's
};

/// How a limit is relaxed where an infeasible part is explained.
enum class Relaxing {
  never,     ///< for the reason that the row gives
  released,  ///< a given condition: it holds or is left to the planner
  to_given,  ///< the end of a tool's window: moved to the given conditions
  rows,      ///< the rows of a solved model are scaled by it
  model      ///< it also changes the model
};

struct LimitRow {
  std::optional<Check> check = {};  ///< none: a condition that the request gives
  const char* name = nullptr;
  const char* unit = nullptr;
  Side side = Side::at_most;
  Relaxing relaxing = Relaxing::never;
  std::vector<LimitNumber> numbers = {};  ///< a reader of the request can change
  std::optional<Check> with = {};         ///< the numbers of this check set it as well
  /// The number that is scaled to relax the limit, once for the plan; absent: the first
  /// of the numbers, for every owner that has the limit.
  std::optional<LimitNumber> relaxed_by = {};
  /// Removes the limit.  Absent: it is scaled so far that it never binds.
  void (*take_away)(PlanRequest&, std::size_t owner) = nullptr;
  /// Whether a request has the limit to relax; absent: if it has a number of it.
  bool (*applies)(const PlanRequest&) = nullptr;
  bool is_width = false;         ///< of a zone or size, which opens about its middle
  const char* reason = nullptr;  ///< why it is never relaxed

  bool given() const { return relaxing == Relaxing::released; }
  /// Whether the limit either holds or is dropped, with no value between.
  bool whole() const { return given() || relaxing == Relaxing::to_given; }
  bool at_most() const { return side == Side::at_most; }
};

/// Given conditions first, then the checks in the order of their enumerators: where a
/// conflict can be stated with several limits, the earlier ones are preferred.
const std::vector<LimitRow>& limit_table();

const LimitRow& limit_row(Check check);

/// Whether the numbers of a limit set this check.
bool sets(const LimitRow& limit, Check check);

/// Whether the jaws of a setup finish with a force of their own, given or eased.
bool finishes_with_another_force(const PreparedPart& part, std::size_t setup);

/// How many owners of a kind a request has.
std::size_t owners(const PlanRequest& plan, Owner owner);

/// Id of a surface by its number among the owners.
const std::string& surface_id(const PlanRequest& plan, std::size_t surface);

}  // namespace turnwright::planning
