#pragma once
#include <span>
#include <string>

#include "turnwright/volumetric/ball_bar.hpp"
#include "turnwright/volumetric/compensation.hpp"
#include "turnwright/volumetric/machine.hpp"

/// Pictures of a machine's geometry (SVG 1.1, readable alone, 190 mm wide).  Equal data
/// give equal bytes.
namespace turnwright::report {

/// A circular test: both paths about their common centre, with what the twelve terms make
/// of them, at
///
///     radius on paper = 42 mm + factor (v - e_u cos theta - e_v sin theta)          (1)
///
/// v the values, e the common centre, factor the largest of 1, 2, 5, 10, .. that keeps
/// the traces between 28 and 56 mm; beside it the amplitudes of the lobes, undulations
/// 2 to 8 of a path, and the terms' ranking.
/// @throws ModelRangeError as volumetric::decompose.
std::string ball_bar_drawing(const volumetric::Trace& trace);

/// Distances of the tip from where it should be, before and after the correction, along
/// the program, on a logarithmic scale; of more moves than columns the largest of each.
/// Values below 0.1 nm stand on the lower edge.
std::string compensation_drawing(const volumetric::Compensated& compensated);

/// The errors of each axis over -Q to Q (machine.hpp (1)), shifts and turns apart, by
/// direction of motion where they differ (no band: coefficients carry no uncertainty).
/// Errors that are zero are left out.
std::string error_map(const volumetric::Machine& machine);

}  // namespace turnwright::report
