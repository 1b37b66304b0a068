#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "turnwright/deflection/beam.hpp"

/// Tables of flexibilities compared field by field.
namespace turnwright::deflection {

using Field = double Flexibility::*;
inline constexpr Field kFields[] = {&Flexibility::f_ww_mm_N, &Flexibility::f_wp_rad_N,
                                    &Flexibility::f_pp_rad_Nmm, &Flexibility::tail_per_N,
                                    &Flexibility::tail_per_Nmm};

/// Largest difference of two tables, field by field, in parts of the field's largest.
inline double difference(const std::vector<Flexibility>& x,
                         const std::vector<Flexibility>& y) {
  double worst = 0;
  for (const Field f : kFields) {
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      largest = std::max(largest, std::abs(y[i].*f));
      apart = std::max(apart, std::abs(x[i].*f - y[i].*f));
      if (!(std::isfinite(x[i].*f))) return std::numeric_limits<double>::quiet_NaN();
    }
    if (apart > 0) worst = std::max(worst, apart / largest);
  }
  return worst;
}

inline std::vector<double> positions(double L) {
  std::vector<double> a;
  for (const double u : {0.01, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.99, 1.0})
    a.push_back(u * L);
  return a;
}

}  // namespace turnwright::deflection
