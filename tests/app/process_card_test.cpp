#include <gtest/gtest.h>
#include <zip.h>

#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

// A file of a zip archive.
std::string unzipped(const fs::path& archive, const char* name) {
  auto* zip = zip_open(archive.c_str(), ZIP_RDONLY, nullptr);
  if (!zip) return {};
  std::string text;
  zip_stat_t about;
  if (zip_stat(zip, name, 0, &about) == 0) {
    text.resize(about.size);
    auto* file = zip_fopen(zip, name, 0);
    const auto read = zip_fread(file, text.data(), text.size());
    EXPECT_EQ(read, static_cast<zip_int64_t>(text.size()));
    zip_fclose(file);
  }
  zip_close(zip);
  return text;
}

// The cells of a workbook's sheet by their places, "A1".
std::map<std::string, std::string> cells(const fs::path& book, int sheet) {
  pugi::xml_document shared, rows;
  EXPECT_TRUE(shared.load_string(unzipped(book, "xl/sharedStrings.xml").c_str()));
  const auto name = "xl/worksheets/sheet" + std::to_string(sheet) + ".xml";
  EXPECT_TRUE(rows.load_string(unzipped(book, name.c_str()).c_str()));
  std::vector<std::string> texts;
  for (const auto si : shared.child("sst").children("si"))
    texts.emplace_back(si.child_value("t"));
  std::map<std::string, std::string> all;
  for (const auto row : rows.child("worksheet").child("sheetData").children("row"))
    for (const auto c : row.children("c")) {
      const std::string value = c.child_value("v");
      const bool text = std::string(c.attribute("t").value()) == "s";
      all[c.attribute("r").value()] = text ? texts.at(std::stoul(value)) : value;
    }
  return all;
}

class ProcessCard : public CommandLine {
 protected:
  // The example's quote, of a part whose name a spreadsheet would take for a formula.
  nlohmann::json quote() const {
    auto request = nlohmann::json::parse(row("quote").example);
    request["parts"][0]["name"] = "=1+1";
    return request;
  }
};

TEST_F(ProcessCard, HasTheNumbersOfTheQuoteInItsCells) {
  put(folder_ / "quote.json", quote().dump());
  const auto run = shell("turnwright quote quote.json --xlsx card.xlsx --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto result = nlohmann::json::parse(run.out);
  const auto book = folder_ / "card.xlsx";
  const auto prices = cells(book, 1), routing = cells(book, 2), ways = cells(book, 3);
  EXPECT_EQ(prices.at("D1"), "Price");
  const auto& told = result["parts"][0]["prices"];
  ASSERT_EQ(told.size(), 4u);
  for (std::size_t i = 0; i < told.size(); ++i) {
    const auto line = std::to_string(i + 2);
    EXPECT_EQ(prices.at("A" + line), "=1+1");  // a text, as no formula is in the sheet
    EXPECT_EQ(std::stoi(prices.at("C" + line)), told[i]["batch"]);
    EXPECT_NEAR(std::stod(prices.at("D" + line)), told[i]["price"], 1e-9);
    EXPECT_NEAR(std::stod(prices.at("L" + line)), told[i]["lower_bound"], 1e-9);
  }
  EXPECT_EQ(prices.count("A6"), 0u);
  for (std::size_t i = 0; i < result["routing"].size(); ++i)
    EXPECT_NEAR(std::stod(routing.at("G" + std::to_string(i + 2))),
                result["routing"][i]["run_min"], 1e-9);
  EXPECT_NEAR(std::stod(ways.at("F2")), result["parts"][0]["ways"][0]["energy"]["kWh"],
              1e-9);
  EXPECT_EQ(unzipped(book, "xl/worksheets/sheet1.xml").find("<f>"), std::string::npos);
  EXPECT_NE(unzipped(book, "docProps/core.xml").find("prices in EUR"), std::string::npos);
}

TEST_F(ProcessCard, IsTheSameFileOfTheSameQuote) {
  put(folder_ / "quote.json", quote().dump());
  const std::string again =
      "turnwright quote quote.json --xlsx a.xlsx && sleep 2.1 && "
      "turnwright quote quote.json --xlsx b.xlsx";
  ASSERT_EQ(shell(again).code, 0);
  EXPECT_FALSE(contents(folder_ / "a.xlsx").empty());
  EXPECT_EQ(contents(folder_ / "a.xlsx"), contents(folder_ / "b.xlsx"));
  EXPECT_EQ(files(), (std::vector<std::string>{"a.xlsx", "b.xlsx", "quote.json"}));
}

TEST_F(ProcessCard, WantsAPlaceOfItsOwn) {
  put(folder_ / "quote.json", quote().dump());
  const auto run = shell("turnwright quote quote.json --xlsx card -o card");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("another place than that of --output"), std::string::npos)
      << run.err;
  const auto nowhere = shell("turnwright quote quote.json --xlsx none/card.xlsx");
  EXPECT_EQ(nowhere.code, 74);
}

}  // namespace
}  // namespace turnwright::app
