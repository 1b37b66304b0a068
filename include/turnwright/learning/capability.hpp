#pragma once
#include "turnwright/learning/trend.hpp"

/// How well a series keeps its limits.
///
///     Cp  = (U - L)/(6 s)        Pp  = (U - L)/(6 s_o)                               (1)
///     Cpk = min(U - m, m - L)/(3 s)      Ppk likewise with s_o                       (2)
///
/// U, L are the limits, m the mean of all parts, s the scatter from part to part without
/// trends (trend.hpp, (2)), s_o the standard deviation of all parts, trends and edges in it.
/// Without a lower limit there is no Cp and Pp, and (2) has U alone.
///
/// Intervals: nu s^2/sigma^2 is chi-squared, hence
///
///     s sqrt(nu/chi^2_{1-a/2}) <= sigma <= s sqrt(nu/chi^2_{a/2})                    (3)
///     Cp sqrt(chi^2_{a/2}/nu) <= Cp <= Cp sqrt(chi^2_{1-a/2}/nu)                     (4)
///     Cpk +- z sqrt(var m/(9 s^2) + Cpk^2/(2 nu))                                    (5)
///
/// For independent parts var m = s^2/n, and (5) is Bissell's interval.  nu of s is that of
/// the trend; that of s_o follows from the first two moments of
///
///     (n - 1) s_o^2 = sum (y - m)^2,
///     E = (n - 1) s^2 + M,  Var = 2 (n - 1) s^4 + 4 s^2 M,  nu_o = 2 E^2/Var         (6)
///
/// M the sum of squares of the parts' expected values about their mean, by the fit within
/// edges less what scatter adds to it.  m, s_o, Pp and Ppk are those of the batch as it was
/// made, on these edges and with these corrections: the same trend makes s_o known better
/// than by n - 1.  The next batch has other edges; `edges` of the trend tells how they
/// scatter.  All presume normal scatter, which normality.hpp tests.
/// Source: (1), (2), (4) the usual definitions [Montgomery 2013]; (5) [Bissell 1990], with
/// var m and nu of a trend derived here; (6) derived here from the moments of a non-central
/// chi-squared variable.  capability_test compares (4), (5) with published numbers and
/// simulates the coverage of all.
namespace turnwright::learning {

struct Indices {
  Estimate s_mm;
  std::optional<Estimate> p;  ///< Cp or Pp; none without a lower limit
  Estimate pk;                ///< Cpk or Ppk
};

struct Capability {
  double overall_degrees = 0;  ///< nu_o
  Indices within, overall;     ///< C and P
};

/// None where nothing scatters.
std::optional<Capability> capability(const Series& series, const Trend& trend,
                                     const Limits& limits, double confidence);

}  // namespace turnwright::learning
