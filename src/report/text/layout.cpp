#include "layout.hpp"

#include <algorithm>
#include <optional>

namespace turnwright::report {
namespace {

constexpr std::size_t kIndent = 2, kGap = 2;

bool blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7f; }

// Whether a character of UTF-8 begins here.
bool begins(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// Bytes of the first `count` characters.
std::size_t bytes(std::string_view text, std::size_t count) {
  std::size_t i = 0;
  for (; i < text.size(); ++i)
    if (begins(text[i]) && count-- == 0) break;
  return i;
}

// Bytes of what of a word that is too long stands on a line of its own: up to the last
// mark between the parts of an id.
constexpr std::string_view kMarks = "-:|/_";
std::size_t first_piece(std::string_view word, std::size_t width) {
  const auto fits = bytes(word, width);
  const auto mark = word.substr(0, fits).find_last_of(kMarks);
  return mark == word.npos ? fits : mark + 1;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> all;
  for (std::size_t i = 0; i < text.size();) {
    const auto end = static_cast<std::size_t>(
        std::find_if(text.begin() + static_cast<long>(i), text.end(), blank) -
        text.begin());
    if (end > i) all.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return all;
}

// Characters of the longest piece of a text that stands on one line if it has room.
std::size_t longest_piece(std::string_view text) {
  std::size_t longest = 0;
  for (auto word : words(text))
    while (!word.empty()) {
      const auto mark = std::min(word.find_first_of(kMarks), word.size() - 1);
      longest = std::max(longest, characters(word.substr(0, mark + 1)));
      word.remove_prefix(mark + 1);
    }
  return longest;
}

std::string padded(const std::string& text, std::size_t width, Align align) {
  const auto have = characters(text);
  const std::string pad(width > have ? width - have : 0, ' ');
  return align == Align::left ? text + pad : pad + text;
}

void trim_right(std::string& line) { line.erase(line.find_last_not_of(' ') + 1); }

// The widest of the columns that may be narrower; none if none may.
std::optional<std::size_t> widest(const std::vector<Column>& columns,
                                  const std::vector<std::size_t>& width,
                                  const std::vector<std::size_t>& least) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < width.size(); ++i)
    if (columns[i].align == Align::left && width[i] > least[i] &&
        (!found || width[i] > width[*found]))
      found = i;
  return found;
}

// Columns give way until the table fits: first at blanks and marks, then within words.
std::vector<std::size_t> widths(const std::vector<Column>& columns,
                                const std::vector<Row>& rows) {
  constexpr std::size_t kLeast = 6;
  std::vector<std::size_t> all, unbroken;
  std::size_t total = kIndent;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::size_t width = characters(columns[i].title),
                piece = longest_piece(columns[i].title);
    for (const auto& row : rows) {
      width = std::max(width, characters(row.cells[i]));
      piece = std::max(piece, longest_piece(row.cells[i]));
    }
    all.push_back(width);
    unbroken.push_back(std::max(piece, kLeast));
    total += width + (i > 0 ? kGap : 0);
  }
  const std::vector<std::size_t> least(columns.size(), kLeast);
  for (; total > kPageWidth; --total) {
    auto narrower = widest(columns, all, unbroken);
    if (!narrower) narrower = widest(columns, all, least);
    if (!narrower) break;
    --all[*narrower];
  }
  return all;
}

// The lines that one row of cells takes.
std::string lines(const std::vector<Column>& columns,
                  const std::vector<std::size_t>& width,
                  const std::vector<std::string>& cells) {
  std::vector<std::vector<std::string>> parts;
  std::size_t height = 1;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    parts.push_back(wrapped(cells[i], width[i]));
    height = std::max(height, parts.back().size());
  }
  std::string out;
  for (std::size_t k = 0; k < height; ++k) {
    std::string line(kIndent, ' ');
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0) line += std::string(kGap, ' ');
      line += padded(k < parts[i].size() ? parts[i][k] : "", width[i], columns[i].align);
    }
    trim_right(line);
    out += line + '\n';
  }
  return out;
}

}  // namespace

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> all{""};
  for (auto word : words(text)) {
    const auto used = characters(all.back());
    if (used > 0 && used + 1 + characters(word) <= width) {
      all.back() += ' ';
      all.back() += word;
      continue;
    }
    if (used > 0) all.emplace_back();
    while (characters(word) > width) {
      const auto piece = first_piece(word, width);
      all.back() = word.substr(0, piece);
      all.emplace_back();
      word.remove_prefix(piece);
    }
    all.back() = word;
  }
  return all;
}

std::string paragraph(std::string_view lead, std::string_view text) {
  const auto depth = characters(lead);
  std::string out;
  for (const auto& line : wrapped(text, kPageWidth - depth)) {
    out += out.empty() ? std::string(lead) : std::string(depth, ' ');
    out += line;
    trim_right(out);
    out += '\n';
  }
  return out;
}

std::string clipped(std::string_view text, std::size_t width) {
  const auto line = wrapped(text, characters(text) + 1).front();
  if (characters(line) <= width) return line;
  return line.substr(0, bytes(line, width > 3 ? width - 3 : 0)) + "...";
}

std::string table(const std::vector<Column>& columns, const std::vector<Row>& rows) {
  const auto width = widths(columns, rows);
  std::vector<std::string> titles;
  for (const auto& column : columns) titles.push_back(column.title);
  std::string out = lines(columns, width, titles);
  for (const auto& row : rows) {
    out += lines(columns, width, row.cells);
    if (!row.note.empty()) out += paragraph("    ", row.note);
  }
  return out;
}

}  // namespace turnwright::report
