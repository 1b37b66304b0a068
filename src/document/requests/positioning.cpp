#include "turnwright/document/positioning.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/catalogue/machine_fields.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "document/json/text_lines.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/volumetric/linuxcnc_compensation.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kAxisReadings = 10000;
constexpr double kNearest_mm = 1e-4;  // of rows, so that they rise in any unit
const Bounds kAxisPlace = within(-1e5, 1e5, "mm"), kAxisDeviation = within(-1e6, 1e6);

struct CompFile {
  CompFileType type = CompFileType::actual;
  std::string unit = "mm";
  double unit_mm() const { return unit == "mm" ? 1 : 25.4; }
};

struct PositioningRequest {
  char axis = 'X';
  AxisTable table_mm;
  bool measured = false;            ///< whether the table is one of readings
  std::optional<CompFile> written;  ///< the file that is wanted
};

/// "type" and "unit" of a compensation file.
CompFile read_comp_file_kind(Reader& r) {
  CompFile out;
  out.type = static_cast<CompFileType>(r.integer_or("type", 0, 1, 0));
  out.unit = r.choice_or<const char*>("unit", {{"mm", "mm"}, {"inch", "inch"}}, "mm");
  return out;
}

double reading_unit_mm(Reader& r) {
  return r.choice<double>("unit", {{"mm", 1}, {"um", units::mm_from_um(1)}});
}

AxisTable read_reading_lists(Reader& r) {
  AxisTable t;
  t.q = r.numbers("q_mm", kAxisPlace, 1, kAxisReadings);
  const double unit = reading_unit_mm(r);
  const auto column = [&](const char* key, std::vector<double>& out) {
    if (!r.has(key)) return;
    out = r.numbers(key, kAxisDeviation, 1, kAxisReadings);
    if (!out.empty() && !t.q.empty() && out.size() != t.q.size())
      r.problem_at(key, tr("as many readings as q_mm has positions"), "count");
    for (double& x : out) x *= unit;
  };
  column("plus", t.plus);
  column("minus", t.minus);
  return t;
}

AxisTable read_reading_csv(Reader& r) {
  AxisTable t;
  const double unit = reading_unit_mm(r);
  std::map<std::string, std::string> names{
      {"q_mm", "q_mm"}, {"plus", "plus"}, {"minus", "minus"}};
  if (auto given = r.optional_object("columns")) {
    for (auto& [key, name] : names) name = given->text_or(key, name);
    given->finish();
  }
  const Reader csv = r.at("csv");
  const auto header = csv_header(csv);
  const auto has = [&](const char* key) {
    return std::ranges::find(header, names[key]) != header.end();
  };
  const bool plus = has("plus"), minus = has("minus");
  for (const CsvRow& row : csv_rows(csv,
                                    {{.name = names["q_mm"]},
                                     {.name = names["plus"], .required = false},
                                     {.name = names["minus"], .required = false}},
                                    OtherColumns::ignored, kAxisReadings)) {
    Reader cells(row.value, r.problems(), row.pointer);
    t.q.push_back(cells.number(names["q_mm"], kAxisPlace));
    if (plus) t.plus.push_back(unit * cells.number(names["plus"], kAxisDeviation));
    if (minus) t.minus.push_back(unit * cells.number(names["minus"], kAxisDeviation));
  }
  return t;
}

AxisTable read_readings(Reader r) {
  const auto problems = r.problems().list.size();
  AxisTable t = r.has("csv") ? read_reading_csv(r) : read_reading_lists(r);
  r.finish();
  if (r.problems().list.size() == problems && t.plus.empty() && t.minus.empty())
    r.problem(tr("neither"), tr("plus, minus or both: readings by direction of approach"),
              "missing");
  return t;
}

void append(const CompensationPoint& p, AxisTable& out) {
  out.q.push_back(p.nominal_mm);
  out.plus.push_back(p.plus_mm);
  out.minus.push_back(p.minus_mm);
}

/// The rows of LinuxCNC's file; what it would not read is a problem.
AxisTable read_comp_file(Reader r) {
  const CompFile kind = read_comp_file_kind(r);
  AxisTable t;
  const Reader text = r.at("text", tr("the text of a compensation file, or its lines"));
  const char* form = to_translate("three numbers a line: nominal, forward, reverse");
  const auto problems = text.problems().list.size();
  auto lines = text_lines(text, form);
  while (!lines.empty() && trimmed(lines.back().text).empty()) lines.pop_back();
  const auto refuse = [&](const TextLine& line, const std::string& expected) {
    text.problems().add({line_pointer(text, line.number),
                         shown(json(std::string(line.text))), expected, "range"});
  };
  if (lines.empty() && !text.broken() && text.problems().list.size() == problems)
    text.problem(tr("no row"), tr(form), "count");
  else if (lines.size() > kCompFileRows)
    text.problem(say("{} rows", lines.size()),
                 say("at most {} rows, as LinuxCNC takes them", kCompFileRows), "count");
  else if (are_text(text, lines, form))
    for (const TextLine& line : lines) {
      const auto point = comp_file_point(line.text, kind.type, kind.unit_mm());
      if (!point) {
        refuse(line, say("{}; LinuxCNC reads no further", tr(form)));
        break;
      }
      if (!contains(kAxisPlace, point->nominal_mm) ||
          !contains(kAxisPlace, point->plus_mm) || !contains(kAxisPlace, point->minus_mm))
        refuse(line, expected_number(kAxisPlace));
      else if (!t.q.empty() && point->nominal_mm <= t.q.back())
        refuse(line, tr("a nominal position above that of the line before"));
      append(*point, t);
    }
  r.finish();
  return t;
}

/// The positioning error of an axis of a machine, by both directions of motion.
AxisTable read_model(Reader r, char name) {
  const Machine machine = read_chain(r);
  const double from = r.number("from_mm", kAxisPlace), to = r.number("to_mm", kAxisPlace);
  const auto count = r.integer_or("positions", 2, static_cast<long>(kCompFileRows), 31);
  r.finish();
  if (to <= from) r.problem_at("to_mm", tr("a position above from_mm"), "range");
  AxisTable t;
  const auto axis = std::ranges::find(machine.axes, name, &volumetric::Axis::name);
  if (axis == machine.axes.end()) {
    if (chain_fault(machine.chain).empty() &&
        machine.chain.find(name) == std::string::npos)
      r.problem_at("chain", say("a chain with the axis {}", name), "conflict");
    return t;
  }
  const ErrorFunction& error = axis->errors[letter_index(name)];
  const double side = sense(machine.chain, name);
  for (long i = 0; i < count; ++i) {
    const double q =
        from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    append({q, side * error_at(error, q, axis->Q, 1),
            side * error_at(error, q, axis->Q, -1)},
           t);
  }
  return t;
}

AxisTable read_source(Reader& r, char axis) {
  const bool readings = r.has("readings"), file = r.has("comp_file"),
             model = r.has("model");
  AxisTable t;
  if (readings) t = read_readings(r.object("readings"));
  if (file) t = read_comp_file(r.object("comp_file"));
  if (model) t = read_model(r.object("model"), axis);
  const int given = readings + file + model;
  if (r.is_object() && given != 1)
    r.problem(given == 0 ? tr("none") : tr("more than one"),
              tr("one of readings, comp_file and model"), "conflict");
  return t;
}

/// Whether LinuxCNC takes a file of these positions.
void check_written(Reader& r, const AxisTable& t) {
  if (t.plus.empty() || t.minus.empty()) {
    r.problem_at("write_comp_file", tr("readings in both directions"), "conflict");
    return;
  }
  const auto all = targets(t);
  if (all.size() > kCompFileRows)
    r.problem_at("write_comp_file",
                 say("at most {} positions, the rows that LinuxCNC takes; there are {}",
                     kCompFileRows, all.size()),
                 "count");
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].q_mm - all[i - 1].q_mm < kNearest_mm) {
      r.problem_at("write_comp_file",
                   say("positions at least {} mm apart", number_text(kNearest_mm)),
                   "conflict");
      return;
    }
}

PositioningRequest read_positioning_request(const json& document) {
  Problems problems{.document = "positioning"};
  Reader r = Reader(document, problems).as_object();
  PositioningRequest q;
  read_format(r, "turnwright-positioning/1");
  q.axis = r.choice<char>("axis", {{"X", 'X'}, {"Y", 'Y'}, {"Z", 'Z'}});
  q.measured = r.has("readings");
  q.table_mm = read_source(r, q.axis);
  if (auto kind = r.optional_object("write_comp_file")) {
    q.written = read_comp_file_kind(*kind);
    kind->finish();
    if (problems.list.empty()) check_written(r, q.table_mm);
  }
  r.finish();
  problems.throw_if_any();
  return q;
}

/// A value in um under its key, if there is one.
void put_um(ordered_json& out, const char* key, const std::optional<double>& mm) {
  if (mm) out[key] = units::um_from_mm(*mm);
}

void put_um(ordered_json& out, const char* key, const std::optional<Extent>& extent) {
  if (extent) out[key] = units::um_from_mm(extent->width_mm());
}

ordered_json position_json(const PositionValues& p) {
  ordered_json out{{"q_mm", p.q_mm},
                   {"approaches_plus", p.approaches_plus},
                   {"approaches_minus", p.approaches_minus}};
  put_um(out, "mean_plus_um", p.mean_plus_mm);
  put_um(out, "mean_minus_um", p.mean_minus_mm);
  put_um(out, "mean_um", p.mean_mm);
  put_um(out, "s_plus_um", p.s_plus_mm);
  put_um(out, "s_minus_um", p.s_minus_mm);
  put_um(out, "B_um", p.B_mm);
  put_um(out, "R_um", p.R_mm);
  return out;
}

ordered_json values_json(const Iso230_2& v) {
  ordered_json out = ordered_json::object();
  put_um(out, "A_um", v.A);
  put_um(out, "A_plus_um", v.A_plus);
  put_um(out, "A_minus_um", v.A_minus);
  put_um(out, "R_um", v.R_mm);
  put_um(out, "R_plus_um", v.R_plus_mm);
  put_um(out, "R_minus_um", v.R_minus_mm);
  put_um(out, "E_um", v.E);
  put_um(out, "E_plus_um", v.E_plus);
  put_um(out, "E_minus_um", v.E_minus);
  put_um(out, "M_um", v.M);
  put_um(out, "B_um", v.B_mm);
  put_um(out, "B_mean_um", v.B_mean_mm);
  return out;
}

/// What the test lacks of ISO 230-2.
ordered_json lacks_json(const std::vector<Target>& all) {
  ordered_json out = ordered_json::array();
  std::size_t plus = kAxisReadings, minus = kAxisReadings;
  for (const Target& t : all) {
    plus = std::min(plus, t.plus_mm.size());
    minus = std::min(minus, t.minus_mm.size());
  }
  const std::size_t fewest = plus == 0    ? minus
                             : minus == 0 ? plus
                                          : std::min(plus, minus);
  if (plus == 0 || minus == 0)
    out.push_back(
        tr("The axis was measured in one direction: what needs both is missing."));
  if (fewest < 2)
    out.push_back(
        tr("Positions were approached once: repeatability and accuracy are missing."));
  const double travel = all.back().q_mm - all.front().q_mm;
  if (const auto wanted = approaches_wanted(travel); fewest < wanted)
    out.push_back(
        say("ISO 230-2 approaches each position {} times from each side; here it is {}.",
            wanted, fewest));
  if (const auto wanted = positions_wanted(travel); all.size() < wanted)
    out.push_back(say("ISO 230-2 has at least {} positions over {} mm; here are {}.",
                      wanted, number_text(travel), all.size()));
  if (evenly_spaced(all))
    out.push_back(
        say("The positions stand at one interval of {} mm: an error that repeats "
            "with it is not seen.",
            number_text(all[1].q_mm - all[0].q_mm)));
  return out;
}

/// Deviations that change along the axis as those of no axis do.
void add_doubt_of_slope(const std::vector<PositionValues>& all, ordered_json& out) {
  constexpr double kSteep = 0.01;      // a hundred times what leadscrews have
  constexpr double kScatter_mm = 0.1;  // between positions that nearly coincide
  for (const auto mean : {&PositionValues::mean_plus_mm, &PositionValues::mean_minus_mm})
    for (std::size_t i = 1; i < all.size(); ++i) {
      const auto &from = all[i - 1], &to = all[i];
      if (!(from.*mean) || !(to.*mean)) continue;
      const double change = std::abs(*(to.*mean) - *(from.*mean)),
                   length = to.q_mm - from.q_mm;
      if (change <= kSteep * length + kScatter_mm) continue;
      out.push_back(say(
          "The deviation changes by {:.3g} mm over {:.3g} mm at {:.6g} mm: are unit and "
          "type of the file right?",
          change, length, to.q_mm));
      return;
    }
}

/// The readings as an error of machine documents holds them.
ordered_json table_json(const AxisTable& t, std::size_t positions) {
  ordered_json out{{"q", t.q}};
  if (!t.plus.empty()) out["plus"] = t.plus;
  if (!t.minus.empty()) out["minus"] = t.minus;
  out["unit"] = "mm";
  out["sign"] = "tool-minus-workpiece";
  out["degree"] = std::min<std::size_t>(3, positions - 1);
  return out;
}

ordered_json comp_file_json(const CompFile& kind, const Iso230_2& v) {
  std::vector<CompensationPoint> points;
  for (const PositionValues& p : v.positions)
    points.push_back({p.q_mm, *p.mean_plus_mm, *p.mean_minus_mm});
  return {{"text", comp_file(points, kind.type, kind.unit_mm())},
          {"type", static_cast<int>(kind.type)},
          {"unit", kind.unit}};
}

}  // namespace

ordered_json positioning(const json& request) { return positioned(request).result; }

PositioningAnswer positioned(const json& request) {
  const PositioningRequest q = read_positioning_request(request);
  const auto all = targets(q.table_mm);
  PositioningAnswer out{.result = {}, .axis = q.axis, .values = iso230_2(all)};
  ordered_json positions = ordered_json::array();
  for (const auto& p : out.values.positions) positions.push_back(position_json(p));
  ordered_json warnings = q.measured ? lacks_json(all) : ordered_json::array();
  add_doubt_of_slope(out.values.positions, warnings);
  out.result = {{"axis", std::string(1, q.axis)},
                {"iso230_2", values_json(out.values)},
                {"positions", std::move(positions)},
                {"warnings", std::move(warnings)},
                {"table", table_json(q.table_mm, all.size())}};
  if (q.written) out.result["comp_file"] = comp_file_json(*q.written, out.values);
  return out;
}

}  // namespace turnwright::document
