#pragma once
#include <optional>
#include <span>
#include <vector>

#include "turnwright/cutting/estimate.hpp"
#include "turnwright/cutting/life_point.hpp"

/// Taylor's constants from measured tool lives.
namespace turnwright::cutting {

/// Constants of T = (C/(vc f^a ap^b))^(1/n).
struct TaylorFit {
  std::optional<Estimate> C, n;  ///< none: see `missing`
  std::optional<Estimate> a, b;  ///< none: the given values were used
  std::optional<Labs> labs;      ///< on C; none of a single lab
  std::vector<Missing> missing;
  Evidence evidence;
};

/// Least squares on the logarithm of the life,
///
///     ln T = (ln C)/n - (1/n) ln vc - (a/n) ln f - (b/n) ln ap                       (1)
///
/// because lives scatter and conditions do not.  a and b are fitted where feed and depth
/// varied independently of the speed, that is, where the part of their logarithm that the
/// other variables do not explain has a standard deviation of 0.02; otherwise the given
/// values are kept.  n is -1 over a coefficient and the other constants are ratios of
/// two, such as ln C = -c0/c1; their intervals are Fieller's, exact for normal errors.  n
/// and C cannot be identified where the speed hardly varied, or where the life does not
/// fall with it beyond doubt.
///
/// Where some lives are only known to be longer, (1) is the line of greatest likelihood
/// for lives of a lognormal distribution (Tobit); what the lives determine is then judged
/// by those that ended, r of them.  Intervals come from the observed information, widened
/// by r/(r - p) for p coefficients, with Student's t of r - p degrees of freedom.  No life
/// is then left out as an outlier.
///
/// Several labs share n, a and b, and each has its own C, as in fit_kienzle.  A lab in
/// which no life ended says nothing, and its lives are not used.
/// Source: [Fieller 1954] for ratios, [Tobin 1958]; derived here from (1), checked in
/// material_fit_test, life_fit_test and, of labs, lab_fit_test.
/// @throws std::domain_error if a number is not positive and finite; ModelRangeError if
///   the measurements do not separate the exponents.
TaylorFit fit_taylor(std::span<const LifePoint> lives, double given_a, double given_b,
                     const FitOptions& options = {});

}  // namespace turnwright::cutting
