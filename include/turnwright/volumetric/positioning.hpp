#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/volumetric/axis_table.hpp"

namespace turnwright::volumetric {

/// A target position of an axis and the deviations on approaching it from either side:
/// actual less programmed position of the tool relative to the workpiece.
struct Target {
  double q_mm = 0;
  std::vector<double> plus_mm, minus_mm;  ///< moving in + and in -
};

/// The readings of a table by position, rising; rows of one position are approaches to it.
std::vector<Target> targets(const AxisTable& readings_mm);

/// What is known of one position.  Values of a direction are missing if the position was not
/// approached in it, standard deviations also after one approach.
struct PositionValues {
  double q_mm = 0;
  std::size_t approaches_plus = 0, approaches_minus = 0;
  std::optional<double> mean_plus_mm, mean_minus_mm;
  std::optional<double> s_plus_mm, s_minus_mm;  ///< of a sample, with n - 1
  std::optional<double> mean_mm, B_mm, R_mm;    ///< of both directions, (1) to (3)
};

/// The positions between which something of an axis lies.
struct Extent {
  double low_mm = 0, high_mm = 0;
  double width_mm() const { return high_mm - low_mm; }
};

/// Accuracy and repeatability of positioning of one axis.  With the means x+ and x- of the
/// deviations at position i, and their standard deviations s+ and s-,
///
///     mean deviation       x_i = (x+ + x-)/2                                          (1)
///     reversal             B_i = x+ - x-,  B = max |B_i|,  B_mean = mean of B_i       (2)
///     repeatability        R_i+ = 4 s+,  R_i- = 4 s-,
///                          R_i = max(2 s+ + 2 s- + |B_i|, R_i+, R_i-),
///                          R+, R-, R: the largest of each                             (3)
///     mean deviation       M = max x_i - min x_i                                      (4)
///     systematic deviation E+ = max x+ - min x+,  E- likewise,
///                          E = max(x+, x-) - min(x+, x-)                              (5)
///     accuracy             A+ = max(x+ + 2 s+) - min(x+ - 2 s+),  A- likewise,
///                          A = max(x+ + 2 s+, x- + 2 s-) - min(x+ - 2 s+, x- - 2 s-)  (6)
///
/// A value is missing if any position lacks what it is computed from.
/// Source: ISO 230-2:2014, as clause 3 defines them with a coverage factor of 2; from general
/// knowledge, checked against a public report in positioning_test.
struct Iso230_2 {
  std::vector<PositionValues> positions;
  std::optional<double> B_mm, B_mean_mm;
  std::optional<double> R_plus_mm, R_minus_mm, R_mm;
  std::optional<Extent> M, E_plus, E_minus, E, A_plus, A_minus, A;
};
Iso230_2 iso230_2(std::span<const Target> targets);

/// How many positions ISO 230-2 has at least: five a metre and five in all; beyond 2 m one
/// every 250 mm on the average.
std::size_t positions_wanted(double travel_mm);

/// How often ISO 230-2 approaches each position from each side: five times; beyond 2 m once,
/// without repeatability and accuracy, which it tests over 2 m of such an axis.
std::size_t approaches_wanted(double travel_mm);

/// Whether three positions or more stand at one interval, but for rounding.  An error that
/// repeats with this interval, as that of a ball screw's pitch, is then not seen; ISO 230-2
/// lets the positions vary.
bool evenly_spaced(std::span<const Target> targets);

/// An error at programmed position q and sign of motion s; catalogue/geometric_errors.hpp (1).
double error_at(const ErrorFunction& error, double q, double Q, double s);

}  // namespace turnwright::volumetric
