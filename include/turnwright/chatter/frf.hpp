#pragma once
#include <complex>
#include <optional>
#include <variant>
#include <vector>

/// Modal parameters from a frequency response measured at the cut, with force and motion
/// along one axis.
namespace turnwright::chatter {

/// A frequency response Y(w) = (i w)^d H(w): the motion under a force e^(+i w t).
struct FrequencyResponse {
  int derivative = 0;           ///< d: 0 receptance, 1 mobility, 2 accelerance
  std::vector<double> w_rad_s;  ///< rising, > 0
  std::vector<std::complex<double>> value;  ///< [mm/(s^d N)], one for each of them
  /// Sizes of the errors, > 0, to a common factor, one for each line; none: not known.
  std::vector<double> error = {};
  /// A, where H was measured at i w + A because both time series were multiplied by
  /// e^(-A t).
  double decay_1_s = 0;
};

/// A number with its standard uncertainty.
struct Measured {
  double value = 0, u = 0;
};

struct FittedMode {
  Measured wn_rad_s, zeta, k_N_mm;
};

/// A mode that noise may hide.
struct HiddenMode {
  double wn_rad_s = 0, zeta = 0;
  double k_N_mm = 0;  ///< a mode at least as stiff would not be found
  double share = 0;   ///< its peak 1/(2 zeta k) over the highest fitted one
};

struct ModalFit {
  std::vector<FittedMode> modes;  ///< rising in frequency
  Measured above_mm_N;            ///< c of (1): modes above the lines
  Measured below_mm_N_s2;         ///< b of (1): modes below the lines, free motion
  /// f of (3); none: the errors are equal at every line.
  std::optional<double> error_floor;
  double explained = 0;     ///< 1 - sum |e|^2 / sum |Y|^2; both over given errors
  double rms_measured = 0;  ///< of |Y|, over given errors
  double rms_left = 0;      ///< of |e|, over given errors
  /// Correlation of e/s at neighbouring lines, in [-1, 1]: near 0 if the residual is
  /// noise; otherwise the uncertainties are too small.
  double correlation = 0;
  /// In each octave from the first line the highest mode that (2) would not add, by (4).
  std::vector<HiddenMode> hidden;
};

/// The reason why there is no fit, with the frequency at which it appears, if any.
struct NoFit {
  enum class Why {
    too_few_lines,  ///< fewer than 3 n + 2 for n modes
    no_peak,        ///< no mode explains the lines better than (1) without any
    negative,       ///< a negative stiffness, which no mode at the driving point can have
    not_told,       ///< not determined: a standard uncertainty above half of the value, a
                    ///< peak below 1e-3 of the highest, or (2) as large as without it
    other_quantity  ///< as another `derivative` the residual is less than a tenth
  } why = Why::no_peak;
  double w_rad_s = 0;
  int derivative = 0;
};

/// Least squares of
///
///     H(w) = sum_r (1/k_r) / (1 - (w/wn_r)^2 + 2 i zeta_r w/wn_r) + c - b/w^2        (1)
///
/// over the lines: sum |Y - (i w)^d H|^2 / s^2 = sum |e|^2 / s^2 is least.  c stands for
/// modes above the lines, b for those below and for free motion.  The method is that of
/// Levenberg and Marquardt in ln wn, ln zeta, 1/k, c, b.  Modes are added one by one,
/// each at the frequency where it explains most of the residual that small changes of the
/// modes before cannot explain, and all are fitted again; the starting points tried are
/// the best three of these frequencies, and each mode split in two.
///
/// Standard uncertainties: roots of the diagonal of t^2 (J^T J)^-1, t^2 = sum |e|^2 / s^2
/// / (2 L - 3 n - 2), for L lines, J of the rows over s.
///
/// Without `modes` their number n, the order of the model, is chosen by the Bayesian
/// information criterion: it is the least n for which n + 1 modes do not lower
///
///     2 L ln(sum |e|^2 / s^2 / 2 L) + (5 n + 2) ln(2 L)                              (2)
///
/// or for which the residual is nothing but rounding (1e-12 of |Y|).  A mode counts 5 in
/// (2), not its 3 parameters, because a mode placed at the best of 2 L lines fits noise
/// better than a mode at a given line.  Only fits are considered whose modes all lie
/// inside the band, have positive stiffness and are determined by the lines (see NoFit);
/// at most kMostModes modes.  Modes whose peak |1/(2 zeta k)| is below 1e-3 of the
/// highest are then left out: they move no limit, and rounding of printed values looks
/// like them.
/// A mode of negative stiffness is a reason to refuse the response if its peak is above a
/// twentieth of the highest and if the residual without it and the modes after it is four
/// times as large.
///
/// s, the relative size of the errors, is 1 at first.  If errors that grow with the
/// response,
///
///     s^2 = |Y_fit|^2 / max |Y_fit|^2 + f^2,     f one of 0.001, 0.003, .. 0.1 (3)
///
/// make the residual likelier, that is, if 2 L ln(sum |e|^2 / s^2 / 2 L) + 4 sum ln s
/// falls by more than 5 ln(2 L), all is fitted again with them, at most twice.
///
/// If the response comes with its errors, s is in proportion to them.  H measured at
/// i w + A has modes of the same form,
///
///     wn'^2 = wn^2 + 2 zeta wn A + A^2,  zeta' wn' = zeta wn + A,  k'/k = wn'^2/wn^2
///
/// which are fitted and changed back; a mode that A alone damps is not told.  b and c of
/// (1) are then those at i w + A; `hidden` modes are damped by 0.01 with A.
///
/// A mode of compliance a at one of the lines lowers the residual by a^2 S, S the sum of
/// squares of its shape over s that the fitted modes cannot explain, up to noise of 2 t
/// in the root.  So a mode is found, as a rule, if
///
///     a sqrt(S) > t (sqrt(5 ln(2 L)) + 2)                                            (4)
///
/// with t as above.  The highest mode below that, of a damping ratio of 0.01 (a mode that
/// is damped more has a lower peak) and not within two widths of a fitted one, is
/// `hidden`.  Alone it would chatter from 1/share of the least depth on at which the
/// highest fitted mode does.
///
/// A response of which less than 0.98 is explained, or nothing, is fitted as each of the
/// other two derivatives as well, and refused if one of these leaves less than a tenth of
/// the residual.
///
/// Valid for damping that couples no modes (k real).  Source: [Levenberg 1944],
/// [Marquardt 1963]; [Schwarz 1978] for (2), the weight 5 derived here, and so the modes at
/// i w + A, from (s^2 + 2 zeta wn s + wn^2) at s + A; checked in frf_test on responses of known modes.
std::variant<ModalFit, NoFit> modal_fit(const FrequencyResponse& response,
                                        std::optional<int> modes = {});
inline constexpr int kMostModes = 8;

/// H of (1) [mm/N].
std::complex<double> receptance_mm_N(const ModalFit& fit, double w_rad_s);

}  // namespace turnwright::chatter
