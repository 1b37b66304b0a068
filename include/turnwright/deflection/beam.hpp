#pragma once
#include <span>
#include <vector>

#include "turnwright/part/shaft.hpp"

namespace turnwright::deflection {

enum class Method { chuck, between_centres, chuck_tailstock };

/// Compliance of the root S = [[c0, c1], [c1, c2]]: deflection and rotation at z = 0 per
/// unit force and couple there.  The springs k1, k2, k3 and the arm Lc of [Valino 2008]'s
/// Eqs. 3 and 4 enter only as c0 = 1/k1 + Lc^2/k2, c1 = Lc/k2, c2 = 1/k2 + 1/k3.
struct Root {
  double c0_mm_N = 0, c1_rad_N = 0, c2_rad_Nmm = 0;
};

/// Supports in one plane (radial or tangential); zeros are rigid.
struct Supports {
  Method method = Method::chuck;
  Root root;             ///< chuck and chuck-tailstock
  double head_mm_N = 0;  ///< headstock centre, between centres
  double tail_mm_N = 0;  ///< tail centre
};

/// Deflection and rotation of the section at z = a per unit force and couple there.
struct Flexibility {
  double f_ww_mm_N = 0;     ///< deflection per unit force
  double f_wp_rad_N = 0;    ///< rotation per unit force = deflection per unit couple
  double f_pp_rad_Nmm = 0;  ///< rotation per unit couple
  double tail_per_N = 0;    ///< tail centre's reaction per unit force, against it
  double tail_per_Nmm = 0;  ///< and per unit couple
};

/// Whether S is the compliance of an elastic body: c0, c2 >= 0 and c1^2 <= c0 c2, up to
/// rounding (1e-12, because a chuck with one rigid spring has exactly c1^2 = c0 c2).
bool elastic(const Root& root);

/// Compliance of everything that supports the section under the tool from one side:
/// angular flexibility M, distance d of the centroid of M from the section, and
/// deflection X per force through that centroid.  For the length from z0 to the tool at a
///
///     M = int dz/EI,  d = int (a - z)/EI dz / M,
///     X = int [(a - d - z)^2/EI + chi/GA] dz                                   (1)
///
/// and for the root S, seen from z = 0: M = c2, d = c1/c2, X = c0 - c1^2/c2.
struct Body {
  double M_rad_Nmm = 0, d_mm = 0, X_mm_N = 0;
};

Body body(const Root& root);

/// A body joined with the length of part that follows it, by the parallel-axis rule.
/// With e = d_1 + length their centroids are e and d_2 from the section, and
///
///     M = M_1 + M_2,  d = (M_1 e + M_2 d_2)/M,
///     X = X_1 + X_2 + (e - d_2)^2 M_1 M_2/M                                    (2)
///
/// Every term is positive.  Where e - d_2, the distance of the two centroids, is small
/// and therefore inexact, its term is small, too.
Body joined(const Body& behind, double length_mm, const Body& stretch);

struct BeamRun;  // positions computed together, see src/deflection/beam_run.hpp

/// The part as a beam that bends and shears.  The constructor sums up its segments; every
/// position then costs O(1) once its segment is known.
///
/// EI(z) and GA(z)/chi(z) are local, also in cones; (M, d, X) belongs to the root and all
/// of the part left of the tool.  Seen from the ends of the part its two sides are
///
///     H = c_head + int_0^a (z^2/EI + chi/GA) dz,
///     T = c_tail + int_a^L ((L - z)^2/EI + chi/GA) dz                          (3)
///
/// Chuck:
///     f_ww = X + M d^2,  f_wp = M d,  f_pp = M                                 (4)
/// Between centres, b = L - a:
///     f_ww = (b^2 H + a^2 T)/L^2,  f_wp = (a T - b H)/L^2,  f_pp = (H + T)/L^2,
///     tail reaction a/L per force, 1/L per couple                              (5)
/// Chuck-tailstock:  g_w = f_aL = X + M d (d + b),  g_p = M (d + b),
///     f_LL + c_t = g_w + g_p b + T,  alpha_i = g_i/(f_LL + c_t) the tail's reaction,
///     f_ij = f_ij,chuck - g_i alpha_j
/// evaluated as the energy of the two loads, which avoids the cancellation that a thin
/// neck causes, with gamma = (1 - alpha_w, -alpha_p) the shear left of the tool and
/// B = (d T - b X, X + T)/(f_LL + c_t) the moment at the centroid:
///     f_ij = M B_i B_j + X gamma_i gamma_j + T alpha_i alpha_j                 (6)
///
/// Sections: EI = pi E (re^4 - ri^4)/4, GA = pi E (re^2 - ri^2)/(2 (1 + nu)), and the
/// shear factor, m = ri/re,
///     chi = ((7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2)/(6 (1 + nu)(1 + m^2)^2) (7)
/// Solid cones and all cylinders have closed forms; hollow cones take 5 Gauss points on
/// panels so short that the rule is exact to rounding (see beam_piece.cpp).
///
/// Valid for walls above a fifth of the radius, because thinner rings become oval.
/// Sections stay plane, so a diameter step costs up to 21 % unless `shoulder_correction`
/// is used.  Linear.
/// Degenerate input: a = 0 on a rigid chuck gives zeros; with rigid centres (5) has no
/// terms of them.
/// Source: [Valino 2008], Eqs. 6-8, corrected as docs/deflection.md derives;
/// [Timoshenko 1921], the beam; [Cowper 1966] for (7), handbook value.  Checked in
/// beam_test.
class Beam {
 public:
  /// @throws std::domain_error if lengths or diameters do not describe a body, unless
  /// E > 0 and 0 <= nu < 0.5.
  explicit Beam(const part::Shaft& shaft);

  double length_mm() const noexcept { return length_mm_; }

  /// Flexibility at a [mm], 0 <= a <= L.  A position beyond L by less than 1e-12 L, the
  /// rounding of sums of lengths, counts as L.
  /// @throws std::domain_error outside this range, or if the supports are not elastic.
  Flexibility at(double a_mm, const Supports& supports) const;
  /// Flexibilities at several positions, fastest in rising order; `out` is as long as
  /// `a_mm`.
  void at(std::span<const double> a_mm, const Supports& supports,
          std::span<Flexibility> out) const;

  /// The body (1) of the part left of a, without supports.
  /// @throws std::domain_error unless 0 <= a <= L (as `at`).
  Body body(double a_mm) const;

  /// int_0^L dz/GJ with J = 2 I: twist of the end per unit torque [rad/(N mm)].
  double twist_rad_Nmm() const noexcept { return twist_; }

  /// Flexibilities of a part whose shape left of the tool is that of `left` and right of
  /// it that of `right`, as in the middle of a cut; both have the same length.
  /// @throws std::domain_error if the lengths differ, or as the members `at`.
  friend void flexibilities(const Beam& left, const Beam& right,
                            std::span<const double> a_mm, const Supports& supports,
                            std::span<Flexibility> out);

 private:
  /// One end of a piece: re - ri and re + ri there, and Eq. (3) without the centre for
  /// the length between it and the end of the part on that side.
  struct End {
    double wall_mm, sum_mm, moment_mm_N;
  };
  /// A length of the part with one closed form or one Gauss panel.
  struct Piece {
    enum class Kind { cylinder, solid_cone, hollow_cone } kind;
    double bend, shear, shear_hollow;  // constants of 1/EI and chi/GA
    double z_mm, h_mm;                 // left end, length
    End left, right;
    Body whole, before;  // the piece, and everything left of it

    /// Bodies between each of the positions, all within the piece, and its ends.
    void measure(std::span<const double> a_mm, BeamRun& run) const;
    void both_sides(BeamRun& run) const;
    Body measured() const;
  };

  void add_pieces(const part::Shaft& shaft, const part::Segment& segment, double z_mm);
  double end_of(std::size_t piece) const;
  std::size_t piece_at(double a_mm, std::size_t hint) const;

  std::vector<Piece> pieces_;
  double length_mm_ = 0;
  double twist_ = 0;
};

void flexibilities(const Beam& left, const Beam& right, std::span<const double> a_mm,
                   const Supports& supports, std::span<Flexibility> out);

}  // namespace turnwright::deflection
