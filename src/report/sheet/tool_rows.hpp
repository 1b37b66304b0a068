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
  double re_mm = 0;                                 ///< corner radius, 0: none
  std::optional<double> stick_out_mm = {};          ///< of a boring bar
  std::vector<std::string> operations = {};         ///< their ids
  std::vector<std::string> on = {};                 ///< what they cut
  std::optional<planning::EdgeSchedule> edge = {};  ///< none: parts do not wear it
};

/// The tools of a setup in the order of their numbers, then the driven ones.
/// @throws std::domain_error if the program is not that of the setup's operations.
std::vector<ToolRow> tool_rows(const planning::PreparedPart& part,
                               const planning::SetupPlan& setup,
                               const toolpath::SetupProgram& program);

}  // namespace turnwright::report
