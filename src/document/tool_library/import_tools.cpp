#include "turnwright/document/import_tools.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "base/say.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "document/exchange/given_file.hpp"
#include "document/json/fields.hpp"
#include "hole_tool_draft.hpp"
#include "library_file.hpp"
#include "tool_draft.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kDoor = "import-tools";

// A sentence stands once, with all the places that it is true of.
class PlacedRemarks {
 public:
  void add(const std::string& at, const std::string& text) {
    const auto [row, fresh] = rows_.try_emplace(text, list_.size());
    if (fresh) list_.push_back({{"at", ordered_json::array()}, {"text", text}});
    list_[row->second]["at"].push_back(at);
  }
  ordered_json json() const { return list_; }

 private:
  std::map<std::string, std::size_t> rows_;
  ordered_json list_ = ordered_json::array();
};

// Ids for files: letters, digits and "_.+-", each once.
class Ids {
 public:
  std::string of(const std::string& name) {
    constexpr std::size_t kLongest = 56;  // of 64, with room for a number
    std::string id;
    for (const unsigned char c : name) {
      if (id.size() == kLongest) break;
      const bool good = c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '.' ||
                                     c == '+' || c == '-');
      if (good && (!id.empty() || std::isalnum(c) != 0))
        id += static_cast<char>(c);
      else if (!good && !id.empty() && id.back() != '-')
        id += '-';
    }
    while (id.ends_with('-')) id.pop_back();
    if (id.empty()) id = "tool";
    int& number = last_[id];
    std::string fresh = id;
    while (!used_.insert(fresh).second) fresh = id + '-' + std::to_string(1 + ++number);
    return fresh;
  }

 private:
  std::set<std::string> used_;
  std::map<std::string, int> last_;  // how often a name had to be numbered
};

// What the catalogue's reader says to a document, "" if it accepts it.
std::string objection(const ordered_json& document) {
  const json value = document;
  Problems problems{.document = kDoor};
  if (value["format"] == "turnwright-fixed-tool/1")
    (void)read_fixed_tool(Reader(value, problems));
  else
    (void)read_tool(Reader(value, problems));
  if (problems.list.empty()) return "";
  const auto& p = problems.list.front();
  return say("Its document would be refused: {}: got {}, expected {}.", p.pointer, p.got,
             p.expected);
}

std::string letters(const std::vector<catalogue::IsoGroup>& groups) {
  std::string out;
  for (const auto& [word, group] : iso_groups())
    if (std::ranges::count(groups, group) > 0) out += word;
  return out;
}

ordered_json result_of(const LibraryFile& file, const std::string& groups) {
  ordered_json tools = ordered_json::array();
  PlacedRemarks assumed, contradictions, ignored;
  for (const auto& remark : file.library.ignored) ignored.add(remark.at, remark.text);
  Ids ids;
  for (const auto& tool : file.library.tools) {
    auto [document, assumptions, disagreements, refused] =
        tool.use.empty() ? tool_draft(tool, groups) : hole_tool_draft(tool, groups);
    if (refused.empty()) {
      document["id"] =
          ids.of(tool.id.empty() ? document["name"].get<std::string>() : tool.id);
      refused = objection(document);
    }
    for (const auto& sentence : disagreements) contradictions.add(tool.at, sentence);
    if (!refused.empty()) {
      ignored.add(tool.at, refused);
      continue;
    }
    const auto id = document["id"].get<std::string>();
    for (const auto& remark : assumptions) assumed.add(id + remark.at, remark.text);
    tools.push_back(std::move(document));
  }
  return {{"source", file.source},
          {"tools", std::move(tools)},
          {"assumed", assumed.json()},
          {"contradictions", contradictions.json()},
          {"ignored", ignored.json()}};
}

}  // namespace

ordered_json import_tools(const json& request) {
  Problems problems{.document = kDoor};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-import-tools/1");
  const auto given = read_given_file(r, to_translate("library"), kLargestLibrary);
  const Choices<const char*> units{{"mm", "mm"}, {"inch", "inch"}};
  const std::string unit = r.choice_or("unit", units, "mm");
  const std::string groups =
      r.has("groups") ? letters(read_set(r, "groups", iso_groups())) : "PMK";
  r.finish();
  problems.throw_if_any();

  try {
    return result_of(read_library_file(given.bytes, unit, kLargestLibrary), groups);
  } catch (const InputError& error) {
    rethrow_at(error, kDoor, given.pointer);
  }
}

}  // namespace turnwright::document
