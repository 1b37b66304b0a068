#pragma once
#include <array>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

namespace turnwright::volumetric {

/// Readings of one error along its axis, by a laser or a ball array, in the error's unit.
struct AxisTable {
  std::vector<double> q;            ///< programmed positions
  std::vector<double> plus, minus;  ///< approached in + and in -; one may be empty
};

struct AxisFit {
  ErrorFunction error;
  std::array<double, 5> u{};  ///< standard uncertainties of c0 to c3 and b
  double s = 0;               ///< standard deviation of the residuals
};

/// Least-squares fit of c0 + .. + c_degree t^degree + b s to all readings, t = q/Q.  b is
/// half the difference of the two approaches, and 0 if there is only one.  Uncertainties
/// follow from the residuals; they are 0 without a degree of freedom.  If the positions
/// differ by rounding alone the error is left 0 and its uncertainty is infinite.
/// @throws std::domain_error if columns differ in length, degree is not 0 to 3, or there
///   are fewer than degree + 1 different positions.
AxisFit fit_axis(const AxisTable& table, double Q, int degree = 3);

}  // namespace turnwright::volumetric
