#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "library_tool.hpp"

namespace turnwright::document {

/// The document (schemas/tool.json) that a tool of a library becomes, without its id.
struct ToolDraft {
  nlohmann::ordered_json document;
  std::vector<PlacedRemark> assumed;        ///< at a member of the document, "/life"
  std::vector<std::string> contradictions;  ///< sentences: what disagrees, what is taken
  std::string refused;                      ///< why there is no document, a sentence
};

/// Makes the document.  Designations that stand in the library's texts are what is printed
/// on box and holder, and win over its numbers; corners keep their inch size (0.794 mm for
/// 08).  Numbers that the library does not say are estimates (tool_estimates.hpp), with
/// large uncertainties and their source.
/// @param groups  ISO 513 letters for tools whose library does not say any
ToolDraft tool_draft(const LibraryTool& tool, const std::string& groups);

}  // namespace turnwright::document
