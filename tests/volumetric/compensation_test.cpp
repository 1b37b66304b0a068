#include "turnwright/volumetric/compensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "machines.hpp"
#include "turnwright/volumetric/kinematics.hpp"

namespace turnwright::volumetric {
namespace {

using Lines = std::vector<std::string_view>;

Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double norm(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

std::vector<Vec3> targets(const NcProgram& p) {
  std::vector<Vec3> out;
  for (const NcMove& m : p.moves)
    if (m.moves) out.push_back(m.target_mm);
  return out;
}

void near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LE(norm(difference(a, b)), tolerance)
      << a[0] << ' ' << a[1] << ' ' << a[2] << " for " << b[0] << ' ' << b[1] << ' '
      << b[2];
}

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
      "G41 D1",   "G81 Z-5 R2",  "G28 X0",    "G92 X0",   "X1 A5",      "#1=3",
      "X[1+2]",   "M98 P10",     "/X5",       "G2 X5 Y0", "G1 X",       "G1 XNaN",
      "G1 X1e9",  "G1 X1 X2",    "G55",       "G43 H7",   "G33 Z-5 K1", "G91.1",
      "G0 G1 X1", "G1 X1 I2",    "(open",     "G2 X9 I3", "G53 X0",     "G93",
      "O10 X1",   "G2 X9 K3 Y1", "G10 L2 P1", "X1 U2",    "!",          "G3 X8 Y0 R1"};
  for (const auto line : wrong) {
    const auto p = read_nc({"G1 X1 F100", line, "X3"}, {});
    ASSERT_EQ(p.problems.size(), 1u) << line;
    EXPECT_EQ(p.problems[0].line, 2u) << line;
  }
  EXPECT_EQ(read_nc({"Y1"}, {.axes = "XZ"}).problems.size(), 1u);
  for (const auto line : {"G4 P1.5", "G4 X2", "G50 S2000", "G96 S200 M3", "G95 F0.2",
                          "(X[1])", "; #1", "", "  ", "M6 T1", "G40", "n5g1x2", "X+1.5"})
    EXPECT_TRUE(read_nc({line}, {}).problems.empty()) << line;
}

/// The seed's scales and squareness, with bows along all axes and play.
Machine seed_machine() {
  Machine m{"wfXYZt", {}, {{'X', {}, 100}, {'Y', {}, 100}, {'Z', {}, 100}}};
  m.axes[0].errors[0].c = {0, 9e-3, 1e-3, -2e-4};
  m.axes[1].errors[1].c = {0, 11.25e-3, -8e-4, 1e-4};
  m.axes[2].errors[2].c = {0, 7.667e-3, 6e-4, 3e-4};
  m.axes[0].errors[1].c[2] = 2e-3;
  m.axes[1].errors[2].c[2] = -1e-3;
  m.axes[2].errors[3].c[1] = 1e-5;
  m.axes[0].location[4] = -35e-6;
  m.axes[2].location[4] = 20e-6;
  return m;
}

// 8 x 8 x 8 points over the seed's moves, each reached from below.
std::vector<std::string> grid() {
  std::vector<std::string> out;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k)
        out.push_back("G0 X" + std::to_string(200.0 * i / 7) + " Y" +
                      std::to_string(400.0 * j / 7) + " Z" +
                      std::to_string(300.0 * k / 7));
  return out;
}

Lines views(const std::vector<std::string>& lines) {
  return {lines.begin(), lines.end()};
}

TEST(Compensation, MethodsOnTheSeedsVolume) {
  const auto lines = grid();
  const NcProgram p = read_nc(views(lines), {});
  const auto run = [&](Method method, int passes) {
    return compensate(p, seed_machine(), {}, {.method = method, .passes = passes});
  };
  const auto average = run(Method::average, 1), affine = run(Method::affine, 1),
             one = run(Method::full_field, 1), two = run(Method::full_field, 2);
  EXPECT_EQ(two.points, 512u);
  EXPECT_LT(average.after.rms_mm, average.before.rms_mm);
  EXPECT_LT(affine.after.rms_mm, average.after.rms_mm / 4);
  EXPECT_LT(one.after.rms_mm, affine.after.rms_mm / 10);
  EXPECT_LT(two.after.max_mm, 1e-6);
  // A shift changes no distance between points.
  const Kinematics k(seed_machine());
  const auto stretch = [&](const Compensated& c) {
    const auto first = targets(read_nc(views(c.lines), {}));
    const auto goal = targets(p);
    double square = 0;
    for (std::size_t i = 1; i < first.size(); ++i) {
      const auto tip = [&](std::size_t n) {
        return k.actual({.q = {first[n][0], first[n][1], first[n][2]}}).tip_mm;
      };
      const double d =
          norm(difference(tip(i), tip(0))) - norm(difference(goal[i], goal[0]));
      square += d * d;
    }
    return std::sqrt(square / static_cast<double>(first.size() - 1));
  };
  auto raw = run(Method::full_field, 1);
  raw.lines = lines;
  EXPECT_NEAR(stretch(average), stretch(raw), 1e-5);
  EXPECT_GT(stretch(raw), 1e-2);
  EXPECT_LT(stretch(two), 2e-6);
}

// The corrected program, read again and run on the machine, goes where the source should.
TEST(Compensation, CorrectedProgramReachesItsTargets) {
  Machine m = seed_machine();
  m.axes[0].errors[0].b = -2e-3;
  m.axes[1].errors[0].b = 1e-3;
  const std::vector<std::string_view> source = {
      "G21 G90 G17",     "G0 X10 Y10 Z5", "G1 Z-2 F100",        "X150 Y30",
      "G3 X150 Y90 J30", "G91 G1 X-100",  "G90 G2 X20 Y60 R30", "G1 X20 Y10 Z0 M9"};
  const NcSetup setup{.tolerance_mm = 1e-3};
  const NcProgram p = read_nc(source, setup);
  ASSERT_TRUE(p.problems.empty()) << p.problems[0].got;
  const Compensated c = compensate(p, m, setup);
  EXPECT_GT(c.before.max_mm, 0.01);
  EXPECT_LT(c.after.max_mm, 1e-6);
  const NcProgram again = read_nc(views(c.lines), setup);
  ASSERT_TRUE(again.problems.empty());
  const auto written = targets(again);
  ASSERT_EQ(written.size(), c.points);
  EXPECT_TRUE(c.lines.back().ends_with(" M9"));
  for (const std::string& line : c.lines) EXPECT_EQ(line.find("G2 "), std::string::npos);
  // Without errors nothing is corrected.
  for (Axis& axis : m.axes) axis = {axis.name, {}, 100};
  EXPECT_LT(compensate(p, m, setup).largest_correction_mm, 1e-6);  // as written
}

TEST(Compensation, PlayIsTakenUpWhereAnAxisTurnsBack) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[0].b = -3e-3;  // lost motion 6 um
  const NcSetup setup{.axes = "XY"};
  const auto p = read_nc({"G1 X10 F100", "Y5", "X20", "X0"}, setup);
  const Compensated c = compensate(p, m, setup);
  ASSERT_EQ(c.lines.size(), 6u);
  EXPECT_EQ(c.lines[0], "F100 G1 G90 X0.003000 Y0.000000");  // from rest, s = 0
  EXPECT_EQ(c.lines[1], "G1 X10.003000 Y0.000000");
  EXPECT_EQ(c.lines[2], "G1 X10.003000 Y5.000000");  // X stays on its side
  EXPECT_EQ(c.lines[3], "G1 X20.003000 Y5.000000");
  EXPECT_EQ(c.lines[4], "G1 X19.997000 Y5.000000");
  EXPECT_EQ(c.lines[5], "G1 X-0.003000 Y5.000000");
  EXPECT_EQ(c.added, 2u);
  const Compensated none = compensate(p, m, setup, {.at_rest = AtRest::none});
  EXPECT_NE(std::ranges::find(none.lines, "G1 X10.000000 Y5.000000"), none.lines.end());
}

TEST(Compensation, LongMovesFollowABow) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[1].c[2] = 10e-3;
  const NcSetup setup{.axes = "XY"};
  const auto p = read_nc({"G1 X200 F100"}, setup);
  const Compensated c = compensate(p, m, setup, {.tolerance_mm = 1e-3});
  // A chord of length h leaves 10 um (h/200)^2: 4 pieces 0.6 um each.
  EXPECT_EQ(c.points, 4u);
  EXPECT_EQ(c.lines[1], "G1 X100.000000 Y-0.010000");
}

TEST(Compensation, LatheInDiametersAndInches) {
  Machine m{"wCfZXt", {}, {{'C', {}, units::kPi}, {'Z', {}, 100}, {'X', {}, 100}}};
  m.axes[2].errors[0].c[1] = 3e-3;  // 30 ppm on X
  const NcSetup setup{.axes = "XZ", .diameter = true, .lathe = true};
  const auto mm = compensate(read_nc({"G0 X60 Z0"}, setup), m, setup);
  // 60 mm would come out 1.8 um too large.
  EXPECT_EQ(mm.lines[0], "G0 G90 X59.998200 Z0.000000");
  const auto inch = compensate(read_nc({"G20", "G0 X2 Z0"}, setup), m, setup);
  EXPECT_EQ(inch.lines[1], "G0 G90 X1.99994000 Z0.00000000");
}

}  // namespace
}  // namespace turnwright::volumetric
