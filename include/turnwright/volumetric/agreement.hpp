#pragma once
#include <optional>
#include <string>
#include <vector>

/// Comparison of two calibrations of the same parameters, each made by repeated runs.
namespace turnwright::volumetric {

/// Repeated values of one parameter, by run; none where a run has no value.
struct Runs {
  std::string name;
  std::vector<std::optional<double>> value;
};
/// The values of all runs that have one.
std::vector<double> values(const Runs& runs);

struct Summary {
  double mean = 0, sd = 0;  ///< sd of a sample, with n - 1; 0 for equal values
};
/// @throws std::domain_error for fewer than two values.
Summary summary(const std::vector<double>& values);

/// Pearson's correlation of two lists and its significance.
struct Correlation {
  double r = 0;
  /// 95 % interval of r, by Fisher's z = atanh r with standard deviation 1/sqrt(n - 3);
  /// none for n < 4.
  std::optional<double> lower, upper;
  double p =
      1;  ///< probability of such a correlation by chance: two-sided, Student, n - 2
};

struct Agreement {
  std::string name;
  Summary a, b;
  double difference = 0;  ///< a.mean - b.mean; its modulus is the thesis' "range"
  bool overlap = false;   ///< |difference| <= a.sd + b.sd
  /// Test of equal means [Welch 1947]: t, degrees of freedom, two-sided probability; none
  /// if neither list scatters.
  std::optional<double> t, dof, p;
  /// Over the runs that both have, if there are at least three and both scatter.
  std::optional<Correlation> correlation;
};

/// @throws std::domain_error if either has fewer than two runs.
Agreement agreement(const Runs& a, const Runs& b);

/// A run that differs from the others in several parameters at once.
struct CommonJump {
  std::size_t run = 0;                  ///< index from 0
  std::vector<std::string> parameters;  ///< parameters that jump in this run
  std::vector<double> jump;             ///< value of the run less the mean of the others
};

/// Runs that jump in at least two and at least half of the parameters of a group, in the
/// same direction and by amounts that differ from each other by less than half their
/// mean. A run jumps in a parameter if its distance from the mean of the others is more
/// than kJump of their standard deviations.
///
/// With four runs a single parameter exceeds kJump = 3 by chance in 12 % of the cases
/// (Student with 2 degrees of freedom and a mean of three).  That two parameters do so in
/// the same direction has the probability 0.12^2/2, times that of similar amounts.
std::vector<CommonJump> common_jumps(const std::vector<Runs>& group);

inline constexpr double kJump = 3;

/// The runs with one of them left out.
Runs without_run(const Runs& runs, std::size_t run);

}  // namespace turnwright::volumetric
