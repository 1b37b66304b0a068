// Every text of the sources that is said in the program's language has a translation in each
// folder of languages/, and the other way round; a translation has the values of its text.
#include "turnwright/document/translations.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = TURNWRIGHT_SOURCE_DIR;

std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The literal that begins at text[at] == '"', as its characters; `at` is then behind it.
std::string literal(const std::string& text, std::size_t& at) {
  const auto begin = at++;
  while (text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  ++at;
  return nlohmann::json::parse(text.substr(begin, at - begin)).get<std::string>();
}

void skip_space(const std::string& text, std::size_t& at) {
  at = std::min(text.find_first_not_of(" \t\n", at), text.size());
}

/// The texts that `call` ("say", ..) is given in these files, literals beside each other joined.
std::set<std::string> texts_of(const fs::path& folder, const std::string& call,
                               const std::regex& files) {
  const std::regex begin("\\b(" + call + ")\\(\\s*(?=\")");
  std::set<std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!std::regex_search(entry.path().string(), files)) continue;
    const auto source = content(entry.path());
    for (std::sregex_iterator it(source.begin(), source.end(), begin), end; it != end;
         ++it) {
      auto at = static_cast<std::size_t>(it->position() + it->length());
      std::string text;
      for (; at < source.size() && source[at] == '"'; skip_space(source, at))
        text += literal(source, at);
      texts.insert(text);
    }
  }
  return texts;
}

std::set<std::string> all_texts() {
  auto texts =
      texts_of(kRoot / "src", "say|tr|translated|to_translate", std::regex("\\.[ch]pp$"));
  texts.merge(texts_of(kRoot / "web/src", "t|later", std::regex("\\.(ts|svelte)$")));
  return texts;
}

/// The values of a text: which, and how they are written.
std::set<std::pair<std::string, std::string>> values(const std::string& text) {
  static const std::regex kValue("\\{\\{|\\}\\}|\\{([^:}]*)(:[^}]*)?\\}");
  std::set<std::pair<std::string, std::string>> all;
  int next = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), kValue), end; it != end; ++it) {
    if (it->str() == "{{" || it->str() == "}}") continue;
    const auto name = (*it)[1].str();
    all.emplace(name.empty() ? std::to_string(next++) : name, (*it)[2].str());
  }
  return all;
}

TEST(Translations, AreCompleteAndHaveTheValuesOfTheirTexts) {
  const auto wanted = all_texts();
  for (const auto& language : languages(kRoot)) {
    if (language == "en") continue;
    const auto known = translations(kRoot, language);
    nlohmann::ordered_json missing, needless;
    for (const auto& text : wanted)
      if (!known.contains(text)) missing[text] = "";
    for (const auto& [english, text] : known) {
      if (!wanted.contains(english)) needless[english] = text;
      EXPECT_EQ(values(english), values(text)) << language << ": " << text;
      EXPECT_FALSE(text.empty()) << language << ": " << english;
    }
    EXPECT_TRUE(missing.empty()) << language << " lacks " << missing.dump(2);
    EXPECT_TRUE(needless.empty()) << language << " has in vain " << needless.dump(2);
  }
}

/// The language is the program's: English again for the tests that follow.
class Speaking : public ::testing::Test {
 protected:
  void TearDown() override { speak("en", {}); }
};

TEST_F(Speaking, TranslatesWhatIsKnownAndLeavesTheRest) {
  EXPECT_EQ(say("{} of {}", 1, "mm"), "1 of mm");
  speak("de", {{"{} of {}", "von {1} {0}"}});
  EXPECT_EQ(say("{} of {}", 1, "mm"), "von mm 1");
  EXPECT_EQ(say("{:.2f} mm", 1.5), "1.50 mm");
  EXPECT_EQ(tr("chuck"), "chuck");
}

TEST(Translations, AreReadFromTheFolderOfTheLanguage) {
  EXPECT_TRUE(translations(kRoot, "en").empty());
  try {
    translations(kRoot, "xx");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().at(0).pointer, "--language");
  }
}

}  // namespace
}  // namespace turnwright::document
