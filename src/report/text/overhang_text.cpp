#include <fmt/format.h>

#include <string>
#include <vector>

#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "stability_words.hpp"
#include "text.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string overhang_name(const ordered_json& overhang) {
  return significant(number(overhang, "overhang_mm"), 5) + " mm";
}

/// The cuts that stay stable, an overhang a row.
std::string overhang_limits(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& o : list(result, "overhangs")) {
    const auto& best = object(o, "best");
    rows.push_back(
        {{significant(number(o, "overhang_mm"), 5), significant(number(o, "least_mm"), 3),
          shown(number(best, "n_rpm"), 0), significant(number(best, "ap_mm"), 3)},
         word(o, "why")});
  }
  return table(
      {{tr("overhang mm")}, {tr("least limit mm")}, {tr("best 1/min")}, {tr("depth mm")}},
      rows);
}

std::string overhang_cuts(const ordered_json& result) {
  std::string out;
  for (const auto& o : list(result, "overhangs"))
    for (const auto& p : list(o, "points"))
      out += paragraph("  " + overhang_name(o) + "  ",
                       fmt::format("{} 1/min, {} mm: {}", shown(number(p, "n_rpm"), 0),
                                   significant(number(p, "ap_mm"), 3), verdict_words(p)));
  return out.empty() ? "" : '\n' + tr("REQUESTED CUTS") + '\n' + out;
}

std::string tip_modes(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& o : list(result, "overhangs"))
    for (const auto& tip : list(o, "tip"))
      for (const auto& m : list(tip, "modes"))
        rows.push_back({{significant(number(o, "overhang_mm"), 5), word(tip, "axis"),
                         shown(number(m, "frequency_Hz"), 1),
                         significant(number(m, "damping_ratio"), 3),
                         shown(number(m, "stiffness_N_mm"), 0)},
                        ""});
  if (rows.empty()) return "";
  return '\n' + tr("MODES AT THE TIP") + '\n' +
         table({{tr("overhang mm")},
                {tr("axis"), Align::left},
                {"Hz"},
                {tr("damping ratio")},
                {"N/mm"}},
               rows);
}

}  // namespace

std::string overhang_text(const ordered_json& result) {
  return tr("OVERHANG OF THE TOOL") + '\n' + made_by(result) + '\n' + tr("LIMITS") +
         '\n' + overhang_limits(result) + overhang_cuts(result) + tip_modes(result) +
         warnings(result) + assumption_lines(result);
}

}  // namespace turnwright::report
