#include "csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "base/say.hpp"
#include "pointer.hpp"
#include "text_lines.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document {
namespace {

using Line = TextLine;

constexpr std::string_view kBlank = " \t";
constexpr const char* kForm =
    to_translate("the text of a table, or the list of its lines");
constexpr const char* kText = to_translate("a table as text");

struct Header {
  explicit Header(char ends_cells) : separator(ends_cells), numbers(ends_cells != ',') {}

  char separator;
  DecimalNumbers numbers;
  std::vector<const CsvColumn*> columns;  // null where a column is ignored
};

std::string pointer_of(const Reader& csv, const Line& line) {
  return line_pointer(csv, line.number);
}

void report(const Reader& csv, std::string pointer, std::string got, std::string expected,
            std::string code) {
  csv.problems().add(
      {std::move(pointer), std::move(got), std::move(expected), std::move(code)});
}

/// The cells without their quotes; nothing if quotes are misplaced.
std::optional<std::vector<std::string>> cells(std::string_view line, char separator) {
  std::vector<std::string> out;
  for (;;) {
    std::string cell;
    const auto start = line.find_first_not_of(separator == '\t' ? " " : kBlank);
    if (start != line.npos && line[start] == '"') {
      line.remove_prefix(start + 1);
      for (;;) {
        const auto quote = line.find('"');
        if (quote == line.npos) return std::nullopt;
        cell += line.substr(0, quote);
        line.remove_prefix(quote + 1);
        if (!line.starts_with('"')) break;
        cell += '"';
        line.remove_prefix(1);
      }
      if (!trimmed(line.substr(0, line.find(separator))).empty()) return std::nullopt;
    } else {
      cell = trimmed(line.substr(0, line.find(separator)));
    }
    out.push_back(std::move(cell));
    const auto end = line.find(separator);
    if (end == line.npos) return out;
    line.remove_prefix(end + 1);
  }
}

/// The cells without those that are empty behind the first `least`.
std::optional<std::vector<std::string>> cells_of(const Reader& csv, const Line& line,
                                                 char separator, std::size_t least) {
  auto out = cells(line.text, separator);
  if (!out)
    report(csv, pointer_of(csv, line), tr("a quote out of place"),
           tr("cells as \"text\", on one line, with \"\" for a quote"), "type");
  while (out && out->size() > least && out->back().empty()) out->pop_back();
  return out;
}

char separator_of(std::string_view header) {
  char best = ',';
  for (const char c : {';', '\t'})
    if (std::ranges::count(header, c) > std::ranges::count(header, best)) best = c;
  return best;
}

std::string list(const std::vector<CsvColumn>& columns) {
  std::string out;
  for (const CsvColumn& c : columns) out += (out.empty() ? "" : ", ") + c.name;
  return out;
}

/// The meaning of the header's columns; nothing if the header is wrong.
std::optional<Header> read_header(const Reader& csv, const Line& line,
                                  const std::vector<CsvColumn>& columns,
                                  OtherColumns others) {
  Header out(separator_of(line.text));
  const auto names = cells_of(csv, line, out.separator, 0);
  if (!names) return std::nullopt;
  bool good = true;
  const auto wrong = [&](const std::string& got, std::string expected, const char* code) {
    report(csv, pointer_of(csv, line), got, std::move(expected), code);
    good = false;
  };
  const auto listed = [&csv] {  // or the problem is only counted
    return csv.problems().list.size() < Problems::kListed;
  };
  std::vector<std::string> strangers;
  std::map<std::string_view, const CsvColumn*> by_name;
  for (const CsvColumn& column : columns) by_name.emplace(column.name, &column);
  std::set<std::string_view> seen;
  for (const std::string& name : *names) {
    leave_if_asked();
    const auto found = by_name.find(name);
    const CsvColumn* const column = found == by_name.end() ? nullptr : found->second;
    if (!column && others == OtherColumns::refused)
      wrong(say("column {}", shown(name)),
            listed() ? say("columns of {}", list(columns)) : "", "unknown-key");
    else if (column && !seen.insert(name).second)
      wrong(say("column {} again", shown(name)), tr("each column once"), "duplicate");
    out.columns.push_back(column);
    if (!column) strangers.push_back(name);
  }
  for (const CsvColumn& column : columns) {
    if (!column.required || std::ranges::count(*names, column.name) > 0) continue;
    const auto near = nearest(column.name, strangers);
    wrong(say("no column \"{}\"", column.name),
          near.empty() ? tr("one") : say("perhaps {}", shown(near)), "missing");
  }
  return good ? std::optional(out) : std::nullopt;
}

/// Whether a row is as long as the header; another length is reported.
bool has_length(const Reader& csv, const Line& line, std::size_t cells,
                std::size_t header) {
  if (cells != header)
    report(csv, pointer_of(csv, line), say("{} cells", cells),
           say("{} as in the header", header), "count");
  return cells == header;
}

/// The row of a line; false if a number has another decimal mark, as then many have.
bool add_row(const Reader& csv, const Line& line, Header& header,
             std::vector<CsvRow>& rows) {
  const auto row_cells = cells_of(csv, line, header.separator, header.columns.size());
  if (!row_cells || std::ranges::all_of(*row_cells, &std::string::empty)) return true;
  if (!has_length(csv, line, row_cells->size(), header.columns.size())) return true;
  CsvRow row{nlohmann::json::object(), pointer_of(csv, line)};
  for (std::size_t i = 0; i < row_cells->size(); ++i) {
    const CsvColumn* const column = header.columns[i];
    const std::string& cell = (*row_cells)[i];
    if (!column || cell.empty()) continue;
    const auto number =
        column->text ? DecimalNumbers::Number{} : header.numbers.read(cell);
    if (number.expected) {
      report(csv, child_pointer(row.pointer, column->name), shown(cell),
             tr(number.expected), "type");
      return false;
    }
    row.value[column->name] =
        number.value ? nlohmann::json(*number.value) : nlohmann::json(cell);
  }
  rows.push_back(std::move(row));
  return true;
}

/// Reports a table of no rows, unless something else was, or of too many.
void check_rows(const Reader& csv, std::size_t rows, std::size_t most,
                std::size_t problems_before, const std::string& header) {
  const bool nothing = rows == 0 && csv.problems().list.size() == problems_before;
  if (rows > most || nothing)
    csv.problem(nothing ? tr("no rows") : tr("more rows"),
                say("{} and 1 to {} rows", header, most), "count");
}

}  // namespace

std::optional<double> csv_number(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double x = 0;
  const auto end = cell.data() + cell.size();
  const auto [to, error] = std::from_chars(cell.data(), end, x);
  if (error != std::errc() || to != end || !std::isfinite(x)) return std::nullopt;
  return x;
}

DecimalNumbers::Number DecimalNumbers::read(std::string_view cell) {
  std::string digits(cell);
  const auto comma = digits.find(',');
  const bool has_comma = comma != digits.npos,
             has_point = digits.find('.') != digits.npos;
  if (has_comma) digits[comma] = '.';
  const auto value = csv_number(digits);
  if (!value || !(has_comma || has_point)) return {value};
  const char mark = has_comma ? ',' : '.';
  if (mark_ == 0) mark_ = mark;
  if (mark == mark_) return {value};
  return {value, mark_ == '.' ? to_translate("a decimal point, here and in all numbers")
                              : to_translate("a decimal comma, here and in all numbers")};
}

void csv_cells(const Reader& csv, std::size_t most_rows,
               const std::function<bool(const CsvCells&)>& take) {
  const std::size_t before = csv.problems().list.size();
  const auto lines = text_lines(csv, kForm);
  if (csv.broken() || !are_text(csv, lines, kText)) return;
  char separator = ',';
  std::size_t columns = 0, rows = 0;
  for (const Line& line : lines) {
    leave_if_asked();
    const auto text = trimmed(line.text);
    const bool header = columns == 0;
    if (text.empty() || (header && text.starts_with('#'))) continue;
    if (header) separator = separator_of(line.text);
    auto row = cells_of(csv, line, separator, columns);
    if (!row && header) return;
    if (!row || std::ranges::all_of(*row, &std::string::empty)) continue;
    if (header)
      columns = row->size();
    else if (++rows > most_rows)
      break;
    else if (!has_length(csv, line, row->size(), columns))
      continue;
    if (!take({line.number, std::move(*row)})) return;
  }
  check_rows(csv, rows, most_rows, before, tr("a header"));
}

std::vector<std::string> csv_header(const Reader& csv) {
  const auto lines = text_lines(csv, kForm);
  if (csv.broken() || !are_text(csv, lines, kText)) return {};
  for (const Line& line : lines) {
    const auto text = trimmed(line.text);
    if (!text.empty() && !text.starts_with('#'))
      return cells_of(csv, line, separator_of(line.text), 0)
          .value_or(std::vector<std::string>{});
  }
  return {};
}

std::vector<CsvRow> csv_rows(const Reader& csv, const std::vector<CsvColumn>& columns,
                             OtherColumns others, std::size_t most_rows) {
  const std::size_t before = csv.problems().list.size();
  const auto lines = text_lines(csv, kForm);
  std::vector<CsvRow> rows;
  std::optional<Header> header;
  if (csv.broken() || !are_text(csv, lines, kText)) return rows;
  for (const Line& line : lines) {
    leave_if_asked();
    const auto text = trimmed(line.text);
    if (text.empty() || (!header && text.starts_with('#'))) continue;
    if (!header) {
      header = read_header(csv, line, columns, others);
      if (!header) return rows;
    } else if (!add_row(csv, line, *header, rows)) {
      return rows;
    }
    if (rows.size() > most_rows) break;
  }
  check_rows(csv, rows.size(), most_rows, before,
             say("a header with columns of {}", list(columns)));
  return rows;
}

}  // namespace turnwright::document
