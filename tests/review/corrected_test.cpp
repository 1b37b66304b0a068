// Words F and S of programs, changed.
#include "turnwright/review/corrected.hpp"

#include <gtest/gtest.h>

namespace turnwright::review {
namespace {

using gcode::Control;

TEST(CorrectedText, HasOtherWordsAndNothingElse) {
  const auto c =
      corrected_text("(F0.3 S200) G96 S200 M3 (S200)\r\nG1 Z-5. F0.3 ; F0.3\nX9. F.25",
                     Control::fanuc, {{{2, 0.5}, {3, 1.1}}, {{1, 1.2345}}});
  EXPECT_EQ(c.text,
            "(F0.3 S200) G96 S246 M3 (S200)\r\nG1 Z-5. F0.150 ; F0.3\nX9. F0.275");
  ASSERT_EQ(c.words.size(), 3U);
  EXPECT_EQ(c.words[0].line, 1U);
  EXPECT_EQ(c.words[0].was, "S200");
  EXPECT_EQ(c.words[0].is, "S246");
}

TEST(CorrectedText, KeepsDecimalsPointsAndNames) {
  EXPECT_EQ(corrected_text("S200.50", Control::linuxcnc, {{}, {{1, 0.9}}}).text,
            "S180.45");
  EXPECT_EQ(corrected_text("S200.", Control::fanuc, {{}, {{1, 0.9}}}).text, "S180.");
  EXPECT_EQ(corrected_text("G96 S=200 LIMS=2000 F=0.2", Control::siemens,
                           {{{1, 0.9}}, {{1, 0.9}}})
                .text,
            "G96 S=180 LIMS=2000 F=0.180");
}

TEST(CorrectedText, StaysWhereLittleChanges) {
  const auto c =
      corrected_text("G96 S200 F0.2\n", Control::fanuc, {{{1, 1.0005}}, {{1, 0.9999}}});
  EXPECT_EQ(c.text, "G96 S200 F0.2\n");
  EXPECT_TRUE(c.words.empty());
}

/// A feed over one surface from the words of a line.
ReadMove feed(std::size_t line, std::size_t F_line, std::size_t S_line,
              toolpath::Move::Kind kind = toolpath::Move::Kind::feed) {
  return {toolpath::Point{}, {kind, 1, 1}, line, {F_line, S_line, false}};
}

Cut cut(const char* on, std::size_t line, double f) {
  Cut c;
  c.on = on;
  c.tool = 1;
  c.tool_id = "T";
  c.at.f_mm_rev = f;
  c.at.S = 100;
  c.at.constant_surface_speed = true;
  c.passes = {PassCut{.line = line}};
  return c;
}

planning::OperationPlan best(const char* on, double f, double vc) {
  planning::OperationPlan o;
  o.on = {on};
  o.tool = "T";
  o.passes = {planning::Pass{}};
  o.passes[0].f_mm_rev = f;
  o.passes[0].vc_m_min = vc;
  return o;
}

/// Factors of moves with one tool that make these cuts, for the best operations.
WordFactors factors(std::vector<ReadMove> moves, std::vector<Cut> cuts,
                    std::vector<planning::OperationPlan> operations) {
  TurningProgram program;
  program.runs.emplace_back();
  program.runs[0].step.tool = 1;
  program.runs[0].moves = std::move(moves);
  ReviewedSetup setup;
  setup.cuts = std::move(cuts);
  planning::SetupPlan plan;
  plan.operations = std::move(operations);
  return word_factors(setup, program, plan);
}

// Two surfaces in one way have one S, and the second its own F.
TEST(WordFactors, AreTheLeastOfWhatAWordServes) {
  const std::vector<Cut> cuts{cut("a", 10, 0.2), cut("b", 11, 0.2)};
  const std::vector<planning::OperationPlan> operations{best("a", 0.3, 150),
                                                        best("b", 0.1, 120)};
  const auto together = factors({feed(10, 9, 5), feed(11, 11, 5)}, cuts, operations);
  EXPECT_NEAR(together.S.at(5), 1.2, 1e-12);
  EXPECT_NEAR(together.F.at(9), 0.5, 1e-12);
  EXPECT_NEAR(together.F.at(11), 0.5, 1e-12);

  // A rapid between them parts what they share.
  const auto apart = factors(
      {feed(10, 9, 5), feed(10, 9, 5, toolpath::Move::Kind::rapid), feed(11, 11, 5)},
      cuts, operations);
  EXPECT_NEAR(apart.F.at(9), 1.5, 1e-12);
  EXPECT_NEAR(apart.F.at(11), 0.5, 1e-12);
}

TEST(WordFactors, LeaveTheLeadOfAThread) {
  const auto thread = factors({feed(10, 10, 5, toolpath::Move::Kind::thread)},
                              {cut("a", 10, 1.5)}, {best("a", 1.5, 80)});
  EXPECT_TRUE(thread.F.empty());
  EXPECT_NEAR(thread.S.at(5), 0.8, 1e-12);
}

// 20 % more speed and 50 % more feed a revolution.
TEST(WordFactors, OfAFeedPerMinuteHaveBoth) {
  auto move = feed(10, 9, 5);
  move.words.per_minute = true;
  EXPECT_NEAR(factors({move}, {cut("a", 10, 0.2)}, {best("a", 0.3, 120)}).F.at(9), 1.8,
              1e-12);
}

}  // namespace
}  // namespace turnwright::review
