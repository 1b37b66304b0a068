#include "turnwright/cutting/wear_curve.hpp"

#include <cmath>
#include <stdexcept>

namespace turnwright::cutting {

CurveLife life_of_curve(std::span<const WearPoint> curve, double criterion_mm) {
  const auto require = [](bool good) {
    if (!good) throw std::domain_error("life_of_curve: no wear curve");
  };
  require(!curve.empty() && criterion_mm > 0 && std::isfinite(criterion_mm));
  WearPoint before;
  for (const WearPoint& p : curve) {
    require(p.t_min > before.t_min && std::isfinite(p.t_min));
    require(p.VB_mm >= 0 && std::isfinite(p.VB_mm));
    if (p.VB_mm >= criterion_mm) {
      const double share = (criterion_mm - before.VB_mm) / (p.VB_mm - before.VB_mm);
      return {before.t_min + share * (p.t_min - before.t_min), false};
    }
    before = p;
  }
  return {before.t_min, true};
}

}  // namespace turnwright::cutting
