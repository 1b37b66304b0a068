#include "turnwright/document/stability.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "stability_request.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/chart.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::chatter;
using namespace stability_request;
using nlohmann::json;
using nlohmann::ordered_json;

/// The walls that a stable cut generates.
ordered_json described(const std::vector<Surface>& walls) {
  ordered_json out = ordered_json::array();
  for (const Surface& wall : walls)
    out.push_back({{"milled", wall.up_milled ? "up" : "down"},
                   {"height_mm", wall.height_mm},
                   {"left_mm", wall.left_mm}});
  return out;
}

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

/// A depth less than a limit, if there is one, by so much.
ordered_json margin_to(const std::optional<double>& limit_mm, double ap_mm) {
  return limit_mm ? ordered_json(*limit_mm - ap_mm) : ordered_json();
}

void add_margin(const ChartPoint& point, bool speeds, ordered_json& out) {
  const auto& [limit_mm, chatter_Hz, cure] = *point.margin;
  out["limit_mm"] = or_null(limit_mm);
  out["margin_mm"] = margin_to(limit_mm, point.at.ap_mm);
  if (point.stable) return;
  out["chatter_Hz"] = or_null(chatter_Hz);
  if (!speeds) return;
  out["cure"] = ordered_json();
  if (cure)
    out["cure"] = {{"n_rpm", cure->n_rpm},
                   {"limit_mm", or_null(cure->limit_mm)},
                   {"margin_mm", margin_to(cure->limit_mm, point.at.ap_mm)}};
}

ordered_json described(const Request& q, const ChartPoint& point) {
  ordered_json out{{"n_rpm", point.at.n_rpm}, {"ap_mm", point.at.ap_mm}};
  out["unstable_multipliers"] =
      point.unstable ? ordered_json(*point.unstable) : ordered_json();
  out["spectral_radius"] = point.spectral_radius;
  out["stable"] = point.stable;
  if (point.margin) add_margin(point, !q.speeds_rpm.empty(), out);
  if (q.method == Method::fundamental_matrix && q.cutter && q.cutter->feed_mm > 0 &&
      point.at.ap_mm > 0)
    out["walls"] = point.stable ? described(point.walls) : ordered_json();
  return out;
}

ordered_json described(const Undecided& undecided, const std::string& pointer) {
  const auto& [i, at, why, harder_rpm, stable_to_mm] = undecided;
  ordered_json out{
      {"pointer", pointer},
      {"n_rpm", at.n_rpm},
      {"ap_mm", at.ap_mm},
      {"why", !why.empty() ? why
                           : say("not tried, as {} 1/min would take too long",
                                 number_text(harder_rpm))}};
  if (stable_to_mm) out["stable_to_mm"] = *stable_to_mm;
  return out;
}

/// @throws ModelRangeError if nothing else is told.
void add_undecided(const Request& q, const StabilityChart& chart, ordered_json& out) {
  ordered_json all = ordered_json::array();
  for (const Undecided& u : chart.undecided_speeds)
    all.push_back(described(u, q.pointer_of_speed(u.index)));
  for (const Undecided& u : chart.undecided_points)
    all.push_back(described(u, "/points/" + std::to_string(u.index)));
  if (all.empty()) return;
  const auto in_part = [](const ordered_json& u) { return u.contains("stable_to_mm"); };
  if (chart.speeds.empty() && chart.points.empty() &&
      std::ranges::none_of(all, in_part)) {
    const ordered_json& first = all.front();
    throw ModelRangeError(
        say("stability: {}: at {} 1/min: {}", first.at("pointer").get<std::string>(),
            number_text(first.at("n_rpm")), first.at("why").get<std::string>()));
  }
  out["undecided"] = std::move(all);
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
  if (speed.searched_mm) out["searched_mm"] = *speed.searched_mm;
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

/// The data on which the limits rest, where the request only names them.
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

ordered_json described(const OperatingPoint& point) {
  return {{"n_rpm", point.n_rpm}, {"ap_mm", point.ap_mm}};
}

const char* name_of(DepthEnd end) {
  switch (end) {
    case DepthEnd::chatter:
      return "chatter";
    case DepthEnd::ap_max:
      return "ap_max_mm";
    case DepthEnd::power:
      return "machine_power_kW";
    case DepthEnd::torque:
      return "machine_torque_Nm";
  }
  throw std::domain_error("stability: unknown end of a depth");
}

ordered_json described(const Request& q, const SafeCut& best) {
  ordered_json out = described(best.at);
  out["limited_by"] = name_of(best.limited_by);
  out["limit_mm"] = or_null(best.limit_mm);
  out["margin_mm"] = margin_to(best.limit_mm, best.at.ap_mm);
  if (best.stable)
    out["stable_rpm"] = {{"from", best.stable->from_rpm}, {"to", best.stable->to_rpm}};
  if (best.chatter_Hz) out["chatter_Hz"] = *best.chatter_Hz;
  out["speeds_judged"] = best.speeds_judged;
  if (!q.removed_mm2) return out;
  constexpr double cm3_per_mm3 = 1e-3;
  out["removed_cm3_min"] = cm3_per_mm3 * *q.removed_mm2 * best.at.n_rpm * best.at.ap_mm;
  out["power_kW"] = q.spindle->power_at_kW(best.at);
  out["torque_Nm"] = q.spindle->torque_Nm_mm * best.at.ap_mm;
  return out;
}

/// The limits with each variation of the speed, beside the one without.
ordered_json varied(const Request& q, const SpeedLimits& constant,
                    const std::stop_token& stop) {
  ordered_json out = ordered_json::array();
  for (const SpeedVariation& v : q.variations) {
    leave_if(stop);
    ordered_json told{{"rva", v.rva}, {"rvf", v.rvf}};
    try {
      const VariedLimit limit = varied_limit(q.system, constant.n_rpm, v, *q.ap_max_mm);
      told["limit_mm"] = or_null(limit.limit_mm);
      told["relative_error"] =
          limit.limit_mm ? ordered_json(limit.relative_error) : ordered_json();
    } catch (const ModelRangeError& e) {
      told["why"] = e.what();
    }
    out.push_back(std::move(told));
  }
  return out;
}

void add_speeds(const Request& q, const StabilityChart& chart,
                const std::stop_token& stop, ordered_json& out) {
  if (chart.speeds.empty()) return;
  for (const ChartSpeed& speed : chart.speeds) {
    ordered_json told = described(speed.limits);
    if (speed.uncertain) told["uncertain"] = described(*speed.uncertain);
    if (!q.variations.empty()) told["varied"] = varied(q, speed.limits, stop);
    out["speeds"].push_back(std::move(told));
  }
  if (!q.depths_mm.empty()) out["depths_mm"] = q.depths_mm;
  out["best"] = ordered_json();
  if (chart.best) out["best"] = described(q, *chart.best);
  out["magic_speeds"] = ordered_json::array();
  for (const OperatingPoint& point : chart.magic)
    out["magic_speeds"].push_back(described(point));
}

}  // namespace

ordered_json stability(const json& request, const Catalogue& catalogue,
                       const std::stop_token& stop, const StabilityProgress& tell) {
  const Request q = read(request, catalogue);
  ordered_json out{{"format", "turnwright-stability-result/1"}};
  const StabilityChart chart = stability_chart(q, stop, tell);
  add_basis(q, out);
  add_speeds(q, chart, stop, out);
  for (const ChartPoint& point : chart.points)
    out["points"].push_back(described(q, point));
  add_undecided(q, chart, out);
  if (q.model == Model::turning && q.system.modes.size() == 1 && !q.cutter)
    out["absolute_limit_mm"] = absolute_limit_mm(q.system);
  out["assumed"] = q.assumed;
  out["warnings"] = ordered_json::array();
  for (const MeasuredAxis& measured : q.measured)
    for (const std::string& doubt : doubts(measured)) out["warnings"].push_back(doubt);
  return out;
}

}  // namespace turnwright::document
