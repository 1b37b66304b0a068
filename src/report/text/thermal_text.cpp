#include <string>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "result_words.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string choice(const ordered_json& result) {
  const ordered_json& c = object(result, "choice");
  std::string text = say("{} lag(s) of the spindle", shown(number(c, "lags"), 0));
  const auto by = word(c, "by");
  if (by == "request") text += tr(", as requested");
  if (by == "too-few-rows") text += tr(", as the rows are too few to choose");
  if (by == "cross-validation")
    text += say(", chosen by blocks left out: RMS {} um with one, {} um with two",
                shown(number(c, "one_lag_um"), 2), shown(number(c, "two_lags_um"), 2));
  return paragraph('\n' + tr("MODEL  "), text);
}

/// "tau_1_s" -> "tau_1" and "s".
std::pair<std::string, std::string> name_and_unit(const std::string& key) {
  for (const auto& [suffix, unit] :
       {std::pair{"_um_K", "um/K"}, {"_um", "um"}, {"_s", "s"}})
    if (key.ends_with(suffix))
      return {key.substr(0, key.size() - std::string(suffix).size()), unit};
  return {key, ""};
}

std::string standing(const ordered_json& parameter) {
  auto found = word(parameter, "found");
  if (found == "unknown") return tr("nothing depends on it");
  if (found == "inside")
    found = flag(parameter, "ill_determined") ? tr("ill-determined") : "";
  return spoken(found);
}

std::string parameters(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& p : list(result, "parameters")) {
    const auto [name, unit] = name_and_unit(word(p, "name"));
    rows.push_back({{name, significant(number(p, "value")),
                     significant(number(p, "u"), 2), unit, standing(p)},
                    ""});
  }
  return table({{"", Align::left},
                {tr("value")},
                {tr("std. uncertainty")},
                {tr("unit"), Align::left},
                {tr("standing"), Align::left}},
               rows);
}

Row errors(const std::string& of, const ordered_json& e) {
  return {{of, shown(number(e, "rows"), 0), shown(number(e, "rms_um"), 2),
           shown(number(e, "mean_um"), 2), shown(number(e, "largest_um"), 2)},
          ""};
}

std::string residuals(const ordered_json& result) {
  const ordered_json& network = object(result, "network");
  std::vector<Row> rows{errors(tr("model, rows fitted"), object(result, "fitted")),
                        errors(tr("model, held out"), object(result, "held_out"))};
  if (!network.empty()) {
    rows.push_back(
        {{tr("network, rows fitted"), shown(number(object(result, "fitted"), "rows"), 0),
          shown(number(network, "rms_um"), 2), "-", "-"},
         ""});
    rows.push_back(errors(tr("network, held out"), object(network, "held_out")));
    rows.push_back(errors(tr("network, held out but like rows fitted"),
                          object(network, "held_out_inside")));
  }
  std::string out =
      '\n' + tr("ERRORS  measured less predicted, um") + '\n' +
      table({{"", Align::left}, {tr("rows")}, {tr("RMS")}, {tr("mean")}, {tr("largest")}},
            rows);
  return out + paragraph("  ", say("correlation of neighbouring residuals {}: "
                                   "near 1 the standard uncertainties are too small",
                                   shown(number(result, "autocorrelation"), 3)));
}

std::string shift(const ordered_json& result) {
  const ordered_json& s = object(result, "shift");
  if (s.empty()) return "";
  const auto &t = list(s, "time_s"), &e = list(s, "drift_um"), &u = list(s, "u_um");
  std::string out = '\n' + tr("SHIFT") + '\n';
  if (!t.empty() && t.size() == e.size() && t.size() == u.size()) {
    std::vector<Row> rows;
    constexpr std::size_t kMost = 12;  // rows of a long shift, its last among them
    const std::size_t step = (t.size() + kMost - 1) / kMost;
    const auto add = [&](std::size_t i) {
      rows.push_back({{significant(t[i].get<double>(), 7), shown(e[i].get<double>(), 2),
                       shown(u[i].get<double>(), 2)},
                      ""});
    };
    for (std::size_t i = 0; i + 1 < t.size(); i += step) add(i);
    add(t.size() - 1);
    out += table({{tr("time s")}, {tr("drift um")}, {tr("std. uncertainty")}}, rows);
  }
  const ordered_json& b = object(s, "batch");
  if (b.empty()) return out;
  return out +
         paragraph("  ", say("batch of {} parts: drift ranges over {} um, "
                             "between two offsets over {} um; largest step "
                             "from part to part {} um",
                             list(b, "time_s").size(), shown(number(b, "range_um"), 2),
                             shown(number(b, "between_offsets_um"), 2),
                             shown(number(b, "largest_step_um"), 2)));
}

}  // namespace

std::string thermal_text(const ordered_json& result) {
  return tr("THERMAL DRIFT") + '\n' + made_by(result) + choice(result) +
         parameters(result) + residuals(result) + shift(result) + warnings(result);
}

}  // namespace turnwright::report
