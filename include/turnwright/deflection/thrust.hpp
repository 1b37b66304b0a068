#pragma once
#include "turnwright/deflection/beam.hpp"

namespace turnwright::deflection {

/// Thrust of the tailstock [N] at which the part would buckle between its supports.
///
/// With K(x, y) the rotation at y per unit couple at x, m0(x) = int_0^x dz/EI,
/// h(x) = int_0^x (L - z)/EI dz,
///
///     centres:          K = m0(min(x, y)) - (h(x) + h(y))/L + (h_LL + c_h + c_t)/L^2
///     chuck-tailstock:  K = m0(min(x, y)) + c2 - g(x) g(y)/(f_LL + c_t),
///                       g(x) = h(x) + c1 + c2 L                                 (1)
///     w'(y) = P int_0^L K(x, y) w'(x) dx                                        (2)
///
/// is the effect on a bent part of a thrust P along the axis of the machine, and 1/P_cr
/// is the largest eigenvalue of K.  (2) is evaluated at the middle of at least 160 equal
/// parts, 16 in every segment, and iterated; the sums are of second order in the length
/// of the parts.  The error is 1e-3 (for uniform parts 1e-4).  Neglects shear, which
/// makes the part softer by P_cr chi/GA (1 % at L = 8 D).
/// Source: derived here from beam.hpp (4) to (6); pi^2 EI/L^2 and 20.19 EI/L^2 in
/// thrust_test.
/// @throws std::domain_error as Beam, or if the supports have no tailstock.
double critical_thrust_N(const part::Shaft& shaft, const Supports& supports);

/// Factor by which a thrust P increases the deflection under the tool at most,
///
///     f(P) <= f/(1 - P/P_cr)                                                    (3)
///
/// Valid for 0 <= P < P_cr, f_ww and f_pp, every position and every support.  In the
/// buckling modes, which are orthogonal for the part's stiffness and for the thrust's,
/// f(P) = sum_n f_n/(1 - P/P_n) with all f_n >= 0 and P_n >= P_cr.  The bound is exact
/// where the part bends in the first mode only; in the middle between centres it is too
/// large by 0.1 % at P = 0.1 P_cr and by 1.2 % at 0.5 P_cr.
/// Source: derived here.
/// @throws std::domain_error unless 0 <= P < P_cr.
double thrust_amplification(double P_N, double P_cr_N);

}  // namespace turnwright::deflection
