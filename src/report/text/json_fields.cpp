#include "json_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace turnwright::report {

using nlohmann::ordered_json;

const ordered_json& list(const ordered_json& parent, const char* key) {
  static const ordered_json kEmpty = ordered_json::array();
  const auto found = parent.find(key);
  return found != parent.end() && found->is_array() ? *found : kEmpty;
}

const ordered_json& object(const ordered_json& parent, const char* key) {
  static const ordered_json kEmpty = ordered_json::object();
  const auto found = parent.find(key);
  return found != parent.end() && found->is_object() ? *found : kEmpty;
}

std::string word(const ordered_json& parent, const char* key) {
  const auto found = parent.find(key);
  return found != parent.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<double> number(const ordered_json& parent, const char* key) {
  const auto found = parent.find(key);
  if (found == parent.end() || !found->is_number()) return {};
  return found->get<double>();
}

bool flag(const ordered_json& parent, const char* key) {
  const auto found = parent.find(key);
  return found != parent.end() && found->is_boolean() && found->get<bool>();
}

std::string shown(std::optional<double> value, int decimals) {
  if (!value) return "-";
  if (!(std::abs(*value) < 1e7)) return fmt::format("{:.4g}", *value);
  auto text = fmt::format("{:.{}f}", *value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-')
    text.erase(0, 1);  // nothing has no sign
  return text;
}

std::string significant(std::optional<double> value, int digits) {
  return value ? fmt::format("{:.{}g}", *value, digits) : "-";
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  return fmt::format("{}", fmt::join(words, between));
}

}  // namespace turnwright::report
