#include "report/picture/milled_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "report/page/html.hpp"
#include "report/text/text.hpp"

namespace turnwright::report::milled_drawing_test {
namespace {

using nlohmann::ordered_json;

planning::OperationPlan keyway() {
  planning::OperationPlan o;
  o.id = "s2-mill-k1";
  o.kind = planning::OperationKind::mill;
  o.on = {"k1"};
  o.passes.resize(3);
  for (auto& p : o.passes) p = {.ap_mm = 1.25, .n_rpm = 4321};
  planning::MilledCut cut;
  cut.depth_margin = 0.2;
  cut.speed_margin = 0.02;
  cut.shown_mm = 3;
  cut.n_rpm = {2000, 4000, 6000};
  cut.limits_mm = {1.5, std::nullopt, 2.25};
  o.milled = cut;
  return o;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(MilledDrawing, ShowsLimitMarginsAndTheChosenPass) {
  const auto svg = milled_drawing(keyway());
  EXPECT_NE(svg.find("s2-mill-k1: stable depth over speed"), std::string::npos);
  EXPECT_NE(svg.find("4321/min, 1.25 mm"), std::string::npos);
  EXPECT_NE(svg.find("2 % of speed and 20 % of depth"), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"best\""), 1U);
  EXPECT_EQ(count(svg, "class=\"count2\""), 1U);
  // The line of limits: 20 to 182 mm across, 100 mm at depth 0, 20 mm at 3 mm.
  EXPECT_NE(svg.find("20.000,60.000 101.000,20.000 182.000,40.000"), std::string::npos)
      << svg;
  // The box of the margins ends at 1.5 mm, half way up.
  EXPECT_NE(svg.find(",60.000 "), std::string::npos);
}

TEST(MilledDrawing, NeedsAMilledOperation) {
  auto o = keyway();
  o.milled.reset();
  EXPECT_THROW(milled_drawing(o), std::domain_error);
  o = keyway();
  o.passes.clear();
  EXPECT_THROW(milled_drawing(o), std::domain_error);
}

ordered_json result() {
  return ordered_json::parse(
      R"({"status": "ok", "cost_per_part": 1, "time_per_part_min": 1,
    "setups": [{"hold": "left", "clamping": "chuck", "operations": [
      {"id": "s1-mill-f1", "kind": "mill", "on": ["f1"], "tool": "E", "direction": "to-chuck",
       "passes": [{"ap_mm": 1, "n_rpm": 4000}], "constraints": [],
       "milling": {"lanes": 2, "fz_mm": 0.045, "limit_mm": 1.33, "shown_mm": 5,
                   "speed_margin": 0.02, "stability_margin": 0.2}}]}]})");
}

TEST(MilledWords, TellHowDeepItMayBeCut) {
  auto r = result();
  auto told = text(r);
  std::replace(told.begin(), told.end(), '\n', ' ');
  for (auto at = told.find("  "); at != told.npos; at = told.find("  "))
    told.erase(at, 1);
  EXPECT_NE(
      told.find("mill f1; no limit binds; 2 lanes, fz 0.0450 mm; stable to 1.330 mm "
                "within 2.0 % of the speed, 20 % more than the pass asked for"),
      std::string::npos)
      << told;
  EXPECT_EQ(told.find("towards the chuck"), std::string::npos);
  r["setups"][0]["operations"][0]["milling"]["limit_mm"] = 5;
  EXPECT_NE(text(r).find("more than 5.000"), std::string::npos) << text(r);
}

TEST(MilledWords, TheReportHasTheChart) {
  const std::vector<Figure> figures{{"stability-s1-mill-f1.svg", "<svg/>"}};
  const auto page = html("pin", result(), figures);
  EXPECT_NE(page.find("Stability of milled places"), std::string::npos);
  EXPECT_NE(page.find("Stable depth over speed of s1-mill-f1"), std::string::npos);
  EXPECT_EQ(html("pin", result(), {}).find("Stability of milled places"),
            std::string::npos);
}

}  // namespace
}  // namespace turnwright::report::milled_drawing_test
