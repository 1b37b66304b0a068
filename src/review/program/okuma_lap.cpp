#include "okuma_lap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using toolpath::Point;
using Kind = toolpath::Move::Kind;

constexpr double kClearance_mm = 0.5;  // LAP's, a parameter of the control
constexpr double kMostLapPasses = 500;

void copy_turn(ModalState& s, const Contour& contour, const ContourCycle& c,
               RoughingAlong direction) {
  const bool across = direction == RoughingAlong::x;
  const Point start{*s.x_mm, *s.z_mm};
  const auto& first = contour.runs.front().moves.front().to;
  const Point last{first.x_mm + c.left_x_mm, first.z_mm + c.left_z_mm};
  const double whole = across ? start.z_mm - last.z_mm : start.h_mm - last.h_mm;
  const double n = std::ceil(std::abs(whole) / c.depth_mm - 1e-9);
  if (!(n <= kMostLapPasses)) return s.unknown("G86", tr("It has more than 500 passes."));
  for (double pass = 1; pass <= std::max(n, 1.0); ++pass) {
    // Eq. (1): what is left of the way along both axes.
    const double share = pass < n ? 1 - pass * c.depth_mm / std::abs(whole) : 0;
    const double dx = share * (start.h_mm - last.h_mm),
                 dz = share * (start.z_mm - last.z_mm);
    along(s, contour, c.left_x_mm + dx, c.left_z_mm + dz);
    if (pass < n) s.straight(Kind::rapid, s.x_mm, start.z_mm);
  }
}

}  // namespace

void lap_cycle(ModalState& s, int code, const Block& block, const Contour& contour,
               RoughingAlong direction) {
  const auto value = [&](const char* name) {
    return s.mm(block.value(name).value_or(0));
  };
  if (!s.x_mm || !s.z_mm || contour.runs.empty() || contour.runs.front().moves.empty())
    return s.unknown(tr("a LAP cycle"),
                     tr("Its contour or the tool's place is not known."));
  const Point start{*s.x_mm, *s.z_mm};
  ContourCycle c{.name = code == 85 ? "G85" : "G86",
                 .depth_mm = value("D") / (direction == RoughingAlong::z ? 2 : 1),
                 .retract_mm = kClearance_mm,
                 .left_x_mm = value("U") / 2,
                 .left_z_mm = value("W"),
                 .comes_back = false};
  if (code != 87 && !(c.depth_mm > 0))
    return s.unknown(c.name, tr("Its depth D is missing."));
  const auto nose = s.nose;
  if (code != 87) s.nose = {};  // roughing
  if (code == 85) {
    s.assume(tr("The clearance of LAP is a parameter of the control, here 0.5 mm."));
    rough(s, contour, c, direction);
  } else if (code == 86) {
    copy_turn(s, contour, c, direction);
  } else {
    follow_contour(s, contour, c.left_x_mm, c.left_z_mm);
  }
  s.nose = nose;
  for (const auto& w : block.words)
    if (w.name == "M" && w.value == 85) return;
  s.straight(Kind::rapid, s.x_mm, start.z_mm);
  s.straight(Kind::rapid, start.h_mm, s.z_mm);
}

}  // namespace turnwright::review
