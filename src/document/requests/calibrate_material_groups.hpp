#pragma once
#include "calibrate_material_fits.hpp"

namespace turnwright::document::material_calibration {

struct Written {
  nlohmann::json material;    ///< with the measured constants; null without one given
  const char* law = nullptr;  ///< of feed and passive force that goes into it, or would
};

/// The material's document with every group that the cuts determine.  What a material
/// cannot have stays as it was, with a warning.
Written written(const Request& q, const Fits& fits, nlohmann::json& warnings);

}  // namespace turnwright::document::material_calibration
