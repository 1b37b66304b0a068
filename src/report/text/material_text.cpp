#include <fmt/format.h>

#include <string>
#include <vector>

#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

// A constant with its interval, or as it was given.
Row constant(const std::string& key, const ordered_json& e) {
  return {{key, significant(number(e, "value"), 5), significant(number(e, "lower"), 5),
           significant(number(e, "upper"), 5), flag(e, "given") ? "as given" : ""},
          ""};
}

std::string left_out(const ordered_json& group) {
  std::vector<std::string> cuts;
  for (const auto& i : list(group, "outliers"))
    if (i.is_number()) cuts.push_back(shown(i.get<double>(), 0));
  return cuts.empty() ? "" : "; left out as outliers: cuts " + joined(cuts);
}

std::string group(const ordered_json& result, const char* key, const char* title) {
  const auto& g = object(result, key);
  if (g.empty()) return "";
  std::vector<Row> rows;
  for (const auto& [name, value] : g.items())
    if (value.is_object() && value.contains("value"))
      rows.push_back(constant(name, value));
  return fmt::format("\n{}\n", title) +
         paragraph("  ",
                   fmt::format("{} cuts, {} degrees of freedom, residual scatter {} %{}",
                               shown(number(g, "cuts"), 0),
                               shown(number(g, "degrees_of_freedom"), 0),
                               shown(number(g, "s_pct"), 2), left_out(g))) +
         table({{"", Align::left}, {"value"}, {"from"}, {"to"}, {"", Align::left}}, rows);
}

std::string material(const ordered_json& result) {
  const auto& m = object(result, "material");
  if (m.empty()) return "";
  return paragraph("\nMATERIAL  ",
                   fmt::format("{} ({}) stands whole in the result document, under "
                               "material",
                               word(m, "id"), word(m, "name")));
}

}  // namespace

std::string material_text(const ordered_json& result) {
  const auto confidence = number(result, "confidence");
  return "MATERIAL FROM MEASURED CUTS\n" + made_by(result) +
         paragraph(
             "  ",
             "intervals hold with a confidence of " +
                 shown(confidence ? std::optional(100 * *confidence) : std::nullopt, 1) +
                 " %") +
         group(result, "cutting", "CUTTING FORCE") + group(result, "feed", "FEED FORCE") +
         group(result, "passive", "PASSIVE FORCE") +
         group(result, "taylor", "TOOL LIFE") + material(result) + warnings(result);
}

}  // namespace turnwright::report
