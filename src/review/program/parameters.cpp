#include "parameters.hpp"

#include <cmath>
#include <string_view>

#include "base/say.hpp"

namespace turnwright::review {
namespace {

constexpr int kLinuxCncUsers = 5000, kLargestNumber = 99'999;
constexpr int kFanucCommon = 100, kFanucCommonEnd = 999;
constexpr int kSiemensEnd = 999, kOkumaEnd = 200;
constexpr int kX = 5420, kZ = 5422;
constexpr double kWhole = 1e-4;  // LinuxCNC's and ours
constexpr std::size_t kNames = 1000;

std::string_view own_letter(Language l) {
  return l == Language::siemens ? "R" : l == Language::okuma ? "V" : "#";
}

// The name of an array without its index.
std::string array_of(const std::string& name) { return name.substr(0, name.find('[')); }

}  // namespace

Language language_of(gcode::Control control) {
  using gcode::Control;
  switch (control) {
    case Control::linuxcnc:
      return Language::linuxcnc;
    case Control::siemens:
      return Language::siemens;
    case Control::okuma:
      return Language::okuma;
    case Control::fanuc:
    case Control::fanuc_b:
    case Control::haas:
    case Control::siemens_iso:
      break;
  }
  return Language::macro_b;
}

int Parameters::number_of(double number) const {
  const double whole = std::round(number);
  if (!(std::abs(number - whole) <= kWhole && whole >= 0 && whole <= kLargestNumber))
    throw NotFollowed(say("There is no variable {}{:g}.", own_letter(language_), number));
  return static_cast<int>(whole);
}

Value Parameters::at(double number) const {
  const int n = number_of(number);
  if (n == 0 && language_ == Language::macro_b) return std::nullopt;
  if (local(n)) {
    const auto& value = locals_.back().numbered[static_cast<std::size_t>(n)];
    return linuxcnc() ? value.value_or(0) : value;
  }
  if (linuxcnc() && (n == kX || n == kZ))
    if (const auto& place = n == kX ? x : z) return place;
  const auto set = numbered_.find(n);
  if (set != numbered_.end()) return set->second;
  if (linuxcnc() && n > 0 && n <= kLinuxCncUsers) return 0;
  throw NotFollowed(
      say("The value of {}{} is the control's, the program does not tell it.",
          own_letter(language_), n));
}

std::optional<double> Parameters::find(const std::string& name) const {
  const auto& all = common(name) ? named_ : locals_.back().named;
  const auto found = all.find(name);
  if (found != all.end()) return found->second;
  if (declared(name)) return 0;
  if (linuxcnc() && name == "_x") return x;
  if (linuxcnc() && name == "_z") return z;
  return std::nullopt;
}

double Parameters::at(const std::string& name) const {
  const auto value = find(name);
  if (!value)
    throw NotFollowed(say("The program does not tell the value of {}.",
                          linuxcnc() ? "#<" + name + ">" : name));
  return *value;
}

bool Parameters::of_program(int n) const {
  switch (language_) {
    case Language::linuxcnc:
      return n > 0 && n <= kLinuxCncUsers;
    case Language::macro_b:
      return n >= kFanucCommon && n <= kFanucCommonEnd;
    case Language::siemens:
      return n <= kSiemensEnd;
    case Language::okuma:
      break;
  }
  return n > 0 && n <= kOkumaEnd;
}

// Whether a name is of all programs: LinuxCNC's with "_", Okuma's VC with a number.
bool Parameters::common(const std::string& name) const {
  if (linuxcnc()) return name.starts_with('_');
  if (language_ != Language::okuma || !name.starts_with('v')) return false;
  const bool users = name.size() > 2 && name.starts_with("vc") &&
                     name.find_first_not_of("0123456789", 2) == name.npos;
  if (!users) throw NotFollowed(say("{} is a variable of the control's own.", name));
  return true;
}

void Parameters::set(double number, Value value) {
  const int n = number_of(number);
  if (local(n)) {
    locals_.back().numbered[static_cast<std::size_t>(n)] = value;
    return;
  }
  if (!of_program(n))
    throw NotFollowed(say("What the control does when {}{} is set is not known.",
                          own_letter(language_), n));
  numbered_[n] = value;
}

void Parameters::set(const std::string& name, double value) {
  auto& all = common(name) ? named_ : locals_.back().named;
  if (all.size() >= kNames && !all.contains(name))
    throw NotFollowed(tr("The program has more than 1000 named variables."));
  const auto declared = locals_.back().declared.find(array_of(name));
  const bool whole = declared != locals_.back().declared.end() && declared->second;
  all[name] = whole ? std::round(value) : value;
}

void Parameters::declare(const std::string& name, bool whole) {
  auto& all = locals_.back().declared;
  if (all.size() >= kNames)
    throw NotFollowed(tr("The program has more than 1000 named variables."));
  all[array_of(name)] = whole;
}

bool Parameters::declared(const std::string& name) const {
  return locals_.back().declared.contains(array_of(name));
}

void Parameters::enter(const std::map<int, double>& arguments) {
  locals_.emplace_back();
  for (const auto& [n, value] : arguments)
    if (local(n)) locals_.back().numbered[static_cast<std::size_t>(n)] = value;
  first_.push_back(locals_.back());
}

void Parameters::leave() {
  locals_.pop_back();
  first_.pop_back();
}

}  // namespace turnwright::review
