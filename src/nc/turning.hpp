#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "site.hpp"

/// Tool paths of the operations whose conditions the plan has chosen.
namespace turnwright::nc {

/// Whether the last pass of an operation continues into that of the next one without
/// leaving the part: both finish in one pass with one tool, and meet at one height.
bool joined(const Site& site, std::size_t operation);

/// Why a finishing tool enters the contour again with an operation, for the program's
/// comments; none if the operation is the tool's first, or goes on from the one before.
std::optional<std::string> entered_again(const Site& site, std::size_t operation);

/// Turns an element or bores a bore.
void turn(Site& site, std::size_t operation);

/// Faces the free end.
void face(Site& site, std::size_t operation);

/// Faces the shoulder between two elements, outside or between bores.
void face_shoulder(Site& site, std::size_t operation);

/// What operations after one take off the same surface.
double later_mm(const Site& site, std::size_t operation, const std::string& surface);

/// Corner radius [mm] of an operation's tool.
double corner_mm(const Site& site, const planning::OperationPlan& operation);

}  // namespace turnwright::nc
