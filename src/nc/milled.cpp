#include "milled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "planning/auxiliary/cross_holes.hpp"
#include "planning/auxiliary/milled_paths.hpp"
#include "turnwright/cutting/fixed.hpp"

namespace turnwright::nc {
namespace {

using planning::kApproach_mm;
using planning::kPlungeFeed;
using planning::kSlack_mm;
using planning::MilledKind;
using planning::OperationPlan;

const planning::MilledPlace& milled_place(const Site& site, const OperationPlan& o) {
  const auto& all = site.part.milled_places;
  const auto found = std::ranges::find(all, o.on[0], &planning::MilledPlace::id);
  if (found == all.end()) throw std::domain_error("nc: no milled place " + o.on[0]);
  return *found;
}

// A place in the program's coordinates, and the cutter in it.
struct Recess {
  MilledKind kind;
  double D, w;           // of the cutter and the place
  double high_z, low_z;  // ends of the place
  bool high_open, low_open;
  double top, depth;  // radius of the cylinder and depth of the floor below it
  int layers, lanes;

  double side() const { return kind == MilledKind::flat ? 0 : (w - D) / 2; }
  double lane_mm() const { return w / lanes; }
  double floor(int layer) const { return top - depth * layer / layers; }
  // The middle of the cutter at the ends of its way, and where it is clear of the part.
  double high() const { return high_open ? high_z + D / 2 : high_z - D / 2; }
  double low() const { return low_open ? low_z - D / 2 : low_z + D / 2; }
};

Recess recess_in(const Site& site, const OperationPlan& o) {
  const auto& m = milled_place(site, o);
  const auto cutter = std::ranges::find(m.cutters, o.tool, &catalogue::MillingCutter::id);
  if (cutter == m.cutters.end()) throw std::domain_error("nc: no cutter " + o.tool);
  const auto out =
      planning::run_out(site.part, site.setup, site.clamping, m, cutter->dc_mm);
  const double a = site.z(m.z_mm), b = site.z(m.z_mm + m.length_mm);
  const bool keyway = m.kind == MilledKind::keyway, left_high = a > b;
  return {.kind = m.kind,
          .D = cutter->dc_mm,
          .w = m.width_mm,
          .high_z = std::max(a, b),
          .low_z = std::min(a, b),
          .high_open = !keyway && (left_high ? out.left : out.right),
          .low_open = !keyway && (left_high ? out.right : out.left),
          .top = site.part.drawing.outer[m.element].left_mm / 2,
          .depth = m.depth_mm,
          .layers = static_cast<int>(o.passes.size()),
          .lanes = o.milled->lanes};
}

// Moves of the cutter beside the spindle's axis too.
class Cutter {
 public:
  Cutter(Site& site, double above) : site_(site), above_(above) {}

  void feed(double x, double y, double z, double share = 1) {
    site_.to(Move::Kind::feed, site_.outer, {x, z});
    end(y).feed_share = share;
  }
  /// From where it is to above a place.
  void come(double y, double z) {
    if (started_) {
      rapid(above_, y_, site_.at.z_mm);
      rapid(above_, y, z);
      return;
    }
    started_ = true;
    const auto first = site_.moves.size();
    site_.approach(site_.outer, {above_, z});
    for (auto k = first; k < site_.moves.size(); ++k) site_.moves[k].y_mm = y;
    y_ = y;
  }
  void rapid(double x, double y, double z) {
    if (site_.at.h_mm == x && y_ == y && site_.at.z_mm == z) return;
    site_.to(Move::Kind::rapid, site_.outer, {x, z});
    end(y);
  }
  /// Above the place, in the plane of the spindle's axis.
  void leave() {
    rapid(above_, y_, site_.at.z_mm);
    rapid(above_, 0, site_.at.z_mm);
  }
  double z() const { return site_.at.z_mm; }
  double above() const { return above_; }

 private:
  Move& end(double y) {
    site_.moves.back().y_mm = y_ = y;
    return site_.moves.back();
  }

  Site& site_;
  double above_, y_ = 0;
  bool started_ = false;
};

// Both sides of a place after its middle, from the end `from` of the lane to `to` and back:
// towards +Z at +Y, towards -Z at -Y.
void sides(Cutter& c, double x, double s, double from, double to) {
  if (s <= kSlack_mm) return;
  const double first = to > from ? s : -s;
  c.feed(x, first, from);
  c.feed(x, first, to);
  c.feed(x, -first, to);
  c.feed(x, -first, from);
  c.feed(x, 0, from);
}

// Down at the end where the layer before ended, along to the other end.
void closed(Cutter& c, const Recess& p) {
  c.come(0, p.high());
  c.feed(p.top, 0, p.high());
  for (int k = 1; k <= p.layers; ++k) {
    const double from = c.z(), to = from == p.high() ? p.low() : p.high();
    c.feed(p.floor(k), 0, from, kPlungeFeed);
    c.feed(p.floor(k), 0, to);
    sides(c, p.floor(k), p.side(), to, from);
  }
}

// In from outside, at an end that is open.
void open(Cutter& c, const Recess& p) {
  const double outside = p.high_open ? p.high() + kApproach_mm : p.low() - kApproach_mm;
  const double to = p.high_open ? p.low() : p.high();
  for (int k = 1; k <= p.layers; ++k) {
    c.come(0, outside);
    c.rapid(p.floor(k) + kAbove_mm, 0, outside);
    c.feed(p.floor(k), 0, outside);
    c.feed(p.floor(k), 0, to);
    sides(c, p.floor(k), p.side(), to, outside);
  }
}

// Lanes from the side at which the cutter, going along, has the material on its right.
void flat(Cutter& c, const Recess& p) {
  const bool down = p.high_open || !p.low_open;  // towards -Z
  const double side = down ? 1 : -1, ae = p.lane_mm();
  const bool from_side = !p.high_open && !p.low_open;
  const double begin = down ? p.high() + (p.high_open ? kApproach_mm : 0)
                            : p.low() - kApproach_mm,
               end = down ? p.low() : p.high();
  const double beside = std::max(p.D / 2, ae) + kApproach_mm;
  for (int k = 1; k <= p.layers; ++k)
    for (int lane = 1; lane <= p.lanes; ++lane) {
      const double y = side * (p.w / 2 - lane * ae + p.D / 2);
      const double y_in = from_side ? y + side * beside : y;
      c.come(y_in, begin);
      c.rapid(p.floor(k) + kAbove_mm, y_in, begin);
      c.feed(p.floor(k), y_in, begin);
      if (from_side) c.feed(p.floor(k), y, begin);
      c.feed(p.floor(k), y, end);
    }
}

// Down to the tip's depth and out, after every peck.
void drill(Cutter& c, const Site& site, const OperationPlan& o) {
  const auto& m = milled_place(site, o);
  const auto& tools = site.part.fixed_tools;
  const auto tool = std::ranges::find(tools, o.tool, &catalogue::FixedTool::id);
  if (tool == tools.end()) throw std::domain_error("nc: no drill " + o.tool);
  const double top = site.part.drawing.outer[m.element].left_mm / 2;
  const double z = site.z(m.z_mm + m.length_mm / 2);
  const double tip = planning::cross_hole_tip_mm(m, *tool);
  c.come(0, z);
  double reached = 0;
  for (const double to : cutting::peck_depths_mm(tool->pecking, m.width_mm, tip)) {
    if (reached > 0) c.rapid(top - reached + kPeck_mm, 0, z);
    c.feed(top - to, 0, z);
    c.rapid(c.above(), 0, z);
    reached = to;
  }
}

// Whether a cutter that goes down into solid material cuts over its centre.
bool plunges(const Site& site, const OperationPlan& o) {
  const auto& m = milled_place(site, o);
  if (m.kind == MilledKind::cross_hole) return true;
  const auto p = recess_in(site, o);
  return p.kind == MilledKind::flat || p.high_open || p.low_open ||
         std::ranges::find(m.cutters, o.tool, &catalogue::MillingCutter::id)
             ->centre_cutting;
}

double farthest_y_mm(const std::vector<Move>& moves) {
  double most = 0;
  for (const auto& m : moves) most = std::max(most, std::abs(m.y_mm));
  return most;
}

}  // namespace

std::string not_milled(const Site& site, const OperationPlan& o) {
  const auto& driven = *site.part.machine.driven_tools;
  if (!driven.c_axis) return "no axis C";
  const auto before = std::span(site.plan.setups).first(site.setup);
  const auto mills = [](const planning::SetupPlan& s) {
    return std::ranges::any_of(s.operations,
                               [](const auto& one) { return is_driven(one.kind); });
  };
  if (std::ranges::any_of(before, mills))
    return "its angle to what an earlier setup has milled is not known";
  const double y = farthest_y_mm(site.moves);
  if (y > driven.y_max_mm)
    return fmt::format(
        "the cutter would be {:.4g} mm beside the axis, the axis Y goes to "
        "{:.4g} mm",
        y, driven.y_max_mm);
  return plunges(site, o) ? "" : "the cutter does not cut over its centre";
}

Milling milling_of(const Site& site, const OperationPlan& o) {
  const double angle = site.sign * milled_place(site, o).angle_deg;
  const auto& pass = o.passes[0];
  return {.n_rpm = pass.n_rpm,
          .f_mm_min = pass.f_mm_rev * pass.n_rpm,
          .C_deg = std::fmod(std::fmod(angle, 360) + 360, 360),
          .needs_y = farthest_y_mm(site.moves) > 0};
}

void mill(Site& site, std::size_t operation) {
  const auto& o = site.answer().operations[operation];
  const auto& m = milled_place(site, o);
  Cutter c(site, site.part.drawing.outer[m.element].left_mm / 2 + kAbove_mm);
  if (m.kind == MilledKind::cross_hole) return drill(c, site, o);
  const auto p = recess_in(site, o);
  if (p.kind == MilledKind::flat)
    flat(c, p);
  else if (p.high_open || p.low_open)
    open(c, p);
  else
    closed(c, p);
  c.leave();
}

}  // namespace turnwright::nc
