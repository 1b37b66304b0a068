#include "turnwright/deflection/shop_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "turnwright/base/units.hpp"
#include "turnwright/deflection/feedback.hpp"

namespace turnwright::deflection {
namespace {

using units::rad_from_deg;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Heat, AWarmPartIsMeasuredSmaller) {
  // steel, 11.5e-6/K, 20 K, 60 mm: the diameter shrinks by 13.8 um
  EXPECT_NEAR(2 * heat_error_mm(11.5e-6, 20, 60), -0.0138, 1e-15);
  EXPECT_EQ(heat_error_mm(11.5e-6, 0, 60), 0);
  EXPECT_GT(heat_error_mm(11.5e-6, -5, 60), 0);
  EXPECT_THROW(heat_error_mm(-1e-6, 1, 60), std::domain_error);
  EXPECT_THROW(heat_error_mm(1e-6, kNotANumber, 60), std::domain_error);
  EXPECT_THROW(heat_error_mm(1e-6, 1, 0), std::domain_error);
}

/// The wedge drawn: where the land meets the rake face and the flank, sharp corner at
/// the origin, x back along the land, y away from the surface.
double land(double recession, double alpha, double gamma) {
  const double on_rake = recession * std::tan(gamma);
  const double on_flank = recession / std::tan(alpha);
  return on_flank - on_rake;
}

TEST(Wear, TheLandOnTheWedgeIsVB) {
  for (const double alpha : {3.0, 7.0, 15.0})
    for (const double gamma : {-10.0, -6.0, 0.0, 8.0, 20.0}) {
      const Edge edge{rad_from_deg(alpha), rad_from_deg(gamma)};
      EXPECT_NEAR(land(wear_error_mm(0.3, edge, 1), edge.alpha_o_rad, edge.gamma_o_rad),
                  0.3, 1e-14);
    }
  // without rake VB tan(alpha); a positive rake gives way more
  EXPECT_NEAR(wear_error_mm(0.3, {rad_from_deg(7), 0}, 1), 0.3 * 0.1227845609, 1e-11);
  EXPECT_GT(wear_error_mm(0.3, {rad_from_deg(7), rad_from_deg(10)}, 1),
            wear_error_mm(0.3, {rad_from_deg(7), 0}, 1));
}

TEST(Wear, GrowsWithTheLifeUsed) {
  const Edge edge{rad_from_deg(6), rad_from_deg(-6)};
  EXPECT_EQ(wear_error_mm(0.3, edge, 0), 0);
  EXPECT_NEAR(wear_error_mm(0.3, edge, 0.25), wear_error_mm(0.3, edge, 1) / 4, 1e-16);
  EXPECT_EQ(wear_error_mm(0, edge, 1), 0);
}

TEST(Wear, RefusesWhatIsNoWedge) {
  EXPECT_THROW(wear_error_mm(-0.1, {0.1, 0}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {0, 0}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {0.8, 0.8}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {1.6, -1}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {0.1, -1.6}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {0.1, kNotANumber}, 1), std::domain_error);
  EXPECT_THROW(wear_error_mm(0.1, {0.1, 0}, 1.1), std::domain_error);
  EXPECT_THROW(wear_error_mm(kNotANumber, {0.1, 0}, 1), std::domain_error);
}

TEST(Toolpost, LumpedStiffnessAndACrossTerm) {
  EXPECT_NEAR(toolpost_error_mm({1 / 5e4, -4e-6}, {500, 1000, 77}), 0.01 - 0.004, 1e-16);
  EXPECT_THROW(toolpost_error_mm({-1e-6, 0}, {}), std::domain_error);
}

TEST(Toolpost, InTheLoopItAddsToThePart) {
  const Flexibility part{2e-5, 1e-7, 1e-9, 0, 0};
  const Toolpost post{1 / 5e4, -4e-6};
  const ForceLaw law{900, 1, 0.5, 2, 1.5};
  const Equilibrium e = equilibrium(40, with_toolpost(part, post, 2), {}, law);
  // e of the part plus e of the post under the force at the answer
  const Load load{e.Fr_N, 2 * e.Fr_N, 0.5 * e.Fr_N};
  const double alone = response(0, 40, part, {}, load).delta_r_mm;
  EXPECT_NEAR(e.radius_error_mm, alone + toolpost_error_mm(post, load), 1e-15);
  EXPECT_NEAR(e.Fr_N, 900 * (1.5 - e.radius_error_mm), 1e-10);
}

}  // namespace
}  // namespace turnwright::deflection
