#include "turnwright/catalogue/fixed_tool.hpp"

#include <cmath>

namespace turnwright::catalogue {

FixedConditions of_size(FixedConditions at, FixedUse use, double size_mm) {
  if (!on_axis(use) || use == FixedUse::tapping) return at;
  at.f_mm_rev *= size_mm;
  if (at.window)
    for (double* f : {&at.window->f_mm_rev.lower, &at.window->f_mm_rev.upper})
      *f *= size_mm;
  return at;
}

FixedConditions at(const FixedConditions& c, double vc, double f) {
  auto other = c;
  other.vc_m_min = vc;
  other.f_mm_rev = f;
  if (!c.window) return other;
  other.T_min *= std::pow(c.vc_m_min / vc, 1 / c.window->taylor_n);  // Eq. (1)
  if (c.f_mm_rev > 0) other.T_min *= std::pow(c.f_mm_rev / f, c.window->life_feed);
  return other;
}

}  // namespace turnwright::catalogue
