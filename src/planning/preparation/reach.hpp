#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

/// Which surfaces a setup's tools can get to.
namespace turnwright::planning {

/// A sentence that is made only where it is told.  It refers to the part and its ways,
/// which must outlive it.
using Reason = std::function<std::string()>;

/// Length [mm] that the corner of a finishing tool needs beyond the end of an element, and
/// the length that the jaws leave free.
struct BeforeJaws {
  double needed_mm = 0, left_mm = 0;
  bool enough() const { return left_mm >= needed_mm - 1e-5; }
};

/// An outer element for tools that come from one free end.
struct SeenOuter {
  /// It widens towards the jaws, and nothing nearer the free end is larger.
  bool open = false;
  /// A thread's tool comes in before it: 1.5 pitches to what stands higher than the root
  /// towards the free end, cones that rise to the thread apart.
  bool has_run_in = false;
  double to_z_mm = 0;  ///< its end towards the jaws, from the free end (Surroundings::z1)
  double needed_mm = 0;  ///< beyond it (needed_beyond_mm), by the least finishing corner
  std::optional<std::size_t> level_behind;  ///< Surroundings::level_behind
};

/// A face that a tolerance, roughness or datum of the drawing asks for.
struct NamedFace {
  std::size_t element = 0;  ///< shoulders: k of "k-1|k"; between bores: the wider one
  std::string id;
};

/// What the assignment of surfaces asks of a part that no grip changes: found once, while
/// grips are chosen.
struct Ways {
  explicit Ways(const PreparedPart& part);

  std::vector<double> left_mm;                  ///< of the outer elements
  std::array<std::vector<SeenOuter>, 2> outer;  ///< by the held end: left, right
  std::array<std::vector<bool>, 2> bores;       ///< likewise: it opens to the free end
  std::unordered_set<std::string> named;        ///< faces and what tolerances are on
  std::vector<NamedFace> shoulders, inner_shoulders;  ///< that are faced
  bool finishes = false;  ///< some tool finishes outer surfaces

  /// Whether a surface may be made in this setup: the request leaves that to the planner, or
  /// has an operation for it there.
  bool wanted(std::size_t setup, const std::string& surface) const;

 private:
  void look_up_operations(const PreparedPart& part);
  void look_up_shoulders(const PreparedPart& part);

  struct Asked {
    std::unordered_set<std::string> cut;
    std::array<bool, 2> drilled{};  // from the left and the right end
  };
  std::optional<std::vector<Asked>> asked_;   // by the operations of each setup
  std::map<std::string, std::size_t> holes_;  // and the end that each is drilled from
};

/// These ways with the grips as they are; both must outlive it.
class Reach {
 public:
  Reach(const PreparedPart& part, const Ways& ways);

  const Ways& ways() const { return ways_; }
  /// Whether a tool can reach outer element i from the free end.
  bool outer(std::size_t setup, std::size_t i) const;
  /// Whether a bore opens to the free end and narrows inwards, itself and with all before it.
  bool bore(std::size_t setup, std::size_t i) const;
  /// Of an outer element that the setup reaches.
  BeforeJaws before_jaws(std::size_t setup, std::size_t i) const;
  bool has_run_in(std::size_t setup, std::size_t i) const;

 private:
  const SeenOuter& seen(std::size_t setup, std::size_t i) const;

  const PreparedPart& p_;
  const Ways& ways_;
  std::vector<double> jaws_z_mm_, free_z_mm_;
};

}  // namespace turnwright::planning
