#include "turnwright/deflection/face.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace turnwright::deflection {
namespace {

constexpr Flexibility kEnd{1e-5, 2e-7, 4e-9, 0, 0};

TEST(Face, FormIsTheSectionsRotationTimesTheRadius) {
  // at every radius the rotation is f_wp Fr + f_pp C with Fr = -Ff, C = Fp rho
  const FaceForm face = face_form(kEnd, {2, 20, 90, 260});
  ASSERT_EQ(face.rho_mm.size(), face.g_mm.size());
  EXPECT_EQ(face.rho_mm.front(), 2);
  EXPECT_EQ(face.rho_mm.back(), 20);
  for (std::size_t i = 0; i < face.rho_mm.size(); ++i) {
    const double rho = face.rho_mm[i], rotation = 2e-7 * -90 + 4e-9 * 260 * rho;
    EXPECT_NEAR(face.g_mm[i], rho * rotation, 1e-18);
  }
}

TEST(Face, TheVertexBetweenCounts) {
  // vertex at f_wp Ff/(2 f_pp Fp) = 8.65, g = -(f_wp Ff)^2/(4 f_pp Fp)
  const double first = 2e-7 * 90, second = 4e-9 * 260;
  const FaceForm face = face_form(kEnd, {2, 20, 90, 260});
  EXPECT_NEAR(face.peak_to_valley_mm,
              20 * (20 * second - first) + first * first / (4 * second), 1e-16);
  // beyond it the ends alone
  EXPECT_NEAR(face_form(kEnd, {10, 20, 90, 260}).peak_to_valley_mm,
              20 * (20 * second - first) - 10 * (10 * second - first), 1e-16);
  EXPECT_NEAR(face_form(kEnd, {0, 20, 90, 0}).peak_to_valley_mm, 20 * first, 1e-16);
  EXPECT_EQ(face_form({}, {0, 20, 90, 260}).peak_to_valley_mm, 0);
}

TEST(Face, RefusesRadiiThatAreNoFace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Facing& f : {Facing{-1, 20, 1, 1}, Facing{20, 20, 1, 1},
                          Facing{nan, 20, 1, 1}, Facing{0, nan, 1, 1}})
    EXPECT_THROW(face_form(kEnd, f), std::domain_error);
}

}  // namespace
}  // namespace turnwright::deflection
