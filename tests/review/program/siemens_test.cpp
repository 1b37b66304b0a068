// Siemens' native programs: moves from the rules of the programming manuals, worked by hand.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using All = std::vector<double>;
using Ways = std::vector<std::string>;

const std::string kSiemens = "G18 G710 G90 G95 DIAMON\nG97 S500 M3\nG0 X20 Z5 F0.1\n";

/// The ends that X has after the start, as diameters.
All ends_of_x(const std::string& text) {
  return diameters_after_start(Control::siemens, kSiemens + text);
}

/// The moves after the start.
Ways made_of(const std::string& text) {
  return ways_after_start(Control::siemens, kSiemens + text);
}

TEST(SiemensExpressions, ReckonInTheirRanks) {
  for (const auto& [text, value] : {std::pair{"G1 X=2+3*4", 14.0},
                                    {"R1=7\nG1 X=R1", 7.0},
                                    {"R1=2\nR[R1+1]=6\nG1 X=R3", 6.0},
                                    {"R1=9 R2=4\nG1 X=R1-R2*2 Z=1", 1.0},
                                    {"G1 X=(2+3)*4 Z=-R9 R9=1", 20.0},
                                    {"G1 X=7 DIV 2", 3.0},
                                    {"G1 X=2+7 DIV 2", 5.0},
                                    {"G1 X=7 MOD 4", 3.0},
                                    {"G1 X=7/2", 3.5},
                                    {"G1 X=SQRT(16)+POT(2)", 8.0},
                                    {"G1 X=ATAN2(1,1)/15", 3.0},
                                    {"G1 X=SIN(30)*8", 4.0},
                                    {"G1 X=TRUNC(3.9)+ROUND(0.6)", 4.0},
                                    {"G1 X=MINVAL(5,3)", 3.0},
                                    {"G1 X=MAXVAL(5,3)", 5.0},
                                    {"G1 X=BOUND(0,4,9)", 4.0},
                                    {"G1 X=6 B_AND 3", 2.0},
                                    {"G1 X=6 B_OR 3", 7.0},
                                    {"G1 X=6 B_XOR 3", 5.0},
                                    {"G1 X=NOT 0", 1.0},
                                    {"G1 X=1 OR 0 AND 0", 1.0},
                                    {"G1 X=5EX-1*4", 2.0},
                                    {"G1 X=(1==1)+(2<>1)+(2>=2)+(1<2)", 4.0},
                                    {"G1 X=TRUE+2", 3.0},
                                    {"G1X=AC(4)", 4.0},
                                    {"G1 X=IC(-6)", 14.0},
                                    {"G91 G1 X=AC(4)", 4.0},
                                    {"R5=-3\nG1 X=-R5", 3.0},
                                    {"DEF REAL AA=2.5, BB\nBB=AA*2\nG1 X=BB", 5.0},
                                    {"DEF INT NO\nNO=2.6\nG1 X=NO", 3.0},
                                    {"DEF REAL AA[3]\nAA[1]=8\nG1 X=AA[0]+AA[1]", 8.0},
                                    {"DEF STRING[20] NAME=\"A, B\"\nG1 X=6", 6.0},
                                    {"DEF STRING[20] NAME, OTHER\nG1 X=6", 6.0}}) {
    const std::string program = text;
    const auto p = read(Control::siemens, kSiemens + program);
    if (program.find("R9") == std::string::npos) expect_understood(p);
    if (!p.unknown.empty()) continue;
    EXPECT_NEAR(2 * moves(p).back().x_mm, value, 1e-12) << text;
  }
}

TEST(SiemensFlow, Branches) {
  EXPECT_EQ(ends_of_x("R1=3\nIF R1>2\nG1 X1\nELSE\nG1 X2\nENDIF\nX3"), (All{1, 3}));
  EXPECT_EQ(ends_of_x("R1=3\nIF R1<2\nG1 X1\nELSE\nG1 X2\nENDIF\nX3"), (All{2, 3}));
  EXPECT_EQ(ends_of_x("R1=3\nIF R1<2\nIF R1>0\nG1 X1\nENDIF\nENDIF\nG1 X3"), (All{3}));
  EXPECT_EQ(ends_of_x("R1=1\nIF (R1==1) AND (R1<2) GOTOF NEXT\nG1 X1\nNEXT: G1 X2"),
            (All{2}));
  EXPECT_EQ(ends_of_x("R1=0\nN5 BACK: R1=R1+1\nG1 X=R1\nIF R1<3 GOTOB BACK\nX9"),
            (All{1, 2, 3, 9}));
  EXPECT_EQ(ends_of_x("GOTO N30\nG1 X1\nN30 G1 X2"), (All{2}));
}

TEST(SiemensFlow, Repeats) {
  EXPECT_EQ(ends_of_x("R1=0\nWHILE R1<3\nR1=R1+1\nG1 X=R1\nENDWHILE"), (All{1, 2, 3}));
  EXPECT_EQ(ends_of_x("FOR R1 = 4 TO 6\nG1 X=R1\nENDFOR\nX9"), (All{4, 5, 6, 9}));
  EXPECT_EQ(ends_of_x("FOR R1 = 4 TO 3\nG1 X=R1\nENDFOR\nG1 X9"), (All{9}));
  EXPECT_EQ(ends_of_x("DEF INT NO\nFOR NO=1 TO 2\nG1 X=NO\nENDFOR"), (All{1, 2}));
  EXPECT_EQ(ends_of_x("R1=0\nREPEAT\nR1=R1+1\nG1 X=R1\nUNTIL R1>=3"), (All{1, 2, 3}));
  EXPECT_EQ(ends_of_x("R1=0\nLOOP\nR1=R1+1\nG1 X=R1\nIF R1==2 GOTOF OUT\nENDLOOP\n"
                      "OUT: X9"),
            (All{1, 2, 9}));
  // The section once by itself, then twice more; then between two labels; then one block.
  EXPECT_EQ(ends_of_x("A: G1 X=IC(-1)\nX=IC(-2)\nREPEAT A P=2"),
            (All{19, 17, 16, 14, 13, 11}));
  EXPECT_EQ(ends_of_x("A: G1 X=IC(-1)\nX=IC(-2)\nB: X=IC(-3)\nG0 X50\nREPEAT A B"),
            (All{19, 17, 14, 50, 49, 47, 44}));
  EXPECT_EQ(ends_of_x("A: G1 X=IC(-1)\nX=IC(-2)\nREPEATB A P3\nX1"),
            (All{19, 17, 16, 15, 14, 1}));
  EXPECT_EQ(ends_of_x("A: G1 X=IC(-1)\nENDLABEL:\nX=IC(-2)\nREPEAT A P=1"),
            (All{19, 17, 16}));
}

TEST(SiemensPrograms, AreCalled) {
  const std::string main = "%_N_SHAFT_MPF\n;$PATH=/_N_WKS_DIR\n";
  const auto ends = [&](const std::string& text, const std::string& subs) {
    return diameters_after_start(Control::siemens,
                                 main + kSiemens + text + "\nM30\n" + subs);
  };
  EXPECT_EQ(ends("GROOVE\nG0 X30", "%_N_GROOVE_SPF\nG1 X=IC(-2)\nM17\n"), (All{18, 30}));
  EXPECT_EQ(ends("L100 P3", "%_N_L100_SPF\nG1 X=IC(-2)\nRET\nX99\n"), (All{18, 16, 14}));
  EXPECT_EQ(ends("CALL \"GROOVE\"", "%_N_GROOVE_SPF\nG1 X=IC(-2)\nM2\n"), (All{18}));
  // Values of a call, those that it leaves out, and variables of its own.
  EXPECT_EQ(ends("R1=3\nCUT(12.5,,R1*2) P2\nG1 X=R2",
                 "%_N_CUT_SPF\nPROC CUT(REAL DIA, INT NO=4, REAL END) SAVE\nG1 "
                 "X=DIA\nX=NO\nX=END\n"
                 "DIA=1\nR2=END+DIA\nM17\n"),
            (All{12.5, 4, 6, 12.5, 4, 6, 7}));
  EXPECT_EQ(ends("A\nG1 X50", "PROC A\nG1 X5\nB\nX6\nRET\nPROC B\nX7\nRET\n"),
            (All{5, 7, 6, 50}));
}

// A chamfer of 2 mm on each leg; one of 2 mm across; a rounding of 2 mm at a right angle.
TEST(SiemensCorners, AreBrokenAndRounded) {
  EXPECT_EQ(made_of("G1 X30 Z0 CHR=2\nZ-20\n")[0], "G1 13.5858 1.41421");
  EXPECT_EQ(made_of("G1 Z0\nX30 CHR=2\nZ-20\n"),
            (Ways{"G1 10 0", "G1 13 0", "G1 15 -2", "G1 15 -20"}));
  EXPECT_EQ(made_of("G1 Z0\nX30 CHF=2\nZ-20\n"),
            (Ways{"G1 10 0", "G1 13.5858 0", "G1 15 -1.41421", "G1 15 -20"}));
  const auto p = read(Control::siemens, kSiemens + "G1 Z0\nX30 RND=2\nZ-20 RND=3\nX50");
  expect_understood(p);
  EXPECT_EQ(ways(p)[3], "G3 15 -2");
  EXPECT_NEAR(moves(p)[3].centre.h_mm, 13, 1e-9);
  EXPECT_NEAR(moves(p)[3].centre.z_mm, -2, 1e-9);
  EXPECT_EQ(ways(p)[5], "G2 18 -20");
  EXPECT_NEAR(moves(p)[5].centre.h_mm, 18, 1e-9);
  EXPECT_NEAR(moves(p)[5].centre.z_mm, -17, 1e-9);
  // Longer than the leg.
  EXPECT_EQ(read(Control::siemens, kSiemens + "G1 Z0\nX24 CHR=2\nZ-20").unknown.size(),
            1u);
}

// Over the contour of 20, a cone to 30 and 40 mm: passes of (20 - 10)/4 = 2.5 mm.
const std::string kContour =
    "M30\n%_N_KONTUR_SPF\nG1 X20 Z0\nZ-10\nX30 Z-20\nZ-30\nX40\nM17\n";

TEST(StockRemoval, RoughsInEqualDepthsWithoutCorners) {
  EXPECT_EQ(made_of("CYCLE95(\"KONTUR\",3,0,0,,0.3,,0.1,1,,,1)\nG0 X60\n" + kContour),
            (Ways{"G0 21 1",
                  // 17.5 mm meets the wall at -30 and follows it out.
                  "G0 17.5 1", "G1 17.5 -30", "G1 20 -30", "G0 21 -29", "G0 21 1",
                  // 15 mm is the cylinder.
                  "G0 15 1", "G1 15 -20", "G1 15 -30", "G1 17.5 -30", "G0 18.5 -29",
                  "G0 18.5 1",
                  // 12.5 mm meets the cone half way.
                  "G0 12.5 1", "G1 12.5 -15", "G1 15 -20", "G0 16 -19", "G0 16 1",
                  "G0 10 1", "G1 10 0", "G1 10 -10", "G1 12.5 -15", "G0 13.5 -14",
                  "G0 13.5 1", "G0 21 1", "G0 21 1", "G0 30 1"}));
}

TEST(StockRemoval, LeavesWhatItIsTold) {
  const auto w = made_of("CYCLE95(\"KONTUR\",10,0.2,0.5,,0.3,,0.1,201)\n" + kContour);
  // One pass of 10 mm at 10.5 mm, which the cylinder of 10 mm with its allowance is; no corners.
  EXPECT_EQ(w, (Ways{"G0 21.5 1.2", "G0 10.5 1.2", "G1 10.5 0.2", "G0 11.5 1.2",
                     "G0 11.5 1.2", "G0 21.5 1.2", "G0 21.5 1.2"}));
  // Normal to the contour: at the cone of 45 deg the corner moves by 0.4 tan(22.5 deg).
  const auto n = made_of("CYCLE95(\"KONTUR\",10,,,0.4,0.3,,0.1,1)\n" + kContour);
  EXPECT_EQ(n[2], "G1 10.4 0");
  const double d = 0.4 * std::tan(std::atan(0.5) / 2);
  char corner[40];
  std::snprintf(corner, sizeof corner, "G1 10.4 %.6g", -10 + d);
  EXPECT_EQ(n[3], corner);
}

TEST(StockRemoval, FinishesBesideTheNose) {
  const auto p = read(Control::siemens,
                      kSiemens + "CYCLE95(\"KONTUR\",3,0,0,,0.3,,0.15,9)\n" + kContour);
  expect_understood(p);
  bool contour = false;
  for (const auto& run : p.runs)
    for (const auto& m : run.moves)
      if (m.nose.side != NoseSide::none) {
        contour = true;
        EXPECT_EQ(m.nose.side, NoseSide::right);
        EXPECT_EQ(run.step.f_mm_rev, 0.15);
      }
  EXPECT_TRUE(contour);
  const auto only = made_of("CYCLE95(\"KONTUR\",,,,,,,0.1,5)\n" + kContour);
  EXPECT_EQ(only, (Ways{"G0 21 1", "G0 10 1", "G1 10 0", "G1 10 -10", "G1 15 -20",
                        "G1 15 -30", "G1 20 -30", "G0 21 -30", "G0 21 1"}));
}

// In a bore from 40 to 20 mm, and a face from the outside inwards, between labels.
TEST(StockRemoval, GoesInsideAndAcross) {
  const auto bore = made_of(
      "CYCLE95(\"BORE\",5,0,0,,0.3,,,3)\nM30\nPROC BORE\nG1 X40 Z0\nZ-10\nX20\nRET\n");
  EXPECT_EQ(bore, (Ways{"G0 9 1", "G0 15 1", "G1 15 -10", "G1 10 -10", "G0 9 -9",
                        "G0 9 1", "G0 20 1", "G1 20 0", "G1 20 -10", "G1 15 -10",
                        "G0 14 -9", "G0 14 1", "G0 9 1", "G0 9 1"}));
  const auto face = made_of(
      "CYCLE95(\"A:B\",4,0,0,,0.3,,,2)\nGOTOF OUT\nA: G1 X60 Z-8\nX20\nB: Z0\nOUT: "
      "G0 X80");
  EXPECT_EQ(face, (Ways{"G0 31 1", "G0 31 -4", "G1 10 -4", "G1 10 0", "G0 11 1",
                        "G0 31 1", "G0 31 -8", "G1 30 -8", "G1 10 -8", "G1 10 -4",
                        "G0 11 -3", "G0 31 -3", "G0 31 1", "G0 31 1", "G0 40 1"}));
}

TEST(StockRemoval, TellsWhatItCannotFollow) {
  for (const char* text :
       {"CYCLE95(\"NONE\",3,0,0,,0.3,,,1)\n", "CYCLE95(\"KONTUR\",0,0,0,,0.3,,,1)\n",
        "CYCLE95(\"KONTUR\",0.01,0,0,,0.3,,,1)\n",
        "CYCLE95(\"KONTUR\",3,0,0,,0.3,,,13)\n", "CYCLE95(\"KONTUR\",3,0,0,,0.3,,,3)\n",
        "CYCLE95(\"KONTUR\",3,R7,0,,0.3,,,1)\n",
        "CYCLE95(\"BACK\",3,0,0,,0.3,,,1)\nM30\nPROC BACK\nG1 X20 "
        "Z0\nZ-9\nX15\nX30\nRET\n"}) {
    const auto p = read(Control::siemens, kSiemens + text + kContour);
    ASSERT_FALSE(p.unknown.empty()) << text;
    EXPECT_EQ(p.unknown[0].line, 4u) << text;
  }
}

/// Radii at which a thread is cut.
All radii_of_threads(const TurningProgram& p) {
  All all;
  for (const auto& m : moves(p))
    if (m.kind == Move::Kind::thread) all.push_back(m.x_mm);
  return all;
}

// M20 x 1.5, 0.9 mm deep, 0.1 mm of it the last cut; from 3 mm before to 2 mm behind.
TEST(SiemensThreads, HaveEqualSectionsOrDepths) {
  const auto p = read(Control::siemens,
                      kSiemens + "CYCLE97(1.5,,0,-20,20,20,3,2,0.9,0.1,0,0,4,1,3,1,2)");
  expect_understood(p);
  const All radii{
      10 - 0.4, 10 - 0.8 * std::sqrt(0.5), 10 - 0.8 * std::sqrt(0.75), 10 - 0.8, 10 - 0.9,
      10 - 0.9};
  ASSERT_EQ(radii_of_threads(p).size(), radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    EXPECT_NEAR(radii_of_threads(p)[i], radii[i], 1e-12);
  EXPECT_EQ(p.runs.back().step.f_mm_rev, 1.5);
  const auto w = ways(p);
  EXPECT_EQ(w[1], "G0 12 3");
  EXPECT_EQ(w[2], "G0 9.6 3");
  EXPECT_EQ(w[3], "G33 9.6 -22");
  EXPECT_EQ(w[4], "G0 12 -22");
  EXPECT_EQ(w.back(), "G0 12 3");
  const auto equal = read(Control::siemens,
                          kSiemens + "CYCLE97(1.5,,0,-20,20,20,3,2,0.9,0,0,0,3,0,2,1)");
  const All inner{10.3, 10.6, 10.9};
  ASSERT_EQ(radii_of_threads(equal).size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(radii_of_threads(equal)[i], inner[i], 1e-12);
  EXPECT_EQ(ways(equal)[1], "G0 9 3");
  EXPECT_FALSE(read(Control::siemens, kSiemens + "CYCLE97(1.5,,0,-20,20,20,3,2,0.9,0,0,0,"
                                                 "999999,-999999,3,1)")
                   .unknown.empty());
  // A tapered one: 1 mm on the radius over 20 mm, and so beyond both ends.
  const auto taper = read(Control::siemens,
                          kSiemens + "CYCLE97(1.5,,0,-20,20,22,2,0,0.5,0,0,0,1,0,1,1)");
  EXPECT_EQ(ways(taper)[2], "G0 9.4 2");
  EXPECT_EQ(ways(taper)[3], "G33 10.5 -20");
}

double waits_s(const TurningProgram& p) {
  double min = 0;
  for (const auto& run : p.runs) min += run.wait_min;
  return 60 * min;
}

TEST(SiemensDrilling, DrillsOnTheAxis) {
  EXPECT_EQ(made_of("G17 X0\nCYCLE81(5,0,2,-20)\nG18"),
            (Ways{"G0 0 5", "G0 0 2", "G1 0 -20", "G0 0 5"}));
  EXPECT_EQ(made_of("X0\nCYCLE82(5,1,2,,20,0.5)"),
            (Ways{"G0 0 5", "G0 0 3", "G1 0 -19", "G0 0 5"}));
  EXPECT_NEAR(waits_s(read(Control::siemens, kSiemens + "X0\nCYCLE82(5,1,2,,20,0.5)")),
              0.5, 1e-12);
  EXPECT_EQ(made_of("X0\nCYCLE85(5,0,2,-20,,,0.2,0.4)"),
            (Ways{"G0 0 5", "G0 0 2", "G1 0 -20", "G1 0 2", "G0 0 5"}));
  EXPECT_EQ(
      made_of("X0\nCYCLE84(5,0,2,-20,,0,3,,1.5,0,300,300)"),
      (Ways{"G0 0 5", "G0 0 2", "G0 0 2", "G33 0 -20", "G33 0 2", "G0 0 2", "G0 0 5"}));
  EXPECT_EQ(made_of("X0\nCYCLE840(5,0,2,-20,,0,4,3,0,,1.5)"),
            made_of("X0\nCYCLE84(5,0,2,-20,,0,3,,1.5,0,300,300)"));
}

// 2 mm before the surface: 12 mm, then 4 less each time, 3 at least.
TEST(SiemensDrilling, ClearsChips) {
  EXPECT_EQ(
      made_of("X0\nCYCLE83(5,0,2,-25,,-10,,4,0,0,1,1,,3,,,0.5)"),
      (Ways{"G0 0 5", "G0 0 2", "G1 0 -10", "G0 0 2", "G0 0 -9.5", "G1 0 -18", "G0 0 2",
            "G0 0 -17.5", "G1 0 -22", "G0 0 2", "G0 0 -21.5", "G1 0 -25", "G0 0 5"}));
  EXPECT_EQ(made_of("X0\nCYCLE83(5,0,2,-20,,-10,,-0.5,0,0,1,0,,4,0.8)"),
            (Ways{"G0 0 5", "G0 0 2", "G1 0 -10", "G0 0 -9.2", "G1 0 -16", "G0 0 -15.2",
                  "G1 0 -20", "G0 0 5"}));
  const auto p =
      read(Control::siemens, kSiemens + "X0\nCYCLE83(5,0,2,-20,,-10,,,1,2,0.5,1)");
  EXPECT_NEAR(waits_s(p), 1 + 1 + 2, 1e-12);
  EXPECT_EQ(p.runs[1].step.f_mm_rev, 0.05);
  EXPECT_FALSE(read(Control::siemens, kSiemens + "CYCLE81(5,0,2,-20)").unknown.empty());
  EXPECT_FALSE(
      read(Control::siemens, kSiemens + "X0\nCYCLE83(5,0,2,-20,,-1,,-0.5,0,0,1,1)")
          .unknown.empty());
}

// What was read as a feed or a way before: G4 waits.
TEST(Dwells, WaitAndMoveNothing) {
  for (const auto& [control, text] :
       {std::pair{Control::siemens, "G4 F2\n"},
        {Control::siemens, "G4 S1000\n"},  // turns, at 500 1/min 120 s
        {Control::fanuc, "G4 X2.\n"},
        {Control::fanuc, "G4 U2.\n"},
        {Control::fanuc, "G4 P2000\n"},
        {Control::linuxcnc, "G4 P2\n"},
        {Control::okuma, "G4 F2\n"}}) {
    const auto p =
        read(control, "G97 S500 M3 F0.1\nG0 X20. Z5.\n" + std::string(text) + "G1 Z1.\n");
    expect_understood(p);
    EXPECT_EQ(moves(p).size(), 2u);
    EXPECT_NEAR(waits_s(p), std::string(text).find('S') != std::string::npos ? 120 : 2,
                1e-9)
        << text;
    EXPECT_NEAR(p.runs.back().step.f_mm_rev,
                control == Control::linuxcnc ? 0.1 / 500 : 0.1, 1e-12)
        << text;
  }
}

TEST(SiemensPrograms, TellWhatTheyDoNotKnow) {
  for (
      const char* text :
      {"G1 X=R7", "R1=$AA_IW[X]", "G1 X=UNKNOWN", "GOTOF NOWHERE",   "IF R7>1 GOTOF A",
       "FOO",     "FOO(1)",       "L77",          "CALL FOO",        "REPEAT NOWHERE P=2",
       "WHILE 1", "ENDWHILE",     "TRANS Z=5",    "DEF REAL 5",      "G1 X=3+",
       "G1 X=(3", "FOR R1 = 1",   "CYCLE99(1)",   "CYCLE81(5,0",     "G1 X30 FOO=3",
       "RET",     "DIV=3",        "X=7.5 DIV 2",  "MCALL CYCLE81(1)"}) {
    const auto p = read(Control::siemens, kSiemens + text + "\nG1 Z-5\n");
    ASSERT_FALSE(p.unknown.empty()) << text;
    EXPECT_EQ(p.unknown[0].line, 4u) << text;
    EXPECT_FALSE(p.unknown[0].why.empty());
  }
}

}  // namespace
}  // namespace turnwright::review
