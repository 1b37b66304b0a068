#include "file.hpp"

#include <fstream>

#include "parse.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {

nlohmann::json parse_file(const std::filesystem::path& path, std::string name) {
  if (name.empty()) name = path.string();
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(name, {{"", "nothing readable", "a JSON file", "file"}});
  return parse(in, name, kLocalLimits);
}

}  // namespace turnwright::document
