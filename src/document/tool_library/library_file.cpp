#include "library_file.hpp"

#include <algorithm>
#include <initializer_list>
#include <list>
#include <string_view>
#include <utility>

#include "base/say.hpp"
#include "document/json/parse.hpp"
#include "library_readers.hpp"

namespace turnwright::document {
namespace {

using nlohmann::json;

constexpr const char* kLibrary = "tool library";
constexpr const char* kReadable = to_translate(
    "a tool library of Fusion (.json, .tools), a table with symbols of ISO 13399 (.csv), "
    "MTConnect cutting tools (.xml) or bits of FreeCAD (.fctb, also several with their "
    "library .fctl, or a zip archive of them)");

[[noreturn]] void refuse_library(const std::string& got) {
  throw InputError(kLibrary, {{"", got, tr(kReadable), "format"}});
}

// The JSON of a file of an archive, or of the only file.
json parsed(const std::string& text, const std::string& file) {
  try {
    return parse(text, kLibrary, {.bytes = text.size(), .string_bytes = text.size()});
  } catch (const InputError& error) {
    auto problems = error.problems();
    for (auto& p : problems)
      if (!file.empty()) p.pointer = file + (p.pointer.empty() ? "" : ": ") + p.pointer;
    throw InputError(kLibrary, std::move(problems));
  }
}

bool lists_files(const json& root) {
  const auto tools = root.is_object() ? root.find("tools") : root.end();
  return tools != root.end() && tools->is_array() && !tools->empty() &&
         tools->front().is_object() && tools->front().contains("path");
}

LibraryFile read_json(const std::string& text, const std::string& file) {
  const json root = parsed(text, file);
  if (root.is_object() && root.contains("parameter"))
    return {"freecad", read_freecad_bits({{tr("the bit"), &root}})};
  if (lists_files(root))
    refuse_library(
        tr("a list of bits of FreeCAD (.fctl), which are files of their own: give them "
           "with it, as files or in a zip archive"));
  Problems problems{.document = kLibrary};
  auto library = read_fusion_library(Reader(root, problems));
  problems.throw_if_any();
  return {"fusion", std::move(library)};
}

bool ends_with_any(std::string_view name, std::initializer_list<const char*> endings) {
  return std::ranges::any_of(endings,
                             [&](const char* ending) { return name.ends_with(ending); });
}

LibraryFile read_zip(const std::string& bytes, std::size_t largest) {
  // So that few bytes do not become many: libraries shrink to a thirtieth at most.
  const auto most_bytes = std::min(largest, 1'000'000 + 50 * bytes.size());
  const auto entries = zip_entries(bytes, most_bytes, [](std::string_view name) {
    return ends_with_any(name,
                         {".json", ".fctb", ".fctl", ".p21", "package_meta_data.xml"});
  });
  std::list<json> values;
  std::vector<NamedJson> bits, libraries;
  for (const auto& entry : entries) {
    if (!ends_with_any(entry.name, {".fctb", ".fctl"})) continue;
    const auto name = readable(entry.name);
    (entry.name.ends_with(".fctb") ? bits : libraries)
        .push_back({name, &values.emplace_back(parsed(entry.bytes, name))});
  }
  if (!bits.empty()) return {"freecad", read_freecad_libraries(libraries, bits)};
  for (const auto& entry : entries)
    if (entry.name.ends_with(".json"))
      return read_json(entry.bytes, readable(entry.name));
  refuse_library(entries.empty()
                     ? tr("a zip archive without tools.json and without .fctb files")
                     : tr("a GTC package: its data in ISO 13399 Part 21 are not read"));
}

LibraryFile read_table(const std::string& bytes, const std::string& unit) {
  Problems problems{.document = kLibrary};
  const json text = readable(bytes);
  std::vector<std::string> others;
  auto library = read_tool_table(Reader(text, problems), unit, others);
  problems.throw_if_any();
  for (const auto& name : others)
    library.ignored.push_back(
        {"header", say("The column {} is not read.", shown(shortened(name, 60)))});
  return {"csv", std::move(library)};
}

}  // namespace

LibraryFile read_library_file(const std::string& bytes, const std::string& unit,
                              std::size_t most_bytes) {
  if (is_zip(bytes)) return read_zip(bytes, most_bytes);
  const auto begin = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const std::string_view rest =
      begin == bytes.npos ? std::string_view() : std::string_view(bytes).substr(begin);
  if (rest.starts_with('{') || rest.starts_with('['))
    return read_json(std::string(rest), "");
  if (rest.starts_with("ISO-10303-21")) refuse_library(tr("a file of ISO 10303-21"));
  if (!rest.starts_with('<')) return read_table(bytes, unit);
  Problems problems{.document = kLibrary};
  auto library = read_mtconnect(bytes, problems, "");
  problems.throw_if_any();
  return {"mtconnect", std::move(library)};
}

}  // namespace turnwright::document
