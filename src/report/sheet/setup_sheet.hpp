#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inspection.hpp"
#include "tool_rows.hpp"

/// The set-up sheet: what hangs at the machine while a setup runs.
namespace turnwright::report {

/// Somebody has to do something in the middle of the program.
struct StopRow {
  std::string before;  ///< the operation that follows; of a milled place itself
  std::string what;    ///< and why
  double minutes = 0;  ///< 0: not planned here
};

/// A name and what it is, as read: {"Jaws", "soft, 60.0 kN"}.
using Entries = std::vector<std::pair<std::string, std::string>>;

struct SetupSheet {
  std::size_t setup = 0, setups = 0;  ///< from 1, of so many
  std::string program;                ///< its file
  Entries title;                      ///< part, drawing, material, machine
  Entries clamping;                   ///< stock, jaws, centres, zero
  Entries times;
  std::vector<ToolRow> tools;
  std::vector<StopRow> stops;
  std::vector<Check> checks;
};

/// Under what the machine finds the programs.
struct ShopPrograms {
  std::vector<std::string> files;  ///< names, one of each program
  std::string work_offset;         ///< "G54"; empty where the control has none
};

/// The sheets of every setup that has a program; none of a plan that has no programs.
/// @throws std::domain_error if the programs are not those of the plan.
std::vector<SetupSheet> setup_sheets(const planning::PreparedPart& part,
                                     const planning::ProcessPlan& plan,
                                     const nc::Programs& programs,
                                     const ShopPrograms& shop);

}  // namespace turnwright::report
