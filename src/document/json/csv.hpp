#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reader.hpp"

namespace turnwright::document {

/// A column wanted from a CSV table, by its name in the header.
struct CsvColumn {
  std::string name;
  bool required = true;
  bool text = false;  ///< its cells stay text, also where they look like numbers
};

enum class OtherColumns { refused, ignored };

/// A row as an object that a Reader can take: column -> cell, empty cells left out.
struct CsvRow {
  nlohmann::json value;
  std::string pointer;  ///< "/csv#line 3", counted from 1 as an editor does
};

/// The rows of a CSV table (RFC 4180) given as one text or as the list of its lines.
///
/// - The header names the columns, in any order; lines before it may begin with #.
/// - Cells end at a comma, a semicolon or a tab, whichever the header has most of.  They
///   may be quoted, with "" for a quote, but not over several lines.
/// - Numbers have a decimal point.  What is no number stays text, for the row's Reader to
///   refuse under the column's name.
/// - A byte order mark, blanks around cells, \r at the end of a line, empty lines and
///   empty cells behind the last column do not count.
///
/// Reported: no table, a table of no rows or of more than `most_rows`, a wrong header,
/// rows of another length than the header, quotes out of place, and, once, a control
/// character (what is read is no text) or a decimal comma.
std::vector<CsvRow> csv_rows(const Reader& csv, const std::vector<CsvColumn>& columns,
                             OtherColumns others, std::size_t most_rows);

/// The names in the header of such a table, for tables whose columns are not known
/// before; none if there is no table, which is reported.
std::vector<std::string> csv_header(const Reader& csv);

}  // namespace turnwright::document
