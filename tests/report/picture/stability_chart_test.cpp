#include "report/picture/stability_chart.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace turnwright::report::stability_chart_test {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json crossing(double ap_mm, const char* sense, const char* kind) {
  return {{"ap_mm", ap_mm}, {"sense", sense}, {"kind", kind}};
}

/// Three speeds, the middle one with an island between 2 and 4 of 5 mm.
ordered_json chart_result() {
  return {
      {"speeds",
       {{{"n_rpm", 3000}, {"limit_mm", nullptr}, {"crossings", ordered_json::array()}},
        {{"n_rpm", 1000}, {"limit_mm", 1}, {"crossings", {crossing(1, "loss", "hopf")}}},
        {{"n_rpm", 2000},
         {"limit_mm", 2},
         {"crossings", {crossing(2, "loss", "flip"), crossing(4, "regain", "flip")}}}}},
      {"best", {{"n_rpm", 3000}, {"ap_mm", 5}}},
      {"magic_speeds", ordered_json::array()}};
}

const json kRequest{{"ap_max_mm", 5}};

int times(const std::string& text, const std::string& what) {
  int n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++n;
  return n;
}

// The plot spans x 20 to 182 for 1000 to 3000/min and y 104 to 20 for 0 to 5 mm.
TEST(StabilityChart, FillsWhatIsUnstableBetweenHalfWayNeighbours) {
  const std::string svg = stability_chart(kRequest, chart_result());
  EXPECT_EQ(times(svg, "<polygon class=\"count2\""), 2);
  EXPECT_NE(svg.find("<polygon class=\"count2\" points=\"20.000,20.000 60.500,20.000 "
                     "60.500,87.200 20.000,87.200\"/>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("<polygon class=\"count2\" points=\"60.500,36.800 141.500,36.800 "
                     "141.500,70.400 60.500,70.400\"/>"),
            std::string::npos);
}

// Its neighbours do not stand for it, and no line of limits passes over it.
TEST(StabilityChart, ShadesASpeedThatIsUndecided) {
  auto told = chart_result();
  told["speeds"].erase(2);
  told["undecided"] = {{{"pointer", "/speeds_rpm"}, {"n_rpm", 2000}, {"ap_mm", 5}},
                       {{"pointer", "/points/0"}, {"n_rpm", 1400}, {"ap_mm", 5}}};
  const std::string svg = stability_chart(kRequest, told);
  EXPECT_EQ(times(svg, "<polygon class=\"outside\""), 1);
  EXPECT_NE(svg.find("<polygon class=\"outside\" points=\"60.500,20.000 141.500,20.000 "
                     "141.500,104.000 60.500,104.000\"/>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("shaded: undecided"), std::string::npos);
  const std::string all_told = stability_chart(kRequest, chart_result());
  EXPECT_EQ(times(svg, "<polyline"), times(all_told, "<polyline") - 1);
  EXPECT_EQ(all_told.find("undecided"), std::string::npos);
}

TEST(StabilityChart, MarksCrossingsByTheirKindAndTheFirstLimit) {
  const std::string svg = stability_chart(kRequest, chart_result());
  EXPECT_EQ(times(svg, "<line class=\"flip\""), 3);  // one of them in the key
  EXPECT_EQ(times(svg, "<line class=\"hopf\""), 2);
  EXPECT_NE(svg.find("<line class=\"hopf\" x1=\"20.000\" y1=\"87.200\" x2=\"60.500\" "
                     "y2=\"87.200\"/>"),
            std::string::npos);
  // At 2000/min it is stable again below the limit at 3000/min: the island ends between.
  EXPECT_NE(svg.find("<polyline points=\"20.000,87.200 101.000,70.400\"/>"),
            std::string::npos);
  EXPECT_EQ(svg.find("101.000,70.400 182.000,20.000"), std::string::npos);
  EXPECT_NE(svg.find("best with margins: 3000/min, 5 mm"), std::string::npos);
}

TEST(StabilityChart, TheLineOfTheFirstLimitBreaksOnlyWhereAnIslandEnds) {
  ordered_json r = chart_result();
  r["speeds"][2]["crossings"].erase(1);  // unstable above 2 mm: one flank up to 3000/min
  EXPECT_NE(
      stability_chart(kRequest, r)
          .find("<polyline points=\"20.000,87.200 101.000,70.400 182.000,20.000\"/>"),
      std::string::npos);
  r = chart_result();
  r["speeds"][0]["limit_mm"] = 3;  // below where it is stable again at 2000/min
  r["speeds"][0]["crossings"] = {
      {{"ap_mm", 3}, {"sense", "loss"}, {"kind", "flip"}, {"frequency_Hz", 900}}};
  EXPECT_NE(
      stability_chart(kRequest, r)
          .find("<polyline points=\"20.000,87.200 101.000,70.400 182.000,53.600\"/>"),
      std::string::npos);
}

// Above the frame, where no lens is.
TEST(StabilityChart, TheLabelOfTheBestCutStandsOutsideTheChart) {
  EXPECT_NE(stability_chart(kRequest, chart_result())
                .find("<text class=\"path\" x=\"23.000\" y=\"17.000\""),
            std::string::npos)
      << stability_chart(kRequest, chart_result());
}

TEST(StabilityChart, FoldsAreInTheKeyWhereThereAreAny) {
  ordered_json r = chart_result();
  EXPECT_EQ(times(stability_chart(kRequest, r), "fold\""), 0);
  r["speeds"][1]["crossings"][0]["kind"] = "fold";
  EXPECT_EQ(times(stability_chart(kRequest, r), "<line class=\"fold\""), 2);
  EXPECT_EQ(times(stability_chart(kRequest, r), ">fold</text>"), 1);
}

TEST(StabilityChart, CountsDarkenAndChangeAtTheCrossing) {
  ordered_json r = chart_result();
  r["depths_mm"] = {1.5, 3, 5};
  r["speeds"][0]["unstable_multipliers"] = {0, 0, 0};
  r["speeds"][1]["unstable_multipliers"] = {2, 9, 9};
  r["speeds"][2]["unstable_multipliers"] = {0, 1, 0};
  const std::string svg = stability_chart(kRequest, r);
  // From the loss at 1 mm; half way from 1.5 to 3 mm; 9 is as dark as 4.
  EXPECT_NE(svg.find("<polygon class=\"count2\" points=\"20.000,66.200 60.500,66.200 "
                     "60.500,87.200 20.000,87.200\"/>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("<polygon class=\"count4\" points=\"20.000,20.000 60.500,20.000 "
                     "60.500,66.200 20.000,66.200\"/>"),
            std::string::npos);
  EXPECT_NE(svg.find("<polygon class=\"count1\" points=\"60.500,36.800 141.500,36.800 "
                     "141.500,70.400 60.500,70.400\"/>"),
            std::string::npos);
}

TEST(StabilityChart, ShowsPointsRobustLimitAndTheMachinesReach) {
  ordered_json r = chart_result();
  r["points"] = {{{"n_rpm", 2000}, {"ap_mm", 1}, {"stable", true}},
                 {{"n_rpm", 2000}, {"ap_mm", 3}, {"stable", false}},
                 {{"n_rpm", 9000}, {"ap_mm", 3}, {"stable", false}}};
  for (auto& s : r["speeds"]) s["uncertain"] = {{"robust_mm", 0.5}};
  json q = kRequest;
  q["machine_rpm"] = {{"from", 500}, {"to", 2500}};
  const std::string svg = stability_chart(q, r);
  EXPECT_EQ(times(svg, "<polygon class=\"stable\""), 1);
  EXPECT_NE(svg.find("<line x1=\"100.100\" y1=\"52.700\" x2=\"101.900\" y2=\"54.500\"/>"),
            std::string::npos);
  EXPECT_NE(svg.find("<polyline class=\"robust\" points=\"20.000,95.600"),
            std::string::npos);
  EXPECT_EQ(times(svg, "<polygon class=\"outside\""), 1);
  EXPECT_NE(svg.find("<polygon class=\"outside\" points=\"141.500,20.000 182.000,20.000"),
            std::string::npos);
}

TEST(StabilityChart, OfOneSpeedIsAsWideAsATenthOfIt) {
  ordered_json r = chart_result();
  r["speeds"] = {r["speeds"][1]};
  const std::string svg = stability_chart(kRequest, r);
  EXPECT_NE(svg.find("<polygon class=\"count2\" points=\"20.000,20.000 182.000,20.000"),
            std::string::npos);
  EXPECT_EQ(times(svg, "nan"), 0);
  EXPECT_EQ(stability_chart(kRequest, {{"points", ordered_json::array()}}), "");
}

}  // namespace
}  // namespace turnwright::report::stability_chart_test
