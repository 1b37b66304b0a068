#pragma once
#include <cstddef>

#include "turnwright/catalogue/tool.hpp"

namespace turnwright::planning {

/// A discrete choice for making a surface: tools, passes and speed ranges are fixed, the
/// conditions are open.
struct Recipe {
  const catalogue::Tool* rough = nullptr;   ///< absent: no roughing
  const catalogue::Tool* finish = nullptr;  ///< finishing or facing tool; may be absent
  int rough_passes = 0, finish_passes = 0;
  std::size_t rough_range = 0, finish_range = 0;  ///< which of the machine's speed ranges
  std::size_t rough_piece = 0,
              finish_piece = 0;  ///< and of the tools' chip windows, if these have any
};

}  // namespace turnwright::planning
