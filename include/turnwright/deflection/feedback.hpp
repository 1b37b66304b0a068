#pragma once
#include <span>
#include <vector>

#include "turnwright/deflection/response.hpp"

namespace turnwright::deflection {

/// Force as a function of the depth that is really cut, which is ap - e where the part
/// yields by e:
///
///     Fr = c (ap - e)^x,  Fa = (Fa/Fr) Fr,  Ft = (Ft/Fr) Fr                     (1)
struct ForceLaw {
  double c_N = 0;  ///< Fr at 1 mm depth, > 0
  double x = 1;    ///< exponent of the depth, > 0
  double Fa_over_Fr = 0, Ft_over_Fr = 0;
  double ap_mm = 0;  ///< set depth, > 0
};

/// Equilibrium of the deflection and the force that causes it:
///
///     e = A Fr + B Fr^2,  A = f_ww - f_wp (Fa/Fr) D/2,  B = (f_ww,t Ft/Fr)^2/D  (2)
///     loop gain mu = A c x ap^(x-1)                                             (3)
///
/// f_ww, f_wp and f_ww,t are flexibilities of the part (beam.hpp), D is its diameter.
/// (1) and (2) are solved for the depth h = ap - e by Newton's method, safeguarded by
/// bisection; evaluating (1) and (2) alternately would diverge for mu > 1.  For x = 1
/// and B = 0, e = ap mu/(1 + mu).
/// Degenerate input: for A < 0 the couple pulls the part towards the tool and the cut is
/// deeper than ap; the solution is then the first depth above ap.
/// Source: derived here, checked in feedback_test.
struct Equilibrium {
  double Fr_N = 0;
  double radius_error_mm = 0;                   ///< e
  double radius_error_without_feedback_mm = 0;  ///< e at Fr = c ap^x
  double loop_gain = 0;
};

/// @throws std::domain_error unless c, x, ap and D are positive; ModelRangeError if the
/// part is pulled in without an equilibrium at any depth up to 100 ap.
Equilibrium equilibrium(double D_mm, const Flexibility& radial,
                        const Flexibility& tangential, const ForceLaw& law);

/// Radius errors e_n [mm] of successive passes at one position with set depths `ap_mm`.
/// Each pass also meets the stock that the one before has not removed: its depth is
/// ap_n + e_(n-1).  For x = 1 and B = 0, e_n = (ap_n + e_(n-1)) mu/(1 + mu).
/// `law.ap_mm` is not used.
std::vector<double> radius_errors_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential, ForceLaw law,
                                            std::span<const double> ap_mm);

}  // namespace turnwright::deflection
