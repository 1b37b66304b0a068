#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTable =
    "id;insert;holder;RE;KAPR;H;B;LF;LH;WF\n"
    "R1;CNMG 120408;DCLNL 2525M 12;0,8;95;25;25;150;32;32\n"
    "F1;DNMG 150604;;0,4;93;;;;;\n"
    "X1;;;;;;;;;\n";

class ImportTools : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    put(folder_ / "crib.csv", kTable);
  }
  static nlohmann::json json_of(const fs::path& file) {
    std::ifstream in(file);
    return nlohmann::json::parse(in);
  }
};

TEST_F(ImportTools, PrintsTheDocumentsAndWhatWasAssumed) {
  const auto run = shell("turnwright import-tools crib.csv --groups P,K");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result["format"], "turnwright-import-tools-result/1");
  EXPECT_EQ(result["tools"].size(), 2u);
  EXPECT_EQ(result["tools"][1]["groups"], nlohmann::json({"P", "K"}));
  EXPECT_EQ(shell("turnwright import-tools - --groups PK < crib.csv -o -").out, run.out);
  EXPECT_EQ(shell("turnwright import-tools crib.csv --groups PK -o r.json").out, "");
  EXPECT_EQ(json_of(folder_ / "r.json"), result);
  const auto both =
      shell("turnwright import-tools crib.csv --groups PK --out shop --json");
  EXPECT_EQ(both.out, run.out);
  EXPECT_EQ(both.err, "");
  EXPECT_TRUE(fs::exists(folder_ / "shop/tools/R1.json"));
}

// A library of FreeCAD and its bits are files of their own.
TEST_F(ImportTools, TakesALibraryWithItsBits) {
  const auto bit = fs::path(TURNWRIGHT_SOURCE_DIR) / "tests/data/tools/rhombus.fctb";
  put(folder_ / "lathe.fctl",
      R"({"tools": [{"nr": 7, "path": "rhombus.fctb"}, {"nr": 8, "path": "gone.fctb"}]})");
  const auto run = shell("turnwright import-tools lathe.fctl " + bit.string());
  EXPECT_EQ(run.code, 0) << run.err;
  const auto result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result["tools"].size(), 1u);
  EXPECT_EQ(result["ignored"][0]["at"][0], "T8 gone.fctb");
  EXPECT_EQ(shell("turnwright import-tools lathe.fctl").code, 2);
  const auto twice = shell("turnwright import-tools lathe.fctl lathe.fctl");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("a file of another name"), std::string::npos) << twice.err;
}

TEST_F(ImportTools, AToolWrittenToADataFolderIsInItsCatalogue) {
  const auto source = fs::path(TURNWRIGHT_SOURCE_DIR);
  fs::create_directory(folder_ / "shop");
  for (const char* part : {"materials", "machines"})
    fs::create_directory_symlink(source / part, folder_ / "shop" / part);
  const auto run = shell("turnwright import-tools crib.csv --out shop");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "shop/tools/R1.json\nshop/tools/F1.json\n");
  EXPECT_NE(run.err.find("assumed: R1/life and 1 more: The life is not said"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("ignored: line 4: Its insert is not said"), std::string::npos);
  EXPECT_EQ(shell("turnwright list tools --data shop").out.rfind("F1  ", 0), 0u);
  const auto plan = shell(
      "echo 'd32 x 30; d25 h8 x 50 Ra1.6' | turnwright import - --material C45 --quiet | "
      "turnwright plan - --data shop --json");
  ASSERT_EQ(plan.code, 0) << plan.err;
  EXPECT_EQ(nlohmann::json::parse(plan.out)["status"], "ok");
}

TEST_F(ImportTools, TapsStandAmongTheToolsOfFixedOperations) {
  put(folder_ / "taps.csv", "id;type;TDZ\nT10;tap;M10\n");
  const auto run = shell("turnwright import-tools taps.csv --out shop");
  EXPECT_EQ(run.out, "shop/tools/fixed/T10.json\n") << run.err;
  EXPECT_EQ(json_of(folder_ / "shop/tools/fixed/T10.json")["threads"][0], "M10");
  EXPECT_EQ(shell("turnwright import-tools taps.csv --out shop").code, 2);
}

TEST_F(ImportTools, FilesThatAreThereStayUnlessForced) {
  fs::create_directories(folder_ / "shop/tools");
  put(folder_ / "shop/tools/F1.json", "mine");
  const auto run = shell("turnwright import-tools crib.csv --out shop");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(
      run.err,
      "command line: --out: got shop/tools/F1.json, which exists, expected a folder "
      "without it, or --force to replace it\n");
  EXPECT_FALSE(fs::exists(folder_ / "shop/tools/R1.json"));
  EXPECT_EQ(shell("turnwright import-tools crib.csv --out shop --force").code, 0);
  EXPECT_EQ(json_of(folder_ / "shop/tools/F1.json")["insert"], "DNMG 150604");
}

TEST_F(ImportTools, NamesTheFileOrTheOptionThatIsWrong) {
  put(folder_ / "wrong.csv", "insert;RE\nCNMG 120408\n");
  const auto wrong = shell("turnwright import-tools wrong.csv --out shop");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.err.rfind("wrong.csv: document: got #line 2: 1 cells", 0), 0u)
      << wrong.err;
  EXPECT_FALSE(fs::exists(folder_ / "shop"));
  EXPECT_EQ(shell("turnwright import-tools crib.csv --unit ell")
                .err.rfind("command line: --unit: got \"ell\"", 0),
            0u);
  EXPECT_EQ(shell("turnwright import-tools crib.csv --groups X")
                .err.rfind("command line: --groups/0: got \"X\"", 0),
            0u);
  EXPECT_EQ(shell("turnwright import-tools none.tools").code, 2);
  EXPECT_EQ(
      shell("turnwright import-tools /dev/zero").err,
      "/dev/zero: document: got more than 20000000 bytes, expected a tool library of "
      "at most so many\n");
}

TEST_F(ImportTools, TakesARequestAsOtherCommandsDo) {
  put(folder_ / "request.json", R"({"text": "insert\nCNMG 120408\n", "groups": ["H"]})");
  const auto run = shell("turnwright import-tools request.json");
  EXPECT_EQ(nlohmann::json::parse(run.out)["tools"][0]["groups"], nlohmann::json({"H"}))
      << run.err;
}

}  // namespace
}  // namespace turnwright::app
