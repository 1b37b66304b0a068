#pragma once
#include "document/json/reader.hpp"
#include "turnwright/gcode/dialect.hpp"

namespace turnwright::document {

/// The controls of programs, by the names that requests give them.
inline const Choices<gcode::Control>& controls() {
  static const auto kControls = [] {
    Choices<gcode::Control> all;
    for (const auto& d : gcode::dialects()) all.push_back({d.id, d.control});
    return all;
  }();
  return kControls;
}

}  // namespace turnwright::document
