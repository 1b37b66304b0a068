#include "solved_setup.hpp"

#include <algorithm>

namespace turnwright::planning {

bool SolvedSetup::feasible() const {
  return std::all_of(features.begin(), features.end(),
                     [](const SolvedSurface& f) { return f.answer.feasible; });
}

}  // namespace turnwright::planning
