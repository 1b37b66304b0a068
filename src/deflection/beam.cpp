// The part as a Timoshenko beam whose section varies, by Castigliano's theorem.
//
// Departures from [Valino 2008] (its Eqs. 6-8; why and by how much: docs/deflection.md):
// both sides of the tool count between centres, the tailstock's reaction comes from the
// real sections, and the couple of the feed force and all rotations are there.
//
// Departures from the usual flexibility sums: moments are kept about their centroid and
// joined by the parallel-axis rule, so every sum is one of positive terms, and the
// chuck-tailstock case is the energy of Eq. (6) instead of f_aa - f_aL^2/f_LL, which
// loses four digits on a part with a thin neck.
#include "turnwright/deflection/beam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "beam_run.hpp"

namespace turnwright::deflection {
namespace {

// Rounding in the caller's own sum of lengths, up to some thousand of them.
constexpr double kEnd = 1e-12;

// The least divisor: two bodies are both empty only at a rigid root.
constexpr double kTiny = std::numeric_limits<double>::min();

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

/// Contribution of a body to Eq. (3) at an end of the part, `arm_mm` from its centroid.
double seen_from(double arm_mm, const Body& body) {
  return body.X_mm_N + body.M_rad_Nmm * arm_mm * arm_mm;
}

}  // namespace

bool elastic(const Root& root) {
  const double c0 = root.c0_mm_N, c1 = root.c1_rad_N, c2 = root.c2_rad_Nmm;
  return c0 >= 0 && c2 >= 0 && std::isfinite(c0) && std::isfinite(c2) &&
         c1 * c1 <= c0 * c2 * (1 + 1e-12);
}

Body body(const Root& root) {
  const auto [c0, c1, c2] = root;
  const double q = c2 > 0 ? c1 / c2 : 0.0;
  return {c2, q, c0 - c1 * q};
}

Body joined(const Body& behind, double length_mm, const Body& stretch) {
  const double M = behind.M_rad_Nmm + stretch.M_rad_Nmm;
  const double far = behind.d_mm + length_mm, apart = far - stretch.d_mm;
  const double share = 1 / (M + kTiny);
  return {M, (behind.M_rad_Nmm * far + stretch.M_rad_Nmm * stretch.d_mm) * share,
          behind.X_mm_N + stretch.X_mm_N +
              apart * apart * behind.M_rad_Nmm * stretch.M_rad_Nmm * share};
}

Beam::Beam(const part::Shaft& shaft) {
  check(shaft);
  const std::vector<double> z = part::ends_mm(shaft.segments);
  length_mm_ = z.back();
  pieces_.reserve(shaft.segments.size());
  for (std::size_t i = 0; i < shaft.segments.size(); ++i)
    add_pieces(shaft, shaft.segments[i], z[i]);

  // The sums up to every piece, from the chuck and back from the tail.
  Body before;
  double H = 0, T = 0, b = 0;
  for (Piece& p : pieces_) {
    p.before = before;
    p.left.moment_mm_N = H;
    H += seen_from(p.z_mm + p.h_mm - p.whole.d_mm, p.whole);
    before = joined(before, p.h_mm, p.whole);
  }
  twist_ = (1 + shaft.nu) * before.M_rad_Nmm;  // G J = 2 E I/(2 (1 + nu))
  for (auto p = pieces_.rbegin(); p != pieces_.rend(); ++p) {
    p->right.moment_mm_N = T;
    T += seen_from(b + p->whole.d_mm, p->whole);
    b = length_mm_ - p->z_mm;
  }
}

double Beam::end_of(std::size_t k) const {
  return k + 1 < pieces_.size() ? pieces_[k + 1].z_mm
                                : std::numeric_limits<double>::infinity();
}

std::size_t Beam::piece_at(double a_mm, std::size_t hint) const {
  const auto holds = [&](std::size_t k) {
    return pieces_[k].z_mm <= a_mm && a_mm < end_of(k);
  };
  if (holds(hint)) return hint;
  if (hint + 1 < pieces_.size() && holds(hint + 1)) return hint + 1;
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), a_mm,
                                     [](double a, const Piece& p) { return a < p.z_mm; });
  return static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

namespace {

// Eq. (2) for the bodies left of every position of a run.
void join(const Body& start, auto& run) {
  const auto [M0, d0, X0] = start;
  auto& left = run.left;
  for (std::size_t i = 0; i < run.n; ++i) {
    const double m = left.M[i], d = left.d[i], far = d0 + run.t[i], apart = far - d;
    const double share = 1 / (M0 + m + kTiny);
    left.M[i] = M0 + m;
    left.d[i] = (M0 * far + m * d) * share;
    left.X[i] += X0 + apart * apart * M0 * m * share;
  }
}

// Eq. (4)
void chuck(const auto& left, std::span<Flexibility> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double M = left.M[i], d = left.d[i];
    out[i] = {left.X[i] + M * d * d, M * d, M, 0, 0};
  }
}

// Eq. (5); head and tail are H and T at the ends of the piece.
void between_centres(const Column& a, double L, const auto& left, double head,
                     const auto& right, double tail, std::span<Flexibility> out) {
  const double inverse = 1 / L;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double b = L - a[i], x = a[i] * inverse, y = b * inverse;
    const double d_l = a[i] - left.d[i], d_r = b - right.d[i];
    const double H = head + left.X[i] + left.M[i] * d_l * d_l,
                 T = tail + right.X[i] + right.M[i] * d_r * d_r;
    out[i].f_ww_mm_N = y * y * H + x * x * T;
    out[i].f_wp_rad_N = (x * T - y * H) * inverse;
    out[i].f_pp_rad_Nmm = (H + T) * inverse * inverse;
    out[i].tail_per_N = x;
    out[i].tail_per_Nmm = inverse;
  }
}

// Eq. (6)
void chuck_tailstock(const Column& a, double L, const auto& left, const auto& right,
                     double tail, std::span<Flexibility> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double b = L - a[i], d_r = b - right.d[i];
    const double T = tail + right.X[i] + right.M[i] * d_r * d_r;
    const double M = left.M[i], d = left.d[i], X = left.X[i];
    const double g_p = M * (d + b), g_w = X + g_p * d, lever = g_p * b + T;
    const double inverse = 1 / (g_w + lever);  // 1/(f_LL + c_t)
    const double alpha_w = g_w * inverse, alpha_p = g_p * inverse,
                 gamma_w = lever * inverse;
    const double B_w = (d * T - b * X) * inverse, B_p = (X + T) * inverse;
    out[i].f_ww_mm_N = M * B_w * B_w + X * gamma_w * gamma_w + T * alpha_w * alpha_w;
    out[i].f_wp_rad_N = M * B_w * B_p + (T * alpha_w - X * gamma_w) * alpha_p;
    out[i].f_pp_rad_Nmm = M * B_p * B_p + (X + T) * alpha_p * alpha_p;
    out[i].tail_per_N = alpha_w;
    out[i].tail_per_Nmm = alpha_p;
  }
}

}  // namespace

void flexibilities(const Beam& left, const Beam& right, std::span<const double> a_mm,
                   const Supports& supports, std::span<Flexibility> out) {
  check(supports);
  const double L = left.length_mm_, end = L * (1 + kEnd);
  if (!(std::abs(L - right.length_mm_) <= kEnd * L))
    throw std::domain_error("flexibilities: the two bodies differ in length");
  if (out.size() != a_mm.size())
    throw std::domain_error("flexibilities: one place per position is needed");
  const Body root = body(supports.root);
  Column a;
  BeamRun in_left, in_right;
  for (std::size_t i = 0, l = 0, r = 0, n = 0; i < a_mm.size(); i += n) {
    if (!(a_mm[i] >= 0 && a_mm[i] <= end))
      throw std::domain_error("flexibilities: positions must be in [0, L]");
    l = left.piece_at(a_mm[i], l);
    r = right.piece_at(a_mm[i], r);
    const Beam::Piece &left_piece = left.pieces_[l], &right_piece = right.pieces_[r];
    const double from = std::max(left_piece.z_mm, right_piece.z_mm),
                 to = std::min(left.end_of(l), right.end_of(r));
    const std::size_t most = std::min(kRun, a_mm.size() - i);
    for (n = 0; n < most; ++n) {
      const double x = a_mm[i + n];
      if (!(x >= from && x < to && x <= end)) break;
      a[n] = std::min(x, L);
    }

    const std::span<const double> at(a.data(), n);
    left_piece.measure(at, in_left);
    if (&left != &right) right_piece.measure(at, in_right);
    const BeamBodies& after = &left == &right ? in_left.right : in_right.right;
    const double tail = supports.tail_mm_N + right_piece.right.moment_mm_N;
    const auto places = out.subspan(i, n);
    if (supports.method == Method::between_centres) {
      const double head = supports.head_mm_N + left_piece.left.moment_mm_N;
      between_centres(a, L, in_left.left, head, after, tail, places);
      continue;
    }
    join(joined(root, left_piece.z_mm, left_piece.before), in_left);
    if (supports.method == Method::chuck)
      chuck(in_left.left, places);
    else
      chuck_tailstock(a, L, in_left.left, after, tail, places);
  }
}

void Beam::at(std::span<const double> a_mm, const Supports& supports,
              std::span<Flexibility> out) const {
  flexibilities(*this, *this, a_mm, supports, out);
}

Body Beam::body(double a_mm) const {
  if (!(a_mm >= 0 && a_mm <= length_mm_ * (1 + kEnd)))
    throw std::domain_error("Beam: positions must be in [0, L]");
  const Piece& piece = pieces_[piece_at(a_mm, 0)];
  BeamRun run;
  piece.measure({&a_mm, 1}, run);
  const auto& left = run.left;
  return joined(piece.before, run.t[0], {left.M[0], left.d[0], left.X[0]});
}

Flexibility Beam::at(double a_mm, const Supports& supports) const {
  Flexibility f;
  at(std::span(&a_mm, 1), supports, std::span(&f, 1));
  return f;
}

}  // namespace turnwright::deflection
