#include "frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "document/json/csv.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

using chatter::FrequencyResponse;
using chatter::ModalFit;
using chatter::NoFit;
using nlohmann::ordered_json;

constexpr std::size_t kRows = 20000, kFrequencyLines = 5000;
const Bounds kFrequency = within(0, 1e6, "Hz"), kPart = within(-1e12, 1e12);

/// Unit of a response: its order of derivative by time, and its length in mm.
struct Unit {
  int derivative = 0;
  double mm = 1;
  friend bool operator==(const Unit&, const Unit&) = default;
};

Unit read_unit(Reader& r) {
  constexpr double kGravity_mm_s2 = 9806.65;
  return r.choice<Unit>("unit", {{"mm/N", {0, 1}},
                                 {"um/N", {0, 1e-3}},
                                 {"m/N", {0, 1e3}},
                                 {"mm/s/N", {1, 1}},
                                 {"m/s/N", {1, 1e3}},
                                 {"mm/s2/N", {2, 1}},
                                 {"m/s2/N", {2, 1e3}},
                                 {"g/N", {2, kGravity_mm_s2}}});
}

/// A line of the table, with its place there.
struct Line {
  double frequency_Hz = 0;
  std::complex<double> value;
  std::string pointer;
};

std::vector<Line> read_lines(Reader& r) {
  std::map<std::string, std::string> names;  // of the columns
  for (const char* key : {"frequency_Hz", "real", "imaginary"}) names[key] = key;
  if (auto given = r.optional_object("columns")) {
    for (auto& [key, name] : names)
      if (const auto other = given->optional_text(key)) name = *other;
    given->finish();
  }
  std::vector<CsvColumn> columns;
  for (const auto& [key, name] : names) columns.push_back({.name = name});
  std::vector<Line> out;
  const Reader table = r.at("csv", "the text of a table, or the list of its lines");
  for (const CsvRow& row : csv_rows(table, columns, OtherColumns::ignored, kRows)) {
    Reader cells(row.value, r.problems(), row.pointer);
    Line line{.frequency_Hz = 0, .value = 0, .pointer = row.pointer};
    line.frequency_Hz = cells.number(names["frequency_Hz"], kFrequency);
    const double real = cells.number(names["real"], kPart),
                 imaginary = cells.number(names["imaginary"], kPart);
    line.value = {real, imaginary};
    if (!out.empty() && line.frequency_Hz <= out.back().frequency_Hz)
      cells.at(names["frequency_Hz"])
          .problem(number_text(line.frequency_Hz),
                   "more than " + number_text(out.back().frequency_Hz) +
                       " Hz of the line before",
                   "order");
    out.push_back(std::move(line));
  }
  return out;
}

/// Those of the band; at 0 Hz nothing vibrates.
std::vector<Line> in_band(Reader& r, std::vector<Line> lines) {
  const double from = r.number_or("from_Hz", kFrequency, 0),
               to = r.number_or("to_Hz", kFrequency, 1e6);
  if (from >= to) r.problem_at("to_Hz", "more than from_Hz", "order");
  std::erase_if(lines, [&](const Line& line) {
    return !(line.frequency_Hz > 0 && line.frequency_Hz >= from &&
             line.frequency_Hz <= to);
  });
  return lines;
}

FrequencyResponse response(const std::vector<Line>& lines, const Unit& unit) {
  FrequencyResponse out{.derivative = unit.derivative, .w_rad_s = {}, .value = {}};
  for (const Line& line : lines) {
    out.w_rad_s.push_back(2 * units::kPi * line.frequency_Hz);
    out.value.push_back(unit.mm * line.value);
  }
  return out;
}

double hertz(double w_rad_s) { return w_rad_s / (2 * units::kPi); }

std::string short_Hz(double w_rad_s) {
  return number_text(std::round(hertz(w_rad_s) * 100) / 100) + " Hz";
}

std::string counted(std::size_t lines) {
  return lines == 1 ? "1 line" : std::to_string(lines) + " lines";
}

const char* quantity(int derivative) {
  return derivative == 0   ? "a receptance"
         : derivative == 1 ? "a mobility"
                           : "an accelerance";
}

/// Reports why there are no modes, at the line nearest to the frequency that shows it.
void report(Reader& r, const std::vector<Line>& lines, const NoFit& no,
            std::optional<long> modes, int derivative) {
  const std::string f = short_Hz(no.w_rad_s);
  Problem problem{r.pointer_of("csv"), "", "", "fit"};
  if (no.w_rad_s > 0) {
    const auto apart = [&](const Line& line) {
      return std::abs(line.frequency_Hz - hertz(no.w_rad_s));
    };
    problem.pointer = std::ranges::min_element(lines, {}, apart)->pointer;
  }
  switch (no.why) {
    case NoFit::Why::too_few_lines:
      problem.got = counted(lines.size());
      problem.expected = "at least " + std::to_string(3 * modes.value_or(1) + 2) +
                         " of the band, 3 for each mode and 2";
      problem.code = "count";
      break;
    case NoFit::Why::no_peak:
      problem.got = no.w_rad_s > 0 ? "no peak, the nearest to one at " + f : "no peak";
      problem.expected = "a mode among the lines, damped by less than 0.5";
      break;
    case NoFit::Why::negative:
      problem.got = "a mode of negative mass at " + f;
      problem.expected =
          "the receptance of a drive point under e^(+i w t): imaginary part < 0 at a "
          "peak; is the unit that of the quantity measured?";
      break;
    case NoFit::Why::not_told:
      problem.got = no.w_rad_s > 0 ? "a mode at " + f + " that the lines do not tell"
                                   : "fewer modes";
      problem.expected = "fewer modes asked, more lines or less noise";
      break;
    case NoFit::Why::other_quantity:
      problem.pointer = r.pointer_of("unit");
      problem.got = std::string("the unit of ") + quantity(derivative);
      problem.expected = std::string("that of ") + quantity(no.derivative) +
                         ", whose modes explain these lines far better";
      problem.code = "unit";
      break;
  }
  r.problems().add(std::move(problem));
}

std::string three_digits(double x) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(3) << x;
  return out.str();
}

void add(ordered_json& out, const std::string& key, double value, double u) {
  out[key] = value;
  out["u_" + key] = u;
}

}  // namespace

std::optional<MeasuredAxis> read_frequency_response(Reader r, AxisKey axis) {
  r = r.as_object();
  const auto before = r.problems().list.size();
  MeasuredAxis out;
  if (axis == AxisKey::asked)
    out.axis = r.choice<chatter::Axis>(
        "axis", {{"x", chatter::Axis::x}, {"y", chatter::Axis::y}});
  const Unit unit = read_unit(r);
  std::vector<Line> all = read_lines(r);
  const std::size_t given = all.size();
  const std::vector<Line> lines = in_band(r, std::move(all));
  const auto modes = r.optional_integer("modes", 1, chatter::kMostModes);
  r.finish();
  if (lines.size() > kFrequencyLines)
    r.problem_at("csv",
                 "at most " + std::to_string(kFrequencyLines) + " lines in the band",
                 "count");
  if (r.broken() || r.problems().list.size() > before) return std::nullopt;
  const auto found =
      chatter::modal_fit(response(lines, unit),
                         modes ? std::optional(static_cast<int>(*modes)) : std::nullopt);
  if (const auto* no = std::get_if<NoFit>(&found)) {
    report(r, lines, *no, modes, unit.derivative);
    return std::nullopt;
  }
  out.pointer = r.pointer();
  out.lines = lines.size();
  out.left_out = given - lines.size();
  out.from_Hz = lines.front().frequency_Hz;
  out.to_Hz = lines.back().frequency_Hz;
  out.fit = std::get<ModalFit>(found);
  return out;
}

ordered_json described(const MeasuredAxis& measured) {
  const ModalFit& fit = measured.fit;
  ordered_json modes = ordered_json::array();
  for (const chatter::FittedMode& m : fit.modes) {
    ordered_json told;
    add(told, "frequency_Hz", hertz(m.wn_rad_s.value), hertz(m.wn_rad_s.u));
    add(told, "damping_ratio", m.zeta.value, m.zeta.u);
    add(told, "stiffness_N_mm", m.k_N_mm.value, m.k_N_mm.u);
    told["mass_kg"] = 1000 * m.k_N_mm.value / (m.wn_rad_s.value * m.wn_rad_s.value);
    modes.push_back(std::move(told));
  }
  ordered_json out{{"axis", measured.axis == chatter::Axis::x ? "x" : "y"},
                   {"lines", measured.lines},
                   {"left_out", measured.left_out},
                   {"from_Hz", measured.from_Hz},
                   {"to_Hz", measured.to_Hz},
                   {"modes", std::move(modes)}};
  add(out, "above_mm_N", fit.above_mm_N.value, fit.above_mm_N.u);
  add(out, "below_1_kg", fit.below_mm_N_s2.value / 1000, fit.below_mm_N_s2.u / 1000);
  out["hidden"] = ordered_json::array();
  for (const chatter::HiddenMode& m : fit.hidden)
    out["hidden"].push_back({{"frequency_Hz", hertz(m.wn_rad_s)},
                             {"stiffness_N_mm", m.k_N_mm},
                             {"share", m.share}});
  out["explained"] = fit.explained;
  out["relative_rest"] = fit.rms_left / fit.rms_measured;
  out["correlation"] = fit.correlation;
  out["error_floor"] = fit.error_floor ? ordered_json(*fit.error_floor) : ordered_json();
  return out;
}

/// What a mode below the noise could do, if that matters.
std::optional<std::string> doubt_of_hidden(const MeasuredAxis& measured) {
  constexpr double kMatters = 0.1;  // of the highest peak
  const auto matters = [](const chatter::HiddenMode& m) { return m.share > kMatters; };
  const auto& hidden = measured.fit.hidden;
  const auto worst = std::ranges::max_element(hidden, {}, &chatter::HiddenMode::share);
  if (worst == hidden.end() || !matters(*worst)) return std::nullopt;
  const auto last = std::ranges::find_if(hidden.rbegin(), hidden.rend(), matters);
  const std::string share = three_digits(worst->share);
  return measured.pointer + ": up to the octave of " +
         three_digits(hertz(last->wn_rad_s)) +
         " Hz noise may hide a mode; its peak may be " + share +
         " of the highest one's, and it would chatter from " +
         three_digits(1 / worst->share) +
         " of the least depth on at which that one does: more averages, or receptance "
         "or mobility in place of accelerance, show more";
}

std::vector<std::string> doubts(const MeasuredAxis& measured) {
  constexpr double kExplained = 0.9;
  const Bounds usual = within(100, 1e6, "N/mm");  // of tools, spindles and slender work
  std::vector<std::string> out;
  const ModalFit& fit = measured.fit;
  if (!(fit.explained >= kExplained))
    out.push_back(
        measured.pointer + ": the modes explain " +
        number_text(std::round(1000 * fit.explained) / 10) +
        " % of the response's squares, less than 90 %: its limits are not to be "
        "trusted; is the unit right, the band wide enough, the noise low?");
  if (auto doubt = doubt_of_hidden(measured)) out.push_back(std::move(*doubt));
  const auto weakest = std::ranges::min_element(
      fit.modes, {}, [](const chatter::FittedMode& m) { return m.k_N_mm.value; });
  const double k = weakest->k_N_mm.value;
  if (!contains(usual, k))
    out.push_back(measured.pointer +
                  "/unit: the most compliant mode has a stiffness of " + three_digits(k) +
                  ", where " + expected_number(usual) + " is usual; is the unit right?");
  return out;
}

}  // namespace turnwright::document
