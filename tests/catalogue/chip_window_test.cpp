#include "turnwright/catalogue/chip_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace turnwright::catalogue {
namespace {

using Polygon = std::vector<ChipPoint>;

// An L, its inward corner at (1, 0.2); a star; a convex chart that opens with the depth.
const Polygon kL{{0.5, 0.1}, {4, 0.1}, {4, 0.2}, {1, 0.2}, {1, 0.5}, {0.5, 0.5}};
const Polygon kStar{{1, 0.1}, {1.2, 0.18}, {4, 0.2},   {1.3, 0.25},
                    {1, 0.6}, {0.8, 0.25}, {0.3, 0.2}, {0.85, 0.18}};
const Polygon kConvex{{0.5, 0.1}, {4, 0.16}, {5, 0.4}, {2, 0.5}, {0.4, 0.25}};

Polygon reversed(Polygon p) { return {p.rbegin(), p.rend()}; }

// Turns of the polygon, straight in logarithms, about a point.
bool inside(const Polygon& p, const ChipPoint& x) {
  double angle = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto at = [&](const ChipPoint& q) {
      return std::pair{std::log(q.ap_mm / x.ap_mm), std::log(q.f_mm_rev / x.f_mm_rev)};
    };
    const auto [ax, ay] = at(p[i]);
    const auto [bx, by] = at(p[(i + 1) % p.size()]);
    angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
  }
  return std::abs(angle) > 3;
}

TEST(ChipWindow, PiecesTogetherAreThePolygon) {
  std::mt19937 seed(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto& p : {kL, kStar, kConvex, reversed(kStar), reversed(kConvex)}) {
    ASSERT_TRUE(is_simple(p));
    const auto pieces = convex_pieces(p);
    int in = 0;
    for (int k = 0; k < 4000; ++k) {
      const ChipPoint x{0.2 * std::pow(40, unit(seed)), 0.05 * std::pow(20, unit(seed))};
      int holding = 0;
      for (const auto& piece : pieces) holding += holds(piece, x);
      EXPECT_EQ(holding > 0, inside(p, x)) << x.ap_mm << ' ' << x.f_mm_rev;
      EXPECT_LE(holding, 1);
      in += holding;
    }
    EXPECT_GT(in, 100);
  }
}

TEST(ChipWindow, ConvexOnesAreTheirOwnPiece) {
  EXPECT_EQ(convex_pieces(kConvex).size(), 1u);
  EXPECT_EQ(convex_pieces(kL).size(), 2u);
  EXPECT_LE(convex_pieces(kStar).size(), 9u);  // four inward corners, two cuts each
}

TEST(ChipWindow, CornersAreHeldByRounding) {
  for (const auto& p : {kL, kStar, kConvex})
    for (const auto& corner : p) {
      int holding = 0;
      for (const auto& piece : convex_pieces(p)) holding += holds(piece, corner);
      EXPECT_GE(holding, 1);
    }
}

// Whichever corner it begins with, either way round and with its axes exchanged.
bool simple(std::vector<ChipPoint> p) {
  const bool is = is_simple(p);
  for (int exchanged = 0; exchanged < 2; ++exchanged) {
    for (int reversed = 0; reversed < 2; ++reversed) {
      for (std::size_t first = 0; first < p.size(); ++first) {
        EXPECT_EQ(is_simple(p), is);
        std::rotate(p.begin(), p.begin() + 1, p.end());
      }
      std::reverse(p.begin(), p.end());
    }
    for (auto& v : p) v = {v.f_mm_rev, v.ap_mm};
  }
  return is;
}

TEST(ChipWindow, WhatIsNoAreaIsNotSimple) {
  EXPECT_FALSE(simple({{1, 0.1}, {2, 0.2}}));
  EXPECT_FALSE(simple({{1, 0.1}, {2, 0.2}, {4, 0.4}}));            // on one line
  EXPECT_FALSE(simple({{1, 0.1}, {2, 0.2}, {2, 0.1}, {1, 0.2}}));  // crosses itself
  EXPECT_FALSE(simple({{1, 0.1}, {1, 0.1}, {2, 0.1}, {2, 0.2}}));  // a corner twice
  EXPECT_FALSE(simple({{1, 0.1}, {4, 0.1}, {2, 0.1}, {2, 0.3}}));  // runs back
  EXPECT_TRUE(simple({{1, 0.1}, {2, 0.1}, {4, 0.1}, {4, 0.3}}));   // straight corner
  for (const auto& p : {kL, kStar, kConvex}) EXPECT_TRUE(simple(p));
}

// A notch down to an edge, and one whose sides stand on the same line.
TEST(ChipWindow, TouchingItselfIsNotSimpleStandingOnALineIs) {
  EXPECT_FALSE(simple({{1, 0.1}, {4, 0.1}, {4, 0.4}, {2, 0.1}, {1, 0.4}}));
  EXPECT_TRUE(simple({{1, 0.1}, {4, 0.1}, {4, 0.4}, {2, 0.11}, {1, 0.4}}));
  EXPECT_TRUE(simple(
      {{1, 0.1}, {2, 0.1}, {2, 0.2}, {3, 0.2}, {3, 0.1}, {4, 0.1}, {4, 0.4}, {1, 0.4}}));
}

}  // namespace
}  // namespace turnwright::catalogue
