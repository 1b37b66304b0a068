#include <cmath>
#include <string>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using Kind = toolpath::Move::Kind;

/// Conditions of the run with the last move.
const toolpath::Step& last(const TurningProgram& p) { return p.runs.back().step; }

TEST(ReadProgram, HalvesDiametersAndConvertsInches) {
  const auto fanuc = read(Control::fanuc,
                          "T0203\nG99\nG97 S800 M3\nG0 X40. Z2.\n"
                          "G1 X30. Z-10. F0.2");
  ASSERT_EQ(moves(fanuc).size(), 2u);
  expect_at(moves(fanuc)[1], 15, -10);
  EXPECT_EQ(last(fanuc).tool, 2);
  EXPECT_EQ(last(fanuc).f_mm_rev, 0.2);
  EXPECT_EQ(last(fanuc).S, 800);
  EXPECT_FALSE(last(fanuc).constant_surface_speed);
  // LinuxCNC starts with radii and feed by the minute.
  const auto linuxcnc =
      read(Control::linuxcnc, "G20 T1 M6\nS500 M3\nG0 X1 Z0\nG1 Z-1 F5");
  expect_at(moves(linuxcnc)[1], 25.4, -25.4);
  EXPECT_NEAR(last(linuxcnc).f_mm_rev, 5 * 25.4 / 500, 1e-12);
  EXPECT_EQ(last(linuxcnc).tool, 1);
  EXPECT_TRUE(fanuc.unknown.empty());
  EXPECT_TRUE(linuxcnc.unknown.empty());
}

TEST(ReadProgram, KnowsIncrementsOfBothSystems) {
  const auto a = read(Control::haas, "G99 G97 S800 M3\nG0 X40. Z2.\nG1 U-4. W-3. F0.2");
  expect_at(moves(a)[1], 18, -1);
  const auto b =
      read(Control::fanuc_b, "G95 G97 S800 M3\nG0 X40. Z2.\nG91 G1 X-4. Z-3. F0.2");
  expect_at(moves(b)[1], 18, -1);
}

TEST(ReadProgram, LimitsTheSpindleInTheWordsOfEachControl) {
  const std::string rest = "\nG0 X40 Z2\nG1 Z-5 F0.2";
  for (const auto& [control, words] :
       {std::pair{Control::fanuc, "G99\nG50 S2500\nG96 S200 M3"},
        {Control::fanuc_b, "G95\nG92 S2500\nG96 S200 M3"},
        {Control::linuxcnc, "G95 G7\nG96 D2500 S200 M3"},
        {Control::siemens, "G95 DIAMON\nG96 S200 LIMS=2500 M3"},
        {Control::okuma, "G95\nG50 S2500\nG96 S200 M3"}}) {
    const auto p = read(control, words + rest);
    EXPECT_TRUE(p.unknown.empty()) << words;
    EXPECT_TRUE(last(p).constant_surface_speed);
    EXPECT_EQ(last(p).n_max_rpm, 2500) << words;
    EXPECT_EQ(last(p).S, 200) << words;
  }
  EXPECT_EQ(last(read(Control::fanuc, "G99\nG96 S200 M3" + rest)).n_max_rpm, 4000);
}

// A quarter of a circle of 5 mm about (20, -10), from the outside inwards.
TEST(ReadProgram, FindsTheCentreOfArcs) {
  const std::string to = "G99 G97 S800 M3\nG0 X40. Z-5.\nG3 X50. Z-10. ";
  for (const char* words : {"I0. K-5. F0.1", "R5. F0.1"}) {
    const auto p = read(Control::fanuc, to + words);
    ASSERT_EQ(moves(p).size(), 2u) << words;
    EXPECT_EQ(moves(p)[1].kind, Kind::arc);
    EXPECT_NEAR(moves(p)[1].centre.h_mm, 20, 1e-9) << words;
    EXPECT_NEAR(moves(p)[1].centre.z_mm, -10, 1e-9) << words;
    EXPECT_FALSE(moves(p)[1].clockwise);
  }
  const auto wrong = read(Control::fanuc, to + "R2. F0.1");
  ASSERT_EQ(wrong.unknown.size(), 1u);
  EXPECT_EQ(wrong.unknown[0].line, 3u);
}

TEST(ReadProgram, MakesMovesOfBoxes) {
  const auto p = read(Control::fanuc,
                      "G99 G97 S800 M3\nG0 X40. Z2.\nG90 X36. Z-20. F0.2\nX32.\n"
                      "G94 X10. Z-1.");
  const auto m = moves(p);
  ASSERT_EQ(m.size(), 13u);
  expect_at(m[1], 18, 2);
  EXPECT_EQ(m[2].kind, Kind::feed);
  expect_at(m[2], 18, -20);
  expect_at(m[3], 20, -20);
  expect_at(m[4], 20, 2);
  expect_at(m[6], 16, -20);
  expect_at(m[9], 20, -1);
  EXPECT_EQ(m[10].kind, Kind::feed);
  expect_at(m[10], 5, -1);
  expect_at(m[12], 20, 2);
}

/// Radii at which a thread is cut.
std::vector<double> thread_radii(const TurningProgram& p) {
  std::vector<double> all;
  for (const auto& m : moves(p))
    if (m.kind == Kind::thread) all.push_back(m.x_mm);
  return all;
}

// M20 x 1.5, 0.9 mm deep; the k-th cut is sqrt(k) times as deep as the first, 0.45 mm.
TEST(ReadProgram, MakesCutsOfThreads) {
  const std::vector<double> radii{10 - 0.45, 10 - 0.45 * std::sqrt(2),
                                  10 - 0.45 * std::sqrt(3), 10 - 0.9};
  for (const auto& [control, words] :
       {std::pair{Control::linuxcnc,
                  "G7 G95 G97 S500 M3\nG0 X24 Z5\nG76 P1.5 Z-20 I-4 J0.9 K1.8 R2"},
        {Control::fanuc,
         "G99 G97 S500 M3\nG0 X24. Z5.\nG76 P010000 Q20 R0.\n"
         "G76 X18.2 Z-20. P900 Q450 F1.5"},
        {Control::haas, "G99 G97 S500 M3\nG0 X24. Z5.\nG76 X18.2 Z-20. K0.9 D0.45 F1.5"},
        {Control::fanuc,
         "G99 G97 S500 M3\nG0 X24. Z5.\nG92 X19.1 Z-20. F1.5\n"
         "X18.7272\nX18.4412\nX18.2"},
        {Control::okuma,
         "G95 G97 S500 M3\nG0 X24 Z5\nG33 X19.1 Z-20 F1.5\n"
         "X18.7272\nX18.4412\nX18.2"}}) {
    const auto p = read(control, words);
    const auto found = thread_radii(p);
    ASSERT_EQ(found.size(), 4u) << words;
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k], radii[k], 1e-4) << words;
    EXPECT_EQ(last(p).f_mm_rev, 1.5) << words;
    expect_at(moves(p).back(), 12, 5);
    EXPECT_TRUE(p.unknown.empty()) << words;
  }
}

TEST(ReadProgram, NamesToolsOfComments) {
  const auto p = read(Control::fanuc,
                      "(T1 PCLNL-CNMG120408-PM, CORNER 0.8 MM)\n"
                      "(T12 DRILL-HM-5D 19 MM)\n(TOOLS)\n(T3)");
  ASSERT_EQ(p.named_tools.size(), 2u);
  EXPECT_EQ(p.named_tools.at(1), "PCLNL-CNMG120408-PM");
  EXPECT_EQ(p.named_tools.at(12), "DRILL-HM-5D 19 MM");
}

// A cone from 20 to 30 mm over 10 mm and a cylinder of 30 mm, roughed from 40 mm by 2 mm on
// the radius, 0.5 mm left on the radius and 0.1 mm along the axis.
TEST(ReadProgram, RoughsAndFinishesContours) {
  const auto p = read(Control::fanuc,
                      "G99 G97 S500 M3\nG0 X40. Z2.\nG71 U2. R0.5\n"
                      "G71 P10 Q20 U1. W0.1 F0.3\nN10 G0 X20.\nG1 Z0. F0.1\nX30. Z-10.\n"
                      "N20 Z-30.\nG70 P10 Q20\nG0 X60. Z5.");
  for (const auto& u : p.unknown) ADD_FAILURE() << u.line << u.what << u.why;
  const auto m = moves(p);
  // To the start, four passes, along the contour, twice back; finishing, twice back; away.
  ASSERT_EQ(m.size(), 1u + 4u * 4u + 1u + 4u + 2u + 4u + 2u + 1u);
  // At 18 mm the cylinder of 15.5 mm is passed inside, to the end.
  expect_at(m[2], 18, -29.9);
  expect_at(m[3], 18.5, -29.4);
  EXPECT_EQ(m[4].kind, Kind::rapid);
  expect_at(m[4], 18.5, 2);
  expect_at(m[6], 16, -29.9);
  // The cone begins at 10.5 mm and 0.1 mm: 14 mm are 7 mm behind.
  expect_at(m[10], 14, -6.9);
  expect_at(m[14], 12, -2.9);
  expect_at(m[19], 10.5, 0.1);
  expect_at(m[21], 15.5, -29.9);
  // Finishing with the feed of the blocks.
  expect_at(m[25], 10, 0);
  expect_at(m[27], 15, -30);
  expect_at(m[29], 20, 2);
  for (const auto& run : p.runs)
    for (const auto& move : run.moves)
      if (move.to.kind == Kind::feed && move.to.z_mm == -30.0) {
        EXPECT_EQ(run.step.f_mm_rev, 0.1);
      }
}

struct Strange {
  Control control;
  const char* text;
  std::size_t line;
  const char* what;
};

// What is not understood is listed with its line, and nothing is cut from a place that is
// not known.
TEST(ReadProgram, ListsWhatItDoesNotKnow) {
  const std::string start = "G97 S500 M3 F0.1\nG0 X20. Z2.\n";
  const Strange strange[] = {
      {Control::linuxcnc, "#5=\n", 3, "#5="},
      {Control::linuxcnc, "G1 X[3+]\n", 3, "G1 X[3+]"},
      {Control::linuxcnc, "G1 X[3\n", 3, "X[3"},
      {Control::linuxcnc, "G1 X[1/0]\n", 3, "G1 X[1/0]"},
      {Control::linuxcnc, "G1 X#<diameter>\n", 3, "G1 X#<diameter>"},
      {Control::linuxcnc, "G1 X#5161\n", 3, "G1 X#5161"},
      {Control::linuxcnc, "o100 call\n", 3, "o100 call"},
      {Control::linuxcnc, "o100 if [#5161]\no100 endif\n", 3, "o100 if [#5161]"},
      {Control::linuxcnc, "o100 while [1]\n", 3, "o100 while [1]"},
      {Control::linuxcnc, "G71 Q100 D1 I1 R1\n", 3, "G71 Q100 D1 I1 R1"},
      {Control::fanuc, "G73 P10 Q20 U1.\n", 3, "P10 Q20"},
      {Control::fanuc, "M98 P1000\n", 3, "M98 P1000"},
      {Control::fanuc, "G65 P1000 A1.\n", 3, "G65 P1000 A1."},
      {Control::fanuc, "G66 P1000 A1.\n", 3, "G66 P1000 A1."},
      {Control::fanuc, "G1 X#500\n", 3, "G1 X#500"},
      {Control::fanuc, "#3000=1(ALARM)\n", 3, "#3000=1(ALARM)"},
      {Control::fanuc, "IF [#1001 EQ 1] GOTO 9\n", 3, "IF [#1001 EQ 1] GOTO 9"},
      {Control::fanuc, "GOTO 9\n", 3, "GOTO 9"},
      {Control::fanuc, "WHILE [1 EQ 2] DO1\n", 3, "WHILE [1 EQ 2] DO1"},
      {Control::fanuc, "G1 Y3.\n", 3, "Y3."},
      {Control::fanuc, "G123\n", 3, "G123"},
      {Control::fanuc, "G1 X10. F0.2E5\n", 3, "E5"},
      {Control::fanuc, "G1 X10.5.2\n", 3, ".2"},
      {Control::fanuc, "G1 X10. X12.\n", 3, "X12."},
      {Control::linuxcnc, "G1 X10 Z\n", 3, "Z"},
      {Control::siemens, "CYCLE95(\"CONTOUR\",2)\n", 3, "CYCLE95(\"CONTOUR\",2)"},
      {Control::siemens, "TRANS Z=5\n", 3, "TRANS"}};
  for (const auto& s : strange) {
    const auto p = read(s.control, start + s.text);
    ASSERT_FALSE(p.unknown.empty()) << s.text;
    EXPECT_EQ(p.unknown[0].line, s.line) << s.text;
    EXPECT_EQ(p.unknown[0].what, s.what);
    EXPECT_FALSE(p.unknown[0].why.empty());
  }
}

// MSG() moves nothing, whatever its text looks like; another name with brackets may.
TEST(ReadProgram, MessagesToTheOperatorMoveNothing) {
  const auto program = [](const std::string& line) {
    return read(
        Control::siemens,
        "G18 G710 G90 G95 DIAMON\nG97 S500 M3 F0.1\nG0 X20 Z2\n" + line + "\nG1 Z-9");
  };
  for (const auto* line : {"MSG(\"X1 Z2 (E3)\")", "msg()", "N40 MSG(\"TURN\") M8",
                           "MSG(\"it says: \") ; end\""}) {
    const auto p = program(line);
    EXPECT_TRUE(p.unknown.empty()) << line << ": " << p.unknown[0].what;
    ASSERT_TRUE(p.runs.back().moves.back().from) << line;
    expect_at(moves(p).back(), 10, -9);
  }
  for (const auto* line : {"MSG(\"no end", "MSGX(\"1\")", "CYCLE1(2)"})
    EXPECT_EQ(program(line).unknown.size(), 2u) << line;  // and the cut that follows
}

TEST(ReadProgram, DoesNotCutFromAPlaceThatIsNotKnown) {
  const auto p = read(Control::fanuc,
                      "G99 G97 S500 M3\nG1 Z-5. F0.1\nG0 X20. Z2.\nG28 U0.\n"
                      "G1 Z-9.\nG0 X22. Z2.\nG1 Z-5.");
  EXPECT_EQ(p.unknown.size(), 2u);
  int known = 0;
  for (const auto& run : p.runs)
    for (const auto& m : run.moves)
      if (m.to.kind == Kind::feed) known += m.from.has_value();
  EXPECT_EQ(known, 1);
}

// A code that nobody knows may be one of motion, if its block names a place.
TEST(ReadProgram, AnUnknownCodeBesideAPlaceLosesIt) {
  const auto last = [](const std::string& line) {
    const auto p =
        read(Control::okuma, "G95 G97 S500 M3 F0.1\nG0 X20 Z2\n" + line + "\nG1 Z-9");
    return p.runs.back().moves.back().from.has_value();
  };
  EXPECT_TRUE(last("G123"));
  EXPECT_FALSE(last("G181 X18 Z-5"));
}

TEST(ReadProgram, DoesNotFollowShiftedZerosAndSubprogramsThatNobodyCalls) {
  const auto shifted = read(Control::linuxcnc,
                            "G95 G97 S500 M3\nG0 X20 Z2\nG92 Z0\nG1 Z-9 F0.1\nG92.1\n"
                            "G0 X20 Z2\nG1 Z-3");
  ASSERT_EQ(shifted.unknown.size(), 1u);
  EXPECT_EQ(shifted.unknown[0].line, 4u);
  expect_at(moves(shifted).back(), 20, -3);
  const auto sub =
      read(Control::linuxcnc,
           "G95 G97 S500 M3 F0.1\nG0 X20 Z2\nO100 sub\nG1 Z-50\nO100 endsub\n"
           "o<long> sub\nG1 Z-60\no<long> endsub\nG1 Z-3");
  EXPECT_TRUE(sub.unknown.empty());
  EXPECT_EQ(moves(sub).size(), 2u);
}

TEST(ReadProgram, RefusesCutsAtRestAndWithoutFeed) {
  EXPECT_EQ(read(Control::fanuc, "G0 X20. Z2.\nG1 Z-5. F0.1 S500").unknown.size(), 1u);
  EXPECT_EQ(read(Control::fanuc, "M3 S500\nG0 X20. Z2.\nG1 Z-5.").unknown.size(), 1u);
  EXPECT_EQ(read(Control::fanuc, "M3\nG0 X20. Z2.\nG1 Z-5. F0.1").unknown.size(), 1u);
}

TEST(ReadProgram, EndsAndIsBounded) {
  const auto ended = read(Control::fanuc, "G0 X20. Z2.\nM30\nG0 X50.");
  EXPECT_EQ(moves(ended).size(), 1u);
  std::string text = "G0 X20. Z2.\n";
  for (int i = 0; i < 50; ++i) text += "X20.\nX21.\n";
  const auto cut_off =
      read_program(text, {.control = Control::fanuc, .n_max_rpm = 4000, .moves_max = 10});
  EXPECT_EQ(moves(cut_off).size(), 10u);
  ASSERT_EQ(cut_off.unknown.size(), 1u);
}

}  // namespace
}  // namespace turnwright::review
