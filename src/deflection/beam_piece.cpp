// Eq. (1) within a piece: closed forms for cylinders and solid cones, Gauss' rule on
// short panels for hollow cones, whose closed form (logarithms and arctangents) loses all
// digits at small taper.
#include <algorithm>
#include <cmath>
#include <limits>

#include "beam_run.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/deflection/beam.hpp"

namespace turnwright::deflection {
namespace {

// Gauss-Legendre rule on [0, 1]: roots of P5 and their weights, derived here with 40
// digits; beam_test integrates with them.
constexpr std::size_t kGauss = 5;
constexpr std::array<double, kGauss> kNode = {
    0.046910077030668003601, 0.230765344947158454482, 0.500000000000000000000,
    0.769234655052841545518, 0.953089922969331996399};
constexpr std::array<double, kGauss> kWeight = {
    0.118463442528094543757, 0.239314335249683234021, 0.284444444444444444444,
    0.239314335249683234021, 0.118463442528094543757};

// A panel is at most this part of the distance from its left end to the nearest pole of
// the integrands (re - ri, re + ri or re + i ri of zero when continued), and at most half
// of a panel is integrated at once.  So the nearest pole lies 14 lengths off the end:
// rho = 29 + sqrt(840) = 58, and the error of the 5-point rule is of the order
// rho^-10 = 2e-18 times 10^3/6 for a pole of order four.
constexpr double kPanel = 0.125;

// Panels are at least kLeast long, because a wall that closes would need infinitely many.
constexpr double kLeast = std::numeric_limits<double>::epsilon();

double length_to_panel_end(double x, double dx, double y, double dy) {
  const auto reach = [](double value, double change) {
    return change == 0 ? 1.0 : kPanel * value / std::abs(change);
  };
  return std::max(
      kLeast, std::min({reach(x, dx), reach(y, dy),
                        reach(std::sqrt(x * x + y * y), std::sqrt(dx * dx + dy * dy))}));
}

void cylinder(const auto& piece, auto& run) {
  const double bend = piece.bend, shear = piece.shear, whole = piece.h_mm;
  const auto set = [=](double h, double& M, double& d, double& X) {
    M = bend * h;
    d = h / 2;
    X = h * (shear + M * h * (1.0 / 12));
  };
  for (std::size_t i = 0; i < run.n; ++i) {
    set(run.t[i], run.left.M[i], run.left.d[i], run.left.X[i]);
    set(whole - run.t[i], run.right.M[i], run.right.d[i], run.right.X[i]);
  }
}

// From r0 to r = y r0 over a length h the integrals of u^0, u, u^2 over r^4 are
// elementary and free of cancellation: with Q = 1 + y + y^2
//     M = h Q/(3 r0^4 y^3),  d = h y (y + 1/2)/Q,  h^3/(4 r0^4 y Q) in X,
// and the shear's is h/(r0^2 y).
void solid_cone(const auto& piece, auto& run) {
  const double bend = piece.bend, shear = piece.shear, whole = piece.h_mm;
  const auto set = [=](double inv_r0, double r, double h, double& M, double& d,
                       double& X) {
    const double inv2 = inv_r0 * inv_r0, y = r * inv_r0, Q = 1 + y * (1 + y);
    const double inv_yQ = 1 / (y * Q), inv_y = inv_yQ * Q, inv_Q = inv_yQ * y;
    const double bend_h = bend * inv2 * inv2 * h;
    M = bend_h * Q * inv_y * inv_y * inv_y * (1.0 / 3);
    d = h * y * (y + 0.5) * inv_Q;
    X = inv_y * (shear * inv2 * h + bend_h * h * h * inv_Q * 0.25);
  };
  const double inv0 = 1 / piece.left.sum_mm, inv1 = 1 / piece.right.sum_mm;
  const double r0_h = piece.left.sum_mm / whole, r1_h = piece.right.sum_mm / whole;
  for (std::size_t i = 0; i < run.n; ++i) {
    const double t = run.t[i], rest = whole - t, r = rest * r0_h + t * r1_h;
    set(inv0, r, t, run.left.M[i], run.left.d[i], run.left.X[i]);
    set(inv1, r, rest, run.right.M[i], run.right.d[i], run.right.X[i]);
  }
}

/// Parts of a piece; `at` is the position of the centroid, from the left end as `start`.
struct Stretches {
  Column start, length;
  Column M, at, X;
};

// Gauss' rule, with moments about the middle of the length.
void integrate(const auto& piece, std::size_t n, Stretches& s) {
  const double bend = piece.bend, shear = piece.shear, hollow = piece.shear_hollow;
  const double x0 = piece.left.wall_mm, x_mm = (piece.right.wall_mm - x0) / piece.h_mm;
  const double y0 = piece.left.sum_mm, y_mm = (piece.right.sum_mm - y0) / piece.h_mm;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = s.start[i], h = s.length[i];
    const double x_z = x0 + x_mm * z, x_h = x_mm * h, y_z = y0 + y_mm * z, y_h = y_mm * h;
    double m = 0, first = 0, second = 0, sheared = 0;
    for (std::size_t k = 0; k < kGauss; ++k) {
      const double u = kNode[k], v = u - 0.5;
      const double x = x_z + x_h * u, y = y_z + y_h * u;
      const double minus = x * y, plus = x * x + y * y, square = plus * plus;
      const double w = kWeight[k] / (minus * square), g = w * plus, g_v = g * v;
      m += g;
      first += g_v;
      second += g_v * v;
      sheared += w * (shear * square - hollow * (minus * minus));
    }
    const double c = first / m;
    s.M[i] = bend * h * m;
    s.at[i] = z + h * (0.5 + c);
    s.X[i] = h * (sheared + bend * h * h * (second - c * first));
  }
}

// The shorter side is integrated, and the other is the rest of the panel.  The rest is at
// least a third of the panel, so the subtraction costs one digit at most.
void hollow_cone(const auto& piece, auto& run) {
  const double h = piece.h_mm;
  Stretches s;
  for (std::size_t i = 0; i < run.n; ++i) {
    s.start[i] = 2 * run.t[i] < h ? 0 : run.t[i];
    s.length[i] = std::min(run.t[i], h - run.t[i]);
  }
  integrate(piece, run.n, s);
  const auto [M, d, X] = piece.whole;
  const double at = h - d, inv_M = 1 / M;
  for (std::size_t i = 0; i < run.n; ++i) {
    const double M1 = s.M[i], at1 = s.at[i], X1 = s.X[i];
    const double M2 = M - M1, at2 = (M * at - M1 * at1) / M2, apart = at2 - at1;
    const double X2 = X - X1 - apart * apart * M1 * M2 * inv_M;
    const bool left = s.start[i] == 0;
    run.left.M[i] = left ? M1 : M2;
    run.left.d[i] = run.t[i] - (left ? at1 : at2);
    run.left.X[i] = left ? X1 : X2;
    run.right.M[i] = left ? M2 : M1;
    run.right.d[i] = (left ? at2 : at1) - run.t[i];
    run.right.X[i] = left ? X2 : X1;
  }
}

}  // namespace

// With x = re - ri, y = re + ri, minus = x y, plus = x^2 + y^2:
//     1/EI = 2 bend/(minus plus),
//     chi/GA = (shear + hollow (1/4 - (minus/plus)^2))/minus,  Eq. (7)
// the bracket being (re ri)^2/(re^2 + ri^2)^2.
void Beam::add_pieces(const part::Shaft& shaft, const part::Segment& s, double z_mm) {
  const double inv_piE = 1 / (units::kPi * shaft.E_MPa), bend = 4 * inv_piE,
               shear = (7 + 6 * shaft.nu) / 3 * inv_piE,
               hollow = (20 + 12 * shaft.nu) / 3 * inv_piE;
  const double x0 = (s.outer_left_mm - s.inner_left_mm) / 2,
               x1 = (s.outer_right_mm - s.inner_right_mm) / 2,
               y0 = (s.outer_left_mm + s.inner_left_mm) / 2,
               y1 = (s.outer_right_mm + s.inner_right_mm) / 2;
  Piece p{};
  if (s.outer_left_mm == s.outer_right_mm && s.inner_left_mm == s.inner_right_mm) {
    const double minus = x0 * y0, plus = x0 * x0 + y0 * y0, share = minus / plus;
    p.kind = Piece::Kind::cylinder;
    p.bend = 2 * bend / (minus * plus);
    p.shear = (shear + hollow * (0.25 - share * share)) / minus;
  } else if (s.inner_left_mm == 0 && s.inner_right_mm == 0) {
    p.kind = Piece::Kind::solid_cone;
    p.bend = bend;
    p.shear = shear;
  } else {
    p.kind = Piece::Kind::hollow_cone;
    p.bend = 2 * bend;
    p.shear = shear + hollow / 4;
    p.shear_hollow = hollow;
  }
  const auto end = [&](double u) {
    return End{x0 * (1 - u) + x1 * u, y0 * (1 - u) + y1 * u, 0};
  };
  for (double u = 0, v = 1; u < 1; u = v) {
    p.left = end(u);
    if (p.kind == Piece::Kind::hollow_cone)
      v = std::min(
          1.0, u + length_to_panel_end(p.left.wall_mm, x1 - x0, p.left.sum_mm, y1 - y0));
    p.right = end(v);
    p.z_mm = z_mm + u * s.length_mm;
    p.h_mm = (v - u) * s.length_mm;
    p.whole = p.measured();
    pieces_.push_back(p);
  }
}

void Beam::Piece::measure(std::span<const double> a_mm, BeamRun& run) const {
  run.n = a_mm.size();
  for (std::size_t i = 0; i < run.n; ++i) run.t[i] = std::min(a_mm[i] - z_mm, h_mm);
  both_sides(run);
}

void Beam::Piece::both_sides(BeamRun& run) const {
  switch (kind) {
    case Kind::cylinder:
      return cylinder(*this, run);
    case Kind::solid_cone:
      return solid_cone(*this, run);
    case Kind::hollow_cone:
      return hollow_cone(*this, run);
  }
}

Body Beam::Piece::measured() const {
  if (kind == Kind::hollow_cone) {
    const double half = h_mm / 2;
    Stretches halves;
    halves.start[0] = 0;
    halves.start[1] = halves.length[0] = halves.length[1] = half;
    integrate(*this, 2, halves);
    const auto seen_from = [&](double z, std::size_t i) {
      return Body{halves.M[i], z - halves.at[i], halves.X[i]};
    };
    return joined(seen_from(half, 0), half, seen_from(h_mm, 1));
  }
  BeamRun all;
  all.n = 1;
  all.t[0] = h_mm;
  both_sides(all);
  return {all.left.M[0], all.left.d[0], all.left.X[0]};
}

}  // namespace turnwright::deflection
