#include "turnwright/tolerance/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/random.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::tolerance {
namespace {

/// Moments of a distribution with value 1.
struct Moments {
  double mean, sigma, low, high;
};

Moments moments(Distribution d) {
  constexpr double kTail = 0.00135;  // beyond 3 sigma of a normal, one side
  switch (d) {
    case Distribution::normal:
      return {0, 1, -3, 3};
    case Distribution::uniform:
      return {0, 1 / std::sqrt(3.0), -1, 1};
    case Distribution::triangular:
      return {0, 1 / std::sqrt(6.0), -1, 1};
    case Distribution::arcsine:
      return {0, 1 / std::sqrt(2.0), -1, 1};
    case Distribution::fixed:
      return {1, 0, 1, 1};
    case Distribution::rayleigh:
      return {std::sqrt(units::kPi / 2), std::sqrt(2 - units::kPi / 2), 0,
              std::sqrt(-2 * std::log(kTail))};
  }
  throw std::domain_error("budget: not a distribution");
}

/// s_i a_i times the moments; a negative sensitivity exchanges low and high.
Moments moments_um(const Source& s) {
  const double scale = s.sensitivity * s.value_um;
  const Moments m = moments(s.distribution);
  const auto [low, high] = std::minmax({scale * m.low, scale * m.high});
  return {scale * m.mean, std::abs(scale) * m.sigma, low, high};
}

void require_that(bool kept, const std::string& rule) {
  if (!kept) throw std::domain_error("budget: " + rule);
}

void check(std::span<const Source> sources) {
  for (const Source& s : sources) {
    const bool bias = s.distribution == Distribution::fixed;
    require_that(std::isfinite(s.value_um) && (bias || s.value_um >= 0),
                 fmt::format("the value of '{}' must be {}", s.name,
                             bias ? "finite" : ">= 0 um and finite"));
    require_that(std::isfinite(s.sensitivity),
                 fmt::format("the sensitivity of '{}' must be finite", s.name));
  }
}

/// X of value 1 from two numbers in (0, 1].
double unit_draw(Distribution d, double u, double w) {
  switch (d) {
    case Distribution::normal:
      return normal_draw(u, w);
    case Distribution::uniform:
      return 2 * u - 1;
    case Distribution::triangular:
      return u + w - 1;
    case Distribution::arcsine:
      return std::cos(units::kPi * u);
    case Distribution::fixed:
      return 1;
    case Distribution::rayleigh:
      return std::sqrt(-2 * std::log(u));
  }
  throw std::domain_error("budget: not a distribution");
}

/// Eq. (1) for the draws first .. first + sums.size() - 1.
void add_draws(std::span<const Source> sources, std::uint64_t seed, std::size_t first,
               std::span<double> sums, const std::stop_token& stop) {
  constexpr std::size_t kBetweenLooks = 65'536;  // draws, some milliseconds
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Source& s = sources[i];
    const double scale = s.sensitivity * s.value_um;
    const std::uint64_t state = splitmix64(splitmix64(seed, 0), i);
    for (std::size_t j = 0; j < sums.size(); ++j) {
      if (j % kBetweenLooks == 0 && stop.stop_requested()) return;
      const std::uint64_t k = 2 * static_cast<std::uint64_t>(first + j);
      sums[j] += scale * unit_draw(s.distribution, uniform_draw(splitmix64(state, k)),
                                   uniform_draw(splitmix64(state, k + 1)));
    }
  }
}

/// Eqs. (2), (4).
void add_closed_forms(std::span<const Source> sources, Budget& b) {
  double variance = 0;
  for (const Source& s : sources) {
    const Moments m = moments_um(s);
    b.worst_case_um.down_um += m.low;
    b.worst_case_um.up_um += m.high;
    b.mean_um += m.mean;
    variance += m.sigma * m.sigma;
  }
  b.sigma_um = std::sqrt(variance);
  for (const Source& s : sources) {
    const Moments m = moments_um(s);
    b.shares.push_back(
        {.name = s.name,
         .worst_case_um = std::max(std::abs(m.low), std::abs(m.high)),
         .variance_share = variance > 0 ? m.sigma * m.sigma / variance : 0});
  }
}

bool fits(const Span& inner, const Span& outer) {
  return inner.down_um >= outer.down_um && inner.up_um <= outer.up_um;
}

/// Wilson's score interval of a share p found in n draws.
void add_interval(double p, double n, Budget& b) {
  constexpr double kZ = 1.959963984540054;  // 97.5 % of a normal lie below
  const double z2 = kZ * kZ / n;
  const double middle = (p + z2 / 2) / (1 + z2);
  const double half = std::sqrt(z2 * (p * (1 - p) + z2 / 4)) / (1 + z2);
  b.P_low = std::max(0.0, middle - half);
  b.P_high = std::min(1.0, middle + half);
}

/// Eq. (7).
std::optional<double> index(const Budget& b) {
  const double above = b.Q99_865_um - b.Q50_um, below = b.Q50_um - b.Q0_135_um;
  if (!(above > 0 && below > 0)) return std::nullopt;
  return std::min((b.room_um.up_um - b.Q50_um) / above,
                  (b.Q50_um - b.room_um.down_um) / below);
}

double normal_below(double x, double sigma) {
  if (!(sigma > 0)) return x >= 0 ? 1 : 0;
  return std::erfc(-x / sigma / std::sqrt(2.0)) / 2;
}

/// I_n of Eq. (9).
double smoothed_power(double t, int n, double sigma) {
  if (!(sigma > 0)) {
    double power = t > 0 ? 1 : 0;
    for (int k = 1; k <= n; ++k) power *= t / k;
    return power;
  }
  const double z = t / sigma;
  double before = std::exp(-z * z / 2) / std::sqrt(2 * units::kPi) / sigma;
  double last = normal_below(t, sigma);
  for (int k = 1; k <= n; ++k)
    before = std::exchange(last, (t * last + sigma * sigma * before) / k);
  return last;
}

/// Eq. (9) of half widths that fall.
double uniforms_below(double x, std::span<const double> widths, double variance) {
  constexpr double kNarrow = 1e-3, kSigmas = 9;
  double reach = kSigmas * std::sqrt(variance);
  for (const double w : widths) reach += w;
  std::vector<double> wide;
  for (const double w : widths)
    if (w >= kNarrow * reach)
      wide.push_back(w);
    else
      variance += w * w / 3;
  const double sigma = std::sqrt(variance);
  reach = kSigmas * sigma + std::accumulate(wide.begin(), wide.end(), 0.0);
  if (!(x > -reach)) return 0;
  if (!(x < reach)) return 1;
  const auto n = static_cast<int>(wide.size());
  double sum = 0, scale = 1;
  for (const double w : wide) scale *= 2 * w;
  for (unsigned signs = 0; signs < 1u << n; ++signs) {
    double at = x, sign = 1;
    for (int i = 0; i < n; ++i) {
      const bool minus = signs >> i & 1u;
      at +=
          minus ? -wide[static_cast<std::size_t>(i)] : wide[static_cast<std::size_t>(i)];
      if (minus) sign = -sign;
    }
    sum += sign * smoothed_power(at, n, sigma);
  }
  return std::clamp(sum / scale, 0.0, 1.0);
}

/// Eq. (10).
double rayleigh_below(double x, double a, double sigma) {
  if (!(x > -INFINITY)) return 0;
  if (!(sigma > 0)) return x > 0 ? -std::expm1(-x * x / (2 * a * a)) : 0;
  const double s = std::hypot(a, sigma);
  return normal_below(x, sigma) -
         a / s * std::exp(-x * x / (2 * s * s)) * normal_below(x * a / s, sigma);
}

}  // namespace

Span room_um(const Verdict& v) {
  return {units::um_from_mm(v.room_mm.min_mm), units::um_from_mm(v.room_mm.max_mm)};
}

std::vector<double> rising_sum_um(std::span<const Source> sources, const Draws& draws) {
  check(sources);
  require_that(draws.count > 0, "there must be a draw");
  std::vector<double> sums(draws.count, 0.0);
  const std::size_t asked =
      draws.threads ? draws.threads : std::max(1u, std::thread::hardware_concurrency());
  const std::size_t threads = std::min({asked, draws.count, std::size_t{64}});
  const std::stop_token* const heard = Listening::heard();
  const std::stop_token stop = heard ? *heard : std::stop_token();
  const auto part = [&](std::size_t t) {
    const std::size_t first = draws.count * t / threads;
    const std::size_t last = draws.count * (t + 1) / threads;
    add_draws(sources, draws.seed, first, std::span(sums).subspan(first, last - first),
              stop);
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(part, t);
    part(0);
  }
  leave_if(stop);
  std::ranges::sort(sums);
  return sums;
}

double quantile_um(std::span<const double> rising_um, double p) {
  require_that(!rising_um.empty(), "a quantile needs draws");
  require_that(p >= 0 && p <= 1, "a quantile's p must lie in [0, 1]");
  const double rank = p * static_cast<double>(rising_um.size() - 1);
  const auto k = static_cast<std::size_t>(rank);
  if (k + 1 == rising_um.size()) return rising_um[k];
  return std::lerp(rising_um[k], rising_um[k + 1], rank - static_cast<double>(k));
}

double share_within(std::span<const double> rising_um, const Span& room) {
  require_that(!rising_um.empty(), "a share needs draws");
  const auto first = std::ranges::lower_bound(rising_um, room.down_um);
  const auto last = std::ranges::upper_bound(rising_um, room.up_um);
  return last <= first
             ? 0
             : static_cast<double>(last - first) / static_cast<double>(rising_um.size());
}

Span rss_um(std::span<const Source> sources) {
  check(sources);
  double mean = 0, up = 0, down = 0;
  for (const Source& s : sources) {
    const Moments m = moments_um(s);
    mean += m.mean;
    up += (m.high - m.mean) * (m.high - m.mean);
    down += (m.mean - m.low) * (m.mean - m.low);
  }
  return {mean - std::sqrt(down), mean + std::sqrt(up)};
}

Spread::Spread(std::span<const Source> sources, const Draws& draws) {
  check(sources);
  constexpr std::size_t kMostUniform = 6;
  std::vector<Source> rest;
  bool other = false;
  for (const Source& s : sources) {
    const Moments m = moments_um(s);
    const double a = std::abs(s.sensitivity * s.value_um);
    if (!(a > 0)) continue;
    using enum Distribution;
    if (s.distribution == normal || s.distribution == fixed) {
      mean_um_ += m.mean;
      variance_um2_ += m.sigma * m.sigma;
      continue;
    }
    rest.push_back(s);
    if (s.distribution == uniform)
      uniform_um_.push_back(a);
    else if (s.distribution == triangular)
      uniform_um_.insert(uniform_um_.end(), 2, a / 2);
    else if (s.distribution == rayleigh && s.sensitivity > 0 && !(rayleigh_um_ > 0))
      rayleigh_um_ = a;
    else
      other = true;
  }
  std::ranges::sort(uniform_um_, std::greater<>{});
  if (!other && uniform_um_.size() <= kMostUniform &&
      !(rayleigh_um_ > 0 && !uniform_um_.empty()))
    return;
  drawn_um_ = rising_sum_um(rest, draws);
  constexpr std::size_t kNeighbours = 20;
  if (drawn_um_.size() % kNeighbours != 0) {
    means_um_ = drawn_um_;
    return;
  }
  for (auto at = drawn_um_.begin(); at != drawn_um_.end(); at += kNeighbours)
    means_um_.push_back(std::accumulate(at, at + kNeighbours, 0.0) / kNeighbours);
}

// Eqs. (9), (10).
double Spread::below(double x, double variance) const {
  if (rayleigh_um_ > 0) return rayleigh_below(x, rayleigh_um_, std::sqrt(variance));
  return uniforms_below(x, uniform_um_, variance);
}

double Spread::within(const Span& room, double further_sigma_um) const {
  const Span left{room.down_um - mean_um_, room.up_um - mean_um_};
  const double variance = variance_um2_ + further_sigma_um * further_sigma_um;
  if (closed()) {
    if (!(variance > 0) && uniform_um_.empty() && !(rayleigh_um_ > 0))
      return left.down_um <= 0 && left.up_um >= 0 ? 1 : 0;
    return std::max(0.0, below(left.up_um, variance) - below(left.down_um, variance));
  }
  if (!(variance > 0)) return share_within(drawn_um_, left);
  const double scale = std::sqrt(2 * variance);
  double sum = 0;
  for (const double x : means_um_)
    sum += std::max(
        0.0, std::erf((left.up_um - x) / scale) - std::erf((left.down_um - x) / scale));
  return sum / 2 / static_cast<double>(means_um_.size());
}

Budget budget(const BudgetDemand& demand, const Span& room) {
  require_that(demand.conformance >= 0 && demand.conformance <= 1,
               "the wanted conformance must lie in [0, 1]");
  require_that(std::isfinite(demand.measurement_U_um) && demand.measurement_U_um >= 0,
               "the measurement's uncertainty must be >= 0 um and finite");
  require_that(!std::isnan(room.down_um) && !std::isnan(room.up_um),
               "the ends of the range that the sources may use must not be NaN");
  const std::vector<double> rising = rising_sum_um(demand.sources, demand.draws);
  Budget b{.room_um = room};
  add_closed_forms(demand.sources, b);
  b.rss_um = rss_um(demand.sources);
  b.worst_case_fits = fits(b.worst_case_um, room);
  b.rss_fits = fits(b.rss_um, room);
  b.P_conform = share_within(rising, room);  // Eq. (6)
  add_interval(b.P_conform, static_cast<double>(rising.size()), b);
  const double U = demand.measurement_U_um;
  b.P_accept = share_within(rising, {room.down_um + U, room.up_um - U});  // Eq. (8)
  b.Q0_135_um = quantile_um(rising, 0.00135);
  b.Q50_um = quantile_um(rising, 0.5);
  b.Q99_865_um = quantile_um(rising, 0.99865);
  b.index = index(b);
  if (b.P_accept >= demand.conformance)
    b.decision = Decision::conforms;
  else if (share_within(rising, {room.down_um - U, room.up_um + U}) < demand.conformance)
    b.decision = Decision::does_not_conform;
  return b;
}

}  // namespace turnwright::tolerance
