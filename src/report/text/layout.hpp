#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Plain text inside a page's width.  Characters are code points of UTF-8; control
/// characters count as blanks, so that a name cannot steer a terminal.
namespace turnwright::report {

inline constexpr std::size_t kPageWidth = 100;

std::size_t characters(std::string_view text);

/// Lines of at most `width` characters, broken at blanks, a longer word where it must;
/// at least one line.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// `text` wrapped behind `lead`, its further lines indented as deep.
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

/// Columns as wide as their widest cell, indented by two.  Where that is wider than the
/// page, the left-aligned columns give way and their cells wrap.
std::string table(const std::vector<Column>& columns, const std::vector<Row>& rows);

}  // namespace turnwright::report
