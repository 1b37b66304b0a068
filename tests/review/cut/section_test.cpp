#include "review/cut/section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace turnwright::review {
namespace {

const Polygon kSquare = hull({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0.5, 0.5}});

double area(const Polygon& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.z * b.x - a.x * b.z;
  }
  return twice / 2;
}

// A convex K swept along v covers area K + |v| width of K across v; inwards by d it loses
// d (perimeter) - d^2 sum of 1/tan of half its angles.
TEST(Section, SweepsAndErosionsHaveTheirAreas) {
  EXPECT_DOUBLE_EQ(area(kSquare), 1);
  EXPECT_DOUBLE_EQ(area(swept(kSquare, {0, 0}, {0, 3})), 4);
  EXPECT_NEAR(area(swept(kSquare, {5, 5}, {7, 7})), 1 + 4, 1e-12);
  EXPECT_NEAR(area(eroded(kSquare, 0.1)), 0.64, 1e-12);
  EXPECT_TRUE(eroded(kSquare, 0.51).empty());
  const auto triangle = hull({{0, 0}, {3, 0}, {0, 4}});  // its circle has a radius of 1
  EXPECT_NEAR(area(eroded(triangle, 0.5)), 6 / 4.0, 1e-12);
}

TEST(Section, ConvexPolygonsOverlapOnlyInside) {
  const auto at = [](double x, double z) { return swept(kSquare, {x, z}, {x, z}); };
  EXPECT_FALSE(overlap(kSquare, at(1, 0)));
  EXPECT_TRUE(overlap(kSquare, at(1 - 1e-9, 0)));
  EXPECT_TRUE(overlap(kSquare, hull({{-5, 0.5}, {5, 0.5}, {5, 0.6}, {-5, 0.6}})));
  const auto leaning = hull({{1.6, 0.5}, {0.6, 1.5}, {1.6, 1.5}});  // x + z >= 2.1
  EXPECT_FALSE(overlap(kSquare, leaning));
}

// A disc of radius 1 along a line at 45 deg leaves x = z +- sqrt 2.
TEST(Section, LinesAreCutExactly) {
  Section s({0, 0}, {10, 10}, 0.5);
  s.fill({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  Polygon disc;
  for (int i = 0; i < 4000; ++i)
    disc.push_back({std::sin(i * M_PI / 2000), std::cos(i * M_PI / 2000)});
  s.cut(swept(hull(disc), {-5, -5}, {15, 15}));
  for (const auto* lines : {&s.columns, &s.rows})
    for (std::size_t i = 0; i < lines->size(); ++i) {
      const double at = lines->at(i), w = std::sqrt(2);
      const auto& on = lines->on(i);
      if (at < w || at > 10 - w) continue;
      ASSERT_EQ(on.size(), 2u);
      EXPECT_NEAR(on[0].to, at - w, 1e-6);
      EXPECT_NEAR(on[1].from, at + w, 1e-6);
    }
}

TEST(Section, WhatCrossesTheAxisCutsTheOtherHalfToo) {
  Section s({0, 0}, {10, 10}, 0.5);
  s.fill({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  s.cut(hull({{-3, 4}, {1, 4}, {1, 6}, {-3, 6}}));
  EXPECT_EQ(s.columns.on(10)[0].from, 3);
  EXPECT_EQ(s.columns.on(2)[0].from, 0);
  EXPECT_EQ(s.rows.on(4).size(), 2u);  // at a radius between 2 and 3
  EXPECT_NEAR(s.depth(hull({{2, 4}, {4, 4}, {4, 6}, {2, 6}})), 1, 1e-12);
  EXPECT_EQ(s.depth(hull({{2, 4}, {3, 4}, {3, 6}, {2, 6}})), 0);
}

TEST(Section, WhatIsPartedOffFalls) {
  Section s({0, 0}, {2, 10}, 0.5);
  s.fill({{0, 0}, {2, 0}, {2, 10}, {0, 10}});
  s.cut(hull({{0, 3}, {2, 3}, {2, 4}, {0, 4}}));
  s.drop_loose(7);
  EXPECT_TRUE(s.columns.on(2).empty());
  EXPECT_FALSE(s.columns.on(8).empty());
  ASSERT_EQ(s.rows.on(1).size(), 1u);
  EXPECT_EQ(s.rows.on(1)[0].from, 4);
}

TEST(Section, IntervalsLessOthers) {
  const auto rest = without({{0, 4}, {5, 6}}, {{1, 2}, {3, 5.5}});
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest[0].to, 1);
  EXPECT_EQ(rest[1].from, 2);
  EXPECT_EQ(rest[2].from, 5.5);
}

}  // namespace
}  // namespace turnwright::review
