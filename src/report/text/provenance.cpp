#include "provenance.hpp"

#include "json_fields.hpp"
#include "layout.hpp"

namespace turnwright::report {

using nlohmann::ordered_json;

std::string made_by(const ordered_json& result) {
  const auto version = word(result, "turnwright_version");
  const auto digest = word(result, "request_digest");
  if (version.empty() || digest.empty()) return "";
  return paragraph("made by ",
                   "turnwright " + version + " from request " + digest.substr(0, 12));
}

std::string warnings(const ordered_json& result) {
  std::string out;
  for (const auto& warning : list(result, "warnings"))
    if (warning.is_string()) out += paragraph("  - ", warning.get<std::string>());
  return out.empty() ? "" : "\nWARNINGS\n" + out;
}

}  // namespace turnwright::report
