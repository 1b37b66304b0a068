#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "attempt.hpp"
#include "openable.hpp"

/// Whether a part can be made at all, over every clamping, tool, pass count and speed
/// range, and which limits decide.
namespace turnwright::planning {

/// A plan's limits, opened this far and that.  Remembers what each surface came to: what
/// can be made can be made with its limits opened further, what cannot cannot with them
/// opened less.
class Feasibility {
 public:
  /// Called with the task and the answer of a surface that can be made.
  using Found = std::function<void(const FeatureTask&, const FeatureAnswer&)>;

  explicit Feasibility(const PreparedPart& plan);

  const PreparedPart& plan() const { return plan_; }
  const std::vector<Openable>& limits() const { return limits_; }

  /// With the limits opened: true if conditions were found that keep all of them, the
  /// tool's path corrected where need be; false if local searches of every recipe, from
  /// two starts each, found none.
  bool with(const Openings& times, const Found& found = {});

  /// Surfaces that cannot be made by any clamping that was tried in the last call.
  const std::set<std::string>& failed() const { return failed_; }

  /// From now on a surface counts as made: its trouble is no limit's.
  void leave_out(const std::string& surface) { left_out_.insert(surface); }
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  std::vector<double> state(const Openings& times, const std::string& surface) const;
  bool made(const PreparedPart& plan, const FeatureTask& task, const Openings& times,
            const Found& found);
  bool setup_made(const PreparedPart& plan, std::size_t setup, const SetupWork& work,
                  const Finished& done, const Openings& times, const Found& found);

  // Setup, clamping and the jaws' force at finishing, surface, its tools.
  using Key =
      std::tuple<std::size_t, Clamping, double, std::string, std::string, std::string>;

  struct Tried {
    std::vector<double> times;  // how far the surface's limits were opened
    bool made;
  };

  const PreparedPart& plan_;
  std::vector<Openable> limits_;
  std::map<Key, std::vector<Tried>> tried_;
  std::set<std::string> failed_, left_out_;
};

}  // namespace turnwright::planning
