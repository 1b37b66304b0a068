#include <gtest/gtest.h>

#include "../words.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::quote_text_test {
namespace {

using nlohmann::ordered_json;

// Keys as in schemas/quote.result.json.
ordered_json quoted() {
  return ordered_json::parse(R"({"status": "ok", "currency": "EUR", "parts": [
    {"name": "Pin", "status": "ok",
     "prices": [{"batch": 10, "price": 5.39485, "made_by": "lathe-small", "stock": 0.72727,
                 "run": 1.09477, "setting_up": 2.4, "scrap": 0, "overhead": 0.63331,
                 "margin": 0.53949, "time_min": 4.2, "lower_bound": 4.222, "gap": 1e-6}],
     "ways": [{"made_by": "lathe-small", "proved": false, "stock_kg": 0.634,
               "conforming": 0.9973, "energy": {"kWh": 0.048, "kg_CO2": 0.018}}],
     "alternatives": [{"name": "lathe-small", "feasible": true},
                      {"name": "lathe-heavy", "feasible": false,
                       "why": "the chuck holds 40 to 500 mm, not 32 mm"}]},
    {"name": "Tube", "status": "infeasible", "prices": [], "ways": [],
     "alternatives": [{"name": "", "feasible": false, "why": "d1 chatters"}]}]})");
}

TEST(QuoteText, HasAPriceForEachBatchAndSaysWhatCannotBeMade) {
  const auto text = flat(quote_text(quoted()));
  EXPECT_TRUE(has(text, "prices of one part in EUR\n"));
  EXPECT_TRUE(has(text,
                  "\n 10 5.39 0.727 1.09 2.40 0.00 0.633 0.539 4 min 12 s "
                  "lathe-small\n"))
      << text;
  EXPECT_TRUE(has(text, "lathe-small: 0.634 kg of stock, 0.048 kWh and 0.018 kg of CO2"));
  EXPECT_TRUE(has(text, "at least 99.73 %"));
  EXPECT_TRUE(has(text, "not proved to be the"));
  EXPECT_TRUE(has(text, "\n lathe-heavy: the chuck holds 40 to 500 mm, not 32 mm\n"));
  EXPECT_TRUE(has(text, "\nTube\n no way to make it was found\n d1 chatters\n"));
}

TEST(QuoteText, WithoutAChoiceNoWayIsNamed) {
  auto result = quoted();
  result["parts"][0]["prices"][0].erase("made_by");
  EXPECT_FALSE(has(flat(quote_text(result)), "made by"));
}

}  // namespace
}  // namespace turnwright::report::quote_text_test
