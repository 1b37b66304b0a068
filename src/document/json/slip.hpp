#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace turnwright::document {

/// What somebody meant who wrote broken JSON.
struct Slip {
  std::string got;     ///< "1,6"
  std::string wanted;  ///< "1.6, with a decimal point"
};

/// A usual slip where a parser stopped: a decimal comma, a comma too many or missing, a
/// comment, single quotes, a key without quotes, a number that begins with its point or a plus
/// sign.
/// @param bytes_read  the parser's last byte is text[bytes_read - 1].
/// @param reason  what the parser says of it.
std::optional<Slip> usual_slip(std::string_view text, std::size_t bytes_read,
                               std::string_view reason);

}  // namespace turnwright::document
