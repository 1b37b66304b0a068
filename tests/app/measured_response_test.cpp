// Measurements as files of their own, beside a request of `stability`.
#include <gtest/gtest.h>

#include <cmath>
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

TEST_F(CommandLine, SpeedAndTeethOfASoundNeedNoDocument) {
  // 0.25 s of 16 bits at 4 kHz: 100 Hz, the spindle's.
  std::string wav = "RIFF", samples;
  for (int i = 0; i < 1000; ++i) {
    const int x = static_cast<int>(9000 * std::sin(2 * M_PI * i / 40));
    samples += static_cast<char>(x & 0xFF);
    samples += static_cast<char>(x >> 8 & 0xFF);
  }
  const auto number = [](unsigned x, int bytes) {
    std::string out;
    for (; bytes > 0; --bytes, x >>= 8) out += static_cast<char>(x & 0xFF);
    return out;
  };
  wav += number(36 + 2000, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) + number(1, 2) +
         number(4000, 4) + number(8000, 4) + number(2, 2) + number(16, 2) + "data" +
         number(2000, 4) + samples;
  put(folder_ / "cut.wav", wav);
  const std::string command = "turnwright listen --wav cut.wav --speed 6010 --teeth 3";
  const auto told = shell(command + " --json");
  ASSERT_EQ(told.code, 0) << told.err;
  const auto result = nlohmann::json::parse(told.out);
  EXPECT_EQ(result["taken"], (nlohmann::json{{"n_rpm", 6010}, {"teeth", 3}}));
  EXPECT_NEAR(result["n_rpm"], 6000, 6);
  EXPECT_NE(shell(command).out.find("Taken: 6010 1/min, teeth 3; by the harmonics"),
            std::string::npos);
  const auto nothing = shell("turnwright listen --wav cut.wav");
  EXPECT_EQ(nothing.code, 2);
  EXPECT_NE(nothing.err.find("--wav with a sound and --speed"), std::string::npos);
  EXPECT_EQ(shell("turnwright listen --wav cut.wav --speed 0").code, 2);
}

}  // namespace
}  // namespace turnwright::app
