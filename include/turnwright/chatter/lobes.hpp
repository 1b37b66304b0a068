#pragma once
#include <map>
#include <mutex>
#include <vector>

#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {

/// How deep a cutter may go at a spindle speed before the first loss of stability,
/// whatever it does there: a lens of instability that opens and closes again ends the
/// depth, islands beyond are not used.
///
/// Motion and limits depend on depth times force alone, so the system is taken with a
/// unit force: what is told is w Kt [N/mm], w the axial depth and Kt the tangential
/// stiffness of the chip, for a given Kn/Kt.
///
/// What was found is remembered; the same question is answered the same in any order and
/// from any thread.
class Lobes {
 public:
  /// @param systems  of unit force (LinearForce{1, Kn/Kt}); a cut passes through all of
  ///   them, the least counts.
  explicit Lobes(std::vector<System> systems);

  /// The first loss [N/mm], `enough` if there is none up to it.  Where limits cannot be
  /// told (ModelRangeError of speed_limits) it is a depth up to which they were.
  double stable_to_N_mm(double n_rpm, double enough) const;

  const std::vector<System>& systems() const { return systems_; }

 private:
  struct Known {
    double searched = 0;  // up to here
    bool lost = false;    // there
  };
  Known search(const System& system, double n_rpm, Known known, double enough) const;

  std::vector<System> systems_;
  double first_;  // where searches begin
  mutable std::mutex mutex_;
  mutable std::map<double, std::vector<Known>> known_;
};

}  // namespace turnwright::chatter
