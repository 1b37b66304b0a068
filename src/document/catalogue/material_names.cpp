#include "material_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/say.hpp"

namespace turnwright::document {
namespace {

constexpr std::array<std::string_view, 7> kSystems{"aisi", "sae", "jis", "uns",
                                                   "din",  "en",  "wnr"};

std::string letters_and_digits(const std::string& name) {
  std::string out;
  for (const unsigned char c : name)
    if (std::isalnum(c) != 0) out += static_cast<char>(std::tolower(c));
  return out;
}

std::string without_system(const std::string& name) {
  auto key = letters_and_digits(name);
  for (const auto system : kSystems)
    if (key.starts_with(system)) return key.substr(system.size());
  return key;
}

}  // namespace

std::vector<catalogue::Material> materials_called(
    const std::string& name, const std::vector<catalogue::Material>& materials) {
  const auto with_id = [&](const auto& m) { return m.id == name; };
  const auto exact = std::find_if(materials.begin(), materials.end(), with_id);
  if (exact != materials.end()) return {*exact};
  const auto key = without_system(name);
  std::vector<catalogue::Material> found;
  if (key.empty()) return found;
  const auto called = [&](const std::string& other) {
    return without_system(other) == key;
  };
  for (const auto& m : materials)
    if (called(m.id) || called(m.name) ||
        std::any_of(m.synonyms.begin(), m.synonyms.end(), called))
      found.push_back(m);
  return found;
}

std::string expected_state(const std::vector<catalogue::Material>& candidates) {
  std::string list;
  for (const auto& m : candidates) {
    const auto one = '"' + m.id + "\" (" + m.name + ')';
    list = list.empty() ? one : say("{} or {}", list, one);
  }
  return say("one of the materials that are called so: {}", list);
}

}  // namespace turnwright::document
