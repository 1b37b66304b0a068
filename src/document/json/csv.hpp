#pragma once
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
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
/// - Numbers have a decimal point or, where cells do not end at commas, a comma, all of them
///   the same (DecimalNumbers).  What is no number stays text, for the row's Reader to
///   refuse under the column's name.
/// - A byte order mark, blanks around cells, \r at the end of a line, empty lines and
///   empty cells behind the last column do not count.
///
/// Reported: no table, a table of no rows or of more than `most_rows`, a wrong header,
/// rows of another length than the header, quotes out of place, and, once, a control
/// character (what is read is no text) or a number with another decimal mark.  Each column
/// of the header and each line is a cancellation point, also of csv_cells.
std::vector<CsvRow> csv_rows(const Reader& csv, const std::vector<CsvColumn>& columns,
                             OtherColumns others, std::size_t most_rows);

/// A line of a table that is not empty, its cells without quotes and blanks around them.
struct CsvCells {
  std::size_t line = 0;  ///< counted from 1
  std::vector<std::string> cells;
};

/// Calls `take` with the header of a table as csv_rows reads it, then with each row, until
/// `take` returns false; for tables that tell by their header what their columns are, and
/// whose numbers may have decimal commas where cells do not end at commas.  Reported: what
/// csv_rows reports of a table as such and of rows of another length than the header.
void csv_cells(const Reader& csv, std::size_t most_rows,
               const std::function<bool(const CsvCells&)>& take);

/// A number with a decimal point; nothing for other text.
std::optional<double> csv_number(std::string_view cell);

/// Reads the numbers of a table, which all have the decimal mark of the first that has one.
class DecimalNumbers {
 public:
  /// @param commas  whether they may have decimal commas
  explicit DecimalNumbers(bool commas = true) : mark_(commas ? 0 : '.') {}

  struct Number {
    std::optional<double> value;     ///< nothing for other text
    const char* expected = nullptr;  ///< to_translate(): the mark that it does not have
  };
  Number read(std::string_view cell);

 private:
  char mark_;
};

/// The names in the header of such a table, for tables whose columns are not known
/// before; none if there is no table, which is reported.
std::vector<std::string> csv_header(const Reader& csv);

}  // namespace turnwright::document
