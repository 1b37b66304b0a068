#include "turnwright/volumetric/compensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../gcode/moves.hpp"
#include "machines.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/volumetric/kinematics.hpp"

namespace turnwright::volumetric {
namespace {

using namespace gcode::test;
using gcode::read_nc;

/// The scales and squareness of [Jha], with bows along all axes.
Machine paper_machine() {
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

// 8 x 8 x 8 points over the moves of [Jha], each reached from below.
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

TEST(Compensation, MethodsOnThePapersVolume) {
  const auto lines = grid();
  const NcProgram p = read_nc(views(lines), {});
  const auto run = [&](Method method, int passes) {
    return compensate(p, paper_machine(), {}, {.method = method, .passes = passes});
  };
  const auto average = run(Method::average, 1), affine = run(Method::affine, 1),
             one = run(Method::full_field, 1), two = run(Method::full_field, 2);
  EXPECT_EQ(two.points, 512u);
  EXPECT_LT(average.after.rms_mm, average.before.rms_mm);
  EXPECT_LT(affine.after.rms_mm, average.after.rms_mm / 4);
  EXPECT_LT(one.after.rms_mm, affine.after.rms_mm / 10);
  EXPECT_LT(two.after.max_mm, 1e-6);
  // A shift changes no distance between points.
  const Kinematics k(paper_machine());
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

// The part of that field which the paper gives, scales and squareness, over the travel of
// its machine, 630 x 600 x 600 mm: on n equal steps an axis has the mean L/2 and the
// variance L^2 (n + 1)/(12 (n - 1)), so that every RMS has a closed form.
TEST(Compensation, LinearFieldsHaveClosedForms) {
  Machine m{"wfXYZt", {}, {{'X', {}, 100}, {'Y', {}, 100}, {'Z', {}, 100}}};
  const double a = 90e-6, b = 112.5e-6, c = 230e-6 / 3, k1 = 35e-6, i2 = 20e-6;
  m.axes[0].errors[0].c[1] = 100 * a;
  m.axes[1].errors[1].c[1] = 100 * b;
  m.axes[2].errors[2].c[1] = 100 * c;
  m.axes[0].location[4] = -k1;  // X runs towards +Z
  m.axes[2].location[4] = i2;   // Z runs towards +X
  constexpr int n = 8;
  const Vec3 L{630, 600, 600};
  std::vector<std::string> lines;
  for (int i = 0; i < n * n * n; ++i)
    lines.push_back("G0 X" + std::to_string(L[0] * (i % n) / (n - 1)) + " Y" +
                    std::to_string(L[1] * (i / n % n) / (n - 1)) + " Z" +
                    std::to_string(L[2] * (i / n / n) / (n - 1)));
  const auto left = [&](Method method) {
    return compensate(read_nc(views(lines), {}), m, {}, {.method = method});
  };
  const auto variance = [&](std::size_t k) {
    return L[k] * L[k] * (n + 1) / (12.0 * (n - 1));
  };
  const double spread = (a * a + k1 * k1) * variance(0) + b * b * variance(1) +
                        (c * c + i2 * i2) * variance(2);
  const Vec3 mean{(a * L[0] + i2 * L[2]) / 2, b * L[1] / 2, (k1 * L[0] + c * L[2]) / 2};
  const Compensated average = left(Method::average);
  // Unit vectors and six decimals cost up to 1 nm.
  EXPECT_NEAR(average.before.rms_mm, std::sqrt(spread + norm(mean) * norm(mean)), 2e-6);
  EXPECT_NEAR(average.after.rms_mm, std::sqrt(spread), 2e-6);
  EXPECT_LT(left(Method::affine).after.max_mm, 3e-6);
  EXPECT_LT(left(Method::full_field).after.max_mm, 1e-6);
}

// The corrected program, read again and run on the machine, goes where the source should.
TEST(Compensation, CorrectedProgramReachesItsTargets) {
  Machine m = paper_machine();
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

/// Where the tip of a machine goes that keeps, of each axis, the side of its play:
/// motions read off the written coordinates alone.
std::vector<Vec3> made(const Machine& m, const std::vector<Vec3>& written, Vec3 at) {
  const Kinematics k(m);
  std::vector<Vec3> out;
  Position p;
  for (const Vec3& to : written) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(to[i] - at[i]) > 1e-9) p.sign[i] = to[i] > at[i] ? 1 : -1;
      p.q[i] = to[i];
    }
    at = to;
    out.push_back(k.actual(p).tip_mm);
  }
  return out;
}

// Axes that stand in the source follow the bows of others, back and forth: what the
// corrected program does is what it is said to do, with lost motion or overshoot.
TEST(Compensation, AxesThatFollowABowTurnBackToo) {
  for (const double b : {-5e-3, 2e-3}) {
    Machine m = paper_machine();
    m.axes[0].errors[1].c = {0, 0, 0.02, 0.004};
    m.axes[1].errors[1].b = b;
    m.axes[2].errors[2].b = b / 2;
    const NcSetup setup{.start_mm = {-60, -2, 1}};
    const auto p = read_nc({"G0 X-50 Y-1 Z0", "G1 F100 Y0", "X50", "X-50", "G0 X40 Y3",
                            "G1 Z-5", "X-80", "Y3 X30", "Z-4.999"},
                           setup);
    const Compensated c = compensate(p, m, setup);
    const NcProgram again = read_nc(views(c.lines), setup);
    const auto tips = made(m, targets(again), setup.start_mm);
    ASSERT_EQ(tips.size(), c.points);
    // The ends of the source's moves are among them, in their order.
    constexpr double kRounding = 1.5e-6;
    std::size_t at = 0;
    for (const Vec3& goal : targets(p)) {
      while (at < tips.size() && norm(difference(tips[at], goal)) > kRounding) ++at;
      ASSERT_LT(at, tips.size()) << b;
    }
    // Axes that overshoot their turns do so once more beyond the start of a feed.
    const double beyond = 2.01 * std::hypot(b, b / 2);
    EXPECT_LT(c.after.max_mm, b < 0 ? kRounding : beyond) << b;
    if (b < 0) {
      EXPECT_GT(c.added, 10u);
    }
  }
}

double distance_to_way(const Vec3& at, const Vec3& from, const Vec3& to) {
  const Vec3 way = difference(to, from), gone = difference(at, from);
  double along = 0, square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along += gone[k] * way[k];
    square += way[k] * way[k];
  }
  const double share = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return norm(
      {gone[0] - share * way[0], gone[1] - share * way[1], gone[2] - share * way[2]});
}

/// Farthest that the tip is from the source's feed moves anywhere on the corrected ones,
/// each axis dragged through its play; moves that take up play are short.
double farthest_from_way(const Machine& m, const NcProgram& source,
                         const NcProgram& corrected, const Vec3& start) {
  constexpr double kShort_mm = 0.1;
  const Kinematics k(m);
  double worst = 0;
  Position p;
  Vec3 at = start;
  for (const NcMove& move : corrected.moves) {
    if (!move.moves) continue;
    const Vec3 way = difference(move.target_mm, at);
    const auto side = p.sign;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      for (std::size_t i = 0; i < 3; ++i) {
        p.q[i] = at[i] + share * way[i];
        const double side_mm = -m.axes[i].errors[i].b;  // half the lost motion
        p.sign[i] = std::clamp(side[i] + share * way[i] / side_mm, -1.0, 1.0);
      }
      if (move.rapid || norm(way) < kShort_mm) continue;
      double nearest = 1e9;
      Vec3 from = start;
      for (const NcMove& s : source.moves) {
        if (!s.moves) continue;
        if (!s.rapid)
          nearest =
              std::min(nearest, distance_to_way(k.actual(p).tip_mm, from, s.target_mm));
        from = s.target_mm;
      }
      worst = std::max(worst, nearest);
    }
    at = move.target_mm;
  }
  return worst;
}

// An axis whose play is taken up moves others by the play across and by squareness, and
// these must not turn back for it: the way of the feed is right from its start.
TEST(Compensation, PlayTakenUpLeavesNoneToTheFeed) {
  std::mt19937 random(8);
  const auto within = [&random](double low, double high) {
    return low + (high - low) * std::generate_canonical<double, 53>(random);
  };
  for (int i = 0; i < 200; ++i) {
    Machine m = paper_machine();
    for (Axis& axis : m.axes)
      for (std::size_t j = 0; j < 6; ++j) {
        const double size = j < 3 ? 1 : 1e-3;
        axis.errors[j] = {};
        axis.errors[j].c[0] = size * within(-0.02, 0.02);
        axis.errors[j].c[1] = j < 3 ? within(-0.01, 0.01) : 0;
        axis.errors[j].b = i % 2 && j < 3 ? within(-1e-3, 1e-3) : 0;
      }
    // Play of less than a rounding's worth is left to the feed; that across is the less.
    for (std::size_t k = 0; k < 3; ++k) m.axes[k].errors[k].b = within(-5e-3, -1e-3);
    const NcSetup setup{.start_mm = {-60, -2, 1}};
    const auto p =
        read_nc({"G0 X-50 Y-1 Z0", "G1 F100 Z-5", "X50", "Y20", "X-50 Y10", "G0 Z20",
                 "X40 Y3", "G1 Z-5", "X-80", "Y3 X30 Z-10", "G0 X60 Y30", "G1 X50 Y-20",
                 "G0 X20", "G1 Y10", "G0 X-30", "G1 X-40"},
                setup);
    for (const int decimals : {3, 4, 6}) {
      const Compensated c = compensate(p, m, setup, {.decimals = decimals});
      const double step = std::pow(10.0, -decimals);
      EXPECT_LE(farthest_from_way(m, p, read_nc(views(c.lines), setup), setup.start_mm),
                3.5 * step + 1e-6)
          << i << ", " << decimals << " decimals";
    }
  }
}

// Once per turn, a spindle only makes the part run out of its own centre.
TEST(Compensation, ATurningSpindlesHarmonicsShiftNothing) {
  Machine m{"wCfZXt", {}, {{'C', {}, units::kPi}, {'Z', {}, 100}, {'X', {}, 100}}};
  m.axes[0].errors[0].f = {{6e-4, 0}, {4e-4, 1e-4}};
  m.axes[0].errors[2].f = {{6e-4, 0}};
  const NcSetup setup{.axes = "XZ", .diameter = true, .lathe = true};
  const auto p = read_nc({"G0 X50 Z2", "G1 X40 F.2", "Z-30"}, setup);
  const auto c = compensate(p, m, setup);
  EXPECT_EQ(c.lines[2], "G1 X40.000000 Z-30.000000");
  // Of a mill's table, standing at 0, they do.
  const NcSetup mill{.axes = "XZ"};
  EXPECT_NE(compensate(read_nc({"G1 X20 Z-30"}, mill), m, mill).lines[0],
            "G1 G90 X20.000000 Z-30.000000");
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

// An odd bow has no bend in the middle; between points the tip stays within tolerance.
TEST(Compensation, LongMovesFollowAnOddBow) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[1].c[3] = 1e-3;
  const NcSetup setup{.axes = "XY", .start_mm = {-200, 0, 0}};
  const auto p = read_nc({"G1 X200 F100"}, setup);
  const Compensated c = compensate(p, m, setup, {.tolerance_mm = 1e-3});
  const auto at = targets(read_nc(views(c.lines), setup));
  Vec3 from{-200, 8e-3, 0};
  for (const Vec3& to : at) {
    for (double share = 0; share < 1; share += 0.125) {
      const double x = from[0] + share * (to[0] - from[0]), t = x / 100;
      EXPECT_NEAR(from[1] + share * (to[1] - from[1]), -1e-3 * t * t * t, 1.01e-3) << x;
    }
    from = to;
  }
  EXPECT_LE(at.size(), 8u);
}

TEST(Compensation, LatheInDiametersAndInches) {
  Machine m{"wCfZXt", {}, {{'C', {}, units::kPi}, {'Z', {}, 100}, {'X', {}, 100}}};
  m.axes[2].errors[0].c[1] = 3e-3;  // 30 ppm on X
  const NcSetup setup{.axes = "XZ", .diameter = true, .lathe = true};
  const auto mm = compensate(read_nc({"G0 X60 Z0"}, setup), m, setup);
  m.axes[2].errors[1].c[0] = 4e-3;  // tangential: neither corrected nor counted
  EXPECT_LT(compensate(read_nc({"G0 X60 Z0"}, setup), m, setup).after.max_mm, 1e-6);
  // 60 mm would come out 1.8 um too large.
  EXPECT_EQ(mm.lines[0], "G0 G90 X59.998200 Z0.000000");
  const auto inch = compensate(read_nc({"G20", "G0 X2 Z0"}, setup), m, setup);
  EXPECT_EQ(inch.lines[1], "G0 G90 X1.99994000 Z0.00000000");
}

// A tool's length is no motion: no play is taken up, no coordinate runs.
TEST(Compensation, ToolLengthsAreNoMotion) {
  Machine m{"wfXYZt", {}, {{'X', {}, 100}, {'Y', {}, 100}, {'Z', {}, 100}}};
  m.axes[2].errors[2].b = -3e-3;
  const NcSetup setup{.start_mm = {0, 0, 150}, .tool_offsets_mm = {{1, {0, 0, -100}}}};
  const auto c = compensate(read_nc({"G1 Z140 F100", "G43 H1", "X5"}, setup), m, setup);
  ASSERT_EQ(c.lines.size(), 4u);
  EXPECT_EQ(c.lines[1], "G1 X0.000000 Y0.000000 Z139.997000");  // s = -1: 3 um too high
  EXPECT_EQ(c.lines[2], "G43 H1");
  EXPECT_EQ(c.lines[3], "G1 X5.000000 Y0.000000 Z39.997000");
  const auto up = compensate(read_nc({"G1 Z160 F100", "G43 H1", "X5"}, setup), m, setup);
  EXPECT_EQ(up.lines.back(), "G1 X5.000000 Y0.000000 Z60.003000");
}

// Errors that change by more than the way cannot be taken out by (1).
TEST(Compensation, ErrorsBeyondCorrectionAreSaid) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  m.axes[0].errors[0].c[1] = 250;  // 2.5 mm per mm
  const NcSetup setup{.axes = "XY"};
  const auto p = read_nc({"M8", "G0 X10"}, setup);
  EXPECT_THROW(compensate(p, m, setup), ModelRangeError);
  m.axes[0].errors[0].c = {1e17, 0, 0, 0};
  EXPECT_THROW(compensate(p, m, setup), ModelRangeError);
}

// What is written is the nearest number of so many decimals.
TEST(Compensation, WritesDecimalsRounded) {
  Machine m{"wfXYt", {}, {{'X', {}, 100}, {'Y', {}, 100}}};
  const NcSetup setup{.axes = "XY"};
  const auto line = [&](const char* source, int decimals) {
    return compensate(read_nc({source}, setup), m, setup, {.decimals = decimals})
        .lines[0];
  };
  EXPECT_EQ(line("G0 X0.0004 Y-0.0004", 3), "G0 G90 X0.000 Y0.000");
  EXPECT_EQ(line("G0 X0.0006 Y-0.0006", 3), "G0 G90 X0.001 Y-0.001");
  EXPECT_EQ(line("G0 X-12.3456 Y999999.9996", 3), "G0 G90 X-12.346 Y1000000.000");
  EXPECT_EQ(line("G0 X100 Y-.05", 9), "G0 G90 X100.000000000 Y-0.050000000");
}

}  // namespace
}  // namespace turnwright::volumetric
