#include "turnwright/gcode/dialect.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace turnwright::gcode {
namespace {

using std::string_view;

constexpr std::array<string_view, 6> kG54To59{"G54", "G55", "G56", "G57", "G58", "G59"};
constexpr std::span<const string_view> kG54To57{kG54To59.data(), 4};

constexpr std::array kDialects{
    Dialect{
        .control = Control::linuxcnc,
        .id = "linuxcnc",
        .name = "LinuxCNC",
        .extension = ".ngc",
        .begin = "%",
        .start = "G18 G21 G40 G80 G90 G95 G7 G61 {offset}",
        .end = "M30\n%",
        .programs = 0,
        .work_offsets = kG54To59,
        .reference = "G28",
        .comment = "({})",
        .upper_case = false,
        .longest = 200,
        .tool = "T{tool} M6\nG43 H{offset}",
        .offset = OffsetNumber::of_tool,
        .surface_speed = "G96 D{limit} S{S} {turn}",
        .thread = "G33",
        .lead = 'K',
        .thread_returns = false,
        .thread_cycle = "G76 P{lead} Z{Z} I{peak_d} J{first_d} K{depth_d} R2 Q0 H0 E0 L0",
        .tap = "G33.1 Z{Z} K{lead}",
        .point = false,
        .decimals = 4,
        .centre_decimals = 5,
        .S_decimals = 2},
    Dialect{
        .control = Control::fanuc,
        .id = "fanuc",
        .name = "Fanuc, system A",
        .extension = ".nc",
        .begin = "%\nO{program:04}",
        .start = "G18 G21 G40 G99 {offset}",
        .end = "M30\n%",
        .programs = 9999,
        .work_offsets = kG54To59,
        .reference = "G28 U0. W0.",
        .comment = "({})",
        .upper_case = true,
        .longest = 200,
        .tool = "T{tool:02}{offset:02}",
        .offset = OffsetNumber::free,
        .surface_speed = "G50 S{limit}\nG96 S{S} {turn}",
        .thread = "G32",
        .lead = 'F',
        .thread_returns = false,
        .thread_cycle =
            "G76 P010000 Q{least_um} R0.\nG76 X{X} Z{Z} P{depth_um} Q{first_um} F{lead}",
        .tap = "M29 S{S}\nG84 Z{Z} R0. F{lead}\nG80",
        .point = true,
        .decimals = 3,
        .centre_decimals = 3,
        .S_decimals = 0},
    Dialect{
        .control = Control::fanuc_b,
        .id = "fanuc-b",
        .name = "Fanuc, system B",
        .extension = ".nc",
        .begin = "%\nO{program:04}",
        .start = "G18 G21 G40 G80 G90 G95 {offset}",
        .end = "M30\n%",
        .programs = 9999,
        .work_offsets = kG54To59,
        .reference = "G91 G28 X0. Z0.\nG90",
        .comment = "({})",
        .upper_case = true,
        .longest = 200,
        .tool = "T{tool:02}{offset:02}",
        .offset = OffsetNumber::free,
        .surface_speed = "G92 S{limit}\nG96 S{S} {turn}",
        .thread = "G33",
        .lead = 'F',
        .thread_returns = false,
        .thread_cycle =
            "G76 P010000 Q{least_um} R0.\nG76 X{X} Z{Z} P{depth_um} Q{first_um} F{lead}",
        .tap = "M29 S{S}\nG84 Z{Z} R0. F{lead}\nG80",
        .point = true,
        .decimals = 3,
        .centre_decimals = 3,
        .S_decimals = 0},
    Dialect{.control = Control::haas,
            .id = "haas",
            .name = "Haas",
            .extension = ".nc",
            .begin = "%\nO{program:05}",
            .start = "G18 G21 G40 G80 G99 {offset}",
            .end = "M30\n%",
            .programs = 99999,
            .work_offsets = kG54To59,
            .reference = "G53 G0 X0.\nG53 G0 Z0.",
            .comment = "({})",
            .upper_case = true,
            .longest = 200,
            .tool = "T{tool}{offset:02}",
            .offset = OffsetNumber::free,
            .surface_speed = "G50 S{limit}\nG96 S{S} {turn}",
            .thread = "G32",
            .lead = 'F',
            .thread_returns = false,
            .thread_cycle = "M24\nG76 X{X} Z{Z} K{depth} D{first} F{lead}",
            .tap = "G84 Z{Z} R{R} F{lead}\nG80",
            .point = true,
            .decimals = 3,
            .centre_decimals = 3,
            .S_decimals = 0},
    Dialect{.control = Control::siemens_iso,
            .id = "siemens-iso",
            .name = "Siemens 840D, ISO mode",
            .extension = ".mpf",
            .begin = "G291",
            .start = "G18 G21 G40 G80 G90 G95 {offset}",
            .end = "M30",
            .programs = 0,
            .work_offsets = kG54To59,
            .reference = "G91 G28 X0. Z0.\nG90",
            .comment = "({})",
            .upper_case = true,
            .longest = 200,
            .tool = "T{tool:02}{offset:02}",
            .offset = OffsetNumber::free,
            .surface_speed = "G92 S{limit}\nG96 S{S} {turn}",
            .thread = "G33",
            .lead = 'F',
            .thread_returns = false,
            .thread_cycle = "",
            .tap = "M29 S{S}\nG84 Z{Z} R0. F{lead}\nG80",
            .point = true,
            .decimals = 3,
            .centre_decimals = 3,
            .S_decimals = 0},
    Dialect{.control = Control::siemens,
            .id = "siemens",
            .name = "Siemens 840D",
            .extension = ".mpf",
            .begin = "",
            .start = "G18 G40 G710 G90 G95 DIAMON {offset}",
            .end = "M30",
            .programs = 0,
            .work_offsets = kG54To57,
            .reference = "G75 FP=1 X1=0 Z1=0",
            .comment = "; {}",
            .upper_case = false,
            .longest = 200,
            .tool = "T{tool} D{offset}",
            .offset = OffsetNumber::edge,
            .surface_speed = "G96 S{S} LIMS={limit} {turn}",
            .thread = "G33",
            .lead = 'K',
            .thread_returns = false,
            .thread_cycle = "",
            .tap = "SPOS=0\nG331 Z{Z} K{lead} S{S}\nG332 Z{R} K{lead}",
            .point = false,
            .decimals = 3,
            .centre_decimals = 3,
            .S_decimals = 0},
    Dialect{.control = Control::okuma,
            .id = "okuma",
            .name = "Okuma OSP",
            .extension = ".min",
            .begin = "O{program:04}",
            .start = "G18 G40 G90 G95",
            .end = "M30",
            .programs = 9999,
            .work_offsets = {},
            .reference = "G20 HP=1",
            .comment = "({})",
            .upper_case = true,
            .longest = 150,
            .tool = "T{offset:02}{tool:02}{offset:02}",
            .offset = OffsetNumber::free,
            .surface_speed = "G50 S{limit}\nG96 S{S} {turn}",
            .thread = "G33",
            .lead = 'F',
            .thread_returns = true,
            .thread_cycle = "",
            .tap = "G77 X0 Z{Z} F{lead}",
            .point = false,
            .decimals = 3,
            .centre_decimals = 3,
            .S_decimals = 0}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kDialects.size(); ++i)
    if (static_cast<std::size_t>(kDialects[i].control) != i) return false;
  return kDialects.back().control == Control::okuma;
}
static_assert(in_order(), "a row for every control, in their order");

}  // namespace

std::span<const Dialect> dialects() { return kDialects; }

const Dialect& dialect(Control control) {
  return kDialects[static_cast<std::size_t>(control)];
}

double cut_off(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return std::floor(value * scale * (1 + 1e-12)) / scale;
}

}  // namespace turnwright::gcode
