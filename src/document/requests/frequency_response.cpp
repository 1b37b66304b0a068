#include "frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <locale>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/say.hpp"
#include "document/response/response_file.hpp"
#include "document/response/response_table.hpp"
#include "document/response/response_taps.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/chatter/coherence.hpp"

namespace turnwright::document {
namespace {

using chatter::FrequencyResponse;
using chatter::ModalFit;
using chatter::NoFit;
using nlohmann::ordered_json;

constexpr std::size_t kFrequencyLines = 5000;
const Bounds kFrequency = within(0, 1e6, "Hz");
constexpr double kLeastCoherence = 0.1;

using Lines = std::vector<MeasuredLine>;

/// Those of the band that say something; at 0 Hz nothing vibrates.
Lines in_band(Reader& r, Lines lines) {
  const double from = r.number_or("from_Hz", kFrequency, 0),
               to = r.number_or("to_Hz", kFrequency, 1e6);
  if (from >= to) r.problem_at("to_Hz", tr("more than from_Hz"), "order");
  std::erase_if(lines, [&](const MeasuredLine& line) {
    return !(line.frequency_Hz > 0 && line.frequency_Hz >= from &&
             line.frequency_Hz <= to && line.coherence.value_or(1) >= kLeastCoherence);
  });
  return lines;
}

bool has_coherence(const Lines& lines) {
  return !lines.empty() && lines.front().coherence.has_value();
}

FrequencyResponse response(const MeasuredResponse& measured) {
  FrequencyResponse out{.derivative = measured.derivative,
                        .w_rad_s = {},
                        .value = {},
                        .decay_1_s = measured.decay_1_s};
  std::vector<double> coherence;
  for (const MeasuredLine& line : measured.lines) {
    out.w_rad_s.push_back(2 * units::kPi * line.frequency_Hz);
    out.value.push_back(line.value);
    coherence.push_back(line.coherence.value_or(1));
  }
  if (has_coherence(measured.lines))
    out.error = chatter::errors_by_coherence(out.value, coherence);
  return out;
}

double hertz(double w_rad_s) { return w_rad_s / (2 * units::kPi); }

std::string short_Hz(double w_rad_s) {
  return number_text(std::round(hertz(w_rad_s) * 100) / 100) + " Hz";
}

std::string counted(std::size_t lines) {
  return lines == 1 ? tr("1 line") : say("{} lines", lines);
}

std::string with_article(int derivative) {
  if (derivative == 0) return tr("a receptance");
  return derivative == 1 ? tr("a mobility") : tr("an accelerance");
}

/// Reports why there are no modes, at the line nearest to the frequency that shows it.
void report(Reader& r, const MeasuredResponse& measured, const NoFit& no,
            std::optional<long> modes) {
  const Lines& lines = measured.lines;
  const std::string f = short_Hz(no.w_rad_s);
  Problem problem{r.pointer_of(measured.key), "", "", "fit"};
  if (no.w_rad_s > 0) {
    const auto apart = [&](const MeasuredLine& line) {
      return std::abs(line.frequency_Hz - hertz(no.w_rad_s));
    };
    problem.pointer = std::ranges::min_element(lines, {}, apart)->pointer;
  }
  switch (no.why) {
    case NoFit::Why::too_few_lines:
      problem.got = counted(lines.size());
      problem.expected = say("at least {} of the band, 3 for each mode and 2",
                             3 * modes.value_or(1) + 2);
      problem.code = "count";
      break;
    case NoFit::Why::no_peak:
      problem.got =
          no.w_rad_s > 0 ? say("no peak, the nearest to one at {}", f) : tr("no peak");
      problem.expected = tr("a mode among the lines, damped by less than 0.5");
      break;
    case NoFit::Why::negative:
      problem.got = say("a mode of negative mass at {}", f);
      problem.expected =
          tr("the receptance of a drive point under e^(+i w t): imaginary part < 0 at a "
             "peak; is the unit that of the quantity measured, and is motion along the "
             "force counted as positive (else \"reversed\": true)?");
      break;
    case NoFit::Why::not_told:
      problem.got = no.w_rad_s > 0 ? say("a mode at {} that the lines do not tell", f)
                                   : tr("fewer modes");
      problem.expected = tr("fewer modes asked, more lines or less noise");
      break;
    case NoFit::Why::other_quantity:
      problem.pointer = r.pointer_of("unit");
      problem.got = say("the unit of {}", with_article(measured.derivative));
      problem.expected = say("that of {}, whose modes explain these lines far better",
                             with_article(no.derivative));
      problem.code = "unit";
      break;
  }
  r.problems().add(std::move(problem));
}

struct Fitted {
  std::variant<ModalFit, NoFit> fit;
  bool conjugate = false;
};

FrequencyResponse conjugate_of(FrequencyResponse r) {
  for (auto& y : r.value) y = std::conj(y);
  return r;
}

/// The modes of a response, or else of its conjugate, as the header says.
Fitted fitted(const FrequencyResponse& r, std::optional<int> modes) {
  constexpr double kGood = 0.02, kFarLess = 0.25;  // of the squares, left
  const auto left = [](const std::variant<ModalFit, NoFit>& found) {
    const auto* fit = std::get_if<ModalFit>(&found);
    return fit ? 1 - fit->explained : 1;
  };
  auto as_given = chatter::modal_fit(r, modes);
  const auto* no = std::get_if<NoFit>(&as_given);
  if (left(as_given) < kGood || (no && no->why == NoFit::Why::too_few_lines))
    return {std::move(as_given)};
  FrequencyResponse opposite = r;
  for (auto& y : opposite.value) y = -y;
  auto turned = chatter::modal_fit(conjugate_of(r), modes);
  if (left(turned) < kFarLess * left(as_given) &&
      left(turned) < kFarLess * left(chatter::modal_fit(opposite, modes)))
    return {std::move(turned), true};
  return {std::move(as_given)};
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

const MeasuredLine& nearest_line(const Lines& lines, double f_Hz) {
  return *std::ranges::min_element(lines, {}, [&](const MeasuredLine& line) {
    return std::abs(line.frequency_Hz - f_Hz);
  });
}

std::optional<ordered_json> described_coherence(const Lines& lines) {
  if (!has_coherence(lines)) return std::nullopt;
  const auto least = std::ranges::min_element(lines, {}, &MeasuredLine::coherence);
  double sum = 0;
  for (const MeasuredLine& line : lines) sum += *line.coherence;
  return ordered_json{{"mean", sum / static_cast<double>(lines.size())},
                      {"least", *least->coherence},
                      {"at_Hz", least->frequency_Hz}};
}

const char* name_of(chatter::DiagramPole::Stable stable) {
  switch (stable) {
    case chatter::DiagramPole::Stable::no:
      return "no";
    case chatter::DiagramPole::Stable::frequency:
      return "frequency";
    case chatter::DiagramPole::Stable::damping:
      return "damping";
    case chatter::DiagramPole::Stable::all:
      return "all";
  }
  throw std::domain_error("frf: unknown mark of a pole");
}

/// The magnitude of the response, of many lines the highest ones.
ordered_json curve_of(const Lines& lines) {
  constexpr std::size_t kMostPoints = 400;
  const std::size_t each = (lines.size() + kMostPoints - 1) / kMostPoints;
  ordered_json f = ordered_json::array(), magnitude = ordered_json::array();
  for (std::size_t i = 0; i < lines.size(); i += each) {
    const auto highest = std::ranges::max_element(
        std::span(lines).subspan(i, std::min(each, lines.size() - i)), {},
        [](const MeasuredLine& line) { return std::abs(line.value); });
    f.push_back(highest->frequency_Hz);
    magnitude.push_back(std::abs(highest->value));
  }
  return {{"frequency_Hz", std::move(f)}, {"magnitude", std::move(magnitude)}};
}

ordered_json described_diagram(const MeasuredAxis& measured) {
  const chatter::Stabilisation& diagram = measured.stabilisation;
  ordered_json out{{"orders", diagram.orders.size()}};
  out["poles"] = ordered_json::array();
  for (const chatter::DiagramOrder& o : diagram.orders)
    for (const chatter::DiagramPole& p : o.poles)
      out["poles"].push_back({{"order", o.order},
                              {"frequency_Hz", hertz(p.wn_rad_s)},
                              {"damping_ratio", p.zeta},
                              {"stable", name_of(p.stable)}});
  out["unfitted"] = ordered_json::array();
  for (const chatter::UnfittedMode& m : diagram.unfitted)
    out["unfitted"].push_back({{"frequency_Hz", hertz(m.wn_rad_s)},
                               {"damping_ratio", m.zeta},
                               {"stiffness_N_mm", m.k_N_mm},
                               {"from_order", m.from_order},
                               {"to_order", m.to_order},
                               {"least_depth_with", m.depth_with}});
  out["curve"] = curve_of(measured.response.lines);
  return out;
}

/// The response in the one form in which it is given.
std::optional<MeasuredResponse> read_measured(Reader& r) {
  const int forms = int{r.has("csv")} + int{r.has("uff")} + int{r.has("taps")};
  if (forms > 1)
    r.problem(tr("several of them"), tr("one of csv, uff and taps"), "exclusive");
  if (r.has("taps")) return read_response_taps(r);
  return r.has("uff") ? read_response_file(r) : read_response_table(r);
}

}  // namespace

std::optional<MeasuredAxis> read_frequency_response(Reader r, AxisKey axis) {
  r = r.as_object();
  const auto before = problems_of(r);
  MeasuredAxis out;
  if (axis == AxisKey::asked)
    out.axis = r.choice<chatter::Axis>(
        "axis", {{"x", chatter::Axis::x}, {"y", chatter::Axis::y}});
  auto measured = read_measured(r);
  const std::size_t given = measured ? measured->lines.size() : 0;
  Lines lines = in_band(r, measured ? std::move(measured->lines) : Lines());
  const bool reversed = r.boolean_or("reversed", false);
  const auto modes = r.optional_integer("modes", 1, chatter::kMostModes);
  r.finish();
  if (measured && lines.size() > kFrequencyLines)
    r.problem_at(measured->key, say("at most {} lines in the band", kFrequencyLines),
                 "count");
  if (!measured || r.broken() || problems_of(r) > before) return std::nullopt;
  measured->lines = std::move(lines);
  FrequencyResponse asked = response(*measured);
  if (reversed)
    for (auto& y : asked.value) y = -y;
  const auto found =
      fitted(asked, modes ? std::optional(static_cast<int>(*modes)) : std::nullopt);
  if (const auto* no = std::get_if<NoFit>(&found.fit)) {
    report(r, *measured, *no, modes);
    return std::nullopt;
  }
  out.pointer = r.pointer();
  out.lines = measured->lines.size();
  out.left_out = given - measured->lines.size();
  out.from_Hz = measured->lines.front().frequency_Hz;
  out.to_Hz = measured->lines.back().frequency_Hz;
  out.response = std::move(*measured);
  out.conjugate = found.conjugate;
  out.fit = std::get<ModalFit>(found.fit);
  out.stabilisation = chatter::stabilisation(
      found.conjugate ? conjugate_of(std::move(asked)) : asked, out.fit);
  return out;
}

ordered_json described(const MeasuredAxis& measured) {
  const ModalFit& fit = measured.fit;
  ordered_json modes = ordered_json::array();
  for (std::size_t i = 0; i < fit.modes.size(); ++i) {
    const chatter::FittedMode& m = fit.modes[i];
    const chatter::SettledMode& settled = measured.stabilisation.modes[i];
    ordered_json told;
    add(told, "frequency_Hz", hertz(m.wn_rad_s.value), hertz(m.wn_rad_s.u));
    add(told, "damping_ratio", m.zeta.value, m.zeta.u);
    add(told, "stiffness_N_mm", m.k_N_mm.value, m.k_N_mm.u);
    told["mass_kg"] = 1000 * m.k_N_mm.value / (m.wn_rad_s.value * m.wn_rad_s.value);
    told["stable_from_order"] =
        settled.from_order ? ordered_json(*settled.from_order) : ordered_json();
    told["stable_orders"] = settled.orders;
    told["least_depth_without"] =
        settled.depth_without ? ordered_json(*settled.depth_without) : ordered_json();
    modes.push_back(std::move(told));
  }
  ordered_json out{{"axis", measured.axis == chatter::Axis::x ? "x" : "y"},
                   {"quantity", quantity_of(measured.response.derivative)},
                   {"unit", measured.response.unit},
                   {"convention", measured.conjugate ? "e^(-i w t)" : "e^(+i w t)"},
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
  out["stabilisation"] = described_diagram(measured);
  if (const auto coherence = described_coherence(measured.response.lines))
    out["coherence"] = *coherence;
  out.update(measured.response.told);
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
  return say(
      "{}: up to the octave of {} Hz noise may hide a mode; its peak may be {} of the "
      "highest one's, and it would chatter from {} of the least depth on at which that "
      "one does: more averages, or receptance or mobility in place of accelerance, show "
      "more",
      measured.pointer, three_digits(hertz(last->wn_rad_s)), share,
      three_digits(1 / worst->share));
}

/// Of the modes at which noise or a second source is a part of the motion.
void add_doubts_of_coherence(const MeasuredAxis& measured,
                             std::vector<std::string>& out) {
  constexpr double kUsual = 0.8;
  if (!has_coherence(measured.response.lines)) return;
  for (const chatter::FittedMode& m : measured.fit.modes) {
    const auto& line = nearest_line(measured.response.lines, hertz(m.wn_rad_s.value));
    if (*line.coherence < kUsual)
      out.push_back(
          say("{}: a coherence of {} at the mode of {}, where more than 0.8 is usual: "
              "noise, a double hit or a loose sensor is a part of it",
              line.pointer, three_digits(*line.coherence), short_Hz(m.wn_rad_s.value)));
  }
}

/// What the least depth would be without a mode, or with one more.
std::string depth_words(const std::optional<double>& factor) {
  return factor ? say("{} times as large", three_digits(*factor)) : tr("without limit");
}

/// Of modes that never become stable, and of stable poles that are no modes.
void add_doubts_of_diagram(const MeasuredAxis& measured, std::vector<std::string>& out) {
  constexpr std::size_t kEnoughOrders = 20;
  constexpr double kMatters = 0.1, kOfDepth = 0.02;  // of the highest peak, of the depth
  const chatter::Stabilisation& diagram = measured.stabilisation;
  const auto height = [](const chatter::FittedMode& m) {
    return 1 / (2 * m.zeta.value * m.k_N_mm.value);
  };
  const auto& modes = measured.fit.modes;
  const double highest = height(*std::ranges::max_element(modes, {}, height));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const chatter::SettledMode& settled = diagram.modes[i];
    const double share = height(modes[i]) / highest;
    const bool deep =
        !settled.depth_without || std::abs(*settled.depth_without - 1) >= kOfDepth;
    if (settled.from_order || diagram.orders.size() < kEnoughOrders ||
        (share < kMatters && !deep))
      continue;
    out.push_back(say(
        "{}: the mode at {} never becomes stable in models of rising order up to {}: "
        "its peak is {} of the highest one's; if noise made it, the least depth along "
        "this axis would be {}; more averages show which",
        measured.pointer, short_Hz(modes[i].wn_rad_s.value), diagram.orders.size(),
        three_digits(share), depth_words(settled.depth_without)));
  }
  for (const chatter::UnfittedMode& m : diagram.unfitted)
    out.push_back(
        say("{}: a pole at {} is stable in models of order {} to {}, but none of the "
            "modes: with it the least depth along this axis would be {}",
            measured.pointer, short_Hz(m.wn_rad_s), m.from_order, m.to_order,
            depth_words(m.depth_with)));
}

std::vector<std::string> doubts(const MeasuredAxis& measured) {
  constexpr double kExplained = 0.9;
  const Bounds usual = within(100, 1e6, "N/mm");  // of tools, spindles and slender work
  std::vector<std::string> out;
  const ModalFit& fit = measured.fit;
  if (!(fit.explained >= kExplained))
    out.push_back(
        say("{}: the modes explain {} % of the response's squares, less than 90 %: its "
            "limits are not to be trusted; is the unit right, the band wide enough, the "
            "noise low?",
            measured.pointer, number_text(std::round(1000 * fit.explained) / 10)));
  if (measured.conjugate)
    out.push_back(
        say("{}/{}: its phase is that under a force e^(-i w t): the imaginary part of "
            "the receptance is positive at its peaks; its conjugate was fitted",
            measured.pointer, measured.response.key));
  for (const std::string& doubt : measured.response.doubts) out.push_back(doubt);
  add_doubts_of_coherence(measured, out);
  if (auto doubt = doubt_of_hidden(measured)) out.push_back(std::move(*doubt));
  add_doubts_of_diagram(measured, out);
  const auto weakest = std::ranges::min_element(
      fit.modes, {}, [](const chatter::FittedMode& m) { return m.k_N_mm.value; });
  const double k = weakest->k_N_mm.value;
  if (!contains(usual, k))
    out.push_back(
        say("{}/unit: the most compliant mode has a stiffness of {}, where {} is usual; "
            "is the unit right?",
            measured.pointer, three_digits(k), expected_number(usual)));
  return out;
}

}  // namespace turnwright::document
