#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "amounts.hpp"
#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "result_words.hpp"
#include "text.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

// "2 x 5.5", or the depths of passes that differ: "4 x 2.1 .. 3.5".
std::string depths(const ordered_json& cut) {
  double low = INFINITY, high = 0;
  for (const auto& p : list(cut, "passes")) {
    low = std::min(low, number(p, "ap_mm").value_or(0));
    high = std::max(high, number(p, "ap_mm").value_or(0));
  }
  const auto least = significant(low, 3), most = significant(high, 3);
  return fmt::format("{} x {}", list(cut, "passes").size(),
                     least == most ? most : least + " .. " + most);
}

double minutes_of(const ordered_json& cut) {
  double sum = 0;
  for (const auto& p : list(cut, "passes")) sum += number(p, "time_min").value_or(0);
  return sum;
}

std::string broken(const ordered_json& l) {
  const auto name = planning::limit_words(word(l, "name")), unit = word(l, "unit");
  const auto value = significant(number(l, "value"), 3),
             limit = significant(number(l, "limit"), 3);
  return flag(l, "at_most")
             ? say("{}: {} {} where at most is {}", name, value, unit, limit)
             : say("{}: {} {} where at least is {}", name, value, unit, limit);
}

// Limits that the cut does not keep, and an edge that meets more in a corner.
std::string cut_note(const ordered_json& cut) {
  std::vector<std::string> told;
  for (const auto& l : list(cut, "limits"))
    if (!flag(l, "kept")) told.push_back(broken(l));
  return told.empty() ? "" : tr("NOT KEPT  ") + joined(told, "; ");
}

std::string cuts_table(const ordered_json& setup) {
  const std::vector<Column> columns{{tr("line")},
                                    {tr("on"), Align::left},
                                    {tr("what"), Align::left},
                                    {tr("tool"), Align::left},
                                    {"ap mm"},
                                    {"f mm/rev"},
                                    {"vc m/min"},
                                    {"Fc N"},
                                    {tr("most N")},
                                    {"kW"},
                                    {"s"}};
  std::vector<Row> rows;
  for (const auto& c : list(setup, "cuts")) {
    const auto& passes = list(c, "passes");
    rows.push_back(
        {{passes.empty() ? "-" : shown(number(passes.front(), "line"), 0), word(c, "on"),
          spoken(word(c, "kind")), word(c, "tool"), depths(c),
          significant(number(c, "f_mm_rev"), 3), shown(number(c, "vc_m_min"), 0),
          shown(number(c, "Fc_N"), 0), shown(number(c, "largest_Fc_N"), 0),
          shown(number(c, "Pc_kW"), 2), seconds(minutes_of(c))},
         cut_note(c)});
  }
  return rows.empty() ? tr("  no cut is followed") + '\n' : table(columns, rows);
}

// What is not known, the lines of one reason together.
std::string unknown_lines(const ordered_json& setup) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const auto& u : list(setup, "unknown")) {
    const double line = number(u, "line").value_or(0);
    const auto what =
        line > 0 ? say("line {} {}", shown(line, 0), word(u, "what")) : word(u, "what");
    const auto why = word(u, "why");
    auto it = std::ranges::find(reasons, why, &decltype(reasons)::value_type::first);
    if (it == reasons.end()) it = reasons.insert(it, {why, {}});
    it->second.push_back(what);
  }
  constexpr std::size_t kListed = 8;
  std::string text;
  for (auto& [why, where] : reasons) {
    const auto more = where.size() > kListed ? where.size() - kListed : 0;
    where.resize(where.size() - more);
    text += paragraph(tr("  UNKNOWN  "),
                      fmt::format("{} ({}{})", why, joined(where),
                                  more > 0 ? say(" and {} more", more) : ""));
  }
  return text;
}

std::string reviewed_setup(const ordered_json& setup) {
  const auto& m = object(setup, "minutes");
  const auto& spent = object(setup, "spent");
  auto text = say("\nSETUP {}\n", shown(number(setup, "setup").value_or(0) + 1, 0));
  text += cuts_table(setup);
  text += paragraph(
      "  ", say("{}, cost {}: cutting {}, beside it {}, tools {}, edges {}",
                duration(number(spent, "time_min")), money(number(spent, "cost")),
                duration(number(m, "cutting")), duration(number(m, "air")),
                duration(number(m, "tool_changes")), duration(number(m, "edges"))));
  for (const auto& r : list(setup, "rapids_in_material"))
    text += paragraph(tr("  NOT KEPT  "),
                      say("line {}: a rapid goes {} mm through material",
                          shown(number(r, "line"), 0), significant(number(r, "mm"), 2)));
  text += unknown_lines(setup);
  for (const auto& t : list(setup, "taken"))
    if (t.is_string()) text += paragraph(tr("  taken  "), t.get<std::string>());
  return text;
}

std::string sizes_table(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& s : list(result, "sizes")) {
    const auto& allowed = list(s, "allowed_mm");
    const auto end = [&](std::size_t i) {
      return allowed.size() == 2 ? shown(allowed[i].get<double>(), 3) : "-";
    };
    rows.push_back({{word(s, "on"), shown(number(s, "diameter_mm"), 3), end(0), end(1)},
                    number(s, "beyond_mm").value_or(0) > 0
                        ? say("beyond its limits by {} mm until its offset is set",
                              significant(number(s, "beyond_mm"), 2))
                        : ""});
  }
  if (rows.empty()) return "";
  return '\n' + tr("SIZES as programmed, without offsets and deflection [mm]") + '\n' +
         table({{tr("on"), Align::left}, {tr("diameter")}, {tr("from")}, {tr("to")}},
               rows);
}

std::string predicted_tolerances(const ordered_json& result) {
  const auto& predicted = object(result, "predicted");
  if (predicted.empty()) {
    std::string text = '\n' + tr("TOLERANCES are not predicted") + '\n';
    for (const auto& why : list(result, "not_predicted"))
      if (why.is_string()) text += paragraph("  ", why.get<std::string>());
    return text;
  }
  const auto ends = [](const ordered_json& t, const char* key) {
    if (const auto value = number(t, key)) return shown(value, 4);
    std::vector<std::string> all;
    for (const auto& x : list(t, key))
      if (x.is_number()) all.push_back(shown(x.get<double>(), 4));
    return joined(all, " .. ");
  };
  std::vector<Row> rows;
  for (const auto& t : list(predicted, "tolerances"))
    rows.push_back({{word(t, "id"), ends(t, "predicted_mm"), ends(t, "allowed_mm"),
                     spoken(word(t, "verdict"))},
                    ""});
  auto text =
      '\n' +
      tr("TOLERANCES as cut, with deflection, offsets set as the plan proposes [mm]") +
      '\n' +
      table({{tr("id"), Align::left},
             {tr("predicted"), Align::left},
             {tr("allowed"), Align::left},
             {tr("verdict"), Align::left}},
            rows);
  for (const auto& l : list(predicted, "limits"))
    text += paragraph(
        tr("  NOT KEPT  "),
        say("{}: {} {} {}, limit {}", word(l, "operation"),
            planning::limit_words(word(l, "name")), significant(number(l, "value"), 3),
            word(l, "unit"), significant(number(l, "limit"), 3)));
  return text;
}

std::string comparison(const ordered_json& result) {
  const auto& plan = object(result, "plan");
  if (plan.empty())
    return '\n' + tr("No plan of this part was found to compare with.") + '\n';
  const auto& spent = object(plan, "spent");
  double programs_min = 0, programs_cost = 0;
  for (const auto& s : list(result, "setups")) {
    programs_min += number(object(s, "spent"), "time_min").value_or(0);
    programs_cost += number(object(s, "spent"), "cost").value_or(0);
  }
  const auto made =
      say("{} takes {} and costs {} for the same setups, the programs {} and {}.",
          word(plan, "certificate") == "global" ? tr("The certified plan") : tr("A plan"),
          duration(number(spent, "time_min")), money(number(spent, "cost")),
          duration(programs_min), money(programs_cost));
  const auto whole = say(
      "With loading, setting up and stock it costs {} a part; nothing costs less than "
      "{}.",
      money(number(plan, "cost_per_part")), money(number(plan, "lower_bound")));
  return '\n' + tr("PLAN") + '\n' + paragraph("  ", made) + paragraph("  ", whole);
}

std::string corrected_programs(const ordered_json& result) {
  const auto& why_not = list(result, "not_corrected");
  std::string text;
  for (const auto& why : why_not)
    if (why.is_string()) text += paragraph("  ", why.get<std::string>());
  if (!text.empty()) return '\n' + tr("CORRECTED PROGRAMS cannot be given") + '\n' + text;
  const auto& corrected = object(result, "corrected");
  if (corrected.empty()) return "";
  const auto& spent = object(corrected, "spent");
  const auto& saves = object(corrected, "saves");
  text = '\n' + tr("CORRECTED PROGRAMS, words F and S changed") + '\n' +
         paragraph("  ", say("They take {} and cost {}, {} less{}.",
                             duration(number(spent, "time_min")),
                             money(number(spent, "cost")), money(number(saves, "cost")),
                             word(corrected, "status") == "kept"
                                 ? ""
                                 : tr(", and do not keep every limit")));
  std::vector<Row> rows;
  for (const auto& program : list(corrected, "programs"))
    for (const auto& w : list(program, "words"))
      rows.push_back({{significant(number(program, "setup").value_or(0) + 1, 3),
                       significant(number(w, "line"), 6), word(w, "was"), word(w, "is")},
                      ""});
  return text + table({{tr("setup")},
                       {tr("line")},
                       {tr("was"), Align::left},
                       {tr("is"), Align::left}},
                      rows);
}

}  // namespace

std::string review_text(const ordered_json& result) {
  auto text = say("REVIEW  {}\n", clipped(word(result, "name"), 80));
  for (const auto& s : list(result, "setups")) text += reviewed_setup(s);
  return text + sizes_table(result) + predicted_tolerances(result) + comparison(result) +
         corrected_programs(result) + made_by(result);
}

}  // namespace turnwright::report
