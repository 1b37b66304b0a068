#pragma once
#include <cstddef>
#include <string>

#include "library_tool.hpp"

namespace turnwright::document {

struct LibraryFile {
  std::string source;  ///< what it was read as: "fusion", "csv", "mtconnect", "freecad"
  ToolLibrary library;
};

/// Reads a tool library in one of the formats of library_readers.hpp, which its first bytes
/// show; archives are unpacked.
/// @param most_bytes  that an archive may unpack to; 1 MB and 50 times its size, if less
/// @param unit  of lengths in a table that does not say any, "mm" or "inch"
/// @throws InputError with what can be read if it is none of them, or with what is wrong in
///   it; pointers are places in the file.
LibraryFile read_library_file(const std::string& bytes, const std::string& unit,
                              std::size_t most_bytes);

}  // namespace turnwright::document
