#include "turnwright/chatter/stability_limits.hpp"

namespace turnwright::chatter {

std::optional<double> SpeedLimits::limit_mm() const {
  if (crossings.empty()) return std::nullopt;
  return crossings.front().ap_mm;
}

}  // namespace turnwright::chatter
