#pragma once
#include <cstddef>
#include <istream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Text to JSON, strictly: what nlohmann::json would let pass is refused here.
namespace turnwright::document {

/// Caps that keep a hostile document harmless.
struct ParseLimits {
  std::size_t bytes = 2'000'000;         ///< of the whole text
  std::size_t depth = 64;                ///< of nested objects and arrays
  std::size_t key_bytes = 200;           ///< of one key
  std::size_t string_bytes = 2'000'000;  ///< of one string value: tables, NC programs
};

/// Of a file or pipe that whoever runs the program names: a million NC blocks.
inline constexpr ParseLimits kLocalLimits{.bytes = 100'000'000,
                                          .string_bytes = 100'000'000};

/// The JSON value of `text`.  Refused, beyond what RFC 8259 forbids: duplicate keys (with
/// the pointer of the duplicate), numbers a double cannot hold (1e999, 1e-400), and
/// whatever exceeds the limits.  NaN and Infinity are no JSON.
/// @param document  name shown before every problem.
/// @throws InputError with line and column of a syntax error, or with every duplicate key
///   and number found.
nlohmann::json parse(std::string_view text, const std::string& document,
                     const ParseLimits& limits = {});
/// Of all that the stream still holds; no more is read than shows that it is too much.
nlohmann::json parse(std::istream& in, const std::string& document,
                     const ParseLimits& limits);

}  // namespace turnwright::document
