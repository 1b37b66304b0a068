#include "turnwright/chatter/receptance_coupling.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using Complex = std::complex<double>;
using Block = Eigen::Matrix2cd;
using Transfer = Eigen::Matrix4cd;

/// What (2) needs of a segment.
struct Section {
  double mass = 0;            ///< rho A [N s^2/mm^2]
  double rotary = 0;          ///< rho I [N s^2]
  Complex bending, shearing;  ///< 1/(E I) [1/(N mm^2)], 1/(kappa G A) [1/N]
};

Section section(const BeamSegment& s, BeamTheory theory) {
  constexpr double N_s2_mm4 = 1e-12;  // of a density in kg/m^3
  const double d2 = s.diameter_mm * s.diameter_mm, b2 = s.bore_mm * s.bore_mm;
  const double A = units::kPi / 4 * (d2 - b2), I = A * (d2 + b2) / 16;
  const double rho = s.density_kg_m3 * N_s2_mm4;
  const Complex E = s.E_MPa * Complex(1, s.loss_factor);
  Section out{rho * A, 0, 1.0 / (E * I), 0};
  if (theory == BeamTheory::euler_bernoulli) return out;
  const double m2 = b2 / d2, square = (1 + m2) * (1 + m2);
  const double kappa = 6 * (1 + s.nu) * square /
                       ((7 + 6 * s.nu) * square + (20 + 12 * s.nu) * m2);  // Eq. (4)
  out.rotary = rho * I;
  out.shearing = 2 * (1 + s.nu) / (kappa * E * A);
  return out;
}

/// A of (2), z' = A z.
Transfer slope(const Section& s, double w) {
  Transfer out = Transfer::Zero();
  out(0, 1) = 1;
  out(0, 2) = s.shearing;
  out(1, 3) = s.bending;
  out(2, 0) = -s.mass * w * w;
  out(3, 1) = -s.rotary * w * w;
  out(3, 2) = -1;
  return out;
}

/// The largest rate at which a motion changes along the beam [1/mm]: every closed way
/// through (2) is a product of these.
double wave_number(const Section& s, double w) {
  const double bending = std::pow(s.mass * w * w * std::abs(s.bending), 0.25),
               shearing = w * std::sqrt(s.mass * std::abs(s.shearing)),
               turning = w * std::sqrt(s.rotary * std::abs(s.bending));
  return std::max({bending, shearing, turning});
}

/// T of a length over which motions change little, by the exponential series.
Transfer transfer(const Transfer& A, double length_mm) {
  constexpr int kTerms = 24;  // (3/2)^24/24! < 1e-19, with three ways out of a state
  Transfer out = Transfer::Identity(), term = Transfer::Identity();
  for (int i = 1; i <= kTerms; ++i) {
    term = (term * A * (length_mm / i)).eval();
    out += term;
  }
  return out;
}

Block along(const BeamSegment& segment, BeamTheory theory, double w, Block R) {
  constexpr double kTurn = 0.5;  // of a piece; T of long ones loses what decays
  const Section s = section(segment, theory);
  const double pieces = std::ceil(wave_number(s, w) * segment.length_mm / kTurn);
  const double count = std::max(1.0, pieces);
  const Transfer T = transfer(slope(s, w), segment.length_mm / count);
  for (double i = 0; i < count; ++i)
    R = ((T.topLeftCorner<2, 2>() * R + T.topRightCorner<2, 2>()) *
         (T.bottomLeftCorner<2, 2>() * R + T.bottomRightCorner<2, 2>()).inverse())
            .eval();  // Eq. (3)
  return R;
}

}  // namespace

EndReceptance tilting(Complex H_mm_N, double pivot_mm) {
  return {H_mm_N, H_mm_N / pivot_mm, H_mm_N / (pivot_mm * pivot_mm)};
}

EndReceptance operator+(const EndReceptance& a, const EndReceptance& b) {
  return {a.H_mm_N + b.H_mm_N, a.L_1_N + b.L_1_N, a.P_1_Nmm + b.P_1_Nmm};
}

EndReceptance at_the_end(const EndReceptance& start,
                         std::span<const BeamSegment> segments, BeamTheory theory,
                         double w_rad_s) {
  Block R;
  R << start.H_mm_N, start.L_1_N, start.L_1_N, start.P_1_Nmm;
  for (const BeamSegment& s : segments) R = along(s, theory, w_rad_s, R);
  return {R(0, 0), R(0, 1), R(1, 1)};
}

}  // namespace turnwright::chatter
