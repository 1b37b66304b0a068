#include "turnwright/document/catalogue.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "document/catalogue/catalogue_readers.hpp"
#include "document/json/file.hpp"

namespace turnwright::document::catalogue_test {
namespace {

namespace fs = std::filesystem;

nlohmann::json example(const std::string& file) {
  return parse_file(fs::path(TURNWRIGHT_SOURCE_DIR) / "tests/data/catalogue" / file);
}
const char* const kMaterial = "materials/test-steel.json";
const char* const kTool = "tools/test-rougher.json";
const char* const kCutter = "tools/milling/test-cutter.json";
const char* const kLathe = "machines/lathe-medium.json";

template <class T>
std::string problems_of(T (*read)(Reader), const nlohmann::json& json) {
  Problems problems{.document = "t"};
  read(Reader(json, problems));
  std::string text;
  for (const auto& p : problems.list)
    text += p.pointer + ": got " + p.got + ", expected " + p.expected + "\n";
  return text;
}

/// A data folder of our own, gone at the end of the test.
class Folder {
 public:
  Folder()  // tests run side by side, each in its own process
      : path_(fs::path(testing::TempDir()) /
              ("turnwright_catalogue_test_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    for (const auto* kind : {"materials", "tools", "machines"})
      fs::create_directories(path_ / kind);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& file, const nlohmann::json& json) const {
    write_text(file, json.dump());
  }
  void write_text(const std::string& file, const std::string& text) const {
    std::ofstream(path_ / file) << text;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(Catalogue, ChipWindowIsAPolygonOrRanges) {
  const auto json =
      parse_file(fs::path(TURNWRIGHT_SOURCE_DIR) / "tests/data" / "heavy-rougher.json");
  Problems none{.document = "t"};
  const auto tool = read_tool(Reader(json, none));
  EXPECT_TRUE(none.list.empty());
  EXPECT_EQ(tool.chip.size(), 2u);
  EXPECT_NEAR(tool.ap_mm.lower, 0.8, 1e-15);
  EXPECT_NEAR(tool.ap_mm.upper, 6, 1e-14);
  EXPECT_NEAR(tool.f_mm_rev.lower, 0.2, 1e-15);
  EXPECT_NEAR(tool.f_mm_rev.upper, 0.6, 1e-15);
  const auto with = [&](const auto& change) {
    auto changed = json;
    change(changed["window"]);
    return problems_of(read_tool, changed);
  };
  EXPECT_EQ(with([](auto& w) { w["ap_mm"] = {1, 4}; }), "");
  EXPECT_EQ(with([](auto& w) { w.erase("chip_window"); }),
            "/window/f_mm_rev: got nothing, expected a list of 2 entries\n"
            "/window/ap_mm: got nothing, expected a list of 2 entries\n");
  EXPECT_EQ(with([](auto& w) {
              w["chip_window"] = {{1, 0.1}, {2, 0.2}};
            }),
            "/window/chip_window: got a list of 2 entries, expected a list of 3 to 20 "
            "entries\n");
  const std::string area =
      "corners [ap_mm, f_mm_rev] of one area whose edges do not "
      "cross\n";
  EXPECT_EQ(with([](auto& w) {
              w["chip_window"] = {{1, 0.1}, {2, 0.2}, {2, 0.1}, {1, 0.2}};
            }),
            "/window/chip_window: got a list of 4 entries, expected " + area);
  EXPECT_NE(with([](auto& w) {
              w["chip_window"][2] = {6, 7};
            }).find("/window/chip_window/2/1: got 7, expected a number > 0 and <= 5"),
            std::string::npos);
  EXPECT_NE(
      with([](auto& w) { w["chip_window"][1] = {3}; }).find("/window/chip_window/1"),
      std::string::npos);
  EXPECT_EQ(with([](auto& w) {
              w["ap_mm"] = {7, 9};
            }),
            "/window/ap_mm: got [7,9], expected a range that chip_window reaches\n");
}

TEST(Catalogue, DampingRatiosArePositiveAndAtMostOneHalf) {
  auto lathe = example(kLathe);
  lathe["stiffness"]["damping_ratio"] = 0.04;
  Problems none{.document = "t"};
  EXPECT_EQ(read_lathe(Reader(lathe, none)).damping_ratio, 0.04);
  for (const double zeta : {0.0, -0.1, 0.6}) {
    lathe["stiffness"]["damping_ratio"] = zeta;
    EXPECT_NE(problems_of(read_lathe, lathe)
                  .find("/stiffness/damping_ratio: got " + nlohmann::json(zeta).dump() +
                        ", expected a number > 0 and <= 0.5"),
              std::string::npos);
  }
}

// Every number of the example documents, by hand: no field is read from another's key.
TEST(Catalogue, EveryMaterialFieldComesFromItsKey) {
  const auto json = example(kMaterial);
  Problems problems;
  const auto m = read_material(Reader(json, problems));
  ASSERT_TRUE(problems.list.empty());
  EXPECT_EQ(m.id, "test-steel");
  EXPECT_EQ(m.name, "Invented steel for tests");
  EXPECT_EQ(m.standard, "none");
  EXPECT_EQ(m.condition, "normalised");
  EXPECT_EQ(m.group, catalogue::IsoGroup::P);
  EXPECT_EQ(m.hardness_HB, 190);
  EXPECT_EQ(m.E_MPa, 210000);
  EXPECT_EQ(m.nu, 0.3);
  EXPECT_EQ(m.rho_kg_m3, 7850);
  EXPECT_EQ(m.expansion_1_K, 1.15e-5);
  EXPECT_EQ(m.kc.k11_MPa, 2000);
  EXPECT_EQ(m.kc.m, 0.25);
  EXPECT_EQ(m.gamma0_deg, 6);
  EXPECT_EQ(m.kc_uncertainty_pct, 10);
  EXPECT_EQ(m.kf->k11_MPa, 350);
  EXPECT_EQ(m.kf->m, 0.7);
  EXPECT_EQ(m.kp->k11_MPa, 250);
  EXPECT_EQ(m.kp->m, 0.6);
  EXPECT_EQ(m.taylor.C, 300);
  EXPECT_EQ(m.taylor.n, 0.25);
  EXPECT_EQ(m.taylor.a, 0.3);
  EXPECT_EQ(m.taylor.b, 0.1);
  EXPECT_EQ(m.taylor_uncertainty_pct, 15);
  EXPECT_EQ(m.hmin_mm, 0.005);
}

TEST(Catalogue, EveryToolFieldComesFromItsKey) {
  const auto json = example(kTool);
  Problems problems;
  const auto t = read_tool(Reader(json, problems));
  ASSERT_TRUE(problems.list.empty());
  EXPECT_EQ(t.id, "test-rougher");
  EXPECT_EQ(t.name, "Invented roughing tool for tests");
  EXPECT_EQ(t.insert, "CNMG 120408");
  using enum catalogue::ToolUse;
  EXPECT_EQ(t.uses, (std::vector{roughing, facing}));
  EXPECT_EQ(t.groups, (std::vector{catalogue::IsoGroup::P, catalogue::IsoGroup::K}));
  EXPECT_EQ(t.kapr_deg, 95);
  EXPECT_EQ(t.minor_kapr_deg, 5);
  EXPECT_EQ(t.gamma_deg, -6);
  EXPECT_EQ(t.alpha_deg, 6);
  EXPECT_EQ(t.re_mm, 0.8);
  EXPECT_FALSE(t.wiper);
  EXPECT_EQ(t.f_mm_rev.lower, 0.15);
  EXPECT_EQ(t.f_mm_rev.upper, 0.5);
  EXPECT_EQ(t.ap_mm.lower, 0.5);
  EXPECT_EQ(t.ap_mm.upper, 5);
  EXPECT_EQ(t.vc_m_min.lower, 80);
  EXPECT_EQ(t.vc_m_min.upper, 400);
  EXPECT_EQ(t.Fc_max_N, 6000);
  EXPECT_EQ(t.T_min.lower, 5);
  EXPECT_EQ(t.T_min.upper, 60);
  EXPECT_EQ(t.change_min, 1);
  EXPECT_EQ(t.edge_cost, 2.5);
}

nlohmann::json tool_with_holder() {
  auto json = example(kTool);
  json["holder"] = {{"designation", "PCLNL 2520M 12"},
                    {"h_mm", 25},
                    {"b_mm", 20},
                    {"lf_mm", 150},
                    {"lh_mm", 31},
                    {"wf_mm", 27},
                    {"uncertainty_pct", 10},
                    {"source", "invented for tests"}};
  return json;
}

TEST(Catalogue, EveryHolderFieldComesFromItsKey) {
  Problems problems;
  EXPECT_FALSE(read_tool(Reader(example(kTool), problems)).holder.has_value());
  const auto json = tool_with_holder();
  const auto t = read_tool(Reader(json, problems));
  ASSERT_TRUE(problems.list.empty());
  ASSERT_TRUE(t.holder.has_value());
  EXPECT_EQ(t.holder->designation, "PCLNL 2520M 12");
  EXPECT_EQ(t.holder->h_mm, 25);
  EXPECT_EQ(t.holder->b_mm, 20);
  EXPECT_EQ(t.holder->lf_mm, 150);
  EXPECT_EQ(t.holder->lh_mm, 31);
  EXPECT_EQ(t.holder->wf_mm, 27);
}

TEST(Catalogue, AHoldersDesignationAgreesWithTheTool) {
  const auto with = [](const char* designation, const auto& change) {
    auto json = tool_with_holder();
    json["holder"]["designation"] = designation;
    change(json);
    return problems_of(read_tool, json);
  };
  const auto as_it_is = [](auto&) {};
  const std::string at = "/holder/designation: got ";
  EXPECT_EQ(with("PCLNL 2520M 12", as_it_is), "");
  EXPECT_EQ(with("PCLNL 2520-12", as_it_is), "");
  EXPECT_EQ(with("PDLNL 2520M 12", as_it_is),
            at + "\"PDLNL 2520M 12\", expected a holder of the insert CNMG 120408\n");
  EXPECT_EQ(with("PCLNL 2520M 16", as_it_is),
            at + "\"PCLNL 2520M 16\", expected a holder of the insert CNMG 120408\n");
  EXPECT_EQ(with("PCKNL 2520M 12", as_it_is),
            at + "\"PCKNL 2520M 12\", expected a style whose KAPR is "
                 "geometry/kapr_deg, 95 deg, not 75 deg\n");
  for (const auto* size : {"PCLNL 2020M 12", "PCLNL 2525M 12", "PCLNL 2520K 12"})
    EXPECT_EQ(with(size, as_it_is),
              at + '"' + size + "\", expected the size that h_mm, b_mm and lf_mm give\n");
  EXPECT_EQ(with("PCLNL 2520M 12", [](auto& j) { j["geometry"]["minor_kapr_deg"] = 6; }),
            at + "\"PCLNL 2520M 12\", expected an insert whose angle, with kapr_deg and "
                 "minor_kapr_deg, makes 180 deg\n");
  EXPECT_EQ(with("PCLNL 2520M 12", [](auto& j) { j["holder"]["lh_mm"] = 150; }),
            "/holder/lh_mm: got 150, expected less than lf_mm\n");
  EXPECT_NE(with("PCLNL", as_it_is)
                .find(at + "\"PCLNL\", expected an ISO 5608 designation (decode_iso5608"),
            std::string::npos);
}

TEST(Catalogue, EveryLatheFieldComesFromItsKey) {
  const auto json = example(kLathe);
  Problems problems;
  const auto m = read_lathe(Reader(json, problems));
  ASSERT_TRUE(problems.list.empty());
  EXPECT_EQ(m.id, "lathe-medium");
  EXPECT_EQ(m.clampings.size(), 3U);
  EXPECT_EQ(m.clampings[1], "chuck-tailstock");
  EXPECT_EQ(m.n_min_rpm, 50);
  EXPECT_EQ(m.n_max_rpm, 4000);
  ASSERT_EQ(m.curve.size(), 3U);
  EXPECT_EQ(m.curve[1].n_rpm, 800);
  EXPECT_EQ(m.curve[1].P_kW, 15.08);
  EXPECT_EQ(m.curve[1].M_Nm, 180);
  EXPECT_EQ(m.efficiency, 0.8);
  EXPECT_EQ(m.feed_force_max_N, 8000);
  EXPECT_EQ(m.rapid_mm_min, 15000);
  EXPECT_EQ(m.index_min, 0.05);
  EXPECT_EQ(m.load_min, 1);
  EXPECT_EQ(m.tailstock_min, 0.3);
  EXPECT_EQ(m.centres_min, 0.8);
  EXPECT_EQ(m.setup_min, 30);
  EXPECT_EQ(m.cost_per_min, 1);
  EXPECT_EQ(m.swing_mm, 400);
  EXPECT_EQ(m.between_centres_mm, 1000);
  EXPECT_EQ(m.stations, 10);
  EXPECT_EQ(m.chuck.grip_force_N, 40000);
  EXPECT_EQ(m.chuck.jaw_mass_radius_kg_m, 0.3);
  EXPECT_EQ(m.chuck.friction, 0.25);
  EXPECT_EQ(m.chuck.n_max_rpm, 4500);
  EXPECT_EQ(m.chuck.diameter_mm.lower, 10);
  EXPECT_EQ(m.chuck.diameter_mm.upper, 200);
  EXPECT_EQ(m.chuck.radial.c0_mm_N, 1e-5);
  EXPECT_EQ(m.chuck.radial.c1_rad_N, 1e-7);
  EXPECT_EQ(m.chuck.radial.c2_rad_Nmm, 3e-9);
  EXPECT_EQ(m.chuck.tangential.c0_mm_N, 1.1e-5);
  EXPECT_EQ(m.chuck.axial_mm_N, 5e-6);
  EXPECT_EQ(m.tail_centre.radial_mm_N, 2e-5);
  EXPECT_EQ(m.tail_centre.tangential_mm_N, 2.1e-5);
  EXPECT_EQ(m.head_centre.radial_mm_N, 1e-5);
  EXPECT_EQ(m.head_centre.tangential_mm_N, 1.1e-5);
  EXPECT_EQ(m.tool_rr_mm_N, 2.2e-5);
  EXPECT_EQ(m.tool_rt_mm_N, -3e-6);
  EXPECT_EQ(m.stiffness_uncertainty_pct, 25);
  ASSERT_TRUE(m.driven_tools);
  const auto& driven = *m.driven_tools;
  EXPECT_EQ(driven.n_min_rpm, 45);
  EXPECT_EQ(driven.n_max_rpm, 5500);
  EXPECT_EQ(driven.efficiency, 0.7);
  EXPECT_EQ(driven.feed_max_mm_min, 7000);
  ASSERT_EQ(driven.curve.size(), 3U);
  EXPECT_EQ(driven.curve[2].M_Nm, 6.53);
  ASSERT_EQ(driven.modes.count("test-cutter"), 1U);
  const auto& mode = driven.modes.at("test-cutter").at(0);
  EXPECT_FALSE(mode.along_feed);
  EXPECT_EQ(mode.frequency_Hz, 700);
  EXPECT_EQ(mode.damping_ratio, 0.02);
  EXPECT_EQ(mode.stiffness_N_mm, 9000);
}

TEST(Catalogue, EveryCutterFieldComesFromItsKey) {
  const auto json = example(kCutter);
  Problems problems;
  const auto c = read_milling_cutter(Reader(json, problems));
  ASSERT_TRUE(problems.list.empty());
  EXPECT_EQ(c.id, "test-cutter");
  EXPECT_EQ(c.name, "Invented cutter for tests");
  EXPECT_EQ(c.dc_mm, 10);
  EXPECT_EQ(c.teeth, 3);
  EXPECT_EQ(c.re_mm, 0.5);
  EXPECT_EQ(c.lu_mm, 25);
  EXPECT_EQ(c.gamma_deg, 8);
  EXPECT_TRUE(c.centre_cutting);
  EXPECT_EQ(c.ap_mm.lower, 0.2);
  EXPECT_EQ(c.ap_mm.upper, 15);
  EXPECT_EQ(c.conditions_in(catalogue::IsoGroup::K), nullptr);
  const auto* steel = c.conditions_in(catalogue::IsoGroup::M);
  ASSERT_NE(steel, nullptr);
  EXPECT_EQ(steel->vc_m_min.lower, 50);
  EXPECT_EQ(steel->vc_m_min.upper, 190);
  EXPECT_EQ(steel->hex_mm.lower, 0.01);
  EXPECT_EQ(steel->hex_mm.upper, 0.055);
  EXPECT_EQ(steel->T0_min, 45);
  EXPECT_EQ(steel->v0_m_min, 130);
  EXPECT_EQ(steel->n, 0.3);
  EXPECT_EQ(c.Fc_max_N, 1100);
  ASSERT_EQ(c.modes.size(), 2U);
  EXPECT_TRUE(c.modes[0].along_feed);
  EXPECT_FALSE(c.modes[1].along_feed);
  EXPECT_EQ(c.modes[1].frequency_Hz, 950);
  EXPECT_EQ(c.modes[1].damping_ratio, 0.035);
  EXPECT_EQ(c.modes[1].stiffness_N_mm, 13000);
  EXPECT_EQ(c.change_min, 1.25);
  EXPECT_EQ(c.edge_cost, 30);
}

TEST(Catalogue, CuttersThatContradictThemselvesAreRefused) {
  auto json = example(kCutter);
  json["geometry"]["re_mm"] = 6;
  json["geometry"]["ap_mm"] = {1, 26};
  json["conditions"][1]["hex_mm"] = {0.1, 0.05};
  EXPECT_EQ(problems_of(read_milling_cutter, json),
            "/geometry/re_mm: got 6, expected a corner radius of at most half of dc_mm\n"
            "/geometry/ap_mm: got [1,26], expected depths up to lu_mm at most\n"
            "/conditions/1/hex_mm: got [0.1,0.05], expected [lower, upper] with lower <= "
            "upper\n");
  auto lathe = example(kLathe);
  auto& measured = lathe["driven_tools"]["measured"];
  measured.push_back(measured[0]);
  EXPECT_EQ(problems_of(read_lathe, lathe),
            "/driven_tools/measured/1/cutter: got \"test-cutter\", expected each cutter "
            "once\n");
}

TEST(Catalogue, AnAxisYNeedsOneThatTurnsThePart) {
  auto lathe = example(kLathe);
  lathe["driven_tools"]["y_max_mm"] = 40;
  EXPECT_EQ(
      problems_of(read_lathe, lathe),
      "/driven_tools/y_max_mm: got 40, expected 0: without c_axis nothing turns the "
      "part\n");
  lathe["driven_tools"]["c_axis"] = true;
  EXPECT_EQ(problems_of(read_lathe, lathe), "");
}

TEST(Catalogue, AnyNumberMissingOrOutOfRangeIsNamed) {
  const std::set<std::string> may_be_absent{"/chip/edge_um", "/taylor/b_shallow",
                                            "/taylor/scatter_pct", "/room/stations"};
  for (const auto& [name, read] :
       {std::pair{kMaterial,
                  +[](const nlohmann::json& j) { return problems_of(read_material, j); }},
        {kTool, +[](const nlohmann::json& j) { return problems_of(read_tool, j); }},
        {kCutter,
         +[](const nlohmann::json& j) { return problems_of(read_milling_cutter, j); }},
        {kLathe, +[](const nlohmann::json& j) { return problems_of(read_lathe, j); }}}) {
    const auto good = example(name);
    EXPECT_EQ(read(good), "");
    const auto flat = good.flatten();
    for (const auto& [pointer, value] : flat.items()) {
      if (!value.is_number()) continue;
      auto bad = good;
      bad[nlohmann::json::json_pointer(pointer)] = -1e9;
      EXPECT_NE(read(bad).find(pointer + ": got -1000000000.0"), std::string::npos)
          << name << pointer;
      if (pointer.back() >= '0' && pointer.back() <= '9') continue;  // of a range
      bad = good;
      const nlohmann::json::json_pointer at(pointer);
      bad[at.parent_pointer()].erase(at.back());
      if (may_be_absent.contains(pointer)) {
        EXPECT_EQ(read(bad), "") << name << pointer;
      } else {
        EXPECT_NE(read(bad).find(pointer + ": got nothing"), std::string::npos)
            << name << pointer;
      }
    }
  }
}

TEST(Catalogue, NumbersThatContradictEachOtherAreRefused) {
  auto tool = example(kTool);
  tool["insert"] = "CNMG 120412";
  EXPECT_EQ(problems_of(read_tool, tool),
            "/insert: got \"CNMG 120412\", expected a designation whose corner is "
            "geometry/re_mm, 0.8 mm, not 1.2 mm\n");
  tool["insert"] = "XNMG 120408";
  EXPECT_NE(problems_of(read_tool, tool)
                .find("/insert: got \"XNMG 120408\", expected an ISO "
                      "1832 designation"),
            std::string::npos);
  tool = example(kTool);
  tool["geometry"]["minor_kapr_deg"] = 85;  // with 95 a straight edge
  EXPECT_EQ(
      problems_of(read_tool, tool),
      "/geometry/minor_kapr_deg: got 85, expected a corner: kapr_deg + minor_kapr_deg "
      "< 180 deg\n");
  tool = example(kTool);
  tool["geometry"]["alpha_deg"] = 0;  // would rub
  EXPECT_NE(problems_of(read_tool, tool).find("/geometry/alpha_deg: got 0, expected"),
            std::string::npos);
  tool["geometry"]["alpha_deg"] = tool["geometry"]["gamma_deg"] = 45;
  EXPECT_EQ(problems_of(read_tool, tool),
            "/geometry/gamma_deg: got 45, expected a wedge: alpha_deg + gamma_deg < 90 "
            "deg\n");
  auto lathe = example(kLathe);
  lathe["spindle"]["curve"][1]["P_kW"] = 16;
  lathe["spindle"]["n_max_rpm"] = 4001;
  lathe["stiffness"]["chuck_radial"]["c1_rad_N"] = 2e-7;  // 4e-14 > 1e-5 * 3e-9
  EXPECT_EQ(
      problems_of(read_lathe, lathe),
      "/spindle/curve/1/P_kW: got 16, expected the power of M_Nm at n_rpm, "
      "15.079644737231007 kW, within 3 %\n"
      "/spindle/curve: got a list of 3 entries, expected points from n_min_rpm or below "
      "to "
      "n_max_rpm or above\n"
      "/stiffness/chuck_radial: got an object, expected c0_mm_N times c2_rad_Nmm at "
      "least c1_rad_N squared\n");
  lathe = example(kLathe);
  std::swap(lathe["spindle"]["curve"][1], lathe["spindle"]["curve"][0]);
  lathe["clampings"] = {"chuck", "chuck"};
  lathe["chuck"]["diameter_mm"] = {200, 10};
  EXPECT_EQ(problems_of(read_lathe, lathe),
            "/clampings/1: got \"chuck\", expected each word once\n"
            "/spindle/curve/1: got an object, expected a speed above the point's before\n"
            "/spindle/curve: got a list of 3 entries, expected points from n_min_rpm or "
            "below to "
            "n_max_rpm or above\n"
            "/chuck/diameter_mm: got [200,10], expected [lower, upper] with lower <= "
            "upper\n");
}

TEST(Catalogue, LoadsAFolderInOrderOfIds) {
  const Folder folder;
  auto material = example(kMaterial);
  folder.write("materials/a.json", material);
  material["id"] = "a-steel";
  folder.write("materials/b.json", material);
  folder.write("tools/t.json", example(kTool));
  folder.write("machines/m.json", example(kLathe));
  folder.write_text("materials/README.md", "not a document");
  const auto all = load_catalogue(folder.path());
  ASSERT_EQ(all.materials.size(), 2U);
  EXPECT_EQ(all.materials[0].id, "a-steel");
  EXPECT_EQ(all.materials[1].id, "test-steel");
  EXPECT_EQ(all.tools.size(), 1U);
  EXPECT_EQ(all.machines.size(), 1U);
}

TEST(Catalogue, TellsAllProblemsOverAllFiles) {
  const Folder folder;
  auto material = example(kMaterial);
  folder.write("materials/a.json", material);
  folder.write("materials/b.json", material);
  material["kienzle"]["mc"] = 1;
  material["id"] = "other";
  folder.write("materials/c.json", material);
  folder.write_text("tools/t.json", "{\"id\": }");
  folder.write_text("machines/m.json", "3");
  try {
    load_catalogue(folder.path());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string at = folder.path().string() + ": ";
    EXPECT_EQ(
        error.what(),
        at +
            "materials/b.json#/id: got \"test-steel\", expected an id no other file "
            "has\n" +
            at +
            "materials/c.json#/kienzle/mc: got 1, expected a number >= 0 and < "
            "1\n" +
            at +
            "tools/t.json#: got broken JSON at line 1, column 8: "
            "unexpected '}' in value, expected '[', '{', or a literal\n" +
            at + "machines/m.json#: got 3, expected an object");
  }
}

TEST(DataFolder, TheArgumentBeatsTheEnvironmentBeatsTheSourceTree) {
  const Folder folder;
  setenv("TURNWRIGHT_DATA", "/nowhere", 1);
  EXPECT_EQ(data_folder(folder.path()), folder.path());
  EXPECT_THROW(data_folder(), InputError);
  setenv("TURNWRIGHT_DATA", folder.path().c_str(), 1);
  EXPECT_EQ(data_folder(), folder.path());
  EXPECT_THROW(data_folder("/nowhere"), InputError);
  unsetenv("TURNWRIGHT_DATA");
}

}  // namespace
}  // namespace turnwright::document::catalogue_test
