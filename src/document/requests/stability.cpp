#include "turnwright/document/stability.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stability_request.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/chatter/reference_methods.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::chatter;
using namespace stability_request;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kDepths = 40;  // scanned by the checks

Dominant checked(const Request& q, double n_rpm, double ap_mm,
                 const std::stop_token& stop) {
  leave_if(stop);
  if (q.method == Method::tfea)
    return time_finite_elements(q.system, n_rpm, ap_mm, q.resolution);
  if (q.method == Method::semi_discretisation)
    return semi_discretisation(q.system, n_rpm, ap_mm, q.resolution);
  return simulation(q.system, n_rpm, ap_mm);
}

SpeedLimits limits_of(const Request& q, double n_rpm, const std::stop_token& stop) {
  leave_if(stop);
  if (q.shaped()) return speed_limits(*q.cutter, n_rpm, *q.ap_max_mm, q.depths_mm);
  if (q.method == Method::fundamental_matrix)
    return speed_limits(q.system, n_rpm, *q.ap_max_mm, q.depths_mm);
  return scanned_limits(q.system, n_rpm, *q.ap_max_mm, kDepths,
                        [&](double ap_mm) { return checked(q, n_rpm, ap_mm, stop); });
}

/// The walls that a stable cut leaves.
ordered_json walls(const Cutter& cutter, const Point& p) {
  ordered_json out = ordered_json::array();
  for (const Surface& wall : surfaces(cutter, p.n_rpm, p.ap_mm))
    out.push_back({{"milled", wall.up_milled ? "up" : "down"},
                   {"height_mm", wall.height_mm},
                   {"left_mm", wall.left_mm}});
  return out;
}

ordered_json judged(const Request& q, const Point& p, const std::stop_token& stop) {
  leave_if(stop);
  ordered_json out{{"n_rpm", p.n_rpm}, {"ap_mm", p.ap_mm}};
  if (q.method == Method::fundamental_matrix) {
    const Multipliers m = q.shaped() ? multipliers(*q.cutter, p.n_rpm, p.ap_mm)
                                     : multipliers(q.system, p.n_rpm, p.ap_mm);
    out["unstable_multipliers"] = m.unstable;
    out["spectral_radius"] = m.spectral_radius;
    out["stable"] = m.unstable == 0;
    if (q.cutter && q.cutter->feed_mm > 0 && p.ap_mm > 0)
      out["walls"] = m.unstable == 0 ? walls(*q.cutter, p) : ordered_json();
    return out;
  }
  const Dominant d = checked(q, p.n_rpm, p.ap_mm, stop);
  const double radius = std::abs(d.multiplier);
  out["unstable_multipliers"] = d.unstable ? ordered_json(*d.unstable) : ordered_json();
  out["spectral_radius"] = radius;
  out["stable"] = radius < 1;
  return out;
}

/// Searches at speeds, or points, one after the other: those outside the method are told
/// with the reason.
class Attempts {
 public:
  /// What is computed at the i-th of them; none if that is outside the method, or no
  /// easier than one before that would have taken too long.
  template <class F>
  auto at(std::size_t i, const std::string& pointer, const Point& asked, F compute)
      -> std::optional<decltype(compute())> {
    for (const Point& p : too_long_)
      if (asked.n_rpm <= p.n_rpm && asked.ap_mm >= p.ap_mm) {
        leave_out(i, pointer, asked,
                  "not tried, as " + number_text(p.n_rpm) + " 1/min would take too long");
        return std::nullopt;
      }
    try {
      return compute();
    } catch (const TooManyVibrations& e) {
      too_long_.push_back(asked);
      leave_out(i, pointer, asked, e.what());
    } catch (const ModelRangeError& e) {
      leave_out(i, pointer, asked, e.what());
    }
    return std::nullopt;
  }

  /// In the order asked.
  const std::map<std::size_t, ordered_json>& undecided() const { return undecided_; }

 private:
  void leave_out(std::size_t i, const std::string& pointer, const Point& asked,
                 const std::string& why) {
    undecided_[i] = {{"pointer", pointer},
                     {"n_rpm", asked.n_rpm},
                     {"ap_mm", asked.ap_mm},
                     {"why", why}};
  }

  std::vector<Point> too_long_;
  std::map<std::size_t, ordered_json> undecided_;
};

/// @throws ModelRangeError if nothing else is told.
void add_undecided(const Attempts& speeds, const Attempts& points, ordered_json& out) {
  ordered_json all = ordered_json::array();
  for (const Attempts* attempts : {&speeds, &points})
    for (const auto& [i, told] : attempts->undecided()) all.push_back(told);
  if (all.empty()) return;
  if (!out.contains("speeds") && !out.contains("points")) {
    const ordered_json& first = all.front();
    throw ModelRangeError("stability: " + first.at("pointer").get<std::string>() +
                          ": at " + number_text(first.at("n_rpm")) +
                          " 1/min: " + first.at("why").get<std::string>());
  }
  out["undecided"] = std::move(all);
}

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json described(const SpeedLimits& speed) {
  ordered_json crossings = ordered_json::array();
  for (const Crossing& c : speed.crossings)
    crossings.push_back({{"ap_mm", c.ap_mm},
                         {"sense", c.loss ? "loss" : "regain"},
                         {"kind", c.flip             ? "flip"
                                  : c.theta_rad == 0 ? "fold"
                                                     : "hopf"},
                         {"frequency_Hz", c.frequency_Hz},
                         {"relative_error", std::isnan(c.relative_error)
                                                ? ordered_json()
                                                : ordered_json(c.relative_error)}});
  ordered_json out{{"n_rpm", speed.n_rpm}};
  out["limit_mm"] = or_null(speed.limit_mm());
  out["crossings"] = std::move(crossings);
  if (!speed.unstable.empty()) out["unstable_multipliers"] = speed.unstable;
  return out;
}

ordered_json described(const UncertainLimit& limit) {
  return {{"robust_mm", or_null(limit.robust_mm)},
          {"p05_mm", or_null(limit.p05_mm)},
          {"p50_mm", or_null(limit.p50_mm)},
          {"p95_mm", or_null(limit.p95_mm)}};
}

double stable_mm(const SpeedLimits& speed, double ap_max) {
  return speed.limit_mm().value_or(ap_max);
}

/// The machine's speed that removes most: n times the depth up to the first loss; null if
/// it has none of them.
ordered_json best(const Request& q, const std::vector<SpeedLimits>& speeds) {
  const double ap_max = *q.ap_max_mm;
  const auto volume = [&](const SpeedLimits& s) {
    const bool possible = !q.machine || q.machine->holds(s.n_rpm);
    return possible ? s.n_rpm * stable_mm(s, ap_max) : 0;
  };
  const auto at = std::ranges::max_element(speeds, {}, volume);
  if (!(volume(*at) > 0)) return {};
  return {{"n_rpm", at->n_rpm},
          {"ap_mm", stable_mm(*at, ap_max)},
          {"limited_by", at->limit_mm() ? "chatter" : "ap_max_mm"}};
}

/// A speed, and to which depth it is stable, if that is told.
using StableAt = std::pair<double, std::optional<double>>;

/// Local maxima of the limit over the speeds in rising order.
ordered_json magic(std::vector<StableAt> all) {
  std::ranges::sort(all);
  ordered_json out = ordered_json::array();
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const auto &below = all[i - 1].second, &at = all[i].second,
               &above = all[i + 1].second;
    if (below && at && above && *at > *below && *at >= *above)
      out.push_back({{"n_rpm", all[i].first}, {"ap_mm", *at}});
  }
  return out;
}

/// 2 k zeta (1 + zeta)/K, below which one mode is stable at every speed.
double absolute_limit_mm(const System& system) {
  const Mode& m = system.modes.front();
  return 2 * m.k_N_mm * m.zeta * (1 + m.zeta) /
         std::get<ConstantForce>(system.force).K_MPa;
}

UncertainLimit uncertain_of(const Request& q, const std::vector<System>& systems,
                            double n_rpm, const std::stop_token& stop) {
  leave_if(stop);
  return uncertain_limit(q.system, systems, *q.bands, n_rpm, *q.ap_max_mm);
}

/// What the limits rest on where the request names it only.
void add_basis(const Request& q, ordered_json& out) {
  for (const MeasuredAxis& measured : q.measured)
    out["frf"].push_back(described(measured));
  if (q.modes_of_cutter)
    for (const Mode& m : q.system.modes)
      out["modes"].push_back({{"axis", m.axis == Axis::x ? "x" : "y"},
                              {"frequency_Hz", m.wn_rad_s / (2 * units::kPi)},
                              {"damping_ratio", m.zeta},
                              {"stiffness_N_mm", m.k_N_mm}});
  if (q.chip)
    out["force"] = {{"hm_mm", q.chip->hm_mm},
                    {"Kt_MPa", q.chip->force.Kt_MPa},
                    {"Kn_MPa", q.chip->force.Kn_MPa}};
}

/// Tells how many of the speeds and points are done.
class Count {
 public:
  Count(const Request& q, const StabilityProgress& tell)
      : all_(q.speeds_rpm.size() + q.points.size()), tell_(tell) {}
  void one() {
    if (tell_) tell_(++done_, all_);
  }

 private:
  std::size_t done_ = 0, all_;
  const StabilityProgress& tell_;
};

/// Places in a list of speeds from the highest down: slow ones take longest.
std::vector<std::size_t> from_the_fastest(const std::vector<double>& speeds_rpm) {
  std::vector<std::size_t> out(speeds_rpm.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::ranges::stable_sort(out, std::ranges::greater(),
                           [&](std::size_t i) { return speeds_rpm[i]; });
  return out;
}

void add_speeds(const Request& q, const std::stop_token& stop, Count& done,
                Attempts& attempts, ordered_json& out) {
  const auto systems = q.bands ? drawn(q.system, *q.bands) : std::vector<System>{};
  std::map<std::size_t, std::pair<SpeedLimits, ordered_json>> found;
  for (const std::size_t i : from_the_fastest(q.speeds_rpm)) {
    const Point deepest{q.speeds_rpm[i], *q.ap_max_mm};
    auto speed = attempts.at(i, q.pointer_of_speed(i), deepest, [&] {
      const SpeedLimits limits = limits_of(q, deepest.n_rpm, stop);
      ordered_json told = described(limits);
      if (q.bands)
        told["uncertain"] = described(uncertain_of(q, systems, deepest.n_rpm, stop));
      return std::pair(limits, told);
    });
    if (speed) found.emplace(i, std::move(*speed));
    done.one();
  }
  if (found.empty()) return;
  std::vector<SpeedLimits> speeds;
  std::vector<StableAt> stable;
  for (const double n : q.speeds_rpm) stable.emplace_back(n, std::nullopt);
  for (auto& [i, speed] : found) {
    stable[i].second = stable_mm(speed.first, *q.ap_max_mm);
    speeds.push_back(std::move(speed.first));
    out["speeds"].push_back(std::move(speed.second));
  }
  if (!q.depths_mm.empty()) out["depths_mm"] = q.depths_mm;
  out["best"] = best(q, speeds);
  out["magic_speeds"] = magic(std::move(stable));
}

void add_points(const Request& q, const std::stop_token& stop, Count& done,
                Attempts& attempts, ordered_json& out) {
  for (std::size_t i = 0; i < q.points.size(); ++i) {
    const Point& p = q.points[i];
    if (const auto verdict = attempts.at(i, "/points/" + std::to_string(i), p,
                                         [&] { return judged(q, p, stop); }))
      out["points"].push_back(*verdict);
    done.one();
  }
}

}  // namespace

ordered_json stability(const json& request, const Catalogue& catalogue,
                       const std::stop_token& stop, const StabilityProgress& tell) {
  const Request q = read(request, catalogue);
  ordered_json out{{"format", "turnwright-stability-result/1"}};
  Count done(q, tell);
  Attempts speeds, points;
  add_basis(q, out);
  if (!q.speeds_rpm.empty()) add_speeds(q, stop, done, speeds, out);
  add_points(q, stop, done, points, out);
  add_undecided(speeds, points, out);
  if (q.model == Model::turning && q.system.modes.size() == 1 && !q.cutter)
    out["absolute_limit_mm"] = absolute_limit_mm(q.system);
  out["assumed"] = q.assumed;
  out["warnings"] = ordered_json::array();
  for (const MeasuredAxis& measured : q.measured)
    for (const std::string& doubt : doubts(measured)) out["warnings"].push_back(doubt);
  return out;
}

}  // namespace turnwright::document
