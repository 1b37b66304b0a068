// A plan says the same in every language: its numbers, ids and words of the schema are equal,
// and its sentences have the numbers of the English ones.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "../schema_check.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/document/translations.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::document::translated_plan_test {
namespace {

using nlohmann::ordered_json;

ordered_json plan_in(const std::string& language, const std::string& part) {
  const auto root = source_path("");
  speak(language, translations(root, language));
  const auto prepared =
      prepared_part(parse_file(source_path(part)), load_catalogue(root), part);
  return to_json(planning::plan(prepared.part), {});
}

std::multiset<std::string> numbers(const std::string& text) {
  static const std::regex kNumber("[0-9]+(?:\\.[0-9]+)?");
  return {std::sregex_token_iterator(text.begin(), text.end(), kNumber), {}};
}

/// The sentences that differ, by their pointers; everything else must be equal.
void compare(const ordered_json& english, const ordered_json& other,
             std::map<std::string, std::string>& sentences) {
  static const std::set<std::string> kSentences{"sentence", "where", "reason", "why"};
  const auto a = english.flatten(), b = other.flatten();
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [pointer, value] : a.items()) {
    ASSERT_TRUE(b.contains(pointer)) << pointer;
    const auto key = pointer.substr(pointer.rfind('/') + 1);
    if (!value.is_string() || !kSentences.contains(key)) {
      EXPECT_EQ(value, b[pointer]) << pointer;
      continue;
    }
    const auto text = b[pointer].get<std::string>();
    EXPECT_EQ(numbers(value), numbers(text)) << pointer << ": " << text;
    if (value != text) sentences[pointer] = text;
  }
}

class TranslatedPlan : public ::testing::Test {
 protected:
  void TearDown() override { speak("en", {}); }
};

TEST_F(TranslatedPlan, ExplainsAnInfeasiblePartInGermanWithTheSameNumbersAndLimits) {
  const auto part = "parts/infeasible-as-drawn.json";
  const auto english = plan_in("en", part);
  const auto german = plan_in("de", part);
  ASSERT_EQ(english["status"], "infeasible");
  std::map<std::string, std::string> sentences;
  compare(english, german, sentences);
  for (const std::string list : {"conflicts", "relax", "tried"}) {
    ASSERT_FALSE(german[list].empty()) << list;
    for (std::size_t i = 0; i < german[list].size(); ++i)
      EXPECT_TRUE(sentences.contains('/' + list + '/' + std::to_string(i) + "/sentence"))
          << german[list][i];
  }
  EXPECT_NE(sentences["/conflicts/0/sentence"].find("der Grenzwert ist 0.002 mm"),
            std::string::npos);
}

TEST_F(TranslatedPlan, OfAFeasiblePartHasTheSameNumbers) {
  const auto part = "parts/aluminium-tube.json";
  const auto english = plan_in("en", part);
  const auto german = plan_in("de", part);
  ASSERT_EQ(english["status"], "ok");
  std::map<std::string, std::string> sentences;
  compare(english, german, sentences);
  EXPECT_TRUE(sentences.contains("/prices/0/sentence"));
}

}  // namespace
}  // namespace turnwright::document::translated_plan_test
