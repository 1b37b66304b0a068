#include "turnwright/document/file.hpp"

#include <fstream>

#include "turnwright/base/errors.hpp"
#include "turnwright/document/parse.hpp"

namespace turnwright::document {

nlohmann::json parse_file(const std::filesystem::path& path, std::string name) {
  if (name.empty()) name = path.string();
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(name, {{"", "nothing readable", "a JSON file", "file"}});
  // One byte more than allowed is enough for parse() to refuse the rest.
  std::string text(ParseLimits{}.bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse(text, name);
}

}  // namespace turnwright::document
