#include "turnwright/chatter/receptance_coupling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <vector>

#include "turnwright/chatter/frf.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;

const BeamSegment kCarbide{.length_mm = 60,
                           .diameter_mm = 12,
                           .bore_mm = 0,
                           .E_MPa = 580000,
                           .nu = 0.22,
                           .density_kg_m3 = 14300,
                           .loss_factor = 0};

double area(const BeamSegment& s) {
  return M_PI / 4 * (s.diameter_mm * s.diameter_mm - s.bore_mm * s.bore_mm);
}

double inertia(const BeamSegment& s) {
  return M_PI / 64 * (std::pow(s.diameter_mm, 4) - std::pow(s.bore_mm, 4));
}

double EI(const BeamSegment& s) { return s.E_MPa * inertia(s); }
double mass_per_mm(const BeamSegment& s) { return s.density_kg_m3 * 1e-12 * area(s); }

Complex tip(const BeamSegment& s, BeamTheory theory, double w) {
  return at_the_end({}, std::vector{s}, theory, w).H_mm_N;
}

/// The angular frequency in [a, b] at which 1/H of an undamped cantilever vanishes.
double resonance(const BeamSegment& s, BeamTheory theory, double a, double b) {
  const auto f = [&](double w) { return (1.0 / tip(s, theory, w)).real(); };
  for (int i = 0; i < 80; ++i) {
    const double m = (a + b) / 2;
    ((f(m) > 0) == (f(a) > 0) ? a : b) = m;
  }
  return (a + b) / 2;
}

// Roots of 1 + cos cosh = 0.
TEST(ReceptanceCoupling, AClampedBeamHasTheFrequenciesOfEulerAndBernoulli) {
  const double unit = std::sqrt(EI(kCarbide) / mass_per_mm(kCarbide)) / (60.0 * 60);
  for (const double root : {1.87510406871196, 4.69409113297417, 7.85475743823761}) {
    const double w = root * root * unit;
    EXPECT_NEAR(resonance(kCarbide, BeamTheory::euler_bernoulli, 0.97 * w, 1.03 * w) / w,
                1, 1e-9);
  }
}

// Shear and rotary inertia lower the frequencies of a beam of Timoshenko; for a slender one
// by nothing.
TEST(ReceptanceCoupling, ASlenderBeamOfTimoshenkoIsThatOfEuler) {
  BeamSegment s = kCarbide;
  s.length_mm = 1000;
  const double w =
      std::pow(1.87510406871196, 2) * std::sqrt(EI(s) / mass_per_mm(s)) / 1e6;
  const double slender = resonance(s, BeamTheory::timoshenko, 0.9 * w, 1.1 * w) / w;
  EXPECT_LT(slender, 1);
  EXPECT_NEAR(slender, 1, 2e-4);
  s.length_mm = 40;
  const double w2 = w * 1e6 / 1600;
  EXPECT_LT(resonance(s, BeamTheory::timoshenko, 0.7 * w2, 1.1 * w2) / w2, 0.97);
}

// Slowly: H + 2 l L + l^2 P of the spindle, l^3/3EI of bending, l/kappa G A of shear.
TEST(ReceptanceCoupling, StandsStillAsABeamOnASpring) {
  BeamSegment s = kCarbide;
  s.bore_mm = 4;
  const EndReceptance spindle{2e-5, 1e-7, 3e-9};
  const double l = s.length_mm, G = s.E_MPa / 2 / (1 + s.nu), m2 = 16.0 / 144;
  const double kappa = 6 * (1 + s.nu) * (1 + m2) * (1 + m2) /
                       ((7 + 6 * s.nu) * (1 + m2) * (1 + m2) + (20 + 12 * s.nu) * m2);
  const auto R = at_the_end(spindle, std::vector{s}, BeamTheory::timoshenko, 1e-3);
  EXPECT_NEAR(R.H_mm_N.real(),
              2e-5 + 2 * l * 1e-7 + l * l * 3e-9 + l * l * l / (3 * EI(s)) +
                  l / (kappa * G * area(s)),
              1e-13);
  EXPECT_NEAR(R.L_1_N.real(), 1e-7 + l * 3e-9 + l * l / (2 * EI(s)), 1e-15);
  EXPECT_NEAR(R.P_1_Nmm.real(), 3e-9 + l / EI(s), 1e-17);
}

// A rigid stub adds its mass: 1/H = 1/H0 - m w^2.
TEST(ReceptanceCoupling, AStubIsAMass) {
  BeamSegment s = kCarbide;
  s.length_mm = 0.01;
  const double w = 3000, m = mass_per_mm(s) * 0.01;
  const auto R = at_the_end({2e-3, 0, 0}, std::vector{s}, BeamTheory::euler_bernoulli, w);
  EXPECT_NEAR((1.0 / R.H_mm_N).real(), 1 / 2e-3 - m * w * w, 1e-6 * m * w * w);
}

TEST(ReceptanceCoupling, CuttingASegmentInTwoChangesNothing) {
  BeamSegment whole = kCarbide, part = kCarbide, rest = kCarbide;
  whole.loss_factor = part.loss_factor = rest.loss_factor = 0.01;
  part.length_mm = 17;
  rest.length_mm = 43;
  const EndReceptance spindle = tilting({2e-5, -1e-6}, 80);
  for (const double w : {500.0, 5000.0, 50000.0, 500000.0})
    for (const auto theory : {BeamTheory::timoshenko, BeamTheory::euler_bernoulli}) {
      const auto a = at_the_end(spindle, std::vector{whole}, theory, w),
                 b = at_the_end(spindle, std::vector{part, rest}, theory, w);
      EXPECT_LT(std::abs(a.H_mm_N / b.H_mm_N - 1.0), 1e-10) << w;
      EXPECT_LT(std::abs(a.L_1_N / b.L_1_N - 1.0), 1e-10) << w;
      EXPECT_LT(std::abs(a.P_1_Nmm / b.P_1_Nmm - 1.0), 1e-10) << w;
    }
}

// All lengths c times, w over c: a receptance over c.
TEST(ReceptanceCoupling, ScalesWithLength) {
  BeamSegment large = kCarbide;
  large.length_mm *= 3;
  large.diameter_mm *= 3;
  for (const double w : {3000.0, 30000.0})
    EXPECT_NEAR((tip(large, BeamTheory::timoshenko, w / 3) * 3.0 /
                 tip(kCarbide, BeamTheory::timoshenko, w))
                    .real(),
                1, 1e-11);
}

/// Two modes of a spindle with their own pivots, so that R can be inverted.
EndReceptance spindle(double w) {
  const auto mode = [&](double f_Hz, double zeta, double k, double pivot_mm) {
    const double r = w / (2 * M_PI * f_Hz);
    return tilting(1 / k / Complex(1 - r * r, 2 * zeta * r), pivot_mm);
  };
  return mode(600, 0.04, 40000, 150) + mode(1500, 0.03, 60000, -90);
}

/// H at the tip by beam elements with two nodes, y and psi linear, the shear taken in the
/// middle of the element: their error falls with the square of its length.
Complex by_elements(const std::vector<BeamSegment>& segments, BeamTheory theory, double w,
                    int each) {
  const auto nodes = static_cast<Eigen::Index>(segments.size()) * each + 1;
  Eigen::MatrixXcd D = Eigen::MatrixXcd::Zero(2 * nodes, 2 * nodes);
  const EndReceptance R = spindle(w);
  Eigen::Matrix2cd start;
  start << R.H_mm_N, R.L_1_N, R.L_1_N, R.P_1_Nmm;
  D.topLeftCorner<2, 2>() = start.inverse();
  Eigen::Index at = 0;
  for (const BeamSegment& s : segments)
    for (int i = 0; i < each; ++i, at += 2) {
      const double h = s.length_mm / each, rho = s.density_kg_m3 * 1e-12,
                   m = rho * area(s);
      const Complex E = s.E_MPa * Complex(1, s.loss_factor);
      const double m2 = std::pow(s.bore_mm / s.diameter_mm, 2), q = (1 + m2) * (1 + m2);
      const double kappa =
          6 * (1 + s.nu) * q / ((7 + 6 * s.nu) * q + (20 + 12 * s.nu) * m2);
      Eigen::Matrix4cd e = Eigen::Matrix4cd::Zero();
      if (theory == BeamTheory::euler_bernoulli) {  // Hermite's cubic
        Eigen::Matrix4d k, mass;
        k << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12,
            -6 * h, 6 * h, 2 * h * h, -6 * h, 4 * h * h;
        mass << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54,
            13 * h, 156, -22 * h, -13 * h, -3 * h * h, -22 * h, 4 * h * h;
        e = E * inertia(s) / (h * h * h) * k - w * w * m * h / 420 * mass;
      } else {
        Eigen::RowVector4d bend(0, -1 / h, 0, 1 / h), shear(-1 / h, -0.5, 1 / h, -0.5);
        const Complex GA = kappa * E / 2.0 / (1 + s.nu) * area(s);
        e = E * inertia(s) * h * (bend.transpose() * bend) +
            GA * h * (shear.transpose() * shear);
        for (const int r : {0, 1}) {
          const double of = (r == 0 ? m : rho * inertia(s)) * h / 6 * w * w;
          e(r, r) -= 2 * of;
          e(r + 2, r + 2) -= 2 * of;
          e(r, r + 2) -= of;
          e(r + 2, r) -= of;
        }
      }
      D.block<4, 4>(at, at) += e;
    }
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(2 * nodes);
  force(2 * nodes - 2) = 1;
  return D.partialPivLu().solve(force)(2 * nodes - 2);
}

// Spindle, hollow holder, shank and fluted part.
TEST(ReceptanceCoupling, AgreesWithFiniteElements) {
  BeamSegment holder{.length_mm = 55,
                     .diameter_mm = 40,
                     .bore_mm = 14,
                     .E_MPa = 205000,
                     .nu = 0.29,
                     .density_kg_m3 = 7850,
                     .loss_factor = 0.01};
  BeamSegment shank = kCarbide, flutes = kCarbide;
  shank.loss_factor = flutes.loss_factor = 0.004;
  shank.length_mm = 35;
  flutes.length_mm = 25;
  flutes.diameter_mm = 9.6;
  const std::vector all{holder, shank, flutes};
  for (const auto theory : {BeamTheory::timoshenko, BeamTheory::euler_bernoulli})
    for (const double f_Hz : {50.0, 590.0, 800.0, 1490.0, 2100.0, 3500.0, 5000.0}) {
      const double w = 2 * M_PI * f_Hz;
      const Complex ours = at_the_end(spindle(w), all, theory, w).H_mm_N;
      const Complex theirs = by_elements(all, theory, w, 80);
      EXPECT_LT(std::abs(ours / theirs - 1.0), 1e-3) << f_Hz;
      if (theory == BeamTheory::euler_bernoulli) continue;  // rounding is left
      const Complex coarse = by_elements(all, theory, w, 40);
      EXPECT_LT(std::abs(ours / theirs - 1.0), 0.26 * std::abs(ours / coarse - 1.0))
          << f_Hz;
    }
}

// The first mode of a cantilever: at its tip a quarter of its mass, damped by half of the
// loss factor.
TEST(ReceptanceCoupling, TheFitFindsTheModeOfACantilever) {
  BeamSegment s = kCarbide;
  s.loss_factor = 0.01;
  const double w1 =
      std::pow(1.87510406871196, 2) * std::sqrt(EI(s) / mass_per_mm(s)) / 3600;
  FrequencyResponse response;
  for (double r = 0.5; r < 2; r += 0.005) {
    response.w_rad_s.push_back(r * w1);
    response.value.push_back(tip(s, BeamTheory::euler_bernoulli, r * w1));
  }
  const auto fit = std::get<ModalFit>(modal_fit(response, 1));
  EXPECT_NEAR(fit.modes[0].wn_rad_s.value / w1, 1, 1e-4);
  EXPECT_NEAR(fit.modes[0].zeta.value, 0.005, 5e-5);
  EXPECT_NEAR(fit.modes[0].k_N_mm.value / (w1 * w1 * mass_per_mm(s) * 60 / 4), 1, 2e-3);
}

TEST(ReceptanceCoupling, TiltingIsOfRankOne) {
  const auto R = tilting({3e-5, -1e-6}, 120);
  EXPECT_LT(std::abs(R.H_mm_N * R.P_1_Nmm - R.L_1_N * R.L_1_N), 1e-24);
  EXPECT_EQ(tilting(1e-5, INFINITY).L_1_N, 0.0);
  EXPECT_EQ(tilting(1e-5, INFINITY).P_1_Nmm, 0.0);
}

}  // namespace
}  // namespace turnwright::chatter
