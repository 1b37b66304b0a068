#include "csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace turnwright::document {
namespace {

std::string_view trimmed(std::string_view s) {
  constexpr std::string_view kBlank = " \t\r";
  const auto first = s.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split(std::string_view s, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = s.find(separator);
    parts.push_back(trimmed(s.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    s.remove_prefix(end + 1);
  }
}

nlohmann::json cell(std::string_view s, bool text) {
  double x = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), x);
  if (text || error != std::errc() || end != s.data() + s.size() || !std::isfinite(x))
    return std::string(s);
  return x;
}

/// The columns in the order of the header; empty if it is wrong.
std::vector<CsvColumn> read_header(const Reader& text, std::string_view line,
                                   const std::vector<CsvColumn>& columns) {
  std::vector<std::string> known;
  for (const CsvColumn& c : columns) known.push_back(c.key);
  std::vector<CsvColumn> header;
  bool good = true;
  const auto wrong = [&](std::string_view name, std::string expected, const char* code) {
    text.problem("column \"" + std::string(name) + "\"", std::move(expected), code);
    good = false;
  };
  for (const std::string_view name : split(line, ',')) {
    const auto same = [name](const CsvColumn& c) { return c.key == name; };
    const auto found = std::ranges::find_if(columns, same);
    if (found == columns.end()) {
      std::string list;
      for (const std::string& key : known) list += (list.empty() ? "" : ", ") + key;
      wrong(name, "a first line naming columns of " + list, "unknown-key");
    } else if (std::ranges::any_of(header, same)) {
      wrong(name, "each column once", "duplicate");
    } else {
      header.push_back(*found);
    }
  }
  return good ? header : std::vector<CsvColumn>{};
}

}  // namespace

std::vector<CsvRow> csv_rows(const Reader& text, std::size_t max_bytes,
                             const std::vector<CsvColumn>& columns) {
  const std::string whole = text.as_text(max_bytes);
  std::vector<CsvRow> rows;
  std::vector<CsvColumn> header;
  std::size_t number = 0;
  for (const std::string_view line : split(whole, '\n')) {
    ++number;
    if (line.empty()) continue;
    if (header.empty()) {
      header = read_header(text, line, columns);
      if (header.empty()) return {};
      continue;
    }
    const auto cells = split(line, ',');
    const std::string pointer = text.pointer() + "#line " + std::to_string(number);
    if (cells.size() != header.size()) {
      text.problems().add({pointer, std::to_string(cells.size()) + " cells",
                           std::to_string(header.size()) + " as in the first line",
                           "count"});
      continue;
    }
    nlohmann::json row = nlohmann::json::object();
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!cells[i].empty()) row[header[i].key] = cell(cells[i], header[i].text);
    rows.push_back({std::move(row), pointer});
  }
  return rows;
}

}  // namespace turnwright::document
