#include "turnwright/chatter/reference_methods.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "cutters.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

double first_loss(const System& s, double n_rpm, double deepest,
                  const std::function<Dominant(double)>& method) {
  return scanned_limits(s, n_rpm, deepest, 12, method).limit_mm().value_or(NAN);
}

double tfea_limit(double n_rpm, double deepest, int elements) {
  const System s = slot_cutter();
  return first_loss(s, n_rpm, deepest, [&](double w) {
    return time_finite_elements(s, n_rpm, w, elements);
  });
}

/// Half a unit of the fourth digit.
double half_a_digit(double value) {
  return 0.5 * std::pow(10, std::floor(std::log10(value)) - 3) * (1 + 1e-9);
}

// Limits of the slot cutter by E elements, from an implementation apart from this one.
TEST(TimeFiniteElements, ReproduceTheirTable) {
  const struct {
    double n_rpm;
    std::array<double, 4> limit_mm;  // of 6, 10, 14 and 40 elements
  } rows[] = {{5000, {12.94, 5.825, 5.544, 5.454}},
              {10000, {4.864, 5.065, 5.092, 5.102}},
              {15000, {26.95, 26.55, 26.49, 26.47}},
              {18000, {56.87, 56.15, 56.03, 55.98}}};
  constexpr std::array<int, 4> kElements{6, 10, 14, 40};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(tfea_limit(row.n_rpm, 60, kElements[i]), row.limit_mm[i],
                  half_a_digit(row.limit_mm[i]))
          << row.n_rpm << " " << kElements[i];
}

TEST(TimeFiniteElements, ConvergeWithTheFourthPower) {
  const double exact = speed_limits(slot_cutter(), 15000, 30).limit_mm().value();
  const double coarse = std::abs(tfea_limit(15000, 30, 24) - exact);
  const double fine = std::abs(tfea_limit(15000, 30, 48) - exact);
  EXPECT_GT(std::log2(coarse / fine), 3.9);
}

TEST(SemiDiscretisation, ConvergesWithTheSecondPower) {
  const System s = benchmark(Directions::two, down_milling(1));
  const double exact = speed_limits(s, 10000, 0.1).limit_mm().value();
  const auto error = [&](int intervals) {
    return std::abs(first_loss(s, 10000, 0.1,
                               [&](double w) {
                                 return semi_discretisation(s, 10000, w, intervals);
                               }) -
                    exact);
  };
  const double coarse = error(40), fine = error(80);
  EXPECT_LT(fine, 0.002 * exact);
  EXPECT_GT(std::log2(coarse / fine), 1.9);
}

TEST(SemiDiscretisation, CountsTheSixOfTheDeepSlot) {
  const System s = benchmark(Directions::two, down_milling(1));
  EXPECT_EQ(semi_discretisation(s, 9000, 5, 160).unstable, 6);
}

TEST(Simulation, AgreesOnGrowthAndVerdict) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  const struct {
    System system;
    double deepest;
  } cases[] = {{benchmark(Directions::one, down_milling(0.1)), 4},
               {benchmark(Directions::one, down_milling(1)), 1},
               {benchmark(Directions::one, down_milling(0.05)), 5},
               {benchmark(Directions::two, down_milling(0.1)), 2},
               {benchmark(Directions::two, down_milling(0.05)), 4},
               {benchmark(Directions::two, down_milling(1)), 0.2},
               {slot_cutter(), 30}};
  for (const auto& c : cases)
    for (int i = 0; i < 10; ++i) {
      const double n = 5000 + 20000 * share(random), w = c.deepest * share(random);
      const Multipliers right = multipliers(c.system, n, w);
      const double growth = std::abs(simulation(c.system, n, w).multiplier);
      EXPECT_NEAR(growth, right.spectral_radius, 1e-3 * right.spectral_radius)
          << n << " " << w;
      if (std::abs(right.spectral_radius - 1) > 1e-3) {
        EXPECT_EQ(growth > 1, right.unstable > 0) << n << " " << w;
      }
    }
}

// A kilobyte a step: the period is refused before its memory is taken.
TEST(Simulation, RefusesAPeriodOfTooManySteps) {
  const System s = slot_cutter();
  const double steps = simulation_steps(s, 100);
  EXPECT_NEAR(simulation_steps(s, 50), 2 * steps, 2);  // whole steps on each arc
  EXPECT_THROW(simulation(s, 100, 0.1, {.most_steps = steps - 1}), ModelRangeError);
  EXPECT_NO_THROW(simulation(s, 100, 0.1, {.periods = 12, .most_steps = steps}));
  EXPECT_THROW(simulation(s, 1, 0.1), ModelRangeError);
}

}  // namespace
}  // namespace turnwright::chatter
