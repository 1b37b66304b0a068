#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "provenance.hpp"
#include "text.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr const char* kPlanes[] = {"radial", "tangential"};

std::string um(const ordered_json& of, const char* key, int decimals = 2) {
  const auto mm = number(of, key);
  return mm ? shown(units::um_from_mm(*mm), decimals) : "-";
}

std::string joined_words(const ordered_json& words, const std::string& between) {
  std::vector<std::string> all;
  for (const auto& w : words)
    if (w.is_string()) all.push_back(w.get<std::string>());
  return joined(all, between.c_str());
}

/// A value beside its standard error, and that in per cent.
Row estimate(const std::string& name, std::optional<double> value,
             std::optional<double> u, const std::string& unit) {
  const bool relative = value && u && *value != 0;
  return {{name, significant(value), significant(u),
           relative ? shown(100 * *u / std::abs(*value), 1) : "-", unit},
          ""};
}

Row spring(const ordered_json& springs, const std::string& name, const std::string& key,
           const std::string& unit) {
  if (springs.contains(key) && springs[key].is_null())
    return {{name, tr("rigid"), "-", "-", unit}, ""};
  return estimate(name, number(springs, key.c_str()),
                  number(springs, ("u_" + key).c_str()), unit);
}

std::string compliance(const ordered_json& root, const ordered_json& fit) {
  std::vector<Row> rows;
  const ordered_json& u = object(fit, "u");
  const auto add = [&](const char* name, const char* key, const char* unit) {
    rows.push_back(estimate(name, number(root, key), number(u, key), unit));
  };
  add("c0", "c0_mm_N", "mm/N");
  add("c1", "c1_rad_N", "rad/N");
  add("c2", "c2_rad_Nmm", "rad/(N mm)");
  const ordered_json& springs = object(fit, "springs");
  if (!springs.empty()) {
    rows.push_back(spring(springs, "k1", "k1_N_mm", "N/mm"));
    rows.push_back(spring(springs, "k2", "k2_Nmm_rad", "N mm/rad"));
    rows.push_back(spring(springs, "k3", "k3_Nmm_rad", "N mm/rad"));
  }
  std::string out = table({{"", Align::left},
                           {tr("value")},
                           {tr("std. error")},
                           {"%"},
                           {tr("unit"), Align::left}},
                          rows);
  if (springs.empty()) return out;
  const auto& arms = list(springs, "Lc_range_mm");
  const auto arm = [&arms](std::size_t i) {
    return i < arms.size() && arms[i].is_number() ? shown(arms[i].get<double>(), 1) : "-";
  };
  return out + paragraph("  ", say("springs for the arm Lc = {} mm; any from {} to "
                                   "{} mm gives the same deflections",
                                   shown(number(springs, "Lc_mm"), 1), arm(0), arm(1)));
}

std::string fitted_offsets(const ordered_json& fit) {
  std::vector<std::string> all;
  for (const auto& o : list(fit, "offsets"))
    all.push_back(
        fmt::format("{}: {} ({})", word(o, "setup"), um(o, "offset_mm"), um(o, "u_mm")));
  return paragraph("  ",
                   say("offsets of the setups in um (std. error)  {}", joined(all)));
}

std::string outliers(const ordered_json& fit) {
  std::vector<std::string> all;
  for (const auto& i : list(fit, "outliers"))
    if (i.is_number()) all.push_back(shown(i.get<double>(), 0));
  if (all.empty()) return "";
  return paragraph("  ", say("cuts left out, counted from 0: {}", joined(all)));
}

std::string fitted(const char* plane, const ordered_json& result) {
  const ordered_json& fit = object(result, plane);
  if (fit.empty()) return "";
  std::string out =
      paragraph('\n' + (plane == kPlanes[0] ? tr("RADIAL  ") : tr("TANGENTIAL  ")),
                say("scatter of a cut {} um, {} degrees of freedom", um(fit, "s_mm"),
                    shown(number(fit, "degrees_of_freedom"), 0)));
  out += compliance(object(object(result, "chuck"), plane), fit);
  if (flag(fit, "on_border"))
    out += paragraph("  ", say("at the border of the elastic chucks, the best of all "
                               "fits {} s^2 better",
                               shown(number(fit, "contradiction"), 2)));
  return out + fitted_offsets(fit) + outliers(fit);
}

/// Identifiability by planned cuts, for which no errors are given.
std::string design(const char* plane, const ordered_json& result) {
  const ordered_json& can = object(object(result, "identifiability"), plane);
  if (can.empty() || result.contains("chuck")) return "";
  std::string out = paragraph(
      '\n' + (plane == kPlanes[0] ? tr("RADIAL  ") : tr("TANGENTIAL  ")),
      say("{} of c0, c1, c2 are determined, {} degrees of freedom",
          shown(number(can, "rank"), 0), shown(number(can, "degrees_of_freedom"), 0)));
  for (const auto& n : list(can, "null_directions"))
    out += paragraph(tr("  not determined: "), word(n, "words"));
  if (const auto& missing = list(can, "missing"); !missing.empty())
    out += paragraph(tr("  missing: "), joined_words(missing, tr(" and ")));
  if (const auto& one = list(can, "setups_of_one_force"); !one.empty())
    out += paragraph(tr("  setups of one force: "), joined_words(one, ", "));
  if (can.contains("condition"))
    out += paragraph(
        "  ", say("condition {}; predictions at the cuts err by up to {} um per "
                  "um of scatter; most useful next: {}",
                  significant(number(can, "condition")),
                  significant(number(can, "largest_u_per_s")), word(can, "most_useful")));
  return out;
}

std::string predictions(const ordered_json& result) {
  std::vector<Row> rows;
  for (const auto& p : list(result, "predictions"))
    rows.push_back(
        {{shown(number(p, "z_mm"), 1), shown(number(p, "Fr_N"), 0), um(p, "delta_r_mm"),
          um(p, "u_delta_r_mm"), um(p, "delta_t_mm"), um(p, "u_delta_t_mm"),
          um(p, "radius_error_mm"), um(p, "u_radius_error_mm")},
         ""});
  if (rows.empty()) return "";
  return '\n' +
         tr("PREDICTED  deflection of the chuck alone, um, each with its standard "
            "error") +
         '\n' +
         table({{"z mm"},
                {"Fr N"},
                {tr("radial")},
                {"+-"},
                {tr("tangential")},
                {"+-"},
                {tr("radius error")},
                {"+-"}},
               rows);
}

std::string polynomial(const ordered_json& graph) {
  const auto& c = list(graph, "coefficients");
  const auto& u = list(graph, "u_coefficients");
  std::vector<Row> rows;
  for (std::size_t j = 0; j < c.size() && j < u.size(); ++j)
    if (c[j].is_number() && u[j].is_number())
      rows.push_back(estimate(j == 0   ? "1"
                              : j == 1 ? "z"
                                       : fmt::format("z^{}", j),
                              c[j].get<double>(), u[j].get<double>(),
                              j == 0   ? "mm"
                              : j == 1 ? "mm/mm"
                                       : fmt::format("mm/mm^{}", j)));
  return table({{"", Align::left},
                {tr("coefficient")},
                {tr("std. error")},
                {"%"},
                {tr("unit"), Align::left}},
               rows);
}

std::string graph(const ordered_json& result) {
  const ordered_json& g = object(result, "graph");
  if (g.empty()) return "";
  std::string out =
      paragraph('\n' + tr("DEVIATION GRAPH  "),
                say("R^2 {} ({} as measured), scatter {} um, {} degrees of freedom",
                    shown(number(g, "r2"), 4), shown(number(g, "r2_as_measured"), 4),
                    um(g, "s_mm"), shown(number(g, "degrees_of_freedom"), 0)));
  out += polynomial(g);
  for (const auto& s : list(g, "steps"))
    out +=
        paragraph(tr("  step "),
                  say("of {} um (std. error {}) between z = {} and {} mm; "
                      "by chance: p = {}",
                      um(s, "height_mm"), um(s, "u_mm"), shown(number(s, "after_mm"), 2),
                      shown(number(s, "before_mm"), 2), significant(number(s, "p"), 2)));
  if (list(g, "steps").empty()) out += tr("  no step of the carriage") + '\n';
  return out;
}

}  // namespace

std::string chuck_text(const ordered_json& result) {
  std::string out;
  for (const char* plane : kPlanes) out += fitted(plane, result) + design(plane, result);
  out += predictions(result) + graph(result) + warnings(result);
  return tr("CHUCK  test cuts and deviation graphs") + '\n' + made_by(result) + out;
}

}  // namespace turnwright::report
