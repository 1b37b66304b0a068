#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "stability_words.hpp"
#include "text.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kShownSpeeds = 24;  // rows of a table

std::string best(const ordered_json& result) {
  const auto found = result.find("best");
  if (found == result.end()) return "";
  return '\n' + tr("BEST CUT") + '\n' +
         paragraph("  ", found->is_null()
                             ? tr("The machine has none of the speeds whose "
                                  "limits are known, or none with the margins.")
                             : best_words(*found));
}

std::string points(const ordered_json& result) {
  const auto& all = list(result, "points");
  if (all.empty()) return "";
  std::vector<Row> rows;
  for (std::size_t i = 0; i < all.size() && i < kShownSpeeds; ++i)
    rows.push_back({{shown(number(all[i], "n_rpm"), 0),
                     significant(number(all[i], "ap_mm")), verdict_words(all[i])},
                    ""});
  std::string out = '\n' + tr("REQUESTED CUTS") + '\n';
  if (all.size() > kShownSpeeds)
    out += say("  the first {} of {}\n", kShownSpeeds, all.size());
  return out + table({{"1/min"}, {"mm"}, {"", Align::left}}, rows);
}

std::string magic(const ordered_json& result) {
  std::vector<std::string> all;
  for (const auto& m : list(result, "magic_speeds"))
    all.push_back(fmt::format("{} ({} mm)", shown(number(m, "n_rpm"), 0),
                              significant(number(m, "ap_mm"), 3)));
  if (all.empty()) return "";
  return paragraph("  ",
                   say("speeds stable deeper than their neighbours, without a margin: {}",
                       joined(all)));
}

std::string speeds(const ordered_json& result) {
  const auto& all = list(result, "speeds");
  if (all.empty()) return "";
  const std::size_t step = 1 + (all.size() - 1) / kShownSpeeds;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < all.size(); i += step)
    rows.push_back({{shown(number(all[i], "n_rpm"), 0),
                     significant(number(all[i], "limit_mm")), limit_words(all[i])},
                    ""});
  std::string out = '\n' + tr("LIMITS") + '\n';
  if (step > 1)
    out += say("  one in {} of {} speeds; --json has all\n", step, all.size());
  return out + table({{"1/min"}, {tr("stable to mm")}, {"", Align::left}}, rows) +
         magic(result);
}

/// Limits with and without a variation of the speed.
std::string varied(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& speed : list(result, "speeds"))
    for (const auto& v : list(speed, "varied")) {
      if (rows.size() == kShownSpeeds) break;
      rows.push_back(
          {{shown(number(speed, "n_rpm"), 0),
            significant(100 * number(v, "rva").value_or(0), 3),
            significant(number(v, "rvf"), 3), significant(number(v, "limit_mm")),
            significant(number(speed, "limit_mm"))},
           word(v, "why")});
    }
  if (rows.empty()) return "";
  return '\n' + tr("SWINGING SPEED  stable to, mm; - where it is to the largest depth") +
         '\n' +
         table({{"1/min"},
                {"+- %"},
                {tr("times a turn")},
                {tr("swinging")},
                {tr("constant")}},
               rows);
}

std::string modes(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& r : list(result, "frf"))
    for (const auto& m : list(r, "modes"))
      rows.push_back({{word(r, "axis"), significant(number(m, "frequency_Hz"), 5),
                       significant(number(m, "damping_ratio"), 3),
                       shown(number(m, "stiffness_N_mm"), 0),
                       shown(number(m, "stable_from_order"), 0)},
                      ""});
  if (rows.empty()) return "";
  return '\n' +
         tr("MODES  of the measured response; the order of models from which they are "
            "stable, - for never") +
         '\n' +
         table({{tr("axis"), Align::left},
                {"Hz"},
                {tr("damping ratio")},
                {"N/mm"},
                {tr("stable from")}},
               rows);
}

std::string undecided(const ordered_json& result) {
  std::string out;
  for (const auto& u : list(result, "undecided"))
    out += paragraph("  - ",
                     fmt::format("{}: {} 1/min, {} mm: {}", word(u, "pointer"),
                                 significant(number(u, "n_rpm"), 6),
                                 significant(number(u, "ap_mm"), 6), word(u, "why")));
  return out.empty() ? "" : '\n' + tr("UNDECIDED") + '\n' + out;
}

}  // namespace

std::string stability_text(const ordered_json& result) {
  return tr("STABILITY OF THE CUT") + '\n' + made_by(result) + best(result) +
         points(result) + speeds(result) + varied(result) + modes(result) +
         undecided(result) + warnings(result) + assumption_lines(result);
}

}  // namespace turnwright::report
