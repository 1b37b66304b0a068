#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/nc/program.hpp"

namespace turnwright::report {

/// A tool of a setup as the person who loads the turret needs it.
struct ToolRow {
  int number = 0, offset = 0;  ///< T word and offset; 0 of a driven tool
  std::string id;              ///< of the catalogue, as the program lists it
  std::string holder;          ///< its designation; empty: not known
  std::string insert;
  double re_mm = 0;                          ///< corner radius, 0: none
  std::optional<double> stick_out_mm = {};   ///< of a boring bar
  std::vector<std::string> operations = {};  ///< their ids
  std::vector<std::string> on = {};          ///< what they cut
  double edge_share = 0;  ///< of an edge's life that one part uses in this setup
};

/// The tools of a setup in the order of their numbers, then the driven ones.  A part uses
/// of an edge the sum of t/T over its passes, as the plan's costs count it; of faces no
/// more than that, because T is the life at their highest speed.
/// @throws std::domain_error if the program is not that of the setup's operations.
std::vector<ToolRow> tool_rows(const planning::PreparedPart& part,
                               const planning::SetupPlan& setup,
                               const toolpath::SetupProgram& program);

/// Whole parts until this share of an edge is used; none where a part uses nothing.
std::optional<long> parts_until(double share, double edge_share);

}  // namespace turnwright::report
