#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tool_draft.hpp"

/// Taps, reamers and countersinks of tool libraries, which make holes to their size.
namespace turnwright::document {

/// What a library calls such a tool: "tapping", "reaming", "countersinking", as the documents'
/// `use` has it; "" if none of the words tap, reamer, countersink is in the text, or another
/// that makes it something else (tap drill, tapered reamer), whatever their case.
std::string hole_use(std::string_view text);

/// The conditions of one group of materials in which high-speed steel cuts.
struct HoleConditions {
  std::string_view group;  ///< letter of ISO 513
  double vc_m_min = 0;
  double f_per_mm = 0;  ///< 0 of taps, whose feed is the pitch
  double T_min = 0;
};
/// What a library does not say of these tools, as the catalogue's own have it (tools/fixed).
struct HoleEstimates {
  std::vector<HoleConditions> conditions;
  int edges = 0;
  double reach_diameters = 0;  ///< 0 of countersinks
  double gamma_deg = 0, change_min = 0, edge_cost = 0;
};
/// @param use  as hole_use() gives it
const HoleEstimates& hole_estimates(std::string_view use);

/// The document (schemas/fixed-tool.json) of a tool with a `use`, without its id.  A tap's
/// thread is the designation that stands in its texts, else that of its diameter and pitch.
/// @param groups  ISO 513 letters for tools whose library does not say any
ToolDraft hole_tool_draft(const LibraryTool& tool, const std::string& groups);

}  // namespace turnwright::document
