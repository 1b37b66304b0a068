#pragma once
#include <string>

namespace turnwright::report {

/// A picture as SVG and the name of its file.
struct Figure {
  std::string file, svg;
};

}  // namespace turnwright::report
