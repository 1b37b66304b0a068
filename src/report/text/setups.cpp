#include "setups.hpp"

#include <algorithm>

#include "amounts.hpp"
#include "base/say.hpp"
#include "certificate_words.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "result_words.hpp"
#include "setup_words.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

// The operation's first run has its name, time and cost; the others only conditions.
void add_rows(const ordered_json& operation, std::vector<Row>& rows) {
  const auto certificate = operation.find("certificate");
  const auto all = runs(list(operation, "passes"));
  for (std::size_t i = 0; i < std::max<std::size_t>(all.size(), 1); ++i) {
    Row row{std::vector<std::string>(10), ""};
    auto& cells = row.cells;
    if (i == 0) {
      cells[0] = word(operation, "id");
      cells[1] = word(operation, "tool");
      cells[7] = seconds(number(operation, "time_min"));
      cells[8] = money(number(operation, "cost"));
      cells[9] = certificate == operation.end() ? "-" : gap(*certificate);
    }
    if (i < all.size()) {
      const auto& pass = *all[i].first;
      cells[2] = std::to_string(all[i].count);
      cells[3] = shown(number(pass, "ap_mm"), 3);
      cells[4] = shown(number(pass, "f_mm_rev"), 3);
      cells[5] = shown(number(pass, "vc_m_min"), 1);
      cells[6] = speeds(all[i]);
    }
    rows.push_back(std::move(row));
  }
  rows.back().note = note(operation);
}

std::string conditions(const ordered_json& operations) {
  if (operations.empty()) return tr("  No operations.") + '\n';
  std::vector<Row> rows;
  for (const auto& operation : operations) add_rows(operation, rows);
  return table({{tr("operation"), Align::left},
                {tr("tool"), Align::left},
                {tr("no.")},
                {"ap mm"},
                {"f mm/r"},
                {"vc m/min"},
                {"n 1/min"},
                {"s"},
                {tr("cost")},
                {tr("gap")}},
               rows);
}

}  // namespace

std::string setups(const ordered_json& plan_result) {
  std::string out;
  const bool feasible = word(plan_result, "status") != "infeasible";
  std::size_t index = 0;
  for (const auto& setup : list(plan_result, "setups")) {
    out += '\n' + paragraph(say("SETUP {}  ", ++index), say("hold {}", holding(setup)));
    for (const auto& rejected : list(setup, "rejected"))
      out += paragraph(tr("  not "),
                       spoken(word(rejected, "clamping")) + ": " + word(rejected, "why"));
    if (!feasible && !list(setup, "operations").empty())
      out +=
          "  " +
          tr("Conditions that come closest; they break limits, do not cut with them.") +
          '\n';
    out += conditions(list(setup, "operations"));
  }
  return out;
}

}  // namespace turnwright::report
