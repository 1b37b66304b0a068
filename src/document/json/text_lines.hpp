#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reader.hpp"

/// Texts of other formats inside a document, line by line.
namespace turnwright::document {

struct TextLine {
  std::size_t number;  ///< counted from 1 as an editor does
  std::string_view text;
};

/// The lines of a text or of a list of lines, without their ends and without a byte order
/// mark; they point into the document.  Another type is reported with the text `form`, what is
/// expected.
std::vector<TextLine> text_lines(const Reader& value, const char* form);

/// Whether the lines are text; the first control character is reported, `form` expected.
bool are_text(const Reader& value, const std::vector<TextLine>& lines, const char* form);

/// A text without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// The place of a line, "/csv#line 3".
std::string line_pointer(const Reader& value, std::size_t number);

}  // namespace turnwright::document
