#pragma once
#include <string>
#include <vector>

#include "tool_rows.hpp"

namespace turnwright::report {

/// A line of the inspection plan of a setup.
struct Check {
  std::string what;       ///< "\u00d830 k6", "total radial run-out to A"
  std::string of;         ///< the surface
  std::string limits;     ///< "30.002 .. 30.015", in mm; of a roughness in um
  std::string predicted;  ///< deviation from the nominal size, or the form's error
  std::string gauge;
  std::string when;  ///< "first, then 1 in 12"
};

/// What is checked once a setup is done: every tolerance whose surfaces are then all made,
/// the roughnesses (alike ones in one line) and threads and knurls that this setup makes.
///
/// Every characteristic is checked on the first part.  A size is checked again when the
/// plan's corrections fall due, after `shop.life_between_offsets` of the edge that
/// finishes it; everything else, and sizes where the plan counts no wear, after a change
/// of that edge.  What fewer parts keep than the request wants is checked on every part.
std::vector<Check> inspection(const planning::PreparedPart& part,
                              const planning::ProcessPlan& plan, std::size_t setup,
                              const std::vector<ToolRow>& tools);

}  // namespace turnwright::report
