#pragma once
#include <vector>

#include "regression.hpp"

namespace turnwright::cutting {

/// Intercepts: a column of ones, or one column for each lab.
struct LabColumns {
  Eigen::MatrixXd X;               ///< ones where there is one lab
  std::vector<std::size_t> names;  ///< of the columns, rising
  bool several() const { return names.size() > 1; }
};
LabColumns lab_columns(const std::vector<std::size_t>& lab_of_row);

/// Their names and numbers of used rows; factors are 0 still.
Labs labs_of(const LabColumns& labs, const std::vector<std::size_t>& lab_of_row,
             const std::vector<std::size_t>& used, double s_between);

struct PooledLabs {
  Line line;        ///< pooled intercept at the origin of the columns, and the slopes
  Line deviations;  ///< of each lab from the pooled intercept, then the slopes
  double s_between = 0;     ///< standard deviation of intercepts between labs
  double s_prediction = 0;  ///< of one measurement in another lab at the middle
};

/// Labs as a random sample: the intercepts a of a line with k >= 2 of them, and their
/// covariance V, say
///
///     a ~ N(mu, V + tau^2),  (a - mu)' W (a - mu) = k - 1,  W = (V + tau^2)^-1       (1)
///     mu = w'a, w = W 1/(1'W 1), var mu = 1/(1'W 1)                                  (2)
///
/// (1) gives tau, or 0 where labs differ no more than their measurements scatter.  mu has
/// Student's distribution with k - 1 degrees of freedom; its variance is widened so
/// that an interval with the line's own degrees has that width.  Deviations a - mu are
/// those of these labs, of which V alone tells the error.
/// Source: [Paule 1982] for (1); checked in lab_fit_test.
/// @param columns  the columns behind those of the labs, of which the mean is the middle
///   at which labs are compared.
PooledLabs pooled_labs(const Line& line, Eigen::Index labs,
                       const Eigen::MatrixXd& columns, double confidence);

}  // namespace turnwright::cutting
