#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/say.hpp"
#include "centre_hole.hpp"
#include "elements.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange {
namespace {

Point turned(const Point& p) { return {-p.z_mm, -p.r_mm}; }

// A bore as a chain with the material below: half a turn of the plane.
Side turned(Side s) {
  s.from = turned(s.from);
  s.to = turned(s.to);
  if (s.centre) s.centre = turned(*s.centre);
  return s;
}

// From one end: from the face at its mouth to that at the other end, or to its bottom.
struct Bore {
  Side mouth;
  std::vector<Side> sides;  // from right to left
  std::optional<Side> opposite;
};

std::string named(const std::vector<Side>& sides) {
  std::vector<std::string> sources;
  for (const Side& s : sides)
    sources.insert(sources.end(), s.sources.begin(), s.sources.end());
  return fmt::format("{}", fmt::join(sources, ", "));
}

bool falls_to_axis(const Point& from, const Point& to, double join_mm) {
  return on_axis(to, join_mm) && !on_axis(from, join_mm) &&
         std::abs(to.z_mm - from.z_mm) > join_mm;
}

// Points of drills have 90 to 150 deg.
void require_point(const Side& s) {
  const double along = std::abs(s.to.z_mm - s.from.z_mm),
               across = std::abs(s.to.r_mm - s.from.r_mm);
  const double deg = 2 * units::deg_from_rad(std::atan2(across, along));
  if (deg < 89 || deg > 151)
    throw InputError(
        "profile",
        {{place(s.sources, s.from), say("a bore that ends in a point of {:.4g} deg", deg),
          tr("a flat bottom, or the point of a drill, 90 to 150 deg"), "geometry"}});
}

// A plane in the place of the drill's point at the bottom of a blind bore.
void take_point(std::vector<Side>& sides, double join_mm, Outline& out) {
  const auto leave = [&](const Side& point) {
    require_point(point);
    out.assumed.push_back(
        {named({point}),
         tr("The conical bottom of the bore is left to the drill's point.")});
  };
  Side &first = sides.front(), &last = sides.back();
  if (!last.centre && falls_to_axis(last.from, last.to, join_mm)) {
    leave(last);
    last.to = {last.from.z_mm, 0};
  } else if (!first.centre && falls_to_axis(first.to, first.from, join_mm)) {
    leave(first);
    first.from = {first.to.z_mm, 0};
  }
}

Element inner_element(const Band& b, part::End from) {
  Element e = element_of(b);
  std::swap(e.left_mm, e.right_mm);  // the chain runs from right to left
  e.from = from;
  return e;
}

double narrowest_mm(const Element& e) { return std::min(e.left_mm, e.right_mm); }

// Number of elements of a through bore that are reached from the right: to the narrowest.
std::size_t from_the_right(const std::vector<Element>& elements) {
  std::size_t last = 0;
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (narrowest_mm(elements[k]) <= narrowest_mm(elements[last])) last = k;
  return last + 1;
}

// Appends a bore's elements to the outline: those of the right end, then those of the left.
void add_bore(Outline& out, const Bore& bore, part::End from, double join_mm) {
  std::vector<Side> sides;
  if (from == part::End::right) sides.push_back(turned(bore.mouth));
  for (const Side& s : bore.sides) sides.push_back(turned(s));
  if (from == part::End::left) sides.push_back(turned(bore.mouth));
  if (bore.opposite) sides.push_back(turned(*bore.opposite));
  const Chain chain = chain_of(sides, join_mm);

  std::vector<Element> elements;
  for (const Band& b : chain.bands) elements.push_back(inner_element(b, from));
  const std::size_t count = elements.size();
  const std::size_t right = from == part::End::left ? 0
                            : bore.opposite         ? from_the_right(elements)
                                                    : count;
  const std::size_t named_before = out.inner.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = k < right ? k : right + count - 1 - k;
    elements[k].id = fmt::format("b{}", named_before + place + 1);
    if (k >= right) elements[k].from = part::End::left;
  }
  const auto name = [&](std::size_t k) {
    if (k == 0) return pair("right", elements.front().id);
    if (k == count) return pair("left", elements.back().id);
    return pair(elements[k - 1].id, elements[k].id);
  };
  add_corners(out, chain, elements, name);
  out.inner.insert(out.inner.end(), elements.begin(),
                   elements.begin() + static_cast<std::ptrdiff_t>(right));
  out.inner.insert(out.inner.end(), elements.rbegin(),
                   elements.rbegin() + static_cast<std::ptrdiff_t>(count - right));
}

void add_blind_bore(Outline& out, Bore bore, part::End from, double join_mm) {
  if (bore.sides.empty()) return;
  if (const auto hole = centre_hole_of(bore.sides, from, join_mm)) {
    out.centre_holes.push_back({from, part::designation(*hole)});
    return;
  }
  if (like_centre_hole(bore.sides, join_mm)) {
    out.assumed.push_back(
        {named(bore.sides),
         from == part::End::left
             ? say("The centre hole at the left end is drilled where a "
                   "clamping needs it.")
             : say("The centre hole at the right end is drilled where a "
                   "clamping needs it.")});
    return;
  }
  take_point(bore.sides, join_mm, out);
  add_bore(out, bore, from, join_mm);
}
}  // namespace

void add_inside(Outline& out, const Parts& parts, double join_mm) {
  const auto& sides = parts.inside;
  const auto bottom = std::find_if(sides.begin(), sides.end(), [&](const Side& s) {
    return on_axis(s.from, join_mm);
  });
  const bool solid = on_axis(parts.left.from, join_mm) || bottom != sides.end() ||
                     on_axis(parts.right.to, join_mm);
  if (!solid) {
    if (!sides.empty())
      add_bore(out, {parts.right, sides, parts.left}, part::End::right, join_mm);
    return;
  }
  const bool right_is_bored = !on_axis(parts.right.to, join_mm);
  add_blind_bore(
      out,
      {parts.right,
       right_is_bored ? std::vector<Side>(sides.begin(), bottom) : std::vector<Side>{},
       {}},
      part::End::right, join_mm);
  add_blind_bore(out, {parts.left, {bottom, sides.end()}, {}}, part::End::left, join_mm);
}

}  // namespace turnwright::exchange
