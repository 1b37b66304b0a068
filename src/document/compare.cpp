#include "turnwright/document/compare.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "csv.hpp"
#include "fields.hpp"
#include "turnwright/volumetric/agreement.hpp"

namespace turnwright::document {
namespace {

using namespace volumetric;
using nlohmann::json;

constexpr std::size_t kParameters = 500, kRuns = 1000;
const Bounds kValue = within(-1e6, 1e6);

struct Row {
  Runs runs;
  std::string group, unit, pointer;
};

struct Calibration {
  std::string name;
  std::vector<Row> rows;
};

Row read_row(Reader r) {
  r = r.as_object();
  Row row{.runs = {r.text("name", 32), {}},
          .group = r.text_or("group", ""),
          .unit = r.text_or("unit", "", 32),
          .pointer = r.pointer()};
  row.runs.value = r.numbers("runs", kValue, 2, kRuns);
  r.finish();
  return row;
}

bool is_run(std::string_view column) {
  for (const std::string_view start : {"test", "run"})
    if (column.starts_with(start) && column.size() > start.size() &&
        column.find_first_not_of("0123456789", start.size()) == column.npos)
      return true;
  return false;
}

/// The columns a header names: runs are numbers, all else may be anything.
std::vector<CsvColumn> columns_of(const Reader& csv) {
  std::vector<CsvColumn> out;
  for (const std::string& name : csv_header(csv))
    out.push_back({.name = name, .required = false, .text = !is_run(name)});
  return out;
}

std::vector<Row> read_table(const Reader& csv) {
  const std::size_t before = csv.problems().list.size();
  const auto columns = columns_of(csv);
  if (csv.problems().list.size() > before) return {};
  const auto named = [&](const char* key) {
    return std::ranges::find(columns, key, &CsvColumn::name) != columns.end();
  };
  const auto runs =
      std::ranges::count_if(columns, [](const CsvColumn& c) { return !c.text; });
  if (!named("param") || runs < 2) {
    csv.problem("a first line without them",
                "columns param and two or more of test1, test2, .. (or run1, ..); "
                "group and unit if there are any",
                "missing");
    return {};
  }
  std::vector<Row> out;
  for (const CsvRow& line : csv_rows(csv, columns, OtherColumns::refused, kParameters)) {
    json row{{"name", line.value.value("param", "")}, {"runs", json::array()}};
    for (const char* key : {"group", "unit"})
      if (line.value.contains(key)) row[key] = line.value[key];
    for (const CsvColumn& c : columns)
      if (!c.text && line.value.contains(c.name))
        row["runs"].push_back(line.value[c.name]);
    out.push_back(read_row(Reader(row, csv.problems(), line.pointer)));
  }
  return out;
}

/// EXX, EYY, EZZ with whatever follows but a reversal's b.
bool is_scale(const std::string& name) {
  return name.size() >= 3 && name[1] == name[2] && name.find('b') == std::string::npos;
}

Calibration read_calibration(Reader r) {
  Calibration c{.name = r.text("name"), .rows = {}};
  const double sign = r.choice_or<double>("sign", {{"as-named", 1}, {"opposite", -1}}, 1);
  // Of b where B = -2 b, the lost motion, is written down.
  const double reversal =
      r.choice_or<double>("reversal", {{"half", 1}, {"full", -0.5}}, 1);
  const auto length = r.optional_number("length_mm", above_up_to(0, 1e5, "mm"));
  if (r.has("csv")) {
    c.rows = read_table(r.at("csv"));
    if (r.has("parameters"))
      r.problem_at("parameters", "either csv or parameters", "conflict");
  } else {
    for (const Reader& item : r.items("parameters", 1, kParameters))
      c.rows.push_back(read_row(item));
  }
  r.finish();
  for (auto row = c.rows.begin(); row != c.rows.end(); ++row) {
    const std::string& name = row->runs.name;
    if (std::any_of(c.rows.begin(), row,
                    [&](const Row& other) { return other.runs.name == name; }))
      r.problems().add(
          {row->pointer + "/name", '"' + name + '"', "each parameter once", "duplicate"});
    double factor = sign * (name.ends_with('b') ? reversal : 1.0);
    if (length && is_scale(name) && row->unit == "um") {
      factor *= 1000 / *length;
      row->unit = "ppm";
    }
    for (double& v : row->runs.value) v *= factor;
  }
  return c;
}

const Row* row_of(const Calibration& c, const std::string& name) {
  const auto found =
      std::ranges::find_if(c.rows, [&](const Row& row) { return row.runs.name == name; });
  return found == c.rows.end() ? nullptr : &*found;
}

json summary_json(const Summary& s, std::size_t n) {
  return {{"mean", s.mean}, {"sd", s.sd}, {"n", n}};
}

json agreement_json(const Row& a, const Row& b) {
  const Agreement found = agreement(a.runs, b.runs);
  json out{{"name", found.name},
           {"a", summary_json(found.a, a.runs.value.size())},
           {"b", summary_json(found.b, b.runs.value.size())},
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

/// Common jumps of one calibration, with what leaving the run out does to the overlaps.
void add_jumps(const Calibration& own, const Calibration& other, json& jumps,
               json& notes) {
  std::vector<std::string> groups;
  for (const Row& row : own.rows)
    if (std::ranges::find(groups, row.group) == groups.end()) groups.push_back(row.group);
  for (const std::string& group : groups) {
    std::vector<Runs> runs;
    std::string unit;
    for (const Row& row : own.rows)
      if (row.group == group) {
        runs.push_back(row.runs);
        unit = row.unit;
      }
    for (const CommonJump& jump : common_jumps(runs)) {
      json changed = json::array();
      for (const Runs& r : runs) {
        const Row* against = row_of(other, r.name);
        if (!against || r.value.size() < 3) continue;
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
      notes.push_back(own.name + ": run " + std::to_string(jump.run + 1) +
                      " jumps alike in " + names + ", a common cause");
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
  for (const Row& row : a.rows) {
    const Row* other = row_of(b, row.runs.name);
    if (other && other->unit != row.unit)
      problems.add({other->pointer + "/unit", '"' + other->unit + '"',
                    "the unit of a's " + row.runs.name + ", \"" + row.unit + '"',
                    "conflict"});
  }
  const bool common = std::ranges::any_of(
      a.rows, [&](const Row& row) { return row_of(b, row.runs.name) != nullptr; });
  if (problems.list.empty() && !common)
    r.problem("no parameter in both", "at least one parameter in both", "conflict");
  problems.throw_if_any();

  json parameters = json::array(), agreeing = json::array(), only_a = json::array(),
       only_b = json::array(), jumps = json::array(), notes = json::array();
  for (const Row& row : a.rows) {
    const Row* other = row_of(b, row.runs.name);
    if (!other) {
      only_a.push_back(row.runs.name);
      continue;
    }
    parameters.push_back(agreement_json(row, *other));
    if (parameters.back()["overlap"]) agreeing.push_back(row.runs.name);
  }
  for (const Row& row : b.rows)
    if (!row_of(a, row.runs.name)) only_b.push_back(row.runs.name);
  notes.push_back(std::to_string(agreeing.size()) + " of " +
                  std::to_string(parameters.size()) +
                  " parameters agree within one standard deviation of each");
  add_jumps(a, b, jumps, notes);
  add_jumps(b, a, jumps, notes);
  return {{"parameters", parameters}, {"agreeing", agreeing},  {"only_in_a", only_a},
          {"only_in_b", only_b},      {"common_jumps", jumps}, {"notes", notes}};
}

}  // namespace turnwright::document
