#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Plain text within the width of a page.  Characters are code points of UTF-8; control
/// characters are replaced by blanks, so that a name cannot control a terminal.
namespace turnwright::report {

inline constexpr std::size_t kPageWidth = 100;

std::size_t characters(std::string_view text);

/// The text in lines of at most `width` characters, broken at blanks, or within a word
/// that is too long, there behind one of "-:|/_" if it has any; at least one line.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// `text` wrapped behind `lead`, with its further lines indented by the width of `lead`.
std::string paragraph(std::string_view lead, std::string_view text);

/// The first `width` characters, the last three "..." where more follow; one line.
std::string clipped(std::string_view text, std::size_t width);

enum class Align { left, right };

struct Column {
  std::string title;
  Align align = Align::right;
};

struct Row {
  std::vector<std::string> cells;  ///< one per column
  std::string note;                ///< a paragraph below the row, if not empty
};

/// A table with columns as wide as their widest cell, indented by two.  If it is wider
/// than the page its left-aligned columns become narrower and their cells wrap.
std::string table(const std::vector<Column>& columns, const std::vector<Row>& rows);

}  // namespace turnwright::report
