#pragma once
#include <cstddef>

#include "site.hpp"

/// Ways of the operations whose conditions the plan has chosen.
namespace turnwright::nc {

/// Whether the last pass of an operation goes on into the next one's without leaving the
/// part: both finish in one pass with one tool, and meet at one height.
bool joined(const Site& site, std::size_t operation);

/// Elements and bores.
void turn(Site& site, std::size_t operation);

/// The free end's face.
void face(Site& site, std::size_t operation);

/// A face between two elements.
void face_shoulder(Site& site, std::size_t operation);

/// What operations after one take off the same surface.
double later_mm(const Site& site, std::size_t operation, const std::string& surface);

/// Corner radius [mm] of an operation's tool.
double corner_mm(const Site& site, const planning::OperationPlan& operation);

}  // namespace turnwright::nc
