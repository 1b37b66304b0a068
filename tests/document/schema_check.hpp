#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <valijson/schema.hpp>

namespace turnwright::document {

/// A file or folder of the source tree.
std::filesystem::path source_path(const std::string& path);

/// One of schemas/, ready to hold documents against.
class SchemaCheck {
 public:
  explicit SchemaCheck(const std::string& file);

  /// A fault the schema sees, "" if there is none.
  std::string fault(const nlohmann::json& document) const;

 private:
  nlohmann::json text_;
  valijson::Schema schema_;
};

}  // namespace turnwright::document
