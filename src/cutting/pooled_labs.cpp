#include "pooled_labs.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "turnwright/base/dual.hpp"

namespace turnwright::cutting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastVariance = 1e-20;  // rounding of logarithms

struct PooledMean {
  double mu = 0, variance = 0, tau2 = 0;
  VectorXd weights;
};

// Eq. (2), and in `excess` the left side of (1) less k - 1.
PooledMean mean_with(const VectorXd& a, const MatrixXd& V, double tau2, double& excess) {
  const Index k = a.size();
  const MatrixXd all = V + (tau2 + kLeastVariance) * MatrixXd::Identity(k, k);
  const auto solved = all.ldlt();
  const VectorXd ones = solved.solve(VectorXd::Ones(k));
  PooledMean m;
  m.tau2 = tau2;
  m.variance = 1 / ones.sum();
  m.weights = m.variance * ones;
  m.mu = m.weights.dot(a);
  const VectorXd rest = a - VectorXd::Constant(k, m.mu);
  excess = rest.dot(solved.solve(rest)) - static_cast<double>(k - 1);
  return m;
}

// Eq. (1) by bisection: the left side falls with tau^2, and at the plain variance of the
// intercepts it is at most k - 1.
PooledMean mean_of_labs(const VectorXd& a, const MatrixXd& V) {
  constexpr int kHalvings = 60;
  double excess = 0;
  const PooledMean alike = mean_with(a, V, 0, excess);
  if (!(excess > 0)) return alike;
  double low = 0, high = (a.array() - a.mean()).matrix().squaredNorm() /
                         static_cast<double>(a.size() - 1);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    mean_with(a, V, middle, excess);
    (excess > 0 ? low : high) = middle;
  }
  return mean_with(a, V, high, excess);
}

}  // namespace

LabColumns lab_columns(const std::vector<std::size_t>& lab_of_row) {
  LabColumns labs;
  labs.names = lab_of_row;
  std::ranges::sort(labs.names);
  labs.names.erase(std::unique(labs.names.begin(), labs.names.end()), labs.names.end());
  const auto n = static_cast<Index>(lab_of_row.size());
  if (!labs.several()) {
    labs.X = MatrixXd::Ones(n, 1);
    return labs;
  }
  labs.X = MatrixXd::Zero(n, static_cast<Index>(labs.names.size()));
  for (Index i = 0; i < n; ++i) {
    const auto lab = lab_of_row[static_cast<std::size_t>(i)];
    labs.X(i, std::ranges::lower_bound(labs.names, lab) - labs.names.begin()) = 1;
  }
  return labs;
}

Labs labs_of(const LabColumns& labs, const std::vector<std::size_t>& lab_of_row,
             const std::vector<std::size_t>& used, double s_between) {
  Labs out{.each = {}, .s_between = s_between};
  for (const std::size_t name : labs.names) {
    const auto n =
        std::ranges::count_if(used, [&](std::size_t i) { return lab_of_row[i] == name; });
    out.each.push_back({name, static_cast<std::size_t>(n), {}});
  }
  return out;
}

PooledLabs pooled_labs(const Line& line, Index k, const MatrixXd& columns,
                       double confidence) {
  const Index q = columns.cols();
  const Eigen::RowVectorXd middle = columns.colwise().mean();
  MatrixXd to_middle = MatrixXd::Identity(k + q, k + q);
  to_middle.topRightCorner(k, q).rowwise() = middle;
  const VectorXd c = to_middle * line.c;
  const MatrixXd V = to_middle * line.covariance * to_middle.transpose();
  const PooledMean mean = mean_of_labs(c.head(k), V.topLeftCorner(k, k));

  PooledLabs out;
  out.s_between = std::sqrt(mean.tau2);
  out.s_prediction = std::sqrt(sqr(line.s) + mean.tau2 + mean.variance);

  MatrixXd pool = MatrixXd::Zero(1 + q, k + q);  // to (mu, slopes)
  pool.row(0).head(k) = mean.weights;
  pool.bottomRightCorner(q, q).setIdentity();
  MatrixXd to_origin = MatrixXd::Identity(1 + q, 1 + q);
  to_origin.row(0).tail(q) = -middle;
  MatrixXd pooled = pool * V * pool.transpose();
  const double wider =
      student(confidence, static_cast<double>(k - 1)) / student(confidence, line.degrees);
  pooled(0, 0) = mean.variance * std::max(1.0, sqr(wider));
  out.line = line;
  out.line.c = to_origin * pool * c;
  out.line.covariance = to_origin * pooled * to_origin.transpose();

  MatrixXd deviate = MatrixXd::Identity(k + q, k + q);
  deviate.topLeftCorner(k, k).rowwise() -= mean.weights.transpose();
  out.deviations = line;
  out.deviations.c = deviate * c;
  out.deviations.covariance = deviate * V * deviate.transpose();
  return out;
}

}  // namespace turnwright::cutting
