#include "messages.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/say.hpp"
#include "service/listing.hpp"

namespace turnwright::service::mcp {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array kRevisions{"2025-06-18", "2025-11-25"};
constexpr std::string_view kScheme = "turnwright://";
constexpr const char* kInstructions =
    "Plans turned parts: clamping, passes, speed, feed and depth of every operation at "
    "the "
    "lowest cost inside all tolerances, with proof. Read turnwright://schemas/part and a "
    "document of turnwright://parts before writing a part; materials, machines and tools "
    "are named by the ids of their resources. Errors name the place in the document by a "
    "JSON pointer.";

std::string uri_of(const std::string& kind, const std::string& id) {
  return std::string(kScheme) + kind + '/' + id;
}

std::string schema_of(const Request& row) {
  return uri_of("schemas", std::filesystem::path(request_schema(row)).stem().string());
}

ordered_json tool(const Request& row) {
  return {{"name", row.name},
          {"title", tr(row.summary)},
          {"description", say("{}. The arguments are a document of the schema {}",
                              tr(row.summary), schema_of(row))},
          {"inputSchema",
           {{"type", "object"},
            {"description", say("as in {}", schema_of(row))},
            {"examples", ordered_json::array({ordered_json::parse(row.example)})}}},
          {"annotations", {{"readOnlyHint", true}, {"openWorldHint", false}}}};
}

ordered_json text_content(const std::string& text) {
  return ordered_json::array({{{"type", "text"}, {"text", text}}});
}

}  // namespace

ordered_json response(const json& id, ordered_json result) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

ordered_json error(const json& id, Fault fault, const std::string& message) {
  return {{"jsonrpc", "2.0"},
          {"id", id},
          {"error", {{"code", static_cast<int>(fault)}, {"message", message}}}};
}

ordered_json welcome(const json& parameters) {
  const auto asked = parameters.find("protocolVersion");
  const bool known = asked != parameters.end() &&
                     std::ranges::find(kRevisions, *asked) != kRevisions.end();
  return {{"protocolVersion", known ? ordered_json(*asked) : kRevisions.front()},
          {"capabilities",
           {{"tools", ordered_json::object()}, {"resources", ordered_json::object()}}},
          {"serverInfo",
           {{"name", "turnwright"}, {"title", "Turnwright"}, {"version", version()}}},
          {"instructions", kInstructions}};
}

ordered_json tools() {
  auto all = ordered_json::array();
  for (const auto& row : requests()) all.push_back(tool(row));
  return {{"tools", std::move(all)}};
}

ordered_json tool_result(const Request& row, ordered_json result) {
  auto text = row.text ? row.text(result) : result.dump();
  return {{"content", text_content(text)},
          {"structuredContent", std::move(result)},
          {"isError", false}};
}

ordered_json tool_failure(const std::string& message) {
  return {{"content", text_content(message)}, {"isError", true}};
}

Resources::Resources(const std::filesystem::path& folder) {
  for (const auto& [kind, documents] : read_documents(folder)) add(kind, documents);
  Documents schemas;
  for (const auto& [id, name] : list_schemas(folder)) {
    schemas.names[id] = name;
    schemas.texts[id] = schema_text(folder, id);
  }
  add("schemas", schemas);
}

void Resources::add(const std::string& kind, const Documents& documents) {
  for (const auto& [id, title] : documents.names)
    by_uri_[uri_of(kind, id)] = {id, title, documents.texts.at(id)};
}

ordered_json Resources::list() const {
  auto all = ordered_json::array();
  for (const auto& [uri, resource] : by_uri_)
    all.push_back({{"uri", uri},
                   {"name", resource.id},
                   {"title", resource.title},
                   {"mimeType", "application/json"}});
  return {{"resources", std::move(all)}};
}

std::optional<ordered_json> Resources::read(const std::string& uri) const {
  const auto found = by_uri_.find(uri);
  if (found == by_uri_.end()) return std::nullopt;
  return {{{"contents", ordered_json::array({{{"uri", uri},
                                              {"mimeType", "application/json"},
                                              {"text", found->second.text}}})}}};
}

}  // namespace turnwright::service::mcp
