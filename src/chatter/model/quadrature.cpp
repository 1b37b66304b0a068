#include "quadrature.hpp"

#include <array>
#include <boost/math/special_functions/legendre.hpp>
#include <numeric>
#include <stdexcept>

namespace turnwright::chatter {
namespace {

constexpr std::size_t kLargest = 40;

// P_0 .. P_n at x, by Bonnet's recurrence.
std::vector<double> legendre(std::size_t n, double x) {
  std::vector<double> p(n + 2);
  p[0] = 1;
  p[1] = x;
  for (std::size_t k = 1; k < n; ++k) {
    const double order = static_cast<double>(k);
    p[k + 1] = ((2 * order + 1) * x * p[k] - order * p[k - 1]) / (order + 1);
  }
  return p;
}

std::vector<double> roots(std::size_t n) {
  const auto half = boost::math::legendre_p_zeros<double>(static_cast<int>(n));
  std::vector<double> x;
  for (auto it = half.rbegin(); it != half.rend(); ++it)
    if (*it > 0) x.push_back(-*it);
  x.insert(x.end(), half.begin(), half.end());
  return x;
}

// The Lagrange polynomial of node j is w_j sum_k (2 k + 1)/2 P_k(x_j) P_k(x), k < n, and
// int_-1^x P_k = (P_{k+1} - P_{k-1})/(2 k + 1), x + 1 for k = 0; halved for [0, 1].
Quadrature made(std::size_t n) {
  Quadrature q{.size = n, .nodes = {}, .weights = {}, .to_node = {}, .legendre = {}};
  const std::vector<double> x = roots(n);
  std::vector<std::vector<double>> p;
  for (const double xi : x) p.push_back(legendre(n, xi));
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      sum += (2 * static_cast<double>(k) + 1) * p[i][k] * p[i][k];
    q.nodes.push_back((1 + x[i]) / 2);
    q.weights.push_back(1 / sum);  // half of 2 / sum
    q.legendre.insert(q.legendre.end(), p[i].begin(),
                      p[i].begin() + static_cast<std::ptrdiff_t>(n));
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = x[i] + 1;
      for (std::size_t k = 1; k < n; ++k) sum += p[j][k] * (p[i][k + 1] - p[i][k - 1]);
      q.to_node.push_back(q.weights[j] * sum / 2);
    }
  return q;
}

}  // namespace

const Quadrature& quadrature(std::size_t size) {
  static const auto kAll = [] {
    std::array<Quadrature, kLargest + 1> all;
    for (std::size_t n = 2; n <= kLargest; ++n) all[n] = made(n);
    return all;
  }();
  if (size < 2 || size > kLargest)
    throw std::domain_error("quadrature: size must be from 2 to 40");
  return kAll[size];
}

std::vector<double> integrals_to(const Quadrature& rule, double s) {
  const std::size_t n = rule.size;
  const std::vector<double> to = legendre(n, 2 * s - 1);
  std::vector<double> rises(n, 2 * s), out;
  for (std::size_t k = 1; k < n; ++k) rises[k] = to[k + 1] - to[k - 1];
  for (std::size_t j = 0; j < n; ++j)
    out.push_back(
        rule.weights[j] / 2 *
        std::inner_product(rises.begin(), rises.end(), &rule.legendre[j * n], 0.0));
  return out;
}

}  // namespace turnwright::chatter
