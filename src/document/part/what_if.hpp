#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "document/json/reader.hpp"

namespace turnwright::document {

/// One entry of `what_if`: a limit of the request scaled, or the document with some of
/// its values set.
struct ChangedRequest {
  std::string name;
  std::string pointer;  ///< of the limit's name, or of the values set
  std::string limit;    ///< empty: `document` is the changed request
  double factor = 1;
  nlohmann::json document;
};

/// The changed requests of a document whose `what_if` has the right form; places that do
/// not exist in the document are reported to `problems`.
std::vector<ChangedRequest> changed_requests(const nlohmann::json& request,
                                             Problems& problems);

}  // namespace turnwright::document
