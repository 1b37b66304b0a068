// Corrected programs through LinuxCNC's interpreter: TURNWRIGHT_RS274 names it (see
// scripts/rs274), else one on the path is taken.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "turnwright/volumetric/compensation.hpp"

namespace turnwright::volumetric {
namespace {

namespace fs = std::filesystem;

/// What the command prints; "" if it fails.
std::string printed(const std::string& command) {
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  if (!pipe) return "";
  std::string out;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe))
    out.append(buffer.data(), n);
  return pclose(pipe) == 0 ? out : "";
}

struct Interpreter {
  std::string path;
  fs::path folder;
  Interpreter() {
    const char* given = std::getenv("TURNWRIGHT_RS274");
    path = given ? given : printed("command -v rs274");
    while (path.ends_with('\n')) path.pop_back();
    folder =
        fs::temp_directory_path() /
        ("turnwright-rs274-" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    fs::create_directories(folder);
    std::ofstream parameters(folder / "rs274.var");
    // G54 is active, G55 at (1, 0, -2) inches; tool 2 is 4 inches long, 0.5 off.
    for (int i = 5161; i <= 5390; ++i)
      parameters << i << ' ' << (i == 5220 || i == 5241 ? 1 : i == 5243 ? -2 : 0) << '\n';
    std::ofstream(folder / "tool.tbl") << "T1 P1 Z0\nT2 P2 X0.5 Z4\n";
  }
  ~Interpreter() { fs::remove_all(folder); }

  struct Move {
    bool rapid = false;
    Vec3 to{};
  };
  /// Straight moves of a program; arcs by their ends, as feeds.
  std::vector<Move> moves(const std::vector<std::string>& lines) const {
    std::ofstream program(folder / "program.ngc");
    for (const std::string& line : lines) program << line << '\n';
    program << "M2\n";
    program.close();
    const std::string text = printed("cd " + folder.string() + " && " + path +
                                     " -g -v rs274.var -t tool.tbl program.ngc");
    std::vector<Move> out;
    for (std::size_t at = 0; at < text.size();) {
      const auto end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      at = end + 1;
      const auto open = line.find('(');
      Move m{.rapid = line.find("STRAIGHT_TRAVERSE") != line.npos};
      if (!m.rapid && line.find("STRAIGHT_FEED") == line.npos) continue;
      if (std::sscanf(line.c_str() + open, "(%lf, %lf, %lf", m.to.data(), m.to.data() + 1,
                      m.to.data() + 2) == 3)
        out.push_back(m);
    }
    return out;
  }
};

void runs_as_asked(const Interpreter& rs274, const std::vector<std::string_view>& source,
                   const NcSetup& setup, const Machine& machine,
                   const std::vector<std::string>& before) {
  const NcProgram program = read_nc(source, setup);
  ASSERT_TRUE(program.problems.empty());
  const Compensated c = compensate(program, machine, setup);
  std::vector<std::string> lines = before;
  lines.insert(lines.end(), c.lines.begin(), c.lines.end());
  const auto canonical = rs274.moves(lines);
  const std::vector<std::string_view> views(c.lines.begin(), c.lines.end());
  std::vector<NcMove> asked = read_nc(views, setup).moves;
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

// LinuxCNC and read_nc take the same arcs for the same: the same ends, and centres by R.
TEST(LinuxCnc, RefusesNoArcThatIsRead) {
  const Interpreter rs274;
  if (rs274.moves({"G21", "G0 X1"}).size() != 1) GTEST_SKIP() << "rs274 is not there";
  for (const char* arc : {"G3 X0 Y10 R10 F9", "G3 X0 Y10 R-10 F9", "G2 X0 Y10 I-10 F9",
                          "G3 X10 Y0 I-10 F9"}) {
    const auto p = read_nc({"G0 X10 Y0", arc, "G1 X3 Y4"}, {});
    ASSERT_TRUE(p.problems.empty());
    EXPECT_EQ(rs274.moves({"G21", "G0 X10 Y0", arc, "G1 X3 Y4"}).size(), 2u) << arc;
  }
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
    auto p = read_nc(views, with_1);
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
