#include "document/response/wav_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "turnwright/base/random.hpp"

namespace turnwright::document::wav_file_test {
namespace {

std::string little(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
  return out;
}

std::string chunk(const std::string& name, const std::string& body) {
  return name + little(static_cast<std::uint32_t>(body.size()), 4) + body +
         std::string(body.size() % 2, '\0');
}

std::string format(std::uint32_t kind, std::uint32_t channels, std::uint32_t bits,
                   std::uint32_t rate = 8000) {
  return little(kind, 2) + little(channels, 2) + little(rate, 4) +
         little(rate * channels * bits / 8, 4) + little(channels * bits / 8, 2) +
         little(bits, 2);
}

std::string file(const std::string& chunks) {
  return "RIFF" + little(static_cast<std::uint32_t>(chunks.size()) + 4, 4) + "WAVE" +
         chunks;
}

std::string wav(std::uint32_t kind, std::uint32_t channels, std::uint32_t bits,
                const std::string& data) {
  return file(chunk("fmt ", format(kind, channels, bits)) + chunk("data", data));
}

/// What is wrong with a file; "" if it is read.
std::string fault(const std::string& bytes, WavFile* out = nullptr) {
  const nlohmann::json given = "";
  Problems problems{.document = "test"};
  const Reader at(given, problems, "/wav");
  WavFile read = read_wav(at, bytes);
  if (out) *out = std::move(read);
  if (problems.list.empty()) return "";
  EXPECT_EQ(problems.list[0].pointer, "/wav");
  EXPECT_TRUE(!out || out->channels.empty());
  return problems.list[0].got + " | " + problems.list[0].expected;
}

WavFile read(const std::string& bytes) {
  WavFile out;
  EXPECT_EQ(fault(bytes, &out), "");
  return out;
}

TEST(WavFile, WholeNumbersAreSharesOfFullScale) {
  const auto half = read(wav(1, 1, 16, little(0x4000, 2) + little(0x8000, 2)));
  EXPECT_EQ(half.rate_Hz, 8000);
  EXPECT_EQ(half.bits, 16);
  EXPECT_EQ(half.channels, (std::vector<std::vector<double>>{{0.5, -1}}));
  EXPECT_EQ(read(wav(1, 1, 8, std::string("\x00\x80\xc0", 3))).channels[0],
            (std::vector{-1.0, 0.0, 0.5}));
  EXPECT_EQ(read(wav(1, 1, 24, little(0xe00000, 3))).channels[0][0], -0.25);
  EXPECT_EQ(read(wav(1, 1, 32, little(0x20000000, 4))).channels[0][0], 0.25);
}

TEST(WavFile, FloatingPointAndTwoChannels) {
  const auto bits = [](float x) { return little(std::bit_cast<std::uint32_t>(x), 4); };
  const auto both = read(wav(3, 2, 32, bits(0.125F) + bits(-2) + bits(0.25F) + bits(1)));
  EXPECT_TRUE(both.floating);
  EXPECT_EQ(both.channels, (std::vector<std::vector<double>>{{0.125, 0.25}, {-2, 1}}));
  const auto twice = [](double x) { return little(std::bit_cast<std::uint64_t>(x), 8); };
  EXPECT_EQ(read(wav(3, 1, 64, twice(0.1) + twice(-3))).channels[0],
            (std::vector{0.1, -3.0}));
  EXPECT_EQ(fault(wav(3, 1, 64, twice(1e300))),
            "byte 44: a sample that is no number, or beyond single precision | numbers");
  EXPECT_EQ(fault(wav(3, 1, 32, bits(std::numeric_limits<float>::infinity()))),
            "byte 44: a sample that is no number, or beyond single precision | numbers");
}

TEST(WavFile, OtherChunksArePassedOverAndExtensibleIsRead) {
  const std::string extended = format(0xfffe, 1, 16) + little(22, 2) + little(16, 2) +
                               little(4, 4) + little(1, 2) + std::string(14, 'x');
  const auto sound = read(file(chunk("LIST", "odd") + chunk("fmt ", extended) +
                               chunk("fact", "1234") + chunk("data", little(0x2000, 2))));
  EXPECT_EQ(sound.channels[0], (std::vector<double>{0.25}));
}

TEST(WavFile, DataOfUnknownLengthEndWithTheFile) {
  std::string piped = wav(1, 2, 16, little(0x4000c000, 4) + "cut");
  piped.resize(piped.size() - 1);  // the byte that makes the chunk even
  for (const std::uint64_t stated : {0xffffffffU, 0x80000000U, 0x7ffff000U}) {
    piped.replace(40, 4, little(stated, 4));
    EXPECT_EQ(read(piped).channels, (std::vector<std::vector<double>>{{-0.5}, {0.5}}));
  }
}

TEST(WavFile, MalformedFilesAreToldWithTheirByte) {
  const std::string good = wav(1, 1, 16, "ab");
  EXPECT_EQ(fault(""), "byte 0: no RIFF header of WAVE | a .wav file");
  EXPECT_EQ(fault("RIFX" + good.substr(4)),
            "byte 0: no RIFF header of WAVE | a .wav file");
  EXPECT_EQ(fault(good.substr(0, 36)), "byte 36: no chunk \"data\" | samples");
  EXPECT_EQ(fault(good.substr(0, 40)),
            "byte 36: the begin of a chunk | its name and length");
  EXPECT_EQ(
      fault(good.substr(0, 45)),
      "byte 36: a chunk of 2 bytes, 1 of them in the file | a file that is not cut off");
  EXPECT_EQ(fault(file(chunk("data", "ab"))),
            "byte 12: data before fmt | fmt before data");
  EXPECT_EQ(fault(file(chunk("fmt ", "short"))),
            "byte 20: a fmt of 5 bytes | 16 bytes or more");
  const std::string known =
      " | PCM of 8, 16, 24 or 32 bits, or floating point of 32 or 64";
  EXPECT_EQ(fault(wav(1, 1, 12, "ab")), "byte 20: format 1 of 12 bits" + known);
  EXPECT_EQ(fault(wav(3, 1, 16, "ab")), "byte 20: format 3 of 16 bits" + known);
  EXPECT_EQ(fault(wav(6, 1, 16, "ab")), "byte 20: format 6 of 16 bits" + known);
  EXPECT_EQ(fault(wav(1, 3, 16, "abcdef")), "byte 22: 3 channels | one or two");
  EXPECT_EQ(fault(file(chunk("fmt ", format(1, 1, 16, 7)))),
            "byte 24: 7 samples a second | 1000 to 400000");
  EXPECT_EQ(fault(wav(1, 2, 16, "ab")), "byte 44: 2 bytes of samples | a multiple of 4");
  std::string frame = good;
  frame[32] = 3;
  EXPECT_EQ(fault(frame), "byte 32: 3 bytes a sample of all channels | 2");
}

// Nothing but answers and refusals; never a read beyond the end (with the sanitizers).
TEST(WavFile, DamagedFilesAreReadOrRefused) {
  const std::string good = wav(1, 2, 16, std::string(64, 'x'));
  for (std::uint64_t k = 0; k < 3000; k += 3) {
    std::string bytes = good;
    bytes[splitmix64(5, k) % bytes.size()] = static_cast<char>(splitmix64(5, k + 1));
    bytes = bytes.substr(0, bytes.size() - splitmix64(5, k + 2) % 8);
    WavFile out;
    const auto told = fault(bytes, &out);
    EXPECT_EQ(told.empty(), !out.channels.empty()) << told;
  }
}

}  // namespace
}  // namespace turnwright::document::wav_file_test
