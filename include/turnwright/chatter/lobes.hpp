#pragma once
#include <map>
#include <mutex>
#include <vector>

#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {

/// Depth of cut at the first loss of stability for a spindle speed.  A closed island of
/// instability is such a loss, too; stable depths above it are not used.
///
/// Motion and limits depend on the product of depth and force alone, so the system has a
/// unit force and the results are w Kt [N/mm], with the axial depth w and the tangential
/// force coefficient Kt, for a given ratio Kn/Kt.
///
/// Results are cached; they do not depend on the order of the calls or on the thread.
class Lobes {
 public:
  /// @param systems  with unit force (LinearForce{1, Kn/Kt}); a cut passes through all of
  ///   them, and the least limit counts.
  explicit Lobes(std::vector<System> systems);

  /// The first loss [N/mm], or `enough` if there is none up to that.  Where limits cannot
  /// be computed (ModelRangeError of speed_limits) it is a depth up to which they were.
  double stable_to_N_mm(double n_rpm, double enough) const;

  const std::vector<System>& systems() const { return systems_; }

 private:
  struct Known {
    double searched = 0;  // end of the search
    bool lost = false;    // whether stability is lost there
  };
  Known search(const System& system, double n_rpm, Known known, double enough) const;

  std::vector<System> systems_;
  double first_;  // where searches begin
  mutable std::mutex mutex_;
  mutable std::map<double, std::vector<Known>> known_;
};

}  // namespace turnwright::chatter
