// Every document of tests/data/malformed is refused with exactly the text beside it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <set>

#include "document/json/file.hpp"
#include "document/json/parse.hpp"
#include "test_catalogue.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/document/translations.hpp"

namespace turnwright::document::malformed_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> malformed_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source_path("tests/data/malformed")))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

InputError refusal(const fs::path& file) {
  try {
    prepared_part(parse_file(file, "part.json"), test_catalogue(), "part.json");
  } catch (const InputError& error) {
    return error;
  }
  return {"part.json", {{"", "accepted", "a refusal", ""}}};
}

TEST(Malformed, EachIsRefusedWithItsExactText) {
  const auto files = malformed_files();
  EXPECT_EQ(files.size(), 143U) << "docs/verification.md tells how many";
  for (const auto& file : files) {
    auto expected = file;
    expected.replace_extension(".expected");
    ASSERT_TRUE(fs::exists(expected)) << expected;
    EXPECT_EQ(std::string(refusal(file).what()) + "\n", text_of(expected)) << file;
  }
}

/// The language is the program's: English again for the tests that follow.
class MalformedInGerman : public ::testing::Test {
 protected:
  void SetUp() override { speak("de", translations(source_path(""), "de")); }
  void TearDown() override { speak("en", {}); }

  static std::vector<Problem> in_english(const fs::path& file) {
    speak("en", {});
    return refusal(file).problems();
  }
};

/// Whether a text has the same words in both languages, beside the document's JSON.
bool stayed(const std::string& german, const std::string& english) {
  static const std::regex kJson("\"[^\"]*(\"|$)|null|true|false"), kWord("[A-Za-z]{3}");
  return german == english &&
         std::regex_search(std::regex_replace(german, kJson, ""), kWord);
}

TEST_F(MalformedInGerman, HasThePlacesAndCodesOfEnglishAndOtherWords) {
  for (const auto& file : malformed_files()) {
    SetUp();
    const auto german = refusal(file).problems(), english = in_english(file);
    ASSERT_EQ(german.size(), english.size()) << file;
    for (std::size_t i = 0; i < german.size(); ++i) {
      EXPECT_EQ(german[i].pointer, english[i].pointer) << file;
      EXPECT_EQ(german[i].code, english[i].code) << file;
      EXPECT_FALSE(stayed(german[i].got, english[i].got)) << german[i].got;
      EXPECT_FALSE(stayed(german[i].expected, english[i].expected)) << german[i].expected;
    }
  }
}

TEST_F(MalformedInGerman, SpeaksInSentencesWithTheSameValues) {
  const auto said = [](const char* name) {
    return std::string(refusal(source_path("tests/data/malformed") / name).what());
  };
  EXPECT_EQ(said("005-missing-comma.json"),
            "part.json: Dokument: gegeben fehlerhaftes JSON in Zeile 4, Spalte 12: zwei "
            "Einträge oder Werte nebeneinander, erwartet ein Komma dazwischen");
  EXPECT_EQ(said("031-number-as-text.json"),
            "part.json: /outer/0/diameter_mm: gegeben \"30\", erwartet eine Zahl > 0 und "
            "<= 20000 mm");
  EXPECT_EQ(said("037-misspelt-key.json"),
            "part.json: /outer/0/diameter_mm: gegeben nichts, erwartet eine Zahl > 0 und "
            "<= 20000 mm\n"
            "part.json: /outer/0/diamter_mm: gegeben 30, erwartet kein solcher Schlüssel "
            "(vielleicht \"diameter_mm\"?)");
}

TEST(Malformed, APathThatIsNoFileIsRefused) {
  EXPECT_STREQ(refusal("/nowhere/part.json").what(),
               "part.json: document: got nothing readable, expected a JSON file");
  EXPECT_STREQ(refusal(source_path("parts")).what(),
               "part.json: document: got nothing readable, expected a JSON file");
}

TEST(Malformed, OneByteTooManyIsRefused) {
  const auto file = fs::path(testing::TempDir()) /
                    ("turnwright_too_large_" + std::to_string(::getpid()) + ".json");
  std::ofstream{file};
  fs::resize_file(file, kLocalLimits.bytes + 1);  // sparse
  EXPECT_STREQ(
      refusal(file).what(),
      "part.json: document: got 100000001 bytes, expected at most 100000000 bytes");
  fs::remove(file);
}

TEST(Malformed, DamagedDocumentsAreTakenOrRefusedAndNothingElse) {
  const auto good = text_of(source_path("tests/data/every_key_of_a_part.json"));
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::string bytes = "{}[],:\"0123456789-.eE\\nulltruefalse \n\xff\x01";
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    auto text = good;
    for (std::size_t slips = 1 + below(3); slips > 0; --slips) {
      const auto at = below(text.size());
      if (below(3) == 0)
        text.erase(at, 1 + below(20));
      else if (below(2) == 0)
        text.insert(at, text.substr(below(text.size()), below(30)));
      else
        text[at] = bytes[below(bytes.size())];
    }
    try {
      prepared_part(parse(text, "part.json"), test_catalogue(), "part.json");
    } catch (const InputError& error) {
      EXPECT_FALSE(error.problems().empty());
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
}

// Faults of shape are the schema's business too; which setup or price another key asks
// for, and what an inline document holds, it cannot see.
bool schema_sees(const Problem& problem) {
  static const std::set<std::string> kShape{"type", "range", "missing", "unknown-key",
                                            "format"};
  return kShape.contains(problem.code) && !problem.pointer.starts_with("/material/") &&
         !problem.pointer.starts_with("/tools/") && problem.pointer != "/rates/price" &&
         !problem.pointer.ends_with("/setup");
}

TEST(Malformed, TheSchemaSeesEveryFaultOfShape) {
  const SchemaCheck schema("part.json");
  int seen = 0;
  for (const auto& file : malformed_files()) {
    const auto problems = refusal(file).problems();
    if (std::none_of(problems.begin(), problems.end(), schema_sees)) continue;
    EXPECT_NE(schema.fault(parse_file(file)), "") << file;
    ++seen;
  }
  EXPECT_GE(seen, 30);
}

TEST(Malformed, ReferencesAndContradictionsAreBeyondTheSchema) {
  // What the reader alone sees must pass the schema, or the schema refuses good shapes.
  const SchemaCheck schema("part.json");
  static const std::set<std::string> kMeaning{"unknown-id", "order", "unsupported"};
  int seen = 0;
  for (const auto& file : malformed_files()) {
    const auto problems = refusal(file).problems();
    if (!std::all_of(problems.begin(), problems.end(),
                     [](const Problem& p) { return kMeaning.contains(p.code); }))
      continue;
    EXPECT_EQ(schema.fault(parse_file(file)), "") << file;
    ++seen;
  }
  EXPECT_GE(seen, 15);
}

}  // namespace
}  // namespace turnwright::document::malformed_test
