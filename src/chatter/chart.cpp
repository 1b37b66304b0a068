#include "turnwright/chatter/chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "safe_cuts.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::chatter {
namespace {

constexpr int kDepths = 40;  // scanned by the reference methods
/// After one speed that could not be searched to the end, slower ones get this part of its
/// work each.
constexpr double kPatience = 10;

Dominant by_reference(const ChartRequest& q, double n_rpm, double ap_mm,
                      const std::stop_token& stop) {
  leave_if(stop);
  if (q.method == Method::tfea)
    return time_finite_elements(q.system, n_rpm, ap_mm, q.resolution);
  if (q.method == Method::semi_discretisation)
    return semi_discretisation(q.system, n_rpm, ap_mm, q.resolution);
  return simulation(q.system, n_rpm, ap_mm);
}

SpeedLimits search(const ChartRequest& q, double n_rpm, double ap_mm, double work,
                   const std::stop_token& stop, std::span<const double> depths_mm = {}) {
  leave_if(stop);
  if (q.shaped()) return speed_limits(*q.cutter, n_rpm, ap_mm, depths_mm, work);
  if (q.method == Method::fundamental_matrix)
    return speed_limits(q.system, n_rpm, ap_mm, depths_mm);
  return scanned_limits(q.system, n_rpm, ap_mm, kDepths, [&](double depth_mm) {
    return by_reference(q, n_rpm, depth_mm, stop);
  });
}

ChartPoint judged(const ChartRequest& q, const OperatingPoint& p,
                  const std::stop_token& stop) {
  leave_if(stop);
  if (q.method != Method::fundamental_matrix) {
    const Dominant d = by_reference(q, p.n_rpm, p.ap_mm, stop);
    const double radius = std::abs(d.multiplier);
    return {p, d.unstable, radius, radius < 1, {}, {}};
  }
  const Multipliers m = q.shaped() ? multipliers(*q.cutter, p.n_rpm, p.ap_mm)
                                   : multipliers(q.system, p.n_rpm, p.ap_mm);
  ChartPoint out{p, m.unstable, m.spectral_radius, m.unstable == 0, {}, {}};
  if (out.stable && q.cutter && q.cutter->feed_mm > 0 && p.ap_mm > 0)
    out.walls = surfaces(*q.cutter, p.n_rpm, p.ap_mm);
  return out;
}

constexpr const char* kUndecidedAbove =
    to_translate("stable up to stable_to_mm; the search above takes too long");

/// Searches at speeds or points, one after the other.
class Attempts {
 public:
  /// @param each  whether none is skipped because an earlier one would take too long.
  explicit Attempts(bool each) : each_(each) {}

  /// The result at the i-th of them; none if it is outside the range of the method, or at
  /// least as difficult as an earlier one that would have taken too long.
  template <class F>
  auto at(std::size_t i, const OperatingPoint& asked, F compute)
      -> std::optional<decltype(compute())> {
    for (const OperatingPoint& p : too_long_)
      if (asked.n_rpm <= p.n_rpm && asked.ap_mm >= p.ap_mm) {
        undecided_[i] = {i, asked, "", p.n_rpm};
        return std::nullopt;
      }
    try {
      return compute();
    } catch (const TooManyVibrations& e) {
      if (!each_) too_long_.push_back(asked);
      undecided_[i] = {i, asked, e.what()};
    } catch (const ModelRangeError& e) {
      undecided_[i] = {i, asked, e.what()};
    }
    return std::nullopt;
  }

  /// Notes that the i-th is stable up to a depth and undecided above it.
  void undecided_above(std::size_t i, const OperatingPoint& asked, double stable_to_mm) {
    undecided_[i] = {i, asked, tr(kUndecidedAbove), 0, stable_to_mm};
  }

  /// The undecided ones in the order of the request.
  std::vector<Undecided> undecided() const {
    std::vector<Undecided> out;
    for (const auto& [i, told] : undecided_) out.push_back(told);
    return out;
  }

 private:
  bool each_;
  std::vector<OperatingPoint> too_long_;
  std::map<std::size_t, Undecided> undecided_;
};

double stable_mm(const SpeedLimits& speed, double ap_max) {
  return speed.limit_mm().value_or(ap_max);
}

/// The loss of stability next below a depth that chatters.
std::optional<double> chatter_Hz(const SpeedLimits& limits, double ap_mm) {
  std::optional<double> out;
  for (const Crossing& c : limits.crossings)
    if (c.loss && c.ap_mm <= ap_mm) out = c.frequency_Hz;
  return out;
}

/// The limits at the speed of a point, searched at least up to its depth; none where they
/// are not known or take long.
std::optional<SpeedLimits> limits_at(const ChartRequest& q, const StabilityChart& chart,
                                     const OperatingPoint& p,
                                     const std::stop_token& stop) {
  if (p.ap_mm <= *q.ap_max_mm)
    for (const ChartSpeed& s : chart.speeds)
      if (s.limits.n_rpm == p.n_rpm &&
          (!s.limits.searched_mm || p.ap_mm <= *s.limits.searched_mm))
        return s.limits;
  if (!q.quick()) return std::nullopt;
  try {
    return search(q, p.n_rpm, std::max(*q.ap_max_mm, p.ap_mm), q.work, stop);
  } catch (const ModelRangeError&) {
    return std::nullopt;
  }
}

/// @param safe  null if there are no speeds.
std::optional<PointMargin> margin_of(const ChartRequest& q, const StabilityChart& chart,
                                     const ChartPoint& point, SafeCuts* safe,
                                     const std::stop_token& stop) {
  if (!q.ap_max_mm) return std::nullopt;
  const auto limits = limits_at(q, chart, point.at, stop);
  if (!limits) return std::nullopt;
  PointMargin out;
  out.limit_mm = limits->limit_mm();
  if (point.stable) return out;
  out.chatter_Hz = chatter_Hz(*limits, point.at.ap_mm);
  if (safe) out.cure = safe->cure(point.at);
  return out;
}

KnownLimits known_limits(const ChartRequest& q, const StabilityChart& chart) {
  KnownLimits out{.speeds = {},
                  .ap_max_mm = *q.ap_max_mm,
                  .margins = q.margins,
                  .machine = q.machine,
                  .spindle = q.spindle};
  for (const double n : q.speeds_rpm) out.speeds.push_back({n, nullptr});
  for (const ChartSpeed& s : chart.speeds) out.speeds[s.index].limits = &s.limits;
  return out;
}

void find_magic(const ChartRequest& q, StabilityChart& out) {
  /// A speed with the depth up to which it is stable, if that is decided.
  std::vector<std::pair<double, std::optional<double>>> all;
  for (const double n : q.speeds_rpm) all.emplace_back(n, std::nullopt);
  for (const ChartSpeed& s : out.speeds)
    all[s.index].second = stable_mm(s.limits, *q.ap_max_mm);
  std::ranges::sort(all);
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const auto &below = all[i - 1].second, &at = all[i].second,
               &above = all[i + 1].second;
    if (below && at && above && *at > *below && *at >= *above)
      out.magic.push_back({all[i].first, *at});
  }
}

/// Indices of a list of speeds, from the highest speed down.
std::vector<std::size_t> from_the_fastest(const std::vector<double>& speeds_rpm) {
  std::vector<std::size_t> out(speeds_rpm.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::ranges::stable_sort(out, std::ranges::greater(),
                           [&](std::size_t i) { return speeds_rpm[i]; });
  return out;
}

}  // namespace

bool ChartRequest::shaped() const {
  return cutter && (cutter->helix_rad > 0 || cutter->by_revolution() ||
                    cutter->indentation_N_mm > 0);
}

bool ChartRequest::quick() const {
  constexpr std::size_t kModes = 6;  // with them a speed takes a twentieth of a second
  if (method != Method::fundamental_matrix) return false;
  return std::holds_alternative<ConstantForce>(system.force) ||
         (!shaped() && system.modes.size() <= kModes);
}

StabilityChart stability_chart(const ChartRequest& q, const std::stop_token& stop,
                               const ChartProgress& tell) {
  StabilityChart out;
  std::size_t done = 0;
  const auto one_done = [&] {
    if (tell) tell(++done, q.speeds_rpm.size() + q.points.size());
  };
  const auto systems = q.bands ? drawn(q.system, *q.bands) : std::vector<System>{};
  Attempts speeds(q.shaped()), points(q.shaped());
  double work = q.work;
  for (const std::size_t i : from_the_fastest(q.speeds_rpm)) {
    const double n_rpm = q.speeds_rpm[i];
    auto speed = speeds.at(i, {n_rpm, *q.ap_max_mm}, [&] {
      ChartSpeed found{i, search(q, n_rpm, *q.ap_max_mm, work, stop, q.depths_mm), {}};
      if (q.bands) {
        leave_if(stop);
        found.uncertain =
            uncertain_limit(q.system, systems, *q.bands, n_rpm, *q.ap_max_mm);
      }
      return found;
    });
    if (!speed || speed->limits.searched_mm) work = q.work / kPatience;
    if (speed && speed->limits.searched_mm && !speed->limits.limit_mm())
      speeds.undecided_above(i, {n_rpm, *q.ap_max_mm}, *speed->limits.searched_mm);
    else if (speed)
      out.speeds.push_back(std::move(*speed));
    one_done();
  }
  std::ranges::sort(out.speeds, {}, &ChartSpeed::index);
  std::optional<SafeCuts> safe;
  if (!out.speeds.empty()) {
    SafeCuts::Search beside;
    if (q.quick())
      beside = [&](double n_rpm, double ap_mm) {
        return search(q, n_rpm, ap_mm, q.work, stop);
      };
    safe.emplace(known_limits(q, out), std::move(beside), stop);
    out.best = safe->best();
    find_magic(q, out);
  }
  for (std::size_t i = 0; i < q.points.size(); ++i) {
    if (auto point =
            points.at(i, q.points[i], [&] { return judged(q, q.points[i], stop); })) {
      point->margin = margin_of(q, out, *point, safe ? &*safe : nullptr, stop);
      out.points.push_back(std::move(*point));
    }
    one_done();
  }
  out.undecided_speeds = speeds.undecided();
  out.undecided_points = points.undecided();
  return out;
}

double absolute_limit_mm(const System& system) {
  const Mode& m = system.modes.front();
  return 2 * m.k_N_mm * m.zeta * (1 + m.zeta) /
         std::get<ConstantForce>(system.force).K_MPa;
}

}  // namespace turnwright::chatter
