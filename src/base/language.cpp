#include "turnwright/base/language.hpp"

#include <utility>

namespace turnwright {
namespace {

struct Language {
  std::string tag = "en";
  Translations texts;
};

Language& spoken() {
  static Language one;
  return one;
}

}  // namespace

void speak(std::string language, Translations texts) {
  spoken() = {std::move(language), std::move(texts)};
}

const std::string& language() noexcept { return spoken().tag; }

std::string_view translated(std::string_view english) noexcept {
  const auto& texts = spoken().texts;
  const auto text = texts.find(english);
  return text == texts.end() ? english : std::string_view(text->second);
}

}  // namespace turnwright
