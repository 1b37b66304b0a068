#include "turning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "contour.hpp"
#include "planning/paths/edges.hpp"
#include "planning/paths/pass_lengths.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::nc {
namespace {

using planning::OperationKind;
using planning::OperationPlan;
using Kind = Move::Kind;

double depth_mm(const OperationPlan& o) {
  double sum = 0;
  for (const auto& pass : o.passes) sum += pass.ap_mm;
  return sum;
}

bool is_on(const OperationPlan& o, const std::string& surface) {
  return std::find(o.on.begin(), o.on.end(), surface) != o.on.end();
}

bool is_bore(OperationKind kind) {
  return kind == OperationKind::bore_rough || kind == OperationKind::bore_finish;
}

bool finishes(const OperationPlan& o) {
  return o.kind == OperationKind::finish || o.kind == OperationKind::bore_finish;
}

const catalogue::Tool& tool_of(const Site& site, const OperationPlan& o) {
  return *std::find_if(site.part.tools.begin(), site.part.tools.end(),
                       [&](const auto& t) { return t.id == o.tool; });
}

double minor_edge_rad(const Site& site, const OperationPlan& o) {
  return units::rad_from_deg(tool_of(site, o).minor_kapr_deg);
}

std::size_t place(const Side& side, const std::string& id) {
  return static_cast<std::size_t>(
      std::find_if(side.items.begin(), side.items.end(),
                   [&](const Surface& s) { return s.id == id; }) -
      side.items.begin());
}

bool is_arc(const Site& site, const Surface& s) {
  const auto& cut = cut_of(site, s);
  return cut && cut->kind == part::CutKind::arc;
}

// The surface that rises behind element k as a step, and the element at whose end it
// stands: level or lower elements may lie between.
struct Wall {
  double z_mm = 0, top_mm = 0;
  std::size_t before = 0;
  bool steps = true;    // else the beginning of a cone or an arc
  bool of_arc = false;  // the blank of an arc, which is cut later
};
std::optional<Wall> wall_behind(const Site& site, const Side& side, std::size_t k) {
  const double h = side.items[k].h1 + kSame_mm;
  const auto last = end_of_run(side, k);
  for (std::size_t j = k; j < last; ++j) {
    const auto& next = side.items[j + 1];
    if (std::max(next.h0, next.h1) > h)
      return Wall{next.z0, side.top0(next), j, next.h0 > h, is_arc(site, next)};
  }
  const double z = side.items[last].z1;
  if (!hole_goes_on(site, side, z, h)) return std::nullopt;
  return Wall{z, side.stock_h, last};
}

// Thickness that turning leaves before a shoulder that is faced later.
double shoulder_stock_mm(const Site& site, std::size_t operation, const Side& side,
                         std::size_t k) {
  if (k + 1 >= side.items.size()) return 0;
  const auto &a = side.items[k].id, &b = side.items[k + 1].id;
  return std::max(later_mm(site, operation, a + "|" + b),
                  later_mm(site, operation, b + "|" + a));
}

// Ends a path where the corner touches a piece; returns whether it does.
bool clip(std::vector<Point>& way, std::span<const Piece> pieces, const Corner& corner) {
  const auto course = along(way);
  const double free = free_mm(course, pieces, corner);
  if (!(free < course.length_mm)) return false;
  double length = course.length_mm;
  while (way.size() > 1 && length > free) {
    length -= along({way[way.size() - 2], way.back()}).length_mm;
    way.pop_back();
  }
  if (free > 0)
    way.push_back(course.at(free));
  else
    way.clear();
  return true;
}

constexpr Normal kWall{0, 1};  // of a wall that rises towards the chuck

// Points on the straight line through two others.
Point at_z(const Point& a, const Point& b, double z) {
  return {a.h_mm + (b.h_mm - a.h_mm) * (z - a.z_mm) / (b.z_mm - a.z_mm), z};
}
Point at_h(const Point& a, const Point& b, double h) {
  return {h, a.z_mm + (b.z_mm - a.z_mm) * (h - a.h_mm) / (b.h_mm - a.h_mm)};
}

// Element k, if it has a chamfer at its front that this setup cuts without making the
// element.
const Surface* edge_to_cut(const Site& site, const Side& side, std::size_t k) {
  if (k >= side.items.size() || !side.items[k].front) return nullptr;
  const auto& s = side.items[k];
  const bool made =
      planning::makes(site.part.work.setups[site.setup], {s.inner, s.index});
  return made ? nullptr : &s;
}

// One pass over an element.
struct Pass {
  Site& site;
  Side& side;
  std::size_t operation, k;  // k: the element's place in the tool's order
  double ap_mm, left_mm, re_mm;
  bool last;                           // makes the drawn contour
  std::optional<double> stock_z = {};  // where it reaches stock, if not at its front

  Surface& surface() const { return side.items[k]; }
  bool from_before() const {
    return last && operation > 0 && joined(site, operation - 1);
  }
  bool goes_on() const { return last && joined(site, operation); }
  const OperationPlan& plan() const { return site.answer().operations[operation]; }
  Corner tool() const { return {re_mm, minor_edge_rad(site, plan())}; }
};

std::vector<Point> contour(const Pass& p) {
  auto line = p.last ? finished_line(p.site, p.side, p.surface())
                     : roughed_line(p.surface(), p.left_mm);
  // Roughing begins above what stands on the element in front.
  if (p.last || !p.surface().front || p.k == 0) return line;
  const double floor = p.side.top1(p.side.items[p.k - 1]);
  if (floor >= line[1].h_mm)
    line.erase(line.begin());
  else if (floor > line[0].h_mm)
    line[0] = at_h(line[0], line[1], floor);
  return line;
}

// Tips at the foot and at the top of a wall between two lines, b above a; on a wall that is
// lower than the corner needs those at which the corner crosses from one to the other.
std::vector<Point> up_wall(const Point& a, const Normal& m, const Point& b,
                           const Normal& n, double r) {
  const auto foot = tip(a, m, kWall, r), top = tip(b, kWall, n, r);
  if (top.h_mm >= foot.h_mm) return {foot, top};
  const auto over = across(a, m, b, n, r);
  return {over.leave, over.meet};
}

// Tips at which a pass leaves element k and meets the next one: up the wall between them,
// or over the small step between two sizes that are drawn as one.  Down such a step the
// tool follows its minor edge, which touches the edge of the higher surface.
std::vector<Point> crossing(const Pass& p, std::size_t k) {
  const auto &s = p.side.items[k], &t = p.side.items[k + 1];
  const auto from = finished_line(p.site, p.side, s),
             to = finished_line(p.site, p.side, t);
  const auto m = normal(from[from.size() - 2], from.back()), n = normal(to[0], to[1]);
  const double r = p.re_mm;
  const double rises_mm = to[0].h_mm - from.back().h_mm;
  if (rises_mm > r || (t.h0 > s.h1 + kSame_mm && (rises_mm > 0 || t.front)))
    return up_wall(from.back(), m, to[0], n, r);
  const double falls = from.back().h_mm - to[0].h_mm, rises_rad = *p.tool().rises_rad;
  const double arc = r * (1 - std::cos(rises_rad));
  if (falls > arc) {
    // Down a line through the edge until the corner stands on what follows.
    const Normal down{std::cos(rises_rad), -std::sin(rises_rad)};
    const auto edge = tip(from.back(), down, r), foot = tip(to[0], n, r);
    const double above = (edge.h_mm - foot.h_mm) * n.h + (edge.z_mm - foot.z_mm) * n.z;
    const double steeper = n.z * down.h - n.h * down.z;  // sine of the angle between both
    if (above > 0 && steeper > 0)
      return {
          m.z == 0 ? Point{from.back().h_mm, edge.z_mm} : tip(from.back(), m, down, r),
          moved_along(edge, down, above / steeper)};
  }
  const auto over = across(from.back(), m, to[0], n, r);
  return {over.leave, over.meet};
}

// Distance at which the minor edge keeps the corner from a step down of the corrections.
double lost_mm(const Pass& p) {
  if (p.k == 0) return 0;
  const auto &s = p.side.items[p.k - 1], &t = p.surface();
  const double step = corrected(p.site, p.side, s).back().h_mm - s.h1 -
                      (corrected(p.site, p.side, t).front().h_mm - t.h0);
  return std::max(step, 0.0) / std::tan(*p.tool().rises_rad);
}

// Whether the element in front is finished, and ends where and as high as this one begins.
bool begins_on_finished(const Pass& p) {
  if (p.k == 0) return false;
  const auto &s = p.side.items[p.k - 1], &t = p.surface();
  return s.finished && std::abs(s.z1 - t.z0) < kSame_mm &&
         std::abs(s.h1 - t.h0) < kStands_mm;
}

// A way to an edge that would begin on the surface in front begins between it and the stock
// that is left before the shoulder.
void begin_beside(const Pass& p, std::vector<Point>& way) {
  if (p.k == 0 || !p.surface().front || way.size() < 2) return;
  const double stock_z =
      p.surface().z0 + shoulder_stock_mm(p.site, p.operation, p.side, p.k - 1);
  const double z = (way[0].z_mm + stock_z) / 2;
  if (way[0].z_mm > stock_z + kStands_mm && z > way[1].z_mm)
    way[0] = at_z(way[0], way[1], z);
}

// A finishing pass comes in along the element's own line, from as far away as the
// surfaces in front allow; onto the end of a finished surface, down a slope of 45 deg; to a
// rounded edge, up one.  A roughing pass comes in along the axis.
void lead_in(const Pass& p, const std::vector<Point>& c, std::vector<Point>& way) {
  const auto n = normal(c[0], c[1]);
  const double far = kBefore_mm + p.re_mm;
  if (!p.last) {
    way.front() = tip(c[0], {1, 0}, n, p.re_mm);
    if (n.z != 0)
      way.insert(way.begin(), {way.front().h_mm, p.surface().z0 + kBefore_mm});
    else
      way.front().z_mm += far;
    return;
  }
  const double own = along(way).length_mm;
  if (p.surface().front && p.surface().front->round) {
    const double from = planning::before_rounding_mm(far);
    way.insert(way.begin(), {way.front().h_mm - from, way.front().z_mm + from});
  } else {
    way.front() = {way.front().h_mm - n.z * far, way.front().z_mm + n.h * far};
  }
  const auto pieces = drawn_before(p.site, p.side, p.k);
  way = {way.rbegin(), way.rend()};
  const double lets = free_mm(along(way), pieces, {p.re_mm});
  const bool stopped = clip(way, pieces, p.tool());
  if (along(way).length_mm < std::min(lets, own) - kStands_mm - lost_mm(p))
    p.site.refuse(p.plan().id,
                  say("the minor edge of {} does not clear what is before {}",
                      p.plan().tool, p.surface().id));
  way = {way.rbegin(), way.rend()};
  if (way.empty() || !(stopped || begins_on_finished(p))) return;
  if (!stopped)
    way.front() = tip(c[0], n, p.re_mm);
  else
    begin_beside(p, way);
  if (const auto from = slope_onto(way.front(), p.site.above(p.side), pieces, p.tool()))
    way.insert(way.begin(), *from);
}

// Starts a pass clear of the material before the free end and of the stock left on
// elements in front, which the pass then removes; elements whose blank is higher than the
// pass are not affected.  On a long element that has been roughed the pass comes down
// through the stock on a slope that the minor edge clears.  Returns the number of moves
// over elements in front.
std::size_t start_clear(const Pass& p, std::vector<Point>& way) {
  const auto [h, z] = way.front();
  const auto blank = [](const Surface& s) { return std::max(s.h0, s.h1); };
  double from = z;
  bool first = p.k == 0;
  for (std::size_t j = p.k; j-- > 0;) {
    auto& s = p.side.items[j];
    if (blank(s) > h + kStands_mm) break;
    const double top = p.side.top(s);
    if (!(top > h + kStands_mm)) continue;
    const double slope_z = from + (top - h) / std::tan(*p.tool().rises_rad);
    if (!s.stock && slope_z < s.z0 + kBefore_mm) {
      if (from > z) way.insert(way.begin(), {h, from});
      way.insert(way.begin(), {top, slope_z});
      return from > z ? 2 : 1;
    }
    from = std::max(from, s.z0 + kBefore_mm);
    first = first || j == 0;
    s.stock = false;
    s.left = h - blank(s);
  }
  const std::size_t entered = from > z ? 1 : 0;
  if (first && from < p.site.front + kBefore_mm && p.site.front > 0)
    from = p.site.front + kBefore_mm;
  if (from > z) way.insert(way.begin(), {h, from});
  return entered;
}

// Thickness that a pass leaves on the wall behind element k: that of a shoulder which is
// faced, or the least depth of the tool that finishes the element before the wall.
double wall_stock_mm(const Pass& p, const Wall& w) {
  const double faced = shoulder_stock_mm(p.site, p.operation, p.side, w.before);
  if (faced > 0 || p.last || !w.steps) return faced;
  const auto& all = p.site.answer().operations;
  for (std::size_t i = p.operation; i < all.size(); ++i)
    if (finishes(all[i]) && is_on(all[i], p.side.items[w.before].id))
      return catalogue::least_depth_mm(tool_of(p.site, all[i]));
  return 0;
}

// Height above which roughing keeps off the programmed surface of an element, at one of its
// ends: where that is still to be finished, so that no mark of a rougher tool stays on it.
double kept_h(const Site& site, const Side& side, const Surface& s, double drawn_h) {
  constexpr double kMarks_mm = 0.05;
  return drawn_h + middle_h(site.part.drawing, side, s) + (s.finished ? 0 : kMarks_mm);
}

// Whether an element is drawn as high as the one in front of it, where they meet.
bool drawn_level(const Surface& front, const Surface& behind) {
  return std::abs(front.h1 - behind.h0) < kSame_mm &&
         std::abs(front.z1 - behind.z0) < kSame_mm;
}

// Whether the next element, drawn as high, stands above a roughing pass because of its
// limits.
bool steps_up_behind(const Pass& p) {
  if (p.k + 1 >= p.side.items.size()) return false;
  const auto &s = p.surface(), &next = p.side.items[p.k + 1];
  return drawn_level(s, next) && kept_h(p.site, p.side, next, next.h0) > s.h1 + p.left_mm;
}

// The pieces that end a pass over element k.
std::vector<Piece> ends(const Pass& p, std::size_t k, const std::optional<Wall>& w) {
  std::vector<Piece> all;
  if (p.last)
    all = drawn_behind(p.site, p.side, k);
  else if (steps_up_behind(p))
    all.push_back(wall(p.surface().z1));
  if (!w) return all;
  const double stock = wall_stock_mm(p, *w);
  const auto& s = p.surface();
  if (const auto& u = p.last || !s.undercut ? s.faced_undercut : s.undercut) {
    const double r = u->radius_mm;
    const double h = corrected(p.site, p.side, s).back().h_mm - u->depth_mm;
    const Arc radius{{h, s.z1 + r}, {h + r, s.z1}, {h + r, s.z1 + r}, false};
    all.push_back({radius.from, radius.to, radius});
  }
  if (!p.last || stock > 0) all.push_back(wall(w->z_mm + stock));
  return all;
}

bool cut_later(const Site& site, const Surface& s) {
  const auto& cut = cut_of(site, s);
  return cut && part::replaces_blank(cut->kind);
}

// Whether the next element is as high, so that no fillet can stand behind an edge.
bool level_behind(const Pass& p) {
  if (p.k + 1 >= p.side.items.size()) return false;
  const auto &s = p.surface(), &next = p.side.items[p.k + 1];
  return s.h0 == s.h1 && !cut_later(p.site, next) &&
         std::abs(next.h0 - s.h1) < kStands_mm && std::abs(next.h1 - s.h1) < kStands_mm;
}

// Ends a pass up a cone once it is out of the stock.
void leave_stock(const Pass& p, std::vector<Point>& way) {
  const auto& s = p.surface();
  const double out = p.side.stock_h + kAbove_mm;
  auto& last = way.back();
  if (p.side.sign < 0 || !(s.h1 > s.h0) || !(last.h_mm > out)) return;
  const auto end = at_h(way[way.size() - 2], last, out);
  if (end.z_mm > last.z_mm) last = end;
}

// Goes up a wall and along the chamfer of the element behind it, which another setup
// makes; through stock on that element the tool is then drawn out.
void over_edge(const Pass& p, const Surface& s, std::vector<Point>& way) {
  const auto line = finished_line(p.site, p.side, s);
  const auto edge = edge_of_front(s);
  const auto front =
      tips({line.begin(), line.begin() + static_cast<std::ptrdiff_t>(edge) + 1}, p.re_mm);
  const auto n = normal(line[edge - 1], line[edge]);
  const auto own = finished_line(p.site, p.side, p.surface());
  const auto m = normal(own[own.size() - 2], own.back());
  const auto over = up_wall(own.back(), m, line[0], normal(line[0], line[1]), p.re_mm);
  if (p.surface().z1 == s.z0) way.back() = over[0];
  way.push_back(over[1]);
  way.insert(way.end(), front.begin() + 1, front.end() - 1);
  const double beyond = planning::beyond_edge_mm(*s.front, s.stock, p.re_mm);
  if (s.stock) {
    way.push_back(tip(moved_along(line[edge], n, beyond), n, kWall, p.re_mm));
    way.push_back({p.side.top0(s), way.back().z_mm});
  } else {
    way.push_back(moved_along(front.back(), n, beyond));
  }
}

// Draws the tool out along a wall that has ended its pass: a roughing pass as far as it
// was deep, which takes off the wedge that the lead angle leaves, and so does the last pass
// in a bore before a shoulder that is faced, because it may be deep; the pass that makes the
// wall to its top.
void draw_out(const Pass& p, const Wall& w, std::vector<Point>& way) {
  const double stock = wall_stock_mm(p, w);
  const bool makes = p.last && !(stock > 0);
  if (!w.steps || (p.last && ((stock > 0 && p.side.sign > 0) || w.of_arc))) return;
  const auto end = way.back();
  const double top = makes ? w.top_mm : std::min(w.top_mm, end.h_mm + p.ap_mm);
  if (!(end.z_mm < w.z_mm + stock + kStands_mm)) return;
  if (const auto* edge = makes ? edge_to_cut(p.site, p.side, w.before + 1) : nullptr)
    over_edge(p, *edge, way);
  else if (top > end.h_mm + kStands_mm)
    way.push_back({top, end.z_mm});
}

// Ends a pass where the corner touches a surface, or where it has removed the fillet that
// another corner may have left behind a falling edge.
void lead_out(const Pass& p, std::vector<Point>& way) {
  if (p.goes_on()) return;
  auto& last = way.back();
  const double falls = p.last && level_behind(p) ? 0 : p.site.r_most + p.re_mm;
  last = at_z(way[way.size() - 2], last, last.z_mm - falls - kBehind_mm);
  leave_stock(p, way);
  const auto w = wall_behind(p.site, p.side, p.k);
  const bool stopped = clip(way, ends(p, p.k, w), {p.re_mm});
  if (way.size() < 2) return;
  if (p.side.sign > 0) {
    if (p.last && !cut_later(p.site, p.surface()))
      tell_jaws(p.site, p.k, p.plan().id,
                std::max(way.back().z_mm, p.surface().z1 - p.re_mm));
    if (clip(way, {{wall(p.site.root_z)}}, {p.re_mm})) return;
  }
  if (stopped && w && way.size() > 1) draw_out(p, *w, way);
}

// Begins a pass over a cylinder of a casting or forging where it reaches stock.
void begin_at_stock(const Pass& p, std::vector<Point>& way) {
  const double h = p.surface().h1 + p.left_mm;
  const auto level = [&](const Point& q) { return std::abs(q.h_mm - h) < kStands_mm; };
  auto next = std::ranges::find_if(
      way, [&](const Point& q) { return level(q) && q.z_mm < *p.stock_z + kBefore_mm; });
  if (next == way.end()) next = std::find_if(way.rbegin(), way.rend(), level).base() - 1;
  way.erase(way.begin(), next);
  way.insert(way.begin(), {h, std::max(*p.stock_z, way.front().z_mm) + kBefore_mm});
}

struct Way {
  std::vector<Point> points;
  std::size_t entered = 0;  // moves over elements in front
};
Way way_of(const Pass& p) {
  std::size_t entered = 0;
  auto way = tips(contour(p), p.re_mm);
  if (p.from_before()) {
    way.front() = crossing(p, p.k - 1).back();
    while (way.size() > 2 && way[1].z_mm >= way[0].z_mm) way.erase(way.begin() + 1);
  } else {
    lead_in(p, contour(p), way);
    if (way.size() < 2) return {};
    if (!p.stock_z) entered = start_clear(p, way);
  }
  if (p.goes_on()) {
    const auto over = crossing(p, p.k);
    way.back() = over.front();
    while (way.size() > 2 && way[way.size() - 2].z_mm <= way.back().z_mm)
      way.erase(way.end() - 2);
    way.push_back(over.back());
  }
  lead_out(p, way);
  if (p.stock_z) begin_at_stock(p, way);
  return {way, entered};
}

// Along the floor of an undercut, which a large corner may reach beyond the shoulder at z,
// up its radius, which may be larger than the corner's, and where it goes into the
// shoulder, back to that.
void up_undercut(const Pass& p, const part::Undercut& u, double z) {
  const auto way = planning::undercut_way(u, p.re_mm);
  const auto line = tips(finished_line(p.site, p.side, p.surface()), p.re_mm);
  const auto& floor = line[line.size() - 2];
  const double h = floor.h_mm;
  if (floor.z_mm < z) p.site.to(Kind::feed, p.side, floor);
  p.site.to(Kind::feed, p.side, {h, z + way.centre_z});
  if (way.radius_mm > kSame_mm)
    p.site.arc(p.side, {h + way.arc_h, z + way.arc_z},
               {h + way.centre_h, z + way.centre_z}, false, true);
  if (way.lean_rad > 0) p.site.to(Kind::feed, p.side, {h + way.foot_h, z});
}

// The rounded edges that the last pass over an element goes around: at its own front, and
// behind the wall, of an element that another setup makes.
std::vector<Arc> roundings(const Pass& p) {
  std::vector<Arc> all;
  if (!p.last) return all;
  const auto add = [&](const Surface& s) {
    if (const auto arc = rounding(p.site, p.side, s, p.re_mm)) all.push_back(*arc);
  };
  add(p.surface());
  const auto w = wall_behind(p.site, p.side, p.k);
  if (const auto* edge = w ? edge_to_cut(p.site, p.side, w->before + 1) : nullptr)
    add(*edge);
  return all;
}

// Puts the ends of each stretch of a way that goes around a rounded edge onto its arc.
void meet(std::vector<Point>& way, const std::vector<Arc>& arcs) {
  for (const auto& arc : arcs)
    for (std::size_t i = 0; i < way.size(); ++i) {
      const auto end = around_edge(way, i, arc);
      if (end == i) continue;
      way[i] = onto(arc, way[i]);
      way[end] = onto(arc, way[end]);
      i = end;
    }
}

// Follows a way from its first point on, around the rounded edges in arcs; `go` moves to a
// point of it.
template <class Go>
void follow(Site& site, Side& side, const std::vector<Point>& way,
            const std::vector<Arc>& arcs, bool inwards, const Go& go) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const auto around = std::ranges::find_if(
        arcs, [&](const Arc& a) { return around_edge(way, i - 1, a) >= i; });
    if (around == arcs.end()) {
      go(i);
      continue;
    }
    i = around_edge(way, i - 1, *around);
    site.arc(side, way[i], around->centre, true, inwards);
  }
}

// Goes at feed to one of the points of a path, which may be where an undercut ends at a
// wall: the first one on it.
void to_point(const Pass& p, const std::vector<Point>& way, std::size_t i) {
  const auto& undercut = p.surface().undercut;
  const auto level = [](const Point& a, const Point& b) {
    return std::abs(a.z_mm - b.z_mm) < kSame_mm;
  };
  const bool foot = p.last && undercut && i + 1 < way.size() &&
                    std::abs(way[i].z_mm - p.surface().z1) < kStands_mm &&
                    level(way[i], way[i + 1]) && !level(way[i - 1], way[i]);
  foot ? up_undercut(p, *undercut, way[i].z_mm) : p.site.to(Kind::feed, p.side, way[i]);
}

void pass(const Pass& p) {
  auto& s = p.surface();
  if (p.side.sign < 0 && !p.from_before()) p.site.clear_bore();  // as the bores stand yet
  auto way = way_of(p);
  const auto arcs = roundings(p);
  meet(way.points, arcs);
  if (way.points.size() > 1) {
    if (p.stock_z)
      p.site.approach_level(p.side, way.points[0]);
    else if (!p.from_before())
      p.site.approach(p.side, way.points[0], way.points[1], p.re_mm);
    follow(p.site, p.side, way.points, arcs, true, [&](std::size_t i) {
      to_point(p, way.points, i);
      p.site.moves.back().entering = i <= way.entered;
    });
  }
  if (!p.goes_on()) p.site.lift(p.side);
  s.stock = false;
  s.left = p.left_mm;
  s.finished = p.last;
}

// A facing pass over contact points, which are ordered from the axis outwards; the tool
// comes from outside.  Its corner continues a radius beyond the first point, independent
// of the slope there, or as far as the surfaces `before` the face allow.  It comes down at
// feed onto a rounded edge that it begins with.
void face_pass(Site& site, Side& side, const std::vector<Point>& contact, double re,
               const std::vector<Piece>& before, const std::vector<Arc>& arcs = {}) {
  auto way = tips(contact, re);
  way.front() = at_h(way[0], way[1], contact.front().h_mm - re);
  std::reverse(way.begin(), way.end());
  clip(way, before, {re});
  if (way.empty()) return;
  meet(way, arcs);
  if (!arcs.empty() && around_edge(way, 0, arcs[0]) > 0)
    site.approach(side, way.front(), re);
  else
    site.approach(side, way.front());
  follow(site, side, way, arcs, false,
         [&](std::size_t i) { site.to(Kind::feed, side, way[i]); });
}

// Contact points of a face at z between two heights; those of the last pass are corrected.
std::vector<Point> face_contour(const Site& site, const Side& side, const std::string& id,
                                double z, double from, double to, bool last) {
  const auto& table = correction(site, id);
  if (!last || table.empty()) {
    const double moved = z + moved_mm(site, id);
    return {{from, moved}, {to, moved}};
  }
  const auto at = [&](double h) {
    return Point{h, z + planning::interpolated(table, side.sign * h)};
  };
  std::vector<Point> all{at(from)};
  for (const auto& [rho, dz] : table)
    if (const double h = side.sign * rho; h > from && h < to) all.push_back(at(h));
  std::ranges::sort(all, {}, &Point::h_mm);
  all.push_back({to, all.back().z_mm});
  return all;
}

// Contact points of a face that go on along the chamfer of element k behind it, if another
// setup makes that.
std::vector<Point> with_edge(const Site& site, const Side& side,
                             std::vector<Point> contact, std::size_t k, double re_mm) {
  const auto* s = edge_to_cut(site, side, k);
  if (!s) return contact;
  const auto line = finished_line(site, side, *s);
  const auto edge = edge_of_front(*s);
  const auto n = normal(line[edge - 1], line[edge]);
  const double top = contact.back().h_mm;
  while (contact.size() > 1 && contact[contact.size() - 2].h_mm >= line[0].h_mm)
    contact.pop_back();
  contact.back() = {line[0].h_mm, contact.back().z_mm};
  contact.insert(contact.end(), line.begin() + 1,
                 line.begin() + static_cast<std::ptrdiff_t>(edge));
  contact.push_back(
      moved_along(line[edge], n, planning::beyond_edge_mm(*s->front, s->stock, re_mm)));
  if (s->stock) contact.push_back({top, contact.back().z_mm});
  return contact;
}

// Radius to clear when approaching the shoulder before element k, including following
// elements that are no longer than the stock before their own shoulders.
double shoulder_top(const Site& site, const Side& side, std::size_t operation,
                    std::size_t k) {
  double top = side.top0(side.items[k]);
  for (std::size_t j = k + 1; j < side.items.size(); ++j) {
    const double stock = shoulder_stock_mm(site, operation, side, j - 1);
    if (!(side.items[j].z0 + stock >= side.items[k].z0 - kSame_mm)) break;
    top = std::max(top, side.top0(side.items[j]));
  }
  return top;
}

// Moves along the line of the element before a shoulder to where turning has ended, or to
// its beginning, as far as the surfaces in front of it allow.
void run_out(Site& site, Side& side, std::size_t k, const std::vector<Point>& line,
             double re_mm, double to_z) {
  if (cut_later(site, side.items[k]) || !(to_z > site.at.z_mm)) return;
  auto way = tips(line, re_mm);
  std::reverse(way.begin(), way.end());
  while (way.size() > 2 && way[way.size() - 2].z_mm > to_z) way.pop_back();
  if (!(way.back().z_mm > site.at.z_mm)) return;
  if (way.back().z_mm > to_z) way.back() = at_z(way[way.size() - 2], way.back(), to_z);
  way.front() = {side.sign * site.at.h_mm, site.at.z_mm};
  clip(way, drawn_before(site, side, k), {re_mm});
  for (std::size_t i = 1; i < way.size(); ++i) site.to(Kind::feed, side, way[i]);
}

// Where facing ends at the foot of a shoulder, and the line on which it goes on from there.
struct ShoulderFoot {
  double turned_h = 0,
         h = 0;             // of the corner's lower end: as turned, and with the undercut
  std::vector<Point> line;  // of the element before the shoulder
  std::optional<planning::UndercutWay> undercut = {};
  double width_mm = 0;  // of the undercut
};

ShoulderFoot shoulder_foot(const Site& site, const Side& side, std::size_t k,
                           double re_mm) {
  const auto& s = side.items[k];
  ShoulderFoot f;
  f.line = corrected(site, side, s);
  const auto n = normal(f.line[f.line.size() - 2], f.line.back());
  f.turned_h = f.h = tip(f.line.back(), n, kWall, re_mm).h_mm + re_mm;
  if (const auto u =
          planning::undercut_behind(site.part, site.setup, {s.inner, s.index})) {
    f.line = with_undercut(std::move(f.line), *u, s.z1);
    f.undercut = planning::undercut_way(*u, re_mm);
    f.h = f.line.back().h_mm + f.undercut->foot_h + re_mm;
    f.width_mm = u->width_mm;
  }
  return f;
}

// From the shoulder down to the floor of an undercut, of the height h.
void down_undercut(Site& site, const planning::UndercutWay& way, double h) {
  const double z = site.at.z_mm;
  if (way.lean_rad > 0) site.to(Kind::feed, site.outer, {h + way.arc_h, z + way.arc_z});
  if (way.radius_mm > kSame_mm)
    site.arc(site.outer, {h, z + way.centre_z}, {h + way.centre_h, z + way.centre_z},
             false, false);
}

}  // namespace

double later_mm(const Site& site, std::size_t operation, const std::string& surface) {
  const auto& all = site.answer().operations;
  double sum = 0;
  for (std::size_t k = operation + 1; k < all.size(); ++k)
    if (all[k].kind != OperationKind::fixed && is_on(all[k], surface))
      sum += depth_mm(all[k]);
  return sum;
}

double corner_mm(const Site& site, const OperationPlan& o) {
  for (const auto& t : site.part.tools)
    if (t.id == o.tool) return t.re_mm;
  for (const auto& t : site.part.fixed_tools)
    if (t.id == o.tool) return t.re_mm;
  return 0;
}

// Why finishing does not run on from operation a into b, its next one; none if it does.
std::optional<std::string> parted(const Site& site, std::size_t i) {
  const auto &a = site.answer().operations[i], &b = site.answer().operations[i + 1];
  if (b.passes.size() != 1) return fmt::format("{} passes", b.passes.size());
  const auto& side = is_bore(a.kind) ? site.inner : site.outer;
  const auto k = place(side, a.on[0]);
  if (a.on.size() != 1 || b.on.size() != 1 || k + 1 >= side.items.size() ||
      side.items[k + 1].id != b.on[0])
    return "not the next element";
  const auto &s = side.items[k], &t = side.items[k + 1];
  const double falls =
      corrected(site, side, s).back().h_mm - corrected(site, side, t).front().h_mm;
  const auto rad = [](const Surface& e) { return std::atan2(e.h1 - e.h0, e.z0 - e.z1); };
  if (std::abs(s.z1 - t.z0) >= kSame_mm || t.h0 < s.h1 - kSame_mm)
    return "behind a falling wall";
  if (shoulder_stock_mm(site, i, side, k) > 0) return "the shoulder is faced later";
  const bool from_arc = is_arc(site, s), to_arc = is_arc(site, t);
  if ((to_arc && falls < -kSame_mm) || (from_arc && falls > kSame_mm) ||
      ((from_arc || to_arc) && (t.h0 > s.h1 + kSame_mm || rad(t) > rad(s) + kSame_mm)))
    return "no fillet may stay beside an arc's blank";
  const auto length = [](const Surface& e) {
    return std::hypot(e.h1 - e.h0, e.z1 - e.z0);
  };
  planning::Passage passage;
  passage.cylinders = s.h0 == s.h1 && t.h0 == t.h1;
  passage.least_mm = std::min(length(s), length(t));
  if (t.h0 < s.h1 + kSame_mm) passage.falls_mm = falls;
  const double r = corner_mm(site, a);
  if (planning::runs_on(passage, r, minor_edge_rad(site, a))) return std::nullopt;
  return passage.least_mm < 2 * r ? "an element shorter than the corner"
                                  : "a step down that the minor edge does not clear";
}

// Whether two operations finish contours with one tool.
bool finish_alike(const OperationPlan& a, const OperationPlan& b) {
  return finishes(a) && a.kind == b.kind && a.tool == b.tool;
}

bool joined(const Site& site, std::size_t i) {
  const auto& all = site.answer().operations;
  return i + 1 < all.size() && finish_alike(all[i], all[i + 1]) && !parted(site, i);
}

std::optional<std::string> entered_again(const Site& site, std::size_t i) {
  const auto& all = site.answer().operations;
  const auto& o = all[i];
  if (i > 0 && finish_alike(all[i - 1], o)) return parted(site, i - 1);
  const auto is_profiling = [&](const auto& t) {
    return t.id == o.tool && t.use == catalogue::FixedUse::profiling;
  };
  const bool profiles = std::any_of(site.part.fixed_tools.begin(),
                                    site.part.fixed_tools.end(), is_profiling);
  const auto before = [&](const OperationPlan& a) {
    return a.tool == o.tool && (finish_alike(a, o) || profiles);
  };
  if (std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), before))
    return profiles ? "arcs, and chamfers of their own, are cut one by one"
                    : "another operation comes between";
  if (o.passes.size() > 1 && (profiles || finishes(o)))
    return fmt::format("{} passes", o.passes.size());
  return std::nullopt;
}

// Thickness [mm] above the nominal line of element k that roughing leaves where it is planned
// to leave `left_mm` above the programmed one.  It comes in over what is in front, where its
// minor edge rises, and stays above surfaces there that are drawn as high but have other
// limits.
double above_nominal_mm(const Site& site, const OperationPlan& o, const Side& side,
                        std::size_t k, double left_mm) {
  const auto& s = side.items[k];
  const double rises_from_z = s.z0 + kBefore_mm + 2 * corner_mm(site, o);
  const double slope = std::tan(minor_edge_rad(site, o));
  double least = left_mm + middle_h(site.part.drawing, side, s);
  for (std::size_t j = k; j-- > 0 && drawn_level(side.items[j], side.items[j + 1]);) {
    const auto& t = side.items[j];
    const double rise = slope * std::max(0.0, t.z1 - rises_from_z);
    least = std::max(least, kept_h(site, side, t, t.h1) - s.h0 - rise);
    if (t.h0 != t.h1) break;
  }
  return least;
}

void turn(Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  auto& side = site.side(is_bore(o.kind));
  for (const auto& id : o.on) {
    const auto k = place(side, id);
    const auto& s = side.items[k];
    const auto outline = !s.inner && s.stock
                             ? planning::outline_over(site.part, site.setup, s.index)
                             : planning::Outline{};
    double left = later_mm(site, operation, id) + depth_mm(o);
    const bool finishes = left - depth_mm(o) < kSame_mm;
    for (std::size_t i = 0; i < o.passes.size(); ++i) {
      left -= o.passes[i].ap_mm;
      const bool last = finishes && i + 1 == o.passes.size();
      pass({site, side, operation, k, o.passes[i].ap_mm,
            last ? middle_h(site.part.drawing, side, s)
                 : above_nominal_mm(site, o, side, k, left),
            corner_mm(site, o), last,
            last ? std::nullopt
                 : planning::reaches_stock_z(outline, static_cast<int>(i),
                                             static_cast<int>(o.passes.size()))});
    }
  }
}

void face(Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  const double re = corner_mm(site, o), hole = -site.inner.stock_h;
  const double outside =
      planning::end_stock_mm(site.part, site.setup) / 2 + kAbove_mm + re;
  double left = later_mm(site, operation, o.on[0]) + depth_mm(o);
  for (const auto& pass : o.passes) {
    left -= pass.ap_mm;
    const bool last = left < kSame_mm;
    face_pass(site, site.outer,
              face_contour(site, site.outer, o.on[0], last ? 0 : left,
                           hole > 0 ? hole - kBehind_mm : 0, outside, last),
              re, {});
    site.rapid(site.at.h_mm, site.at.z_mm + kAbove_mm);
    site.front = last ? 0 : left;
  }
}

void face_shoulder(Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  const auto& id = o.on[0];
  Side& side = site.side(part::inner_shoulder(site.part.drawing, id).has_value());
  const auto& items = side.items;
  std::size_t k = 0;  // the lower element, before the shoulder
  while (items[k].id + "|" + items[k + 1].id != id &&
         items[k + 1].id + "|" + items[k].id != id)
    ++k;
  const double re = corner_mm(site, o), z = items[k].z1;
  const auto foot = shoulder_foot(site, side, k, re);
  const double outside =
      shoulder_top(site, side, operation, k + 1) + site.above(side) + re;
  const double stock = later_mm(site, operation, id) + depth_mm(o);
  const auto before = drawn_before(site, side, k);
  double left = stock;
  for (const auto& pass : o.passes) {
    left -= pass.ap_mm;
    if (left >= kSame_mm) {
      face_pass(site, side,
                face_contour(site, side, id, z + left, foot.turned_h + kBehind_mm,
                             outside, false),
                re, before);
    } else {
      const auto contact = face_contour(site, side, id, z, foot.h, outside, true);
      const auto* edge = edge_to_cut(site, side, k + 1);
      const auto arc = edge ? rounding(site, side, *edge, re) : std::nullopt;
      face_pass(site, side, with_edge(site, side, contact, k + 1, re), re, before,
                arc ? std::vector<Arc>{*arc} : std::vector<Arc>{});
      if (foot.undercut) down_undercut(site, *foot.undercut, foot.line.back().h_mm);
      run_out(site, side, k, foot.line, re,
              std::max(z + stock + site.r_most - re, z + foot.width_mm));
    }
    site.lift(side);
  }
}

}  // namespace turnwright::nc
