#include "response_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/pointer.hpp"
#include "document/json/text_lines.hpp"
#include "measured_table.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::document {
namespace {

using Column = MeasuredTable::Column;

constexpr std::size_t kRows = 20000;

/// rad of one unit of a phase.
std::optional<double> radian_of_unit(std::string_view text) {
  if (text == "\u00b0") return units::rad_from_deg(1);
  const auto words = words_of(text);
  if (words.size() != 1) return std::nullopt;
  for (const std::string_view degree : {"deg", "degree", "degrees"})
    if (words[0] == degree) return units::rad_from_deg(1);
  for (const std::string_view radian : {"rad", "radian", "radians"})
    if (words[0] == radian) return 1;
  return std::nullopt;
}

/// Of a magnitude: linear, or 20 log10 of it over `reference` units.
struct MagnitudeUnit {
  bool decibel = false;
  double reference = 1;
  std::string text;  ///< of its response unit; "": none stated
};

/// "dB", "dB re 1 m/N", "dB re 1e-6 m/N", "dB (mm/N)", or a unit alone.
std::optional<MagnitudeUnit> magnitude_unit(std::string_view text) {
  const auto skip = [&](std::string_view what) {
    const bool there = text.starts_with(what);
    if (there) text.remove_prefix(what.size());
    while (there && text.starts_with(' ')) text.remove_prefix(1);
    return there;
  };
  MagnitudeUnit out;
  out.decibel = skip("dB") || skip("db");
  if (out.decibel && (skip("ref ") || skip("rel ") || skip("re "))) {
    const auto blank = text.find(' ');
    if (const auto x = csv_number(text.substr(0, blank)); x && *x > 0) {
      out.reference = *x;
      text.remove_prefix(blank == text.npos ? text.size() : blank + 1);
    }
  }
  if (!text.empty() && !response_unit(text)) return std::nullopt;
  if (text.empty() && !out.decibel) return std::nullopt;
  out.text = text;
  return out;
}

bool is_unit(std::string_view text) {
  return hertz_of_unit(text) || radian_of_unit(text) || text == "%" ||
         magnitude_unit(text);
}

TableForm form() {
  return {.quantities = {{"coherence", {"coh*", "koh*", "gamma2", "\u03b3\u00b2"}},
                         {"phase", {"phas*", "phi", "arg", "angle"}},
                         {"imaginary", {"imag*", "im"}},
                         {"real", {"real*", "re"}},
                         {"magnitude", {"mag*", "amp*", "abs", "modulus", "betrag"}},
                         {"frequency_Hz", {"freq*", "f", "hz"}}},
          .is_unit = is_unit,
          .bounds = within(-1e12, 1e12),
          .most_rows = kRows};
}

/// Values of a table that became a response, and what is wrong with them.
class ResponseTable {
 public:
  ResponseTable(Reader& r, const Reader& csv, const MeasuredTable& table)
      : r_(r), csv_(csv), table_(table) {}

  std::optional<MeasuredResponse> response(const std::optional<WrittenUnit>& given) {
    const Column *const f = find("frequency_Hz"), *const coherence = find("coherence");
    const bool parts = find("real") && find("imaginary");
    const Column *const a = find(parts ? "real" : "magnitude"), *const b = find(
                                                                    parts ? "imaginary"
                                                                          : "phase");
    if (!f || !a || !b) {
      report(line_pointer(csv_, table_.header), say("columns of {}", found()),
             tr("a frequency, and real and imaginary part, or magnitude and phase"),
             "missing");
      return std::nullopt;
    }
    const auto size = magnitude_unit(a->unit);
    if (!parts) check_unit(a, size || a->unit.empty(), tr("motion per force, or dB"));
    const auto unit = agreed_unit(r_, given, parts ? of_parts(*a, *b) : of(size),
                                  tr("in the header of the column"));
    const double hertz = hertz_of(*f), radian = parts ? 1 : radian_of(*b);
    check_unit(coherence, coherence && (coherence->unit.empty() || percent(*coherence)),
               tr("none or %"));
    MeasuredResponse out;
    out.key = "csv";
    for (std::size_t i = 0; i < table_.lines.size(); ++i) {
      MeasuredLine line{.frequency_Hz = hertz * f->values[i], .value = {}, .pointer = {}};
      line.pointer = line_pointer(csv_, table_.lines[i]);
      check(*f, i, line.frequency_Hz, within(0, 1e6, "Hz"));
      if (!out.lines.empty() && line.frequency_Hz <= out.lines.back().frequency_Hz)
        report(child_pointer(line.pointer, f->name), number_text(line.frequency_Hz),
               say("more than {} Hz of the line before",
                   number_text(out.lines.back().frequency_Hz)),
               "order");
      line.value =
          parts ? std::complex(a->values[i], b->values[i])
                : turned(*a, i, size.value_or(MagnitudeUnit{}), radian * b->values[i]);
      if (unit) line.value *= unit->unit.mm;
      if (coherence) {
        line.coherence = coherence->values[i] / (percent(*coherence) ? 100 : 1);
        check(*coherence, i, *line.coherence, within(0, 1));
      }
      out.lines.push_back(std::move(line));
    }
    if (!unit) return std::nullopt;
    out.derivative = unit->unit.derivative;
    out.unit = unit->text;
    return out;
  }

 private:
  const Column* find(std::string_view key) const { return table_.find(key); }

  std::string found() const {
    std::string out;
    for (const Column& c : table_.columns) out += (out.empty() ? "" : ", ") + c.key;
    return out.empty() ? tr("none of these") : out;
  }

  static bool percent(const Column& c) { return c.unit == "%"; }

  static std::optional<WrittenUnit> of(const std::optional<MagnitudeUnit>& m) {
    if (!m || m->text.empty()) return std::nullopt;
    return WrittenUnit{m->text, response_unit(m->text).value_or(ResponseUnit{})};
  }

  /// The one unit of both parts.
  std::optional<WrittenUnit> of_parts(const Column& a, const Column& b) {
    std::optional<WrittenUnit> out;
    for (const Column* c : {&a, &b}) {
      const auto unit = response_unit(c->unit);
      check_unit(c, unit || c->unit.empty(), tr("motion per force"));
      if (unit && out && out->unit != *unit)
        report(line_pointer(csv_, table_.header), c->unit, say("one unit, {}", out->text),
               "unit");
      if (unit) out = WrittenUnit{c->unit, *unit};
    }
    return out;
  }

  void check_unit(const Column* c, bool good, const std::string& expected) {
    if (c && !good)
      report(child_pointer(line_pointer(csv_, table_.header), c->name), shown(c->unit),
             say("a unit of {}: {}", c->key, expected), "unit");
  }

  /// Hz of one unit.  Without one the header has no other words than those of a frequency.
  double hertz_of(const Column& f) {
    const auto stated = hertz_of_unit(f.unit);
    const auto expected = tr("Hz, kHz, rad/s, rpm or cpm");
    check_unit(&f, stated || f.unit.empty(), expected);
    for (const auto& word : words_of(f.unit.empty() ? f.name : ""))
      if (!is_of_frequency(word)) {
        report(child_pointer(line_pointer(csv_, table_.header), f.name), shown(word),
               say("a frequency, or its unit: {}", expected), "unit");
        break;
      }
    return stated.value_or(1);
  }

  static bool is_of_frequency(const std::string& word) {
    constexpr std::array kWords{"f",     "hz", "axis",  "line",
                                "lines", "x",  "value", "values"};
    return word.starts_with("freq") || std::ranges::find(kWords, word) != kWords.end() ||
           word.find_first_not_of("0123456789") == word.npos;
  }

  /// One unit of the phase [rad], from the header or from "phase_unit".
  double radian_of(const Column& phase) {
    const auto given = r_.optional_choice<double>(
        "phase_unit", {{"deg", units::rad_from_deg(1)}, {"rad", 1}});
    const auto stated = radian_of_unit(phase.unit);
    check_unit(&phase, stated || phase.unit.empty(), tr("deg or rad"));
    if (given && stated && *given != *stated)
      r_.problem_at("phase_unit", tr("none or that of the header"), "conflict");
    if (!given && phase.unit.empty())
      r_.problem_at("phase_unit", tr("deg or rad, here or in the header of the phase"),
                    "missing");
    return given.value_or(stated.value_or(1));
  }

  std::complex<double> turned(const Column& size, std::size_t i,
                              const MagnitudeUnit& unit, double phase_rad) {
    if (!unit.decibel) check(size, i, size.values[i], at_least(0));
    const double linear = unit.decibel
                              ? unit.reference * std::pow(10, size.values[i] / 20)
                              : size.values[i];
    const Bounds bounds = within(0, 1e12);
    if (unit.decibel) check(size, i, linear, bounds);
    return std::complex(linear * std::cos(phase_rad), linear * std::sin(phase_rad));
  }

  /// Reports a value outside its bounds; one that was no number has been reported.
  void check(const Column& c, std::size_t i, double x, const Bounds& bounds) {
    if (std::isfinite(c.values[i]) && !contains(bounds, x))
      report(child_pointer(line_pointer(csv_, table_.lines[i]), c.name),
             number_text(c.values[i]), expected_number(bounds), "range");
  }

  void report(std::string pointer, std::string got, std::string expected,
              std::string code) {
    csv_.problems().add(
        {std::move(pointer), std::move(got), std::move(expected), std::move(code)});
  }

  Reader& r_;
  const Reader& csv_;
  const MeasuredTable& table_;
};

}  // namespace

std::optional<MeasuredResponse> read_response_table(Reader& r) {
  const auto given = read_response_unit(r);
  const auto before = problems_of(r);
  const Reader csv = r.at("csv", tr("the text of a table, or the list of its lines"));
  const MeasuredTable table =
      read_measured_table(csv, r.optional_object("columns"), form());
  if (table.lines.empty()) {  // which was reported
    r.has("phase_unit");
    return std::nullopt;
  }
  auto out = ResponseTable(r, csv, table).response(given);
  r.has("phase_unit");
  return problems_of(r) > before ? std::nullopt : std::move(out);
}

}  // namespace turnwright::document
