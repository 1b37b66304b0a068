// No number of the catalogue without a source and an uncertainty.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../test_catalogue.hpp"
#include "document/json/file.hpp"

namespace turnwright::document {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Pointers of the numbers that no group around them accounts for: one with a source in
// words, and an uncertainty above 0, because no number is exact.
std::vector<std::string> unaccounted(const json& all) {
  std::vector<std::string> found;
  const auto accounts = [](const json& group) {
    if (!group.is_object()) return false;
    const auto source = group.value("source", json());
    const auto uncertainty = group.value("uncertainty_pct", json());
    return source.is_string() && source.get<std::string>().size() > 3 &&
           uncertainty.is_number() && uncertainty.get<double>() > 0;
  };
  const auto flat = all.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number()) continue;
    bool accounted = accounts(all);
    for (json::json_pointer at(pointer); !accounted && !at.empty(); at.pop_back())
      accounted = accounts(all.at(at));
    if (!accounted) found.push_back(pointer);
  }
  return found;
}

TEST(Provenance, EveryNumberOfTheCatalogueHasASourceAndAnUncertainty) {
  std::size_t documents = 0;
  for (const char* folder : {"materials", "tools", "machines"})
    for (const auto& entry : fs::recursive_directory_iterator(source_path(folder))) {
      if (entry.path().extension() != ".json") continue;
      ++documents;
      for (const auto& pointer : unaccounted(parse_file(entry.path().string())))
        ADD_FAILURE() << entry.path() << ' ' << pointer;
    }
  EXPECT_GE(documents, 160u);
}

TEST(Provenance, ANumberWithoutIsFound) {
  const auto good = parse_file(source_path("materials/C45.json"));
  EXPECT_TRUE(unaccounted(good).empty());
  auto bare = good;
  bare["taylor"].erase("source");
  EXPECT_EQ(unaccounted(bare).size(), 11u);  // C, n, a, b, three ranges, uncertainty
  auto exact = good;
  exact["chip"]["uncertainty_pct"] = 0;
  EXPECT_EQ(unaccounted(exact).size(), 2u);
  auto loose = good;
  loose["k"] = 3;
  EXPECT_EQ(unaccounted(loose), std::vector<std::string>{"/k"});
}

}  // namespace
}  // namespace turnwright::document
