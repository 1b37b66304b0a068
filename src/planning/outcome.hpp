#pragma once
#include <vector>

#include "between.hpp"
#include "describe.hpp"
#include "fixed.hpp"

/// What follows from solved features: verdicts on tolerances, prices, conflicts.
namespace turnwright::planning {

/// A setup with one clamping, all its features solved.
struct SolvedSetup {
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  std::vector<SolvedFeature> features;
  Between between = {};
  double objective = 0;  ///< of the whole setup
  double lower_bound = 0;
  std::vector<RejectedTool> rejected_tools = {};
  FixedWork fixed = {};
  bool feasible() const;
};

/// Where a setup's time and cost per part go.
Breakdown breakdown(const PreparedPart& plan, const SolvedSetup& setup);
/// Cost, time and profit of a result from its breakdown.
void add_totals(const PreparedPart& plan, ProcessPlan& result);

/// Preparing the machine for all setups.
SettingUp setting_up(const PlanRequest& plan);

/// Of the tolerances, the first of those that fewest parts keep.
std::optional<WorstConformance> worst_conformance(
    const PlanRequest& plan, const std::vector<ToleranceResult>& tolerances);

/// Its operations in the order they are cut: faces, centre hole and drilling, roughing,
/// finishing, shoulders, bores, then arcs, grooves, threads, parting off.
std::vector<OperationPlan> operations_in_order(const PreparedPart& plan,
                                               const SolvedSetup& setup);

/// What no setup makes.
void add_unreachable(const PreparedPart& part, ProcessPlan& result);

/// Those of some tolerances that the machine's share alone uses up.
void add_used_up(const PreparedPart& plan, const std::vector<std::size_t>& tolerances,
                 ProcessPlan& result);

/// Of what no setup cuts: no condition, and no limit but themselves, can help them.
std::vector<std::size_t> tolerances_left_to_the_stock(const PreparedPart& part);

/// And what stands against the operations at fixed conditions of a setup in all its
/// clampings.
void add_fixed_obstacles(const PreparedPart& part, ProcessPlan& result);

/// Predicted against allowed for every tolerance of the drawing, at the answers.
std::vector<ToleranceResult> tolerance_results(const PreparedPart& plan,
                                               const std::vector<SolvedSetup>& setups);

/// The error of every surface at 21 places, as it is made; not of blanks.
std::vector<Deviation> deviations(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& setups);

/// Offsets of the tool that sizes need, where a constant one was to be had.
std::vector<ToolOffset> offsets(const std::vector<SolvedSetup>& setups);

/// Correction of the tool path where a tolerance needs it.
std::vector<Compensation> compensations(const std::vector<SolvedSetup>& setups);

/// Every limit that costs something, dearest first.
std::vector<Price> prices(const PreparedPart& plan,
                          const std::vector<SolvedSetup>& setups);

/// A number in a sentence: four digits, whole from ten thousand on.
std::string readable(double value);

/// One sentence: what stands against this feature, and by how much.
std::string obstacle(const PreparedPart& plan, const SolvedFeature& feature);

/// A tolerance of which all but the cut leaves nothing.
Conflict used_up_conflict(const PreparedPart& plan, const SolvedFeature& feature,
                          const Demand& demand);

}  // namespace turnwright::planning
