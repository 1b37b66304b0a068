// Measurements as files of their own, beside a request of `stability`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

const std::string kData = TURNWRIGHT_SOURCE_DIR "/tests/data/uff/";

/// `stability` with a request of turning on standard input.
std::string with_files(const std::string& more, const std::string& files) {
  return "turnwright stability - " + files +
         R"( --json <<'END'
{"model": "turning", "kappa_deg": 75, "kp_MPa": 900, "ap_max_mm": 1, "speeds_rpm": [800])" +
         more + "}\nEND";
}

TEST_F(CommandLine, TakesAMeasuredResponseAsAFile) {
  const auto run =
      shell(with_files("", "--frf " + kData + "accelerance-even-double.uff"));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto modes = nlohmann::json::parse(run.out)["frf"][0]["modes"];
  EXPECT_NEAR(modes[0]["frequency_Hz"], 640, 1e-6);
}

TEST_F(CommandLine, FillsTheEntryThatHasNoData) {
  const auto run = shell(with_files(R"(, "frf": [{"modes": 1, "to_Hz": 700}])",
                                    "--frf " + kData + "accelerance-even-double.uff"));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["frf"][0]["modes"].size(), 1U);
}

TEST_F(CommandLine, TakesABinaryMeasurement) {
  const auto run = shell(with_files("", "--frf " + kData + "binary-58b.uff"));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto modes = nlohmann::json::parse(run.out)["frf"][0]["modes"];
  EXPECT_NEAR(modes[1]["stiffness_N_mm"], 16000, 1e-3);
  EXPECT_EQ(
      shell(with_files(R"(, "frf": [{"taps": 3}])", "--frf " + kData + "README.md")).code,
      2);
}

TEST_F(CommandLine, TakesASoundAsAFile) {
  put(folder_ / "no.wav", "RIFF");
  const auto run =
      shell("turnwright listen - --wav no.wav <<'END'\n{\"n_rpm\": 6000}\nEND");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("byte 0: no RIFF header of WAVE"), std::string::npos) << run.err;
  EXPECT_EQ(
      shell("turnwright listen - --wav none.wav <<'END'\n{\"n_rpm\": 6000}\nEND").code,
      2);
}

}  // namespace
}  // namespace turnwright::app
