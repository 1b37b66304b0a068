#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "turnwright/catalogue/material.hpp"

/// Constants of a material from measured cuts, with confidence intervals.
namespace turnwright::cutting {

struct Estimate {
  double value = 0, lower = 0, upper = 0;
};

/// Measurements and scatter on which a fit rests.
struct Evidence {
  std::vector<std::size_t> used;      ///< indices of the measurements
  std::vector<std::size_t> outliers;  ///< indices left out of the fit, rising
  int degrees_of_freedom = 0;
  double s = 0;             ///< standard deviation of the logarithm of one measurement
  double s_prediction = 0;  ///< the same of a further cut at the mean of the conditions

  /// Replaces the index i of each measurement by names[i].
  void rename(const std::vector<std::size_t>& names);
};

/// A constant that the cuts do not determine, and a cut that would.
struct Missing {
  std::string parameter, test;
};

struct FitOptions {
  double confidence = 0.95;  ///< of every interval
  double outlier_p = 0.01;   ///< chance to find an outlier in good cuts; 0: keep all
};

struct ForcePoint {
  double h_mm = 0, b_mm = 0, F_N = 0;
};

/// k1.1 and m of F = k1.1 b h^(1-m).
struct KienzleFit {
  std::optional<Estimate> k11_MPa, m;  ///< none: see `missing`
  std::vector<Missing> missing;
  Evidence evidence;
};

/// Least squares on the logarithm of the specific force,
///
///     ln(F/(b h)) = ln k1.1 - m ln h                                                 (1)
///
/// whose error is the relative error of the force, equally large for all forces.
/// Intervals are by Student's t.  Neither constant can be identified where the thickest
/// chip is less than 1.05 times the thinnest, or with fewer than three cuts.
///
/// Outliers: the measurement with the largest externally studentised residual is left
/// out as long as such a residual is less likely than outlier_p divided by the number of
/// measurements (Bonferroni).  At most a fifth is left out, and at least three more than
/// the unknowns are kept.
/// Source: linear regression; checked in material_fit_test.
/// @throws std::domain_error if a number is not positive and finite; ModelRangeError if
///   the measurements do not separate the exponents.
KienzleFit fit_kienzle(std::span<const ForcePoint> cuts, const FitOptions& options = {});

/// A measured part of the thrust force: F = F_D share.
struct ThrustPoint {
  double Fc_N = 0, L_mm = 0;  ///< cutting force and engaged length of the edge
  double share = 0;           ///< cosine (of Fp) or sine (of Ff) of the chip's flow, > 0
  double F_N = 0;
};

/// lambda and ke of F_D = lambda Fc + ke L.
struct ThrustFit {
  std::optional<Estimate> ratio, edge_N_mm;  ///< none: fewer than three cuts
  bool scaled = false;                       ///< the given constants times one number
  Evidence evidence;
};

/// Least squares on the logarithm of the force, by Gauss and Newton,
///
///     ln F = ln((lambda Fc + ke L) share)                                            (3)
///
/// with intervals and outliers as in fit_kienzle.  Where the cuts do not tell the two
/// constants apart, or one of them would be negative, `given` is scaled as a whole.
/// Source: linear regression of each step; checked in force_fit_test.
/// @throws std::domain_error if a number is not positive and finite.
ThrustFit fit_thrust(std::span<const ThrustPoint> cuts, const catalogue::Thrust& given,
                     const FitOptions& options = {});

struct LifePoint {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0, T_min = 0;
};

/// Constants of T = (C/(vc f^a ap^b))^(1/n).
struct TaylorFit {
  std::optional<Estimate> C, n;  ///< none: see `missing`
  std::optional<Estimate> a, b;  ///< none: the given values were used
  std::vector<Missing> missing;
  Evidence evidence;
};

/// Least squares on the logarithm of the life,
///
///     ln T = (ln C)/n - (1/n) ln vc - (a/n) ln f - (b/n) ln ap                       (2)
///
/// because lives scatter and conditions do not.  a and b are fitted where feed and depth
/// varied independently of the speed, that is, where the part of their logarithm that the
/// other variables do not explain has a standard deviation of 0.02; otherwise the given
/// values are kept.  n is -1 over a coefficient and the other constants are ratios of
/// two, such as ln C = -c0/c1; their intervals are Fieller's, exact for normal errors.  n
/// and C cannot be identified where the speed hardly varied, or where the life does not
/// fall with it beyond doubt.
/// Source: [Fieller 1954] for ratios; derived here from (2), checked in
/// material_fit_test.
/// @throws std::domain_error if a number is not positive and finite; ModelRangeError if
///   the measurements do not separate the exponents.
TaylorFit fit_taylor(std::span<const LifePoint> lives, double given_a, double given_b,
                     const FitOptions& options = {});

}  // namespace turnwright::cutting
