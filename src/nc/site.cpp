#include "site.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planning/paths/edges.hpp"
#include "planning/paths/programmed_faces.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::nc {

using planning::SetupWork;

double moved_mm(const Site& site, const std::string& surface) {
  const double to_middle = planning::to_middle_mm(site.part.drawing, surface);
  for (const auto& o : site.plan.offsets)
    if (o.on == surface) return o.offset_mm + to_middle;
  return to_middle;
}

double middle_h(const part::Drawing& drawing, const Side& side, const Surface& s) {
  return side.sign * planning::to_middle_mm(drawing, s.id);
}

double Side::top(const Surface& s) const { return std::max(top0(s), top1(s)); }

double Side::highest(double from_z, double to_z) const {
  double h = -INFINITY;
  for (const auto& s : items)
    if (s.z0 > from_z && s.z1 < to_z) h = std::max(h, top(s));
  return h;
}

Site::Site(const planning::PreparedPart& part_, const planning::ProcessPlan& plan_,
           std::size_t setup_)
    : part(part_),
      plan(plan_),
      setup(setup_),
      clamping(plan_.setups[setup_].clamping),
      sign(part_.setups[setup_].hold == part::End::left ? 1 : -1),
      free_z(planning::free_z_mm(part_, setup_)),
      root_z(sign * (planning::root_z_mm(part_, setup_, clamping) - free_z)) {
  const auto& stock = part.drawing.stock;
  for (const auto& t : part.tools) r_most = std::max(r_most, t.re_mm);
  outer = {1, stock.outer_mm / 2, {}};
  inner = {-1, -stock.inner_mm / 2, {}};
  const auto& work = part.work.setups;
  auto finished = planning::nothing_finished(part.drawing);
  bool faced = false;
  for (std::size_t k = 0; k < setup; ++k) {
    planning::finish(finished, work[k]);
    faced = faced || (work[k].end_face && part.setups[k].hold == part.setups[setup].hold);
  }
  if (!faced)
    front = planning::face_stock_mm(part, sign > 0 ? part::End::right : part::End::left);
  const auto moved = planning::faces_moved_mm(part.drawing);
  const auto stock_h = [&](bool bore, std::size_t i) {
    return bore ? 0 : part::stock_of(part.drawing, i).most_mm / 2;
  };
  const auto add = [&](Side& side, const auto& elements, const auto& left_z,
                       const std::vector<bool>& done, bool bore) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto& e = elements[i];
      const auto by = [&](part::End end) {
        return planning::end_moved_mm(moved, part.drawing, {bore, i}, end);
      };
      const double moves_a = by(part::End::left), moves_b = by(part::End::right);
      const double a = z(left_z(i) + moves_a), b = z(left_z(i) + e.length_mm + moves_b);
      // A cone stays where it is drawn and ends at the displaced face.
      const double rises = side.sign * (e.right_mm - e.left_mm) / 2 / e.length_mm;
      const double ra = side.sign * e.left_mm / 2 + rises * moves_a,
                   rb = side.sign * e.right_mm / 2 + rises * moves_b;
      const auto left = planning::turned(e.left_chamfer),
                 right = planning::turned(e.right_chamfer);
      side.items.push_back(a > b ? Surface{e.id, bore, i, a, ra, b, rb, !done[i],
                                           stock_h(bore, i), 0, left, right}
                                 : Surface{e.id, bore, i, b, rb, a, ra, !done[i],
                                           stock_h(bore, i), 0, right, left});
      if constexpr (requires { e.left_undercut; })
        (planning::faces_behind(part, setup, work[setup], {bore, i})
             ? side.items.back().faced_undercut
             : side.items.back().undercut) =
            planning::undercut_behind(part, setup, {bore, i});
      auto& s = side.items.back();
      if (!done[i]) continue;
      s.finished = true;
      s.left = middle_h(part.drawing, side, s);
      if (part::is_groove(e)) s.h0 = s.h1 = side.sign * e.cut->core.left_mm / 2;
    }
    std::sort(side.items.begin(), side.items.end(),
              [](const Surface& x, const Surface& y) { return x.z0 > y.z0; });
  };
  const auto& d = part.drawing;
  add(
      outer, d.outer, [&](std::size_t i) { return part::left_z_mm(d, i); },
      finished.outer, false);
  add(
      inner, d.inner, [&](std::size_t i) { return part::inner_left_z_mm(d, i); },
      finished.inner, true);
  at = {outer.stock_h + kChange_mm, front + kChange_mm};
}

void Site::add(const Move& move) {
  leave_if_asked();
  if (++moved_ > kMostMoves) throw TooManyMoves();
  moves.push_back(move);
}

void Site::rapid(double x, double z_) {
  if (x == at.h_mm && z_ == at.z_mm) return;
  add({Move::Kind::rapid, x, z_, {}, false});
  at = {x, z_};
}

void Site::refuse(const std::string& operation, const std::string& why) {
  cannot.push_back(planning::setup_label(setup) + ", " + operation + ": " + why);
}

void Site::to(Move::Kind kind, const Side& side, const Point& p) {
  add({kind, side.sign * p.h_mm, p.z_mm, {}, false});
  at = {side.sign * p.h_mm, p.z_mm};
}

void Site::arc(const Side& side, const Point& end, const Point& centre, bool convex,
               bool inwards) {
  const bool clockwise = (convex != inwards) == (side.sign > 0);
  add({Move::Kind::arc,
       side.sign * end.h_mm,
       end.z_mm,
       {side.sign * centre.h_mm, centre.z_mm},
       clockwise});
  at = {side.sign * end.h_mm, end.z_mm};
}

void Site::approach(const Side& side, const Point& p, double re_mm) {
  const double to_z = side.sign > 0 ? p.z_mm + 2 * re_mm : INFINITY;
  const double stands = std::max(side.highest(p.z_mm, to_z), p.h_mm);
  approach(side, {stands + above(side), p.z_mm});
  to(Move::Kind::feed, side, p);
}

void Site::approach_level(const Side& side, const Point& p) {
  approach(side, {p.h_mm + above(side), p.z_mm});
  to(Move::Kind::feed, side, p);
}

void Site::approach(const Side& side, const Point& p, const Point& next, double re_mm) {
  const double stands = side.highest(p.z_mm, p.z_mm + 2 * re_mm);
  if (p.h_mm < std::max(stands, next.h_mm) + above(side) / 2)
    approach(side, p, re_mm);
  else
    approach(side, p);
}

void Site::approach(const Side& side, const Point& p) {
  const double x = side.sign * p.h_mm;
  if (side.sign > 0) {
    rapid(std::max(at.h_mm, outer.stock_h + kClear_mm), at.z_mm);
    rapid(at.h_mm, p.z_mm);
    rapid(x, p.z_mm);
  } else {
    clear_bore();
    rapid(at.h_mm, std::max(at.z_mm, front + kClear_mm));
    rapid(x, at.z_mm);
    rapid(x, p.z_mm);
  }
}

void Site::clear_bore() {
  const double h = inner.highest(at.z_mm, INFINITY) + kAboveBore_mm;
  if (-at.h_mm < h - kSame_mm) rapid(-h, at.z_mm);
}

void Site::lift(const Side& side) {
  rapid(at.h_mm + side.sign * above(side), at.z_mm + above(side));
}

const Surface& surface_of(const Site& site, const std::string& id) {
  for (const Side* side : {&site.outer, &site.inner})
    for (const auto& s : side->items)
      if (s.id == id) return s;
  throw std::domain_error("nc: no element " + id);
}

void Site::home(bool from_bore) {
  const double x = outer.stock_h + kChange_mm, z_ = front + kChange_mm;
  if (from_bore) {
    clear_bore();
    rapid(at.h_mm, z_);
    rapid(x, z_);
  } else {
    rapid(x, at.z_mm);
    rapid(x, z_);
  }
}

}  // namespace turnwright::nc
