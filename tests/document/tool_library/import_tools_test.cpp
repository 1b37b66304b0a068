#include "turnwright/document/import_tools.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>

#include "../slips.hpp"
#include "document/catalogue/catalogue_readers.hpp"
#include "document/json/file.hpp"
#include "document/tool_library/hole_tool_draft.hpp"
#include "document/tool_library/zip_archive.hpp"
#include "turnwright/document/import.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::document::import_tools_test {
namespace {

using nlohmann::json;

std::string bytes_of(const std::string& name) {
  std::ifstream file(source_path("tests/data/tools/" + name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

json answered(const json& request) {
  static const SchemaCheck kRequest("import-tools.request.json"), kTool("tool.json"),
      kFixed("fixed-tool.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = import_tools(request);
  for (const json& tool : result["tools"]) {
    const bool fixed = tool["format"] == "turnwright-fixed-tool/1";
    EXPECT_EQ((fixed ? kFixed : kTool).fault(tool), "") << tool;
    Problems problems{.document = "tool"};
    if (fixed)
      (void)read_fixed_tool(Reader(tool, problems));
    else
      (void)read_tool(Reader(tool, problems));
    EXPECT_TRUE(problems.list.empty()) << tool;
  }
  return result;
}

json imported(const std::string& bytes) { return answered(import_request(bytes)); }

std::string refused(const std::string& bytes) {
  return input_refusal([](const json& r) { import_tools(r); }, import_request(bytes));
}

/// The sentences of remarks at a place.
std::string at(const json& remarks, const std::string& place) {
  std::string all;
  for (const json& r : remarks)
    for (const json& p : r["at"])
      if (p == place) all += r["text"].get<std::string>() + '\n';
  return all;
}

json tool_called(const json& result, const std::string& id) {
  for (const json& tool : result["tools"])
    if (tool["id"] == id) return tool;
  ADD_FAILURE() << "no tool " << id;
  return {};
}

// --------------------------------------------------- taps, reamers and countersinks

json catalogue_tool(const std::string& id) {
  return parse_file(source_path("tools/fixed/" + id + ".json"));
}

TEST(ImportTools, WhatIsNotSaidOfHoleToolsIsAsInTheCatalogue) {
  for (const auto& [use, id] : {std::pair{"tapping", "TAP-HSS-6H"},
                                {"reaming", "REAM-HSS-H7"},
                                {"countersinking", "CSINK-HSS-90"}}) {
    SCOPED_TRACE(id);
    const json tool = catalogue_tool(id);
    const auto& usual = hole_estimates(use);
    EXPECT_EQ(tool["edges"], usual.edges);
    EXPECT_EQ(tool.value("reach_diameters", 0.0), usual.reach_diameters);
    for (const auto& [key, value] : {std::pair{"gamma_deg", usual.gamma_deg},
                                     {"change_min", usual.change_min},
                                     {"edge_cost", usual.edge_cost}})
      EXPECT_EQ(tool[key], value) << key;
    ASSERT_EQ(tool["conditions"].size(), usual.conditions.size());
    for (std::size_t i = 0; i < usual.conditions.size(); ++i) {
      const auto& c = usual.conditions[i];
      const json& of = tool["conditions"][i];
      EXPECT_EQ(of["groups"], json({c.group}));
      EXPECT_EQ(of["vc_m_min"], c.vc_m_min);
      EXPECT_EQ(of.value("f_per_mm", 0.0), c.f_per_mm);
      EXPECT_EQ(of["T_min"], c.T_min);
    }
  }
}

TEST(ImportTools, HoleToolsOfATableAreDocuments) {
  const json r = imported(
      "id;type;DC;TP;NOF;LU;SIG;TDZ;TMC1ISO;unit\n"
      "T8;tap;8;1.25;3;20;;;PK;\nT9;tap;;;;;;M10x1;;\nTI;tap;0.375;0.0625;;;;;;inch\n"
      "R;reamer;12;;6;36;;;;\nC;countersink;20.5;;3;;60;;P;\nN;reamer;;;;;;;;\n"
      "H;tap;8;1.25;;;;;H;\nE;tap;8;1e-9;;;;;;\nF;reamer;8;;1e300;;;;;\n");
  ASSERT_EQ(r["tools"].size(), 5u) << r["ignored"];
  const json tap = tool_called(r, "T8"), reamer = tool_called(r, "R"),
             sink = tool_called(r, "C");
  EXPECT_EQ(tap["use"], "tapping");
  EXPECT_EQ(tap["threads"], json({"M8"}));
  EXPECT_EQ(tap["reach_diameters"], 2.5);
  ASSERT_EQ(tap["conditions"].size(), 2u);
  EXPECT_EQ(tap["conditions"][1]["groups"], json({"K"}));
  EXPECT_EQ(tap["uncertainty_pct"], 50);
  EXPECT_EQ(tool_called(r, "T9")["threads"], json({"M10x1"}));
  EXPECT_EQ(tool_called(r, "TI")["threads"], json({"3/8-16 UN"}));
  EXPECT_EQ(reamer["sizes_mm"], json({12}));
  EXPECT_EQ(reamer["reach_diameters"], 3);
  EXPECT_EQ(reamer["edges"], 6);
  EXPECT_EQ(reamer["hole"], json({{"grade", 7}, {"Ra_um", 0.8}}));
  EXPECT_EQ(sink["point_deg"], 60);
  EXPECT_EQ(sink["sizes_mm"], json({20.5}));
  EXPECT_EQ(at(r["assumed"], "R/edges"), "");
  EXPECT_NE(at(r["assumed"], "T9/edges"), "");
  EXPECT_NE(at(r["assumed"], "T9/reach_diameters").find("3 diameters"),
            std::string::npos);
  EXPECT_EQ(at(r["ignored"], "line 7"), "Its cutting diameter (DC) is not said.\n");
  EXPECT_NE(at(r["ignored"], "line 8").find("no material of the groups H"),
            std::string::npos);
  EXPECT_NE(at(r["ignored"], "line 9").find("is no thread of a tap"), std::string::npos);
  EXPECT_NE(at(r["ignored"], "line 10").find("/edges"), std::string::npos);
}

TEST(ImportTools, HoleToolsOfFusionAreDocuments) {
  const auto tool = [](const char* type, const char* called, json geometry,
                       const char* unit = "millimeters") {
    return json{{"type", type},
                {"description", called},
                {"unit", unit},
                {"geometry", std::move(geometry)},
                {"BMC", "hss"}};
  };
  const json r = imported(json{
      {"data",
       {tool("tap right hand", "M42 steel, M6", {{"DC", 6}, {"LCF", 15}, {"NOF", 2}}),
        tool("tap right hand", "tap", {{"DC", 0.25}, {"TP", 0.05}}, "inches"),
        tool("tap left hand", "M6 LH", {{"DC", 6}, {"TP", 1}}),
        tool("reamer", "6H7", {{"DC", 6}, {"LCF", 24}, {"NOF", 6}}),
        tool("counter sink", "90", {{"DC", 12.4}, {"SIG", 90}, {"NOF", 3}}),
        tool("tap right hand", "special",
             {{"DC", 6}})}}}.dump());
  ASSERT_EQ(r["tools"].size(), 4u) << r["ignored"];
  EXPECT_EQ(r["tools"][0]["threads"], json({"M6"}));  // not the steel's grade
  EXPECT_EQ(r["tools"][0]["reach_diameters"], 2.5);
  EXPECT_EQ(r["tools"][1]["threads"], json({"1/4-20 UN"}));
  EXPECT_EQ(r["tools"][2]["use"], "reaming");
  EXPECT_EQ(r["tools"][3]["point_deg"], 90);
  EXPECT_NE(at(r["ignored"], "/data/2").find("right-hand"), std::string::npos);
  EXPECT_NE(at(r["ignored"], "/data/5").find("neither the thread"), std::string::npos);
}

TEST(ImportTools, HoleToolsOfFreeCadAndMtconnectAreDocuments) {
  const auto bit = [](const char* shape, json parameters,
                      json attribute = json::object()) {
    return json{{"version", 2},
                {"name", "a bit"},
                {"shape", shape},
                {"parameter", std::move(parameters)},
                {"attribute", std::move(attribute)}}
        .dump();
  };
  const json tap{
      {"Diameter", "8 mm"}, {"Pitch", "1.25 mm"}, {"CuttingEdgeLength", "24 mm"}};
  const json r = imported(
      zipped({{"tap.fctb", bit("tap.fcstd", tap)},
              {"left.fctb", bit("tap.fcstd", tap, {{"SpindleDirection", "Reverse"}})},
              {"inch.fctb",
               bit("tap.fcstd", {{"Diameter", "0.375 \""}, {"Pitch", "0.0625 in"}})},
              {"reamer.fctb", bit("reamer.fcstd", {{"Diameter", "5 mm"}})}}));
  ASSERT_EQ(r["tools"].size(), 3u) << r["ignored"];
  EXPECT_EQ(r["tools"][0]["threads"], json({"M8"}));
  EXPECT_EQ(r["tools"][0]["reach_diameters"], 3);
  EXPECT_NE(at(r["ignored"], "left.fctb").find("turns to the left"), std::string::npos);

  const json x = imported(
      R"(<MTConnectAssets><CuttingTool assetId="1" toolId="R8"><Description>Reamer 8 H7</Description>
         <CuttingToolLifeCycle><Measurements><CuttingDiameter code="DC">8</CuttingDiameter>
         <UsableLength code="LU">32</UsableLength></Measurements></CuttingToolLifeCycle>
         </CuttingTool></MTConnectAssets>)");
  ASSERT_EQ(x["tools"].size(), 1u) << x["ignored"];
  EXPECT_EQ(x["tools"][0]["id"], "R8");
  EXPECT_EQ(x["tools"][0]["sizes_mm"], json({8}));
  EXPECT_EQ(x["tools"][0]["reach_diameters"], 4);
}

// Left-hand, forming and other taps than metric and unified ones are told, none is another.
TEST(ImportTools, OtherTapsAreNotTakenForMetricOnes) {
  const char* wrong[] = {"tap left hand;M8;", "tap;M8x1.25 LH;",   "tap;M8;L",
                         "forming tap;M8;",   "tap fluteless;M8;", "tap;EG M8;",
                         "tap;M10 STI;",      "tap;1/4-20 BSW;",   "tap;1/4-18 NPT;",
                         "tap;G 1/8;",        "tap;Rd 8x1;",       "tap;Tr 8x1.5;"};
  std::string table = "id;type;TDZ;HAND;DC;TP\n";
  for (const char* line : wrong) table += std::string("T;") + line + ";8;1\n";
  const json r = imported(table);
  EXPECT_EQ(r["tools"].size(), 0u) << r["tools"];
  EXPECT_EQ(imported("id;type;TDZ;HAND\nA;tap;M8;R\n")["tools"].size(), 1u);
  EXPECT_EQ(imported("id;type;DC;TP\nA;tap;9.525;406.4\nB;tap;8;1\n")["tools"].size(),
            1u);
}

TEST(ImportTools, AHoleIsTappedByTheLibrarysTap) {
  const json tap = imported("id;type;TDZ\nOURS;tap;M10\n")["tools"][0];
  json part =
      json::parse(R"({"format": "turnwright-part/1", "name": "nut", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 42, "length_mm": 34, "left_allowance_mm": 2},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 15, "diameter_mm": 40},
              {"id": "d2", "kind": "cylinder", "length_mm": 15, "diameter_mm": 30}],
    "inner": [{"id": "t", "kind": "thread", "from": "right", "length_mm": 16,
               "designation": "M10"}], "choose": {"setups": "auto"}})");
  part["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", tap};
  static const Catalogue kShop = load_catalogue(source_path(""));
  const auto candidates = prepared_part(part, kShop, "part").part.fixed_tools;
  const auto ours = std::ranges::find(candidates, "OURS", &catalogue::FixedTool::id);
  ASSERT_NE(ours, candidates.end());
  for (const auto& t : candidates)
    EXPECT_TRUE(t.id == "OURS" || t.use != catalogue::FixedUse::tapping) << t.id;
}

// ------------------------------------------------------------------------------ Fusion

json fusion_tool(const std::string& geometry, const std::string& rest = "") {
  return json::parse(R"({"type": "turning general", "unit": "millimeters",
    "description": "tool", "geometry": )" +
                     geometry + rest + "}");
}

json of_fusion(const json& tool) { return imported(json{{"data", {tool}}}.dump()); }

TEST(ImportTools, FusionsTurningToolsAreDocuments) {
  const json r = imported(bytes_of("crib.json"));
  EXPECT_EQ(r["source"], "fusion");
  ASSERT_EQ(r["tools"].size(), 5u);
  const json t = tool_called(r, "T01");
  EXPECT_EQ(t["insert"], "CNMG 120408");
  EXPECT_EQ(t["geometry"]["kapr_deg"], 95);
  EXPECT_EQ(t["geometry"]["minor_kapr_deg"], 180 - 95 - 80);
  EXPECT_EQ(t["holder"]["designation"], "DCLNL 2525M 12");
  // 0.6 and 1.5 times the presets' 0.3 and 0.35 mm, 0.6 and 1.4 times 180 and 220 m/min.
  EXPECT_EQ(t["window"]["f_mm_rev"], json({0.18, 0.525}));
  EXPECT_EQ(t["window"]["vc_m_min"], json({108, 308}));
  EXPECT_EQ(at(r["contradictions"], "/data/0"), "");
  EXPECT_NE(at(r["assumed"], "T01/life"), "");
  EXPECT_GE(t["life"]["uncertainty_pct"], 50);
  EXPECT_EQ(t["life"]["source"].get<std::string>().rfind("not in the library", 0), 0u);
}

// Makers print 1/32 inch as 0.031 or 0.0312.
TEST(ImportTools, ARoundedInchCornerIsTheInchSize) {
  for (const char* corner : {"0.0312", "0.031", "0.03125"}) {
    const json r =
        imported(std::string("insert,RE,unit\nCNMG 432,") + corner + ",inch\n");
    EXPECT_EQ(r["contradictions"], json::array()) << corner;
    EXPECT_NEAR(r["tools"][0]["geometry"]["re_mm"], 25.4 / 32, 1e-9) << corner;
  }
  EXPECT_NE(imported("insert,RE,unit\nCNMG 432,0.029,inch\n")["contradictions"],
            json::array());
}

TEST(ImportTools, EveryToolHasItsUnitAndSoHasItsHolder) {
  const json r = imported(bytes_of("crib.json"));
  const json inch = tool_called(r, "OD-finisher-25-mm");
  EXPECT_EQ(inch["insert"], "DNMG 150408");
  EXPECT_EQ(inch["geometry"]["re_mm"], 25.4 / 32);  // 0.794 mm, not 0.8
  const auto speeds = inch["window"]["vc_m_min"];
  EXPECT_NEAR(speeds[0].get<double>(), 0.6 * 800 * 0.3048, 1e-6);  // ft/min
  EXPECT_NEAR(inch["window"]["f_mm_rev"][1].get<double>(), 1.5 * 0.006 * 25.4, 1e-6);
  const json mixed = tool_called(r, "80-deg-20-mm-shank");
  EXPECT_EQ(mixed["insert"], "CNMG 120408");
  EXPECT_EQ(mixed["holder"]["designation"], "DCLNR 2020K 12");
  EXPECT_EQ(mixed["holder"]["lf_mm"], 125);
}

TEST(ImportTools, ContradictionsOfALibraryAreNamed) {
  const json r = imported(bytes_of("crib.json"));
  const auto style = at(r["contradictions"], "/data/1");
  EXPECT_NE(style.find("DDJNL 2525M 15 has an edge angle of 93 deg, style L of 95 deg"),
            style.npos)
      << style;
  EXPECT_NE(style.find("H x B is 20 x 20 mm"), style.npos) << style;
  EXPECT_EQ(tool_called(r, "OD-finisher-25-mm")["geometry"]["kapr_deg"], 93);
  EXPECT_FALSE(tool_called(r, "OD-finisher-25-mm").contains("holder"));
  EXPECT_EQ(at(r["contradictions"], "/data/3"),
            "A16M SCLCR 09 has a shank of 16 mm, the library says 20 mm: the name is "
            "taken.\n");
}

TEST(ImportTools, BarsOfFusionBore) {
  const json r = imported(bytes_of("crib.json"));
  const json bar = tool_called(r, "Bore-16");
  EXPECT_EQ(bar["uses"], json({"boring"}));
  EXPECT_EQ(bar["insert"], "CCMT 09T304");  // clearance of the bar SCLCR
  EXPECT_EQ(bar["bar"]["segments"][0]["diameter_mm"], 16);
  EXPECT_EQ(bar["bar"]["tip_offset_mm"], 11.2);  // CW is that of a shank of 20 mm
  EXPECT_EQ(bar["bar"]["min_bore_mm"], 20.2);    // 16/2 + 0.7 x 16 + 1
  EXPECT_EQ(tool_called(r, "Bore-20-finishing")["bar"]["tip_offset_mm"], 13);
  EXPECT_EQ(tool_called(r, "Bore-20-finishing")["geometry"]["kapr_deg"], 93);  // style u
}

TEST(ImportTools, WhatIsNoTurningToolIsToldOnceWithItsPlaces) {
  const json ignored = imported(bytes_of("crib.json"))["ignored"];
  EXPECT_EQ(at(ignored, "/data/6"),
            "\"flat end mill\" is no turning tool with an insert.\n");
  EXPECT_EQ(at(ignored, "/data/6"), at(ignored, "/data/7"));
  EXPECT_NE(at(ignored, "/data/5").find("conditions for every group"), std::string::npos);
  EXPECT_NE(at(ignored, "/data/9").find("insert is not said"), std::string::npos);
  EXPECT_NE(at(ignored, "/data/10").find("unit: got \"furlongs\""), std::string::npos);
  EXPECT_NE(at(ignored, "/data/10").find("geometry/RE: got \"0.8\""), std::string::npos);
  EXPECT_NE(at(ignored, "/data/11").find("round insert"), std::string::npos);
  EXPECT_NE(at(ignored, "/data/12").find("no angle to the minor edge"),
            std::string::npos);
  EXPECT_NE(at(ignored, "/data/13").find("high-speed steel"), std::string::npos);
}

// 9.525 mm is the circle of an edge of 9.525/sin 80 deg = 9.672 mm.
TEST(ImportTools, FeedsOfPresetsStayWithinTheCorner) {
  const auto with_feed = [](const std::string& f_n) {
    return of_fusion(fusion_tool(
        R"({"SC": "C", "RE": 0.8, "INSD": 12.7, "S": 4.76})",
        R"(, "start-values": {"presets": [{"f_n": )" + f_n + R"(, "v_c": 100}]})"));
  };
  EXPECT_EQ(with_feed("0.5")["tools"][0]["window"]["f_mm_rev"], json({0.3, 0.64}));
  const json r = with_feed("2");
  EXPECT_EQ(r["tools"][0]["window"]["f_mm_rev"], json({0.12, 0.48}));
  EXPECT_NE(at(r["contradictions"], "/data/0").find("more than the corner"),
            std::string::npos);
}

TEST(ImportTools, ASizeIsTheCircleOrTheEdge) {
  for (const char* size : {R"("INSD": 9.525)", R"("INSD": 9.671938)",
                           R"("INSD": 9.67, "SIZE_SPECIFICATION_MODE": "CE")"}) {
    const json r = of_fusion(fusion_tool(
        std::string(
            R"({"SC": "C", "SCTY": "T", "TC": "M", "RE": 0.4, "S": 3.97, "RA": 7, )") +
        size + "}"));
    ASSERT_EQ(r["tools"].size(), 1u) << r;
    EXPECT_EQ(r["tools"][0]["insert"], "CCMT 09T304") << size;
  }
  // Said to be the edge, a circle is none.
  const json r = of_fusion(fusion_tool(
      R"({"SC": "C", "RE": 0.4, "INSD": 9.525, "SIZE_SPECIFICATION_MODE": "CE"})"));
  EXPECT_NE(at(r["ignored"], "/data/0").find("an edge of 9.525 mm"), std::string::npos)
      << r;
}

TEST(ImportTools, AClearanceOfZeroIsNotSaid) {
  const auto insert = [](const std::string& mtp, const std::string& ra) {
    const json r = of_fusion(fusion_tool(
        R"({"SC": "C", "SCTY": "T", "TC": "M", "RE": 0.4, "S": 3.97, "INSD": 9.525, "RA": )" +
            ra + "}",
        R"(, "holder": {"MTP": ")" + mtp + "\"}"));
    const bool told =
        at(r["assumed"], "tool/insert").find("clearance") != std::string::npos;
    return r["tools"][0]["insert"].get<std::string>() + (told ? " assumed" : "");
  };
  EXPECT_EQ(insert("S", "0"), "CCMT 09T304 assumed");
  EXPECT_EQ(insert("D", "0"), "CNMT 09T304 assumed");
  EXPECT_EQ(insert("S", "11"), "CPMT 09T304");
}

TEST(ImportTools, TheNameOfAnInsertWinsOverItsSizes) {
  json tool = fusion_tool(
      R"({"SC": "D", "SCTY": "T", "TC": "M", "RE": 0.4, "S": 4.76, "INSD": 12.7})");
  tool["description"] = "rougher CNMG 120408-PM";
  const json r = of_fusion(tool);
  EXPECT_EQ(r["tools"][0]["insert"], "CNMG 120408");
  EXPECT_EQ(at(r["contradictions"], "/data/0"),
            "The insert is named CNMG 120408, but SC is D, the type is T, RE is 0.4 "
            "mm: the name is taken.\n");
}

TEST(ImportTools, IdsAreNamesOfFilesAndEachOnce) {
  json library{{"data", json::array()}};
  for (const char* name : {"a/b", "a b", "", "..", "a-b-2", "Größe 5"}) {
    json tool = fusion_tool(R"({"SC": "C", "RE": 0.8, "INSD": 12.7, "S": 4.76})");
    tool["description"] = name;
    library["data"].push_back(tool);
  }
  std::vector<std::string> ids;
  const json r = imported(library.dump());
  for (const json& tool : r["tools"]) ids.push_back(tool["id"]);
  EXPECT_EQ(ids, (std::vector<std::string>{"a-b", "a-b-2", "CNMG-120408", "tool",
                                           "a-b-2-2", "Gr-e-5"}));
}

TEST(ImportTools, ALibraryInAnArchiveIsTheSame) {
  const auto text = bytes_of("crib.json");
  EXPECT_EQ(imported(zipped({{"tools.json", text}})), imported(text));
  EXPECT_EQ(imported("\xEF\xBB\xBF" + text), imported(text));
}

// --------------------------------------------------------------------------------- CSV

TEST(ImportTools, TablesHaveSymbolsOfIso13399) {
  const json r = imported(bytes_of("crib.csv"));
  EXPECT_EQ(r["source"], "csv");
  EXPECT_EQ(r["tools"].size(), 4u);
  const json rougher = tool_called(r, "R1");
  EXPECT_EQ(rougher["holder"]["designation"], "PCLNL 2525M 12");
  EXPECT_EQ(rougher["groups"], json({"P", "K"}));
  EXPECT_EQ(rougher["window"]["ap_mm"][1], 5);  // APMX
  EXPECT_EQ(rougher["geometry"]["gamma_deg"], 6);
  EXPECT_EQ(tool_called(r, "I1")["geometry"]["re_mm"], 25.4 / 32);
  EXPECT_EQ(tool_called(r, "B1")["bar"]["segments"][0]["length_mm"], 48);
  EXPECT_EQ(at(r["ignored"], "header"), "The column \"shelf\" is not read.\n");
  EXPECT_NE(at(r["ignored"], "line 7").find("RE: got \"O,8\""), std::string::npos);
  EXPECT_NE(at(r["ignored"], "line 8"), "");
}

TEST(ImportTools, DecimalCommasAndPointsAreOneTable) {
  EXPECT_EQ(imported("name;SC;IC;S;RE\nx;C;12,7;4,76;0,8\n")["tools"],
            imported("name,SC,IC,S,RE\nx,C,12.7,4.76,0.8\n")["tools"]);
}

TEST(ImportTools, ATableWithoutAUnitHasThatOfTheRequest) {
  json request = import_request("name,SC,IC,S,RE\nx,C,0.5,0.1875,0.03125\n");
  request["unit"] = "inch";
  request["groups"] = {"H", "P"};
  const json t = answered(request)["tools"][0];
  EXPECT_EQ(t["insert"], "CNMG 120408");
  EXPECT_EQ(t["groups"], json({"P", "H"}));
}

TEST(ImportTools, ANamedInsertKeepsTheInchSizeOfItsCorner) {
  const json r =
      imported("insert;RE;unit\nCNMG 120408;0,03125;inch\nCNMG 432;;\nCNMG 432;0.8;\n");
  ASSERT_EQ(r["tools"].size(), 3u) << r;
  for (const json& tool : r["tools"]) EXPECT_EQ(tool["insert"], "CNMG 120408");
  EXPECT_EQ(r["tools"][0]["geometry"]["re_mm"], 25.4 / 32);
  EXPECT_EQ(r["tools"][1]["geometry"]["re_mm"], 25.4 / 32);
  EXPECT_EQ(r["tools"][2]["geometry"]["re_mm"], 0.8);
  EXPECT_TRUE(r["contradictions"].empty()) << r;
}

TEST(ImportTools, WhatTheReaderRefusesIsIgnoredWithItsPlace) {
  const json r = imported("insert;KAPR;APMX\nCNMG 120408;-5;\nCNMG 120408;95;60\n");
  EXPECT_TRUE(r["tools"].empty());
  EXPECT_NE(at(r["ignored"], "line 2").find("refused: /geometry/kapr_deg: got -5"),
            std::string::npos)
      << r;
  EXPECT_NE(at(r["ignored"], "line 3").find("refused: /window/ap_mm/1: got 60"),
            std::string::npos)
      << r;
}

TEST(ImportTools, AHolderOfOtherInsertsIsNotUsed) {
  const json r = imported("insert;holder\nDNMG 150604;PCLNL 2525M 12\n");
  EXPECT_EQ(r["tools"][0]["geometry"]["kapr_deg"], 93);
  EXPECT_NE(at(r["contradictions"], "line 2").find("does not hold DNMG 150604"),
            std::string::npos);
  EXPECT_NE(at(r["assumed"], "DNMG-150604/geometry/kapr_deg"), "");
}

TEST(ImportTools, ABarsCornerIsBeyondItsShankAndInItsBore) {
  const auto bar = [](const std::string& row) {
    return imported("insert;holder;WF;DMIN\nCCMT 09T304;A16M-SCLCR 09;" + row + "\n");
  };
  const json within = bar("5;");
  EXPECT_EQ(within["tools"][0]["bar"]["tip_offset_mm"], 0.7 * 16);
  EXPECT_NE(at(within["assumed"], "CCMT-09T304/bar/tip_offset_mm"), "");
  const json inch = imported(
      "insert;holder;DCON;WF;unit\nCCMT 09T304;A16M-SCLCR 09;0,629921;0,433071;inch\n");
  EXPECT_TRUE(inch["contradictions"].empty()) << inch;
  EXPECT_NEAR(inch["tools"][0]["bar"]["tip_offset_mm"].get<double>(), 11, 1e-4);
  const json tight = bar("11;18");
  EXPECT_EQ(tight["tools"][0]["bar"]["min_bore_mm"], 8 + 11 + 1);
  EXPECT_NE(at(tight["contradictions"], "line 2").find("DMIN is 18 mm"),
            std::string::npos);
}

TEST(ImportTools, ARowWithABarBores) {
  const auto uses = [](const std::string& row) {
    const json r = imported("insert;holder;DCON;TMC1ISO\n" + row + "\n");
    return r["tools"].empty() ? r["ignored"][0]["text"] : r["tools"][0]["uses"];
  };
  EXPECT_EQ(uses("CCMT 09T304;A16M-SCLCR 09;;"), json({"boring"}));
  EXPECT_EQ(uses("CCMT 09T304;;16;P25"), json({"boring"}));
  EXPECT_EQ(uses("CCMT 09T304;;;").size(), 3u);
  EXPECT_EQ(
      uses("CCMT 09T304;;;Steel"),
      "It cannot be read: TMC1ISO: got \"Steel\", expected letters of ISO 513, P M K "
      "N S H.");
}

TEST(ImportTools, BytesOfLatin1AreRead) {
  EXPECT_EQ(imported("name,insert\nGr\xF6\xDF"
                     "e,CNMG 120408\n")["tools"][0]["name"],
            "Größe");
}

TEST(ImportTools, AWrongTableIsRefusedWithItsLines) {
  EXPECT_NE(
      refused("some text, that is no table\n1, 2\n").find("a header of other columns"),
      std::string::npos);
  EXPECT_NE(refused("insert;RE\nCNMG 120408\n").find("line 2: 1 cells"),
            std::string::npos);
  EXPECT_NE(refused("insert;RE\n").find("no rows"), std::string::npos);
  EXPECT_NE(refused("insert\xFF\n\x01\n"), "");
}

// --------------------------------------------------------------------------- MTConnect

TEST(ImportTools, AssetsOfMtconnectAreRead) {
  const json r = imported(bytes_of("turning_assets.xml"));
  EXPECT_EQ(r["source"], "mtconnect");
  ASSERT_EQ(r["tools"].size(), 2u);
  const json rougher = tool_called(r, "T7");
  EXPECT_EQ(rougher["insert"], "CNMG 120408");
  EXPECT_EQ(rougher["geometry"]["re_mm"], 0.8);  // nominal, not as measured
  EXPECT_EQ(rougher["holder"]["designation"], "DCLNL 2525M 12");
  const json bar = tool_called(r, "T8");       // in a namespace with a prefix
  EXPECT_EQ(bar["geometry"]["kapr_deg"], 93);  // PSIR -3
  EXPECT_EQ(bar["bar"]["segments"][0]["length_mm"], 60);
  EXPECT_EQ(bar["bar"]["min_bore_mm"], 24);
  EXPECT_NE(at(r["ignored"], "CuttingToolArchetype T9").find("no CuttingItem"),
            std::string::npos);
  EXPECT_TRUE(r["contradictions"].empty()) << r;
}

// A face mill of the standard's own examples: Apache-2.0, see tests/data/tools/README.md.
TEST(ImportTools, AMillOfMtconnectIsNoTurningTool) {
  const json r = imported(bytes_of("mtconnect_asset1.xml"));
  EXPECT_TRUE(r["tools"].empty());
  EXPECT_NE(at(r["ignored"], "CuttingTool KSSP300R4SD43L240.1").find("cutting diameter"),
            std::string::npos)
      << r;
}

TEST(ImportTools, WrongXmlIsRefusedWithItsPlace) {
  EXPECT_NE(refused("<Assets><CuttingTool></Assets>").find("/text: got byte "),
            std::string::npos);
  EXPECT_NE(refused("<Assets/>").find("without CuttingTool"), std::string::npos);
}

// ----------------------------------------------------------------------------- FreeCAD

// The corner of 55 deg about 59.5 deg from the axis: edges at 87 and 32 deg.
TEST(ImportTools, BitsOfFreecadHaveTheirAnglesByRotation) {
  const json r = imported(bytes_of("rhombus.fctb"));
  EXPECT_EQ(r["source"], "freecad");
  const json t = r["tools"][0];
  EXPECT_EQ(t["insert"], "DCMT 11T304");
  EXPECT_EQ(t["geometry"]["kapr_deg"], 180 - 87);
  EXPECT_EQ(t["geometry"]["minor_kapr_deg"], 32);
  EXPECT_TRUE(r["contradictions"].empty()) << r;
}

std::string bit(const std::string& name, const std::string& edge,
                const std::string& tip) {
  return R"({"version": 2, "name": ")" + name + R"(", "parameter": {"EdgeLength": ")" +
         edge + R"(", "Rotation": "45.00 °", "TipAngle": ")" + tip +
         R"( °", "TipRadius": "0.40 mm"}})";
}

TEST(ImportTools, ANameOfABitThatIsNoDesignationIsTold) {
  const json r = imported(bit("CCMT070204R", "6.35 mm", "80.00"));
  EXPECT_EQ(r["tools"][0]["insert"], "CCMT 060204");
  EXPECT_NE(at(r["contradictions"], "the bit").find("\"CCMT070204\" is no designation"),
            std::string::npos)
      << r;
}

TEST(ImportTools, BitsComeInAnArchive) {
  const json r =
      imported(zipped({{"Bit/c.fctb", bit("CCMT060204", "0.25 in", "80")},
                       {"Library/all.fctl", R"({"tools": []})"},
                       {"Bit/mill.fctb", R"({"parameter": {"Diameter": "6 mm"}})"},
                       {"Bit/odd.fctb", bit("x", "6.35 furlongs", "80")},
                       {"Bit/angle.fctb", bit("x", "6.35", "81.5")}}));
  ASSERT_EQ(r["tools"].size(), 1u) << r;
  EXPECT_EQ(r["tools"][0]["insert"], "CCMT 060204");
  EXPECT_NE(at(r["ignored"], "Bit/mill.fctb").find("no turning bit"), std::string::npos);
  EXPECT_NE(at(r["ignored"], "Bit/odd.fctb").find("furlongs"), std::string::npos);
  EXPECT_NE(at(r["ignored"], "Bit/angle.fctb").find("81.5"), std::string::npos);
  EXPECT_NE(refused(R"({"tools": [{"nr": 1, "path": "c.fctb"}]})").find(".fctl"),
            std::string::npos);
}

// A library gives its bits their numbers and order; what it names and is not there is told.
TEST(ImportTools, ALibraryOfFreeCadComesWithItsBits) {
  const auto named = [](const char* path, int number) {
    return json{{"nr", number}, {"path", path}};
  };
  const json library{{"version", 1},
                     {"tools",
                      {named("d.fctb", 3), named("Bit/c.fctb", 1), named("gone.fctb", 2),
                       named("odd.fctb", 4), json(5), json{{"nr", "x"}}}}};
  const json r = imported(zipped({{"Bit/c.fctb", bit("CCMT060204", "0.25 in", "80")},
                                  {"Bit/d.fctb", bit("DCMT070204", "0.25 in", "55")},
                                  {"Bit/e.fctb", bit("VBMT110304", "0.25 in", "35")},
                                  {"Bit/odd.fctb", R"({"parameter": {}})"},
                                  {"Library/all.fctl", library.dump()}}));
  ASSERT_EQ(r["tools"].size(), 3u) << r;
  EXPECT_EQ(r["tools"][0]["insert"], "DCMT 070204");
  EXPECT_EQ(r["tools"][1]["insert"], "CCMT 060204");
  EXPECT_EQ(r["tools"][2]["insert"], "VBMT 110304");
  EXPECT_NE(at(r["ignored"], "T2 gone.fctb").find("Library/all.fctl names it"),
            std::string::npos)
      << r["ignored"];
  EXPECT_NE(at(r["ignored"], "T4 Bit/odd.fctb").find("no turning bit"),
            std::string::npos);
  for (const char* broken : {"[]", "5", R"({"tools": 5})", R"({"tools": [[]]})"})
    EXPECT_EQ(imported(zipped({{"c.fctb", bit("CCMT060204", "0.25 in", "80")},
                               {"a.fctl", broken}}))["tools"]
                  .size(),
              1u)
        << broken;
}

TEST(ImportTools, FilesOfOneNameAreRefused) {
  EXPECT_THROW(zipped({{"a.fctb", "{}"}, {"a.fctb", "{}"}}), InputError);
}

// ------------------------------------------------------------------------- real libraries

// Libraries of makers and shops, which may not be copied here.
TEST(ImportTools, LibrariesOfAFolderAreRead) {
  const char* folder = std::getenv("TURNWRIGHT_TOOL_LIBRARIES");
  if (!folder) {
    std::cout << "NOT CHECKED: TURNWRIGHT_TOOL_LIBRARIES names no folder of libraries\n";
    GTEST_SKIP() << "TURNWRIGHT_TOOL_LIBRARIES is not set";
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(refused(bytes), "") << entry.path();
    const json result = imported(bytes);
    std::cout << entry.path().filename() << ": " << result["tools"].size() << " tools, "
              << result["contradictions"].size() << " contradictions, "
              << result["ignored"].size() << " remarks on what is ignored\n";
  }
}

// ------------------------------------------------------------------------- what is wrong

TEST(ImportTools, OtherFilesAreRefusedWithWhatCanBeRead) {
  for (const std::string& other : {std::string("ISO-10303-21;\nHEADER;"),
                                   std::string("{\"a\": 1}"), std::string("[1, 2]"),
                                   zipped({{"package_meta_data.xml", "<a/>"},
                                           {"product_data/tool.p21", "ISO-10303-21;"}}),
                                   zipped({{"readme.txt", "nothing"}})}) {
    const auto why = refused(other);
    EXPECT_NE(why.find("ool library of Fusion"), why.npos) << why;
  }
  EXPECT_NE(refused("PK\x03\x04 and no archive"), "");
  EXPECT_NE(refused("{\"data\": [1, }").find("/text: got"), std::string::npos);
  EXPECT_NE(refused(zipped({{"a/tools.json", "{"}})).find("/base64: got a/tools.json: "),
            std::string::npos)
      << refused(zipped({{"a/tools.json", "{"}}));
  EXPECT_NE(input_refusal([](const json& r) { import_tools(r); }, json::object())
                .find("no library"),
            std::string::npos);
}

TEST(ImportTools, BombsEndInErrors) {
  const auto zeros =
      zipped({{"tools.json", "{\"data\": [" + std::string(kLargestLibrary, ' ') + "]}"}});
  EXPECT_LT(zeros.size(), 200'000u);
  EXPECT_NE(refused(zeros).find("tools.json: more bytes than the archive may unpack to"),
            std::string::npos);
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  EXPECT_NE(refused(deep), "");
  EXPECT_NE(refused(std::string(100'000, '[')), "");
  std::string many = "insert\n";
  for (int i = 0; i < 1'000'000; ++i) many += "x\n";
  EXPECT_NE(refused(many).find("1 to 10000 rows"), std::string::npos);
  const auto tools = [](int count, const std::string& type) {
    std::string all = R"({"data": [{})";
    for (int i = 0; i < count; ++i) all += R"(,{"type":")" + type + "\"}";
    return all + "]}";
  };
  EXPECT_NE(refused(tools(100'000, "drill")).find("more than 100000 entries"),
            std::string::npos);
  EXPECT_NE(refused(tools(10'002, R"(turning boring","unit":"mm)"))
                .find("more than 10000 turning tools"),
            std::string::npos);
  std::string assets = "<a>";
  for (int i = 0; i <= 10'000; ++i) assets += "<CuttingTool/>";
  EXPECT_NE(refused(assets + "</a>").find("at most 10000"), std::string::npos);
}

// ------------------------------------------------------------------------------ invariants

TEST(ImportTools, EverySlipInARequestIsRefusedAsTheSchemaDoes) {
  static const SchemaCheck kSchema("import-tools.request.json");
  const json good{{"format", "turnwright-import-tools/1"},
                  {"text", "insert\nCNMG 120408\n"},
                  {"unit", "inch"},
                  {"groups", {"P", "N"}}};
  const auto refused_request = [](const json& r) {
    return input_refusal([](const json& request) { import_tools(request); }, r);
  };
  EXPECT_GT(SlipsOf(kSchema, refused_request, good).try_all(), 15);
}

// Whatever a library says, its tool is a document that the reader accepts, or refused with
// a reason of ours, never by the reader.
TEST(ImportTools, NoDraftIsRefusedByTheReader) {
  std::string table = "name;type;SC;IC;RE;KAPR;DCON;WF;APMX\n";
  int rows = 0;
  for (const char shape : std::string("CDVTSWEMPHO"))
    for (const double circle : {3.97, 6.35, 9.525, 12.7, 25.4})
      for (const double corner : {0.2, 0.4, 0.794, 1.6, 2.4})
        for (const char* rest : {";;;;", ";45;;;", ";107,5;;;0,1", ";95;12;9;3"}) {
          const bool bar = std::string(rest).find("12") != std::string::npos;
          table += "t;" + std::string(bar ? "boring" : "turning") + ";" + shape + ";" +
                   std::to_string(circle) + ";" + std::to_string(corner) + rest + "\n";
          ++rows;
        }
  const json r = imported(table);
  for (const json& remark : r["ignored"])
    EXPECT_EQ(remark["text"].get<std::string>().find("would be refused"),
              std::string::npos)
        << remark;
  EXPECT_GT(static_cast<int>(r["tools"].size()), rows / 3);
}

json with_tools(json part, const json& tools) {
  part["tools"] = tools;
  return part;
}

planning::ProcessPlan planned_with(const json& part) {
  static const Catalogue kShop = load_catalogue(source_path(""));
  return planning::plan(prepared_part(part, kShop, "part").part);
}

// The planner rough turns, finishes and bores with a crib's tools alone.
TEST(ImportTools, AReferencePartIsPlannedWithACribsTools) {
  const json tools = imported(bytes_of("crib.json"))["tools"];
  const auto plan =
      planned_with(with_tools(parse_file(source_path("parts/flanged-bush.json")), tools));
  EXPECT_EQ(plan.status, planning::PlanStatus::ok);
  EXPECT_GT(plan.cost_per_part, 0);
}

}  // namespace
}  // namespace turnwright::document::import_tools_test
