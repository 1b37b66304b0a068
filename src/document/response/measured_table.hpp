#pragma once
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "heading.hpp"

namespace turnwright::document {

/// The columns of a CSV that are known by their headers.
struct MeasuredTable {
  struct Column {
    std::string key;             ///< of its quantity
    std::string name;            ///< in the header
    std::string unit;            ///< of the header, or of a line of units below; "": none
    std::vector<double> values;  ///< as written, one for each of `lines`
  };
  std::vector<Column> columns;
  std::size_t header = 0;          ///< line of the header
  std::vector<std::size_t> lines;  ///< of the rows
  const Column* find(std::string_view key) const;
};

/// How a table is read.
struct TableForm {
  std::vector<Quantity> quantities;  ///< the first that fits a header has the column
  bool (*is_unit)(std::string_view) = nullptr;
  Bounds bounds;  ///< of all cells
  std::size_t most_rows = 0;
};

/// Reads the CSV under `csv`.  Quantities are known by the words of their headers, or by the
/// names that `names` ({"real": "Re(H1)"}) gives for their keys; other columns are ignored.
/// Numbers have decimal points, or decimal commas where cells end at semicolons or tabs,
/// one of them in the whole table.  What stands in brackets at a header's end, or has a
/// slash, is its unit, known or not, but not the name of a channel, "(H1)".  A first row
/// without numbers, all of whose cells are units, holds the units of the columns.
/// Reported: what csv_cells reports; no rows but that of units; a name of `names` that no
/// column has; two columns of one quantity; cells that are no numbers, by line and column.
MeasuredTable read_measured_table(const Reader& csv, std::optional<Reader> names,
                                  const TableForm& form);

}  // namespace turnwright::document
