#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "turnwright/exchange/outline.hpp"

/// Compares the geometry of outlines, for tests that read a drawing back.
namespace turnwright::exchange::compared {

inline constexpr double kSame_mm = 1e-9;

inline void expect_same(const Element& read, const Element& drawn) {
  SCOPED_TRACE(drawn.id);
  EXPECT_EQ(read.id, drawn.id);
  EXPECT_EQ(read.shape, drawn.shape);
  EXPECT_NEAR(read.length_mm, drawn.length_mm, kSame_mm);
  EXPECT_NEAR(read.left_mm, drawn.left_mm, kSame_mm);
  EXPECT_NEAR(read.right_mm, drawn.right_mm, kSame_mm);
  EXPECT_NEAR(read.radius_mm, drawn.radius_mm, kSame_mm);
  EXPECT_EQ(read.convex, drawn.convex);
  EXPECT_EQ(read.from, drawn.from);
}

inline void expect_same(const std::vector<Edge>& read, const std::vector<Edge>& drawn) {
  EXPECT_EQ(read.size(), drawn.size());
  for (const Edge& e : drawn) {
    SCOPED_TRACE(e.at);
    const auto found = std::find_if(read.begin(), read.end(), [&](const Edge& r) {
      return r.at == e.at && r.chamfer_mm.has_value() == e.chamfer_mm.has_value() &&
             r.radius_mm.has_value() == e.radius_mm.has_value();
    });
    ASSERT_NE(found, read.end());
    EXPECT_NEAR(found->chamfer_mm.value_or(0), e.chamfer_mm.value_or(0), kSame_mm);
    EXPECT_NEAR(found->angle_deg, e.angle_deg, 1e-7);
    EXPECT_NEAR(found->radius_mm.value_or(0), e.radius_mm.value_or(0), kSame_mm);
    EXPECT_NEAR(found->fillet_mm.value_or(0), e.fillet_mm.value_or(0), kSame_mm);
    EXPECT_EQ(found->undercut, e.undercut);
  }
}

inline void expect_same(const Outline& read, const Outline& drawn) {
  ASSERT_EQ(read.outer.size(), drawn.outer.size());
  ASSERT_EQ(read.inner.size(), drawn.inner.size());
  for (std::size_t i = 0; i < drawn.outer.size(); ++i)
    expect_same(read.outer[i], drawn.outer[i]);
  for (std::size_t i = 0; i < drawn.inner.size(); ++i)
    expect_same(read.inner[i], drawn.inner[i]);
  expect_same(read.edges, drawn.edges);
  ASSERT_EQ(read.centre_holes.size(), drawn.centre_holes.size());
  for (const CentreHole& c : drawn.centre_holes)
    EXPECT_TRUE(std::any_of(read.centre_holes.begin(), read.centre_holes.end(),
                            [&](const CentreHole& r) {
                              return r.at == c.at && r.designation == c.designation;
                            }))
        << c.designation;
}

}  // namespace turnwright::exchange::compared
