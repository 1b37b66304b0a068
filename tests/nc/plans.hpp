#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "document/json/file.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/nc/text.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::nc::test {

inline std::filesystem::path source(const std::string& path) {
  return std::filesystem::path(TURNWRIGHT_SOURCE_DIR) / path;
}

inline const document::Catalogue& catalogue() {
  static const auto kCatalogue = document::load_catalogue(source(""));
  return kCatalogue;
}

/// Names of the reference parts, without ".json".
inline std::vector<std::string> reference_parts() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source("parts")))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

struct Planned {
  planning::PreparedPart part;
  planning::ProcessPlan plan;
};

/// A document's plan, which is made once in a process.
inline const Planned& planned(const nlohmann::json& document) {
  static std::map<std::string, Planned> all;
  const auto key = document.dump();
  auto found = all.find(key);
  if (found == all.end()) {
    auto part = document::prepared_part(document, catalogue(), "part").part;
    auto plan = planning::plan(part);
    found = all.emplace(key, Planned{std::move(part), std::move(plan)}).first;
  }
  return found->second;
}

inline const Planned& planned_reference(const std::string& name) {
  auto document = document::parse_file(source("parts/" + name + ".json"));
  document.erase("what_if");
  return planned(document);
}

/// A part of tests/data/awkward_parts.json.
inline const Planned& planned_awkward(const std::string& name) {
  for (const auto& one : document::parse_file(source("tests/data/awkward_parts.json")))
    if (one["part"]["name"] == name) return planned(one["part"]);
  throw std::domain_error("no awkward part " + name);
}

/// Those with holes that are reamed or tapped.
inline constexpr std::array kWithHoles{"tapped-ends",
                                       "reamed-through",
                                       "reamed-behind-counterbore",
                                       "tapped-behind-counterbore",
                                       "tapped-through",
                                       "counterbored-chamfered",
                                       "counterbored-twice-reamed",
                                       "counterbored-from-the-left",
                                       "counterbored-before-thread",
                                       "chamfered-at-both-ends",
                                       "nut-chamfered-at-both-ends"};

}  // namespace turnwright::nc::test
