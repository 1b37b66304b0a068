#include "safe_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

constexpr int kSteps = 16;  // between a speed and either end of its band
// The speeds about a safe cut at which its depth is stable are looked for so far, at speeds
// so far apart, and the end between two of them so near.
constexpr double kReach = 0.1, kStride = 0.01, kResolve = 1e-3;

constexpr double kNothing = 0;  // a depth that is always stable

/// Lowers a depth to the first loss of these limits, if that is less; to nothing if there
/// are none.
void lower(double& depth_mm, std::optional<double>& chatter_Hz,
           const SpeedLimits* limits) {
  if (!limits) {
    depth_mm = kNothing;
    chatter_Hz.reset();
  } else if (limits->limit_mm().value_or(depth_mm) < depth_mm) {
    depth_mm = *limits->limit_mm();
    chatter_Hz = limits->crossings.front().frequency_Hz;
  }
}

}  // namespace

double SpindleLoad::power_at_kW(const OperatingPoint& cut) const {
  constexpr double kW_per_W = 1e-3, s_per_min = 60;
  return kW_per_W * 2 * units::kPi * cut.n_rpm / s_per_min * torque_Nm_mm * cut.ap_mm;
}

SafeCuts::SafeCuts(KnownLimits known, Search search, std::stop_token stop)
    : q_(std::move(known)), search_(std::move(search)), stop_(std::move(stop)) {
  for (const auto& [n_rpm, limits] : q_.speeds) speeds_.push_back({n_rpm, limits});
  std::ranges::sort(speeds_, {}, &Bounded::n_rpm);
  auto from = speeds_.begin(), to = speeds_.begin();
  for (Bounded& at : speeds_) {
    while (from->n_rpm < at.n_rpm * (1 - q_.margins.speed)) ++from;
    while (to != speeds_.end() && to->n_rpm <= at.n_rpm * (1 + q_.margins.speed)) ++to;
    at.bound_mm = q_.ap_max_mm;
    at.beside = static_cast<std::size_t>(to - from);
    for (auto u = from; u != to; ++u) lower(at.bound_mm, at.chatter_Hz, u->limits);
  }
  bands_.resize(speeds_.size());
}

/// The depth that keeps (1) and the spindle's limits, and what ends it.
std::pair<double, DepthEnd> SafeCuts::safe(double n_rpm, double least_mm) const {
  std::pair out{least_mm / (1 + q_.margins.depth),
                least_mm < q_.ap_max_mm ? DepthEnd::chatter : DepthEnd::ap_max};
  if (!q_.spindle) return out;
  const auto end_at = [&](double depth_mm, DepthEnd why) {
    if (depth_mm < out.first) out = {depth_mm, why};
  };
  if (q_.spindle->power_kW)
    end_at(*q_.spindle->power_kW / q_.spindle->power_at_kW({n_rpm, 1}), DepthEnd::power);
  if (q_.spindle->torque_Nm)
    end_at(*q_.spindle->torque_Nm / q_.spindle->torque_Nm_mm, DepthEnd::torque);
  return out;
}

/// Takes a speed into a band.
void SafeCuts::judge_at(double n_rpm, Band& out) const {
  leave_if(stop_);
  ++out.judged;
  try {
    const SpeedLimits limits = search_(n_rpm, out.depth_mm);
    lower(out.depth_mm, out.chatter_Hz, &limits);
  } catch (const ModelRangeError&) {
    lower(out.depth_mm, out.chatter_Hz, nullptr);
  }
}

void SafeCuts::judge_between(const Bounded& at, Band& out) const {
  for (int step = -kSteps; step <= kSteps && out.depth_mm > kNothing; ++step)
    if (step != 0) judge_at(at.n_rpm * (1 + q_.margins.speed * step / kSteps), out);
}

const SafeCuts::Band& SafeCuts::band(std::size_t i) {
  auto& known = bands_[i];
  if (known) return *known;
  const Bounded& at = speeds_[i];
  known = {at.bound_mm, at.chatter_Hz, at.beside};
  if (search_ && q_.margins.speed > 0) judge_between(at, *known);
  return *known;
}

std::optional<SafeCut> SafeCuts::best() {
  const auto rate = [&](std::size_t i, double least_mm) {
    return speeds_[i].n_rpm * safe(speeds_[i].n_rpm, least_mm).first;
  };
  std::vector<std::pair<double, std::size_t>> bounds;
  for (std::size_t i = 0; i < speeds_.size(); ++i)
    if (!q_.machine || q_.machine->holds(speeds_[i].n_rpm))
      bounds.emplace_back(rate(i, speeds_[i].bound_mm), i);
  std::ranges::stable_sort(bounds, std::ranges::greater(),
                           &std::pair<double, std::size_t>::first);
  double most = 0;
  std::optional<std::size_t> at;
  for (const auto& [bound, i] : bounds) {
    if (bound <= most) break;
    if (const double r = rate(i, band(i).depth_mm); r > most) {
      most = r;
      at = i;
    }
  }
  return at ? std::optional(told(*at)) : std::nullopt;
}

SafeCut SafeCuts::told(std::size_t i) {
  const Bounded& s = speeds_[i];
  const Band& b = band(i);
  const auto [depth, end] = safe(s.n_rpm, b.depth_mm);
  SafeCut out{.at = {s.n_rpm, depth},
              .limited_by = end,
              .limit_mm = s.limits->limit_mm(),
              .stable = {},
              .chatter_Hz = {},
              .speeds_judged = b.judged};
  if (end == DepthEnd::chatter) out.chatter_Hz = b.chatter_Hz;
  if (search_) out.stable = SpeedRange{stable_until(out.at, -1), stable_until(out.at, 1)};
  return out;
}

bool SafeCuts::stable_at(double n_rpm, double ap_mm) const {
  Band alone{ap_mm, {}, 0};
  judge_at(n_rpm, alone);
  return alone.depth_mm == ap_mm;
}

/// The speed up to which the depth of a safe cut is stable, slower (-1) or faster (1).
double SafeCuts::stable_until(const OperatingPoint& cut, int way) const {
  const double end = cut.n_rpm * (1 + way * std::max(kReach, q_.margins.speed));
  double known = cut.n_rpm * (1 + way * q_.margins.speed);
  while (known != end) {
    double next = known * (1 + way * kStride);
    if (way * next > way * end) next = end;
    if (!stable_at(next, cut.ap_mm)) {
      while (std::abs(next - known) > kResolve * known) {
        const double middle = std::midpoint(known, next);
        (stable_at(middle, cut.ap_mm) ? known : next) = middle;
      }
      return known;
    }
    known = next;
  }
  return end;
}

std::optional<PointMargin::Cure> SafeCuts::cure(const OperatingPoint& cut) {
  const auto safe_at = [&](std::size_t i, double least_mm) {
    return safe(speeds_[i].n_rpm, least_mm).first >= cut.ap_mm;
  };
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < speeds_.size(); ++i)
    if ((!q_.machine || q_.machine->holds(speeds_[i].n_rpm)) &&
        safe_at(i, speeds_[i].bound_mm))
      near.emplace_back(std::abs(std::log(speeds_[i].n_rpm / cut.n_rpm)), i);
  std::ranges::sort(near);
  for (const auto& [distance, i] : near)
    if (safe_at(i, band(i).depth_mm))
      return PointMargin::Cure{speeds_[i].n_rpm, speeds_[i].limits->limit_mm()};
  return std::nullopt;
}

}  // namespace turnwright::chatter
