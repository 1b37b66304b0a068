#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "planning/clamping/made_surfaces.hpp"
#include "planning/limits/relaxation.hpp"
#include "planning/surface/surface_optimiser.hpp"

/// Whether a part can be made at all, over every clamping, tool, pass count and speed
/// range, and which limits decide.
namespace turnwright::planning {

/// Feasibility oracle over relaxed limits.  Feasibility is monotone in the relaxation, so
/// earlier verdicts on a surface are used again in both directions.
class Feasibility {
 public:
  /// Called with the task and the answer of a surface that can be made.
  using Found = std::function<void(const SurfaceTask&, const SurfaceAnswer&)>;

  explicit Feasibility(const PreparedPart& part);

  const PreparedPart& part() const { return part_; }
  const std::vector<RelaxableLimit>& limits() const { return limits_; }

  /// With the limits relaxed: true if conditions were found that keep all of them, the
  /// tool's path corrected where need be; false if local searches of every recipe, from
  /// two starts each, found none.
  bool with(const RelaxationFactors& factors, const Found& found = {});

  /// Surfaces that no clamping makes, of those tried in the last call.
  const std::set<std::string>& failed() const { return failed_; }

  /// From now on a surface counts as made: no limit decides whether it is.
  void leave_out(const std::string& surface) { left_out_.insert(surface); }
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  std::vector<double> state(const RelaxationFactors& factors,
                            const std::string& surface) const;
  bool made(const PreparedPart& plan, const SurfaceTask& task,
            const RelaxationFactors& factors, const Found& found);
  bool setup_made(const PreparedPart& plan, std::size_t setup, const SetupWork& work,
                  const Finished& done, const RelaxationFactors& factors,
                  const Found& found);

  // Setup, clamping and the jaws' force at finishing, surface, its tools.
  using Key =
      std::tuple<std::size_t, Clamping, double, std::string, std::string, std::string>;

  struct Tried {
    std::vector<double> factors;  // of the limits that the surface has to keep
    bool made;
  };

  const PreparedPart& part_;
  std::vector<RelaxableLimit> limits_;
  std::map<Key, std::vector<Tried>> tried_;
  std::set<std::string> failed_, left_out_;
};

}  // namespace turnwright::planning
