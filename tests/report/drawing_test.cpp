#include "turnwright/report/drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

namespace turnwright::report {
namespace {

using planning::Clamping;
using planning::PartPlan;
using planning::ProcessPlan;

// A bush from tube: d1 and its end face are cut in setup 1; d2, the bore and the right
// face in setup 0.  Stock 100 mm from -2, diameter 40: the height does not bind, so a mm
// is (190 - 2 * 16) / 100 = 1.58 paper mm; z = -2 lies at x = 16.
PartPlan bush() {
  PartPlan p;
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
  return p;
}

// The largest error, 0.010 mm, may take 6 paper mm: 6 / (1.58 * 0.010) = 380, so 200:1.
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

constexpr double kScale = 1.58, kFactor = 200;
double x_of(double z) { return 16 + kScale * (z + 2); }

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

/// Whether tags nest, attributes are quoted and `<`, `&` appear in text as entities only.
bool well_formed(const std::string& xml) {
  const std::regex tag(
      "^<(/?)([a-z]+)((?:\\s+[A-Za-z][A-Za-z0-9:-]*=\"[^\"<&]*\")*)(/?)>",
      std::regex::optimize);
  const std::regex entity("^&(amp|lt|gt|quot);");
  std::vector<std::string> open;
  bool root_closed = false;
  for (std::size_t i = 0; i < xml.size();) {
    const auto rest = xml.begin() + static_cast<long>(i);
    std::smatch m;
    if (xml[i] == '&') {
      if (!std::regex_search(rest, xml.end(), m, entity)) return false;
      i += static_cast<std::size_t>(m.length());
    } else if (xml[i] == '<') {
      if (root_closed || !std::regex_search(rest, xml.end(), m, tag)) return false;
      const std::string name = m[2];
      if (m[1] == "/") {
        if (open.empty() || open.back() != name) return false;
        open.pop_back();
        root_closed = open.empty();
      } else if (m[4] != "/") {
        open.push_back(name);
      }
      i += static_cast<std::size_t>(m.length());
    } else {
      if (xml[i] == '>') return false;
      ++i;
    }
  }
  return root_closed;
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
    EXPECT_NE(all[s].find("Setup " + std::to_string(s) + ": chuck, "), std::string::npos);
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
  EXPECT_NE(all[0].find(">d&lt;1&gt;  \u00d836<"), std::string::npos);
  EXPECT_NE(all[0].find(">d2  \u00d830 k6, path corrected<"), std::string::npos);
}

TEST(SetupDrawings, JawsHoldTheGrip) {
  const auto all = setup_drawings(bush(), planned());
  // Setup 0 grips the stock, -2 .. 18, radius 20; setup 1 the part, 56 .. 96, radius 15.
  const double from[] = {-2, 56}, to[] = {18, 96}, r[] = {20, 15};
  for (std::size_t s = 0; s < 2; ++s) {
    const auto jaws = shapes(all[s], "jaw");
    ASSERT_EQ(jaws.size(), 2u);
    EXPECT_NEAR(jaws[0][0].first, x_of(from[s]), 1e-3);
    EXPECT_NEAR(jaws[0][1].first, x_of(to[s]), 1e-3);
    EXPECT_NEAR(axis(all[s]) - jaws[0][0].second, kScale * r[s], 2e-3);
    EXPECT_NEAR(jaws[1][0].second - axis(all[s]), kScale * r[s], 2e-3);
  }
}

TEST(SetupDrawings, CentresStandWhereTheClampingHasThem) {
  auto part = bush();
  auto plan = planned();
  const auto count = [&](Clamping clamping, const char* css_class) {
    part.setups[0].clampings = {clamping};
    plan.setups[0].clamping = clamping;
    return shapes(setup_drawings(part, plan)[0], css_class).size();
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
  EXPECT_NE(all[0].find(" 200:1 "), std::string::npos);
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
  const auto all = setup_drawings(part, planned());
  EXPECT_EQ(all[0].find(">b1 "), std::string::npos);
  EXPECT_NE(all[1].find(">b1  \u00d816<"), std::string::npos);
  // The section is open at the bore's radius only behind setup 1.
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
    EXPECT_NEAR(body[0].first, x_of(left[s]), 1e-3);
    const auto radius_at = [&](double z) {  // outer points come first
      for (const auto& [x, y] : body)
        if (std::abs(x - x_of(z)) < 1e-3) return (axis(all[s]) - y) / kScale;
      return std::nan("");
    };
    EXPECT_NEAR(radius_at(30), radii[s][0], 1e-2);
    EXPECT_NEAR(radius_at(96), radii[s][1], 1e-2);
  }
}

TEST(SetupDrawings, NoErrorsNoBar) {
  auto plan = planned();
  plan.deviations.clear();
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
    EXPECT_THROW(setup_drawings(part, planned()), std::domain_error);
  }
}

}  // namespace
}  // namespace turnwright::report
