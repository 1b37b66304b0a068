#include "turnwright/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fields.hpp"
#include "layout.hpp"
#include "plan_words.hpp"
#include "proof.hpp"
#include "setup_words.hpp"
#include "svg.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;
using Figures = std::vector<Figure>;

constexpr const char* kStyle = R"css(
@page { size: A4; margin: 12mm }
body { max-width: 186mm; margin: 10mm auto; padding: 0 4mm; color: #1a1d21;
  font: 8.5pt/1.3 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif;
  font-variant-numeric: tabular-nums }
h1 { font-size: 18pt; line-height: 1.15; margin: 0 0 1mm; overflow-wrap: anywhere }
h2 { font-size: 11pt; margin: 4mm 0 1mm; padding-bottom: 0.8mm;
  border-bottom: 0.3mm solid #1a1d21; break-after: avoid }
p { margin: 0.8mm 0 } h2 + p { break-after: avoid }
.status { font-weight: 600 } .status.infeasible { color: #b00d26 }
.from { color: #5b626b; font-size: 8pt }
dl { display: flex; flex-wrap: wrap; gap: 1mm 10mm; margin: 2mm 0 }
dt { color: #5b626b; font-size: 8pt } dd { margin: 0; font-size: 14pt }
dd small { font-size: 8.5pt; color: #5b626b }
table { border-collapse: collapse; width: 100%; font-size: 7.5pt; margin: 1mm 0 }
th { text-align: left; font-weight: 600; border-bottom: 0.2mm solid #8b929b;
  vertical-align: bottom }
th small { display: block; font-weight: 400; color: #5b626b }
th, td { padding: 0.4mm 1.6mm 0.4mm 0 }
td { border-bottom: 0.1mm solid #d8dce1; vertical-align: top; overflow-wrap: anywhere }
td.n, th.n { text-align: right; white-space: nowrap }
tr { break-inside: avoid } thead { display: table-header-group }
tr.first td { border-bottom: 0 } td.note { color: #454b53; padding-left: 3mm }
.bad { color: #b00d26; font-weight: 600 }
ol { padding-left: 6mm; margin: 1mm 0 } li { margin: 0.4mm 0 }
ul { padding-left: 5mm; margin: 1mm 0; color: #454b53 }
figure { margin: 2mm 0; break-inside: avoid }
figure img { max-width: 100%; max-height: 70mm; display: block; margin: 0 auto }
.pairs { display: grid; grid-template-columns: 1fr 1fr; gap: 3mm }
.pairs figure { margin: 0 }
.assumed td:first-child { white-space: nowrap } .assumed { font-size: 7.5pt }
@media print { body { margin: 0; padding: 0; max-width: none } figure img { max-height: 62mm } }
@media (max-width: 640px) { .scroll { overflow-x: auto } .pairs { grid-template-columns: 1fr } }
)css";

std::string tag(const std::string& name, std::string_view text) {
  return '<' + name + '>' + escaped(text) + "</" + name + ">\n";
}

/// Bytes of a URL (RFC 3986): what is not unreserved as %XX.
std::string percent_encoded(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = (byte | 0x20) >= 'a' && (byte | 0x20) <= 'z';
    if (letter || (byte >= '0' && byte <= '9') ||
        std::string_view("-._~ ,:;=/()@!*'").find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}

/// An image of its own, so that its styles and names stay apart from the page's.
std::string figure(const Figure& f, const std::string& what) {
  return "<figure><img alt=\"" + escaped(what) + "\" src=\"data:image/svg+xml," +
         percent_encoded(f.svg) + "\"></figure>\n";
}

std::string figure_named(const Figures& figures, const std::string& file,
                         const std::string& what) {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const Figure& f) { return f.file == file; });
  return found == figures.end() ? "" : figure(*found, what);
}

std::string numbered(const std::vector<std::string>& sentences) {
  std::string out = "<ol>\n";
  for (const auto& sentence : sentences) out += tag("li", sentence);
  return out + "</ol>\n";
}

std::string section(const std::string& title, const std::vector<std::string>& sentences) {
  return sentences.empty() ? "" : tag("h2", title) + numbered(sentences);
}

struct Heading {
  std::string title, unit;
  bool number = true;
};

std::string table_head(const std::vector<Heading>& headings,
                       const std::string& css_class = "") {
  std::string out =
      "<div class=\"scroll\"><table class=\"" + css_class + "\"><thead><tr>";
  for (const auto& h : headings) {
    out += h.number ? "<th class=\"n\">" : "<th>";
    out += escaped(h.title);
    if (!h.unit.empty()) out += "<small>" + escaped(h.unit) + "</small>";
    out += "</th>";
  }
  return out + "</tr></thead><tbody>\n";
}

constexpr const char* kTableFoot = "</tbody></table></div>\n";

std::string words_cell(std::string_view text) { return "<td>" + escaped(text) + "</td>"; }
std::string number_cell(std::string_view text) {
  return "<td class=\"n\">" + escaped(text) + "</td>";
}

std::string key_figure(const std::string& name, const std::string& value,
                       const std::string& unit) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + " <small>" +
         escaped(unit) + "</small></dd></div>\n";
}

std::string header(std::string_view name, const ordered_json& result) {
  const bool feasible = word(result, "status") != "infeasible";
  std::string out = tag("h1", name);
  out += "<p class=\"status" + std::string(feasible ? "" : " infeasible") + "\">" +
         (feasible ? "Every limit is kept" : "Infeasible: no plan keeps every limit") +
         "</p>\n";
  if (feasible) {
    out += "<dl>\n";
    out += key_figure("Cost", shown(number(result, "cost_per_part"), 4), "per part");
    out +=
        key_figure("Time", shown(number(result, "time_per_part_min"), 3), "min per part");
    if (const auto profit = number(result, "profit_per_min"))
      out += key_figure("Profit", shown(profit, 4), "per minute");
    const auto& robust = object(result, "robustness");
    if (const auto p = number(robust, "conformance"))
      out += key_figure(
          "Robust", shown(100 * *p, 2),
          "% kept, for " + shown(number(robust, "price_per_part"), 4) + " per part");
    out += "</dl>\n";
  }
  if (const auto& c = object(result, "certificate"); !c.empty())
    out += tag("p", "Proof: " + proof(c) + ".");
  const auto version = word(result, "turnwright_version");
  const auto digest = word(result, "request_digest");
  if (!version.empty() && !digest.empty())
    out += "<p class=\"from\">Turnwright " + escaped(version) + ", request " +
           escaped(digest) + "</p>\n";
  return out;
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
           number_cell(first ? shown(number(operation, "time_min"), 3) : "") +
           number_cell(first ? shown(number(operation, "cost"), 3) : "") +
           number_cell(first ? gap(certificate) : "") + "</tr>\n";
  }
  return out + "<tr><td class=\"note\" colspan=\"10\">" + escaped(note(operation)) +
         "</td></tr>\n";
}

std::string operations(const ordered_json& all) {
  if (all.empty()) return tag("p", "No operations.");
  std::string out = table_head({{"operation", "", false},
                                {"tool", "", false},
                                {"passes", ""},
                                {"ap", "mm"},
                                {"f", "mm/rev"},
                                {"vc", "m/min"},
                                {"n", "1/min"},
                                {"time", "min"},
                                {"cost", "per part"},
                                {"gap", ""}});
  for (const auto& operation : all) out += operation_rows(operation);
  return out + kTableFoot;
}

/// Figures two beside each other.
std::string pairs(const std::string& figures) {
  return figures.empty() ? "" : "<div class=\"pairs\">\n" + figures + "</div>\n";
}

std::string setup_figures(const ordered_json& result, const Figures& figures) {
  std::string out;
  for (std::size_t i = 0; i < list(result, "setups").size(); ++i)
    out += figure_named(
        figures, fmt::format("setup-{}.svg", i),
        fmt::format("Setup {}: the part, its clamping and its deviations", i));
  return pairs(out);
}

std::string setups(const ordered_json& result) {
  std::string out;
  const bool feasible = word(result, "status") != "infeasible";
  std::size_t index = 0;
  for (const auto& setup : list(result, "setups")) {
    const auto i = std::to_string(index++);
    out += tag("h2", "Setup " + i) + tag("p", "Hold " + holding(setup) + ".");
    std::string rejected;
    for (const auto& r : list(setup, "rejected"))
      rejected += tag("li", "not " + word(r, "clamping") + ": " + word(r, "why"));
    if (!rejected.empty()) out += "<ul>\n" + rejected + "</ul>\n";
    if (!feasible && !list(setup, "operations").empty())
      out +=
          "<p class=\"bad\">Conditions that come closest; they break limits, do not "
          "cut with them.</p>\n";
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
  std::string out = tag("h2", "Tolerances") + table_head({{"id", "", false},
                                                          {"kind", "", false},
                                                          {"of", "", false},
                                                          {"predicted", "\u00b5m"},
                                                          {"allowed", "\u00b5m"},
                                                          {"margin", "\u00b5m"},
                                                          {"used", "of the width"},
                                                          {"verdict", "", false},
                                                          {"paper", "", false}});
  for (const auto& t : all) {
    auto kind = word(t, "kind");
    std::replace(kind.begin(), kind.end(), '-', ' ');
    const bool met = word(t, "verdict") != "not-met";
    out += "<tr>" + words_cell(word(t, "id")) + words_cell(kind) +
           words_cell(word(t, "of")) + number_cell(micrometres(t, "predicted_mm")) +
           number_cell(micrometres(t, "allowed_mm")) +
           number_cell(micrometres(t, "margin_mm")) + used_cell(t) +
           (met ? words_cell(verdict(t)) : "<td class=\"bad\">NOT MET</td>") +
           words_cell(other_verdict(t)) + "</tr>\n";
    if (const auto p = conformance(t); !p.empty())
      out += "<tr><td class=\"note\" colspan=\"9\">" + escaped(p) + "</td></tr>\n";
  }
  return out + kTableFoot +
         "<p class=\"from\">offset: met once the tool path is corrected; paper: the "
         "published acceptance equations, where they judge otherwise</p>\n" +
         figure_named(figures, "budget.svg", "What takes each tolerance's width");
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
        figure_named(figures, "window-" + id + ".svg", "Speeds and feeds of " + id);
    if (one.empty() || ++count > kMost) continue;
    out += one;
  }
  if (out.empty()) return "";
  return tag("h2", "Windows of speed and feed: the operations that cost most") +
         pairs(out);
}

// Of every milled place: how deep it may be cut over the spindle's speeds.
std::string stability(const ordered_json& result, const Figures& figures) {
  std::string out;
  for (const auto& setup : list(result, "setups"))
    for (const auto& o : list(setup, "operations"))
      out += figure_named(figures, "stability-" + word(o, "id") + ".svg",
                          "Stable depth over speed of " + word(o, "id"));
  return out.empty() ? "" : tag("h2", "Stability of milled places") + pairs(out);
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
    rows += "<tr>" + words_cell(word(c, "on")) +
            number_cell(shown(number(c, "setup"), 0)) + words_cell(table) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return tag("h2", "Compensation: add dr to the radius of the tool path at z") +
         table_head({{"on", "", false}, {"setup", ""}, {"z: dr", "mm: \u00b5m", false}}) +
         rows + kTableFoot;
}

std::string prices(const ordered_json& result) {
  constexpr std::size_t kMost = 12;
  auto sentences = sentences_of(list(result, "prices"));
  const auto all = sentences.size();
  if (all > kMost) sentences.resize(kMost);
  auto out = section("Prices: what 10 % more room would save", sentences);
  if (all > kMost)
    out +=
        fmt::format("<p class=\"from\">{} smaller ones are in the result document.</p>\n",
                    all - kMost);
  return out;
}

std::string assumptions(const ordered_json& result) {
  constexpr std::size_t kMost = 160;
  std::string rows;
  for (const auto& a : list(result, "assumed")) {
    const auto found = a.find("value");
    auto value = found == a.end() ? "-" : value_text(*found);
    if (value.size() > kMost) value = clipped(value, kMost);
    rows += "<tr>" + words_cell(word(a, "pointer")) + words_cell(value) +
            words_cell(word(a, "why")) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return tag("h2", "Assumed: what the request left open") +
         table_head({{"where", "", false}, {"taken", "", false}, {"why", "", false}},
                    "assumed") +
         rows + kTableFoot;
}

}  // namespace

std::string html(std::string_view name, const ordered_json& result,
                 const Figures& figures) {
  const bool feasible = word(result, "status") != "infeasible";
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "img-src data:; style-src 'unsafe-inline'\">\n";
  out += "<title>" + escaped(name) + " - process plan</title>\n<style>" + kStyle +
         "</style>\n</head>\n<body>\n<main>\n";
  out += header(name, result);
  out += section("Conflicts: limits that cannot be kept together",
                 conflict_sentences(result));
  if (!feasible)
    out += section(several_sets(list(result, "relax"))
                       ? "What would have to give, one of every set"
                       : "What would have to give, the smallest opening first",
                   opening_sentences(result));
  out += section("What else would do, each alone, as planned with it",
                 sentences_of(list(result, "remedies")));
  out += setup_figures(result, figures) + setups(result) + tolerances(result, figures) +
         prices(result) +
         section("What if: planned anew with a change",
                 sentences_of(list(result, "what_if"))) +
         compensation(result) + stability(result, figures) + windows(result, figures) +
         assumptions(result);
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace turnwright::report
