#include "tool_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace turnwright::document {

nlohmann::ordered_json estimated(nlohmann::ordered_json group, const char* source,
                                 double uncertainty_pct) {
  group["uncertainty_pct"] = uncertainty_pct;
  group["source"] = tr(source);
  return group;
}

double rounded(double x) { return std::round(x * 1e6) / 1e6; }

catalogue::Range usual_feed_mm_rev(double re_mm) { return {0.15 * re_mm, 0.6 * re_mm}; }

catalogue::Range usual_depth_mm(const catalogue::Insert1832& insert, double re_mm) {
  constexpr double kSharp_deg = 60;
  const double least_mm = std::max(0.1, 0.6 * re_mm);
  const double share = insert.included_angle_deg < kSharp_deg ? 1.0 / 8 : 1.0 / 4;
  return {least_mm, std::max(least_mm, share * insert.edge_length_mm)};
}

double usual_strength_N(double f_mm_rev, double ap_mm) {
  constexpr double kSteel_MPa = 2500;
  return kSteel_MPa * f_mm_rev * ap_mm;
}

double usual_rake_deg(const catalogue::Insert1832& insert) {
  const bool leaning = insert.clearance_deg == 0;
  const bool flat = std::string_view("AWNQ").find(insert.type) != std::string_view::npos;
  const double holder_deg = leaning ? -6 : 0, groove_deg = leaning ? 12 : 6;
  return flat ? holder_deg : holder_deg + groove_deg;
}

double usual_clearance_deg(const catalogue::Insert1832& insert) {
  return insert.clearance_deg == 0 ? 6 : insert.clearance_deg;
}

double usual_kapr_deg(char shape) {
  switch (shape) {
    case 'C':
    case 'W':
      return 95;
    case 'D':
    case 'V':
      return 93;
    case 'T':
      return 90;
    default:
      return 75;
  }
}

double usual_thickness_mm(double circle_mm, double clearance_deg) {
  if (circle_mm < 7) return 2.38;
  if (circle_mm < 11) return clearance_deg == 0 ? 4.76 : 3.97;
  if (circle_mm < 14) return 4.76;
  return circle_mm < 22 ? 6.35 : 7.94;
}

std::vector<std::string> usual_uses(const catalogue::Insert1832& insert, double kapr_deg,
                                    double re_mm) {
  constexpr double kStrong_deg = 55, kSharp_mm = 0.35, kRound_mm = 1.25;
  const bool strong = insert.included_angle_deg >= kStrong_deg;
  std::vector<std::string> uses;
  if (strong && re_mm >= kSharp_mm) uses.push_back("roughing");
  if (re_mm <= kRound_mm) uses.push_back("finishing");
  if (strong && kapr_deg >= 90) uses.push_back("facing");
  if (uses.empty()) uses.push_back("roughing");
  return uses;
}

}  // namespace turnwright::document
