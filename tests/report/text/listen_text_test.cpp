#include <gtest/gtest.h>

#include <string>

#include "report/text/text.hpp"

namespace turnwright::report::listen_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/listen.result.json.
TEST(ListenText, TellsChatterAndSpeedsWithoutIt) {
  const auto result = ordered_json::parse(R"({
    "from_Hz": 50, "to_Hz": 1800,
    "chatter": {"frequency_Hz": 730.04, "amplitude": 0.25, "over_noise_dB": 41.2},
    "speeds": [{"n_rpm": 5475.3, "harmonic": 2}],
    "others": [{"frequency_Hz": 730.04, "amplitude": 0.25, "over_noise_dB": 41.2}],
    "harmonics": [{"frequency_Hz": 400, "amplitude": 0.3, "over_noise_dB": 43, "order": 4,
                   "of_teeth": true},
                  {"frequency_Hz": 100, "amplitude": 0.05, "over_noise_dB": 30, "order": 1,
                   "of_teeth": false}],
    "stability": {"points": [{"n_rpm": 6000, "ap_mm": 2, "stable": true, "limit_mm": 3,
                              "margin_mm": 1}]}})");
  const auto text = listen_text(result);
  for (const char* what :
       {"It chatters at 730.0 Hz, 41 dB over the noise.", "5475 1/min (2 a",
        "6000 1/min, 2 mm: stable, margin 1 mm", "no harmonic",
        "teeth, 4 times the spindle", "run-out, 1 times the spindle"})
    EXPECT_NE(text.find(what), std::string::npos) << what << '\n' << text;
}

TEST(ListenText, TellsThatNoChatterIsHeard) {
  const auto text = listen_text({{"from_Hz", 50}, {"to_Hz", 1800}, {"chatter", nullptr}});
  EXPECT_NE(text.find("No chatter is heard from 50 to 1800 Hz."), std::string::npos)
      << text;
}

}  // namespace
}  // namespace turnwright::report::listen_text_test
