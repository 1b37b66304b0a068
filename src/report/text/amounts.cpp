#include "amounts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "json_fields.hpp"

namespace turnwright::report {
namespace {

constexpr double kSeconds = 60;      // of a minute
constexpr double kCounted_min = 10;  // longer ones are told in whole minutes

}  // namespace

std::string duration(std::optional<double> minutes) {
  if (!minutes) return "-";
  const double s = kSeconds * *minutes;
  if (s < 59.5) return shown(s, s < 9.95 ? 1 : 0) + " s";
  if (!(*minutes < kCounted_min)) return shown(minutes, 0) + " min";
  const long whole = std::lround(s);
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

std::string seconds(std::optional<double> minutes) {
  return minutes ? shown(kSeconds * *minutes, 1) : "-";
}

std::string money(std::optional<double> value) {
  if (!value || *value == 0) return shown(value, 2);
  constexpr int kDigits = 3;
  const int before = static_cast<int>(std::floor(std::log10(std::abs(*value)))) + 1;
  return shown(value, std::clamp(kDigits - before, 2, 9));
}

}  // namespace turnwright::report
