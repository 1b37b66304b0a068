#pragma once
#include <cstddef>
#include <string>

#include "turnwright/base/errors.hpp"

/// Files of other programs, which commands take instead of a request.
namespace turnwright::app {

struct ForeignFile {
  const char* small;       ///< "a drawing of at most so many"
  const char* kinds;       ///< "a STEP, DXF or text file"
  std::size_t most_bytes;  ///< larger ones are refused before they are read whole
};

/// The bytes of a file; "-" is standard input.
/// @throws InputError if it cannot be read or is too large.
std::string read_foreign_file(const std::string& file, const ForeignFile& kind);

/// The name under which its problems are told.
std::string name_of_foreign_file(const std::string& file);

/// Throws the problems of a request that was made from a file and options: those of the file
/// under its name, those of options under theirs.
[[noreturn]] void rethrow_of_foreign_file(const InputError& error,
                                          const std::string& file);

}  // namespace turnwright::app
