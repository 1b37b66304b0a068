#include "tool_rows.hpp"

#include <algorithm>
#include <stdexcept>

#include "planning/values/tool_label.hpp"
#include "report/picture/program_steps.hpp"

namespace turnwright::report {
namespace {

using planning::OperationPlan;

const catalogue::Tool* turning_tool(const planning::PreparedPart& part,
                                    const std::string& id) {
  const auto found = std::ranges::find(part.tools, id, &catalogue::Tool::id);
  return found == part.tools.end() ? nullptr : &*found;
}

ToolRow row_of(const planning::PreparedPart& part, const toolpath::TableTool& tool) {
  ToolRow row{tool.number, tool.offset, tool.id, {}, {}, tool.re_mm};
  const auto* turning = turning_tool(part, tool.id);
  if (!turning) return row;
  row.insert = turning->insert;
  if (turning->holder) row.holder = turning->holder->designation;
  if (turning->bar) row.stick_out_mm = catalogue::stick_out_mm(*turning->bar);
  return row;
}

void add(ToolRow& row, const OperationPlan& o) {
  row.operations.push_back(o.id);
  for (const auto& id : o.on)
    if (std::ranges::find(row.on, id) == row.on.end()) row.on.push_back(id);
}

}  // namespace

std::vector<ToolRow> tool_rows(const planning::PreparedPart& part,
                               const planning::SetupPlan& setup,
                               const toolpath::SetupProgram& program) {
  std::vector<ToolRow> rows, driven;
  for (const auto& tool : program.tools) rows.push_back(row_of(part, tool));
  for (const auto& [step, operation] : planned_steps(setup, program)) {
    if (!step->stop) {
      const auto row = std::ranges::find(rows, step->tool, &ToolRow::number);
      if (row == rows.end())
        throw std::domain_error("tool_rows: the program does not list the tool of " +
                                operation->id);
      add(*row, *operation);
    } else if (is_driven(operation->kind) && step->stop_min == 0) {
      const auto label = planning::tool_label(part, *operation);
      auto row = std::ranges::find(driven, label, &ToolRow::id);
      if (row == driven.end()) row = driven.insert(row, ToolRow{0, 0, label, {}, {}});
      add(*row, *operation);
    }
  }
  std::ranges::sort(rows, {}, &ToolRow::number);
  rows.insert(rows.end(), driven.begin(), driven.end());
  for (auto& row : rows) {
    const auto e = std::ranges::find(setup.edges, row.id, &planning::EdgeSchedule::tool);
    if (e != setup.edges.end()) row.edge = *e;
  }
  return rows;
}

}  // namespace turnwright::report
