#pragma once
#include <span>
#include <vector>

#include "turnwright/deflection/workpiece.hpp"

namespace turnwright::deflection {

/// One clamping in both planes; both have the same method.
struct Clamping {
  Supports radial, tangential;
};

/// Cutting force on the part [N]: Fr pushes it away from the tool, Ft along the cutting
/// speed, Fa towards the chuck (negative when turning away from it).
struct Load {
  double Fr_N = 0, Ft_N = 0, Fa_N = 0;
};

/// Response of an outside surface of diameter D to a load at z = a.
///
///     C = -Fa D/2                                  couple of the feed force     (1)
///     delta_r = f_ww Fr + f_wp C,  theta_r = f_wp Fr + f_pp C      (radial)     (2)
///     delta_t = f_ww Ft                                            (tangential) (3)
///     radius error e = delta_r + delta_t^2/D                                    (4)
///
/// Positive delta means that the part yields and the radius comes out larger by e.
/// Eq. (4) is the expansion of hypot(D/2 + delta_r, delta_t) - D/2; the first neglected
/// term is delta_t^2 delta_r/D^2.  Tool, toolpost and heat are not included.
/// Source: [Valino 2008], Eqs. 1 and 2, corrected as docs/deflection.md derives.
struct Response {
  double a_mm = 0, D_mm = 0;
  Flexibility radial, tangential;
  double delta_r_mm = 0, delta_t_mm = 0, theta_r_rad = 0;
  double radius_error_mm = 0;
  double tail_reaction_N = 0;  ///< of the tail centre in the radial plane, against Fr
};

/// The response by Eqs. (1) to (4).  @throws std::domain_error unless D > 0.
Response response(double a_mm, double D_mm, const Flexibility& radial,
                  const Flexibility& tangential, const Load& load);

/// The responses at positions on a workpiece.  D is the finished diameter there; at a
/// step it is that of the left segment.
std::vector<Response> responses(const Workpiece& part, const Clamping& clamping,
                                std::span<const double> a_mm, const Load& load);

}  // namespace turnwright::deflection
