#pragma once
#include <string>

#include "document/json/reader.hpp"

/// The bytes of a foreign file in a request, as "text" or in "base64".
namespace turnwright::document {

struct GivenFile {
  std::string bytes;
  std::string pointer;  ///< where they stand in the request
};

/// @param what  what the file is, the English text "drawing", for problems.
GivenFile read_given_file(Reader& r, const std::string& what, std::size_t most_bytes);

/// The bytes that a text gives in base64; "" if it cannot, which is reported.
std::string read_base64(const Reader& at, const std::string& what,
                        std::size_t most_bytes);

/// The base64 of bytes (RFC 4648).
std::string base64_of(const std::string& bytes);

/// Throws what was found in a file again as problems of the request: at `pointer`, the place
/// in the file before what was found there.
/// @param document  name of the request, shown before every problem.
[[noreturn]] void rethrow_at(const InputError& error, const std::string& document,
                             const std::string& pointer);

}  // namespace turnwright::document
