#include "notation_units.hpp"

#include <cmath>

#include "exchange/contour/elements.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::exchange::notated {
namespace {

constexpr Units kInches{25.4, 0.0254, "in", "uin"};

void scale(double by, std::optional<double>& x) {
  if (x) *x = tidy_mm(*x * by);
}

void scale(double by, part::Limits& l) {
  l = {tidy_mm(l.lower_mm * by), tidy_mm(l.upper_mm * by)};
}

void scale(const Units& u, Demands& d) {
  if (d.limits) scale(u.mm, *d.limits);
  scale(u.um, d.Ra_um);
  scale(u.um, d.Rz_um);
  scale(u.mm, d.grinding_mm);
}

void scale(const Units& u, Element& e) {
  e.length_mm = tidy_mm(e.length_mm * u.mm);
  e.radius_mm = tidy_mm(e.radius_mm * u.mm);
  if (e.shape != Shape::thread)
    for (double* d : {&e.left_mm, &e.right_mm}) *d = tidy_mm(*d * u.mm);
  scale(u, e.demands);
}

}  // namespace

Units units_of(const std::vector<Word>& statements, Mistakes& mistakes) {
  Units units;
  for (const Word s : statements) {
    const auto colon = s.find(':');
    if (colon == Word::npos || !same(trimmed(s.substr(0, colon)), "unit")) continue;
    const Word unit = trimmed(s.substr(colon + 1));
    if (same(unit, "in") || same(unit, "inch"))
      units = kInches;
    else if (!same(unit, "mm"))
      mistakes.add(unit.empty() ? s : unit, tr("mm or in"));
  }
  return units;
}

void to_millimetres(const Units& u, Outline& o) {
  for (auto* list : {&o.outer, &o.inner})
    for (auto& e : *list) scale(u, e);
  for (auto& e : o.edges)
    for (auto* size : {&e.chamfer_mm, &e.radius_mm, &e.fillet_mm}) scale(u.mm, *size);
  for (auto& f : o.faces) scale(u, f.demands);
  for (auto& t : o.tolerances) {
    t.value_mm = tidy_mm(t.value_mm * u.mm);
    if (t.limits) scale(u.mm, *t.limits);
  }
  for (auto& m : o.milled) {
    for (double* size : {&m.z_mm, &m.length_mm, &m.width_mm, &m.depth_mm})
      *size = tidy_mm(*size * u.mm);
    scale(u, m.demands);
  }
}

}  // namespace turnwright::exchange::notated
