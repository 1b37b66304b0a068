#include "readable.hpp"

#include <fmt/format.h>

#include <cmath>

namespace turnwright::planning {

std::string readable(double value) {
  return std::abs(value) < 1e4 ? fmt::format("{:.4g}", value)
                               : fmt::format("{:.0f}", value);
}

}  // namespace turnwright::planning
