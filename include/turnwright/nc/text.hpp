#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/gcode/dialect.hpp"
#include "turnwright/nc/program.hpp"

/// Programs as text: a control's dialect with a shop's settings.
namespace turnwright::nc {

using gcode::Control;

enum class BlockNumbers {
  none,
  tools,  ///< blocks that call a tool, by ten for each operation
  all     ///< N1, N2, .., after N9999 from the beginning
};

/// The spindle's sense while turning.  Drills and threads always run with M3: with M4 a
/// right-hand drill does not cut, and a thread towards the chuck becomes left-handed.
enum class SpindleTurn { M3, M4 };

/// A tool by the id that programs list, with the shop's number of it.
struct ShopTool {
  std::string id;
  int number = 0;
  std::optional<int> offset = std::nullopt;  ///< if not the usual one
};

/// The codes of a machine's builder for axis C and driven tools; empty: the control's own,
/// if it has some.
struct MillingCodes {
  std::string c_axis_on = {}, c_axis_off = {};
  std::string lock = {}, unlock = {};  ///< of the main spindle while it holds the part
  std::string tool_on = {}, tool_off = {};  ///< {S} is the speed
};

struct Settings {
  Control control = Control::linuxcnc;
  int program_number = 1;        ///< of the first setup; the others count on
  std::string work_offset = {};  ///< empty: the control's first, if it has any
  BlockNumbers block_numbers = BlockNumbers::tools;
  SpindleTurn spindle = SpindleTurn::M3;
  std::string coolant = "M8";   ///< the code that turns it on; empty: none
  bool optional_stops = false;  ///< M1 before each change of the tool
  /// To the reference position at the start, before each change of the tool and at the
  /// end.  The program's minutes do not count these ways.
  bool reference_returns = false;
  /// Threads by the control's cycle for all cuts, if the dialect has one.  The controls
  /// of Fanuc repeat the last cut once more, which the program's minutes do not count.
  bool cycles = false;
  /// Holes by the control's drilling cycles.
  bool drill_cycles = false;
  MillingCodes milling = {};
  std::vector<ShopTool> tools = {};
};

/// The work offset that a program selects, "" if the control has none.
std::string work_offset(const Settings& settings);

/// Gives the tools of all programs of a part the shop's numbers and offsets.  Tools the
/// shop has not numbered get the numbers that are left, in their order of use.
void number_tools(std::vector<SetupProgram>& programs, const Settings& settings);

/// Why a control's programs do not mill with the settings: the codes that are missing, or
/// that it moves Y otherwise; empty if they do.
std::string cannot_mill(const Milling& milling, const Settings& settings);

/// Changes the programs to what a control can do with the settings (docs/nc.md): moves and
/// minutes are those of its own cycles where they peck in their own way, and where it
/// cannot mill, a stop stands for it.
void fit_to_control(std::vector<SetupProgram>& programs, const Settings& settings,
                    const catalogue::Lathe& machine);

/// The program's text, lines of printable ASCII.
/// @throws std::domain_error if it mills where the control cannot (fit_to_control).
std::string text(const SetupProgram& program, const Settings& settings);

/// LinuxCNC's tool table for programs of one part: numbers, diameters and orientations,
/// offsets zero.
std::string tool_table(const std::vector<SetupProgram>& programs);

}  // namespace turnwright::nc
