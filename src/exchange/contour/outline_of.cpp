#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "elements.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/exchange/profile.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kSplit = 1e-6;  // between radii and centres of arcs that are one, of R

[[noreturn]] void refuse(const std::vector<std::string>& sources, const Point& at,
                         std::string got, std::string wanted) {
  throw InputError("profile",
                   {{place(sources, at), std::move(got), std::move(wanted), "geometry"}});
}

double apart_mm(const Point& a, const Point& b) {
  return std::hypot(a.z_mm - b.z_mm, a.r_mm - b.r_mm);
}

void check_numbers(const std::vector<Side>& sides, double join_mm) {
  if (sides.empty()) refuse({}, {}, tr("no sides"), tr("a closed half profile"));
  for (const Side& s : sides) {
    const auto finite = [](const Point& p) {
      return std::isfinite(p.z_mm) && std::isfinite(p.r_mm);
    };
    if (!finite(s.from) || !finite(s.to) || (s.centre && !finite(*s.centre)))
      refuse(s.sources, {}, tr("a place that is no number"), tr("finite coordinates"));
    if (s.from.r_mm < -join_mm || s.to.r_mm < -join_mm)
      refuse(s.sources, s.from.r_mm < 0 ? s.from : s.to, tr("a side below the axis"),
             tr("the half profile on one side of the axis"));
  }
}

// Each side begins where the one before ends, or both lie on the axis.
void join(std::vector<Side>& sides, double join_mm) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Side &a = sides[i], &b = sides[(i + 1) % sides.size()];
    if (on_axis(a.to, join_mm) && on_axis(b.from, join_mm) &&
        std::abs(a.to.z_mm - b.from.z_mm) > join_mm) {
      a.to.r_mm = b.from.r_mm = 0;
      continue;
    }
    if (!(apart_mm(a.to, b.from) <= join_mm))
      refuse(a.sources, a.to,
             say("a gap of {:.6g} mm between z = {:g}, r = {:g} and z = {:g}, r = "
                 "{:g} mm",
                 apart_mm(a.to, b.from), a.to.z_mm, a.to.r_mm, b.from.z_mm, b.from.r_mm),
             tr("a closed half profile"));
    b.from = a.to;
  }
}

bool same_direction(const Side& a, const Side& b, double join_mm) {
  const double ux = a.to.z_mm - a.from.z_mm, uy = a.to.r_mm - a.from.r_mm;
  const double vx = b.to.z_mm - a.from.z_mm, vy = b.to.r_mm - a.from.r_mm;
  const double off = std::abs(ux * vy - uy * vx) / std::hypot(vx, vy);
  const bool onwards =
      ux * (b.to.z_mm - b.from.z_mm) + uy * (b.to.r_mm - b.from.r_mm) > 0;
  return off <= join_mm && onwards;
}

bool one_line(const Side& a, const Side& b, double join_mm) {
  if (!apart_mm(a.to, b.from)) {
    if (!a.centre && !b.centre) return same_direction(a, b, join_mm);
    if (a.centre && b.centre && a.counterclockwise == b.counterclockwise) {
      const double r = apart_mm(*a.centre, a.from);
      return apart_mm(*a.centre, *b.centre) <= std::max(join_mm, kSplit * r);
    }
  }
  return false;
}

// Sides of no length go, neighbours on one line or one circle become one side.
std::vector<Side> merged(const std::vector<Side>& sides, double join_mm) {
  std::vector<Side> out;
  for (const Side& s : sides) {
    if (!s.centre && apart_mm(s.from, s.to) <= join_mm) {
      if (!out.empty()) out.back().to = s.to;
      continue;
    }
    if (!out.empty() && one_line(out.back(), s, join_mm)) {
      out.back().to = s.to;
      out.back().sources.insert(out.back().sources.end(), s.sources.begin(),
                                s.sources.end());
    } else {
      out.push_back(s);
    }
  }
  while (out.size() > 1 && one_line(out.back(), out.front(), join_mm)) {
    out.front().from = out.back().from;
    out.front().sources.insert(out.front().sources.begin(), out.back().sources.begin(),
                               out.back().sources.end());
    out.pop_back();
  }
  return out;
}
bool wall_at(const Side& s, double z_mm, double join_mm) {
  return !s.centre && std::abs(s.from.z_mm - z_mm) <= join_mm &&
         std::abs(s.to.z_mm - z_mm) <= join_mm;
}

// Index of the outermost plane at an end.
std::size_t end_face(const std::vector<Side>& sides, double z_mm, bool left,
                     double join_mm) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool up = sides[i].to.r_mm > sides[i].from.r_mm;
    if (!wall_at(sides[i], z_mm, join_mm) || up != left) continue;
    if (!found || sides[i].from.r_mm + sides[i].to.r_mm >
                      sides[*found].from.r_mm + sides[*found].to.r_mm)
      found = i;
  }
  if (!found)
    refuse({}, {z_mm, 0},
           left ? tr("no plane at the left end") : tr("no plane at the right end"),
           tr("a part that ends in a plane: points and balls are not turned to the end"));
  return *found;
}

Parts parts_of(std::vector<Side> sides, double join_mm) {
  const auto ends = [](const Side& s) { return std::minmax(s.from.z_mm, s.to.z_mm); };
  double z0 = sides.front().from.z_mm, z1 = z0;
  for (const Side& s : sides) {
    z0 = std::min(z0, ends(s).first);
    z1 = std::max(z1, ends(s).second);
  }
  const auto left = static_cast<std::ptrdiff_t>(end_face(sides, z0, true, join_mm));
  std::rotate(sides.begin(), sides.begin() + left, sides.end());
  const auto right = static_cast<std::ptrdiff_t>(end_face(sides, z1, false, join_mm));
  const auto begin = sides.begin();
  return {sides.front(),
          sides[static_cast<std::size_t>(right)],
          {begin + 1, begin + right},
          {begin + right + 1, sides.end()}};
}

}  // namespace

Outline outline_of(const Profile& profile, double join_mm) {
  auto sides = profile.sides;
  check_numbers(sides, join_mm);
  join(sides, join_mm);
  const Parts parts = parts_of(merged(sides, join_mm), join_mm);
  Outline out;
  add_outside(out, parts, join_mm);
  add_inside(out, parts, join_mm);
  return out;
}

}  // namespace turnwright::exchange
