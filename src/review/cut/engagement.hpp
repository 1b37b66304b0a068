#pragma once
#include "turnwright/review/cuts.hpp"
#include "workpiece.hpp"

/// The moves of a program through the stock.
namespace turnwright::review {

/// Follows a program and cuts the workpiece; the cuts of the result have neither loads nor
/// limits yet.
ReviewedSetup follow(const planning::PreparedPart& part, const ReviewedProgram& program,
                     const std::vector<MountedTool>& tools, Workpiece& workpiece);

}  // namespace turnwright::review
