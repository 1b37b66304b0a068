#include "turnwright/learning/normality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace turnwright::learning {
namespace {

// ln Phi(x); of both tails without cancellation.
double ln_normal(double x) { return std::log(0.5 * std::erfc(-x / std::numbers::sqrt2)); }

double p_of(double A) {
  if (A < 0.2) return 1 - std::exp(-13.436 + A * (101.14 - 223.73 * A));
  if (A < 0.34) return 1 - std::exp(-8.318 + A * (42.796 - 59.938 * A));
  if (A < 0.6) return std::exp(0.9177 - A * (4.279 + 1.38 * A));
  if (A < 7) return std::exp(1.2937 - A * (5.709 - 0.0186 * A));
  return 0;
}

}  // namespace

std::optional<Normality> normality(std::span<const double> residuals) {
  constexpr std::size_t kLeast = 8;
  constexpr double kRounding = 1e-12;
  constexpr double kFarthest = 35;  // of which the logarithm is finite
  if (residuals.size() < kLeast) return std::nullopt;
  std::vector<double> z(residuals.begin(), residuals.end());
  const auto n = static_cast<double>(z.size());
  double mean = 0, sum2 = 0;
  for (const double x : z) mean += x / n;
  for (const double x : z) sum2 += (x - mean) * (x - mean);
  const double s = std::sqrt(sum2 / (n - 1));
  if (!(s > kRounding * std::abs(mean))) return std::nullopt;
  std::ranges::sort(z);
  double A2 = -n;
  for (std::size_t i = 0; i < z.size(); ++i) {  // (1)
    const double low = std::clamp((z[i] - mean) / s, -kFarthest, kFarthest),
                 high =
                     std::clamp((z[z.size() - 1 - i] - mean) / s, -kFarthest, kFarthest);
    A2 -= (2 * static_cast<double>(i) + 1) / n * (ln_normal(low) + ln_normal(-high));
  }
  A2 *= 1 + 0.75 / n + 2.25 / (n * n);  // (2)
  return Normality{A2, p_of(A2)};
}

}  // namespace turnwright::learning
