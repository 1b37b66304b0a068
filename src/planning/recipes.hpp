#pragma once
#include <string>
#include <vector>

#include "feature.hpp"

/// The discrete choices of a surface: numbers of passes, speed ranges and tools.
namespace turnwright::planning {

/// The part of the request about one surface: its operations and tools.
struct Wanted {
  bool rough = true, finish = true;  ///< whether these operations are allowed
  bool given = false;                ///< whether `operations` gives them
  const catalogue::Tool *rough_tool = nullptr, *finish_tool = nullptr;
  Fixed fixed;
  std::vector<std::string> ids;  ///< of the given operations, rough first
};
Wanted wanted(const PreparedPart& plan, std::size_t setup, const std::string& surface);

/// The tools of the request for a use and the plan's material.
std::vector<const catalogue::Tool*> tools_for(const PlanRequest& plan,
                                              catalogue::ToolUse use);

/// Finishing passes that `auto` may take on an element or a bore.
inline constexpr int kFinishingPasses = 2;

/// Every number of passes that the depths of the tools allow, or the given number, with
/// every speed range; on elements and bores at most kFinishingPasses finishing passes
/// unless their number is given.
std::vector<Recipe> recipes(const PreparedPart& plan, const Feature& feature,
                            const Wanted& wanted, const catalogue::Tool* rough,
                            const catalogue::Tool* finish);

}  // namespace turnwright::planning
