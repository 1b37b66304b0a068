#include "stability_words.hpp"

#include <vector>

#include "base/say.hpp"
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
  if (by == "machine_power_kW") return tr("the machine's power ends the depth");
  if (by == "machine_torque_Nm") return tr("the machine's torque ends the depth");
  if (by == "ap_max_mm")
    return tr(
        "limits are not known deeper than this and its margin, so a larger ap_max_mm "
        "may allow more");
  return number(best, "chatter_Hz")
             ? say("deeper it would begin to chatter at {} within the margins",
                   hertz(best, "chatter_Hz"))
             : tr("deeper it would begin to chatter within the margins");
}

std::string chattering(const ordered_json& point) {
  auto out = number(point, "chatter_Hz")
                 ? say("chatters at {}", hertz(point, "chatter_Hz"))
                 : tr("chatters");
  if (number(point, "limit_mm")) out += say(", from {} on", mm(point, "limit_mm"));
  const auto cure = point.find("cure");
  if (cure == point.end()) return out;
  if (cure->is_null())
    return out +
           tr("; at none of the speeds asked for it would be stable with the margins");
  out += say("; at {} it does not", rpm(*cure, "n_rpm"));
  if (number(*cure, "margin_mm")) out += say(", margin {}", mm(*cure, "margin_mm"));
  return out;
}

}  // namespace

std::string stable_up_to(const ordered_json& parent) {
  if (number(parent, "limit_mm")) return say("up to {}", mm(parent, "limit_mm"));
  return tr("up to the largest depth asked for");
}

std::string best_words(const ordered_json& best) {
  std::string out = say("{}, {} deep: ", rpm(best, "n_rpm"), mm(best, "ap_mm"));
  if (number(best, "removed_cm3_min"))
    out += say("removes {} cm3/min with {} kW and {} Nm; ",
               significant(number(best, "removed_cm3_min"), 3),
               significant(number(best, "power_kW"), 3),
               significant(number(best, "torque_Nm"), 3));
  out += end_of_depth(best);
  out += say(". At this speed it is stable {}", stable_up_to(best));
  if (number(best, "margin_mm")) out += say(", a margin of {}", mm(best, "margin_mm"));
  if (const auto& range = object(best, "stable_rpm"); !range.empty())
    out += say("; this depth from {} to {}", shown(number(range, "from"), 0),
               rpm(range, "to"));
  return out + ".";
}

std::string verdict_words(const ordered_json& point) {
  if (!flag(point, "stable")) return chattering(point);
  if (!point.contains("limit_mm")) return tr("stable");
  const auto margin = number(point, "margin_mm");
  if (!margin) return say("stable, and {}", stable_up_to(point));
  if (*margin >= 0) return say("stable, margin {}", mm(point, "margin_mm"));
  return say("stable only above depths that chatter from {} on", mm(point, "limit_mm"));
}

std::string limit_words(const ordered_json& speed) {
  std::vector<std::string> all;
  for (const auto& c : list(speed, "crossings"))
    all.push_back(
        word(c, "sense") == "loss"
            ? say("chatter at {} from {}", hertz(c, "frequency_Hz"), mm(c, "ap_mm"))
            : say("stable again from {}", mm(c, "ap_mm")));
  return all.empty() ? tr("no chatter") : joined(all);
}

}  // namespace turnwright::report
