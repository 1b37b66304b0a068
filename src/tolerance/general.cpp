#include "turnwright/tolerance/general.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

#include "turnwright/base/units.hpp"

namespace turnwright::tolerance {
namespace {

/// Marks a cell that is empty in the standard.
constexpr double kNoClass = -1;

// Part 1: upper ends of the ranges [mm] and deviations [mm] for f, m, c, v.
constexpr std::array<double, 8> kLinearTo{3, 6, 30, 120, 400, 1000, 2000, 4000};
constexpr std::array<std::array<double, 8>, 4> kLinear{
    {{0.05, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, kNoClass},
     {0.1, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2},
     {0.2, 0.3, 0.5, 0.8, 1.2, 2, 3, 4},
     {kNoClass, 0.5, 1, 1.5, 2.5, 4, 6, 8}}};

// Part 1: radii and chamfers [mm], and angles [minutes of arc].
constexpr double kNoEnd = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> kEdgeTo{3, 6, kNoEnd};
constexpr std::array<std::array<double, 3>, 4> kEdge{
    {{0.2, 0.5, 1}, {0.2, 0.5, 1}, {0.4, 1, 2}, {0.4, 1, 2}}};
constexpr std::array<double, 5> kAngleTo{10, 50, 120, 400, kNoEnd};
constexpr std::array<std::array<double, 5>, 4> kAngle_min{{{60, 30, 20, 10, 5},
                                                           {60, 30, 20, 10, 5},
                                                           {90, 60, 30, 15, 10},
                                                           {180, 120, 60, 30, 20}}};

// Part 2: the same for H, K, L.
constexpr std::array<double, 6> kStraightnessTo{10, 30, 100, 300, 1000, 3000};
constexpr std::array<std::array<double, 6>, 3> kStraightness{
    {{0.02, 0.05, 0.1, 0.2, 0.3, 0.4},
     {0.05, 0.1, 0.2, 0.4, 0.6, 0.8},
     {0.1, 0.2, 0.4, 0.8, 1.2, 1.6}}};
constexpr std::array<double, 4> kPerpendicularityTo{100, 300, 1000, 3000};
constexpr std::array<std::array<double, 4>, 3> kPerpendicularity{
    {{0.2, 0.3, 0.4, 0.5}, {0.4, 0.6, 0.8, 1}, {0.6, 1, 1.5, 2}}};
constexpr std::array<std::array<double, 4>, 3> kSymmetry{
    {{0.5, 0.5, 0.5, 0.5}, {0.6, 0.6, 0.8, 1}, {0.6, 1, 1.5, 2}}};
constexpr std::array<double, 3> kRunout{0.1, 0.2, 0.5};

template <std::size_t N>
double value_of(double size_mm, const std::array<double, N>& up_to,
                const std::array<double, N>& values) {
  const auto range = std::ranges::lower_bound(up_to, size_mm) - up_to.begin();
  return values[static_cast<std::size_t>(range)];
}

void check_length(double length_mm) {
  if (!(length_mm > 0 && length_mm <= 3000))
    throw std::domain_error(
        fmt::format("length {} mm: ISO 2768-2 holds above 0 up to 3000 mm", length_mm));
}

using part::ToleranceKind;

bool has_zone(const part::Drawing& drawing, const std::string& of, double at_most_mm,
              std::initializer_list<ToleranceKind> kinds) {
  return std::ranges::any_of(drawing.tolerances, [&](const part::Tolerance& t) {
    return t.of == of && t.value_mm <= at_most_mm &&
           std::ranges::find(kinds, t.kind) != kinds.end();
  });
}

part::Tolerance zone(ToleranceKind kind, const std::string& of, double value_mm) {
  return {.id = of + ":" + part::name(kind),
          .kind = kind,
          .of = of,
          .datum = "",
          .between = {},
          .value_mm = value_mm};
}

template <class Element>
void add_straightness(const part::Drawing& drawing, const std::vector<Element>& elements,
                      GeometricalClass form, std::vector<part::Tolerance>& out) {
  using enum ToleranceKind;
  for (const auto& e : elements) {
    if (e.cut || part::stays(e) || !(e.length_mm > 0 && e.length_mm <= 3000)) continue;
    const double value = general_straightness_mm(e.length_mm, form);
    const bool held =
        (e.limits && (e.limits->upper_mm - e.limits->lower_mm) / 2 <= value) ||
        has_zone(drawing, e.id, value,
                 {straightness, cylindricity, total_radial_runout, profile,
                  profile_without_datum});
    if (!held) out.push_back(zone(straightness, e.id, value));
  }
}

void add_flatness(const part::Drawing& drawing, const std::string& id, double diameter_mm,
                  double allowance_mm, GeometricalClass form,
                  std::vector<part::Tolerance>& out) {
  using enum ToleranceKind;
  if (!(diameter_mm > 0 && diameter_mm <= 3000 && allowance_mm > 0)) return;
  const double value = general_straightness_mm(diameter_mm, form);
  if (!has_zone(drawing, id, value,
                {flatness, parallelism, perpendicularity, total_axial_runout}))
    out.push_back(zone(flatness, id, value));
}

}  // namespace

GeneralTolerance general_tolerance(std::string_view designation) {
  constexpr std::string_view kPrefix = "ISO 2768-", kLinearNames = "fmcv",
                             kGeometricalNames = "HKL";
  if (designation.starts_with(kPrefix)) {
    std::string_view rest = designation.substr(kPrefix.size());
    GeneralTolerance out;
    const auto take = [&rest](std::string_view names) {
      const auto at = rest.empty() ? std::string_view::npos : names.find(rest.front());
      if (at != std::string_view::npos) rest.remove_prefix(1);
      return at;
    };
    if (const auto at = take(kLinearNames); at != std::string_view::npos)
      out.linear = static_cast<LinearClass>(at);
    if (const auto at = take(kGeometricalNames); at != std::string_view::npos)
      out.geometrical = static_cast<GeometricalClass>(at);
    if (rest.empty() && (out.linear || out.geometrical)) return out;
  }
  throw std::domain_error(fmt::format(
      "general tolerance '{}': write \"ISO 2768-\" with f, m, c or v for sizes "
      "and H, K or L for form and position, such as \"ISO 2768-mK\"",
      designation));
}

part::Limits general_limits_mm(double nominal_mm, LinearClass tolerance_class) {
  if (!(nominal_mm >= 0.5 && nominal_mm <= 4000))
    throw std::domain_error(fmt::format(
        "nominal size {} mm: ISO 2768-1 holds from 0.5 to 4000 mm", nominal_mm));
  const double dev =
      value_of(nominal_mm, kLinearTo, kLinear[static_cast<std::size_t>(tolerance_class)]);
  if (dev == kNoClass)
    throw std::domain_error(fmt::format("nominal size {} mm: ISO 2768-1 {}", nominal_mm,
                                        tolerance_class == LinearClass::f
                                            ? "class f ends at 2000 mm"
                                            : "class v starts above 3 mm"));
  return {.lower_mm = -dev, .upper_mm = dev};
}

part::Limits general_edge_limits_mm(double nominal_mm, LinearClass tolerance_class) {
  if (!(nominal_mm >= 0.5))
    throw std::domain_error(
        fmt::format("radius or chamfer {} mm: ISO 2768-1 holds from 0.5 mm", nominal_mm));
  const double dev =
      value_of(nominal_mm, kEdgeTo, kEdge[static_cast<std::size_t>(tolerance_class)]);
  return {.lower_mm = -dev, .upper_mm = dev};
}

double general_angle_rad(double leg_mm, LinearClass tolerance_class) {
  if (!(leg_mm > 0))
    throw std::domain_error(
        fmt::format("shorter leg {} mm: ISO 2768-1 holds above 0 mm", leg_mm));
  const auto row = static_cast<std::size_t>(tolerance_class);
  return units::rad_from_deg(value_of(leg_mm, kAngleTo, kAngle_min[row]) / 60);
}

double general_straightness_mm(double length_mm, GeometricalClass tolerance_class) {
  check_length(length_mm);
  return value_of(length_mm, kStraightnessTo,
                  kStraightness[static_cast<std::size_t>(tolerance_class)]);
}

double general_perpendicularity_mm(double length_mm, GeometricalClass tolerance_class) {
  check_length(length_mm);
  return value_of(length_mm, kPerpendicularityTo,
                  kPerpendicularity[static_cast<std::size_t>(tolerance_class)]);
}

double general_symmetry_mm(double length_mm, GeometricalClass tolerance_class) {
  check_length(length_mm);
  return value_of(length_mm, kPerpendicularityTo,
                  kSymmetry[static_cast<std::size_t>(tolerance_class)]);
}

double general_runout_mm(GeometricalClass tolerance_class) {
  return kRunout[static_cast<std::size_t>(tolerance_class)];
}

std::vector<part::Tolerance> implied_form_tolerances(const part::Drawing& drawing,
                                                     GeometricalClass tolerance_class) {
  std::vector<part::Tolerance> out;
  add_straightness(drawing, drawing.outer, tolerance_class, out);
  add_straightness(drawing, drawing.inner, tolerance_class, out);
  const auto& outer = drawing.outer;
  if (outer.empty()) return out;
  add_flatness(drawing, "left", outer.front().left_mm, drawing.stock.left_allowance_mm,
               tolerance_class, out);
  add_flatness(drawing, "right", outer.back().right_mm, part::right_allowance_mm(drawing),
               tolerance_class, out);
  return out;
}

}  // namespace turnwright::tolerance
