#pragma once
#include <string>
#include <vector>

#include "removal.hpp"

namespace turnwright::report {

/// Moves at feed between two rapids, and the work before and after.
struct CutPass {
  int tool = 0;
  std::string operation;
  std::vector<toolpath::Point> way;  ///< of the programmed point, arcs as chords
  std::vector<Ring> before, after;
};

/// The work when a setup begins: stock, or what the setup before has left.
Work work_before(const planning::PreparedPart& part, std::size_t setup);

/// Every pass of a program, in its order.
/// @throws std::domain_error if the program does not cut the setup's operations.
std::vector<CutPass> passes(const planning::PreparedPart& part,
                            const planning::SetupPlan& setup,
                            const toolpath::SetupProgram& program);

}  // namespace turnwright::report
