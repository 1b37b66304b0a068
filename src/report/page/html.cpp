#include "html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/say.hpp"
#include "html_parts.hpp"
#include "report/picture/svg.hpp"
#include "report/text/amounts.hpp"
#include "report/text/certificate_words.hpp"
#include "report/text/json_fields.hpp"
#include "report/text/plan_words.hpp"
#include "report/text/result_words.hpp"
#include "report/text/setup_words.hpp"
#include "sheet_html.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string header(std::string_view name, const ordered_json& result) {
  const bool feasible = word(result, "status") != "infeasible";
  std::string out = tag("h1", name);
  if (const auto title = title_block(result); !title.empty())
    out += tag("p", say("Drawing {}", title));
  const bool bad = !feasible || keeps_too_few(result);
  auto status = feasible ? kept(result) : tr("infeasible: no plan keeps every limit");
  status[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(status[0])));
  out += "<p class=\"status" + std::string(bad ? " infeasible" : "") + "\">" +
         escaped(status) + "</p>\n";
  if (feasible) {
    out += "<dl>\n";
    out += key_figure(tr("Cost"), money_of(result, number(result, "cost_per_part")),
                      tr("per part"));
    out += key_figure(tr("Time"), duration(number(result, "time_per_part_min")),
                      tr("per part") + preparing(result));
    if (const auto profit = number(result, "profit_per_min"))
      out += key_figure(tr("Profit"), money_of(result, profit), tr("per minute"));
    const auto& worst = object(result, "worst_conformance");
    if (const auto p = number(worst, "P_conform"))
      out += key_figure(tr("Worst tolerance"), shown(100 * *p, 2),
                        say("% of the parts keep {}", word(worst, "tolerance")));
    out += "</dl>\n";
    if (const auto words = setting_up(result); !words.empty())
      out += tag("p", say("Preparing the machine: {}.", words));
  }
  if (const auto& c = object(result, "certificate"); !c.empty())
    out += tag("p", say("Proof: {}.", proof(c)));
  return out + origin(result);
}

// Where time and cost per part go, what prepares the machine apart.
std::string breakdown(const ordered_json& result) {
  const auto rows = spending(result);
  if (rows.empty()) return "";
  std::string out =
      tag("h2", tr("Time and cost")) +
      table_head(
          {{tr("spent on"), "", false}, {tr("time"), "s"}, {tr("cost"), tr("per part")}});
  for (const auto& r : rows)
    out += "<tr>" + words_cell(r.name) + number_cell(seconds(r.time_min)) +
           number_cell(money(r.cost)) + "</tr>\n";
  return out + kTableFoot;
}

// The first run has the operation's name, time and cost; the last is followed by its
// note.
std::string operation_rows(const ordered_json& operation) {
  const auto all = runs(list(operation, "passes"));
  const auto& certificate = object(operation, "certificate");
  std::string out;
  for (std::size_t i = 0; i < std::max<std::size_t>(all.size(), 1); ++i) {
    const bool first = i == 0;
    out += "<tr class=\"first\">" + words_cell(first ? word(operation, "id") : "") +
           words_cell(first ? word(operation, "tool") : "");
    static const ordered_json kNone = ordered_json::object();
    const auto& pass = i < all.size() ? *all[i].first : kNone;
    out += number_cell(i < all.size() ? std::to_string(all[i].count) : "-") +
           number_cell(shown(number(pass, "ap_mm"), 3)) +
           number_cell(shown(number(pass, "f_mm_rev"), 3)) +
           number_cell(shown(number(pass, "vc_m_min"), 1)) +
           number_cell(i < all.size() ? speeds(all[i]) : "-") +
           number_cell(first ? seconds(number(operation, "time_min")) : "") +
           number_cell(first ? money(number(operation, "cost")) : "") +
           number_cell(first ? gap(certificate) : "") + "</tr>\n";
  }
  return out + "<tr><td class=\"note\" colspan=\"10\">" + escaped(note(operation)) +
         "</td></tr>\n";
}

std::string operations(const ordered_json& all) {
  if (all.empty()) return tag("p", tr("No operations."));
  std::string out = table_head({{tr("operation"), "", false},
                                {tr("tool"), "", false},
                                {tr("passes"), ""},
                                {"ap", "mm"},
                                {"f", "mm/rev"},
                                {"vc", "m/min"},
                                {"n", "1/min"},
                                {tr("time"), "s"},
                                {tr("cost"), tr("per part")},
                                {tr("gap"), ""}});
  for (const auto& operation : all) out += operation_rows(operation);
  return out + kTableFoot;
}

// Where no sheet has them.
std::string setup_figures(const ordered_json& result, const Figures& figures) {
  std::string out;
  for (std::size_t i = 1; i <= list(result, "setups").size(); ++i)
    out += figure_named(figures, fmt::format("setup-{}.svg", i),
                        say("Setup {}: the part, its clamping and its deviations", i));
  return out;
}

std::string setups(const ordered_json& result) {
  std::string out;
  const bool feasible = word(result, "status") != "infeasible";
  std::size_t index = 0;
  for (const auto& setup : list(result, "setups")) {
    out +=
        tag("h2", say("Setup {}", ++index)) + tag("p", say("Hold {}.", holding(setup)));
    std::string rejected;
    for (const auto& r : list(setup, "rejected"))
      rejected +=
          tag("li", say("not {}: {}", spoken(word(r, "clamping")), word(r, "why")));
    if (!rejected.empty()) out += "<ul>\n" + rejected + "</ul>\n";
    if (!feasible && !list(setup, "operations").empty())
      out +=
          "<p class=\"bad\">" +
          escaped(tr("Conditions that come closest; they break limits, do not cut with "
                     "them.")) +
          "</p>\n";
    out += operations(list(setup, "operations"));
  }
  return out;
}

/// How much of the width is used, as a bar.
std::string used_cell(const ordered_json& tolerance) {
  const auto width = number(tolerance, "width_mm");
  if (!width || !(*width > 0)) return words_cell("-");
  const Stack stack = stack_of(tolerance);
  const double used = 1 - stack.left_um / units::um_from_mm(*width);
  const double shown_width = 60 * std::clamp(used, 0.0, 1.0);
  return fmt::format(
      "<td class=\"n\">{} % <svg width=\"60\" height=\"7\" aria-hidden=\"true\">"
      "<rect width=\"60\" height=\"7\" fill=\"#e3e6ea\"/>"
      "<rect width=\"{:.2f}\" height=\"7\" fill=\"{}\"/></svg></td>",
      shown(100 * used, 0), shown_width, stack.over() ? "#b00d26" : "#3a4654");
}

std::string tolerances(const ordered_json& result, const Figures& figures) {
  const auto& all = list(result, "tolerances");
  if (all.empty()) return "";
  const bool differ = published_differ(all);
  std::vector<Heading> headings{{tr("id"), "", false},
                                {tr("kind"), "", false},
                                {tr("of"), "", false},
                                {tr("predicted"), "\u00b5m"},
                                {tr("allowed"), "\u00b5m"},
                                {tr("margin"), "\u00b5m"},
                                {tr("used"), tr("of the width")},
                                {tr("kept by"), tr("% of the parts")},
                                {tr("verdict"), "", false}};
  if (differ) headings.push_back({tr("published"), "", false});
  std::string out = tag("h2", tr("Tolerances")) + table_head(headings);
  for (const auto& t : all) {
    const bool met = word(t, "verdict") != "not-met";
    out += "<tr>" + words_cell(word(t, "id")) + words_cell(kind_words(word(t, "kind"))) +
           words_cell(word(t, "of")) + number_cell(micrometres(t, "predicted_mm")) +
           number_cell(micrometres(t, "allowed_mm")) +
           number_cell(micrometres(t, "margin_mm")) + used_cell(t) +
           number_cell(kept_by(t)) +
           (met ? words_cell(verdict(t))
                : "<td class=\"bad\">" + escaped(verdict(t)) + "</td>") +
           (differ ? words_cell(other_verdict(t)) : "") + "</tr>\n";
  }
  return out + kTableFoot + "<p class=\"from\">" +
         tr("offset: met with the tool's offset or corrected path") +
         (differ ? tr("; published: by the published acceptance equations, where they "
                      "differ")
                 : "") +
         "</p>\n" +
         figure_named(figures, "budget.svg", tr("What takes each tolerance's width"));
}

// Of the operations that cost most; the others' pictures stand alone.
std::string windows(const ordered_json& result, const Figures& figures) {
  constexpr std::size_t kMost = 4;
  std::vector<std::pair<double, std::string>> shown_first;
  for (const auto& setup : list(result, "setups"))
    for (const auto& o : list(setup, "operations"))
      shown_first.emplace_back(-number(o, "cost").value_or(0), word(o, "id"));
  std::stable_sort(shown_first.begin(), shown_first.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string out;
  std::size_t count = 0;
  for (const auto& [cost, id] : shown_first) {
    const auto one =
        figure_named(figures, "window-" + id + ".svg", say("Speeds and feeds of {}", id));
    if (one.empty() || ++count > kMost) continue;
    out += one;
  }
  if (out.empty()) return "";
  return tag("h2", tr("Windows of speed and feed: the operations that cost most")) + out;
}

// Of every milled place: how deep it may be cut over the spindle's speeds.
std::string stability(const ordered_json& result, const Figures& figures) {
  std::string out;
  for (const auto& setup : list(result, "setups"))
    for (const auto& o : list(setup, "operations"))
      out += figure_named(figures, "stability-" + word(o, "id") + ".svg",
                          say("Stable depth over speed of {}", word(o, "id")));
  return out.empty() ? "" : tag("h2", tr("Stability of milled places")) + out;
}

std::string offsets(const ordered_json& result) {
  std::string rows;
  for (const auto& o : list(result, "offsets"))
    rows += "<tr>" + words_cell(word(o, "on")) + number_cell(setup_number(o)) +
            number_cell(shown(units::um_from_mm(number(o, "offset_mm").value_or(0)), 1)) +
            "</tr>\n";
  if (rows.empty()) return "";
  return tag("h2", tr("Offsets: every pass is moved to the middle of the size")) +
         table_head(
             {{tr("on"), "", false}, {tr("setup"), ""}, {tr("offset"), "\u00b5m"}}) +
         rows + kTableFoot + "<p class=\"from\">" +
         tr("on the radius, or along the axis; the first part shows what is still "
            "missing") +
         "</p>\n";
}

std::string compensation(const ordered_json& result) {
  std::string rows;
  for (const auto& c : list(result, "compensation")) {
    std::string table;
    for (const auto& row : list(c, "table_mm"))
      if (row.is_array() && row.size() == 2 && row[0].is_number() && row[1].is_number())
        table += fmt::format("{}{}: {}", table.empty() ? "" : "; ",
                             shown(row[0].get<double>(), 2),
                             shown(units::um_from_mm(row[1].get<double>()), 2));
    rows += "<tr>" + words_cell(word(c, "on")) + number_cell(setup_number(c)) +
            words_cell(table) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return tag("h2", tr("Compensation: add dr to the radius of the tool path at z")) +
         table_head({{tr("on"), "", false},
                     {tr("setup"), ""},
                     {"z: dr", "mm: \u00b5m", false}}) +
         rows + kTableFoot;
}

std::string prices(const ordered_json& result) {
  constexpr std::size_t kMost = 12;
  auto sentences = sentences_of(list(result, "prices"));
  const auto all = sentences.size();
  if (all > kMost) sentences.resize(kMost);
  auto out =
      section(tr("Prices: what relaxing each limit by 10 % would save, to first order"),
              sentences);
  if (all > kMost)
    out += "<p class=\"from\">" +
           say("{} smaller ones are in the result document.", all - kMost) + "</p>\n";
  return out;
}

}  // namespace

std::string html(std::string_view name, const ordered_json& result,
                 const Figures& figures, const std::vector<SetupSheet>& sheets) {
  const bool feasible = word(result, "status") != "infeasible";
  std::string out = header(name, result);
  out += section(tr("Conflicts: limits that cannot be kept together"),
                 conflict_sentences(result));
  if (!feasible)
    out +=
        section(several_sets(list(result, "relax"))
                    ? tr("Limits to relax: one of every set, the smallest change first")
                    : tr("Limits to relax: the smallest change first"),
                opening_sentences(result));
  if (const auto stays = what_stays(result); !stays.empty()) out += tag("p", stays);
  out += section(tr("Other changes, each line of which alone makes the part feasible"),
                 sentences_of(list(result, "remedies")));
  out += breakdown(result) + (sheets.empty() ? setup_figures(result, figures) : "") +
         setups(result) + tolerances(result, figures) + prices(result) +
         section(tr("What if: planned anew with a change"),
                 sentences_of(list(result, "what_if"))) +
         section(tr("Rules of the shop: the part planned without each"),
                 sentences_of(list(result, "rules"))) +
         section(tr("Alternatives: each way, planned"),
                 sentences_of(list(result, "alternatives"))) +
         offsets(result) + compensation(result) + stability(result, figures) +
         windows(result, figures) + assumptions(result);
  for (const auto& sheet : sheets) out += sheet_html(sheet, figures);
  return page(say("{} - process plan", name), out);
}

}  // namespace turnwright::report
