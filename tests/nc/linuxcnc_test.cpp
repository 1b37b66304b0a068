// The programs' texts through LinuxCNC's interpreter: its canonical moves make the
// contour, with the plan's conditions.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <sstream>

#include "../rs274.hpp"
#include "check.hpp"

namespace turnwright::nc {
namespace {

namespace fs = std::filesystem;
using namespace test;

bool there(const turnwright::test::Rs274& rs274) {
  return !rs274.canonical("G21\nG0 X1\nM2\n", "T1 P1\n").empty();
}

std::vector<double> numbers(const std::string& call) {
  std::vector<double> all;
  auto text = call.substr(call.find('(') + 1);
  for (char& c : text)
    if (c == ',' || c == ')') c = ' ';
  std::istringstream in(text);
  for (double x; in >> x;) all.push_back(x);
  return all;
}

// ARC_FEED in the ZX plane: end z, end x, centre z, centre x, turns against the clock
// from Z to X.
void add_arc(std::vector<Way>& ways, Way w, const std::vector<double>& a) {
  const double R = std::hypot(w.z0 - a[2], w.x0 - a[3]);
  const double from = std::atan2(w.x0 - a[3], w.z0 - a[2]);
  double to = std::atan2(a[1] - a[3], a[0] - a[2]);
  if (a[4] > 0 && to < from) to += 2 * M_PI;
  if (a[4] < 0 && to > from) to -= 2 * M_PI;
  const int n = 1 + static_cast<int>(std::abs(to - from) * R / std::sqrt(1.6e-5 * R));
  for (int i = 1; i <= n; ++i) {
    const double t = from + (to - from) * i / n;
    w.x1 = i < n ? a[3] + R * std::sin(t) : a[1];
    w.z1 = i < n ? a[2] + R * std::cos(t) : a[0];
    ways.push_back(w);
    w.x0 = w.x1;
    w.z0 = w.z1;
  }
}

std::vector<Way> ways_of(const std::string& canonical) {
  std::vector<Way> ways;
  Way w;
  bool known = false, in_operation = false;
  std::istringstream in(canonical);
  for (std::string line; std::getline(in, line);) {
    const auto has = [&](const char* word) { return line.find(word) != line.npos; };
    const auto operation = line.find("operation ");
    if (has("COMMENT") && operation != line.npos) {
      const auto from = operation + 10;
      w.operation = line.substr(from, line.find(':', from) - from);
      in_operation = true;
    }
    if (has("SET_FEED_RATE")) w.f_mm_rev = numbers(line)[0];
    if (has("START_SPEED_FEED_SYNC")) {
      w.thread = true;
      w.f_mm_rev = numbers(line)[0];
    }
    if (has("STOP_SPEED_FEED_SYNC")) w.thread = false;
    if (has("SET_SPINDLE_MODE"))
      std::sscanf(line.c_str() + line.find('('), "(%*d %lf", &w.n_max_rpm);
    if (has("SET_SPINDLE_SPEED")) w.S = numbers(line)[1];
    const bool traverse = has("STRAIGHT_TRAVERSE"), arc = has("ARC_FEED");
    if (!in_operation || (!traverse && !arc && !has("STRAIGHT_FEED"))) continue;
    const auto a = numbers(line);
    w.rapid = traverse;
    const double x = arc ? a[1] : a[0], z = arc ? a[0] : a[2];
    w.x0 = known ? w.x1 : x;
    w.z0 = known ? w.z1 : z;
    known = true;
    if (arc)
      add_arc(ways, w, a);
    else {
      w.x1 = x;
      w.z1 = z;
      ways.push_back(w);
    }
    w.x1 = x;
    w.z1 = z;
  }
  return ways;
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

std::string listed(const Faults& faults) {
  std::string all;
  for (const auto& f : faults) all += f + '\n';
  return all;
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

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

TEST_F(NcThroughLinuxCnc, PlantedErrorsAreFound) {
  const auto p = planned_reference("threaded-spindle");
  ASSERT_EQ(listed(faults_of(rs274, p, p)), "");
  const std::vector<std::pair<const char*, Change>> slips = {
      {"a radius 5 um too small",
       [](auto t) { return replaced(t, "X28 F0.3", "X27.99 F0.3"); }},
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
