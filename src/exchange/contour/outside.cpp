#include <fmt/format.h>

#include <cmath>

#include "base/say.hpp"
#include "elements.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::exchange {
namespace {

void leave_sharp(Outline& out, const std::string& at, const Corner& c,
                 const std::string& why) {
  std::string what = c.kind == Corner::Kind::chamfer    ? tr("chamfer")
                     : c.kind == Corner::Kind::fillet   ? tr("fillet")
                     : c.kind == Corner::Kind::undercut ? tr("undercut")
                     : c.kind == Corner::Kind::rounded  ? tr("rounded edge")
                                                        : tr("recess in the corner");
  const double size = c.kind == Corner::Kind::chamfer ? c.axial_mm : c.radius_mm;
  const std::string of = size > 0 ? say(" of {:.6g} mm", tidy_mm(size)) : std::string();
  out.ignored.push_back(
      {c.sources.empty() ? at : fmt::format("{}", fmt::join(c.sources, ", ")),
       say("The {}{} at {} is left out: {}.", what, of, at, why)});
}

// Whether a document can have such an edge between these two: at grooves only chamfers, and
// rounded edges only of cylinders.
bool plain(const Element* a, const Element* b, const Corner& c) {
  const auto has_edges = [&](const Element* e) {
    return !e || (e->shape != Shape::arc &&
                  (e->shape != Shape::groove || c.kind == Corner::Kind::chamfer) &&
                  (c.kind != Corner::Kind::rounded || e->shape == Shape::cylinder));
  };
  return has_edges(a) && has_edges(b);
}

}  // namespace

double tidy_mm(double mm) {
  constexpr double kDigits = 1e9;
  return std::round(mm * kDigits) / kDigits;
}

Element element_of(const Band& b) {
  return {.id = "",
          .shape = b.shape,
          .length_mm = tidy_mm(b.to.z_mm - b.from.z_mm),
          .left_mm = tidy_mm(2 * std::abs(b.from.r_mm)),
          .right_mm = tidy_mm(2 * std::abs(b.to.r_mm)),
          .radius_mm = tidy_mm(b.radius_mm),
          .convex = b.convex,
          .sources = b.sources};
}

void add_corner(Outline& out, const std::string& at, const Corner& c, const Element* a,
                const Element* b) {
  const bool face = !a || !b;
  const auto edge = [&] {
    Edge e{.at = at, .sources = c.sources};
    if (c.kind == Corner::Kind::chamfer) {
      e.chamfer_mm = tidy_mm(c.axial_mm);
      e.angle_deg = tidy_mm(units::deg_from_rad(c.angle_rad));
    } else if (c.kind == Corner::Kind::rounded) {
      e.radius_mm = tidy_mm(c.radius_mm);
    } else if (c.kind == Corner::Kind::fillet) {
      e.fillet_mm = tidy_mm(c.radius_mm);
      out.assumed.push_back(
          {at, say("The radius of {:g} mm at {} is the largest that may stay: a "
                   "tool's smaller corner may cut it.",
                   *e.fillet_mm, at)});
    } else {
      e.undercut = c.undercut;
      e.pitch_mm = c.pitch_mm;
    }
    out.edges.push_back(std::move(e));
  };
  if (c.kind == Corner::Kind::recess)
    leave_sharp(
        out, at, c,
        tr("it is none of DIN 509's forms F, G and H with the sizes of their table, the "
           "corner stays sharp"));
  else if (!plain(a, b, c))
    leave_sharp(out, at, c,
                c.kind == Corner::Kind::rounded
                    ? tr("only edges of cylinders are rounded")
                    : tr("edges beside grooves and arcs are left to their tools"));
  else if (face && c.kind != Corner::Kind::chamfer && c.kind != Corner::Kind::rounded)
    leave_sharp(out, at, c, tr("the corner lies at the bottom of a bore"));
  else
    edge();
}

void add_outside(Outline& out, const Parts& parts, double join_mm) {
  std::vector<Side> sides{parts.left};
  sides.insert(sides.end(), parts.outside.begin(), parts.outside.end());
  sides.push_back(parts.right);
  const Chain chain = chain_of(sides, join_mm);
  if (chain.bands.empty())
    throw InputError("profile",
                     {{place(parts.left.sources, parts.left.from),
                       tr("a part without length"), tr("an outer contour"), "geometry"}});
  for (const Band& b : chain.bands) {
    out.outer.push_back(element_of(b));
    out.outer.back().id = fmt::format("d{}", out.outer.size());
  }
  const auto name = [&](std::size_t k) {
    if (k == 0) return std::string("left");
    if (k == out.outer.size()) return std::string("right");
    return pair(out.outer[k - 1].id, out.outer[k].id);
  };
  for (std::size_t k = 0; k < chain.walls.size(); ++k)
    if (!chain.walls[k].empty())
      out.faces.push_back({.id = name(k), .sources = chain.walls[k]});
  add_corners(out, chain, out.outer, name);
}
}  // namespace turnwright::exchange
