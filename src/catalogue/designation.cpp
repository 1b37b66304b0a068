#include "designation.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "base/say.hpp"
#include "turnwright/catalogue/tool_codes.hpp"

namespace turnwright::catalogue {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::string_view kClearanceLetters = "ABCDEFGNP";
constexpr std::array kClearances_deg{3.0, 5.0, 7.0, 15.0, 20.0, 25.0, 30.0, 0.0, 11.0};

}  // namespace

std::optional<double> clearance_of_letter_deg(char letter) {
  const auto at = kClearanceLetters.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  return kClearances_deg[at];
}

std::optional<char> clearance_letter(double clearance_deg) {
  const auto at =
      std::find(kClearances_deg.begin(), kClearances_deg.end(), clearance_deg);
  if (at == kClearances_deg.end()) return std::nullopt;
  return kClearanceLetters[static_cast<std::size_t>(at - kClearances_deg.begin())];
}

std::string_view Designation::take(std::size_t count) {
  while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  const std::string_view symbol = std::string_view(text_).substr(at_, count);
  at_ += symbol.size();
  ++number_;
  last_ = symbol;
  if (symbol.size() != count) fail(tr("is missing"));
  return symbol;
}

char Designation::take_one_of(std::string_view letters) {
  const char c = take(1).front();
  if (letters.find(c) == std::string_view::npos) fail(say("must be one of {}", letters));
  return c;
}

int Designation::take_two_digits() {
  const auto s = take(2);
  if (!is_digit(s[0]) || !is_digit(s[1])) fail(tr("must be two digits"));
  return 10 * (s[0] - '0') + (s[1] - '0');
}

bool Designation::digit_follows() const {
  return at_ < text_.size() && is_digit(text_[at_]);
}

bool Designation::point_follows() const {
  return at_ < text_.size() && text_[at_] == '.';
}

void Designation::fail(const std::string& rule) const {
  throw std::domain_error(
      say("{}: \"{}\": symbol {} (\"{}\") {}", function_, text_, number_, last_, rule));
}

}  // namespace turnwright::catalogue
