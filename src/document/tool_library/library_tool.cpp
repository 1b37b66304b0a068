#include "library_tool.hpp"

#include <charconv>
#include <cmath>

namespace turnwright::document {

const std::vector<Symbol>& symbols() {
  using T = LibraryTool;
  static const std::vector<Symbol> kSymbols{
      {"IC", &T::IC_mm, true},       {"L", &T::L_mm, true},
      {"S", &T::S_mm, true},         {"RE", &T::RE_mm, true},
      {"AN", &T::AN_deg, false},     {"EPSR", &T::EPSR_deg, false},
      {"KAPR", &T::KAPR_deg, false}, {"PSIR", &T::PSIR_deg, false},
      {"GAMO", &T::GAMO_deg, false}, {"H", &T::H_mm, true},
      {"B", &T::B_mm, true},         {"LF", &T::LF_mm, true},
      {"LH", &T::LH_mm, true},       {"WF", &T::WF_mm, true},
      {"DCON", &T::DCON_mm, true},   {"DCONMS", &T::DCON_mm, true},
      {"DMM", &T::DCON_mm, true},    {"DMIN", &T::DMIN_mm, true},
      {"DMIN1", &T::DMIN_mm, true},  {"OHX", &T::OHX_mm, true},
      {"APMX", &T::APMX_mm, true},   {"DC", &T::DC_mm, true},
      {"TP", &T::TP_mm, true},       {"SIG", &T::SIG_deg, false},
      {"NOF", &T::NOF, false},       {"LU", &T::LU_mm, true},
  };
  return kSymbols;
}

std::optional<Quantity> quantity(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == text.npos) return std::nullopt;
  text.remove_prefix(begin);
  std::string digits(text.substr(0, kLongest));
  if (const auto comma = digits.find(','); comma != digits.npos) digits[comma] = '.';
  double value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - digits.data()));
  const auto unit = text.find_first_not_of(" \t\r\n");
  if (unit == text.npos) return Quantity{value, {}};
  text.remove_prefix(unit);
  return Quantity{value, text.substr(0, text.find_last_not_of(" \t\r\n") + 1)};
}

std::optional<double> unit_mm(std::string_view name) {
  constexpr double kInch_mm = 25.4;
  for (const auto metric : {"mm", "millimeters", "millimetres", "metric"})
    if (name == metric) return 1;
  for (const auto inch : {"in", "inch", "inches", "\""})
    if (name == inch) return kInch_mm;
  return std::nullopt;
}

}  // namespace turnwright::document
