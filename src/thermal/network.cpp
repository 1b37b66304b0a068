#include "turnwright/thermal/network.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/optimise/local.hpp"
#include "turnwright/optimise/nnls.hpp"

namespace turnwright::thermal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kOfNeuron = kInputs + 2;  // w_h0, w_h1 .., v_h
constexpr double kLargestWeight = 50;           // tanh is a step long before
constexpr int kDirections = 400;                // along which outermost rows are sought
constexpr double kOnHull = 1e-6;  // standardised distance taken for rounding

// Uniform in [-1, 1); the distributions of <random> differ between libraries.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1;
}

Row standardised(const Network& net, const Row& x) {
  Row z{};
  for (std::size_t i = 0; i < kInputs; ++i)
    if (net.scale[i] > 0) z[i] = (x[i] - net.mean[i]) / net.scale[i];
  return z;
}

// Mean and standard deviation; a spread that is only rounding counts as zero.
std::pair<double, double> moments(std::span<const double> v) {
  double mean = 0, square = 0;
  for (const double x : v) mean += x / static_cast<double>(v.size());
  for (const double x : v)
    square += (x - mean) * (x - mean) / static_cast<double>(v.size());
  const double s = std::sqrt(square);
  return {mean, s > 1e-12 * std::abs(mean) ? s : 0};
}

struct Standard {
  MatrixXd Z;  // a row of 1 above the inputs, a column for each row trained on
  VectorXd e;
};

// Eq. (10) and its gradient.  W: hidden x (1 + inputs), v: hidden.
void loss(const Standard& data, std::size_t hidden, double decay,
          std::span<const double> weights, optimise::Values& out) {
  const auto H = static_cast<Index>(hidden), I = static_cast<Index>(kInputs);
  const auto n = static_cast<double>(data.e.size());
  const auto count = static_cast<double>(weights.size());
  const Eigen::Map<
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
      neurons(weights.data(), H, I + 2);
  const Eigen::Map<const VectorXd> all(weights.data(),
                                       static_cast<Index>(weights.size()));
  const MatrixXd T = (neurons.leftCols(I + 1) * data.Z).array().tanh();
  const VectorXd v = neurons.col(I + 1);
  const VectorXd r = (T.transpose() * v).array() + weights.back() - data.e.array();
  out.f = 0.5 * r.squaredNorm() / n + 0.5 * decay * all.squaredNorm() / count;
  MatrixXd G(H, I + 2);
  const MatrixXd inner = ((1 - T.array().square()).colwise() * v.array()).matrix();
  G.leftCols(I + 1) =
      (inner.array().rowwise() * r.transpose().array()).matrix() * data.Z.transpose() / n;
  G.col(I + 1) = T * r / n;
  for (Index h = 0; h < H; ++h)
    for (Index j = 0; j < I + 2; ++j)
      out.df[static_cast<std::size_t>(h * (I + 2) + j)] = G(h, j);
  out.df.back() = r.mean();
  for (std::size_t k = 0; k < weights.size(); ++k)
    out.df[k] += decay * weights[k] / count;
}

std::vector<Row> outermost(const Network& net, std::span<const Row> rows) {
  std::mt19937_64 random(0);
  std::set<std::size_t> kept;
  for (int d = 0; d < kDirections; ++d) {
    leave_if_asked();
    Row direction{};
    for (double& x : direction) x = uniform(random);
    // The axes come first, in both directions.
    if (d < static_cast<int>(2 * kInputs)) {
      direction = {};
      direction[static_cast<std::size_t>(d / 2)] = d % 2 ? -1 : 1;
    }
    std::size_t furthest = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Row z = standardised(net, rows[k]);
      double along = 0;
      for (std::size_t i = 0; i < kInputs; ++i) along += direction[i] * z[i];
      if (along > most) {
        most = along;
        furthest = k;
      }
    }
    kept.insert(furthest);
  }
  std::vector<Row> out;
  for (const std::size_t k : kept) out.push_back(rows[k]);
  return out;
}

}  // namespace

Network train(std::span<const Row> rows, std::span<const double> error_um,
              const NetworkOptions& options) {
  if (rows.empty() || rows.size() != error_um.size() || options.hidden == 0 ||
      options.starts == 0)
    throw std::domain_error(
        "train: rows must be one or more, error_um one for each, hidden and starts > 0");
  const auto n = static_cast<Index>(rows.size());
  Network net{.hidden = options.hidden, .least = rows[0], .largest = rows[0]};
  for (std::size_t i = 0; i < kInputs; ++i) {
    std::vector<double> column;
    for (const Row& row : rows) column.push_back(row[i]);
    std::tie(net.mean[i], net.scale[i]) = moments(column);
    const auto [low, high] = std::ranges::minmax(column);
    net.least[i] = low;
    net.largest[i] = high;
  }
  std::tie(net.error_mean_um, net.error_scale_um) = moments(error_um);
  if (!(net.error_scale_um > 0)) net.error_scale_um = 1;

  Standard data{MatrixXd::Ones(static_cast<Index>(kInputs) + 1, n), VectorXd(n)};
  for (Index k = 0; k < n; ++k) {
    const Row z = standardised(net, rows[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < kInputs; ++i) data.Z(static_cast<Index>(i) + 1, k) = z[i];
    data.e[k] =
        (error_um[static_cast<std::size_t>(k)] - net.error_mean_um) / net.error_scale_um;
  }
  const std::size_t count = options.hidden * kOfNeuron + 1;
  const optimise::Problem problem{
      .lower = std::vector<double>(count, -kLargestWeight),
      .upper = std::vector<double>(count, kLargestWeight),
      .evaluate = [&](std::span<const double> w, optimise::Values& out) {
        loss(data, options.hidden, options.decay, w, out);
      }};
  std::mt19937_64 random(options.seed);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t start = 0; start < options.starts; ++start) {
    std::vector<double> w(count);
    for (double& x : w) x = uniform(random);
    const auto s = optimise::local_minimum(
        problem, w, {.f_tolerance = 1e-9, .max_evaluations = options.max_evaluations});
    if (s.f < least) {
      least = s.f;
      net.weights = s.y;
    }
  }
  double square = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    square += std::pow(drift_um(net, rows[k]) - error_um[k], 2);
  net.rms_um = std::sqrt(square / static_cast<double>(rows.size()));
  net.hull = outermost(net, rows);
  return net;
}

double drift_um(const Network& net, const Row& row) {
  const Row z = standardised(net, row);
  double e = net.weights.back();
  for (std::size_t h = 0; h < net.hidden; ++h) {  // Eq. (9)
    const double* w = net.weights.data() + h * kOfNeuron;
    double sum = w[0];
    for (std::size_t i = 0; i < kInputs; ++i) sum += w[i + 1] * z[i];
    e += w[kInputs + 1] * std::tanh(sum);
  }
  return net.error_mean_um + net.error_scale_um * e;
}

Reach reach(const Network& net, const Row& row) {
  leave_if_asked();
  for (std::size_t i = 0; i < kInputs; ++i)
    if (!(row[i] >= net.least[i] && row[i] <= net.largest[i])) return Reach::outside;
  // A mixture: z = sum lambda_k z_k with lambda >= 0 and sum lambda = 1.
  const auto I = static_cast<Index>(kInputs), n = static_cast<Index>(net.hull.size());
  MatrixXd A(I + 1, n);
  VectorXd b(I + 1);
  const Row z = standardised(net, row);
  for (Index i = 0; i < I; ++i) b[i] = z[static_cast<std::size_t>(i)];
  b[I] = 1;
  for (Index k = 0; k < n; ++k) {
    const Row corner = standardised(net, net.hull[static_cast<std::size_t>(k)]);
    for (Index i = 0; i < I; ++i) A(i, k) = corner[static_cast<std::size_t>(i)];
    A(I, k) = 1;
  }
  const VectorXd lambda = optimise::non_negative_least_squares(A, b);
  return (A * lambda - b).norm() <= kOnHull ? Reach::inside : Reach::between_rows;
}

}  // namespace turnwright::thermal
