#include "turnwright/chatter/lobes.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "turnwright/base/errors.hpp"

namespace turnwright::chatter {
namespace {

// 2 k zeta, of the order of magnitude of the absolute limit.
double first_guess(const std::vector<System>& systems) {
  double least = 1e300;
  for (const auto& s : systems)
    for (const auto& m : s.modes) least = std::min(least, 2 * m.k_N_mm * m.zeta);
  return least;
}

// If a search ends with a multiplier on the circle to within rounding it is continued
// slightly deeper.  Depths that cannot be decided count as unstable.
std::optional<double> first_loss(const System& system, double n_rpm, double before,
                                 double& depth) {
  for (const double deeper : {1.0, 1.05}) {
    depth *= deeper;
    try {
      return speed_limits(system, n_rpm, depth).limit_mm();
    } catch (const TooManyVibrations&) {
      return before;
    } catch (const ModelRangeError&) {
    }
  }
  return before;
}

}  // namespace

Lobes::Lobes(std::vector<System> systems)
    : systems_(std::move(systems)), first_(first_guess(systems_)) {}

// Each search goes twice as deep as the one before, because a search far above the first
// loss takes long.  The depths do not depend on the call, so neither do the last digits
// of the result.
Lobes::Known Lobes::search(const System& system, double n_rpm, Known k,
                           double enough) const {
  while (!k.lost && k.searched < enough) {
    const double before = k.searched;
    k.searched = before > 0 ? 2 * before : first_;
    if (const auto loss = first_loss(system, n_rpm, before, k.searched))
      k = {*loss, true};
  }
  return k;
}

double Lobes::stable_to_N_mm(double n_rpm, double enough) const {
  const auto start = [&] {
    const std::scoped_lock lock(mutex_);
    return known_.try_emplace(n_rpm, systems_.size()).first->second;
  }();
  auto found = start;
  double least = enough;
  for (std::size_t i = 0; i < systems_.size(); ++i) {
    found[i] = search(systems_[i], n_rpm, found[i], least);
    if (found[i].lost) least = std::min(least, found[i].searched);
  }
  const std::scoped_lock lock(mutex_);
  auto& known = known_[n_rpm];
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i].lost && (found[i].lost || found[i].searched > known[i].searched))
      known[i] = found[i];
  return least;
}

}  // namespace turnwright::chatter
