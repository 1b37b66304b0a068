#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "turnwright/gcode/dialect.hpp"
#include "turnwright/toolpath/setup_program.hpp"

/// Reading turning programs that others have written.
namespace turnwright::review {

/// Something in a program that is not understood, or not known.
struct Unknown {
  std::size_t line = 0;  ///< from 1; 0: of the whole program
  std::string what;      ///< as it stands there
  std::string why;       ///< one sentence
};

/// The lines whose words F and S are in force; 0: none.
struct WordsInForce {
  std::size_t F_line = 0, S_line = 0;
  bool per_minute = false;  ///< F
};

/// On which side of its way the tool's nose keeps, looking along it with X up and Z to the
/// right: G41 left, G42 right.
enum class NoseSide { none, left, right };
struct NoseCompensation {
  NoseSide side = NoseSide::none;
  double radius_mm = 0;  ///< that the program gives (LinuxCNC's G41.1); 0: the tool's
};

/// A move of the tip as a block, or a block of a cycle, commands it; with compensation the
/// line that the nose touches.
struct ReadMove {
  std::optional<toolpath::Point> from = {};  ///< none: from a place that is not known
  toolpath::Move to;
  std::size_t line = 0;
  WordsInForce words = {};
  NoseCompensation nose = {};
  double from_y_mm = 0;  ///< of a driven tool
};

/// Moves at one tool, spindle speed and feed, or a stop.
struct Run {
  toolpath::Step step;  ///< conditions alone: neither comments nor moves; of driven tools
                        ///< `milling`
  std::vector<ReadMove> moves = {};
  double wait_min = 0;  ///< dwells between and behind them
};

struct TurningProgram {
  std::vector<Run> runs;
  /// Tools by the number that comments give them as programs of `nc` do:
  /// "T1 PCLNL-CNMG120408-PM, corner 0.8 mm".
  std::map<int, std::string> named_tools;
  std::vector<Unknown> unknown;
  std::vector<std::string> assumed;  ///< sentences
};

struct ReadOptions {
  gcode::Control control = gcode::Control::linuxcnc;
  double n_max_rpm = 0;  ///< the machine's, until the program limits the spindle
  std::size_t moves_max = 50'000;  ///< reading stops at the line that exceeds it
};

/// Reads the moves of a program for the XZ plane.  Radii and places are the program's, of
/// the imaginary tip; diameters are halved, inches converted.
///
/// It interprets G0 to G3 (centre by I and K from the start, or R), threads by G32 or G33,
/// absolute and incremental coordinates (G90, G91; U and W in system A), units, diameters
/// (G7, G8, DIAMON, DIAMOF), G96, G97 and the spindle's limit, feed per revolution and per
/// minute, tools, M0 and M1, and these cycles:
///
///     fanuc, haas     G90, G94 (straight), G92, G76 (Fanuc's two blocks, Haas' one), G71
///                     and G72 of contours that go one way in X and in Z, G73, G70, G74,
///                     G75, in two blocks or one; G83, G85, of Haas G81, G82, G89
///     fanuc-b         G76, G83, G85
///     linuxcnc        G70 to G72, G71.1, G72.1; G76, G73, G81 to G83, G85, G89
///     okuma           G33 comes back to where it began; G85 to G87 of LAP, G74
///     siemens         CYCLE81 to 85, 840, 95, 97
///
/// Threads of a cycle become plain moves, the k-th cut of a depth
///
///     d_k = d_1 k^(1/R), R = 2 but for LinuxCNC's word R, until the whole depth.       (1)
///
/// Variables, expressions, subprograms, branches and loops are executed: LinuxCNC's O words
/// and #<name>, Fanuc's macro B, M97, M98, M99 and G65 to G67, Siemens' R and DEF, IF to UNTIL,
/// labels and programs by name, Okuma's V, IF, GOTO and CALL; at most 200,000 lines beyond each
/// once, and calls ten deep.
///
/// Moves while the main spindle is an axis (C, Y, codes of driven tools) have `milling`: they
/// are not reviewed, which is told once a tool, but take time, and the place behind them is
/// known.
///
/// Reference returns move the tool to a place that is not known.  Everything else is listed
/// under `unknown` with its line, and reading goes on; after a line that may have moved the
/// tool its place is not known until both coordinates are given.  Moves with tool nose radius
/// compensation (G41, G42) have what the program says; nose_path.hpp makes the tip's way of
/// them.
/// Source: the controls' manuals in docs/bibliography.md; (1) is LinuxCNC's degression.
TurningProgram read_program(std::string_view text, const ReadOptions& options);

}  // namespace turnwright::review
