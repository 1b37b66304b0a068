// Driven tools: their time and the place behind them.
#include <cmath>
#include <string>

#include "moves_of.hpp"

namespace turnwright::review {
namespace {

using namespace test;

/// Feed of driven tools in minutes, by the straight ways in space, and waits.
double driven_min(const TurningProgram& p) {
  double min = 0;
  for (const auto& run : p.runs) {
    min += run.wait_min;
    if (!run.step.milling) continue;
    for (const auto& m : run.moves)
      if (m.to.kind == Move::Kind::feed && m.from)
        min += std::hypot(m.to.x_mm - m.from->h_mm, m.to.z_mm - m.from->z_mm,
                          m.to.y_mm - m.from_y_mm) /
               run.step.milling->f_mm_min;
  }
  return min;
}

struct Driven {
  Control control;
  std::string text;
  double min;  ///< of the tool's feed
  double x_mm, z_mm;
};

// Feed of 100 mm/min, or 0.1 mm at 1000 1/min.
TEST(Milling, TakesTimeAndKeepsThePlace) {
  const double quarter = std::asin(std::sqrt(0.5)) * 2;
  const Driven driven[] = {
      {Control::fanuc, "G98 G0 C0.\nX30.\nG1 X20. F100.\nZ-20.\nC90.\n",
       0.05 + 0.25 + 0.9, 10, -20},
      {Control::fanuc, "G98 G0 C0. F100.\nG12.1\nG1 X30. C20.\nX30. C0.\nX10.\nG13.1\n",
       (std::hypot(5, 20) + 20 + 10) / 100, 5, 5},
      {Control::fanuc, "G98 G0 C0. F100.\nG112\nG1 X40. C15.\nG113\n", 0.15, 25, 5},
      {Control::fanuc, "G98 G0 C0. F100.\nG0 X30.\nG83 Z-10. R-3.\nG80\n", 0.12, 15, 5},
      {Control::haas, "M154\nM133 P1000\nG98\nG1 X20. F100.\nY5.\nM135\nM155\n",
       0.1 + 0.05, 10, 5},
      {Control::okuma, "M110\nSB=1000\nM13\nG94 G1 X20 F100\nM12\nM109\n", 0.1, 10, 5},
      {Control::siemens, "G94 SPOS=30\nS2=1000 M2=3\nG1 X20 F100\nY=IC(5)\nM2=5\n",
       0.1 + 0.05, 10, 5},
      {Control::siemens, "S2=1000 M2=3\nTRANSMIT\nG95 F0.1\nG1 X30 Y20\nTRAFOOF\n",
       std::hypot(5, 20) / 100, std::hypot(15, 20), 5},
      {Control::siemens, "TRACYL(40)\nG94 G1 Y20 F100\nG17 G2 X60 Y30 CR=10\nTRAFOOF\n",
       0.2 + quarter * 10 / 100, 30, 5},
      {Control::linuxcnc, "G94 G0 C90\nS1000 M3 $1\nG1 X10 F100\nG1 Y5\nM5 $1\n",
       0.1 + 0.05, 10, 5}};
  for (const auto& d : driven) {
    const std::string start =
        d.control == Control::linuxcnc  ? "G8 G95 G97 S500 M3\nG0 X20 Z5\nM5\n"
        : d.control == Control::siemens ? "DIAMON G95 G97 S500 M3\nG0 X40 Z5\nM5\n"
                                        : "G97 S500 M3\nG0 X40. Z5.\nM5\n";
    const auto p = read(d.control, start + d.text);
    ASSERT_EQ(p.unknown.size(), 1u) << d.text;
    EXPECT_EQ(p.unknown[0].what, "milling");
    EXPECT_NEAR(driven_min(p), d.min, 1e-9) << d.text;
    const bool a = d.control == Control::fanuc || d.control == Control::haas;
    const auto turned =
        read(d.control, start + d.text + "G97 S500 M3\n" + (a ? "G99" : "G95") +
                            " F0.2\nG1 Z0.\nZ-1.\n");
    ASSERT_EQ(turned.unknown.size(), 1u) << d.text << turned.unknown.back().what;
    const auto& last = turned.runs.back();
    EXPECT_FALSE(last.step.milling) << d.text;
    ASSERT_TRUE(last.moves.front().from) << d.text;
    EXPECT_NEAR(last.moves.front().from->h_mm, d.x_mm, 1e-9) << d.text;
    EXPECT_NEAR(last.moves.front().from->z_mm, d.z_mm, 1e-9) << d.text;
  }
}

// A speed beside the M3 that ends milling is the main spindle's, not the driven tool's.
TEST(Milling, EndsBeforeTheSpeedOfTheMainSpindle) {
  for (const auto control : {Control::fanuc, Control::siemens, Control::linuxcnc})
    for (const char* spindle : {"G97 S500 M3\n", "G97 M4 S500\n"}) {
      const bool a = control == Control::fanuc;
      const auto p = read(control, std::string("G97 S1500 M3\nG0 X20. Z5.\nM5\n") +
                                       (a ? "G98" : "G94") + " G0 C0.\nG1 X10. F100.\n" +
                                       spindle + (a ? "G99" : "G95") + " F0.2\nG1 Z0.\n");
      EXPECT_DOUBLE_EQ(p.runs.back().step.S, 500) << spindle;
      EXPECT_FALSE(p.runs.back().step.milling) << spindle;
    }
}

// C while the spindle turns and the tool feeds is no driven tool, and is told.
TEST(Milling, IsNotACutWithTheSpindleTurning) {
  const auto p =
      read(Control::fanuc, "G99 G97 S500 M3\nG0 X40. Z5.\nG1 Z-5. C2. F0.1\nG1 X50.");
  ASSERT_EQ(p.unknown.size(), 1u);
  EXPECT_EQ(p.unknown[0].what, "C2.");
  for (const auto& run : p.runs) EXPECT_FALSE(run.step.milling);
  // Nor is a slide that is sent to the axis.
  const auto y = read(Control::fanuc, "G99 G97 S500 M3\nG0 X40. Z5. Y0.\nG1 Z-5. F0.1");
  expect_understood(y);
  EXPECT_FALSE(y.runs.back().step.milling);
  // And without a feed it is told that there is none.
  EXPECT_EQ(read(Control::fanuc, "G0 X40. Z5.\nG0 C0.\nG1 X20.").unknown.size(), 2u);
}

}  // namespace
}  // namespace turnwright::review
