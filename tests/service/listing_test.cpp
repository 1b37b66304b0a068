#include "service/listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace turnwright::service::listing_test {
namespace {

std::set<std::string> ids(const std::vector<Entry>& list) {
  std::set<std::string> ids;
  for (const auto& entry : list) {
    EXPECT_FALSE(entry.name.empty()) << entry.id;
    EXPECT_TRUE(ids.insert(entry.id).second) << entry.id;
  }
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end(),
                             [](const Entry& a, const Entry& b) { return a.id < b.id; }));
  return ids;
}

// Names of the documents in a folder, which are their ids.
std::set<std::string> files_of(const char* folder) {
  std::set<std::string> names;
  const auto all = std::filesystem::path(TURNWRIGHT_SOURCE_DIR) / folder;
  for (const auto& entry : std::filesystem::directory_iterator(all))
    names.insert(entry.path().stem().string());
  EXPECT_GE(names.size(), 30u);
  return names;
}

TEST(Listing, HoldsTheShippedCatalogue) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  EXPECT_EQ(ids(list_materials(catalogue)), files_of("materials"));
  EXPECT_EQ(ids(list_shops(catalogue)), (std::set<std::string>{"workshop"}));
  const auto tools = ids(list_tools(catalogue));
  for (const auto* id : {"PCLNL-CNMG120408-PM", "PART-3", "KEYWAY-HM-8"})
    EXPECT_TRUE(tools.count(id)) << id;
  EXPECT_EQ(ids(list_machines(catalogue)),
            (std::set<std::string>{"lathe-heavy", "lathe-medium", "lathe-small",
                                   "lathe-worn", "turn-mill"}));
}

TEST(Listing, HoldsTheReferenceParts) {
  EXPECT_EQ(ids(list_parts(TURNWRIGHT_SOURCE_DIR)),
            (std::set<std::string>{
                "aluminium-tube", "bearing-seat", "coupling-shaft", "drilled-bush",
                "flanged-bush", "gearbox-input-shaft", "infeasible-as-drawn", "iron-hub",
                "keyed-shaft", "motor-shaft", "piston-rod", "pump-shaft", "roller-tube",
                "spindle-nose", "threaded-spindle", "titanium-pin"}));
}

TEST(Listing, AFolderWithoutPartsHasNone) {
  EXPECT_TRUE(list_parts(TURNWRIGHT_SOURCE_DIR "/include").empty());
}

}  // namespace
}  // namespace turnwright::service::listing_test
