#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "turnwright/review/program.hpp"

/// Moves of programs for tests.
namespace turnwright::review::test {

using gcode::Control;
using toolpath::Move;

inline TurningProgram read(Control control, const std::string& text) {
  return read_program(text, {.control = control, .n_max_rpm = 4000});
}

inline std::vector<Move> moves(const TurningProgram& p) {
  std::vector<Move> all;
  for (const auto& run : p.runs)
    for (const auto& m : run.moves) all.push_back(m.to);
  return all;
}

/// As "G0 20 -5", radii and places with as few decimals as they have.
inline std::vector<std::string> ways(const TurningProgram& p) {
  std::vector<std::string> all;
  for (const auto& m : moves(p)) {
    char text[64];
    const char* code = m.kind == Move::Kind::rapid  ? "G0"
                       : m.kind == Move::Kind::feed ? "G1"
                       : m.kind == Move::Kind::arc  ? m.clockwise ? "G2" : "G3"
                                                    : "G33";
    std::snprintf(text, sizeof text, "%s %.6g %.6g", code, m.x_mm, m.z_mm);
    all.push_back(text);
  }
  return all;
}

inline void expect_at(const Move& m, double x, double z) {
  EXPECT_NEAR(m.x_mm, x, 1e-9);
  EXPECT_NEAR(m.z_mm, z, 1e-9);
}

inline void expect_understood(const TurningProgram& p) {
  for (const auto& u : p.unknown)
    ADD_FAILURE() << u.line << ": " << u.what << ": " << u.why;
}

/// The ends that X has after the first move, as diameters, of a program that is understood.
inline std::vector<double> diameters_after_start(Control control,
                                                 const std::string& text) {
  const auto p = read(control, text);
  expect_understood(p);
  std::vector<double> all;
  for (const auto& m : moves(p)) all.push_back(2 * m.x_mm);
  all.erase(all.begin());
  return all;
}

/// ways() after the first move, of a program that is understood.
inline std::vector<std::string> ways_after_start(Control control,
                                                 const std::string& text) {
  const auto p = read(control, text);
  expect_understood(p);
  auto all = ways(p);
  all.erase(all.begin());
  return all;
}

}  // namespace turnwright::review::test
