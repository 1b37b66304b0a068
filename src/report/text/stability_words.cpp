#include "stability_words.hpp"

#include <fmt/format.h>

#include <vector>

#include "json_fields.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string rpm(const ordered_json& parent, const char* key) {
  return shown(number(parent, key), 0) + " 1/min";
}

std::string mm(const ordered_json& parent, const char* key) {
  return significant(number(parent, key), 3) + " mm";
}

std::string hertz(const ordered_json& parent, const char* key) {
  return shown(number(parent, key), 0) + " Hz";
}

std::string end_of_depth(const ordered_json& best) {
  const auto by = word(best, "limited_by");
  if (by == "machine_power_kW") return "the machine's power ends the depth";
  if (by == "machine_torque_Nm") return "the machine's torque ends the depth";
  if (by == "ap_max_mm")
    return "limits are not known deeper than this and its margin, so a larger ap_max_mm "
           "may allow more";
  std::string out = "deeper it would begin to chatter";
  if (number(best, "chatter_Hz")) out += " at " + hertz(best, "chatter_Hz");
  return out + " within the margins";
}

std::string chattering(const ordered_json& point) {
  std::string out = "chatters";
  if (number(point, "chatter_Hz")) out += " at " + hertz(point, "chatter_Hz");
  if (number(point, "limit_mm")) out += ", from " + mm(point, "limit_mm") + " on";
  const auto cure = point.find("cure");
  if (cure == point.end()) return out;
  if (cure->is_null())
    return out + "; at none of the speeds asked for it would be stable with the margins";
  out += "; at " + rpm(*cure, "n_rpm") + " it does not";
  if (number(*cure, "margin_mm")) out += ", margin " + mm(*cure, "margin_mm");
  return out;
}

}  // namespace

std::string stable_up_to(const ordered_json& parent) {
  if (number(parent, "limit_mm")) return "up to " + mm(parent, "limit_mm");
  return "up to the largest depth asked for";
}

std::string best_words(const ordered_json& best) {
  std::string out = fmt::format("{}, {} deep: ", rpm(best, "n_rpm"), mm(best, "ap_mm"));
  if (number(best, "removed_cm3_min"))
    out += fmt::format("removes {} cm3/min with {} kW and {} Nm; ",
                       significant(number(best, "removed_cm3_min"), 3),
                       significant(number(best, "power_kW"), 3),
                       significant(number(best, "torque_Nm"), 3));
  out += end_of_depth(best);
  out += fmt::format(". At this speed it is stable {}", stable_up_to(best));
  if (number(best, "margin_mm"))
    out += fmt::format(", a margin of {}", mm(best, "margin_mm"));
  if (const auto& range = object(best, "stable_rpm"); !range.empty())
    out += fmt::format("; this depth from {} to {}", shown(number(range, "from"), 0),
                       rpm(range, "to"));
  return out + ".";
}

std::string verdict_words(const ordered_json& point) {
  if (!flag(point, "stable")) return chattering(point);
  if (!point.contains("limit_mm")) return "stable";
  const auto margin = number(point, "margin_mm");
  if (!margin) return "stable, and " + stable_up_to(point);
  if (*margin >= 0) return "stable, margin " + mm(point, "margin_mm");
  return "stable only above depths that chatter from " + mm(point, "limit_mm") + " on";
}

std::string limit_words(const ordered_json& speed) {
  std::vector<std::string> all;
  for (const auto& c : list(speed, "crossings"))
    all.push_back(word(c, "sense") == "loss"
                      ? fmt::format("chatter at {} from {}", hertz(c, "frequency_Hz"),
                                    mm(c, "ap_mm"))
                      : "stable again from " + mm(c, "ap_mm"));
  return all.empty() ? "no chatter" : joined(all);
}

}  // namespace turnwright::report
