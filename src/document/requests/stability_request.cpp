#include "stability_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/catalogue/entries.hpp"
#include "document/json/fields.hpp"
#include "mode_reader.hpp"
#include "reference_work.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/cutting/milled.hpp"

namespace turnwright::document::stability_request {
namespace {

using namespace turnwright::chatter;
using nlohmann::json;

constexpr std::size_t kModes = 20, kSpeeds = 10000, kPoints = 10000, kChecked = 200;
constexpr std::size_t kCounted = 1000, kCuts = 1'000'000;   // depths of a speed, cuts
constexpr std::size_t kDrawn = 10000, kSearches = 100'000;  // samples, times speeds
constexpr double kSlenderDamping = 0.03;
constexpr std::size_t kVariations = 20, kVaried = 200;  // of a list, of all
constexpr std::size_t kShapedSpeeds = 500;  // of cutters beyond straight and even edges
const Bounds kSpeed = within(1, 1e6, "1/min"), kDepth = above_up_to(0, 1000, "mm"),
             kPointDepth = within(0, 1000, "mm"), kPressure = within(1e-3, 1e6, "MPa"),
             kFeed = above_up_to(0, 10, "mm");

enum class Direction { down, up, slot };

Engagement read_engagement(Reader& r) {
  const auto direction = r.choice<Direction>(
      "direction",
      {{"down", Direction::down}, {"up", Direction::up}, {"slot", Direction::slot}});
  const Bounds bounds = within(1e-6, 1);
  if (direction == Direction::slot) {
    const auto given = r.optional_number("radial_immersion", bounds);
    if (given && *given < 1)
      r.problem_at("radial_immersion", tr("1 or none, for a slot"), "range");
    return {0, units::kPi};
  }
  const double immersion = r.number("radial_immersion", bounds);
  return direction == Direction::up ? up_milling(immersion) : down_milling(immersion);
}

using Named = std::optional<catalogue::MillingCutter>;

/// "cutter", in place of teeth and diameter, and of modes where none are given.
Named read_named(Reader& r, const Catalogue& catalogue) {
  if (!r.has("cutter")) return std::nullopt;
  for (const char* key : {"teeth", "diameter_mm"})
    if (r.has(key)) r.problem_at(key, tr("no such key beside cutter"), "exclusive");
  const auto before = r.problems().list.size();
  auto cutter = cutter_of(catalogue, r.at("cutter"));
  if (r.problems().list.size() > before) return std::nullopt;
  return cutter;
}

/// Reads a material in place of Kt_MPa and Kn_MPa: both follow from Kienzle's law at the
/// mean chip thickness.
void read_material(Reader& r, const Catalogue& catalogue, const Named& cutter,
                   Request& q) {
  for (const char* key : {"Kt_MPa", "Kn_MPa"})
    if (r.has(key)) r.problem_at(key, tr("no such key beside material"), "exclusive");
  const auto before = r.problems().list.size();
  const auto material = material_of(catalogue, r.at("material"));
  const double fz = r.number("feed_mm", kFeed);
  if (r.problems().list.size() > before) return;
  if (!cutter)
    q.assumed.push_back({{"pointer", "/cutter/geometry/gamma_deg"},
                         {"value", material.gamma0_deg},
                         {"why", tr("the rake that kc1.1 belongs to")}});
  const double rake = cutter ? cutter->gamma_deg : material.gamma0_deg;
  const double immersion =
      (std::cos(q.system.entry_rad) - std::cos(q.system.exit_rad)) / 2;
  const double hm = fz * cutting::milled_chip(immersion).hm_over_fz;
  const auto K =
      cutting::chip_stiffness(cutting::kienzle_at(material, rake), material, hm);
  const LinearForce force{K.Kt_MPa, K.Kn_MPa};
  q.system.force = force;
  q.chip = {hm, force};
}

bool has_axis(const Request& q, Axis axis) {
  return std::ranges::any_of(q.system.modes,
                             [&](const Mode& m) { return m.axis == axis; });
}

void add_modes(const MeasuredAxis& measured, Request& q) {
  for (const FittedMode& m : measured.fit.modes)
    q.system.modes.push_back({.axis = measured.axis,
                              .wn_rad_s = m.wn_rad_s.value,
                              .zeta = m.zeta.value,
                              .k_N_mm = m.k_N_mm.value});
}

/// "frf": responses measured along axes that have no mode yet.
void read_measured(Reader& r, AxisKey axis, std::size_t most, Request& q) {
  for (const Reader& item : r.optional_items("frf", 1, most)) {
    auto measured = read_frequency_response(item, axis);
    if (!measured) continue;
    if (has_axis(q, measured->axis))
      Reader(item).problem_at("axis", tr("an axis without modes"), "conflict");
    add_modes(*measured, q);
    q.measured.push_back(std::move(*measured));
  }
}

void add_modes(const catalogue::MillingCutter& cutter, Request& q) {
  for (const catalogue::TipMode& m : cutter.modes)
    q.system.modes.push_back({.axis = m.along_feed ? Axis::x : Axis::y,
                              .wn_rad_s = 2 * units::kPi * m.frequency_Hz,
                              .zeta = m.damping_ratio,
                              .k_N_mm = m.stiffness_N_mm});
  q.modes_of_cutter = true;
}

void read_milling(Reader& r, const Catalogue& catalogue, const Named& named, Request& q) {
  if (!r.has("cutter"))
    q.system.teeth = static_cast<int>(r.integer("teeth", 1, 100));
  else if (named)
    q.system.teeth = named->teeth;
  if (!r.has("material")) {
    LinearForce force;
    force.Kt_MPa = r.number("Kt_MPa", kPressure);
    force.Kn_MPa = r.number("Kn_MPa", within(0, 1e6, "MPa"));
    q.system.force = force;
  }
  const Engagement cut = read_engagement(r);
  q.system.entry_rad = cut.entry_rad;
  q.system.exit_rad = cut.exit_rad;
  if (r.has("material")) read_material(r, catalogue, named, q);
  for (Reader& mode : r.optional_items("modes", 1, kModes)) {
    mode = mode.as_object();
    const auto axis = mode.choice<Axis>("axis", {{"x", Axis::x}, {"y", Axis::y}});
    q.system.modes.push_back(read_mode(mode, axis, {}));
  }
  read_measured(r, AxisKey::asked, 2, q);
  if (r.has("modes") || r.has("frf")) return;
  if (named)
    add_modes(*named, q);
  else if (!r.has("cutter"))
    r.problem_at("modes", tr("modes, frf or cutter"), "missing");
}

void read_power_law(Reader& r, Request& q) {
  q.system.teeth = static_cast<int>(r.integer("teeth", 1, 100));
  q.system.exit_rad = units::kPi;
  Mode mode;
  mode.wn_rad_s = r.number("natural_frequency_rad_s", within(1, 1e7, "rad/s"));
  mode.zeta = r.number("damping_ratio", kModeDamping);
  mode.k_N_mm = stiffness_N_mm(r.number("mass_kg", kModeMass), mode.wn_rad_s);
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
  for (const Reader& item : r.optional_items("modes", 1, kModes)) {
    Reader mode = item.as_object();
    if (mode.is_object() && !mode.has("damping_ratio"))
      q.assumed.push_back(
          {{"pointer", "/modes/" + std::to_string(i) + "/damping_ratio"},
           {"value", kSlenderDamping},
           {"why", tr("slender parts in a chuck and boring bars in a holder")}});
    q.system.modes.push_back(read_mode(mode, Axis::x, kSlenderDamping));
    ++i;
  }
  if (r.has("modes") && r.has("frf"))
    r.problem_at("frf", tr("either modes or frf"), "exclusive");
  else if (!r.has("modes") && !r.has("frf"))
    r.problem_at("modes", tr("modes or frf"), "missing");
  else
    read_measured(r, AxisKey::none, 1, q);
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
      r.problem_at("pitch_deg", tr("angles that add up to 360 deg"), "range");
    for (double& pitch : cutter.pitch_rad) pitch *= 360 / sum;
  }
  if (r.has("runout_mm"))
    cutter.offset_mm = r.numbers("runout_mm", within(-10, 10, "mm"), teeth, teeth);
  cutter.feed_mm = r.number_or("feed_mm", kFeed, 0);
  if (!cutter.offset_mm.empty() && !r.has("feed_mm"))
    r.problem_at("feed_mm", tr("a feed per tooth, for runout_mm"), "missing");
}

/// Reads helix, unequal pitches, runout, feed per tooth and process damping into
/// `q.cutter`, which stays empty if the request has none of them.
void read_cutter(Reader& r, const Named& named, Request& q) {
  constexpr std::array kEdges{"helix_deg", "pitch_deg", "runout_mm", "feed_mm"};
  const bool mill = q.model == Model::milling;
  const bool edges =
      mill && std::ranges::any_of(kEdges, [&](const char* key) { return r.has(key); });
  const bool damped = r.has("process_damping");
  const double diameter =
      r.number_or("diameter_mm", above_up_to(0, 1e4, "mm"), named ? named->dc_mm : 0);
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
  if (((mill && r.has("helix_deg")) || damped) && !r.has("diameter_mm") &&
      !r.has("cutter"))
    r.problem_at("diameter_mm", tr("a diameter, for helix_deg and process_damping"),
                 "missing");
  q.cutter = std::move(cutter);
}

/// "speed_variation": every amplitude with every frequency.
void read_variations(Reader& r, Request& q) {
  auto found = r.find("speed_variation");
  if (!found) return;
  Reader v = found->as_object();
  const auto amplitudes = v.numbers("rva", within(0, 0.9), 1, kVariations);
  const auto frequencies = v.numbers("rvf", within(0.01, 1), 1, kVariations);
  v.finish();
  for (const double rva : amplitudes)
    for (const double rvf : frequencies) q.variations.push_back({rva, rvf});
  for (const char* key : {"process_damping", "uncertainty", "method"})
    if (r.has(key))
      r.problem_at(key, tr("no such key with speed_variation"), "exclusive");
  if (q.variations.size() * q.speeds_rpm.size() > kVaried)
    r.problem_at("speed_variation",
                 say("at most {} amplitudes times frequencies times speeds", kVaried),
                 "range");
  for (const Mode& m : q.system.modes)
    if (m.zeta >= 0.7)
      r.problem_at("speed_variation", tr("damping ratios below 0.7"), "range");
}

SpeedRange read_range(Reader& r) {
  const SpeedRange range{r.number("from", kSpeed), r.number("to", kSpeed)};
  if (range.from_rpm > range.to_rpm)
    r.problem_at("to", tr("a speed not below from"), "range");
  return range;
}

void read_speeds(Reader& r, Request& q) {
  auto found = r.find("speeds_rpm");
  if (!found) return;
  q.speeds_listed = !found->is_object();
  if (q.speeds_listed) {
    q.speeds_rpm = found->as_numbers(kSpeed, 1, kSpeeds);
    return;
  }
  const auto [from, to] = read_range(*found);
  const long count = found->integer("count", 1, kSpeeds);
  found->finish();
  for (long i = 0; i < count; ++i)
    q.speeds_rpm.push_back(count == 1 ? from
                                      : from + (to - from) * static_cast<double>(i) /
                                                   static_cast<double>(count - 1));
}

/// "depths": the number of equal steps up to ap_max_mm.
void read_depths(Reader& r, Request& q) {
  if (!r.has("depths")) return;
  const long count = r.integer("depths", 1, kCounted);
  if (q.method != Method::fundamental_matrix)
    r.problem_at("depths", tr("no such key with this method"), "exclusive");
  else if (static_cast<std::size_t>(count) * q.speeds_rpm.size() > kCuts)
    r.problem_at("depths", say("at most {} depths over all speeds", kCuts), "range");
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
    u.problem_at("samples", say("at most {} samples over all speeds", kSearches),
                 "range");
  u.finish();
  if (q.method != Method::fundamental_matrix)
    r.problem_at("uncertainty", tr("no such key with this method"), "exclusive");
  q.bands = bands;
}

/// The spindle's speeds, among which `best` is chosen.
void read_machine(Reader& r, Request& q) {
  auto found = r.find("machine_rpm");
  if (!found) return;
  Reader range = found->as_object();
  q.machine = read_range(range);
  range.finish();
  if (!q.speeds_rpm.empty() &&
      std::ranges::none_of(q.speeds_rpm, [&](double n) { return q.machine->holds(n); }))
    r.problem_at("machine_rpm", tr("a range that holds one of speeds_rpm"), "range");
}

/// "stability_margin" and "speed_margin", which the best cut keeps.
void read_margins(Reader& r, Request& q) {
  const auto share = [&](const char* key, const Bounds& bounds, double usual,
                         const std::string& why) {
    if (!q.speeds_rpm.empty() && !r.has(key))
      q.assumed.push_back(
          {{"pointer", std::string("/") + key}, {"value", usual}, {"why", why}});
    return r.number_or(key, bounds, usual);
  };
  const Margins usual;
  q.margins.depth =
      share("stability_margin", within(0, 10), usual.depth,
            tr("the best cut stays stable when it is deeper by this share"));
  q.margins.speed = share("speed_margin", within(0, 0.2), usual.speed,
                          tr("and at all speeds slower or faster by this share, or with "
                             "all natural frequencies higher or lower by it"));
}

/// What milling removes in a revolution per depth, if feed and diameter are known, and the
/// machine's power and torque, which limit the best cut.
void read_spindle(Reader& r, const Named& named, Request& q) {
  SpindleLoad load;
  load.power_kW = r.optional_number("machine_power_kW", above_up_to(0, 1000, "kW"));
  load.torque_Nm = r.optional_number("machine_torque_Nm", above_up_to(0, 1e5, "Nm"));
  const double fz = q.cutter ? q.cutter->feed_mm : 0;
  const double diameter = q.cutter ? q.cutter->diameter_mm : 0;
  if (load.power_kW || load.torque_Nm) {
    if (!r.has("feed_mm"))
      r.problem_at("feed_mm", tr("a feed per tooth, for the machine's power and torque"),
                   "missing");
    if (!r.has("diameter_mm") && !named && !r.has("cutter"))
      r.problem_at("diameter_mm", tr("a diameter, for the machine's power and torque"),
                   "missing");
  }
  if (!(fz > 0 && diameter > 0)) return;
  const double ae =
      diameter * (std::cos(q.system.entry_rad) - std::cos(q.system.exit_rad)) / 2;
  q.removed_mm2 = q.system.teeth * fz * ae;
  constexpr double m_per_mm = 1e-3;
  load.torque_Nm_mm = m_per_mm * std::get<LinearForce>(q.system.force).Kt_MPa *
                      *q.removed_mm2 / (2 * units::kPi);
  q.spindle = load;
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

void refuse_beside_shape(Reader& r, const Request& q) {
  const std::string with =
      tr("no such key with helix_deg, pitch_deg, runout_mm or process_damping");
  if (q.method != Method::fundamental_matrix) r.problem_at("method", with, "exclusive");
  if (q.bands) r.problem_at("uncertainty", with, "exclusive");
  if (q.speeds_rpm.size() > kShapedSpeeds)
    r.problem_at("speeds_rpm", say("at most {} speeds of such a cutter", kShapedSpeeds),
                 "range");
}

void refuse_without_speeds(Reader& r, const Request& q) {
  std::vector<std::string_view> keys{"depths", "uncertainty", "machine_rpm",
                                     "stability_margin", "speed_margin"};
  if (q.model == Model::milling)
    keys.insert(keys.end(), {"machine_power_kW", "machine_torque_Nm"});
  if (q.model == Model::turning) keys.push_back("speed_variation");
  for (const std::string_view key : keys)
    if (!r.broken() && r.has(key) && !r.has("speeds_rpm"))
      r.problem_at(key, tr("no such key without speeds_rpm"), "exclusive");
}

Request read_request(const json& request, const Catalogue& catalogue,
                     Problems& problems) {
  Request q;
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-stability/1");
  const std::size_t problems_before = problems.list.size();
  q.model = r.choice<Model>("model", {{"milling", Model::milling},
                                      {"power-law", Model::power_law},
                                      {"turning", Model::turning}});
  const bool known = problems.list.size() == problems_before && !r.broken();
  if (known) {
    const Named named =
        q.model == Model::milling ? read_named(r, catalogue) : std::nullopt;
    if (q.model == Model::milling) read_milling(r, catalogue, named, q);
    if (q.model == Model::power_law) read_power_law(r, q);
    if (q.model == Model::turning) read_turning(r, q);
    if (q.model != Model::power_law) read_cutter(r, named, q);
    if (q.model == Model::milling) read_spindle(r, named, q);
  }
  read_method(r, q);
  read_speeds(r, q);
  q.ap_max_mm = r.optional_number("ap_max_mm", kDepth);
  read_depths(r, q);
  read_uncertainty(r, q);
  read_machine(r, q);
  read_margins(r, q);
  if (q.model == Model::turning && known) read_variations(r, q);
  for (Reader& point : r.optional_items("points", 1, kPoints)) {
    point = point.as_object();
    chatter::OperatingPoint p;
    p.n_rpm = point.number("n_rpm", kSpeed);
    p.ap_mm = point.number("ap_mm", kPointDepth);
    point.finish();
    q.points.push_back(p);
  }
  const auto few = [&](std::string_view key, std::size_t asked) {
    if (q.method != Method::fundamental_matrix && asked > kChecked)
      r.problem_at(key, say("at most {} with this method", kChecked), "range");
  };
  few("speeds_rpm", q.speeds_rpm.size());
  few("points", q.points.size());
  if (q.shaped()) refuse_beside_shape(r, q);
  if (problems.list.size() == problems_before) limit_reference_work(r, q);
  if (!r.broken() && !r.has("speeds_rpm") && !r.has("points"))
    r.problem_at("speeds_rpm", tr("speeds_rpm or points"), "missing");
  if (!r.broken() && r.has("speeds_rpm") && !r.has("ap_max_mm"))
    r.problem_at("ap_max_mm", say("{} to search up to", expected_number(kDepth)),
                 "missing");
  refuse_without_speeds(r, q);
  if (known) r.finish();
  return q;
}

}  // namespace

Request read(const json& request, const Catalogue& catalogue) {
  Problems problems{.document = "stability"};
  Request q = read_request(request, catalogue, problems);
  problems.throw_if_any();
  return q;
}

}  // namespace turnwright::document::stability_request
