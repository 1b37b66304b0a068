// What a part leaves open and planning settles before it begins: how long the jaws hold,
// how far a boring bar sticks out, how a neck and its blade are chosen.
#include <gtest/gtest.h>

#include <algorithm>

#include "../parts.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/auxiliary/hole_operations.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

json cylinder(const char* id, double length, double d) {
  return {{"id", id}, {"kind", "cylinder"}, {"length_mm", length}, {"diameter_mm", d}};
}

json turned(json outer, double stock_mm) {
  double length = 4;
  for (const auto& e : outer) length += e["length_mm"].get<double>();
  return {{"material", "C45"},
          {"machine", "lathe-medium"},
          {"damping_ratio", 0.4},
          {"stock",
           {{"kind", "bar"},
            {"diameter_mm", stock_mm},
            {"length_mm", length},
            {"left_allowance_mm", 2}}},
          {"outer", std::move(outer)},
          {"setups",
           {{{"hold", "right"}, {"clampings", {"chuck"}}},
            {{"hold", "left"}, {"clampings", {"chuck"}}}}}};
}

// A bush with a bore through it from one end, chamfers at both, parted off.
json bush(const char* from) {
  auto d = turned({cylinder("d1", 35, 45)}, 50);
  d.erase("setups");
  d["stock"] = {{"kind", "bar"},
                {"diameter_mm", 50},
                {"length_mm", 100},
                {"part_off_allowance_mm", 0.5}};
  d["inner"] = {cylinder("b1", 35, 25)};
  d["inner"][0]["from"] = from;
  for (const char* at : {"left", "right", "left|b1", "right|b1"})
    d["edges"].push_back({{"at", at}, {"chamfer_mm", 1}});
  return d;
}

// Without setups the ends are held in the order in which everything can be made, so that a
// part and its mirror image cost the same.
TEST(OpenSetups, OfAMirrorImageAreTheOtherWayRound) {
  const auto right = part(bush("right")), left = part(bush("left"));
  EXPECT_EQ(right.setups[0].hold, part::End::left);
  EXPECT_EQ(left.setups[0].hold, part::End::right);
  EXPECT_EQ(left.setups[1].hold, part::End::left);
  EXPECT_TRUE(left.work.unreachable.empty());
  EXPECT_EQ(left.setups[0].clampings, right.setups[0].clampings);
  const auto a = plan(right), b = plan(left);
  ASSERT_EQ(a.status, PlanStatus::ok);
  ASSERT_EQ(b.status, PlanStatus::ok);
  EXPECT_NEAR(a.cost_per_part, b.cost_per_part, 1e-3 * a.cost_per_part);
}

TEST(OpenSetups, AreToldAndStayAsTheyAreWhereNeitherOrderHelps) {
  const auto told = [](const json& d) {
    std::string why;
    for (const auto& a : document::prepared_part(d, shop(), "part").assumed)
      if (a.pointer == "/setups") why = a.why;
    return why.substr(0, why.find(','));
  };
  EXPECT_EQ(told(bush("left")), "hold right");
  EXPECT_EQ(told(bush("right")), "hold left");
  auto neck =
      turned({cylinder("a", 20, 40), cylinder("b", 20, 30), cylinder("c", 20, 40)}, 45);
  neck.erase("setups");
  neck["outer"][1]["kind"] = "cone";
  neck["outer"][1].erase("diameter_mm");
  neck["outer"][1]["left_mm"] = 20;
  neck["outer"][1]["right_mm"] = 35;
  EXPECT_FALSE(part(neck).work.unreachable.empty());
  EXPECT_EQ(told(neck), "hold left");
  auto given = bush("left");
  given["setups"] = {{{"hold", "left"}}, {{"hold", "right"}}};
  EXPECT_EQ(part(given).setups[0].hold, part::End::left);
}

// A finished pin of 16 x 80 mm, on which 20 mm are left to cut: three diameters, 48 mm,
// stand out of the jaws instead of 85.
TEST(Grips, LetThreeDiametersStandOut) {
  const auto pin = turned({cylinder("d1", 80, 16), cylinder("d2", 20, 10)}, 20);
  EXPECT_EQ(part(pin).grips_mm[1], 52);
  auto given = pin;
  given["setups"][1]["grip_mm"] = 15;
  EXPECT_EQ(part(given).grips_mm[1], 15);
}

// They leave the room that the blade needs to part a bush off: 29 mm of the bar would be
// held otherwise, of the 30 mm that stand behind it.
TEST(Grips, LetTheBladePartOff) {
  auto d = turned({cylinder("d1", 40, 56)}, 58);
  d["stock"]["length_mm"] = 72;
  d["stock"]["left_allowance_mm"] = 30;
  d["stock"]["part_off_allowance_mm"] = 0.5;
  d["setups"] = {{{"hold", "left"}, {"clampings", {"chuck"}}},
                 {{"hold", "right"}, {"clampings", {"chuck"}}}};
  const auto p = part(d);
  double blade = INFINITY;  // the narrowest that reaches to the axis
  for (const auto& t : p.fixed_tools)
    if (t.use == catalogue::FixedUse::parting && t.reach >= 29)
      blade = std::min(blade, t.sizes_mm.front());
  EXPECT_NEAR(p.grips_mm[0], 30 - 0.5 - blade - 2, 1e-9);
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
}

// They end before a step, a groove, a milled place and the surface that is cut.
TEST(Grips, EndBeforeWhatTheyCannotHold) {
  const auto grip = [](const json& outer, const json& milling = {}) {
    auto d = turned(outer, 24);
    if (!milling.is_null()) {
      d["milling"] = milling;
      d["machine"] = "turn-mill";
    }
    return part(d).grips_mm[1];
  };
  const auto end = cylinder("e", 20, 10);
  EXPECT_EQ(grip({cylinder("d1", 30, 16), cylinder("d2", 50, 18), end}), 30);
  EXPECT_EQ(
      grip({cylinder("d1", 30, 16),
            {{"id", "g"}, {"kind", "groove"}, {"length_mm", 3}, {"diameter_mm", 14}},
            cylinder("d2", 50, 16),
            end}),
      30);
  EXPECT_EQ(grip({cylinder("d1", 80, 16), end}, {{{"id", "k"},
                                                  {"kind", "keyway"},
                                                  {"on", "d1"},
                                                  {"z_mm", 40},
                                                  {"length_mm", 20},
                                                  {"width_mm", 5},
                                                  {"depth_mm", 3}}}),
            40);
  // The largest corner, of 1.2 mm, has to roll over the end of what is cut.
  EXPECT_NEAR(grip({cylinder("d1", 30, 16), cylinder("e", 60, 10)}), 28.8, 1e-9);
}

double stick_out(const PreparedPart& p, const char* tool) {
  const auto t = std::ranges::find(p.tools, tool, &catalogue::Tool::id);
  return catalogue::stick_out_mm(t->bar.value());
}

json bored(double depth_mm) {
  auto d = turned({cylinder("d1", 120, 60)}, 64);
  d["inner"] = {cylinder("b1", depth_mm, 30)};
  d["inner"][0]["from"] = "right";
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 15}, {"clampings", {"chuck"}}}};
  return d;
}

// 2 mm beyond the bore, up to whole 5 mm; not beyond 6 diameters of carbide or 4 of steel.
TEST(StickOut, IsWhatTheDeepestBoreNeeds) {
  EXPECT_EQ(stick_out(part(bored(40)), "E16R-SCLCR-CCMT09T304-PF"), 45);
  EXPECT_EQ(stick_out(part(bored(84)), "E16R-SCLCR-CCMT09T304-PF"), 90);
  EXPECT_EQ(stick_out(part(bored(84)), "E20S-SCLCR-CCMT09T304-PF"), 90);
  EXPECT_EQ(stick_out(part(bored(95)), "E16R-SCLCR-CCMT09T304-PF"), 72)
      << "as drawn: it does not reach";
  EXPECT_EQ(stick_out(part(bored(40)), "S16R-SCLCR-CCMT09T304-PF"), 45);
  EXPECT_EQ(stick_out(part(bored(63)), "S16R-SCLCR-CCMT09T304-PF"), 56);
  EXPECT_EQ(stick_out(part(bored(5)), "S16R-SCLCR-CCMT09T304-PF"), 28)
      << "its head of 12 mm and a diameter";
}

// A tool without a longest stick-out keeps its own.
TEST(StickOut, OfAMeasuredBarStays) {
  PlanRequest request = part(bored(40));
  for (auto& t : request.tools)
    if (t.bar) t.bar->longest_mm.reset();
  const double before = stick_out(part(bored(95)), "E16R-SCLCR-CCMT09T304-PF");
  EXPECT_EQ(stick_out(prepare(request), "E16R-SCLCR-CCMT09T304-PF"), 45)
      << "what was set before";
  EXPECT_EQ(before, 72);
}

// Between 40 and 50 mm: plunged from 40 mm down, its sizes are not judged.
TEST(Necks, ArePlungedByABlade) {
  auto d = turned({cylinder("d1", 30, 40), cylinder("neck", 20, 30),
                   cylinder("d3", 20, 50), cylinder("d4", 40, 35)},
                  54);
  d["outer"][1]["fit"] = "h9";
  const auto p = part(d);
  const auto& neck = p.drawing.outer[1];
  ASSERT_TRUE(neck.cut);
  EXPECT_EQ(neck.cut->kind, part::CutKind::groove);
  EXPECT_EQ(neck.left_mm, 40);
  EXPECT_EQ(neck.cut->drawn.left_mm, 30);
  EXPECT_FALSE(neck.limits);
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  const auto& all = r.setups[0].operations;
  EXPECT_TRUE(std::ranges::any_of(all, [](const auto& o) {
    return o.id == "s1-groove-neck" && o.passes.size() == 4;  // blades of 6 mm
  }));
}

// A cone in a neck is more than a blade makes: the neck stays a cylinder and is told.
TEST(Necks, WithConesAreNotPlunged) {
  const json cone{{"id", "c"},
                  {"kind", "cone"},
                  {"length_mm", 10},
                  {"left_mm", 30},
                  {"right_mm", 36}};
  const auto d = turned({cylinder("d1", 30, 40), cylinder("neck", 20, 30), cone,
                         cylinder("d3", 20, 50), cylinder("d4", 40, 35)},
                        54);
  const auto p = part(d);
  EXPECT_FALSE(p.drawing.outer[1].cut);
  EXPECT_FALSE(p.work.unreachable.empty());
}

json thread(const char* id, double length_mm, double d_mm, double pitch_mm) {
  auto e = cylinder(id, length_mm, d_mm);
  e["kind"] = "thread";
  e["pitch_mm"] = pitch_mm;
  return e;
}

// A stud as thick as its threads: each is cut from its own end, where its tool comes in.
TEST(Assignment, ThreadsAreCutWhereTheirToolComesIn) {
  const auto stud = [](double neck_mm) {
    auto d = turned({thread("a", 30, 16, 2), cylinder("neck", 4, neck_mm),
                     cylinder("shank", 36, 16), thread("b", 30, 16, 2)},
                    18);
    d["setups"] = {{{"hold", "left"}, {"grip_mm", 20}, {"clampings", {"chuck"}}},
                   {{"hold", "right"}, {"grip_mm", 20}, {"clampings", {"chuck"}}}};
    d["stock"]["left_allowance_mm"] = 40;
    d["stock"]["length_mm"] = 142;
    return d;
  };
  const auto elements = [](const json& d, std::size_t s) {
    auto all = part(d).work.setups.at(s).elements;
    std::ranges::sort(all);
    return all;
  };
  using All = std::vector<std::size_t>;
  EXPECT_EQ(elements(stud(16), 0), (All{1, 2, 3}));
  EXPECT_EQ(elements(stud(16), 1), (All{0}));
  EXPECT_EQ(plan(part(stud(16))).status, PlanStatus::ok);
  EXPECT_EQ(elements(stud(13), 0), (All{0, 1, 2, 3})) << "the neck is as low as the root";
  auto one = stud(16);
  one["setups"].erase(1);
  EXPECT_EQ(elements(one, 0), (All{0, 1, 2, 3})) << "nowhere else";
}

// The jaws of a bar that is parted off leave the blade its room.
TEST(Grip, LeavesTheBladeItsRoom) {
  auto d = turned({cylinder("d1", 100, 20), cylinder("d2", 60, 18)}, 22);
  d["stock"] = {{"kind", "bar"},
                {"diameter_mm", 22},
                {"length_mm", 202},
                {"left_allowance_mm", 40},
                {"part_off_allowance_mm", 0.6}};
  d["setups"] = {{{"hold", "left"}, {"clampings", {"chuck", "chuck-tailstock"}}},
                 {{"hold", "right"}, {"clampings", {"chuck"}}}};
  const auto p = part(d);
  double least = INFINITY;
  for (const auto& t : p.fixed_tools)
    if (t.use == catalogue::FixedUse::parting && t.reach >= 11)
      least = std::min(least, t.sizes_mm.front());
  EXPECT_GE(40 - 0.6 - p.grips_mm[0], least + 2 - 1e-9);
  EXPECT_GT(p.grips_mm[0], 15) << "lengthened";
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
}

json drilled(double d_mm, const json& more = json::object()) {
  auto d = turned({cylinder("d1", 40, 30)}, 34);
  d["setups"] = {{{"hold", "left"}, {"grip_mm", 15}, {"clampings", {"chuck"}}}};
  d["outer"] = {cylinder("d1", 40, 30)};
  d["stock"] = {
      {"kind", "bar"}, {"diameter_mm", 34}, {"length_mm", 70}, {"left_allowance_mm", 28}};
  d["outer"][0]["length_mm"] = 40;
  d["inner"] = {cylinder("b1", 20, d_mm)};
  d["inner"][0]["from"] = "right";
  d["inner"][0].update(more);
  return d;
}

bool by_the_drill(const json& d) {
  const auto e = part(d).drawing.inner.at(0);
  return part::is_hole(e) && !part::is_reamed(e);
}

// The carbide drills hold IT10, 58 um above 8 mm, and Ra 3.2.
TEST(Holes, AreDrilledWhereADrillKeepsThem) {
  EXPECT_TRUE(by_the_drill(drilled(8)));
  EXPECT_TRUE(by_the_drill(drilled(8, {{"fit", "H11"}})));
  EXPECT_TRUE(by_the_drill(drilled(8, {{"limits_mm", {0, 0.058}}})));
  EXPECT_FALSE(by_the_drill(drilled(8, {{"limits_mm", {0, 0.057}}})));
  EXPECT_FALSE(by_the_drill(drilled(8, {{"limits_mm", {0.01, 0.2}}})));
  EXPECT_TRUE(by_the_drill(drilled(8, {{"Ra_um", 3.2}})));
  EXPECT_FALSE(by_the_drill(drilled(8, {{"Ra_um", 1.6}})));
  EXPECT_FALSE(by_the_drill(drilled(8.2))) << "no drill of that size";
  EXPECT_TRUE(by_the_drill(drilled(10.5)));
  EXPECT_FALSE(by_the_drill(drilled(11))) << "a bar of 8 mm enters what a drill leaves";
  auto named = drilled(8);
  named["tolerances"] = {{{"id", "t"},
                          {"kind", "coaxiality"},
                          {"of", "b1"},
                          {"datum", "d1"},
                          {"value_mm", 0.1}}};
  EXPECT_FALSE(by_the_drill(named));
}

part::InnerElement first_bore(const json& d) { return part(d).drawing.inner.at(0); }

// A bore before a hole, by default one that no boring bar enters.
json before_a_hole(double d_mm, double length_mm, const json& more = json::object(),
                   double behind_mm = 9) {
  auto d = drilled(behind_mm);
  d["inner"].insert(d["inner"].begin(), cylinder("b0", length_mm, d_mm));
  d["inner"][0]["from"] = "right";
  d["inner"][0].update(more);
  return d;
}

// The flat drills hold IT10, 70 um above 18 mm, and Ra 3.2, down to two diameters.
TEST(Holes, WiderOnesBeforeThemAreCounterbored) {
  const auto counterbored = [](const json& d) {
    const auto e = first_bore(d);
    if (part::is_counterbore(e)) {
      EXPECT_EQ(e.cut->drilled_mm, 9);
    }
    return part::is_counterbore(e);
  };
  EXPECT_TRUE(counterbored(before_a_hole(18, 11)));
  EXPECT_TRUE(counterbored(before_a_hole(18, 11, {{"limits_mm", {0, 0.070}}})));
  EXPECT_FALSE(counterbored(before_a_hole(18, 11, {{"limits_mm", {0, 0.069}}})));
  EXPECT_TRUE(counterbored(before_a_hole(18, 11, {{"Ra_um", 3.2}})));
  EXPECT_FALSE(counterbored(before_a_hole(18, 11, {{"Ra_um", 1.6}})));
  EXPECT_TRUE(counterbored(before_a_hole(18, 11, {{"kind", "hole"}, {"fit", "H11"}})));
  EXPECT_FALSE(counterbored(before_a_hole(18.2, 11))) << "no flat drill of that size";
  EXPECT_TRUE(counterbored(before_a_hole(9.5, 19))) << "half a millimetre wider";
  auto deep = before_a_hole(12, 24.1);
  deep["outer"][0]["length_mm"] = 46;
  deep["stock"]["length_mm"] = 76;
  EXPECT_FALSE(counterbored(deep)) << "deeper than 2 D";
  auto through = before_a_hole(18, 11);
  through["inner"][1]["kind"] = "thread";
  through["inner"][1]["diameter_mm"] = 10;
  EXPECT_TRUE(part::is_tapped(part(through).drawing.inner[1]));
  EXPECT_EQ(first_bore(through).cut->drilled_mm, 8.5);
}

// A cone of 90 deg that is 19 mm wide is 9 mm wide 5 mm deeper.
TEST(Holes, CounterboresAreChamferedWhereTheConeSparesTheirFloor) {
  const auto counterbored = [](double length_mm) {
    auto d = before_a_hole(18, length_mm);
    d["edges"] = {{{"at", "right|b0"}, {"chamfer_mm", 0.5}}};
    return part::is_counterbore(first_bore(d));
  };
  EXPECT_TRUE(counterbored(5));
  EXPECT_FALSE(counterbored(4.99));
}

// From the face on, or from the floor of the counterbore before; bores before them begin at
// the widest of them.
TEST(Holes, CounterboresAreCutBeforeBoring) {
  auto d = before_a_hole(18, 5);
  d["inner"].insert(d["inner"].begin() + 1, cylinder("b00", 4, 15));
  d["inner"][1]["from"] = "right";
  d["inner"].insert(d["inner"].begin(), cylinder("bored", 6, 22));
  d["inner"][0]["from"] = "right";
  d["inner"][0]["fit"] = "H7";
  const auto p = part(d);
  EXPECT_EQ(p.drilled_mm, (std::vector<double>{18, 9, 9, 9}));
  const auto wide = counterbore_way(p.drawing, 1, 0.3);
  EXPECT_NEAR(wide.from_mm, 0.3, 1e-12);
  EXPECT_NEAR(wide.to_mm, -11, 1e-12);
  const auto narrow = counterbore_way(p.drawing, 2, 0.3);
  EXPECT_NEAR(narrow.from_mm, -11, 1e-12);
  EXPECT_NEAR(narrow.to_mm, -15, 1e-12);
  const auto work =
      auxiliary_work(p, 0, Clamping::chuck, p.work.setups[0], {p.machine_per_min, 1});
  ASSERT_EQ(work.before.size(), 3u);
  const double lengths[] = {11, 4}, radial[] = {4.5, 3};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& o = work.before[i + 1].plan;
    EXPECT_EQ(o.tool, "FLAT-HM-2D");
    const auto& pass = o.passes.at(0);
    EXPECT_NEAR(pass.ap_mm, radial[i], 1e-12);
    EXPECT_NEAR(pass.time_min, lengths[i] / (pass.f_mm_rev * pass.n_rpm), 1e-9);
  }
}

// The chamfer at the far end is cut in the setup that frees it: from the hole's edge 0.8 mm
// deep, by a cone of 90 deg.
TEST(Holes, AreChamferedWhereTheyLeaveThePart) {
  auto d = drilled(8, {{"length_mm", 40}});
  d["outer"] = {cylinder("d1", 18, 32), cylinder("d2", 22, 30)};
  d["setups"].push_back({{"hold", "right"}, {"grip_mm", 15}, {"clampings", {"chuck"}}});
  d["edges"] = {{{"at", "right|b1"}, {"chamfer_mm", 0.5}},
                {{"at", "left|b1"}, {"chamfer_mm", 0.8}}};
  const auto p = part(d);
  EXPECT_TRUE(part::is_hole(p.drawing.inner[0]));
  const auto work =
      auxiliary_work(p, 1, Clamping::chuck, p.work.setups[1], {p.machine_per_min, 1})
          .all();
  const auto sink = std::ranges::find(work, "s2-countersink-b1",
                                      [](const auto& o) { return o.plan.id; });
  ASSERT_NE(sink, work.end());
  const auto& pass = sink->plan.passes.at(0);
  EXPECT_NEAR(pass.ap_mm, 0.8, 1e-12);
  EXPECT_NEAR(pass.time_min, 0.8 / (pass.f_mm_rev * pass.n_rpm), 1e-12);
  auto inside = d;
  inside["inner"][0]["length_mm"] = 30;
  inside["inner"].push_back({{"id", "b2"},
                             {"kind", "cylinder"},
                             {"from", "right"},
                             {"length_mm", 10},
                             {"diameter_mm", 6}});
  inside["edges"] = {{{"at", "b1|b2"}, {"chamfer_mm", 0.2}}};
  EXPECT_FALSE(part::is_reamed(part(inside).drawing.inner[0]));
}

// Where a bar enters a bore that other tools leave as it is drawn too, all are planned.
TEST(Holes, ThatABarEntersAreMadeInTheCheapestWay) {
  const auto names = [](const json& d) {
    std::vector<std::string> all;
    for (const auto& c : document::prepared_candidates(d, shop(), "part", false).usable)
      all.push_back(c.name);
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(drilled(20, {{"fit", "H7"}})), (Names{"b1 bored", "b1 reamed"}));
  EXPECT_EQ(names(drilled(20, {{"fit", "H6"}})), Names{""}) << "no reamer for it";
  EXPECT_EQ(names(drilled(8, {{"fit", "H7"}})), Names{""}) << "no bar enters";
  EXPECT_EQ(names(drilled(20)), (Names{"b1 bored", "b1 drilled"}));
  EXPECT_EQ(names(drilled(21)), Names{""}) << "IT13 of indexable drills is too wide";
  EXPECT_EQ(names(before_a_hole(18, 11, json::object(), 11)),
            (Names{"b1 bored", "b1 drilled; b0 bored", "b1 drilled; b0 counterbored"}));
}

// The reamers make H7, 15 um above 8 mm, and Ra 0.8, after a drill of 7.8 mm.
TEST(Holes, AreReamedWhereADrillDoesNotKeepThem) {
  for (const json& more : {json{{"limits_mm", {0, 0.057}}},
                           json{{"limits_mm", {-0.01, 0.015}}}, json{{"fit", "H7"}},
                           json{{"Ra_um", 0.8}}, json{{"kind", "hole"}, {"fit", "H7"}}}) {
    const auto e = first_bore(drilled(8, more));
    ASSERT_TRUE(part::is_reamed(e)) << more;
    EXPECT_EQ(e.left_mm, 8) << more;
    EXPECT_EQ(e.cut->drilled_mm, 7.8) << more;
    EXPECT_EQ(e.fit,
              more.contains("fit") ? std::optional<std::string>("H7") : std::nullopt);
  }
  EXPECT_FALSE(part::is_hole(first_bore(drilled(8, {{"limits_mm", {0, 0.014}}}))));
  EXPECT_FALSE(part::is_hole(first_bore(drilled(8, {{"fit", "G7"}}))));
  EXPECT_FALSE(part::is_hole(first_bore(drilled(8, {{"Ra_um", 0.7}}))));
  EXPECT_FALSE(part::is_hole(first_bore(drilled(8.5, {{"fit", "H7"}})))) << "no reamer";
}

// Of several drills that leave the reamer what it needs the one that leaves least.
TEST(Holes, AreDrilledForTheReamerAsWideAsMayBe) {
  auto drill = file("tools/fixed/DRILL-HM-5D.json");
  drill["sizes_mm"] = {7.65, 7.7, 7.85, 7.95};
  auto d = drilled(8, {{"fit", "H7"}});
  d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", drill};
  EXPECT_EQ(first_bore(d).cut->drilled_mm, 7.85);
}

json threaded(const char* designation, double length_mm) {
  auto d = drilled(8);
  d["inner"][0] = {{"id", "b1"},
                   {"kind", "thread"},
                   {"from", "right"},
                   {"length_mm", length_mm},
                   {"designation", designation}};
  return d;
}

// DIN 336's drills, where the carbide drills have them.
TEST(Threads, ThatNoBarEntersAreTapped) {
  const std::pair<const char*, double> taps[] = {
      {"M3", 2.5},   {"M4", 3.3},   {"M5", 4.2},      {"M6", 5},
      {"M8", 6.8},   {"M8x1", 7},   {"M10", 8.5},     {"M10x1.25", 8.8},
      {"M12", 10.2}, {"3/8-16", 8}, {"1/4-20 UNC", 5}};
  for (const auto& [designation, drill] : taps) {
    const auto e = first_bore(threaded(designation, 6));
    ASSERT_TRUE(part::is_tapped(e)) << designation;
    EXPECT_EQ(e.cut->drilled_mm, drill) << designation;
    EXPECT_EQ(e.left_mm, drill) << designation;
  }
  EXPECT_FALSE(part::is_tapped(first_bore(threaded("M16", 6)))) << "a bar enters";
  EXPECT_FALSE(part::is_tapped(first_bore(threaded("M10x0.75", 8)))) << "no tap";
  EXPECT_FALSE(part::is_tapped(first_bore(threaded("M10", 27)))) << "deeper than 3 d";
}

// Tools that would keep what is asked, but do not make the hole here, are named.
TEST(Holes, AreRefusedWhatTheirToolsCannotKeepHere) {
  const auto refusal = [](const json& d) -> std::string {
    try {
      part(d);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const json h7{{"kind", "hole"}, {"fit", "H7"}};
  auto deep = drilled(8, h7);
  deep["inner"][0]["length_mm"] = 30.5;  // and 1.5 mm of lead: four diameters
  EXPECT_EQ(refusal(deep), "accepted");
  deep["inner"][0]["length_mm"] = 30.6;
  EXPECT_EQ(refusal(deep),
            "part: /inner/0/fit: got \"H7\", expected what the tools can keep here: "
            "REAM-HSS-H7 reaches 32 mm with its lead");
  auto before = drilled(8, h7);
  before["inner"].push_back(cylinder("b2", 5, 8));
  before["inner"][1]["from"] = "right";
  before["inner"][1]["kind"] = "hole";
  EXPECT_NE(refusal(before).find("asks for a drill of 7.7 to 7.9 mm"), std::string::npos)
      << refusal(before);
}

// A tap does not pass through a hole that is narrower than its thread.
TEST(Threads, DoNotLieBehindNarrowerHoles) {
  auto d = threaded("M10", 12);
  auto before = cylinder("b0", 6, 8.5);
  before["from"] = "right";
  before["kind"] = "hole";
  d["inner"] = json::array({before, d["inner"][0]});
  EXPECT_THROW(part(d), InputError);
  d["inner"][0]["kind"] = "cylinder";
  EXPECT_NE(plan(part(d)).status, PlanStatus::ok);
  auto twice = threaded("M10", 8);
  twice["inner"].push_back(twice["inner"][0]);
  twice["inner"][1]["id"] = "b2";
  EXPECT_NE(plan(part(twice)).status, PlanStatus::ok);
}

// A hole's tools stand each in an operation of its own; others, and depths or feeds that do
// not follow from the drawing, are refused.
TEST(Holes, TakeTheOperationsOfTheirPlan) {
  auto d = threaded("M10", 16);
  const auto r = plan(part(d));
  ASSERT_EQ(r.status, PlanStatus::ok);
  d["operations"] = json::array();
  for (std::size_t s = 0; s < r.setups.size(); ++s)
    for (const auto& o : r.setups[s].operations)
      d["operations"].push_back({{"id", o.id},
                                 {"setup", s},
                                 {"kind", name(o.kind)},
                                 {"on", o.on},
                                 {"tool", o.tool}});
  const auto again = plan(part(d));
  ASSERT_EQ(again.status, PlanStatus::ok);
  EXPECT_NEAR(again.cost_per_part, r.cost_per_part, 1e-6 * r.cost_per_part);
  const auto tap = std::ranges::find_if(
      d["operations"], [](const json& o) { return o["tool"] == "TAP-HSS-6H"; });
  ASSERT_NE(tap, d["operations"].end());
  (*tap)["conditions"] = {{"f_mm_rev", 2}};
  EXPECT_NE(plan(part(d)).status, PlanStatus::ok) << "its pitch is 1.5 mm";
  (*tap)["conditions"] = {{"passes", 3}};
  EXPECT_NE(plan(part(d)).status, PlanStatus::ok) << "one pass";
  tap->erase("conditions");
  (*tap)["tool"] = "REAM-HSS-H7";
  EXPECT_THROW(part(d), InputError);
}

// The drill goes a pitch deeper than the tap with its lead of 2.5 pitches, or as deep as
// what is drawn behind; with a hole behind that is as wide as the tap's drill, one drill makes both.
TEST(Threads, AreDrilledForTheLeadOfTheTap) {
  auto d = threaded("M10", 16);
  const auto depth = [](const json& document) {
    const auto p = part(document);
    EXPECT_EQ(plan(p).status, PlanStatus::ok);
    return drilled_depth_mm(p, 0, part::End::right, 1000);
  };
  EXPECT_NEAR(depth(d), 16 + 3.5 * 1.5, 1e-12);
  const auto hole = [](double D, double length_mm) {
    return json{{"id", "b2"},
                {"kind", "hole"},
                {"from", "right"},
                {"length_mm", length_mm},
                {"diameter_mm", D}};
  };
  d["inner"].push_back(hole(8.5, 6));
  EXPECT_NEAR(depth(d), 22, 1e-12);
  d["inner"][1] = hole(8.5, 2);
  EXPECT_NEAR(depth(d), 16 + 3.5 * 1.5, 1e-12);
  d["inner"][1] = hole(8, 6);
  EXPECT_THROW(part(d), InputError) << "two drills";
}

// The lead of a tap would cut the thread of the other end anew, out of step.
TEST(Threads, AreNotTappedIntoTheThreadOfTheOtherEnd) {
  auto d = threaded("M10", 16);
  auto behind = d["inner"][0];
  behind["id"] = "b2";
  behind["from"] = "left";
  behind["length_mm"] = part::length_mm(part(d).drawing) - 16;
  d["inner"].push_back(behind);
  EXPECT_EQ(drilled_mm(part(d), part::End::right), 0) << "no drill may";
  d["inner"][1]["designation"] = "M12";
  EXPECT_EQ(drilled_mm(part(d), part::End::right), 8.5) << "a drill of 10.2 mm was there";
}

// Two taps from both ends: each drill may use half of what is left, with what it goes deeper
// for its tap (3.5 pitches) and its point; nor does it meet the centre hole of the other end.
TEST(Threads, AreDrilledClearOfTheOtherEnd) {
  const double tip = 3.5 * 1.5 + 8.5 / 2 / std::tan(units::rad_from_deg(70));
  const auto drill = [](double rest_mm, bool both) {
    auto d = threaded("M10", 16);
    d["outer"][0]["length_mm"] = 16 + rest_mm + (both ? 16 : 0);
    d["stock"]["length_mm"] = 110;
    auto behind = d["inner"][0];
    behind["id"] = "b2";
    behind["from"] = "left";
    if (both) d["inner"].push_back(behind);
    if (!both) d["centre_holes"] = {{{"at", "left"}, {"designation", "A4/8.5"}}};
    return drilled_mm(part(d), part::End::right);
  };
  EXPECT_EQ(drill(2 * tip + 0.01, true), 8.5);
  EXPECT_EQ(drill(2 * tip - 0.01, true), 0);
  const double centre = part::centre_hole('A', 4, 8.5)->depth_mm;
  EXPECT_EQ(drill(centre + tip + 0.01, false), 8.5);
  EXPECT_EQ(drill(centre + tip - 0.01, false), 0);
}

// In the cut both ways through the hole; the lead beyond it and three pitches before it at
// feed.
TEST(Threads, TakeTheTimeOfTheirWays) {
  const auto p = part(threaded("M10", 16));
  const auto work =
      auxiliary_work(p, 0, Clamping::chuck, p.work.setups[0], {p.machine_per_min, 1})
          .all();
  const auto tap =
      std::ranges::find(work, "s1-tap-b1", [](const auto& o) { return o.plan.id; });
  ASSERT_NE(tap, work.end());
  const auto& pass = tap->plan.passes.at(0);
  EXPECT_EQ(pass.f_mm_rev, 1.5);
  EXPECT_NEAR(tap->plan.time_min, 2 * 16 / (1.5 * pass.n_rpm), 1e-12);
  EXPECT_NEAR(tap->air_min, 2 * (3 * 1.5 + 2.5 * 1.5) / (1.5 * pass.n_rpm), 1e-12);
}

// DIN 76-1: 1.05 times the thread's diameter where nothing is drawn, by a cone of 90 deg.
TEST(Threads, AreCountersunk) {
  const auto e = first_bore(threaded("M10", 16));
  ASSERT_TRUE(e.right_chamfer);
  EXPECT_NEAR(e.right_chamfer->radial_mm, (10.5 - 8.5) / 2, 1e-12);
  EXPECT_NEAR(e.right_chamfer->axial_mm, (10.5 - 8.5) / 2, 1e-12);
  EXPECT_FALSE(e.left_chamfer);
  auto d = threaded("M10", 16);
  d["edges"] = {{{"at", "right|b1"}, {"chamfer_mm", 1.5}}};
  EXPECT_NEAR(first_bore(d).right_chamfer->radial_mm, 1.5, 1e-12) << "as drawn";
  d["edges"][0]["angle_deg"] = 30;
  EXPECT_FALSE(part::is_tapped(first_bore(d))) << "no countersink of 60 deg";
  d = drilled(8, {{"kind", "hole"}});
  EXPECT_FALSE(first_bore(d).right_chamfer) << "not asked for";
  d["edges"] = {{{"at", "right|b1"}, {"chamfer_mm", 1}}};
  EXPECT_TRUE(part::is_hole(first_bore(d)));
  d["edges"][0]["angle_deg"] = 30;
  EXPECT_THROW(part(d), InputError);
}

// Cut from where the cone meets the hole of 8.5 mm to 10.5 mm, 1 mm along the axis; the
// cone's point comes from 2 mm before the face and goes 5.25 mm deep.
TEST(Threads, TakeTheTimeOfTheirCountersinks) {
  const auto p = part(threaded("M10", 16));
  const auto work =
      auxiliary_work(p, 0, Clamping::chuck, p.work.setups[0], {p.machine_per_min, 1})
          .all();
  const auto sink = std::ranges::find(work, "s1-countersink-b1",
                                      [](const auto& o) { return o.plan.id; });
  ASSERT_NE(sink, work.end());
  const auto& pass = sink->plan.passes.at(0);
  const double vf = pass.f_mm_rev * pass.n_rpm;
  EXPECT_NEAR(sink->plan.time_min, 1 / vf, 1e-12);
  EXPECT_NEAR(sink->air_min, (2 + 5.25 - 1) / vf + (2 + 5.25) / p.machine.rapid_mm_min,
              1e-12);
}

// A counterbore before them is bored; the tap has to pass through it.
TEST(Threads, BehindABoreAreTappedIfTheTapPasses) {
  auto d = threaded("M12", 16);
  auto counterbore = cylinder("b0", 6, 20);
  counterbore["from"] = "right";
  d["inner"] = json::array({counterbore, d["inner"][0]});
  EXPECT_TRUE(part::is_tapped(part(d).drawing.inner.at(1)));
  d["inner"][0]["diameter_mm"] = 11.5;
  EXPECT_FALSE(part::is_tapped(part(d).drawing.inner.at(1)));
}

// One drill of 8 mm, no boring, and the bore weakens the part like any other.
TEST(Holes, TakeNoBoring) {
  const auto p = part(drilled(8));
  EXPECT_EQ(p.drilled_mm, std::vector<double>{8});
  const auto r = plan(p);
  ASSERT_EQ(r.status, PlanStatus::ok);
  int drills = 0;
  for (const auto& o : r.setups[0].operations) {
    EXPECT_NE(o.kind, OperationKind::bore_rough);
    EXPECT_NE(o.kind, OperationKind::bore_finish);
    if (o.id != "s1-drill-b1") continue;
    ++drills;
    EXPECT_EQ(o.passes.front().ap_mm, 4);
  }
  EXPECT_EQ(drills, 1);
}

// 34 mm deep with its point, 24 of them in one feed, the rest in two pecks of at most 8 mm:
// out of 24 and 29 mm to 2 mm before the part and back, the last 0.5 mm of it fed.
TEST(Holes, OfADrillWithoutCoolantArePecked) {
  const auto drilled_by = [](const std::optional<catalogue::Pecking>& pecking) {
    auto d = drilled(8, {{"kind", "hole"}});
    d["inner"][0]["length_mm"] = 34 - 4 / std::tan(units::rad_from_deg(59));
    d["tools"] = {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", "DRILL-HSS-5D"};
    auto request = without_windows(part(d));
    for (auto& t : request.fixed_tools)
      if (t.use == catalogue::FixedUse::drilling) t.pecking = pecking;
    return prepare(std::move(request));
  };
  const auto drilling = [](const PreparedPart& p) {
    return auxiliary_work(p, 0, Clamping::chuck, p.work.setups[0], {p.machine_per_min, 1})
        .all()
        .at(0);
  };
  const auto whole = drilling(drilled_by({})),
             pecked = drilling(drilled_by(catalogue::Pecking{3, 1}));
  const auto& pass = pecked.plan.passes.at(0);
  const double vf = pass.f_mm_rev * pass.n_rpm;
  EXPECT_NEAR(whole.plan.time_min, 34 / vf, 1e-12);
  EXPECT_NEAR(pecked.plan.time_min, (34 + 2 * 0.5) / vf, 1e-12);
  EXPECT_NEAR(
      pecked.air_min - whole.air_min,
      (2 * (24 + 2) + 2 * (29 + 2) - 2 * 0.5) / drilled_by({}).machine.rapid_mm_min,
      1e-12);
}

// Where the request gives the operations, a hole is one that it drills.
TEST(Holes, OfGivenOperationsAreDrilledByOne) {
  auto d = drilled(8, {{"kind", "hole"}});
  const auto operation = [](const char* id, const char* kind, const char* on) {
    return json{{"id", id}, {"setup", 0}, {"kind", kind}, {"on", {on}}};
  };
  d["operations"] = {operation("o1", "face", "right"), operation("o2", "rough", "d1"),
                     operation("o3", "finish", "d1"), operation("o4", "fixed", "b1")};
  EXPECT_TRUE(part(d).work.unreachable.empty());
  EXPECT_EQ(plan(part(d)).status, PlanStatus::ok);
  d["inner"][0]["kind"] = "cylinder";
  EXPECT_TRUE(by_the_drill(d)) << "nothing bores it";
  d["inner"][0]["kind"] = "hole";
  d["operations"].erase(3);
  EXPECT_EQ(
      part(d).work.unreachable,
      std::vector<std::string>{"b1 has no operation: it would stay as the stock is"});
}

// A drill of the catalogue promises IT10 and Ra 3.2 um: a hole is not asked for more.
TEST(Holes, AreNotAskedForMoreThanADrillLeaves) {
  const auto answer = [](const json& asked) -> std::string {
    auto hole = asked;
    hole["kind"] = "hole";
    try {
      part(drilled(8, hole));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string leaves =
      ", expected no more than a drill, a flat drill or a reamer leaves (DRILL-HM-5D "
      "IT10 and Ra 3.2 "
      "um; "
      "DRILL-HM-8D IT10 and Ra 3.2 um; REAM-HSS-H7 IT7 and Ra 0.8 um; FLAT-HM-2D IT10 "
      "and Ra 3.2 um), or \"cylinder\" "
      "as "
      "kind, which is bored";
  EXPECT_EQ(answer({{"fit", "H6"}}), "part: /inner/0/fit: got \"H6\"" + leaves);
  EXPECT_EQ(answer({{"Ra_um", 0.2}}), "part: /inner/0/Ra_um: got 0.2" + leaves);
  EXPECT_EQ(answer({{"limits_mm", {0.0, 0.01}}}),
            "part: /inner/0/limits_mm: got [0.0,0.01]" + leaves);
  EXPECT_TRUE(answer({{"fit", "H7x"}}).starts_with("part: /inner/0/fit: got \"H7x\""));
  for (const json& asked :
       {json{{"fit", "H10"}}, json{{"Ra_um", 3.2}}, json{{"limits_mm", {0, 0.058}}}})
    EXPECT_EQ(answer(asked), "accepted") << asked;
}

// A flat drill of 18 mm reaches 36 mm from the face, not 36 mm into its own hole: behind a
// bore of 30 mm it does not make 8 mm more.
TEST(Holes, OfAFlatDrillEndWhereItReachesFromTheFace) {
  const auto answer = [](double before_mm) -> std::string {
    auto d = before_a_hole(18, 8);
    d["outer"][0]["length_mm"] = 80;
    d["stock"]["length_mm"] = 110;
    d["inner"][0]["kind"] = "hole";
    d["inner"][0]["fit"] = "H10";
    d["inner"].insert(d["inner"].begin(), cylinder("bored", before_mm, 22));
    d["inner"][0]["from"] = "right";
    try {
      part(d);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(answer(28), "accepted");
  const auto far = answer(30);
  EXPECT_NE(
      far.find("FLAT-HM-2D opens a narrower hole behind, down to at most 36 mm from "
               "the face"),
      std::string::npos)
      << far;
}

// Behind a bored seat the drill has the hole's size and boring starts from that.
TEST(Holes, BehindABoreAreWhereBoringStarts) {
  auto d = drilled(20);
  d["inner"] = {cylinder("b1", 20, 26), cylinder("b2", 15, 16)};
  d["inner"][1]["kind"] = "hole";
  for (auto& b : d["inner"]) b["from"] = "right";
  d["inner"][0]["fit"] = "H7";
  d["outer"][0]["diameter_mm"] = 50;
  d["stock"]["diameter_mm"] = 54;
  const auto p = part(d);
  EXPECT_TRUE(part::is_hole(p.drawing.inner[1]));
  EXPECT_FALSE(part::is_hole(p.drawing.inner[0]));
  EXPECT_EQ(p.drilled_mm, (std::vector<double>{16, 16}));
  EXPECT_EQ(plan(p).status, PlanStatus::ok);
}

// A thin bush is held with little force: a narrower blade is borne where the widest is not.
TEST(Grooves, TakeTheWidestBladeThatTheJawsBear) {
  const auto blade = [](double force_N) {
    auto d = turned({cylinder("d1", 30, 40), cylinder("d2", 30, 36)}, 44);
    d["outer"].push_back(
        {{"id", "g"}, {"kind", "groove"}, {"length_mm", 6}, {"diameter_mm", 30}});
    d["outer"].push_back(cylinder("d3", 10, 36));
    d["stock"]["length_mm"] = 103;
    d["stock"]["left_allowance_mm"] = 25;
    d["setups"] = {{{"hold", "left"},
                    {"grip_mm", 20},
                    {"grip_force_N", force_N},
                    {"clampings", {"chuck"}}}};
    const auto r = plan(part(d));
    for (const auto& o : r.setups.at(0).operations)
      if (o.id == "s1-groove-g") return o.passes.front().ap_mm;
    return 0.0;
  };
  EXPECT_EQ(blade(60000), 6);
  EXPECT_LT(blade(12000), 6);
  EXPECT_GT(blade(12000), 0);
}

}  // namespace
}  // namespace turnwright::planning
