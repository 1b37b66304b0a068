#pragma once
#include <cstddef>

namespace turnwright::cutting {

/// The life of one edge, in measured conditions.
struct LifePoint {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0;
  double T_min = 0;
  bool longer = false;  ///< the edge was still good after T_min (a censored life)
  std::size_t lab = 0;
};

}  // namespace turnwright::cutting
