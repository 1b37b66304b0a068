#include "turnwright/part/inch_thread.hpp"

#include <charconv>
#include <cmath>

namespace turnwright::part {
namespace {

constexpr double kLargest_in = 24;
constexpr int kMostPerInch = 120;
constexpr int kFinest = 64;  // of an inch, the least fraction
constexpr int kMostNumber = 12;

double numbered_in(int n) { return 0.060 + 0.013 * n; }  // Eq. (2)

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

// An unsigned number with or without a point.
std::optional<double> take_number(std::string_view& text, bool whole) {
  constexpr std::size_t kLongest = 12;
  std::size_t n = 0;
  bool digit = false;
  for (; n < text.size() && n < kLongest; ++n) {
    if (is_digit(text[n]))
      digit = true;
    else if (whole || text[n] != '.')
      break;
  }
  double x = 0;
  const auto read = std::from_chars(text.data(), text.data() + n, x);
  if (!digit || read.ec != std::errc() || read.ptr != text.data() + n)
    return std::nullopt;
  text.remove_prefix(n);
  return x;
}

// "/2" behind a numerator.
std::optional<double> take_quotient(std::string_view& text, double numerator) {
  take(text, '/');
  const auto by = take_number(text, true);
  return by && *by > 0 ? std::optional(numerator / *by) : std::nullopt;
}

// "1/2", "1-1/4", "1 1/4", "0.5", ".500", "#10", in inches.
std::optional<double> take_size_in(std::string_view& text) {
  if (take(text, '#')) {
    const auto n = take_number(text, true);
    if (!n || *n > kMostNumber) return std::nullopt;
    return numbered_in(static_cast<int>(*n));
  }
  const auto first = take_number(text, false);
  if (!first) return std::nullopt;
  if (text.starts_with('/')) return take_quotient(text, *first);
  auto rest = text;
  if (!take(rest, '-') && !take(rest, ' ')) return first;
  const auto second = take_number(rest, true);
  if (!second || !rest.starts_with('/')) return first;
  const auto part = take_quotient(rest, *second);
  if (!part || !(*part < 1)) return std::nullopt;
  text = rest;
  return *first + *part;
}

// One of the series, behind a blank or '-' or not; there may be none.
void take_series(std::string_view& text) {
  auto rest = text;
  if (!take(rest, ' ')) take(rest, '-');
  for (const std::string_view series : {"UNEF", "UNC", "UNF", "UNS", "UN"})
    if (rest.starts_with(series)) {
      text = rest.substr(series.size());
      return;
    }
}

std::optional<std::string> take_class(std::string_view& text) {
  if (text.empty()) return "";
  if (!take(text, ' ') && !take(text, '-')) return std::nullopt;
  const bool is = text.size() == 2 && text[0] >= '1' && text[0] <= '3' &&
                  (text[1] == 'A' || text[1] == 'B');
  return is ? std::optional<std::string>(text) : std::nullopt;
}

}  // namespace

std::optional<InchThread> inch_thread(std::string_view text) {
  const auto size_in = take_size_in(text);
  if (!size_in || !take(text, '-')) return std::nullopt;
  const auto per_inch = take_number(text, false);
  const bool known = per_inch && *size_in > 0 && *size_in <= kLargest_in &&
                     *per_inch >= 1 && *per_inch <= kMostPerInch;
  if (!known) return std::nullopt;
  take_series(text);
  auto tolerance_class = take_class(text);
  if (!tolerance_class) return std::nullopt;
  return InchThread{kInch_mm * *size_in, kInch_mm / *per_inch,  // Eq. (1)
                    std::move(*tolerance_class)};
}

std::optional<std::string> inch_designation(double d_mm, double pitch_mm) {
  const double n = std::round(kInch_mm / pitch_mm);
  if (!(n >= 1 && n <= kMostPerInch) || kInch_mm / n != pitch_mm) return std::nullopt;
  const auto end = '-' + std::to_string(static_cast<int>(n)) + " UN";
  for (int k = 0; k <= kMostNumber; ++k)
    if (kInch_mm * numbered_in(k) == d_mm) return '#' + std::to_string(k) + end;
  const double parts = std::round(d_mm / kInch_mm * kFinest);
  if (!(parts >= 1 && parts <= kLargest_in * kFinest)) return std::nullopt;
  const int whole = static_cast<int>(parts) / kFinest;
  int over = static_cast<int>(parts) % kFinest, under = kFinest;
  if (kInch_mm * (whole + static_cast<double>(over) / under) != d_mm) return std::nullopt;
  if (over == 0) return std::to_string(whole) + end;
  for (; over % 2 == 0; under /= 2) over /= 2;
  return (whole > 0 ? std::to_string(whole) + '-' : "") + std::to_string(over) + '/' +
         std::to_string(under) + end;
}

}  // namespace turnwright::part
