#pragma once
#include <Eigen/Core>
#include <vector>

#include "turnwright/learning/series.hpp"

/// The series as a table for regressions, and its fit within edges: (2) of trend.hpp.
namespace turnwright::learning {

/// Columns of x: 1, `at`, `age`; the latter two count from their means.
enum Column : Eigen::Index { kConstant, kAt, kAge };
using Columns = std::vector<Eigen::Index>;

/// Degrees of freedom with which a fit is one.
inline constexpr double kLeastDegrees = 3;

struct Table {
  Eigen::MatrixXd x;               ///< a row for each part, three columns
  Eigen::VectorXd y;               ///< less the corrections in force
  std::vector<Eigen::Index> edge;  ///< of each row, from 0 without gaps
  std::vector<std::size_t> edges;  ///< their indices in the series
  Eigen::VectorXd n;               ///< rows of each edge
  Eigen::MatrixXd mean_x;          ///< of each edge
  Eigen::VectorXd mean_y;
  Eigen::Vector3d origin;  ///< 1, mean `at`, mean `age`
};

/// @param one_edge  all parts as of one edge.
Table table_of(const Series& series, bool one_edge);

/// Columns of x and y less a share (one for each edge) of the mean of their edge.
struct Reduced {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
};
Reduced reduced(const Table& table, const Columns& columns, const Eigen::VectorXd& share);

/// Those of `at` and `age` that vary and are no multiples of each other; of two that are, age.
struct Independent {
  Columns columns;
  bool alike = false;  ///< both vary, in proportion
};
/// @param x  columns `at` and `age`.
Independent independent(const Eigen::MatrixXd& x);

struct Within {
  Columns columns;
  bool alike = false;
  Eigen::VectorXd beta;
  Eigen::MatrixXd inverse;  ///< (x'x)^-1
  double rss = 0, degrees = 0;
  Eigen::VectorXd residual, leverage;
};
Within within_fit(const Table& table);

}  // namespace turnwright::learning
