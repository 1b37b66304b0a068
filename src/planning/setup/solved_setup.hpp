#pragma once
#include <vector>

#include "planning/auxiliary/auxiliary_work.hpp"
#include "planning/paths/operation_gaps.hpp"
#include "planning/surface/operation_result.hpp"

namespace turnwright::planning {

/// A setup with one clamping, all its features solved.
struct SolvedSetup {
  std::size_t setup = 0;
  Clamping clamping = Clamping::chuck;
  std::vector<SolvedSurface> features;
  Between between = {};
  double objective = 0;  ///< of the whole setup
  double lower_bound = 0;
  std::vector<RejectedTool> rejected_tools = {};
  AuxiliaryWork auxiliary = {};
  bool short_of_stations = false;  ///< for some choices of tools
  bool feasible() const;
};

}  // namespace turnwright::planning
