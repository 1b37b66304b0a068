#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/catalogue/material.hpp"
#include "turnwright/cutting/estimate.hpp"

/// Constants of a material from measured cuts, with confidence intervals.
namespace turnwright::cutting {

struct ForcePoint {
  double h_mm = 0, b_mm = 0, F_N = 0;
  std::size_t lab = 0;
};

/// k1.1 and m of F = k1.1 b h^(1-m).
struct KienzleFit {
  std::optional<Estimate> k11_MPa, m;  ///< none: see `missing`
  std::optional<Labs> labs;            ///< on k1.1; none of a single lab
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
/// Several labs share m, and each has its own k1.1, which scatters about the pooled one.
/// A further cut (s_prediction) is then one in another lab.
/// Source: linear regression; checked in material_fit_test, of labs in lab_fit_test.
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

}  // namespace turnwright::cutting
