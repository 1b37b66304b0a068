#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Constants of a material from measured cuts, with confidence intervals.
namespace turnwright::cutting {

struct Estimate {
  double value = 0, lower = 0, upper = 0;
};

/// What a fit rests on.
struct Evidence {
  std::vector<std::size_t> used;      ///< indices of the measurements
  std::vector<std::size_t> outliers;  ///< left out; rising
  int degrees_of_freedom = 0;
  double s = 0;             ///< standard deviation of the logarithm of one measurement
  double s_prediction = 0;  ///< the same of the next one at the middle of the cuts
};

/// A constant that the cuts cannot tell, and a cut that would.
struct Missing {
  std::string parameter, test;
};

struct FitOptions {
  double confidence = 0.95;  ///< of every interval
  double outlier_p = 0.01;   ///< chance to call a good set of cuts spoilt; 0: keep all
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
/// whose error is the relative error of the force, alike for large and small ones.
/// Intervals by Student's t.  Not identifiable: both, where the thickest chip is less
/// than 1.05 times the thinnest, or with fewer than three cuts.
///
/// Outliers: the measurement with the largest externally studentised residual is left
/// out while that is less likely than outlier_p over the number of measurements
/// (Bonferroni), up to a fifth of them, never below three beyond the unknowns.
/// Source: regression as in any textbook; derived here, material_fit_test covers.
/// @throws std::domain_error if a number is not positive and finite; ModelRangeError if
///   the measurements do not tell the exponents apart.
KienzleFit fit_kienzle(std::span<const ForcePoint> cuts, const FitOptions& options = {});

struct LifePoint {
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0, T_min = 0;
};

/// Constants of T = (C/(vc f^a ap^b))^(1/n).
struct TaylorFit {
  std::optional<Estimate> C, n;  ///< none: see `missing`
  std::optional<Estimate> a, b;  ///< none: taken as given
  std::vector<Missing> missing;
  Evidence evidence;
};

/// Least squares on the logarithm of the life,
///
///     ln T = (ln C)/n - (1/n) ln vc - (a/n) ln f - (b/n) ln ap                       (2)
///
/// for lives scatter and conditions do not.  a and b come out where feed and depth moved
/// apart from the speed (a standard deviation of 0.02 in what is left of their logarithm
/// after the others); else their given values stay.  n is -1 over a coefficient, the
/// others are ratios of two, ln C = -c0/c1: their intervals are Fieller's, exact for
/// normal errors.  Not identifiable: n and C, where the speed hardly moved or the life
/// does not fall with it beyond doubt. Source: [Fieller 1954] for ratios; derived here
/// from (2), material_fit_test covers.
/// @throws std::domain_error if a number is not positive and finite; ModelRangeError if
///   the measurements do not tell the exponents apart.
TaylorFit fit_taylor(std::span<const LifePoint> lives, double given_a, double given_b,
                     const FitOptions& options = {});

}  // namespace turnwright::cutting
