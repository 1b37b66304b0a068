#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "amounts.hpp"
#include "base/say.hpp"
#include "certificate_words.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "plan_words.hpp"
#include "provenance.hpp"
#include "result_words.hpp"
#include "setup_words.hpp"
#include "setups.hpp"
#include "stack.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string header(const ordered_json& result) {
  const auto name = word(result, "name");
  std::string out = name.empty() ? tr("PROCESS PLAN") + '\n'
                                 : paragraph(tr("PROCESS PLAN") + "  ", name);
  if (const auto title = title_block(result); !title.empty())
    out += paragraph(tr("drawing "), title);
  if (word(result, "status") == "infeasible") {
    out += paragraph(tr("status  "), tr("infeasible"));
    if (const auto c = result.find("certificate"); c != result.end())
      out += paragraph(tr("proof   "), proof(*c));
  } else {
    out += paragraph(tr("status  "), kept(result));
    out +=
        paragraph(tr("cost    "),
                  say("{} per part", money_of(result, number(result, "cost_per_part"))));
    out += paragraph(tr("time    "),
                     say("{} per part", duration(number(result, "time_per_part_min"))) +
                         preparing(result));
    if (const auto profit = number(result, "profit_per_min"))
      out += paragraph(tr("profit  "), say("{} per minute", money_of(result, profit)));
    if (const auto words = setting_up(result); !words.empty())
      out += paragraph(tr("set up  "), words);
    const auto certificate = result.find("certificate");
    if (certificate != result.end())
      out += paragraph(tr("proof   "), proof(*certificate));
  }
  return out + made_by(result);
}

// Where time and cost per part go, what prepares the machine apart.
std::string breakdown(const ordered_json& result) {
  const auto rows = spending(result);
  if (rows.empty()) return "";
  std::vector<Row> lines;
  for (const auto& r : rows)
    lines.push_back({{r.name, seconds(r.time_min), money(r.cost)}, ""});
  return '\n' + tr("TIME AND COST  per part") + '\n' +
         table({{"", Align::left}, {"s"}, {tr("cost")}}, lines);
}

// One sentence of each member, in the order of importance.
std::string numbered(const std::vector<std::string>& sentences) {
  std::string out;
  std::size_t i = 0;
  for (const auto& sentence : sentences)
    out += paragraph(fmt::format("{:3}. ", ++i), sentence);
  return out;
}

std::string conflicts(const ordered_json& result) {
  const auto sentences = conflict_sentences(result);
  if (sentences.empty()) return "";
  return '\n' + tr("CONFLICTS  limits that cannot be kept together") + '\n' +
         numbered(sentences);
}

std::string relaxations(const ordered_json& result) {
  if (word(result, "status") != "infeasible") return "";
  const bool several = several_sets(list(result, "relax"));
  const auto out =
      '\n' +
      (several ? tr("LIMITS TO RELAX  one of every set, the smallest change first")
               : tr("LIMITS TO RELAX  the smallest change first")) +
      '\n';
  const auto sentences = opening_sentences(result);
  if (sentences.empty())
    return out + tr("  No limit was found whose relaxation alone helps; the other "
                    "changes tried "
                    "are listed below.\n");
  const auto stays = what_stays(result);
  return out + numbered(sentences) + (stays.empty() ? "" : paragraph("  ", stays));
}

std::string remedies(const ordered_json& result) {
  const auto& all = list(result, "remedies");
  std::string out;
  if (!all.empty())
    out = '\n' + tr("OTHER CHANGES  each line alone makes the part feasible") + '\n' +
          numbered(sentences_of(all));
  const auto& tried = list(result, "tried");
  if (!tried.empty())
    out += '\n' + tr("TRIED WITHOUT SUCCESS  each alone") + '\n' +
           numbered(sentences_of(tried));
  return out;
}

std::string tolerances(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& t : list(result, "tolerances")) {
    const auto published = other_verdict(t);
    rows.push_back({{word(t, "id"), kind_words(word(t, "kind")), word(t, "of"),
                     micrometres(t, "predicted_mm"), micrometres(t, "allowed_mm"),
                     micrometres(t, "margin_mm"), kept_by(t), verdict(t)},
                    published.empty()
                        ? ""
                        : say("by the published acceptance equations: {}", published)});
  }
  if (rows.empty()) return "";
  return '\n' + tr("TOLERANCES") + '\n' +
         paragraph("  ", tr("predicted, allowed and margin in \u00b5m; kept: by so many "
                            "of the parts; "
                            "offset: met with the tool's offset or corrected path")) +
         table({{tr("id"), Align::left},
                {tr("kind"), Align::left},
                {tr("of"), Align::left},
                {tr("predicted")},
                {tr("allowed")},
                {tr("margin")},
                {tr("kept %")},
                {tr("verdict"), Align::left}},
               rows);
}

// A column a source, and what is left.
std::string budget(const ordered_json& result) {
  std::vector<const ordered_json*> tolerances;
  std::vector<Stack> stacks;
  for (const auto& t : list(result, "tolerances"))
    if (t.contains("width_mm")) {
      tolerances.push_back(&t);
      stacks.push_back(stack_of(t));
    }
  if (stacks.empty()) return "";
  const auto all = sources(stacks);
  std::vector<Column> columns{{tr("id"), Align::left}, {tr("width")}};
  for (const auto& source : all) columns.push_back({clipped(spoken(source), 11)});
  columns.push_back({say("left{}", "")});  // what remains, not the side
  std::vector<Row> rows;
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    Row row{{word(*tolerances[i], "id"), micrometres(*tolerances[i], "width_mm")}, ""};
    for (const auto& source : all) {
      double um = 0;
      for (const auto& [name, taken] : stacks[i].slices)
        if (name == source) um += taken;
      row.cells.push_back(um > 0 ? shown(um, 1) : "");
    }
    row.cells.push_back(shown(stacks[i].left_um, 1));
    rows.push_back(std::move(row));
  }
  return '\n' + tr("BUDGET") + '\n' +
         paragraph(
             "  ",
             tr("what uses up each tolerance's width, \u00b5m; independent sources add "
                "by "
                "squares, so all shares but the deflection are scaled down in proportion "
                "until the row adds up to the width")) +
         table(columns, rows);
}

// The rows [z, dr] laid across the page, so many at a time.
std::string across(const ordered_json& rows) {
  constexpr std::size_t kAbreast = 9;
  std::string out;
  for (std::size_t i = 0; i < rows.size(); i += kAbreast) {
    std::vector<Column> columns{{"z mm", Align::left}};
    Row correction{{"dr \u00b5m"}, ""};
    for (std::size_t k = i; k < std::min(i + kAbreast, rows.size()); ++k) {
      const auto& row = rows[k];
      if (!row.is_array() || row.size() != 2 || !row[0].is_number() ||
          !row[1].is_number())
        continue;
      columns.push_back({shown(row[0].get<double>(), 2)});
      correction.cells.push_back(shown(units::um_from_mm(row[1].get<double>()), 2));
    }
    out += table(columns, {correction});
  }
  return out;
}

std::string offsets(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& o : list(result, "offsets")) {
    const double um = units::um_from_mm(number(o, "offset_mm").value_or(0));
    rows.push_back({{word(o, "on"), setup_number(o), shown(um, 1)}, ""});
  }
  if (rows.empty()) return "";
  return '\n' + tr("OFFSETS") + '\n' +
         paragraph(
             "  ",
             tr("\u00b5m on the radius, or along the axis, by which every pass over the "
                "surface is moved to the middle of its size; the first part shows what "
                "is still missing")) +
         table({{tr("on"), Align::left}, {tr("setup")}, {tr("offset")}}, rows);
}

std::string compensation(const ordered_json& result) {
  std::string out;
  for (const auto& c : list(result, "compensation"))
    out += paragraph("  ", say("{} in setup {}", word(c, "on"), setup_number(c))) +
           across(list(c, "table_mm"));
  if (out.empty()) return "";
  return '\n' + tr("COMPENSATION  add dr to the radius of the tool path at z") + '\n' +
         out;
}

std::string prices(const ordered_json& result) {
  constexpr std::size_t kMost = 8;
  const auto& all = list(result, "prices");
  if (all.empty()) return "";
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i)
    sentences.push_back(sentence_of(all[i]));
  std::string out =
      '\n' + tr("PRICES  what relaxing each limit by 10 % would save, to first order") +
      '\n' + numbered(sentences);
  if (all.size() > kMost)
    out += "  " + say("{} smaller ones are in the result document.", all.size() - kMost) +
           '\n';
  return out;
}

std::string what_if(const ordered_json& result) {
  const auto& all = list(result, "what_if");
  if (all.empty()) return "";
  return '\n' + tr("WHAT IF  planned anew with a change") + '\n' +
         numbered(sentences_of(all));
}

std::string rules(const ordered_json& result) {
  const auto& all = list(result, "rules");
  if (all.empty()) return "";
  return '\n' + tr("RULES  of the shop, the part planned without each") + '\n' +
         numbered(sentences_of(all));
}

// The chosen combination, then the others by cost, those without a plan last.
ordered_json by_cost(ordered_json all) {
  const auto place = [](const ordered_json& a) {
    const bool chosen = a.value("chosen", false), feasible = a.value("feasible", false);
    return std::tuple(!chosen, !feasible, number(a, "cost_per_part").value_or(0));
  };
  std::stable_sort(
      all.begin(), all.end(),
      [&](const ordered_json& a, const ordered_json& b) { return place(a) < place(b); });
  return all;
}

std::string alternatives(const ordered_json& result) {
  constexpr std::size_t kShown = 10;
  const auto& all = list(result, "alternatives");
  if (all.empty()) return "";
  auto sentences = sentences_of(all);
  std::string more;
  if (all.size() > kShown) {
    sentences = sentences_of(by_cost(all));
    sentences.resize(kShown);
    more = "  " + say("and {} more, in the result as JSON", all.size() - kShown) + '\n';
  }
  return '\n' + tr("ALTERNATIVES  each way, planned") + '\n' + numbered(sentences) + more;
}

}  // namespace

std::string text(const ordered_json& plan_result) {
  return header(plan_result) + breakdown(plan_result) + conflicts(plan_result) +
         relaxations(plan_result) + remedies(plan_result) + setups(plan_result) +
         tolerances(plan_result) + budget(plan_result) + offsets(plan_result) +
         compensation(plan_result) + prices(plan_result) + what_if(plan_result) +
         rules(plan_result) + alternatives(plan_result) + assumption_lines(plan_result);
}

}  // namespace turnwright::report
