#include "turnwright/document/stability.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stability_request.hpp"
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

ordered_json described(const Request& q, const ChartPoint& point) {
  ordered_json out{{"n_rpm", point.at.n_rpm}, {"ap_mm", point.at.ap_mm}};
  out["unstable_multipliers"] =
      point.unstable ? ordered_json(*point.unstable) : ordered_json();
  out["spectral_radius"] = point.spectral_radius;
  out["stable"] = point.stable;
  if (q.method == Method::fundamental_matrix && q.cutter && q.cutter->feed_mm > 0 &&
      point.at.ap_mm > 0)
    out["walls"] = point.stable ? described(point.walls) : ordered_json();
  return out;
}

ordered_json described(const Undecided& undecided, const std::string& pointer) {
  const auto& [i, at, why, harder_rpm, stable_to_mm] = undecided;
  ordered_json out{{"pointer", pointer},
                   {"n_rpm", at.n_rpm},
                   {"ap_mm", at.ap_mm},
                   {"why", !why.empty() ? why
                                        : "not tried, as " + number_text(harder_rpm) +
                                              " 1/min would take too long"}};
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

void add_speeds(const Request& q, const StabilityChart& chart, ordered_json& out) {
  if (chart.speeds.empty()) return;
  for (const ChartSpeed& speed : chart.speeds) {
    ordered_json told = described(speed.limits);
    if (speed.uncertain) told["uncertain"] = described(*speed.uncertain);
    out["speeds"].push_back(std::move(told));
  }
  if (!q.depths_mm.empty()) out["depths_mm"] = q.depths_mm;
  out["best"] = ordered_json();
  if (chart.best) {
    out["best"] = described(*chart.best);
    out["best"]["limited_by"] =
        chart.best_is_limited_by_chatter ? "chatter" : "ap_max_mm";
  }
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
  add_speeds(q, chart, out);
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
