#include "stability_html.hpp"

#include "base/say.hpp"
#include "html_parts.hpp"
#include "report/text/json_fields.hpp"
#include "report/text/stability_words.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMost = 40;  // rows of a table

std::string chart_header(const ordered_json& result) {
  std::string out = tag("h1", tr("Stability of the cut"));
  if (const auto& best = object(result, "best"); !best.empty()) {
    out += "<dl>\n";
    out += key_figure(tr("Best speed"), shown(number(best, "n_rpm"), 0), "1/min");
    out += key_figure(tr("Depth there"), significant(number(best, "ap_mm"), 3),
                      tr("mm, with the margins"));
    out += "</dl>\n" + tag("p", best_words(best));
  }
  return out + origin(result);
}

std::string plus_minus(const ordered_json& parent, const std::string& key) {
  return significant(number(parent, key.c_str()), 6) + " \u00b1 " +
         significant(number(parent, ("u_" + key).c_str()), 2);
}

/// From which order of the diagram on a mode is stable.
std::string stable_words(const ordered_json& mode) {
  const auto from = number(mode, "stable_from_order");
  return from ? say("from order {}", shown(from, 0)) : tr("never");
}

std::string responses(const ordered_json& result, const std::vector<Figure>& figures) {
  std::string rows, rest;
  for (const auto& r : list(result, "frf")) {
    for (const auto& m : list(r, "modes"))
      rows += "<tr>" + words_cell(word(r, "axis")) +
              number_cell(plus_minus(m, "frequency_Hz")) +
              number_cell(plus_minus(m, "damping_ratio")) +
              number_cell(plus_minus(m, "stiffness_N_mm")) +
              number_cell(significant(number(m, "mass_kg"))) +
              words_cell(stable_words(m)) + "</tr>\n";
    rest +=
        tag("p", say("Along {}: {} lines from {} to {} Hz; the modes explain "
                     "{} % of the response's squares, what is left is {} of "
                     "it and correlated by {} from line to line.",
                     word(r, "axis"), shown(number(r, "lines"), 0),
                     significant(number(r, "from_Hz")), significant(number(r, "to_Hz")),
                     shown(100 * number(r, "explained").value_or(0), 3),
                     significant(number(r, "relative_rest"), 2),
                     shown(number(r, "correlation"), 2)));
    rest += figure_named(figures, "stabilisation-" + word(r, "axis") + ".svg",
                         tr("Poles of models of rising order over the response"));
  }
  if (rows.empty()) return "";
  return tag("h2", tr("Modes of the measured response")) +
         table_head({{tr("axis"), "", false},
                     {tr("frequency"), "Hz"},
                     {tr("damping ratio"), ""},
                     {tr("stiffness"), "N/mm"},
                     {tr("mass"), "kg"},
                     {tr("stable"), "", false}}) +
         rows + kTableFoot + rest;
}

std::string force(const ordered_json& result) {
  const auto& f = object(result, "force");
  if (f.empty()) return "";
  return tag("p",
             say("Force of the material at a mean chip of {} mm: Kt {} MPa, "
                 "Kn {} MPa.",
                 significant(number(f, "hm_mm"), 3), significant(number(f, "Kt_MPa")),
                 significant(number(f, "Kn_MPa"))));
}

/// Warnings, and speeds and points that are undecided.
std::string warnings(const ordered_json& result) {
  std::string out;
  for (const auto& warning : list(result, "warnings"))
    if (warning.is_string()) out += tag("p", warning.get<std::string>());
  for (const auto& u : list(result, "undecided"))
    out += tag(
        "p",
        say("Undecided: {} 1/min, {} mm ({}): {}.", significant(number(u, "n_rpm"), 6),
            significant(number(u, "ap_mm"), 6), word(u, "pointer"), word(u, "why")));
  return out.empty() ? out : tag("h2", tr("Warnings")) + out;
}

std::string speeds(const ordered_json& result) {
  const auto& all = list(result, "speeds");
  if (all.empty()) return "";
  std::string rows;
  const std::size_t step = 1 + (all.size() - 1) / kMost;
  for (std::size_t i = 0; i < all.size(); i += step)
    rows += "<tr>" + number_cell(shown(number(all[i], "n_rpm"), 0)) +
            number_cell(significant(number(all[i], "limit_mm"), 5)) +
            words_cell(limit_words(all[i])) + "</tr>\n";
  std::string out = tag("h2", tr("Limits"));
  if (step > 1)
    out +=
        "<p class=\"from\">" +
        say("One in {} of {} speeds; all are in the result document.", step, all.size()) +
        "</p>\n";
  return out +
         table_head({{tr("speed"), "1/min"}, {tr("stable to"), "mm"}, {"", "", false}}) +
         rows + kTableFoot;
}

std::string points(const ordered_json& result) {
  const auto& all = list(result, "points");
  if (all.empty()) return "";
  std::string rows;
  for (std::size_t i = 0; i < all.size() && i < kMost; ++i)
    rows += "<tr>" + number_cell(shown(number(all[i], "n_rpm"), 0)) +
            number_cell(significant(number(all[i], "ap_mm"))) +
            words_cell(verdict_words(all[i])) + "</tr>\n";
  std::string out = tag("h2", tr("Requested cuts"));
  if (all.size() > kMost)
    out +=
        "<p class=\"from\">" + say("The first {} of {}.", kMost, all.size()) + "</p>\n";
  return out +
         table_head(
             {{tr("speed"), "1/min"}, {tr("depth"), "mm"}, {tr("verdict"), "", false}}) +
         rows + kTableFoot;
}

}  // namespace

std::string stability_html(std::string_view, const ordered_json& result,
                           const std::vector<Figure>& figures) {
  return page(tr("Stability of the cut"),
              chart_header(result) +
                  figure_named(figures, "stability.svg", tr("Depth over spindle speed")) +
                  warnings(result) + force(result) + responses(result, figures) +
                  points(result) + speeds(result) + assumptions(result));
}

}  // namespace turnwright::report
