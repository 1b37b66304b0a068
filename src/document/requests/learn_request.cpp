#include "learn_request.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/fields.hpp"
#include "document/json/read_below.hpp"
#include "document/json/reference.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "qif_results.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document::measured_parts {
namespace {

using nlohmann::json;

constexpr std::size_t kRows = 20000, kCharacteristics = 200, kEdges = 1000;
constexpr std::size_t kQifFiles = 5000;
const Bounds kSize = within(-1e6, 1e6, "mm");

// A name as text or as a whole number.
std::string read_name(Reader& r, std::string_view key) {
  const auto value = r.find(key);
  if (!value || value->broken()) return "";
  if (value->is_number()) return std::to_string(value->as_integer(0, 1'000'000'000));
  return value->as_text(64);
}

Characteristic read_characteristic(Reader r) {
  r = r.as_object();
  Characteristic c{.id = r.text("id"), .limits = {}};
  c.nominal_mm = r.number("nominal_mm", kSize);
  c.limits.upper_mm = r.number("upper_mm", kSize);
  c.limits.lower_mm = r.optional_number("lower_mm", kSize);
  const double upper = c.limits.upper_mm, lower = c.limits.lower_mm.value_or(0);
  if (lower >= upper)
    r.problem_at("upper_mm", say("more than the lower limit, {}", mm_text(lower)),
                 "order");
  c.limits.target_mm =
      r.number_or("target_mm", within(lower, std::max(lower, upper), "mm"),
                  c.limits.lower_mm ? (lower + upper) / 2 : 0);
  c.parts_per_edge = r.optional_integer("parts_per_edge", 1, 1'000'000);
  r.finish();
  return c;
}

std::optional<double> nominal_mm(const part::Drawing& d, const part::Tolerance& t) {
  if (!part::has_two_ends(t.kind)) return 0;
  if (t.kind == part::ToleranceKind::length)
    return std::abs(planning::face_z_mm(d, t.between[0]) -
                    planning::face_z_mm(d, t.between[1]));
  if (t.kind != part::ToleranceKind::diameter) return std::nullopt;
  for (const auto& e : d.outer)
    if (e.id == t.of) return e.left_mm;
  for (const auto& e : d.inner)
    if (e.id == t.of) return e.left_mm;
  return std::nullopt;
}

// Sizes, forms and places of the drawing that a gauge gives one number for.
void add_characteristics(const part::Drawing& d, std::vector<Characteristic>& all) {
  for (const auto& t : d.tolerances) {
    const auto nominal = nominal_mm(d, t);
    const auto same = std::ranges::find(all, t.id, &Characteristic::id);
    if (!nominal || same != all.end()) continue;
    Characteristic c{.id = t.id, .nominal_mm = *nominal, .limits = {}};
    c.limits.upper_mm = t.limits ? *nominal + t.limits->upper_mm : t.value_mm;
    if (t.limits) {
      c.limits.lower_mm = *nominal + t.limits->lower_mm;
      c.limits.target_mm = (c.limits.upper_mm + *c.limits.lower_mm) / 2;
    }
    all.push_back(std::move(c));
  }
}

void read_part(Reader& r, const Catalogue& catalogue, Request& q) {
  const auto part = r.optional_object("part");
  if (!part) return;
  read_below(*part, r.problems(), [&] {
    q.part = prepared_part(part->json(), catalogue, "learn");
    q.part_document = part->json();
    add_characteristics(q.part->part.drawing, q.characteristics);
  });
}

void read_characteristics(Reader& r, Request& q) {
  for (const Reader& item : r.optional_items("characteristics", 1, kCharacteristics)) {
    auto c = read_characteristic(item);
    if (std::ranges::find(q.characteristics, c.id, &Characteristic::id) !=
            q.characteristics.end() &&
        !c.id.empty())
      item.problem_at("id", tr("each characteristic once"), "duplicate");
    q.characteristics.push_back(std::move(c));
  }
  if (!r.has("characteristics") && !r.has("part") && !r.has("qif"))
    r.problem_at("characteristics",
                 tr("a list of characteristics, or a part whose tolerances they are"),
                 "missing");
}

// One row of one characteristic, whose id is known or to be read.
void add_row(Reader r, const std::string* id, const std::vector<std::string>& known,
             Request& q, std::set<std::string>& machines) {
  leave_if_asked();
  r = r.as_object();
  Row row{
      .part = read_name(r, "part"), .edge = read_name(r, "edge"), .pointer = r.pointer()};
  if (row.part.empty() && !r.has("part") && !r.broken())
    r.problem_at("part", tr("the part's number or name"), "missing");
  const std::string of =
      id ? *id
         : checked_reference(r.at("characteristic", tr("the id of a characteristic")),
                             known, tr("a characteristic"));
  row.value_mm = r.number(id ? *id : "value_mm", kSize);
  row.time_s = r.optional_number("time_s", within(0, 1e10, "s"));
  row.age = r.optional_number("parts_on_edge", within(0, 1e6));
  row.offset_mm = r.number_or("offset_mm", within(-10, 10, "mm"), 0);
  if (r.has("machine")) machines.insert(read_name(r, "machine"));
  if (!id) r.finish();
  const auto at = std::ranges::find(known, of);
  if (at == known.end()) return;
  row.characteristic = static_cast<std::size_t>(at - known.begin());
  // Corrections move sizes, and neither form nor place.
  if (!q.characteristics[row.characteristic].limits.lower_mm) row.offset_mm = 0;
  q.rows.push_back(std::move(row));
}

std::vector<CsvColumn> common_columns() {
  const auto optional = [](const char* name, bool text = false) {
    return CsvColumn{.name = name, .required = false, .text = text};
  };
  return {{.name = "part", .text = true}, optional("time_s"),
          optional("edge", true),         optional("parts_on_edge"),
          optional("offset_mm"),          optional("machine", true)};
}

// A table of a row for each value, or with a column for each characteristic.
void read_table(const Reader& csv, const std::vector<std::string>& known, Request& q,
                std::set<std::string>& machines) {
  const auto header = csv_header(csv);
  auto columns = common_columns();
  const bool tall = std::ranges::find(header, "characteristic") != header.end();
  std::vector<std::string> measured;
  if (tall) {
    columns.push_back({.name = "characteristic", .text = true});
    columns.push_back({.name = "value_mm"});
  }
  for (const auto& name : header)
    if (!tall && std::ranges::find(known, name) != known.end()) {
      measured.push_back(name);
      columns.push_back({.name = name, .required = false});
    }
  if (!tall && measured.empty() && !header.empty()) {
    csv.problem(tr("a first line without them"),
                say("columns characteristic and value_mm, or columns named by {}",
                    expected_reference("", known, tr("characteristics"))),
                "missing");
    return;
  }
  for (const CsvRow& row : csv_rows(csv, columns, OtherColumns::refused, kRows)) {
    if (tall)
      add_row(Reader(row.value, csv.problems(), row.pointer), nullptr, known, q,
              machines);
    for (const auto& id : measured)
      if (row.value.contains(id))
        add_row(Reader(row.value, csv.problems(), row.pointer), &id, known, q, machines);
  }
}

// Names of a file's characteristics -> ids of the request's.
std::map<std::string, std::string> read_names(Reader& qif, const Request& q) {
  std::vector<std::string> known;
  for (const auto& c : q.characteristics) known.push_back(c.id);
  std::map<std::string, std::string> names;
  for (const auto& entry : qif.optional_items("names", 0, kCharacteristics)) {
    auto item = entry.as_object();
    const auto name = item.text("name");
    const auto id = checked_reference(item.at("id", tr("the id of a characteristic")),
                                      known, tr("a characteristic"));
    item.finish();
    if (!item.broken() && !names.emplace(name, id).second)
      item.problem_at("name", tr("each name once"), "duplicate");
  }
  return names;
}

// The characteristic of a name in a file: the request's, else one by the file's limits.
std::optional<std::size_t> characteristic_of(const std::string& name,
                                             const std::string& id,
                                             const QifResults& results, Request& q) {
  const auto known = std::ranges::find(q.characteristics, id, &Characteristic::id);
  if (known != q.characteristics.end())
    return static_cast<std::size_t>(known - q.characteristics.begin());
  const auto limits =
      std::ranges::find(results.limits, name, &std::pair<std::string, QifLimits>::first);
  if (limits == results.limits.end() || q.characteristics.size() >= kCharacteristics)
    return std::nullopt;
  const auto& l = limits->second;
  Characteristic c{.id = id, .nominal_mm = l.nominal_mm, .limits = {}};
  c.limits.upper_mm = l.upper_mm;
  c.limits.lower_mm = l.lower_mm;
  if (l.lower_mm) c.limits.target_mm = (l.upper_mm + *l.lower_mm) / 2;
  q.characteristics.push_back(std::move(c));
  return q.characteristics.size() - 1;
}

// What the values of one characteristic have in common.
struct InCommon {
  std::optional<std::size_t> characteristic = {};
  std::size_t n = 0;
  bool timed = true;
  std::set<std::string> devices = {};
};

void warn_of(const std::string& name, const InCommon& c, Request& q) {
  if (!c.characteristic) {
    q.warnings.push_back(
        say("{}: neither the request nor the file has limits of it; its {} values do not "
            "count",
            name, c.n));
    return;
  }
  auto& of = q.characteristics[*c.characteristic];
  if (c.devices.size() == 1) of.device = *c.devices.begin();
  if (c.devices.size() > 1)
    q.warnings.push_back(
        say("{}: measured by {} devices, whose differences count as scatter", of.id,
            c.devices.size()));
}

void add_rows(const QifResults& results, const std::map<std::string, InCommon>& common,
              Request& q) {
  double first = std::numeric_limits<double>::infinity();
  for (const auto& v : results.values) first = std::min(first, v.time_s.value_or(first));
  for (const auto& v : results.values) {
    const auto& c = common.at(v.characteristic);
    if (!c.characteristic) continue;
    Row row{.part = v.part, .edge = v.edge, .pointer = v.pointer};
    row.characteristic = *c.characteristic;
    row.value_mm = v.value_mm;
    if (c.timed) row.time_s = *v.time_s - first;
    row.age = v.parts_on_edge;
    if (q.characteristics[row.characteristic].limits.lower_mm)
      row.offset_mm = v.offset_mm.value_or(0);
    q.rows.push_back(std::move(row));
  }
}

void read_qif_results(Reader qif, Request& q, std::set<std::string>& machines) {
  qif = qif.as_object();
  const auto names = read_names(qif, q);
  auto results = read_qif(qif.items("files", 1, kQifFiles));
  qif.finish();
  std::map<std::string, InCommon> common;
  for (auto& v : results.values) {
    auto& c = common[v.characteristic];
    ++c.n;
    c.timed = c.timed && v.time_s.has_value();
    if (v.device) c.devices.insert(*v.device);
    if (!v.machine.empty()) machines.insert(v.machine);
  }
  bool timed = false;
  for (auto& [name, c] : common) {
    const auto id = names.find(name);
    c.characteristic =
        characteristic_of(name, id == names.end() ? name : id->second, results, q);
    timed = timed || (c.timed && c.characteristic);
    warn_of(name, c, q);
  }
  add_rows(results, common, q);
  q.warnings.insert(q.warnings.end(), results.not_read.begin(), results.not_read.end());
  if (timed)
    q.warnings.push_back(tr("QIF: times are those of measuring; drift counts by them"));
  if (q.rows.empty() && qif.problems().list.empty())
    qif.problem(tr("no such values"),
                tr("measured lengths of characteristics that have limits"), "missing");
}

void read_rows(Reader& r, Request& q) {
  std::vector<std::string> known;
  for (const auto& c : q.characteristics) known.push_back(c.id);
  std::set<std::string> machines;
  if (r.has("csv") + r.has("rows") + r.has("qif") > 1)
    r.problem_at(r.has("csv") ? "csv" : "qif", tr("one of rows, csv and qif"),
                 "conflict");
  else if (r.has("qif"))
    read_qif_results(r.at("qif"), q, machines);
  else if (r.has("csv"))
    read_table(r.at("csv"), known, q, machines);
  else
    for (const Reader& item : r.items("rows", 1, kRows))
      add_row(item, nullptr, known, q, machines);
  if (q.rows.size() > kRows)
    r.problem_at("csv", say("{} values at most", kRows), "range");
  if (machines.size() > 1)
    r.problem_at(r.has("csv")   ? "csv"
                 : r.has("qif") ? "qif"
                                : "rows",
                 tr("parts of one machine; those of another are a request of their own"),
                 "conflict");
}

bool is_number(const std::string& name) {
  double x = 0;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), x);
  return fault == std::errc() && end == name.data() + name.size() && std::isfinite(x);
}

double number_of(const std::string& name) {
  double x = 0;
  std::from_chars(name.data(), name.data() + name.size(), x);
  return x;
}

// All rows of a characteristic have a time or none, and so with edges.
void check_series(const Request& q, std::size_t characteristic, Problems& problems) {
  const auto& id = q.characteristics[characteristic].id;
  const Row* first = nullptr;
  std::set<std::string> made;
  for (const Row& row : q.rows) {
    if (row.characteristic != characteristic) continue;
    if (!first) first = &row;
    const auto want = [&](bool has, bool wanted, const char* key) {
      if (has != wanted)
        problems.add({row.pointer + '/' + key, wanted ? tr("nothing") : tr("a value"),
                      wanted ? say("a value, as the first row of {} has", id)
                             : say("none, as the first row of {} has", id),
                      wanted ? "missing" : "conflict"});
    };
    want(row.time_s.has_value(), first->time_s.has_value(), "time_s");
    want(!row.edge.empty(), !first->edge.empty(), "edge");
    want(row.age.has_value(), first->age.has_value(), "parts_on_edge");
    if (!made.insert(row.part).second)
      problems.add({row.pointer, say("part \"{}\" twice", row.part),
                    tr("one value of each characteristic of a part"), "duplicate"});
  }
}

void check_edges(const Request& q, std::size_t characteristic, Problems& problems) {
  const auto made = series_of(q, characteristic);
  std::set<std::string> left;
  for (std::size_t i = 1; i < made.rows.size(); ++i) {
    const Row &before = q.rows[made.rows[i - 1]], &row = q.rows[made.rows[i]];
    if (row.edge == before.edge) continue;
    left.insert(before.edge);
    if (left.contains(row.edge))
      problems.add({row.pointer + "/edge", '"' + row.edge + '"',
                    tr("an edge that was not changed before"), "order"});
  }
  if (made.edges.size() > kEdges)
    problems.add(
        {"", say("{} edges", made.edges.size()), say("{} at most", kEdges), "range"});
}

// When each row was made: hours, else the number of its part.
std::vector<double> places(const Request& q, const std::vector<std::size_t>& rows,
                           bool timed) {
  const bool numbers =
      std::ranges::all_of(rows, [&](std::size_t i) { return is_number(q.rows[i].part); });
  constexpr double kHour_s = 3600;
  std::vector<double> all;
  for (const std::size_t i : rows)
    all.push_back(timed     ? *q.rows[i].time_s / kHour_s
                  : numbers ? number_of(q.rows[i].part)
                            : static_cast<double>(all.size()));
  return all;
}

}  // namespace

MadeSeries series_of(const Request& q, std::size_t characteristic) {
  MadeSeries made;
  for (std::size_t i = 0; i < q.rows.size(); ++i)
    if (q.rows[i].characteristic == characteristic) made.rows.push_back(i);
  if (made.rows.empty()) return made;
  made.timed = std::ranges::all_of(
      made.rows, [&](std::size_t i) { return q.rows[i].time_s.has_value(); });
  const auto unordered = places(q, made.rows, made.timed);
  std::vector<std::size_t> order(made.rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return unordered[i]; });
  const auto given = made.rows;
  double first = 0;  // number of the first part of the edge
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Row& row = q.rows[made.rows[k] = given[order[k]]];
    const double number =
        is_number(row.part) ? number_of(row.part) : static_cast<double>(k);
    const bool inferred =
        row.edge.empty() && row.age && k > 0 && *row.age <= made.series.back().age;
    const bool new_edge = k == 0 || inferred || row.edge != q.rows[made.rows[k - 1]].edge;
    if (new_edge) {
      made.edges.push_back(row.edge.empty() ? std::to_string(made.edges.size() + 1)
                                            : row.edge);
      first = number;
    }
    const double counted = row.edge.empty() ? 0 : std::max(0.0, number - first);
    made.series.push_back({row.value_mm, row.offset_mm, unordered[order[k]],
                           made.edges.size() - 1, row.age.value_or(counted)});
  }
  return made;
}

Request read(const json& document, const Catalogue& catalogue) {
  Problems problems{.document = "learn"};
  Reader r = Reader(document, problems).as_object();
  Request q;
  read_format(r, "turnwright-learn/1");
  q.confidence = r.number_or("confidence", within(0.5, 0.999), q.confidence);
  q.outlier_p = r.number_or("outlier_p", within(0, 0.5), q.outlier_p);
  q.update = r.boolean_or("update", false);
  if (q.update && !r.has("part"))
    r.problem_at("update", tr("a part, whose plan the parts were made by"), "conflict");
  read_characteristics(r, q);
  const auto before = problems.list.size();
  read_part(r, catalogue, q);
  if (problems.list.size() == before)
    read_rows(r, q);
  else
    for (const char* key : {"csv", "rows", "qif"}) r.has(key);
  r.finish();
  problems.throw_if_any();
  for (std::size_t c = 0; c < q.characteristics.size(); ++c) check_series(q, c, problems);
  problems.throw_if_any();
  for (std::size_t c = 0; c < q.characteristics.size(); ++c) check_edges(q, c, problems);
  problems.throw_if_any();
  return q;
}

}  // namespace turnwright::document::measured_parts
