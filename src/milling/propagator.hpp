#pragma once
#include <vector>

#include "turnwright/milling/system.hpp"

namespace turnwright::milling {

/// The fundamental matrix of a stretch of the period, as a polynomial in kappa:
///
///     Phi(kappa) = sum_j P_j kappa^j,   coefficients[j m^2 + row m + column]
struct SubArc {
  std::size_t degree = 0;
  std::vector<double> coefficients;
};

/// One period, cut into stretches; Phi of the period is their product, the last leftmost.
/// States: (eta_i, eta_i'/wn_i) of the modes in their order; m of them.
struct Propagator {
  std::size_t states = 0;
  double log_det =
      0;  ///< ln det Phi = -2 tau sum zeta_i wn_i for every kappa (Liouville)
  std::vector<SubArc> stretches;
};

/// An arc with what bounds the response in it.
struct ArcLoad {
  Arc arc;
  double length_s = 0;
  double largest_MPa = 0;  ///< of the directional factors, row sums of moduli (sampled)
};

/// The arcs of a system at one spindle speed.
std::vector<ArcLoad> arc_loads(const System& system, double n_rpm);

/// How finely a propagator is made.  The integrand of (2) turns by 2 `phase_rad` at most
/// in a stretch, and there are so many nodes p that
///
///     (phase_rad/2)^2p / (2p)! <= error                                            (3)
///
/// which is what Gauss's rule leaves of a wave of that phase at the end of a stretch.
struct Resolution {
  double phase_rad = 6;
  double error = 1e-17;
};
inline constexpr Resolution kCoarse{6, 1e-14};
inline constexpr Resolution kFine{5, 1e-19};

/// On the stability boundary q(t - tau) = q(t)/mu, so that (2) of system.hpp becomes
///
///     u' = (A - kappa B(t)) u,   kappa = w (1 - 1/mu)                              (1)
///
/// with the matrix A of free vibration, and B of the directional factors.  On each
/// stretch Phi is the Neumann series of the Volterra equation
///
///     Phi(t) = e^(A t) - kappa int_0^t e^(A (t - s)) B(s) Phi(s) ds                (2)
///
/// on Gauss-Legendre nodes.  Where h goes like a broken power of the distance from an end
/// the nodes are s^q apart from it, which makes the integrand smooth.
///
/// Only q enters B, so (2) is iterated for q alone.  Good for |kappa| <= kappa_max_mm.
/// Source: derived here; checked in accuracy_test against Bulirsch and Stoer's method.
Propagator propagator(const System& system, const std::vector<ArcLoad>& arcs,
                      double n_rpm, double kappa_max_mm, const Resolution& resolution);

/// About ln |Phi| over one period for |kappa| <= kappa_mm: by this the size of a first
/// series in kappa is chosen; nothing rests on it.
double growth(const System& system, const std::vector<ArcLoad>& arcs, double kappa_mm);

}  // namespace turnwright::milling
