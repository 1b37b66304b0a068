#include "turnwright/document/translations.hpp"

#include <algorithm>

#include "base/say.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::document {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnglish = "en";

std::vector<fs::path> sorted_content(const fs::path& folder) {
  std::error_code none;  // a data folder of one's own may have no languages
  std::vector<fs::path> content;
  for (const auto& entry : fs::directory_iterator(folder, none))
    content.push_back(entry.path());
  std::ranges::sort(content);
  return content;
}

void add(const fs::path& file, Translations& texts) {
  constexpr ParseLimits kSentences{.key_bytes = 10'000};
  const auto document = parse_file(file, "", kSentences);
  std::vector<Problem> problems;
  if (!document.is_object())
    problems.push_back({"", document.type_name(), tr("an object of texts"), "type"});
  for (const auto& [english, text] : document.items()) {
    if (!text.is_string())
      problems.push_back({'/' + english, text.dump(), tr("a text"), "type"});
    else if (!texts.emplace(english, text.get<std::string>()).second)
      problems.push_back(
          {'/' + english, text.dump(), tr("a text that no other file has"), "duplicate"});
  }
  if (!problems.empty()) throw InputError(file.string(), std::move(problems));
}

}  // namespace

std::vector<std::string> languages(const fs::path& data_folder) {
  std::vector<std::string> all{kEnglish};
  for (const auto& folder : sorted_content(data_folder / "languages"))
    if (fs::is_directory(folder)) all.push_back(folder.filename().string());
  return all;
}

Translations translations(const fs::path& data_folder, const std::string& language) {
  const auto known = languages(data_folder);
  if (std::ranges::find(known, language) == known.end()) {
    std::string all;
    for (const auto& one : known) all += (all.empty() ? "" : ", ") + one;
    throw InputError(tr("command line"), {{"--language", '"' + language + '"',
                                           say("one of {}", all), "choice"}});
  }
  Translations texts;
  if (language == kEnglish) return texts;
  for (const auto& file : sorted_content(data_folder / "languages" / language))
    if (file.extension() == ".json") add(file, texts);
  return texts;
}

}  // namespace turnwright::document
