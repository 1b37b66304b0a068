// Ways of the tip over a contour.
#include "turnwright/nc/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace turnwright::nc {
namespace {

constexpr double kRounding = 1e-12;

// From a point to the straight line through two others, the air's side positive.
double above(const Point& p, const Point& a, const Point& b) {
  const auto n = normal(a, b);
  return (p.h_mm - a.h_mm) * n.h + (p.z_mm - a.z_mm) * n.z;
}

Point centre_of(const Point& tip, double r) { return {tip.h_mm + r, tip.z_mm + r}; }

TEST(Normal, PointsIntoTheAir) {
  EXPECT_NEAR(normal({10, 0}, {10, -5}).h, 1, kRounding);
  EXPECT_NEAR(normal({10, -5}, {14, -5}).z, 1,
              kRounding);  // a wall seen from its free end
  const auto cone = normal({10, 0}, {13, -4});
  EXPECT_NEAR(cone.h, 0.8, kRounding);
  EXPECT_NEAR(cone.z, 0.6, kRounding);
  EXPECT_THROW(normal({1, 1}, {1, 1}), std::domain_error);
}

TEST(Tip, IsOnLinesAlongTheAxes) {
  for (const double r : {0.0, 0.4, 1.2}) {
    EXPECT_NEAR(tip({10, -3}, {1, 0}, r).h_mm, 10, kRounding);
    EXPECT_NEAR(tip({12, -7}, {0, 1}, r).z_mm, -7, kRounding);
    // Where a cylinder meets a wall the tip is in the corner.
    const auto corner = tip({10, -7}, {1, 0}, {0, 1}, r);
    EXPECT_NEAR(corner.h_mm, 10, kRounding);
    EXPECT_NEAR(corner.z_mm, -7, kRounding);
  }
}

TEST(Tips, KeepTheCornerTangentToEveryLine) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> part(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double r = 1.2 * part(random);
    std::vector<Point> contour{{10, 0}};
    for (int k = 0; k < 4; ++k)
      contour.push_back({contour.back().h_mm + 3 * part(random),
                         contour.back().z_mm - 5 - 5 * part(random)});
    const auto way = tips(contour, r);
    ASSERT_EQ(way.size(), contour.size());
    for (std::size_t k = 0; k + 1 < contour.size(); ++k)
      for (const auto& end : {way[k], way[k + 1]})
        EXPECT_NEAR(above(centre_of(end, r), contour[k], contour[k + 1]), r, 1e-9);
  }
}

// The corner's circle at every place of its way stays off both lines' material, and
// touches both.
TEST(Across, CutsNeitherLineAndTouchesBoth) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double r = 0.6 + 0.4 * unit(random), step = 0.03 * unit(random);
    const Point a0{10 + unit(random), 5}, a{10, 0}, b{10 + step, 0},
        b1{10 + step + unit(random), -5};
    const auto m = normal(a0, a), n = normal(b, b1);
    const auto [leave, meet] = across(a, m, b, n, r);
    const auto off = [r](const Point& tip, const Point& p, const Normal& by) {
      return by.h * (tip.h_mm + r - p.h_mm) + by.z * (tip.z_mm + r - p.z_mm) - r;
    };
    EXPECT_NEAR(off(leave, a, m), 0, 1e-12);
    EXPECT_NEAR(off(meet, b, n), 0, 1e-12);
    const Point edge = step > 0 ? b : a;
    for (const double u : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Point c{std::lerp(leave.h_mm, meet.h_mm, u) + r,
                    std::lerp(leave.z_mm, meet.z_mm, u) + r};
      EXPECT_GE(std::hypot(c.h_mm - edge.h_mm, c.z_mm - edge.z_mm), r - 1e-9) << i;
      const auto along = [&c](const Point& p, const Normal& by) {
        return (c.h_mm - p.h_mm) * by.z - (c.z_mm - p.z_mm) * by.h;
      };
      const Point now{c.h_mm - r, c.z_mm - r};
      if (along(a, m) <= 0) {
        EXPECT_GE(off(now, a, m), -1e-9) << i;
      }
      if (along(b, n) >= 0) {
        EXPECT_GE(off(now, b, n), -1e-9) << i;
      }
    }
    // The lower line is left or met no farther from the edge than the corner needs to.
    const auto& low = step > 0 ? leave : meet;
    const auto foot = tip(edge, step > 0 ? m : n, r);
    EXPECT_LE(std::hypot(low.h_mm - foot.h_mm, low.z_mm - foot.z_mm),
              std::sqrt(2 * r * std::abs(step)) + 0.3 * r + std::abs(step));
  }
}

TEST(ArcThrough, HasItsEndsAtItsRadius) {
  for (const bool convex : {true, false}) {
    const auto a = arc_through({14, 0}, {20, -6}, 6, convex);
    for (const auto& p : {a.from, a.to})
      EXPECT_NEAR(std::hypot(p.h_mm - a.centre.h_mm, p.z_mm - a.centre.z_mm), 6, 1e-9);
    // A quarter circle: its centre is level with one end, below or above the other.
    EXPECT_NEAR(a.centre.h_mm, convex ? 14 : 20, 1e-9);
    EXPECT_NEAR(a.centre.z_mm, convex ? -6 : 0, 1e-9);
  }
  EXPECT_THROW(arc_through({0, 0}, {10, -10}, 7, true), std::domain_error);
}

TEST(TipArc, KeepsTheCornerTangentToTheArc) {
  for (const bool convex : {true, false})
    for (const double r : {0.0, 0.4, 1.2}) {
      const auto a = arc_through({14, 0}, {19, -7}, 9, convex);
      const auto t = tip_arc(a, r, {-1e9, -1e9, -1e9});
      ASSERT_TRUE(t);
      for (const auto& end : {t->from, t->to}) {
        const auto c = centre_of(end, r);
        EXPECT_NEAR(std::hypot(c.h_mm - a.centre.h_mm, c.z_mm - a.centre.z_mm),
                    convex ? 9 + r : 9 - r, 1e-9);
        EXPECT_NEAR(std::hypot(end.h_mm - t->centre.h_mm, end.z_mm - t->centre.z_mm),
                    convex ? 9 + r : 9 - r, 1e-9);
      }
      // The corner touches the drawn ends.
      const auto c = centre_of(t->to, r);
      EXPECT_NEAR(std::hypot(c.h_mm - a.to.h_mm, c.z_mm - a.to.z_mm), r, 1e-9);
    }
}

TEST(TipArc, StaysOffWhatIsBeforeAndAfter) {
  const auto a = arc_through({14, 0}, {19, -7}, 9, false);
  const auto t = tip_arc(a, 0.8, {14, 0, -7});
  ASSERT_TRUE(t);
  EXPECT_GE(t->from.h_mm, 14 - kRounding);
  EXPECT_GE(t->to.z_mm, -7 - kRounding);
  for (const auto& end : {t->from, t->to})  // still on the tip's circle
    EXPECT_NEAR(std::hypot(end.h_mm - t->centre.h_mm, end.z_mm - t->centre.z_mm), 8.2,
                1e-9);
}

// Whether a corner lies inside a height over a range of z, by points of its circle.
bool cuts_below(const Point& tip_at, double r, double h, double z0, double z1) {
  const auto c = centre_of(tip_at, r);
  for (int i = 0; i < 3600; ++i) {
    const double a = i * std::numbers::pi / 1800;
    const double z = c.z_mm + r * std::cos(a);
    if (z > z0 && z < z1 && c.h_mm + r * std::sin(a) < h - 1e-9) return true;
  }
  return false;
}

TEST(TipArc, ReachesEndsThatFallAndSparesWhatIsLevelWithThem) {
  const double r = 0.8;
  // A throat: its corner is over the arc at both ends, as deep as they are drawn.
  const auto throat = arc_through({20, 0}, {20, -8}, 20, false);
  const auto in = tip_arc(throat, r, {20, 20, -1e9});
  ASSERT_TRUE(in);
  EXPECT_LT(in->from.h_mm, 20 - 0.01);
  for (const auto& [tip_at, end] :
       {std::pair{in->from, throat.from}, {in->to, throat.to}}) {
    const auto c = centre_of(tip_at, r);
    EXPECT_NEAR(std::hypot(c.h_mm - end.h_mm, c.z_mm - end.z_mm), r, 1e-9);
  }
  EXPECT_FALSE(cuts_below(in->from, r, 20, 0, 10));
  EXPECT_FALSE(cuts_below(in->to, r, 20, -20, -8));
  // A crown: the corner would reach beyond both ends.
  const auto over = tip_arc(arc_through({20, 0}, {20, -8}, 20, true), r, {20, 20, -1e9});
  ASSERT_TRUE(over);
  EXPECT_NEAR(over->from.h_mm, 20, 1e-12);
  EXPECT_NEAR(over->to.h_mm, 20, 1e-12);
  EXPECT_FALSE(cuts_below(over->from, r, 20, 0, 10));
  EXPECT_FALSE(cuts_below(over->to, r, 20, -20, -8));
  EXPECT_NEAR(over->from.z_mm + over->to.z_mm, -8 - 2 * r, 1e-9);  // alike
  const auto c = centre_of(over->to, r);
  EXPECT_NEAR(
      std::hypot(c.h_mm - (over->centre.h_mm + r), c.z_mm - (over->centre.z_mm + r)),
      20 + r, 1e-9);
}

TEST(TipArc, RefusesACornerThatDoesNotFit) {
  EXPECT_FALSE(
      tip_arc(arc_through({14, 0}, {14.5, -0.5}, 0.5, false), 0.8, {0, 0, -100}));
  EXPECT_TRUE(tip_arc(arc_through({14, 0}, {14.5, -0.5}, 0.5, true), 0.8, {0, 0, -100}));
}

}  // namespace
}  // namespace turnwright::nc
