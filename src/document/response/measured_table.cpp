#include "measured_table.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/pointer.hpp"
#include "document/json/text_lines.hpp"
#include "turnwright/base/pattern.hpp"

namespace turnwright::document {
namespace {

constexpr std::size_t kLongestName = 200;  // of a header in which a unit is looked for

/// Rows of a table, one after the other.
class TableRows {
 public:
  TableRows(const Reader& csv, std::map<std::string, std::string> names,
            const TableForm& form)
      : csv_(csv), names_(std::move(names)), form_(form) {}

  bool take(const CsvCells& line) {
    if (table_.header == 0) {
      read_header(line);
      return good_;
    }
    if (table_.lines.empty() && !asked_for_units_) {
      asked_for_units_ = true;
      if (are_units(line)) return true;
    }
    read_row(line);
    return true;
  }

  MeasuredTable table() && { return std::move(table_); }

 private:
  void read_header(const CsvCells& line) {
    table_.header = line.line;
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const Heading head = heading_of(line.cells[i]);
      const auto key = key_of(line.cells[i], head.quantity);
      if (!key) continue;
      if (const auto* other = table_.find(*key)) {
        report(line_pointer(csv_, line.line),
               say("columns {} and {}", shown(other->name), shown(line.cells[i])),
               say("one {}, named under columns", *key), "duplicate");
        continue;
      }
      table_.columns.push_back({*key, line.cells[i], head.unit, {}});
      places_.push_back(i);
    }
    for (const auto& [key, name] : names_) {
      if (std::ranges::count(line.cells, name) > 0) continue;
      const auto near = nearest(name, line.cells);
      report(line_pointer(csv_, line.line), say("no column {}", shown(name)),
             near.empty() ? tr("one") : say("perhaps {}", shown(near)), "missing");
    }
  }

  /// What stands in brackets at the end is a unit, known or not, and so is what has a slash;
  /// in round brackets there may also be the name of a channel, "(H1)".
  Heading heading_of(const std::string& name) const {
    static const Pattern kUnit(
        R"((.*\S)\s*(?:\[([^\[\]]*)\]|\(([^()]*)\)|\s([^\s()\[\]]+/[^\s()\[\]]+))\s*)");
    static const Pattern kChannel(R"([A-Za-z]{0,8}[ _-]?\d*)");
    const Heading known = heading(name, form_.is_unit);
    if (!known.unit.empty() || name.size() > kLongestName) return known;
    const auto m = kUnit.match(name);
    if (!m) return known;
    const std::string &square = (*m)[2], &round = (*m)[3], &ratio = (*m)[4];
    const bool channel =
        kChannel.match(round) && round.find_first_of("0123456789") != round.npos;
    return channel ? known : Heading{(*m)[1], square + round + ratio};
  }

  std::optional<std::string> key_of(const std::string& name,
                                    const std::string& quantity) const {
    for (const auto& [key, given] : names_)
      if (given == name) return key;
    const Quantity* const found = quantity_named(quantity, form_.quantities);
    if (!found || names_.contains(found->key)) return std::nullopt;
    return found->key;
  }

  bool are_units(const CsvCells& line) {
    bool any = false;
    for (const std::string& cell : line.cells) {
      const auto inside = heading("x " + cell, form_.is_unit).unit;
      if (!cell.empty() && inside.empty()) return false;
      any = any || !inside.empty();
    }
    if (!any) return false;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      auto& unit = table_.columns[k].unit;
      if (unit.empty()) unit = heading("x " + line.cells[places_[k]], form_.is_unit).unit;
    }
    return true;
  }

  void read_row(const CsvCells& line) {
    table_.lines.push_back(line.line);
    for (std::size_t k = 0; k < places_.size(); ++k)
      table_.columns[k].values.push_back(
          number(line.cells[places_[k]], line.line, table_.columns[k].name));
  }

  double number(const std::string& cell, std::size_t line, const std::string& name) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto [x, expected] = numbers_.read(cell);
    if (expected || !x || !contains(form_.bounds, *x)) {
      report(child_pointer(line_pointer(csv_, line), name),
             cell.empty() ? tr("nothing") : shown(cell),
             expected ? tr(expected) : expected_number(form_.bounds),
             x && !expected ? "range" : "type");
      return kNone;
    }
    return *x;
  }

  void report(std::string pointer, std::string got, std::string expected,
              std::string code) {
    good_ = good_ && table_.lines.size() > 0;
    csv_.problems().add(
        {std::move(pointer), std::move(got), std::move(expected), std::move(code)});
  }

  const Reader& csv_;
  std::map<std::string, std::string> names_;  // of columns, by their keys
  const TableForm& form_;
  MeasuredTable table_;
  std::vector<std::size_t> places_;  // of the columns in a row
  bool asked_for_units_ = false, good_ = true;
  DecimalNumbers numbers_;
};

}  // namespace

const MeasuredTable::Column* MeasuredTable::find(std::string_view key) const {
  const auto found = std::ranges::find(columns, key, &Column::key);
  return found == columns.end() ? nullptr : &*found;
}

MeasuredTable read_measured_table(const Reader& csv, std::optional<Reader> names,
                                  const TableForm& form) {
  std::map<std::string, std::string> given;
  if (names) {
    for (const Quantity& q : form.quantities)
      if (const auto name = names->optional_text(q.key)) given[q.key] = *name;
    names->finish();
  }
  TableRows rows(csv, std::move(given), form);
  const auto before = problems_of(csv);
  csv_cells(csv, form.most_rows, [&](const CsvCells& line) { return rows.take(line); });
  auto table = std::move(rows).table();
  if (table.lines.empty() && problems_of(csv) == before)
    csv.problem(tr("no rows below those of names and units"),
                say("{} and 1 to {} rows", tr("a header"), form.most_rows), "count");
  return table;
}

}  // namespace turnwright::document
