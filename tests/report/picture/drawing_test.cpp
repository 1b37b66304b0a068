#include "report/picture/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

#include "svg_check.hpp"
#include "turnwright/part/thread.hpp"
#include "turnwright/planning/prepare.hpp"

namespace turnwright::report::drawing_test {
namespace {

using planning::Clamping;
using planning::PreparedPart;
using planning::ProcessPlan;

// A bush from tube: d2, the bore and the right face are cut in the first setup, d1 and its
// end face in the second.  Stock 100 mm from -2, diameter 40: 40 mm high on paper, so a mm is one of
// paper; in the first setup z = -2 lies at x = (190 - 100) / 2 = 45, in the second,
// which holds the right end, z = 98.
PreparedPart bush() {
  planning::PlanRequest p;
  p.drawing.name = "Bush <A&B>";
  p.drawing.stock = {part::StockKind::tube, 40, 10, 100, 2};
  part::OuterElement d1, d2;
  d1.id = "d<1>";
  d1.length_mm = 30;
  d1.left_mm = d1.right_mm = 36;
  d2.id = "d2";
  d2.length_mm = 66;
  d2.left_mm = d2.right_mm = 30;
  d2.fit = "k6";
  p.drawing.outer = {d1, d2};
  part::InnerElement b1;
  b1.id = "b1";
  b1.length_mm = 20;
  b1.left_mm = b1.right_mm = 16;
  p.drawing.inner = {b1};
  p.setups.resize(2);
  p.setups[0] = {part::End::left, 20, {Clamping::chuck}};
  p.setups[1] = {part::End::right, 40, {Clamping::chuck}};
  return planning::prepare(std::move(p));
}

// The largest error, 0.010 mm, may take 6 paper mm: 6 / 0.010 = 600, so 500:1.
ProcessPlan planned() {
  ProcessPlan plan;
  plan.setups.resize(2);
  plan.setups[1].hold = part::End::right;
  plan.deviations = {{"d2", 0, {{30, 0.004}, {96, -0.010}}},
                     {"b1", 0, {{76, 0.002}, {96, 0.005}}},
                     {"right", 0, {{0, 5.0}, {15, 5.0}}},
                     {"d<1>", 1, {{0, 0.001}, {30, 0.001}}}};
  plan.compensation = {{"d2", 0, {{30, 0.001}, {96, 0.002}}}};
  return plan;
}

constexpr double kScale = 1, kFactor = 500;
double x_of(double z, std::size_t setup = 0) {
  return 45 + kScale * (setup == 0 ? z + 2 : 98 - z);
}

using Points = std::vector<std::pair<double, double>>;

/// Points of every polygon or polyline of a class.
std::vector<Points> shapes(const std::string& svg, const std::string& css_class) {
  std::vector<Points> all;
  const std::regex shape("<poly\\w+ class=\"" + css_class + "\" points=\"([^\"]*)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), shape), end; it != end; ++it) {
    std::istringstream in((*it)[1].str());
    Points points;
    double x = 0, y = 0;
    char comma = 0;
    while (in >> x >> comma >> y) points.emplace_back(x, y);
    all.push_back(points);
  }
  return all;
}

/// y of the centre line, which is the only line of its class.
double axis(const std::string& svg) {
  std::smatch found;
  if (!std::regex_search(svg, found,
                         std::regex("class=\"axis\" x1=\"\\S+\" y1=\"(\\S+)\"")))
    return std::nan("");
  return std::stod(found[1]);
}

TEST(WellFormed, SeesWhatIsNot) {
  EXPECT_TRUE(well_formed("<a b=\"1\"><c/>x &lt; y</a>\n"));
  for (const std::string wrong :
       {"<a><b></a></b>", "<a>&x</a>", "<a b=1/>", "<a>", "<a/"})
    EXPECT_FALSE(well_formed(wrong)) << wrong;
}

TEST(SetupDrawings, EachSetupHasOneWellFormedPicture) {
  const auto all = setup_drawings(bush(), planned());
  ASSERT_EQ(all.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_TRUE(well_formed(all[s])) << all[s];
    EXPECT_NE(all[s].find("Setup " + std::to_string(s + 1) + ": chuck, "),
              std::string::npos);
    EXPECT_EQ(all[s].find("nan"), std::string::npos);
  }
  EXPECT_NE(all[0].find("left end held, grip 20 mm"), std::string::npos);
  EXPECT_NE(all[1].find("right end held, grip 40 mm"), std::string::npos);
}

TEST(SetupDrawings, EqualPlansGiveEqualBytes) {
  EXPECT_EQ(setup_drawings(bush(), planned()), setup_drawings(bush(), planned()));
}

TEST(SetupDrawings, NamesAreEscaped) {
  const auto all = setup_drawings(bush(), planned());
  EXPECT_NE(all[0].find(">Bush &lt;A&amp;B&gt;<"), std::string::npos);
  EXPECT_NE(all[1].find(">d&lt;1&gt;  \u00d836<"), std::string::npos);
  EXPECT_NE(all[0].find(">d2  \u00d830 k6, path corrected<"), std::string::npos);
}

TEST(SetupDrawings, SizesAreThoseOfWhatIsCut) {
  const auto all = setup_drawings(bush(), planned());
  EXPECT_NE(all[0].find(" class=\"later\""), std::string::npos);
  EXPECT_NE(all[0].find(">d&lt;1&gt; uncut<"), std::string::npos);
  EXPECT_EQ(all[0].find("\u00d836"), std::string::npos);
  EXPECT_EQ(all[1].find("uncut"), std::string::npos);
  EXPECT_NE(all[1].find(">d2  \u00d830 k6<"), std::string::npos);  // of the first
}

TEST(SetupDrawings, JawsAreBoredToWhatTheyHold) {
  auto part = bush();
  auto& outer = part.drawing.outer;
  outer[1].length_mm = 46;
  outer.push_back(outer[1]);
  outer[2].id = "d3";
  outer[2].length_mm = 20;
  outer[2].left_mm = outer[2].right_mm = 24;
  const auto svg = setup_drawings(planning::prepare(part), planned())[1];
  const auto jaws = shapes(svg, "jaw");
  ASSERT_EQ(jaws.size(), 2u);
  const double top = 15 + 7 / kScale;  // paper mm beyond the largest
  const Points expected{{56, 15}, {76, 15}, {76, 12}, {96, 12}, {96, top}, {56, top}};
  for (std::size_t side = 0; side < 2; ++side) {
    ASSERT_EQ(jaws[side].size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(jaws[side][i].first, x_of(expected[i].first, 1), 1e-3);
      EXPECT_NEAR((axis(svg) - jaws[side][i].second) * (side == 0 ? 1 : -1),
                  kScale * expected[i].second, 2e-3);
    }
  }
}

TEST(SetupDrawings, JawsHoldTheGrip) {
  const auto all = setup_drawings(bush(), planned());
  // The first grips the stock, -2 .. 18, radius 20; the second the part, 56 .. 96, radius
  // 15, from the chuck outwards 96 .. 56.
  const double from[] = {-2, 96}, to[] = {18, 56}, r[] = {20, 15};
  for (std::size_t s = 0; s < 2; ++s) {
    const auto jaws = shapes(all[s], "jaw");
    ASSERT_EQ(jaws.size(), 2u);
    const auto [left, right] = std::ranges::minmax(jaws[0]);
    EXPECT_NEAR(left.first, x_of(from[s], s), 1e-3);
    EXPECT_NEAR(right.first, x_of(to[s], s), 1e-3);
    EXPECT_NEAR(axis(all[s]) - jaws[0][0].second, kScale * r[s], 2e-3);
    EXPECT_NEAR(jaws[1][0].second - axis(all[s]), kScale * r[s], 2e-3);
  }
}

TEST(SetupDrawings, JawsHoldTheBarThatThePartIsPartedOff) {
  auto part = bush();
  part.drawing.stock = {part::StockKind::tube, 40, 10, 160, 60, 0.6};
  auto plan = planned();
  plan.setups.resize(1);
  const auto svg = setup_drawings(planning::prepare(part), plan)[0];
  const auto jaws = shapes(svg, "jaw");
  ASSERT_EQ(jaws.size(), 2u);
  const double scale = 158.0 / 160;  // paper mm of a mm
  const double top = 20 + 7 / scale;
  const Points expected{{-60, 20}, {-40, 20}, {-40, top}, {-60, top}};
  ASSERT_EQ(jaws[0].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(jaws[0][i].first, 16 + scale * (expected[i].first + 60), 1e-3);
    EXPECT_NEAR(axis(svg) - jaws[0][i].second, scale * expected[i].second, 2e-3);
  }
}

TEST(SetupDrawings, CentresStandWhereTheClampingHasThem) {
  auto part = bush();
  auto plan = planned();
  const auto count = [&](Clamping clamping, const char* css_class) {
    part.setups[0].clampings = {clamping};
    plan.setups[0].clamping = clamping;
    return shapes(setup_drawings(planning::prepare(part), plan)[0], css_class).size();
  };
  EXPECT_EQ(count(Clamping::chuck, "centre"), 0u);
  EXPECT_EQ(count(Clamping::chuck_tailstock, "centre"), 1u);
  EXPECT_EQ(count(Clamping::chuck_tailstock, "jaw"), 2u);
  EXPECT_EQ(count(Clamping::between_centres, "centre"), 2u);
  EXPECT_EQ(count(Clamping::between_centres, "jaw"), 0u);
  part.setups[0].steady_z_mm = 30;
  EXPECT_EQ(count(Clamping::chuck_steady, "rest"), 2u);
  EXPECT_EQ(count(Clamping::chuck_steady, "centre"), 0u);
}

TEST(SetupDrawings, ErrorsStandOffTheSurfaceByTheFactor) {
  const auto all = setup_drawings(bush(), planned());
  const auto made = shapes(all[0], "made");
  ASSERT_EQ(made.size(), 2u);  // the face is not drawn
  const auto expect = [&](const std::pair<double, double>& p, double z, double r,
                          double e) {
    EXPECT_NEAR(p.first, x_of(z), 1e-3);
    EXPECT_NEAR(axis(all[0]) - p.second, kScale * (r + kFactor * e), 2e-3);
  };
  expect(made[0][0], 30, 15, 0.004);
  expect(made[0][1], 96, 15, -0.010);
  expect(made[1][1], 96, 8, 0.005);
  EXPECT_EQ(shapes(all[1], "made").size(), 1u);  // the factor is the plan's
  EXPECT_NEAR(axis(all[1]) - shapes(all[1], "made")[0][0].second,
              kScale * (18 + kFactor * 0.001), 2e-3);
  EXPECT_NE(all[0].find(" 500:1 "), std::string::npos);
}

TEST(SetupDrawings, CorrectedPathsStandOffByTheSameFactor) {
  auto plan = planned();
  const auto all = setup_drawings(bush(), plan);
  const auto paths = shapes(all[0], "path");
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NEAR(paths[0][1].first, x_of(96), 1e-3);
  EXPECT_NEAR(axis(all[0]) - paths[0][1].second, kScale * (15 + kFactor * 0.002), 2e-3);
  EXPECT_NE(all[0].find("blue: the tool path"), std::string::npos);
  EXPECT_TRUE(shapes(all[1], "path").empty());
  EXPECT_EQ(all[1].find("blue: the tool path"), std::string::npos);
  // 0.035 mm may take 6 paper mm: 6 / 0.035 = 171, so 100:1
  plan.compensation[0].table_mm[0].second = -0.035;
  EXPECT_NE(setup_drawings(bush(), plan)[0].find(" 100:1 "), std::string::npos);
  plan.compensation[0].table_mm[0].second = std::nan("");
  EXPECT_THROW(setup_drawings(bush(), plan), std::domain_error);
  plan = planned();
  plan.compensation[0].on = "right";  // a face, whose errors are not drawn
  EXPECT_EQ(setup_drawings(bush(), plan)[0].find("blue"), std::string::npos);
}

TEST(SetupDrawings, NoTextLiesOnAnother) {
  auto part = bush();
  auto plan = planned();
  for (const auto& svg : setup_drawings(planning::prepare(part), plan))
    EXPECT_EQ(crowded(svg), "");
  part.drawing.name = std::string(200, 'W');
  part.drawing.outer[1].id = std::string(24, 'W');
  part.drawing.outer[0].fit = "h11";
  plan.status = planning::PlanStatus::infeasible;
  plan.compensation[0].on = part.drawing.outer[1].id;
  for (const auto& svg : setup_drawings(planning::prepare(part), plan))
    EXPECT_EQ(crowded(svg), "");
  // steps of all lengths down to a tenth of a mm, up to the 100 that a part may have
  for (const std::size_t steps : {3u, 12u, 51u, 52u, 100u}) {
    part = bush();
    part.drawing.inner.clear();
    auto& outer = part.drawing.outer;
    const double length = 66.0 / static_cast<double>(steps) - 0.1;
    for (std::size_t i = 1; i < steps; ++i) {
      outer.insert(outer.begin() + 1, outer.back());
      outer[1].length_mm = i % 2 == 0 ? 0.1 : length;
      outer[1].id = "step" + std::to_string(i);
      outer[1].left_mm = outer[1].right_mm = 30 + 0.05 * static_cast<double>(i);
    }
    double used = 0;
    for (std::size_t i = 0; i + 1 < outer.size(); ++i) used += outer[i].length_mm;
    outer.back().length_mm = 96 - used;
    for (const auto& svg : setup_drawings(planning::prepare(part), planned()))
      EXPECT_EQ(crowded(svg), "") << steps;
  }
}

std::vector<std::string> texts_of_class(const std::string& svg, const std::string& name) {
  std::vector<std::string> all;
  const std::regex text("<text class=\"" + name + "\"[^>]*>([^<]*)<");
  for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it)
    all.push_back((*it)[1]);
  return all;
}

// The first setup's finished right face is z = 96, the second's finished left face z = 0.
TEST(SetupDrawings, ZeroIsInTheFinishedFaceOfTheFreeEnd) {
  const auto all = setup_drawings(bush(), planned());
  const double free_z[] = {96, 0};
  for (std::size_t s = 0; s < 2; ++s) {
    const auto arrows = shapes(all[s], "zero");
    ASSERT_EQ(arrows.size(), 4u);  // two heads, two filled quarters of the disk
    const auto [tip_z, tip_x] = std::pair{arrows[0][0], arrows[1][0]};
    EXPECT_NEAR(tip_z.first, x_of(free_z[s], s) + 12, 1e-3);  // Z to the right
    EXPECT_NEAR(tip_z.second, axis(all[s]), 1e-3);
    EXPECT_NEAR(tip_x.first, x_of(free_z[s], s), 1e-3);  // X up
    EXPECT_NEAR(tip_x.second, axis(all[s]) - 12, 1e-3);
    EXPECT_EQ(texts_of_class(all[s], "zero"), (std::vector<std::string>{"Z", "X"}));
  }
}

// Ends of elements in the program's Z: 96 mm from face to face, d1 30 mm long; the bore 20
// mm deep from the right.  The tube sticks out 2 mm at the left until it is faced.
TEST(SetupDrawings, TheRulerHasTheProgramsZ) {
  const auto all = setup_drawings(bush(), planned());
  for (const char* z : {">-98<", ">-96<", ">-66<", ">-20<", ">0<"})
    EXPECT_NE(all[0].find(z), std::string::npos) << z;
  for (const char* z : {">-96<", ">-76<", ">-30<", ">0<"})
    EXPECT_NE(all[1].find(z), std::string::npos) << z;
  EXPECT_EQ(all[1].find(">-98<"), std::string::npos);
  EXPECT_EQ(all[1].find(">30<"), std::string::npos);  // the drawing's own z
}

TEST(SetupDrawings, BarsAreAsLongAsTheySay) {
  const auto svg = setup_drawings(bush(), planned())[0];
  const std::regex bar(
      "class=\"bar\" x1=\"(\\S+)\" y1=\"(\\S+)\" x2=\"(\\S+)\" y2=\"(\\S+)\"");
  std::vector<double> lengths;
  for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it)
    lengths.push_back(std::hypot(std::stod((*it)[3]) - std::stod((*it)[1]),
                                 std::stod((*it)[4]) - std::stod((*it)[2])));
  ASSERT_EQ(lengths.size(), 2u);
  std::smatch mm, um;
  ASSERT_TRUE(std::regex_search(svg, mm, std::regex(">([0-9.]+) mm<")));
  ASSERT_TRUE(std::regex_search(svg, um, std::regex(">([0-9.]+) \u00b5m<")));
  EXPECT_NEAR(lengths[0], kScale * std::stod(mm[1]), 2e-3);
  EXPECT_NEAR(lengths[1], kScale * kFactor * std::stod(um[1]) / 1000, 2e-3);
}

TEST(SetupDrawings, BoresShowOnceTheyAreCut) {
  auto part = bush();
  part.drawing.inner[0].from = part::End::left;  // now setup 1 makes it
  const auto all = setup_drawings(planning::prepare(part), planned());
  EXPECT_EQ(all[0].find(">b1 "), std::string::npos);
  EXPECT_NE(all[1].find(">b1  \u00d816<"), std::string::npos);
  // The section is open at the bore's radius only after the second setup.
  const auto opening = [&](std::size_t s) {
    return (axis(all[s]) - shapes(all[s], "body")[0].back().second) / kScale;
  };
  EXPECT_NEAR(opening(0), 5, 1e-2);
  EXPECT_NEAR(opening(1), 8, 1e-2);
}

TEST(SetupDrawings, ThePartStandsAsTheSetupLeavesIt) {
  const auto all = setup_drawings(bush(), planned());
  const double radii[2][2] = {{20, 15}, {18, 15}}, left[] = {-2, 0};
  for (std::size_t s = 0; s < 2; ++s) {
    const auto body = shapes(all[s], "body")[0];
    EXPECT_NEAR(body[0].first, x_of(left[s], s), 1e-3);
    const auto radius_at = [&](double z) {  // outer points come first
      for (const auto& [x, y] : body)
        if (std::abs(x - x_of(z, s)) < 1e-3) return (axis(all[s]) - y) / kScale;
      return std::nan("");
    };
    EXPECT_NEAR(radius_at(30), radii[s][0], 1e-2);
    EXPECT_NEAR(radius_at(96), radii[s][1], 1e-2);
  }
}

// d2 gets a groove's floor, a thread's root or an arc's chords in place of its cylinder.
TEST(SetupDrawings, ShowWhatIsCutIntoABlank) {
  const auto drawn = [](const part::Shaped& s) {
    auto p = bush();
    auto& d2 = p.drawing.outer[1];
    d2.left_mm = s.blank.left_mm;
    d2.right_mm = s.blank.right_mm;
    d2.cut = s.cut;
    return setup_drawings(planning::prepare(p), planned()).at(0);
  };
  const auto has = [](const std::string& svg, const std::string& text) {
    return svg.find(text) != std::string::npos;
  };
  EXPECT_TRUE(has(drawn(part::groove(30, 26, 26)), "\u00d826 k6"));
  const auto thread = drawn(part::thread(30, 2, part::Where::outside));
  EXPECT_TRUE(has(thread, "M30\u00d72"));
  const auto arc = drawn(part::arc(66, {30, 30}, 200, false));
  EXPECT_TRUE(has(arc, "\u00d830 R200"));
  const auto count = [](const std::string& svg, const std::string& text) {
    std::size_t n = 0;
    for (auto at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1))
      ++n;
    return n;
  };
  const auto plain = setup_drawings(bush(), planned()).at(0);
  EXPECT_EQ(count(thread, "class=\"thin\"") - count(plain, "class=\"thin\""), 2U);
  EXPECT_EQ(count(arc, "class=\"cut\"") - count(plain, "class=\"cut\""), 22U);
  for (const auto& svg : {thread, arc}) EXPECT_TRUE(well_formed(svg));
}

// Of a rounded edge the ruler has both ends, not those of its chords.
TEST(SetupDrawings, TheRulerHasTheEndsOfRoundedEdges) {
  const part::Chamfer edge{.axial_mm = 3, .radial_mm = 3, .round = true};
  auto p = bush();
  p.drawing.outer[1].right_chamfer = p.drawing.inner[0].right_chamfer = edge;
  const auto svg = setup_drawings(planning::prepare(p), planned()).at(0);
  EXPECT_NE(svg.find(">-3<"), std::string::npos);
  EXPECT_FALSE(std::regex_search(svg, std::regex(">-[0-9]+\\.[0-9]{3}<")));
}

TEST(SetupDrawings, WhatStaysAsABarWithCornersHasTheWidthAcrossFlats) {
  auto p = bush();
  p.drawing.stock = {part::StockKind::hexagon, 36 / std::cos(M_PI / 6), 0, 100, 2};
  auto& head = p.drawing.outer[0];
  head.as_stock = true;
  head.left_mm = head.right_mm = p.drawing.stock.outer_mm;
  p.drawing.inner.clear();
  const auto svg = setup_drawings(planning::prepare(p), planned()).at(0);
  EXPECT_NE(svg.find("hex 36<"), std::string::npos);
}

TEST(SetupDrawings, NoErrorsNoBar) {
  auto plan = planned();
  plan.deviations.clear();
  plan.compensation.clear();
  const auto svg = setup_drawings(bush(), plan)[0];
  EXPECT_TRUE(well_formed(svg));
  EXPECT_TRUE(shapes(svg, "made").empty());
  EXPECT_EQ(svg.find("\u00b5m"), std::string::npos);
}

TEST(SetupDrawings, WhatIsNotFiniteIsRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto plan = planned();
    plan.deviations[0].table_mm[1].second = bad;
    EXPECT_THROW(setup_drawings(bush(), plan), std::domain_error);
    auto part = bush();
    part.drawing.stock.length_mm = bad;
    EXPECT_THROW(setup_drawings(planning::prepare(part), planned()), std::domain_error);
  }
}

}  // namespace
}  // namespace turnwright::report::drawing_test
