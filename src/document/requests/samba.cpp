#include "turnwright/document/samba.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "document/catalogue/calibrated_machine.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/volumetric/samba.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kIndexations = 500, kBalls = 100, kPerIndexation = 100;
const Bounds kBallPlace = within(-1e5, 1e5, "mm"), kReading = within(-100, 100, "mm"),
             kPoseAngle = within(-3600, 3600, "deg");

struct CalibrationRequest {
  SambaStrategy strategy;
  std::vector<std::string> parameters;
  bool given = false;  // readings
  std::vector<double> readings_mm;
  std::optional<double> noise_mm;
  std::optional<MachineDocument> machine;
};

Vec3 vec3(const Reader& r, const Bounds& bounds) {
  Vec3 out{};
  std::ranges::copy(r.as_numbers(bounds, 3, 3), out.begin());
  return out;
}

void read_pre_moves(Reader r, SambaStrategy& s) {
  for (std::size_t i = 0; i < s.indexations.size(); ++i) {
    const std::string key = std::to_string(i + 1);
    for (const Reader& move : r.optional_items(key, 0, kPerIndexation)) {
      std::array<double, 2> signs{};
      const auto read = move.as_numbers(within(-1, 1), 2, 2);
      std::ranges::copy(read, signs.begin());
      for (const double sign : read)
        if (sign > -1 && sign < 1) move.problem(tr("two signs, -1 or 1"), "range");
      s.indexations[i].pre_moves.push_back(signs);
    }
  }
  r.finish();
}

/// Largest difference between a bar's length and the distance of its balls as given.
constexpr double kBarOff = 0.02;

void check_scale_bar(Reader& r, const SambaStrategy& s) {
  const Vec3 &a = s.balls_mm[0], &b = s.balls_mm[1];
  const double apart = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  if (!(apart > 0))
    r.problem_at("balls_mm", tr("the first two, the bar's, apart from each other"),
                 "conflict");
  else if (s.scale_bar_mm > 0 && !(std::abs(s.scale_bar_mm - apart) <= kBarOff * apart))
    r.problem_at(
        "scale_bar_mm",
        say("the distance of its balls, the first two of balls_mm, {} mm, within 2 %",
            number_text(apart)),
        "conflict");
}

SambaStrategy read_strategy(Reader r) {
  SambaStrategy s;
  for (const Reader& pose : r.items("indexations_deg", 1, kIndexations)) {
    const auto bc = pose.as_numbers(kPoseAngle, 2, 2);
    if (bc.size() == 2)
      s.indexations.push_back(
          {units::rad_from_deg(bc[0]), units::rad_from_deg(bc[1]), {}, {}});
    else
      s.indexations.push_back({});
  }
  for (const Reader& ball : r.items("balls_mm", 2, kBalls))
    s.balls_mm.push_back(vec3(ball, kBallPlace));
  const auto seen = r.items("balls_seen", 1, kIndexations);
  if (!seen.empty() && !s.indexations.empty() && seen.size() != s.indexations.size())
    r.problem_at("balls_seen", tr("one list for each of indexations_deg"), "count");
  const auto balls = static_cast<long>(s.balls_mm.size());
  for (std::size_t i = 0; balls > 0 && i < std::min(seen.size(), s.indexations.size());
       ++i)
    for (const Reader& ball : seen[i].as_items(0, kPerIndexation))
      s.indexations[i].balls.push_back(
          static_cast<std::size_t>(ball.as_integer(1, balls)) - 1);
  if (auto moves = r.optional_object("pre_moves")) read_pre_moves(*moves, s);
  const bool touched = std::ranges::any_of(
      s.indexations, [](const Indexation& at) { return !at.pre_moves.empty(); });
  if (touched || r.has("facet_mm")) s.facet_mm = read_vec3(r, "facet_mm", kBallPlace);
  if (touched || r.has("facet_normal")) {
    s.facet_normal = read_vec3(r, "facet_normal", within(-1, 1));
    if (r.has("facet_normal") && r.json()["facet_normal"] == json{0, 0, 0})
      r.problem_at("facet_normal", tr("a direction that is not zero"), "range");
  }
  s.scale_bar_mm = r.number("scale_bar_mm", above_up_to(0, 1e5, "mm"));
  if (s.balls_mm.size() > 1) check_scale_bar(r, s);
  if (r.has("styli_mm")) {
    s.styli_mm.clear();
    for (const Reader& tip : r.items("styli_mm", 1, 10))
      s.styli_mm.push_back(vec3(tip, kBallPlace));
  }
  r.finish();
  return s;
}

std::vector<std::string> read_parameters(Reader& r) {
  const Reader value = r.at("parameters", tr("\"all\" or a list of names"));
  if (value.broken()) return {};
  if (value.is_text()) {
    if (value.json() == "all") return samba_parameters();
    value.problem(tr("\"all\" or a list of names"), "choice");
    return {};
  }
  std::vector<std::string> out;
  for (const Reader& item : value.as_items(1, 300)) {
    const std::string name = item.as_text(8);
    if (name.empty()) continue;
    if (!is_samba_parameter(name)) {
      const std::string near = nearest(name, samba_parameters());
      const auto expected =
          tr("an error parameter of the machine such as EC0Y, EX0C, EXX1, EYX2, EXYb, or "
             "facet");
      item.problem(near.empty() ? expected : did_you_mean(expected, near), "reference");
    } else if (std::ranges::find(out, name) != out.end()) {
      item.problem(tr("each parameter once"), "duplicate");
    }
    out.push_back(name);
  }
  return out;
}

/// Readings in the workpiece frame, tool minus workpiece, end to end.
void read_readings(Reader& r, CalibrationRequest& q) {
  const double sign = r.choice_or<double>(
      "sign", {{"tool-minus-workpiece", 1}, {"workpiece-minus-tool", -1}}, 1);
  const bool machine =
      r.choice_or<bool>("frame", {{"workpiece", false}, {"machine", true}}, false);
  q.given = r.has("readings_mm");
  if (!q.given) return;
  const Reader list = r.at("readings_mm");
  std::size_t probings = 0;
  for (const Indexation& at : q.strategy.indexations)
    probings += q.strategy.styli_mm.size() * (at.balls.size() + at.pre_moves.size());
  const auto items = list.as_items(0, 1000000);
  if (list.is_array() && items.size() != probings) {
    list.problem(say("{} readings, one for each probing", probings), "count");
    return;
  }
  auto item = items.begin();
  for (const Indexation& at : q.strategy.indexations)
    for (std::size_t stylus = 0; stylus < q.strategy.styli_mm.size(); ++stylus) {
      const auto R = table_rotation(at);
      for (std::size_t ball = 0; ball < at.balls.size() && item != items.end(); ++ball) {
        const Vec3 e = vec3(*item++, kReading);
        for (std::size_t k = 0; k < 3; ++k)
          q.readings_mm.push_back(
              sign * (machine
                          ? R[3 * k] * e[0] + R[3 * k + 1] * e[1] + R[3 * k + 2] * e[2]
                          : e[k]));
      }
      for (std::size_t touch = 0; touch < at.pre_moves.size() && item != items.end();
           ++touch)
        q.readings_mm.push_back(sign * (item++)->as_number(kReading));
    }
}

void check_size(Reader& r, const CalibrationRequest& q) {
  const SambaSize size = samba_size(q.strategy, q.parameters);
  if (!size.solvable())
    r.at("strategy")
        .problem(say("{} equations of {} unknowns", size.equations, size.unknowns),
                 say("at most {:.0e} equations times the square of the unknowns",
                     kMostSambaWork),
                 "range");
}

CalibrationRequest read_calibration_request(const json& document) {
  Problems problems{.document = "samba"};
  Reader r = Reader(document, problems).as_object();
  CalibrationRequest q;
  read_format(r, "turnwright-samba/1");
  q.strategy = read_strategy(r.object("strategy"));
  q.parameters = read_parameters(r);
  q.noise_mm = r.optional_number("noise_mm", above_up_to(0, 10, "mm"));
  if (problems.list.empty()) {
    check_size(r, q);
    read_readings(r, q);
  } else {
    for (const char* key : {"sign", "frame", "readings_mm"}) r.has(key);
  }
  const std::string chain(kSambaChain);
  q.machine = read_machine_document(r, chain, "XYZBC");
  if (q.machine && q.machine->errors.chain.chain != chain)
    r.problem_at(
        "machine",
        say("a machine of the chain {}, not {}", chain, q.machine->errors.chain.chain),
        "conflict");
  if (q.machine && !q.given)
    r.problem_at("machine", tr("readings_mm as well: without them nothing is found"),
                 "conflict");
  r.finish();
  problems.throw_if_any();
  return q;
}

/// Uncertainties are null if they are unknown: no noise is given and there are no
/// residuals.
json values_json(const Identifiability& of, std::size_t from, std::size_t to,
                 const SambaFit* fit, bool uncertain) {
  json out = json::object();
  for (std::size_t j = from; j < to; ++j) {
    json one{{"identifiable", static_cast<bool>(of.identifiable[j])}};
    if (fit && of.identifiable[j]) {
      one["value"] = fit->value[j];
      one["u"] = uncertain ? json(fit->u[j]) : json(nullptr);
    }
    out[of.unknowns[j]] = std::move(one);
  }
  return out;
}

/// The machine's other errors explain their part of the readings, and the errors found
/// explain the rest.
json with_readings(const CalibrationRequest& q) {
  MachineDocument m = *q.machine;
  const auto calibrated = [&](const SambaFit& fit) {
    std::vector<Calibrated> all;
    for (std::size_t j = 0; j < fit.of.parameters; ++j)
      if (fit.of.identifiable[j] && fit.of.unknowns[j] != "facet")
        all.push_back({fit.of.unknowns[j], fit.value[j], fit.u[j]});
    return all;
  };
  const auto fitted = [&](const std::vector<double>& readings_mm) {
    return samba_fit(q.strategy, q.parameters, readings_mm, q.noise_mm);
  };
  for (Calibrated one : calibrated(fitted(q.readings_mm))) {
    one.value = 0;
    put(one, m.errors);
  }
  std::vector<double> left = q.readings_mm;
  const auto own = samba_readings(q.strategy, m.errors.chain);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= own[i];
  return with_errors(std::move(m), calibrated(fitted(left)), tr("probed balls (SAMBA)"));
}

}  // namespace

json samba(const json& request) {
  const CalibrationRequest q = read_calibration_request(request);
  std::optional<SambaFit> fit;
  Identifiability of;
  if (q.given) {
    fit = samba_fit(q.strategy, q.parameters, q.readings_mm, q.noise_mm);
    of = fit->of;
  } else {
    of = identifiability(q.strategy, q.parameters);
  }
  const bool uncertain = q.noise_mm || (fit && fit->dof > 0);
  if (q.machine && !uncertain)
    throw InputError("samba", {{"/noise_mm", "nothing",
                                tr("the standard deviation of a reading: these leave no "
                                   "degree of freedom that would tell it"),
                                "missing"}});
  json suggested = json::array();
  for (const Remedy& remedy : remedies(q.strategy, of))
    suggested.push_back(
        {{"remedy", remedy.what}, {"rank", remedy.rank}, {"gains", remedy.gains}});
  const SambaFit* found = fit ? &*fit : nullptr;
  json out{
      {"unknowns", of.unknowns.size()},
      {"equations", of.equations},
      {"rank", of.rank},
      {"condition", of.condition},
      {"null_vectors", of.null_vectors},
      {"parameters", values_json(of, 0, of.parameters, found, uncertain)},
      {"setup", values_json(of, of.parameters, of.unknowns.size(), found, uncertain)},
      {"dof", of.equations - of.rank},
      {"remedies", suggested}};
  if (fit) out["s0"] = fit->dof > 0 ? json(fit->s0_mm) : json(nullptr);
  if (q.machine) out["machine"] = with_readings(q);
  return out;
}

}  // namespace turnwright::document
