// Knurled cylinders, whose blank is turned lower than they are drawn.
#include <gtest/gtest.h>

#include <algorithm>

#include "refusal.hpp"
#include "turnwright/document/part_plan.hpp"

namespace turnwright::document::knurl_test {
namespace {

using nlohmann::json;

// A grip of 30 mm before a collar, and a pin behind it.
json knob(const char* knurl = "RGE1.2") {
  const auto cylinder = [](const char* id, double length, double d) {
    return json{
        {"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
  };
  auto grip = cylinder("grip", 20, 30);
  grip["knurl"] = knurl;
  return {{"material", "test-steel"},
          {"stock", {{"kind", "bar"}, {"diameter_mm", 45}, {"length_mm", 85}}},
          {"outer", {cylinder("collar", 30, 40), grip, cylinder("pin", 30, 20)}}};
}

LoadedPart read(const json& document) {
  return load_part_plan(document, test_catalogue(), "t");
}
bool tells(const LoadedPart& loaded, const std::string& pointer, const char* why) {
  return std::ranges::any_of(loaded.assumed, [&](const Assumption& a) {
    return a.pointer == pointer && a.why.find(why) != std::string::npos;
  });
}

TEST(Knurls, AreTurnedLowerThanTheyAreDrawn) {
  auto d = knob();
  d["outer"][1]["fit"] = "h11";
  d["outer"][1]["Ra_um"] = 1.6;
  const auto loaded = read(d);
  const auto& e = loaded.plan.drawing.outer.at(1);
  ASSERT_TRUE(part::is_knurled(e));
  EXPECT_NEAR(e.left_mm, 30 - 0.8, 1e-12);
  EXPECT_EQ(e.cut->drawn.left_mm, 30);
  EXPECT_NEAR(part::raised_mm(e), 0.4, 1e-12);
  EXPECT_FALSE(e.fit || e.limits || e.Ra_um);
  EXPECT_TRUE(tells(loaded, "/outer/1/diameter_mm", "raises it to the 30 mm"));
  EXPECT_TRUE(tells(loaded, "/outer/1/fit", "not predicted"));
  EXPECT_TRUE(tells(loaded, "/outer/1/Ra_um", "not predicted"));
}

// As drawn it takes 1.5 mm of the radius of 15 mm; the blank is 0.4 mm lower.
TEST(Knurls, HaveTheirChamfersAsDrawn) {
  auto d = knob();
  d["edges"] = {{{"at", "grip|pin"}, {"chamfer_mm", 1.5}}};
  const auto e = read(d).plan.drawing.outer.at(1);
  ASSERT_TRUE(e.right_chamfer);
  EXPECT_NEAR(e.right_chamfer->radial_mm, 1.1, 1e-12);
  EXPECT_NEAR(e.right_chamfer->axial_mm, 1.1, 1e-12);
  d["edges"][0]["chamfer_mm"] = 0.4;
  EXPECT_EQ(
      refusal_of(d),
      "t: /edges/0/chamfer_mm: got 0.4, expected a chamfer that takes more than 0.4 "
      "mm of the radius: so much lower grip is turned before it is knurled");
}

TEST(Knurls, OfOtherSizesAndPlacesAreRefused) {
  for (const char* wrong : {"RAA0.7", "RAB0.8", "diamond"})
    EXPECT_EQ(refusal_of(knob(wrong)),
              "t: /outer/1/knurl: got \"" + std::string(wrong) +
                  "\", expected a knurl of DIN 82, RAA, RBL, RBR, RGE, RGV, RKE or RKV "
                  "with a pitch of 0.5, 0.6, 0.8, 1, 1.2 or 1.6 mm, like \"RAA0.8\"");
  auto ground = knob();
  ground["outer"][1]["grinding_allowance_mm"] = 0.3;
  EXPECT_NE(refusal_of(ground).find("knurl or grinding_allowance_mm, not both"),
            std::string::npos);
  auto thin = knob("RAA1.6");
  thin["outer"][1]["diameter_mm"] = 4;
  EXPECT_NE(refusal_of(thin).find("a pitch of at most a third of the diameter"),
            std::string::npos);
  auto cone = knob();
  cone["outer"][1] = {{"id", "grip"},  {"kind", "cone"}, {"length_mm", 20},
                      {"left_mm", 30}, {"right_mm", 28}, {"knurl", "RAA1"}};
  EXPECT_NE(refusal_of(cone).find("/outer/1/knurl"), std::string::npos);
  auto undercut = knob();
  undercut["edges"] = {{{"at", "collar|grip"}, {"undercut", "E0.8x0.3"}}};
  EXPECT_NE(refusal_of(undercut).find("/edges/0/at"), std::string::npos);
  auto run_out = knob();
  run_out["tolerances"] = {{{"id", "t"},
                            {"kind", "total-radial-runout"},
                            {"of", "grip"},
                            {"datum", "pin"},
                            {"value_mm", 0.05}}};
  EXPECT_NE(refusal_of(run_out).find("/tolerances/0/of"), std::string::npos);
}

}  // namespace
}  // namespace turnwright::document::knurl_test
