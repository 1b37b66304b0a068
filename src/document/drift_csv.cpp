#include "drift_csv.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace turnwright::document {
namespace {

constexpr std::size_t kLineBytes = 10'000;

std::string_view trimmed(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r\n\"");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r\n\"") - first + 1);
}

std::vector<std::string_view> split(std::string_view s, std::string_view at) {
  std::vector<std::string_view> out;
  while (true) {
    const auto end = s.find_first_of(at);
    out.push_back(s.substr(0, end));
    if (end == std::string_view::npos) return out;
    s.remove_prefix(end + 1);
  }
}

struct Line {
  std::size_t number;  // from 1, as an editor counts
  std::string text;
};

std::vector<Line> lines_of(const Reader& csv, std::size_t most_rows) {
  std::vector<Line> out;
  const auto keep = [&out](std::size_t number, std::string_view text) {
    const auto content = trimmed(text);
    if (!content.empty() && content.front() != '#')
      out.push_back({number, std::string(text)});
  };
  std::size_t number = 0;
  if (csv.is_array()) {
    for (const Reader& line : csv.as_items(2, 2 * most_rows))
      keep(++number, line.as_text(kLineBytes));
  } else {
    const std::string text = csv.as_text(std::numeric_limits<std::size_t>::max());
    for (const auto line : split(text, "\n")) keep(++number, line);
  }
  return out;
}

double number(std::string_view field, bool& read) {
  const auto content = trimmed(field);
  double x = 0;
  const auto end = content.data() + content.size();
  const auto result = std::from_chars(content.data(), end, x);
  read = !content.empty() && result.ec == std::errc() && result.ptr == end;
  return x;
}

}  // namespace

std::map<std::string, std::vector<double>> csv_columns(
    const Reader& csv, const std::map<std::string, WantedColumn>& wanted,
    std::size_t most_rows) {
  std::map<std::string, std::vector<double>> out;
  if (!csv.broken() && !csv.is_array() && !csv.is_text()) {
    csv.problem("the text of a table, or the list of its lines", "type");
    return out;
  }
  const std::size_t before = csv.problems().list.size();
  const auto lines = lines_of(csv, most_rows);
  if (csv.problems().list.size() != before) return out;
  if (lines.size() < 2 || lines.size() > most_rows + 1) {
    csv.problem(std::to_string(lines.size()) + " lines",
                "a header line and 1 to " + std::to_string(most_rows) + " rows", "count");
    return out;
  }
  const char* separators = ",;\t";
  std::vector<std::string> header;
  for (const auto field : split(lines.front().text, separators))
    header.emplace_back(trimmed(field));
  std::map<std::string, std::size_t> place;
  for (const auto& [key, column] : wanted) {
    const auto at = std::ranges::find(header, column.name);
    if (at == header.end()) {
      const auto near = nearest(column.name, header);
      csv.problem("no column \"" + column.name + "\"",
                  near.empty() ? "a column for " + key : "perhaps \"" + near + "\"",
                  "missing");
    } else {
      place[key] = static_cast<std::size_t>(at - header.begin());
    }
  }
  if (place.size() != wanted.size()) return out;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    const auto fields = split(line->text, separators);
    for (const auto& [key, column] : wanted) {
      const std::size_t i = place[key];
      bool read = false;
      const double x = i < fields.size() ? number(fields[i], read) : 0;
      if (!read || !contains(column.bounds, x))
        csv.problem("line " + std::to_string(line->number) + ", " + column.name + ": " +
                        (i < fields.size() ? std::string(trimmed(fields[i])) : "nothing"),
                    expected_number(column.bounds), read ? "range" : "type");
      out[key].push_back(x);
    }
  }
  return out;
}

}  // namespace turnwright::document
