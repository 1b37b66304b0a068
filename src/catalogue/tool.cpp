#include "turnwright/catalogue/tool.hpp"

#include <algorithm>

namespace turnwright::catalogue {

double least_depth_mm(const Tool& t) {
  return std::max(t.ap_mm.lower, 2.0 / 3.0 * t.re_mm);
}

bool goes_behind_shoulders(const Tool& t) { return t.kapr_deg >= 98 - 1e-9; }

double stick_out_mm(const BoringBar& bar) {
  double length = 0;
  for (const auto& s : bar.segments) length += s.length_mm;
  return length;
}

}  // namespace turnwright::catalogue
