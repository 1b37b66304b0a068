#pragma once
#include <span>
#include <vector>

#include "turnwright/part/shaft.hpp"

namespace turnwright::deflection {

enum class Method { chuck, between_centres, chuck_tailstock };

/// Compliance of the root S = [[c0, c1], [c1, c2]]: deflection and rotation at z = 0 per
/// unit force and couple there.  The springs k1, k2, k3 and the arm Lc of the seed's
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

/// What one newton and one newton-millimetre at z = a do to the section there.
struct Flexibility {
  double f_ww_mm_N = 0;     ///< deflection per unit force
  double f_wp_rad_N = 0;    ///< rotation per unit force = deflection per unit couple
  double f_pp_rad_Nmm = 0;  ///< rotation per unit couple
  double tail_per_N = 0;    ///< tail centre's reaction per unit force, against it
  double tail_per_Nmm = 0;  ///< and per unit couple
};

/// Whether S is the compliance of an elastic body: c0, c2 >= 0 and c1^2 <= c0 c2 but for
/// rounding (1e-12: a chuck with one rigid spring has exactly c1^2 = c0 c2).
bool elastic(const Root& root);

/// The bending and shearing part: moments of its flexibility once, then every position
/// in O(1) after finding its segment.
///
/// With EI(z) and GA(z)/chi(z) local, also in cones, the part left of the tool is its
/// angular flexibility, how far its centroid lies behind the tool, its moment about that
/// centroid and its shear; the part right of it is what it adds at the tail:
///
///     M0 = int_0^a dz/EI,  d = int_0^a (a - z)/EI dz / M0,
///     J = int_0^a (a - d - z)^2/EI dz,  S = int_0^a chi/GA dz                  (1)
///     H = c_head + int_0^a (z^2/EI + chi/GA) dz,
///     T = c_tail + int_a^L ((L - z)^2/EI + chi/GA) dz                          (2)
///
/// Chuck:
///     f_ww = J + M0 d^2 + S + c0 + 2 c1 a + c2 a^2,
///     f_wp = M0 d + c1 + c2 a,  f_pp = M0 + c2                                 (3)
/// Between centres, b = L - a:
///     f_ww = (b^2 H + a^2 T)/L^2,  f_wp = (a T - b H)/L^2,  f_pp = (H + T)/L^2,
///     tail reaction a/L per force, 1/L per couple                              (4)
/// Chuck-tailstock, g_w = f_aL, g_p = int_0^a (L - z)/EI dz + c1 + c2 L:
///     alpha_i = g_i/(f_LL + c_t) the tail's reaction,  f_ij = f_ij,chuck - g_i alpha_j
/// evaluated as the energy of the two loads, which subtracts nothing that a thin neck
/// could make large (rows w, p: shear gamma, moment B at the centroid, B0 at the root):
///     f_ij = M0 B_i B_j + (J + S) gamma_i gamma_j + c2 B0_i B0_j
///            + (c0 - c1^2/c2) gamma_i gamma_j + T alpha_i alpha_j              (5)
///
/// Sections: EI = pi E (re^4 - ri^4)/4, GA = pi E (re^2 - ri^2)/(2 (1 + nu)), and the
/// shear factor, m = ri/re,
///     chi = ((7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2)/(6 (1 + nu)(1 + m^2)^2) (6)
/// Solid cones and all cylinders are closed forms; hollow cones take 6 Gauss points on
/// panels so short that the rule is exact to rounding (see beam.cpp).
///
/// Valid for walls above a fifth of the radius (thin rings ovalise); sections stay plane,
/// so a diameter step costs up to 21 % unless `shoulder_correction` is used.  Linear.
/// Degenerate input: a = 0 on a rigid chuck gives zeros; head and tail centre both rigid
/// leave (4) without their terms.
/// Source: the seed (Valino et al.), Eqs. 6-8, corrected as docs/deflection.md derives;
/// Eq. 6: Cowper's shear coefficient, handbook value.  Checked in beam_test.
class Beam {
 public:
  /// @throws std::domain_error on lengths or diameters that are no body, E or nu not
  /// physical (E > 0, 0 <= nu < 0.5).
  explicit Beam(const part::Shaft& shaft);

  double length_mm() const noexcept { return length_mm_; }

  /// Flexibility at a [mm], 0 <= a <= L (beyond L by less than 1e-12 L, the rounding of
  /// sums of lengths, counts as L).
  /// @throws std::domain_error outside, or if the supports are no elastic body.
  Flexibility at(double a_mm, const Supports& supports) const;
  /// All positions at once, fastest in rising order.  `out` is as long as `a_mm`.
  void at(std::span<const double> a_mm, const Supports& supports,
          std::span<Flexibility> out) const;

  /// Eq. (1) left of a, the bare part without its supports.
  struct Body {
    double M0_rad_Nmm = 0;  ///< angular flexibility
    double d_mm = 0;        ///< how far its centroid lies behind a
    double J_mm_N = 0;      ///< its moment about the centroid
    double S_mm_N = 0;      ///< its shear
  };
  /// @throws std::domain_error unless 0 <= a <= L (as `at`).
  Body body(double a_mm) const;

  /// int_0^L dz/GJ with J = 2 I: twist of the end per unit torque [rad/(N mm)].
  double twist_rad_Nmm() const noexcept { return twist_; }

  /// A part whose body left of the tool is that of `left` and right of it that of
  /// `right`: the same positions in two shapes of the same length, as while cutting.
  /// @throws std::domain_error if the lengths differ, or as the members `at`.
  friend void flexibilities(const Beam& left, const Beam& right,
                            std::span<const double> a_mm, const Supports& supports,
                            std::span<Flexibility> out);

 private:
  /// A stretch of one closed form or of one Gauss panel, with the sums up to its left
  /// end (prefix_) and from its right end (tail_).
  struct Piece {
    double z_mm, h_mm;          // left end, length
    double re0, re1, ri0, ri1;  // radii
    double inv0, inv1;          // 1/re
    double bend, shear;         // 1/EI and chi/GA per mm of a cylinder
    double m0, d, J, S, H;      // Eqs. (1), (2) at the left end
    double b_mm, T;             // L - right end, Eq. (2) there
    enum class Kind { cylinder, solid_cone, hollow_cone } kind;
  };
  enum class Side { left, right };
  struct Stretches;
  struct Sums;

  void add_pieces(const part::Segment& segment, double z_mm);
  template <Side side>
  void measure(const Piece& piece, std::size_t n, const double* t, Stretches& out) const;
  void left_of(const Piece& piece, std::size_t first, std::size_t n, const double* t,
               Sums& out) const;
  void right_of(const Piece& piece, std::size_t first, std::size_t n, const double* t,
                Sums& out) const;
  bool holds(std::size_t piece, double a_mm) const;
  std::size_t piece_at(double a_mm, std::size_t hint) const;
  template <class Run>
  void each_run(std::size_t n, const double* a, std::size_t& piece, const Run& run) const;

  std::vector<Piece> pieces_;
  double length_mm_ = 0;
  double bend_ = 0, shear_ = 0, shear_hollow_ = 0;  // constants of E and nu
  double twist_ = 0;
};

void flexibilities(const Beam& left, const Beam& right, std::span<const double> a_mm,
                   const Supports& supports, std::span<Flexibility> out);

}  // namespace turnwright::deflection
