#include "data_beside.hpp"

#include <dlfcn.h>

#include <cstdlib>

// TURNWRIGHT_DATA_FROM_LIB comes from the build: install's data folder as seen from its
// libraries.

namespace turnwright::library {

std::optional<std::filesystem::path> data_beside() {
  if (std::getenv("TURNWRIGHT_DATA")) return std::nullopt;
  Dl_info here;
  if (!::dladdr(reinterpret_cast<void*>(&data_beside), &here)) return std::nullopt;
  std::error_code unknown;  // a library that was deleted meanwhile
  const auto library = std::filesystem::canonical(here.dli_fname, unknown);
  const auto data = (library.parent_path() / TURNWRIGHT_DATA_FROM_LIB).lexically_normal();
  if (unknown || !std::filesystem::is_directory(data / "materials")) return std::nullopt;
  return data;
}

}  // namespace turnwright::library
