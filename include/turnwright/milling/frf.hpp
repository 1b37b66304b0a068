#pragma once
#include <complex>
#include <optional>
#include <variant>
#include <vector>

/// Modes from a frequency response measured at the cut, force and motion along one axis.
namespace turnwright::milling {

/// Y(w) = (i w)^d H(w): what moves under a force e^(+i w t).
struct FrequencyResponse {
  int derivative = 0;           ///< d: 0 receptance, 1 mobility, 2 accelerance
  std::vector<double> w_rad_s;  ///< rising, > 0
  std::vector<std::complex<double>> value;  ///< [mm/(s^d N)], one for each of them
};

/// A number with its standard uncertainty.
struct Measured {
  double value = 0, u = 0;
};

struct FittedMode {
  Measured wn_rad_s, zeta, k_N_mm;
};

struct ModalFit {
  std::vector<FittedMode> modes;  ///< rising in frequency
  Measured above_mm_N;            ///< c of (1): modes above the lines
  Measured below_mm_N_s2;         ///< b of (1): what moves below the lines
  double explained = 0;           ///< 1 - sum |e|^2 / sum |Y|^2
  double rms_measured = 0;        ///< of |Y|
  double rms_left = 0;            ///< of |e|
  /// Of e at neighbouring lines, in [-1, 1]: near 0 if what is left is noise.  Where it
  /// is not the uncertainties are too small.
  double correlation = 0;
};

/// Why there is no fit, with the frequency that tells it, if one does.
struct NoFit {
  enum class Why {
    too_few_lines,  ///< fewer than 3 n + 2 for n modes
    no_peak,        ///< no mode explains the lines better than (1) without any
    negative,       ///< a drive point's mode has a stiffness > 0, so Im H < 0 at its peak
    not_told        ///< a standard uncertainty above half of the value, or (2) is no
                    ///< less than with one mode less
  } why = Why::no_peak;
  double w_rad_s = 0;
};

/// Least squares of
///
///     H(w) = sum_r (1/k_r) / (1 - (w/wn_r)^2 + 2 i zeta_r w/wn_r) + c - b/w^2        (1)
///
/// over the lines: sum |Y - (i w)^d H|^2 = sum |e|^2 is least, which is right where
/// errors of Y are alike at every line.  c stands for modes above the lines, b for those
/// below and for free motion.  Levenberg and Marquardt's method in ln wn, ln zeta, 1/k,
/// c, b. Modes are added one by one, each where it explains most of what is left apart
/// from small changes of those before, and all are fitted anew; the starts tried are the
/// best three of these and each mode split in two.
///
/// Standard uncertainties: roots of the diagonal of s^2 (J^T J)^-1, s^2 = sum |e|^2 /
/// (2 L - 3 n - 2), for L lines.
///
/// Without `modes` their number n is the least that one more does not improve by the
/// criterion of Schwarz,
///
///     2 L ln(sum |e|^2 / 2 L) + (5 n + 2) ln(2 L)                                    (2)
///
/// (5, not 3, as the best of 2 L places fits noise better than a given one)
/// or that leaves nothing but rounding (1e-12 of |Y|), or whose next mode is not told by
/// the lines, not among them, or of negative stiffness and a peak below a twentieth of
/// the highest; at most kMostModes.
///
/// Valid for damping that couples no modes (k real).  Source: derived here; (2) as in any
/// text on the choice of models; checked in frf_test on responses of known modes.
std::variant<ModalFit, NoFit> modal_fit(const FrequencyResponse& response,
                                        std::optional<int> modes = {});
inline constexpr int kMostModes = 8;

/// H of (1) [mm/N].
std::complex<double> receptance_mm_N(const ModalFit& fit, double w_rad_s);

}  // namespace turnwright::milling
