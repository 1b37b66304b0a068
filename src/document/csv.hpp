#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/document/reader.hpp"

namespace turnwright::document {

/// A column that a CSV text may have.
struct CsvColumn {
  std::string key;
  bool text = false;  ///< its cells stay text, also where they look like numbers
};

/// A row as an object that a Reader can take: key -> cell, empty cells left out.
struct CsvRow {
  nlohmann::json value;
  std::string pointer;  ///< "/csv#line 3"
};

/// Lines of cells between commas, the first naming the columns in any order.  Blanks
/// around cells, a carriage return and empty lines do not count; cells cannot be quoted.
/// Wrong headers and rows of another length than the header go to the reader's problems;
/// what is no number stays text, for the row's Reader to refuse.
std::vector<CsvRow> csv_rows(const Reader& text, std::size_t max_bytes,
                             const std::vector<CsvColumn>& columns);

}  // namespace turnwright::document
