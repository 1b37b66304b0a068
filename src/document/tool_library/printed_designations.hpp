#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/catalogue/tool_codes.hpp"

namespace turnwright::document {

/// Designations found in names and remarks of a tool, the first of each kind.
struct PrintedDesignations {
  std::optional<catalogue::Insert1832> insert;  ///< "CNMG 120408" or "CNMG 432"
  std::optional<catalogue::Holder5608> holder;  ///< "DCLNR 2020K 12"
  std::optional<catalogue::Bar5609> bar;        ///< "A16M-SCLCR 09"
  std::string holder_text;                      ///< as holder or bar stands there
  /// Letters 1 to 4 of an insert, if they stand alone or before a size that is none.
  std::string insert_letters;
  std::string unreadable;  ///< what looks like an insert's designation and is none
};

PrintedDesignations printed_designations(const std::vector<std::string>& texts);

}  // namespace turnwright::document
