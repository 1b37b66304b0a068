// Shoulders where their lengths are in the middles of their limits.
#include "planning/paths/programmed_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../parts.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

struct Asked {
  std::string a, b;
  double lower_mm, upper_mm;
};

// Three cylinders of 20 mm each that rise to the left, and a seat 12 mm deep at the right.
part::Drawing drawing(const std::vector<Asked>& lengths) {
  auto d = pin();
  d["stock"] = {{"kind", "bar"}, {"diameter_mm", 70}, {"length_mm", 62}};
  d["outer"] = json::array();
  for (int i = 1; i <= 3; ++i)
    d["outer"].push_back({{"id", "d" + std::to_string(i)},
                          {"kind", "cylinder"},
                          {"length_mm", 20},
                          {"diameter_mm", 72 - 5 * i}});
  d["inner"] = json::parse(R"([
    {"id": "seat", "kind": "cylinder", "from": "right", "diameter_mm": 40, "length_mm": 12},
    {"id": "bore", "kind": "cylinder", "from": "right", "diameter_mm": 30, "length_mm": 48}])");
  d["tools"] = "all";
  d["tolerances"] = json::array();
  for (const auto& l : lengths)
    d["tolerances"].push_back({{"id", "l" + std::to_string(d["tolerances"].size())},
                               {"kind", "length"},
                               {"between", {l.a, l.b}},
                               {"limits_mm", {l.lower_mm, l.upper_mm}}});
  return part(d).drawing;
}

TEST(ProgrammedFaces, StandWhereTheyAreDrawnIfAllLimitsAreAboutTheirSizes) {
  EXPECT_TRUE(faces_moved_mm(drawing({})).empty());
  EXPECT_TRUE(faces_moved_mm(drawing({{"right", "seat|bore", -0.1, 0.1}})).empty());
  // The overall length follows from how the part is set up.
  EXPECT_TRUE(faces_moved_mm(drawing({{"left", "right", 0, 0.1}})).empty());
}

TEST(ProgrammedFaces, AreMovedAwayFromTheEndThatALongerLengthIsMeasuredFrom) {
  for (const auto& [end, to_right] : {std::pair{"right", -1}, std::pair{"left", 1}})
    for (const char* face : {"seat|bore", "d1|d2"}) {
      const auto d = drawing({{end, face, 0, 0.1}});
      const auto moved = faces_moved_mm(d);
      EXPECT_EQ(moved.size(), 1u);
      EXPECT_NEAR(moved.at(face), to_right * 0.05, 1e-12) << end << face;
      EXPECT_NEAR(off_middle_mm(d, d.tolerances[0]), 0, 1e-12);
    }
}

TEST(ProgrammedFaces, OfAChainAreEachInTheirMiddle) {
  const auto d = drawing({{"left", "d1|d2", 0, 0.1},
                          {"d2|d3", "d1|d2", -0.04, 0},
                          {"seat|bore", "d2|d3", 0.1, 0.3}});
  const auto moved = faces_moved_mm(d);
  EXPECT_NEAR(moved.at("d1|d2"), 0.05, 1e-12);
  EXPECT_NEAR(moved.at("d2|d3"), 0.03, 1e-12);
  EXPECT_NEAR(moved.at("seat|bore"), 0.23, 1e-12);
  for (const auto& t : d.tolerances)
    if (t.kind == part::ToleranceKind::length) {
      EXPECT_NEAR(off_middle_mm(d, t), 0, 1e-12) << t.id;
    }
}

TEST(ProgrammedFaces, ThatNoEndIsConnectedWithKeepTheLeftmost) {
  const auto moved = faces_moved_mm(drawing({{"d2|d3", "d1|d2", 0, 0.1}}));
  EXPECT_EQ(moved.size(), 1u);
  EXPECT_NEAR(moved.at("d2|d3"), 0.05, 1e-12);
}

// d of both lengths to d1|d2 is the mean of what each asks, weighted by 1/w^2.
TEST(ProgrammedFaces, OfAnOverdeterminedChainShareByTheirWidths) {
  const auto d = drawing({{"left", "d1|d2", 0, 0.1}, {"right", "d1|d2", 0, 0.2}});
  const double a = 1 / (0.1 * 0.1), b = 1 / (0.2 * 0.2);
  const double moved = (a * 0.05 - b * 0.1) / (a + b);
  EXPECT_NEAR(faces_moved_mm(d).at("d1|d2"), moved, 1e-12);
  EXPECT_NEAR(off_middle_mm(d, d.tolerances[0]), moved - 0.05, 1e-12);
  EXPECT_NEAR(off_middle_mm(d, d.tolerances[1]), -moved - 0.1, 1e-12);
}

}  // namespace
}  // namespace turnwright::planning
