#include "sheet_html.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/say.hpp"
#include "report/picture/svg.hpp"
#include "report/text/amounts.hpp"
#include "report/text/json_fields.hpp"

namespace turnwright::report {
namespace {

std::string entries(const Entries& all, const char* css_class) {
  std::string out = fmt::format("<dl class=\"{}\">\n", css_class);
  for (const auto& [name, value] : all)
    out += "<div><dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd></div>\n";
  return out + "</dl>\n";
}

std::string nowrap_cell(const std::string& text) {
  return "<td class=\"nowrap\">" + escaped(text) + "</td>";
}

std::string numbered(int number) {
  return number > 0 ? fmt::format("T{}", number) : tr("driven");
}

std::string lasts(const ToolRow& tool) {
  if (!tool.edge) return "-";
  const long parts = tool.edge->parts_per_edge;
  return parts > 0 ? say("{} parts", parts) : tr("less than a part");
}

std::string in_batch(const ToolRow& tool) {
  return tool.edge && tool.edge->edges_per_batch
             ? std::to_string(*tool.edge->edges_per_batch)
             : "-";
}

std::string tools(const SetupSheet& sheet) {
  std::string rows;
  for (const auto& t : sheet.tools) {
    rows += "<tr>" + words_cell(numbered(t.number)) +
            number_cell(t.offset > 0 ? std::to_string(t.offset) : "-") +
            words_cell(t.holder.empty() ? t.id : t.holder) +
            words_cell(t.insert.empty() ? "-" : t.insert) +
            number_cell(t.re_mm > 0 ? plain(t.re_mm) : "-") +
            number_cell(t.stick_out_mm ? plain(*t.stick_out_mm, 1) : "-") +
            words_cell(joined(t.on)) + number_cell(lasts(t)) + number_cell(in_batch(t)) +
            "</tr>\n";
  }
  return tag("h2", tr("Tools")) +
         table_head({{tr("tool"), "", false},
                     {tr("offset"), ""},
                     {tr("holder"), "", false},
                     {tr("insert"), "", false},
                     {tr("corner"), "mm"},
                     {tr("stick-out"), "mm"},
                     {tr("cuts"), "", false},
                     {tr("new edge every"), ""},
                     {tr("edges"), tr("of the batch")}}) +
         rows + kTableFoot;
}

// "0: -1, 33: -3": whole micrometres, as controls take them, where they change.
std::string step_words(const planning::FollowedOffset& offset) {
  std::string text;
  long now = 0;
  for (const auto& step : offset.steps) {
    const long um = std::lround(step.um);
    if (um == now) continue;
    text += fmt::format("{}{}: {:+}", text.empty() ? "" : ", ", step.after_part, um);
    now = um;
  }
  return text;
}

std::string followed_offsets(const SetupSheet& sheet) {
  std::string rows;
  for (const auto& t : sheet.tools) {
    if (!t.edge) continue;
    for (const auto& offset : t.edge->offsets)
      if (const auto moved = step_words(offset); !moved.empty())
        rows += "<tr>" + words_cell(numbered(t.number)) + words_cell(offset.on) +
                words_cell(moved) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return tag("h2", tr("Offsets while an edge wears")) +
         table_head(
             {{tr("tool"), "", false},
              {tr("at"), "", false},
              {tr("after so many parts of an edge: offset on the diameter, of a face "
                  "along Z"),
               "\u00b5m", false}}) +
         rows + kTableFoot;
}

std::string stops(const SetupSheet& sheet) {
  if (sheet.stops.empty()) return "";
  std::string rows;
  for (const auto& s : sheet.stops)
    rows += "<tr>" + words_cell(s.before) + words_cell(s.what) +
            number_cell(s.minutes > 0 ? duration(s.minutes) : "-") + "</tr>\n";
  return tag("h2", tr("Stops (M0)")) +
         table_head(
             {{tr("before"), "", false}, {tr("do"), "", false}, {tr("takes"), ""}}) +
         rows + kTableFoot;
}

std::string checks(const SetupSheet& sheet) {
  if (sheet.checks.empty()) return "";
  std::string rows;
  for (const auto& c : sheet.checks)
    rows += "<tr>" + nowrap_cell(c.what) + words_cell(c.of) + number_cell(c.limits) +
            number_cell(c.predicted) + words_cell(c.gauge) + nowrap_cell(c.when) +
            "<td class=\"blank\"></td></tr>\n";
  return tag("h2", tr("Inspection")) +
         table_head({{tr("characteristic"), "", false},
                     {tr("of"), "", false},
                     {tr("limits"), "mm"},
                     {tr("predicted"), tr("off nominal")},
                     {tr("gauge"), "", false},
                     {tr("when"), "", false},
                     {tr("found"), "", false}}) +
         rows + kTableFoot;
}

std::string signatures() {
  std::string out = "<div class=\"sign\">\n";
  for (const auto& what : {tr("set up by, date"), tr("first part released by, date"),
                           tr("programmed and approved by, date")})
    out += tag("p", what);
  return out + "</div>\n";
}

}  // namespace

std::string sheet_html(const SetupSheet& sheet, const Figures& figures) {
  const auto setup = say("Setup {} of {}", sheet.setup, sheet.setups);
  std::string out = "<section class=\"setup-sheet\">\n";
  out += "<h1>" + escaped(setup) + " <span>" + escaped(sheet.program) + "</span></h1>\n";
  out += entries(sheet.title, "title");
  out += figure_named(figures, fmt::format("setup-{}.svg", sheet.setup),
                      say("{}: the part, its clamping and the program's zero", setup));
  Entries facts = sheet.clamping;
  facts.insert(facts.end(), sheet.times.begin(), sheet.times.end());
  out += entries(facts, "facts");
  out += tools(sheet) + stops(sheet) + checks(sheet) + signatures() + "</section>\n";
  const auto path = figure_named(figures, fmt::format("path-{}.svg", sheet.setup),
                                 say("{}: tool path and material taken off", setup));
  if (const auto offsets = followed_offsets(sheet); !path.empty() || !offsets.empty())
    out += "<section class=\"cut\">\n" + tag("h2", say("{}: the cut", setup)) + path +
           offsets + "</section>\n";
  return out;
}

}  // namespace turnwright::report
