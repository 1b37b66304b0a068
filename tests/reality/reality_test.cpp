// The models beside measured cuts; docs/reality.md has the tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/document/calibrate_material.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright {
namespace {

using nlohmann::json;

const std::string kRoot = TURNWRIGHT_SOURCE_DIR;

const document::Catalogue& catalogue() {
  static const auto kCatalogue = document::load_catalogue(kRoot);
  return kCatalogue;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
  return all;
}

// ---- Shafts of 12L14 -----------------------------------------------------------------

struct Condition {
  double D_mm, vc_m_min, f_mm_rev, ap_mm;
  std::string at;
  auto operator<=>(const Condition&) const = default;
};

// Means of a column over the readings with "New" or "Worn" edges.
using Means = std::map<Condition, double>;
Means means(const std::string& edge, std::size_t column) {
  std::ifstream in(kRoot + "/tests/data/AISI12L14/data.csv");
  std::map<Condition, std::pair<double, int>> sums;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto c = cells(line);
    if (c.at(5) != edge) continue;
    const double D = c[4] == "D30" ? 30 : 50;
    auto& [sum, n] = sums[{D, std::stod(c[1]), std::stod(c[2]), std::stod(c[3]), c[6]}];
    sum += std::stod(c.at(column));
    ++n;
  }
  Means all;
  for (const auto& [at, s] : sums) all[at] = s.first / s.second;
  return all;
}

constexpr std::size_t kRa = 8, kRz = 9;

// Mean Ra of the readings with a new edge.
const Means& shafts() {
  static const auto kMeans = means("New", kRa);
  return kMeans;
}

// The corner of the unnamed insert: 0.4 mm is the usual radius that its roughness allows.
constexpr double kCorner_mm = 0.4;

TEST(Shafts12L14, RoughnessOfStableCuts) {
  cutting::Cut c;
  c.corner = cutting::corner_of(kCorner_mm, 95 * std::numbers::pi / 180);
  c.hmin_mm = 0.002;  // of the catalogue's steels
  double square = 0;
  int n = 0;
  for (const auto& [at, Ra] : shafts()) {
    if (at.D_mm == 30 && at.at == "Live centre") continue;  // chattered
    square += std::pow(cutting::Ra_um(c, at.f_mm_rev) / Ra - 1, 2);
    ++n;
  }
  EXPECT_EQ(n, 75);
  EXPECT_LT(std::sqrt(square / n), 0.25);
}

// hmin by calibrate-material from the same readings: beyond the 2 um of the catalogue, and
// the roughness of a feed within the range of the others comes from those.
TEST(Shafts12L14, RoughnessCalibrated) {
  const auto calibrated = [](double left_out_f) {
    json cuts = json::array();
    for (const auto& [at, Ra] : shafts())
      if (!(at.D_mm == 30 && at.at == "Live centre") && at.f_mm_rev != left_out_f)
        cuts.push_back({{"vc_m_min", at.vc_m_min},
                        {"f_mm_rev", at.f_mm_rev},
                        {"ap_mm", at.ap_mm},
                        {"Ra_um", Ra}});
    return document::calibrate_material({{"material", "C15"},
                                         {"tool",
                                          {{"name", "of the shafts"},
                                           {"re_mm", kCorner_mm},
                                           {"kapr_deg", 95},
                                           {"rake_deg", 6}}},
                                         {"cuts", cuts}},
                                        catalogue());
  };
  const json all = calibrated(0)["roughness"];
  EXPECT_EQ(all["cuts"], 75);
  EXPECT_GT(all["hmin_mm"]["lower"], 0.002);
  EXPECT_LT(all["s_pct"], 25);
  cutting::Cut c;
  c.corner = cutting::corner_of(kCorner_mm, 95 * std::numbers::pi / 180);
  for (const double f : {0.08, 0.1, 0.12}) {
    c.hmin_mm = calibrated(f)["roughness"]["hmin_mm"]["value"];
    double square = 0;
    int n = 0;
    for (const auto& [at, Ra] : shafts()) {
      if ((at.D_mm == 30 && at.at == "Live centre") || at.f_mm_rev != f) continue;
      square += std::pow(cutting::Ra_um(c, f) / Ra - 1, 2);
      ++n;
    }
    EXPECT_LT(std::sqrt(square / n), 0.25) << f;
  }
}

// Relative errors, measured by the worn edge (VB 0.3 mm), of (10) of cut.hpp with the
// measured roughness of the new edge as the profile of the feed.
struct Errors {
  double rms = 0, mean = 0;
};
template <class Of>
Errors worn_errors(const Means& fresh, const Means& worn, double land_um,
                   const Of& counts) {
  Errors e;
  int n = 0;
  for (const auto& [at, R] : worn) {
    if (!counts(at)) continue;
    const double error = cutting::with_land_um(fresh.at(at), land_um) / R - 1;
    e.rms += error * error;
    e.mean += error;
    ++n;
  }
  return {std::sqrt(e.rms / n), e.mean / n};
}

// Shafts of 50 mm, which did not chatter: a worn edge leaves 1.99 um where a new one leaves
// 1.21, whatever the feed.  With the catalogue's 5 um per mm of land (10) describes them
// with 21 % rms, and a feed that was left out of a fit of its own with 27 % at most; without
// the land the surface would come out a third too smooth.
TEST(Shafts12L14, RoughnessOfWornEdges) {
  constexpr double kVB_mm = 0.3;
  const auto steel = std::ranges::find(catalogue().materials, "11SMnPb30",
                                       &turnwright::catalogue::Material::id);
  ASSERT_NE(steel, catalogue().materials.end());
  const double w = steel->land_Ra_um_mm;
  const auto stiff = [](const Condition& c) { return c.D_mm == 50; };
  const auto fresh = means("New", kRa), worn = means("Worn", kRa);
  const auto without = worn_errors(fresh, worn, 0, stiff);
  EXPECT_LT(without.mean, -0.33);
  EXPECT_GT(without.rms, 0.39);
  const auto with = worn_errors(fresh, worn, w * kVB_mm, stiff);
  EXPECT_LT(with.rms, 0.215);
  EXPECT_LT(std::abs(with.mean), 0.04);
  EXPECT_LT(
      worn_errors(means("New", kRz), means("Worn", kRz), 4.5 * w * kVB_mm, stiff).rms,
      0.19);
  for (const double f : {0.07, 0.08, 0.1, 0.12, 0.13}) {
    const auto others = [&](const Condition& c) { return stiff(c) && c.f_mm_rev != f; };
    double best = 0;
    for (double land_um = 0; land_um < 3; land_um += 0.01)
      if (worn_errors(fresh, worn, land_um, others).rms <
          worn_errors(fresh, worn, best, others).rms)
        best = land_um;
    EXPECT_LT(worn_errors(fresh, worn, best,
                          [&](const Condition& c) { return stiff(c) && c.f_mm_rev == f; })
                  .rms,
              0.28)
        << f;
  }
}

// Largest chatter stiffness over its limit in one pass over a shaft on a live centre; the
// toolpost yields along the feed where it is told how much.
double chatter_share(const Condition& c, double length_mm, double tool_zz_mm_N = 0) {
  const double blank = c.D_mm + 2 * c.ap_mm;
  json machine = catalogue().machine_documents.at("lathe-medium");
  if (tool_zz_mm_N > 0) machine["stiffness"]["tool_zz_mm_N"] = tool_zz_mm_N;
  const json part = {
      {"format", "turnwright-part/1"},
      {"name", "12L14 shaft"},
      {"material", "C15"},
      {"stock",
       {{"kind", "bar"},
        {"diameter_mm", blank},
        {"length_mm", length_mm + 60},
        {"left_allowance_mm", 0}}},
      {"outer",
       {{{"id", "held"},
         {"kind", "cylinder"},
         {"length_mm", 60},
         {"diameter_mm", blank - 0.1}},
        {{"id", "d"},
         {"kind", "cylinder"},
         {"length_mm", length_mm},
         {"diameter_mm", c.D_mm}}}},
      {"machine", machine},
      {"setups",
       {{{"hold", "left"}, {"grip_mm", 50}, {"clampings", {"chuck-tailstock"}}}}},
      {"operations",
       {{{"id", "turn"},
         {"kind", "finish"},
         {"on", {"d"}},
         {"tool", "PCLNL-CNMG120404-PF"},
         {"setup", 0},
         {"conditions",
          {{"passes", 1},
           {"vc_m_min", c.vc_m_min},
           {"f_mm_rev", c.f_mm_rev},
           {"ap_mm", c.ap_mm}}}}}}};
  const auto r = planning::predict(
      document::prepared_part(part, catalogue(), "shaft", document::Purpose::predict)
          .part);
  for (const auto& o : r.setups.at(0).operations)
    for (const auto& k : o.constraints)
      if (o.id == "turn" && k.name == "chatter stiffness") return k.value / k.limit;
  ADD_FAILURE() << "no chatter stiffness";
  return 0;
}

// At the live centre diameter 30 chattered in 12 of 15 conditions (Ra 1.3 to 9.6 um, where
// the feed gives 1.1), diameter 50 in none.  The data do not tell the shafts' length:
// between 480 and 600 mm the default damping sorts 24 to 27 of the 30 rightly, and never
// calls a shaft of 50 mm unstable.
TEST(Shafts12L14, ChatterAtTheCentreComesToTheSlenderOne) {
  for (const double length : {480.0, 540.0, 600.0}) {
    int right = 0, all = 0;
    for (const auto& [at, Ra] : shafts()) {
      if (at.at != "Live centre") continue;
      const bool predicted = chatter_share(at, length) > 1;
      if (at.D_mm == 50) {
        EXPECT_FALSE(predicted) << at.ap_mm << ' ' << length;
      }
      right += predicted == (Ra > 2);
      ++all;
    }
    EXPECT_EQ(all, 30);
    EXPECT_GE(right, 24) << length;
  }
}

// With a toolpost that yields along the feed by half of what it does across, an estimate,
// the verdicts are right in at least as many conditions, and the share falls less with the
// depth; that it rises as measured is not reached.
TEST(Shafts12L14, ChatterAlongTheFeed) {
  constexpr double kHalfOfRadial_mm_N = 1e-5;
  for (const double length : {450.0, 480.0, 540.0, 600.0}) {
    int radial = 0, both = 0;
    for (const auto& [at, Ra] : shafts()) {
      if (at.at != "Live centre") continue;
      const double share = chatter_share(at, length, kHalfOfRadial_mm_N);
      radial += (chatter_share(at, length) > 1) == (Ra > 2);
      both += (share > 1) == (Ra > 2);
      if (at.D_mm == 50) {
        EXPECT_LT(share, 1) << at.ap_mm << ' ' << length;
      }
    }
    EXPECT_GE(both, std::max(radial, 24)) << length;
  }
  const auto falls = [](double tool_zz_mm_N) {
    const auto at = [&](double ap) {
      return chatter_share({30, 280, 0.1, ap, ""}, 540, tool_zz_mm_N);
    };
    return at(0.53) / at(1.37);
  };
  EXPECT_LT(falls(kHalfOfRadial_mm_N), falls(0));
}

// ---- Forces on H13 -------------------------------------------------------------------

struct MeasuredForces {
  double ap_mm, vc_m_min, f_mm_rev, Fc_N, Fp_N, Ff_N;
};

// The columns ap_mm, vc_m_min, f_mm_rev, Fc_N, Fp_N, Ff_N of the file that
// TURNWRIGHT_H13_CUTS names; lines that begin with # do not count.
std::vector<MeasuredForces> h13() {
  std::vector<MeasuredForces> all;
  const char* path = std::getenv("TURNWRIGHT_H13_CUTS");
  std::ifstream in(path ? path : "");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'a') continue;
    const auto c = cells(line);
    all.push_back({std::stod(c.at(0)), std::stod(c[1]), std::stod(c[2]), std::stod(c[3]),
                   std::stod(c[4]), std::stod(c[5])});
  }
  if (all.empty())
    std::fputs("NOT CHECKED: TURNWRIGHT_H13_CUTS names no measured cuts\n", stderr);
  return all;
}

catalogue::Tool finishing_insert() {
  catalogue::Tool t;  // TNMG 160404-PF in MTJNL; the rake is that of the chip groove
  t.re_mm = 0.4;
  t.kapr_deg = 93;
  t.gamma_deg = 8;
  return t;
}

// By the nearest steel of the catalogue, nothing fitted.
TEST(ForcesH13, PassiveForceBlind) {
  const auto cuts = h13();
  if (cuts.empty()) GTEST_SKIP() << "TURNWRIGHT_H13_CUTS is not set";
  const auto steel = std::ranges::find(catalogue().materials, "42CrMo4-A",
                                       &turnwright::catalogue::Material::id);
  ASSERT_NE(steel, catalogue().materials.end());
  const auto cut = cutting::cut_of(*steel, finishing_insert());
  double sum = 0;
  for (const auto& m : cuts) {
    const auto F = cutting::forces_N(cut, m.ap_mm, m.f_mm_rev);
    const double error = F.Fp_N / m.Fp_N - 1;
    EXPECT_GT(error, -0.2) << m.ap_mm << ' ' << m.f_mm_rev;
    sum += error;
  }
  EXPECT_LT(std::abs(sum / static_cast<double>(cuts.size())), 0.15);
}

json calibrated(const std::vector<MeasuredForces>& cuts) {
  json list = json::array();
  for (const auto& m : cuts)
    list.push_back({{"ap_mm", m.ap_mm},
                    {"vc_m_min", m.vc_m_min},
                    {"f_mm_rev", m.f_mm_rev},
                    {"Fc_N", m.Fc_N},
                    {"Ff_N", m.Ff_N},
                    {"Fp_N", m.Fp_N}});
  return document::calibrate_material(
      {{"material", "42CrMo4-A"},
       {"tool",
        {{"name", "TNMG 160404-PF"}, {"re_mm", 0.4}, {"kapr_deg", 93}, {"rake_deg", 8}}},
       {"cuts", list}},
      catalogue());
}

// Calibrated on two depths, a third is predicted.
TEST(ForcesH13, OfAnotherDepth) {
  const auto cuts = h13();
  if (cuts.empty()) GTEST_SKIP() << "TURNWRIGHT_H13_CUTS is not set";
  const json r = calibrated(cuts);
  EXPECT_FALSE(r["material"].is_null());
  EXPECT_EQ(r["feed_and_passive_by"], "thrust");
  ASSERT_GE(r["left_out"].size(), 3u);
  for (const json& depth : r["left_out"]) {
    EXPECT_LT(depth["Fc_rms_pct"], 15) << depth;
    EXPECT_LT(depth["Fp_rms_pct"], 15) << depth;
  }
}

// From any two of three depths both groups of the material are written, with the errors at
// each depth by the other.
TEST(ForcesH13, EverySplitOfDepthsIsWritten) {
  const auto cuts = h13();
  if (cuts.empty()) GTEST_SKIP() << "TURNWRIGHT_H13_CUTS is not set";
  const json& steel = catalogue().material_documents.at("42CrMo4-A");
  std::set<double> depths;
  for (const auto& m : cuts) depths.insert(m.ap_mm);
  ASSERT_GE(depths.size(), 3u);
  for (const double left : depths) {
    auto some = cuts;
    std::erase_if(some, [&](const MeasuredForces& m) { return m.ap_mm == left; });
    const json r = calibrated(some);
    EXPECT_NE(r["material"]["kienzle"], steel["kienzle"]) << left;
    EXPECT_TRUE(r["material"].contains("thrust")) << left;
    EXPECT_EQ(r["warnings"], json::array()) << left;
    EXPECT_EQ(r["left_out"].size(), depths.size() - 1) << left;
  }
}

}  // namespace
}  // namespace turnwright
