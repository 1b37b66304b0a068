#pragma once
#include <optional>
#include <span>

namespace turnwright::learning {

/// Test of normality of residuals after Anderson and Darling, mean and variance estimated.
///
///     A^2 = -n - (1/n) sum_i (2 i - 1) [ln F_i + ln(1 - F_{n+1-i})],  F_i = Phi(z_(i))  (1)
///     A*  = A^2 (1 + 0.75/n + 2.25/n^2)                                               (2)
///
/// z are the residuals in rising order over their standard deviation; p follows from A* by
/// the four formulas of [D'Agostino 1986] as R's `nortest::ad.test` has them.  Residuals of
/// a trend count like a sample of as many parts.
/// Valid for n >= 8.
/// Source: (1) [Anderson 1952]; the formulas as read in nortest; normality_test simulates
/// the level and compares a published sample.
struct Normality {
  double A2 = 0;  ///< A*
  double p = 1;   ///< chance of as much of a normal sample
};

/// None of fewer than eight residuals, or where they do not scatter.
std::optional<Normality> normality(std::span<const double> residuals);

}  // namespace turnwright::learning
