#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/say.hpp"
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
           significant(number(e, "upper"), 5), flag(e, "given") ? tr("as given") : ""},
          ""};
}

std::string left_out(const ordered_json& group) {
  std::vector<std::string> cuts;
  for (const auto& i : list(group, "outliers"))
    if (i.is_number()) cuts.push_back(shown(i.get<double>(), 0));
  return cuts.empty() ? "" : say("; left out as outliers: cuts {}", joined(cuts));
}

std::string group(const ordered_json& result, const char* key, const std::string& title) {
  const auto& g = object(result, key);
  if (g.empty()) return "";
  std::vector<Row> rows;
  for (const auto& [name, value] : g.items())
    if (value.is_object() && value.contains("value"))
      rows.push_back(constant(name, value));
  return fmt::format("\n{}\n", title) +
         paragraph("  ", say("{} cuts, {} degrees of freedom, residual scatter {} %{}",
                             shown(number(g, "cuts"), 0),
                             shown(number(g, "degrees_of_freedom"), 0),
                             shown(number(g, "s_pct"), 2), left_out(g))) +
         table({{"", Align::left},
                {tr("value")},
                {tr("from")},
                {tr("to")},
                {"", Align::left}},
               rows);
}

// 14.2 (11.9 to 16.4) min
std::string minutes(const ordered_json& edges, const char* key) {
  const auto& e = object(edges, key);
  return say("{} min ({} to {})", significant(number(e, "value"), 3),
             significant(number(e, "lower"), 3), significant(number(e, "upper"), 3));
}

// How the lives of edges scatter.
std::string edges(const ordered_json& result) {
  const auto& life = object(result, "taylor");
  const auto& e = object(life, "edges");
  if (e.empty()) return "";
  const auto& at = object(e, "at");
  std::string text = paragraph(
      "  ",
      say("half of the edges reach {}, 90 % of them {}, at vc {} m/min, f {} "
          "mm/rev, ap {} mm",
          minutes(e, "T50_min"), minutes(e, "T90_min"),
          significant(number(at, "vc_m_min"), 3), significant(number(at, "f_mm_rev"), 3),
          significant(number(at, "ap_mm"), 3)));
  const bool weibull = word(e, "distribution") == "weibull";
  text += paragraph(
      "  ",
      (weibull ? tr("their lives are likelier Weibull's than lognormal")
               : tr("their lives are likelier lognormal than Weibull's")) +
          say("; Weibull's shape is {}", significant(number(e, "weibull_shape"), 3)));
  if (const auto& s = object(e, "scatter_pct"); !s.empty())
    text += paragraph(
        "  ", say("edges at equal conditions scatter by {} % ({} to {}), lack of "
                  "fit {} %",
                  shown(number(s, "value"), 1), shown(number(s, "lower"), 1),
                  shown(number(s, "upper"), 1), shown(number(e, "lack_of_fit_pct"), 1)));
  if (const auto n = number(life, "censored"))
    text += paragraph("  ", say("longer than their test: {} lives", shown(n, 0)));
  return text;
}

std::string labs(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& lab : list(result, "labs"))
    for (const auto& [name, factor] : lab.items())
      if (factor.is_object()) {
        Row row = constant(name, factor);
        row.cells.insert(row.cells.begin(), word(lab, "lab"));
        row.cells.back() = shown(number(factor, "cuts"), 0);
        rows.push_back(row);
      }
  if (rows.empty()) return "";
  return '\n' + tr("LABS") + '\n' +
         table({{"", Align::left},
                {"", Align::left},
                {tr("factor")},
                {tr("from")},
                {tr("to")},
                {tr("cuts")}},
               rows);
}

// Errors of cuts that the others predict.
std::string replicas(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& l : list(result, "left_out_replicas"))
    rows.push_back(
        {{word(l, "replica"), shown(number(l, "Fc_rms_pct"), 1),
          shown(number(l, "Ff_rms_pct"), 1), shown(number(l, "Fp_rms_pct"), 1)},
         ""});
  if (rows.empty()) return "";
  return '\n' + tr("REPLICAS PREDICTED FROM THE OTHERS, rms error in %") + '\n' +
         table({{"", Align::left}, {"Fc"}, {"Ff"}, {"Fp"}}, rows);
}

std::string material(const ordered_json& result) {
  const auto& m = object(result, "material");
  if (m.empty()) return "";
  return paragraph('\n' + tr("MATERIAL  "),
                   say("{} ({}) stands whole in the result document, under "
                       "material",
                       word(m, "id"), word(m, "name")));
}

}  // namespace

std::string material_text(const ordered_json& result) {
  const auto confidence = number(result, "confidence");
  return tr("MATERIAL FROM MEASURED CUTS") + '\n' + made_by(result) +
         paragraph("  ",
                   say("intervals hold with a confidence of {} %",
                       shown(confidence ? std::optional(100 * *confidence) : std::nullopt,
                             1))) +
         group(result, "cutting", tr("CUTTING FORCE")) +
         group(result, "feed", tr("FEED FORCE")) +
         group(result, "passive", tr("PASSIVE FORCE")) +
         group(result, "taylor", tr("TOOL LIFE")) + edges(result) +
         group(result, "roughness", tr("ROUGHNESS")) + labs(result) + replicas(result) +
         material(result) + warnings(result);
}

}  // namespace turnwright::report
