#include "turnwright/document/import_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <list>
#include <map>
#include <set>
#include <utility>

#include "document/catalogue/catalogue_readers.hpp"
#include "document/exchange/given_file.hpp"
#include "document/json/fields.hpp"
#include "document/json/parse.hpp"
#include "library_readers.hpp"
#include "tool_draft.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kDoor = "import-tools";
constexpr const char* kReadable =
    "a tool library of Fusion (.json, .tools), a table with symbols of ISO 13399 (.csv), "
    "MTConnect cutting tools (.xml) or bits of FreeCAD (.fctb, or a zip archive of them)";

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

struct Read {
  std::string source;
  ToolLibrary library;
};

[[noreturn]] void refuse_library(const std::string& got) {
  throw InputError(kDoor, {{"", got, kReadable, "format"}});
}

json parsed(const std::string& text) {
  return parse(text, kDoor, {.bytes = kLargestLibrary, .string_bytes = kLargestLibrary});
}

bool lists_files(const json& root) {
  const auto tools = root.is_object() ? root.find("tools") : root.end();
  return tools != root.end() && tools->is_array() && !tools->empty() &&
         tools->front().is_object() && tools->front().contains("path");
}

Read read_json(const std::string& text) {
  const json root = parsed(text);
  if (root.is_object() && root.contains("parameter"))
    return {"freecad", read_freecad_bits({{"the bit", &root}})};
  if (lists_files(root))
    refuse_library("a list of bits of FreeCAD (.fctl), which are files of their own");
  Problems problems{.document = kDoor};
  auto library = read_fusion_library(Reader(root, problems));
  problems.throw_if_any();
  return {"fusion", std::move(library)};
}

bool ends_with_any(std::string_view name, std::initializer_list<const char*> endings) {
  return std::ranges::any_of(endings,
                             [&](const char* ending) { return name.ends_with(ending); });
}

Read read_zip(const std::string& bytes) {
  // So that few bytes do not become many: libraries shrink to a thirtieth at most.
  const auto most_bytes = std::min(kLargestLibrary, 1'000'000 + 50 * bytes.size());
  const auto entries = zip_entries(bytes, most_bytes, [](std::string_view name) {
    return ends_with_any(name, {".json", ".fctb", ".p21", "package_meta_data.xml"});
  });
  std::list<json> values;
  std::vector<NamedJson> bits;
  for (const auto& entry : entries)
    if (entry.name.ends_with(".fctb"))
      bits.push_back({readable(entry.name), &values.emplace_back(parsed(entry.bytes))});
  if (!bits.empty()) return {"freecad", read_freecad_bits(bits)};
  for (const auto& entry : entries)
    if (entry.name.ends_with(".json")) return read_json(entry.bytes);
  refuse_library(entries.empty()
                     ? "a zip archive without tools.json and without .fctb files"
                     : "a GTC package: its data in ISO 13399 Part 21 are not read");
}

Read read_table(const std::string& bytes, const std::string& unit) {
  Problems problems{.document = kDoor};
  const json text = readable(bytes);
  std::vector<std::string> others;
  auto library = read_tool_table(Reader(text, problems), unit, others);
  problems.throw_if_any();
  for (const auto& name : others)
    library.ignored.push_back({"header", fmt::format("The column {} is not read.",
                                                     shown(shortened(name, 60)))});
  return {"csv", std::move(library)};
}

Read read_library(const std::string& bytes, const std::string& unit) {
  if (is_zip(bytes)) return read_zip(bytes);
  const auto begin = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const std::string_view rest =
      begin == bytes.npos ? std::string_view() : std::string_view(bytes).substr(begin);
  if (rest.starts_with('{') || rest.starts_with('[')) return read_json(std::string(rest));
  if (rest.starts_with("ISO-10303-21")) refuse_library("a file of ISO 10303-21");
  if (!rest.starts_with('<')) return read_table(bytes, unit);
  Problems problems{.document = kDoor};
  auto library = read_mtconnect(bytes, problems, "");
  problems.throw_if_any();
  return {"mtconnect", std::move(library)};
}

// What the catalogue's reader says to a document, "" if it accepts it.
std::string objection(const ordered_json& document) {
  const json value = document;
  Problems problems{.document = kDoor};
  (void)read_tool(Reader(value, problems));
  if (problems.list.empty()) return "";
  const auto& p = problems.list.front();
  return fmt::format("Its document would be refused: {}: got {}, expected {}.", p.pointer,
                     p.got, p.expected);
}

std::string letters(const std::vector<catalogue::IsoGroup>& groups) {
  std::string out;
  for (const auto& [word, group] : iso_groups())
    if (std::ranges::count(groups, group) > 0) out += word;
  return out;
}

}  // namespace

ordered_json import_tools(const json& request) {
  Problems problems{.document = kDoor};
  Reader r = Reader(request, problems).as_object();
  read_format(r, "turnwright-import-tools/1");
  const auto given = read_given_file(r, "library", kLargestLibrary);
  const Choices<const char*> units{{"mm", "mm"}, {"inch", "inch"}};
  const std::string unit = r.choice_or("unit", units, "mm");
  const std::string groups =
      r.has("groups") ? letters(read_set(r, "groups", iso_groups())) : "PMK";
  r.finish();
  problems.throw_if_any();

  Read read;
  try {
    read = read_library(given.bytes, unit);
  } catch (const InputError& error) {
    rethrow_at(error, kDoor, given.pointer);
  }
  ordered_json tools = ordered_json::array();
  PlacedRemarks assumed, contradictions, ignored;
  for (const auto& remark : read.library.ignored) ignored.add(remark.at, remark.text);
  Ids ids;
  for (const auto& tool : read.library.tools) {
    auto draft = tool_draft(tool, groups);
    if (draft.refused.empty()) {
      draft.document["id"] =
          ids.of(tool.id.empty() ? draft.document["name"].get<std::string>() : tool.id);
      draft.refused = objection(draft.document);
    }
    for (const auto& sentence : draft.contradictions)
      contradictions.add(tool.at, sentence);
    if (!draft.refused.empty()) {
      ignored.add(tool.at, draft.refused);
      continue;
    }
    const auto id = draft.document["id"].get<std::string>();
    for (const auto& remark : draft.assumed) assumed.add(id + remark.at, remark.text);
    tools.push_back(std::move(draft.document));
  }
  return {{"source", read.source},
          {"tools", std::move(tools)},
          {"assumed", assumed.json()},
          {"contradictions", contradictions.json()},
          {"ignored", ignored.json()}};
}

}  // namespace turnwright::document
