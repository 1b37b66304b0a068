#pragma once
#include <string>
#include <string_view>

namespace turnwright::service {

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.  Source: FIPS 180-4.
std::string sha256_hex(std::string_view bytes);

/// The same in base64 (RFC 4648, section 4).
std::string sha256_base64(std::string_view bytes);

}  // namespace turnwright::service
