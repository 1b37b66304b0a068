#pragma once
#include <vector>

#include "collocation_grid.hpp"

namespace turnwright::chatter {

/// The fundamental matrix of an interval of the period, as a polynomial in kappa:
///
///     Phi(kappa) = sum_j P_j kappa^j,   coefficients[j m^2 + row m + column]
struct SubArc {
  std::size_t degree = 0;
  std::vector<double> coefficients;
};

/// One period, divided into intervals; Phi of the period is their product, the last
/// leftmost.  The m states are (eta_i, eta_i'/wn_i) of the modes in their order.
struct Propagator {
  std::size_t states = 0;
  double log_det =
      0;  ///< ln det Phi = -2 tau sum zeta_i wn_i for every kappa (Liouville)
  std::vector<SubArc> stretches;
};

/// On the stability boundary q(t - tau) = q(t)/mu, so that (2) of system.hpp becomes
///
///     u' = (A - kappa B(t)) u,   kappa = w (1 - 1/mu)                              (1)
///
/// with the matrix A of free vibration, and B of the directional factors.  On each
/// interval Phi is the Neumann series of the Volterra equation
///
///     Phi(t) = e^(A t) - kappa int_0^t e^(A (t - s)) B(s) Phi(s) ds                (2)
///
/// on Gauss-Legendre nodes.  Where h behaves like a fractional power of the distance from
/// an end the nodes are graded as s^q, which makes the integrand smooth.
///
/// Only q enters B, so (2) is iterated for q alone.  Valid for |kappa| <= kappa_max_mm.
/// Source: derived here; checked in accuracy_test against Bulirsch and Stoer's method.
Propagator propagator(const System& system, const std::vector<ArcLoad>& arcs,
                      double n_rpm, double kappa_max_mm, const Resolution& resolution);

}  // namespace turnwright::chatter
