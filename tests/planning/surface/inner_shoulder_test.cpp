// Shoulders between bores: roughness alone is left to the pass of the wider one, a
// tolerance asks for a facing operation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../parts.hpp"
#include "planning/clamping/made_surfaces.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/cut.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

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

// The housing with a depth of its seat from the free end, and limits about its middle.
json with_depth(double half_mm, const char* shoulder = "seat|bore") {
  auto document = housing(json::array());
  document["tolerances"] = {{{"id", "depth"},
                             {"kind", "length"},
                             {"between", {"right", shoulder}},
                             {"limits_mm", {-half_mm, half_mm}}}};
  document["robust"] = false;
  document["budget"] = no_shop_errors();
  document["machine_share_um"] = 0;
  return document;
}

const OperationPlan& facing(const ProcessPlan& plan) {
  return operation(plan, "s1-face-seat-bore");
}

const Deviation& deviation(const ProcessPlan& plan) {
  const auto found = std::ranges::find(plan.deviations, "seat|bore", &Deviation::on);
  if (found == plan.deviations.end()) throw std::domain_error("no deviation");
  return *found;
}

TEST(InnerShoulder, WithADepthIsFacedByTheBarThatFinishesTheBores) {
  for (const char* id : {"seat|bore", "bore|seat"}) {
    const auto p = part(with_depth(0.05, id));
    EXPECT_EQ(p.work.setups[0].inner_shoulders, std::vector<std::size_t>{0});
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok);
    const auto& all = r.setups[0].operations;
    EXPECT_EQ(all.back().id, facing(r).id);
    EXPECT_EQ(facing(r).kind, OperationKind::face);
    EXPECT_EQ(facing(r).tool, finish_of(r, "seat").tool);
    EXPECT_TRUE(tolerance(r, "depth").verdict == Verdict::met);
    EXPECT_EQ(r.certificate.kind, CertificateKind::global);
    const auto again = predict(part_to_predict(as_planned(with_depth(0.05, id), r)));
    ASSERT_EQ(again.status, PlanStatus::ok);
    EXPECT_NEAR(again.cost_per_part, r.cost_per_part, 1e-6 * r.cost_per_part);
    EXPECT_NEAR(tolerance(again, "depth").margin_mm, tolerance(r, "depth").margin_mm,
                1e-9);
  }
}

// The plan's own conditions with another machine and another bar.
template <class Change>
ProcessPlan changed(const Change& change) {
  const auto document = with_depth(0.05);
  auto p = part_to_predict(as_planned(document, plan(part(document))));
  change(p);
  return predict(p);
}

void make_rigid(PreparedPart& p) {
  p.material.E_MPa *= 1e9;
  p.machine.chuck.radial = p.machine.chuck.tangential = {};
  p.machine.chuck.axial_mm_N = 0;
}

void make_rigid(catalogue::BoringBar& bar) {
  bar.E_MPa *= 1e9;
  bar.holder = {};
}

// The edges of the bar change places.
cutting::Cut cut_on_face(const PreparedPart& p, const OperationPlan& o) {
  auto facing = *std::ranges::find(p.tools, o.tool, &catalogue::Tool::id);
  facing.kapr_deg = 90 + facing.minor_kapr_deg;
  return cutting::cut_of(p.material, facing);
}

cutting::Forces<double> forces_on_face(const PreparedPart& p, const OperationPlan& o) {
  return cutting::forces_N(cut_on_face(p, o), o.passes[0].ap_mm, o.passes[0].f_mm_rev);
}

// A uniform bar of length L: a couple at its tip turns it by L/EI, a force across it turns
// it by L^2/2EI and bends it by L^3/3EI beside its shear, and a force along it shortens it
// by L/EA.
struct UniformBar {
  double L = 120, D = 20, f = 12, E = 6e5, nu = 0.3, c0 = 1e-5, c1 = 2e-8, c2 = 1e-9;
  double EA() const { return E * units::kPi / 4 * D * D; }
  double EI() const { return E * units::kPi / 64 * D * D * D * D; }
  double back_mm_N() const { return f * f * (L / EI() + c2) + L / EA(); }
  double forward_mm_N() const { return f * (L * L / (2 * EI()) + c1 + c2 * L); }
  double aside_mm_N() const {
    const double shears = (7 + 6 * nu) / (6 * (1 + nu)) * L / (EA() / (2 * (1 + nu)));
    return L * L * L / (3 * EI()) + shears + c0 + 2 * c1 * L + c2 * L * L;
  }
  void mount(PreparedPart& p, double damping_ratio) const {
    for (auto& t : p.tools)
      if (t.bar) {
        t.bar->E_MPa = E;
        t.bar->nu = nu;
        t.bar->segments = {{L, D, 0}};
        t.bar->tip_offset_mm = f;
        t.bar->tip_mm_N.reset();
        t.bar->holder = {c0, c1, c2};
        t.bar->damping_ratio = damping_ratio;
      }
  }
};

TEST(InnerShoulder, OfARigidPartDeviatesByTheForcesTimesTheComplianceOfTheBar) {
  const UniformBar bar;
  PreparedPart used;
  const auto r = changed([&](PreparedPart& p) {
    make_rigid(p);
    bar.mount(p, 0.1);
    used = p;
  });
  const auto F = forces_on_face(used, facing(r));
  EXPECT_GT(F.Fp_N, 0);
  for (const auto& [rho, e] : deviation(r).table_mm)
    EXPECT_NEAR(e, bar.back_mm_N() * F.Fp_N - bar.forward_mm_N() * F.Ff_N, 1e-9) << rho;
}

// The bar yields out of the work by what it goes back, and along the feed by what it bends.
TEST(InnerShoulder, OfARigidPartChattersAsTheBarYields) {
  constexpr double zeta = 0.1;
  const UniformBar bar;
  PreparedPart used;
  const auto r = changed([&](PreparedPart& p) {
    make_rigid(p);
    bar.mount(p, zeta);
    used = p;
  });
  const auto& o = facing(r);
  const auto K = cutting::chatter_stiffnesses_N_mm(
      cut_on_face(used, o), o.passes[0].ap_mm, o.passes[0].f_mm_rev);
  const double gain =
      (K.ww * bar.back_mm_N() + K.zz * bar.aside_mm_N()) / (2 * zeta * (1 + zeta));
  EXPECT_GT(K.wz, 0);  // the coupling takes off
  const auto chatter =
      std::ranges::find(o.constraints, "chatter stiffness", &ConstraintValue::name);
  ASSERT_NE(chatter, o.constraints.end());
  EXPECT_NEAR(chatter->margin, -std::log(gain), 1e-6);
}

// Of a compliant part and a rigid bar: the section turns, and the feed force, which is now
// directed outwards, turns it away from the tool.
TEST(InnerShoulder, OfARigidBarDeviatesAsTheSectionOfThePartTurns) {
  const auto r_and = [](double c0, double c1, double c2, double axial) {
    return changed([&](PreparedPart& p) {
      make_rigid(p);
      p.machine.chuck.radial = p.machine.chuck.tangential = {c0, c1, c2};
      p.machine.chuck.axial_mm_N = axial;
      for (auto& t : p.tools)
        if (t.bar) make_rigid(*t.bar);
    });
  };
  // The root of a rigid part turns by c1 F + c2 F x, x the distance of the face.
  const double c1 = 3e-8, c2 = 2e-9, axial = 1e-6;
  const auto r = r_and(1e-5, c1, c2, axial);
  const auto F = forces_on_face(part(with_depth(0.05)), facing(r));
  const double x = 40 - 13;  // 15 mm gripped, of which 2 mm are faced off later
  for (const auto& [rho, e] : deviation(r).table_mm)
    EXPECT_NEAR(e, (c2 * rho * rho + axial) * F.Fp_N + (c1 + c2 * x) * rho * F.Ff_N, 1e-9)
        << rho;
}

// The tightest is kept by a smaller feed on the shoulder itself.
TEST(InnerShoulder, CostsNoLessWithATighterDepth) {
  double before = 0, feed = 0;
  for (const double half_mm : {0.1, 0.004, 0.002, 0.001, 0.0005}) {
    const auto r = plan(part(with_depth(half_mm)));
    ASSERT_EQ(r.status, PlanStatus::ok) << half_mm;
    EXPECT_EQ(r.certificate.kind, CertificateKind::global) << half_mm;
    EXPECT_GE(r.cost_per_part, before * (1 - 2e-4)) << half_mm;  // two gaps of proof
    EXPECT_GE(tolerance(r, "depth").margin_mm, -1e-9);
    const auto again = predict(part_to_predict(as_planned(with_depth(half_mm), r)));
    EXPECT_EQ(again.status, PlanStatus::ok) << half_mm;
    before = r.cost_per_part;
    if (half_mm == 0.1) feed = facing(r).passes[0].f_mm_rev;
    if (half_mm == 0.0005) {
      EXPECT_LT(facing(r).passes[0].f_mm_rev, 0.6 * feed);
    }
  }
}

// The mirrored housing, held at its other end.
TEST(InnerShoulder, OfAMirroredPartCostsTheSame) {
  auto document = with_depth(0.01);
  const auto r = plan(part(document));
  auto& d = document;
  std::swap(d["outer"][0], d["outer"][1]);
  for (auto& e : d["inner"]) e["from"] = "left";
  std::swap(d["setups"][0], d["setups"][1]);
  d["tolerances"][0]["between"] = {"left", "seat|bore"};
  const auto mirrored = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_EQ(mirrored.status, PlanStatus::ok);
  EXPECT_NEAR(mirrored.cost_per_part, r.cost_per_part, 1e-6 * r.cost_per_part);
  EXPECT_NEAR(tolerance(mirrored, "depth").margin_mm, tolerance(r, "depth").margin_mm,
              1e-6);
}

TEST(InnerShoulder, MayHaveEveryToleranceOfAFace) {
  auto document = with_depth(0.05);
  auto& all = document["tolerances"];
  for (const char* kind : {"perpendicularity", "circular-axial-runout",
                           "total-axial-runout", "flatness", "parallelism"}) {
    json t{{"id", kind}, {"kind", kind}, {"of", "bore|seat"}, {"value_mm", 0.05}};
    if (t["kind"] == "parallelism")
      t["datum"] = "right";
    else if (t["kind"] != "flatness")
      t["datum"] = "seat";
    all.push_back(t);
  }
  const auto r = plan(part(document));
  ASSERT_EQ(r.status, PlanStatus::ok);
  for (const auto& t : r.tolerances) EXPECT_EQ(t.verdict, Verdict::met) << t.id;
  EXPECT_EQ(std::ranges::count(r.setups[0].operations, OperationKind::face,
                               &OperationPlan::kind),
            2);
}

// Its roughness is that of its own pass, and slows no other.
TEST(InnerShoulder, OfItsOwnOperationIsAsSmoothAsTheDrawingAsks) {
  auto document = with_depth(0.05);
  const auto rough = plan(part(document));
  document["faces"] = {{{"id", "seat|bore"}, {"Ra_um", 0.8}}};
  const auto smooth = plan(part(document));
  ASSERT_EQ(smooth.status, PlanStatus::ok);
  EXPECT_LT(facing(smooth).passes[0].f_mm_rev, facing(rough).passes[0].f_mm_rev);
  EXPECT_EQ(finish_of(smooth, "seat").passes[0].f_mm_rev,
            finish_of(rough, "seat").passes[0].f_mm_rev);
}

// The edge that trails would lie on the shoulder.
TEST(InnerShoulder, IsNotFacedByABarOf90Degrees) {
  auto p = part(with_depth(0.05));
  for (auto& t : p.tools)
    if (t.bar) t.kapr_deg = 90;
  EXPECT_EQ(plan(p).status, PlanStatus::infeasible);
  for (auto& t : p.tools)
    if (t.bar) t.kapr_deg = 91;
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
}

// Two tools wear apart; one drift shifts both faces alike.
TEST(InnerShoulder, AndTheEndAreCutByTwoTools) {
  auto document = with_depth(0.05);
  document["budget"]["drift_axial_um"] = 7;
  document["budget"]["life_between_offsets"] = 0.5;
  const auto r = plan(part(document));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& all = tolerance(r, "depth").shares;
  EXPECT_EQ(std::ranges::count(all, "drift", &Share::source), 0);
  EXPECT_EQ(std::ranges::count(all, "wear", &Share::source), 1);
}

TEST(InnerShoulder, IsFacedByABarAndInAnOperationOfItsOwn) {
  const auto document = with_depth(0.05);
  const auto r = plan(part(document));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto with = [&](const std::string& id, const auto& change) {
    auto given = as_planned(document, r);
    for (auto& o : given["operations"])
      if (o["id"] == id) change(o);
    return refusal(given);
  };
  const auto own = facing(r).id;
  EXPECT_NE(with(own, [](json& o) { o["tool"] = "PCLNL-CNMG120408-PM"; })
                .find("a tool with a boring bar"),
            std::string::npos);
  EXPECT_NE(with("s1-face-right",
                 [](json& o) {
                   o["on"] = {"right", "seat|bore"};
                 })
                .find("in an operation of their own"),
            std::string::npos);
  auto plain = housing(json::array());
  plain["operations"] = as_planned(document, r)["operations"];
  EXPECT_NE(refusal(plain).find("a shoulder that a tolerance is on"), std::string::npos);
  auto left_out = as_planned(document, r);
  auto& all = left_out["operations"];
  all.erase(std::ranges::find_if(all, [&](const json& o) { return o["id"] == own; }));
  const auto without = plan(part(left_out));
  EXPECT_EQ(without.status, PlanStatus::infeasible);
  ASSERT_FALSE(without.conflicts.empty());
  EXPECT_NE(without.conflicts[0].sentence.find("seat|bore has no operation"),
            std::string::npos)
      << without.conflicts[0].sentence;
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

  document["faces"] = json::array();
  document["tolerances"] = {{{"id", "depth"},
                             {"kind", "length"},
                             {"between", {"right", "hole|seat"}},
                             {"limits_mm", {-0.05, 0.05}}}};
  EXPECT_FALSE(part(document).drawing.inner[0].cut);

  document["inner"][0]["kind"] = "hole";
  EXPECT_NE(refusal(document).find("none of what a drill makes is predicted"),
            std::string::npos)
      << refusal(document);
}

}  // namespace
}  // namespace turnwright::planning
