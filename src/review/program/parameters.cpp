#include "parameters.hpp"

#include <fmt/format.h>

#include <cmath>

namespace turnwright::review {
namespace {

constexpr int kLinuxCncUsers = 5000, kLargestNumber = 99'999;
constexpr int kFanucCommon = 100, kFanucCommonEnd = 999;
constexpr int kX = 5420, kZ = 5422;
constexpr double kWhole = 1e-4;  // LinuxCNC's and ours
constexpr std::size_t kNames = 1000;

}  // namespace

int Parameters::number_of(double number) const {
  const double whole = std::round(number);
  if (!(std::abs(number - whole) <= kWhole && whole >= 0 && whole <= kLargestNumber))
    throw NotFollowed(fmt::format("There is no variable #{:g}.", number));
  return static_cast<int>(whole);
}

Value Parameters::at(double number) const {
  const int n = number_of(number);
  if (n == 0 && !linuxcnc_) return std::nullopt;
  if (local(n)) {
    const auto& value = locals_.back().numbered[static_cast<std::size_t>(n)];
    return linuxcnc_ ? value.value_or(0) : value;
  }
  if (linuxcnc_ && (n == kX || n == kZ))
    if (const auto& place = n == kX ? x : z) return place;
  const auto set = numbered_.find(n);
  if (set != numbered_.end()) return set->second;
  if (linuxcnc_ && n > 0 && n <= kLinuxCncUsers) return 0;
  throw NotFollowed(
      fmt::format("The value of #{} is the control's, the program does not tell it.", n));
}

std::optional<double> Parameters::find(const std::string& name) const {
  const auto& all = name.starts_with('_') ? named_ : locals_.back().named;
  const auto found = all.find(name);
  if (found != all.end()) return found->second;
  if (name == "_x") return x;
  if (name == "_z") return z;
  return std::nullopt;
}

double Parameters::at(const std::string& name) const {
  const auto value = find(name);
  if (!value)
    throw NotFollowed(fmt::format("The program does not tell the value of #<{}>.", name));
  return *value;
}

void Parameters::set(double number, Value value) {
  const int n = number_of(number);
  if (local(n)) {
    locals_.back().numbered[static_cast<std::size_t>(n)] = value;
    return;
  }
  const bool users = linuxcnc_ ? n > 0 && n <= kLinuxCncUsers
                               : n >= kFanucCommon && n <= kFanucCommonEnd;
  if (!users)
    throw NotFollowed(
        fmt::format("What the control does when #{} is set is not known.", n));
  numbered_[n] = value;
}

void Parameters::set(const std::string& name, double value) {
  auto& all = name.starts_with('_') ? named_ : locals_.back().named;
  if (all.size() >= kNames && !all.contains(name))
    throw NotFollowed("The program has more than 1000 named variables.");
  all[name] = value;
}

void Parameters::enter(const std::map<int, double>& arguments) {
  locals_.emplace_back();
  for (const auto& [n, value] : arguments)
    if (local(n)) locals_.back().numbered[static_cast<std::size_t>(n)] = value;
}

void Parameters::leave() { locals_.pop_back(); }

}  // namespace turnwright::review
