#pragma once
#include <optional>
#include <vector>

#include "calibrate_material_request.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/cutting/life_scatter.hpp"
#include "turnwright/cutting/roughness_fit.hpp"

/// What the cuts of a request determine, and in words what they do not.
namespace turnwright::document::material_calibration {

struct Lives {
  std::vector<std::size_t> cuts;  ///< of the request, in the order of the fit's points
  std::size_t censored = 0;       ///< lives that were longer
  cutting::TaylorFit fit;
  /// Where a life was longer, is that of a wear curve, or belongs to a named edge.
  std::optional<cutting::LifeScatter> scatter;
};

struct Fits {
  std::optional<cutting::ForceFit> forces;
  std::optional<Lives> lives;
  std::optional<cutting::RoughnessFit> roughness;
  std::vector<Problem> undetermined;  ///< constants that the cuts do not tell
};

/// All that the cuts determine.
/// @throws InputError with what they do not, if nothing is left.
Fits fitted(const Request& q);

/// Warnings of what was not determined, and of what rests on little.
std::vector<std::string> warnings_of(const Request& q, const Fits& fits);

std::string rounded(double x);  ///< to four digits

}  // namespace turnwright::document::material_calibration
