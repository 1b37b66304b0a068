#include "turnwright/chatter/uncertain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>

#include "turnwright/chatter/limits.hpp"

namespace turnwright::chatter {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Factors 1 +- band; the distributions of <random> differ between libraries.
class Factors {
 public:
  explicit Factors(std::uint64_t seed) : random_(seed) {}
  double operator()(double band) {
    const double share = static_cast<double>(random_() >> 11) * 0x1p-53;
    return 1 + band * (2 * share - 1);
  }

 private:
  std::mt19937_64 random_;
};

void scale(Force& force, double by) {
  std::visit(
      [by](auto& f) {
        using F = std::decay_t<decltype(f)>;
        if constexpr (std::is_same_v<F, LinearForce>) {
          f.Kt_MPa *= by;
          f.Kn_MPa *= by;
        } else if constexpr (std::is_same_v<F, PowerLawForce>) {
          f.C *= by;
        } else {
          f.K_MPa *= by;
        }
      },
      force);
}

/// First loss up to ap_max.
double first_loss(const System& system, double n_rpm, double ap_max) {
  return speed_limits(system, n_rpm, ap_max).limit_mm().value_or(kNever);
}

std::optional<double> told(double limit, double ap_max) {
  return limit <= ap_max ? std::optional(limit) : std::nullopt;
}

/// The ratio of the force of `a` to that of `b`, both of one kind.
double force_ratio(const Force& a, const Force& b) {
  return std::visit(
      [&b](const auto& f) {
        using F = std::decay_t<decltype(f)>;
        const F& other = std::get<F>(b);
        if constexpr (std::is_same_v<F, LinearForce>)
          return f.Kt_MPa / other.Kt_MPa;
        else if constexpr (std::is_same_v<F, PowerLawForce>)
          return f.C / other.C;
        else
          return f.K_MPa / other.K_MPa;
      },
      a);
}

}  // namespace

std::vector<System> drawn(const System& system, const Bands& bands) {
  Factors factor(bands.seed);
  std::vector<System> out(static_cast<std::size_t>(bands.samples), system);
  for (System& s : out) {
    for (Mode& m : s.modes) {
      m.wn_rad_s *= factor(bands.frequency);
      m.zeta *= factor(bands.damping);
      m.k_N_mm *= factor(bands.stiffness);
    }
    scale(s.force, factor(bands.force));
  }
  return out;
}

UncertainLimit uncertain_limit(const System& nominal, const std::vector<System>& systems,
                               const Bands& bands, double n_rpm, double ap_max_mm) {
  const double most = 1 + bands.force;
  // Limits are inversely proportional to the force.
  double worst = first_loss(nominal, n_rpm, most * ap_max_mm) / most;
  std::vector<double> losses;
  for (const System& s : systems) {
    const double to_most = most / force_ratio(s.force, nominal.force);
    const double loss = first_loss(s, n_rpm, to_most * ap_max_mm);
    worst = std::min(worst, loss / to_most);
    losses.push_back(loss);
  }
  std::ranges::sort(losses);
  const auto quantile = [&](double p) {
    const double rank = std::ceil(p * static_cast<double>(losses.size()));
    return told(losses[static_cast<std::size_t>(std::max(rank, 1.0)) - 1], ap_max_mm);
  };
  return {.robust_mm = told(worst, ap_max_mm),
          .p05_mm = quantile(0.05),
          .p50_mm = quantile(0.5),
          .p95_mm = quantile(0.95)};
}

}  // namespace turnwright::chatter
