#pragma once
#include "turnwright/deflection/response.hpp"

/// What else moves the edge or the surface on a lathe, each as a radius error e [mm],
/// positive where more radius is left.
namespace turnwright::deflection {

/// A part turned warm by dT [K] above the temperature it is measured at shrinks by
///
///     e = -alpha dT D/2                                                         (1)
///
/// of its radius, bores likewise.  Valid for an evenly warm section; a thin wall that is
/// warm on one side only is bounded by the warmest dT.
/// Source: linear expansion.
/// @throws std::domain_error unless alpha >= 0, D > 0, dT is finite.
double heat_error_mm(double alpha_per_K, double dT_K, double D_mm);

struct Edge {
  double alpha_o_rad = 0;  ///< clearance, > 0
  double gamma_o_rad = 0;  ///< rake, negative for most inserts
};

/// How far a worn edge has gone back from the surface, VB the flank's wear land [mm]:
///
///     r = VB tan(alpha_o)/(1 - tan(alpha_o) tan(gamma_o))                       (2)
///
/// and e = r u between two corrections of the offset, u the share of the tool life used
/// since the last one (0 to 1; the land is taken to grow evenly over the life).  In a
/// bore the error is -e.
/// Source: derived here.  The land lies along the cutting speed; at the depth r below the
/// sharp corner the rake face has moved back by r tan(gamma_o), the flank by
/// r/tan(alpha_o), and VB is the difference.
/// @throws std::domain_error unless VB >= 0, 0 < alpha_o and alpha_o + gamma_o < pi/2 (a
/// wedge), gamma_o > -pi/2, u in [0, 1].
double wear_error_mm(double VB_mm, const Edge& edge, double life_used);

/// Tool, holder, turret and slide as one compliance towards and away from the part.
///
///     e = c_rr Fr + c_rt Ft                                                     (3)
///
/// c_rr = 1/k_tool; the cross term is how far the edge goes away from the part under Ft
/// alone, mostly the shank bending down and the turret turning; negative where that
/// brings the edge closer.
/// Source: [Valino 2008], Eq. 5, corrected as docs/deflection.md derives.
struct Toolpost {
  double c_rr_mm_N = 0;
  double c_rt_mm_N = 0;
};

/// Eq. (3).  @throws std::domain_error unless c_rr >= 0.
double toolpost_error_mm(const Toolpost& post, const Load& load);

/// The part as the cut feels it with the toolpost in the same loop: Eq. (3) with
/// Ft = (Ft/Fr) Fr is a further f_ww = c_rr + c_rt (Ft/Fr), for `equilibrium`.
Flexibility with_toolpost(const Flexibility& radial, const Toolpost& post,
                          double Ft_over_Fr);

}  // namespace turnwright::deflection
