#include "file.hpp"

#include <fstream>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {

nlohmann::json parse_file(const std::filesystem::path& path, std::string name,
                          const ParseLimits& limits) {
  if (name.empty()) name = path.string();
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(name, {{"", tr("nothing readable"), tr("a JSON file"), "file"}});
  return parse(in, name, limits);
}

}  // namespace turnwright::document
