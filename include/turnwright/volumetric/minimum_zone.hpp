#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace turnwright::volumetric {

struct Zone {
  double width = 0;                ///< max - min of the residuals
  std::vector<double> parameters;  ///< of the model, constant first
};

/// Narrowest zone between two parallel surfaces of a linear family that contains all
/// values:
///
///     min over x of max_i r_i - min_i r_i,   r_i = v_i - sum_j x_j a_ij              (1)
///
/// A straight line's zone has a = (z), a plane's (x, y), a circle's (cos, sin), a
/// cylinder's (cos, sin, z cos, z sin); a constant is always part of the family.
///
/// (1) is twice the best uniform approximation, a linear programme in the family's m
/// unknowns, constant included.  Its dual has m + 1 rows; the simplex method on it is the
/// exchange of m + 1 reference points, which ends at points that touch the two sides of
/// the zone alternately.  Columns that depend on those before them get the parameter 0.
///
/// Exact to rounding for the linear model; the circle's and the cylinder's are linear for
/// deviations small against the radius, e^2/(2 r) is neglected.
/// Source: [Stiefel 1959], the exchange; checked in minimum_zone_test against a search
/// over all references.
/// @param basis  a_ij row by row, `columns` of them, without the constant.
/// @throws std::domain_error if basis is not values x columns, there are no values, or
///   one of them is not finite.
Zone minimum_zone(std::span<const double> basis, std::size_t columns,
                  std::span<const double> values);

/// The zone about the least-squares surface, which is never narrower than the minimum
/// zone.
Zone least_squares_zone(std::span<const double> basis, std::size_t columns,
                        std::span<const double> values);

}  // namespace turnwright::volumetric
