#pragma once
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "outcome.hpp"
#include "recipes.hpp"

/// The surfaces of one setup in one clamping, and the tools they share.
namespace turnwright::planning {

/// The tools of a setup, one for each use.
struct Tools {
  const catalogue::Tool *face = nullptr, *rough = nullptr, *finish = nullptr;
  const catalogue::Tool *bore_rough = nullptr, *bore_finish = nullptr;
};

/// What a setup comes to with some tools: its optimum, or what it cannot beat.
struct Considered {
  Tools tools;
  double at_least = 0;
  bool solved = false;
};

/// A surface with its tools: what the best recipe cannot beat, and its answer once asked
/// for.
struct Entry {
  double bound = 0;
  double most = 0;           ///< what the answer had to beat
  bool compensated = false;  ///< asked for with compensation too
  std::optional<SolvedFeature> solved;
};
using ToolPair = std::pair<const catalogue::Tool*, const catalogue::Tool*>;

/// What holds for several clampings of a setup: end faces are cut in the chuck alone, and
/// where no tolerance is asked clampings that hold alike are one.
struct SharedMemory {
  std::map<const catalogue::Tool*, Entry> faces;
  std::map<std::tuple<std::size_t, ToolPair, Holding>, std::shared_ptr<Unasked>> unasked;
};

/// Solves the features of one setup in one clamping, remembering what depends only on
/// part of the tools.  The plan must outlive it.
class SetupPlanner {
 public:
  SetupPlanner(const PreparedPart& plan, std::size_t setup, Clamping clamping,
               const SetupWork& work, const Finished& before, const Economy& economy,
               SharedMemory& shared);

  /// From now on the tool path may follow the error of what cannot be made otherwise.
  void allow_compensation() { compensate_ = true; }

  /// The cheapest tools with their answers: those that look cheapest first; what cannot
  /// cost less than `most` is dropped as soon as that is known.
  SolvedSetup best(double most);

  /// Whether some tools make every surface, as `makes` says of one of them.  Surfaces
  /// that no tools make are told to it first.
  bool can_be_made(const std::function<bool(const FeatureTask&)>& makes);

  /// Every feature with the tools and conditions given, answered by `answer`; the tool
  /// path follows the error of the `corrected` surfaces.
  SolvedSetup as_given(FeatureAnswer (*answer)(const FeatureTask&),
                       const std::set<std::string>& corrected);

  /// Every feature with the tools of the best setup, which is not feasible.
  SolvedSetup explained();

  /// What it makes, in the order of a SolvedSetup's features.
  std::vector<const Feature*> features() const;

 private:
  // One surface to be made and what the request says of it.
  struct Job {
    Feature feature;
    Wanted wanted;
  };
  // For each place in the setup the tool of each job, if it has any there.
  using ToolOrder = std::vector<std::vector<const catalogue::Tool*>>;

  bool any(Feature::Kind kind) const;
  std::vector<Tools> choices() const;
  ToolPair tools_of(std::size_t job, const Tools& tools) const;
  FeatureTask task(std::size_t job, const Tools& tools, Offset offset);
  const std::vector<Demand>& demands_of(std::size_t job, const catalogue::Tool* last,
                                        Offset offset);
  Entry& entry(std::size_t job, const Tools& tools);
  const SolvedFeature& solved(std::size_t job, const Tools& tools, double most);
  SolvedSetup solve(const Tools& tools, double least, double most);
  std::vector<RejectedTool> rejected(const std::vector<Considered>& all,
                                     const Considered& best) const;
  double least_besides_cutting(const Tools& tools) const;
  Between between(const ToolOrder& order) const;
  Between between(const SolvedSetup& s) const;
  double besides(const Between& between) const;

  const PreparedPart& p_;
  std::size_t setup_;
  Clamping clamping_;
  Economy economy_;
  FixedWork fixed_;
  double front_mm_;
  bool compensate_ = false, explain_ = false;
  long boxes_ = 0;  // bounded so far
  Tools nearest_;
  SharedMemory& shared_;
  std::vector<Job> jobs_;
  std::vector<std::map<ToolPair, Entry>> memory_;  // per job, by its tools
  std::map<std::tuple<std::size_t, const catalogue::Tool*, Offset>, std::vector<Demand>>
      demands_;
};

/// Where a surface's operations stand in the order of a setup: faces first, then all
/// roughing, all finishing, shoulders, and the bores in the same way.
inline constexpr std::size_t kPlaces = 6;
std::size_t place_in_setup(Feature::Kind kind, bool rough);

}  // namespace turnwright::planning
