#include "turnwright/deflection/response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "reference.hpp"

namespace turnwright::deflection {
namespace {

using std::numbers::pi;

TEST(Response, ReferenceFile) {
  for (const auto& c : reference::cases()) {
    const auto mine = responses(Workpiece(c.shaft), c.clamping, c.a_mm, reference::kLoad);
    const auto compare = [&](const std::string& name, double Response::*field) {
      const std::vector<double> expected = c.values.at(name);
      double largest = 0;
      for (const double x : expected) largest = std::max(largest, std::abs(x));
      for (std::size_t i = 0; i < mine.size(); ++i)
        EXPECT_NEAR(mine[i].*field, expected[i], 1e-12 * largest)
            << c.name << ' ' << name;
    };
    compare("D_tool", &Response::D_mm);
    compare("delta_r", &Response::delta_r_mm);
    compare("delta_t", &Response::delta_t_mm);
    compare("theta_r", &Response::theta_r_rad);
    compare("radius_error", &Response::radius_error_mm);
    // the exact distance of the moved axis: the next term is delta_t^2 delta_r/D^2
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const double t = mine[i].delta_t_mm, r = mine[i].delta_r_mm, D = mine[i].D_mm;
      const double exact = c.values.at("radius_error_exact").at(i);
      EXPECT_NEAR(mine[i].radius_error_mm, exact,
                  2.1 * (t * t * std::abs(r) + std::pow(t, 4) / D) / (D * D) + 1e-17);
    }
  }
}

TEST(Response, OfABarInAChuckIsTheTextbooks) {
  const double E = 210000, nu = 0.3, L = 200, D = 40;
  const double EI = E * pi * D * D * D * D / 64;
  const double chi_GA =
      (7 + 6 * nu) / (6 * (1 + nu)) * 2 * (1 + nu) / E / (pi * D * D / 4);
  const Load load{300, 500, 150};
  const std::vector<double> a{50, 200};
  const auto r = responses(Workpiece({E, nu, {{L, D, D, 0, 0}}}), {}, a, load);
  for (const Response& x : r) {
    const double z = x.a_mm, C = -load.Fa_N * D / 2;
    const double f = z * z * z / (3 * EI) + z * chi_GA;
    const double delta_t = f * load.Ft_N;
    EXPECT_NEAR(x.delta_r_mm / (f * load.Fr_N + C * z * z / (2 * EI)), 1, 1e-13);
    EXPECT_NEAR(x.theta_r_rad / (load.Fr_N * z * z / (2 * EI) + C * z / EI), 1, 1e-13);
    EXPECT_NEAR(x.delta_t_mm / delta_t, 1, 1e-13);
    EXPECT_NEAR(x.radius_error_mm, x.delta_r_mm + delta_t * delta_t / D, 1e-18);
    EXPECT_EQ(x.tail_reaction_N, 0);
  }
}

TEST(Response, TheTailTakesForceAndCouple) {
  // between centres by statics alone: R L = Fr a + C
  const Workpiece part({210000, 0.3, {{120, 40, 40, 0, 0}, {80, 30, 30, 0, 0}}});
  const Supports rigid{Method::between_centres, {}, 0, 0};
  const std::vector<double> a{50, 150};
  const auto r = responses(part, {rigid, rigid}, a, {300, 500, 150});
  EXPECT_NEAR(r[0].tail_reaction_N, (300 * 50 - 150 * 20) / 200.0, 1e-11);
  EXPECT_NEAR(r[1].tail_reaction_N, (300 * 150 - 150 * 15) / 200.0, 1e-11);
}

TEST(Response, FeedAwayFromTheChuckTurnsTheCoupleAround) {
  const Workpiece part({210000, 0.3, {{160, 40, 40, 0, 0}}});
  const std::vector<double> a{160};
  const double to = responses(part, {}, a, {200, 0, 100})[0].delta_r_mm;
  const double none = responses(part, {}, a, {200, 0, 0})[0].delta_r_mm;
  const double away = responses(part, {}, a, {200, 0, -100})[0].delta_r_mm;
  EXPECT_LT(to, none);
  EXPECT_NEAR(to + away, 2 * none, 1e-15);
}

TEST(Response, NeedsADiameter) {
  for (const double D : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(response(10, D, {}, {}, {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
