#pragma once
#include <vector>

#include "between.hpp"
#include "describe.hpp"
#include "fixed.hpp"

/// Results that follow from solved surfaces: verdicts on tolerances, prices, conflicts.
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

/// Time and cost per part of a setup by what they are spent on.
Breakdown breakdown(const PreparedPart& plan, const SolvedSetup& setup);
/// Cost, time and profit of a result from its breakdown.
void add_totals(const PreparedPart& plan, ProcessPlan& result);

/// Time and cost of preparing the machine for all setups.
SettingUp setting_up(const PlanRequest& plan);

/// The tolerance that the fewest parts keep; the first one if there are several.
std::optional<WorstConformance> worst_conformance(
    const PlanRequest& plan, const std::vector<ToleranceResult>& tolerances);

/// The operations of a setup in the order of cutting: faces, centre hole and drilling,
/// roughing, finishing, shoulders, bores, then arcs, grooves, threads, parting off.
std::vector<OperationPlan> operations_in_order(const PreparedPart& plan,
                                               const SolvedSetup& setup);

/// Adds a conflict for every surface that no setup can cut.
void add_unreachable(const PreparedPart& part, ProcessPlan& result);

/// Adds a conflict for each of the given tolerances that the machine's share alone uses
/// up.
void add_used_up(const PreparedPart& plan, const std::vector<std::size_t>& tolerances,
                 ProcessPlan& result);

/// Tolerances of surfaces that no setup cuts: no condition and no other limit can help
/// them.
std::vector<std::size_t> tolerances_left_to_the_stock(const PreparedPart& part);

/// Adds the conflicts of operations at fixed conditions that no clamping of their setup
/// resolves.
void add_fixed_obstacles(const PreparedPart& part, ProcessPlan& result);

/// Predicted and allowed values of every tolerance of the drawing, at the solution.
std::vector<ToleranceResult> tolerance_results(const PreparedPart& plan,
                                               const std::vector<SolvedSetup>& setups);

/// The error of every finished surface at 21 positions, offset and correction included;
/// blanks are left out.
std::vector<Deviation> deviations(const PreparedPart& plan,
                                  const std::vector<SolvedSetup>& setups);

/// Constant offsets of the tool at the surfaces whose sizes need one.
std::vector<ToolOffset> offsets(const std::vector<SolvedSetup>& setups);

/// Corrections of the tool path at the surfaces whose tolerances need one.
std::vector<Compensation> compensations(const std::vector<SolvedSetup>& setups);

/// The price of every limit whose relaxation saves something, largest saving first.
std::vector<Price> prices(const PreparedPart& plan,
                          const std::vector<SolvedSetup>& setups);

/// A number as sentences show it: four digits, without decimals from ten thousand on.
std::string readable(double value);

/// One sentence with the limit that keeps this surface from being made, and by how much.
std::string obstacle(const PreparedPart& plan, const SolvedFeature& feature);

/// The conflict of a tolerance that the sources other than the cut use up.
Conflict used_up_conflict(const PreparedPart& plan, const SolvedFeature& feature,
                          const Demand& demand);

}  // namespace turnwright::planning
