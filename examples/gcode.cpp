// The way of the tool in a program, arcs as chords.
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "turnwright/gcode/read_nc.hpp"

int main() {
  using namespace turnwright::gcode;
  const std::vector<std::string_view> program{
      "G18 G21 G90", "G0 X42 Z2", "G1 X40 Z0 F0.2", "Z-30", "G2 X50 Z-35 R5", "M30"};
  const auto read = read_nc(
      program, {.axes = "XZ", .diameter = true, .lathe = true, .start_mm = {50, 0, 50}});
  for (const auto& problem : read.problems)
    std::printf("line %zu: got %s, expected %s\n", problem.line, problem.got.c_str(),
                problem.expected.c_str());
  double feed_mm = 0;
  auto at = read.start_mm;
  for (const auto& move : read.moves) {
    if (!move.moves) continue;
    if (!move.rapid)
      feed_mm += std::hypot(move.target_mm[0] - at[0], move.target_mm[2] - at[2]);
    at = move.target_mm;
  }
  std::printf("%.3f mm at feed, to X %.1f mm (diameter), Z %.1f mm\n", feed_mm, 2 * at[0],
              at[2]);
  return read.problems.empty() ? 0 : 1;
}
