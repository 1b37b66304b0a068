#include "what_if.hpp"

#include <algorithm>
#include <cmath>

#include "document/json/fields.hpp"
#include "document/json/reference.hpp"
#include "part_sections.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/part_plan.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

constexpr std::size_t kMost = 20, kChanges = 50;
constexpr double kLeastPercent = -90, kMostPercent = 900;

// The member of a list by its index, or by its id.
json* member(json& list, const std::string& token) {
  for (auto& item : list)
    if (item.is_object() && item.value("id", json()) == token) return &item;
  const bool index = !token.empty() && token.size() < 4 &&
                     std::all_of(token.begin(), token.end(),
                                 [](char c) { return c >= '0' && c <= '9'; });
  if (!index || std::stoul(token) >= list.size()) return nullptr;
  return &list[std::stoul(token)];
}

// The value at a pointer whose last key may be new; nothing if there is no such place.
json* place(json& document, const std::string& pointer) {
  json* at = &document;
  std::size_t begin = 1;
  while (at && begin <= pointer.size()) {
    const auto end = std::min(pointer.find('/', begin), pointer.size());
    const auto token = pointer.substr(begin, end - begin);
    if (at->is_array())
      at = member(*at, token);
    else if (at->is_object() && (at->contains(token) || end == pointer.size()))
      at = &(*at)[token];
    else
      at = nullptr;
    begin = end + 1;
  }
  return at;
}

// The document with the changes of one entry, or the problem with one of them.
json changed(json document, const json& changes, const std::string& pointer,
             Problems& problems) {
  for (const auto& [path, value] : changes.items()) {
    json* at = path.starts_with('/') ? place(document, path) : nullptr;
    if (at)
      *at = value;
    else
      problems.add({pointer + "/set", "\"" + path + "\"",
                    tr("the place of a value in this document, as /outer/d1/fit or "
                       "/setups/0/clampings"),
                    "reference"});
  }
  return document;
}

std::string called(const json& entry) {
  if (entry.contains("name")) return entry["name"].get<std::string>();
  const double percent = entry["change_percent"].get<double>();
  return entry["limit"].get<std::string>() + (percent < 0 ? " " : " +") +
         number_text(percent) + " %";
}

}  // namespace

void read_what_if(Draft& draft) {
  if (draft.root.has("what_if") && draft.purpose == Purpose::predict)
    draft.root.problem_at("what_if", tr("nothing: only plan answers what_if"),
                          "unsupported");
  for (Reader item : draft.root.optional_items("what_if", 0, kMost)) {
    item = item.as_object();
    if (item.broken()) continue;
    const bool limit = item.has("limit") || item.has("change_percent");
    if (limit) {
      item.optional_text("name", 100);
      item.text("limit");
      const double percent =
          item.number("change_percent", within(kLeastPercent, kMostPercent, "%"));
      if (percent == 0)
        item.problem_at("change_percent", tr("a change other than 0"), "range");
    } else {
      item.text("name", 100);
      const auto set = item.object("set");
      if (!set.broken() && (set.json().empty() || set.json().size() > kChanges))
        item.problem_at("set", tr("1 to 50 changes, as {\"/outer/d1/fit\": \"h7\"}"),
                        "length");
      else if (!set.broken() && set.json().contains("/what_if"))
        item.problem_at("set", tr("no change of what_if itself"), "reference");
    }
    item.finish();
  }
}

std::vector<ChangedRequest> changed_requests(const json& request, Problems& problems) {
  std::vector<ChangedRequest> all;
  if (!request.contains("what_if")) return all;
  auto bare = request;
  bare.erase("what_if");
  bare.erase("pareto");
  for (std::size_t k = 0; k < request["what_if"].size(); ++k) {
    const auto& entry = request["what_if"][k];
    const auto pointer = "/what_if/" + std::to_string(k);
    if (entry.contains("limit")) {
      all.push_back({called(entry),
                     pointer + "/limit",
                     entry["limit"].get<std::string>(),
                     1 + entry["change_percent"].get<double>() / 100,
                     {}});
      continue;
    }
    const auto before = problems.list.size();
    auto document = changed(bare, entry["set"], pointer, problems);
    if (problems.list.size() == before)
      all.push_back({called(entry), pointer + "/set", "", 1, std::move(document)});
  }
  return all;
}

}  // namespace turnwright::document
