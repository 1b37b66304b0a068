#pragma once
#include <optional>
#include <span>

#include "turnwright/cutting/life_fit.hpp"

namespace turnwright::cutting {

enum class LifeDistribution { lognormal, weibull };

/// How the lives of edges scatter about Taylor's law.
struct LifeScatter {
  LifeDistribution distribution = LifeDistribution::lognormal;  ///< the likelier
  double ln_likelihood_ratio = 0;  ///< of lognormal over Weibull's
  double weibull_shape = 0;        ///< the most likely
  /// Standard deviation of ln T between edges at equal conditions; none without repeats.
  std::optional<Estimate> s_between;
  /// Standard deviation of ln T by which the law misses the conditions beyond that, and
  /// the chance of as much where it holds; none without s_between or conditions to spare.
  std::optional<double> s_lack_of_fit, lack_of_fit_p;
  /// Lives that half and 90 % of the edges reach at the middle of the conditions.
  Estimate T50_min, T90_min;
  double vc_m_min = 0, f_mm_rev = 0, ap_mm = 0;  ///< the middle, of logarithms
};

/// Scatter of the lives that fit_taylor used, by maximum likelihood with both
/// distributions of
///
///     T = T(vc, f, ap) exp(s z),  z normal: lognormal;  exp(z) exponential: Weibull's
///                                 with the shape 1/s                                 (1)
///
/// Both have as many constants, so that the greater likelihood chooses; T50 and T90 are of
/// that distribution, with intervals by the observed information as in fit_taylor.
///
/// Lives repeated at equal speed, feed, depth and lab have a mean of each condition
/// instead of the law; what they scatter about it is that between edges, with an interval
/// by chi-squared.  Of more than 100 such conditions the first are used.  The law's lack of
/// fit is what its own scatter has beyond, by Fisher's F:
///
///     F = MS/s_between^2,  MS = (nu s^2 - nu_e s_between^2)/(nu - nu_e),
///     s_lack_of_fit^2 = max(0, MS - s_between^2)/(lives that ended per condition)     (2)
///
/// exact without censoring.
/// Source: [Weibull 1951]; (2) is the usual test of pure error; life_fit_test compares with
/// another program.
/// @param fit  of the same lives; has n.
LifeScatter scatter_of_lives(std::span<const LifePoint> lives, const TaylorFit& fit,
                             double given_a, double given_b,
                             const FitOptions& options = {});

}  // namespace turnwright::cutting
