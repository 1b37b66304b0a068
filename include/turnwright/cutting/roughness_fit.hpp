#pragma once
#include <optional>
#include <span>

#include "turnwright/cutting/cut.hpp"
#include "turnwright/cutting/estimate.hpp"

namespace turnwright::cutting {

struct RoughnessPoint {
  double f_mm_rev = 0;
  std::optional<double> Ra_um, Rz_um;  ///< one of them; Ra where both are given
};

struct RoughnessFit {
  std::optional<Estimate> hmin_mm;  ///< none: fewer than two cuts
  bool below_corner = false;        ///< no hmin at all is best: measured below f^2/(8 r)
  Evidence evidence;
};

/// The least chip thickness hmin of Rz_um and Ra_um in cut.hpp, by least squares on the
/// logarithm of the roughness over hmin >= 0,
///
///     S(hmin) = sum (ln R - ln R(f, hmin))^2                                         (1)
///
/// with an interval of all hmin for which S <= S_least (1 + t^2/(n - 1)), t Student's
/// of n - 1 degrees of freedom: the one of F's test, which ends at 0 where hmin cannot be
/// told from none.  No measurement is left out as an outlier.
/// Every single R rises with hmin, so the least S lies between the least and the largest
/// hmin of single cuts; it is searched on a grid there, then by bracketing.
/// Source: [Brammertz 1961] for the law; the fit is derived here, checked in
/// roughness_fit_test.
/// @param edge  the tool: its corner, which has a radius, and its wiper factor.
/// @throws std::domain_error if a number is not positive and finite.
RoughnessFit fit_roughness(std::span<const RoughnessPoint> cuts, const Cut& edge,
                           const FitOptions& options = {});

}  // namespace turnwright::cutting
