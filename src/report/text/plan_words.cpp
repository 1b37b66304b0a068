#include "plan_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "amounts.hpp"
#include "base/say.hpp"
#include "json_fields.hpp"
#include "result_words.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

constexpr double kTold = 2;  // a larger ratio says no more in percent

// "set 2: ", where there is more than one.
std::string set_of(const ordered_json& member, const ordered_json& all) {
  const auto set = number(member, "set");
  const bool several = std::any_of(all.begin(), all.end(), [](const ordered_json& other) {
    return number(other, "set").value_or(0) > 1;
  });
  return set && several ? say("set {}: ", shown(set, 0)) : "";
}

// |ln(needed/now)|: how far a limit has to move, whichever way opens it.
double opening(const ordered_json& relaxation) {
  const auto now = number(relaxation, "now"), needed = number(relaxation, "needed");
  if (!now || !needed || !(*now > 0) || !(*needed > 0))
    return std::numeric_limits<double>::infinity();
  return std::abs(std::log(*needed / *now));
}

}  // namespace

std::string sentence_of(const ordered_json& member) {
  const auto sentence = word(member, "sentence");
  return sentence.empty() ? word(member, "limit") : sentence;
}

std::vector<std::string> sentences_of(const ordered_json& members) {
  std::vector<std::string> sentences;
  for (const auto& member : members) sentences.push_back(sentence_of(member));
  return sentences;
}

std::vector<std::string> conflict_sentences(const ordered_json& result) {
  const auto& all = list(result, "conflicts");
  std::vector<std::string> sentences;
  for (const auto& conflict : all)
    sentences.push_back(set_of(conflict, all) + sentence_of(conflict));
  return sentences;
}

bool several_sets(const ordered_json& members) {
  return std::any_of(members.begin(), members.end(), [&](const ordered_json& member) {
    return !set_of(member, members).empty();
  });
}

std::vector<std::string> opening_sentences(const ordered_json& result) {
  const auto& members = list(result, "relax");
  std::vector<const ordered_json*> all;
  for (const auto& relaxation : members) all.push_back(&relaxation);
  std::stable_sort(all.begin(), all.end(), [](const auto* a, const auto* b) {
    return opening(*a) < opening(*b);
  });
  std::vector<std::string> sentences;
  for (const auto* relaxation : all) {
    auto sentence = set_of(*relaxation, members) + sentence_of(*relaxation);
    const double by = opening(*relaxation);
    if (std::isfinite(by)) {
      const double ratio = *number(*relaxation, "needed") / *number(*relaxation, "now");
      if (ratio <= kTold) sentence += fmt::format(" [{:+.1f} %]", 100 * (ratio - 1));
    }
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

std::string what_stays(const ordered_json& result) {
  const auto in_set = [](const auto& member) { return member.contains("set"); };
  const auto &relax = list(result, "relax"), &conflicts = list(result, "conflicts");
  const bool stays = !relax.empty() && std::ranges::all_of(relax, in_set) &&
                     !std::ranges::all_of(conflicts, in_set);
  return stays ? tr("Relaxing limits is not enough: the conflicts that belong to no set "
                    "stay.")
               : "";
}

std::string kind_words(std::string kind) {
  std::ranges::replace(kind, '-', ' ');
  constexpr std::string_view kJoined = "runout";
  if (const auto at = kind.find(kJoined); at != kind.npos)
    kind.replace(at, kJoined.size(), "run-out");
  return spoken(kind);
}

std::string title_block(const ordered_json& result) {
  std::vector<std::string> parts;
  for (const auto& [key, before] : {std::pair{"drawing_number", ""},
                                    {"revision", to_translate("revision ")},
                                    {"customer", to_translate("for ")}})
    if (const auto value = word(result, key); !value.empty())
      parts.push_back(tr(before) + value);
  return joined(parts);
}

std::string micrometres(const ordered_json& tolerance, const char* key) {
  std::vector<std::string> parts;
  for (const auto& value : list(tolerance, key))
    parts.push_back(value.is_number() ? shown(units::um_from_mm(value.get<double>()), 1)
                                      : "-");
  if (!parts.empty()) return joined(parts, "..");
  const auto value = number(tolerance, key);
  return value ? shown(units::um_from_mm(*value), 1) : "-";
}

std::string verdict(const ordered_json& tolerance) {
  const auto ours = word(tolerance, "verdict");
  if (ours == "met-with-offset") return tr("offset");
  return ours == "not-met" ? tr("NOT MET") : spoken(ours);
}

std::string other_verdict(const ordered_json& tolerance) {
  const bool accepted = word(tolerance, "verdict") != "not-met";
  if (!tolerance.contains("published_verdict") ||
      flag(tolerance, "published_verdict") == accepted)
    return "";
  return accepted ? tr("not met") : tr("met");
}

bool published_differ(const ordered_json& tolerances) {
  return std::ranges::any_of(
      tolerances, [](const ordered_json& t) { return !other_verdict(t).empty(); });
}

std::string kept_by(const ordered_json& tolerance) {
  const auto p = number(tolerance, "P_conform");
  return p ? shown(100 * *p, 2) : "-";
}

bool keeps_too_few(const ordered_json& result) {
  constexpr double kRounding = 1e-6;
  const auto& worst = object(result, "worst_conformance");
  const auto p = number(worst, "P_conform"), wanted = number(worst, "wanted");
  return p && wanted && *p < *wanted - kRounding;
}

std::string kept(const ordered_json& result) {
  const auto& worst = object(result, "worst_conformance");
  const auto p = number(worst, "P_conform");
  if (!p) return tr("every limit is kept");
  const auto percent = shown(100 * *p, 2), id = word(worst, "tolerance");
  if (keeps_too_few(result)) {
    const auto wanted = number(worst, "wanted");
    int digits = 2;  // as many as tell the two apart
    while (shown(100 * *p, digits) == shown(100 * *wanted, digits)) ++digits;
    return say("kept nominally only: {} % of the parts keep {}, wanted are {} %",
               shown(100 * *p, digits), id, shown(100 * *wanted, digits));
  }
  return say("every limit is kept, {} by the fewest parts, {} %", id, percent);
}

std::string money_of(const ordered_json& result, std::optional<double> value) {
  const auto currency = word(result, "currency");
  return currency.empty() ? money(value) : money(value) + " " + currency;
}

std::string setting_up(const ordered_json& result) {
  const auto& s = object(result, "setting_up");
  const auto minutes = number(s, "min"), cost = number(s, "cost");
  if (!minutes || !cost) return "";
  const auto once =
      say("{} and {} once per batch", duration(minutes), money_of(result, cost));
  const auto share = number(s, "min_per_part");
  if (!share)
    return say("{}; not counted per part, because the request gives no batch size", once);
  return say("{}, of which {} and {} are counted per part", once, duration(share),
             money_of(result, number(s, "cost_per_part")));
}

Stack stack_of(const ordered_json& tolerance) {
  Shares shares;
  for (const auto& s : list(tolerance, "shares"))
    shares.emplace_back(word(s, "source"), number(s, "um").value_or(0));
  const bool size = list(tolerance, "predicted_mm").size() == 2;
  return stack(units::um_from_mm(number(tolerance, "width_mm").value_or(0)),
               units::um_from_mm(number(tolerance, "margin_mm").value_or(0)),
               size ? 2 : 1, shares);
}

std::vector<SpendingRow> spending(const ordered_json& result) {
  constexpr std::pair<const char*, const char*> kKinds[]{
      {"cutting", to_translate("cutting")},
      {"air", to_translate("in the air: approaches, overruns, rapids")},
      {"tool_changes", to_translate("bringing in tools")},
      {"operator_stops", to_translate("operator's stops")},
      {"edges", to_translate("worn edges")},
      {"loading", to_translate("loading")},
      {"setup_share", to_translate("preparing the machine, share of the batch")},
      {"stock", to_translate("the piece of stock")}};
  const auto& b = object(result, "breakdown");
  std::vector<SpendingRow> rows;
  SpendingRow sum{tr("together")};
  for (const auto& [key, name] : kKinds) {
    const auto& share = object(b, key);
    const double time = number(share, "time_min").value_or(0),
                 cost = number(share, "cost").value_or(0);
    if (time > 0 || cost > 0) rows.push_back({tr(name), time, cost});
    sum.time_min += time;
    sum.cost += cost;
  }
  if (!rows.empty()) rows.push_back(sum);
  return rows;
}

std::string preparing(const ordered_json& result) {
  const auto share =
      number(object(object(result, "breakdown"), "setup_share"), "time_min");
  if (!share || !(*share > 0)) return "";
  return say(", {} of it to prepare the machine", duration(share));
}

std::string value_text(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_structured()) {
    std::vector<std::string> parts;
    for (const auto& [key, member] : value.items()) {
      const auto text =
          member.is_structured() ? '(' + value_text(member) + ')' : value_text(member);
      parts.push_back(value.is_object() ? key + ' ' + text : text);
    }
    return joined(parts);
  }
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace turnwright::report
