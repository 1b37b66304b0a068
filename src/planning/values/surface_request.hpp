#pragma once
#include <string>
#include <vector>

#include "turnwright/planning/plan_request.hpp"

/// What a request gives for one surface.
namespace turnwright::planning {

/// Conditions that the request fixes for the operations on a surface.
struct GivenConditions {
  Conditions rough, finish;
  Direction rough_direction = Direction::to_chuck, finish_direction = Direction::to_chuck;
};

/// The part of the request about one surface: its operations and tools.
struct SurfaceRequest {
  bool rough = true, finish = true;  ///< whether these operations are allowed
  bool given = false;                ///< whether `operations` gives them
  const catalogue::Tool *rough_tool = nullptr, *finish_tool = nullptr;
  GivenConditions fixed;
  std::vector<std::string> ids;  ///< of the given operations, rough first
};
SurfaceRequest surface_request(const PlanRequest& request, std::size_t setup,
                               const std::string& surface);

/// The tools of the request for a use and the plan's material.
std::vector<const catalogue::Tool*> tools_for(const PlanRequest& request,
                                              catalogue::ToolUse use);

}  // namespace turnwright::planning
