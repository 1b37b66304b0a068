#include "turnwright/gcode/nc_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "turnwright/base/errors.hpp"

namespace turnwright::gcode::nc_writer_test {
namespace {

std::string printed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

// Random values of all sizes, in mm and inches, which get two decimals more, with every number
// of decimals, 0.3 of the last one away from where rounding turns.  What printf writes as a
// negative zero has no sign here.
TEST(NcWriter, CoordinatesAreWrittenAsPrintfWritesThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> power(-10, 3), sign(-1, 1);
  const NcSetup setup;
  for (int decimals = 0; decimals <= 9; ++decimals) {
    NcWriter writer(setup, decimals);
    for (int i = 0; i < 2000; ++i) {
      NcMove move{.moves = true, .inch = i % 2 == 0, .before = "M8", .after = "M9"};
      const double unit = move.inch ? 25.4 : 1;
      const int written_decimals = decimals + (move.inch ? 2 : 0);
      Vec3 tip;
      std::string expected = i == 0 ? "M8 G1 G90" : "M8 G1";
      for (std::size_t k = 0; k < 3; ++k) {
        const double scale = std::pow(10, written_decimals),
                     units = std::floor(std::pow(10, power(random)) * scale) + 0.3;
        tip[k] = std::copysign(units / scale, sign(random)) * unit;
        auto text = printed(tip[k] / unit, written_decimals);
        if (text.find_first_of("123456789") == text.npos && text[0] == '-')
          text.erase(0, 1);
        if (written_decimals == 0) text += '.';
        expected += std::string(" ") + "XYZ"[k] + text;
      }
      ASSERT_EQ(writer.block(move, tip, true, true), expected + " M9");
    }
  }
}

TEST(NcWriter, TellsThePositionAsWritten) {
  NcWriter writer({}, 3);
  Vec3 tip{1.23456, -0.0004, -10};
  const NcMove move{.moves = true, .rapid = true, .origin_mm = {0, 0, -10}};
  EXPECT_EQ(writer.block(move, tip, true, true), "G0 G90 X1.235 Y0.000 Z0.000");
  EXPECT_NEAR(tip[0], 1.235, 1e-15);
  EXPECT_EQ(tip[1], 0);
  EXPECT_EQ(tip[2], -10);
  EXPECT_EQ(writer.written(move, {1.23456, 0, 0})[0], writer.step_mm(move, 0) * 1235);
  Vec3 far{1e13, 0, 0}, none{std::numeric_limits<double>::quiet_NaN(), 0, 0};
  EXPECT_THROW(writer.block(move, far, true, true), ModelRangeError);
  EXPECT_THROW(writer.block(move, none, true, true), ModelRangeError);
}

}  // namespace
}  // namespace turnwright::gcode::nc_writer_test
