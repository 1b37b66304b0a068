// Ways of the tip over a contour.
#include "turnwright/toolpath/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace turnwright::toolpath {
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
      const auto t = tip_arc(a, r);
      ASSERT_TRUE(t);
      for (const auto& end : {t->from, t->to}) {
        const auto c = centre_of(end, r);
        EXPECT_NEAR(std::hypot(c.h_mm - a.centre.h_mm, c.z_mm - a.centre.z_mm),
                    convex ? 9 + r : 9 - r, 1e-9);
        EXPECT_NEAR(std::hypot(end.h_mm - t->centre.h_mm, end.z_mm - t->centre.z_mm),
                    convex ? 9 + r : 9 - r, 1e-9);
      }
      // The corner touches the drawn ends.
      for (const auto& [tip_at, end] : {std::pair{t->from, a.from}, {t->to, a.to}}) {
        const auto c = centre_of(tip_at, r);
        EXPECT_NEAR(std::hypot(c.h_mm - end.h_mm, c.z_mm - end.z_mm), r, 1e-9);
      }
    }
}

TEST(TipArc, RefusesACornerThatDoesNotFit) {
  EXPECT_FALSE(tip_arc(arc_through({14, 0}, {14.5, -0.5}, 0.5, false), 0.8));
  EXPECT_TRUE(tip_arc(arc_through({14, 0}, {14.5, -0.5}, 0.5, true), 0.8));
}

Piece line(const Point& a, const Point& b) { return {a, b, {}}; }
Piece piece(const Arc& a) { return {a.from, a.to, a}; }

TEST(Distance, IsThatOfTheNearestPoint) {
  const auto step = line({2, 0}, {5, 4});
  EXPECT_NEAR(distance_mm(step, {2 + 1.5 - 0.8, 2 + 0.6}), 1, 1e-12);
  EXPECT_NEAR(distance_mm(step, {2, -1}), 1, 1e-12);
  EXPECT_NEAR(distance_mm(step, {5, 6}), 2, 1e-12);
  EXPECT_NEAR(distance_mm(line({2, 0}, {2, 0}), {5, 4}), 5, 1e-12);
  for (const bool convex : {true, false}) {
    const auto a = arc_through({14, 0}, {19, -7}, 9, convex);
    const auto course = around(a);
    for (const auto& p : {Point{30, 0}, {14, 3}, {21, -9}, {5, -3}, {16, -3}, {20, -1}}) {
      double nearest = INFINITY;
      for (int i = 0; i <= 100'000; ++i) {
        const auto q = course.at(course.length_mm * i / 1e5);
        nearest = std::min(nearest, std::hypot(p.h_mm - q.h_mm, p.z_mm - q.z_mm));
      }
      EXPECT_NEAR(distance_mm(piece(a), p), nearest, 1e-8);
    }
  }
}

TEST(Course, GoesItsLengthFromEndToEnd) {
  const auto bent = along({{0, 0}, {3, 4}, {3, 4}, {3, -2}});
  EXPECT_NEAR(bent.length_mm, 11, 1e-12);
  EXPECT_NEAR(bent.at(7).z_mm, 2, 1e-12);
  EXPECT_NEAR(backwards(bent).at(8.5).h_mm, 1.5, 1e-12);
  const auto a = arc_through({14, 0}, {20, -6}, 6, true);
  const auto round = around(a);
  EXPECT_NEAR(round.length_mm, 3 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(round.at(0).h_mm, 14, 1e-9);
  EXPECT_NEAR(round.at(round.length_mm).z_mm, -6, 1e-9);
  const auto middle = round.at(round.length_mm / 2);
  EXPECT_NEAR(middle.h_mm - a.centre.h_mm, 6 * std::sqrt(0.5), 1e-9);
}

// Along a cylinder: to a wall, an edge just higher, a cone, a crown, and past an edge.
TEST(FreeWay, EndsWhereTheCornerTouches) {
  const double r = 0.8;
  const auto course = along({{20, 5}, {20, -5}});  // of the tip: its centre is r before
  const auto free = [&](const Piece& p) { return free_mm(course, {{p}}, {r}); };
  EXPECT_NEAR(free(line({20, -3}, {30, -3})), 8, 1e-5);
  EXPECT_NEAR(free(line({20.01, -3}, {20.01, -9})),
              8 + r - std::sqrt(r * r - (r - 0.01) * (r - 0.01)), 1e-4);
  EXPECT_NEAR(free(line({20, -3}, {23, -6})), 8 + r - r * std::tan(std::numbers::pi / 8),
              1e-5);
  const auto crown = arc_through({20, -3}, {20, -9}, 20, true);
  const double s = free(piece(crown));
  EXPECT_NEAR(std::hypot(20 + r - crown.centre.h_mm, 5 - s + r - crown.centre.z_mm),
              20 + r, 2e-6);
  EXPECT_EQ(free(line({20, -3}, {17, -6})), 10);
  EXPECT_EQ(free(line({20, -3}, {10, -3})), 10);
  EXPECT_EQ(free(line({21, 5}, {21, 9})), 0);  // not even at its beginning
}

}  // namespace
}  // namespace turnwright::toolpath
