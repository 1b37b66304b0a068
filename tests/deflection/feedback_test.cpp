#include "turnwright/deflection/feedback.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "finite_elements.hpp"
#include "random_shafts.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::deflection {
namespace {

// A place with f_ww = 1e-3 mm/N and nothing else.
constexpr Flexibility kYielding{1e-3, 0, 0, 0, 0};

TEST(Feedback, LinearForceGivesMuOverOnePlusMu) {
  for (const double mu : {1e-6, 0.1, 0.75, 1.0, 3.7, 50.0, 1e6}) {
    const Equilibrium e = equilibrium(40, kYielding, {}, {mu * 1e3, 1, 0, 0, 1.5});
    EXPECT_NEAR(e.loop_gain / mu, 1, 1e-14);
    EXPECT_NEAR(e.radius_error_mm / (1.5 * mu / (1 + mu)), 1, 1e-13);
    EXPECT_NEAR(e.Fr_N / (1e3 * 1.5 * mu / (1 + mu)), 1, 1e-13);
    EXPECT_NEAR(e.radius_error_without_feedback_mm / (1.5 * mu), 1, 1e-14);
  }
}

TEST(Feedback, ForceAndDeflectionAgreeAtTheAnswer) {
  const Flexibility r{8e-3, 6e-5, 7e-7, 0, 0}, t{9e-3, 0, 0, 0, 0};
  for (const double x : {0.3, 0.75, 1.0, 1.3, 2.0})
    for (const double c : {0.01, 20.0, 220.0, 1e5})
      for (const double ap : {0.05, 1.0, 4.0})
        for (const double D : {8.0, 40.0}) {
          const ForceLaw law{c, x, 0.6, 2.2, ap};
          const Equilibrium e = equilibrium(D, r, t, law);
          const double h = ap - e.radius_error_mm, delta_t = 9e-3 * 2.2 * e.Fr_N;
          const double deflected =
              8e-3 * e.Fr_N - 6e-5 * 0.6 * e.Fr_N * D / 2 + delta_t * delta_t / D;
          EXPECT_NEAR(e.radius_error_mm / deflected, 1, 1e-12);
          // the force, told back as a depth
          EXPECT_NEAR(std::pow(e.Fr_N / c, 1 / x), h, 1e-12 * ap);
          EXPECT_LE(e.radius_error_mm, e.radius_error_without_feedback_mm);
        }
}

TEST(Feedback, EquilibriumOnRealShaftsUpToLoopGain3Point7) {
  // the part as finite elements see it under the force that comes back: what it gives way
  // by and what the force law says of the depth left are one number
  const double D = 30, ap = 1.2, Fa_over_Fr = 0.7, Ft_over_Fr = 2.3;
  for (const auto& [name, shaft] : random_shafts::all(43)) {
    const Beam beam(shaft);
    const std::vector<double> a{0.4 * beam.length_mm(), 0.9 * beam.length_mm()};
    const Supports s = random_shafts::supports().back();
    const auto elements = finite_elements::flexibilities(shaft, a, s);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (const double mu : {0.05, 0.9, 3.7})
        for (const double x : {0.75, 1.0}) {
          const Flexibility f = beam.at(a[i], s);
          const double A = f.f_ww_mm_N - f.f_wp_rad_N * Fa_over_Fr * D / 2;
          if (!(A > 0)) continue;  // the couple pulls the part in: another test
          const ForceLaw law{mu / (A * x * std::pow(ap, x - 1)), x, Fa_over_Fr,
                             Ft_over_Fr, ap};
          const Equilibrium e = equilibrium(D, f, f, law);
          EXPECT_NEAR(e.loop_gain / mu, 1, 1e-12) << name;
          const Load load{e.Fr_N, Ft_over_Fr * e.Fr_N, Fa_over_Fr * e.Fr_N};
          const double given =
              response(a[i], D, elements[i], elements[i], load).radius_error_mm;
          EXPECT_NEAR(e.radius_error_mm, given, 1e-10 * ap) << name;
          EXPECT_NEAR(law.c_N * std::pow(ap - given, x), e.Fr_N,
                      1e-10 * law.c_N * std::pow(ap, x))
              << name;
        }
  }
}

TEST(Feedback, LoopGainIsTheSlopeOfTheUncoupledErrorInTheDepth) {
  // B = 0: de/dap of e = A c ap^x
  for (const double x : {0.75, 1.0, 1.6}) {
    const auto uncoupled = [&](double ap) {
      return equilibrium(40, kYielding, {}, {220, x, 0, 0, ap})
          .radius_error_without_feedback_mm;
    };
    const double slope = (uncoupled(2 + 1e-5) - uncoupled(2 - 1e-5)) / 2e-5;
    EXPECT_NEAR(equilibrium(40, kYielding, {}, {220, x, 0, 0, 2}).loop_gain / slope, 1,
                1e-9);
  }
}

TEST(Feedback, TakingTurnsDivergesWhereNewtonDoesNot) {
  const double mu = 3.7, ap = 1;
  double e = 0;
  for (int turn = 0; turn < 20; ++turn) e = mu * (ap - e);
  EXPECT_GT(std::abs(e), 1e6);
  EXPECT_NEAR(equilibrium(40, kYielding, {}, {mu * 1e3, 1, 0, 0, ap}).radius_error_mm,
              mu / (1 + mu), 1e-14);
}

TEST(Feedback, ACoupleThatPullsInCutsDeeper) {
  // A = 1e-3 - 2e-4 0.6 40/2 = -1.4e-3
  const Flexibility r{1e-3, 2e-4, 0, 0, 0};
  const Equilibrium e = equilibrium(40, r, {}, {100, 1, 0.6, 0, 1});
  EXPECT_NEAR(e.loop_gain, -0.14, 1e-15);
  EXPECT_NEAR(e.radius_error_mm, -0.14 / (1 - 0.14), 1e-14);
  // x = 2: h - 0.14 h^2 = 1 has two solutions; the tool meets the smaller one first
  const double h = (1 - std::sqrt(1 - 4 * 0.14)) / (2 * 0.14);
  EXPECT_NEAR(equilibrium(40, r, {}, {100, 2, 0.6, 0, 1}).radius_error_mm, 1 - h, 1e-13);
  EXPECT_THROW(equilibrium(40, r, {}, {1000, 1, 0.6, 0, 1}), ModelRangeError);
}

TEST(Feedback, EveryPassAlsoCutsWhatTheLastOneLeft) {
  const double mu = 0.75;
  const std::vector<double> ap{2, 2, 0.5, 0.1};
  const auto e = radius_errors_of_passes(40, kYielding, {}, {mu * 1e3, 1, 0, 0, 0}, ap);
  ASSERT_EQ(e.size(), ap.size());
  double left = 0;
  for (std::size_t n = 0; n < ap.size(); ++n) {
    left = mu / (1 + mu) * (ap[n] + left);
    EXPECT_NEAR(e[n], left, 1e-14);
  }
}

TEST(Feedback, SpringPassesTakeMuOverOnePlusMuEach) {
  for (const double mu : {0.05, 0.75, 3.7}) {
    const auto e = radius_errors_of_passes(40, kYielding, {}, {mu * 1e3, 1, 0, 0, 0},
                                           std::vector<double>{1.5, 0, 0, 0});
    for (std::size_t k = 0; k < e.size(); ++k)
      EXPECT_NEAR(e[k], 1.5 * std::pow(mu / (1 + mu), static_cast<double>(k + 1)), 1e-13);
  }
  // nothing left, nothing to cut
  EXPECT_EQ(radius_errors_of_passes(40, {}, {}, {200, 0.8, 0.6, 2.2, 0},
                                    std::vector<double>{2, 0, 0}),
            (std::vector<double>{0, 0, 0}));
  EXPECT_THROW(radius_errors_of_passes(40, kYielding, {}, {200, 1, 0, 0, 0},
                                       std::vector<double>{1, -0.1}),
               std::domain_error);
}

TEST(Feedback, ARigidPartIsCutAsSet) {
  const Equilibrium e = equilibrium(40, {}, {}, {200, 0.8, 0.6, 2.2, 2});
  EXPECT_EQ(e.radius_error_mm, 0);
  EXPECT_EQ(e.loop_gain, 0);
  EXPECT_NEAR(e.Fr_N, 200 * std::pow(2, 0.8), 1e-11);
}

TEST(Feedback, RefusesWhatIsNoCut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ForceLaw& law :
       {ForceLaw{0, 1, 0, 0, 1}, ForceLaw{1, 0, 0, 0, 1}, ForceLaw{1, 1, 0, 0, 0},
        ForceLaw{nan, 1, 0, 0, 1}, ForceLaw{1, 1, 0, 0, nan}})
    EXPECT_THROW(equilibrium(40, kYielding, {}, law), std::domain_error);
  EXPECT_THROW(equilibrium(0, kYielding, {}, {1, 1, 0, 0, 1}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
