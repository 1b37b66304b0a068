#pragma once
#include "turnwright/deflection/response.hpp"

/// Heat, wear and the toolpost's yielding as radius errors e [mm], positive where the
/// radius comes out larger.
namespace turnwright::deflection {

/// A part that is dT [K] warmer when it is turned than when it is measured has, after
/// cooling, the radius error
///
///     e = -alpha dT D/2                                                         (1)
///
/// also in bores.  Valid for a uniformly warm section; for a thin wall that is warm on
/// one side only, the largest dT gives a bound.
/// Source: linear expansion.
/// @throws std::domain_error unless alpha >= 0, D > 0, dT is finite.
double heat_error_mm(double alpha_per_K, double dT_K, double D_mm);

struct Edge {
  double alpha_o_rad = 0;  ///< clearance, > 0
  double gamma_o_rad = 0;  ///< rake, negative for most inserts
};

/// Recession of a worn edge from the surface, with the width VB of the wear land [mm]:
///
///     r = VB tan(alpha_o)/(1 - tan(alpha_o) tan(gamma_o))                       (2)
///
/// Between two corrections of the offset the error is e = r u, with u the share of the
/// tool life used since the last one (0 to 1; the land is assumed to grow linearly over
/// the life).  In a bore the error is -e.
/// Source: derived here.  The land lies along the cutting speed; at the depth r below the
/// sharp corner the rake face has moved back by r tan(gamma_o), the flank by
/// r/tan(alpha_o), and VB is the difference.
/// @throws std::domain_error unless VB >= 0, 0 < alpha_o and alpha_o + gamma_o < pi/2 (a
/// wedge), gamma_o > -pi/2, u in [0, 1].
double wear_error_mm(double VB_mm, const Edge& edge, double life_used);

/// Tool, holder, turret and slide as one compliance in the radial direction:
///
///     e = c_rr Fr + c_rt Ft                                                     (3)
///
/// c_rr = 1/k_tool.  The cross term c_rt is the motion of the edge away from the part per
/// Ft, caused mostly by the shank's bending and the turret's rotation; it is negative
/// where that moves the edge closer.
/// Source: [Valino 2008], Eq. 5, corrected as docs/deflection.md derives.
struct Toolpost {
  double c_rr_mm_N = 0;
  double c_rt_mm_N = 0;
};

/// Radius error by Eq. (3).  @throws std::domain_error unless c_rr >= 0.
double toolpost_error_mm(const Toolpost& post, const Load& load);

/// Flexibility of part and toolpost together, for `equilibrium`: with Ft = (Ft/Fr) Fr
/// Eq. (3) adds c_rr + c_rt (Ft/Fr) to f_ww.
Flexibility with_toolpost(const Flexibility& radial, const Toolpost& post,
                          double Ft_over_Fr);

}  // namespace turnwright::deflection
