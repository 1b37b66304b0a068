#include "turnwright/document/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fields.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/document/reader.hpp"
#include "turnwright/milling/checks.hpp"
#include "turnwright/milling/cutter.hpp"
#include "turnwright/milling/limits.hpp"
#include "turnwright/milling/uncertain.hpp"

namespace turnwright::document {
namespace {

using namespace turnwright::milling;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kModes = 20, kSpeeds = 10000, kPoints = 10000, kChecked = 200;
constexpr int kDepths = 40;                                 // scanned by the checks
constexpr std::size_t kCounted = 1000, kCuts = 1'000'000;   // depths of a speed, cuts
constexpr std::size_t kDrawn = 10000, kSearches = 100'000;  // samples, times speeds
constexpr double kSlenderDamping = 0.03;
constexpr std::size_t kShapedSpeeds = 500;  // of cutters beyond straight and even edges
const Bounds kSpeed = within(1, 1e6, "1/min"), kDepth = above_up_to(0, 1000, "mm"),
             kPointDepth = within(0, 1000, "mm"), kFrequency = within(0.1, 1e6, "Hz"),
             kDamping = within(1e-6, 10), kMass = within(1e-9, 1e9, "kg"),
             kStiffness = within(1e-6, 1e12, "N/mm"),
             kPressure = within(1e-3, 1e6, "MPa");

enum class Method { fundamental_matrix, tfea, semi_discretisation, simulation };
enum class Model { milling, power_law, turning };

struct Point {
  double n_rpm = 0, ap_mm = 0;
};

struct SpeedRange {
  double from_rpm = 0, to_rpm = 0;
  bool holds(double n_rpm) const { return n_rpm >= from_rpm && n_rpm <= to_rpm; }
};

struct Request {
  Model model = Model::milling;
  System system;
  std::optional<Cutter> cutter;  // with what `system` does not hold
  std::optional<double> ap_max_mm;
  std::vector<double> speeds_rpm;
  std::vector<double> depths_mm;  // counted at each speed
  std::optional<Bands> bands;
  std::optional<SpeedRange> machine;
  std::vector<Point> points;
  Method method = Method::fundamental_matrix;
  int resolution = 0;  // elements or intervals
  ordered_json assumed = ordered_json::array();
};

double stiffness_N_mm(double mass_kg, double wn_rad_s) {
  return mass_kg * wn_rad_s * wn_rad_s / 1000;  // N/m to N/mm
}

/// Stiffness as such or as a mass.
double read_stiffness(Reader& r, double wn_rad_s) {
  const auto mass = r.optional_number("mass_kg", kMass);
  const auto stiffness = r.optional_number("stiffness_N_mm", kStiffness);
  if (mass && stiffness)
    r.problem_at("mass_kg", "either mass_kg or stiffness_N_mm", "exclusive");
  else if (!mass && !stiffness)
    r.problem_at("stiffness_N_mm", "stiffness_N_mm or mass_kg", "missing");
  return mass ? stiffness_N_mm(*mass, wn_rad_s) : stiffness.value_or(1);
}

Mode read_mode(Reader r, Axis axis, std::optional<double> damping) {
  Mode mode{.axis = axis};
  mode.wn_rad_s = 2 * units::kPi * r.number("frequency_Hz", kFrequency);
  mode.zeta = damping ? r.number_or("damping_ratio", kDamping, *damping)
                      : r.number("damping_ratio", kDamping);
  mode.k_N_mm = read_stiffness(r, mode.wn_rad_s);
  r.finish();
  return mode;
}

enum class Direction { down, up, slot };

Engagement read_engagement(Reader& r) {
  const auto direction = r.choice<Direction>(
      "direction",
      {{"down", Direction::down}, {"up", Direction::up}, {"slot", Direction::slot}});
  const Bounds bounds = within(1e-6, 1);
  if (direction == Direction::slot) {
    const auto given = r.optional_number("radial_immersion", bounds);
    if (given && *given < 1)
      r.problem_at("radial_immersion", "1 or none, for a slot", "range");
    return {0, units::kPi};
  }
  const double immersion = r.number("radial_immersion", bounds);
  return direction == Direction::up ? up_milling(immersion) : down_milling(immersion);
}

void read_milling(Reader& r, Request& q) {
  q.system.teeth = static_cast<int>(r.integer("teeth", 1, 100));
  LinearForce force;
  force.Kt_MPa = r.number("Kt_MPa", kPressure);
  force.Kn_MPa = r.number("Kn_MPa", within(0, 1e6, "MPa"));
  q.system.force = force;
  const Engagement cut = read_engagement(r);
  q.system.entry_rad = cut.entry_rad;
  q.system.exit_rad = cut.exit_rad;
  for (Reader& mode : r.items("modes", 1, kModes)) {
    mode = mode.as_object();
    const auto axis = mode.choice<Axis>("axis", {{"x", Axis::x}, {"y", Axis::y}});
    q.system.modes.push_back(read_mode(mode, axis, {}));
  }
}

void read_power_law(Reader& r, Request& q) {
  q.system.teeth = static_cast<int>(r.integer("teeth", 1, 100));
  q.system.exit_rad = units::kPi;
  Mode mode;
  mode.wn_rad_s = r.number("natural_frequency_rad_s", within(1, 1e7, "rad/s"));
  mode.zeta = r.number("damping_ratio", kDamping);
  mode.k_N_mm = stiffness_N_mm(r.number("mass_kg", kMass), mode.wn_rad_s);
  q.system.modes = {mode};
  PowerLawForce force;
  force.C = r.number("C", within(1, 1e15, "N m^-(1 + gamma)"));
  force.gamma = r.number("gamma", within(0.05, 1));
  force.feed_speed_m_s = r.number("feed_speed_m_s", within(1e-9, 100, "m/s"));
  force.normal_ratio = r.number("normal_ratio", within(0, 10));
  q.system.force = force;
}

void read_turning(Reader& r, Request& q) {
  q.system.exit_rad = 2 * units::kPi;
  const double kappa = r.number("kappa_deg", within(1, 89.9, "deg"));
  const double kp = r.number("kp_MPa", kPressure);
  q.system.force = ConstantForce{kp / std::tan(units::rad_from_deg(kappa))};
  std::size_t i = 0;
  for (const Reader& item : r.items("modes", 1, kModes)) {
    Reader mode = item.as_object();
    if (mode.is_object() && !mode.has("damping_ratio"))
      q.assumed.push_back({{"pointer", "/modes/" + std::to_string(i) + "/damping_ratio"},
                           {"value", kSlenderDamping},
                           {"why", "slender parts and bars in a chuck or holder"}});
    q.system.modes.push_back(read_mode(mode, Axis::x, kSlenderDamping));
    ++i;
  }
}

/// Helix, pitches, offsets and feed of a mill.
void read_edges(Reader& r, Cutter& cutter) {
  const auto teeth = static_cast<std::size_t>(cutter.system.teeth);
  if (r.has("helix_deg"))
    cutter.helix_rad = units::rad_from_deg(r.number("helix_deg", within(0, 80, "deg")));
  if (r.has("pitch_deg")) {
    cutter.pitch_rad = r.numbers("pitch_deg", above_up_to(0, 360, "deg"), teeth, teeth);
    double sum = 0;
    for (double& pitch : cutter.pitch_rad) {
      sum += pitch;
      pitch = units::rad_from_deg(pitch);
    }
    constexpr double kClosed = 1e-6;
    if (cutter.pitch_rad.size() == teeth && std::abs(sum - 360) > kClosed)
      r.problem_at("pitch_deg", "angles that add up to 360 deg", "range");
    for (double& pitch : cutter.pitch_rad) pitch *= 360 / sum;
  }
  if (r.has("runout_mm"))
    cutter.offset_mm = r.numbers("runout_mm", within(-10, 10, "mm"), teeth, teeth);
  cutter.feed_mm = r.number_or("feed_mm", above_up_to(0, 10, "mm"), 0);
  if (!cutter.offset_mm.empty() && !r.has("feed_mm"))
    r.problem_at("feed_mm", "a feed per tooth, for runout_mm", "missing");
}

/// What a straight, even, sharp cutter does not have; none if no key asks for it.
void read_cutter(Reader& r, Request& q) {
  constexpr std::array kEdges{"helix_deg", "pitch_deg", "runout_mm", "feed_mm"};
  const bool mill = q.model == Model::milling;
  const bool edges =
      mill && std::ranges::any_of(kEdges, [&](const char* key) { return r.has(key); });
  const bool damped = r.has("process_damping");
  const double diameter = r.number_or("diameter_mm", above_up_to(0, 1e4, "mm"), 0);
  if (!edges && !damped) return;
  Cutter cutter{.system = q.system};
  cutter.diameter_mm = diameter;
  if (mill) read_edges(r, cutter);
  if (auto found = r.find("process_damping")) {
    Reader damping = found->as_object();
    cutter.indentation_N_mm = damping.number("C_N_mm", within(0, 1e6, "N/mm"));
    if (mill) cutter.friction = damping.number_or("friction", within(0, 2), 0);
    damping.finish();
  }
  if (((mill && r.has("helix_deg")) || damped) && !r.has("diameter_mm"))
    r.problem_at("diameter_mm", "a diameter, for helix_deg and process_damping",
                 "missing");
  q.cutter = std::move(cutter);
}

SpeedRange read_range(Reader& r) {
  const SpeedRange range{r.number("from", kSpeed), r.number("to", kSpeed)};
  if (range.from_rpm > range.to_rpm)
    r.problem_at("to", "a speed not below from", "range");
  return range;
}

std::vector<double> read_speeds(Reader& r) {
  if (auto found = r.find("speeds_rpm")) {
    if (!found->is_object()) return found->as_numbers(kSpeed, 1, kSpeeds);
    const auto [from, to] = read_range(*found);
    const long count = found->integer("count", 1, kSpeeds);
    found->finish();
    std::vector<double> out;
    for (long i = 0; i < count; ++i)
      out.push_back(count == 1 ? from
                               : from + (to - from) * static_cast<double>(i) /
                                            static_cast<double>(count - 1));
    return out;
  }
  return {};
}

/// "depths": so many equal steps up to ap_max_mm.
void read_depths(Reader& r, Request& q) {
  if (!r.has("depths")) return;
  const long count = r.integer("depths", 1, kCounted);
  if (q.method != Method::fundamental_matrix)
    r.problem_at("depths", "no such key with this method", "exclusive");
  else if (static_cast<std::size_t>(count) * q.speeds_rpm.size() > kCuts)
    r.problem_at("depths", "at most " + std::to_string(kCuts) + " depths over all speeds",
                 "range");
  for (long i = 1; i <= count && q.ap_max_mm; ++i)
    q.depths_mm.push_back(*q.ap_max_mm * static_cast<double>(i) /
                          static_cast<double>(count));
}

void read_uncertainty(Reader& r, Request& q) {
  auto found = r.find("uncertainty");
  if (!found) return;
  Reader u = found->as_object();
  const Bounds band = within(0, 0.9);
  Bands bands;
  bands.frequency = u.number_or("frequency", band, 0);
  bands.damping = u.number_or("damping", band, 0);
  bands.stiffness = u.number_or("stiffness", band, 0);
  bands.force = u.number_or("force", band, 0);
  bands.samples = static_cast<int>(u.integer("samples", 1, kDrawn));
  bands.seed = static_cast<std::uint64_t>(u.integer("seed", 0, 2147483647));
  if (static_cast<std::size_t>(bands.samples) * q.speeds_rpm.size() > kSearches)
    u.problem_at("samples",
                 "at most " + std::to_string(kSearches) + " samples over all speeds",
                 "range");
  u.finish();
  if (q.method != Method::fundamental_matrix)
    r.problem_at("uncertainty", "no such key with this method", "exclusive");
  q.bands = bands;
}

/// The spindle's speeds, among which `best` is looked for.
void read_machine(Reader& r, Request& q) {
  auto found = r.find("machine_rpm");
  if (!found) return;
  Reader range = found->as_object();
  q.machine = read_range(range);
  range.finish();
  if (!q.speeds_rpm.empty() &&
      std::ranges::none_of(q.speeds_rpm, [&](double n) { return q.machine->holds(n); }))
    r.problem_at("machine_rpm", "a range that holds one of speeds_rpm", "range");
}

/// "method" with its own key.
void read_method(Reader& r, Request& q) {
  q.method = r.choice_or<Method>("method",
                                 {{"fundamental-matrix", Method::fundamental_matrix},
                                  {"tfea", Method::tfea},
                                  {"semi-discretisation", Method::semi_discretisation},
                                  {"simulation", Method::simulation}},
                                 Method::fundamental_matrix);
  if (q.method == Method::tfea)
    q.resolution = static_cast<int>(r.integer("elements", 1, 60));
  if (q.method == Method::semi_discretisation)
    q.resolution = static_cast<int>(r.integer("intervals", 1, 200));
}

void refuse_beside_cutter(Reader& r, const Request& q) {
  const std::string with =
      "no such key with helix_deg, pitch_deg, runout_mm, feed_mm or process_damping";
  if (q.method != Method::fundamental_matrix) r.problem_at("method", with, "exclusive");
  if (q.bands) r.problem_at("uncertainty", with, "exclusive");
  if (q.speeds_rpm.size() > kShapedSpeeds)
    r.problem_at("speeds_rpm",
                 "at most " + std::to_string(kShapedSpeeds) + " speeds of such a cutter",
                 "range");
}

Request read_request(const json& request, Problems& problems) {
  Request q;
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-stability/1");
  const std::size_t problems_before = problems.list.size();
  q.model = r.choice<Model>("model", {{"milling", Model::milling},
                                      {"power-law", Model::power_law},
                                      {"turning", Model::turning}});
  const bool known = problems.list.size() == problems_before && !r.broken();
  if (known) {
    if (q.model == Model::milling) read_milling(r, q);
    if (q.model == Model::power_law) read_power_law(r, q);
    if (q.model == Model::turning) read_turning(r, q);
    if (q.model != Model::power_law) read_cutter(r, q);
  }
  read_method(r, q);
  q.speeds_rpm = read_speeds(r);
  q.ap_max_mm = r.optional_number("ap_max_mm", kDepth);
  read_depths(r, q);
  read_uncertainty(r, q);
  read_machine(r, q);
  for (Reader& point : r.optional_items("points", 1, kPoints)) {
    point = point.as_object();
    Point p;
    p.n_rpm = point.number("n_rpm", kSpeed);
    p.ap_mm = point.number("ap_mm", kPointDepth);
    point.finish();
    q.points.push_back(p);
  }
  const auto few = [&](std::string_view key, std::size_t asked) {
    if (q.method != Method::fundamental_matrix && asked > kChecked)
      r.problem_at(key, "at most " + std::to_string(kChecked) + " with this method",
                   "range");
  };
  few("speeds_rpm", q.speeds_rpm.size());
  few("points", q.points.size());
  if (q.cutter) refuse_beside_cutter(r, q);
  if (!r.broken() && !r.has("speeds_rpm") && !r.has("points"))
    r.problem_at("speeds_rpm", "speeds_rpm or points", "missing");
  if (!r.broken() && r.has("speeds_rpm") && !r.has("ap_max_mm"))
    r.problem_at("ap_max_mm", expected_number(kDepth) + " to search up to", "missing");
  for (const std::string_view key : {"depths", "uncertainty", "machine_rpm"})
    if (!r.broken() && r.has(key) && !r.has("speeds_rpm"))
      r.problem_at(key, "no such key without speeds_rpm", "exclusive");
  if (known) r.finish();
  return q;
}

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
  if (q.cutter) return speed_limits(*q.cutter, n_rpm, *q.ap_max_mm, q.depths_mm);
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
    const Multipliers m = q.cutter ? multipliers(*q.cutter, p.n_rpm, p.ap_mm)
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

/// What fails at one speed is told with it.
template <class F>
auto at_speed(double n_rpm, F compute) {
  try {
    return compute();
  } catch (const ModelRangeError& e) {
    throw ModelRangeError("stability: at " + number_text(n_rpm) + " 1/min: " + e.what());
  }
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

/// The machine's speed that removes most: n times the depth up to the first loss.
ordered_json best(const Request& q, const std::vector<SpeedLimits>& speeds) {
  const double ap_max = *q.ap_max_mm;
  const auto volume = [&](const SpeedLimits& s) {
    const bool possible = !q.machine || q.machine->holds(s.n_rpm);
    return possible ? s.n_rpm * stable_mm(s, ap_max) : 0;
  };
  const auto at = std::ranges::max_element(speeds, {}, volume);
  return {{"n_rpm", at->n_rpm},
          {"ap_mm", stable_mm(*at, ap_max)},
          {"limited_by", at->limit_mm() ? "chatter" : "ap_max_mm"}};
}

/// Local maxima of the limit over the speeds in rising order.
ordered_json magic(std::vector<SpeedLimits> speeds, double ap_max) {
  std::ranges::sort(speeds, {}, &SpeedLimits::n_rpm);
  ordered_json out = ordered_json::array();
  for (std::size_t i = 1; i + 1 < speeds.size(); ++i) {
    const double at = stable_mm(speeds[i], ap_max);
    if (at > stable_mm(speeds[i - 1], ap_max) && at >= stable_mm(speeds[i + 1], ap_max))
      out.push_back({{"n_rpm", speeds[i].n_rpm}, {"ap_mm", at}});
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

void add_speeds(const Request& q, const std::stop_token& stop, ordered_json& out) {
  const auto systems = q.bands ? drawn(q.system, *q.bands) : std::vector<System>{};
  std::vector<SpeedLimits> speeds;
  ordered_json told = ordered_json::array();
  for (const double n_rpm : q.speeds_rpm) {
    speeds.push_back(at_speed(n_rpm, [&] { return limits_of(q, n_rpm, stop); }));
    told.push_back(described(speeds.back()));
    if (q.bands)
      told.back()["uncertain"] = described(
          at_speed(n_rpm, [&] { return uncertain_of(q, systems, n_rpm, stop); }));
  }
  out["speeds"] = std::move(told);
  if (!q.depths_mm.empty()) out["depths_mm"] = q.depths_mm;
  out["best"] = best(q, speeds);
  out["magic_speeds"] = magic(speeds, *q.ap_max_mm);
}

}  // namespace

ordered_json stability(const json& request, const std::stop_token& stop) {
  Problems problems{.document = "stability"};
  const Request q = read_request(request, problems);
  problems.throw_if_any();
  ordered_json out{{"format", "turnwright-stability-result/1"}};
  if (!q.speeds_rpm.empty()) add_speeds(q, stop, out);
  if (!q.points.empty()) {
    ordered_json points = ordered_json::array();
    for (const Point& p : q.points)
      points.push_back(at_speed(p.n_rpm, [&] { return judged(q, p, stop); }));
    out["points"] = std::move(points);
  }
  if (q.model == Model::turning && q.system.modes.size() == 1 && !q.cutter)
    out["absolute_limit_mm"] = absolute_limit_mm(q.system);
  out["assumed"] = q.assumed;
  return out;
}

}  // namespace turnwright::document
