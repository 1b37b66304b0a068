#include "turnwright/document/ball_bar.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "document/catalogue/calibrated_machine.hpp"
#include "document/catalogue/machine_fields.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/volumetric/ball_bar.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kTracePoints = 20000;
constexpr std::size_t kLeast = 7;  // of each path: more values than terms
const Bounds kRadius = above_up_to(0, 1e5, "mm"), kValue = within(-1e3, 1e3, "mm"),
             kAngle = within(-1e3, 1e3, "rad"), kCentre = within(-1e5, 1e5, "mm");

Plane read_plane(Reader& r) {
  return r.choice<Plane>("plane",
                         {{"XY", Plane::XY}, {"YZ", Plane::YZ}, {"ZX", Plane::ZX}});
}

struct Simulation {
  Machine machine;
  BallBarTest test;
};

Simulation read_simulation(Reader r) {
  Simulation s{.machine = read_chain(r), .test = {}};
  s.test.plane = read_plane(r);
  s.test.R_mm = r.number("R_mm", kRadius);
  s.test.n = static_cast<std::size_t>(r.integer("n", 1, kTracePoints));
  if (r.has("centre_offset_mm"))
    s.test.centre_offset_mm = read_vec3(r, "centre_offset_mm", kValue);
  if (r.has("centre_mm")) s.test.centre_mm = read_vec3(r, "centre_mm", kCentre);
  s.test.theta0_rad = r.optional_number("theta0_rad", kAngle);
  r.finish();
  if (!chain_fault(s.machine.chain).empty()) return s;
  for (const char axis : axes_of(s.test.plane))
    if (s.machine.chain.find(axis) == std::string::npos)
      r.problem_at("plane",
                   say("a plane of two axes of the chain, which has no {}", axis),
                   "conflict");
  return s;
}

/// Columns of a table: theta_rad or theta_deg, ccw and cw in the declared unit and sign.
void read_table(Reader& r, Trace& t) {
  const double unit = r.choice<double>("unit", {{"mm", 1}, {"um", units::mm_from_um(1)}});
  const double sign =
      r.choice<double>("sign", {{"longer-positive", 1}, {"shorter-positive", -1}});
  const bool degrees = r.choice_or<bool>("angle", {{"rad", false}, {"deg", true}}, false);
  std::string theta = degrees ? "theta_deg" : "theta_rad", ccw = "ccw", cw = "cw";
  if (auto names = r.optional_object("columns")) {
    theta = names->text_or("theta", theta);
    ccw = names->text_or("ccw", ccw);
    cw = names->text_or("cw", cw);
    names->finish();
    if (theta == ccw || theta == cw || ccw == cw)
      names->problem(tr("a column twice"), tr("three columns: theta, ccw and cw"),
                     "conflict");
  }
  for (const CsvRow& row : csv_rows(r.at("csv", tr("the text of a table, or its lines")),
                                    {{.name = theta}, {.name = ccw}, {.name = cw}},
                                    OtherColumns::ignored, kTracePoints)) {
    Reader cells(row.value, r.problems(), row.pointer);
    const double at = cells.number(theta, within(-1e5, 1e5));
    t.theta_rad.push_back(degrees ? units::rad_from_deg(at) : at);
    t.ccw_mm.push_back(sign * unit * cells.number(ccw, within(-1e6, 1e6)));
    t.cw_mm.push_back(sign * unit * cells.number(cw, within(-1e6, 1e6)));
  }
  if (!t.ccw_mm.empty() && t.ccw_mm.size() < kLeast)
    r.problem_at("csv", tr("a header and at least 7 rows"), "count");
}

void read_lists(Reader& r, Trace& t) {
  t.ccw_mm = r.numbers("ccw_mm", kValue, kLeast, kTracePoints);
  t.cw_mm = r.numbers("cw_mm", kValue, kLeast, kTracePoints);
  const std::size_t n = t.ccw_mm.size();
  if (n > 0 && !t.cw_mm.empty() && t.cw_mm.size() != n)
    r.problem_at("cw_mm", tr("as many values as ccw_mm has"), "count");
  if (r.has("theta_rad")) {
    t.theta_rad = r.numbers("theta_rad", kAngle, kLeast, kTracePoints);
    if (n > 0 && !t.theta_rad.empty() && t.theta_rad.size() != n)
      r.problem_at("theta_rad", tr("as many angles as ccw_mm has values"), "count");
    if (r.has("theta0_rad"))
      r.problem_at("theta0_rad", tr("either theta_rad or theta0_rad"), "conflict");
    return;
  }
  if (n == 0) return;
  const double turn = 2 * units::kPi / static_cast<double>(n);
  const double first = r.number_or("theta0_rad", kAngle, turn / 2);
  for (std::size_t k = 0; k < n; ++k)
    t.theta_rad.push_back(first + turn * static_cast<double>(k));
}

Trace read_trace(Reader r, Vec3& centre_mm) {
  Trace t;
  t.plane = read_plane(r);
  if (r.has("centre_mm")) centre_mm = read_vec3(r, "centre_mm", kCentre);
  t.R_mm = r.number("R_mm", kRadius);
  if (r.has("csv"))
    read_table(r, t);
  else
    read_lists(r, t);
  r.finish();
  return t;
}

json iso_json(const Iso230_4& v) {
  return {{"G_ccw_mm", v.G_ccw_mm},
          {"G_cw_mm", v.G_cw_mm},
          {"G_ccw_mz_mm", v.G_ccw_mz_mm},
          {"G_cw_mz_mm", v.G_cw_mz_mm},
          {"G_bi_mm", v.G_bi_mm},
          {"H_mm", v.H_mm},
          {"F_max_mm", v.F_max_mm},
          {"F_min_mm", v.F_min_mm},
          {"D_mm", v.D_mm}};
}

std::string fit_key(std::string_view term) {
  if (term.starts_with("scale")) return std::string(term);
  return std::string(term) + (term == "square" ? "_rad" : "_mm");
}

json fit_json(const BallBarFit& fit) {
  json out{{"rms_mm", fit.rms_mm}};
  for (std::size_t k = 0; k < kBallBarTerms.size(); ++k) {
    const std::string key = fit_key(kBallBarTerms[k]);
    out[key] = fit.value[k];
    out["u_" + key] = fit.u[k];
  }
  return out;
}

/// Values as instruments show them: whole lost motions, and bows over the circle's
/// radius.
json derived_json(const Trace& t, const json& fit) {
  const auto of = [&fit](const char* key) { return fit[key].get<double>(); };
  const double bow = t.R_mm / 100 * (t.R_mm / 100);
  return {{"backlash_u_mm", -2 * of("EUUb_mm")},
          {"backlash_v_mm", -2 * of("EVVb_mm")},
          {"lateral_v_of_u_mm", 2 * of("EVUb_mm")},
          {"lateral_u_of_v_mm", 2 * of("EUVb_mm")},
          {"scale_mean_ppm", 1e6 * (of("scale_u") + of("scale_v")) / 2},
          {"scale_mismatch_ppm", 1e6 * (of("scale_u") - of("scale_v"))},
          {"straightness_v_of_u_mm", of("EVU2_mm") * bow},
          {"straightness_u_of_v_mm", of("EUV2_mm") * bow}};
}

json analysis_json(const Trace& t, const BallBarFit& fit) {
  const json terms = fit_json(fit);
  json ranking = json::array();
  for (const Contribution& c : fit.ranking)
    ranking.push_back({{"name", c.name}, {"range_mm", c.range_mm}});
  return {{"iso230_4", iso_json(iso230_4(t))},
          {"fit", terms},
          {"derived", derived_json(t, terms)},
          {"ranking", ranking},
          {"confounded", confounded(t.plane)}};
}

/// The physical errors of the machine by a trace: relative values change their sign on
/// the workpiece's side.  The squareness is assigned to the plane's first axis.
std::vector<Calibrated> calibrated(Plane plane, const BallBarFit& fit,
                                   const Machine& machine) {
  const auto [U, V] = axes_of(plane);
  const auto E = [](char direction, char axis, char number) {
    return std::string{'E', direction, axis, number};
  };
  const auto side = [&](char axis) { return sense(machine.chain, axis); };
  const char turn = plane == Plane::XY ? 'C' : plane == Plane::YZ ? 'A' : 'B';
  std::vector<Calibrated> all;
  const auto add = [&](std::string_view term, const std::string& name, double factor) {
    const auto k = static_cast<std::size_t>(
        std::find(kBallBarTerms.begin(), kBallBarTerms.end(), term) -
        kBallBarTerms.begin());
    all.push_back({name, factor * fit.value[k], std::abs(factor) * fit.u[k]});
  };
  const double Q = default_Q(U);
  add("scale_u", E(U, U, '1'), side(U) * Q);
  add("scale_v", E(V, V, '1'), side(V) * Q);
  add("square", {'E', turn, '0', U}, 1);
  add("EUUb", E(U, U, 'b'), side(U));
  add("EVVb", E(V, V, 'b'), side(V));
  add("EVUb", E(V, U, 'b'), side(U));
  add("EUVb", E(U, V, 'b'), side(V));
  add("EVU2", E(V, U, '2'), side(U));
  add("EUV2", E(U, V, '2'), side(V));
  return all;
}

/// The machine whose circle is the trace.  Its other errors explain their part of the
/// trace, and the errors found explain the rest.  Each round reduces the residual of the
/// last one, which is due to products of errors and, away from the origin, to the slopes
/// of bows.
json with_trace(MachineDocument m, const Trace& t, const Vec3& centre_mm) {
  constexpr int kRounds = 4;
  const Plane plane = t.plane;
  BallBarFit sum{};
  std::vector<Calibrated> found = calibrated(plane, sum, m.errors.chain);
  for (int round = 0; round < kRounds; ++round) {
    for (const Calibrated& one : found) put(one, m.errors);
    Trace left = t;
    const Trace own = simulate(m.errors.chain, {.plane = plane,
                                                .R_mm = t.R_mm,
                                                .theta_rad = t.theta_rad,
                                                .centre_mm = centre_mm});
    for (std::size_t k = 0; k < left.theta_rad.size(); ++k) {
      left.ccw_mm[k] -= own.ccw_mm[k];
      left.cw_mm[k] -= own.cw_mm[k];
    }
    const BallBarFit rest = decompose(left);
    for (std::size_t k = 0; k < sum.value.size(); ++k) sum.value[k] += rest.value[k];
    sum.u = rest.u;
    found = calibrated(plane, sum, m.errors.chain);
  }
  const auto [U, V] = axes_of(plane);
  return with_errors(std::move(m), found,
                     say("ball bar in {}{}, R {} mm", U, V, number_text(t.R_mm)));
}

struct TraceRequest {
  Trace trace;
  bool analysed = false;
  Vec3 centre_mm{};
  std::optional<MachineDocument> machine;  ///< to be calibrated by the trace
};

TraceRequest read_trace_request(const json& request) {
  Problems problems{.document = "ballbar"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-ballbar/1");
  const bool simulated = r.has("simulate"), analysed = r.has("analyse");
  std::optional<Simulation> simulation;
  TraceRequest q{.trace = {}, .analysed = analysed, .centre_mm = {}, .machine = {}};
  if (simulated) simulation = read_simulation(r.object("simulate"));
  if (analysed) {
    q.trace = read_trace(r.object("analyse"), q.centre_mm);
    const auto axes = axes_of(q.trace.plane);
    q.machine = read_machine_document(r, "wCfZXt", {axes.begin(), axes.end()});
  }
  r.finish();
  if (r.is_object() && simulated == analysed)
    r.problem(simulated ? tr("both") : tr("neither"), tr("either simulate or analyse"),
              "conflict");
  problems.throw_if_any();
  if (simulation) q.trace = simulate(simulation->machine, simulation->test);
  return q;
}

}  // namespace

Trace ball_bar_trace(const json& request) { return read_trace_request(request).trace; }

json ball_bar(const json& request) {
  auto [t, analysed, centre_mm, machine] = read_trace_request(request);
  if (!analysed)
    return {{"theta_rad", t.theta_rad}, {"ccw_mm", t.ccw_mm}, {"cw_mm", t.cw_mm}};
  json out = analysis_json(t, decompose(t));
  if (machine) out["machine"] = with_trace(std::move(*machine), t, centre_mm);
  return out;
}

}  // namespace turnwright::document
