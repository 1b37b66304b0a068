// The text of programs in every dialect, read back as the manuals describe it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dialect_reader.hpp"
#include "plans.hpp"
#include "turnwright/nc/text.hpp"

namespace turnwright::nc {
namespace {

using namespace test;

constexpr std::array kControls{Control::linuxcnc, Control::fanuc,       Control::fanuc_b,
                               Control::haas,     Control::siemens_iso, Control::siemens,
                               Control::okuma};

std::string id(Control control) { return std::string(dialect(control).id); }

std::vector<SetupProgram> numbered(const Programs& programs, const Settings& settings) {
  auto all = programs.setups;
  fit_to_control(all, settings, {});
  number_tools(all, settings);
  return all;
}

// A builder's codes where a control has none of its own.
MillingCodes builders(Control control) {
  if (control == Control::siemens) return {.tool_on = "S2={S} M2=3", .tool_off = "M2=5"};
  const bool own = control == Control::linuxcnc || control == Control::haas ||
                   control == Control::okuma;
  return own ? MillingCodes{}
             : MillingCodes{"M35", "M34", "M68", "M69", "S{S} M13", "M15"};
}

// LinuxCNC takes any decimals, the others steps of 0.001 mm.
double last_mm(Control control) { return control == Control::linuxcnc ? 1e-4 : 1e-3; }

bool moves_on(const Move& a, const Move& b, Control control) {
  const auto digits = [&](double mm) { return std::lround(mm / last_mm(control)); };
  return digits(2 * a.x_mm) != digits(2 * b.x_mm) || digits(a.y_mm) != digits(b.y_mm) ||
         digits(a.z_mm) != digits(b.z_mm);
}

void expect_cut_off(double read, double planned, double step, const std::string& at) {
  EXPECT_LE(read, planned * (1 + 1e-12)) << at;
  EXPECT_GT(read, planned - step) << at;
}

// A cutter's move: feed by the minute, the main spindle at rest and held.
void expect_milled(const Read& r, const Move& m, const Step& s, Control control,
                   const std::string& at) {
  const double half_mm = last_mm(control) / 2 + 1e-9;
  EXPECT_EQ(r.kind, m.kind) << at;
  EXPECT_NEAR(r.x_mm, m.x_mm, half_mm / 2) << at;
  EXPECT_NEAR(r.y_mm, m.y_mm, half_mm) << at;
  EXPECT_NEAR(r.z_mm, m.z_mm, half_mm) << at;
  if (m.kind != Move::Kind::rapid)
    expect_cut_off(r.f_mm_min, m.feed_share * s.milling->f_mm_min, 0.1, at);
  expect_cut_off(r.tool_rpm, s.milling->n_rpm, 1, at);
  EXPECT_NEAR(r.C_deg, s.milling->C_deg, 5e-4) << at;
  EXPECT_TRUE(r.mills) << at;
  EXPECT_EQ(r.turn, "") << at;
  EXPECT_TRUE(r.coolant) << at;
  EXPECT_EQ(r.tool, s.tool) << at;
}

/// @param rounded  how often a place along Z is rounded: once, or with each of its pecks
void expect_same(const Read& r, const Move& m, const Step& s, Control control,
                 const std::string& at, double rounded = 0.5) {
  if (s.milling) return expect_milled(r, m, s, control, at);
  EXPECT_FALSE(r.mills) << at;
  const double half_mm = last_mm(control) / 2 + 1e-9;
  EXPECT_EQ(r.kind, m.kind) << at;
  EXPECT_NEAR(r.x_mm, m.x_mm, half_mm / 2) << at;
  EXPECT_NEAR(r.z_mm, m.z_mm, rounded * last_mm(control) + 1e-9) << at;
  if (m.kind == Move::Kind::arc) {
    EXPECT_EQ(r.clockwise, m.clockwise) << at;
    const double centre_mm = control == Control::linuxcnc ? half_mm / 10 : half_mm;
    EXPECT_NEAR(r.centre.h_mm, m.centre.h_mm, centre_mm) << at;
    EXPECT_NEAR(r.centre.z_mm, m.centre.z_mm, centre_mm) << at;
  }
  if (m.kind != Move::Kind::rapid) expect_cut_off(r.f_mm_rev, s.f_mm_rev, 1e-4, at);
  expect_cut_off(r.S, s.S, control == Control::linuxcnc ? 1e-2 : 1, at);
  EXPECT_EQ(r.surface_speed, s.constant_surface_speed) << at;
  if (s.constant_surface_speed) expect_cut_off(r.limit_rpm, s.n_max_rpm, 1, at);
  EXPECT_EQ(r.tool, s.tool) << at;
  EXPECT_EQ(r.offset, control == Control::siemens ? 1 : s.tool) << at;
  EXPECT_EQ(r.turn, "M3") << at;
  EXPECT_TRUE(r.coolant) << at;
}

/// The moves of a program against those that its text commands.
/// @param rounded  of places that moves on the axis reach, as expect_same() has it
void expect_read_back(const SetupProgram& p, const std::vector<Read>& read,
                      Control control, const std::string& name, double rounded = 0.5) {
  std::size_t i = 0;
  int stops = 0;
  for (const auto& s : p.steps) {
    if (s.stop) {
      ++stops;
      continue;
    }
    for (std::size_t k = 0; k < s.moves.size(); ++k) {
      if (k > 0 && !moves_on(s.moves[k - 1], s.moves[k], control)) continue;
      ASSERT_LT(i, read.size()) << name;
      const auto at = name + ", " + s.comments[0] + ", move " + std::to_string(k);
      EXPECT_EQ(read[i].stops, stops) << at;
      stops = 0;
      expect_same(read[i++], s.moves[k], s, control, at,
                  s.moves[k].x_mm == 0 ? rounded : 0.5);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_EQ(i, read.size()) << name;
}

void expect_read_back(const std::string& name, const Planned& p) {
  const auto all = programs(p.part, p.plan);
  for (const auto control : kControls) {
    const Settings settings{.control = control};
    for (const auto& program : numbered(all, settings))
      expect_read_back(program, DialectReader(control).read(text(program, settings)),
                       control, name + " for " + id(control));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(NcDialects, OfEveryReferencePartCommandTheSameMoves) {
  for (const auto& name : reference_parts())
    expect_read_back(name, planned_reference(name));
}

// A shaft with a keyway and a flat, for which the cutter leaves the plane of the axis.
TEST(NcDialects, MillAtAnAngleOfTheMainSpindle) {
  const auto& p = planned_reference("keyed-shaft");
  const auto all = programs(p.part, p.plan);
  for (const auto control : kControls) {
    const Settings settings{.control = control, .milling = builders(control)};
    int milled = 0;
    for (const auto& program : numbered(all, settings)) {
      expect_read_back(program, DialectReader(control).read(text(program, settings)),
                       control, "keyed-shaft for " + id(control));
      milled += static_cast<int>(std::ranges::count_if(
          program.steps, [](const Step& s) { return s.milling.has_value(); }));
    }
    EXPECT_EQ(milled, control == Control::okuma ? 1 : 2) << id(control);  // no Y
  }
}

// Without the builder's codes somebody mills, and the program says why.
TEST(NcDialects, StopWhereTheCodesForMillingAreNotGiven) {
  const auto& p = planned_reference("keyed-shaft");
  for (const auto control : kControls) {
    const bool own = control == Control::linuxcnc || control == Control::haas ||
                     control == Control::okuma;
    const Settings settings{.control = control};
    int stops = 0;
    for (const auto& program : numbered(programs(p.part, p.plan), settings)) {
      DialectReader reader(control);
      reader.read(text(program, settings));
      for (const auto& c : reader.comments()) {
        const bool said = c.find("NO CODES OF THE") != c.npos ||
                          c.find("no codes of the") != c.npos ||
                          c.find("AN AXIS Y OF OKUMA OSP IS NOT PROGRAMMED") != c.npos;
        stops += static_cast<int>(said);
      }
      for (const auto& tool : program.tools)
        EXPECT_TRUE(own || tool.orientation != kCutterOrientation) << id(control);
    }
    EXPECT_EQ(stops, !own ? 2 : control == Control::okuma ? 1 : 0) << id(control);
    if (own) continue;
    EXPECT_THROW(text(programs(p.part, p.plan).setups[0], settings), std::domain_error);
  }
}

TEST(NcDialects, OfPartsWithCrossHolesCommandTheSameMoves) {
  expect_read_back("cross-holes", planned_awkward("cross-holes"));
}

TEST(NcDialects, OfReamedAndTappedPartsCommandTheSameMoves) {
  for (const char* name : kWithHoles) expect_read_back(name, planned_awkward(name));
}

Step step(int tool, double x_mm, Move::Kind kind) {
  Step s;
  s.comments = {"operation (50 % done)"};
  s.tool = tool;
  s.constant_surface_speed = tool == 1;
  s.S = 200.7;
  s.n_max_rpm = 2500.9;
  s.f_mm_rev = 0.25;
  s.moves = {{Move::Kind::rapid, 40, 5},
             {Move::Kind::rapid, x_mm, 5},
             {kind, x_mm, -20},
             {Move::Kind::rapid, 40, -20},
             {Move::Kind::rapid, 40, 5}};
  return s;
}

// Two setups, each of a cylinder, a drill and a thread.
std::vector<SetupProgram> small() {
  SetupProgram p;
  p.comments = {"part"};
  p.tools = {{1, "TURN", 1, 0.8, 3},
             {2, "DRILL 8 mm", 2, 0, kDrillOrientation},
             {3, "THREAD", 3, 0, 3}};
  p.steps = {step(1, 20, Move::Kind::feed), step(2, 0, Move::Kind::feed),
             step(3, 18, Move::Kind::thread)};
  SetupProgram second = p;
  second.setup = 1;
  return {p, second};
}

std::vector<Read> read(const Settings& settings, std::size_t setup = 0) {
  auto all = small();
  number_tools(all, settings);
  return DialectReader(settings.control).read(text(all[setup], settings));
}

TEST(NcDialects, NumberToolsAsTheShopDoes) {
  for (const auto control : kControls) {
    if (dialect(control).offset == gcode::OffsetNumber::of_tool) continue;
    const auto moves =
        read({.control = control, .tools = {{"DRILL 8 mm", 1, 12}, {"OTHER", 2}}});
    EXPECT_EQ(moves.front().tool, 3) << id(control);  // the lowest that is left
    EXPECT_EQ(moves[5].tool, 1) << id(control);
    EXPECT_EQ(moves[5].offset, 12) << id(control);
    EXPECT_EQ(moves.back().tool, 4) << id(control);
  }
}

TEST(NcDialects, WithM4OnlyTurningRunsBackwards) {
  for (const auto control : kControls) {
    const auto moves = read({.control = control, .spindle = SpindleTurn::M4});
    EXPECT_EQ(moves.front().turn, "M4") << id(control);
    EXPECT_EQ(moves[5].turn, "M3") << id(control);
    EXPECT_EQ(moves.back().turn, "M3") << id(control);
  }
}

TEST(NcDialects, StopBeforeEachChangeWithTheSpindleAtRest) {
  for (const auto control : kControls) {
    const Settings settings{.control = control, .optional_stops = true};
    const auto moves = read(settings);
    EXPECT_EQ(moves.front().stops, 0) << id(control);
    EXPECT_EQ(moves[5].stops, 1) << id(control);
    EXPECT_NE(text(small()[0], settings).find("M9\nM5\nM1\n"), std::string::npos);
  }
}

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(NcDialects, ReturnToTheReferenceAtBothEndsAndBeforeEachChange) {
  const std::map<Control, std::string> home{
      {Control::linuxcnc, "\nG28\n"},
      {Control::fanuc, "\nG28 U0. W0.\n"},
      {Control::fanuc_b, "\nG91 G28 X0. Z0.\nG90\n"},
      {Control::haas, "\nG53 G0 X0.\nG53 G0 Z0.\n"},
      {Control::siemens_iso, "\nG91 G28 X0. Z0.\nG90\n"},
      {Control::siemens, "\nG75 FP=1 X1=0 Z1=0\n"},
      {Control::okuma, "\nG20 HP=1\n"}};
  for (const auto control : kControls) {
    Settings settings{.control = control, .reference_returns = true};
    EXPECT_EQ(count(text(small()[0], settings), home.at(control)), 4) << id(control);
    EXPECT_EQ(read(settings).size(), read({.control = control}).size());
    settings.reference_returns = false;
    EXPECT_EQ(count(text(small()[0], settings), home.at(control)), 0) << id(control);
  }
}

TEST(NcDialects, NumberBlocksAsWanted) {
  for (const auto control : kControls) {
    const auto numbers = [&](BlockNumbers which) {
      DialectReader reader(control);
      reader.read(text(small()[0], {.control = control, .block_numbers = which}));
      return reader.numbers();
    };
    EXPECT_EQ(numbers(BlockNumbers::none), std::vector<int>{}) << id(control);
    EXPECT_EQ(numbers(BlockNumbers::tools), (std::vector<int>{10, 20, 30}));
    const auto all = numbers(BlockNumbers::all);
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(all[i], static_cast<int>(i) + 1) << id(control);
    EXPECT_GT(all.size(), 20U) << id(control);
  }
}

TEST(NcDialects, BlocksAreNumberedAnewAfterFourDigits) {
  auto p = small()[0];
  for (int i = 0; i < 10000; ++i)
    p.steps[0].moves.push_back({Move::Kind::feed, 20, i % 2 ? -20.0 : -19.0});
  DialectReader reader(Control::okuma);
  reader.read(text(p, {.control = Control::okuma, .block_numbers = BlockNumbers::all}));
  const auto& all = reader.numbers();
  EXPECT_EQ(*std::max_element(all.begin(), all.end()), 9999);
  EXPECT_EQ(all[9999], 1);
}

TEST(NcDialects, CountProgramsFromTheFirst) {
  const std::map<Control, std::string> second{{Control::fanuc, "%\nO1002\n"},
                                              {Control::fanuc_b, "%\nO1002\n"},
                                              {Control::haas, "%\nO01002\n"},
                                              {Control::okuma, "O1002\n"}};
  for (const auto& [control, head] : second) {
    const auto program = text(small()[1], {.control = control, .program_number = 1001});
    EXPECT_EQ(program.substr(0, head.size()), head);
  }
}

TEST(NcDialects, SelectTheWorkOffset) {
  for (const auto control : kControls) {
    DialectReader reader(control), other(control);
    reader.read(text(small()[0], {.control = control}));
    EXPECT_EQ(reader.words().contains("G54"), control != Control::okuma) << id(control);
    if (control == Control::okuma) continue;
    other.read(text(small()[0], {.control = control, .work_offset = "G55"}));
    EXPECT_TRUE(other.words().contains("G55")) << id(control);
    EXPECT_FALSE(other.words().contains("G54")) << id(control);
  }
}

TEST(NcDialects, TurnTheCoolantOnAsWanted) {
  for (const auto control : kControls) {
    for (const auto& move : read({.control = control, .coolant = ""}))
      EXPECT_FALSE(move.coolant) << id(control);
    const auto other = text(small()[0], {.control = control, .coolant = "M51"});
    EXPECT_EQ(count(other, "\nM51\n"), 3) << id(control);
    EXPECT_EQ(count(other, "\nM8\n"), 0) << id(control);
  }
}

// A bracket would end a comment, and a percent sign the program.
TEST(NcDialects, CommentsHoldNothingThatEndsThem) {
  for (const auto control : kControls) {
    DialectReader reader(control);
    reader.read(text(small()[0], {.control = control}));
    const bool small_letters =
        control == Control::linuxcnc || control == Control::siemens;
    const std::string told =
        small_letters ? "operation [50 ? done]" : "OPERATION [50 ? DONE]";
    int found = 0;
    for (const auto& c : reader.comments())
      found += static_cast<int>(c.find(told) != c.npos);
    EXPECT_EQ(found, 3) << id(control);
  }
}

// Every call of a tool, in whichever words, follows the number of parts that its edge
// makes, taken from the plan's own passes.
TEST(NcDialects, CallsOfToolsSayWhenTheEdgeIsChanged) {
  const auto p = test::planned_reference("drilled-bush");
  const auto all = programs(p.part, p.plan);
  std::size_t calls = 0;
  for (const auto& program : all.setups) {
    std::vector<std::string> wanted;
    int called = 0;
    for (const auto& step : program.steps) {
      if (step.stop || step.tool == called) continue;
      called = step.tool;
      const auto& id = std::ranges::find(program.tools, called, &TableTool::number)->id;
      for (const auto& e : p.plan.setups[program.setup].edges)
        if (e.tool == id)
          wanted.push_back(
              "every " +
              std::to_string(static_cast<long>(std::floor(1 / e.edges_per_part))) +
              " parts");
    }
    ASSERT_FALSE(wanted.empty());
    calls += wanted.size();
    for (const auto control : kControls) {
      DialectReader reader(control);
      reader.read(text(program, {.control = control}));
      std::vector<std::string> told;
      for (auto c : reader.comments()) {
        std::ranges::transform(c, c.begin(),
                               [](unsigned char x) { return std::tolower(x); });
        const auto at = c.find("change edge every ");
        if (at != c.npos)
          told.push_back(c.substr(at + 12, c.find(" parts") + 6 - at - 12));
      }
      EXPECT_EQ(told, wanted) << id(control);
    }
  }
  EXPECT_GE(calls, 4u);
}

// A drill of 8 mm with a point of 118 deg, 34 mm deep without it: 24 mm first, then pecks
// of 8 mm at most, to 36.4 mm.
const Planned& pecked() { return planned_awkward("a pecked hole"); }

std::vector<SetupProgram> with_cycles(const Planned& p, const Settings& settings) {
  auto all = numbered(programs(p.part, p.plan), settings);
  fit_to_control(all, settings, p.part.machine);
  return all;
}

std::vector<Move> moves_of(const std::vector<SetupProgram>& programs) {
  std::vector<Move> all;
  for (const auto& p : programs)
    for (const auto& s : p.steps) all.insert(all.end(), s.moves.begin(), s.moves.end());
  return all;
}

bool same_moves(const std::vector<Move>& a, const std::vector<Move>& b) {
  return std::ranges::equal(a, b, [](const Move& m, const Move& n) {
    return m.kind == n.kind && m.x_mm == n.x_mm && m.z_mm == n.z_mm;
  });
}

// Cycles expanded by the second reader, against the programs' moves.
void expect_cycles_read_back(const std::string& name, const Planned& p) {
  for (const auto control : kControls) {
    const Settings settings{.control = control, .drill_cycles = true};
    for (const auto& program : with_cycles(p, settings))
      expect_read_back(program, DialectReader(control).read(text(program, settings)),
                       control, name + " for " + id(control), 8);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(NcDialects, DrillingCyclesCommandTheProgramsMoves) {
  for (const auto& name : reference_parts())
    expect_cycles_read_back(name, planned_reference(name));
  for (const char* name : kWithHoles)
    expect_cycles_read_back(name, planned_awkward(name));
  expect_cycles_read_back("a pecked hole", pecked());
}

TEST(NcDialects, EveryHoleIsACycleWhereTheControlHasOne) {
  const std::map<Control, std::string> words{
      {Control::linuxcnc, "\nG98 G83 X0 Z-36.4034 R2 Q7.6807 F0.128\nG80\nG18\n"},
      {Control::fanuc, "\nG83 Z-36.403 R0. Q7681 F0.128\nG80\n"},
      {Control::fanuc_b, "\nG83 Z-36.403 R0. Q7681 F0.128\nG80\n"},
      {Control::haas, "\nG83 Z-36.403 R2. I26. J19.799 K6.202 F0.128\nG80\n"},
      {Control::siemens_iso, "\nG83 Z-36.403 R0. Q7681 F0.128\nG80\n"},
      {Control::siemens,
       "\nG17 F0.128\nCYCLE83(2,1,1,-36.403,,-24,,-0.238,0,0,1,1,,6.202,0,0,0.5)\nG18\n"},
      {Control::okuma, "\nG1 Z-24 F0.128\nG0 Z2\nG0 Z-23.5\nG1 Z-30.202\n"}};
  for (const auto& [control, word] : words) {
    const Settings settings{.control = control, .drill_cycles = true};
    EXPECT_EQ(count(text(with_cycles(pecked(), settings)[0], settings), word), 1)
        << id(control);
  }
  const std::map<Control, std::string> straight{
      {Control::linuxcnc, "\nG17\nG98 G81 X0 Z"},
      {Control::fanuc, "\nG83 Z"},
      {Control::fanuc_b, "\nG83 Z"},
      {Control::haas, "\nG81 Z"},
      {Control::siemens_iso, "\nG83 Z"},
      {Control::siemens, "\nCYCLE81("},
      {Control::okuma, "\nG74 X0 Z"}};
  const auto& bush = planned_reference("drilled-bush");
  for (const auto& [control, word] : straight) {
    Settings settings{.control = control, .drill_cycles = true};
    int holes = 0;
    for (const auto& p : with_cycles(bush, settings))
      holes += count(text(p, settings), word);
    EXPECT_EQ(holes, 1) << id(control);
    settings.drill_cycles = false;
    for (const auto& p : with_cycles(bush, settings))
      EXPECT_EQ(count(text(p, settings), word), 0) << id(control);
  }
}

// Where a cycle can peck as the plan does, nothing changes; where its pecks are all of one
// length, they reach the same bottom and no peck is longer than the drill allows.
TEST(NcDialects, DrillingCyclesPeckAsThePlanOrShorter) {
  const auto plain = moves_of(programs(pecked().part, pecked().plan).setups);
  for (const auto control : kControls) {
    const auto all = with_cycles(pecked(), {.control = control, .drill_cycles = true});
    const bool alike = control == Control::linuxcnc || control == Control::fanuc ||
                       control == Control::fanuc_b || control == Control::siemens_iso;
    EXPECT_EQ(same_moves(moves_of(all), plain), !alike) << id(control);
    if (!alike) continue;
    double deepest = 2;
    int pecks = 0;
    for (const auto& m : moves_of(all)) {
      if (m.kind != Move::Kind::feed || m.x_mm != 0 || m.z_mm > -1) continue;
      ++pecks;
      EXPECT_LE(deepest - m.z_mm, 8 + 1e-9);
      deepest = m.z_mm;
    }
    EXPECT_EQ(pecks, 5);
    EXPECT_NEAR(deepest, -(34 + 4 / std::tan(M_PI * 59 / 180)), 1e-9);
  }
}

// Feed of 38.4 mm and 0.254 or 0.5 mm before each of four pecks, at n = vc/(pi D), and the
// rapids in between, against the plain moves' three pecks.
TEST(NcDialects, MinutesAreThoseOfTheCyclesPecks) {
  const auto& p = pecked();
  const auto plain = programs(p.part, p.plan).setups;
  const auto& o = *std::ranges::find_if(p.plan.setups[0].operations, [](const auto& one) {
    return one.id == "s1-drill-b1";
  });
  const double bottom = 36.4034, feed = o.passes[0].f_mm_rev * o.passes[0].n_rpm,
               rapid = p.part.machine.rapid_mm_min;
  const auto hole_min = [&](const std::vector<double>& deep, double back) {
    double fed = bottom + 2, run = bottom + 2;
    for (const double d : deep) {
      fed += back;
      run += 2 * (d + 2) - back;
    }
    return fed / feed + run / rapid;
  };
  const double peck = (bottom + 2) / 5;
  const std::vector<double> alike{peck - 2, 2 * peck - 2, 3 * peck - 2, 4 * peck - 2};
  const double as_planned = hole_min({24, 30.2017}, 0.5);
  for (const auto control : kControls) {
    const auto all = with_cycles(p, {.control = control, .drill_cycles = true});
    const bool linuxcnc = control == Control::linuxcnc;
    const bool equal = same_moves(moves_of(all), moves_of(plain));
    const double more = equal ? 0 : hole_min(alike, linuxcnc ? 0.254 : 0.5) - as_planned;
    EXPECT_NEAR(all[0].minutes.total(), plain[0].minutes.total() + more, 1e-6)
        << id(control);
  }
}

// A thread of six cuts of equal area, outside or in a bore.
Step thread_step(double sign) {
  auto s = step(3, 0, Move::Kind::thread);
  const double from = 20 + 2 * sign, outside = 20, h = 0.92;
  s.moves = {{Move::Kind::rapid, from, 5}};
  for (int k = 1; k <= 6; ++k) {
    const double x = outside - sign * h * std::sqrt(k / 6.0);
    s.moves.insert(s.moves.end(), {{Move::Kind::rapid, x, 5},
                                   {Move::Kind::thread, x, -20},
                                   {Move::Kind::rapid, from, -20},
                                   {Move::Kind::rapid, from, 5}});
  }
  s.moves.push_back({Move::Kind::rapid, 60, 5});
  return s;
}

std::string thread_text(const Step& s, Control control) {
  auto p = small()[0];
  p.steps = {s};
  return text(p, {.control = control, .cycles = true});
}

double value(const std::string& block, char letter) {
  return std::stod(block.substr(block.find(letter) + 1));
}

std::string last_g76(const std::string& program) {
  const auto at = program.rfind("G76 ");
  return program.substr(at, program.find('\n', at) - at);
}

// G76: the k-th cut is as deep as the first times the root of k, until the whole depth.
void expect_cuts(double first, double depth, double root, const Step& planned,
                 double sign) {
  std::vector<double> cuts;
  for (int k = 1; cuts.empty() || cuts.back() < depth; ++k)
    cuts.push_back(std::min(depth, first * std::sqrt(k)));
  std::vector<double> wanted;
  for (const auto& m : planned.moves)
    if (m.kind == Move::Kind::thread) wanted.push_back(m.x_mm);
  ASSERT_EQ(cuts.size(), wanted.size());
  for (std::size_t k = 0; k < cuts.size(); ++k)
    EXPECT_NEAR(root + sign * (depth - cuts[k]), wanted[k], 2.5e-3) << k;
}

TEST(NcDialects, CyclesOfThreadsMakeTheCutsOfThePlan) {
  for (const double sign : {1.0, -1.0}) {
    const auto s = thread_step(sign);
    for (const auto control : {Control::fanuc, Control::fanuc_b}) {
      const auto program = thread_text(s, control);
      EXPECT_NE(program.find("\nG76 P010000 Q80 R0.\nG76 X"), std::string::npos);
      const auto block = last_g76(program);
      expect_cuts(value(block, 'Q') / 1e3, value(block, 'P') / 1e3, value(block, 'X') / 2,
                  s, sign);
      EXPECT_EQ(value(block, 'Z'), -20);
      EXPECT_EQ(value(block, 'F'), 0.25);
      EXPECT_EQ(block.substr(block.find('P'), 5), "P920 ");
    }
    const auto program = thread_text(s, Control::haas);
    EXPECT_NE(program.find("\nM24\nG76 X"), std::string::npos);
    const auto haas = last_g76(program);
    expect_cuts(value(haas, 'D'), value(haas, 'K'), value(haas, 'X') / 2, s, sign);

    const auto linuxcnc = last_g76(thread_text(s, Control::linuxcnc));
    const double depth = value(linuxcnc, 'K') / 2;
    EXPECT_NEAR(20 + 2 * sign + value(linuxcnc, 'I') / 2, 20, 1e-9);
    expect_cuts(value(linuxcnc, 'J') / 2, depth, 20 - sign * depth, s, sign);
    EXPECT_NE(linuxcnc.find(" R2 Q0 H0"), std::string::npos);
  }
}

// CYCLE97 cuts NRC times to what FAL leaves, in sections alike, then FAL.
TEST(NcDialects, SiemensThreadsMakeTheCutsOfThePlan) {
  for (const double sign : {1.0, -1.0}) {
    const auto s = thread_step(sign);
    const auto program = thread_text(s, Control::siemens);
    EXPECT_EQ(count(program, "\nCYCLE97("), 1);
    EXPECT_EQ(count(program, "\nG33"), 0);
    const auto read = DialectReader(Control::siemens).read(program);
    std::vector<Move> cuts;
    std::ranges::copy_if(s.moves, std::back_inserter(cuts),
                         [](const Move& m) { return m.kind == Move::Kind::thread; });
    std::size_t k = 0;
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (read[i].kind != Move::Kind::thread) continue;
      ASSERT_LT(k, cuts.size());
      EXPECT_NEAR(read[i].x_mm, cuts[k].x_mm, 2.5e-3) << k;
      EXPECT_EQ(read[i].z_mm, cuts[k++].z_mm);
      EXPECT_EQ(read[i].f_mm_rev, s.f_mm_rev);
      for (const auto beside : {i - 2, i + 2}) {  // where each cut begins and ends
        EXPECT_EQ(read[beside].x_mm, s.moves[0].x_mm);
        EXPECT_EQ(read[beside].z_mm, s.moves[0].z_mm);
      }
    }
    EXPECT_EQ(k, cuts.size());
  }
}

TEST(NcDialects, OtherInfeedsAreNoCycle) {
  auto s = thread_step(1);
  s.moves[6].x_mm = s.moves[5].x_mm -= 1e-4;
  for (const auto control : {Control::linuxcnc, Control::fanuc, Control::haas}) {
    EXPECT_EQ(count(thread_text(s, control), "G76"), 0) << id(control);
    EXPECT_GT(count(thread_text(s, control), "\nG3"), 5) << id(control);
  }
  EXPECT_EQ(count(thread_text(thread_step(1), Control::okuma), "\nG33 X"), 6);
}

// On the other controls G33 is one cut; here it is a cycle.
TEST(NcDialects, OkumasThreadsComeBackByThemselves) {
  const auto program = text(small()[0], {.control = Control::okuma});
  EXPECT_NE(program.find("G0 X80 Z5\nG33 X36 Z-20 F0.25\nM9\n"), std::string::npos)
      << program;
  auto other = small()[0];
  other.steps[2].moves[3].x_mm = 41;
  EXPECT_THROW(text(other, {.control = Control::okuma}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::nc
