// A part's reports in German: its headings, and the numbers of the English ones.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "../../nc/plans.hpp"
#include "../words.hpp"
#include "report/page/html.hpp"
#include "report/text/terminal.hpp"
#include "report/text/text.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/document/translations.hpp"

namespace turnwright::report::german_report_test {
namespace {

/// German from speak_german() on, and English again for the tests that follow.
class GermanReport : public ::testing::Test {
 protected:
  static void speak_german() {
    speak("de", document::translations(nc::test::source(""), "de"));
  }
  void TearDown() override { speak("en", {}); }
};

struct Reported {
  document::PreparedDocument part;
  planning::ProcessPlan plan;
  nc::Programs programs;
  nlohmann::ordered_json result;

  std::string html() const {
    ShopPrograms shop{{}, "G54"};
    for (const auto& p : programs.setups)
      shop.files.push_back("program-" + std::to_string(p.setup));
    return report::html("Pin", result, {}, setup_sheets(part.part, plan, programs, shop));
  }
};

Reported planned(const std::string& name) {
  Reported r;
  r.part = document::prepared_part(
      document::parse_file(nc::test::source("parts/" + name + ".json")),
      nc::test::catalogue(), "part");
  r.plan = planning::plan(r.part.part, r.part.what_if);
  r.programs = nc::programs(r.part.part, r.plan);
  r.result = document::plan_result(r.plan, r.part);
  return r;
}

/// In whichever order a language has them.
std::multiset<std::string> numbers(const std::string& report) {
  const std::string text = std::regex_replace(report, std::regex("<[^>]*>"), " ");
  static const std::regex kNumber("[0-9]+([.][0-9]+)?");
  std::multiset<std::string> all;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it)
    all.insert(it->str());
  return all;
}

void expect_words(const std::string& report, const std::vector<std::string>& german,
                  const std::vector<std::string>& english) {
  for (const auto& words : german) EXPECT_TRUE(has(report, words)) << words;
  for (const auto& words : english) EXPECT_FALSE(has(report, words)) << words;
}

TEST_F(GermanReport, OfAFeasiblePartHasGermanHeadingsAndTheSameNumbers) {
  const auto r = planned("drilled-bush");
  const auto english = text(r.result), english_page = r.html();
  speak_german();
  const auto german = text(r.result), page = r.html();
  expect_words(
      german,
      {"ARBEITSPLAN", "\nStatus  jede Grenze ist eingehalten",
       "\nZEIT UND KOSTEN  je Teil\n", "\nAUFSPANNUNG 1  gespannt: linkes Ende im Futter",
       "\nTOLERANZEN\n", "\nBUDGET\n", "\nPREISE  ", "\nANGENOMMEN  ", "Schlichten",
       "Durchmesser"},
      {"PROCESS PLAN", "status", "SETUP", "TOLERANCES", "PRICES", "ASSUMED", "finish ",
       "bound by", " per part\n"});
  EXPECT_EQ(numbers(german), numbers(english));
  expect_words(page,
               {"<html lang=\"de\">", "<h1>Aufspannung 1 von 2 ", "<h2>Toleranzen</h2>",
                "<h2>Werkzeuge</h2>", "<h2>Prüfung</h2>", "<dt>Backen</dt>",
                "<dt>Nullpunkt</dt>", "gerüstet von, Datum"},
               {"<html lang=\"en\">", "Setup", "<h2>Tools", "<dt>Jaws", "Inspection"});
  EXPECT_EQ(numbers(page), numbers(english_page));
}

TEST_F(GermanReport, SaysWhatToDoAtAStopOfTheProgram) {
  const auto r = planned("gearbox-input-shaft");
  EXPECT_TRUE(has(r.html(), "<td>bring up the tailstock</td>"));
  speak_german();
  EXPECT_TRUE(has(r.html(), "<td>Reitstock anstellen</td>"));
}

TEST_F(GermanReport, OfAnInfeasiblePartHasEverySection) {
  const auto r = planned("infeasible-as-drawn");
  const auto english = text(r.result);
  speak_german();
  const auto german = text(r.result);
  expect_words(
      german,
      {"\nStatus  nicht durchführbar\n", "\nKONFLIKTE  ",
       "1. Gruppe 1: ", "\nZU LOCKERNDE GRENZEN  eine aus jeder Gruppe, ",
       "\nOHNE ERFOLG VERSUCHT  ", "sie verletzen Grenzen: nicht damit zerspanen."},
      {"infeasible", "CONFLICTS", "LIMITS TO RELAX", "TRIED"});
  EXPECT_EQ(numbers(german), numbers(english));
}

TEST_F(GermanReport, ItsHeadingsAreBoldAndItsStatusTellsByItsColour) {
  speak_german();
  EXPECT_EQ(styled("Status  jede Grenze ist eingehalten, d1"),
            "Status  \x1b[32mjede Grenze ist eingehalten, d1\x1b[0m");
  EXPECT_EQ(styled("Status  nur nominell eingehalten: 90 %"),
            "Status  \x1b[33mnur nominell eingehalten: 90 %\x1b[0m");
  EXPECT_EQ(styled("Status  nicht durchführbar"),
            "Status  \x1b[31mnicht durchführbar\x1b[0m");
  EXPECT_EQ(styled("ÜBERSICHT  je Teil"), "\x1b[1mÜBERSICHT\x1b[0m  je Teil");
  EXPECT_EQ(styled("Übersicht  je Teil"), "Übersicht  je Teil");
}

}  // namespace
}  // namespace turnwright::report::german_report_test
