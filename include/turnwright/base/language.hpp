#pragma once
#include <map>
#include <string>
#include <string_view>

/// The language of sentences, headings and labels.  They are written in English where they
/// arise; languages/<language>/*.json of the data folder has their translations.  Keys of
/// documents, words of schemas and NC programs are the same in every language, and so is
/// every number.
namespace turnwright {

/// Translations by English text.  A text with values has the places "{}" of fmt; a
/// translation that needs them in another order numbers them, "{1} of {0}".
using Translations = std::map<std::string, std::string, std::less<>>;

/// Makes translated() answer in another language from now on.  To be called once, before any
/// other thread runs: the language is the program's.
/// @param language  its tag, "de"; texts without translation stay English
void speak(std::string language, Translations texts);

/// The tag of the program's language; "en" before speak().
const std::string& language() noexcept;

/// The English text in the program's language; as it is where no translation is known.
/// Valid until the next speak(); what is returned unchanged, as long as `english`.
std::string_view translated(std::string_view english) noexcept;

/// translated(), short for the many places that need it.
inline std::string tr(std::string_view english) {
  return std::string(translated(english));
}

/// Marks an English text of a table that is made before the language is known; whoever
/// shows it calls tr().
constexpr const char* to_translate(const char* english) noexcept { return english; }

}  // namespace turnwright
