#include "measured_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

struct NamedUnit {
  std::string_view name;
  MeasuredUnit unit;
};

constexpr double kInch_mm = 25.4, kGravity_mm_s2 = 9806.65, kPound_N = 4.4482216152605,
                 kKilopond_N = 9.80665;
constexpr std::array kUnits{NamedUnit{"m", {1e3, 1, 0, 0}},
                            NamedUnit{"cm", {10, 1, 0, 0}},
                            NamedUnit{"mm", {1, 1, 0, 0}},
                            NamedUnit{"um", {1e-3, 1, 0, 0}},
                            NamedUnit{"nm", {1e-6, 1, 0, 0}},
                            NamedUnit{"in", {kInch_mm, 1, 0, 0}},
                            NamedUnit{"inch", {kInch_mm, 1, 0, 0}},
                            NamedUnit{"mil", {kInch_mm / 1000, 1, 0, 0}},
                            NamedUnit{"ft", {12 * kInch_mm, 1, 0, 0}},
                            NamedUnit{"s", {1, 0, 1, 0}},
                            NamedUnit{"sec", {1, 0, 1, 0}},
                            NamedUnit{"ms", {1e-3, 0, 1, 0}},
                            NamedUnit{"us", {1e-6, 0, 1, 0}},
                            NamedUnit{"N", {1, 0, 0, 1}},
                            NamedUnit{"mN", {1e-3, 0, 0, 1}},
                            NamedUnit{"kN", {1e3, 0, 0, 1}},
                            NamedUnit{"lbf", {kPound_N, 0, 0, 1}},
                            NamedUnit{"lb", {kPound_N, 0, 0, 1}},
                            NamedUnit{"kgf", {kKilopond_N, 0, 0, 1}},
                            NamedUnit{"kp", {kKilopond_N, 0, 0, 1}},
                            NamedUnit{"g", {kGravity_mm_s2, 1, -2, 0}},
                            NamedUnit{"ips", {kInch_mm, 1, -1, 0}},
                            NamedUnit{"kg", {1e-3, -1, 2, 1}}};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

constexpr int kMostPower = 9, kMostDeep = 9;

MeasuredUnit power(const MeasuredUnit& u, int n) {
  return {std::pow(u.scale, n), n * u.length, n * u.time, n * u.force};
}

MeasuredUnit product(const MeasuredUnit& a, const MeasuredUnit& b) {
  return {a.scale * b.scale, a.length + b.length, a.time + b.time, a.force + b.force};
}

/// With one sign for each meaning: u for both letters mu, ^2 for superscripts, * for dots.
std::string plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kSigns{
      {{"\u00b5", "u"},
       {"\u03bc", "u"},
       {"\u207b", "^-"},
       {"\u00b9", "^1"},
       {"\u00b2", "^2"},
       {"\u00b3", "^3"},
       {"\u00b7", "*"},
       {"\u22c5", "*"},
       {"[", "("},
       {"]", ")"},
       {"\u00a0", " "},
       {"^-^", "^-"}}};
  std::string out(text);
  for (const auto& [sign, with] : kSigns)
    for (std::size_t at = 0; (at = out.find(sign, at)) != out.npos; at += with.size())
      out.replace(at, sign.size(), with);
  return out;
}

/// Recursive descent over a unit's text; fails by returning nothing.
class UnitText {
 public:
  explicit UnitText(std::string_view text) : rest_(text) {}

  std::optional<MeasuredUnit> whole() {
    const auto out = unit(0);
    return rest_.empty() ? out : std::nullopt;
  }

 private:
  std::optional<MeasuredUnit> unit(int deep) {
    auto out = factor(deep);
    while (out) {
      const bool blank = skip_blanks();
      if (rest_.empty() || rest_.front() == ')') break;
      const bool divided = take('/'), joined = divided || take('*') || take('.');
      if (!joined && !blank && rest_.front() != '(') return std::nullopt;
      skip_blanks();
      const auto next = factor(deep);
      if (!next) return std::nullopt;
      out = product(*out, divided ? power(*next, -1) : *next);
    }
    return out;
  }

  std::optional<MeasuredUnit> factor(int deep) {
    if (take('(')) {
      if (deep == kMostDeep) return std::nullopt;
      skip_blanks();
      const auto inside = unit(deep + 1);
      if (!inside || !take(')')) return std::nullopt;
      return raised(*inside);
    }
    if (take('1')) return MeasuredUnit{};
    std::size_t letters = 0;
    while (letters < rest_.size() && is_letter(rest_[letters])) ++letters;
    for (const NamedUnit& u : kUnits)
      if (u.name == rest_.substr(0, letters)) {
        rest_.remove_prefix(letters);
        return raised(u.unit);
      }
    return std::nullopt;
  }

  /// With the exponent that follows, if any.
  std::optional<MeasuredUnit> raised(const MeasuredUnit& u) {
    const bool marked = take('^');
    const bool minus =
        rest_.size() > 1 && rest_[0] == '-' && is_digit(rest_[1]) && take('-');
    if (rest_.empty() || !is_digit(rest_.front()))
      return marked || minus ? std::nullopt : std::optional(u);
    const int n = rest_.front() - '0';
    rest_.remove_prefix(1);
    if (n > kMostPower || (!rest_.empty() && is_digit(rest_.front())))
      return std::nullopt;
    return power(u, minus ? -n : n);
  }

  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool skip_blanks() {
    const bool blank = rest_.starts_with(' ');
    while (take(' ')) continue;
    return blank;
  }

  std::string_view rest_;
};

}  // namespace

std::optional<MeasuredUnit> measured_unit(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) return std::nullopt;
  const std::string signs = plain(text);
  return UnitText(signs).whole();
}

std::optional<ResponseUnit> response_unit(const MeasuredUnit& unit) {
  for (const int d : {0, 1, 2})
    if (unit.of_dimensions(1, -d, -1)) return ResponseUnit{d, unit.scale};
  return std::nullopt;
}

std::optional<ResponseUnit> response_unit(std::string_view text) {
  const auto unit = measured_unit(text);
  return unit ? response_unit(*unit) : std::nullopt;
}

std::optional<double> hertz_of_unit(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 7> kHertz{
      {{"hz", 1},
       {"khz", 1e3},
       {"rad/s", 1 / (2 * units::kPi)},
       {"rad/sec", 1 / (2 * units::kPi)},
       {"radians/s", 1 / (2 * units::kPi)},
       {"rpm", 1.0 / 60},
       {"cpm", 1.0 / 60}}};
  for (const auto& [name, hertz] : kHertz)
    if (std::ranges::equal(text, name, {}, lower)) return hertz;
  return std::nullopt;
}

std::optional<int> motion_derivative(const MeasuredUnit& unit) {
  for (const int d : {0, 1, 2})
    if (unit.of_dimensions(1, -d, 0)) return d;
  return std::nullopt;
}

std::string quantity_of(int derivative) {
  return derivative == 0   ? to_translate("receptance")
         : derivative == 1 ? to_translate("mobility")
                           : to_translate("accelerance");
}

}  // namespace turnwright::document
