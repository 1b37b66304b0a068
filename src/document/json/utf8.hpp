#pragma once
#include <cstddef>
#include <string>

/// Texts of other programs as documents can hold them.
namespace turnwright::document {

/// The beginning of a text in UTF-8, of at most `bytes`; no character is cut.
std::string shortened(const std::string& text, std::size_t bytes);

/// A text in UTF-8: where it is none, every byte is a character of Latin-1.
std::string readable(std::string text);

}  // namespace turnwright::document
