#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/catalogue/geometric_errors.hpp"

/// Reading part programs of ISO 6983 as straight moves of the tool tip.
namespace turnwright::gcode {

using catalogue::Vec3;

struct NcSetup {
  std::string axes = "XYZ";  ///< linear axes of the machine, in the order X Y Z
  bool diameter = false;     ///< X words are diameters until G8 says otherwise
  bool lathe = false;        ///< G18 at the start; T words of 3, 4 digits hold an offset
  double tolerance_mm = 1e-3;  ///< of chords against arcs
  Vec3 start_mm{};             ///< the tip at the start, in the first work frame
  /// Origins by "G54" .. "G59" [mm]; the first active is G54, zero unless given.
  std::map<std::string, Vec3> work_offsets_mm = {};
  /// Tool vectors by offset number (G43 H1, T0101) [mm], from the machine's tool point.
  std::map<int, Vec3> tool_offsets_mm = {};
  std::size_t moves_max = 2'000'000;  ///< reading stops at the line that exceeds it
};

/// A straight move of the tip, or a line that is passed on unchanged.
struct NcMove {
  std::size_t line = 0;  ///< line of the source, from 1
  bool moves = false;    ///< false: `before` is the whole line
  bool rapid = false;    ///< G0
  bool inch = false, diameter = false;
  Vec3 target_mm{};         ///< tip in the machine frame
  Vec3 origin_mm{};         ///< of the program's coordinates in the machine frame
  int tool = 0;             ///< offset number, 0 for none
  std::string before = {};  ///< words before the coordinates
  std::string after = {};   ///< words after the coordinates
};

struct NcProblem {
  std::size_t line = 0;
  std::string got, expected;
};

struct NcProgram {
  Vec3 start_mm{};  ///< tip in the machine frame
  std::vector<NcMove> moves;
  std::vector<NcProblem> problems;  ///< if any, `moves` is not to be used
  /// Line of the first coordinates if no motion code precedes them, in which case G0 is
  /// assumed; otherwise 0.
  std::size_t rapid_assumed = 0;
};

/// Reads the moves of a program.  It interprets G0 G1 G2 G3 (centre by I J K from the
/// start, or R), G17 to G19, G20 G21, G90 G91, G54 to G59, G43 H, G49, G7 G8 (X as
/// diameter, radius) and tool words.  It passes on G4, G40, G61, G64, G80, G94 to G99,
/// the speed limit of G50 or G92 with S alone, and M codes.  Numbers are mm or inches
/// with or without a point.  The motion is G0 until a code is given.  Arcs become chords
/// within the tolerance, divided also where an axis reverses; the end of an arc may
/// differ by 0.01 mm from the radius of its start, and ends within 1e-6 mm make a whole
/// circle, or a turn of a helix.
///
/// Selecting a tool offset moves no axis: the position then refers to another tip, and
/// axes that the next block does not name stay where they are (as in LinuxCNC).
///
/// Everything else is reported as a problem of its line: canned cycles (on lathes also
/// where they are named G90, G92, G94: codes are those of system B, in which G90 is
/// absolute), thread cutting, cutter radius compensation, G53, G28, G92 with axes, other
/// axes, variables, expressions, subprograms, coordinates after G80 without a motion, two
/// codes of one group in a block, words other than M repeated in a block, and block
/// delete except of N, M, S and F words.
///
/// The moves are absolute (G90); G2, G3, G90, G91 and arc words are dropped.
NcProgram read_nc(const std::vector<std::string_view>& lines, const NcSetup& setup);

}  // namespace turnwright::gcode
