#include <algorithm>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "result_words.hpp"
#include "text.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr double kUm = 1000;  // in a millimetre

Row estimate_row(const std::string& name, const ordered_json& e, double times,
                 const std::string& unit, int decimals) {
  const auto cell = [&](const char* key) {
    const auto x = number(e, key);
    return shown(x ? std::optional(times * *x) : x, decimals);
  };
  return {{name, cell("value"), cell("lower"), cell("upper"), unit}, ""};
}

std::string estimates(const ordered_json& c) {
  std::vector<Row> rows;
  const auto add = [&](const ordered_json& in, const char* key, const std::string& name,
                       double times, const std::string& unit, int decimals) {
    if (const auto& e = object(in, key); !e.empty())
      rows.push_back(estimate_row(name, e, times, unit, decimals));
  };
  add(c, "mean_mm", tr("mean"), 1, "mm", 5);
  const auto &within = object(c, "within"), &overall = object(c, "overall");
  add(within, "s_mm", tr("s from part to part"), kUm, "um", 2);
  add(overall, "s_mm", tr("s of all"), kUm, "um", 2);
  for (const char* key : {"Cp", "Cpk"}) add(within, key, key, 1, "", 2);
  for (const char* key : {"Pp", "Ppk"}) add(overall, key, key, 1, "", 2);
  add(c, "drift_mm_h", tr("drift"), kUm, "um/h", 2);
  add(c, "drift_mm_part", tr("drift"), kUm, tr("um per part"), 3);
  add(c, "wear_mm_part", tr("wear"), kUm, tr("um per part"), 3);
  const auto& jumps = list(object(c, "edges"), "jumps");
  constexpr std::size_t kMost = 8;  // of many edges the last
  for (std::size_t i = jumps.size() - std::min(kMost, jumps.size()); i < jumps.size();
       ++i)
    rows.push_back(estimate_row(say("jump to edge {}", word(jumps[i], "to")), jumps[i],
                                kUm, "um", 2));
  return table(
      {{"", Align::left}, {tr("value")}, {tr("from")}, {tr("to")}, {"", Align::left}},
      rows);
}

std::string advised(const ordered_json& c) {
  const auto& a = object(c, "advice");
  if (a.empty()) return "";
  const auto& by = object(a, "correction_mm");
  const auto um = [](const ordered_json& in, const char* key) {
    const auto mm = number(in, key);
    return shown(mm ? std::optional(units::um_from_mm(*mm)) : mm, 1);
  };
  std::string text =
      say("correct the size by {} um before the next part, standard uncertainty {} um",
          um(by, "value"), um(by, "u"));
  if (!flag(a, "worthwhile")) text += tr("; it may be nothing: better wait");
  if (const auto due = number(a, "due_in_parts"))
    text += *due > 0
                ? say("; the next correction is due after {} parts more", shown(due, 0))
            : number(a, "room_mm").value_or(0) > 0
                ? tr("; the next correction is due at the next part")
                : tr("; three standard deviations alone reach a limit");
  if (const auto edge = number(a, "edge_due_in_parts"))
    text += say("; the edge is changed in {} parts", shown(edge, 0));
  return paragraph(tr("  ADVICE  "), text);
}

std::string characteristic(const ordered_json& c) {
  std::string text = '\n' + say("{}  {} values", word(c, "id"), shown(number(c, "n"), 0));
  if (number(c, "left_out").value_or(0) > 0)
    text += say(", {} left out", shown(number(c, "left_out"), 0));
  text += '\n';
  if (c.contains("mean_mm")) text += estimates(c) + advised(c);
  for (const auto& sentence : list(c, "not_identified"))
    if (sentence.is_string())
      text += paragraph(tr("  not told  "), sentence.get<std::string>());
  return text;
}

std::string not_counted(const ordered_json& result) {
  const auto& all = list(result, "left_out");
  if (all.empty()) return "";
  std::string text = '\n' + tr("LEFT OUT") + '\n';
  for (const auto& v : all) text += paragraph("  ", word(v, "sentence"));
  return text;
}

Row factor_row(const ordered_json& f) {
  const auto &prior = object(f, "prior"), &post = object(f, "posterior");
  std::string name = word(f, "name");
  std::replace(name.begin(), name.end(), '_', ' ');
  name = spoken(name);
  if (!word(f, "by").empty()) name += say(" by {}", spoken(word(f, "by")));
  return {
      {name, significant(number(prior, "value"), 3), significant(number(prior, "u"), 2),
       significant(number(post, "value"), 3), significant(number(post, "lower"), 3),
       significant(number(post, "upper"), 3), word(f, "unit")},
      word(f, "not_identified")};
}

std::string factors(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& f : list(result, "factors")) rows.push_back(factor_row(f));
  if (rows.empty()) return "";
  std::vector<std::string> written;
  for (const auto& [name, document] : object(result, "documents").items())
    written.push_back(name);
  std::string text =
      '\n' + tr("FACTORS OF THE MODELS  by the documents, and with the measured parts") +
      '\n' +
      table({{"", Align::left},
             {tr("before")},
             {"+-"},
             {tr("now")},
             {tr("from")},
             {tr("to")},
             {tr("unit"), Align::left}},
            rows);
  if (!written.empty())
    text += paragraph(
        "  ", say("documents of the result (-o) for the next plan: {}", joined(written)));
  return text;
}

}  // namespace

std::string learn_text(const ordered_json& result) {
  std::string text = tr("MEASURED PARTS") + '\n' + made_by(result);
  for (const auto& c : list(result, "characteristics")) text += characteristic(c);
  return text + not_counted(result) + factors(result) + warnings(result);
}

}  // namespace turnwright::report
