#pragma once
#include <string>
#include <vector>

#include "removal.hpp"

namespace turnwright::report {

/// Moves at feed between two rapids, and the rings that they change.
struct CutPass {
  int tool = 0;
  std::string operation;
  std::vector<toolpath::Point> way;  ///< of the programmed point, arcs as chords
  std::size_t from = 0;              ///< the first ring that changes
  std::vector<Ring> before, after;   ///< from there to the last one that changes
};

/// What a program takes off, and what it leaves.
struct Removal {
  std::vector<CutPass> passes;
  Work left;
};

/// The work when a setup begins: stock, or what the setup before has left.
Work work_before(const planning::PreparedPart& part, std::size_t setup);

/// Every pass of a program, in its order.  A cancellation point at each move.
/// @throws std::domain_error if the program does not cut the setup's operations.
Removal removal(const planning::PreparedPart& part, const planning::SetupPlan& setup,
                const toolpath::SetupProgram& program);

}  // namespace turnwright::report
