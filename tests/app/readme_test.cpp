#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "document/json/file.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/choice.hpp"
#include "turnwright/planning/process_plan.hpp"

// What the README says is what the program does.
namespace turnwright {
namespace {

const std::filesystem::path kRoot = TURNWRIGHT_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string readme() { return text_of(kRoot / "README.md"); }

std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  std::vector<std::string> all;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    all.push_back((*it)[1]);
  return all;
}

// What links to a heading say: small letters, dashes for blanks, nothing else.
std::set<std::string> anchors(const std::string& text) {
  std::set<std::string> all;
  for (const auto& heading : found(text, "^#+ (.*)$")) {
    std::string anchor;
    for (const char c : heading)
      if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(c));
      else if (c == ' ')
        anchor += '-';
    all.insert(anchor);
  }
  return all;
}

std::vector<std::vector<std::string>> rows(const std::string& text, std::size_t cells) {
  std::vector<std::vector<std::string>> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] != '|') continue;
    std::vector<std::string> row;
    std::istringstream parts(line.substr(1));
    for (std::string cell; std::getline(parts, cell, '|');)
      row.push_back(std::regex_replace(cell, std::regex("^ +| +$"), ""));
    if (row.size() == cells) all.push_back(row);
  }
  return all;
}

// The best of all ways of making the part, as the program plans it.
planning::ProcessPlan chosen_plan(const nlohmann::json& part,
                                  const document::Catalogue& catalogue) {
  std::vector<planning::Candidate> all;
  for (const auto& way : document::prepared_candidates(part, catalogue, "part").usable)
    all.push_back({way.name, way.document.part, {}, {}, {}});
  return planning::choose(all, [](const auto&, auto&) {}).plan;
}

TEST(Readme, CostsAndClampingsAreThoseOfThePlans) {
  const auto catalogue = document::load_catalogue(kRoot);
  int checked = 0;
  for (const auto& row : rows(readme(), 3)) {
    const auto file = kRoot / "parts" / (row[0] + ".json");
    if (!std::filesystem::exists(file)) continue;
    ++checked;
    const auto plan = chosen_plan(document::parse_file(file), catalogue);
    if (row[1] == "infeasible") {
      EXPECT_EQ(plan.status, planning::PlanStatus::infeasible);
      for (const auto& c : plan.conflicts)
        EXPECT_NE(row[2].find(c.limit.substr(0, c.limit.find(' '))), std::string::npos)
            << c.limit;
      continue;
    }
    // The optimum is known to the certificate's gap.
    EXPECT_NEAR(std::stod(row[1]), plan.cost_per_part, 1e-4 * plan.cost_per_part)
        << row[0];
    std::string clampings;
    for (const auto& s : plan.setups)
      clampings += (clampings.empty() ? "" : ", ") + std::string(name(s.clamping));
    EXPECT_EQ(row[2], clampings);
  }
  const std::filesystem::directory_iterator parts(kRoot / "parts");
  EXPECT_EQ(checked, std::distance(begin(parts), end(parts))) << "a part has no row";
}

TEST(Readme, FilesItNamesExist) {
  const auto text = readme();
  const std::regex name(
      R"((scripts/\w+|docs/[\w/.-]+\w|parts/[\w-]+\.json|src/[\w/]+\.cpp|tests/\w+|src/\w+))");
  int count = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) {
    EXPECT_TRUE(std::filesystem::exists(kRoot / it->str())) << it->str();
    ++count;
  }
  EXPECT_GT(count, 20);
}

TEST(Docs, LinksAndTestsTheyNameExist) {
  namespace fs = std::filesystem;
  std::set<std::string> tests;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    tests.insert(entry.path().stem().string());
  std::vector<fs::path> files{kRoot / "README.md", kRoot / "CONTRIBUTING.md"};
  for (const auto& entry : fs::directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  int links = 0, named = 0;
  for (const auto& file : files) {
    const auto text = text_of(file);
    EXPECT_TRUE(found(text, "^(<<<<<<<|>>>>>>>) ").empty()) << file << ": half merged";
    for (const auto& link : found(text, R"(\]\(([^)]+)\))")) {
      if (link.starts_with("http")) continue;
      ++links;
      const auto hash = link.find('#');
      const auto path = link.substr(0, hash);
      const auto to = path.empty() ? file : file.parent_path() / path;
      EXPECT_TRUE(fs::exists(to)) << file << ": " << link;
      if (hash != std::string::npos) {
        EXPECT_TRUE(anchors(text_of(to)).contains(link.substr(hash + 1)))
            << file << ": " << link;
      }
    }
    for (const auto& test : found(text, "`(\\w+_test)`")) {
      ++named;
      EXPECT_TRUE(tests.contains(test)) << file << ": " << test;
    }
  }
  EXPECT_GT(links, 40);
  EXPECT_GT(named, 20);
}

TEST(Docs, SourcesTheyCiteAreInTheBibliography) {
  namespace fs = std::filesystem;
  const std::string key = R"(\[([A-Z][a-z]+ (?:19|20)\d\d)\])";
  const auto listed = found(text_of(kRoot / "docs" / "bibliography.md"), key);
  const std::set<std::string> known(listed.begin(), listed.end());
  int cited = 0;
  for (const auto* folder : {"include", "src", "docs", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const auto kind = entry.path().extension();
      if (kind != ".hpp" && kind != ".cpp" && kind != ".md") continue;
      if (entry.path().filename() == "bibliography.md") continue;
      for (const auto& source : found(text_of(entry.path()), key)) {
        ++cited;
        EXPECT_TRUE(known.contains(source)) << entry.path() << ": " << source;
      }
    }
  EXPECT_GT(cited, 40);
}

}  // namespace
}  // namespace turnwright
