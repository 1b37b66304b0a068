// Corrected programs through LinuxCNC's interpreter.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>
#include <string>

#include "../rs274.hpp"
#include "turnwright/volumetric/compensation.hpp"

namespace turnwright::volumetric {
namespace {

struct Interpreter {
  test::Rs274 rs274;

  /// Canonical commands of a program, a line each; tool 2 is 4 inches long, 0.5 off.
  std::vector<std::string> commands(const std::vector<std::string>& lines) const {
    std::string program;
    for (const std::string& line : lines) program += line + '\n';
    std::istringstream text(
        rs274.canonical(program + "M2\n", "T1 P1 Z0\nT2 P2 X0.5 Z4\n"));
    std::vector<std::string> out;
    for (std::string line; std::getline(text, line);) out.push_back(line);
    return out;
  }

  struct Move {
    bool rapid = false;
    Vec3 to{};
  };
  /// Straight moves of a program.
  std::vector<Move> moves(const std::vector<std::string>& lines) const {
    std::vector<Move> out;
    for (const std::string& line : commands(lines)) {
      const auto open = line.find('(');
      Move m{.rapid = line.find("STRAIGHT_TRAVERSE") != line.npos};
      if (!m.rapid && line.find("STRAIGHT_FEED") == line.npos) continue;
      if (std::sscanf(line.c_str() + open, "(%lf, %lf, %lf", m.to.data(), m.to.data() + 1,
                      m.to.data() + 2) == 3)
        out.push_back(m);
    }
    return out;
  }

  struct Arc {
    std::array<double, 2> end{}, centre{};  // in the plane's axes
    int turn = 0;                           // +1 from the first axis to the second
    double across = 0;                      // end along the third
  };
  std::vector<Arc> arcs(const std::vector<std::string>& lines) const {
    std::vector<Arc> out;
    for (const std::string& line : commands(lines)) {
      const auto at = line.find("ARC_FEED(");
      Arc a;
      if (at != line.npos &&
          std::sscanf(line.c_str() + at, "ARC_FEED(%lf, %lf, %lf, %lf, %d, %lf",
                      a.end.data(), a.end.data() + 1, a.centre.data(),
                      a.centre.data() + 1, &a.turn, &a.across) == 6)
        out.push_back(a);
    }
    return out;
  }
};

void runs_as_asked(const Interpreter& rs274, const std::vector<std::string_view>& source,
                   const NcSetup& setup, const Machine& machine,
                   const std::vector<std::string>& before) {
  const NcProgram program = gcode::read_nc(source, setup);
  ASSERT_TRUE(program.problems.empty());
  const Compensated c = compensate(program, machine, setup);
  std::vector<std::string> lines = before;
  lines.insert(lines.end(), c.lines.begin(), c.lines.end());
  const auto canonical = rs274.moves(lines);
  const std::vector<std::string_view> views(c.lines.begin(), c.lines.end());
  std::vector<NcMove> asked = gcode::read_nc(views, setup).moves;
  std::erase_if(asked, [](const NcMove& m) { return !m.moves; });
  ASSERT_EQ(canonical.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(canonical[i].rapid, asked[i].rapid);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(canonical[i].to[k], asked[i].target_mm[k], 6e-5) << i;  // 4 decimals
  }
}

Machine machine(const char* chain) {
  Machine m{chain, {}, {}};
  for (const char c : std::string(chain)) {
    if (letter_index(c) == std::string_view::npos) continue;
    Axis axis{c, {}, default_Q(c)};
    if (!is_rotary(c)) {
      axis.errors[letter_index(c)].c = {0, 9e-3, 2e-3, 0};
      axis.errors[letter_index(c)].b = -2e-3;
    }
    m.axes.push_back(axis);
  }
  return m;
}

TEST(LinuxCnc, RunsCorrectedProgramsAsAsked) {
  const Interpreter rs274;
  if (rs274.moves({"G21", "G0 X1"}).size() != 1) {
    std::fputs("NOT CHECKED: no rs274 of LinuxCNC, see scripts/rs274\n", stderr);
    GTEST_SKIP() << "rs274 is not there";
  }
  runs_as_asked(rs274,
                {"G21 G90 G17 (milled)", "G0 X10 Y10 Z5", "G1 Z-2 F100 M3 S1000",
                 "X150 Y30", "G3 X150 Y90 J30", "G91 G1 X-100", "G90 G2 X20 Y60 Z-3 R30",
                 "G18 G2 X40 Z-3 I10 K0", "G1 X20 Y10 Z0 M9"},
                {}, machine("wfXYZt"), {"G21"});
  NcSetup lathe{.axes = "XZ", .diameter = true, .lathe = true};
  runs_as_asked(rs274,
                {"G18 G21", "G0 X42 Z2", "G1 X40 F20", "Z-30", "G2 X50 Z-35 R5",
                 "G3 X60 Z-40 I0 K-5", "G0 X80 Z5"},
                lathe, machine("wCfZXt"), {"G7"});
}

/// Random arcs: of any plane, by centre or radius, absolute or not, flat or helical.
std::vector<std::string> random_arcs(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&random](double least, double most) {
    return std::uniform_real_distribution<>(least, most)(random);
  };
  const auto word = [](char letter, double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), " %c%.6f", letter, value);
    return std::string(text.data());
  };
  std::vector<std::string> out = {"G21 G90 G17", "G0 X10 Y20 Z30", "G1 X11 F100"};
  Vec3 at{11, 20, 30};
  for (int i = 0; i < count; ++i) {
    const std::size_t w = random() % 3, u = (w + 1) % 3, v = (w + 2) % 3;
    const double r = number(2, 20), from = number(-3, 3), by_radius = number(-1, 1);
    const double sweep = by_radius > 0 ? number(0.3, 2.8) : number(0.3, 6);
    const bool whole = by_radius<-0.8, incremental = number(-1, 1)> 0;
    const Vec3 start = at;
    if (!whole) {
      at[u] += r * (std::cos(from + sweep) - std::cos(from));
      at[v] += r * (std::sin(from + sweep) - std::sin(from));
    }
    if (number(-1, 1) > 0) at[w] += number(-5, 5);
    for (double& x : at) x = std::round(x * 1e6) / 1e6;
    const std::array<const char*, 3> planes = {"G19", "G18", "G17"};
    std::string line = std::string(planes[w]) + (incremental ? " G91" : " G90") +
                       (random() % 2 ? " G2" : " G3");
    for (const std::size_t k : {u, v, w})
      if (!whole || k == w) line += word("XYZ"[k], at[k] - (incremental ? start[k] : 0));
    if (by_radius > 0) {
      line += word('R', random() % 2 ? r : -r);
    } else {
      line += word("IJK"[u], -r * std::cos(from));
      line += word("IJK"[v], -r * std::sin(from));
    }
    out.push_back(line);
  }
  return out;
}

// Centre, sense, end and height of each arc by LinuxCNC: the chords lie there.
TEST(LinuxCnc, ArcsAreReadAlike) {
  const Interpreter rs274;
  if (rs274.moves({"G21", "G0 X1"}).size() != 1) GTEST_SKIP() << "rs274 is not there";
  const std::vector<std::string> source = random_arcs(200, 7);
  const auto arcs = rs274.arcs(source);
  ASSERT_EQ(arcs.size(), 200u);
  const auto p = gcode::read_nc({source.begin(), source.end()}, {.tolerance_mm = 0.01});
  ASSERT_TRUE(p.problems.empty()) << p.problems[0].line << p.problems[0].got;
  constexpr double kPrinted = 3e-4;  // four decimals of ends, centre and start
  Vec3 from = p.moves[2].target_mm;
  std::size_t k = 3;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const std::string& line = source[i + 3];
    const std::size_t w = line.starts_with("G17")   ? 2
                          : line.starts_with("G18") ? 1
                                                    : 0,
                      u = (w + 1) % 3, v = (w + 2) % 3;
    const auto& [end, centre, turn, across] = arcs[i];
    const auto about = [&](const Vec3& at) {
      return std::array{at[u] - centre[0], at[v] - centre[1]};
    };
    const Vec3 start = from;
    const double r = std::hypot(about(start)[0], about(start)[1]);
    double turned = 0;
    std::vector<std::array<double, 2>> heights;  // angle and way along the axis
    for (; k < p.moves.size() && p.moves[k].line == i + 4; ++k) {
      const Vec3& to = p.moves[k].target_mm;
      const auto a = about(from), b = about(to);
      turned += std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
      heights.push_back({turned, to[w] - start[w]});
      EXPECT_NEAR(std::hypot(b[0], b[1]), r, kPrinted) << line;
      from = to;
    }
    EXPECT_GT(turned * turn, 0) << line;
    EXPECT_LE(std::abs(turned), 2 * units::kPi + kPrinted) << line;
    for (const auto& [angle, way] : heights)
      EXPECT_NEAR(way, (across - start[w]) * angle / turned, kPrinted) << line;
    EXPECT_NEAR(from[u], end[0], kPrinted) << line;
    EXPECT_NEAR(from[v], end[1], kPrinted) << line;
  }
  EXPECT_EQ(k, p.moves.size());
}

// Modal states, offsets and units: where a program goes by LinuxCNC, in its coordinates.
TEST(LinuxCnc, ModesAreReadAlike) {
  const Interpreter rs274;
  if (rs274.moves({"G21", "G0 X1"}).size() != 1) GTEST_SKIP() << "rs274 is not there";
  const NcSetup setup{.work_offsets_mm = {{"G55", {25.4, 0, -50.8}}},
                      .tool_offsets_mm = {{2, {-12.7, 0, -101.6}}}};
  const std::vector<std::vector<std::string>> programs = {
      {"G21", "G90 G54 G17 G40 G49 G80 G94", "N10 G0 X5 Y6 Z200", "G43 H2",
       "N20 X10 (unnamed Z changes with the tool)", "G91 G1 Z-10 F100", "G49", "G90 Y0",
       "G43 H2 X1", "Z3", "G49 X2"},
      {"G21", "G0 X10 Y20 Z30", "G55", "X1", "G91 Y5", "G54", "Z1", "G90 G55 Z0",
       "G54 X0"},
      {"G21", "G1 X25.4 Y50.8 F100", "G20", "Z1", "G91 X1", "G21 Y-10",
       "g90 x-.5 y+.25 z3.", "G 1 X 7 ;end"},
      {"G21", "G96 D2500 S100 M3", "G95 F0.2", "G1 X3", "G97 S900", "G94 F100", "Y4 M5",
       "G64 P0.01", "G4 P0.1", "G61", "X8 Z1 (a) M8 (b)", "G80", "G0 Z9"},
      {"G21", "G91 G0 X1 Y1", "X1 Y-3", "G43 H2", "Z1", "G43 H1", "X1", "G49", "Y1"}};
  for (auto source : programs) {
    NcSetup with_1 = setup;
    with_1.tool_offsets_mm[1] = {};
    const std::vector<std::string_view> views(source.begin(), source.end());
    auto p = gcode::read_nc(views, with_1);
    ASSERT_TRUE(p.problems.empty()) << p.problems[0].line << p.problems[0].got;
    std::erase_if(p.moves, [](const NcMove& m) { return !m.moves; });
    const auto canonical = rs274.moves(source);
    ASSERT_EQ(canonical.size(), p.moves.size()) << source[1];
    for (std::size_t i = 0; i < canonical.size(); ++i) {
      const NcMove& m = p.moves[i];
      EXPECT_EQ(canonical[i].rapid, m.rapid);
      for (std::size_t k = 0; k < 3; ++k)  // told in the units of the block
        EXPECT_NEAR(canonical[i].to[k],
                    (m.target_mm[k] - m.origin_mm[k]) / (m.inch ? 25.4 : 1), 6e-5)
            << source[m.line - 1];
    }
  }
}

}  // namespace
}  // namespace turnwright::volumetric
