#pragma once
#include <span>
#include <vector>

#include "turnwright/thermal/inputs.hpp"

/// Thermal drift of a spindle from its speed and the ambient temperature.
namespace turnwright::thermal {

/// One heat store of the spindle.
struct Lag {
  double tau_s = 0;  ///< time constant
  double K_um = 0;   ///< its part of the drift in thermal equilibrium at n_max
};

/// Drift e [um] of the tool against the part, by first-order lags:
///
///     e(t) = sum_j K_j x_j(t) + b w(t) + a exp(-(t - t_0)/tau_amb) + c              (1)
///     tau_j dx_j/dt = (n(t)/n_max)^p - x_j,          x_j(t_0) = 0                   (2)
///     tau_amb dw/dt = (T_amb(t) - T0) - w,           w(t_0) = T_amb(t_0) - T0       (3)
///
/// Symbols: t time [s], t_0 the first row's, n spindle speed [1/min], p exponent of the
/// heat over speed, T_amb ambient [degC], w the low-passed ambient's distance from T0
/// [K], b [um/K], c [um] the drift of a cold spindle in a machine in equilibrium at T0.
/// a [um] represents the time before t_0, when the structure was a/b [K] away from its
/// ambient; it is equivalent to a free w(t_0).
///
/// Valid for a spindle that is cold at the first row, within the speeds and ambient
/// temperatures of the log.  Neglects the heat of the cut and of the coolant, and
/// centrifugal growth that follows the speed at once, except where a lag as short as the
/// sampling time represents it.
///
/// Degenerate input: one row gives b w + a + c there.
///
/// Source: lumped heat balance, one equation for each store, derived here.
struct LagModel {
  std::vector<Lag> lags = {};
  double p = 1;
  double n_max_rpm = 0;
  double tau_amb_s = 0;
  double b_um_K = 0;
  double a_um = 0;
  double c_um = 0;
  double T0_degC = 20;
};

/// e [um] at every row.  It is exact for any step, because (2) and (3) have closed forms
/// between rows.
/// @throws std::domain_error if the inputs differ in length or the times do not rise.
std::vector<double> drift_um(const LagModel& model, const Inputs& inputs);

/// The inputs with additional rows at `times_s`; times outside the inputs are omitted.
Inputs with_rows_at(const Inputs& inputs, std::span<const double> times_s);

/// `first` followed by `later`, whose times count from the end of `first`; the first row
/// of `later` replaces the last row of `first`.
Inputs joined(const Inputs& first, const Inputs& later);

}  // namespace turnwright::thermal
