#pragma once
#include <functional>
#include <optional>
#include <string>

#include "library_tool.hpp"
#include "printed_designations.hpp"

namespace turnwright::document {

/// How a draft tells what it assumes, and what contradicts itself.
struct DraftRemarks {
  std::function<void(const char* member, std::string sentence)> assume;
  std::function<void(std::string sentence)> contradict;
};

/// What a draft is made from.
struct DraftSource {
  const LibraryTool& tool;
  const PrintedDesignations& printed;
  const DraftRemarks& remarks;
};

struct DraftedInsert {
  catalogue::Insert1832 insert;
  std::string designation;  ///< "CNMG 120408"
  double re_mm = 0;         ///< of the corner, which may be an inch size
};

/// The insert of a tool: the designation that is printed, which the sizes are held against;
/// else made from shape, size and corner, for which the usual letters and thickness are
/// assumed where they are not said.
/// @throws std::domain_error saying why there is none.
DraftedInsert drafted_insert(const DraftSource& from);

/// Whether the printed holder or bar holds such an insert.
bool holds(const PrintedDesignations& printed, const DraftedInsert& insert);

}  // namespace turnwright::document
