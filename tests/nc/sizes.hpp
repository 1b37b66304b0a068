#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "plans.hpp"

/// The sizes that a plan's programs have to make.
namespace turnwright::nc::test {

class Sizes {
 public:
  explicit Sizes(const Planned& p) : p_(p) {}

  double length() const { return part::length_mm(p_.part.drawing); }

  // Whether the plan faces an end.
  bool faced(bool left) const {
    for (const auto& s : p_.plan.setups)
      for (const auto& o : s.operations)
        if (o.on[0] == (left ? "left" : "right")) return true;
    return false;
  }

  // What a radius is cut to beside what is drawn: the middle of the limits of a size or of a
  // thread's crests, the offset of
  // the tool and the correction at a place.
  double correction(const std::string& id, double z) const {
    double sum = 0;
    for (const auto& t : p_.part.drawing.tolerances)
      if (t.of == id && t.kind == part::ToleranceKind::diameter && !cut(id))
        sum += (t.limits->lower_mm + t.limits->upper_mm) / 2 / 2;
    const auto crests = [&](const auto& e) {
      if (e.id == id && e.cut && e.cut->kind == part::CutKind::thread && e.limits)
        sum += (e.limits->lower_mm + e.limits->upper_mm) / 2 / 2;
    };
    std::ranges::for_each(p_.part.drawing.outer, crests);
    std::ranges::for_each(p_.part.drawing.inner, crests);
    for (const auto& o : p_.plan.offsets)
      if (o.on == id) sum += o.offset_mm;
    return sum + path_correction(id, z);
  }

  bool cut(const std::string& id) const {
    const auto is = [&](const auto& e) { return e.id == id && e.cut; };
    return std::ranges::any_of(p_.part.drawing.outer, is) ||
           std::ranges::any_of(p_.part.drawing.inner, is);
  }

  double path_correction(const std::string& id, double z) const {
    for (const auto& c : p_.plan.compensation) {
      if (c.on != id) continue;
      const auto& t = c.table_mm;
      for (std::size_t i = 0; i + 1 < t.size(); ++i) {
        const auto [z0, r0] = t[i];
        const auto [z1, r1] = t[i + 1];
        if (std::min(z0, z1) <= z && z <= std::max(z0, z1))
          return r0 + (r1 - r0) * (z - z0) / (z1 - z0);
      }
    }
    return 0;
  }

  bool corrected(const std::string& id) const {
    const auto is_on = [&](const auto& c) { return c.on == id; };
    return std::ranges::any_of(p_.plan.compensation, is_on) || correction(id, 0) != 0;
  }

  // Radius drawn at a place of an element.
  // Between the edges at its ends, which follow the correction where they begin.
  template <class Element>
  static std::pair<double, double> straight(const Element& e) {
    double from = e.left_chamfer ? e.left_chamfer->axial_mm : 0;
    double to = e.length_mm - (e.right_chamfer ? e.right_chamfer->axial_mm : 0);
    if constexpr (requires { e.left_undercut; }) {
      if (e.left_undercut) from = e.left_undercut->width_mm;
      if (e.right_undercut) to = e.length_mm - e.right_undercut->width_mm;
    }
    return {from, to};
  }

  // Distance of the centre of an undercut's radius from the shoulder: the forms F to H come
  // back to the shoulder from a circle whose deepest point lies t2 behind it.
  static double centre(const part::Undercut& u) { return u.radius_mm - u.recess_mm; }

  // How steeply an undercut falls to its floor: DIN 76 at 30 deg, DIN 509 at 15 deg, form G
  // beside a corner of 55 deg as on its other side.
  static double slope_of(const part::Undercut& u) {
    if (u.pitch_mm > 0) return M_PI / 6;
    return u.form == 'G' ? (90 - 55) / 2.0 * M_PI / 180 : M_PI / 12;
  }

  // How far it leans into the shoulder: form F by 8 deg, the others as they fall.
  static double lean_of(const part::Undercut& u) {
    return u.form == 'F' ? M_PI * 8 / 180 : slope_of(u);
  }

  // Depth of an undercut at a distance from the left end: from its width on down its slope,
  // level, and up a circle.
  template <class Element>
  static double undercut(const Element& e, double from_left) {
    if constexpr (requires { e.left_undercut; }) {
      const bool left = from_left < e.length_mm / 2;
      const auto& u = left ? e.left_undercut : e.right_undercut;
      const double x = left ? from_left : e.length_mm - from_left;
      if (!u || x >= u->width_mm) return 0;
      const double line =
          std::min(u->depth_mm, (u->width_mm - x) * std::tan(slope_of(*u)));
      const double r = u->radius_mm, c = centre(*u);
      return line - (x < c ? r - std::sqrt(std::max(0.0, r * r - (c - x) * (c - x))) : 0);
    }
    return 0;
  }

  template <class Element>
  static double drawn(const Element& e, double u) {
    const double straight = e.left_mm + (e.right_mm - e.left_mm) * u;
    if (!e.cut || e.cut->kind == part::CutKind::thread ||
        e.cut->kind == part::CutKind::knurl)
      return straight / 2;
    if (e.cut->kind == part::CutKind::groove) return e.cut->core.left_mm / 2;
    const double a = e.cut->drawn.left_mm / 2, b = e.cut->drawn.right_mm / 2;
    const double R = e.cut->radius_mm, c = std::hypot(e.length_mm, b - a);
    const double to_centre = std::sqrt(std::max(0.0, R * R - c * c / 4));
    const double out = e.cut->convex ? 1 : -1;  // from the centre to the arc
    const double zc = e.length_mm / 2 + out * to_centre * (b - a) / c;
    const double rc = (a + b) / 2 - out * to_centre * e.length_mm / c;
    const double dz = u * e.length_mm - zc;
    return rc + out * std::sqrt(std::max(0.0, R * R - dz * dz));
  }

  double begin(const part::OuterElement&, std::size_t k) const {
    return part::left_z_mm(p_.part.drawing, k);
  }
  double begin(const part::InnerElement&, std::size_t k) const {
    return part::inner_left_z_mm(p_.part.drawing, k);
  }

 protected:
  const Planned& p_;
};

}  // namespace turnwright::nc::test
