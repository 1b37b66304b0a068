#include "contour_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using toolpath::Move;
using toolpath::Point;
using Kind = Move::Kind;

constexpr int kMostPasses = 500;
constexpr int kChordsOfArc = 24;
constexpr double kLevel_mm = 1e-6;

void add_points(const ReadMove& m, std::vector<Point>& all) {
  const auto& c = m.to.centre;
  if (m.to.kind == Kind::arc && m.from) {
    const double R = std::hypot(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
    const double a = std::atan2(m.from->h_mm - c.h_mm, m.from->z_mm - c.z_mm);
    const double b = std::atan2(m.to.x_mm - c.h_mm, m.to.z_mm - c.z_mm);
    const double turn = std::remainder(b - a, 2 * std::numbers::pi);
    for (int i = 1; i < kChordsOfArc; ++i) {
      const double t = a + turn * i / kChordsOfArc;
      all.push_back({c.h_mm + R * std::sin(t), c.z_mm + R * std::cos(t)});
    }
  }
  all.push_back({m.to.x_mm, m.to.z_mm});
}

// Its corners, from the end of its first block, with what is left on it.
std::vector<Point> points(const Contour& contour, const ContourCycle& cycle) {
  std::vector<Point> all;
  for (const auto& run : contour.runs)
    for (const auto& m : run.moves) add_points(m, all);
  for (auto& p : all) {
    p.h_mm += cycle.left_x_mm;
    p.z_mm += cycle.left_z_mm;
  }
  return all;
}

// Passes lie at levels of one axis and run along the other.
class Levels {
 public:
  Levels(ModalState& s, RoughingAlong along, const std::vector<Point>& contour)
      : s_(s), across_(along == RoughingAlong::x), contour_(contour) {
    const Point start{*s.x_mm, *s.z_mm};
    level_ = level(start);
    place_ = place(start);
    outwards_ = level(contour.front()) <= level_ ? 1 : -1;
    forwards_ = place(contour.back()) <= place_ ? -1 : 1;
  }

  bool steady() const {
    for (std::size_t i = 1; i < contour_.size(); ++i)
      if (outwards_ * (level(contour_[i]) - level(contour_[i - 1])) < -kLevel_mm ||
          forwards_ * (place(contour_[i]) - place(contour_[i - 1])) < -kLevel_mm)
        return false;
    return true;
  }

  /// Whether all passes of one depth, the largest not beyond the given one, were made.
  bool cut_evenly(double depth, double retract, bool corners) {
    const double top = level(contour_.back()), last = level(contour_.front());
    const double n = std::ceil(outwards_ * (top - last) / depth - kLevel_mm);
    if (!(n <= kMostPasses)) return false;
    double before = top;
    for (double k = 1; k <= n; ++k) {
      const double at = top - (top - last) * k / n;
      go(Kind::rapid, at, place_);
      go(Kind::feed, at, reached(at));
      if (corners) follow(at, before);
      const Point now{*s_.x_mm, *s_.z_mm};
      go(Kind::rapid, level(now) + outwards_ * retract, place(now) - forwards_ * retract);
      go(Kind::rapid, level(now) + outwards_ * retract, place_);
      before = at;
    }
    return true;
  }

  /// Whether all passes were made.
  bool cut(double depth, double retract) {
    const double last = level(contour_.front());
    for (int k = 1; k <= kMostPasses; ++k) {
      const double at = level_ - outwards_ * depth * k;
      if (!(outwards_ * (at - last) > kLevel_mm)) return true;
      const double to = reached(at), out = at + outwards_ * retract;
      go(Kind::rapid, at, place_);
      go(Kind::feed, at, to);
      go(Kind::feed, out, to - forwards_ * retract);
      go(Kind::rapid, out, place_);
    }
    return false;
  }
  void begin_contour() { go(Kind::rapid, level(contour_.front()), place_); }
  void back() {
    go(Kind::rapid, level_, place({*s_.x_mm, *s_.z_mm}));
    go(Kind::rapid, level_, place_);
  }

 private:
  double level(const Point& p) const { return across_ ? p.z_mm : p.h_mm; }
  double place(const Point& p) const { return across_ ? p.h_mm : p.z_mm; }
  void go(Kind kind, double level, double place) {
    across_ ? s_.straight(kind, place, level) : s_.straight(kind, level, place);
  }
  // Along the contour from one level to the next further out, or to its end.
  void follow(double from, double to) {
    std::size_t i = 1;
    while (i + 1 < contour_.size() && outwards_ * (level(contour_[i]) - from) < 0) ++i;
    const bool to_end = to == level(contour_.back());
    for (; i < contour_.size(); ++i) {
      const auto &a = contour_[i - 1], &b = contour_[i];
      if (!to_end && outwards_ * (level(b) - to) > -kLevel_mm) {
        const double u = (to - level(a)) / (level(b) - level(a));
        return go(Kind::feed, to, std::lerp(place(a), place(b), std::clamp(u, 0.0, 1.0)));
      }
      if (b.h_mm != *s_.x_mm || b.z_mm != *s_.z_mm) go(Kind::feed, level(b), place(b));
    }
  }
  // Where the contour reaches a level, seen from its beginning.
  double reached(double at) const {
    for (std::size_t i = 1; i < contour_.size(); ++i) {
      const auto &a = contour_[i - 1], &b = contour_[i];
      if (outwards_ * (level(b) - at) < 0) continue;
      const double rise = level(b) - level(a);
      const double u = std::abs(rise) > kLevel_mm ? (at - level(a)) / rise : 0;
      return std::lerp(place(a), place(b), std::clamp(u, 0.0, 1.0));
    }
    return place(contour_.back());
  }

  ModalState& s_;
  bool across_;
  const std::vector<Point>& contour_;
  double level_ = 0, place_ = 0, outwards_ = 1, forwards_ = -1;
};

// A contour moved away from the part by a distance, whose corners stay corners.  Out is to
// the side of the point.
std::vector<Point> beside(const std::vector<Point>& contour, double away, double side) {
  const auto normal = [&](std::size_t i) {
    const double h = contour[i + 1].h_mm - contour[i].h_mm;
    const double z = contour[i + 1].z_mm - contour[i].z_mm;
    const double length = std::hypot(h, z);
    return length > 0 ? Point{-side * z / length, side * h / length} : Point{0, 0};
  };
  auto all = contour;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const auto a = normal(i > 0 ? i - 1 : 0);
    const auto b = normal(std::min(i, contour.size() - 2));
    const double share = away / (1 + a.h_mm * b.h_mm + a.z_mm * b.z_mm);
    all[i].h_mm += share * (a.h_mm + b.h_mm);
    all[i].z_mm += share * (a.z_mm + b.z_mm);
  }
  return all;
}

void shift(toolpath::Move& m, double dx, double dz) {
  m.x_mm += dx;
  m.z_mm += dz;
  m.centre.h_mm += dx;
  m.centre.z_mm += dz;
}

}  // namespace

void along(ModalState& s, const Contour& contour, double dx, double dz) {
  for (const auto& run : contour.runs)
    for (auto m : run.moves) {
      if (m.to.kind == Kind::rapid) m.to.kind = Kind::feed;
      shift(m.to, dx, dz);
      s.to(m.to);
    }
}

void rough(ModalState& s, const Contour& contour, const ContourCycle& cycle,
           RoughingAlong direction) {
  const auto all = points(contour, cycle);
  if (!s.x_mm || !s.z_mm || all.size() < 2 || !(cycle.depth_mm > 0))
    return s.unknown(cycle.name,
                     tr("Its contour, its depth or the tool's place is not known."));
  Levels levels(s, direction, all);
  if (!levels.steady())
    return s.unknown(cycle.name,
                     tr("Only contours that go one way in X and in Z are followed."));
  if (!levels.cut(cycle.depth_mm, cycle.retract_mm))
    s.unknown(cycle.name, tr("It has more than 500 passes."));
  levels.begin_contour();
  along(s, contour, cycle.left_x_mm, cycle.left_z_mm);
  if (cycle.comes_back) levels.back();
}

void remove_stock(ModalState& s, const Contour& contour, const StockRemoval& c,
                  RoughingAlong direction) {
  auto all = points(contour, {.left_x_mm = 0});
  std::erase_if(all, [before = std::optional<Point>()](const Point& p) mutable {
    const auto last = std::exchange(before, p);
    return last && std::hypot(p.h_mm - last->h_mm, p.z_mm - last->z_mm) < kLevel_mm;
  });
  const auto lost = [&s](const std::string& why) {
    s.unknown("CYCLE95", why);
    s.lose_place();
  };
  if (all.size() < 2 || !(c.retract_mm >= 0) || (c.roughs && !(c.depth_mm > 0)))
    return lost(tr("Its contour or its depth is not known."));
  const double outwards = c.inside ? -1 : 1;
  const bool along_x = direction == RoughingAlong::x;
  const double forwards = all.back().z_mm < all.front().z_mm ? -1 : 1;
  const double away_z = along_x ? forwards : -forwards;
  if ((along_x ? -1 : 1) * outwards * (all.back().h_mm - all.front().h_mm) < 0)
    return lost(tr("Its contour goes the other way than its kind."));
  // With X up and Z to the right the tool is to the right of an outer contour that goes left.
  const double side = outwards * forwards;
  if (c.left_mm > 0) all = beside(all, c.left_mm, -side);
  for (auto& p : all) {
    p.h_mm += outwards * c.left_x_mm;
    p.z_mm += away_z * c.left_z_mm;
  }
  const double F = s.F;
  const auto F_line = s.F_line;
  const auto feed = [&s](double given) {
    if (given > 0) s.F = given, s.F_line = 0;  // no word F of the program
  };
  const double x0 = (along_x ? all.front() : all.back()).h_mm + outwards * c.retract_mm;
  const double z0 = (along_x ? all.back() : all.front()).z_mm + away_z * c.retract_mm;
  s.straight(Kind::rapid, x0, z0);
  if (c.roughs) {
    feed(c.rough_feed);
    Levels levels(s, direction, all);
    if (!levels.steady())
      return lost(tr("Only contours that go one way in X and in Z are followed."));
    if (!levels.cut_evenly(c.depth_mm, c.retract_mm, c.corners))
      return lost(tr("It has more than 500 passes."));
    levels.back();
  }
  s.F = F;
  s.F_line = F_line;
  if (!c.finishes) return;
  const auto nose = s.nose;
  along_x ? s.straight(Kind::rapid, x0, all.front().z_mm)
          : s.straight(Kind::rapid, all.front().h_mm, z0);
  s.nose = {side > 0 ? NoseSide::left : NoseSide::right, 0};
  for (const auto& run : contour.runs)
    for (auto m : run.moves) {
      if (m.words.F_line > 0 && s.per_revolution)
        s.F = run.step.f_mm_rev, s.F_line = m.words.F_line;
      feed(c.finish_feed);
      if (m.to.kind == Kind::rapid) m.to.kind = Kind::feed;
      s.to(m.to);
    }
  s.nose = nose;
  s.F = F;
  s.F_line = F_line;
  along_x ? s.straight(Kind::rapid, *s.x_mm, z0) : s.straight(Kind::rapid, x0, *s.z_mm);
  s.straight(Kind::rapid, x0, z0);
}

void repeat_pattern(ModalState& s, const Contour& contour, const ContourCycle& cycle) {
  const auto all = points(contour, cycle);
  if (!s.x_mm || !s.z_mm || all.size() < 2 || !(cycle.passes >= 1))
    return s.unknown("G73",
                     tr("Its contour, its passes or the tool's place is not known."));
  if (!(cycle.passes <= kMostPasses))
    return s.unknown("G73", tr("It has more than 500 passes."));
  const double x0 = *s.x_mm, z0 = *s.z_mm;
  const double n = std::floor(cycle.passes);
  for (double pass = 1; pass <= n; ++pass) {
    const double share = n > 1 ? (n - pass) / (n - 1) : 0;
    const double dx = share * cycle.shift_x_mm, dz = share * cycle.shift_z_mm;
    s.straight(Kind::rapid, x0 + dx, z0 + dz);
    s.straight(Kind::rapid, all.front().h_mm + dx, all.front().z_mm + dz);
    along(s, contour, cycle.left_x_mm + dx, cycle.left_z_mm + dz);
    s.straight(Kind::rapid, x0 + dx, *s.z_mm);
    s.straight(Kind::rapid, x0 + dx, z0 + dz);
  }
}

void follow_contour(ModalState& s, const Contour& contour, double dx, double dz) {
  const double F = s.F;
  const auto F_line = s.F_line;
  const auto nose = s.nose;
  for (const auto& run : contour.runs) {
    const bool own = run.step.f_mm_rev > 0 && s.per_revolution;
    if (own) s.F = run.step.f_mm_rev;
    for (auto m : run.moves) {
      if (own) s.F_line = m.words.F_line;
      s.nose = m.nose;
      shift(m.to, dx, dz);
      s.to(m.to);
    }
  }
  s.nose = nose;
  s.F = F;
  s.F_line = F_line;
}

void finish(ModalState& s, const Contour& contour) {
  if (!s.x_mm || !s.z_mm)
    return s.unknown(tr("G70 from a place that is not known"),
                     tr("X or Z was not given before it."));
  const double x0 = *s.x_mm, z0 = *s.z_mm;
  follow_contour(s, contour, 0, 0);
  s.straight(Kind::rapid, x0, *s.z_mm);
  s.straight(Kind::rapid, x0, z0);
}

void ContourCycleReader::set(const ModalState& s, int code, const Block& block) {
  const auto length = [&](const char* name) {
    return s.mm(block.value(name).value_or(0));
  };
  if (code == 73) {
    cycle_.shift_x_mm = length("U");
    cycle_.shift_z_mm = length("W");
    cycle_.passes = block.value("R").value_or(0);
    return;
  }
  cycle_.depth_mm = length(code == 71 ? "U" : "W");
  cycle_.retract_mm = length("R");
}

std::optional<double> ContourCycleReader::take(ModalState& s, gcode::Control control,
                                               int code, const Block& block,
                                               const Between& between) {
  const auto P = block.value("P"), Q = block.value("Q");
  if (!P || !Q) {
    set(s, code, block);
    return std::nullopt;
  }
  const auto contour = between(*P, *Q);
  if (!contour) {
    s.unknown(fmt::format("P{:g} Q{:g}", *P, *Q),
              tr("There are no such blocks in the program, or they call others."));
    s.lose_place();
    return std::nullopt;
  }
  if (code == 70) return finish(s, *contour), std::nullopt;
  const auto* D = block.find("D");
  if (code == 73) {
    if (D) cycle_.passes = *D->value;
    if (const auto I = block.value("I")) cycle_.shift_x_mm = s.mm(*I);
    if (const auto K = block.value("K")) cycle_.shift_z_mm = s.mm(*K);
  } else if (D) {
    cycle_.depth_mm = control == gcode::Control::haas ? s.mm(*D->value)
                                                      : s.steps_mm(*D->value, D->point);
  }
  cycle_.name = code == 71 ? "G71" : "G72";
  cycle_.left_x_mm = s.mm(block.value("U").value_or(0)) / 2;
  cycle_.left_z_mm = s.mm(block.value("W").value_or(0));
  // Controls rough without compensation.
  const auto nose = std::exchange(s.nose, {});
  if (code == 73)
    repeat_pattern(s, *contour, cycle_);
  else
    rough(s, *contour, cycle_, code == 71 ? RoughingAlong::z : RoughingAlong::x);
  s.nose = nose;
  return Q;
}

}  // namespace turnwright::review
