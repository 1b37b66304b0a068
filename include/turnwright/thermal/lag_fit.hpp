#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/thermal/lag_model.hpp"

namespace turnwright::thermal {

/// The error beside the inputs that caused it.
struct DriftLog {
  Inputs inputs;
  std::vector<double> error_um;
};

struct FitOptions {
  int lags = 0;                          ///< 1 or 2; 0 chooses by cross-validation
  double T0_degC = 20;                   ///< c_um belongs to it; the fit is the same
  bool soaked_start = false;             ///< a_um = 0 rather than fitted
  std::optional<double> n_max_rpm = {};  ///< none: the highest speed of the rows fitted
  std::optional<double> p = {};          ///< none: fitted
  double p_min = 0.5, p_max = 3;         ///< bearing friction to windage
  std::optional<double> tau_min_s = {};  ///< none: the median step of the log
  std::optional<double> tau_max_s = {};  ///< of the spindle; none: the log's length
  /// Of the ambient; none: 100 times the length of the log, near enough to a structure
  /// that only integrates.
  std::optional<double> tau_amb_max_s = {};
};

enum class Found {
  inside,    ///< fitted, inside its bounds
  at_lower,  ///< the fit wants less than its bound
  at_upper,  ///< the fit wants more than its bound
  given,     ///< set by the options
  unknown,   ///< nothing in the log depends on it
};

struct Parameter {
  std::string name;  ///< the member of LagModel: "tau_1_s", "K_1_um", "p", ...
  double value = 0;
  double u = 0;  ///< standard uncertainty; 0 unless Found::inside
  Found found = Found::inside;
  /// At a bound, unknown, or u above half the value: the rest of the fit leans on it, it
  /// does not stand for itself.
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
  /// Root mean square error of the blocks left out, with one and with two lags; none if
  /// the number was given or the log is too short for blocks.
  std::optional<double> one_lag_um, two_lags_um;
};

/// LagModel fitted to the first `rows` rows of a log.
///
///     min over theta of min over k of |e - A(theta) k|^2                             (4)
///     theta = (tau_j, tau_amb, p),  k = (K_j, b, a, c)
///
/// Variable projection: for given lags and exponent the rest is linear and solved by QR;
/// its residual r is a function of the nonlinear parameters alone, with the gradient
/// -r' (dA/d theta) k of half its square, since k is a minimum itself.  Local solves from
/// a fixed grid of starts in ln tau, with tau_2 >= 2 tau_1: nearer lags are one lag and
/// its derivative by tau, with K_1 and K_2 running off in opposite signs.
///
/// Standard uncertainties: with J the Jacobian by all parameters inside their bounds and
/// rho the correlation of neighbouring residuals,
///
///     C = s^2 (J'J)^-1 (1 + rho)/(1 - rho),   s^2 = r'r/(rows - parameters)          (5)
///
/// (5) is right for residuals of a first-order autoregression and inputs that move slower
/// than it forgets.  A drift log's residuals are mostly what the model does not know;
/// taken as independent they would make u some ten times too small.
///
/// One lag or two: the log is cut into kBlocks blocks of equal time; each but the first
/// is predicted by a fit to the others (the inputs are known throughout; the first alone
/// knows how the log began).  A second lag is taken if it lowers the mean square error of
/// the blocks left out by more than kEarned.
///
/// Source: [Golub 1973] for (4), variable projection; the rest derived here.
/// @throws std::domain_error as drift_um, or if errors are not as many as times or rows
///   are more; ModelRangeError if the rows are fewer than kLeastRows, or the spindle never
///   turns in them.
Choice fit_lags(const DriftLog& log, std::size_t rows, const FitOptions& options = {});

inline constexpr std::size_t kLeastRows = 20;
inline constexpr std::size_t kBlocks = 8;
inline constexpr double kEarned = 0.1;

/// Standard uncertainty [um] of drift_um at every row, from the fit's covariance: what
/// the parameters leave open, not what the model does not know.
std::vector<double> drift_uncertainty_um(const LagFit& fit, const Inputs& inputs);

}  // namespace turnwright::thermal
