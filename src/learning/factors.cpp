#include "turnwright/learning/factors.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "turnwright/base/distributions.hpp"
#include "turnwright/base/dual.hpp"

namespace turnwright::learning {
namespace {

constexpr double kIdentified = 0.9;

Eigen::VectorXd row_of(const Evidence& e, std::size_t factors) {
  if (e.effects.size() != factors)
    throw std::domain_error("posterior: an evidence needs an effect of each factor");
  return Eigen::Map<const Eigen::VectorXd>(e.effects.data(),
                                           static_cast<Eigen::Index>(factors));
}

}  // namespace

std::vector<Posterior> posterior(std::span<const Prior> prior,
                                 std::span<const Evidence> evidence, double confidence) {
  const auto n = std::ssize(prior);
  // In units of the prior standard deviations: inverse of I + S H' W H S.
  Eigen::VectorXd sd(n), mean(n), shift = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    sd[i] = prior[static_cast<std::size_t>(i)].sd;
    mean[i] = prior[static_cast<std::size_t>(i)].mean;
  }
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(n, n);
  for (const auto& e : evidence) {
    const Eigen::VectorXd h = row_of(e, prior.size());
    const Eigen::VectorXd scaled = h.cwiseProduct(sd) / e.u;
    precision += scaled * scaled.transpose();
    shift += scaled * ((e.value - h.dot(mean)) / e.u);
  }
  const Eigen::MatrixXd C = precision.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd by = C * shift;
  const double z = normal_quantile((1 + confidence) / 2);
  std::vector<Posterior> all;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double less = std::sqrt(C(i, i)), u = sd[i] * less;
    const double value = mean[i] + sd[i] * by[i];
    all.push_back({{value, u, value - z * u, value + z * u}, less < kIdentified});
  }
  return all;
}

std::vector<Evidence> uncorrelated(const Evidence& first, Evidence second, double rho) {
  const double told = rho * second.u / first.u;
  for (std::size_t i = 0; i < second.effects.size(); ++i)
    second.effects[i] -= told * first.effects[i];
  second.value -= told * first.value;
  second.u *= std::sqrt(std::max(1e-12, 1 - sqr(rho)));
  return {first, second};
}

ScatterPrior scatter_prior(double s, double relative_u) {
  return {s, 1 / (2 * sqr(relative_u))};
}

Posterior posterior(const ScatterPrior& prior, double sum_of_squares, double degrees,
                    double confidence) {
  const double nu = prior.degrees + degrees;
  const double s = std::sqrt((prior.degrees * sqr(prior.s) + sum_of_squares) / nu);
  const double tail = (1 - confidence) / 2;
  return {
      {s, s / std::sqrt(2 * nu), s * std::sqrt(nu / chi_squared_upper_quantile(tail, nu)),
       s * std::sqrt(nu / chi_squared_quantile(tail, nu))},
      sqr(kIdentified) * nu > prior.degrees};
}

}  // namespace turnwright::learning
