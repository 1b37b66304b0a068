#include "contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/say.hpp"
#include "planning/values/readable.hpp"

namespace turnwright::nc {
namespace {

constexpr double kFar_mm = 1e4;
constexpr double kTouch_mm = 1e-5;  // larger than the tolerance of free_mm
constexpr int kFacets = 16;         // of a rounded edge

// The corners, before its end on the surface, of a polygon that touches a rounded edge of
// radius R from outside, in equal turns of d: R/cos(d/2) from the centre.
std::vector<Point> facets(const Point& edge, double R, double towards) {
  const double turn = std::numbers::pi / 2 / kFacets, far = R / std::cos(turn / 2);
  std::vector<Point> all{{edge.h_mm - R, edge.z_mm - towards * R}};
  for (int i = 0; i < kFacets; ++i) {
    const double a = turn * (i + 0.5);
    all.push_back(
        {edge.h_mm - R + far * std::sin(a), edge.z_mm - towards * far * std::cos(a)});
  }
  return all;
}

// A line that begins with a chamfer or a rounded edge.
std::vector<Point> chamfered(std::vector<Point> line, const part::Chamfer& chamfer) {
  const double towards = line.back().z_mm < line.front().z_mm ? -1 : 1;
  const double end = line.front().z_mm + towards * chamfer.axial_mm;
  while (line.size() > 2 && towards * (line[1].z_mm - end) <= 0) line.erase(line.begin());
  const auto &a = line[0], &b = line[1];
  const double u = (end - a.z_mm) / (b.z_mm - a.z_mm);
  const Point edge{a.h_mm + (b.h_mm - a.h_mm) * u, end};
  line[0] = edge;
  const auto before = chamfer.round
                          ? facets(edge, chamfer.axial_mm, towards)
                          : std::vector<Point>{{edge.h_mm - chamfer.radial_mm,
                                                end - towards * chamfer.axial_mm}};
  line.insert(line.begin(), before.begin(), before.end());
  return line;
}

std::vector<Point> with_front(std::vector<Point> line, const Surface& s) {
  return s.front ? chamfered(std::move(line), *s.front) : line;
}

std::vector<Point> with_back(std::vector<Point> line, const Surface& s) {
  if (!s.back) return line;
  line = chamfered({line.rbegin(), line.rend()}, *s.back);
  return {line.rbegin(), line.rend()};
}

// A line with the undercut that turning cuts at its end.
std::vector<Point> with_its_undercut(std::vector<Point> line, const Surface& s) {
  return s.undercut ? with_undercut(std::move(line), *s.undercut, s.z1) : line;
}

// An element of the nominal contour.
std::vector<Piece> pieces(const Site& site, const Side& side, const Surface& s) {
  const auto& cut = cut_of(site, s);
  if (cut && cut->kind == part::CutKind::arc) {
    const auto arc = drawn_arc(site, s);
    return {{arc.from, arc.to, arc}};
  }
  auto line = with_its_undercut(with_back(with_front(corrected(site, side, s), s), s), s);
  if (cut && cut->kind == part::CutKind::groove) {
    const double floor = side.sign * cut->core.left_mm / 2;
    line = {{floor, s.z0}, {floor, s.z1}};
  }
  std::vector<Piece> all;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    all.push_back({line[i], line[i + 1], {}});
  return all;
}

// Adds pieces, with the step up or down to them.
void append(std::vector<Piece>& all, const std::vector<Piece>& more) {
  if (!all.empty() && !more.empty())
    all.push_back({all.back().to, more.front().from, {}});
  all.insert(all.end(), more.begin(), more.end());
}

bool is_groove(const Site& site, const Surface& s) {
  const auto& cut = cut_of(site, s);
  return cut && cut->kind == part::CutKind::groove;
}

// A groove's blank is as low as the lower of the neighbours that are drawn as high, so
// that no fillet stays on them.
double blank_h(const Site& site, const Side& side, const Surface& s) {
  double h = s.h0;
  for (const auto& t : side.items) {
    const bool before = t.z1 == s.z0 && std::abs(t.h1 - s.h0) < kSame_mm;
    const bool behind = t.z0 == s.z1 && std::abs(t.h0 - s.h1) < kSame_mm;
    if (is_groove(site, t) || (!before && !behind)) continue;
    const auto line = corrected(site, side, t);
    h = std::min(h, before ? line.back().h_mm : line.front().h_mm);
  }
  return h;
}

}  // namespace

std::vector<Point> with_undercut(std::vector<Point> line, const part::Undercut& u,
                                 double z_mm) {
  const double depth = u.depth_mm, z = z_mm + u.width_mm;
  Point behind = line.back();
  for (; line.size() > 1 && line.back().z_mm <= z; line.pop_back()) behind = line.back();
  const auto& a = line.back();
  const double h =
      a.h_mm + (behind.h_mm - a.h_mm) * (z - a.z_mm) / (behind.z_mm - a.z_mm);
  line.push_back({h, z});
  line.push_back({h - depth, z - part::fall_mm(u)});
  line.push_back({h - depth, z_mm});
  return line;
}

const planning::Compensation::Table& correction(const Site& site,
                                                const std::string& surface) {
  static const planning::Compensation::Table none;
  for (const auto& c : site.plan.compensation)
    if (c.on == surface) return c.table_mm;
  return none;
}

std::vector<Point> corrected(const Site& site, const Side& side, const Surface& s) {
  if (is_groove(site, s)) {
    const double h = blank_h(site, side, s);
    return {{h, s.z0}, {h, s.z1}};
  }
  const double by = side.sign * moved_mm(site, s.id);
  std::vector<Point> all{{s.h0 + by, s.z0}, {s.h1 + by, s.z1}};
  const auto& table = correction(site, s.id);
  if (table.empty()) return all;
  all.clear();
  for (const auto& [part_z, dr] : table) {
    const double z = std::clamp(site.z(part_z), s.z1, s.z0);
    const double u = (s.z0 - z) / (s.z0 - s.z1);
    all.push_back({s.h0 + by + (s.h1 - s.h0) * u + side.sign * dr, z});
  }
  std::sort(all.begin(), all.end(),
            [](const Point& a, const Point& b) { return a.z_mm > b.z_mm; });
  return all;
}

std::vector<Point> finished_line(const Site& site, const Side& side, const Surface& s) {
  return with_front(with_its_undercut(corrected(site, side, s), s), s);
}

std::vector<Point> roughed_line(const Surface& s, double left_mm) {
  std::vector<Point> line{{s.h0 + left_mm, s.z0}, {s.h1 + left_mm, s.z1}};
  return s.front ? chamfered(std::move(line), part::roughed(*s.front)) : line;
}

std::size_t edge_of_front(const Surface& s) { return s.front->round ? kFacets + 1 : 1; }

std::optional<Arc> rounding(const Site& site, const Side& side, const Surface& s,
                            double re_mm) {
  if (!s.front || !s.front->round) return std::nullopt;
  const auto line = finished_line(site, side, s);
  const Point &from = line[0], &to = line[edge_of_front(s)];
  return tip_arc({from, to, {from.h_mm, to.z_mm}, true}, re_mm);
}

std::size_t around_edge(const std::vector<Point>& way, std::size_t i, const Arc& arc) {
  const auto from_centre = [&](const Point& p) {
    return std::hypot(p.h_mm - arc.centre.h_mm, p.z_mm - arc.centre.z_mm);
  };
  const double R = from_centre(arc.from);
  const double most = R / std::cos(std::numbers::pi / 4 / kFacets);
  const auto on = [&](const Point& p) {
    const double d = from_centre(p);
    return d > R - kTouch_mm && d < most + kTouch_mm &&
           p.h_mm > arc.from.h_mm - kTouch_mm && p.z_mm > arc.to.z_mm - kTouch_mm;
  };
  if (!on(way[i])) return i;
  while (i + 1 < way.size() && on(way[i + 1])) ++i;
  return i;
}

Point onto(const Arc& arc, const Point& p) {
  const auto n = arc_normal(arc, p);
  const double R =
      std::hypot(arc.from.h_mm - arc.centre.h_mm, arc.from.z_mm - arc.centre.z_mm);
  return {arc.centre.h_mm + R * n.h, arc.centre.z_mm + R * n.z};
}

const std::optional<part::Cut>& cut_of(const Site& site, const Surface& s) {
  const auto& d = site.part.drawing;
  return s.inner ? d.inner[s.index].cut : d.outer[s.index].cut;
}

Arc drawn_arc(const Site& site, const Surface& s) {
  const auto& cut = *cut_of(site, s);
  const bool mirrored = site.sign < 0;
  const double first = mirrored ? cut.drawn.left_mm : cut.drawn.right_mm;
  const double second = mirrored ? cut.drawn.right_mm : cut.drawn.left_mm;
  return arc_through({first / 2, s.z0}, {second / 2, s.z1}, cut.radius_mm, cut.convex);
}

std::size_t end_of_run(const Side& side, std::size_t k) {
  while (k + 1 < side.items.size() &&
         side.items[k + 1].z0 >= side.items[k].z1 - planning::kNoWall_mm)
    ++k;
  return k;
}

bool hole_goes_on(const Site& site, const Side& side, double z, double h) {
  const bool at_end = z + part::length_mm(site.part.drawing) < planning::kNoWall_mm;
  return side.sign < 0 && !at_end && side.stock_h > h;
}

Point moved_along(const Point& p, const Normal& of_line, double by_mm) {
  return {p.h_mm + of_line.z * by_mm, p.z_mm - of_line.h * by_mm};
}

Piece wall(double z_mm) { return {{kFar_mm, z_mm}, {-kFar_mm, z_mm}, {}}; }

std::vector<Piece> drawn_before(const Site& site, const Side& side, std::size_t k) {
  std::vector<Piece> all;
  for (std::size_t j = 0; j <= k; ++j) {
    auto more = pieces(site, side, side.items[j]);
    if (j == k) {  // only its beginning
      more.resize(1);
      more[0] = {more[0].from, more[0].from, {}};
    }
    append(all, more);
  }
  if (side.sign > 0)
    all.push_back({{0, side.items[0].z0}, {0, side.items[0].z0 + kFar_mm}, {}});
  return all;
}

std::vector<Piece> drawn_behind(const Site& site, const Side& side, std::size_t k) {
  const auto own = pieces(site, side, side.items[k]);
  std::vector<Piece> all{{own.back().to, own.back().to, {}}};
  const auto last = end_of_run(side, k);
  for (std::size_t j = k + 1; j <= last; ++j)
    append(all, pieces(site, side, side.items[j]));
  const double z = side.items[last].z1;
  if (hole_goes_on(site, side, z, all.back().to.h_mm))
    append(all, {{{side.stock_h, z}, {side.stock_h, z - kFar_mm}, {}}});
  return all;
}

void tell_jaws(Site& site, std::size_t k, const std::string& operation, double needed_z) {
  if (needed_z >= site.root_z - kTouch_mm) return;
  const auto& s = site.outer.items[k];
  const auto own = pieces(site, site.outer, s).back();
  const auto behind = drawn_behind(site, site.outer, k);
  // A level surface behind is turned later from the other end, and its pass comes up to
  // here.
  const auto level = [&](const Piece& piece) {
    return !piece.arc && std::abs(piece.from.h_mm - own.to.h_mm) < kStands_mm &&
           std::abs(piece.to.h_mm - own.to.h_mm) < kStands_mm;
  };
  if (level(own) && behind.size() > 2 && level(behind[1]) && level(behind[2]) &&
      site.outer.items[k + 1].stock)
    return;
  const double ends = std::round(1e6 * (s.z1 - site.root_z)) / 1e6;
  const auto [left, needed] = planning::readable_apart(std::abs(ends), s.z1 - needed_z);
  site.refuse(operation,
              say("{} ends {} mm before the jaws, its tool's corner needs {} mm: "
                  "grip less",
                  s.id, left, needed));
}

bool comes_in(const std::vector<Point>& way, const std::vector<Piece>& pieces,
              const Corner& corner) {
  constexpr double kTouching_mm = 2e-6, kHigh_mm = 1e3;
  std::vector<Point> raised{{way[0].h_mm + kHigh_mm, way[0].z_mm}};
  for (const auto& p : way) raised.push_back({p.h_mm + kTouching_mm, p.z_mm});
  const auto course = along(raised);
  return free_mm(course, pieces, corner) >= course.length_mm;
}

std::optional<Point> slope_onto(const Point& to, double above_mm,
                                const std::vector<Piece>& pieces, const Corner& corner) {
  const Point from{to.h_mm + above_mm, to.z_mm + above_mm};
  if (!comes_in({from, to}, pieces, corner)) return std::nullopt;
  return from;
}

}  // namespace turnwright::nc
