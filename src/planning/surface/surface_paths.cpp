#include <algorithm>
#include <cmath>

#include "machined_surface.hpp"

namespace turnwright::planning {
namespace {

// Diameter inside which the spindle keeps its limit, at the middle of the speeds allowed.
double limited_mm(const OperationModel& o) {
  const double vc = std::sqrt(o.vc_window.lower * o.vc_window.upper);
  return 1000 * vc / (units::kPi * o.n_cap_rpm);
}

}  // namespace

Beside MachinedSurface::ways(const OperationModel& o, const Strokes& strokes) const {
  return is_face() ? facing(o, strokes.passes) : beside(around_, strokes);
}

// Lengths in the cut are those of the chain: fed_mm counts them longer by the time that
// the rest takes.
Beside MachinedSurface::facing(const OperationModel& o, int passes) const {
  const double r = o.tool->re_mm, D_c = limited_mm(o), n = passes;
  const double small = D_small_ / 2, large = D_large_ / 2;
  const double stock_h = plan_->drawing.stock.outer_mm / 2;
  const bool end = kind_ == Kind::end_face;
  const double top = end ? stock_h : top_h_;
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
    const double out = o.ap.lower + around_.r_most - r;  // along the smaller element
    fed -= (n - 1) * swept_mm2(small, small + kBehind_mm, D_c);
    fed += out * std::max(D_small_, D_c);
    b.to_mm += out;
  }
  b.fed_mm = n * (large - small) * fed / (n * cut);
  return b;
}

InOrder MachinedSurface::in_order(const catalogue::Tool& tool, bool rough) const {
  const bool alone = kind_ == Kind::end_face;
  InOrder o{tool.id, rough || alone ? Stage::roughing : Stage::finishing, alone,
            kind_ == Kind::bore};
  const auto b = is_face() ? Beside{0, 0, face_z_, face_z_ + kAbove_mm}
                           : beside(around_, {1, !rough, !rough, tool.re_mm,
                                              units::rad_from_deg(tool.minor_kapr_deg)});
  o.from_mm = b.from_mm;
  o.to_mm = b.to_mm;
  return o;
}

}  // namespace turnwright::planning
