#include "turnwright/volumetric/lathe_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "machines.hpp"

namespace turnwright::volumetric {
namespace {

constexpr double kUm = 1e-3;

/// A lathe with errors that `put` puts on its axes C, Z, X.
Surface cut(const Generator& g, const std::function<void(Axis&, Axis&, Axis&)>& put) {
  Machine m{"wCfZXt", {}, {{'C', {}, std::numbers::pi}, {'Z', {}, 100}, {'X', {}, 100}}};
  put(m.axes[0], m.axes[1], m.axes[2]);
  return turned(Kinematics(m), {}, g);
}

const Generator kShaft{30, 0, 30, 100}, kFace{30, 50, 5, 50};

TEST(LathePart, ScaleOfXIsADiameter) {
  const Surface s = cut(kShaft, [](Axis&, Axis&, Axis& X) { X.errors[0].c[1] = 3e-3; });
  EXPECT_NEAR(diameter_error_mm(s), 1.80 * kUm, 1e-7);
  EXPECT_NEAR(cylindricity(s).minimum_zone_mm, 0, 1e-9);
}

TEST(LathePart, SpindleToZIsATaper) {
  const Surface s = cut(kShaft, [](Axis&, Axis& Z, Axis&) { Z.location[4] = 20e-6; });
  EXPECT_NEAR(taper_mm(s), 4.0 * kUm, 1e-7);
  EXPECT_NEAR(cylindricity(s).minimum_zone_mm, 2.0 * kUm, 1e-7);
  EXPECT_NEAR(cylindricity(s).least_squares_mm, 2.0 * kUm, 1e-7);
  EXPECT_NEAR(straightness(s).minimum_zone_mm, 0, 1e-9);
  // In the YZ plane only by y^2/2R: (2 um)^2/60 mm.
  const Surface y = cut(kShaft, [](Axis&, Axis& Z, Axis&) { Z.location[3] = 20e-6; });
  EXPECT_LT(std::abs(taper_mm(y)), 1e-6);
}

TEST(LathePart, SpindleToXIsAConcaveFace) {
  const Surface s = cut(kFace, [](Axis&, Axis&, Axis& X) { X.location[4] = 20e-6; });
  EXPECT_NEAR(flatness(s).minimum_zone_mm, 0.50 * kUm, 1e-7);
  EXPECT_NEAR(perpendicularity_mm(s, {}), 0.50 * kUm, 1e-7);
  EXPECT_NEAR(circular_axial_runout_mm(s, {}), 0, 1e-9);
}

TEST(LathePart, BowOfZIsCylindricity) {
  const Surface s =
      cut({30, 20, 30, 120}, [](Axis&, Axis& Z, Axis&) { Z.errors[0].c[2] = 5e-3; });
  EXPECT_NEAR(cylindricity(s).minimum_zone_mm, 7.0 * kUm, 1e-7);
  // A parabola over 100 mm: 5 um/4 between parallel lines.
  EXPECT_NEAR(straightness(s).minimum_zone_mm, 1.25 * kUm, 1e-7);
  EXPECT_NEAR(total_radial_runout_mm(s, {}), 7.0 * kUm, 1e-7);
}

TEST(LathePart, LobesOfTheSpindleAreRoundness) {
  const auto lobes = [](Axis& C, Axis&, Axis&) { C.errors[0].f = {{0, 0}, {1e-3, 0}}; };
  const Surface s = cut(kShaft, lobes);
  EXPECT_NEAR(roundness(s).minimum_zone_mm, 2.0 * kUm, 1e-7);
  EXPECT_NEAR(roundness(s).least_squares_mm, 2.0 * kUm, 1e-7);
  // Once per turn: a circle off the axis, round itself.
  const Surface once = cut(kShaft, [](Axis& C, Axis&, Axis&) {
    C.errors[0].f = {{1e-3, 0}};
  });
  EXPECT_NEAR(roundness(once).minimum_zone_mm, 0, 1e-7);
  EXPECT_NEAR(coaxiality_mm(once, {}), 2.0 * kUm, 1e-6);
  EXPECT_NEAR(circular_radial_runout_mm(once, {}), 2.0 * kUm, 1e-6);
  EXPECT_NEAR(circular_radial_runout_mm(once, axis_of(once)), 0, 1e-7);
}

TEST(LathePart, AxialSpindleErrorsAreOnFaces) {
  for (const std::size_t n : {1u, 2u, 3u}) {
    const Surface s = cut(kFace, [n](Axis& C, Axis&, Axis&) {
      C.errors[2].f.assign(n, {});
      C.errors[2].f.back() = {1e-3, 0};
    });
    EXPECT_NEAR(perpendicularity_mm(s, {}), 2.0 * kUm, 1e-5) << n;
    EXPECT_NEAR(circular_axial_runout_mm(s, {}), 2.0 * kUm, 1e-5) << n;
    if (n > 1) {
      EXPECT_NEAR(flatness(s).least_squares_mm, 2.0 * kUm, 2e-5) << n;
    }
  }
}

TEST(LathePart, ReversalOfXGoesWithItsDirection) {
  const auto play = [](Axis&, Axis&, Axis& X) { X.errors[0].b = -1e-3; };
  Generator outside = kShaft, inside = kShaft;
  inside.approach_x = 1;
  EXPECT_NEAR(diameter_error_mm(cut(outside, play)), 2.0 * kUm, 1e-9);
  EXPECT_NEAR(diameter_error_mm(cut(inside, play)), -2.0 * kUm, 1e-9);
}

TEST(LathePart, LengthsAndParallelFaces) {
  const auto scale = [](Axis&, Axis& Z, Axis&) { Z.errors[2].c[1] = 2e-3; };
  const Surface left = cut({30, 10, 5, 10}, scale), right = cut({30, 90, 5, 90}, scale);
  EXPECT_NEAR(length_error_mm(left, right), 1.6 * kUm, 1e-7);  // 20 ppm of 80 mm
  EXPECT_NEAR(parallelism_mm(right, left), 0, 1e-9);
  // Rechucked: the second face is tilted by 10 urad, 0.6 um over 60 mm.
  Surface tilted = right;
  for (std::size_t i = 0; i < tilted.theta_rad.size(); ++i)
    for (std::size_t j = 0; j < tilted.r_mm.size(); ++j)
      tilted.e_mm[i * tilted.r_mm.size() + j] +=
          1e-5 * tilted.r_mm[j] * std::cos(tilted.theta_rad[i]);
  EXPECT_NEAR(parallelism_mm(tilted, left), 0.6 * kUm, 1e-9);
  EXPECT_NEAR(normal_of(tilted).ax, -1e-5, 1e-15);
  EXPECT_NEAR(normal_of(tilted).ay, 0, 1e-15);
  EXPECT_NEAR(flatness(tilted).minimum_zone_mm, 0, 1e-9);
}

TEST(LathePart, ToolHeightIsSecondOrder) {
  const double y = 0.1, R = 30;
  const Surface s = cut(kShaft, [y](Axis&, Axis&, Axis& X) { X.errors[1].c[0] = y; });
  EXPECT_NEAR(diameter_error_mm(s), y * y / R, 1e-6);
}

TEST(LathePart, ConesAreMeasuredAlongTheirNormal) {
  // 45 deg: a shift of X by d is d/sqrt 2 along the normal.
  const Surface s =
      cut({10, 0, 30, 20}, [](Axis&, Axis&, Axis& X) { X.errors[0].c[0] = 1e-3; });
  EXPECT_NEAR(profile_mm(s), 2e-3 / std::sqrt(2.0), 1e-9);
}

TEST(LathePart, ZonesNeverExceedLeastSquares) {
  testing::RandomMachines random(8);
  for (int i = 0; i < 10; ++i) {
    const auto put = [&](Axis& C, Axis& Z, Axis& X) {
      for (Axis* axis : {&C, &Z, &X})
        for (std::size_t k = 0; k < 6; ++k)
          for (double& c : axis->errors[k].c) c = random.number(k < 3 ? 5e-3 : 5e-5);
      for (std::size_t k = 0; k < 6; ++k)
        C.errors[k].f = {{random.number(1e-5), 0}, {0, random.number(1e-5)}};
    };
    const Surface s = cut(kShaft, put), f = cut(kFace, put);
    for (const Form& form :
         {straightness(s), roundness(s), cylindricity(s), flatness(f), straightness(f)})
      EXPECT_LE(form.minimum_zone_mm, form.least_squares_mm);
  }
}

TEST(LathePart, ZonesOfAnySurfaceAreNarrowerAndAddUpToNoMore) {
  testing::RandomMachines random(9);
  const auto rough = [&](const Generator& g) {
    Surface s = cut(g, [](Axis&, Axis&, Axis&) {});
    for (double& e : s.e_mm) e = random.number(1e-2);
    return s;
  };
  for (int i = 0; i < 5; ++i) {
    const Surface a = rough(kShaft), b = rough(kShaft), f = rough(kFace),
                  g = rough(kFace);
    const auto sum = [](Surface x, const Surface& y) {
      for (std::size_t k = 0; k < x.e_mm.size(); ++k) x.e_mm[k] += y.e_mm[k];
      return x;
    };
    for (const auto measure : {straightness, roundness, cylindricity, flatness}) {
      const bool face = measure == flatness;
      const Form one = measure(face ? f : a), two = measure(face ? g : b),
                 both = measure(face ? sum(f, g) : sum(a, b));
      EXPECT_LE(one.minimum_zone_mm, one.least_squares_mm * (1 + 1e-12));
      EXPECT_LE(both.minimum_zone_mm,
                (one.minimum_zone_mm + two.minimum_zone_mm) * (1 + 1e-9));
    }
  }
}

TEST(LathePart, MonteCarloOfOneSourceIsItsNormal) {
  // One source: range |x| of a taper's 2 um; the median of |N| is 0.6745, 95 % 1.96.
  const Surface s = cut(kShaft, [](Axis&, Axis& Z, Axis&) { Z.location[4] = 20e-6; });
  const std::vector<FormSource> one = {{cylinder_residual_mm(s), 0.5, 2}};
  const FormDistribution d = form_distribution(one, 100000, 1);
  EXPECT_NEAR(d.median_mm, 0.6745 * 1.0 * kUm, 0.01 * kUm);
  EXPECT_NEAR(d.p95_mm, 1.96 * 1.0 * kUm, 0.02 * kUm);
  EXPECT_NEAR(d.worst_mm, 4.0 * kUm, 1e-7);
  EXPECT_EQ(form_distribution(one, 1000, 7).p95_mm,
            form_distribution(one, 1000, 7).p95_mm);
  const std::vector<FormSource> capped = {{cylinder_residual_mm(s), 10, 1}};
  EXPECT_NEAR(form_distribution(capped, 1000, 1).p95_mm, 2.0 * kUm, 1e-9);
  EXPECT_THROW(form_distribution({}, 10, 1), std::domain_error);
}

TEST(LathePart, RefusesWhatIsNoSurface) {
  for (const Generator& g : {Generator{30, 0, 30, 0}, Generator{-1, 0, 5, 0},
                             Generator{30, 0, std::nan(""), 9}})
    EXPECT_THROW(cut(g, [](Axis&, Axis&, Axis&) {}), std::domain_error);
}

}  // namespace
}  // namespace turnwright::volumetric
