#pragma once
#include <string>
#include <vector>

#include "reader.hpp"

/// Ids in a document that refer to something else by its name.
namespace turnwright::document {

/// Reads the id under `key` and reports it unless it is in `known`, with `what` ("a tool
/// of this request") and the most similar id or the list.  Nothing is reported if `known`
/// is empty.
std::string checked_reference(const Reader& id, const std::vector<std::string>& known,
                              const std::string& what);

/// "a material of the catalogue (did you mean "C45"?)", or with the list.
std::string expected_reference(const std::string& id,
                               const std::vector<std::string>& known,
                               const std::string& what);

}  // namespace turnwright::document
