#include "turnwright/part/thread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "turnwright/base/units.hpp"
#include "turnwright/part/inch_thread.hpp"

namespace turnwright::part {
namespace {

double middle_mm(const Limits& limits) { return (limits.lower_mm + limits.upper_mm) / 2; }

// Eq. (1).
Limits within(double deviation_mm, double width_mm, Where where) {
  const double far = deviation_mm + width_mm;
  return where == Where::outside ? Limits{-far, -deviation_mm}
                                 : Limits{deviation_mm, far};
}

// Factors of the grades 3 to 9; of the pitch diameter inside.
using Factors = std::array<double, 7>;
constexpr Factors kGrades{0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0};
constexpr Factors kPitchInside{0.67, 0.85, 1.06, 1.32, 1.7, 2.12, 2.65};

std::optional<double> of_grade(char grade, const Factors& factors) {
  if (grade < '3' || grade > '9') return std::nullopt;
  return factors[static_cast<std::size_t>(grade - '3')];
}

// Eq. (2).
std::optional<double> deviation_um(char letter, double P, Where where) {
  if (where == Where::inside) {
    if (letter == 'G') return 15 + 11 * P;
    return letter == 'H' ? std::optional(0.0) : std::nullopt;
  }
  switch (letter) {
    case 'e':
      return 50 + 11 * P;
    case 'f':
      return 30 + 11 * P;
    case 'g':
      return 15 + 11 * P;
    case 'h':
      return 0;
    default:
      return std::nullopt;
  }
}

// Geometric mean of the range of nominal diameters of ISO 965-1 about a diameter.
double mean_mm(double d) {
  constexpr std::array kRanges_mm{0.99, 1.4,  2.8,  5.6,   11.2,
                                  22.4, 45.0, 90.0, 180.0, 355.0};
  const auto end = std::ranges::lower_bound(kRanges_mm, d);
  if (end == kRanges_mm.begin() || end == kRanges_mm.end()) return d;
  return std::sqrt(*(end - 1) * *end);
}

double pitch_width_um(double d, double P) {  // Eq. (3), of grade 6 outside
  return 90 * std::pow(P, 0.4) * std::pow(mean_mm(d), 0.1);
}

double crest_width_um(double P, Where where) {  // Eq. (4)
  if (where == Where::outside) return 180 * std::pow(P, 2.0 / 3) - 3.15 / std::sqrt(P);
  return P <= 0.8 ? 433 * P - 190 * std::pow(P, 1.22) : 230 * std::pow(P, 0.7);
}

std::optional<ThreadLimits> metric(std::string_view text, double d, double P,
                                   Where where) {
  if (text.size() != 2 && text.size() != 4) return std::nullopt;
  const auto crest = text.substr(text.size() - 2);
  const auto q2 = of_grade(text[0], where == Where::inside ? kPitchInside : kGrades);
  const auto qc = of_grade(crest[0], kGrades);
  const auto e2 = deviation_um(text[1], P, where), ec = deviation_um(crest[1], P, where);
  if (!q2 || !qc || !e2 || !ec) return std::nullopt;
  return ThreadLimits{within(units::mm_from_um(*e2),
                             units::mm_from_um(*q2 * pitch_width_um(d, P)), where),
                      within(units::mm_from_um(*ec),
                             units::mm_from_um(*qc * crest_width_um(P, where)), where)};
}

double inch_crest_width(char number, double D, double P, Where where) {  // Eq. (6)
  const double P23 = std::cbrt(P * P);
  if (where == Where::outside) return (number == '1' ? 0.09 : 0.06) * P23;
  const double wide = 0.25 * P - 0.4 * P * P;
  if (number != '3' && D >= 0.25) return P >= 0.25 ? 0.15 * P : wide;
  const double fine = P < 1.0 / 12 ? 0.23 * P - 1.5 * P * P : 0.12 * P;
  return std::min(
      std::max(0.05 * P23 + 0.03 * P / D - 0.002, number == '3' ? fine : wide),
      0.394 * P);
}

std::optional<ThreadLimits> unified(std::string_view text, double d, double P,
                                    Where where) {
  const bool outside = where == Where::outside;
  if (text.size() != 2 || text[0] < '1' || text[0] > '3' ||
      text[1] != (outside ? 'A' : 'B'))
    return std::nullopt;
  constexpr std::array kOf2A{1.5, 1.0, 0.75};
  constexpr double kInside = 1.3, kAllowance = 0.3;
  const double D = d / kInch_mm, p = P / kInch_mm;
  const double of_2A =
      0.0015 * std::cbrt(D) + 0.0015 * std::sqrt(D) + 0.015 * std::cbrt(p * p);
  const double T2 =
      kOf2A[static_cast<std::size_t>(text[0] - '1')] * (outside ? 1 : kInside) * of_2A;
  const double e0 = outside && text[0] != '3' ? kAllowance * of_2A : 0;
  return ThreadLimits{
      within(kInch_mm * e0, kInch_mm * T2, where),
      within(kInch_mm * e0, kInch_mm * inch_crest_width(text[0], D, p, where), where)};
}

}  // namespace

std::optional<ThreadLimits> thread_limits(std::string_view tolerance_class, double d_mm,
                                          double pitch_mm, Where where) {
  const auto found = metric(tolerance_class, d_mm, pitch_mm, where);
  return found ? found : unified(tolerance_class, d_mm, pitch_mm, where);
}

MinorDiameter minor_diameter_6H(double d_mm, double pitch_mm) {
  const double least = thread(d_mm, pitch_mm, Where::inside).blank.left_mm;
  return {least,
          least + units::mm_from_um(crest_width_um(pitch_mm, Where::inside))};  // Eq. (7)
}

Shaped thread(double d_mm, double pitch_mm, Where where, const ThreadLimits& limits) {
  const double H = std::numbers::sqrt3 / 2 * pitch_mm;
  const bool outside = where == Where::outside;
  const double blank = outside ? d_mm : d_mm - 2 * (5.0 / 8) * H;
  const double root = outside ? d_mm - 2 * (17.0 / 24) * H : d_mm;
  const double core = root + middle_mm(limits.pitch);  // Eq. (8), (9)
  return {{blank, blank},
          {.kind = CutKind::thread,
           .drawn = {d_mm, d_mm},
           .core = {core, core},
           .depth_mm = std::abs(blank + middle_mm(limits.crest) - core) / 2,
           .pitch_mm = pitch_mm}};
}

Shaped tapped(double d_mm, double pitch_mm, double drilled_mm, double lead_mm) {
  auto s = thread(d_mm, pitch_mm, Where::inside);
  s.blank = {drilled_mm, drilled_mm};
  s.cut.depth_mm = (d_mm - drilled_mm) / 2;
  s.cut.drilled_mm = drilled_mm;
  s.cut.lead_mm = lead_mm;
  return s;
}

}  // namespace turnwright::part
