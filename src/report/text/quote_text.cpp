#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "amounts.hpp"
#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

Row batch_row(const ordered_json& price) {
  Row row{{shown(number(price, "batch"), 0)}, ""};
  for (const char* key :
       {"price", "stock", "run", "setting_up", "scrap", "overhead", "margin"})
    row.cells.push_back(money(number(price, key)));
  row.cells.push_back(duration(number(price, "time_min")));
  row.cells.push_back(word(price, "made_by"));
  return row;
}

std::string batch_table(const ordered_json& part) {
  std::vector<Column> columns{{tr("batch")},    {tr("price")},
                              {tr("stock")},    {tr("run")},
                              {tr("set up")},   {tr("scrap")},
                              {tr("overhead")}, {say("margin{}", "")},  // of the price
                              {tr("time")},     {tr("made by"), Align::left}};
  std::vector<Row> rows;
  bool choice = false;
  for (const auto& price : list(part, "prices")) {
    rows.push_back(batch_row(price));
    choice = choice || !word(price, "made_by").empty();
  }
  if (!choice) {
    columns.pop_back();
    for (auto& row : rows) row.cells.pop_back();
  }
  return table(columns, rows);
}

std::string way_line(const ordered_json& way) {
  const auto& energy = object(way, "energy");
  const auto by = word(way, "made_by");
  return paragraph(
      "  ",
      say("{}{} kg of stock, {} kWh and {} kg of CO2 for a part; at least {} "
          "% of the parts conform{}",
          by.empty() ? "" : by + ": ", significant(number(way, "stock_kg"), 3),
          significant(number(energy, "kWh"), 2), significant(number(energy, "kg_CO2"), 2),
          shown(std::floor(1e4 * number(way, "conforming").value_or(0)) / 100, 2),
          flag(way, "proved") ? "" : tr("; not proved to be the cheapest")));
}

std::string quoted_part(const ordered_json& part) {
  auto text = fmt::format("\n{}\n", clipped(word(part, "name"), kPageWidth));
  if (word(part, "status") != "ok") text += tr("  no way to make it was found") + '\n';
  if (!list(part, "prices").empty()) text += batch_table(part);
  for (const auto& way : list(part, "ways")) text += way_line(way);
  for (const auto& a : list(part, "alternatives"))
    if (!flag(a, "feasible")) {
      const auto name = word(a, "name");
      text += paragraph("  ", (name.empty() ? "" : name + ": ") + word(a, "why"));
    }
  return text;
}

}  // namespace

std::string quote_text(const ordered_json& result) {
  const auto currency = word(result, "currency");
  auto text = tr("QUOTE") + '\n' +
              paragraph(tr("prices of one part  "),
                        currency.empty() ? tr("in the currency of the rates")
                                         : say("in {}", currency));
  for (const auto& part : list(result, "parts")) text += quoted_part(part);
  return text + made_by(result);
}

}  // namespace turnwright::report
