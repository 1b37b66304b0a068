#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chain.hpp"

/// The outer elements and the bores of a half profile, with their edges.
namespace turnwright::exchange {

// The faces at the ends and what lies between them: the outside from left to right, the
// bores from right to left.
struct Parts {
  Side left, right;
  std::vector<Side> outside, inside;
};

inline bool on_axis(const Point& p, double join_mm) {
  return std::abs(p.r_mm) <= join_mm;
}

/// Rounded to 1e-9 mm, so that short decimals of a file stay short.
double tidy_mm(double mm);

/// The element of a band, without its id.
Element element_of(const Band& band);

inline std::string pair(const std::string& a, const std::string& b) {
  return a + '|' + b;
}

/// Adds one corner between two elements, of which a face of the part has one, as an edge,
/// or names it under `ignored` where a part document has no place for it.
void add_corner(Outline& out, const std::string& at, const Corner& corner,
                const Element* a, const Element* b);

/// The corners of a chain; `name(k)` is that before element k.
template <class Name>
void add_corners(Outline& out, const Chain& chain, const std::vector<Element>& elements,
                 Name name) {
  for (std::size_t k = 0; k <= chain.bands.size(); ++k) {
    const Element* a = k > 0 ? &elements[k - 1] : nullptr;
    const Element* b = k < elements.size() ? &elements[k] : nullptr;
    if (a)
      for (const Corner& c : chain.bands[k - 1].after) add_corner(out, name(k), c, a, b);
    if (b)
      for (const Corner& c : chain.bands[k].before) add_corner(out, name(k), c, a, b);
  }
}

/// @throws InputError if there is no contour.
void add_outside(Outline& out, const Parts& parts, double join_mm);

/// Bores of a through hole go with the end from which they are reached: those to the
/// narrowest with the right one.  Centre holes of ISO 6411 are `centre_holes`.  The point of a
/// drill at a bottom is left to the drill, and centre holes of other sizes to the clamping
/// that needs them; `assumed` says so.
void add_inside(Outline& out, const Parts& parts, double join_mm);

}  // namespace turnwright::exchange
