#include "cycles.hpp"

#include <algorithm>
#include <cmath>

#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using Kind = toolpath::Move::Kind;

constexpr int kMostCuts = 200;
constexpr double kRounding_mm = 1e-6;

}  // namespace

void box_cycle(ModalState& s, Box box, double x, double z, double lead_mm) {
  if (!s.x_mm || !s.z_mm)
    return s.unknown(tr("a cycle from a place that is not known"),
                     tr("X or Z was not given before it."));
  const double x0 = *s.x_mm, z0 = *s.z_mm;
  switch (box) {
    case Box::turning:
      s.straight(Kind::rapid, x, z0);
      s.straight(Kind::feed, x, z);
      s.straight(Kind::feed, x0, z);
      break;
    case Box::facing:
      s.straight(Kind::rapid, x0, z);
      s.straight(Kind::feed, x, z);
      s.straight(Kind::feed, x, z0);
      break;
    case Box::threading:
      s.straight(Kind::rapid, x, z0);
      s.thread(x, z, lead_mm);
      s.straight(Kind::rapid, x0, z);
      break;
  }
  s.straight(Kind::rapid, x0, z0);
}

void tap_cycle(ModalState& s, double from_z, double to_z, double lead_mm) {
  if (!s.x_mm || !s.z_mm || *s.x_mm != 0 || !(lead_mm > 0))
    return s.unknown(
        tr("a tap that is not followed"),
        tr("X or Z was not given before it, X is not 0, or the lead is missing."));
  const double z0 = *s.z_mm;
  s.straight(Kind::rapid, 0, from_z);
  s.thread(0, to_z, lead_mm);
  s.thread(0, from_z, lead_mm);
  s.straight(Kind::rapid, 0, z0);
}

std::vector<double> strokes(double from_z_mm, double bottom_z_mm, double first_mm,
                            const std::function<double(double)>& next) {
  std::vector<double> ends;
  const double way = bottom_z_mm - from_z_mm, depth = std::abs(way);
  double at = 0;
  for (double stroke = first_mm; at < depth - kRounding_mm; stroke = next(stroke)) {
    if (!(stroke > kRounding_mm) || ends.size() >= kMostCuts) return {};
    at = std::min(depth, at + stroke);
    ends.push_back(from_z_mm + std::copysign(at, way));
  }
  if (!ends.empty()) ends.back() = bottom_z_mm;
  return ends;
}

void drill_cycle(ModalState& s, const DrillCycle& c) {
  if (!s.x_mm || (*s.x_mm != 0 && !s.milling.on) || c.strokes_z_mm.empty())
    return s.lose_place(),
           s.unknown(
               tr("a drilling cycle"),
               tr("X is not known or not 0, or its depth or strokes are not given."));
  const double outwards = c.from_z_mm > c.strokes_z_mm.back() ? 1 : -1;
  s.straight(Kind::rapid, s.x_mm, c.from_z_mm);
  const double F = s.F;
  std::optional<double> reached;
  for (const double z : c.strokes_z_mm) {
    if (reached && c.clears) {
      s.straight(Kind::rapid, s.x_mm, c.from_z_mm);
      s.dwell(c.wait_top_min);
    }
    const double back = c.clears ? c.before_mm : c.retract_mm;
    const double room = reached ? std::abs(c.from_z_mm - *reached) : 0;
    if (reached)
      s.straight(Kind::rapid, s.x_mm, *reached + outwards * std::min(back, room));
    s.F = reached ? F : F * c.first_feed_share;
    s.straight(Kind::feed, s.x_mm, z);
    s.dwell(c.wait_bottom_min);
    reached = z;
  }
  if (c.feed_out > 0) {
    s.F = c.feed_out;
    s.straight(Kind::feed, s.x_mm, c.feeds_away ? c.away_z_mm : c.from_z_mm);
  }
  s.F = F;
  if (!c.feeds_away) s.straight(Kind::rapid, s.x_mm, c.away_z_mm);
}

void thread_cycle(ModalState& s, const ThreadCycle& c) {
  const double depth = std::abs(c.end_x_mm - c.outside_mm);
  if (!(depth > 0 && c.first_mm > 0 && c.degression >= 1 && c.lead_mm > 0) || !s.x_mm)
    return s.unknown("G76", tr("Depth, first infeed or lead is missing."));
  const auto left = [depth](double cut_mm) { return cut_mm < depth - kRounding_mm; };
  const double inwards = c.end_x_mm < c.outside_mm ? -1 : 1;
  double cut = 0;
  int springs = c.spring_cuts;
  for (int k = 1; k <= kMostCuts && (left(cut) || springs-- > 0); ++k) {
    const double wanted = c.first_mm * std::pow(k, 1 / c.degression);  // Eq. (1)
    cut = std::min(depth, std::max(wanted, cut + c.least_mm));
    box_cycle(s, Box::threading, c.outside_mm + inwards * cut, c.end_z_mm, c.lead_mm);
  }
  if (left(cut))
    s.unknown("G76", tr("It has more than 200 cuts; only these are followed."));
}

void ThreadCycleReader::take(ModalState& s, gcode::Control control, const Block& block) {
  if (!s.x_mm || !s.z_mm)
    return s.unknown(tr("G76 from a place that is not known"),
                     tr("X or Z was not given before it."));
  if (control == gcode::Control::linuxcnc) return linuxcnc(s, block);
  if (control == gcode::Control::haas) return haas(s, block);
  fanuc(s, block);
}

void ThreadCycleReader::linuxcnc(ModalState& s, const Block& block) {
  const double half = s.diameter ? 0.5 : 1;
  const auto length = [&](const char* name) {
    return s.mm(block.value(name).value_or(0));
  };
  ThreadCycle c;
  c.outside_mm = *s.x_mm + half * length("I");
  // An outer thread lies inside the drive line, I < 0, and is cut towards the axis.
  c.end_x_mm = c.outside_mm + (length("I") > 0 ? 1 : -1) * half * length("K");
  c.end_z_mm = s.incremental ? *s.z_mm + length("Z") : length("Z");
  c.first_mm = half * length("J");
  c.degression = block.value("R").value_or(1);
  c.spring_cuts = static_cast<int>(std::clamp(block.value("H").value_or(0), 0.0, 99.0));
  c.lead_mm = length("P");
  if (block.value("E").value_or(0) > 0 && block.value("L").value_or(0) > 0)
    s.assume(tr("Tapered ends of threads (E and L of G76) are taken as straight."));
  thread_cycle(s, c);
}

void ThreadCycleReader::fanuc(ModalState& s, const Block& block) {
  const auto X = block.value("X"), Z = block.value("Z");
  if (!X && !Z) {
    least_mm_ = block.value("Q").value_or(0) / 1000;
    return;
  }
  if (!X || !Z || block.value("R").value_or(0) != 0)
    return s.unknown("G76", tr("Only straight threads with X and Z are followed."));
  ThreadCycle c;
  c.end_x_mm = s.mm(*X) / 2;
  c.end_z_mm = s.mm(*Z);
  const double depth = block.value("P").value_or(0) / 1000;
  c.outside_mm = c.end_x_mm + (c.end_x_mm < *s.x_mm ? depth : -depth);
  c.first_mm = block.value("Q").value_or(0) / 1000;
  c.least_mm = least_mm_;
  c.lead_mm = s.mm(block.value("F").value_or(0));
  thread_cycle(s, c);
}

void ThreadCycleReader::haas(ModalState& s, const Block& block) {
  const auto X = block.value("X"), Z = block.value("Z");
  if (!X || !Z || block.value("I").value_or(0) != 0)
    return s.unknown("G76", tr("Only straight threads with X and Z are followed."));
  ThreadCycle c;
  c.end_x_mm = s.mm(*X) / 2;
  c.end_z_mm = s.mm(*Z);
  const double depth = s.mm(block.value("K").value_or(0));
  c.outside_mm = c.end_x_mm + (c.end_x_mm < *s.x_mm ? depth : -depth);
  c.first_mm = s.mm(block.value("D").value_or(0));
  c.lead_mm = s.mm(block.value("F").value_or(0));
  thread_cycle(s, c);
}

void peck_cycle(ModalState& s, const PeckCycle& c) {
  if (!s.x_mm || !s.z_mm)
    return s.unknown(tr("a cycle from a place that is not known"),
                     tr("X or Z was not given before it."));
  // Along: the axis of the pecks.  Across: that of their places.
  const double x0 = *s.x_mm, z0 = *s.z_mm;
  const double along0 = c.along_x ? x0 : z0, across0 = c.along_x ? z0 : x0;
  const double along1 = c.along_x ? c.to_x_mm : c.to_z_mm;
  const double across1 = c.along_x ? c.to_z_mm : c.to_x_mm;
  const double deeper = along1 < along0 ? -1 : 1, further = across1 < across0 ? -1 : 1;
  const double depth = std::abs(along1 - along0), width = std::abs(across1 - across0);
  const double peck = c.peck_mm > 0 ? c.peck_mm : depth;
  const double shift = c.shift_mm > 0 ? c.shift_mm : width;
  const auto go = [&](Kind kind, double along, double across) {
    c.along_x ? s.straight(kind, along, across) : s.straight(kind, across, along);
  };
  if (!(depth > 0 && depth <= kMostCuts * peck && width <= kMostCuts * shift))
    return s.unknown(tr("a cycle of pecks"),
                     tr("It has no depth, or more than 200 pecks or places."));
  for (double at = 0; !s.full(); at = std::min(at + shift, width)) {
    const double across = across0 + further * at;
    go(Kind::rapid, along0, across);
    for (double cut = std::min(peck, depth);; cut = std::min(cut + peck, depth)) {
      go(Kind::feed, along0 + deeper * cut, across);
      if (!(cut < depth - kRounding_mm)) break;
      go(Kind::rapid, along0 + deeper * (cut - c.retract_mm), across);
    }
    if (c.relief_mm > 0) go(Kind::rapid, along1, across - further * c.relief_mm);
    go(Kind::rapid, along0, across - (c.relief_mm > 0 ? further * c.relief_mm : 0));
    if (!(at < width - kRounding_mm)) break;
  }
  s.straight(Kind::rapid, x0, z0);
}

void PeckCycleReader::take(ModalState& s, int code, const Block& block) {
  const bool along_x = code == 75;
  const auto end = [&](const char* absolute, const char* incremental, double now,
                       double scale) {
    if (const auto v = block.value(absolute)) return s.mm(*v) * scale;
    return now + s.mm(block.value(incremental).value_or(0)) * scale;
  };
  const auto increment = [&](const char* steps, const char* length) {
    if (const auto v = block.value(length)) return std::abs(s.mm(*v));
    const auto* w = block.find(steps);
    return w ? std::abs(s.steps_mm(*w->value, w->point)) : 0;
  };
  const bool ends =
      block.find("X") || block.find("Z") || block.find("U") || block.find("W");
  if (!ends) {
    retract_mm_ = std::abs(s.mm(block.value("R").value_or(0)));
    return;
  }
  PeckCycle c;
  c.along_x = along_x;
  c.to_x_mm = end("X", "U", s.x_mm.value_or(0), s.diameter ? 0.5 : 1);
  c.to_z_mm = end("Z", "W", s.z_mm.value_or(0), 1);
  const double in_x = increment("P", "I"), in_z = increment("Q", "K");
  c.peck_mm = along_x ? in_x : in_z;
  c.shift_mm = along_x ? in_z : in_x;
  c.retract_mm = retract_mm_;
  const char* relief = block.find("D") ? "D" : "R";
  c.relief_mm = std::abs(s.mm(block.value(relief).value_or(0)));
  peck_cycle(s, c);
}

}  // namespace turnwright::review
