#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace turnwright::volumetric {

/// A row of a compensation table: the deviations of an axis at a programmed position, actual
/// less programmed, moving in + and in -.
struct CompensationPoint {
  double nominal_mm = 0, plus_mm = 0, minus_mm = 0;
};

/// What LinuxCNC's COMP_FILE_TYPE makes of the second and third number of a line: the actual
/// positions, or what is to be added to the commanded position, nominal less actual.
enum class CompFileType { actual = 0, trim = 1 };

/// Rows that LinuxCNC takes of a file; the further ones it refuses one by one.
constexpr std::size_t kCompFileRows = 256;

/// The compensation file (COMP_FILE) of a joint of LinuxCNC, a line for each point: nominal,
/// forward, reverse.  LinuxCNC moves the motor to
///
///     p + trim(p),  trim = nominal - actual, by the sign of the velocity               (1)
///
/// with trim linear between the nominal positions and constant beyond the first and the last.
/// Trims stay at rest.  As the axis deviates at p + trim(p) instead of p, what remains is of
/// second order: a deviation of 20 um with a slope of 50 um/m leaves 1 nm.
///
/// Numbers have 6 decimals in mm, 7 in inches, so that rounding adds up to 1 nm.
/// Source: LinuxCNC 2.9, usrmotLoadComp (usrmotintf.cc), EMCMOT_SET_JOINT_COMP (command.c),
/// compute_screw_comp (control.c); INI configuration, JOINT section.  LinuxCNC itself ran files
/// of both types, see linuxcnc_compensation_test.
/// @param unit_mm  the machine's unit, 1 or 25.4
/// @throws std::domain_error without points, for more than kCompFileRows, or if their nominal
///   positions as written do not rise.
std::string comp_file(std::span<const CompensationPoint> points, CompFileType type,
                      double unit_mm);

/// The point of a line; nothing if it does not begin with three numbers, where LinuxCNC stops
/// reading.
std::optional<CompensationPoint> comp_file_point(std::string_view line, CompFileType type,
                                                 double unit_mm);

}  // namespace turnwright::volumetric
