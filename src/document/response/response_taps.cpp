#include "response_taps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/say.hpp"
#include "document/json/pointer.hpp"
#include "document/json/text_lines.hpp"
#include "measured_table.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/tap_test.hpp"

namespace turnwright::document {
namespace {

using chatter::Tap;
using chatter::TapRecord;
using chatter::TapTest;
using Column = MeasuredTable::Column;

constexpr std::size_t kSamples = 500'000;

bool is_time(const MeasuredUnit& u) { return u.of_dimensions(0, 1, 0); }
bool is_force(const MeasuredUnit& u) { return u.of_dimensions(0, 0, 1); }
bool is_motion(const MeasuredUnit& u) { return motion_derivative(u).has_value(); }

bool is_series_unit(std::string_view text) {
  const auto u = measured_unit(text);
  return u && (is_time(*u) || is_force(*u) || is_motion(*u));
}

/// A column of the table, what its unit must be, and units that "units" may name.
struct Series {
  const char* key;
  bool (*fits)(const MeasuredUnit&);
  const char* expected;
  std::vector<std::string> units;
};

const std::array<Series, 3>& series() {
  static const std::array<Series, 3> kAll{
      Series{"time", is_time, to_translate("a unit of time"), {"s", "ms"}},
      Series{"force", is_force, to_translate("a unit of force"), {"N", "kN", "lbf"}},
      Series{"motion",
             is_motion,
             to_translate("a unit of length, speed or acceleration"),
             {"m/s2", "g", "mm/s2", "in/s2", "m/s", "mm/s", "um", "mm"}}};
  return kAll;
}

TableForm tap_table() {
  return {
      .quantities = {{"time", {"time*", "t", "zeit"}},
                     {"force", {"force*", "hammer*", "kraft", "f"}},
                     {"motion",
                      {"acc*", "a", "vel*", "v", "disp*", "x", "motion", "response"}}},
      .is_unit = is_series_unit,
      .bounds = within(-1e12, 1e12),
      .most_rows = kSamples};
}

/// The unit of a column, by its header or by "units".
std::optional<MeasuredUnit> unit_of(const Reader& csv, const MeasuredTable& table,
                                    const Column& c, const Series& s,
                                    std::optional<Reader>& units) {
  std::optional<std::string> given;
  if (units && units->has(s.key)) {
    Choices<std::string> choices;
    for (const std::string& u : s.units) choices.emplace_back(u, u);
    given = units->choice<std::string>(s.key, choices);
  }
  const std::string text = !c.unit.empty() ? c.unit : given.value_or("");
  const auto unit = measured_unit(text);
  const std::string place = child_pointer(line_pointer(csv, table.header), c.name);
  if (!unit || !s.fits(*unit))
    csv.problems().add({place, text.empty() ? tr("no unit") : shown(text),
                        say("{}, there or under units", tr(s.expected)), "unit"});
  else if (given && measured_unit(*given) != unit)
    units->problem_at(s.key, tr("none or that of the header"), "conflict");
  return unit && s.fits(*unit) ? unit : std::nullopt;
}

/// A time as text, rounded to a part of a second.
std::string rounded(double x, double per_s = 1e6) {
  return number_text(std::round(x * per_s) / per_s);
}

/// The samples, cut into records where the time steps back.
struct Samples {
  std::vector<TapRecord> records;
  double step_s = 0;
  int derivative = 2;
};

double median(std::vector<double> x) {
  std::ranges::nth_element(x, x.begin() + std::ssize(x) / 2);
  return x[x.size() / 2];
}

/// The usual step of the time [s], which the others may miss by half of it for rounding.
double usual_step(const std::vector<double>& t_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t_s.size(); ++i)
    if (t_s[i] > t_s[i - 1]) steps.push_back(t_s[i] - t_s[i - 1]);
  return steps.empty() ? 0 : median(std::move(steps));
}

/// The mean step inside the records, for the usual one is rounded as its times are.
double mean_step(const std::vector<double>& t_s) {
  double sum = 0, count = 0;
  for (std::size_t i = 1; i < t_s.size(); ++i)
    if (t_s[i] > t_s[i - 1]) {
      sum += t_s[i] - t_s[i - 1];
      ++count;
    }
  return sum / count;
}

void check_times(const Reader& csv, const MeasuredTable& table, const Column& time,
                 const std::vector<double>& t_s, double step_s) {
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double step = t_s[i] - t_s[i - 1];
    if (step < 0 || std::abs(step - step_s) < 0.5 * step_s) continue;
    csv.problems().add(
        {child_pointer(line_pointer(csv, table.lines[i]), time.name),
         say("{} s, {} after the line before", rounded(t_s[i]), rounded(step, 1e8)),
         say("even steps of {} s, or a step back to a new record", rounded(step_s, 1e8)),
         "order"});
  }
}

std::optional<Samples> samples(const Reader& csv, const MeasuredTable& table,
                               std::optional<Reader> units) {
  constexpr std::size_t kFewest = 64;
  std::array<const Column*, 3> columns{};
  std::array<MeasuredUnit, 3> unit{};
  const auto before = problems_of(csv);
  for (std::size_t k = 0; k < 3; ++k) {
    const Series& s = series()[k];
    columns[k] = table.find(s.key);
    if (columns[k])
      unit[k] = unit_of(csv, table, *columns[k], s, units).value_or(MeasuredUnit{});
    else
      csv.problems().add({line_pointer(csv, table.header), say("no column of {}", s.key),
                          tr("columns of time, force and motion"), "missing"});
  }
  if (units) units->finish();
  if (problems_of(csv) > before) return std::nullopt;
  std::vector<double> t_s = columns[0]->values;
  for (double& t : t_s) t *= unit[0].scale;
  const double usual = usual_step(t_s);
  if (table.lines.size() < kFewest || !(usual > 0)) {
    csv.problem(say("{} samples", table.lines.size()),
                say("at least {}, in rising time", kFewest), "count");
    return std::nullopt;
  }
  check_times(csv, table, *columns[0], t_s, usual);
  Samples out;
  out.step_s = mean_step(t_s);
  out.derivative = *motion_derivative(unit[2]);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if (i == 0 || t_s[i] < t_s[i - 1])
      out.records.push_back({.from_s = t_s[i], .force_N = {}, .motion = {}});
    out.records.back().force_N.push_back(unit[1].scale * columns[1]->values[i]);
    out.records.back().motion.push_back(unit[2].scale * columns[2]->values[i]);
  }
  if (problems_of(csv) > before) return std::nullopt;
  return out;
}

/// Why a tap counts nowhere; "" if it does.
std::string fault_of(const Tap& tap) {
  const std::string at = rounded(tap.again_s, 1e4) + " s";
  switch (tap.fault) {
    case Tap::Fault::none:
      return "";
    case Tap::Fault::double_hit:
      return say("double hit, again at {}", at);
    case Tap::Fault::overload:
      return say("overload at {}", at);
    case Tap::Fault::cut_off:
      return say("cut off at {}", at);
  }
  return "";
}

std::string name_of(std::size_t i, const Tap& tap) {
  return say("tap {} at {} s", i + 1, rounded(tap.at_s, 1e4));
}

nlohmann::ordered_json described(const TapTest& test) {
  nlohmann::ordered_json taps = nlohmann::ordered_json::array();
  for (const Tap& tap : test.taps) {
    nlohmann::ordered_json told{{"at_s", tap.at_s}, {"peak_N", tap.peak_N}};
    if (tap.fault != Tap::Fault::none) told["left_out"] = fault_of(tap);
    taps.push_back(std::move(told));
  }
  return {{"taps", std::move(taps)}, {"block_s", test.block_s}, {"left", test.left}};
}

void report_faults(const Reader& csv, const TapTest& test) {
  if (test.taps.empty())
    csv.problem(tr("no tap"), tr("a force that stands out of its noise"), "missing");
  for (std::size_t i = 0; i < test.taps.size(); ++i)
    csv.problem(name_of(i, test.taps[i]) + ": " +
                    (test.taps[i].fault == Tap::Fault::none ? tr("too short a block")
                                                            : fault_of(test.taps[i])),
                tr("a tap without fault"), "fit");
}

MeasuredResponse response_of(const TapTest& test, const Reader& csv) {
  MeasuredResponse out;
  out.key = "taps";
  out.derivative = test.response.derivative;
  constexpr const char* kOfMotion[] = {"mm/N", "mm/s/N", "mm/s2/N"};
  out.unit = kOfMotion[out.derivative];
  out.decay_1_s = test.response.decay_1_s;
  for (std::size_t i = 0; i < test.response.value.size(); ++i) {
    MeasuredLine line{.frequency_Hz = test.response.w_rad_s[i] / (2 * units::kPi),
                      .value = test.response.value[i],
                      .pointer = csv.pointer()};
    if (!test.coherence.empty()) line.coherence = test.coherence[i];
    out.lines.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < test.taps.size(); ++i)
    if (test.taps[i].fault != Tap::Fault::none)
      out.doubts.push_back(say("{}: {} counts nowhere: {}", csv.pointer(),
                               name_of(i, test.taps[i]), fault_of(test.taps[i])));
  if (test.coherence.empty())
    out.doubts.push_back(
        say("{}: one tap alone has no coherence: three to five show whether they agree",
            csv.pointer()));
  out.told["tap_test"] = described(test);
  return out;
}

}  // namespace

std::optional<MeasuredResponse> read_response_taps(Reader& r) {
  const auto before = problems_of(r);
  Reader taps = r.object("taps");
  const Reader csv = taps.at("csv", tr("the text of a table, or the list of its lines"));
  const MeasuredTable table =
      read_measured_table(csv, taps.optional_object("columns"), tap_table());
  auto units = taps.optional_object("units");
  chatter::TapOptions options;
  options.block_s = taps.optional_number("block_s", above_up_to(0, 1000, "s"));
  options.left = taps.optional_number("left", within(1e-6, 1));
  taps.finish();
  if (table.lines.empty()) {  // which was reported
    if (units)
      for (const Series& s : series()) units->has(s.key);
    return std::nullopt;
  }
  const auto read = samples(csv, table, std::move(units));
  if (!read || problems_of(r) > before) return std::nullopt;
  options.derivative = read->derivative;
  options.step_s = read->step_s;
  const TapTest test = chatter::tap_test(read->records, options);
  if (test.response.value.empty()) {
    report_faults(csv, test);
    return std::nullopt;
  }
  return response_of(test, csv);
}

}  // namespace turnwright::document
