#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "turnwright/gcode/read_nc.hpp"

/// Positions of NC programs that are read.
namespace turnwright::gcode::test {

using Lines = std::vector<std::string_view>;

inline Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double norm(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

inline std::vector<Vec3> targets(const NcProgram& p) {
  std::vector<Vec3> out;
  for (const NcMove& m : p.moves)
    if (m.moves) out.push_back(m.target_mm);
  return out;
}

inline void near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LE(norm(difference(a, b)), tolerance)
      << a[0] << ' ' << a[1] << ' ' << a[2] << " for " << b[0] << ' ' << b[1] << ' '
      << b[2];
}

}  // namespace turnwright::gcode::test
