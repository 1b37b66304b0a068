#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frequency_response.hpp"
#include "turnwright/chatter/cutter.hpp"
#include "turnwright/chatter/uncertain.hpp"
#include "turnwright/document/catalogue.hpp"

/// The request of the door `stability`.
namespace turnwright::document::stability_request {

enum class Method { fundamental_matrix, tfea, semi_discretisation, simulation };
enum class Model { milling, power_law, turning };

struct Point {
  double n_rpm = 0, ap_mm = 0;
};

struct SpeedRange {
  double from_rpm = 0, to_rpm = 0;
  bool holds(double n_rpm) const { return n_rpm >= from_rpm && n_rpm <= to_rpm; }
};

/// The force that a material's law gives at the mean chip.
struct Chip {
  double hm_mm = 0;
  chatter::LinearForce force;
};

struct Request {
  Model model = Model::milling;
  chatter::System system;
  std::optional<chatter::Cutter> cutter;  // with what `system` does not hold
  std::vector<MeasuredAxis> measured;     // whose modes `system` holds
  bool modes_of_cutter = false;           // those of its document
  std::optional<Chip> chip;
  std::optional<double> ap_max_mm;
  std::vector<double> speeds_rpm;
  bool speeds_listed = false;     // one by one, not as a range
  std::vector<double> depths_mm;  // counted at each speed
  std::optional<chatter::Bands> bands;
  std::optional<SpeedRange> machine;
  std::vector<Point> points;
  Method method = Method::fundamental_matrix;
  int resolution = 0;  // elements or intervals
  nlohmann::ordered_json assumed = nlohmann::ordered_json::array();

  std::string pointer_of_speed(std::size_t i) const {
    return speeds_listed ? "/speeds_rpm/" + std::to_string(i) : "/speeds_rpm";
  }

  /// Whether depth and delay enter by more than one number, see cutter.hpp.
  bool shaped() const {
    return cutter && (cutter->helix_rad > 0 || cutter->by_revolution() ||
                      cutter->indentation_N_mm > 0);
  }
};

/// @throws InputError with every problem.
Request read(const nlohmann::json& request, const Catalogue& catalogue);

}  // namespace turnwright::document::stability_request
