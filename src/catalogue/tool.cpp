#include "turnwright/catalogue/tool.hpp"

#include <algorithm>

namespace turnwright::catalogue {

double least_depth_mm(const Tool& t) {
  return std::max(t.ap_mm.lower, 2.0 / 3.0 * t.re_mm);
}

}  // namespace turnwright::catalogue
