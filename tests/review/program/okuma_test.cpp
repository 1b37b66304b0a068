// Okuma's programs: variables, branches, calls, LAP and G74, worked by hand.
#include <string>
#include <vector>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using Ends = std::vector<double>;

const std::string kOkuma = "G90 G95\nG97 S500 M3\nG0 X20 Z5 F0.1\n";

Ends okuma_ends(const std::string& text) {
  return diameters_after_start(Control::okuma, kOkuma + text);
}

std::vector<std::string> okuma_ways(const std::string& text) {
  return ways_after_start(Control::okuma, kOkuma + text);
}

TEST(OkumaExpressions, Reckon) {
  for (const auto& [text, value] : {std::pair{"V1=2+3*4\nG1 X=V1", 14.0},
                                    {"V1=3\nV[V1+1]=5\nG1 X=V4", 5.0},
                                    {"DIA=12 (LOCAL)\nG1 X=DIA-2*[1+1]", 8.0},
                                    {"VC7=4\nG1 X=VC7", 4.0},
                                    {"V1=30\nG1 X=SIN[V1]*8", 4.0},
                                    {"G1 X=SQRT[16]+ABS[-3]", 7.0},
                                    {"G1 X=MOD[7,4]", 3.0},
                                    {"G1 X=ATAN2[1,1]/15", 3.0},
                                    {"G1 X=ATAN[1]/9", 5.0},
                                    {"G1 X=FIX[-2.8]+6", 4.0},
                                    {"G1 X=FUP[-2.2]+6", 3.0},
                                    {"G1 X=ROUND[2.6]", 3.0},
                                    {"N10V2=6\nN20G1X=V2Z3", 6.0},
                                    {"NOEX V2=6\nG1 X=V2", 6.0},
                                    {"V5=-4\nG1 X=-V5", 4.0}}) {
    const auto p = read(Control::okuma, kOkuma + text);
    expect_understood(p);
    EXPECT_NEAR(2 * moves(p).back().x_mm, value, 1e-12) << text;
  }
}

// The name that the control writes before a program is no block of it.
TEST(OkumaFlow, BeginsBehindTheNameOfTheFile) {
  const auto p = read(Control::okuma, "$SHAFT.MIN%\r\nO0001\r\n" + kOkuma +
                                          "G1 Z-5\nM2\nO2\nG1 Z-9\nRTS");
  expect_understood(p);
  EXPECT_EQ(ways(p), (std::vector<std::string>{"G0 10 5", "G1 10 -5"}));
}

TEST(OkumaFlow, BranchesToNumbersAndNames) {
  EXPECT_EQ(okuma_ends("V1=1\nN5 IF [V1 GT 3] NEND\nG1 X=V1\nV1=V1+1\nGOTO N5\n"
                       "NEND X9"),
            (Ends{1, 2, 3, 9}));
  EXPECT_EQ(okuma_ends("AB=2\nIF[AB EQ 2]N0020\nG1 X1\nN20 G1 X2"), (Ends{2}));
  EXPECT_EQ(okuma_ends("IF [1 EQ 2] GOTO N20\nG1 X1\nN20 G1 X2"), (Ends{1, 2}));
  EXPECT_EQ(okuma_ends("IF [[1 LT 2] AND [3 GE 3]] N20\nG1 X1\nN20 G1 X2"), (Ends{2}));
  EXPECT_EQ(okuma_ends("IF [[1 LT 2] EOR [3 GE 3]] N20\nG1 X1\nN20 G1 X2"), (Ends{1, 2}));
}

TEST(OkumaPrograms, AreCalledWithTheirOwnVariables) {
  const std::string subs =
      "M30\nOGRV (GROOVE)\nG91 G1 X=-DEP\nG90\nDEP=DEP+1\nV9=DEP\nRTS\n"
      "O100\nG1 X7\nCALL OGRV DEP=1\nRTS\n";
  const auto ends = [&](const std::string& text) {
    return diameters_after_start(Control::okuma, "O1\n" + kOkuma + text + subs);
  };
  EXPECT_EQ(ends("DEP=50\nCALL OGRV DEP=2\nX=DEP\nX=V9\n"), (Ends{18, 50, 3}));
  EXPECT_EQ(ends("V2=3\nCALL OGRV Q2 DEP=V2*2\n"), (Ends{14, 8}));
  EXPECT_EQ(ends("CALL O0100\nX30\n"), (Ends{7, 6, 30}));
}

// A cylinder of 20 mm and a cone to 40 mm, from 44 mm by 8 mm of the diameter.
const std::string kLap = "G0 X44 Z2\nNLAP1 G81\nG0 X20\nG1 Z-10 F0.15\nX40 Z-20\nG80\n";

TEST(Lap, RoughsAtLevelsAndFinishes) {
  const auto w = okuma_ways(kLap + "G85 NLAP1 D8 U1 W0.1 F0.3\nG87 NLAP1\nG0 X60\n");
  const std::vector<std::string> expected{
      "G0 22 2",
      // Levels at 18 and 14 mm; the cone from (10.5, -9.9) to (20.5, -19.9).
      "G0 18 2", "G1 18 -17.4", "G1 18.5 -16.9", "G0 18.5 2", "G0 14 2", "G1 14 -13.4",
      "G1 14.5 -12.9", "G0 14.5 2", "G0 10.5 2", "G1 10.5 2.1", "G1 10.5 -9.9",
      "G1 20.5 -19.9", "G0 20.5 2", "G0 22 2",
      // The contour with its own feed, back along Z first.
      "G0 10 2", "G1 10 -10", "G1 20 -20", "G0 20 2", "G0 22 2", "G0 30 2"};
  EXPECT_EQ(w, expected);
  const auto p = read(Control::okuma, kOkuma + kLap + "G85 NLAP1 D8 F0.3\nG87 NLAP1\n");
  EXPECT_EQ(p.runs.back().step.f_mm_rev, 0.15);
}

// The contour is only defined where it stands, and M85 leaves the tool at its end.
TEST(Lap, DefinesBeforeAndStays) {
  EXPECT_EQ(okuma_ways(kLap + "G0 X60"),
            (std::vector<std::string>{"G0 22 2", "G0 30 2"}));
  const auto w = okuma_ways(kLap + "G85 NLAP1 D8 U1 F0.3 M85\n");
  EXPECT_EQ(w.back(), "G1 20.5 -20");
}

// Across: D and W are lengths along Z.
TEST(Lap, RoughsAcross) {
  EXPECT_EQ(
      okuma_ways("G0 X64 Z1\nN200 G82\nG0 Z-8\nG1 X20\nZ0\nG80\nG85 N200 D5 F0.3\n"),
      (std::vector<std::string>{"G0 32 1", "G0 32 -4", "G1 10 -4", "G1 10.5 -3.5",
                                "G0 32 -3.5", "G0 32 -8", "G1 32 -8", "G1 10 -8",
                                "G1 10 0", "G0 10 1", "G0 32 1"}));
}

// Xs = 44, Xa + U = 20, D = 12: the first pass is half of the way off along both axes, from
// Zs = 2 to Za + W = 0.
TEST(Lap, CopiesTheContour) {
  EXPECT_EQ(okuma_ways("G0 X44 Z2\nNLAP2 G81\nG1 X20 Z0\nZ-10\nX40\nG80\n"
                       "G86 NLAP2 D12 U0 W0 F0.3\n"),
            (std::vector<std::string>{"G0 22 2", "G1 16 1", "G1 16 -9", "G1 26 -9",
                                      "G0 26 2", "G1 10 0", "G1 10 -10", "G1 20 -10",
                                      "G0 20 2", "G0 22 2"}));
}

TEST(OkumaDrilling, PecksAlongTheAxis) {
  EXPECT_EQ(okuma_ways("X0\nG74 X0 Z-10 D15 F0.1\n"),
            (std::vector<std::string>{"G0 0 5", "G0 0 5", "G1 0 -10", "G0 0 5"}));
  EXPECT_EQ(okuma_ways("X0\nG74 Z-10 D6 F0.1\n"),
            (std::vector<std::string>{"G0 0 5", "G0 0 5", "G1 0 -1", "G0 0 -0.5",
                                      "G1 0 -7", "G0 0 -6.5", "G1 0 -10", "G0 0 5"}));
}

TEST(OkumaPrograms, TellWhatTheyDoNotKnow) {
  for (const char* text :
       {"G1 X=V7",          "G1 X=LEN", "V1=VETFZ",      "VETFZ=1",   "GOTO N99",
        "IF [V7 GT 1] N10", "CALL O77", "CALL O1 P2",    "MODIN O1",  "RTS",
        "G85 NLAP9 D4",     "G85 D4",   "NLAP1 G81",     "G88 NLAP1", "G1 X=3+",
        "G1 X=[3",          "V999=1",   "G74 X0 Z-9 L3", "FOO",       "G1 X=LN[2]"}) {
    const auto p = read(Control::okuma, kOkuma + text + "\nG1 Z-5\n");
    ASSERT_FALSE(p.unknown.empty()) << text;
    EXPECT_EQ(p.unknown[0].line, 4u) << text;
    EXPECT_FALSE(p.unknown[0].why.empty());
  }
  for (const char* text : {"NL G83\nG1 X50 Z0\nG81\nG0 X20\nG1 Z-9\nG80\nG85 NL D4",
                           "NL G81\nG0 X20\nCALL O1\nG1 Z-9\nG80\nG85 NL D4",
                           "NL G81\nG0 X20\nG1 Z-9\nX15\nG80\nG85 NL D4"})
    EXPECT_FALSE(read(Control::okuma, kOkuma + text).unknown.empty()) << text;
  // A definition that ends where it begins, in the first line.
  EXPECT_FALSE(read(Control::okuma, "NL G81 G80\nG0 X9 Z9\nG85 NL D4").unknown.empty());
}

}  // namespace
}  // namespace turnwright::review
