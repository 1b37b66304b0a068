#include <algorithm>
#include <cmath>

#include "machined_surface.hpp"
#include "planning/operation/speed_window.hpp"
#include "planning/paths/edges.hpp"

namespace turnwright::planning {
namespace {

constexpr double kDepths_mm = 1e-3;  // between which lengths are compared

// Diameter inside which the spindle keeps its limit: at the largest feed that the tool
// allows, and at the speed of least cost as far as its limits allow.  It does not depend on
// the conditions that a request gives.
double limited_mm(OperationModel o, const Strokes& strokes) {
  const double reach = strokes.depth_mm * (strokes.passes - 1) / 2.0,
               f = o.f_window.upper;
  o.vc = o.vc_window;
  o.depth_mm = {strokes.depth_mm, 0};
  o.passes = {{{strokes.left_mm + reach, 0}, {}}, {{strokes.left_mm - reach, 0}, {}}};
  const auto F = cutting::forces_N(o.cut, strokes.depth_mm, f);
  const double held = spindle_cap(o, F, 0.0);
  const double cap = held > o.n_min_rpm ? held : o.n_cap_rpm;
  const auto window = speed_window(o, f, 0.0, F, cap);
  const double least_cost =
      cutting::speed_for_life_m_min(o.cut, o.economic_life_min, f, strokes.depth_mm);
  return 1000 * std::min(std::max(least_cost, window.lower), window.upper) /
         (units::kPi * cap);
}

// The line through its values at two depths, if it is positive from depth 0 to beyond the
// larger one.
Affine through(double a0, double v0, double a1, double v1) {
  const double slope = a1 - a0 > kDepths_mm ? (v1 - v0) / (a1 - a0) : 0;
  const double at_0 = v0 - slope * a0;
  const bool positive = at_0 > 0 && v1 + 0.1 * slope * a1 > 0;
  return std::abs(v1 - v0) > 1e-9 * v0 && positive ? Affine{at_0, slope} : Affine{v0, 0};
}

}  // namespace

// Lengths are those at the least and at the largest depth of finishing that the tools
// allow, and on the line through these between and a little beyond.
void MachinedSurface::add_lengths(const Recipe& recipe, double stock_mm, Chain& c) const {
  const double nr = recipe.rough_passes, nf = recipe.finish_passes;
  double least = nf > 0 ? stock_mm / nf : 0, most = least;
  if (nr > 0 && nf > 0) {
    const auto &rough = c.operations[0].ap, &finish = c.operations[1].ap;
    const auto possible = [&](double a) { return std::clamp(a, 0.0, stock_mm / nf); };
    least = possible(std::max(finish.lower, (stock_mm - nr * rough.upper) / nf));
    most = std::max(least,
                    possible(std::min(finish.upper, (stock_mm - nr * rough.lower) / nf)));
  }
  for (auto& o : c.operations) {
    const auto at_least = lengths(recipe, o, stock_mm, least);
    const auto at_most = lengths(recipe, o, stock_mm, most);
    const auto path = through(least, at_least.path_mm, most, at_most.path_mm);
    for (auto& pass : o.passes) pass.path_mm = path;
    o.rapid_min = through(least, at_least.rapid_min, most, at_most.rapid_min);
    o.fed_mm = through(least, at_least.fed_mm, most, at_most.fed_mm);
  }
}

MachinedSurface::Lengths MachinedSurface::lengths(const Recipe& recipe,
                                                  const OperationModel& o,
                                                  double stock_mm, double a_mm) const {
  const int n = o.finishing ? recipe.finish_passes : recipe.rough_passes;
  const bool makes = o.finishing || recipe.finish_passes == 0;
  const double finished = recipe.finish_passes * a_mm;
  Strokes strokes{n, makes, o.finishing, o.tool->re_mm,
                  units::rad_from_deg(o.tool->minor_kapr_deg)};
  strokes.depth_mm = o.finishing ? a_mm : (stock_mm - finished) / n;
  strokes.left_mm = strokes.depth_mm * (n - 1) / 2.0 + (o.finishing ? 0 : finished);
  strokes.limited_mm = limited_mm(o, strokes);
  strokes.in_stock = !(o.finishing && recipe.rough_passes > 0);
  if (recipe.finish) strokes.wall_stock_mm = catalogue::least_depth_mm(*recipe.finish);
  const auto b = ways(o, strokes);
  const double path = is_face() ? (D_large_ - D_small_) / 2
                                : std::hypot(high_ - low_, (D_large_ - D_small_) / 2);
  const double fed = b.fed_mm / n, in_cut = std::min(path + b.wall_mm / n, fed);
  return {in_cut, fed, b.rapid_mm / plan_->machine.rapid_mm_min};
}

Beside MachinedSurface::ways(const OperationModel& o, const Strokes& strokes) const {
  return is_face() ? facing(o, strokes) : beside(around_, strokes);
}

// What cutting an undercut from its shoulder adds to a facing pass.
struct Undercutting {
  double above_h = 0;   // the facing ends so far above the smaller element, or below it
  double along_mm = 0;  // to out_mm before the shoulder
  double out_mm = 0;    // at least its width
};
Undercutting undercutting(const part::Undercut& u, double corner_mm, double out_mm) {
  const auto w = undercut_way(u, corner_mm);
  const double out = std::max(out_mm, u.width_mm);
  const double in = std::hypot(w.foot_h - w.arc_h, w.arc_z);
  const double arc = w.radius_mm * (units::kPi / 2 + w.lean_rad);
  return {w.foot_h - u.depth_mm, in + arc + (out - w.centre_z) + slope_excess_mm(u), out};
}

// What the edge above a shoulder, of an element that another setup makes, adds to a facing
// pass: one that is made already it begins with, instead of above the element.
double over_edge_mm(const Surroundings& s, double corner_mm) {
  const auto& c = s.wall_chamfer;
  if (!(c.axial_mm > 0)) return 0;
  const double begins = s.wall_in_stock ? 0 : c.radial_mm + (c.round ? 0 : kAbove_mm);
  return edge_mm(s, corner_mm) - begins;
}

// Lengths in the cut are those of the chain: fed_mm counts them longer by the time that
// the rest takes.
Beside MachinedSurface::facing(const OperationModel& o, const Strokes& strokes) const {
  if (kind_ == Kind::inner_shoulder) return facing_inside(o, strokes);
  const double r = o.tool->re_mm, D_c = strokes.limited_mm, n = strokes.passes;
  const double small = D_small_ / 2, large = D_large_ / 2;
  const double stock_h = plan_->drawing.stock.outer_mm / 2;
  const bool end = kind_ == Kind::end_face;
  const double top = end ? D_large_ / 2 : top_mm_;
  const double to = end ? (small > 0 ? small - kBehind_mm : 0) - r : small;
  const double cut = swept_mm2(small, large, D_c);
  double fed = n * swept_mm2(to, top + kAbove_mm, D_c);
  Beside b;
  const double back =
      end ? stock_h + kClear_mm - to : stock_h + kClear_mm - small - kAbove_mm;
  b.rapid_mm = n * (stock_h + kClear_mm - top - kAbove_mm + kAbove_mm + back);
  b.from_mm = face_z_;
  b.to_mm = face_z_ + kAbove_mm;
  if (!end) {
    double out = o.ap.lower + around_.r_most - r, along = out;  // the smaller element
    fed -= (n - 1) * swept_mm2(small, small + kBehind_mm, D_c);
    fed += over_edge_mm(around_, r) *
           std::max(D_large_ - around_.wall_chamfer.radial_mm, D_c);
    if (around_.undercut) {
      const auto u = undercutting(*around_.undercut, r, out);
      fed -= swept_mm2(small, small + u.above_h, D_c);
      out = u.out_mm;
      along = u.along_mm;
    }
    fed += along * std::max(D_small_, D_c);
    b.to_mm += out;
  }
  b.fed_mm = n * (large - small) * fed / (n * cut);
  return b;
}

// From above the edge of the narrower bore out to the wider one, and along that.
Beside MachinedSurface::facing_inside(const OperationModel& o,
                                      const Strokes& strokes) const {
  const double r = o.tool->re_mm, D_c = strokes.limited_mm, n = strokes.passes;
  const double small = D_small_ / 2, large = D_large_ / 2;
  const double from = top_mm_ - kAboveBore_mm, out = o.ap.lower + around_.r_most - r;
  const double fed = n * swept_mm2(from, large, D_c) -
                     (n - 1) * swept_mm2(large - kBehind_mm, large, D_c) +
                     over_edge_mm(around_, r) *
                         std::max(D_small_ + around_.wall_chamfer.radial_mm, D_c) +
                     out * std::max(D_large_, D_c);
  Beside b;
  b.fed_mm = (large - small) * fed / swept_mm2(small, large, D_c);
  b.rapid_mm = n * (2 * (around_.front + kClear_mm - face_z_)) - out;
  b.from_mm = from;
  b.to_mm = large - kAboveBore_mm;
  b.rapid_mm += (n - 1) * (b.to_mm - b.from_mm);
  return b;
}

InOrder MachinedSurface::in_order(const catalogue::Tool& tool, bool rough) const {
  const bool alone = kind_ == Kind::end_face;
  InOrder o{tool.id, rough || alone ? Stage::roughing : Stage::finishing, alone,
            by_bar()};
  const auto b =
      kind_ == Kind::inner_shoulder
          ? Beside{0, 0, 0, top_mm_ - kAboveBore_mm, D_large_ / 2 - kAboveBore_mm}
      : is_face() ? Beside{0, 0, face_z_, face_z_ + kAbove_mm}
                  : beside(around_, {1, !rough, !rough, tool.re_mm,
                                     units::rad_from_deg(tool.minor_kapr_deg)});
  o.from_mm = b.from_mm;
  o.to_mm = b.to_mm;
  return o;
}

}  // namespace turnwright::planning
