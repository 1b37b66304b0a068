#include "turnwright/volumetric/linuxcnc_compensation.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace turnwright::volumetric {
namespace {

/// A number with a fixed number of decimals, never "-0.000000".
std::string fixed(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return fmt::format("{:.{}f}", std::round(value * scale) == 0 ? 0.0 : value, decimals);
}

/// Takes a number, and the blanks before it, off a line.
std::optional<double> take_number(std::string_view& line) {
  const auto start = line.find_first_not_of(" \t");
  if (start == line.npos) return std::nullopt;
  line.remove_prefix(start);
  if (line.starts_with('+') && !line.starts_with("+-")) line.remove_prefix(1);
  double value = 0;
  const auto [end, error] =
      std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return value;
}

}  // namespace

std::string comp_file(std::span<const CompensationPoint> points, CompFileType type,
                      double unit_mm) {
  if (points.empty() || points.size() > kCompFileRows)
    throw std::domain_error("comp_file: 1 to 256 points");
  const int decimals = unit_mm > 1 ? 7 : 6;
  std::string out, before;
  for (const CompensationPoint& p : points) {
    const auto text = [&](double mm) { return fixed(mm / unit_mm, decimals); };
    const auto written = [&](double deviation_mm) {  // Eq. (1)
      return text(type == CompFileType::actual ? p.nominal_mm + deviation_mm
                                               : -deviation_mm);
    };
    const std::string nominal = text(p.nominal_mm);
    if (&p != &points.front() &&
        (!(p.nominal_mm > (&p - 1)->nominal_mm) || nominal == before))
      throw std::domain_error("comp_file: nominal positions that rise as written");
    out += nominal + ' ' + written(p.plus_mm) + ' ' + written(p.minus_mm) + '\n';
    before = nominal;
  }
  return out;
}

std::optional<CompensationPoint> comp_file_point(std::string_view line, CompFileType type,
                                                 double unit_mm) {
  std::array<double, 3> number{};
  for (double& one : number) {
    const auto found = take_number(line);
    if (!found) return std::nullopt;
    one = unit_mm * *found;
  }
  const auto [nominal, plus, minus] = number;
  if (type == CompFileType::trim) return CompensationPoint{nominal, -plus, -minus};
  return CompensationPoint{nominal, plus - nominal, minus - nominal};
}

}  // namespace turnwright::volumetric
