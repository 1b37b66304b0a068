#include "dxf_axis.hpp"

#include <iterator>
#include <map>
#include <set>

#include "base/say.hpp"
#include "dxf_file.hpp"
#include "dxf_graph.hpp"

namespace turnwright::exchange::dxf {
namespace {

constexpr double kSymmetric = 0.5;  // share of mirrored ends; a half section has fewer
constexpr std::size_t kMostCandidates = 8;

bool is_contour(const Stroke& s) { return s.role == Role::contour; }

// Extents of the contour along the axis and to its left.
struct Extents {
  double z0 = 1e300, z1 = -1e300, r0 = 1e300, r1 = -1e300;
  void add(const Place& p) {
    z0 = std::min(z0, p.x), z1 = std::max(z1, p.x);
    r0 = std::min(r0, p.y), r1 = std::max(r1, p.y);
  }
};

Extents extents(const Axis& axis, const std::vector<Stroke>& strokes) {
  Extents e;
  for (const Stroke& s : strokes) {
    if (!is_contour(s)) continue;
    e.add(axis.local(s.from));
    e.add(axis.local(s.to));
  }
  return e;
}

bool one_sided(const Extents& e, double join_mm) {
  return e.r0 >= -join_mm || e.r1 <= join_mm;
}

bool touches(const Extents& e, double join_mm) {
  return one_sided(e, join_mm) && std::min(std::abs(e.r0), std::abs(e.r1)) <= join_mm;
}

// Share of the ends of the contour whose mirror images are ends of it.
double symmetry(const Axis& axis, const std::vector<Stroke>& strokes, double join_mm) {
  std::set<std::pair<long long, long long>> cells;
  const auto cell = [join_mm](double x) { return std::llround(x / (4 * join_mm)); };
  std::vector<Place> ends;
  for (const Stroke& s : strokes)
    if (is_contour(s))
      for (const Place& p : {axis.local(s.from), axis.local(s.to)}) {
        ends.push_back(p);
        cells.emplace(cell(p.x), cell(p.y));
      }
  std::size_t mirrored = 0;
  for (const Place& p : ends) {
    bool found = false;
    for (long long i = -1; i <= 1; ++i)
      for (long long k = -1; k <= 1; ++k)
        found = found || cells.count({cell(p.x) + i, cell(-p.y) + k}) > 0;
    if (found) ++mirrored;
  }
  return static_cast<double>(mirrored) / static_cast<double>(ends.size());
}

Place to_the_right(Place u) {
  u = 1 / length(u) * u;
  constexpr double kUpright = 1e-12;
  if (std::abs(u.x) < kUpright) return {0, 1};
  if (std::abs(u.y) < kUpright) return {1, 0};
  return u.x > 0 ? u : -1 * u;
}

// Centre lines, the longest first.
std::vector<Axis> centre_lines(const std::vector<Stroke>& strokes) {
  std::vector<const Stroke*> lines;
  for (const Stroke& s : strokes)
    if (s.role == Role::centre && !s.centre) lines.push_back(&s);
  std::stable_sort(lines.begin(), lines.end(), [](const Stroke* a, const Stroke* b) {
    return length(a->to - a->from) > length(b->to - b->from);
  });
  std::vector<Axis> out;
  for (const Stroke* s : lines) {
    if (out.size() == kMostCandidates) break;
    const Axis axis{s->from, to_the_right(s->to - s->from)};
    out.push_back({axis.drawn({-dot(s->from, axis.u), 0}), axis.u});
  }
  return out;
}

// The centre line about which the contour lies: on one side of it, mirrored, or at least as
// far out on both sides, as in a half section of a bored part.
std::optional<Axis> of_centre_lines(const std::vector<Stroke>& strokes, double join_mm) {
  const auto lines = centre_lines(strokes);
  const auto first = [&](const auto& suits) -> std::optional<Axis> {
    for (const Axis& axis : lines) {
      const auto beside = along(axis, strokes);
      if (std::any_of(beside.begin(), beside.end(), is_contour) && suits(beside))
        return axis;
    }
    return std::nullopt;
  };
  if (const auto axis = first([&](const std::vector<Stroke>& beside) {
        return one_sided(extents({}, beside), join_mm) ||
               symmetry({}, beside, join_mm) >= kSymmetric;
      }))
    return axis;
  return first([&](const std::vector<Stroke>& beside) {
    const auto e = extents({}, beside);
    return std::abs(e.r0 + e.r1) <= join_mm;
  });
}

// The direction in which most of the contour runs, along it or across; x first.
std::vector<Place> directions(const std::vector<Stroke>& strokes) {
  constexpr double kStep_rad = 1e-6, kRight_rad = 1.5707963267948966;
  struct Bundle {
    double length = 0;
    Place u;
  };
  std::map<long long, Bundle> bundles;  // by the angle within a quarter of a turn
  for (const Stroke& s : strokes) {
    if (!is_contour(s) || s.centre) continue;
    const Place d = s.to - s.from;
    double a = std::fmod(std::atan2(d.y, d.x) + 2 * kRight_rad, kRight_rad);
    if (a > kRight_rad - kStep_rad / 2) a = 0;
    auto& b = bundles[std::llround(a / kStep_rad)];
    if (b.length == 0) b.u = to_the_right(d);
    b.length += length(d);
  }
  Bundle most;
  for (const auto& [angle, b] : bundles)
    if (b.length > most.length) most = b;
  if (!(most.length > 0)) return {{1, 0}, {0, 1}};
  const Place across = to_the_right({-most.u.y, most.u.x});
  if (std::abs(most.u.x) >= std::abs(across.x)) return {most.u, across};
  return {across, most.u};
}

// Whether lines of the contour lie on the axis all along the part.
bool closed_along(const Axis& axis, const Extents& e, const std::vector<Stroke>& strokes,
                  double join_mm) {
  double covered = 0;
  for (const Stroke& s : strokes) {
    if (!is_contour(s) || s.centre) continue;
    const Place a = axis.local(s.from), b = axis.local(s.to);
    if (std::abs(a.y) <= join_mm && std::abs(b.y) <= join_mm)
      covered += std::abs(b.x - a.x);
  }
  return covered >= e.z1 - e.z0 - join_mm;
}

// The ends at which nothing goes on.
std::vector<Place> open_ends(const std::vector<Stroke>& strokes, double join_mm) {
  std::vector<Stroke> contour;
  std::copy_if(strokes.begin(), strokes.end(), std::back_inserter(contour), is_contour);
  const Graph g = joined(contour, join_mm);
  std::vector<Place> out;
  for (Node n = 0; n < g.nodes.size(); ++n)
    if (g.at[n].size() == 1) out.push_back(g.nodes[n]);
  return out;
}

// The line on which all open ends lie, with the contour on one side of it.
std::optional<Axis> through_open_ends(const std::vector<Stroke>& strokes, double join_mm,
                                      std::vector<Remark>& assumed) {
  const auto ends = open_ends(strokes, join_mm);
  if (ends.size() < 2) return std::nullopt;
  const auto far =
      std::max_element(ends.begin(), ends.end(), [&](const Place& a, const Place& b) {
        return length(a - ends.front()) < length(b - ends.front());
      });
  if (!(length(*far - ends.front()) > join_mm)) return std::nullopt;
  const Axis axis{ends.front(), to_the_right(*far - ends.front())};
  for (const Place& p : ends)
    if (std::abs(axis.local(p).y) > join_mm) return std::nullopt;
  if (!one_sided(extents(axis, strokes), join_mm)) return std::nullopt;
  assumed.push_back(
      {"", tr("The drawing has no centre line; the axis is taken to join the "
              "open ends of its half profile.")});
  return axis;
}

// y = 0, or x = 0 if the contour does not end on y = 0 as well.
std::optional<Axis> at_origin(const std::vector<Stroke>& strokes, double join_mm,
                              bool whole, std::vector<Remark>& assumed) {
  const Axis level{{0, 0}, {1, 0}}, upright{{0, 0}, {0, 1}};
  const bool along_x = touches(extents(level, strokes), join_mm);
  const Axis& axis = along_x ? level : upright;
  const Extents e = extents(axis, strokes);
  if (!touches(e, join_mm) || (whole && !closed_along(axis, e, strokes, join_mm)))
    return std::nullopt;
  assumed.push_back(
      {"", say("The drawing has no centre line; the axis is taken to be {} = 0, on "
               "which the contour of its half profile lies.",
               along_x ? "y" : "x")});
  return axis;
}

// Whether a line of the contour goes from one side of the axis to the other.
bool crossed(const Axis& axis, const std::vector<Stroke>& strokes, double join_mm) {
  return std::any_of(strokes.begin(), strokes.end(), [&](const Stroke& s) {
    const auto [low, high] = std::minmax({axis.local(s.from).y, axis.local(s.to).y});
    return is_contour(s) && low < -join_mm && high > join_mm;
  });
}

// Of two axes of symmetry one that no line crosses lies in the bore of a ring; the other
// cuts its section.
std::optional<Axis> of_symmetry(const std::vector<Stroke>& strokes, double join_mm,
                                std::vector<Remark>& assumed) {
  std::optional<Axis> best;
  double most = kSymmetric;
  bool both = false;
  for (const Place& u : directions(strokes)) {
    Axis axis{{0, 0}, u};
    const Extents e = extents(axis, strokes);
    axis.origin = axis.drawn({0, (e.r0 + e.r1) / 2});
    const double share = symmetry(axis, strokes, join_mm);
    both = best && share == most;
    const bool apart =
        both && crossed(*best, strokes, join_mm) && !crossed(axis, strokes, join_mm);
    if (apart) both = false;
    if (share > most || apart || (!best && share == most)) {
      most = share;
      best = axis;
    }
  }
  if (best)
    assumed.push_back(
        {"", both ? tr("The drawing has no centre line and is symmetric both "
                       "ways; the axis is taken to run along x.")
                  : tr("The drawing has no centre line; the axis of its "
                       "symmetry is taken as that of the part.")});
  return best;
}

}  // namespace

Axis find_axis(const std::vector<Stroke>& strokes, double join_mm,
               std::vector<Remark>& assumed) {
  if (std::none_of(strokes.begin(), strokes.end(), is_contour))
    refuse("", tr("no lines of a contour"),
           tr("lines and arcs on a layer for the contour"));
  if (const auto axis = of_centre_lines(strokes, join_mm)) return *axis;
  if (const auto axis = through_open_ends(strokes, join_mm, assumed)) return *axis;
  if (const auto axis = at_origin(strokes, join_mm, true, assumed)) return *axis;
  if (const auto axis = of_symmetry(strokes, join_mm, assumed)) return *axis;
  if (const auto axis = at_origin(strokes, join_mm, false, assumed)) return *axis;
  refuse("", tr("no axis: no centre line, no symmetric contour, none that ends on y = 0"),
         tr("a centre line of line type CENTER or on a layer of that name"));
}

std::vector<Stroke> along(const Axis& axis, const std::vector<Stroke>& strokes) {
  constexpr double kOverrun = 0.05, kLeast_mm = 2;
  double z0 = 1e300, z1 = -1e300;  // of the centre line
  for (const Stroke& s : strokes) {
    if (s.role != Role::centre || s.centre) continue;
    const Place a = axis.local(s.from), b = axis.local(s.to);
    if (std::abs(a.y) > 1e-6 || std::abs(b.y) > 1e-6) continue;
    z0 = std::min({z0, a.x, b.x});
    z1 = std::max({z1, a.x, b.x});
  }
  const double margin = std::max(kLeast_mm, kOverrun * (z1 - z0));
  std::vector<Stroke> out;
  for (Stroke s : strokes) {
    if (s.role != Role::contour && s.role != Role::hidden) continue;
    s.from = axis.local(s.from);
    s.to = axis.local(s.to);
    if (s.centre) s.centre = axis.local(*s.centre);
    const auto [a, b] = std::minmax(s.from.x, s.to.x);
    const bool before = b<z0 - margin, behind = a> z1 + margin;
    const bool across = a < z0 - margin && b > z1 + margin;
    if (z0 < z1 && (before || behind || across)) continue;
    out.push_back(s);
  }
  return out;
}

std::vector<Stroke> mirrored(std::vector<Stroke> local) {
  for (Stroke& s : local) {
    s.from.y = -s.from.y;
    s.to.y = -s.to.y;
    if (s.centre) s.centre->y = -s.centre->y;
    s.counterclockwise = !s.counterclockwise;
  }
  return local;
}

namespace {

// The points of an arc on the axis, in the order of its direction.
std::vector<Place> crossings(const Stroke& s) {
  if (!s.centre) {
    const double t = s.from.y / (s.from.y - s.to.y);
    return {{s.from.x + t * (s.to.x - s.from.x), 0}};
  }
  const double R = length(s.from - *s.centre), h = R * R - s.centre->y * s.centre->y;
  if (!(h > 0)) return {};
  const double sign = s.counterclockwise ? 1 : -1, sweep = sweep_rad(s);
  const auto angle = [&](const Place& p) {  // from `from` on, in the arc's direction
    const Place u = s.from - *s.centre, v = p - *s.centre;
    const double a = sign * std::atan2(cross(u, v), dot(u, v));
    return a < 0 ? a + 2 * std::acos(-1.0) : a;
  };
  std::vector<Place> out;
  for (const double dz : {-std::sqrt(h), std::sqrt(h)})
    if (const Place p{s.centre->x + dz, 0}; angle(p) < sweep) out.push_back(p);
  std::sort(out.begin(), out.end(),
            [&](const Place& a, const Place& b) { return angle(a) < angle(b); });
  return out;
}

// A point of the stroke between its ends.
Place middle(const Stroke& s) {
  const Place m = 0.5 * (s.from + s.to);
  if (!s.centre) return m;
  const Place chord = s.to - s.from;
  const double R = length(s.from - *s.centre), l = length(chord);
  const double side = s.counterclockwise ? 1 : -1;
  const double rise = R - std::sqrt(std::max(0.0, R * R - l * l / 4));
  return m + side * rise / l * Place{chord.y, -chord.x};
}

}  // namespace

std::vector<Stroke> half(const std::vector<Stroke>& local, double join_mm) {
  std::vector<Stroke> out;
  const auto onto_axis = [join_mm](Place& p) {
    if (std::abs(p.y) <= join_mm) p.y = 0;
  };
  for (Stroke s : local) {
    onto_axis(s.from);
    onto_axis(s.to);
    std::vector<Place> cuts{s.from};
    if (s.centre || s.from.y * s.to.y < 0)
      for (const Place& p : crossings(s))
        if (length(p - s.from) > join_mm && length(p - s.to) > join_mm) cuts.push_back(p);
    cuts.push_back(s.to);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      Stroke piece = s;
      piece.from = cuts[i - 1];
      piece.to = cuts[i];
      const bool on_axis = !s.centre && piece.from.y == 0 && piece.to.y == 0;
      if (!on_axis && middle(piece).y > 0) out.push_back(piece);
    }
  }
  return out;
}

}  // namespace turnwright::exchange::dxf
