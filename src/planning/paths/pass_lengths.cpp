#include "pass_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "edges.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "planning/values/surface_request.hpp"
#include "turnwright/base/dual.hpp"
#include "turnwright/base/interval.hpp"

namespace turnwright::planning {
namespace {

constexpr double kSame_mm = 1e-9;
constexpr double kLevel_mm = 0.01;  // more than corrections differ
constexpr double kRounding_mm = 1e-5;
constexpr double kUpright = std::numbers::pi / 2;

// An element in the tool's order.
struct Item {
  std::size_t index = 0;
  double z0, h0, z1, h1;  // blank
  part::CutKind cut{};
  bool cut_later = false;  // a groove or an arc
  bool mirrored = false;   // against the part's axis
  double moved = 0;        // to the middle of the limits, in the heights
  double length() const { return std::hypot(z0 - z1, h1 - h0); }
  double bends_rad = 0;  // of an arc: steeper at its beginning than its chord
  double radius_mm = 0;  // of an arc
  double rad() const { return std::atan2(h1 - h0, z0 - z1); }
};

std::vector<Item> items_of(const PreparedPart& p, std::size_t setup, bool inner) {
  const auto& d = p.drawing;
  const bool left = p.setups[setup].hold == part::End::left;
  const double sign = left ? 1 : -1, out = inner ? -1 : 1, free = free_z_mm(p, setup);
  const auto to_middles = to_middles_mm(d);
  const auto by_mm = [&](const auto& e) {
    const auto found = to_middles.find(e.id);
    return found == to_middles.end() ? 0 : found->second;
  };
  std::vector<Item> all;
  const auto add = [&](const auto& e, std::size_t i, double left_z) {
    const double a = sign * (left_z - free), b = sign * (left_z + e.length_mm - free);
    const double by = by_mm(e);
    const double ha = out * (e.left_mm / 2 + by), hb = out * (e.right_mm / 2 + by);
    Item item = a > b ? Item{i, a, ha, b, hb} : Item{i, b, hb, a, ha};
    item.cut_later = e.cut && part::replaces_blank(e.cut->kind);
    item.moved = out * by;
    item.mirrored = !left;
    all.push_back(item);
  };
  const auto left_mm = inner ? part::inner_left_ends_mm(d) : part::left_ends_mm(d);
  for (std::size_t i = 0; i < left_mm.size(); ++i)
    inner ? add(d.inner[i], i, left_mm[i]) : add(d.outer[i], i, left_mm[i]);
  std::sort(all.begin(), all.end(),
            [](const Item& a, const Item& b) { return a.z0 > b.z0; });
  return all;
}

// Eq. (1), of r = 1.
double tip_z(double a_rad, double b_rad) {
  return std::sin((a_rad + b_rad) / 2) / std::cos((a_rad - b_rad) / 2) - 1;
}

// Whether the last bore ends inside the part, at a wall: the stock's hole, if any, is
// narrower.
bool hole_ends(const PreparedPart& p, const Item& last) {
  return last.z1 + part::length_mm(p.drawing) >= kNoWall_mm &&
         -p.drawing.stock.inner_mm / 2 > last.h1 + kSame_mm;
}

// An element as it stands once its groove or arc is cut; none for a groove, which is not in
// the tool's way.
std::optional<Item> drawn(const PreparedPart& p, Item e, bool inner) {
  if (!e.cut_later) return e;
  const auto& cut = inner ? p.drawing.inner[e.index].cut : p.drawing.outer[e.index].cut;
  if (cut->kind == part::CutKind::groove) return std::nullopt;
  const double out = inner ? -1 : 1;
  e.h0 = out * (e.mirrored ? cut->drawn.left_mm : cut->drawn.right_mm) / 2;
  e.h1 = out * (e.mirrored ? cut->drawn.right_mm : cut->drawn.left_mm) / 2;
  e.radius_mm = cut->radius_mm;
  e.bends_rad = (cut->convex ? 1 : -1) *
                std::asin(std::min(1.0, e.length() / (2 * cut->radius_mm)));
  return e;
}

// Stock [mm] that turning leaves for facing on the shoulder between an element and the next
// one; 0 if this setup faces no shoulder there.  It is the largest of its tools'
// least depths: the tool is not chosen yet, and one that also roughs, which spares a tool
// change, has the largest.
double left_before_shoulder_mm(const PreparedPart& p, const SetupWork& work, bool inner,
                               const Item& a, const Item& b) {
  const Element front{inner, a.index}, behind{inner, b.index};
  if (!faces_between(work, front, behind)) return 0;
  double most = 0;
  for (const auto* t : shoulder_tools(p, front, behind))
    most = std::max(most, catalogue::least_depth_mm(*t));
  return most;
}

bool is_arc(const PreparedPart& p, const Item& e, bool inner) {
  const auto& cut = inner ? p.drawing.inner[e.index].cut : p.drawing.outer[e.index].cut;
  return cut && cut->kind == part::CutKind::arc;
}

// The elements made after the first `setups`; none while surfaces are being assigned.
std::vector<bool> made_after(const PreparedPart& p, std::size_t setups, bool inner) {
  const auto done = setups > 0 && setups <= p.work.setups.size()
                        ? finished_after(p, setups - 1)
                        : nothing_finished(p.drawing);
  return inner ? done.inner : done.outer;
}

// The first thing behind element k that is higher than its end: for roughing a blank, for
// finishing a drawn surface with its size in the middle of its limits.
void add_walls(const PreparedPart& p, std::size_t setup, const SetupWork& work,
               const std::vector<Item>& all, std::size_t k, Surroundings& s) {
  const double h = all[k].h1 + kSame_mm, blank = h - all[k].moved;
  const auto before = made_after(p, setup, s.inner),
             after = made_after(p, setup + 1, s.inner);
  const auto stock_h = [&](const Item& e) {
    return s.inner ? -hole_mm(p, all[k].index) / 2
                   : part::stock_of(p.drawing, e.index).most_mm / 2;
  };
  bool touches = false;
  std::size_t j = k;
  while (j + 1 < all.size() && all[j + 1].z0 >= all[j].z1 - kNoWall_mm) {
    const auto& e = all[++j];
    if (!std::isfinite(s.wall_z) && std::max(e.h0, e.h1) - e.moved > blank) {
      const Element wall{s.inner, e.index};
      if (!makes(work, wall))
        s.wall_chamfer = front_chamfer(p, setup, wall).value_or(part::Chamfer{});
      s.wall_edge_h = e.h0 - s.wall_chamfer.radial_mm;
      s.wall_in_stock = !before[e.index];
      s.wall_z = e.z0;
      s.wall_steps = e.h0 - e.moved > blank;
      s.wall_h = before[e.index] ? e.h0 : stock_h(e);
      s.wall_drawn_h = is_arc(p, e, s.inner) ? h : after[e.index] ? e.h0 : stock_h(e);
      s.shoulder_mm = left_before_shoulder_mm(p, work, s.inner, all[j - 1], e);
    }
    const auto seen = drawn(p, e, s.inner);
    if (touches || !seen) continue;
    const double rises_rad = seen->rad() + seen->bends_rad;
    const bool step = seen->h0 > h, meets = seen->h0 >= h - 2 * kSame_mm;
    if (!step && seen->h1 <= h && !(meets && rises_rad > kSame_mm)) continue;
    touches = true;
    s.touch_z = e.z0;
    s.touch_rad = meets && !step ? rises_rad : kUpright;
    if (s.touch_rad < 0) {  // a hollow that rises again to the height it began at
      s.touch_z -= 2 * seen->radius_mm * std::sin(-rises_rad);
      s.touch_rad = -rises_rad;
    }
  }
  if (!s.inner || !hole_ends(p, all[j])) return;
  if (!std::isfinite(s.wall_z)) {
    s.wall_z = all[j].z1;
    s.wall_steps = true;
    s.wall_h = s.wall_drawn_h = stock_h(all[j]);
  }
  if (touches) return;
  s.touch_z = all[j].z1;
  s.touch_rad = kUpright;
}

// Two elements drawn with one diameter where they meet.
bool meet(const Item& a, const Item& b) {
  return std::abs(a.h1 - a.moved - b.h0 + b.moved) < kSame_mm &&
         std::abs(a.z1 - b.z0) < kSame_mm;
}

// From one element to the next, if the setup makes both.
std::optional<Passage> passage(const PreparedPart& p, std::size_t setup,
                               const SetupWork& work, bool inner, const Item& a,
                               const Item& b) {
  const double rises = b.h0 - b.moved - a.h1 + a.moved;
  // Finishing does not run on beside the blank of an arc if a step or an inner corner there
  // would keep the tool's corner off the finished surface.
  const bool from_arc = is_arc(p, a, inner), to_arc = is_arc(p, b, inner);
  const bool kept_off =
      (to_arc && b.h0 > a.h1 + kSame_mm) || (from_arc && b.h0 < a.h1 - kSame_mm) ||
      ((from_arc || to_arc) && (rises > kSame_mm || b.rad() > a.rad() + kSame_mm));
  const auto drilled = [&](const Item& e) {
    return inner && part::is_hole(p.drawing.inner[e.index]);
  };
  if (std::abs(a.z1 - b.z0) >= kSame_mm || rises < -kSame_mm || kept_off || drilled(a) ||
      drilled(b) || !makes(work, {inner, a.index}) || !makes(work, {inner, b.index}) ||
      left_before_shoulder_mm(p, work, inner, a, b) > 0)
    return std::nullopt;
  Passage g;
  g.cylinders = a.h0 == a.h1 && b.h0 == b.h1;
  g.least_mm = std::min(a.length(), b.length());
  if (rises > kSame_mm) {
    g.rad = kUpright;
    g.wall_to_h =
        b.h0 -
        front_chamfer(p, setup, {inner, b.index}).value_or(part::Chamfer{}).radial_mm;
  } else {
    g.falls_mm = a.h1 - b.h0;
  }
  return g;
}

// Length of a corner and its minor edge, from the corner's centre towards the free end,
// that stays below a height.
double below_mm(double height, double r, double minor_rad) {
  const double arc = r * (1 - std::cos(minor_rad));
  return height <= arc ? std::sqrt(height * (2 * r - height))
                       : r * std::sin(minor_rad) + (height - arc) / std::tan(minor_rad);
}

// Distance from the shoulder at which a corner of radius r, on a pass that leaves the
// thickness `left`, meets the radius of an undercut: its centre is then R - r from that
// radius' own.
double before_radius_mm(const Surroundings& s, double r, double left) {
  const auto& undercut = s.undercut ? s.undercut : s.faced_undercut;
  if (!undercut) return 0;
  const double most = undercut->radius_mm - r;
  const double below = most - undercut->depth_mm - left;
  if (most <= 0 || below <= 0) return 0;
  return most - std::sqrt(most * most - sqr(std::min(below, most)));
}

// Way of the tip of a corner of radius r around a rounded edge.
double around_mm(const part::Chamfer& rounded, double r) {
  return kUpright * (rounded.axial_mm + r);
}

}  // namespace

double front_mm(const PreparedPart& p, std::size_t setup, const SetupWork& work) {
  const std::string face = free_face(p, setup);
  const auto faces = [&](const OperationRequest& o) {
    return o.kind == OperationKind::face && o.setup < setup && o.on[0] == face;
  };
  const bool faced = work.end_face || !p.operations ||
                     std::any_of(p.operations->begin(), p.operations->end(), faces);
  return faced ? 0
               : face_stock_mm(p, p.setups[setup].hold == part::End::left
                                      ? part::End::right
                                      : part::End::left);
}

Outline outline_over(const PreparedPart& p, std::size_t setup, std::size_t element) {
  const auto& d = p.drawing;
  const auto& e = d.outer[element];
  Outline o;
  if (d.stock.outline.empty() || e.left_mm != e.right_mm) return o;
  const double sign = p.setups[setup].hold == part::End::left ? 1 : -1,
               free = free_z_mm(p, setup), from = part::left_z_mm(d, element);
  o.front_z = sign * ((sign > 0 ? from + e.length_mm : from) - free);
  o.drawn_h = e.left_mm / 2;
  o.most_h = part::stock_of(d, element).most_mm / 2;
  for (const auto& line : part::stock_lines(d.stock, from - part::kRunOut_mm,
                                            from + e.length_mm + part::kRunOut_mm)) {
    const double left = line.left_mm / 2, right = line.right_mm / 2;
    o.lines.push_back(
        sign > 0 ? Outline::Line{line.z1_mm - free, right, line.z0_mm - free, left}
                 : Outline::Line{free - line.z0_mm, left, free - line.z1_mm, right});
  }
  if (sign > 0) std::ranges::reverse(o.lines);
  return o;
}

std::optional<double> reaches_stock_z(const Outline& o, int i, int n) {
  const double level = o.drawn_h + (o.most_h - o.drawn_h) * (1 - (i + 1.0) / n);
  for (const auto& line : o.lines) {
    if (!(std::max(line.h0, line.h1) > level + kSame_mm)) continue;
    const double z = line.h0 > level ? line.z0
                                     : line.z0 + (line.z1 - line.z0) * (level - line.h0) /
                                                     (line.h1 - line.h0);
    return z < o.front_z - kSame_mm ? std::optional{z} : std::nullopt;
  }
  return std::nullopt;
}

double edge_mm(const Surroundings& s, double r) {
  const auto& c = s.wall_chamfer;
  if (c.round) return around_mm(c, r) - (s.wall_in_stock ? c.axial_mm + r : r);
  const double chamfer = std::hypot(c.radial_mm, c.axial_mm);
  const double along = chamfer + beyond_edge_mm(c, s.wall_in_stock, r);
  return s.wall_in_stock ? along * (1 - c.radial_mm / chamfer) : along;
}

Home home_of(const PreparedPart& p, double front) {
  return {p.drawing.stock.outer_mm / 2 + kChange_mm, front + kChange_mm};
}

namespace {

// Of element k in the tool's order.
Surroundings surroundings(const PreparedPart& p, std::size_t setup, Clamping clamping,
                          const SetupWork& work, bool inner, const std::vector<Item>& all,
                          std::size_t k) {
  const auto& e = all[k];
  const Element element{inner, e.index};
  Surroundings s;
  s.inner = element.inner;
  s.stock_h = p.drawing.stock.outer_mm / 2;
  s.front = front_mm(p, setup, work);
  const double sign = p.setups[setup].hold == part::End::left ? 1 : -1;
  s.mirrored = sign < 0;
  s.root_z =
      s.inner ? -kInfinity : sign * (root_z_mm(p, setup, clamping) - free_z_mm(p, setup));
  for (const auto& t : p.tools) s.r_most = std::max(s.r_most, t.re_mm);
  if (!s.inner) s.outline = outline_over(p, setup, element.index);
  s.z0 = e.z0;
  s.h0 = e.h0;
  s.z1 = e.z1;
  s.h1 = e.h1;
  s.front_chamfer = front_chamfer(p, setup, element).value_or(part::Chamfer{});
  s.fillet_mm = fillet_behind_mm(p, setup, element);
  (faces_behind(p, setup, work, element) ? s.faced_undercut : s.undercut) =
      undercut_behind(p, setup, element);
  s.first = k == 0;
  s.wall_z = s.touch_z = -kInfinity;
  add_walls(p, setup, work, all, k, s);
  if (k > 0 && meet(all[k - 1], e)) {
    s.front_falls_mm = all[k - 1].h1 - e.h0;
    if (const auto front = drawn(p, all[k - 1], s.inner))
      s.front_rad = front->rad() - front->bends_rad;
  }
  if (k > 0) {
    s.before = passage(p, setup, work, s.inner, all[k - 1], e);
    if (s.before && s.before->rad == 0) s.before->rad = all[k - 1].rad();
  }
  if (k + 1 == all.size()) return s;
  const auto& next = all[k + 1];
  const double up = next.moved - e.moved;
  if (e.h0 == e.h1 && !next.cut_later && std::abs(next.h0 - e.h1 - up) < kLevel_mm &&
      std::abs(next.h1 - e.h1 - up) < kLevel_mm)
    s.level_behind = next.index;
  if (const auto edge = front_chamfer(p, setup, {s.inner, next.index});
      edge && edge->round)
    s.below_rounding_mm = next.h0 - edge->radial_mm - e.h1;
  s.behind = passage(p, setup, work, s.inner, e, next);
  if (s.behind && s.behind->rad == 0) s.behind->rad = next.rad();
  return s;
}

}  // namespace

Surroundings surroundings(const PreparedPart& p, std::size_t setup, Clamping clamping,
                          const SetupWork& work, const Element& element) {
  const auto all = items_of(p, setup, element.inner);
  std::size_t k = 0;
  while (all[k].index != element.index) ++k;
  return surroundings(p, setup, clamping, work, element.inner, all, k);
}

std::vector<Surroundings> outer_surroundings(const PreparedPart& p, std::size_t setup,
                                             Clamping clamping, const SetupWork& work) {
  const auto items = items_of(p, setup, false);
  std::vector<Surroundings> all(items.size());
  for (std::size_t k = 0; k < items.size(); ++k)
    all[items[k].index] = surroundings(p, setup, clamping, work, false, items, k);
  return all;
}

bool runs_on(const Passage& g, double r, double minor_rad) {
  return g.cylinders ||
         (g.least_mm >= 2 * r && g.falls_mm <= r * (1 - std::cos(minor_rad)));
}

double needed_beyond_mm(const Surroundings& s, double corner_mm) {
  const double rad = std::atan2(s.h1 - s.h0, s.z0 - s.z1);
  const double end = std::isfinite(s.touch_z)
                         ? s.touch_z + corner_mm * tip_z(rad, s.touch_rad)
                         : -kInfinity;
  return s.z1 - std::max(end, s.z1 - corner_mm);
}

bool clears_jaws(const Surroundings& s, double corner_mm) {
  return s.inner || s.z1 - needed_beyond_mm(s, corner_mm) >= s.root_z - kRounding_mm;
}

Beside beside(const Surroundings& s, const Strokes& strokes) {
  const double r = strokes.corner_mm, rad = std::atan2(s.h1 - s.h0, s.z0 - s.z1);
  const double slope = std::cos(rad), above = s.inner ? kAboveBore_mm : kAbove_mm;
  const bool tapered = s.h0 != s.h1;
  // Roughing leaves a chamfer at a rounded edge; finishing comes up to that on a slope of
  // 45 deg, or up the wall.
  const bool rounds = s.front_chamfer.round;
  const auto chamfer = part::roughed(s.front_chamfer);
  const double chamfer_rad = std::atan2(chamfer.radial_mm, chamfer.axial_mm);
  const auto runs = [&](const std::optional<Passage>& g) {
    return strokes.contour && g && runs_on(*g, r, strokes.minor_rad);
  };
  const bool from_before = strokes.passes == 1 && runs(s.before), on = runs(s.behind);

  const auto wall_stock = [&](bool last) {
    return std::max(s.shoulder_mm, s.wall_steps && !last ? strokes.wall_stock_mm : 0);
  };
  // z at which a pass that leaves the thickness `left` ends, or at which finishing runs on
  // into the next element.  A pass up a cone ends once it is out of the stock.
  const auto end = [&](bool last, double left) {
    if (last && on) return s.z1 + r * tip_z(rad, s.behind->rad);
    const bool level = last && s.level_behind;
    double z = s.z1 + r * (std::sin(rad) - 1) - (level ? 0 : s.r_most + r) - kBehind_mm;
    if (!last || s.faced_undercut)
      z = std::max(z,
                   s.wall_z + std::max(wall_stock(last), before_radius_mm(s, r, left)));
    else if (std::isfinite(s.touch_z))
      z = std::max(z, s.touch_z + r * tip_z(rad, s.touch_rad));
    if (s.shoulder_mm > 0) z = std::max(z, s.wall_z + s.shoulder_mm);
    if (!s.inner && rad > 0) {
      const double up = s.stock_h + above - s.h1 - left;
      z = std::max(
          z, s.z1 + r * (std::sin(rad) - 1) - (up + r * (1 - slope)) / std::tan(rad));
    }
    return std::max(z, s.root_z);
  };
  // Height to which the tool is drawn out along a wall at the end of a pass.
  const auto drawn_out_h = [&](bool last, double left, double z) {
    const double h = s.h1 + left;
    // Where a rounded edge begins, the tip is a corner's radius lower.
    if (last && on)
      return s.behind->wall_to_h.value_or(h) - (s.below_rounding_mm ? r : 0);
    const bool faced = last && s.shoulder_mm > 0;
    if (!s.wall_steps || !(z < s.wall_z + wall_stock(last) + kLevel_mm) ||
        (faced && !s.inner))
      return h;
    return std::max(
        h, last && !faced ? s.wall_drawn_h : std::min(s.wall_h, h + strokes.depth_mm));
  };
  const auto start = [&](bool last) {
    if (last && from_before && rounds) return s.z0;
    if (last && from_before)
      return s.z0 + r * tip_z(chamfer.axial_mm > 0 ? chamfer_rad : rad, s.before->rad);
    if (last && s.front_falls_mm > kSame_mm)
      return s.z0 - r - below_mm(s.front_falls_mm, r, strokes.minor_rad);
    if (last && s.front_rad)
      return s.z0 +
             r * (rad < *s.front_rad ? std::sin(rad) - 1 : tip_z(rad, *s.front_rad));
    const double level = s.z0 + kBefore_mm;
    const double along = chamfer.axial_mm > 0 ? chamfer_rad : rad;
    const double own = s.z0 + (rounds ? 0 : r * (std::sin(along) - 1)) +
                       (kBefore_mm + r) * std::cos(along);
    const double z = last ? own : level;
    return s.first && s.front > 0 ? std::max(z, s.front + kBefore_mm) : z;
  };
  const auto turns = [&](double h) {
    return std::max(2 * std::abs(h), strokes.limited_mm);
  };
  const auto height = [&](double left, double tip) {
    const double z = tip + r * (1 - std::sin(rad));
    return s.h1 + left + (s.z1 - z) * std::tan(rad);
  };
  // Time at a place over that at the element's mean diameter: the spindle turns slower on
  // a larger one.
  const auto longer = [&](double left, double tip) {
    return turns(height(left, tip)) / turns((s.h0 + s.h1) / 2 + left);
  };
  // Length [mm] at feed from a to b, counted as that which takes as long at the element's
  // mean diameter.  Roughing enters along the axis, finishing along the element's own line.
  const auto fed = [&](bool last, double left, double a, double b) {
    if (last && rounds) {
      const double R = s.front_chamfer.axial_mm + r, h = s.h0 + left;
      // The tip's mean height on its arc is R (1 - 2/pi) below the surface.
      return (a - s.z0) / std::cos(chamfer_rad) * turns(h - R - (a - s.z0) / 2) /
                 turns(h) +
             around_mm(s.front_chamfer, r) * turns(h - R * (1 - 2 / std::numbers::pi)) /
                 turns(h) +
             s.z0 - R - b;
    }
    if (chamfer.axial_mm > 0) {
      const double foot = last ? a : s.z0 + r * tip_z(0, chamfer_rad);
      const double edge = s.z0 - chamfer.axial_mm + r * tip_z(chamfer_rad, 0);
      const double h = s.h0 + left, below = (foot - edge) / 2 * std::tan(chamfer_rad);
      return a - foot + edge - b +
             (foot - edge) / std::cos(chamfer_rad) * turns(h - below) / turns(h);
    }
    if (!tapered) return a - b;
    const auto cone = [&](double from, double to) {
      return (from - to) / slope * longer(left, (from + to) / 2);
    };
    if (last) return cone(a, b);
    const double first = s.z0 + r * tip_z(0, rad);  // before that, along the axis
    return (a - first) * longer(left, first) + cone(first, b);
  };

  // Length at feed from where a pass is approached to its start: onto the end of a finished
  // surface finishing comes down a slope of 45 deg.
  const auto enters = [&](bool last) {
    if (!last) return above;
    if (s.front_rad || s.front_falls_mm > kSame_mm) return std::sqrt(2) * above;
    return chamfer.axial_mm > 0 || (kBefore_mm + r) * std::sin(-rad) < above ? above : 0;
  };

  Beside sum;
  const double middle = (s.h0 + s.h1) / 2, h = middle + strokes.left_mm;
  const double outside = s.stock_h + kClear_mm;
  double top = outside;  // from where the tool comes down to the pass
  for (int i = 0; i < strokes.passes; ++i) {
    const bool last = strokes.finishing && i + 1 == strokes.passes;
    const double left =
        strokes.left_mm + strokes.depth_mm * ((strokes.passes - 1) / 2.0 - i);
    const double of_pass = turns(middle + left) / turns(h);  // its time over the mean one
    const bool comes = !(last && from_before), leaves = !(last && on);
    const auto late = strokes.in_stock && !last
                          ? reaches_stock_z(s.outline, i, strokes.passes)
                          : std::nullopt;
    const double b = end(last, left);
    const double a = late ? std::max(*late, b) + kBefore_mm : start(last);
    const double undercut = last && s.undercut ? s.undercut->depth_mm : 0;
    const double out_h = drawn_out_h(last, left, b), from_h = s.h1 + left - undercut;
    const bool chamfers = last && !on && !(s.shoulder_mm > 0) &&
                          s.wall_chamfer.axial_mm > 0 && out_h > s.wall_edge_h;
    const double wall_h = chamfers && !s.wall_in_stock ? s.wall_edge_h : out_h;
    const double wall =
        std::abs(sqr(wall_h) - sqr(from_h)) / std::abs(s.h0 + s.h1 + 2 * left);
    // Into the shoulder and back, and along the slope.
    const double undercutting =
        last && s.undercut ? 2 * s.undercut->recess_mm + slope_excess_mm(*s.undercut) : 0;
    double length = (late ? a - b : fed(last, left, a, b)) + undercutting + wall +
                    (comes ? enters(last) * longer(left, a) : 0);
    if (chamfers)
      length +=
          edge_mm(s, r) * std::abs((s.wall_edge_h + out_h) / (s.h0 + s.h1 + 2 * left));
    sum.wall_mm += wall * of_pass;
    sum.fed_mm += length * of_pass;
    if (s.inner) {
      sum.rapid_mm +=
          (comes ? s.front + kClear_mm - a : 0) + (leaves ? s.front + kClear_mm - b : 0);
    } else {
      sum.rapid_mm += comes ? top - (s.h0 + left) - above : 0;
      const double lifted = out_h + (s.z1 - b) * std::tan(rad) + above;
      top = std::max(outside, lifted);
      sum.rapid_mm += leaves ? top - lifted + above : 0;
      if (i > 0) sum.rapid_mm += std::abs(a - sum.to_mm);
    }
    if (i == 0) sum.from_mm = a;
    sum.to_mm = leaves ? b + above : b;
  }
  if (s.inner) sum.from_mm = sum.to_mm = -h;
  return sum;
}

ThreadRoom thread_room(const PreparedPart& p, std::size_t setup, const Element& element,
                       double root_h) {
  const auto all = items_of(p, setup, element.inner);
  const auto done = finished_after(p, setup);
  const auto& d = p.drawing;
  const auto stock_h = [&](const Item& e) {
    return (element.inner ? -d.stock.inner_mm : part::stock_of(d, e.index).most_mm) / 2;
  };
  // As it stands once grooves and arcs are cut.
  const auto tops = [&](const Item& e) -> std::pair<double, double> {
    const auto& made_here = element.inner ? done.inner : done.outer;
    if (!made_here[e.index]) return {stock_h(e), stock_h(e)};
    if (const auto seen = drawn(p, e, element.inner)) return {seen->h0, seen->h1};
    const auto& cut = element.inner ? d.inner[e.index].cut : d.outer[e.index].cut;
    const double floor = (element.inner ? -1 : 1) * cut->core.left_mm / 2;
    return {floor, floor};
  };
  std::size_t k = 0;
  while (all[k].index != element.index) ++k;
  const double drawn_h = all[k].h0 - all[k].moved;
  ThreadRoom room{kInfinity};
  for (std::size_t j = k; j-- > 0;) {
    const auto [begin, end] = tops(all[j]);
    const double top = std::max(begin, end);
    if (!(top > root_h + kSame_mm)) continue;
    if (begin < end && !(top > drawn_h + kSame_mm)) {
      // Of a cone, as far as it is above the root; of an arc, all of it.
      const double from =
          is_arc(p, all[j], element.inner) ? begin : std::max(begin, root_h);
      room.rising_mm =
          all[j].z1 - all[k].z0 + (all[j].z0 - all[j].z1) * (end - from) / (end - begin);
      continue;
    }
    room.before_mm = all[j].z1 - all[k].z0;
    break;
  }
  const bool follows = k + 1 < all.size() && all[k + 1].z0 >= all[k].z1 - kNoWall_mm;
  room.stands_behind = follows ? tops(all[k + 1]).first > root_h + kSame_mm
                               : element.inner && hole_ends(p, all[k]);
  return room;
}

double least_run_in_mm(const ThreadRoom& room, double P) {
  return std::max(P, room.rising_mm > 0 ? room.rising_mm + P / 2 : 0);
}

std::optional<double> run_in_mm(const ThreadRoom& room, double P) {
  const double least = least_run_in_mm(room, P);
  const double way = std::min(std::max(kRunInPitches * P, least), room.before_mm - P / 2);
  if (!(way >= least) || room.rising_mm > kRunInPitches * P) return std::nullopt;
  return way;
}

std::optional<KnurlWay> knurl_way(const ThreadRoom& room, double z0, double z1,
                                  double width) {
  const double to = z1 + (room.stands_behind ? kBehind_mm : 0);
  const bool open = room.before_mm >= width / 2 + kBehind_mm && !(room.rising_mm > 0);
  const double from = z0 - (open ? width / 2 : width);
  if (from >= to) return KnurlWay{from, to};
  if (!open) return std::nullopt;
  return KnurlWay{to, to};
}

double swept_mm2(double from, double to, double D_c) {
  const auto whole = [&](double x) {
    const double c = D_c / 2, out = std::abs(x);
    return std::copysign(out < c ? out * D_c : c * D_c + (out * out - c * c), x);
  };
  return whole(to) - whole(from);
}

}  // namespace turnwright::planning
