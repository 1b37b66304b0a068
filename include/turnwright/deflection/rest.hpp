#pragma once
#include <span>

#include "turnwright/deflection/beam.hpp"

namespace turnwright::deflection {

/// A steady rest as an elastic support in one plane; compliance 0 is rigid.
struct SteadyRest {
  double z_mm = 0;
  double compliance_mm_N = 0;
};

struct RestedFlexibility {
  Flexibility part;
  double rest_per_N = 0;    ///< the rest's reaction per unit force, against it
  double rest_per_Nmm = 0;  ///< and per unit couple
};

/// The part with its usual supports and a steady rest at z_s.  Every position costs O(1)
/// once its segment is known.
///
/// A body (beam.hpp, Eqs. 1 and 2) rotates and shifts the section at its end by
///
///     [X + M d^2, +-M d; +-M d, M] (V, m), + for the left side, - for the right    (1)
///
/// An end that turns freely has infinite M, a missing support infinite X.
///
/// The rest, of compliance c, acts in parallel with the other supports of the part on the
/// side of z_s away from the tool (M, d, X as seen from z_s).  Together they are again a
/// body:
///
///     M' = M (c + X)/(c + X + M d^2),  d' = d c/(c + X),  X' = c X/(c + X)      (2)
///
/// The length between z_s and the tool is joined to it by the parallel-axis rule.  The
/// two sides l and r, D = d_l + d_r and mu = M_l M_r/(M_l + M_r), share a force and a
/// couple at the tool so that the energy is least:
///
///     Delta = X_l + X_r + mu D^2,  V_w = (X_r + mu D d_r)/Delta,  V_p = -mu D/Delta
///     B_w = (d_l X_r - d_r X_l)/Delta,  B_p = (X_l + X_r)/Delta                 (3)
///     f_ww = X_l V_w^2 + X_r (1 - V_w)^2 + mu B_w^2,
///     f_wp = X_l V_w V_p - X_r (1 - V_w) V_p + mu B_w B_p,
///     f_pp = (X_l + X_r) V_p^2 + mu B_p^2                                       (4)
///
/// with V the left side's share of the force and mu B the moment in both.  f_ww and f_pp
/// are sums of squares.  The rest's reaction follows from the force R and the couple m
/// that reach z_s: it takes ((X + M d^2) R +- M d m)/(c + X + M d^2).
///
/// Valid for an elastic rest that stays in contact (its rollers are pressed against the
/// part with more than the reaction) and that does not bend the part when it is set.
/// Source: derived here from beam.hpp (1); checked against finite elements with a spring
/// in rest_test.
class RestedBeam {
 public:
  /// @throws std::domain_error as Beam, unless 0 < z_s < L and the compliance is >= 0.
  RestedBeam(const part::Shaft& shaft, const Supports& supports, const SteadyRest& rest);
  /// For a part in the middle of a cut: the shapes left and right of the tool, of equal
  /// length.
  RestedBeam(const part::Shaft& left_of_tool, const part::Shaft& right_of_tool,
             const Supports& supports, const SteadyRest& rest);

  /// @throws std::domain_error unless 0 <= a <= L.
  RestedFlexibility at(double a_mm) const;

 private:
  double z_mm_, length_mm_, c_;
  bool has_tail_;
  Beam from_root_, to_rest_;       // [0, z_s]: left of the tool; right of it, from z_s
  Beam from_rest_, to_tail_;       // [z_s, L]: left of the tool; right of it, from L
  Body root_, tail_;               // the supports alone
  Body behind_, ahead_;            // left and right of z_s, without the rest
  Body held_behind_, held_ahead_;  // the same with the rest, Eq. (2)
};

/// Flexibility with a follow rest of compliance c > 0 at the tool itself:
///
///     f_ww' = f_ww c/(f_ww + c),  f_wp' = f_wp c/(f_ww + c),
///     f_pp' = f_pp - f_wp^2/(f_ww + c)                                          (5)
///
/// The tail's reaction per force is reduced by the same factor; that per couple loses
/// tail_per_N f_wp/(f_ww + c).  With c = 0 the section can rotate but not move.
/// Source: derived here; it is the limit z_s = a of a steady rest.
/// @throws std::domain_error unless c >= 0 and f_ww + c > 0.
Flexibility follow_rest(const Flexibility& f, double compliance_mm_N);

}  // namespace turnwright::deflection
