#include "turnwright/service/requests.hpp"

#include <vector>

#include "turnwright/document/acceptance.hpp"

namespace turnwright::service {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kAcceptanceExample = R"({"cases": [
  {"id": "seat", "tolerance": "diameter", "e_mm": [0.004, 0.011], "upper_mm": 0.016,
   "lower_mm": 0},
  {"id": "taper", "tolerance": "profile", "e_mm": [-0.002, 0.007], "value_mm": 0.02,
   "half_angle_deg": 10}]})";

}  // namespace

std::span<const Request> requests() {
  static const std::vector<Request> kTable{
      {"acceptance", "deviations over features and their tolerances -> verdicts",
       kAcceptanceExample,
       [](const json& request, const Context&) -> ordered_json {
         return document::acceptance(request);
       }},
  };
  return kTable;
}

}  // namespace turnwright::service
