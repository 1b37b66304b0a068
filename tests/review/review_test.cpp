// Reviews of programs written here, against depths and times by hand.
#include "turnwright/review/review.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "../nc/plans.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::review {
namespace {

using gcode::Control;
using nlohmann::json;

/// A shaft of 40 and 30 mm in diameter behind a cone, from a bar of 50 mm.
const planning::PreparedPart& shaft() {
  static const auto kPart =
      document::prepared_part(
          json{{"name", "Shaft"},
               {"material", "C45"},
               {"machine", "lathe-medium"},
               {"stock",
                {{"kind", "bar"},
                 {"diameter_mm", 50},
                 {"length_mm", 104},
                 {"left_allowance_mm", 2}}},
               {"outer",
                {{{"id", "d1"},
                  {"kind", "cylinder"},
                  {"length_mm", 40},
                  {"diameter_mm", 40}},
                 {{"id", "c"},
                  {"kind", "cone"},
                  {"length_mm", 20},
                  {"left_mm", 40},
                  {"right_mm", 30}},
                 {{"id", "d2"},
                  {"kind", "cylinder"},
                  {"length_mm", 40},
                  {"diameter_mm", 30}}}},
               {"setups",
                {{{"hold", "left"}, {"grip_mm", 25}, {"clampings", {"chuck"}}},
                 {{"hold", "right"}, {"grip_mm", 30}, {"clampings", {"chuck"}}}}}},
          nc::test::catalogue(), "part")
          .part;
  return kPart;
}

const catalogue::Tool& tool(const std::string& name) {
  return *std::ranges::find(nc::test::catalogue().tools, name, &catalogue::Tool::id);
}

Review reviewed(const std::string& text, std::size_t setup = 0,
                const std::vector<MountedTool>& tools = {
                    {.number = 1, .turning = tool("PCLNL-CNMG120408-PM")}}) {
  const auto& p = shaft();
  return review(p,
                {{setup, read_program(text, {.control = Control::fanuc,
                                             .n_max_rpm = p.machine.n_max_rpm})}},
                tools);
}

const std::string kStart = "G99 T0101\nG97 S1000 M3\n";

// 3 mm deep over 60 mm at 0.25 mm/rev and 1000 1/min, from 2 mm before the stock's face
// at Z2.
TEST(Review, MeasuresACylinder) {
  const auto r = reviewed(kStart + "G0 X44. Z4.\nG1 Z-40. F0.25\nG0 X60.");
  ASSERT_EQ(r.setups[0].cuts.size(), 1u);
  const auto& c = r.setups[0].cuts[0];
  EXPECT_EQ(c.on, "d2");
  ASSERT_EQ(c.passes.size(), 1u);
  EXPECT_NEAR(c.passes[0].ap_mm, 3, 1e-4);
  EXPECT_NEAR(c.passes[0].most_mm, 3, 1e-4);
  EXPECT_EQ(c.passes[0].line, 4u);
  EXPECT_NEAR(c.passes[0].time_min, 42 / 250.0, 0.003);
  const auto& s = r.setups[0];
  EXPECT_NEAR(s.minutes.cutting + s.minutes.air,
              44 / 250.0 + 8 / shaft().machine.rapid_mm_min, 1e-9);
  const auto F = cutting::forces_N(
      cutting::cut_of(shaft().material, tool("PCLNL-CNMG120408-PM")), 3.0, 0.25);
  EXPECT_NEAR(c.loads.Fc_N / F.Fc_N, 1, 1e-4);
  EXPECT_NEAR(c.loads.Fp_N / F.Fp_N, 1, 1e-3);
  EXPECT_NEAR(c.loads.vc_m_min, M_PI * 44, 1e-6);
  EXPECT_NEAR(c.loads.Pc_kW, F.Fc_N * M_PI * 44 / 60000, 1e-3);
  ASSERT_EQ(r.sizes.size(), 1u);
  EXPECT_NEAR(r.sizes[0].diameter_mm, 44, 1e-4);
}

// A cone of slope s = 1/4 comes as drawn with the nose beside the contour.  With the tip on
// it the nose of r = 0.8 mm leaves r (1 + s - sqrt(1 + s^2)) on the radius.
TEST(Review, FollowsNoseCompensation) {
  const auto cone_mm = [](const std::string& compensation) {
    const auto r = reviewed(kStart + "G0 X50. Z9.\n" + compensation +
                            "G0 X30. Z4.\nG1 Z-40. F0.25\nX40. Z-60.\nZ-70.\nG40\n"
                            "G0 X60.");
    EXPECT_TRUE(r.setups[0].unknown.empty());
    return std::ranges::find(r.sizes, "c", &MadeSize::on)->diameter_mm;
  };
  EXPECT_NEAR(cone_mm("G42\n"), 35, 1e-3);
  EXPECT_NEAR(cone_mm(""), 35 + 2 * 0.8 * (1.25 - std::sqrt(1 + 0.25 * 0.25)), 1e-3);
}

/// A cycle's program that leaves the shaft as drawn, and the depths of its passes over d2.
void expect_shaft(Control control, const std::string& text,
                  const std::vector<double>& expected) {
  const auto& p = shaft();
  const auto r = review(
      p,
      {{0, read_program(text, {.control = control, .n_max_rpm = p.machine.n_max_rpm})}},
      {{.number = 1, .turning = tool("PCLNL-CNMG120408-PM")}});
  for (const auto& u : r.setups[0].unknown) ADD_FAILURE() << u.what << u.why;
  EXPECT_TRUE(r.setups[0].rapids.empty());
  std::map<std::string, double> sizes;
  for (const auto& s : r.sizes) sizes[s.on] = s.diameter_mm;
  EXPECT_NEAR(sizes["d2"], 30, 2e-3);
  EXPECT_NEAR(sizes["c"], 35, 2e-3);
  std::vector<double> depths;
  for (const auto& c : r.setups[0].cuts)
    if (c.on == "d2")
      for (const auto& pass : c.passes) depths.push_back(pass.ap_mm);
  ASSERT_EQ(depths.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(depths[i], expected[i], 2e-3);
}

// CYCLE95 to 52 mm in 4 passes of 2.75 mm, of which the first takes 1.75 mm of the stock of
// 50 mm; finishing with the nose beside the contour leaves the part as drawn.
TEST(Review, FollowsSiemensStockRemoval) {
  expect_shaft(Control::siemens,
               "G18 G90 G95 DIAMON\nT1 D1\nG97 S1000 M3\n"
               "CYCLE95(\"SHAFT\",3,,,,0.25,,0.25,9)\nM30\nPROC SHAFT\n"
               "G1 X30 Z4\nZ-40\nX40 Z-60\nZ-70\nX52\nRET\n",
               {1.75, 2.75, 2.75, 2.75});
}

// LAP from 52 mm by 5 mm of the diameter: 47, 42, 37 and 32 mm, the contour 0.4 mm beside
// the drawn one, then this.
TEST(Review, FollowsOkumasLap) {
  expect_shaft(Control::okuma,
               "G90 G95\nT010101\nG97 S1000 M3\nG0 X52 Z4\nNLAP1 G81\nG42 G0 X30\n"
               "G1 Z-40 F0.25\nX40 Z-60\nZ-70\nX52\nG80\nG85 NLAP1 D5 U0.8 F0.25\n"
               "G87 NLAP1\nG40 G0 X60\n",
               {1.5, 2.5, 2.5, 2.5, 0.6, 0.4});
}

/// Whether a cut of d2 keeps its tool's least depth, 0.6 mm.
bool keeps_least_depth(const Review& r, std::size_t cut) {
  std::size_t i = 0;
  for (const auto& c : r.setups[0].cuts)
    if (c.on == "d2" && i++ == cut)
      for (const auto& l : c.limits)
        if (l.name == "least depth of cut") return l.margin > -0.01;
  return true;
}

// Thin passes are told of a bar from the first on; 0.5 mm is less than 0.6 mm.
TEST(Review, TellsPassesThatAreTooThin) {
  EXPECT_FALSE(
      keeps_least_depth(reviewed(kStart + "G0 X49. Z4.\nG1 Z-40. F0.25\nG0 X60."), 0));
  EXPECT_TRUE(
      keeps_least_depth(reviewed(kStart + "G0 X48. Z4.\nG1 Z-40. F0.25\nG0 X60."), 0));
  EXPECT_FALSE(keeps_least_depth(
      reviewed(kStart + "G0 X46. Z4.\nG1 Z-40. F0.25\nG0 X60.\nZ4.\nX45.\nG1 Z-40.\n"),
      0));
}

// What the edge wears, and the grip by VDI 3106, whose lever is the part before the cut.
TEST(Review, CountsEdgesAndGrip) {
  const auto r = reviewed(kStart + "G0 X44. Z4.\nG1 Z-40. F0.25\nG0 X60.");
  const auto& s = r.setups[0];
  const auto& c = s.cuts.at(0);
  const auto& t = tool("PCLNL-CNMG120408-PM");
  const double edges =
      c.passes[0].time_min /
      cutting::tool_life_min(cutting::cut_of(shaft().material, t), M_PI * 44, 0.25, 3.0);
  EXPECT_NEAR(c.edges / edges, 1, 1e-3);
  EXPECT_NEAR(s.edge_min / (edges * t.change_min), 1, 1e-3);
  EXPECT_NEAR(s.edge_cost / (edges * t.edge_cost), 1, 1e-3);
  const auto grip =
      std::ranges::find(c.limits, "grip of the chuck", &planning::ConstraintValue::name);
  ASSERT_NE(grip, c.limits.end());
  const auto& chuck = shaft().machine.chuck;
  const double wanted =
      1.5 / chuck.friction * std::hypot(c.loads.Fc_N * 50 / 50, c.loads.Ff_N) +
      chuck.jaw_mass_radius_kg_m * std::pow(M_PI * 1000 / 30, 2);
  EXPECT_NEAR(grip->value / wanted, 1, 1e-3);
}

// A hollow of 12.5 mm between two places of 44 mm, 17 mm from the axis in its middle.
TEST(Review, FollowsArcsTheirWay) {
  for (const auto& [code, least_mm] : {std::pair{"G2", 17.0}, {"G3", 22.0}}) {
    const auto r = reviewed(kStart + "G0 X54. Z-10.\nG1 X44. F0.1\n" + code +
                            " X44. Z-30. R12.5\nG0 X60.");
    const auto& passes = r.setups[0].cuts.at(0).passes;
    EXPECT_NEAR(passes.at(0).x_from_mm, least_mm, 0.02) << code;
  }
  // The short way past the left of its circle, up and down.
  for (const char* way :
       {"G1 X40. F0.1\nG2 X48. Z-30. R5.", "G1 X48. F0.1\nG3 X40. Z-30. R5."}) {
    const auto r = reviewed(kStart + "G0 X54. Z-30.\n" + way + "\nG0 X60.");
    EXPECT_NEAR(r.setups[0].cuts.at(0).passes.at(0).x_from_mm, 20, 0.02) << way;
  }
}

TEST(Review, MeasuresAFace) {
  const auto r = reviewed(kStart + "G0 X54. Z0.5\nG1 X-1.6 F0.2\nG0 Z3.");
  ASSERT_EQ(r.setups[0].cuts.size(), 1u);
  const auto& c = r.setups[0].cuts[0];
  EXPECT_EQ(c.on, "right");
  EXPECT_EQ(c.kind, planning::OperationKind::face);
  EXPECT_NEAR(c.passes[0].ap_mm, 1.5, 1e-4);
  EXPECT_NEAR(c.passes[0].x_to_mm, 25, 0.05);
}

// Parallel to a cone of 14 deg, a layer of t mm on the radius is t cos(14 deg) deep.
TEST(Review, MeasuresAConeAcrossItsWay) {
  const auto r =
      reviewed(kStart +
               "G0 X34. Z4.\nG1 Z-40. F0.2\nX44. Z-60.\nX52.\nG0 Z4.\nG0 X32.\n"
               "G1 Z-40. F0.1\nX42. Z-60.\nX52.\nG0 Z4.");
  const auto slope = std::atan(5.0 / 20);
  const auto& cuts = r.setups[0].cuts;
  const auto cone = std::ranges::find_if(
      cuts, [](const Cut& c) { return c.on == "c" && c.at.f_mm_rev == 0.1; });
  ASSERT_NE(cone, cuts.end());
  EXPECT_NEAR(cone->passes[0].ap_mm, std::cos(slope), 1e-3);
}

TEST(Review, CountsPassesOfOneCut) {
  const auto r = reviewed(kStart +
                          "G90 X47. Z-40. F0.25\n"  // from a place that is not known
                          "G0 X54. Z4.\nG90 X47. Z-40. F0.25\nX44.\nX42.");
  const auto& c = r.setups[0].cuts.at(0);
  ASSERT_EQ(c.passes.size(), 3u);
  EXPECT_NEAR(c.passes[0].ap_mm, 1.5, 1e-4);
  EXPECT_NEAR(c.passes[1].ap_mm, 1.5, 1e-4);
  EXPECT_NEAR(c.passes[2].ap_mm, 1, 1e-4);
  ASSERT_EQ(r.setups[0].unknown.size(), 1u);
  EXPECT_EQ(r.setups[0].unknown[0].line, 3u);
}

TEST(Review, TellsLimitsThatAreNotKept) {
  const auto r = reviewed(kStart + "G0 X30. Z4.\nG1 Z-40. F0.5\nG0 X60.");
  const auto& limits = r.setups[0].cuts.at(0).limits;
  const auto broken = [&](const char* name) {
    const auto l = std::ranges::find(limits, name, &planning::ConstraintValue::name);
    return l != limits.end() && l->margin < 0;
  };
  EXPECT_TRUE(broken("largest depth of cut"));  // 10 mm
  EXPECT_TRUE(broken("cutting force"));
  EXPECT_FALSE(broken("least feed"));
}

TEST(Review, TellsRapidsThroughMaterial) {
  const auto r = reviewed(kStart + "G0 X54. Z-10.\nX48.\nG0 Z-20.\nG0 X54.");
  ASSERT_EQ(r.setups[0].rapids.size(), 3u);
  EXPECT_EQ(r.setups[0].rapids[0].line, 4u);
  EXPECT_NEAR(r.setups[0].rapids[0].mm, 1, 0.01);
  EXPECT_TRUE(r.setups[0].cuts.empty());
}

// Stock is left where no document of the tool is given.
TEST(Review, NamesToolsWithoutADocument) {
  const auto r = reviewed(
      "G99 T0505\nG97 S1000 M3\nG0 X44. Z4.\nG1 Z-40. F0.25\nG0 X60. Z4.\n"
      "T0101\nG0 X44.\nG1 Z-40.");
  ASSERT_EQ(r.setups[0].unknown.size(), 1u);
  EXPECT_EQ(r.setups[0].unknown[0].what, "T5");
  EXPECT_NEAR(r.setups[0].cuts.at(0).passes.at(0).ap_mm, 3, 1e-4);
}

// The second setup finds what the first makes, as drawn.
TEST(Review, TakesEarlierSetupsAsDrawn) {
  const auto r = reviewed(kStart + "G0 X44. Z4.\nG1 Z-70. F0.25\nG0 X60.", 1);
  const auto& s = r.setups[0];
  ASSERT_EQ(s.cuts.size(), 1u);
  EXPECT_EQ(s.cuts[0].on, "d1");
  // d1 ends at Z-40, the cone behind it is finished and smaller than 44 mm.
  EXPECT_NEAR(s.cuts[0].passes[0].length_mm, 42, 0.3);
  EXPECT_THROW(review(shaft(), {{1, {}}, {0, {}}}, {}), std::domain_error);
}

// Infeeds of 0.4 and 0.2 mm into a blank of 44 mm; the second cut is the lighter one.
TEST(Review, MeasuresInfeedsOfThreads) {
  const auto& fixed = nc::test::catalogue().fixed_tools;
  const auto thread = *std::ranges::find_if(fixed, [](const auto& t) {
    return t.use == catalogue::FixedUse::threading && !t.inner;
  });
  const auto r = reviewed(kStart +
                              "G0 X44. Z4.\nG1 Z-30. F0.25\nG0 X60. Z8.\nT0202\n"
                              "G92 X43.2 Z-20. F1.5\nX42.8",
                          0,
                          {{.number = 1, .turning = tool("PCLNL-CNMG120408-PM")},
                           {.number = 2, .fixed = thread}});
  const auto& c = r.setups[0].cuts.back();
  ASSERT_EQ(c.passes.size(), 2u);
  EXPECT_NEAR(c.passes[0].ap_mm, 0.4, 1e-4);
  EXPECT_NEAR(c.passes[1].ap_mm, 0.2, 1e-4);
  EXPECT_NEAR(c.passes[1].before_mm, 0.4, 1e-4);
  EXPECT_EQ(c.kind, planning::OperationKind::fixed);
}

TEST(Review, SaysWhyNothingIsPredicted) {
  const auto r = reviewed(kStart + "G0 X44. Z4.\nG1 Z-40. F0.25\nG0 X60.");
  const auto all = reconstructed(shaft(), r);
  EXPECT_EQ(all.cannot.back(), "setup 2 has no program");
  EXPECT_EQ(all.cannot.front(), "no program faces right");
}

// LinuxCNC's own examples, where they are installed or TURNWRIGHT_NCFILES says.
TEST(ReviewOfForeignPrograms, FollowsLinuxCncsExamples) {
  const char* given = std::getenv("TURNWRIGHT_NCFILES");
  const std::filesystem::path folder = given ? given : "/usr/share/linuxcnc/ncfiles";
  if (!std::filesystem::exists(folder / "lathe_pawn.ngc"))
    GTEST_SKIP() << "no examples in " << folder;
  for (const auto& [file, cuts, unknown] : {std::tuple{"lathe_pawn.ngc", true, false},
                                            {"lathe-g76.ngc", true, true},
                                            {"lathe_g70_71_demo.ngc", false, true},
                                            {"lathecomp.ngc", false, true}}) {
    std::ifstream in(folder / file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto read = read_program(
        text, {.control = Control::linuxcnc, .n_max_rpm = shaft().machine.n_max_rpm});
    std::vector<MountedTool> tools;
    for (const int n : {0, 1, 2})
      tools.push_back({.number = n, .turning = tool("PCLNL-CNMG120408-PM")});
    const auto r = review(shaft(), {{0, read}}, tools);
    EXPECT_EQ(!r.setups[0].cuts.empty(), cuts) << file;
    EXPECT_EQ(!r.setups[0].unknown.empty(), unknown) << file;
  }
}

}  // namespace
}  // namespace turnwright::review
