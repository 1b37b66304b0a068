#include "setup_words.hpp"

#include <algorithm>

#include "base/say.hpp"
#include "certificate_words.hpp"
#include "json_fields.hpp"
#include "result_words.hpp"
#include "turnwright/planning/limit_words.hpp"

namespace turnwright::report {
namespace {

using nlohmann::ordered_json;

std::string end_words(const std::string& end) {
  return end == "left" ? tr("left end") : tr("right end");
}

std::string clamped(const std::string& clamping, const std::string& hold) {
  const auto end = end_words(hold), other = end_words(hold == "left" ? "right" : "left");
  if (clamping == "chuck") return say("{} in the chuck", end);
  if (clamping == "chuck-steady") return say("{} in the chuck, on a steady rest", end);
  if (clamping == "chuck-tailstock")
    return say("{} in the chuck, {} on the tailstock centre", end, other);
  if (clamping == "tailstock-follow")
    return say("{} in the chuck, {} on the tailstock centre, a follow rest at the tool",
               end, other);
  if (clamping == "between-centres")
    return say("between centres, {} at the headstock", end);
  return end + ", " + clamping;
}

// A setup that no clamping can hold names one that it also rejects.
bool held(const ordered_json& setup) {
  const auto& rejected = list(setup, "rejected");
  return std::none_of(rejected.begin(), rejected.end(), [&](const ordered_json& r) {
    return word(r, "clamping") == word(setup, "clamping");
  });
}

bool same_conditions(const ordered_json& a, const ordered_json& b) {
  return std::ranges::all_of(
      std::initializer_list<const char*>{"ap_mm", "f_mm_rev", "vc_m_min"},
      [&](const char* key) { return number(a, key) == number(b, key); });
}

}  // namespace

std::string holding(const ordered_json& setup) {
  std::string text =
      held(setup) ? clamped(word(setup, "clamping"), word(setup, "hold"))
                  : say("{}, no clamping allowed can", end_words(word(setup, "hold")));
  if (const auto grip = number(setup, "grip_mm"))
    text += say(", {} mm gripped", shown(grip, 1));
  if (const auto force = number(setup, "grip_force_N"); force && *force > 0)
    text += say(", jaws with {} kN", shown(*force / 1000, 1));
  const auto eased = number(setup, "finishing_grip_force_N");
  if (eased && eased < number(setup, "grip_force_N"))
    text += say(", {} kN to finish", shown(*eased / 1000, 1));
  return text;
}

std::string setup_number(const ordered_json& member) {
  const auto setup = number(member, "setup");
  return setup ? shown(*setup + 1, 0) : "-";
}

std::vector<Passes> runs(const ordered_json& passes) {
  std::vector<Passes> all;
  for (const auto& pass : passes) {
    if (all.empty() || !same_conditions(*all.back().first, pass))
      all.push_back({.first = &pass});
    auto& run = all.back();
    ++run.count;
    if (const auto n = number(pass, "n_rpm")) {
      run.n_least = std::min(run.n_least, *n);
      run.n_most = std::max(run.n_most, *n);
    }
  }
  return all;
}

std::string speeds(const Passes& run) {
  if (!(run.n_least <= run.n_most)) return "-";
  const auto least = shown(run.n_least, 0), most = shown(run.n_most, 0);
  return least == most ? least : least + "-" + most;
}

namespace {

// What a milled place might bear where it is cut.
std::string milled(const ordered_json& cut) {
  const double depth = number(cut, "limit_mm").value_or(0);
  const bool beyond = depth >= number(cut, "shown_mm").value_or(0);
  const auto lanes = shown(number(cut, "lanes"), 0);
  const auto stable = shown(depth, 3);
  return (number(cut, "lanes") == 1 ? say("; {} lane", lanes)
                                    : say("; {} lanes", lanes)) +
         say(", fz {} mm; stable to {} mm within {} % of the speed, {} % more than the "
             "pass asked for",
             shown(number(cut, "fz_mm"), 4),
             beyond ? say("more than {}", stable) : stable,
             shown(100 * number(cut, "speed_margin").value_or(0), 1),
             shown(100 * number(cut, "stability_margin").value_or(0), 0));
}

}  // namespace

std::string note(const ordered_json& operation) {
  std::vector<std::string> on, binding;
  for (const auto& id : list(operation, "on"))
    if (id.is_string()) on.push_back(id.get<std::string>());
  for (const auto& c : list(operation, "constraints"))
    if (flag(c, "binding")) binding.push_back(planning::limit_words(word(c, "name")));
  const bool mills = operation.contains("milling");
  const auto direction = mills ? "" : word(operation, "direction");
  if (word(operation, "kind") == "fixed") {
    const auto bound = binding.empty() ? "" : say("; bound by {}", joined(binding));
    return say("{}; catalogue data", joined(on)) + bound;
  }
  std::string text = spoken(word(operation, "kind")) + " " + joined(on);
  if (direction == "from-chuck") text += tr(", away from the chuck");
  text +=
      binding.empty() ? tr("; no limit binds") : say("; bound by {}", joined(binding));
  if (mills) text += milled(operation.at("milling"));
  const auto& certificate = object(operation, "certificate");
  if (word(certificate, "kind") == "local") return text + "; " + perhaps(certificate);
  const auto reason = word(certificate, "reason");
  return reason.empty() ? text : text + "; " + reason;
}

}  // namespace turnwright::report
