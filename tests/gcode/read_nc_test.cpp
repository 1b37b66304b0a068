#include "turnwright/gcode/read_nc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "moves.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::gcode {
namespace {

using namespace test;

TEST(NcProgram, ReadsModalMoves) {
  const auto p = read_nc({"%", "O0001", "N10 G21 G90 G54 (start)", "G0 X10 Y-5.", "Z2",
                          "G1 Z-1 F200", "X20", "G91 X5 Y.5", "G20 G90 X1", "M30"},
                         {.work_offsets_mm = {{"G54", {100, 0, 0}}}});
  ASSERT_TRUE(p.problems.empty());
  const auto at = targets(p);
  ASSERT_EQ(at.size(), 6u);
  near(at[0], {110, -5, 0});
  near(at[1], {110, -5, 2});
  near(at[3], {120, -5, -1});
  near(at[4], {125, -4.5, -1});
  near(at[5], {125.4, -4.5, -1});
  EXPECT_TRUE(p.moves[3].rapid);
  EXPECT_FALSE(p.moves[5].rapid);
  EXPECT_EQ(p.moves[2].before, "N10 G21 G54 (start)");
}

TEST(NcProgram, ArcsStayWithinTheirTolerance) {
  struct Case {
    std::string_view plane, arc;
    Vec3 start, centre, normal;
    double sweep;  // right-handed about the normal [quarter turns]
  };
  const std::vector<Case> cases = {
      {"G17", "G3 X0 Y10 I-10", {10, 0, 0}, {0, 0, 0}, {0, 0, 1}, 1},
      {"G17", "G2 X0 Y10 I-10", {10, 0, 0}, {0, 0, 0}, {0, 0, 1}, -3},
      {"G17", "G3 X10 Y0 I-10 J0", {10, 0, 0}, {0, 0, 0}, {0, 0, 1}, 4},
      {"G17", "G3 X0 Y10 R10", {10, 0, 0}, {0, 0, 0}, {0, 0, 1}, 1},
      {"G17", "G3 X0 Y10 R-10", {10, 0, 0}, {10, 10, 0}, {0, 0, 1}, 3},
      {"G17", "G2 X0 Y10 R10", {10, 0, 0}, {10, 10, 0}, {0, 0, 1}, -1},
      {"G18", "G3 Z0 X10 K-10", {0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 1},
      {"G18", "G2 Z0 X10 K-10", {0, 0, 10}, {0, 0, 0}, {0, 1, 0}, -3},
      {"G19", "G3 Y0 Z10 J-10", {0, 10, 0}, {0, 0, 0}, {1, 0, 0}, 1}};
  for (const Case& c : cases) {
    const auto p = read_nc({c.plane, c.arc}, {.tolerance_mm = 1e-3, .start_mm = c.start});
    ASSERT_TRUE(p.problems.empty()) << c.arc;
    Vec3 from = c.start;
    double turned = 0;
    for (const Vec3& to : targets(p)) {
      const Vec3 a = difference(from, c.centre), b = difference(to, c.centre);
      EXPECT_NEAR(norm(b), 10, 1e-9) << c.arc;
      const Vec3 cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                          a[0] * b[1] - a[1] * b[0]};
      turned += std::asin(
          (cross[0] * c.normal[0] + cross[1] * c.normal[1] + cross[2] * c.normal[2]) /
          100);
      const Vec3 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
      EXPECT_LE(10 - norm(middle), 1e-3 * (1 + 1e-9)) << c.arc;
      from = to;
    }
    EXPECT_NEAR(turned, c.sweep * std::acos(0.0), 1e-9) << c.plane << c.arc;
  }
}

// However wide the tolerance: the play of an axis is taken up where it turns back.
TEST(NcProgram, ArcsAreCutWhereAnAxisReverses) {
  const std::vector<Vec3> extremes = {{10, 0, 0}, {0, 10, 0}, {-10, 0, 0}, {0, -10, 0}};
  for (const char* circle : {"G2 X8 Y6 I-8 J-6", "G3 X8 Y6 I-8 J-6"}) {
    const auto p = read_nc({circle}, {.tolerance_mm = 1, .start_mm = {8, 6, 0}});
    ASSERT_TRUE(p.problems.empty());
    for (const Vec3& at : extremes) {
      double nearest = 1e9;
      for (const Vec3& t : targets(p))
        nearest = std::min(nearest, norm(difference(t, at)));
      EXPECT_LT(nearest, 1e-9) << circle << ' ' << at[0] << ' ' << at[1];
    }
  }
}

TEST(NcProgram, LatheWordsAreDiameters) {
  const auto p =
      read_nc({"T0101", "G0 X40 Z5", "G1 Z-10", "G2 X50 Z-15 I5 K0", "G1 G8 X20"},
              {.axes = "XZ",
               .diameter = true,
               .lathe = true,
               .tool_offsets_mm = {{1, {1, 0, 2}}}});
  ASSERT_TRUE(p.problems.empty()) << p.problems[0].got;
  const auto at = targets(p);
  near(at[0], {20, 0, 5});
  near(at[at.size() - 2], {25, 0, -15});
  near(at.back(), {20, 0, -15});
  EXPECT_EQ(p.moves.back().tool, 1);
}

TEST(NcProgram, RefusesWithTheLine) {
  const std::vector<std::string_view> wrong = {
      "G41 D1", "G81 Z-5 R2", "G28 X0", "G92 X0", "X1 A5", "#1=3", "X[1+2]", "M98 P10",
      "/X5", "G2 X5 Y0", "G1 X", "G1 XNaN", "G1 X1e9", "G1 X1 X2", "G55", "G43 H7",
      "G33 Z-5 K1", "G91.1", "G0 G1 X1", "G1 X1 I2", "(open", "G2 X9 I3", "G53 X0", "G93",
      "O10 X1", "G2 X9 K3 Y1", "G10 L2 P1", "X1 U2", "!", "G3 X8 Y0 R1",
      // What a line that goes through may not change, and codes that exclude each other.
      "G4 P1 G91", "G50 S900 G91", "G90 G91 X1", "G20 G21", "G54 G59", "G94 G95",
      "G0 G3 X1 R9", "G4 P1 Z3", "G50 S9 M8",
      // Offsets: none selected in silence.
      "G43", "H1", "G49 H1", "T1.5", "T-1", "G43 H1.5",
      // Controls that go elsewhere or come back with other states.
      "M47", "M70", "M72", "M99", "M3.5", "M-3", "/G91", "/M98 P1", "/2 Z3", "/T0101",
      "X+-5", "X--5", "X 1 0", "X1e2", "X0x10", "G100", "G-1", "G64 P.1 L2", "P1", "D2",
      "X\xc3\xa4", "\xc3\xa4", "\x1b[1m",
      // Ends of lines and tapes that controls see elsewhere.
      "X1\rY2", "; stop\rX5", "(a\rb)", "X1\r\r", "% X5", "%O10", "%(open", "X5 %"};
  for (const auto line : wrong) {
    const auto p = read_nc({"G1 X1 F100", line, "X3"}, {});
    ASSERT_EQ(p.problems.size(), 1u) << line;
    EXPECT_EQ(p.problems[0].line, 2u) << line;
  }
  EXPECT_EQ(read_nc({"Y1"}, {.axes = "XZ"}).problems.size(), 1u);
  for (const auto line : {"G4 P1.5",
                          "G4 X2",
                          "G50 S2000",
                          "G96 S200 M3",
                          "G95 F0.2",
                          "(X[1])",
                          "; #1",
                          "",
                          "  ",
                          "M6 T1",
                          "G40",
                          "n5g1x2",
                          "X+1.5",
                          "X5.",
                          "X-.5",
                          "/M8",
                          "/2 N5 M1 (stop)",
                          "G64 P0.01 Q0.02",
                          "G96 S200 D2500 M3",
                          "G4 U2",
                          "g00 x1 y2",
                          "N5 G 1 X 3",
                          "G0 G17 G21 G40 G49 G80 G90 G94 G98",
                          "X1\tY2\r",
                          "%",
                          " % (end)\r",
                          "\r"})
    EXPECT_TRUE(read_nc({line}, {}).problems.empty()) << line;
}

// A letter that is no ASCII is told whole: the message stays UTF-8.
TEST(NcProgram, QuotesWholeCharacters) {
  const auto p = read_nc(
      {"\xc3\xa4 X1", "X\xe2\x82\xac\xe2\x82\xac\xe2\x82\xac\xe2\x82\xac", "\x1b"}, {});
  ASSERT_EQ(p.problems.size(), 3u);
  EXPECT_EQ(p.problems[0].got, "\"\xc3\xa4\"");
  EXPECT_EQ(p.problems[1].got, "\"X\xe2\x82\xac\xe2\x82\xac\xe2\x82\xac\xe2\x82\xac\"");
  EXPECT_EQ(p.problems[2].got, "\"?\"");
}

// G43, G49 and T move no axis: the tip looked at changes, and with it the coordinates of
// those axes that the next block does not name.
TEST(NcProgram, OffsetsOfToolsMoveNoAxis) {
  const NcSetup mill{.tool_offsets_mm = {{1, {0, 0, -100}}, {2, {3, 0, -80}}}};
  const auto p = read_nc(
      {"G0 X5 Y6 Z200", "G43 H1", "X10", "G91 Z-10", "G43 H2", "G90 Y0", "G49 X0"}, mill);
  ASSERT_TRUE(p.problems.empty());
  const auto at = targets(p);
  near(at[0], {5, 6, 200});
  near(at[1], {10, 6, 100});  // Z stands at 200
  near(at[2], {10, 6, 90});
  near(at[3], {13, 0, 110});  // tool 2 is 20 mm shorter
  near(at[4], {0, 0, 190});
  const NcSetup lathe{.axes = "XZ", .lathe = true, .tool_offsets_mm = {{4, {2, 0, -7}}}};
  near(targets(read_nc({"G0 X50 Z30", "T0704", "X20", "T0700 Z0"}, lathe))[1],
       {20, 0, 23});
}

TEST(NcProgram, WholeCirclesSurviveRounding) {
  const double x = 0.1 + 0.2;  // not the 0.3 of the block
  for (const char* circle : {"G2 X0.3 Y0 I5", "G3 X0.3 I5", "G2 I5", "G3 Y0 I5 J0"}) {
    const auto p = read_nc({circle}, {.start_mm = {x, 0, 0}});
    ASSERT_TRUE(p.problems.empty()) << circle;
    double least = 1e9, most = -1e9;
    for (const Vec3& t : targets(p)) {
      least = std::min(least, t[0]);
      most = std::max(most, t[0]);
    }
    EXPECT_NEAR(most - least, 10, 1e-9) << circle;
  }
  // A helix of one turn: height in proportion to the angle.
  const auto p = read_nc({"G3 X10 Y0 Z-2 I-10"}, {.start_mm = {10, 0, 0}});
  for (const Vec3& t : targets(p)) {
    const double angle = std::atan2(t[1], t[0]);
    const double turns = angle / (2 * units::kPi) + (angle > 1e-9 ? 0 : 1);
    EXPECT_NEAR(t[2], -2 * turns, 1e-9);
  }
}

TEST(NcProgram, SaysWhereItAssumesARapid) {
  EXPECT_EQ(read_nc({"G90", "X5", "Y3"}, {}).rapid_assumed, 2u);
  EXPECT_EQ(read_nc({"G1 F100", "X5", "G0 Y3"}, {}).rapid_assumed, 0u);
  EXPECT_EQ(read_nc({"G2 X5 I2.5", "X5 I1"}, {}).rapid_assumed, 0u);
  EXPECT_EQ(read_nc({"M3", "%"}, {}).rapid_assumed, 0u);
}

TEST(NcProgram, AskForWhatTheyDoNotKnow) {
  // After G80 a control may be in any motion.
  auto p = read_nc({"G1 X1 F9", "G80", "X5", "G0 X7", "X8"}, {});
  ASSERT_EQ(p.problems.size(), 1u);
  EXPECT_EQ(p.problems[0].line, 3u);
  // An arc in a plane whose axis the machine lacks.
  p = read_nc({"G17", "G2 X9 I3", "G18 G2 X9 I4.5"}, {.axes = "XZ"});
  ASSERT_EQ(p.problems.size(), 1u);
  EXPECT_EQ(p.problems[0].got, "G17");
  // No word but G and M twice.
  p = read_nc({"G2 X10 R50 R5", "G2 X10 I3 I5", "G1 X1 F1 F2", "T1 T2", "M3 M8"}, {});
  ASSERT_EQ(p.problems.size(), 4u);
  EXPECT_EQ(p.problems[0].got, "R5");
  EXPECT_EQ(p.problems[0].expected, "R once in a block");
  EXPECT_EQ(p.problems[3].got, "T2");
  // Reading ends where there is no more room.
  p = read_nc({"G17 G1 X1", "G2 I90", "G1 X2", "X3"}, {.moves_max = 100});
  ASSERT_EQ(p.problems.size(), 1u);
  EXPECT_EQ(p.problems[0].line, 2u);
  EXPECT_EQ(p.problems[0].got, "more than 100 moves");
  // Coordinates that add up beyond reason.
  p = read_nc({"G91", "X900000", "X900000", "G20 X90000"}, {});
  ASSERT_EQ(p.problems.size(), 2u);
  EXPECT_EQ(p.problems[0].line, 3u);
}

TEST(NcProgram, IsLeftWhenNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_THROW(read_nc({"G1 X1"}, {}), Cancelled);
}

TEST(NcProgram, EndsOnce) {
  for (const char* end : {"M2", "N9 M30", "G0 X1 M02"}) {
    auto p = read_nc({"G0 X1", end, "", "(more)", "%"}, {});
    EXPECT_TRUE(p.problems.empty()) << end;
    p = read_nc({"G0 X1", end, "O2", "/M8"}, {});
    ASSERT_EQ(p.problems.size(), 2u) << end;
    EXPECT_EQ(p.problems[0].line, 3u);
    EXPECT_EQ(p.problems[0].got, "O2");
    EXPECT_EQ(p.problems[0].expected, "nothing but % and comments after M2 or M30");
    EXPECT_EQ(p.problems[1].got, "M8");
  }
  // A block that may be left out ends nothing; M20 is another code.
  EXPECT_TRUE(read_nc({"/M30", "M20", "G0 X1"}, {}).problems.empty());
}

TEST(NcProgram, ModesOfOneProgram) {
  const NcSetup setup{.axes = "XZ",
                      .diameter = true,
                      .lathe = true,
                      .work_offsets_mm = {{"G54", {0, 0, 100}}, {"G55", {1, 0, 50}}}};
  const auto good =
      read_nc({"O0007 (shaft)", "N10 G21 G90 G95 G54", "N20 G96 S180 M3", "N30 G0 X40 Z2",
               "N40 G91 X-10 Z-1", "N50 G90 G8 X10", "N60 G7 G20 X1", "N70 G55 Z1 (inch)",
               "N80 G21 G94 G97 S900 Z0"},
              setup);
  ASSERT_TRUE(good.problems.empty()) << good.problems[0].got;
  const auto at = targets(good);
  ASSERT_EQ(at.size(), 6u);
  near(at[0], {20, 0, 102});
  near(at[1], {15, 0, 101});
  near(at[2], {10, 0, 101});
  near(at[3], {12.7, 0, 101});
  near(at[4], {12.7, 0, 75.4});  // X stands still under the new origin
  near(at[5], {12.7, 0, 50});
  EXPECT_EQ(good.moves[7].before, "N70 G55");
  EXPECT_EQ(good.moves[7].after, "(inch)");
  EXPECT_EQ(good.moves[8].before, "N80 G21 G94 G97 S900");
}

}  // namespace
}  // namespace turnwright::gcode
