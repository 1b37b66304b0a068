#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "turnwright/part/drawing.hpp"

namespace turnwright::part {
namespace {

double between(double low, double high, std::mt19937_64& draw) {
  return low + (high - low) * (static_cast<double>(draw() >> 11) * 0x1p-53);
}

// Elements of lengths that no sum of binary fractions meets, bores from both ends that meet
// in the middle.
Drawing random_drawing(std::mt19937_64& draw) {
  Drawing d;
  const std::size_t steps = 1 + draw() % 20, bores = draw() % 20;
  for (std::size_t i = 0; i < steps; ++i)
    d.outer.push_back(
        {.id = "d" + std::to_string(i), .length_mm = between(0.1, 9, draw)});
  for (std::size_t i = 0; i < bores; ++i) {
    InnerElement e{.id = "b" + std::to_string(i),
                   .from = draw() % 2 == 0 ? End::left : End::right,
                   .length_mm = length_mm(d) / static_cast<double>(bores)};
    e.left_mm = e.right_mm = static_cast<double>(10 + draw() % 3);
    d.inner.push_back(e);
  }
  return d;
}

TEST(LeftEnds, AreThoseOfEachElement) {
  std::mt19937_64 draw(1);
  for (int n = 0; n < 100; ++n) {
    const auto d = random_drawing(draw);
    const auto outer = left_ends_mm(d), inner = inner_left_ends_mm(d);
    ASSERT_EQ(outer.size(), d.outer.size());
    ASSERT_EQ(inner.size(), d.inner.size());
    for (std::size_t i = 0; i < outer.size(); ++i) EXPECT_EQ(outer[i], left_z_mm(d, i));
    for (std::size_t i = 0; i < inner.size(); ++i)
      EXPECT_EQ(inner[i], inner_left_z_mm(d, i));
  }
  EXPECT_TRUE(left_ends_mm({}).empty());
  EXPECT_TRUE(inner_left_ends_mm({}).empty());
}

// By its definition: two bores that touch and differ in diameter there.
TEST(LeftEnds, ShouldersStandWhereBoresOfDifferentDiametersTouch) {
  std::mt19937_64 draw(2);
  std::size_t found = 0;
  for (int n = 0; n < 100; ++n) {
    const auto d = random_drawing(draw);
    const auto all = inner_shoulders(d);
    std::size_t expected = 0;
    for (std::size_t a = 0; a < d.inner.size(); ++a)
      for (std::size_t b = 0; b < d.inner.size(); ++b) {
        const double z = inner_left_z_mm(d, b), da = d.inner[a].right_mm,
                     db = d.inner[b].left_mm;
        if (a == b || std::abs(inner_left_z_mm(d, a) + d.inner[a].length_mm - z) > 1e-6 ||
            da == db)
          continue;
        ASSERT_LT(expected, all.size());
        EXPECT_EQ(all[expected].wider, da > db ? a : b);
        EXPECT_EQ(all[expected].narrower, da > db ? b : a);
        EXPECT_EQ(all[expected].z_mm, z);
        ++expected;
      }
    EXPECT_EQ(all.size(), expected);
    found += expected;
  }
  EXPECT_GT(found, 200u);
}

}  // namespace
}  // namespace turnwright::part
