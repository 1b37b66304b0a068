// Which setup cuts the chamfers of the drawing, and which tools its inner corners allow.
#include "planning/paths/edges.hpp"

#include <gtest/gtest.h>

#include "../parts.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

json cylinder(const char* id, double length, double d) {
  return {{"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
}

// 30, 50, 40, 30 from the left; the collar is turned in the first setup.
json collar(const json& edges) {
  return {{"material", "C45"},
          {"machine", "lathe-medium"},
          {"damping_ratio", 0.4},
          {"stock",
           {{"kind", "bar"},
            {"diameter_mm", 54},
            {"length_mm", 124},
            {"left_allowance_mm", 2}}},
          {"outer",
           {cylinder("d1", 30, 30), cylinder("d2", 30, 50), cylinder("d3", 30, 40),
            cylinder("d4", 30, 30)}},
          {"setups",
           {{{"hold", "left"}, {"grip_mm", 15}, {"clampings", {"chuck"}}},
            {{"hold", "right"}, {"grip_mm", 15}, {"clampings", {"chuck"}}}}},
          {"edges", edges}};
}

std::vector<std::string> operations(const ProcessPlan& r, std::size_t setup) {
  std::vector<std::string> ids;
  for (const auto& o : r.setups[setup].operations) ids.push_back(o.id);
  return ids;
}

bool has(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

TEST(EdgesOfASetup, AreThoseTowardsItsFreeEnd) {
  const auto p = part(collar(
      {{{"at", "d1|d2"}, {"chamfer_mm", 1}}, {{"at", "d2|d3"}, {"chamfer_mm", 2}}}));
  EXPECT_EQ(front_chamfer(p, 0, {false, 1})->axial_mm, 2);
  EXPECT_EQ(front_chamfer(p, 1, {false, 1})->axial_mm, 1);
  EXPECT_FALSE(front_chamfer(p, 0, {false, 2}));
  const auto of_fillets = part(
      collar({{{"at", "d1|d2"}, {"fillet_mm", 1}}, {{"at", "d2|d3"}, {"fillet_mm", 2}}}));
  EXPECT_EQ(fillet_behind_mm(of_fillets, 0, {false, 2}), 2);
  EXPECT_EQ(fillet_behind_mm(of_fillets, 1, {false, 0}), 1);
  EXPECT_FALSE(fillet_behind_mm(of_fillets, 0, {false, 0}));
}

// Every chamfer is cut on the way: the operations are those of the sharp part, and so
// nearly are their minutes.
TEST(Chamfers, AddNoOperations) {
  const auto sharp = plan(part(collar(json::array())));
  const auto edged = plan(part(collar({{{"at", "left"}, {"chamfer_mm", 1}},
                                       {{"at", "d1|d2"}, {"chamfer_mm", 1}},
                                       {{"at", "d2|d3"}, {"chamfer_mm", 1}},
                                       {{"at", "d3|d4"}, {"chamfer_mm", 1}},
                                       {{"at", "right"}, {"chamfer_mm", 1}}})));
  ASSERT_EQ(edged.status, PlanStatus::ok);
  for (const std::size_t s : {0, 1})
    EXPECT_EQ(operations(edged, s), operations(sharp, s));
  EXPECT_NEAR(edged.cost_per_part, sharp.cost_per_part, 0.01 * sharp.cost_per_part);
  EXPECT_NE(edged.cost_per_part, sharp.cost_per_part);
}

// A bush turned and bored from the right: its left mouth is left to the second setup, after
// that end is faced.
TEST(Chamfers, OfAFarMouthTakeAPassOfTheirOwn) {
  json d = collar({{{"at", "left|b1"}, {"chamfer_mm", 1}}});
  d["outer"] = {cylinder("d1", 20, 50), cylinder("d2", 30, 40)};
  d["stock"]["length_mm"] = 54;
  d["inner"] = {cylinder("b1", 50, 24)};
  d["inner"][0]["from"] = "right";
  const auto p = part(d);
  EXPECT_EQ(p.work.setups[1].inner_chamfers, std::vector<std::size_t>{0});
  const auto work = plan(p);
  ASSERT_EQ(work.status, PlanStatus::ok);
  EXPECT_FALSE(has(operations(work, 0), "s1-chamfer-b1"));
  ASSERT_TRUE(has(operations(work, 1), "s2-chamfer-b1"));
  PlanRequest bare = p;
  std::erase_if(bare.fixed_tools, [](const auto& t) { return t.id == "PROFILE-INT-55"; });
  const auto without = plan(prepare(std::move(bare)));
  EXPECT_EQ(without.status, PlanStatus::infeasible);
  EXPECT_EQ(without.conflicts.front().sentence,
            "chamfer b1: no profiling tool of the tools is for C45 heat-treatable steel, "
            "normalised, 190 HB in "
            "a bore of 24 mm");
}

// What the title block asks for of all edges is cut where a tool passes: with the left end
// held all the time, nothing is done to the edges that face it, and that is no conflict.
TEST(Chamfers, OfTheTitleBlockAreLeftToTheHandWhereNoToolPasses) {
  json d = collar(json::array());
  d["general_edges_mm"] = {0.2, 0.4};
  d["setups"].erase(1);
  d["outer"] = {cylinder("d1", 20, 50), cylinder("d2", 70, 50), cylinder("d3", 30, 40)};
  d["stock"]["left_allowance_mm"] = 0;
  d["stock"]["length_mm"] = 122;
  const auto p = part(d);
  EXPECT_FALSE(p.drawing.outer[0].left_chamfer);
  EXPECT_TRUE(p.drawing.outer[1].right_chamfer);
  EXPECT_TRUE(p.drawing.outer[2].right_chamfer);
  for (const auto& why : p.work.unreachable)
    EXPECT_EQ(why.find("chamfer"), why.npos) << why;
}

// One setup: nothing comes from the left.
TEST(Chamfers, ThatNoSetupReachesAreConflicts) {
  json d = collar({{{"at", "d1|d2"}, {"chamfer_mm", 1}}});
  d["setups"].erase(1);
  d["outer"] = {cylinder("d1", 20, 46), cylinder("d2", 70, 50), cylinder("d3", 30, 40)};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  bool told = false;
  for (const auto& c : r.conflicts)
    told = told || c.sentence.starts_with(
                       "the chamfer at the left end of d2 cannot be cut in any setup");
  EXPECT_TRUE(told);
}

TEST(Fillets, AllowNoLargerCorner) {
  const auto finishing_tool = [](const json& edges) {
    auto d = collar(edges);
    d["tools"] = {"PCLNL-CNMG120408-PM", "PCLNL-CNMG120412-PR", "PDJNL-DNMG150604-PF"};
    const auto r = plan(part(d));
    for (const auto& o : r.setups[1].operations)
      if (o.id == "s2-finish-d1") return o.tool;
    return r.conflicts.empty() ? std::string() : r.conflicts.front().sentence;
  };
  EXPECT_EQ(finishing_tool({{{"at", "d1|d2"}, {"fillet_mm", 0.4}}}),
            "PDJNL-DNMG150604-PF");
  EXPECT_EQ(
      finishing_tool({{{"at", "d1|d2"}, {"fillet_mm", 0.3}}}),
      "d1: no tool that could finish it fits and has a corner of at most 0.3 mm for "
      "the fillet");
}

// A minor edge of 5 deg does not go down 15 deg; a corner of 0.4 mm makes no smaller radius.
TEST(Undercuts, NeedAToolThatGoesIn) {
  const auto with = [](const char* undercut, const char* tool) {
    auto d = collar({{{"at", "d1|d2"}, {"undercut", undercut}}});
    d["tools"] = {"PCLNL-CNMG120408-PM", tool};
    return plan(part(d));
  };
  EXPECT_EQ(with("E0.8x0.3", "PDJNL-DNMG150604-PF").status, PlanStatus::ok);
  EXPECT_EQ(with("E0.8x0.3", "PCLNL-CNMG120404-PF").status, PlanStatus::infeasible);
  const auto small = with("E0.2x0.1", "PDJNL-DNMG150604-PF");
  ASSERT_EQ(small.status, PlanStatus::infeasible);
  EXPECT_EQ(
      small.conflicts.front().sentence,
      "d1: no tool that could finish it fits and has a corner of at most 0.2 mm, a minor "
      "edge of at least 15 deg and a largest depth of cut beyond 0.1 mm for the "
      "undercut");
}

// Form F leans 8 deg into the shoulder: an edge of 93 deg does not go behind it, one of 107.5
// deg does.
TEST(Undercuts, OfFormFNeedAnEdgeThatGoesBehindTheShoulder) {
  const auto with = [](const char* tool) {
    auto d = collar({{{"at", "d1|d2"}, {"undercut", "F0.8x0.3"}}});
    d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", tool};
    return plan(part(d));
  };
  EXPECT_EQ(with("SVHBL-VBMT160404-PF").status, PlanStatus::ok);
  const auto none = with("SVJBL-VBMT160404-PF");
  ASSERT_EQ(none.status, PlanStatus::infeasible);
  EXPECT_EQ(
      none.conflicts.front().sentence,
      "d1: no tool that could finish it fits and has a corner of at most 0.8 mm, a KAPR "
      "of at least 98 deg, a minor edge of at least 15 deg and a largest depth of cut "
      "beyond "
      "0.3 mm for the undercut");
}

// Form H leans 15 deg, G 17.5 deg, as far as an edge of 107.5 deg goes.
TEST(Undercuts, OfFormsGAndHNeedAnEdgeThatLeansAsTheyDo) {
  const auto with = [](const char* undercut, double kapr_deg) {
    auto d = collar({{{"at", "d1|d2"}, {"undercut", undercut}}});
    d["tools"] = {"PCLNL-CNMG120408-PM", "SVHBL-VBMT160404-PF"};
    auto p = part(d);
    for (auto& t : p.tools)
      if (t.id.starts_with("SVHBL")) t.kapr_deg = kapr_deg;
    return plan(p);
  };
  EXPECT_EQ(with("G0.4x0.2", 107.5).status, PlanStatus::ok);
  EXPECT_EQ(with("H0.8x0.3", 105).status, PlanStatus::ok);
  const auto g = with("G0.4x0.2", 107), h = with("H1.2x0.3", 104.5);
  ASSERT_EQ(g.status, PlanStatus::infeasible);
  EXPECT_EQ(
      g.conflicts.front().sentence,
      "d1: no tool that could finish it fits and has a corner of at most 0.4 mm, a KAPR "
      "of "
      "at least 107.5 deg, a minor edge of at least 17.5 deg and a largest depth of cut "
      "beyond 0.2 mm for the undercut");
  ASSERT_EQ(h.status, PlanStatus::infeasible);
  EXPECT_NE(h.conflicts.front().sentence.find("a KAPR of at least 105 deg"),
            std::string::npos);
}

// Of a wall that is asked for its roughness alone, the pass of the undercut is as smooth.
TEST(Undercuts, MakeTheirShoulderAsSmoothAsItIsDrawn) {
  auto d = collar({{{"at", "d1|d2"}, {"undercut", "E0.8x0.3"}}});
  const auto feed = [](const json& document) {
    const auto r = plan(part(document));
    for (const auto& o : r.setups.at(1).operations)
      if (o.id == "s2-finish-d1") return o.passes.front().f_mm_rev;
    return 0.0;
  };
  const double open = feed(d);
  d["faces"] = {{{"id", "d1|d2"}, {"Ra_um", 0.8}}};
  const double smooth = feed(d);
  EXPECT_GT(smooth, 0);
  EXPECT_LT(smooth, open);
  d["outer"][0]["Ra_um"] = 0.8;
  d.erase("faces");
  EXPECT_EQ(feed(d), smooth);
}

json with_runout(const char* undercut) {
  auto d = collar({{{"at", "d1|d2"}, {"undercut", undercut}}});
  d["tolerances"] = {{{"id", "t"},
                      {"kind", "circular-axial-runout"},
                      {"of", "d1|d2"},
                      {"datum", "d1"},
                      {"value_mm", 0.05}}};
  return d;
}

// A shoulder with a tolerance of its own is faced by the finishing tool, which goes on into
// the undercut; the facing tool, whose minor edge does not, faces the ends alone.
TEST(Undercuts, AreCutFromAShoulderThatIsFacedByItself) {
  auto d = with_runout("E0.8x0.3");
  d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"};
  const auto tool_of = [](const ProcessPlan& r, const std::string& id) {
    for (const auto& o : r.setups.at(1).operations)
      if (o.id == id) return o.tool;
    return std::string("none");
  };
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(tool_of(r, "s2-face-d1-d2"), "PDJNL-DNMG150604-PF");
  EXPECT_EQ(tool_of(r, "s2-finish-d1"), "PDJNL-DNMG150604-PF");
  EXPECT_EQ(tool_of(r, "s2-face-left"), "PCLNL-CNMG120408-PM");
  d.erase("edges");
  EXPECT_EQ(tool_of(plan(part(d)), "s2-face-d1-d2"), "PCLNL-CNMG120408-PM");
}

TEST(Undercuts, OfAShoulderThatIsFacedNeedTheSameTools) {
  auto d = with_runout("F0.8x0.3");
  d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF"};
  const auto none = plan(part(d));
  ASSERT_EQ(none.status, PlanStatus::infeasible);
  EXPECT_EQ(
      none.conflicts.front().sentence,
      "d1: no tool that could finish it fits and has a corner of at most 0.8 mm, a KAPR "
      "of at least 98 deg, a minor edge of at least 15 deg and a largest depth of cut "
      "beyond "
      "0.3 mm for the undercut");
  d["tools"].push_back("SVHBL-VBMT160404-PF");
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
}

// The arc around the undercut's own centre ends where the corner touches the floor, and
// where it touches what rises to the shoulder.
TEST(UndercutWay, TouchesFloorRadiusAndShoulder) {
  struct Form {
    char form;
    double radius_mm, depth_mm, lean_deg;
  };
  for (const auto& [form, R, t, deg] :
       {Form{'E', 0.8, 0.3, 0}, Form{'F', 0.8, 0.3, 8}, Form{'G', 0.4, 0.2, 17.5},
        Form{'H', 0.8, 0.3, 15}})
    for (const double r : {0.2, 0.4, 0.8}) {
      if (r > R) continue;
      const auto u = part::undercut(form, R, t).value();
      const auto w = undercut_way(u, r);
      const double lean = deg * M_PI / 180;
      const double z = part::centre_mm(u);  // of the undercut's radius, at its height
      EXPECT_NEAR(w.centre_h + r, u.radius_mm, 1e-12);
      EXPECT_NEAR(w.centre_z + r, z, 1e-12);
      EXPECT_NEAR(std::hypot(w.arc_h - w.centre_h, w.arc_z - w.centre_z), w.radius_mm,
                  1e-12);
      // Distance of the corner's centre from the line that leans through the foot.
      const auto from_line = [&](double h, double along_z) {
        return along_z * std::cos(lean) - (h - part::height_mm(u)) * std::sin(lean);
      };
      EXPECT_NEAR(from_line(w.arc_h + r, w.arc_z + r), r, 1e-9) << form << r;
      EXPECT_NEAR(from_line(w.foot_h + r, r), r, 1e-9) << form << r;
    }
}

}  // namespace
}  // namespace turnwright::planning
