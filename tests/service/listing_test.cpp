#include "service/listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Listing, HoldsTheShippedCatalogue) {
  const auto catalogue = document::load_catalogue(TURNWRIGHT_SOURCE_DIR);
  EXPECT_EQ(ids(list_materials(catalogue)),
            (std::set<std::string>{"100Cr6-60HRC", "16MnCr5", "42CrMo4-A", "42CrMo4-QT",
                                   "AlMgSi", "C15", "C45", "CuZn39Pb3", "E295",
                                   "EN-GJL-250", "EN-GJS-500-7", "Inconel-718",
                                   "Ti-6Al-4V", "X2CrNiMoN22-5-3", "X5CrNi18-10"}));
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
