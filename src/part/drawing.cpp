#include "turnwright/part/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::part {
namespace {

constexpr double kSame_mm = 1e-9;

// Of DIN 509: radius, depth, width, and depth in the shoulder, which form E leaves out.
constexpr std::array kUndercutsF{
    Undercut{0.2, 0.1, 1, 0.1},   Undercut{0.4, 0.2, 2, 0.1},
    Undercut{0.6, 0.2, 2, 0.1},   Undercut{0.6, 0.3, 2.5, 0.2},
    Undercut{0.8, 0.3, 2.5, 0.2}, Undercut{1, 0.2, 2.5, 0.1},
    Undercut{1, 0.4, 4, 0.3},     Undercut{1.2, 0.2, 2.5, 0.1},
    Undercut{1.2, 0.4, 4, 0.3},   Undercut{1.6, 0.3, 4, 0.2},
    Undercut{2.5, 0.4, 5, 0.3},   Undercut{4, 0.5, 7, 0.3}};
constexpr std::array kUndercutsG{Undercut{0.4, 0.2, 0.9, 0.2}};
constexpr std::array kUndercutsH{Undercut{0.8, 0.3, 2, 0.05},
                                 Undercut{1.2, 0.3, 2.43, 0.05}};

constexpr double kRight_rad = std::numbers::pi / 2;

// Of ISO 6411: pilot, and the largest diameter of the forms A and R, and of B (none of the
// smallest pilots); length of the pilot by ISO 866.
constexpr std::array<std::array<double, 4>, 14> kCentreHoles{{{0.5, 1.06, 0, 0.8},
                                                              {0.63, 1.32, 0, 0.9},
                                                              {0.8, 1.7, 0, 1.1},
                                                              {1, 2.12, 3.15, 1.3},
                                                              {1.25, 2.65, 4, 1.6},
                                                              {1.6, 3.35, 5, 2},
                                                              {2, 4.25, 6.3, 2.5},
                                                              {2.5, 5.3, 8, 3.1},
                                                              {3.15, 6.7, 10, 3.9},
                                                              {4, 8.5, 12.5, 5},
                                                              {5, 10.6, 16, 6.3},
                                                              {6.3, 13.2, 18, 8},
                                                              {8, 17, 22.4, 10.1},
                                                              {10, 21.2, 28, 12.8}}};

// Of DIN 76: pitch, d - dg, g2 of the forms A and B, radius.
constexpr std::array<std::array<double, 5>, 18> kThreadUndercuts{
    {{0.5, 0.8, 1.75, 1.25, 0.2},
     {0.6, 1, 2.1, 1.5, 0.4},
     {0.7, 1.1, 2.45, 1.75, 0.4},
     {0.75, 1.2, 2.6, 1.9, 0.4},
     {0.8, 1.3, 2.8, 2, 0.4},
     {1, 1.6, 3.5, 2.5, 0.6},
     {1.25, 2, 4.4, 3.2, 0.6},
     {1.5, 2.3, 5.2, 3.8, 0.8},
     {1.75, 2.6, 6.1, 4.3, 1},
     {2, 3, 7, 5, 1},
     {2.5, 3.6, 8.7, 6.3, 1.2},
     {3, 4.4, 10.5, 7.5, 1.6},
     {3.5, 5, 12, 9, 1.6},
     {4, 5.7, 14, 10, 2},
     {4.5, 6.4, 16, 11, 2},
     {5, 7, 17.5, 12.5, 2.5},
     {5.5, 7.7, 19, 14, 3.2},
     {6, 8.3, 21, 15, 3.2}}};

}  // namespace

std::optional<Undercut> undercut(char form, double radius_mm, double depth_mm) {
  std::span<const Undercut> table;
  if (form == 'E' || form == 'F') table = kUndercutsF;
  if (form == 'G') table = kUndercutsG;
  if (form == 'H') table = kUndercutsH;
  for (auto u : table) {
    if (form == 'E') u.recess_mm = 0;
    u.form = form;
    if (std::abs(u.radius_mm - radius_mm) < kSame_mm &&
        std::abs(u.depth_mm - depth_mm) < kSame_mm)
      return u;
  }
  return std::nullopt;
}

std::optional<Undercut> thread_undercut(char form, double pitch_mm) {
  if (form != 'A' && form != 'B') return std::nullopt;
  for (const auto& [pitch, reduced, long_width, short_width, radius] : kThreadUndercuts)
    if (std::abs(pitch - pitch_mm) < kSame_mm)
      return Undercut{radius, reduced / 2, form == 'A' ? long_width : short_width,
                      0,      pitch,       form};
  return std::nullopt;
}

std::optional<CentreHole> centre_hole(char form, double pilot_mm, double diameter_mm) {
  if (form != 'A' && form != 'B' && form != 'R') return std::nullopt;
  const double t30 = std::tan(units::rad_from_deg(30)), t60 = 3 * t30;
  for (const auto& [pilot, cone, chamfer, length] : kCentreHoles) {
    const double widest = form == 'B' ? chamfer : cone;
    if (pilot != pilot_mm || widest != diameter_mm || (form == 'R' && !(chamfer > 0)))
      continue;
    return CentreHole{form, pilot, widest,
                      (widest - cone) / 2 / t60 + (cone - pilot) / 2 / t30 + length};
  }
  return std::nullopt;
}

std::string designation(const CentreHole& hole) {
  return fmt::format("ISO 6411-{}{:g}/{:g}", hole.form, hole.pilot_mm, hole.diameter_mm);
}

bool leaves_part(const Drawing& d, std::size_t i) {
  const auto& e = d.inner[i];
  const double left = inner_left_z_mm(d, i), right = left + e.length_mm;
  return e.from == End::left ? std::abs(right - length_mm(d)) < kSame_mm
                             : std::abs(left) < kSame_mm;
}

double way_in_mm(const Drawing& d, std::size_t i) {
  double least = INFINITY;
  for (std::size_t k = 0; k < i; ++k)
    if (d.inner[k].from == d.inner[i].from)
      least = std::min({least, d.inner[k].left_mm, d.inner[k].right_mm});
  return least;
}

int flats(StockKind kind) {
  switch (kind) {
    case StockKind::hexagon:
      return 6;
    case StockKind::square:
      return 4;
    case StockKind::bar:
    case StockKind::tube:
    case StockKind::casting:
    case StockKind::forging:
      break;
  }
  return 0;
}

std::vector<StockLine> stock_lines(const Stock& s, double z0_mm, double z1_mm) {
  auto pieces = s.outline;
  if (pieces.empty()) pieces = {{s.length_mm, s.outer_mm, s.outer_mm}};
  std::vector<StockLine> lines;
  double z = -s.left_allowance_mm;
  for (const auto& piece : pieces) {
    const double a = std::max(z0_mm, z), b = std::min(z1_mm, z + piece.length_mm);
    const auto d_mm = [&](double at) {
      return piece.left_mm +
             (piece.right_mm - piece.left_mm) * (at - z) / piece.length_mm +
             s.outline_limits.upper_mm;
    };
    if (b > a) lines.push_back({a, d_mm(a), b, d_mm(b)});
    z += piece.length_mm;
  }
  return lines;
}

StockRange stock_between(const Stock& s, double z0_mm, double z1_mm) {
  if (s.outline.empty()) return {across_mm(s), s.outer_mm};
  const double end = s.length_mm - s.left_allowance_mm;
  const double from = std::min(std::max(z0_mm, -s.left_allowance_mm), end - kSame_mm),
               to = std::min(std::max(z1_mm, from + kSame_mm), end);
  StockRange range{INFINITY, 0};
  for (const auto& line : stock_lines(s, from, to)) {
    if (line.z1_mm - line.z0_mm < kSame_mm / 2) continue;
    range.least_mm = std::min({range.least_mm, line.left_mm, line.right_mm});
    range.most_mm = std::max({range.most_mm, line.left_mm, line.right_mm});
  }
  range.least_mm += s.outline_limits.lower_mm - s.outline_limits.upper_mm;
  return range;
}

std::vector<std::array<double, 2>> half_section(const Stock& s) {
  const double from = -s.left_allowance_mm, to = from + s.length_mm, in = s.inner_mm / 2;
  std::vector<std::array<double, 2>> corners;
  for (const auto& line : stock_lines(s, -INFINITY, INFINITY)) {
    corners.push_back({line.left_mm / 2, line.z0_mm});
    corners.push_back({line.right_mm / 2, line.z1_mm});
  }
  corners.push_back({in, to});
  corners.push_back({in, from});
  return corners;
}

StockRange stock_of(const Drawing& d, std::size_t i) {
  const auto& e = d.outer[i];
  const bool first = i == 0, last = i + 1 == d.outer.size();
  const double z0 = first ? -INFINITY : left_z_mm(d, i),
               z1 = last ? INFINITY : left_z_mm(d, i) + e.length_mm;
  const bool out_left = !first && d.outer[i - 1].right_mm <= e.left_mm + kSame_mm;
  const bool out_right = !last && d.outer[i + 1].left_mm <= e.right_mm + kSame_mm;
  return {stock_between(d.stock, z0, z1).least_mm,
          stock_between(d.stock, out_left ? z0 - kRunOut_mm : z0,
                        out_right ? z1 + kRunOut_mm : z1)
              .most_mm};
}

double across_mm(const Stock& s) {
  const int n = flats(s.kind);
  return n > 0 ? s.outer_mm * std::cos(std::numbers::pi / n) : s.outer_mm;
}

double section_mm2(const Stock& s) {
  const int n = flats(s.kind);
  const double across = across_mm(s);
  if (!s.outline.empty()) {
    double outside_mm3 = 0;
    for (const auto& p : s.outline)
      outside_mm3 +=
          std::numbers::pi / 12 * p.length_mm *
          (p.left_mm * p.left_mm + p.left_mm * p.right_mm + p.right_mm * p.right_mm);
    return outside_mm3 / s.length_mm - std::numbers::pi / 4 * s.inner_mm * s.inner_mm;
  }
  if (n > 0) return n * across * across / 4 * std::tan(std::numbers::pi / n);
  return std::numbers::pi / 4 * (s.outer_mm * s.outer_mm - s.inner_mm * s.inner_mm);
}

double held_mm(const Drawing& d, std::size_t setup, End hold) {
  const double end = d.stock.length_mm - d.stock.left_allowance_mm;
  const double z = hold == End::left ? -d.stock.left_allowance_mm : end;
  const double stock = stock_between(d.stock, z, z).least_mm;
  if (setup == 0) return stock;
  if (d.outer.empty()) return 0;
  return std::min(stock,
                  hold == End::left ? d.outer.front().left_mm : d.outer.back().right_mm);
}

double into_radius_mm(const Chamfer& c, double x) {
  if (!(x < c.axial_mm)) return 0;
  if (!c.round) return c.radial_mm * (1 - x / c.axial_mm);
  const double R = c.axial_mm, beside = R - std::max(x, 0.0);
  return R - std::sqrt(R * R - beside * beside);
}

Chamfer roughed(const Chamfer& c) {
  Chamfer straight = c;
  straight.round = false;
  if (c.round)
    straight.axial_mm = straight.radial_mm = c.axial_mm * (2 - std::numbers::sqrt2);
  return straight;
}

std::vector<InnerShoulder> inner_shoulders(const Drawing& d) {
  std::vector<InnerShoulder> all;
  const auto ends = inner_left_ends_mm(d);
  for (std::size_t a = 0; a < d.inner.size(); ++a)
    for (std::size_t b = 0; b < d.inner.size(); ++b) {
      const auto &left = d.inner[a], &right = d.inner[b];
      const double z = ends[b];
      if (a == b || std::abs(ends[a] + left.length_mm - z) > kSame_mm ||
          is_groove(left) || is_groove(right) ||
          std::abs(left.right_mm - right.left_mm) <= kSame_mm)
        continue;
      const std::size_t wider = left.right_mm > right.left_mm ? a : b;
      const std::size_t narrower = wider == a ? b : a;
      const auto &w = d.inner[wider].id, &n = d.inner[narrower].id;
      all.push_back({w + '|' + n, wider, narrower, z, n + '|' + w});
    }
  return all;
}

std::optional<InnerShoulder> inner_shoulder(const Drawing& d, const std::string& id) {
  for (auto& s : inner_shoulders(d))
    if (id == s.id || id == s.reversed) return std::move(s);
  return std::nullopt;
}

std::optional<InnerShoulder> shoulder_behind(const Drawing& d, std::size_t wider) {
  for (auto& s : inner_shoulders(d))
    if (s.wider == wider) return std::move(s);
  return std::nullopt;
}

bool has_tolerance(const Drawing& d, const std::string& face) {
  return std::ranges::any_of(d.tolerances, [&](const Tolerance& t) {
    return t.of == face || t.between[0] == face || t.between[1] == face;
  });
}

bool fits_countersink(const Chamfer& c, double point_deg) {
  if (c.round) return false;
  constexpr double kSame_deg = 1e-6;
  const double half_deg = units::deg_from_rad(std::atan2(c.radial_mm, c.axial_mm));
  return std::abs(half_deg - point_deg / 2) < kSame_deg;
}

std::string designation(const Undercut& u) {
  if (u.pitch_mm > 0) return fmt::format("DIN 76-{}", u.form);
  return fmt::format("{}{:g}x{:g}", u.form, u.radius_mm, u.depth_mm);
}

double falls_rad(const Undercut& u) {
  if (u.pitch_mm > 0) return units::rad_from_deg(30);
  return u.form == 'G' ? (kRight_rad - units::rad_from_deg(55)) / 2
                       : units::rad_from_deg(15);
}

double leans_rad(const Undercut& u) {
  if (!(u.recess_mm > 0)) return 0;
  return u.form == 'F' ? units::rad_from_deg(8) : falls_rad(u);
}

double fall_mm(const Undercut& u) { return u.depth_mm / std::tan(falls_rad(u)); }

double height_mm(const Undercut& u) {
  if (!(u.recess_mm > 0)) return u.radius_mm;
  const double lean = leans_rad(u);
  return u.radius_mm * (1 + std::sin(lean)) +
         (u.recess_mm - u.radius_mm * (1 - std::cos(lean))) / std::tan(lean);
}

double centre_mm(const Undercut& u) { return u.radius_mm - u.recess_mm; }

double undercut_mm(const OuterElement& e, double from_left_mm) {
  const auto at = [](const std::optional<Undercut>& u, double from_end_mm) {
    if (!u || from_end_mm >= u->width_mm) return 0.0;
    return std::min(u->depth_mm, (u->width_mm - from_end_mm) * std::tan(falls_rad(*u)));
  };
  return at(e.left_undercut, from_left_mm) +
         at(e.right_undercut, e.length_mm - from_left_mm);
}
double length_mm(const Drawing& drawing) {
  double sum = 0;
  for (const auto& element : drawing.outer) sum += element.length_mm;
  return sum;
}

double left_z_mm(const Drawing& drawing, std::size_t i) {
  if (!(i < drawing.outer.size()))
    throw std::domain_error("left_z_mm: element " + std::to_string(i) + " of " +
                            std::to_string(drawing.outer.size()));
  double sum = 0;
  for (std::size_t k = 0; k < i; ++k) sum += drawing.outer[k].length_mm;
  return sum;
}

double inner_left_z_mm(const Drawing& drawing, std::size_t i) {
  if (!(i < drawing.inner.size()))
    throw std::domain_error("inner_left_z_mm: element " + std::to_string(i) + " of " +
                            std::to_string(drawing.inner.size()));
  const End from = drawing.inner[i].from;
  double depth = 0;  // of its outer end
  for (std::size_t k = 0; k < i; ++k)
    if (drawing.inner[k].from == from) depth += drawing.inner[k].length_mm;
  if (from == End::left) return depth;
  return length_mm(drawing) - depth - drawing.inner[i].length_mm;
}

std::vector<double> left_ends_mm(const Drawing& d) {
  std::vector<double> ends;
  ends.reserve(d.outer.size());
  double z = 0;
  for (const auto& e : d.outer) {
    ends.push_back(z);
    z += e.length_mm;
  }
  return ends;
}

std::vector<double> inner_left_ends_mm(const Drawing& d) {
  std::vector<double> ends;
  ends.reserve(d.inner.size());
  const double L = length_mm(d);
  double from_left = 0, from_right = 0;  // depths of the outer ends
  for (const auto& e : d.inner) {
    double& depth = e.from == End::left ? from_left : from_right;
    ends.push_back(e.from == End::left ? depth : L - depth - e.length_mm);
    depth += e.length_mm;
  }
  return ends;
}

double largest_hole_mm(const Drawing& d, double z0_mm, double z1_mm) {
  double most = d.stock.inner_mm;
  const auto ends = inner_left_ends_mm(d);
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const double z0 = ends[i], z1 = z0 + d.inner[i].length_mm;
    if (z0 < z1_mm && z1 > z0_mm)
      most = std::max({most, d.inner[i].left_mm, d.inner[i].right_mm});
  }
  return most;
}

double least_hole_mm(const Drawing& d, double z0_mm, double z1_mm) {
  double least = INFINITY, hollow = 0;
  const auto ends = inner_left_ends_mm(d);
  for (std::size_t i = 0; i < d.inner.size(); ++i) {
    const double z0 = ends[i], z1 = z0 + d.inner[i].length_mm;
    if (!(z0 < z1_mm && z1 > z0_mm)) continue;
    least = std::min({least, d.inner[i].left_mm, d.inner[i].right_mm});
    hollow += std::min(z1, z1_mm) - std::max(z0, z0_mm);
  }
  constexpr double kSlack_mm = 1e-9;
  return hollow < z1_mm - z0_mm - kSlack_mm ? std::min(least, d.stock.inner_mm) : least;
}

bool has_cut(const Drawing& d, const std::string& id) {
  const auto cut = [&](const auto& e) { return e.id == id && e.cut; };
  return std::any_of(d.outer.begin(), d.outer.end(), cut) ||
         std::any_of(d.inner.begin(), d.inner.end(), cut);
}

std::optional<Extent> extent(const Drawing& d, const std::string& id) {
  const auto of = [](const auto& e, double z, bool inner) {
    return Extent{z, z + e.length_mm, e.left_mm, e.right_mm, inner};
  };
  for (std::size_t i = 0; i < d.outer.size(); ++i)
    if (d.outer[i].id == id) return of(d.outer[i], left_z_mm(d, i), false);
  for (std::size_t i = 0; i < d.inner.size(); ++i)
    if (d.inner[i].id == id) return of(d.inner[i], inner_left_z_mm(d, i), true);
  return std::nullopt;
}

std::optional<double> half_angle_rad(const Drawing& d, const std::string& id) {
  const auto at = extent(d, id);
  if (!at) return {};
  return std::atan2(std::abs(at->right_mm - at->left_mm) / 2, at->z1_mm - at->z0_mm);
}

std::string datum_words(const Tolerance& t) {
  return t.common_datum.empty() ? t.datum : t.datum + "-" + t.common_datum;
}

double width_mm(const Tolerance& t) {
  return t.limits ? t.limits->upper_mm - t.limits->lower_mm : t.value_mm;
}

void widen(Tolerance& t, double times) {
  t.value_mm *= times;
  if (!t.limits) return;
  const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
  const double half = (t.limits->upper_mm - t.limits->lower_mm) / 2 * times;
  t.limits = Limits{middle - half, middle + half};
}

double right_allowance_mm(const Drawing& drawing) {
  return drawing.stock.length_mm - drawing.stock.left_allowance_mm - length_mm(drawing);
}

}  // namespace turnwright::part
