#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/volumetric/lathe_part.hpp"

/// The member "turned" of `geometry`: surfaces cut by the machine, and measured.
namespace turnwright::document {

struct TurnedSurface {
  std::string id;
  volumetric::Generator generator;
  std::optional<std::size_t> datum;  ///< index in the list; none: the spindle's axis
};

/// [{"id", "from_mm": [r, z], "to_mm": [r, z], "approach": {"X": -1, "Z": -1}, "datum"}],
/// in the direction of the cut; optional, for a machine with X, Z and C.
std::vector<TurnedSurface> read_turned(Reader& r, const std::string& chain);

/// Deviations of each surface [mm], forms by least squares and by the narrowest zone.
nlohmann::json turned_json(const std::vector<TurnedSurface>& surfaces,
                           const volumetric::Kinematics& machine,
                           const volumetric::Vec3& tool_point_mm);

}  // namespace turnwright::document
