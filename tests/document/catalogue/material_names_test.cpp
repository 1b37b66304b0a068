#include "document/catalogue/material_names.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "../test_catalogue.hpp"
#include "document/json/file.hpp"

namespace turnwright::document::material_names_test {
namespace {

const Catalogue& shipped() {
  static const auto all = load_catalogue(source_path(""));
  return all;
}

std::vector<std::string> ids_called(const std::string& name) {
  std::vector<std::string> ids;
  for (const auto& m : materials_called(name, shipped().materials)) ids.push_back(m.id);
  return ids;
}

using Ids = std::vector<std::string>;

TEST(MaterialNames, NumbersAndNamesOfOtherStandardsAreUnderstood) {
  for (const char* name : {"C45", "1.0503", "AISI 1045", "aisi1045", "SAE-1045", "1045",
                           "JIS S45C", "S45C", "DIN Ck45", "W.-Nr. 1.0503"})
    EXPECT_EQ(ids_called(name), Ids{"C45"}) << name;
  EXPECT_EQ(ids_called("1.4301"), Ids{"X5CrNi18-10"});
  EXPECT_EQ(ids_called("SUS304"), Ids{"X5CrNi18-10"});
  EXPECT_EQ(ids_called("EN AW-6082"), Ids{"AlMgSi"});
  EXPECT_EQ(ids_called("GG-25"), Ids{"EN-GJL-250"});
  for (const char* name : {"", "-", "C4", "C455", "1.05", "steel"})
    EXPECT_EQ(ids_called(name), Ids{}) << name;
}

TEST(MaterialNames, AGradeInSeveralStatesIsNotGuessed) {
  const Ids states{"42CrMo4-A", "42CrMo4-QT"};
  for (const char* name : {"42CrMo4", "1.7225", "AISI 4140", "SCM440"})
    EXPECT_EQ(ids_called(name), states) << name;
  EXPECT_EQ(ids_called("1.7225+QT"), Ids{"42CrMo4-QT"});
  EXPECT_EQ(ids_called("42CrMo4 +A"), Ids{"42CrMo4-A"});
  const auto wanted = expected_state(materials_called("1.7225", shipped().materials));
  EXPECT_NE(wanted.find("\"42CrMo4-A\" (42CrMo4 heat-treatable steel, soft annealed, 200 "
                        "HB) or \"42CrMo4-QT\""),
            std::string::npos)
      << wanted;
}

TEST(MaterialNames, EverySynonymLeadsToItsMaterial) {
  for (const auto& m : shipped().materials)
    for (const auto& synonym : m.synonyms) {
      const auto found = ids_called(synonym);
      EXPECT_NE(std::find(found.begin(), found.end(), m.id), found.end())
          << m.id << ' ' << synonym;
    }
}

// Brinell or, of hard steel, Rockwell as in the condition.
std::string hardness(const catalogue::Material& m) {
  if (m.group != catalogue::IsoGroup::H)
    return std::to_string(std::lround(m.hardness_HB)) + " HB";
  const auto end = m.condition.find(" HRC");
  return end == std::string::npos ? "?" : m.condition.substr(end - 2, 6);
}

TEST(MaterialNames, EveryNameTellsStateAndHardnessAndNoTwoReadAlike) {
  std::map<std::string, std::string> names;
  for (const auto& m : shipped().materials) {
    EXPECT_TRUE(m.name.ends_with(", " + hardness(m))) << m.name << ": " << hardness(m);
    std::string read;  // without what an eye skips
    for (const unsigned char c : m.name)
      if (std::isalnum(c) != 0) read += static_cast<char>(std::tolower(c));
    const auto [other, is_new] = names.emplace(read, m.id);
    EXPECT_TRUE(is_new) << m.id << " and " << other->second << " read " << m.name;
  }
}

TEST(MaterialNames, TheCatalogueHasAShopsMaterialsAndTools) {
  EXPECT_GE(shipped().materials.size(), 30u);
  EXPECT_GE(shipped().tools.size(), 60u);
  std::set<std::string> names;
  for (const auto& t : shipped().tools)
    EXPECT_TRUE(names.insert(t.name).second) << t.id << ' ' << t.name;
}

// [iscar-groups] typed a second time: kc1 [MPa], exponent and hardness [HB] of its groups.
struct Group {
  double kc11_MPa, mc, hardness_HB;
};
const std::map<std::string, Group> kGroups{
    {"1", {1350, 0.21, 125}},  {"2", {1500, 0.22, 190}},  {"4", {1700, 0.24, 220}},
    {"6", {1775, 0.24, 200}},  {"7", {1675, 0.24, 275}},  {"8", {1725, 0.24, 300}},
    {"10", {2450, 0.23, 200}}, {"13", {1875, 0.21, 240}}, {"14", {2150, 0.20, 180}},
    {"15", {1150, 0.20, 180}}, {"16", {1350, 0.28, 260}}, {"17", {1225, 0.25, 160}},
    {"18", {1350, 0.28, 250}}, {"21", {700, 0.25, 60}},   {"22", {800, 0.25, 100}},
    {"24", {700, 0.25, 90}},   {"27", {700, 0.27, 90}},   {"28", {700, 0.27, 100}},
    {"32", {3100, 0.24, 280}}, {"33", {3300, 0.24, 250}}, {"36", {1160, 0.24, 0}},
    {"38", {4600, 0.25, 0}},   {"39", {4700, 0.25, 0}}};

TEST(MaterialNames, ForcesAndHardnessAreThoseOfTheTableTheyName) {
  const std::string table = "[iscar-groups], group ";
  std::size_t compared = 0;
  for (const auto& [id, document] : shipped().material_documents) {
    const auto group_of = [&](const char* numbers) {
      const auto source = document[numbers]["source"].get<std::string>();
      return source.starts_with(table) ? source.substr(table.size()) : "";
    };
    if (const auto group = group_of("kienzle"); !group.empty()) {
      ++compared;
      EXPECT_EQ(document["kienzle"]["kc11_MPa"], kGroups.at(group).kc11_MPa) << id;
      EXPECT_EQ(document["kienzle"]["mc"], kGroups.at(group).mc) << id;
    }
    if (const auto group = group_of("hardness"); !group.empty()) {
      EXPECT_EQ(document["hardness"]["hardness_HB"], kGroups.at(group).hardness_HB) << id;
    }
  }
  EXPECT_GE(compared, 30u);
}

}  // namespace
}  // namespace turnwright::document::material_names_test
