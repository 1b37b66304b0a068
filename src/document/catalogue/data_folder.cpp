#include <cstdlib>

#include "turnwright/base/errors.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/catalogue.hpp"

// TURNWRIGHT_DATA_FROM_BIN (install's data folder as seen from its executables) and
// TURNWRIGHT_SOURCE_DATA (the source tree) come from the build.

namespace turnwright::document {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) { return fs::is_directory(folder / "materials"); }

fs::path required(const fs::path& folder, const std::string& who) {
  if (!holds_data(folder))
    throw InputError(who,
                     {{"", '"' + folder.string() + '"',
                       tr("a folder with materials/, tools/ and machines/"), "file"}});
  return folder;
}

}  // namespace

fs::path data_folder(const std::optional<fs::path>& given) {
  if (given) return required(*given, tr("data folder"));
  if (const char* variable = std::getenv("TURNWRIGHT_DATA"))
    return required(variable, "TURNWRIGHT_DATA");
  std::error_code unknown;  // no /proc: not an installation this can find
  const auto program = fs::read_symlink("/proc/self/exe", unknown);
  const auto installed =
      (program.parent_path() / TURNWRIGHT_DATA_FROM_BIN).lexically_normal();
  if (!unknown && holds_data(installed)) return installed;
  return required(TURNWRIGHT_SOURCE_DATA, tr("data folder"));
}

}  // namespace turnwright::document
