
#include <algorithm>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "hole_tool_draft.hpp"
#include "library_readers.hpp"
#include "printed_designations.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

/// Columns with words.
constexpr std::string_view kWords[] = {"id",     "name",    "type", "unit",
                                       "insert", "MIID",    "SC",   "holder",
                                       "HAND",   "TMC1ISO", "TDZ"};

std::vector<CsvColumn> columns() {
  std::vector<CsvColumn> out;
  for (const auto word : kWords) out.push_back({std::string(word), false, true});
  for (const auto& symbol : symbols())
    out.push_back({std::string(symbol.code), false, true});
  return out;
}

class Row {
 public:
  explicit Row(const json& cells) : cells_(cells) {}
  std::string word(std::string_view column) const {
    return cells_.value(std::string(column), std::string());
  }
  void number(const Symbol& symbol, double unit, LibraryTool& t) {
    const auto cell = word(symbol.code);
    if (cell.empty() || cell == "-") return;
    const auto given = quantity(cell);
    if (!given || !given->unit.empty()) {
      wrong(symbol.code, cell, tr("a number"));
      return;
    }
    t.*symbol.member = given->value * (symbol.length ? unit : 1);
  }
  void wrong(std::string_view column, const std::string& cell,
             std::string_view expected) {
    wrong_ += say("{}{}: got {}, expected {}", wrong_.empty() ? "" : "; ", column,
                  shown(shortened(cell, 60)), expected);
  }
  const std::string& wrong() const { return wrong_; }

 private:
  const json& cells_;
  std::string wrong_;
};

void read_words(Row& row, LibraryTool& t) {
  t.id = row.word("id");
  t.name = row.word("name");
  if (t.name.empty()) t.name = t.id;
  t.insert = row.word("insert").empty() ? row.word("MIID") : row.word("insert");
  t.holder = row.word("holder");
  t.groups = row.word("TMC1ISO");
  if (t.groups.find_first_not_of("PMKNSH0123456789 ,/-") != std::string::npos)
    row.wrong("TMC1ISO", t.groups, tr("letters of ISO 513, P M K N S H"));
  for (const auto& text : {t.name, t.id})
    if (!text.empty()) t.texts.push_back(text);
  const auto letter = [&](const char* column, std::optional<char>& member) {
    const auto cell = row.word(column);
    if (cell.size() > 1)
      row.wrong(column, cell, tr("one letter"));
    else if (!cell.empty())
      member = cell[0];
  };
  letter("SC", t.SC);
  letter("HAND", t.hand);
  const auto type = row.word("type");
  t.boring = type == "boring";
  t.thread = row.word("TDZ");
  t.use = hole_use(type);
  if (!t.use.empty()) t.texts.push_back(type);  // "tap left hand"
  if (!type.empty() && type != "boring" && type != "turning" && t.use.empty())
    row.wrong("type", type, tr("turning, boring, tap, reamer or countersink"));
}

LibraryTool read_row(Row& row, double unit) {
  LibraryTool t;
  read_words(row, t);
  if (const auto name = row.word("unit"); !name.empty()) {
    const auto mm = unit_mm(name);
    if (!mm) row.wrong("unit", name, tr("mm or inch"));
    unit = mm.value_or(1);
  }
  for (const auto& symbol : symbols()) row.number(symbol, unit, t);
  if (row.word("type").empty())
    t.boring = t.DMIN_mm || t.DCON_mm || printed_designations({t.holder}).bar;
  return t;
}

}  // namespace

ToolLibrary read_tool_table(const Reader& csv, const std::string& unit,
                            std::vector<std::string>& others) {
  ToolLibrary out;
  const auto known = columns();
  const auto is_known = [&](const std::string& name) {
    return std::ranges::find(known, name, &CsvColumn::name) != known.end();
  };
  const auto header = csv_header(csv);
  if (!header.empty() && std::ranges::none_of(header, is_known)) {
    csv.problem(
        tr("a header of other columns"),
        tr("columns with symbols of ISO 13399, as RE, IC, KAPR, or with \"insert\""),
        "format");
    return out;
  }
  std::ranges::remove_copy_if(header, std::back_inserter(others), is_known);
  for (const auto& cells : csv_rows(csv, known, OtherColumns::ignored, kMostTools)) {
    Row row(cells.value);
    auto tool = read_row(row, unit_mm(unit).value_or(1));
    tool.at = cells.pointer.substr(cells.pointer.find('#') + 1);
    if (row.wrong().empty())
      out.tools.push_back(std::move(tool));
    else
      out.ignored.push_back({tool.at, say("It cannot be read: {}.", row.wrong())});
  }
  return out;
}

}  // namespace turnwright::document
