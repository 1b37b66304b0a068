#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "service/documents.hpp"
#include "service/requests.hpp"

/// The messages of the Model Context Protocol, revision 2025-06-18
/// (modelcontextprotocol.io/specification), which are JSON-RPC 2.0.
namespace turnwright::service::mcp {

/// Codes of JSON-RPC 2.0, section 5.1; the last one is the protocol's own.
enum class Fault {
  parse = -32700,
  invalid_request = -32600,
  unknown_method = -32601,
  invalid_parameters = -32602,
  internal = -32603,
  busy = -32000,
  unknown_resource = -32002
};

nlohmann::ordered_json response(const nlohmann::json& id, nlohmann::ordered_json result);
/// @param id  null if the request's own could not be read.
nlohmann::ordered_json error(const nlohmann::json& id, Fault fault,
                             const std::string& message);

/// The answer to `initialize`: the revision that was asked for if it is known here.
nlohmann::ordered_json welcome(const nlohmann::json& parameters);

/// The rows of the request table as tools.  Their schemas are resources, which a model
/// reads when it needs them: together they would fill its context.
nlohmann::ordered_json tools();

/// The result of a tool, for a model to read and for a program.
nlohmann::ordered_json tool_result(const Request& row, nlohmann::ordered_json result);
/// A tool that failed, told so that whoever called can correct the request.
nlohmann::ordered_json tool_failure(const std::string& message);

/// The documents and schemas of a data folder as resources, turnwright://parts/pump-shaft.
class Resources {
 public:
  /// @throws InputError if a document cannot be read.
  explicit Resources(const std::filesystem::path& folder);
  nlohmann::ordered_json list() const;
  /// None if there is no such resource.
  std::optional<nlohmann::ordered_json> read(const std::string& uri) const;

 private:
  struct Resource {
    std::string id, title, text;
  };
  void add(const std::string& kind, const Documents& documents);

  std::map<std::string, Resource> by_uri_;
};

}  // namespace turnwright::service::mcp
