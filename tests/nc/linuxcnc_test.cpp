// The programs' texts through LinuxCNC's interpreter: its canonical moves make the
// contour, with the plan's conditions.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <sstream>

#include "../rs274.hpp"
#include "canonical.hpp"
#include "check.hpp"
#include "cut_simulation.hpp"

namespace turnwright::nc {
namespace {

namespace fs = std::filesystem;
using namespace test;

bool there(const turnwright::test::Rs274& rs274) {
  return !rs274.canonical("G21\nG0 X1\nM2\n", "T1 P1\n").empty();
}

using Change = std::function<std::string(std::string)>;

const Change kAsWritten = [](std::string t) { return t; };

// Of the programs for `asked`, changed, as programs for `p`.
Faults faults_of(const turnwright::test::Rs274& rs274, const Planned& p,
                 const Planned& asked, const Change& change = kAsWritten) {
  const auto all = programs(asked.part, asked.plan);
  Check check(p);
  Faults refused;
  for (const auto& program : all.setups) {
    const auto canonical = rs274.canonical(
        change(text(program, {.control = Control::linuxcnc})), tool_table(all.setups));
    if (canonical.empty()) refused.push_back("rs274 refuses the program");
    check.setup(program.setup, ways_of(canonical));
  }
  check.contour();
  refused.insert(refused.end(), check.faults().begin(), check.faults().end());
  return refused;
}

// What the half section shows of programs as the interpreter runs them.  It prints places
// with four decimals: the radius of an arc, between two of them, to 1e-4 mm.
std::vector<Finding> cut(const turnwright::test::Rs274& rs274, const Planned& p) {
  const auto all = programs(p.part, p.plan);
  constexpr double kPitch_mm = 0.01;
  CutSimulation simulation(p, kPitch_mm, {.left = 2e-4});
  for (const auto& program : all.setups)
    simulation.setup(program.setup, ways_of(rs274.canonical(
                                        text(program, {.control = Control::linuxcnc}),
                                        tool_table(all.setups))));
  simulation.compare();
  return simulation.findings();
}

class NcThroughLinuxCnc : public testing::Test {
 protected:
  void SetUp() override {
    if (there(rs274)) return;
    std::fputs("NOT CHECKED: no rs274 of LinuxCNC, see scripts/rs274\n", stderr);
    GTEST_SKIP() << "rs274 is not there";
  }
  turnwright::test::Rs274 rs274;
};

TEST_F(NcThroughLinuxCnc, OfReferencePartsAreTakenAndMakeTheContour) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_EQ(listed(faults_of(rs274, p, p)), "") << name;
  }
}

TEST_F(NcThroughLinuxCnc, OfReferencePartsLeaveTheDrawing) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    auto findings = cut(rs274, p);
    const auto all = programs(p.part, p.plan);
    std::erase_if(findings, [&](const Finding& f) { return is_told(f, all); });
    EXPECT_EQ(listed(findings), "") << name;
  }
}

TEST_F(NcThroughLinuxCnc, ReamsAndTaps) {
  for (const char* name : kWithHoles) {
    const auto& p = planned_awkward(name);
    ASSERT_EQ(p.plan.status, planning::PlanStatus::ok) << name;
    EXPECT_EQ(listed(faults_of(rs274, p, p)), "") << name;
    EXPECT_EQ(listed(cut(rs274, p)), "") << name;
  }
  const auto& p = planned_awkward("tapped-ends");
  const auto with = [&](const char* what, const char* by) {
    return faults_of(rs274, p, p, [&](auto t) {
      const auto at = t.find(what);
      return at == t.npos ? t : t.replace(at, std::string(what).size(), by);
    });
  };
  EXPECT_FALSE(with("G33.1 Z-23.75", "G33.1 Z-23.7").empty()) << "too short a thread";
  EXPECT_FALSE(with("K1.5", "K1.25").empty()) << "another lead";
}

// The orientations of the tool table are the interpreter's: beside a cylinder along Z the tip
// of a compensated tool is on the cylinder, outside and in a bore.  The interpreter alone takes
// the table's diameters for inches.
TEST_F(NcThroughLinuxCnc, TakesTheToolTablesOrientations) {
  const auto p = planned_reference("flanged-bush");
  const auto all = programs(p.part, p.plan);
  const auto table = tool_table(all.setups);
  const auto radius_mm = [&](const std::string& tool, const char* side,
                             const char* from) {
    std::istringstream lines(table);
    std::string line;
    while (std::getline(lines, line) && line.find(tool) == line.npos) continue;
    const auto Q = line.substr(line.find(" Q") + 1, 2);
    const auto text = std::string("T1 M6\nG43\nG18 G21 G7 G90 G94 G40 F100\nG0 X") +
                      from + " Z5\n" + side + " G0 X20 Z2\nG1 Z-20\nG40 G0 X" + from +
                      " Z5\nM2\n";
    const std::string fed = "STRAIGHT_FEED(",
                      canonical = rs274.canonical(text, "T1 P1 D0.03149606 " + Q + "\n");
    const auto at = canonical.find(fed);
    return at == canonical.npos ? 0 : std::stod(canonical.substr(at + fed.size()));
  };
  EXPECT_NEAR(radius_mm("PDJNL-DNMG150604-PF", "G42", "30"), 10, 1e-4);
  EXPECT_NEAR(radius_mm("S25T-SCLCR-CCMT09T304-PF", "G41", "10"), 10, 1e-4);
}

// With everything a shop may set but another zero.
TEST_F(NcThroughLinuxCnc, ProgramsWithTheShopsSettingsMakeTheContour) {
  const auto p = planned_reference("threaded-spindle");
  auto all = programs(p.part, p.plan);
  const Settings settings{.block_numbers = BlockNumbers::all,
                          .spindle = SpindleTurn::M4,
                          .coolant = "M7",
                          .optional_stops = true,
                          .cycles = true,
                          .tools = {{"PROFILE-35", 7}, {"THREAD-EXT-60", 99}}};
  number_tools(all.setups, settings);
  Check check(p);
  for (const auto& program : all.setups) {
    const auto canonical =
        rs274.canonical(nc::text(program, settings), tool_table(all.setups));
    EXPECT_NE(canonical.find("OPTIONAL_PROGRAM_STOP"), canonical.npos);
    EXPECT_NE(canonical.find("START_SPINDLE_COUNTERCLOCKWISE"), canonical.npos);
    EXPECT_NE(canonical.find("MIST_ON"), canonical.npos);
    check.setup(program.setup, ways_of(canonical));
  }
  check.contour();
  EXPECT_EQ(listed(check.faults()), "");
}

// Radii of a thread's cuts by G76 are those of the plan's own moves, and the tool comes
// back to where it began.
TEST_F(NcThroughLinuxCnc, CyclesOfThreadsMakeTheCutsOfThePlan) {
  const auto p = planned_reference("threaded-spindle");
  const auto all = programs(p.part, p.plan);
  std::vector<double> cut, planned;
  Way back;
  for (const auto& program : all.setups) {
    const auto text = nc::text(program, {.cycles = true});
    for (const auto& way : ways_of(rs274.canonical(text, tool_table(all.setups)))) {
      if (way.thread && way.x0 == way.x1) cut.push_back(way.x1);
      if (way.thread) back = {};
      if (!way.thread && back.z1 < 1) back = way;
    }
    for (const auto& step : program.steps)
      for (const auto& m : step.moves)
        if (m.kind == Move::Kind::thread) planned.push_back(m.x_mm);
  }
  ASSERT_GT(planned.size(), 2U);
  ASSERT_EQ(cut.size(), planned.size());
  for (std::size_t k = 0; k < cut.size(); ++k) EXPECT_NEAR(cut[k], planned[k], 2e-4);
  EXPECT_EQ(back.x0, back.x1);
  EXPECT_EQ(back.z1, 4.5);
}

// Drilled by the interpreter's own G81 and G83, pecks and all.
TEST_F(NcThroughLinuxCnc, DrillingCyclesMakeTheContour) {
  const Settings settings{.drill_cycles = true};
  for (const auto& p :
       {planned_reference("drilled-bush"), planned_awkward("a pecked hole"),
        planned_awkward("tapped-ends"), planned_awkward("counterbored-chamfered")}) {
    auto all = programs(p.part, p.plan);
    fit_to_control(all.setups, settings, p.part.machine);
    Check check(p);
    CutSimulation simulation(p, 0.01, {.left = 2e-4});
    for (const auto& program : all.setups) {
      const auto canonical =
          rs274.canonical(nc::text(program, settings), tool_table(all.setups));
      std::vector<double> bottoms, planned;
      for (const auto& way : ways_of(canonical))
        if (!way.rapid && !way.thread && way.x0 == 0 && way.x1 == 0 && way.z1 < way.z0)
          bottoms.push_back(way.z1);
      for (const auto& step : program.steps)
        for (std::size_t k = 1; k < step.moves.size(); ++k) {
          const auto &a = step.moves[k - 1], &b = step.moves[k];
          if (b.kind == Move::Kind::feed && a.x_mm == 0 && b.x_mm == 0 && b.z_mm < a.z_mm)
            planned.push_back(b.z_mm);
        }
      ASSERT_EQ(bottoms.size(), planned.size());
      for (std::size_t k = 0; k < planned.size(); ++k)
        EXPECT_NEAR(bottoms[k], planned[k], 8e-4);
      check.setup(program.setup, ways_of(canonical));
      simulation.setup(program.setup, ways_of(canonical));
    }
    check.contour();
    simulation.compare();
    EXPECT_EQ(listed(check.faults()), "");
    EXPECT_EQ(listed(simulation.findings()), "");
  }
}

// Straight moves of the cutter, with the part at its angle, feed by the minute and the
// second spindle.
void expect_milled(const turnwright::test::Rs274& rs274, const Planned& p, int places) {
  const auto all = programs(p.part, p.plan);
  int milled = 0;
  for (const auto& program : all.setups) {
    std::vector<std::string> lines;
    std::istringstream canonical(
        rs274.canonical(nc::text(program, {}), tool_table(all.setups)));
    for (std::string line; std::getline(canonical, line);) lines.push_back(line);
    for (const auto& step : program.steps) {
      if (!step.milling) continue;
      ++milled;
      const auto begins = step.comments[0].substr(0, step.comments[0].find(':'));
      auto at = std::ranges::find_if(
          lines, [&](const auto& l) { return l.find(begins) != l.npos; });
      ASSERT_NE(at, lines.end()) << begins;
      double f = 0, S = 0, C = 0;
      int spindle = 0;
      bool by_the_minute = false, turns = false;
      std::size_t k = 0;
      for (; at != lines.end() && k < step.moves.size(); ++at) {
        const auto has = [&](const char* word) { return at->find(word) != at->npos; };
        if (has("SET_FEED_MODE")) by_the_minute = numbers(*at)[1] == 0;
        if (has("SET_FEED_RATE")) f = numbers(*at)[0];
        if (has("SET_SPINDLE_SPEED"))
          spindle = static_cast<int>(numbers(*at)[0]), S = numbers(*at)[1];
        if (has("START_SPINDLE_CLOCKWISE")) turns = numbers(*at)[0] == 1;
        const bool fed = has("STRAIGHT_FEED"), traverse = has("STRAIGHT_TRAVERSE");
        if (!fed && !traverse) continue;
        const auto a = numbers(*at);
        if (!turns) {  // to its angle
          C = a[5];
          continue;
        }
        const auto& m = step.moves[k++];
        const auto where = begins + ", move " + std::to_string(k);
        EXPECT_EQ(fed, m.kind == Move::Kind::feed) << where;
        EXPECT_NEAR(a[0], m.x_mm, 1e-4) << where;
        EXPECT_NEAR(a[1], m.y_mm, 1e-4) << where;
        EXPECT_NEAR(a[2], m.z_mm, 1e-4) << where;
        EXPECT_NEAR(a[5], step.milling->C_deg, 1e-4) << where;
        if (fed) {
          EXPECT_TRUE(by_the_minute) << where;
          EXPECT_NEAR(f, m.feed_share * step.milling->f_mm_min, 0.1) << where;
        }
      }
      EXPECT_EQ(k, step.moves.size()) << begins;
      EXPECT_EQ(spindle, 1);
      EXPECT_NEAR(S, step.milling->n_rpm, 1);
      EXPECT_NEAR(C, step.milling->C_deg, 1e-4);
    }
  }
  EXPECT_EQ(milled, places);
}

TEST_F(NcThroughLinuxCnc, MillsAsTheProgram) {
  expect_milled(rs274, planned_reference("keyed-shaft"), 2);
}

// Of four, the last is in a later setup, whose angle is not known.
TEST_F(NcThroughLinuxCnc, DrillsAcrossAsTheProgram) {
  expect_milled(rs274, planned_awkward("cross-holes"), 3);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

TEST_F(NcThroughLinuxCnc, PlantedErrorsAreFound) {
  const auto p = planned_reference("threaded-spindle");
  ASSERT_EQ(listed(faults_of(rs274, p, p)), "");
  const std::vector<std::pair<const char*, Change>> slips = {
      {"a radius 5 um too small",
       [](auto t) {
         const auto pass = t.find("(operation s1-finish-d2");
         if (pass == t.npos) return t;  // the other setup's
         const auto at = t.find("\nG1 X", pass) + 5;
         std::size_t digits = 0;
         const double X = std::stod(t.substr(at), &digits);
         return t.replace(at, digits, fmt::format("{:.4f}", X - 0.01));
       }},
      {"no limit of the spindle",
       [](auto t) {
         return t.replace(t.find(" D"), t.find(" S", t.find("G96")) - t.find(" D"), "");
       }},
      {"another feed", [](auto t) { return replaced(t, " F0.", " F1."); }},
      {"another speed", [](auto t) { return replaced(t, " S2", " S3"); }},
      {"another pitch", [](auto t) { return replaced(t, " K1.5", " K1.6"); }},
      {"a rapid through the part",
       [](auto t) { return replaced(t, "\nG1 Z-", "\nG0 Z-"); }},
      {"an arc the other way",
       [](auto t) { return replaced(replaced(t, "\nG2 ", "\nG0 "), "\nG3 ", "\nG2 "); }}};
  for (const auto& [what, slip] : slips)
    EXPECT_FALSE(faults_of(rs274, p, p, slip).empty()) << what;
  auto other = p;
  for (auto& t : other.part.fixed_tools) t.re_mm *= 2;
  EXPECT_FALSE(faults_of(rs274, p, other).empty()) << "another corner, on an arc";
  auto pin = planned_reference("titanium-pin"), corner = pin;
  ASSERT_EQ(listed(faults_of(rs274, pin, pin)), "");
  for (auto& t : corner.part.tools) t.re_mm *= 1.1;
  EXPECT_FALSE(faults_of(rs274, pin, corner).empty()) << "another corner, on a cone";
  auto hole = planned_reference("drilled-bush"), small = hole;
  ASSERT_EQ(listed(faults_of(rs274, hole, hole)), "");
  for (auto& e : small.part.drawing.inner) e.left_mm = e.right_mm -= 1e-3;
  EXPECT_FALSE(faults_of(rs274, hole, small).empty())
      << "bores too tight by 0.5 um on the radius";
}

}  // namespace
}  // namespace turnwright::nc
