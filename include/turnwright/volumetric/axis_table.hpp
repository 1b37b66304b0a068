#pragma once
#include <array>
#include <vector>

#include "turnwright/volumetric/machine.hpp"

namespace turnwright::volumetric {

/// One error read along its axis by a laser or a ball array, in the error's unit.
struct AxisTable {
  std::vector<double> q;            ///< programmed positions
  std::vector<double> plus, minus;  ///< approached in + and -; one of them may be empty
};

struct AxisFit {
  ErrorFunction error;
  std::array<double, 5> u{};  ///< standard uncertainties of c0 to c3 and b
  double s = 0;               ///< standard deviation of the residuals
};

/// Least squares of c0 + .. + c_degree t^degree + b s over all readings, t = q/Q; b is
/// half the difference of the two approaches, 0 if there is only one.  Uncertainties from
/// the residuals, 0 if they leave no degree of freedom, infinite, of an error left 0, if
/// the positions differ by rounding alone.
/// @throws std::domain_error if columns differ in length, degree is not 0 to 3, or fewer
///   than degree + 1 positions differ.
AxisFit fit_axis(const AxisTable& table, double Q, int degree = 3);

}  // namespace turnwright::volumetric
