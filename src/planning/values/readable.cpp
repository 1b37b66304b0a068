#include "readable.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/say.hpp"
#include "turnwright/planning/limit_words.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {

std::string readable(double value) {
  return std::abs(value) < 1e4 ? fmt::format("{:.4g}", value)
                               : fmt::format("{:.0f}", value);
}

std::pair<std::string, std::string> readable_apart(double a, double b) {
  constexpr int kExact = 12;
  std::pair text{readable(a), readable(b)};
  for (int digits = 5; text.first == text.second && digits <= kExact; ++digits) {
    const std::pair longer{fmt::format("{:.{}g}", a, digits),
                           fmt::format("{:.{}g}", b, digits)};
    if (longer.first != longer.second) text = longer;
  }
  return text;
}

std::string exceeded(const std::string& where, const ConstraintValue& c) {
  const auto [value, limit] = readable_apart(c.value, c.limit);
  const auto name = limit_words(c.name);
  if (value == limit) return say("{}: nothing is left for {}", where, name);
  return say("{}: {} is {} {} where {} {} is allowed", where, name, value, c.unit, limit,
             c.unit);
}

}  // namespace turnwright::planning
