#include <chrono>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using Ways = std::vector<std::string>;

const std::string kStart = "G99 G97 S500 M3\nG0 X20. Z5. F0.1\n";

/// The ends that X has after the start, as the program writes them.
std::vector<double> diameters(Control control, const std::string& text) {
  return diameters_after_start(control, kStart + text);
}
using All = std::vector<double>;

TEST(FanucMacro, ReckonsInItsOwnRanks) {
  for (const auto& [text, value] :
       {std::pair{"#1=2+3*4\nG1 X#1", 14.0},
        {"G1 X[10.-4.-3.]", 3.0},
        {"#1=-7\n#2=#1 MOD 3\nG1 X[#2+2]", 1.0},  // the dividend's sign
        {"G1 X[FIX[-2.8]+3]", 1.0},               // towards 0
        {"G1 X[FUP[-2.2]+4]", 1.0},               // away from it
        {"G1 X[6 AND 3]", 2.0},
        {"G1 X[6 OR 3]", 7.0},
        {"G1 X[6 XOR 3]", 5.0},
        {"G1 X[1 OR 2 AND 2]", 3.0},  // AND is a product, OR a sum
        {"G1 X[POW[2,3]]", 8.0},
        {"G1 X[SQR[9]+RND[1.6]]", 5.0},
        {"G1 X[ATAN[1]/[1]/15]", 3.0},
        {"G1 X[ATAN[1]/9]", 5.0},
        {"#[1+1]=4\nG1 X##[1+1] X#2", 4.0},
        {"#4=7\n#2=4\nG1 X##2", 7.0},
        {"G1 X-[-3.]", 3.0},
        {"N5 #7 = 6 (DEPTH)\nG1 X#7", 6.0}}) {
    const auto p = read(Control::fanuc, kStart + text);
    if (std::string(text).find("X#2") == std::string::npos ||
        std::string(text).find("X##[") == std::string::npos)
      expect_understood(p);
    EXPECT_NEAR(2 * moves(p).back().x_mm, value, 1e-12) << text;
  }
}

// Blocks may be skipped by one of several switches, "/2 N10 ..", and are taken as executed.
TEST(ProgramFlow, ExecutesBlocksBehindASlash) {
  for (const auto control : {Control::fanuc, Control::siemens, Control::okuma}) {
    const bool fanuc = control == Control::fanuc;
    const auto p = read(control, (fanuc ? kStart + "/2 GOTO 10"
                                        : "G95 " + kStart.substr(4) + "/2 GOTO N10") +
                                     "\nG1 X1.\nN10 G1 Z1.\n/ Z2.\n/1 N20 Z3.\n/9Z4.");
    expect_understood(p);
    EXPECT_EQ(moves(p).size(), 5u);
    EXPECT_EQ(moves(p).back().z_mm, 4);
    EXPECT_EQ(p.assumed.front(), "Blocks with a slash are taken as executed.");
  }
}

// A control stops with an alarm where a value grows beyond what it can hold.
TEST(FanucMacro, HasNoValuesBeyondAllBounds) {
  const std::string grows = "#1=1\nWHILE [#2 LT 2000] DO1\n#1=#1+#1\n#2=#2+1\nEND1\n";
  for (const char* text : {"S#1", "F#1", "G#1", "M#1", "T#1", "G[9.*[99999999.]] X1."}) {
    const auto p = read(Control::fanuc, kStart + grows + text + "\nG0 X20. Z5.\nG1 Z0.");
    ASSERT_FALSE(p.unknown.empty()) << text;
    EXPECT_EQ(p.unknown.back().what, text);
    for (const auto& run : p.runs) {
      EXPECT_LE(run.step.S, 500) << text;
      EXPECT_LE(run.step.f_mm_rev, 0.1) << text;
    }
  }
}

// The table of Fanuc's manual for a vacant #1, and for #1 = 0.
TEST(FanucMacro, TellsVacantFromZero) {
  const auto holds = [](const std::string& condition) {
    return diameters(Control::fanuc,
                     "IF [" + condition + "] GOTO 9\nG1 X1.\nN9 G1 X2.") == All{2};
  };
  EXPECT_TRUE(holds("#1 EQ #0"));
  EXPECT_TRUE(holds("#1 NE 0"));
  EXPECT_TRUE(holds("#1 GE #0"));
  EXPECT_FALSE(holds("#1 GT 0"));
  EXPECT_FALSE(holds("#1 EQ 0"));
  const std::string zero = "#1=0\n";
  EXPECT_EQ(diameters(Control::fanuc, zero + "IF[#1EQ#0]GOTO9\nG1X1.\nN9G1X2."),
            (All{1, 2}));
  // A word with a vacant variable is as if it were not there.
  EXPECT_EQ(ways(read(Control::fanuc, kStart + "G1 X#1 Z3.")),
            (Ways{"G0 10 5", "G1 10 3"}));
}

TEST(FanucMacro, JumpsAndRepeats) {
  EXPECT_EQ(diameters(Control::fanuc,
                      "#1=1\nN5 IF [#1 GT 3] GOTO 20\nG1 X#1\n#1=#1+1\nGOTO 5\n"
                      "N20 X9."),
            (All{1, 2, 3, 9}));
  EXPECT_EQ(
      diameters(Control::haas,
                "#1=6.\nWHILE [#1 GT 2.] DO1\n#2=0\nWHILE[#2 LT 2]DO2\nG1 X[#1+#2]\n"
                "#2=#2+1\nEND2\n#1=#1-2.\nEND1\nX30."),
      (All{6, 7, 4, 5, 30}));
  EXPECT_EQ(
      diameters(Control::fanuc, "IF [1 EQ 1] THEN #5=8.\nIF [1 EQ 2] THEN #5=9.\nG1 X#5"),
      (All{8}));
  EXPECT_EQ(diameters(Control::fanuc_b, "DO 3\nG1 X5.\nGOTO [5+5]\nEND 3\nN10 X6."),
            (All{5, 6}));
}

TEST(FanucPrograms, AreCalled) {
  const std::string subs =
      "M30\nO1000 (GROOVE)\nG1 U-2.\nM99\nO2\nM98 P1000\nG0 U1.\nM99\n";
  const std::string main = "O1\n" + kStart;
  const auto ends = [&](Control control, const std::string& text) {
    return diameters_after_start(control, main + text + subs);
  };
  EXPECT_EQ(ends(Control::fanuc, "M98 P1000 L3\nX30.\n"), (All{18, 16, 14, 30}));
  EXPECT_EQ(ends(Control::fanuc, "M98 P31000\n"), (All{18, 16, 14}));
  EXPECT_EQ(ends(Control::fanuc, "X10. M98 P2 L2\nX30.\n"),
            (All{10, 8, 9, 7, 8, 30}));  // after the block's own move
  EXPECT_EQ(ends(Control::haas, "M97 P50 L2\nGOTO 60\nN50 G1 U-4.\nM99\nN60 X30.\n"),
            (All{16, 12, 30}));
}

TEST(FanucPrograms, ReturnToABlock) {
  EXPECT_EQ(
      diameters(Control::fanuc, "M98 P5\nG1 X1.\nN70 X2.\nM30\nO5\nG1 X3.\nM99 P70\n"),
      (All{3, 2}));
}

// Variables of a macro are its own; what it sets of the common ones stays.
TEST(FanucPrograms, GiveMacrosTheirArguments) {
  EXPECT_EQ(diameters(Control::fanuc,
                      "#1=50.\nG65 P9010 X12. Z-3. A4. F0.2\nG1 X#1\nX#100\nM30\n"
                      "O9010\nG1 X#24 F#9\nZ#26\nX[#24+#1]\n#100=#1\n#1=7\nM99\n"),
            (All{12, 12, 16, 50, 4}));
}

// Behind each move of the program with G66, not behind those of the macro, until G67.
TEST(FanucPrograms, CallModalMacros) {
  const std::string macro = "M30\nO9010\nG1 U-[#1] F#9\n#1=9.\nU[#1-9.+#2]\nM99\n";
  EXPECT_EQ(diameters(Control::fanuc,
                      "G66 P9010 A2. B1. F0.2\nG0 X40.\nM8\nX30.\nG67\n"
                      "G0 X50.\n" +
                          macro),
            (All{40, 38, 39, 30, 28, 29, 50}));
  EXPECT_EQ(diameters(Control::haas, "G66 P9010 L2 A2. B1. F0.2\nG0 X40.\nG67\n" + macro),
            (All{40, 38, 39, 37, 38}));
  EXPECT_EQ(diameters(Control::fanuc, "G66 P9010 A2. B1. F0.2\nM98 P5\nG0 X40.\nG67\n" +
                                          macro + "O5\nG0 X8.\nM99\n"),
            (All{8, 40, 38, 39}));
  for (const char* text : {"G66 A1.\n", "G66 P77 A1.\n", "G66 P9010 A1.\nG66 P9010 A1.\n",
                           "G66 P9010 A1. B1. F0.1\nG70 P10 Q20\nN10 G0 X9.\nN20 X8.\n"})
    EXPECT_FALSE(read(Control::fanuc, kStart + text + macro).unknown.empty()) << text;
}

TEST(FanucPrograms, EndWithM99OnTheirOwn) {
  const auto p = read(Control::fanuc, kStart + "G1 X10.\nM99\nX5.");
  EXPECT_EQ(moves(p).size(), 2u);
  ASSERT_EQ(p.assumed.size(), 1u);
}

// A second program in the text is nobody's but who calls it.
TEST(FanucPrograms, AreOneByOne) {
  EXPECT_EQ(diameters(Control::fanuc, "G1 X9.\nO7\nG1 X5.\n"), (All{9}));
  const auto p = read(Control::fanuc, "%\nO1(A)\n" + kStart + "G1 X9.\n%\nO7\nX5.");
  EXPECT_EQ(moves(p).size(), 2u);
}

// A condition that the program does not tell counts as false, and the place is lost.
TEST(ProgramFlow, DoubtsWhatItDoesNotKnow) {
  const auto p = read(Control::fanuc,
                      kStart + "IF [#1000 EQ 1] GOTO 9\nG1 Z-5.\nX8. Z-4.\nN9 G1 X9.");
  ASSERT_EQ(p.unknown.size(), 2u);  // and the cut behind it
  EXPECT_EQ(p.unknown[0].line, 3u);
  EXPECT_EQ(moves(p).back().x_mm, 4.5);
  const auto loop = read(
      Control::linuxcnc,
      "G8 G95 S500 M3 F0.1\nG0 X5 Z5\no1 while [#5161 EQ 0]\nG1 X1\no1 endwhile\nX3");
  ASSERT_EQ(loop.unknown.size(), 1u);
  EXPECT_EQ(moves(loop).size(), 1u);
}

struct Hostile {
  Control control;
  std::string text;
};

// Loops without an end, empty programs called for ever, chains of branches, conditions in a
// thousand brackets: each ends, tells it, and in time.
TEST(ProgramFlow, EndsWhateverTheLoop) {
  std::string chain = "o1 while [1]\no2 if [0]\n", contour, labels, deep;
  for (int i = 0; i < 20'000; ++i) chain += "o2 elseif [0]\n";
  chain += "o2 endif\no1 endwhile\n";
  for (int i = 0; i < 20'000; ++i) contour += "N15\n";
  for (int i = 0; i < 20'000; ++i) labels += "o9 if [0]\no9 endif\n";
  for (int i = 0; i < 20'000; ++i) deep += '[';
  const Hostile hostile[] = {
      {Control::linuxcnc, "o1 while [1]\no1 endwhile\n"},
      {Control::linuxcnc, "o1 do\no1 while [1]\n"},
      {Control::linuxcnc, "o1 repeat [1000000000]\no1 endrepeat\n"},
      {Control::linuxcnc, "o1 repeat [999999]\no1 endrepeat\n"},
      {Control::linuxcnc,
       "o1 sub\no1 call\no1 endsub\no2 while [1]\no1 call\no2 endwhile"},
      {Control::linuxcnc,
       "o1 while [1]\n#<_n>=[#<_n>+1]\n#[#31]=1 #31=[#31+1]\n"
       "o1 endwhile\n"},
      {Control::linuxcnc, chain},
      {Control::linuxcnc,
       "o9 sub\no9 endsub\n" + labels + "o1 while [1]\no9 call\no1 endwhile\n"},
      {Control::siemens, "A: GOTOB A\n"},
      {Control::siemens, "LOOP\nENDLOOP\n"},
      {Control::siemens, "R1=1\nWHILE R1\nENDWHILE\n"},
      {Control::siemens, "A: R1=1\nREPEAT A P=9999\nREPEAT A P=9999\nGOTOB A\n"},
      {Control::siemens, "A: A\nGOTOB A\nM30\nPROC A\nA\nA\nRET\n"},
      {Control::siemens, "FOR R1=0 TO 1000000\nENDFOR\n"},
      {Control::okuma, "NA GOTO NA\n"},
      {Control::okuma, "NA CALL OB Q9999\nGOTO NA\nM30\nOB\nRTS\n"},
      {Control::okuma, "NA G81\nG80\nNB IF [1 EQ 1] NA\n"},
      {Control::fanuc, "G66 P5 L9999\nN1 G0 X20.\nGOTO 1\nM30\nO5\nM99\n"},
      {Control::fanuc, "N1 GOTO 1\n"},
      {Control::fanuc, "WHILE [1 EQ 1] DO 1\nEND 1\n"},
      {Control::fanuc, "DO 1\nM98 P5 L9999\nEND 1\nM30\nO5\n"},
      {Control::fanuc,
       "N1 G71 P10 Q20 U1.\nGOTO 30\nN10\n" + contour + "N20\nN30 GOTO 1\n"},
      {Control::fanuc,
       "G0 X[" + deep + "1\n#" + std::string(5000, '#') + "1=1\nN1 GOTO1"},
      {Control::fanuc, "DO 1\nG74 R0.1\nG74 Z-200. Q1000 F0.1\nEND 1\n"}};
  for (const auto& h : hostile) {
    const auto begin = std::chrono::steady_clock::now();
    const auto p = read(h.control, "G97 S500 M3 F0.1\nG0 X20. Z5.\n" + h.text);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 5) << h.text.substr(0, 80);
    EXPECT_LE(p.unknown.size(), 200u);
    ASSERT_FALSE(p.unknown.empty()) << h.text.substr(0, 80);
    const auto& last = p.unknown.back();
    EXPECT_TRUE(last.what == "the rest of the program" ||
                last.what == "more of this kind" ||
                last.why.find("deep") != last.why.npos)
        << h.text.substr(0, 80) << last.what << last.why;
  }
}

TEST(ProgramFlow, CallsTenDeepAndNoDeeper) {
  const auto p = read(Control::fanuc, kStart + "M98 P5\nX9.\nM30\nO5\nM98 P5\nM99\n");
  ASSERT_FALSE(p.unknown.empty());
  EXPECT_NE(p.unknown[0].why.find("ten deep"), std::string::npos);
}

// The words of a subprogram stand in its own lines.
TEST(ProgramFlow, NamesTheLinesOfSubprograms) {
  const auto p = read(Control::fanuc, kStart + "M98 P5\nM30\nO5\nG1 X9. F0.2\nM99\n");
  EXPECT_EQ(p.runs.back().moves.back().line, 6u);
  EXPECT_EQ(p.runs.back().moves.back().words.F_line, 6u);
}

}  // namespace
}  // namespace turnwright::review
