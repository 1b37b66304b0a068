#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace turnwright::service {

/// The OpenAPI 3.1 document of the HTTP API, from the request table and the schemas in
/// `folder`/schemas.  @throws InputError if a schema cannot be read.
nlohmann::ordered_json openapi(const std::filesystem::path& folder);

}  // namespace turnwright::service
