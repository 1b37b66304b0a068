#include "report/picture/volumetric_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "../words.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::report::volumetric_drawing_test {
namespace {

using namespace volumetric;

struct Dot {
  double x = 0, y = 0;
};

/// Points of the polylines of a class, one list each.
std::vector<std::vector<Dot>> polylines(const std::string& svg, const std::string& of) {
  const std::regex shape("<polyline class=\"" + of + "\" points=\"([^\"]*)\"");
  std::vector<std::vector<Dot>> out;
  for (std::sregex_iterator i(svg.begin(), svg.end(), shape), end; i != end; ++i) {
    std::istringstream in((*i)[1].str());
    out.emplace_back();
    char comma = 0;
    for (Dot d; in >> d.x >> comma >> d.y;) out.back().push_back(d);
  }
  return out;
}

Trace trace(auto ccw, auto cw) {
  Trace t{Plane::YZ, 100, {}, {}, {}};
  for (int k = 0; k < 36; ++k) {
    t.theta_rad.push_back((k + 0.5) * std::numbers::pi / 18);
    t.ccw_mm.push_back(ccw(t.theta_rad.back()));
    t.cw_mm.push_back(cw(t.theta_rad.back()));
  }
  return t;
}

// 3 um on all radii about a centre 10 um off: 14 mm / 3 um allow 2000 : 1, so 6 mm.
TEST(BallBarDrawing, MagnifiesDeviationsFromTheCommonCentre) {
  const auto path = [](double theta) { return 0.003 + 0.010 * std::cos(theta); };
  const std::string svg = ball_bar_drawing(trace(path, path));
  EXPECT_TRUE(has(svg, "deviations 2000 : 1 about the common centre (Y 10, Z 0 um)"));
  EXPECT_TRUE(has(svg, "1 mm of paper is 0.5 um"));
  EXPECT_TRUE(has(svg, "Ball bar YZ, R = 100 mm"));
  for (const char* line : {"made", "path", "thin"})
    for (const auto& curve : polylines(svg, line)) {
      ASSERT_GE(curve.size(), 37u);
      for (const Dot& d : curve)
        EXPECT_NEAR(std::hypot(d.x - 72, d.y - 80), 48, 2e-3) << line;
    }
  EXPECT_EQ(polylines(svg, "thin").size(), 2u);  // the fit of each path
}

// Only the counter-clockwise path has four lobes: +Y to the right, +Z up.
TEST(BallBarDrawing, DrawsEachPathWhereItLies) {
  const std::string svg =
      ball_bar_drawing(trace([](double theta) { return 0.01 * std::cos(4 * theta); },
                             [](double) { return 0.0; }));
  const auto ccw = polylines(svg, "made").at(0), cw = polylines(svg, "path").at(0);
  double least = 1e9, most = 0, flat = 0;
  for (const Dot& d : ccw) {
    least = std::min(least, std::hypot(d.x - 72, d.y - 80));
    most = std::max(most, std::hypot(d.x - 72, d.y - 80));
  }
  for (const Dot& d : cw)
    flat = std::max(flat, std::abs(std::hypot(d.x - 72, d.y - 80) - 42));
  EXPECT_NEAR(most - least, 10 * (1 + std::cos(std::numbers::pi / 9)), 0.02);
  EXPECT_LT(flat, 2e-3);
  EXPECT_GT(ccw.front().x, 72);
  EXPECT_LT(ccw.front().y, 80);
}

TEST(BallBarDrawing, RefusesWhatCannotBeFitted) {
  Trace t = trace([](double) { return 0.0; }, [](double) { return 0.0; });
  EXPECT_NO_THROW(ball_bar_drawing(t));  // nothing to magnify
  t.theta_rad.resize(5);
  t.ccw_mm.resize(5);
  t.cw_mm.resize(5);
  EXPECT_THROW(ball_bar_drawing(t), ModelRangeError);
}

// 1 um and 1 nm stand at 0 and -3 of -4 to 0, between y = 92 and 26.
TEST(CompensationDrawing, IsLogarithmicAndKeepsPeaks) {
  Compensated c;
  c.before = {1e-3, 1e-3};
  c.after = {1e-6, 1e-6};
  c.distances_mm.assign(10000, {1e-4f, 1e-8f});
  c.distances_mm[5003] = {1e-3f, 1e-6f};
  const std::string svg = compensation_drawing(c);
  const auto top = [&svg](const char* line) {
    const auto curves = polylines(svg, line);
    double y = 1e9;
    for (const Dot& d : curves.at(0)) y = std::min(y, d.y);
    return y;
  };
  EXPECT_NEAR(top("made"), 26, 2e-3);
  EXPECT_NEAR(top("path"), 92 - 66.0 / 4, 2e-3);
  EXPECT_TRUE(has(svg, "before: largest 1 um"));
  EXPECT_TRUE(has(svg, "after: largest 0.001 um"));
  EXPECT_NO_THROW(compensation_drawing({}));
}

TEST(ErrorMap, ShowsEachErrorOnce) {
  Machine m{"wCfXt", {}, {{'C', {}, std::numbers::pi}, {'X', {}, 50}}};
  m.axes[1].errors[0].c[1] = 5e-3;
  m.axes[1].errors[0].b = 1e-3;
  m.axes[1].errors[1].c[2] = 2e-3;
  m.axes[0].errors[5].f = {{2e-6, 0}};
  const std::string svg = error_map(m);
  EXPECT_TRUE(has(svg, ">EXX<"));
  EXPECT_TRUE(has(svg, ">EYX<"));
  EXPECT_TRUE(has(svg, ">ECC<"));
  EXPECT_FALSE(has(svg, "EZX"));
  // EXX by direction: parallel lines, 2 b = 2 um apart, rising by 10 um.
  const auto both = polylines(svg, "made");
  ASSERT_EQ(both.size(), 2u);
  const double um = (both[0].front().y - both[0].back().y) / 10;
  EXPECT_GT(um, 0);
  EXPECT_NEAR(both[1].front().y - both[0].front().y, 2 * um, 2e-3);
  EXPECT_TRUE(has(error_map({"wXft", {}, {{'X', {}, 100}}}), "none along any axis"));
}

// Means 0 and 8 um in +, 4 um below in -, 5 approaches with a standard deviation of 1 um: the
// band reaches from -6 to 10 um.
TEST(PositioningDrawing, DrawsMeansBandsAndWhatLiesBetween) {
  const auto about = [](double um) {
    const double mm = um / 1e3, step = 1e-3 / std::sqrt(2.5);
    return std::vector<double>{mm - 2 * step, mm - step, mm, mm + step, mm + 2 * step};
  };
  const std::vector<Target> all{{0, about(0), about(-4)}, {100, about(8), about(4)}};
  const std::string svg = positioning_drawing('Z', iso230_2(all));
  const auto plus = polylines(svg, "made"), minus = polylines(svg, "path"),
             thin = polylines(svg, "thin");
  ASSERT_EQ(plus.size(), 1u);
  ASSERT_EQ(minus.size(), 1u);
  ASSERT_EQ(thin.size(), 4u);
  const double um = (plus[0][0].y - plus[0][1].y) / 8;
  EXPECT_GT(um, 0);
  EXPECT_GT(plus[0][1].x, plus[0][0].x);
  EXPECT_NEAR(minus[0][0].y - plus[0][0].y, 4 * um, 2e-3);
  EXPECT_NEAR(thin[0][0].y - plus[0][0].y, 2 * um, 2e-3);
  EXPECT_NEAR(plus[0][1].y - thin[1][1].y, 2 * um, 2e-3);
  for (const char* told :
       {"Positioning of axis Z, ISO 230-2", ">A<", ">16<", ">E<", ">12<", ">M<", ">8<",
        ">mean in +<", ">mean in -<", ">deviation, um<"})
    EXPECT_TRUE(has(svg, told)) << told;
}

TEST(PositioningDrawing, LeavesOutWhatTheValuesLack) {
  const std::string svg = positioning_drawing(
      'X', iso230_2(std::vector<Target>{{0, {1e-3}, {}}, {100, {2e-3}, {}}}));
  EXPECT_EQ(polylines(svg, "made").size(), 1u);
  EXPECT_TRUE(polylines(svg, "path").empty());
  EXPECT_TRUE(polylines(svg, "thin").empty());
  for (const char* none : {">A<", ">E<", ">M<", ">mean in -<"})
    EXPECT_FALSE(has(svg, none)) << none;
  EXPECT_NO_THROW(positioning_drawing('X', iso230_2(std::vector<Target>{{5, {0}, {0}}})));
  EXPECT_NO_THROW(positioning_drawing('X', {}));
}

}  // namespace
}  // namespace turnwright::report::volumetric_drawing_test
