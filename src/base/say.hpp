#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>

#include "turnwright/base/language.hpp"

namespace turnwright {

/// A sentence with values, in the program's language: fmt::format() whose format is translated
/// first.  The English format is checked when compiled, its translations by a test.
template <class... Values>
std::string say(fmt::format_string<Values...> english, Values&&... values) {
  const fmt::string_view text = english;
  return fmt::vformat(translated({text.data(), text.size()}),
                      fmt::make_format_args(values...));
}

}  // namespace turnwright
