#include "turnwright/volumetric/positioning.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace turnwright::volumetric::positioning_test {
namespace {

using Five = std::array<double, 5>;

/// Five approaches about a mean, whose standard deviation is sqrt(10/4) of the step.
std::vector<double> about(double mean, double step) {
  return {mean - 2 * step, mean - step, mean, mean + step, mean + 2 * step};
}
const double kRoot = std::sqrt(2.5);

// Two positions in closed form: means 1 and 4 in +, 2 and -1 in -, steps 0.1, 0.2, 0.3, 0.1.
TEST(Positioning, ValuesOfIso230_2InClosedForm) {
  const std::vector<Target> all{{0, about(1, 0.1), about(2, 0.2)},
                                {300, about(4, 0.3), about(-1, 0.1)}};
  const Iso230_2 v = iso230_2(all);
  ASSERT_EQ(v.positions.size(), 2u);
  EXPECT_NEAR(*v.positions[0].B_mm, -1, 1e-15);
  EXPECT_NEAR(*v.positions[1].B_mm, 5, 1e-15);
  EXPECT_NEAR(*v.positions[0].mean_mm, 1.5, 1e-15);
  EXPECT_NEAR(*v.positions[0].s_minus_mm, 0.2 * kRoot, 1e-15);
  EXPECT_EQ(v.positions[0].approaches_plus, 5u);
  EXPECT_NEAR(*v.positions[0].R_mm, 0.6 * kRoot + 1, 1e-15);
  EXPECT_NEAR(*v.positions[1].R_mm, 0.8 * kRoot + 5, 1e-14);
  EXPECT_NEAR(*v.B_mm, 5, 1e-15);
  EXPECT_NEAR(*v.B_mean_mm, 2, 1e-15);
  EXPECT_NEAR(*v.R_plus_mm, 1.2 * kRoot, 1e-15);
  EXPECT_NEAR(*v.R_minus_mm, 0.8 * kRoot, 1e-15);
  EXPECT_NEAR(*v.R_mm, 0.8 * kRoot + 5, 1e-14);
  EXPECT_NEAR(v.M->width_mm(), 0, 1e-15);
  EXPECT_NEAR(v.E_plus->width_mm(), 3, 1e-15);
  EXPECT_NEAR(v.E_minus->width_mm(), 3, 1e-15);
  EXPECT_NEAR(v.E->width_mm(), 5, 1e-15);
  EXPECT_NEAR(v.A_plus->low_mm, 1 - 0.2 * kRoot, 1e-15);
  EXPECT_NEAR(v.A_plus->high_mm, 4 + 0.6 * kRoot, 1e-14);
  EXPECT_NEAR(v.A_minus->width_mm(), 3 + 0.6 * kRoot, 1e-14);
  EXPECT_NEAR(v.A->width_mm(), 5 + 0.8 * kRoot, 1e-14);
}

// Where one direction scatters far more than the other and there is no reversal, 4 s of it is
// more than 2 s of both.
TEST(Positioning, RepeatabilityOfBothDirectionsIsNoLessThanThatOfEach) {
  const std::vector<Target> one{{0, about(0, 1), about(0, 0.1)}};
  EXPECT_NEAR(*iso230_2(one).R_mm, 4 * kRoot, 1e-14);
}

// The report of a motion test by a program of the Paul Scherrer Institute (ecmccfg,
// examples/test/fat_sat/report.md), which prints the readings [mm] and what it makes of them.
// Its R, 62.9 nm, is that of one direction, and its E, 24.6 nm, that of the forward direction;
// its own R_i and means give 68.82 and 36.8 nm.
TEST(Positioning, APublicReportIsReproduced) {
  const std::array<double, 5> q{-10, -4.88, 0.24, 5.36, 10.48};
  const std::array<Five, 5> forward{
      {{-10.00008102, -10.00010202, -10.00008702, -10.00009202, -10.00010002},
       {-4.88008702, -4.88009702, -4.88009702, -4.88009502, -4.88008202},
       {0.23992798, 0.23990998, 0.23991198, 0.23991298, 0.23991298},
       {5.35989798, 5.35991398, 5.35991398, 5.35990698, 5.35992198},
       {10.47989998, 10.47988798, 10.47987098, 10.47989098, 10.47990298}}};
  const std::array<Five, 5> backward{
      {{-10.00009902, -10.00009402, -10.00008202, -10.00009102, -10.00009402},
       {-4.88010302, -4.88010402, -4.88009502, -4.88011102, -4.88009302},
       {0.23991398, 0.23989798, 0.23990898, 0.23992398, 0.23990098},
       {5.35992798, 5.35990798, 5.35990498, 5.35989698, 5.35991898},
       {10.47989598, 10.47987398, 10.47986998, 10.47985898, 10.47989298}}};
  AxisTable t;
  for (std::size_t run = 0; run < 5; ++run)
    for (std::size_t i = 0; i < q.size(); ++i) {
      t.q.push_back(q[i]);
      t.plus.push_back(forward[i][run] - q[i]);
      t.minus.push_back(backward[i][run] - q[i]);
    }
  const Iso230_2 v = iso230_2(targets(t));
  const auto near = [](double value, double printed, double half_digit) {
    EXPECT_NEAR(value, printed, half_digit);
  };
  const std::array<double, 5> B{-4e-7, 9.6e-6, 6e-6, -4e-7, 1.22e-5},
      s_plus{8.79e-6, 6.77e-6, 7.26e-6, 9e-6, 1.258e-5},
      s_minus{6.28e-6, 7.29e-6, 1.043e-5, 1.218e-5, 1.573e-5},
      R{3.517e-5, 3.772e-5, 4.17e-5, 4.871e-5, 6.882e-5};
  for (std::size_t i = 0; i < q.size(); ++i) {
    near(*v.positions[i].B_mm, B[i], 1e-13);
    near(*v.positions[i].s_plus_mm, s_plus[i], 5e-9);
    near(*v.positions[i].s_minus_mm, s_minus[i], 5e-9);
    near(*v.positions[i].R_mm, R[i], 5e-9);
  }
  near(*v.B_mm, 1.22e-5, 1e-13);
  near(*v.B_mean_mm, 5.4e-6, 1e-13);
  near(*v.R_plus_mm, 5.033e-5, 5e-9);
  near(*v.R_minus_mm, 6.29e-5, 5e-9);
  near(v.E_plus->width_mm(), 2.46e-5, 1e-13);
  near(v.E_minus->width_mm(), 3.3e-5, 1e-13);
  near(v.M->width_mm(), 2.77e-5, 1e-13);
  near(v.A_plus->width_mm(), 6.428e-5, 5e-9);
  near(v.A_minus->width_mm(), 8.881e-5, 5e-9);
  near(v.A->width_mm(), 8.881e-5, 5e-9);
  near(*v.R_mm, 6.882e-5, 5e-9);
  near(v.E->width_mm(), 3.68e-5, 1e-13);
}

// The order of rows does not count, nor does a shift of all readings.
TEST(Positioning, PositionsAreSortedAndShiftsDoNotCount) {
  const AxisTable t{{100, 0, 100, 0}, {1, 2, 3, 5}, {0, 0, 1, 1}};
  const auto all = targets(t);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].q_mm, 0);
  EXPECT_EQ(all[0].plus_mm, (std::vector<double>{2, 5}));
  EXPECT_EQ(all[1].minus_mm, (std::vector<double>{0, 1}));
  AxisTable shifted = t;
  for (auto* column : {&shifted.plus, &shifted.minus})
    for (double& x : *column) x += 64;
  const Iso230_2 a = iso230_2(all), b = iso230_2(targets(shifted));
  EXPECT_NEAR(a.A->width_mm(), b.A->width_mm(), 1e-12);
  EXPECT_NEAR(*a.R_mm, *b.R_mm, 1e-12);
  EXPECT_NEAR(b.M->low_mm - a.M->low_mm, 64, 1e-12);
}

TEST(Positioning, WhatCannotBeKnownIsMissing) {
  const Iso230_2 once = iso230_2(targets({{0, 1}, {3, 5}, {2, 2}}));
  EXPECT_NEAR(once.E->width_mm(), 3, 1e-15);
  EXPECT_NEAR(*once.B_mm, 3, 1e-15);
  EXPECT_FALSE(once.R_plus_mm || once.R_mm || once.A || once.A_minus);
  const Iso230_2 one_way = iso230_2(targets({{0, 0, 1, 1}, {3, 4, 5, 6}, {}}));
  EXPECT_NEAR(one_way.E_plus->width_mm(), 2, 1e-15);
  EXPECT_NEAR(*one_way.R_plus_mm, 4 * std::sqrt(0.5), 1e-15);
  EXPECT_TRUE(one_way.A_plus);
  EXPECT_FALSE(one_way.E || one_way.B_mm || one_way.M || one_way.R_mm || one_way.A ||
               one_way.E_minus);
  // One position without a second reading takes the axis' value with it.
  const std::vector<Target> gap{{0, {1, 2}, {1, 2}}, {5, {1}, {1, 2}}};
  EXPECT_FALSE(iso230_2(gap).R_plus_mm);
  EXPECT_TRUE(iso230_2(gap).R_minus_mm);
  EXPECT_TRUE(iso230_2({}).positions.empty());
  EXPECT_FALSE(iso230_2({}).M);
}

TEST(Positioning, PositionsThatAreWanted) {
  EXPECT_EQ(positions_wanted(0), 5u);
  EXPECT_EQ(positions_wanted(1000), 5u);
  EXPECT_EQ(positions_wanted(1001), 6u);
  EXPECT_EQ(positions_wanted(2000), 10u);
  EXPECT_EQ(positions_wanted(3000), 13u);
}

TEST(Positioning, ApproachesThatAreWanted) {
  EXPECT_EQ(approaches_wanted(300), 5u);
  EXPECT_EQ(approaches_wanted(2000), 5u);
  EXPECT_EQ(approaches_wanted(2001), 1u);
}

TEST(Positioning, EvenIntervalsAreSeen) {
  const auto at = [](std::vector<double> q) {
    AxisTable t{q, std::vector<double>(q.size()), {}};
    return evenly_spaced(targets(t));
  };
  EXPECT_TRUE(at({0, 0.1, 0.2, 0.1 + 0.2}));
  EXPECT_TRUE(at({-30, 0, 30}));
  EXPECT_FALSE(at({0, 10, 20.001}));
  EXPECT_FALSE(at({0, 10}));
}

// catalogue/geometric_errors.hpp (1) term by term.
TEST(Positioning, AnErrorAtAPosition) {
  const ErrorFunction e{{1, 10, 100, 1000}, 0.5, {{2, 0}, {0, 3}}};
  EXPECT_NEAR(error_at(e, 0, 100, 1), 3.5, 1e-15);
  EXPECT_NEAR(error_at({{1, 10, 100, 1000}, 0.5, {}}, 50, 100, -1),
              1 + 5 + 25 + 125 - 0.5, 1e-12);
  EXPECT_NEAR(error_at({{}, 0, {{2, 0}, {0, 3}}}, std::acos(0.5), 1, 0),
              1 + 3 * std::sqrt(3) / 2, 1e-14);
}

}  // namespace
}  // namespace turnwright::volumetric::positioning_test
