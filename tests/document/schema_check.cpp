#include "schema_check.hpp"

#include <memory>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "document/json/file.hpp"

namespace turnwright::document {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

std::filesystem::path source_path(const std::string& path) {
  return std::filesystem::path(TURNWRIGHT_SOURCE_DIR) / path;
}

// Schemas refer to each other by their file names, which valijson resolves against $id.
SchemaCheck::SchemaCheck(const std::string& file)
    : text_(parse_file(source_path("schemas") / file)) {
  text_["$id"] = "file:///" + file;
  const auto fetched = [](const std::string& uri) -> const nlohmann::json* {
    const auto other = uri.substr(uri.rfind('/') + 1);
    return std::make_unique<nlohmann::json>(parse_file(source_path("schemas") / other))
        .release();
  };
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(Adapter(text_), schema_, fetched,
                      std::default_delete<const nlohmann::json>());
}

std::string SchemaCheck::fault(const nlohmann::json& document) const {
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema_, Adapter(document), &results)) return "";
  valijson::ValidationResults::Error error;
  results.popError(error);
  std::string where;
  for (const auto& step : error.context) where += step;
  return where + ": " + error.description;
}

}  // namespace turnwright::document
