#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string um_of(const ordered_json& of, const char* key) {
  return shown(number(of, key), 2);
}

/// A value of the axis for both directions together, and for each.
Row of_axis(const ordered_json& values, const std::string& name, const std::string& key) {
  const auto um = [&](const char* direction) {
    return um_of(values, (key + direction + "_um").c_str());
  };
  return {{name, key, um(""), um("_plus"), um("_minus")}, ""};
}

std::string axis_values(const ordered_json& result) {
  const auto& values = object(result, "iso230_2");
  const std::vector<Row> rows{
      of_axis(values, tr("accuracy"), "A"),
      of_axis(values, tr("repeatability of positioning"), "R"),
      of_axis(values, tr("systematic deviation"), "E"),
      of_axis(values, tr("mean deviation"), "M"),
      of_axis(values, tr("reversal, largest"), "B"),
      {{tr("reversal, mean"), "B", um_of(values, "B_mean_um"), "-", "-"}, ""}};
  return '\n' + tr("OF THE AXIS  um, moving both ways, in + and in -") + '\n' +
         table({{"", Align::left}, {"", Align::left}, {tr("both")}, {"+"}, {"-"}}, rows);
}

std::string at_positions(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& p : list(result, "positions"))
    rows.push_back({{shown(number(p, "q_mm"), 3), shown(number(p, "approaches_plus"), 0),
                     shown(number(p, "approaches_minus"), 0), um_of(p, "mean_plus_um"),
                     um_of(p, "mean_minus_um"), um_of(p, "s_plus_um"),
                     um_of(p, "s_minus_um"), um_of(p, "B_um"), um_of(p, "R_um")},
                    ""});
  if (rows.empty()) return "";
  return '\n' +
         tr("AT EACH POSITION  n approaches, mean x and standard deviation s in um") +
         '\n' +
         table({{tr("at mm")},
                {"n+"},
                {"n-"},
                {"x+"},
                {"x-"},
                {"s+"},
                {"s-"},
                {"B"},
                {"R"}},
               rows);
}

std::string written_file(const ordered_json& result) {
  const auto& file = object(result, "comp_file");
  if (file.empty()) return "";
  return '\n' + tr("COMPENSATION FILE  of LinuxCNC") + '\n' +
         paragraph("  ", say("{} rows in {}, COMP_FILE_TYPE = {}",
                             list(result, "positions").size(), word(file, "unit"),
                             shown(number(file, "type"), 0)));
}

}  // namespace

std::string positioning_text(const ordered_json& result) {
  return say("POSITIONING  axis {}, ISO 230-2", word(result, "axis")) + '\n' +
         made_by(result) + axis_values(result) + at_positions(result) +
         written_file(result) + warnings(result);
}

}  // namespace turnwright::report
