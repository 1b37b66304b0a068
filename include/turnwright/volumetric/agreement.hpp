#pragma once
#include <optional>
#include <string>
#include <vector>

/// Two calibrations of the same parameters, each by repeated runs, held against each
/// other.
namespace turnwright::volumetric {

/// Repeated values of one parameter, by run; none where a run lacks it.
struct Runs {
  std::string name;
  std::vector<std::optional<double>> value;
};
/// Without the gaps.
std::vector<double> values(const Runs& runs);

struct Summary {
  double mean = 0, sd = 0;  ///< sd of a sample: by n - 1; 0 of equal values
};
/// @throws std::domain_error of fewer than two values.
Summary summary(const std::vector<double>& values);

/// Pearson's correlation of two lists and what it is worth.
struct Correlation {
  double r = 0;
  /// Of r, 95 %, by Fisher's z = atanh r with standard deviation 1/sqrt(n - 3); none for
  /// n < 4.
  std::optional<double> lower, upper;
  double p = 1;  ///< of as much correlation by chance, two-sided, Student with n - 2
};

struct Agreement {
  std::string name;
  Summary a, b;
  double difference = 0;  ///< a.mean - b.mean; its modulus is the thesis' "range"
  bool overlap = false;   ///< |difference| <= a.sd + b.sd
  /// Test of equal means [Welch 1947]: t, degrees of freedom, two-sided probability; none
  /// if neither list scatters.
  std::optional<double> t, dof, p;
  /// Over the runs that both have, if they are three or more and scatter in both.
  std::optional<Correlation> correlation;
};

/// @throws std::domain_error if one has fewer than two runs.
Agreement agreement(const Runs& a, const Runs& b);

/// A run that stands apart from the others in several parameters at once.
struct CommonJump {
  std::size_t run = 0;                  ///< from 0
  std::vector<std::string> parameters;  ///< that jump in it
  std::vector<double> jump;             ///< run less the mean of the others
};

/// Runs that jump in at least two parameters of a group and half of them, in the same
/// sense and by amounts that differ from each other by less than half their mean.  A run
/// jumps in a parameter if its distance from the mean of the others is more than kJump of
/// their standard deviations.
///
/// kJump = 3 alone would fire by chance at four runs (Student with 2 degrees of freedom
/// and a mean of three: 12 %); that two parameters do so by like amounts has a chance of
/// 0.12^2/2 times that of likeness.
std::vector<CommonJump> common_jumps(const std::vector<Runs>& group);

inline constexpr double kJump = 3;

/// Without the value of one run.
Runs without_run(const Runs& runs, std::size_t run);

}  // namespace turnwright::volumetric
