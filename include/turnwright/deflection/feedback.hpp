#pragma once
#include <span>
#include <vector>

#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {

/// Force that follows the depth really cut: a part that gives way by e is cut by ap - e.
///
///     Fr = c (ap - e)^x,  Fa = (Fa/Fr) Fr,  Ft = (Ft/Fr) Fr                     (1)
struct ForceLaw {
  double c_N = 0;  ///< Fr at 1 mm depth, > 0
  double x = 1;    ///< exponent of the depth, > 0
  double Fa_over_Fr = 0, Ft_over_Fr = 0;
  double ap_mm = 0;  ///< set depth, > 0
};

/// Where the part and the force agree.
///
///     e = A Fr + B Fr^2,  A = f_ww - f_wp (Fa/Fr) D/2,  B = (f_ww,t Ft/Fr)^2/D  (2)
///     loop gain mu = A c x ap^(x-1)                                             (3)
///
/// (1) and (2) are solved for the depth h = ap - e by Newton's method kept in a bracket
/// by bisection; taking (1) and (2) in turns diverges for mu > 1.  For x = 1 and B = 0,
/// e = ap mu/(1 + mu).
/// Degenerate input: A < 0 (the couple pulls the part in) cuts deeper than ap; then the
/// solution is the first depth above ap.
/// Source: derived here, checked in feedback_test.
struct Equilibrium {
  double Fr_N = 0;
  double radius_error_mm = 0;                   ///< e
  double radius_error_without_feedback_mm = 0;  ///< e at Fr = c ap^x
  double loop_gain = 0;
};

/// @throws std::domain_error unless c, x, ap and D are positive; ModelRangeError if the
/// part is pulled in without end (no depth up to 100 ap).
Equilibrium equilibrium(double D_mm, const Flexibility& radial,
                        const Flexibility& tangential, const ForceLaw& law);

/// Radius errors e_n [mm] of passes in a row at one place, set depths `ap_mm`: each also
/// has to cut what the one before has left, ap_n + e_(n-1).  (x = 1, B = 0:
/// e_n = (ap_n + e_(n-1)) mu/(1 + mu).)  `law.ap_mm` is not used.
std::vector<double> radius_errors_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential, ForceLaw law,
                                            std::span<const double> ap_mm);

}  // namespace turnwright::deflection
