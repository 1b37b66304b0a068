#pragma once
#include <vector>

#include "turnwright/learning/series.hpp"

/// Values that do not belong to a series.
///
/// First what is grossly off: |y - median| > 8 x 1.4826 MAD, three times the width over which
/// a steady trend runs, so that no trend is taken for a mix-up (MAD: median of the absolute
/// deviations from the median).  Then the generalised extreme studentised deviate: the value
/// with the largest
///
///     t_i = r_i sqrt((nu - 1)/(RSS (1 - h_i) - r_i^2))                               (1)
///
/// is left out, again and again, up to a tenth of the values and twenty at most; those up to
/// the last whose |t| is beyond
///
///     t_{1 - p/(2 m), nu - 1}                                                        (2)
///
/// are outliers, m the values still in.  So several do not hide each other.  r are residuals
/// of the fit within edges (trend.hpp, (2)), h their leverages, nu its degrees of freedom;
/// of a series without trend and edges this is Rosner's test, whose lambda_i is (2) in terms
/// of the deviation.
/// Source: [Rosner 1983]; (1), (2) for a regression derived here; outliers_test has Rosner's
/// sample.
namespace turnwright::learning {

/// Indices in the series, rising.
/// @param p  chance to name one in a good series; 0: none are named.
std::vector<std::size_t> outliers(const Series& series, double p);

/// The series without some of its values.
Series without(const Series& series, const std::vector<std::size_t>& left_out);

}  // namespace turnwright::learning
