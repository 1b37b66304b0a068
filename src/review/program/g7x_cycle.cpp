#include "g7x_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "parameters.hpp"
#include "plane.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::review {
namespace {

using toolpath::Move;
using toolpath::Point;
using Kind = Move::Kind;

constexpr double kMeets_mm = 1e-6;
constexpr double kMostG7xPasses = 500;

// A straight line or an arc of the contour.
struct Way {
  Point from, to;
  bool arc = false;
  Point centre = {};
  bool clockwise = false;
};

double radius(const Way& w) { return length(between(w.centre, w.from)); }

Point direction(const Way& w, bool at_end) {
  if (!w.arc) return unit(between(w.from, w.to));
  const auto across = to_the_right(unit(between(w.centre, at_end ? w.to : w.from)));
  return w.clockwise ? across : plus({}, across, -1);
}

// Moved to its left by a distance.
Way beside_of(const Way& w, double left_mm) {
  Way out = w;
  out.from = plus(w.from, to_the_right(direction(w, false)), -left_mm);
  out.to = plus(w.to, to_the_right(direction(w, true)), -left_mm);
  if (w.arc && !(radius(w) + (w.clockwise ? left_mm : -left_mm) > kMeets_mm))
    throw NotFollowed(tr("An arc of the contour is smaller than what is left on it."));
  return out;
}

// Where two ways that cross in an inner corner meet, of which one at least is straight.
Point meeting(const Way& a, const Way& b) {
  const auto& line = a.arc ? b : a;
  const auto& other = a.arc ? a : b;
  if (line.arc)
    throw NotFollowed(tr("An inner corner between two arcs is not followed."));
  const auto d = direction(line, false);
  if (!other.arc) {
    const auto e = direction(other, false);
    return plus(line.from, d, cross(between(line.from, other.from), e) / cross(d, e));
  }
  const auto to = between(line.from, other.centre);
  const double along = dot(to, d), R = radius(other);
  const double rest = R * R - (dot(to, to) - along * along);
  if (!(rest >= 0))
    throw NotFollowed(tr("What is left does not fit a corner of the contour."));
  const auto near = plus(line.from, d, along - std::sqrt(rest));
  const auto far = plus(line.from, d, along + std::sqrt(rest));
  return length(between(near, a.to)) < length(between(far, a.to)) ? near : far;
}

// A contour beside itself, around outer corners and into inner ones.
std::vector<Way> beside_all(const std::vector<Way>& contour, double left_mm) {
  if (left_mm == 0) return contour;
  std::vector<Way> all;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    auto next = beside_of(contour[i], left_mm);
    if (!all.empty() && length(between(all.back().to, next.from)) > kMeets_mm) {
      const auto turn =
          cross(direction(contour[i - 1], true), direction(contour[i], false));
      if (turn * left_mm < 0)
        all.push_back({all.back().to, next.from, true, contour[i].from, turn < 0});
      else
        all.back().to = next.from = meeting(all.back(), next);
    }
    all.push_back(next);
  }
  return all;
}

class G7x {
 public:
  G7x(ModalState& s, bool across, const Contour& contour)
      : s_(s), across_(across), start_{*s.x_mm, *s.z_mm} {
    for (const auto& run : contour.runs)
      for (const auto& m : run.moves) {
        const bool arc = m.to.kind == Kind::arc;
        ways_.push_back({m.from.value_or(start_),
                         {m.to.x_mm, m.to.z_mm},
                         arc,
                         m.to.centre,
                         m.to.clockwise});
      }
    if (ways_.size() < 2) throw NotFollowed(tr("Its contour has less than two moves."));
    ways_.erase(ways_.begin());  // to its first point
    outwards_ = level(start_) < level(ways_.front().from) ? -1 : 1;
    forwards_ = place(ways_.back().to) < place(ways_.front().from) ? -1 : 1;
    // With Z to the right and X up: to the left of the contour's way.
    left_ = outwards_ * forwards_ * (across_ ? -1 : 1);
  }

  void rough(double left_mm, double step_mm, double back_mm) {
    auto ways = ways_;
    for (const auto& w : ways) check(w);
    const auto end = at(level(start_), place(ways.back().to));
    if (length(between(ways.back().to, end)) > kMeets_mm)
      ways.push_back({ways.back().to, end});
    ways = beside_all(ways, left_ * left_mm);
    ways.back().to = across_ ? Point{ways.back().to.h_mm, start_.z_mm}
                             : Point{start_.h_mm, ways.back().to.z_mm};
    const auto first = ways.front().from;
    const double depth = outwards_ * (level(start_) - level(first));
    if (!(step_mm > 0) || !(depth / step_mm <= kMostG7xPasses))
      throw NotFollowed(tr("Its passes are more than 500, or have no depth."));
    for (double done = 0; depth - done > kMeets_mm; done += step_mm)
      pass(level(start_) - outwards_ * done,
           std::lerp(place(start_), place(first), done / depth), ways, back_mm);
    rapid(first);
    along_all(ways);
  }

  void finish(double from_mm, double to_mm, double passes) {
    if (!(passes >= 1 && passes <= kMostG7xPasses))
      throw NotFollowed(tr("Its passes are none or more than 500."));
    for (double k = std::floor(passes); k >= 1; --k) {
      const auto ways =
          beside_all(ways_, left_ * ((k - 1) * (from_mm - to_mm) / passes + to_mm));
      rapid(start_);
      rapid(ways.front().from);
      along_all(ways);
    }
  }

 private:
  double level(const Point& p) const { return across_ ? p.z_mm : p.h_mm; }
  double place(const Point& p) const { return across_ ? p.h_mm : p.z_mm; }
  Point at(double level, double place) const {
    return across_ ? Point{place, level} : Point{level, place};
  }
  void rapid(const Point& p) { s_.straight(Kind::rapid, p.h_mm, p.z_mm); }

  void check(const Way& w) const {
    const bool steady = outwards_ * (level(w.to) - level(w.from)) > -kMeets_mm &&
                        forwards_ * (place(w.to) - place(w.from)) > -kMeets_mm;
    if (!steady)
      throw NotFollowed(tr("Only contours that go one way in X and in Z are followed."));
  }

  // Where a way that rises through a level meets it.
  double meets(const Way& w, double at_level) const {
    const double rise = level(w.to) - level(w.from);
    if (!w.arc) {
      const double u = std::abs(rise) > 0 ? (at_level - level(w.from)) / rise : 0;
      return std::lerp(place(w.from), place(w.to), std::clamp(u, 0.0, 1.0));
    }
    const double R = radius(w), off = at_level - level(w.centre);
    const double half = std::sqrt(std::max(0.0, R * R - off * off));
    const double a = place(w.centre) - half, b = place(w.centre) + half;
    const double low = std::min(place(w.from), place(w.to));
    const double high = std::max(place(w.from), place(w.to));
    const auto beyond = [&](double p) { return std::max({low - p, p - high, 0.0}); };
    return beyond(a) < beyond(b) ? a : b;
  }

  void pass(double at_level, double begins, const std::vector<Way>& ways, double back) {
    const auto met = std::ranges::find_if(ways, [&](const Way& w) {
      return outwards_ * (level(w.to) - at_level) > -kMeets_mm;
    });
    rapid(at(at_level, begins));
    if (met == ways.end()) return;
    const double to = meets(*met, at_level), length = std::abs(to - begins);
    if (!(length > kMeets_mm)) return;
    const double out = std::min(back, length / 2);
    const auto end = at(at_level, to);
    s_.straight(Kind::feed, end.h_mm, end.z_mm);
    rapid(at(at_level + outwards_ * out, to - forwards_ * out));
    rapid(at(at_level + outwards_ * out, begins + forwards_ * out));
    rapid(at(at_level, begins));
  }

  void along_all(const std::vector<Way>& ways) {
    for (const auto& w : ways)
      s_.to(
          {w.arc ? Kind::arc : Kind::feed, w.to.h_mm, w.to.z_mm, w.centre, w.clockwise});
  }

  ModalState& s_;
  bool across_;
  Point start_;
  std::vector<Way> ways_;
  double outwards_ = 1, forwards_ = -1, left_ = 1;
};

}  // namespace

void g7x_cycle(ModalState& s, int code, const Block& block, const Contour& contour) {
  const auto value = [&](const char* name, double none) {
    const auto v = block.value(name);
    return v ? s.mm(*v) : none;
  };
  if (!s.x_mm || !s.z_mm) throw NotFollowed(tr("X or Z was not given before it."));
  if (code != 70 && s.nose.side != NoseSide::none)
    throw NotFollowed(tr("The control refuses it while a nose is compensated."));
  G7x cycle(s, code == 72, contour);
  if (code == 70)
    return cycle.finish(value("D", 0), value("E", 0), block.value("P").value_or(1));
  cycle.rough(value("D", 0), value("I", s.mm(1)), value("R", s.mm(0.5)));
}

}  // namespace turnwright::review
