#include "planning/auxiliary/catalogue_operations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../parts.hpp"
#include "planning/auxiliary/hole_operations.hpp"
#include "planning/clamping/centre_clearance.hpp"
#include "planning/clamping/positions.hpp"
#include "planning/clamping/setup_body.hpp"
#include "planning/preparation/assignment.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/cutting/fixed.hpp"
#include "turnwright/planning/plan.hpp"
#include "turnwright/planning/process_plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

const OperationPlan* find(const ProcessPlan& r, const std::string& id) {
  for (const auto& s : r.setups)
    for (const auto& o : s.operations)
      if (o.id == id) return &o;
  return nullptr;
}

OperationPlan copy_of(const ProcessPlan& r, const std::string& id) {
  const auto* o = find(r, id);
  if (!o) throw std::out_of_range(id);
  return *o;
}

const catalogue::FixedTool& tool(const PreparedPart& p, const std::string& id) {
  for (const auto& t : p.fixed_tools)
    if (t.id == id) return t;
  throw std::out_of_range(id);
}

// A part whose tools have nothing to choose (chosen_conditions_test.cpp has what they may).
PreparedPart as_in_catalogue(const json& d) { return prepare(without_windows(part(d))); }

// The pin with a groove between its cylinders and a thread at its end.
json grooved() {
  auto d = pin();
  d["stock"]["length_mm"] = 117;
  d["outer"].push_back(
      {{"id", "g1"}, {"kind", "groove"}, {"length_mm", 5}, {"diameter_mm", 26}});
  d["outer"].push_back({{"id", "th1"},
                        {"kind", "thread"},
                        {"length_mm", 20},
                        {"diameter_mm", 30},
                        {"pitch_mm", 1.5}});
  return d;
}

// pi (r0^2 - r1^2)/(1000 vc f) where no spindle limit comes in between.
// Of M30x1.5-6g: the middles of the pitch diameter and of the major one below the basic ones,
// and how much deeper than h3 the thread is cut from there.
const double kPitchBelow_mm =
    (31.5 + 45 * std::pow(1.5, 0.4) * std::pow(22.4 * 45, 0.05)) / 1000;
const double kMajorBelow_mm =
    (31.5 + 90 * std::pow(1.5, 2.0 / 3) - 1.575 / std::sqrt(1.5)) / 1000;
const double kDeeper_mm = (kPitchBelow_mm - kMajorBelow_mm) / 2;

TEST(Groove, TakesTheTimeOfItsRings) {
  const auto p = as_in_catalogue(grooved());
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto o = copy_of(r, "s1-groove-g1");
  const auto& t = tool(p, "GROOVE-EXT");
  const auto& at = *t.conditions_in(p.material.group);
  ASSERT_EQ(o.passes.size(), 1U);  // one blade of 5 mm
  const double time =
      units::kPi * (15.0 * 15 - 13.0 * 13) / (1000 * at.vc_m_min * at.f_mm_rev);
  EXPECT_NEAR(o.time_min, time, 1e-9);
  EXPECT_EQ(o.kind, OperationKind::fixed);
  EXPECT_NEAR(o.passes[0].Fc_N,
              p.material.kc.k11_MPa * (1 - (t.gamma_deg - p.material.gamma0_deg) / 100) *
                  5 * std::pow(at.f_mm_rev, 1 - p.material.kc.m),
              1e-6);
  const double edges = time / at.T_min;
  // From 1 mm above at feed, 0.2 mm beside the wall behind, down to there from 2 mm outside
  // the stock of 42 mm and back; the blank is as low as the crests of the thread beside it.
  const double above = 1.2 / (at.f_mm_rev * 1000 * at.vc_m_min / (units::kPi * 30));
  const double low = kMajorBelow_mm / 2;
  const double way = 2 * (21 + 2 - (15 - low) - 1) + (2 - low) + 1;
  EXPECT_NEAR(o.cost,
              1.0 * (time + above + way / p.machine.rapid_mm_min + edges * t.change_min) +
                  edges * t.edge_cost,
              1e-12);
}

TEST(Groove, WiderThanTheBladeTakesMorePlunges) {
  auto d = grooved();
  d["outer"][2]["length_mm"] = 13;
  d["stock"]["length_mm"] = 125;
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(copy_of(r, "s1-groove-g1").passes.size(), 3U);  // of 6 mm
}

// Blades and depths may be as small as one likes.
TEST(Groove, TakesAThousandPlungesAtMost) {
  const auto with_blade = [](double width_mm) {
    auto request = without_windows(part(grooved()));
    std::erase_if(request.fixed_tools, [](const catalogue::FixedTool& t) {
      return t.use == catalogue::FixedUse::grooving && t.id != "GROOVE-EXT";
    });
    for (auto& t : request.fixed_tools)
      if (t.id == "GROOVE-EXT") t.sizes_mm = {width_mm};
    return plan(prepare(std::move(request)));
  };
  EXPECT_EQ(copy_of(with_blade(0.005), "s1-groove-g1").passes.size(), 1000U);
  for (const double width_mm : {0.004, 1e-8}) {
    const auto r = with_blade(width_mm);
    ASSERT_FALSE(r.conflicts.empty());
    EXPECT_EQ(r.conflicts[0].sentence, "groove g1: it would take more than 1000 passes");
  }
}

TEST(Thread, TurnsItsLengthPitchByPitch) {
  const auto p = as_in_catalogue(grooved());
  const auto o = copy_of(plan(p), "s1-thread-th1");
  const auto& at = *tool(p, "THREAD-EXT-60").conditions_in(p.material.group);
  const double n = 1000 * at.vc_m_min / (units::kPi * 30);
  ASSERT_EQ(o.passes.size(), 6U);
  double depth = 0;
  for (const auto& pass : o.passes) {
    EXPECT_NEAR(pass.n_rpm, n, 1e-9);
    EXPECT_NEAR(pass.time_min, 20 / (1.5 * n), 1e-12);
    EXPECT_EQ(pass.f_mm_rev, 1.5);
    depth += pass.ap_mm;
  }
  EXPECT_NEAR(depth, 17.0 / 24 * std::sqrt(3) / 2 * 1.5 + kDeeper_mm, 1e-12);
}

TEST(Thread, CarriageLimitsTheSpindle) {
  auto d = grooved();
  auto machine = file("machines/lathe-medium.json");
  machine["feed"]["rapid_mm_min"] = 1000;
  d["machine"] = machine;
  const auto o = copy_of(plan(part(d)), "s1-thread-th1");
  EXPECT_NEAR(o.passes[0].n_rpm, 1000 / 1.5, 1e-9);
}

// The whole is the sum: dear edges of a fixed tool come through to the plan's cost, its
// bound and its profit.
TEST(FixedOperations, AreInEveryTotal) {
  auto p = as_in_catalogue(grooved());
  const auto before = plan(p);
  for (auto& t : p.fixed_tools)
    if (t.id == "GROOVE-EXT") t.edge_cost += 10;
  const auto after = plan(p);
  const auto o = copy_of(before, "s1-groove-g1");
  const double more = 10 * o.time_min / o.passes[0].T_min;
  EXPECT_NEAR(after.cost_per_part - before.cost_per_part, more, 1e-9);
  EXPECT_NEAR(after.certificate.lower_bound - before.certificate.lower_bound, more, 1e-3);
  EXPECT_EQ(after.time_per_part_min, before.time_per_part_min);
  EXPECT_NEAR(*before.profit_per_min * before.time_per_part_min -
                  *after.profit_per_min * after.time_per_part_min,
              more, 1e-9);
  EXPECT_EQ(after.certificate.kind, CertificateKind::global);
  EXPECT_EQ(o.certificate.kind, CertificateKind::global);
  EXPECT_EQ(o.certificate.gap, 0);
}

// All minutes: operations with approach and edges, tools brought in, loading, preparing.
TEST(FixedOperations, TimeOfAPartIsTheSumOfItsParts) {
  const auto p = part(grooved());
  const auto r = plan(p);
  double besides = r.cost_per_part;
  for (const auto& s : r.setups)
    for (const auto& o : s.operations) besides -= o.cost;
  // At 1 per minute: loading and preparing twice, and the tools brought in.
  const auto& m = p.machine;
  int tools = 0;
  for (const auto& s : r.setups) {
    std::string in;
    for (const auto& o : s.operations) {
      if (o.tool != in) ++tools;
      in = o.tool;
    }
  }
  const auto& b = r.breakdown;
  EXPECT_NEAR(b.tool_changes.time_min, tools * m.index_min, 1e-12);
  EXPECT_NEAR(b.loading.time_min, 2 * m.load_min, 1e-12);
  EXPECT_NEAR(b.setup_share.time_min, 2 * m.setup_min / *p.batch, 1e-12);
  EXPECT_EQ(b.operator_stops.time_min, 0);
  // And the ways to where the tools are changed, 50 mm outside, across and along the part.
  const double ways =
      besides - b.tool_changes.time_min - b.loading.time_min - b.setup_share.time_min;
  EXPECT_GE(ways, tools * 4 * 48 / m.rapid_mm_min);
  EXPECT_LE(ways, tools * (4 * 50 + 2 * 117) / m.rapid_mm_min);
  const auto total = b.total();
  EXPECT_NEAR(total.time_min, r.time_per_part_min, 1e-12);
  EXPECT_NEAR(total.cost, r.cost_per_part, 1e-12);
}

TEST(Centre, IsDrilledWhereATailstockStands) {
  auto d = pin();
  d["setups"][0]["clampings"] = {"chuck-tailstock"};
  const auto p = as_in_catalogue(d);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  ASSERT_EQ(r.setups[0].operations.size() > 1, true);
  EXPECT_EQ(r.setups[0].operations[1].id, "s1-centre-right");  // after the face
  EXPECT_EQ(find(r, "s2-centre-left"), nullptr);
  const auto o = copy_of(r, "s1-centre-right");
  const auto& t = tool(p, "DIN333-A");
  const auto& at = *t.conditions_in(p.material.group);
  const double D = 10.6;  // the largest below 0.35 of 32 mm
  // A cone of 60 deg to the pilot of 5 mm, and that, 6.3 mm long by ISO 866.
  const double path = (D - 5) / 2 / std::tan(units::rad_from_deg(30)) + 6.3;
  const double n = 1000 * at.vc_m_min / (units::kPi * D);
  EXPECT_NEAR(o.time_min / (path / (at.f_mm_rev * D * n)), 1, 1e-3);  // depths: 0.01 mm
  EXPECT_NEAR(o.passes[0].ap_mm, D / 2, 1e-12);
}

TEST(Centre, ComesWithTheStockWhereNoToolMakesOne) {
  auto d = pin();
  d["setups"][0]["clampings"] = {"chuck-tailstock"};
  auto p = part(d);
  const double cost = plan(p).cost_per_part;
  p.fixed_tools.clear();
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(find(r, "s1-centre-right"), nullptr);
  EXPECT_LT(r.cost_per_part, cost);
}

// Each once, in the setup that faces its end, with the drill of its form; a tailstock takes
// what is drawn instead of its own.
TEST(Centre, IsDrilledAsDrawnInAnyClamping) {
  const auto d = [](const char* clamping, const char* right) {
    auto document = pin();
    document["setups"][0]["clampings"] = {clamping};
    document["centre_holes"] = {{{"at", "right"}, {"designation", right}},
                                {{"at", "left"}, {"designation", "ISO 6411-A4/8.5"}}};
    return document;
  };
  for (const char* clamping : {"chuck", "chuck-tailstock"}) {
    const auto p = part(d(clamping, "B2,5/8"));
    const auto r = plan(p);
    ASSERT_EQ(r.status, PlanStatus::ok) << clamping;
    EXPECT_EQ(copy_of(r, "s1-centre-right").tool, "DIN333-B") << clamping;
    EXPECT_EQ(copy_of(r, "s1-centre-right").passes[0].ap_mm, 4) << clamping;
    EXPECT_EQ(copy_of(r, "s2-centre-left").tool, "DIN333-A") << clamping;
    EXPECT_EQ(copy_of(r, "s2-centre-left").passes[0].ap_mm, 4.25) << clamping;
    EXPECT_EQ(find(r, "s1-centre-left"), nullptr) << clamping;
  }
  auto none = part(d("chuck", "R10/21.2"));
  const auto r = plan(none);
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  EXPECT_NE(r.conflicts.at(0).sentence.find("190 HB and ISO 6411-R10/21.2"),
            std::string::npos)
      << r.conflicts.at(0).sentence;
}

// An end that no setup frees, parted off, gets none.
TEST(Centre, IsNotLeftOutWhereItsEndIsHeld) {
  auto d = pin();
  d["centre_holes"] = {{{"at", "left"}, {"designation", "A4/8.5"}}};
  ASSERT_EQ(d["setups"].size(), 2u);
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
  for (std::size_t only : {0u, 1u}) {
    auto one = d;
    one["setups"] = {d["setups"][only]};
    const auto unreachable = part(one).work.unreachable;
    const bool told = std::ranges::any_of(unreachable, [](const std::string& sentence) {
      return sentence.starts_with("the centre hole at left cannot be drilled");
    });
    EXPECT_EQ(told, d["setups"][only]["hold"] == "left");
  }
}

// Nor is one drilled into the end of a hole that an earlier setup made through the part.
TEST(Centre, IsNotDrilledIntoAHole) {
  auto d = pin();
  d["setups"][0]["clampings"] = {"chuck"};
  d["setups"][1]["clampings"] = {"chuck-tailstock"};
  EXPECT_NE(find(plan(part(d)), "s2-centre-left"), nullptr);
  d["inner"] = {{{"id", "b"},
                 {"kind", "hole"},
                 {"from", "right"},
                 {"length_mm", part::length_mm(part(d).drawing)},
                 {"diameter_mm", 10}}};
  const auto p = part(d);
  EXPECT_EQ(free_bore_mm(p, 1), 10);
  EXPECT_EQ(find(plan(p), "s2-centre-left"), nullptr);
}

// Pilot, cone and protecting chamfer of ISO 6411, the pilot's length of ISO 866 (by hand:
// (12.5 - 8.5)/2/tan 60 + (8.5 - 4)/2/tan 30 + 5).
TEST(Centre, IsAsDeepAsItsCones) {
  EXPECT_NEAR(part::centre_hole('B', 4, 12.5)->depth_mm, 10.05, 5e-3);
  for (const char* file_name : {"DIN333-A", "DIN333-B", "DIN333-R"}) {
    const auto t = file(std::string("tools/fixed/") + file_name + ".json");
    const char form = t.value("form", "A")[0];
    const double pilots[] = {0.5, 0.8, 1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10};
    std::size_t found = 0;
    for (std::size_t i = 0; i < t["sizes_mm"].size(); ++i)
      for (const double pilot : pilots)
        if (const auto hole = part::centre_hole(form, pilot, t["sizes_mm"][i])) {
          EXPECT_NEAR(t["depths_mm"][i].get<double>(), hole->depth_mm, 5.1e-3)
              << file_name << ' ' << pilot;
          ++found;
        }
    EXPECT_EQ(found, t["sizes_mm"].size()) << file_name;
  }
}

// Inside the face's chamfer, and not as deep as what is drawn from the other end.
TEST(Centre, FitsItsEnd) {
  const auto refusal = [](const json& more) -> std::string {
    auto d = pin();
    d["centre_holes"] = {{{"at", "right"}, {"designation", "A4/8.5"}}};
    d.update(more);
    try {
      part(d);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto bore = [&](double rest_mm) {
    const double length_mm = part::length_mm(part(pin()).drawing) - rest_mm;
    return json{{"inner",
                 {{{"id", "b"},
                   {"kind", "cylinder"},
                   {"from", "left"},
                   {"length_mm", length_mm},
                   {"diameter_mm", 16}}}}};
  };
  EXPECT_EQ(refusal(json::object()), "accepted");
  EXPECT_EQ(refusal(bore(9)), "accepted");
  EXPECT_NE(refusal(bore(8.8)).find("less deep than the 8.8 mm"), std::string::npos);
  const double D = part(pin()).drawing.outer.back().right_mm;
  const double chamfer = (D - 21.2) / 2;
  const auto edge = [](double mm) {
    return json{{"centre_holes", {{{"at", "right"}, {"designation", "A10/21.2"}}}},
                {"edges", {{{"at", "right"}, {"chamfer_mm", mm}}}}};
  };
  EXPECT_EQ(refusal(edge(chamfer - 0.01)), "accepted");
  EXPECT_NE(refusal(edge(chamfer + 0.01)).find("less wide than the 21.18 mm"),
            std::string::npos);
}

TEST(Centre, IsOneOfTheTableInASolidEnd) {
  const auto refusal = [](const json& holes) -> std::string {
    auto d = bored_bush();
    d["centre_holes"] = holes;
    try {
      part(d);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto hole = [](const char* at, const char* designation) {
    return json{{"at", at}, {"designation", designation}};
  };
  EXPECT_NE(refusal(json::array({hole("right", "A4/8.5")}))
                .find("/centre_holes/0/at: got \"right\", expected "
                      "an end that is not hollow"),
            std::string::npos);
  EXPECT_NE(refusal(json::array({hole("left", "A4/9")}))
                .find("expected a centre hole of ISO 6411's form"),
            std::string::npos);
}

json bush() { return bored_bush(); }

/// A bar of 60 mm with a bore from the right and a second one from the left, if it is long.
PreparedPart bored(double right_mm, double D_right_mm, double left_mm, double D_left_mm) {
  auto d = bush();
  d.erase("tolerances");
  d.erase("faces");
  d["stock"] = {{"kind", "bar"}, {"diameter_mm", 64}, {"length_mm", 62}};
  d["outer"] = {
      {{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 60}}};
  d["inner"] = json::array();
  const auto add = [&](const char* from, double length_mm, double D_mm) {
    if (length_mm > 0)
      d["inner"].push_back({{"id", std::string("b-") + from},
                            {"kind", "cylinder"},
                            {"from", from},
                            {"length_mm", length_mm},
                            {"diameter_mm", D_mm}});
  };
  add("right", right_mm, D_right_mm);
  add("left", left_mm, D_left_mm);
  return part(d);
}

TEST(Drilling, SparesWhatIsBehind) {
  const auto drilled = [](const PreparedPart& p) {
    return std::pair{drilled_mm(p, part::End::right), drilled_mm(p, part::End::left)};
  };
  // Through: the counterbore's drill is no wider than the bore behind it.
  const auto [through, counterbore] = drilled(bored(45, 20.2, 15, 30));
  EXPECT_EQ(through, 19);
  EXPECT_LE(counterbore, 20);
  EXPECT_GT(counterbore, 15);
  EXPECT_GT(drilled(bored(15, 30, 0, 0)).first, 20);  // nothing but metal behind
  // Blind: the point stays in what is left.
  for (const double rest : {1.0, 3.0, 6.0}) {
    const double D = drilled(bored(60 - rest, 22, 0, 0)).first;
    EXPECT_LT(D / 2 / std::tan(units::rad_from_deg(80)), rest);
    const auto [a, b] = drilled(bored(30 - rest / 2, 22, 30 - rest / 2, 22));
    EXPECT_LT(std::max(a, b) / 2 / std::tan(units::rad_from_deg(80)), rest / 2);
  }
}

// From what programs bore, in the middle of the limits.
TEST(Drilling, LeavesThatOfABoreFarBelowItsDrawnSizeToo) {
  auto d = bush();
  for (auto& b : d["inner"]) {
    b.erase("fit");
    b["limits_mm"] = {-1.9, -1.7};
  }
  const auto beside = as_in_catalogue(d);
  for (const double drilled : beside.drilled_mm) EXPECT_EQ(drilled, 17);
  EXPECT_EQ(plan(beside).status, PlanStatus::ok);
}

TEST(Drilling, LeavesHalfAMillimetreToTheBoringBar) {
  const auto p = as_in_catalogue(bush());
  for (const double drilled : p.drilled_mm) EXPECT_EQ(drilled, 19);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto o = copy_of(r, "s1-drill-b1");
  EXPECT_EQ(o.tool, "DRILL-HM-5D");
  const auto& at = *tool(p, o.tool).conditions_in(p.material.group);
  const double f = at.f_mm_rev * 19, n = 1000 * at.vc_m_min / (units::kPi * 19);
  double corner = 0;
  for (const auto& t : p.tools) corner = std::max(corner, t.re_mm);
  // Into the bar behind the part, so far as the bar may run over.
  const double path = 40 + 2 * corner + 0.2 + 9.5 / std::tan(units::rad_from_deg(70));
  EXPECT_NEAR(o.time_min, path / (f * n), 1e-12);
  double bored = 0;  // what the bar takes from 19 mm to the middle of 22 H7
  for (const auto& s : r.setups)
    for (const auto& x : s.operations)
      if (x.on == std::vector<std::string>{"b1"} && x.kind != OperationKind::fixed)
        for (const auto& pass : x.passes) bored += pass.ap_mm;
  EXPECT_NEAR(bored, 1.5 + 0.021 / 4, 1e-9);
}

// Through a bore of 50 mm 49 would go, for which 15 kW are not enough.
TEST(Drilling, IsNoLargerThanTheSpindleDrives) {
  const auto p = part(nlohmann::json(
      {{"format", "turnwright-part/1"},
       {"material", "C45"},
       {"stock", {{"kind", "bar"}, {"diameter_mm", 80}, {"length_mm", 64}}},
       {"outer",
        {{{"id", "d1"}, {"kind", "cylinder"}, {"length_mm", 60}, {"diameter_mm", 76}}}},
       {"inner",
        {{{"id", "b1"},
          {"kind", "cylinder"},
          {"from", "right"},
          {"length_mm", 60},
          {"diameter_mm", 50}}}},
       {"machine", "lathe-medium"}}));
  const double D = p.drilled_mm.at(0);
  const auto& drill = tool(p, "DRILL-INDEX-4D");
  const auto& at = *drill.conditions_in(p.material.group);
  const auto shaft_kW = [&](double d) {  // kc f d vc/4, with kc of the chip's thickness
    const auto kc = cutting::kienzle_at(p.material, drill.gamma_deg);
    const double f = at.f_mm_rev * d,
                 h = f / 2 * std::sin(units::rad_from_deg(drill.point_deg / 2));
    return kc.k11_MPa * std::pow(h, -kc.m) * f * d * at.vc_m_min / 240e3;
  };
  const double available_kW = 15 * 0.85;
  EXPECT_LT(D, 49);
  EXPECT_LE(shaft_kW(D), available_kW);
  EXPECT_GT(shaft_kW(D + 1), available_kW);
}

TEST(Drilling, OperationsStandInTheOrderOfTheShop) {
  const auto r = plan(part(bush()));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& all = r.setups[0].operations;
  const auto place = [&](const std::string& id) {
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const auto& o) { return o.id.find(id) == 3; });
    EXPECT_NE(it, all.end()) << id;
    return it - all.begin();
  };
  EXPECT_LT(place("face-right"), place("drill-b1"));
  EXPECT_LT(place("drill-b1"), place("finish-d1"));
  EXPECT_LT(place("finish-d2"), place("bore-finish-b1"));
  EXPECT_LT(place("bore-finish-b2"), place("groove-g1"));
  EXPECT_LT(place("groove-g1"), place("part-left"));
  EXPECT_EQ(place("part-left") + 1, static_cast<long>(all.size()));
}

TEST(Limits, WeakFeedDriveIsNamed) {
  auto d = bush();
  auto machine = file("machines/lathe-medium.json");
  machine["feed"]["feed_force_max_N"] = 900;
  d["machine"] = machine;
  const auto r = plan(prepare(with_one_drill(part(d))));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  ASSERT_FALSE(r.conflicts.empty());
  EXPECT_EQ(r.conflicts[0].limit, "feed force");
  EXPECT_EQ(r.conflicts[0].where, "setup 1, s1-drill-b1");
  EXPECT_GT(r.conflicts[0].value, 900);
  EXPECT_EQ(r.conflicts[0].allowed, 900);
}

TEST(Limits, ThrustBelowTheDriveIsFeasibleAndExact) {
  auto p = prepare(with_one_drill(as_in_catalogue(bush())));
  const auto work = assign(p);
  const auto ops =
      auxiliary_work(p, 0, Clamping::chuck, work.setups[0], {p.machine_per_min, 1}).all();
  ASSERT_EQ(ops[0].plan.id, "s1-drill-b1");
  const double Ff = ops[0].plan.passes[0].Ff_N;
  p.machine.feed_force_max_N = Ff * (1 + 1e-12);
  EXPECT_TRUE(auxiliary_conflicts(p, 0, Clamping::chuck, work.setups[0]).empty());
  p.machine.feed_force_max_N = Ff * (1 - 1e-6);
  EXPECT_EQ(auxiliary_conflicts(p, 0, Clamping::chuck, work.setups[0]).size(), 1U);
}

TEST(Limits, NoToolDeepEnoughIsNamed) {
  auto d = grooved();
  d["outer"][2]["diameter_mm"] = 5;  // 12.4 mm below the crests beside it
  PlanRequest request = part(d);
  std::erase_if(request.fixed_tools,
                [](const auto& t) { return t.id == "GROOVE-EXT-DEEP"; });
  const auto r = plan(prepare(std::move(request)));
  ASSERT_EQ(r.status, PlanStatus::infeasible);
  EXPECT_EQ(r.conflicts[0].limit, "groove g1");
  EXPECT_NE(r.conflicts[0].sentence.find("reaches 12.4"), std::string::npos);
}

TEST(Parting, LeavesItsAllowanceToTheFace) {
  const auto p = part(bush());
  EXPECT_EQ(face_stock_mm(p, part::End::left), 0.6);
  EXPECT_EQ(face_stock_mm(p, part::End::right), 2);
  const auto r = plan(p);
  double faced = 0;
  for (const auto& pass : copy_of(r, "s2-face-left").passes) faced += pass.ap_mm;
  EXPECT_NEAR(faced, 0.6, 1e-12);
}

// To the axis at constant surface speed, the spindle held below its limit.
TEST(Parting, TakesTheTimeOfADiscWithTheSpindleHeld) {
  const auto p = as_in_catalogue(bush());
  const auto o = copy_of(plan(p), "s1-part-left");
  const auto& at = *tool(p, o.tool).conditions_in(p.material.group);
  const double force = p.machine.chuck.grip_force_N;
  const double n_cap =
      std::min(4500.0, std::sqrt(0.67 * force / p.machine.chuck.jaw_mass_radius_kg_m) *
                           30 / units::kPi);
  double t = 0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double D = 50 * (i + 0.5) / kSteps;
    t += 25.0 / kSteps /
         (at.f_mm_rev * std::min(n_cap, 1000 * at.vc_m_min / (units::kPi * D)));
  }
  EXPECT_NEAR(o.time_min, t, 1e-6 * t);
}

TEST(Arc, PassesAreTheDepthOverTheDeepest) {
  const auto p = part(reference_part("threaded-spindle"));
  const auto o = copy_of(plan(p), "s1-arc-a1");
  // A concave quarter circle of 6 mm below its chord: 6 - 6/sqrt 2 across, times sqrt 2.
  const double depth = (6 - 6 / std::sqrt(2)) * std::sqrt(2);
  ASSERT_EQ(o.passes.size(), static_cast<std::size_t>(std::ceil(depth / 1.5)));
  const double n = 1000 * o.passes[0].vc_m_min / (units::kPi * 40);
  EXPECT_NEAR(o.passes[0].ap_mm, depth / static_cast<double>(o.passes.size()), 1e-9);
  const double tip = 6 - tool(p, "PROFILE-35").re_mm;  // runs round the arc's centre
  EXPECT_NEAR(o.passes[0].time_min, units::kPi / 2 * tip / (o.passes[0].f_mm_rev * n),
              1e-9);
}

// Once made, a groove, a thread and a drilled hole weaken the body, their blanks do not.
TEST(Body, HasTheCoreOfWhatIsCut) {
  const auto p = part(grooved());
  auto done = nothing_finished(p.drawing);
  const auto at = [&](double z) {
    const SetupBody body(p, 0, Clamping::chuck, done);
    const auto shaft = body.shaft();
    double x = body.x_mm(z);
    for (const auto& s : shaft.segments) {
      if (x < s.length_mm) return s.outer_left_mm;
      x -= s.length_mm;
    }
    return 0.0;
  };
  EXPECT_EQ(at(92), 42);
  for (std::size_t i = 0; i < done.outer.size(); ++i) done.outer[i] = true;
  EXPECT_EQ(at(92), 26);
  EXPECT_NEAR(at(100), 30 - 2 * 17.0 / 24 * std::sqrt(3) / 2 * 1.5 - kPitchBelow_mm,
              1e-12);
}

// What is told of a part that cannot be made, a sentence a line.
std::string told(const PreparedPart& p) {
  const auto r = plan(p);
  EXPECT_EQ(r.status, PlanStatus::infeasible);
  std::string all;
  for (const auto& c : r.conflicts) all += c.sentence + "\n";
  return all;
}

std::string first_told(const json& d) {
  const auto all = told(part(d));
  return all.substr(0, all.find('\n'));
}

json given_groove() {
  auto d = grooved();
  const auto op = [](const char* id, int setup, const char* kind, const json& on) {
    return json{{"id", id}, {"setup", setup}, {"kind", kind}, {"on", on}};
  };
  d["operations"] = {op("f0", 0, "face", {"right"}),    op("r2", 0, "rough", {"d2"}),
                     op("e2", 0, "finish", {"d2"}),     op("r3", 0, "rough", {"th1"}),
                     op("e3", 0, "finish", {"th1"}),    op("groove", 0, "fixed", {"g1"}),
                     op("thread", 0, "fixed", {"th1"}), op("f1", 1, "face", {"left"}),
                     op("e1", 1, "finish", {"d1"})};
  return d;
}

TEST(Given, TheDepthOfAPlungeIsTheWidthOfItsBlade) {
  const auto plunges = [](double ap_mm) {
    auto d = given_groove();
    d["outer"][2]["length_mm"] = 13;
    d["stock"]["length_mm"] = 125;
    d["operations"][5]["conditions"] = {{"ap_mm", ap_mm}};
    return copy_of(plan(part(d)), "groove").passes;
  };
  EXPECT_EQ(plunges(4).size(), 4U);
  EXPECT_EQ(plunges(4)[0].ap_mm, 4);
  // No blade is 4.5 mm wide: one of 6 mm steps by that.
  EXPECT_EQ(plunges(4.5).size(), 3U);
  EXPECT_EQ(plunges(4.5)[0].ap_mm, 6);
}

TEST(Given, FixedOperationsKeepTheirIdsAndConditions) {
  auto d = given_groove();
  d["operations"][5]["conditions"] = {{"f_mm_rev", 0.07}, {"vc_m_min", 90}};
  d["operations"][6]["conditions"] = {{"passes", 9}};
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto g = copy_of(r, "groove");
  EXPECT_EQ(g.passes[0].f_mm_rev, 0.07);
  EXPECT_NEAR(g.passes[0].vc_m_min, 90, 1e-9);
  EXPECT_EQ(copy_of(r, "thread").passes.size(), 9U);
  // The groove's blank is turned with the thread beside it, the smaller one.
  EXPECT_NE(find(r, "r3:g1"), nullptr);
  EXPECT_NE(find(r, "e3:g1"), nullptr);
}

TEST(Given, WhatNoOperationCutsIsTold) {
  auto d = given_groove();
  d["operations"].erase(5);
  EXPECT_EQ(first_told(d),
            "g1 has no operation of kind \"fixed\": only its blank would be made");
}

TEST(Given, PassesThatAreTooFewAreTold) {
  auto d = given_groove();
  d["operations"][5]["conditions"] = {{"passes", 1}, {"ap_mm", 2}};
  EXPECT_EQ(first_told(d), "groove g1: 1 passes of 2 mm are too few");
}

// A plan's own operations, fixed ones without their conditions, given back.
json given_back(const json& d) {
  auto given = as_planned(d, plan(part(d)));
  for (auto& o : given["operations"])
    if (o["kind"] == "fixed") o.erase("conditions");
  return given;
}

json& given_operation(json& d, const std::string& id) {
  for (auto& o : d["operations"])
    if (o["id"] == id) return o;
  throw std::out_of_range(id);
}

TEST(Given, DrillsOfHolesKeepTheirIds) {
  auto d = given_back(nominal(bush()));
  given_operation(d, "s1-drill-b1")["id"] = "hole";
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  EXPECT_EQ(copy_of(r, "hole").passes[0].ap_mm,
            copy_of(plan(part(bush())), "s1-drill-b1").passes[0].ap_mm);
}

TEST(Given, PassesOfAnArcThatAreTooDeepAreTold) {
  auto d = given_back(reference_part("threaded-spindle"));
  given_operation(d, "s1-arc-a1")["conditions"] = {{"passes", 1}};
  // 6 mm of radius over a quarter: 6 sqrt 2 - 6 deep.
  EXPECT_EQ(first_told(d),
            "arc a1: 1 passes of 2.485 mm are deeper than the 1.5 mm of PROFILE-35");
}

TEST(Parting, IsNoneBetweenCentres) {
  auto d = bush();
  d["setups"][0]["clampings"] = {"between-centres"};
  const auto all = told(part(d));
  EXPECT_NE(all.find("a part between centres is not parted off"), std::string::npos)
      << all;
}

// What is told of a part once its tools of a use have no conditions for its material.
std::string told_without(const json& d, catalogue::FixedUse use) {
  auto p = part(d);
  for (auto& t : p.fixed_tools)
    if (t.use == use) t.conditions.clear();
  return told(p);
}

// Behind the drill of so narrow a bore no bar follows: its own diameter would have to be
// drilled, not one less than nothing.
TEST(Refused, TheDrillOfAVeryNarrowBoreHasItsDiameter) {
  for (const auto& [D_mm, size] : {std::pair{0.5, "190 HB, 0.5 mm"},
                                   {1.0, "190 HB, 1 mm"},
                                   {1.8, "190 HB, at most 0.8 mm"}}) {
    const auto all = told(bored(60, D_mm, 0, 0));
    EXPECT_NE(all.find(std::string(size) + " in diameter and long enough for 60 mm"),
              std::string::npos)
        << all;
  }
}

TEST(Refused, OperationsWithoutAToolSayWhatItWouldHaveToBe) {
  using enum catalogue::FixedUse;
  const auto spindle = reference_part("threaded-spindle");
  const auto says = [](const std::string& text, const std::string& what) {
    return text.find(what) != std::string::npos ? "" : text;
  };
  EXPECT_EQ(says(told_without(bush(), drilling), "drill b1: none of the drills is for "),
            "");
  EXPECT_EQ(says(told_without(bush(), parting),
                 "reaches 25 mm deep and fits between jaws and part, "),
            "");
  EXPECT_EQ(says(told_without(spindle, grooving),
                 "groove g1: no blade of the tools is for C45 heat-treatable steel, "
                 "normalised, 190 HB, at "
                 "most 4 mm wide and "),
            "");
  EXPECT_EQ(says(told_without(spindle, threading),
                 "thread th1: no threading tool of the tools is for C45 heat-treatable "
                 "steel, normalised, 190 HB and "
                 "a pitch of 1.5 mm\n"),
            "");
  EXPECT_EQ(says(told_without(spindle, profiling),
                 "arc a1: no profiling tool of the tools is for C45 heat-treatable "
                 "steel, normalised, 190 HB\n"),
            "");
  auto centred = pin();
  centred["setups"][0]["clampings"] = {"chuck-tailstock"};
  EXPECT_EQ(says(told_without(centred, centring),
                 "no centre drill of the tools is for C45 heat-treatable steel, "
                 "normalised, 190 HB and an end of "
                 "32 mm"),
            "");
}

TEST(Drilling, TakesTheShortestOfItsSizeInWhateverOrderTheDrillsStand) {
  PlanRequest request = part(reference_part("drilled-bush"));
  request.fixed_tools = shop().fixed_tools;
  const auto tool = [](const PlanRequest& r) {
    std::string drill;
    for (const auto& s : plan(r).setups)
      for (const auto& o : s.operations)
        if (o.tool.starts_with("DRILL")) drill += o.tool;
    return drill;
  };
  EXPECT_EQ(tool(request), "DRILL-HM-3D");
  std::ranges::reverse(request.fixed_tools);
  EXPECT_EQ(tool(request), "DRILL-HM-3D");
}

TEST(Given, ConditionsThatCannotBeAreTold) {
  const auto told_with = [](std::size_t operation, const json& conditions) {
    auto d = given_groove();
    d["outer"][2]["length_mm"] = 8;
    d["stock"]["length_mm"] = 120;
    d["operations"][operation]["conditions"] = conditions;
    return first_told(d);
  };
  EXPECT_EQ(told_with(6, {{"f_mm_rev", 1.4}}),
            "thread th1: its feed is its pitch, 1.5 mm");
  EXPECT_EQ(told_with(5, {{"passes", 1}}),
            "groove g1: 1 plunges of a blade of 6 mm are less than its width, 8 mm");
}

}  // namespace
}  // namespace turnwright::planning
