// Schemas and readers describe the same documents.
#include <gtest/gtest.h>

#include "document/catalogue/catalogue_readers.hpp"
#include "document/catalogue/entries.hpp"
#include "document/json/file.hpp"
#include "slips.hpp"
#include "test_catalogue.hpp"
#include "turnwright/document/calibrate_material.hpp"
#include "turnwright/document/chuck.hpp"
#include "turnwright/document/multipass.hpp"
#include "turnwright/document/prepared_part.hpp"
#include "turnwright/document/stability.hpp"

namespace turnwright::document::schema_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void every_file_fits(const fs::path& folder, const std::string& schema_file) {
  const SchemaCheck schema(schema_file);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_EQ(schema.fault(parse_file(entry.path())), "") << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0) << folder;
}

TEST(Schema, FitsEveryFileOfTheCatalogue) {
  for (const auto& root : {source_path(""), source_path("tests/data/catalogue")}) {
    every_file_fits(root / "materials", "material.json");
    every_file_fits(root / "tools", "tool.json");
    every_file_fits(root / "tools" / "fixed", "fixed-tool.json");
    every_file_fits(root / "tools" / "milling", "milling-cutter.json");
    every_file_fits(root / "machines", "lathe.json");
  }
  every_file_fits(source_path("shops"), "shop.json");
}

TEST(Schema, FitsEveryReferencePartAndTheReaderTakesIt) {
  every_file_fits(source_path("parts"), "part.json");
  const auto catalogue = load_catalogue(source_path(""));
  for (const auto& entry : fs::directory_iterator(source_path("parts"))) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NO_THROW(prepared_part(parse_file(entry.path()), catalogue,
                                  entry.path().filename().string()));
  }
}

// A document that uses every key, and its neighbours by one slip each.
void try_all(const SchemaCheck& schema, std::string (*refused)(const json&), json good,
             int at_least = 100) {
  EXPECT_GT(SlipsOf(schema, refused, std::move(good)).try_all(), at_least);
}

std::string refused_part(const json& document) {
  try {
    prepared_part(document, test_catalogue(), "t");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

template <class T, T (*Read)(Reader)>
std::string refused_entry(const json& document) {
  Problems problems{.document = "t"};
  Read(Reader(document, problems));
  return problems.list.empty() ? "" : problems.list[0].pointer;
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAPart) {
  const SchemaCheck schema("part.json");
  auto part = parse_file(source_path("tests/data/every_key_of_a_part.json"));
  part["objective"] = "cost";  // that profit needs a price is beyond the schema
  try_all(schema, refused_part, part);
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInWhatIsCutAtFixedConditions) {
  auto part = parse_file(source_path("tests/data/every_key_of_a_part.json"));
  part["objective"] = "cost";
  part["stock"] = {{"kind", "bar"},
                   {"diameter_mm", 50},
                   {"length_mm", 300},
                   {"left_allowance_mm", 60},
                   {"part_off_allowance_mm", 1}};
  part["outer"] = {
      {{"id", "th1"}, {"kind", "thread"}, {"length_mm", 9}, {"designation", "M30x1.5"}},
      {{"id", "g1"}, {"kind", "groove"}, {"length_mm", 3}, {"diameter_mm", 25}},
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 30}, {"diameter_mm", 30}},
      {{"id", "a1"},
       {"kind", "arc"},
       {"length_mm", 9},
       {"left_mm", 30},
       {"right_mm", 40},
       {"radius_mm", 30},
       {"bulge", "concave"}},
      {{"id", "th2"},
       {"kind", "thread"},
       {"length_mm", 60},
       {"diameter_mm", 42},
       {"pitch_mm", 2},
       {"fit", "6g"}}};
  part["tolerances"] = part["faces"] = json::array();
  part["operations"] = "auto";
  try_all(SchemaCheck("part.json"), refused_part, part);
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAForging) {
  const auto part = json::parse(R"({
    "material": "test-steel",
    "stock": {"kind": "forging", "inner_mm": 10, "limits_mm": [-0.5, 1], "price": 3,
              "left_allowance_mm": 2,
              "outline": [{"length_mm": 32, "diameter_mm": 40},
                          {"length_mm": 22, "left_mm": 45, "right_mm": 44}]},
    "outer": [{"id": "d1", "kind": "cylinder", "length_mm": 31, "diameter_mm": 30},
              {"id": "d2", "kind": "cylinder", "length_mm": 20, "diameter_mm": 36}],
    "general": "ISO 2768-mK"})");
  try_all(SchemaCheck("part.json"), refused_part, part);
}

std::string refused_shop(const json& document) {
  Problems problems{.document = "t"};
  read_shop(Reader(document, problems), targets_of(test_catalogue()));
  return problems.list.empty() ? "" : problems.list[0].pointer;
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAShop) {
  const auto part = parse_file(source_path("tests/data/every_key_of_a_part.json"));
  try_all(SchemaCheck("shop.json"), refused_shop,
          {{"format", "turnwright-shop/1"},
           {"id", "own"},
           {"name", "Own"},
           {"tools", {"test-rougher"}},
           {"rules", part["rules"]}},
          50);
}

TEST(Schema, AgreesWithTheReadersOnEverySlipInTheCatalogue) {
  const auto example = [](const std::string& file) {
    return parse_file(source_path("tests/data/catalogue") / file);
  };
  const SchemaCheck material("material.json"), tool("tool.json"), lathe("lathe.json");
  try_all(material, refused_entry<catalogue::Material, read_material>,
          example("materials/test-steel.json"));
  try_all(tool, refused_entry<catalogue::Tool, read_tool>,
          example("tools/test-rougher.json"));
  const SchemaCheck fixed("fixed-tool.json");
  for (const auto& entry : fs::directory_iterator(source_path("tools/fixed"))) {
    auto tool_of_one_kind = parse_file(entry.path());
    for (const char* sizes : {"sizes_mm", "depths_mm"})
      if (tool_of_one_kind.contains(sizes)) tool_of_one_kind[sizes] = {3};
    if (tool_of_one_kind["use"] != "knurling") tool_of_one_kind["Fc_max_N"] = 3000;
    try_all(fixed, refused_entry<catalogue::FixedTool, read_fixed_tool>, tool_of_one_kind,
            50);
  }
  try_all(SchemaCheck("milling-cutter.json"),
          refused_entry<catalogue::MillingCutter, read_milling_cutter>,
          example("tools/milling/test-cutter.json"));
  try_all(lathe, refused_entry<catalogue::Lathe, read_lathe>,
          example("machines/lathe-medium.json"));
}

template <auto Door>
std::string refused_by(const json& document) {
  try {
    Door(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAChuckRequest) {
  const SchemaCheck schema("chuck.request.json");
  const auto text = parse_file(source_path("schemas/chuck.request.json"));
  auto request = text.at("examples").at(0);
  request["graph"] = text.at("examples").at(3).at("graph");
  try_all(schema, refused_by<chuck>, request);
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAMultipassRequest) {
  const SchemaCheck schema("multipass.request.json");
  const auto text = parse_file(source_path("schemas/multipass.request.json"));
  json every = {{"format", "turnwright-multipass/1"}, {"VrU", 110}};
  for (const auto& [key, value] : text["else"]["properties"].items())
    if (value.contains("default")) every[key] = value["default"];
  try_all(schema, refused_by<multipass>, every);
  try_all(schema, refused_by<multipass>, text["examples"][2], 50);
}

json calibrated(const json& document) {
  return calibrate_material(document, test_catalogue());
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInACalibration) {
  const SchemaCheck schema("calibrate-material.request.json");
  auto request = parse_file(source_path("schemas/calibrate-material.request.json"))
                     .at("examples")
                     .at(1);
  request["outlier_p"] = 0;
  request["name"] = "a name";
  try_all(schema, refused_by<calibrated>, request);
  request = parse_file(source_path("schemas/calibrate-material.request.json"))
                .at("examples")
                .at(3);
  try_all(schema, refused_by<calibrated>, request);
}

TEST(Schema, AgreesWithTheReaderOnEverySlipInAStabilityRequest) {
  const SchemaCheck schema("stability.request.json");
  const auto examples =
      parse_file(source_path("schemas/stability.request.json")).at("examples");
  const auto refused = refused_by<[](const json& q) {
    static const auto kCatalogue = load_catalogue(source_path(""));
    return stability(q, kCatalogue);
  }>;
  // What a table's columns are called, and in which unit, and what the lines of a file
  // say, they alone can tell.
  const auto of_the_table = [](const std::string& slip) {
    return slip.starts_with("/frf/0/columns") || slip.starts_with("/frf/0/csv/0 ") ||
           slip == "/frf/0/unit left out" || slip.starts_with("/frf/0/uff/text/");
  };
  for (const json& example : examples)
    EXPECT_GT(SlipsOf(schema, refused, example, of_the_table).try_all(), 40);
}

}  // namespace
}  // namespace turnwright::document::schema_test
