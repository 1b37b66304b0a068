// The part as a Timoshenko beam whose section varies, by Castigliano's theorem.
//
// Departures from the seed (Eqs. 6-8 there; why and by how much: docs/deflection.md):
// both sides of the tool count between centres, the tailstock's reaction comes from the
// real sections, and the couple of the feed force and all rotations are there.
//
// Departures from the usual flexibility sums: moments are kept about their centroid and
// merged by the parallel-axis rule, so every sum is one of positive terms, and the
// chuck-tailstock case is the energy of Eq. (5) instead of f_aa - f_aL^2/f_LL, which
// loses four digits on a part with a thin neck.
#include "turnwright/deflection/beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::deflection {
namespace {

// Gauss-Legendre rule on [0, 1]: roots of P6 and their weights, derived here with 40
// digits; beam_test integrates with them.
constexpr std::size_t kGauss = 6;
constexpr std::array<double, kGauss> kNode = {
    0.033765242898423986094, 0.16939530676686774317, 0.38069040695840154568,
    0.61930959304159845432,  0.83060469323313225683, 0.96623475710157601391};
constexpr std::array<double, kGauss> kWeight = {
    0.08566224618958517252, 0.18038078652406930378, 0.23395696728634552369,
    0.23395696728634552369, 0.18038078652406930378, 0.08566224618958517252};

// A Gauss panel is at most this part of the distance from its left end to the nearest
// pole of the integrands (a wall, radius or re + i ri of zero when continued), so the
// nearest pole lies 7 panels off its end: rho = 15 + sqrt(224) = 30, and the error of the
// 6-point rule is of the order rho^-12 = 2e-18 times 12^3/6 for a pole of order four.
constexpr double kPanel = 0.125;

// Rounding in the caller's own sum of lengths, up to some thousand of them.
constexpr double kEnd = 1e-12;

// Positions are taken in blocks, one array per quantity, so that the compiler computes
// several at a time; the arithmetic per position is the same in any company.
constexpr std::size_t kBlock = 32;
using Column = std::array<double, kBlock>;

struct RootForm {  // S as a hinge of compliance c2 at z = -q and a slide of c0 - c1^2/c2
  double c2, q, slide;
};

RootForm root_form(const Root& root) {
  const double q = root.c2_rad_Nmm > 0 ? root.c1_rad_N / root.c2_rad_Nmm : 0.0;
  return {root.c2_rad_Nmm, q, root.c0_mm_N - root.c1_rad_N * q};
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

/// Eqs. (1), (2) at the tool.
struct Beam::Sums {
  Column M0, d, J, S, H, T;
};

/// Stretches of a piece: angular flexibility, where its centroid lies (distances from the
/// stretch's right and left end), moment about the centroid, shear.
struct Beam::Stretches {
  Column m0, from_right, from_left, J, s;
};

// What lies left or right of t[i] within a piece.
template <Beam::Side side>
void Beam::measure(const Piece& piece, std::size_t n, const double* t,
                   Stretches& out) const {
  constexpr bool kLeft = side == Side::left;
  const double re0 = piece.re0, ri0 = piece.ri0, whole = piece.h_mm;
  const double inv0 = piece.inv0, inv1 = piece.inv1;
  const double slope = (piece.re1 - piece.re0) / piece.h_mm;
  const double slope_i = (piece.ri1 - piece.ri0) / piece.h_mm;
  const double bend = bend_, shear = shear_, shear_hollow = shear_hollow_;
  const auto length = [&](std::size_t i) { return kLeft ? t[i] : whole - t[i]; };
  switch (piece.kind) {
    case Piece::Kind::cylinder: {
      const double per_mm = piece.bend, shear_per_mm = piece.shear;
      for (std::size_t i = 0; i < n; ++i) {
        const double h = length(i);
        out.m0[i] = per_mm * h;
        out.from_right[i] = out.from_left[i] = h / 2;
        out.J[i] = per_mm * h * h * h / 12;
        out.s[i] = shear_per_mm * h;
      }
      return;
    }
    case Piece::Kind::solid_cone:
      // K20, K11, K02 = h int (1-u)^2, u (1-u), u^2 over r^4 du are h/(3 r0^3 r1),
      // h/(6 r0^2 r1^2), h/(3 r0 r1^3), and J = h^2 (K20 K02 - K11^2)/m0 = 3 h^2 K11^2/m0
      for (std::size_t i = 0; i < n; ++i) {
        const double h = length(i);
        const double at = 1 / (re0 + slope * t[i]);
        const double i0 = kLeft ? inv0 : at, i1 = kLeft ? at : inv1;
        const double i01 = i0 * i1, q = i0 * i0 + i01 + i1 * i1, h_q = h / q;
        const double c = bend * h * i01;
        out.m0[i] = c * q / 3;
        out.from_right[i] = h_q * (i0 * i0 + i01 / 2);
        out.from_left[i] = h_q * (i1 * i1 + i01 / 2);
        out.J[i] = c * h * h_q * i01 * i01 / 4;
        out.s[i] = shear * h * i01;
      }
      return;
    case Piece::Kind::hollow_cone:
      break;
  }
  Column re_0, re_h, ri_0, ri_h, sum, first, second, sheared;
  for (std::size_t i = 0; i < n; ++i) {
    const double start = kLeft ? 0 : t[i], h = length(i);
    re_0[i] = re0 + slope * start;
    ri_0[i] = ri0 + slope_i * start;
    re_h[i] = slope * h;
    ri_h[i] = slope_i * h;
    sum[i] = first[i] = second[i] = sheared[i] = 0;
  }
  for (std::size_t k = 0; k < kGauss; ++k) {
    const double u = kNode[k], v = 1 - u, vv = v * v, weight = kWeight[k];
    for (std::size_t i = 0; i < n; ++i) {
      const double re = re_0[i] + re_h[i] * u, ri = ri_0[i] + ri_h[i] * u;
      const double minus = (re - ri) * (re + ri), plus = re * re + ri * ri;
      const double both = re * ri, square = plus * plus;
      const double w = weight / (minus * square), g = w * plus;
      sum[i] += g;
      first[i] += g * v;
      second[i] += g * vv;
      sheared[i] += w * (shear * square + shear_hollow * both * both);  // Eq. (6)
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double h = length(i), c = first[i] / sum[i];
    out.m0[i] = bend * h * sum[i];
    out.from_right[i] = h * c;
    out.from_left[i] = h * (1 - c);
    // the section changes little in a panel, so this difference loses one digit at most
    out.J[i] = bend * h * h * h * (second[i] - c * first[i]);
    out.s[i] = h * sheared[i];
  }
}

// Eq. (1) and H at t[i] behind the left end of a piece: the parallel-axis rule joins two
// bodies.
void Beam::left_of(const Piece& piece, std::size_t first, std::size_t n, const double* t,
                   Sums& out) const {
  Stretches m;
  measure<Side::left>(piece, n, t, m);
  const double M0 = piece.m0, d = piece.d, J = piece.J, S = piece.S, H = piece.H,
               z = piece.z_mm;
  // only at the left end of everything are both bodies empty
  constexpr double kTiny = std::numeric_limits<double>::min();
  for (std::size_t i = 0; i < n; ++i) {
    const double both = M0 + m.m0[i], share = 1 / std::max(both, kTiny);
    const double apart = d + t[i] - m.from_right[i], at = z + m.from_left[i];
    out.M0[first + i] = both;
    out.d[first + i] = (M0 * (d + t[i]) + m.m0[i] * m.from_right[i]) * share;
    out.J[first + i] = J + m.J[i] + apart * apart * M0 * m.m0[i] * share;
    out.S[first + i] = S + m.s[i];
    out.H[first + i] = H + m.J[i] + m.m0[i] * at * at + m.s[i];
  }
}

// T from t[i] behind the left end of a piece.
void Beam::right_of(const Piece& piece, std::size_t first, std::size_t n, const double* t,
                    Sums& out) const {
  Stretches m;
  measure<Side::right>(piece, n, t, m);
  const double T = piece.T, b = piece.b_mm;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = b + m.from_right[i];
    out.T[first + i] = T + m.J[i] + m.m0[i] * at * at + m.s[i];
  }
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

  // The sums up to every piece, from the chuck and back from the tail.
  Sums sums;
  sums.M0[0] = sums.d[0] = sums.J[0] = sums.S[0] = sums.H[0] = sums.T[0] = 0;
  for (Piece& p : pieces_) {
    p.m0 = sums.M0[0], p.d = sums.d[0], p.J = sums.J[0], p.S = sums.S[0], p.H = sums.H[0];
    left_of(p, 0, 1, &p.h_mm, sums);
  }
  twist_ = (1 + nu) * sums.M0[0];  // G J = 2 E I/(2 (1 + nu))
  constexpr double kStart = 0;
  double b = 0;
  for (auto p = pieces_.rbegin(); p != pieces_.rend(); ++p) {
    p->T = sums.T[0], p->b_mm = b;
    right_of(*p, 0, 1, &kStart, sums);
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

bool Beam::holds(std::size_t k, double a_mm) const {
  return pieces_[k].z_mm <= a_mm &&
         (k + 1 == pieces_.size() || a_mm <= pieces_[k + 1].z_mm);
}

std::size_t Beam::piece_at(double a_mm, std::size_t hint) const {
  if (holds(hint, a_mm)) return hint;
  if (hint + 1 < pieces_.size() && holds(hint + 1, a_mm)) return hint + 1;
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), a_mm,
                                     [](double a, const Piece& p) { return a < p.z_mm; });
  return static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

// Runs of positions within one piece.
template <class Run>
void Beam::each_run(std::size_t n, const double* a, std::size_t& piece,
                    const Run& run) const {
  for (std::size_t i = 0, j = 0; i < n; i = j) {
    piece = piece_at(a[i], piece);
    const Piece& p = pieces_[piece];
    Column t;
    for (; j < n && holds(piece, a[j]); ++j) t[j - i] = std::min(a[j] - p.z_mm, p.h_mm);
    run(p, i, j - i, t.data());
  }
}

namespace {

struct Table {
  Column ww, wp, pp, tail_F, tail_C;
};

// Eq. (3)
void chuck(std::size_t n, const Column& a, const auto& sums, const Supports& supports,
           Table& f) {
  const auto [c0, c1, c2] = supports.root;
  for (std::size_t i = 0; i < n; ++i) {
    const double M0 = sums.M0[i], d = sums.d[i];
    f.ww[i] = sums.J[i] + M0 * d * d + sums.S[i] + c0 + 2 * c1 * a[i] + c2 * a[i] * a[i];
    f.wp[i] = M0 * d + c1 + c2 * a[i];
    f.pp[i] = M0 + c2;
    f.tail_F[i] = f.tail_C[i] = 0;
  }
}

// Eq. (4)
void between_centres(std::size_t n, const Column& a, double L, const auto& sums,
                     const Supports& supports, Table& f) {
  const double head = supports.head_mm_N, tail = supports.tail_mm_N, inverse = 1 / L;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = a[i] * inverse, y = (L - a[i]) * inverse;
    const double H = head + sums.H[i], T = tail + sums.T[i];
    f.ww[i] = y * y * H + x * x * T;
    f.wp[i] = (x * T - y * H) * inverse;
    f.pp[i] = (H + T) * inverse * inverse;
    f.tail_F[i] = x;
    f.tail_C[i] = inverse;
  }
}

// Eq. (5): e is the root's hinge as seen from the tool; X_M and X_0 are g_w - d g_p and
// g_w - e g_p, the loads' weights about the centroid and about the hinge.
void chuck_tailstock(std::size_t n, const Column& a, double L, const auto& sums,
                     const Supports& supports, Table& f) {
  const auto [c2, q, slide] = root_form(supports.root);
  const double tail = supports.tail_mm_N;
  for (std::size_t i = 0; i < n; ++i) {
    const double M0 = sums.M0[i], d = sums.d[i], T = tail + sums.T[i], b = L - a[i];
    const double e = a[i] + q, X = sums.J[i] + sums.S[i] + slide;
    const double g_w = X + M0 * d * (d + b) + c2 * e * (e + b);
    const double g_p = M0 * (d + b) + c2 * (e + b);
    const double lever = g_p * b + T, inverse = 1 / (g_w + lever);  // 1/(f_LL + c_t)
    const double alpha_w = g_w * inverse, alpha_p = g_p * inverse,
                 gamma_w = lever * inverse;
    const double X_M = X + c2 * (e + b) * (e - d), X_0 = X - M0 * (d + b) * (e - d);
    const double B_w = (d * T - b * X_M) * inverse, B_p = (T + X_M) * inverse;
    const double B0_w = (e * T - b * X_0) * inverse, B0_p = (T + X_0) * inverse;
    f.ww[i] =
        M0 * B_w * B_w + c2 * B0_w * B0_w + X * gamma_w * gamma_w + T * alpha_w * alpha_w;
    f.wp[i] =
        M0 * B_w * B_p + c2 * B0_w * B0_p - X * gamma_w * alpha_p + T * alpha_w * alpha_p;
    f.pp[i] = M0 * B_p * B_p + c2 * B0_p * B0_p + (X + T) * alpha_p * alpha_p;
    f.tail_F[i] = alpha_w;
    f.tail_C[i] = alpha_p;
  }
}

}  // namespace

void flexibilities(const Beam& left, const Beam& right, std::span<const double> a_mm,
                   const Supports& supports, std::span<Flexibility> out) {
  check(supports);
  const double L = left.length_mm_;
  if (!(std::abs(L - right.length_mm_) <= kEnd * L))
    throw std::domain_error("flexibilities: the two bodies differ in length");
  if (out.size() != a_mm.size())
    throw std::domain_error("flexibilities: one place per position is needed");
  std::size_t in_left = 0, in_right = 0;
  for (std::size_t begin = 0; begin < a_mm.size(); begin += kBlock) {
    const std::size_t n = std::min(kBlock, a_mm.size() - begin);
    Column a;
    for (std::size_t i = 0; i < n; ++i) {
      if (!(a_mm[begin + i] >= 0 && a_mm[begin + i] <= L * (1 + kEnd)))
        throw std::domain_error("flexibilities: positions must be in [0, L]");
      a[i] = std::min(a_mm[begin + i], L);
    }
    Beam::Sums sums;
    left.each_run(n, a.data(), in_left,
                  [&](const auto& p, std::size_t first, std::size_t count,
                      const double* t) { left.left_of(p, first, count, t, sums); });
    if (supports.method != Method::chuck)
      right.each_run(n, a.data(), in_right,
                     [&](const auto& p, std::size_t first, std::size_t count,
                         const double* t) { right.right_of(p, first, count, t, sums); });
    Table f;
    switch (supports.method) {
      case Method::chuck:
        chuck(n, a, sums, supports, f);
        break;
      case Method::between_centres:
        between_centres(n, a, L, sums, supports, f);
        break;
      case Method::chuck_tailstock:
        chuck_tailstock(n, a, L, sums, supports, f);
        break;
    }
    for (std::size_t i = 0; i < n; ++i)
      out[begin + i] = {f.ww[i], f.wp[i], f.pp[i], f.tail_F[i], f.tail_C[i]};
  }
}

void Beam::at(std::span<const double> a_mm, const Supports& supports,
              std::span<Flexibility> out) const {
  flexibilities(*this, *this, a_mm, supports, out);
}

Beam::Body Beam::body(double a_mm) const {
  if (!(a_mm >= 0 && a_mm <= length_mm_ * (1 + kEnd)))
    throw std::domain_error("Beam: positions must be in [0, L]");
  const Piece& p = pieces_[piece_at(a_mm, 0)];
  const double t = std::min(a_mm - p.z_mm, p.h_mm);
  Sums sums;
  left_of(p, 0, 1, &t, sums);
  return {sums.M0[0], sums.d[0], sums.J[0], sums.S[0]};
}

Flexibility Beam::at(double a_mm, const Supports& supports) const {
  Flexibility f;
  at(std::span(&a_mm, 1), supports, std::span(&f, 1));
  return f;
}

}  // namespace turnwright::deflection
