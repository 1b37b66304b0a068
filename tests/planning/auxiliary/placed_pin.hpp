#pragma once
#include <nlohmann/json.hpp>

namespace turnwright::planning {

/// A pin of a diameter, 80 mm long, held at the left, with one milled place or cross hole; a
/// minute costs 1.5.
inline nlohmann::json placed_pin(const nlohmann::json& place, double diameter_mm,
                                 double grip_mm, const nlohmann::json& tools) {
  return {
      {"format", "turnwright-part/1"},
      {"name", "pin"},
      {"material", "C45"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", diameter_mm + 4},
        {"length_mm", 142},
        {"left_allowance_mm", 60}}},
      {"outer",
       {{{"id", "d1"},
         {"kind", "cylinder"},
         {"length_mm", 80},
         {"diameter_mm", diameter_mm}}}},
      {"machine", "turn-mill"},
      {"tools", tools},
      {"milling", nlohmann::json::array({place})},
      {"setups", {{{"hold", "left"}, {"grip_mm", grip_mm}, {"clampings", {"chuck"}}}}},
      {"objective", "cost"},
      {"batch", 10},
      {"rates", {{"machine_per_min", 1.5}}}};
}

}  // namespace turnwright::planning
