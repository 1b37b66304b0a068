#include "turnwright/document/compare.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/volumetric/agreement.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kParameters = 500, kRuns = 1000;
const Bounds kRun = within(-1e6, 1e6);

struct RunRow {
  Runs runs;
  std::string group, unit, pointer;
};

struct Calibration {
  std::string name;
  std::vector<RunRow> rows;
};

RunRow named_row(Reader& r) {
  return {.runs = {r.text("name", 32), {}},
          .group = r.text_or("group", ""),
          .unit = r.text_or("unit", "", 32),
          .pointer = r.pointer()};
}

RunRow read_row(Reader r) {
  r = r.as_object();
  RunRow row = named_row(r);
  for (const double value : r.numbers("runs", kRun, 2, kRuns))
    row.runs.value.emplace_back(value);
  r.finish();
  return row;
}

/// The number of a column test1, run1, ..; 0 of others.
std::size_t run_of(std::string_view column) {
  for (const std::string_view start : {"test", "run"}) {
    if (!column.starts_with(start)) continue;
    std::size_t number = 0;
    const auto [end, fault] = std::from_chars(column.data() + start.size(),
                                              column.data() + column.size(), number);
    if (fault == std::errc() && end == column.data() + column.size())
      return number <= kRuns ? number : 0;
  }
  return 0;
}

/// The columns a header names: runs are numbers, all else may be anything.
std::vector<CsvColumn> columns_of(const Reader& csv) {
  std::vector<CsvColumn> out;
  for (const std::string& name : csv_header(csv))
    out.push_back({.name = name, .required = false, .text = run_of(name) == 0});
  return out;
}

/// A line of a table; a blank cell means that the run has no value.
RunRow line_row(const CsvRow& line, const std::map<std::size_t, std::string>& run_columns,
                Problems& problems) {
  json named{{"name", line.value.value("param", "")}};
  for (const char* key : {"group", "unit"})
    if (line.value.contains(key)) named[key] = line.value[key];
  Reader r(named, problems, line.pointer);
  RunRow row = named_row(r);
  Reader cells(line.value, problems, line.pointer);
  row.runs.value.resize(run_columns.rbegin()->first);
  for (const auto& [run, column] : run_columns)
    row.runs.value[run - 1] = cells.optional_number(column, kRun);
  if (const auto n = values(row.runs).size(); n < 2)
    problems.add({line.pointer, say("{} runs", n), tr("two runs or more"), "count"});
  return row;
}

std::vector<RunRow> read_table(const Reader& csv) {
  const std::size_t before = csv.problems().list.size();
  const auto columns = columns_of(csv);
  if (csv.problems().list.size() > before) return {};
  const auto named = [&](const char* key) {
    return std::ranges::find(columns, key, &CsvColumn::name) != columns.end();
  };
  const auto runs =
      std::ranges::count_if(columns, [](const CsvColumn& c) { return !c.text; });
  if (!named("param") || runs < 2) {
    csv.problem(tr("a first line without them"),
                tr("columns param and two or more of test1, test2, .. (or run1, ..); "
                   "group and unit if there are any"),
                "missing");
    return {};
  }
  std::map<std::size_t, std::string> run_columns;
  for (const CsvColumn& c : columns)
    if (!c.text && !run_columns.emplace(run_of(c.name), c.name).second)
      csv.problem(say("a first line with run {} twice", run_of(c.name)),
                  tr("each run once"), "duplicate");
  std::vector<RunRow> out;
  for (const CsvRow& line : csv_rows(csv, columns, OtherColumns::refused, kParameters))
    out.push_back(line_row(line, run_columns, csv.problems()));
  return out;
}

/// EXX, EYY, EZZ with whatever follows but a reversal's b.
bool is_scale(const std::string& name) {
  return name.size() >= 3 && name[1] == name[2] && name.find('b') == std::string::npos;
}

Calibration read_calibration(Reader r) {
  Calibration c{.name = r.text("name"), .rows = {}};
  const double sign = r.choice_or<double>("sign", {{"as-named", 1}, {"opposite", -1}}, 1);
  // Converts the lost motion B = -2 b to b.
  const double reversal =
      r.choice_or<double>("reversal", {{"half", 1}, {"full", -0.5}}, 1);
  const auto length = r.optional_number("length_mm", within(1, 1e5, "mm"));
  if (r.has("csv")) {
    c.rows = read_table(r.at("csv"));
    if (r.has("parameters"))
      r.problem_at("parameters", tr("either csv or parameters"), "conflict");
  } else {
    for (const Reader& item : r.items("parameters", 1, kParameters))
      c.rows.push_back(read_row(item));
  }
  r.finish();
  for (auto row = c.rows.begin(); row != c.rows.end(); ++row) {
    const std::string& name = row->runs.name;
    if (std::any_of(c.rows.begin(), row,
                    [&](const RunRow& other) { return other.runs.name == name; }))
      r.problems().add({row->pointer + "/name", '"' + name + '"',
                        tr("each parameter once"), "duplicate"});
    double factor = sign * (name.ends_with('b') ? reversal : 1.0);
    if (length && is_scale(name) && row->unit == "um") {
      factor *= 1000 / *length;
      row->unit = "ppm";
    }
    for (auto& value : row->runs.value)
      if (value) *value *= factor;
  }
  return c;
}

const RunRow* row_of(const Calibration& c, const std::string& name) {
  const auto found = std::ranges::find_if(
      c.rows, [&](const RunRow& row) { return row.runs.name == name; });
  return found == c.rows.end() ? nullptr : &*found;
}

json summary_json(const Summary& s, std::size_t n) {
  return {{"mean", s.mean}, {"sd", s.sd}, {"n", n}};
}

json agreement_json(const RunRow& a, const RunRow& b) {
  const Agreement found = agreement(a.runs, b.runs);
  json out{{"name", found.name},
           {"a", summary_json(found.a, values(a.runs).size())},
           {"b", summary_json(found.b, values(b.runs).size())},
           {"difference", found.difference},
           {"range", std::abs(found.difference)},
           {"overlap", found.overlap}};
  if (!a.group.empty()) out["group"] = a.group;
  if (!a.unit.empty()) out["unit"] = a.unit;
  if (found.t) out["welch"] = {{"t", *found.t}, {"dof", *found.dof}, {"p", *found.p}};
  if (const auto& c = found.correlation) {
    out["correlation"] = {{"r", c->r}, {"p", c->p}};
    if (c->lower) out["correlation"]["interval_95"] = {*c->lower, *c->upper};
  }
  return out;
}

/// Common jumps of one calibration, with the overlaps if the run is left out.
void add_jumps(const Calibration& own, const Calibration& other, json& jumps,
               json& notes) {
  std::vector<std::pair<std::string, std::string>> groups;  // of one unit each
  for (const RunRow& row : own.rows)
    if (const std::pair of(row.group, row.unit);
        std::ranges::find(groups, of) == groups.end())
      groups.push_back(of);
  for (const auto& [group, unit] : groups) {
    std::vector<Runs> runs;
    for (const RunRow& row : own.rows)
      if (row.group == group && row.unit == unit) runs.push_back(row.runs);
    for (const CommonJump& jump : common_jumps(runs)) {
      json changed = json::array();
      for (const Runs& r : runs) {
        leave_if_asked();
        const RunRow* against = row_of(other, r.name);
        if (!against || values(r).size() < 3) continue;
        const bool before = agreement(r, against->runs).overlap;
        if (agreement(without_run(r, jump.run), against->runs).overlap != before)
          changed.push_back(r.name);
      }
      std::string names;
      for (const auto& name : jump.parameters)
        names += (names.empty() ? "" : ", ") + name;
      jumps.push_back({{"calibration", own.name},
                       {"group", group},
                       {"unit", unit},
                       {"run", jump.run + 1},
                       {"parameters", jump.parameters},
                       {"jump", jump.jump},
                       {"overlap_changes_without_it", changed}});
      notes.push_back(say("{}: run {} jumps alike in {}, a common cause", own.name,
                          jump.run + 1, names));
    }
  }
}

}  // namespace

json compare(const json& request) {
  Problems problems{.document = "compare"};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-compare/1");
  const Calibration a = read_calibration(r.object("a")),
                    b = read_calibration(r.object("b"));
  r.finish();
  for (const RunRow& row : a.rows) {
    const RunRow* other = row_of(b, row.runs.name);
    if (other && other->unit != row.unit)
      problems.add({other->pointer + "/unit", '"' + other->unit + '"',
                    say("the unit of a's {}, \"{}\"", row.runs.name, row.unit),
                    "conflict"});
  }
  const bool common = std::ranges::any_of(
      a.rows, [&](const RunRow& row) { return row_of(b, row.runs.name) != nullptr; });
  if (problems.list.empty() && !common)
    r.problem(tr("no parameter in both"), tr("at least one parameter in both"),
              "conflict");
  problems.throw_if_any();

  json parameters = json::array(), agreeing = json::array(), only_a = json::array(),
       only_b = json::array(), jumps = json::array(), notes = json::array();
  for (const RunRow& row : a.rows) {
    const RunRow* other = row_of(b, row.runs.name);
    if (!other) {
      only_a.push_back(row.runs.name);
      continue;
    }
    parameters.push_back(agreement_json(row, *other));
    if (parameters.back()["overlap"]) agreeing.push_back(row.runs.name);
  }
  for (const RunRow& row : b.rows)
    if (!row_of(a, row.runs.name)) only_b.push_back(row.runs.name);
  notes.push_back(say("{} of {} parameters agree within one standard deviation of each",
                      agreeing.size(), parameters.size()));
  add_jumps(a, b, jumps, notes);
  add_jumps(b, a, jumps, notes);
  return {{"parameters", parameters}, {"agreeing", agreeing},  {"only_in_a", only_a},
          {"only_in_b", only_b},      {"common_jumps", jumps}, {"notes", notes}};
}

}  // namespace turnwright::document
