#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/thermal/lag_model.hpp"

namespace turnwright::thermal {

/// The measured drift and the inputs that caused it.
struct DriftLog {
  Inputs inputs;
  std::vector<double> error_um;
};

struct FitOptions {
  int lags = 0;                          ///< 1 or 2; 0 chooses by cross-validation
  double T0_degC = 20;                   ///< reference of c_um; does not change the fit
  bool soaked_start = false;             ///< true: a_um = 0 instead of fitted
  std::optional<double> n_max_rpm = {};  ///< none: the highest speed of the rows fitted
  std::optional<double> p = {};          ///< none: fitted
  double p_min = 0.5, p_max = 3;         ///< bearing friction to windage
  std::optional<double> tau_min_s = {};  ///< none: the median step of the log
  std::optional<double> tau_max_s = {};  ///< of the spindle; none: the log's length
  /// Largest tau of the ambient; none: 100 times the length of the log, which is close
  /// enough to a structure that only integrates.
  std::optional<double> tau_amb_max_s = {};
};

enum class Found {
  inside,    ///< fitted, inside its bounds
  at_lower,  ///< at its lower bound
  at_upper,  ///< at its upper bound
  given,     ///< set by the options
  unknown,   ///< no value of the log depends on it
};

struct Parameter {
  std::string name;  ///< the member of LagModel: "tau_1_s", "K_1_um", "p", ...
  double value = 0;
  double u = 0;  ///< standard uncertainty; 0 unless Found::inside
  Found found = Found::inside;
  /// True at a bound, if unknown, or if u is above half the value.  The value then serves
  /// the fit as a whole and has no meaning by itself.
  bool ill_determined = false;
};

struct LagFit {
  LagModel model;
  std::vector<Parameter> parameters;
  std::vector<double> covariance;  ///< of `parameters`, row by row; 0 where u is 0
  double rms_um = 0;               ///< of the rows fitted
  double autocorrelation = 0;      ///< rho of neighbouring residuals, [0, 1)
};

struct Choice {
  LagFit fit;
  /// Root mean square error of the omitted blocks, with one and with two lags; none if
  /// the number of lags was given or the log is too short for blocks.
  std::optional<double> one_lag_um, two_lags_um;
};

/// Fit of a LagModel to the first `rows` rows of a log.
///
///     min over theta of min over k of |e - A(theta) k|^2                             (4)
///     theta = (tau_j, tau_amb, p),  k = (K_j, b, a, c)
///
/// Variable projection: for given lags and exponent the problem is linear and solved by
/// QR.  Its residual r is a function of the nonlinear parameters alone, and half its
/// square has the gradient -r' (dA/d theta) k, because k is itself a minimum.  Local
/// searches start from a fixed grid in ln tau, with tau_2 >= 2 tau_1: two closer lags are
/// one lag and its derivative by tau, with K_1 and K_2 growing without bound in opposite
/// signs.
///
/// Standard uncertainties: with J the Jacobian by all parameters inside their bounds and
/// rho the correlation of neighbouring residuals,
///
///     C = s^2 (J'J)^-1 (1 + rho)/(1 - rho),   s^2 = r'r/(rows - parameters)          (5)
///
/// (5) holds for residuals of a first-order autoregression and inputs that change more
/// slowly than its memory.  The residuals of a drift log are mostly errors of the model;
/// if they were taken as independent u would be some ten times too small.
///
/// One lag or two: the log is divided into kBlocks blocks of equal time.  Each block but
/// the first is predicted by a fit to the others; the first is needed because it alone
/// determines the initial state.  A second lag is used if it lowers the mean square error
/// of the omitted blocks by more than the share kEarned.
///
/// Source: [Golub 1973] for (4), variable projection; the rest derived here.
/// @throws std::domain_error as drift_um, if the numbers of errors and times differ, or
///   if `rows` exceeds them; ModelRangeError if `rows` is less than kLeastRows, or the
///   spindle never turns in them.
Choice fit_lags(const DriftLog& log, std::size_t rows, const FitOptions& options = {});

inline constexpr std::size_t kLeastRows = 20;
inline constexpr std::size_t kBlocks = 8;
inline constexpr double kEarned = 0.1;

/// Standard uncertainty [um] of drift_um at every row, from the fit's covariance.  It
/// contains the uncertainty of the parameters, not the error of the model.
std::vector<double> drift_uncertainty_um(const LagFit& fit, const Inputs& inputs);

}  // namespace turnwright::thermal
