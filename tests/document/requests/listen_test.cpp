#include "turnwright/document/listen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "../slips.hpp"
#include "document/json/file.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/document/stability.hpp"

namespace turnwright::document::listen_test {
namespace {

using nlohmann::json;

// 0.22 s of 16 bits at 4 kHz: harmonics at 100 and 400 Hz, 730 Hz with an amplitude of 0.25.
const json& example(std::size_t i) {
  static const json kAll =
      parse_file(source_path("schemas/listen.request.json")).at("examples");
  return kAll.at(i);
}

const Catalogue& files() {
  static const Catalogue kAll = load_catalogue(source_path(""));
  return kAll;
}

json answered(const json& request) {
  static const SchemaCheck kRequest("listen.request.json"), kResult("listen.result.json");
  EXPECT_EQ(kRequest.fault(request), "") << request;
  json result = listen(request, files());
  EXPECT_EQ(kResult.fault(result), "") << result;
  return result;
}

std::string refused(const json& request) {
  return input_refusal([](const json& r) { listen(r, files()); }, request);
}

TEST(Listen, HearsChatterAndTellsSpeedsWithoutIt) {
  const json r = answered(example(0));
  EXPECT_NEAR(r["chatter"]["frequency_Hz"], 730, 0.7);
  EXPECT_NEAR(r["chatter"]["amplitude"], 0.25, 0.01);
  EXPECT_NEAR(r["n_rpm"], 6000, 6);
  EXPECT_EQ(r["taken"], (json{{"n_rpm", example(0)["n_rpm"]}, {"teeth", 4}}));
  EXPECT_EQ(r["harmonics"][0]["order"], 4);
  EXPECT_EQ(r["harmonics"][0]["of_teeth"], true);
  EXPECT_EQ(r["harmonics"][1]["order"], 1);
  EXPECT_EQ(r["harmonics"][1]["of_teeth"], false);
  EXPECT_NEAR(r["sound"]["seconds"], 0.22, 1e-12);
  // 1.825 vibrations from tooth to tooth; with one, 10,950/min.
  ASSERT_EQ(r["speeds"].size(), 3u);
  EXPECT_EQ(r["speeds"][0]["harmonic"], 2);
  EXPECT_NEAR(r["speeds"][0]["n_rpm"], 60 * 730 / 8.0, 6);
  json slow = example(0);
  slow["machine_rpm"]["to"] = 6000;
  EXPECT_EQ(answered(slow)["speeds"].size(), 2u);
}

TEST(Listen, WithoutTheLineThereIsNoChatter) {
  json q = example(0);
  q["from_Hz"] = 50;
  q["to_Hz"] = 700;
  const json r = answered(q);
  EXPECT_TRUE(r["chatter"].is_null());
  EXPECT_FALSE(r.contains("speeds"));
  EXPECT_EQ(r["to_Hz"], 700);
}

TEST(Listen, TheChartIsThatOfStability) {
  const json q = example(1), r = answered(q);
  const json chart = stability(q["stability"], files());
  EXPECT_EQ(r["stability"]["points"], chart["points"]);
  EXPECT_EQ(r["stability"]["best"], chart["best"]);
}

TEST(Listen, AllProblemsAtOnce) {
  json q = example(1);
  q["wav"] = "UklGRg==";
  q["n_rpm"] = 0;
  q["to_Hz"] = 20;
  q["stability"]["teeth"] = 0;
  q["machine_rpm"] = {{"from", 9000}, {"to", 1000}};
  EXPECT_EQ(refused(q),
            R"(listen: /wav: got byte 0: no RIFF header of WAVE, expected a .wav file
listen: /n_rpm: got 0, expected a number from 1 to 1000000 1/min
listen: /to_Hz: got 20, expected a frequency above from_Hz
listen: /machine_rpm/to: got 1000, expected a speed not below from
listen: /stability/teeth: got 0, expected a whole number from 1 to 100)");
  q = example(0);
  q["channel"] = 2;
  EXPECT_EQ(refused(q),
            "listen: /channel: got 2, expected 1, as the sound has one channel");
  q["wav"] = "no base64!";
  EXPECT_EQ(refused(q),
            "listen: /wav: got \"no base64!\", expected base64 (RFC 4648) of the sound's "
            "bytes");
}

TEST(Listen, ASoundOfFewTurnsIsBeyondTheModel) {
  json q = example(0);
  q["n_rpm"] = 3000;  // 11 revolutions
  EXPECT_THROW(listen(q, files()), ModelRangeError);
}

TEST(Listen, LeavesWhenNobodyWaits) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(listen(example(0), files(), stop.get_token()), Cancelled);
}

TEST(Listen, BytesComeBackFromBase64) {
  EXPECT_EQ(sound_base64("RIFF"), "UklGRg==");
  EXPECT_EQ(sound_base64(""), "");
}

TEST(Listen, SchemaAgreesWithTheReaderOnEverySlip) {
  const SchemaCheck schema("listen.request.json");
  const auto of_the_file = [](const std::string& slip) {
    return slip.starts_with("/stability");  // its own schema and test
  };
  EXPECT_GT(SlipsOf(schema, refused, example(0), of_the_file).try_all(), 15);
}

}  // namespace
}  // namespace turnwright::document::listen_test
