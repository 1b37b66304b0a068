#include "title_block.hpp"

namespace turnwright::document {

nlohmann::ordered_json title_block(const part::Drawing& drawing) {
  nlohmann::ordered_json out{{"name", drawing.name}};
  const auto add = [&out](const char* key, const std::string& value) {
    if (!value.empty()) out[key] = value;
  };
  add("drawing_number", drawing.title.drawing_number);
  add("revision", drawing.title.revision);
  add("customer", drawing.title.customer);
  return out;
}

}  // namespace turnwright::document
