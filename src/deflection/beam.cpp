// The part as a Timoshenko beam whose section varies, by Castigliano's theorem.
//
// Departures from the seed (Eqs. 6-8 there; why and by how much: docs/deflection.md):
// both sides of the tool count between centres, the tailstock's reaction comes from the
// real sections, and the couple of the feed force and all rotations are there.
//
// Departures from the usual flexibility sums: moments are kept about their centroid and
// merged by the parallel-axis rule, so every sum is one of positive terms, and the
// chuck-tailstock case is the energy of Eq. (5) instead of f_aa - f_aL^2/f_LL, which
// loses up to five digits on a part with a thin neck.
#include "turnwright/deflection/beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::deflection {
namespace {

// Gauss-Legendre rule on [0, 1]: roots of P8 and their weights, derived here with 40
// digits; tests/deflection integrates degree 15 with them.
constexpr std::size_t kGauss = 8;
constexpr std::array<double, kGauss> kNode = {
    0.019855071751231884158, 0.10166676129318663020, 0.23723379504183550709,
    0.40828267875217509753,  0.59171732124782490247, 0.76276620495816449291,
    0.89833323870681336980,  0.98014492824876811584};
constexpr std::array<double, kGauss> kWeight = {
    0.050614268145188129576, 0.11119051722668723527, 0.15685332293894364367,
    0.18134189168918099148,  0.18134189168918099148, 0.15685332293894364367,
    0.11119051722668723527,  0.050614268145188129576};

// A Gauss panel is at most this part of the distance from its left end to the nearest
// pole of the integrands (a wall, radius or re + i ri of zero when continued), so the
// nearest pole lies 3 panels off its end: rho = 7 + sqrt(48) = 13.9, and the error of the
// 8-point rule is of the order rho^-16 = 5e-19 times the pole's order cubed.
constexpr double kPanel = 0.25;

// Rounding in the caller's own sum of lengths, up to some thousand of them.
constexpr double kEnd = 1e-12;

struct RootForm {  // S as a hinge of compliance c2 at z = -q and a slide of c0 - c1^2/c2
  double c2, q, slide;
};

RootForm root_form(const Root& root) {
  const double q = root.c2_rad_Nmm > 0 ? root.c1_rad_N / root.c2_rad_Nmm : 0.0;
  return {root.c2_rad_Nmm, q, std::max(0.0, root.c0_mm_N - root.c1_rad_N * q)};
}

double length_to_panel_end(const part::Segment& s, double u) {
  const double re0 = s.outer_left_mm / 2, ri0 = s.inner_left_mm / 2;
  const double dre = s.outer_right_mm / 2 - re0, dri = s.inner_right_mm / 2 - ri0;
  const double re = re0 + dre * u, ri = ri0 + dri * u;
  const auto reach = [](double value, double slope) {
    return slope == 0 ? 1.0 : kPanel * value / std::abs(slope);
  };
  return std::min({reach(re - ri, dre - dri), reach(re + ri, dre + dri), reach(re, dre),
                   reach(std::hypot(re, ri), std::hypot(dre, dri))});
}

void check(const part::Shaft& shaft) {
  if (!(shaft.E_MPa > 0 && std::isfinite(shaft.E_MPa)))
    throw std::domain_error("Beam: E must be > 0 MPa");
  if (!(shaft.nu >= 0 && shaft.nu < 0.5))
    throw std::domain_error("Beam: nu must be in [0, 0.5)");
  if (shaft.segments.empty()) throw std::domain_error("Beam: no segments");
  for (const part::Segment& s : shaft.segments) {
    if (!(s.length_mm > 0 && std::isfinite(s.length_mm)))
      throw std::domain_error("Beam: segment lengths must be > 0 mm");
    for (const auto& [outer, inner] : {std::pair{s.outer_left_mm, s.inner_left_mm},
                                       std::pair{s.outer_right_mm, s.inner_right_mm}})
      if (!(inner >= 0 && outer > inner && std::isfinite(outer)))
        throw std::domain_error("Beam: diameters must be outer > inner >= 0 mm");
  }
}

void check(const Supports& supports) {
  if (!elastic(supports.root) ||
      !(supports.head_mm_N >= 0 && std::isfinite(supports.head_mm_N)) ||
      !(supports.tail_mm_N >= 0 && std::isfinite(supports.tail_mm_N)))
    throw std::domain_error("Beam: the supports are no elastic body");
}

}  // namespace

bool elastic(const Root& root) {
  const double c0 = root.c0_mm_N, c1 = root.c1_rad_N, c2 = root.c2_rad_Nmm;
  return c0 >= 0 && c2 >= 0 && std::isfinite(c0) && std::isfinite(c2) &&
         c1 * c1 <= c0 * c2 * (1 + 1e-12);
}

/// Moments of 1/EI over a stretch: about its right end r1, r2, about its left end l1, l2,
/// the distance of its centroid from its right end, the moment J about the centroid; and
/// s, the shear.
struct Beam::Moments {
  double m0, r1, r2, l1, l2, centroid, J, s;
};

struct Beam::Left {  // Eq. (1) at the tool
  double M0, d, J, S;
};

// From x0 to x1 within a piece; always inlined, so that what a caller does not use is
// not computed.
[[gnu::always_inline]] inline Beam::Moments Beam::moments(const Piece& p, double x0,
                                                          double x1) const {
  const double h = x1 - x0;
  if (p.kind == Piece::Kind::cylinder) {
    const double m0 = p.bend * h;
    const double first = m0 * h / 2, second = m0 * h * h / 3;
    return {m0, first, second, first, second, h / 2, second / 4, p.shear * h};
  }
  const double slope = (p.re1 - p.re0) / p.h_mm;
  if (p.kind == Piece::Kind::solid_cone) {
    const double i0 = x0 > 0 ? 1 / (p.re0 + slope * x0) : p.inv0;
    const double i1 = x1 < p.h_mm ? 1 / (p.re0 + slope * x1) : p.inv1;
    // K20, K11, K02 = h int (1-u)^2, u (1-u), u^2 over r^4 du
    const double i01 = i0 * i1, c = bend_ * h * i01;
    const double K20 = c * i0 * i0 / 3, K11 = c * i01 / 6, K02 = c * i1 * i1 / 3;
    const double m0 = K20 + 2 * K11 + K02;
    // K20 K02 = 4 K11^2, hence J = h^2 (K20 K02 - K11^2)/m0
    return {m0,
            h * (K20 + K11),
            h * h * K20,
            h * (K02 + K11),
            h * h * K02,
            h * (K20 + K11) / m0,
            3 * h * h * K11 * K11 / m0,
            shear_ * h * i01};
  }
  const double slope_i = (p.ri1 - p.ri0) / p.h_mm;
  std::array<double, kGauss> g;
  double m0 = 0, r1 = 0, r2 = 0, l1 = 0, l2 = 0, s = 0;
  for (std::size_t k = 0; k < kGauss; ++k) {
    const double x = x0 + h * kNode[k];
    const double re = p.re0 + slope * x, ri = p.ri0 + slope_i * x;
    const double minus = (re - ri) * (re + ri), plus = re * re + ri * ri;
    const double w = kWeight[k] / (minus * plus * plus), both = re * ri;
    g[k] = w * plus;
    m0 += g[k];
    const double u = kNode[k], v = kNode[kGauss - 1 - k];
    r1 += g[k] * v;
    r2 += g[k] * v * v;
    l1 += g[k] * u;
    l2 += g[k] * u * u;
    s += w * (shear_ * plus * plus + shear_hollow_ * both * both);  // Eq. (6)
  }
  const double v0 = r1 / m0;
  double J = 0;
  for (std::size_t k = 0; k < kGauss; ++k) {
    const double dv = kNode[kGauss - 1 - k] - v0;
    J += g[k] * dv * dv;
  }
  const double b0 = bend_ * h, b1 = b0 * h, b2 = b1 * h;
  return {b0 * m0, b1 * r1, b2 * r2, b1 * l1, b2 * l2, h * v0, b2 * J, h * s};
}

// Eq. (1) at t behind the left end of a piece: the parallel-axis rule joins two bodies.
[[gnu::always_inline]] inline Beam::Left Beam::left_of(const Piece& p, double t) const {
  if (!(t > 0)) return {p.m0, p.d, p.J, p.S};
  const Moments m = moments(p, 0, t);
  const double M0 = p.m0 + m.m0, inverse = 1 / M0, apart = p.d + t - m.centroid;
  return {M0, (p.m0 * (p.d + t) + m.r1) * inverse,
          p.J + m.J + apart * apart * p.m0 * m.m0 * inverse, p.S + m.s};
}

Beam::Beam(const part::Shaft& shaft) {
  check(shaft);
  const double E = shaft.E_MPa, nu = shaft.nu;
  bend_ = 4 / (units::kPi * E);
  shear_ = (7 + 6 * nu) / (3 * units::kPi * E);
  shear_hollow_ = (20 + 12 * nu) / (3 * units::kPi * E);
  const std::vector<double> z = part::ends_mm(shaft.segments);
  length_mm_ = z.back();
  pieces_.reserve(shaft.segments.size());
  for (std::size_t i = 0; i < shaft.segments.size(); ++i)
    add_pieces(shaft.segments[i], z[i]);

  Left left{0, 0, 0, 0};
  double H = 0;
  for (Piece& p : pieces_) {
    p.m0 = left.M0, p.d = left.d, p.J = left.J, p.S = left.S, p.H = H;
    const Moments m = moments(p, 0, p.h_mm);
    left = left_of(p, p.h_mm);
    H += m.l2 + 2 * p.z_mm * m.l1 + p.z_mm * p.z_mm * m.m0 + m.s;
  }
  twist_ = (1 + nu) * left.M0;  // G J = 2 E I/(2 (1 + nu))
  double T = 0, b = 0;
  for (auto p = pieces_.rbegin(); p != pieces_.rend(); ++p) {
    p->T = T, p->b_mm = b;
    const Moments m = moments(*p, 0, p->h_mm);
    T += m.r2 + 2 * b * m.r1 + b * b * m.m0 + m.s;
    b = length_mm_ - p->z_mm;
  }
}

void Beam::add_pieces(const part::Segment& s, double z_mm) {
  const bool cylinder =
      s.outer_left_mm == s.outer_right_mm && s.inner_left_mm == s.inner_right_mm;
  const bool solid = s.inner_left_mm == 0 && s.inner_right_mm == 0;
  for (double u = 0; u < 1;) {
    const double v =
        cylinder || solid ? 1.0 : std::min(1.0, u + length_to_panel_end(s, u));
    Piece p{};
    p.z_mm = z_mm + u * s.length_mm;
    p.h_mm = (v - u) * s.length_mm;
    p.re0 = std::lerp(s.outer_left_mm, s.outer_right_mm, u) / 2;
    p.re1 = std::lerp(s.outer_left_mm, s.outer_right_mm, v) / 2;
    p.ri0 = std::lerp(s.inner_left_mm, s.inner_right_mm, u) / 2;
    p.ri1 = std::lerp(s.inner_left_mm, s.inner_right_mm, v) / 2;
    p.inv0 = 1 / p.re0;
    p.inv1 = 1 / p.re1;
    p.kind = cylinder ? Piece::Kind::cylinder
             : solid  ? Piece::Kind::solid_cone
                      : Piece::Kind::hollow_cone;
    const double minus = (p.re0 - p.ri0) * (p.re0 + p.ri0);
    const double plus = p.re0 * p.re0 + p.ri0 * p.ri0, both = p.re0 * p.ri0;
    p.bend = bend_ / (minus * plus);
    p.shear = (shear_ + shear_hollow_ * (both / plus) * (both / plus)) / minus;  // (6)
    pieces_.push_back(p);
    u = v;
  }
}

std::size_t Beam::piece_at(double a_mm, std::size_t hint) const {
  const auto holds = [&](std::size_t k) {
    return pieces_[k].z_mm <= a_mm &&
           (k + 1 == pieces_.size() || a_mm <= pieces_[k + 1].z_mm);
  };
  if (holds(hint)) return hint;
  if (hint + 1 < pieces_.size() && holds(hint + 1)) return hint + 1;
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), a_mm,
                                     [](double a, const Piece& p) { return a < p.z_mm; });
  return static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

void flexibilities(const Beam& left, const Beam& right, std::span<const double> a_mm,
                   const Supports& supports, std::span<Flexibility> out) {
  check(supports);
  const double L = left.length_mm_;
  if (!(std::abs(L - right.length_mm_) <= kEnd * L))
    throw std::domain_error("flexibilities: the two bodies differ in length");
  if (out.size() != a_mm.size())
    throw std::domain_error("flexibilities: one place per position is needed");
  const RootForm root = root_form(supports.root);
  const double c0 = supports.root.c0_mm_N, c1 = supports.root.c1_rad_N, c2 = root.c2;
  std::size_t in_left = 0, in_right = 0;

  for (std::size_t i = 0; i < a_mm.size(); ++i) {
    if (!(a_mm[i] >= 0 && a_mm[i] <= L * (1 + kEnd)))
      throw std::domain_error("flexibilities: positions must be in [0, L]");
    const double a = std::min(a_mm[i], L), b = L - a;
    in_left = left.piece_at(a, in_left);
    const Beam::Piece& p = left.pieces_[in_left];
    const double t = std::min(a - p.z_mm, p.h_mm);

    if (supports.method == Method::chuck) {
      const auto [M0, d, J, S] = left.left_of(p, t);
      out[i] = {J + M0 * d * d + S + c0 + 2 * c1 * a + c2 * a * a,  // Eq. (3)
                M0 * d + c1 + c2 * a, M0 + c2, 0, 0};
      continue;
    }

    in_right = right.piece_at(a, in_right);
    const Beam::Piece& pr = right.pieces_[in_right];
    const double tr = std::min(a - pr.z_mm, pr.h_mm);
    double T = supports.tail_mm_N + pr.T;
    if (tr < pr.h_mm) {  // Eq. (2)
      const Beam::Moments m = right.moments(pr, tr, pr.h_mm);
      T += m.r2 + 2 * pr.b_mm * m.r1 + pr.b_mm * pr.b_mm * m.m0 + m.s;
    }

    if (supports.method == Method::between_centres) {
      double H = supports.head_mm_N + p.H;
      if (t > 0) {
        const Beam::Moments m = left.moments(p, 0, t);
        H += m.l2 + 2 * p.z_mm * m.l1 + p.z_mm * p.z_mm * m.m0 + m.s;
      }
      const double inverse = 1 / L, x = a * inverse, y = b * inverse;
      out[i] = {y * y * H + x * x * T, (x * T - y * H) * inverse,  // Eq. (4)
                (H + T) * inverse * inverse, x, inverse};
      continue;
    }

    // Eq. (5); e is the root's hinge as seen from the tool, X and Y what the tool's side
    // and the hinge against the centroid weigh.
    const auto [M0, d, J, S] = left.left_of(p, t);
    const double e = a + root.q, X = J + S + root.slide;
    const double g_w = X + M0 * d * (d + b) + c2 * e * (e + b);
    const double g_p = M0 * (d + b) + c2 * (e + b);
    const double lever = g_p * b + T, inverse = 1 / (g_w + lever);  // 1/(f_LL + c_t)
    const double alpha_w = g_w * inverse, alpha_p = g_p * inverse;
    const double gamma_w = lever * inverse, gamma_p = -alpha_p;
    const double X_M = X + c2 * (e + b) * (e - d), X_0 = X - M0 * (d + b) * (e - d);
    const double B_w = (d * T - b * X_M) * inverse, B_p = (T + X_M) * inverse;
    const double B0_w = (e * T - b * X_0) * inverse, B0_p = (T + X_0) * inverse;
    const auto energy = [&](double B, double C, double B0, double C0, double gg,
                            double aa) {
      return M0 * B * C + c2 * B0 * C0 + X * gg + T * aa;
    };
    out[i] = {energy(B_w, B_w, B0_w, B0_w, gamma_w * gamma_w, alpha_w * alpha_w),
              energy(B_w, B_p, B0_w, B0_p, gamma_w * gamma_p, alpha_w * alpha_p),
              energy(B_p, B_p, B0_p, B0_p, gamma_p * gamma_p, alpha_p * alpha_p), alpha_w,
              alpha_p};
  }
}

void Beam::at(std::span<const double> a_mm, const Supports& supports,
              std::span<Flexibility> out) const {
  flexibilities(*this, *this, a_mm, supports, out);
}

Flexibility Beam::at(double a_mm, const Supports& supports) const {
  Flexibility f;
  at(std::span(&a_mm, 1), supports, std::span(&f, 1));
  return f;
}

}  // namespace turnwright::deflection
