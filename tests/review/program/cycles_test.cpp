// Cycles of Fanuc's system A as the plain moves of its manual's figures.
#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;
using Ways = std::vector<std::string>;

Ways cut(Control control, const std::string& text) {
  const auto p = read(control, "G99 G97 S500 M3\n" + text);
  expect_understood(p);
  return ways(p);
}

// A face of a disc: from 60 to 20 mm, a cone of 5 mm along the axis, roughed by 2 mm.
const std::string kFace = "N10 G0 Z-8.\nG1 X40. F0.1\nX20. Z-3.\nN20 Z0.\nG0 X80. Z9.\n";

TEST(FacingCycle, RoughsAlongX) {
  const Ways expected{
      "G0 31 2",
      // Level 0: along X to where the contour with its allowance is so far right.
      "G0 31 0", "G1 10.5 0", "G1 11 0.5", "G0 31 0.5", "G0 31 -2", "G1 10.5 -2",
      "G1 11 -1.5", "G0 31 -1.5",
      // -4 lies on the cone from (20, -7.8) to (10, -2.8): 2.4 behind its left end.
      "G0 31 -4", "G1 12.9 -4", "G1 13.4 -3.5", "G0 31 -3.5", "G0 31 -6", "G1 16.9 -6",
      "G1 17.4 -5.5", "G0 31 -5.5", "G0 31 -7.8", "G1 31.5 -7.8", "G1 20.5 -7.8",
      "G1 10.5 -2.8", "G1 10.5 0.2", "G0 10.5 2", "G0 31 2", "G0 40 9"};
  EXPECT_EQ(cut(Control::fanuc,
                "G0 X62. Z2.\nG72 W2. R0.5\nG72 P10 Q20 U1. W0.2 F0.3\n" + kFace),
            expected);
}

// One block is two: D is the depth, of Fanuc in steps where it has no point.
TEST(ContourCycles, HaveOneBlockOrTwo) {
  const std::string contour = "N10 G0 X20.\nG1 Z-10.\nN20 X40. Z-15.\n";
  const auto with = [&](Control control, const std::string& blocks) {
    return cut(control, "G0 X44. Z2.\n" + blocks + contour);
  };
  for (const auto control : {Control::fanuc, Control::haas}) {
    const auto two = with(control, "G71 U3. R0.\nG71 P10 Q20 U0.4 W0.1 F0.2\n");
    EXPECT_EQ(with(control, "G71 P10 Q20 U0.4 W0.1 D3. F0.2\n"), two);
    EXPECT_GT(two.size(), 12u);
  }
  EXPECT_EQ(with(Control::fanuc, "G71 P10 Q20 U0.4 W0.1 D3000 F0.2\n"),
            with(Control::fanuc, "G71 P10 Q20 U0.4 W0.1 D3. F0.2\n"));
  EXPECT_EQ(with(Control::haas, "G71 P10 Q20 U0.4 W0.1 D3 F0.2\n"),
            with(Control::haas, "G71 P10 Q20 U0.4 W0.1 D3. F0.2\n"));
  EXPECT_EQ(with(Control::fanuc, "G73 U2. W1. R3\nG73 P10 Q20 U0.4 W0.1 F0.2\n"),
            with(Control::haas, "G73 P10 Q20 I2. K1. D3 U0.4 W0.1 F0.2\n"));
}

// The contour's passes: 2 and 1 mm beside its last, then 1 and 0.5 mm, then none.
TEST(PatternCycle, ShiftsTheContour) {
  const Ways expected{"G0 15 2",       "G0 17 3",     "G0 12.5 3",   "G1 12.5 3",
                      "G1 12.5 -9",    "G2 17.5 -14", "G0 17 -14",   "G0 17 3",
                      "G0 16 2.5",     "G0 11.5 2.5", "G1 11.5 2.5", "G1 11.5 -9.5",
                      "G2 16.5 -14.5", "G0 16 -14.5", "G0 16 2.5",   "G0 15 2",
                      "G0 10.5 2",     "G1 10.5 2",   "G1 10.5 -10", "G2 15.5 -15",
                      "G0 15 -15",     "G0 15 2",     "G0 50 9"};
  const auto p = read(Control::fanuc,
                      "G99 G97 S500 M3\nG0 X30. Z2.\nG73 U2. W1. R3\n"
                      "G73 P10 Q20 U1. F0.2\nN10 G0 X20.\nG1 Z-10.\n"
                      "N20 G2 X30. Z-15. R5.\nG0 X100. Z9.");
  expect_understood(p);
  EXPECT_EQ(ways(p), expected);
  // The centre goes with the contour: (15, -10), 0.5 mm outside, shifted.
  for (const auto& m : moves(p))
    if (m.kind == Move::Kind::arc) {
      EXPECT_NEAR(m.centre.h_mm - m.x_mm, 0, 1e-9);
      EXPECT_NEAR(m.centre.z_mm - m.z_mm, 5, 1e-9);
    }
}

TEST(PeckCycles, PeckAlongZ) {
  const Ways expected{"G0 10 2",    "G0 10 2",  "G1 10 -1",  "G0 10 -0.5", "G1 10 -4",
                      "G0 10 -3.5", "G1 10 -5", "G0 10 2",   "G0 8 2",     "G1 8 -1",
                      "G0 8 -0.5",  "G1 8 -4",  "G0 8 -3.5", "G1 8 -5",    "G0 8 2",
                      "G0 7 2",     "G1 7 -1",  "G0 7 -0.5", "G1 7 -4",    "G0 7 -3.5",
                      "G1 7 -5",    "G0 7 2",   "G0 10 2"};
  for (const char* blocks :
       {"G74 R0.5\nG74 X14. Z-5. P2000 Q3000 F0.1",
        "G74 R0.5\nG74 U-6. W-7. I2. K3. F0.1", "G74 R0.5\nG74 X14. Z-5. P2. Q3. F0.1"})
    EXPECT_EQ(cut(Control::fanuc, std::string("G0 X20. Z2.\n") + blocks), expected)
        << blocks;
  // A hole on the axis.
  EXPECT_EQ(
      cut(Control::fanuc, "G0 X0. Z1.\nG74 R1.\nG74 Z-5. Q4000 F0.1"),
      (Ways{"G0 0 1", "G0 0 1", "G1 0 -3", "G0 0 -2", "G1 0 -5", "G0 0 1", "G0 0 1"}));
}

TEST(PeckCycles, PeckAlongX) {
  EXPECT_EQ(cut(Control::fanuc,
                "G0 X32. Z-10.\nG75 R0.5\nG75 X20. Z-13. P4000 Q3000 R0.2 F0.1"),
            (Ways{"G0 16 -10", "G0 16 -10", "G1 12 -10", "G0 12.5 -10", "G1 10 -10",
                  "G0 10 -9.8", "G0 16 -9.8", "G0 16 -13", "G1 12 -13", "G0 12.5 -13",
                  "G1 10 -13", "G0 10 -12.8", "G0 16 -12.8", "G0 16 -10"}));
}

// 5 mm before the face, to 2 mm before it and to 20 mm in three strokes.
TEST(DrillingCycles, GoInStrokesOnTheAxis) {
  const Ways strokes{"G0 0 5",    "G0 0 2",   "G1 0 -7", "G0 0 2",
                     "G0 0 -6.5", "G1 0 -16", "G0 0 2",  "G0 0 -15.5",
                     "G1 0 -20",  "G0 0 5",   "G0 10 5"};
  for (const auto& [control, block] :
       {std::pair{Control::fanuc, "G83 Z-20. R-3. Q9000 F0.1"},
        {Control::fanuc, "G83 Z-20. R-3. Q9. F0.1"},
        {Control::fanuc, "G83 W-25. R-3. Q9000 F0.1"},
        {Control::fanuc_b, "G98 G83 Z-20. R-3. Q9000 F0.1"},
        {Control::siemens_iso, "G98 G83 Z-20. R-3. Q9000 F0.1"},
        {Control::haas, "G83 Z-20. R2. Q9. F0.1"},
        {Control::haas, "G83 Z-20. R2. I9. J0. K9. F0.1"}}) {
    const std::string start = "G0 X0. Z5.\n" + std::string(block) + "\nG80\nX20.";
    EXPECT_EQ(cut(control, start), strokes) << block;
  }
  // 9, 6 and 5 mm, which is the least, and what is left.
  EXPECT_EQ(cut(Control::haas, "G0 X0. Z2.\nG83 Z-20. R2. I9. J3. K5. F0.1\nG80")[5],
            "G1 0 -13");
  EXPECT_EQ(cut(Control::haas, "G0 X0. Z2.\nG81 Z-8. F0.1\nZ-9.\nG80\nX20."),
            (Ways{"G0 0 2", "G0 0 2", "G1 0 -8", "G0 0 2", "G0 0 2", "G1 0 -9", "G0 0 2",
                  "G0 10 2"}));
  EXPECT_EQ(cut(Control::fanuc_b, "G0 X0. Z5.\nG99 G85 Z-8. R-3. F0.1\nG80"),
            (Ways{"G0 0 5", "G0 0 2", "G1 0 -8", "G1 0 2", "G0 0 2"}));
}

TEST(DrillingCycles, AreRepeated) {
  for (const auto& [control, block] : {std::pair{Control::haas, "G81 Z-8. R2. L2 F0.1"},
                                       {Control::fanuc, "G83 Z-8. R-3. K2 F0.1"}})
    EXPECT_EQ(
        cut(control, "G0 X0. Z5.\n" + std::string(block) + "\nG80"),
        (Ways{"G0 0 5", "G0 0 2", "G1 0 -8", "G0 0 5", "G0 0 2", "G1 0 -8", "G0 0 5"}))
        << block;
}

TEST(DrillingCycles, WaitAtTheBottom) {
  for (const auto& [control, block] : {std::pair{Control::haas, "G82 Z-8. R2. P0.5"},
                                       {Control::fanuc, "G83 Z-8. R-3. P500"},
                                       {Control::fanuc, "G85 Z-8. R-3. P500"}}) {
    const auto p = read(
        control, "G99 G97 S500 M3 F0.1\nG0 X0. Z5.\n" + std::string(block) + "\nG80\n");
    expect_understood(p);
    EXPECT_NEAR(60 * p.runs.back().wait_min, 0.5, 1e-12) << block;
  }
}

TEST(DrillingCycles, TellWhatTheyCannotFollow) {
  for (const auto& [control, block] :
       {std::pair{Control::haas, "G0 X10. Z5.\nG81 Z-8. R2."},
        {Control::haas, "G0 X0. Z5.\nG83 Z-8. R2. Q0."},
        {Control::haas, "G0 X0. Z5.\nG83 Z-90. R2. I1. J0.2"},
        {Control::linuxcnc, "G0 X0 Z5\nG81 Z-8 R2"},
        {Control::linuxcnc, "G17 G0 X0 Z5\nG91 G81 Z-8 R2"},
        {Control::fanuc, "G83 Z-8. R-3."}})
    EXPECT_FALSE(read(control, "G97 S500 M3 F0.1\n" + std::string(block) + "\nG80\n")
                     .unknown.empty())
        << block;
}

TEST(PeckCycles, AreBounded) {
  for (const char* text : {"G0 X20. Z2.\nG74 R0.1\nG74 Z-500. Q1 F0.1\n",
                           "G0 X20. Z2.\nG75 R0.1\nG75 X10. Z-90. P1000 Q1 F0.1\n",
                           "G0 X20. Z2.\nG75 X20. F0.1\n", "G75 X20. Z1. F0.1\n"}) {
    const auto p = read(Control::fanuc, std::string("G99 G97 S500 M3\n") + text);
    EXPECT_EQ(p.unknown.size(), 1u) << text;
  }
}

// Roughing in a bore, and towards the free end.
TEST(ContourCycles, GoAnyWay) {
  const auto bore = cut(Control::fanuc,
                        "G0 X20. Z2.\nG71 U2. R0.5\nG71 P10 Q20 U-1. F0.2\n"
                        "N10 G0 X30.\nG1 Z-10.\nN20 X24. Z-20.\n");
  EXPECT_EQ(bore[1], "G0 12 2");
  EXPECT_EQ(bore[2], "G1 12 -18.3333");  // 11.5 mm at -20, 14.5 mm at -10
  EXPECT_EQ(bore[3], "G1 11.5 -17.8333");
  const auto back = cut(Control::fanuc,
                        "G0 X40. Z-30.\nG71 U4. R0.5\nG71 P10 Q20 U0. F0.2\n"
                        "N10 G0 X30.\nG1 Z-10.\nN20 X40. Z0.\n");
  EXPECT_EQ(back[1], "G0 16 -30");
  EXPECT_EQ(back[2], "G1 16 -8");
  EXPECT_EQ(back[3], "G1 16.5 -8.5");
}

// A contour of variables, behind which the program goes on.
TEST(ContourCycles, HaveVariables) {
  const auto p = cut(Control::fanuc,
                     "#1=20.\nG0 X[#1+4.] Z2.\nG70 P10 Q20\nG0 X100.\nM30\n"
                     "N10 G0 X#1\nN20 G1 Z-[#1/2] F0.1\n");
  EXPECT_EQ(p,
            (Ways{"G0 12 2", "G0 10 2", "G1 10 -10", "G0 12 -10", "G0 12 2", "G0 50 2"}));
}

TEST(ContourCycles, TellWhatTheyCannotFollow) {
  for (const char* contour : {"N10 G0 X20.\nM98 P5\nN20 G1 Z-9.\n",
                              "N10 G0 X20.\nIF [1 EQ 1] GOTO 20\nN20 G1 Z-9."}) {
    const auto p = read(Control::fanuc,
                        std::string("G99 G97 S500 M3\nG0 X24. Z2. F0.1\nG70 P10 Q20\n") +
                            contour + "\nM30\nO5\nM99\n");
    EXPECT_FALSE(p.unknown.empty()) << contour;
  }
}

}  // namespace
}  // namespace turnwright::review
