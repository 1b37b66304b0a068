#pragma once
#include <cstddef>
#include <string>

namespace turnwright::app {

/// The bytes of a file, or of standard input if its name is "-".
/// @param what  it should be, "a STEP, DXF or text file".
/// @throws InputError if it cannot be read or has more than `most` bytes.
std::string bytes_of(const std::string& file, std::size_t most, const std::string& what);

/// What messages call it.
std::string name_of(const std::string& file);

}  // namespace turnwright::app
