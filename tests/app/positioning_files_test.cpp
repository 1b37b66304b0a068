// Tables of a laser and compensation files of LinuxCNC, beside a request of `positioning`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

/// `positioning` with a request on standard input.
std::string positioning_with(const std::string& request, const std::string& options) {
  return "turnwright positioning - " + options + " <<'END'\n" + request + "\nEND";
}

TEST_F(CommandLine, WritesACompensationFileByATable) {
  put(folder_ / "laser.csv", "q_mm,plus,minus\n0,0,4\n57,2,6\n0,0.2,4.2\n57,2.4,6.4\n");
  const auto run = shell(positioning_with(R"({"axis": "X", "readings": {"unit": "um"}})",
                                          "--csv laser.csv --write-comp-file x.comp"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("2 rows in mm, COMP_FILE_TYPE = 0"), std::string::npos);
  EXPECT_EQ(contents(folder_ / "x.comp"),
            "0.000000 0.000100 0.004100\n57.000000 57.002200 57.006200\n");
  // What the request asks of the file counts; the file comes back as it was.
  const auto back =
      shell(positioning_with(R"({"axis": "X", "write_comp_file": {"type": 1}})",
                             "--comp-file x.comp --write-comp-file trims.comp --json"));
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(contents(folder_ / "trims.comp"),
            "0.000000 -0.000100 -0.004100\n57.000000 -0.002200 -0.006200\n");
  EXPECT_NEAR(nlohmann::json::parse(back.out)["iso230_2"]["B_um"].get<double>(), 4, 1e-9);
}

TEST_F(CommandLine, RefusesFilesOfPositioningByTheirPlace) {
  put(folder_ / "x.comp", "0 0 0\n1 2\n");
  const std::string axis = R"({"axis": "X"})";
  const auto run = shell(positioning_with(axis, "--comp-file x.comp"));
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("/comp_file/text#line 2: got \"1 2\""), std::string::npos)
      << run.err;
  EXPECT_EQ(shell(positioning_with(axis, "--comp-file none.comp")).code, 2);
  put(folder_ / "laser.csv", "q_mm,plus,minus\n0,0,\377\n");
  EXPECT_EQ(shell(positioning_with(axis, "--csv laser.csv")).code, 2);
  const auto same =
      shell(positioning_with(axis, "--comp-file x.comp --write-comp-file a --output a"));
  EXPECT_EQ(same.code, 2);
  EXPECT_NE(same.err.find("--write-comp-file"), std::string::npos) << same.err;
  EXPECT_FALSE(fs::exists(folder_ / "a"));
}

}  // namespace
}  // namespace turnwright::app
