#pragma once
#include <string>

namespace turnwright::report {

/// How a characteristic is measured.
enum class Measured {
  outside,  ///< a diameter of the outside
  inside,   ///< a bore
  length,   ///< between two faces
  runout,   ///< an indicator against the turning part
  form      ///< an indicator along or across a surface
};

/// A gauge that decides whether a part keeps a tolerance of this width: the simplest one
/// whose expanded uncertainty is at most a fifth of the width; one of the measuring room
/// where none on the shop floor does.  The uncertainties are estimates for clean parts at
/// shop temperature and sizes up to some 100 mm: 30 um of a calliper, 4 um of a
/// micrometer.
/// @throws std::domain_error unless the width is above 0.
std::string gauge(Measured measured, double width_mm);

/// What judges a roughness Ra.
std::string roughness_gauge(double Ra_um);

}  // namespace turnwright::report
