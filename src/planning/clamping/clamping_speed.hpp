#pragma once
#include "turnwright/planning/prepared_part.hpp"

/// Spindle speeds that a clamping allows.
namespace turnwright::planning {

/// Fastest spindle speed [1/min] of machine and clamping.
double clamping_rpm(const PreparedPart& plan, Clamping clamping);
/// Spindle speed [1/min] at which the centrifugal loss of the jaws' force reaches 67 %
/// (VDI 3106).
double grip_loss_rpm(const PreparedPart& plan, Clamping clamping, double force_N);

}  // namespace turnwright::planning
