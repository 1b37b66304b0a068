// Shoulders between bores, which the finishing pass of the wider one makes.
#include <gtest/gtest.h>

#include <algorithm>

#include "../parts.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// A bearing seat before a narrower bore, both from the right.
json housing(const json& faces) {
  auto document = json::parse(R"({
    "format": "turnwright-part/1", "name": "Housing", "material": "C45",
    "stock": {"kind": "bar", "diameter_mm": 80, "length_mm": 64},
    "outer": [{"id": "d1", "kind": "cylinder", "diameter_mm": 60, "length_mm": 30},
              {"id": "d2", "kind": "cylinder", "diameter_mm": 76, "length_mm": 30}],
    "inner": [{"id": "seat", "kind": "cylinder", "from": "right", "diameter_mm": 50,
               "length_mm": 20},
              {"id": "bore", "kind": "cylinder", "from": "right", "diameter_mm": 30,
               "length_mm": 40}],
    "machine": "lathe-medium", "damping_ratio": 0.4,
    "setups": [{"hold": "left", "grip_mm": 15, "clampings": ["chuck"]},
               {"hold": "right", "grip_mm": 15, "clampings": ["chuck"]}]})");
  document["faces"] = faces;
  return document;
}

const OperationPlan& finish_of(const ProcessPlan& plan, const std::string& bore) {
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations)
      if (o.kind == OperationKind::bore_finish && std::ranges::count(o.on, bore) > 0)
        return o;
  throw std::domain_error("no finishing of " + bore);
}

std::string refusal(const json& document) {
  try {
    part(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(InnerShoulder, IsNamedByTheWiderBoreWhicheverComesFirst) {
  for (const char* id : {"seat|bore", "bore|seat"}) {
    const auto p = part(housing({{{"id", id}, {"Ra_um", 3.2}}}));
    ASSERT_EQ(p.drawing.faces.size(), 1u);
    EXPECT_EQ(p.drawing.faces[0].id, "seat|bore");
    EXPECT_EQ(face_z_mm(p.drawing, "seat|bore"), 40);
    EXPECT_EQ(setup_of(p, "seat|bore"), setup_of(p, "seat"));
  }
}

// The pass that makes both keeps the smaller roughness: Ra goes with the square of the feed.
TEST(InnerShoulder, IsAsSmoothAsTheDrawingAsks) {
  const auto rough = plan(part(housing(json::array())));
  const auto smooth = plan(part(housing({{{"id", "seat|bore"}, {"Ra_um", 0.8}}})));
  ASSERT_EQ(smooth.status, PlanStatus::ok);
  const auto& o = finish_of(smooth, "seat");
  const auto Ra =
      std::ranges::find(o.constraints, "roughness Ra", &ConstraintValue::name);
  ASSERT_NE(Ra, o.constraints.end());
  EXPECT_EQ(Ra->limit, 0.8);
  EXPECT_LE(Ra->value, 0.8 * (1 + 1e-9));
  EXPECT_LT(o.passes.back().f_mm_rev, finish_of(rough, "seat").passes.back().f_mm_rev);
  EXPECT_GT(smooth.cost_per_part, rough.cost_per_part);
  EXPECT_EQ(finish_of(smooth, "bore").passes.back().f_mm_rev,
            finish_of(rough, "bore").passes.back().f_mm_rev);
}

TEST(InnerShoulder, HasNoOtherDemandThatIsPredicted) {
  auto document = housing(json::array());
  document["tolerances"] = {{{"id", "depth"},
                             {"kind", "length"},
                             {"between", {"right", "bore|seat"}},
                             {"limits_mm", {-0.05, 0.05}}},
                            {{"id", "run"},
                             {"kind", "total-axial-runout"},
                             {"of", "seat|bore"},
                             {"datum", "seat"},
                             {"value_mm", 0.02}}};
  const auto told = refusal(document);
  EXPECT_NE(told.find("/tolerances/0/between/1: got \"bore|seat\""), std::string::npos)
      << told;
  EXPECT_NE(told.find("/tolerances/1/of: got \"seat|bore\""), std::string::npos) << told;
  EXPECT_NE(told.find("only the roughness is predicted"), std::string::npos) << told;
}

// A bore that a drill could leave as it is drawn is bored for the sake of its shoulder.
TEST(InnerShoulder, OfItsOwnRoughnessIsNotLeftToADrill) {
  auto document = housing(json::array());
  document["inner"] = json::parse(R"([
    {"id": "seat", "kind": "cylinder", "from": "right", "diameter_mm": 20, "length_mm": 12},
    {"id": "hole", "kind": "hole", "from": "right", "diameter_mm": 8, "length_mm": 48}])");
  document["faces"] = {{{"id", "seat|hole"}, {"Ra_um", 1.6}}};
  const auto p = part(document);
  EXPECT_FALSE(p.drawing.inner[0].cut);

  document["inner"][0]["kind"] = "hole";
  EXPECT_NE(refusal(document).find("none of what a drill makes is predicted"),
            std::string::npos)
      << refusal(document);
}

}  // namespace
}  // namespace turnwright::planning
