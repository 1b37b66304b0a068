#include <cmath>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "certificate_words.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "result_words.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string multipass_header(const ordered_json& result) {
  std::string out = tr("MULTI-PASS TURNING") + '\n';
  if (word(result, "status") != "ok")
    return out + paragraph(tr("status  "), spoken(word(result, "status")));
  out += paragraph(tr("cost    "),
                   say("{} per piece", significant(number(result, "UC"), 8)));
  if (const auto n = number(result, "n"))
    out += paragraph(tr("passes  "), say("{} roughing, 1 finishing", shown(n, 0)));
  if (const auto c = result.find("certificate"); c != result.end()) {
    out += paragraph(tr("bound   "), say("{}: no allowed point costs less",
                                         significant(number(*c, "lower_bound"), 8)));
    out += paragraph(tr("proof   "), proof(*c));
  }
  return out;
}

Row pass(const std::string& name, const ordered_json& x) {
  Row row{{name}, ""};
  for (const char* key : {"V", "f", "d", "T", "F_kgf", "P_kW", "Q_degC"})
    row.cells.push_back(significant(number(x, key), 6));
  return row;
}

std::string multipass_conditions(const ordered_json& result) {
  const auto& rough = object(result, "rough");
  if (!rough.empty())
    return '\n' + tr("CONDITIONS") + '\n' +
           table(
               {{"", Align::left},
                {"V m/min"},
                {"f mm/rev"},
                {"d mm"},
                {"T min"},
                {"F kgf"},
                {"P kW"},
                {"Q degC"}},
               {pass(tr("rough"), rough), pass(tr("finish"), object(result, "finish"))});
  if (!number(result, "V")) return "";
  return '\n' + tr("CONDITIONS") + '\n' +
         table(
             {{"V"}, {"f"}},
             {{{significant(number(result, "V"), 6), significant(number(result, "f"), 6)},
               ""}});
}

std::string binding(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& c : list(result, "constraints")) {
    if (!flag(c, "binding")) continue;
    const auto price = number(c, "price");
    const auto percent =
        price ? std::optional(100 * (std::pow(1.1, *price) - 1)) : std::nullopt;
    rows.push_back({{word(c, "name"), significant(number(c, "value"), 6),
                     significant(number(c, "limit"), 6), shown(percent, 3)},
                    ""});
  }
  if (rows.empty()) return "";
  return '\n' +
         tr("BINDING  and what 10 % more of the limit does to the cost, to first order") +
         '\n' +
         table({{tr("limit"), Align::left}, {tr("value")}, {tr("at")}, {tr("cost %")}},
               rows);
}

std::string counts(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& c : list(result, "per_pass_count"))
    rows.push_back({{shown(number(c, "n"), 0), significant(number(c, "UC"), 8),
                     significant(number(c, "lower_bound"), 8), spoken(word(c, "status"))},
                    ""});
  if (rows.empty()) return "";
  return '\n' + tr("PER NUMBER OF ROUGHING PASSES") + '\n' +
         table({{"n"}, {tr("cost")}, {tr("at least")}, {tr("status"), Align::left}},
               rows);
}

std::string multipass_conflicts(const ordered_json& result) {
  std::vector<std::string> names;
  for (const auto& c : list(result, "conflicts"))
    if (c.is_string()) names.push_back(c.get<std::string>());
  if (names.empty()) return "";
  std::string out =
      paragraph('\n' + tr("CONFLICT  "),
                say("{} cannot be kept together; without any one of them the others can",
                    joined(names)));
  std::vector<Row> rows;
  for (const auto& r : list(result, "relax"))
    rows.push_back({{word(r, "limit"), significant(number(r, "now"), 6),
                     number(r, "needed") ? significant(number(r, "needed"), 6)
                                         : tr("never suffices")},
                    ""});
  if (!rows.empty())
    out += table({{tr("opened alone"), Align::left}, {tr("now")}, {tr("needed")}}, rows);
  return out;
}

}  // namespace

std::string multipass_text(const ordered_json& result) {
  return multipass_header(result) + made_by(result) + multipass_conflicts(result) +
         multipass_conditions(result) + binding(result) + counts(result);
}

}  // namespace turnwright::report
