#pragma once
#include <map>
#include <string>
#include <vector>

#include "turnwright/document/reader.hpp"

namespace turnwright::document {

/// A column wanted from a table of text.
struct WantedColumn {
  std::string name;  ///< as in the header line
  Bounds bounds;
};

/// The wanted columns of a CSV: one string, or a list of its lines.  The first line names
/// the columns; fields end at a comma, a semicolon or a tab, numbers have a decimal
/// point; empty lines and lines that begin with # are skipped.  What is wrong is reported
/// against `csv`, by line; columns nobody wants may hold anything.
std::map<std::string, std::vector<double>> csv_columns(
    const Reader& csv, const std::map<std::string, WantedColumn>& wanted,
    std::size_t most_rows);

}  // namespace turnwright::document
