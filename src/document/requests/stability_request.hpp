#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frequency_response.hpp"
#include "turnwright/chatter/chart.hpp"
#include "turnwright/chatter/speed_variation.hpp"
#include "turnwright/document/catalogue.hpp"

/// The request of the capability `stability`.
namespace turnwright::document::stability_request {

enum class Model { milling, power_law, turning };

/// The force coefficients by a material's law at the mean chip thickness.
struct Chip {
  double hm_mm = 0;
  chatter::LinearForce force;
};

struct Request : chatter::ChartRequest {
  Model model = Model::milling;
  std::vector<MeasuredAxis> measured;  // whose modes `system` holds
  bool modes_of_cutter = false;        // those of its document
  std::optional<Chip> chip;
  std::optional<double> removed_mm2;  // per revolution and depth: teeth fz ae, if known
  std::vector<chatter::SpeedVariation> variations;  // of turning
  bool speeds_listed = false;                       // one by one, not as a range
  nlohmann::ordered_json assumed = nlohmann::ordered_json::array();

  std::string pointer_of_speed(std::size_t i) const {
    return speeds_listed ? "/speeds_rpm/" + std::to_string(i) : "/speeds_rpm";
  }
};

/// @throws InputError with every problem.
Request read(const nlohmann::json& request, const Catalogue& catalogue);

}  // namespace turnwright::document::stability_request
