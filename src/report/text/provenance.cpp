#include "provenance.hpp"

#include <algorithm>

#include "base/say.hpp"
#include "json_fields.hpp"
#include "layout.hpp"
#include "plan_words.hpp"

namespace turnwright::report {

using nlohmann::ordered_json;

std::string made_by(const ordered_json& result) {
  const auto version = word(result, "turnwright_version");
  const auto digest = word(result, "request_digest");
  if (version.empty() || digest.empty()) return "";
  return paragraph(tr("made by "),
                   say("turnwright {} from request {}", version, digest.substr(0, 12)));
}

std::string assumption_lines(const ordered_json& result) {
  constexpr std::size_t kWidth = kPageWidth - 2, kLeastValue = 16;
  std::string out;
  for (const auto& a : list(result, "assumed")) {
    const auto found = a.find("value");
    const auto value = found == a.end() ? "-" : value_text(*found);
    const std::string lead = word(a, "pointer") + " = ", why = ": " + word(a, "why");
    const auto taken = std::min(characters(lead + why), kWidth - kLeastValue);
    out += "  " + clipped(lead + clipped(value, kWidth - taken) + why, kWidth) + '\n';
  }
  if (out.empty()) return "";
  return '\n' + tr("ASSUMED  what the request left open") + '\n' + out;
}

std::string warnings(const ordered_json& result) {
  std::string out;
  for (const auto& warning : list(result, "warnings"))
    if (warning.is_string()) out += paragraph("  - ", warning.get<std::string>());
  return out.empty() ? "" : '\n' + tr("WARNINGS") + '\n' + out;
}

}  // namespace turnwright::report
