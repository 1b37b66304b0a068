#pragma once
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planning/auxiliary/auxiliary_work.hpp"
#include "planning/surface/recipes.hpp"
#include "planning/values/economy.hpp"
#include "planning/values/surface_request.hpp"
#include "solved_setup.hpp"
#include "tool_choices.hpp"
#include "turnwright/base/language.hpp"

/// The surfaces of one setup in one clamping, and the tools they share.
namespace turnwright::planning {

/// How conflicts name the stations of the turret, which are too few.
inline constexpr const char* kStations = to_translate("stations of the turret");

/// The objective of a setup with some choice of tools: its optimum, or a lower bound.
struct Considered {
  std::size_t choice = 0;
  double at_least = 0;
  bool solved = false;
};

/// A surface with given tools: a lower bound over its recipes, and its solution once it
/// is needed.
struct Entry {
  double bound = 0;
  double proved = 0;  ///< a bound with tolerances, while paths are corrected or not
  double most = 0;    ///< objective that the solution had to be below
  bool compensated = false;  ///< solved with a corrected path too
  std::optional<SolvedSurface> solved;
  double at_least() const { return std::max(bound, proved); }
};
using ToolPair = std::pair<const catalogue::Tool*, const catalogue::Tool*>;

/// Results shared by several clampings of a setup: end faces are cut in the chuck alone,
/// and without tolerances clampings with the same Holding are alike, if the tools clear the
/// centre in all of them or in none.
struct SharedMemory {
  std::map<const catalogue::Tool*, Entry> faces;
  std::map<std::tuple<std::size_t, ToolPair, Holding, bool>, std::shared_ptr<Unasked>>
      unasked;
};

/// Solves the surfaces of one setup in one clamping and keeps results that depend only on
/// some of the tools.  The plan must outlive it.
class SetupPlanner {
 public:
  SetupPlanner(const PreparedPart& plan, std::size_t setup, Clamping clamping,
               const SetupWork& work, const Finished& before, const Economy& economy,
               SharedMemory& shared);

  /// Allows from now on a corrected tool path on surfaces that cannot be made without.
  /// A path is corrected for one force, not for all from a new edge to a worn one.
  void allow_compensation();

  /// What stops the setup whatever is turned and bored how: the conflicts of its other
  /// operations, and too few stations of the turret for its tools.
  std::vector<Conflict> conflicts() const;

  /// The cheapest tools with their solutions, among those for which the turret has stations.  Tools with the smallest bound are tried
  /// first; those that cannot cost less than `most` are dropped as soon as that is known.
  SolvedSetup best(double most);

  /// Whether some choice of tools makes every surface; `makes` decides it for one
  /// surface.  Each surface is tried alone first, so one that no tools make ends the
  /// search.
  bool can_be_made(const std::function<bool(const SurfaceTask&)>& makes);

  /// Every surface with the given tools and conditions, solved by `answer`; the tool path
  /// is corrected on the `corrected` surfaces.
  SolvedSetup as_given(SurfaceAnswer (*answer)(const SurfaceTask&),
                       const std::set<std::string>& corrected);

  /// Every surface with the tools of the best setup if that is infeasible.
  SolvedSetup explained();

  /// Its surfaces in the order of a SolvedSetup's features.
  std::vector<const MachinedSurface*> features() const;

 private:
  // A surface to be made with the conditions that the request fixes.
  struct Job {
    MachinedSurface feature;
    SurfaceRequest wanted;
  };
  // For each place in the setup's order the tool of each job; null where it has none.
  using ToolOrder = std::vector<std::vector<const catalogue::Tool*>>;

  bool any(MachinedSurface::Kind kind) const;
  ToolChoices every_choice() const;
  std::set<const catalogue::Tool*> used(const Tools& tools) const;
  std::set<const catalogue::Tool*> requested_tools() const;
  void fit_turret();
  bool fits(const Tools& tools, long spared = 0) const;
  std::optional<Tools> first_fitting(const ToolChoices& choices) const;
  double least_objective_of(const Tools& tools);
  std::size_t group_of(std::size_t job) const;
  CheapestFirst::AllTerms terms();
  CheapestFirst cheapest_first(CheapestFirst::AllTerms terms);
  ToolPair tools_of(std::size_t job, const Tools& tools) const;
  SurfaceTask task(std::size_t job, const Tools& tools, Offset offset);
  const std::vector<CutTolerance>& cut_tolerances_of(std::size_t job,
                                                     const catalogue::Tool* last,
                                                     Offset offset);
  Entry& entry(std::size_t job, const Tools& tools);
  const SolvedSurface& solved(std::size_t job, const Tools& tools, double most);
  SolvedSetup solve(const Tools& tools, double least, double most);
  std::optional<Considered> least_with(CheapestFirst::AllTerms terms, std::size_t list,
                                       const catalogue::Tool* tool);
  std::vector<RejectedTool> rejected(const Considered& best);
  const SolvedSurface& solve_surface(Entry& entry, std::size_t job, const Tools& tools,
                                     double most);
  bool may_share_tools() const;
  ToolOrder order_of(const Tools& tools) const;
  double least_besides_cutting(const Tools& tools) const;
  double least_between(std::size_t group, const Tools& tools) const;
  void add_group(std::size_t group, const ToolOrder& order, Order& all) const;
  Between between(const ToolOrder& order) const;
  Between between(const SolvedSetup& s) const;
  double besides(const Between& between) const;

  const PreparedPart& p_;
  std::size_t setup_;
  Clamping clamping_;
  Economy economy_;
  AuxiliaryWork auxiliary_;
  double auxiliary_min_, auxiliary_edges_;  // minutes and cost of edges of all of it
  double front_mm_;
  bool compensate_ = false, explain_ = false;
  long boxes_ = 0;  // bounded so far
  Tools nearest_;
  SharedMemory& shared_;
  ToolChoices choices_;
  bool share_tools_ = false;  // the groups of tools, or with other operations
  long stations_ = 0;         // of the turret, for the tools that are chosen
  long spared_ = 0;           // more, if one cutter did for all milled places
  bool left_out_ = false;     // some choices, for which the turret has no stations
  double nearly_fitting_ = kInfinity;   // least objective of those that `spared_` admits
  std::vector<Considered> considered_;  // solved choices
  std::vector<Job> jobs_;
  std::vector<std::map<ToolPair, Entry>> memory_;  // per job, by its tools
  std::map<std::tuple<std::size_t, const catalogue::Tool*, Offset>,
           std::vector<CutTolerance>>
      cut_tolerances_;
};

}  // namespace turnwright::planning
