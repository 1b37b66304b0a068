// Milled places of whole plans, against limits written anew and other methods.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "../parts.hpp"
#include "placed_pin.hpp"
#include "planning/auxiliary/catalogue_operations.hpp"
#include "planning/preparation/assignment.hpp"
#include "turnwright/chatter/limits.hpp"
#include "turnwright/chatter/lobes.hpp"
#include "turnwright/chatter/reference_methods.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

using nlohmann::json;

// One pin with one place in it, held at the left.
json milled_pin(const json& place, double diameter_mm = 40) {
  return placed_pin(place, diameter_mm, 55,
                    {"PCLNL-CNMG120408-PM", "PDJNL-DNMG150604-PF", "KEYWAY-HM-6",
                     "KEYWAY-HM-8", "KEYWAY-HM-10", "ENDMILL-HM-8", "ENDMILL-HM-10"});
}

json keyway() {
  return {{"id", "k1"},      {"kind", "keyway"}, {"on", "d1"},   {"z_mm", 40},
          {"length_mm", 32}, {"width_mm", 10},   {"depth_mm", 5}};
}

AuxiliaryWork work_of(const PreparedPart& p, std::size_t setup = 0) {
  return auxiliary_work(p, setup, Clamping::chuck, assign(p).setups[setup],
                        {p.machine_per_min, 1});
}

const OperationPlan* milled_in(const AuxiliaryWork& work) {
  for (const auto& o : work.after)
    if (o.plan.kind == OperationKind::mill) return &o.plan;
  return nullptr;
}

// The cuts of an operation as systems, by the issue's own formulas.
std::vector<chatter::System> systems_of(const PreparedPart& p, const Milled& m,
                                        const OperationPlan& o) {
  const auto& cut = *o.milled;
  const auto cutter = *std::find_if(m.cutters.begin(), m.cutters.end(),
                                    [&](const auto& c) { return c.id == o.tool; });
  // Outer lanes of flats are narrower, corners of wide keyways wider than the sides.
  const double side = m.kind == MilledKind::flat ? 0 : (m.width_mm - cutter.dc_mm) / 2;
  std::vector<double> widths{cut.ae_mm};
  if (m.kind == MilledKind::flat || side > 1e-6)
    for (const double share : {0.75, 0.5, 0.25, 0.0})
      if (side + share > 0) widths.push_back(side + share * (cut.ae_mm - side));
  std::vector<chatter::System> all;
  for (const double ae : widths) {
    chatter::System s;
    for (const auto& mode : cutter.modes)
      s.modes.push_back({mode.along_feed ? chatter::Axis::x : chatter::Axis::y,
                         2 * std::numbers::pi * mode.frequency_Hz, mode.damping_ratio,
                         mode.stiffness_N_mm});
    s.teeth = cutter.teeth;
    const double a = std::min(1.0, ae / cutter.dc_mm), arc = std::acos(1 - 2 * a);
    s.entry_rad = std::numbers::pi - arc;
    s.exit_rad = std::numbers::pi;
    const double hm = cut.fz_mm * 2 * a / arc;
    const double K = p.material.kc.k11_MPa *
                     (1 - (cutter.gamma_deg - p.material.gamma0_deg) / 100) *
                     std::pow(hm, -p.material.kc.m);
    const auto& kf = p.material.kf;
    s.force = chatter::LinearForce{K, kf ? kf->k11_MPa * std::pow(hm, -kf->m) : 0.4 * K};
    all.push_back(s);
  }
  return all;
}

TEST(Milled, IsStableWithTheMarginsByAnotherMethod) {
  auto j = milled_pin({{"id", "k1"},
                       {"kind", "keyway"},
                       {"on", "d1"},
                       {"z_mm", 40},
                       {"length_mm", 32},
                       {"width_mm", 8},
                       {"depth_mm", 4}});
  j["milling"].push_back({{"id", "f1"},
                          {"kind", "flat"},
                          {"on", "d1"},
                          {"z_mm", 40},
                          {"length_mm", 20},
                          {"depth_mm", 1},
                          {"angle_deg", 180}});
  const auto p = part(j);
  const auto plan = planning::plan(p);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  int seen = 0;
  for (const auto& setup : plan.setups)
    for (const auto& o : setup.operations) {
      if (!o.milled) continue;
      ++seen;
      const auto& m = *std::find_if(p.milled.begin(), p.milled.end(), [&](const auto& x) {
        return o.on == std::vector{x.id};
      });
      const auto& pass = o.passes[0];
      EXPECT_GE(o.milled->limit_mm, pass.ap_mm * 1.2 * (1 - 1e-9)) << o.id;
      const double yields = 1 + o.milled->part_share;
      const auto growth = [&](const chatter::System& s, double n, double ap) {
        return std::abs(chatter::simulation(s, n, ap * yields).multiplier);
      };
      double least = std::numeric_limits<double>::infinity(), beyond = 0;
      for (const auto& s : systems_of(p, m, o))
        for (const double u : {-1.0, 0.0, 1.0}) {
          const double n = pass.n_rpm * (1 + 0.02 * u);
          EXPECT_LT(growth(s, n, 0.97 * 1.2 * pass.ap_mm), 1) << o.id << ' ' << n;
          const auto loss = chatter::speed_limits(s, n, 40 * pass.ap_mm).limit_mm();
          if (!loss || *loss > least * yields) continue;
          least = *loss / yields;
          beyond = growth(s, n, 1.05 * least);
        }
      EXPECT_LE(o.milled->limit_mm, std::min(least, o.milled->shown_mm) * (1 + 1e-9));
      EXPECT_GT(beyond, 1) << o.id;
      EXPECT_EQ(o.certificate.kind, CertificateKind::global);
      EXPECT_LE(o.certificate.gap, 1e-4);
      EXPECT_GE(o.certificate.gap, 0);
      for (const auto& c : o.constraints) EXPECT_GE(c.margin, -1e-9) << o.id << c.name;
      ASSERT_EQ(o.milled->n_rpm.size(), o.milled->limits_mm.size());
      EXPECT_GE(o.milled->n_rpm.size(), 100U);
    }
  EXPECT_EQ(seen, 2);
  EXPECT_EQ(plan.certificate.kind, CertificateKind::global);
  EXPECT_LE(plan.certificate.gap, 1e-4);
}

// Every slot drill that fits, every number of passes, speeds and feeds on a lattice, each
// limit written out.
TEST(Milled, NothingOnALatticeIsCheaper) {
  const auto p = part(milled_pin(keyway()));
  const auto work = work_of(p);
  ASSERT_TRUE(work.conflicts.empty()) << work.conflicts[0].sentence;
  const auto* found = milled_in(work);
  ASSERT_NE(found, nullptr);
  const auto& driven = *p.machine.driven_tools;
  const double rho_f = found->constraints[1].value * 1e-6;  // of the part, checked below
  double least = std::numeric_limits<double>::infinity();
  for (const auto& c : shop().cutters) {
    const double D = c.dc_mm;
    if (!c.centre_cutting || D > 10 || D < 6 || c.lu_mm < 5) continue;
    const auto& grade = *c.conditions_in(p.material.group);
    const double rho = rho_f * c.modes[1].stiffness_N_mm;
    if (rho > 1) continue;  // refused
    for (int passes = 1; passes <= 24; ++passes) {
      const double ap = 5.0 / passes;
      if (ap > c.ap_mm.upper || ap < c.ap_mm.lower) continue;
      for (int i = 0; i <= 12; ++i) {
        const double vc = grade.vc_m_min.lower +
                          (grade.vc_m_min.upper - grade.vc_m_min.lower) * i / 12.0;
        const double n = 1000 * vc / (std::numbers::pi * D);
        if (n > driven.n_max_rpm || n < driven.n_min_rpm) continue;
        for (const double share : {1.0, 0.8, 0.5}) {
          const double fz = share * grade.hex_mm.upper;
          const double lane = 32 - D;
          double path = passes * (D < 10 ? lane + 2 * (lane + 10 - D) : lane) + 5 / 0.3;
          const double t = path / (fz * c.teeth * n);
          const double T = grade.T0_min * std::pow(grade.v0_m_min / vc, 1 / grade.n);
          const double back = passes * 36 / p.machine.rapid_mm_min;
          const double cost =
              1.5 * (t + back + c.change_min * t / T) + c.edge_cost * t / T;
          if (cost >= least) continue;
          const double kc11 = 1600 * (1 - (c.gamma_deg - p.material.gamma0_deg) / 100);
          const double hm = fz * 2 / std::numbers::pi;
          const double P = kc11 * std::pow(hm, -0.25) * ap * D * fz * c.teeth * n / 60e6;
          const double most = n <= 1876 ? 28 * n * std::numbers::pi / 30000 : 5.5;
          if (P > 0.8 * most * 0.999) continue;
          if (kc11 * ap * std::pow(fz, 0.75) * (c.teeth == 2 ? 1.0 : 2.0) > c.Fc_max_N)
            continue;
          OperationPlan o = *found;
          o.tool = c.id;
          o.milled->ae_mm = D;
          o.milled->fz_mm = fz;
          bool stable = true;
          for (const auto& s : systems_of(p, p.milled[0], o))
            for (const double u : {0.98, 1.0, 1.02}) {
              if (!stable) break;
              const auto limit =
                  chatter::speed_limits(s, n * u, ap * 1.2 * (1 + rho)).limit_mm();
              stable = !limit;
            }
          if (stable) least = cost;
        }
      }
    }
  }
  ASSERT_TRUE(std::isfinite(least));
  EXPECT_LE(found->cost, least * (1 + 1e-6));
  EXPECT_GE(found->cost, least * 0.9);  // the lattice is not far off
  EXPECT_LE(found->certificate.lower_bound, least);
}

// Kn/Kt changes with the feed: what is chosen is stable with the one at its own feed, on
// a machine too weak for the largest chip too.
TEST(Milled, ForcesRatioIsThatOfTheFeedChosen) {
  for (const auto& [mf, efficiency] : {std::pair{0.1, 0.8}, std::pair{0.45, 0.05}}) {
    auto j = milled_pin(keyway());
    j["material"] = file("materials/C45.json");
    j["material"]["feed_passive"] = {{"kf11_MPa", 350},       {"mf", mf},
                                     {"kp11_MPa", 250},       {"mp", 0.3},
                                     {"uncertainty_pct", 15}, {"source", "a test"}};
    auto p = part(j);
    p.machine.driven_tools->efficiency = efficiency;
    const auto work = work_of(p);
    ASSERT_TRUE(work.conflicts.empty()) << work.conflicts[0].sentence;
    const auto& o = *milled_in(work);
    const auto& pass = o.passes[0];
    const double yields = 1 + o.milled->part_share;
    const double asked = 1.2 * pass.ap_mm * yields;
    for (auto s : systems_of(p, p.milled[0], o)) {
      const auto [Kt, Kn] = std::get<chatter::LinearForce>(s.force);
      s.force = chatter::LinearForce{1, Kn / Kt};
      const chatter::Lobes lobes({s});
      for (const double u : {0.98, 0.99, 1.0, 1.01, 1.02})
        EXPECT_GE(lobes.stable_to_N_mm(pass.n_rpm * u, asked * Kt),
                  asked * Kt * (1 - 1e-6))
            << mf << ' ' << efficiency;
    }
    const double hm = o.milled->hm_mm;
    EXPECT_NEAR(o.milled->Kn_MPa, 350 * std::pow(hm, -mf), 1e-9 * o.milled->Kn_MPa);
  }
}

// The stretches of feeds join; the lobes of each are those of the ratios Kn/Kt at its
// ends, for the lane as wide as it is and for narrower ones.
TEST(Milled, LobesAreThoseOfTheCutsAndTheRatiosAtTheEndsOfTheFeeds) {
  auto j = milled_pin({{"id", "f1"},
                       {"kind", "flat"},
                       {"on", "d1"},
                       {"z_mm", 40},
                       {"length_mm", 20},
                       {"depth_mm", 1},
                       {"tool", "ENDMILL-HM-10"},
                       {"conditions", {{"lanes", 2}}}});
  j["material"] = file("materials/C45.json");
  j["material"]["feed_passive"] = {{"kf11_MPa", 350},       {"mf", 0.4},
                                   {"kp11_MPa", 250},       {"mp", 0.3},
                                   {"uncertainty_pct", 15}, {"source", "a test"}};
  const auto p = part(j);
  const auto& m = p.milled_places[0];
  const auto& c = m.cutters[0];
  const auto& kc = p.material.kc;
  const double k11 = kc.k11_MPa * (1 - (c.gamma_deg - p.material.gamma0_deg) / 100);
  ASSERT_GT(m.ways.size(), 1U);
  const auto check = [&](const chatter::System& s, double share, double fz) {
    const double a = share * m.width_mm / 2 / c.dc_mm, arc = std::acos(1 - 2 * a);
    EXPECT_NEAR(s.exit_rad - s.entry_rad, arc, 1e-12);
    const auto& force = std::get<chatter::LinearForce>(s.force);
    const double hm = fz * 2 * a / arc;
    EXPECT_NEAR(force.Kn_MPa / force.Kt_MPa,
                350 * std::pow(hm, -0.4) / (k11 * std::pow(hm, -kc.m)), 1e-12);
  };
  double from = m.ways.front().fz_from_mm;
  for (const auto& way : m.ways) {
    EXPECT_NEAR(way.fz_from_mm, from, 1e-12);
    from = way.fz_to_mm;
    EXPECT_LE((kc.m - 0.4) * std::log(way.fz_from_mm / way.fz_to_mm), std::log1p(0.05));
    const auto& wide = way.lobes->systems();
    ASSERT_EQ(wide.size(), 2U);
    check(wide[0], 1, way.fz_to_mm);
    check(wide[1], 1, way.fz_from_mm);
    const auto& narrow = way.between->systems();
    ASSERT_EQ(narrow.size(), 6U);
    for (std::size_t k = 0; k < 3; ++k) {
      check(narrow[k], 0.75 - 0.25 * static_cast<double>(k), way.fz_to_mm);
      check(narrow[3 + k], 0.75 - 0.25 * static_cast<double>(k), way.fz_from_mm);
    }
  }
  const auto& hex = c.conditions_in(p.material.group)->hex_mm;
  EXPECT_NEAR(m.ways.front().fz_from_mm / from, hex.lower / hex.upper, 1e-12);
}

// Turned about the axis a place is milled in the same way.
TEST(Milled, PlacesOfOneEntryAreMilledAlike) {
  auto place = keyway();
  place["count"] = 2;
  const auto both = work_of(part(milled_pin(place))).after;
  place.erase("count");
  place["angle_deg"] = 180;
  const auto turned = work_of(part(milled_pin(place))).after;
  std::vector<const OperationPlan*> mills;
  for (const auto& o : both)
    if (o.plan.kind == OperationKind::mill) mills.push_back(&o.plan);
  ASSERT_EQ(mills.size(), 2U);
  EXPECT_EQ(mills[0]->id, "s1-mill-k1-1");
  EXPECT_EQ(mills[1]->id, "s1-mill-k1-2");
  EXPECT_EQ(mills[1]->on, std::vector<std::string>{"k1-2"});
  for (const auto* m : mills) {
    EXPECT_EQ(m->cost, turned.back().plan.cost);
    EXPECT_EQ(m->tool, turned.back().plan.tool);
  }
}

TEST(Milled, WhereNothingIsStableThePlanIsInfeasibleAndSaysWhy) {
  auto j = milled_pin(keyway());
  auto cutter = file("tools/milling/KEYWAY-HM-10.json");
  for (auto& mode : cutter["tool_point"]["modes"]) {
    mode["stiffness_N_mm"] = 60;
    mode["damping_ratio"] = 0.005;
  }
  cutter["geometry"]["ap_mm"] = {1, 10};
  j["milling"][0]["tool"] = cutter;
  const auto plan = planning::plan(part(j));
  EXPECT_EQ(plan.status, PlanStatus::infeasible);
  ASSERT_EQ(plan.conflicts.size(), 1U);
  const auto& c = plan.conflicts[0];
  EXPECT_EQ(c.limit, "stable depth with its margin");
  EXPECT_NE(c.sentence.find("k1: it chatters at every speed: 5 passes of 1 mm with "
                            "KEYWAY-HM-10 come nearest"),
            std::string::npos)
      << c.sentence;
  EXPECT_LT(c.allowed, c.value);
  EXPECT_NEAR(c.value, 1.2, 1e-9);
}

TEST(Milled, NoCutterThatFitsIsAConflict) {
  auto place = keyway();
  place["width_mm"] = 3;
  auto plan = planning::plan(part(milled_pin(place)));
  EXPECT_EQ(plan.status, PlanStatus::infeasible);
  ASSERT_EQ(plan.conflicts.size(), 1U);
  EXPECT_EQ(plan.conflicts[0].limit, "cutter");
  place = keyway();
  place["tool"] = "ENDMILL-HM-10";
  plan = planning::plan(part(milled_pin(place)));
  ASSERT_EQ(plan.conflicts.size(), 1U);
  EXPECT_EQ(plan.conflicts[0].sentence,
            "k1: ENDMILL-HM-10 does not cut over its centre, so it cannot plunge");
}

// The floor lies 5 mm below d1 and 33 mm below the flange beside it.
TEST(Milled, TheHolderClearsWhatStandsBeside) {
  auto j = milled_pin(keyway());
  j["outer"].push_back(
      {{"id", "d2"}, {"kind", "cylinder"}, {"length_mm", 20}, {"diameter_mm", 96}});
  j["outer"][0]["length_mm"] = 75;
  j["stock"] = {{"kind", "bar"},
                {"diameter_mm", 100},
                {"length_mm", 100},
                {"left_allowance_mm", 2}};
  j["setups"] = json::array();
  for (const char* hold : {"left", "right"})
    j["setups"].push_back({{"hold", hold}, {"grip_mm", 15}, {"clampings", {"chuck"}}});
  j["milling"][0]["z_mm"] = 40, j["milling"][0]["tool"] = "KEYWAY-HM-10";
  const auto setup = part(j).milled_places[0].setup.value();
  auto work = work_of(part(j), setup);
  ASSERT_EQ(work.conflicts.size(), 1U);
  EXPECT_NE(work.conflicts[0].sentence.find("holder would meet what stands 33 mm above"),
            std::string::npos)
      << work.conflicts[0].sentence;
  j["milling"][0]["z_mm"] = 12;  // its holder ends 13 mm beside the flange
  work = work_of(part(j), setup);
  EXPECT_TRUE(work.conflicts.empty()) << work.conflicts[0].sentence;
}

json slot_drill() { return file("tools/milling/KEYWAY-HM-10.json"); }

std::string told_of(const json& place) {
  const auto work = work_of(part(milled_pin(place)));
  return work.conflicts.empty() ? "" : work.conflicts[0].sentence;
}

// The part yields across the feed: modes along it do not tell what that does.
TEST(Milled, AToolPointWithoutAModeAcrossTheFeedIsRefused) {
  auto place = keyway();
  place["tool"] = slot_drill();
  place["tool"]["tool_point"]["modes"].erase(1);
  EXPECT_EQ(told_of(place),
            "k1: KEYWAY-HM-10 has no mode across the feed (axis y) at its tool point, "
            "where the part yields with it");
}

TEST(Milled, ADepthAtTheLeastOfTheCutterIsOnePass) {
  json place{{"id", "f1"},
             {"kind", "flat"},
             {"on", "d1"},
             {"z_mm", 40},
             {"length_mm", 25},
             {"depth_mm", 0.2 - 5e-10},
             {"tool", "KEYWAY-HM-10"}};
  const auto work = work_of(part(milled_pin(place)));
  ASSERT_NE(milled_in(work), nullptr);
  EXPECT_EQ(milled_in(work)->passes.size(), 1U);
}

TEST(Milled, CuttersAndSpindleWithoutACommonSpeedAreTold) {
  auto place = keyway();
  place["z_mm"] = 10;
  place["tool"] = slot_drill();
  for (auto& c : place["tool"]["conditions"]) c["vc_m_min"] = {0.5, 1.0};
  EXPECT_EQ(told_of(place),
            "k1: cutters turn at 15.92 to 31.83 1/min, the driven spindle at 40 to 6000 "
            "1/min: no speed is in common");
}

// Without an operation on the right end the bar goes on beyond it: a slot cannot run out.
TEST(Milled, AnEndThatStaysAsStockIsNotAir) {
  auto j = milled_pin({{"id", "s1"},
                       {"kind", "slot"},
                       {"on", "d1"},
                       {"z_mm", 60},
                       {"length_mm", 20},
                       {"width_mm", 10},
                       {"depth_mm", 4}});
  EXPECT_TRUE(work_of(part(j)).conflicts.empty());
  j["operations"] = {{{"id", "o1"},
                      {"setup", 0},
                      {"kind", "finish"},
                      {"on", {"d1"}},
                      {"tool", "PDJNL-DNMG150604-PF"}}};
  const auto work = work_of(part(j));
  ASSERT_EQ(work.conflicts.size(), 1U);
  EXPECT_NE(work.conflicts[0].sentence.find("runs out at neither end"), std::string::npos)
      << work.conflicts[0].sentence;
}

TEST(Milled, GivenSpeedsAndFeedsOutsideTheCuttersAreNamed) {
  auto place = keyway();
  place["conditions"] = {{"n_rpm", 300}};
  auto work = work_of(part(milled_pin(place)));
  ASSERT_EQ(work.conflicts.size(), 1U);
  EXPECT_EQ(work.conflicts[0].limit, "spindle speed");
  EXPECT_NE(work.conflicts[0].sentence.find("300 1/min is given, "), std::string::npos);
  EXPECT_GT(work.conflicts[0].allowed, 1000);
  place["conditions"] = {{"fz_mm", 0.5}};
  work = work_of(part(milled_pin(place)));
  ASSERT_EQ(work.conflicts.size(), 1U);
  EXPECT_EQ(work.conflicts[0].limit, "feed per tooth");
  EXPECT_LT(work.conflicts[0].allowed, 0.2);
}

json slender_pin(double z_mm) {
  auto j = milled_pin({{"id", "k1"},
                       {"kind", "keyway"},
                       {"on", "d1"},
                       {"z_mm", z_mm},
                       {"length_mm", 20},
                       {"width_mm", 5},
                       {"depth_mm", 2}},
                      14);
  j.erase("tools");
  j["outer"][0]["length_mm"] = 280;
  j["stock"]["length_mm"] = 342;
  return j;
}

TEST(Milled, ASlenderPinIsRefusedNotGuessed) {
  const auto work = work_of(part(slender_pin(250)));
  ASSERT_EQ(work.conflicts.size(), 1U);
  EXPECT_NE(work.conflicts[0].sentence.find("the part yields"), std::string::npos)
      << work.conflicts[0].sentence;
}

TEST(Milled, WhatStandsAgainstEachClampingIsToldWhateverTheirOrder) {
  auto j = slender_pin(140);
  std::set<std::string> told;
  for (const json& order :
       {json{"chuck", "chuck-tailstock"}, json{"chuck-tailstock", "chuck"}}) {
    j["setups"][0]["clampings"] = order;
    const auto plan = planning::plan(part(j));
    EXPECT_EQ(plan.status, PlanStatus::infeasible);
    ASSERT_EQ(plan.conflicts.size(), 2U);
    for (const auto& c : plan.conflicts) told.insert(c.sentence);
  }
  EXPECT_EQ(told.size(), 2U);
  EXPECT_EQ(told.begin()->find("chuck-tailstock: k1: no cutter does: the part yields"),
            0U);
  EXPECT_EQ(told.rbegin()->find("chuck: k1: no cutter does: the part yields"), 0U);
}

// What plan chose, given: the same. Twice as fast and deep: told what breaks.
TEST(Milled, PredictJudgesGivenConditions) {
  auto j = milled_pin(keyway());
  const auto p = part(j);
  const auto first = work_of(p);
  const auto& o = *milled_in(first);
  auto& place = j["milling"][0];
  place["tool"] = o.tool;
  place["conditions"] = {{"passes", o.passes.size()},
                         {"n_rpm", o.passes[0].n_rpm},
                         {"fz_mm", o.milled->fz_mm}};
  const auto again = work_of(part(j));
  ASSERT_NE(milled_in(again), nullptr);
  EXPECT_NEAR(milled_in(again)->cost, o.cost, 1e-9 * o.cost);
  EXPECT_NEAR(milled_in(again)->milled->limit_mm, o.milled->limit_mm, 1e-9);
  EXPECT_TRUE(
      auxiliary_conflicts(part(j), 0, Clamping::chuck, assign(p).setups[0]).empty());
  place["conditions"] = {{"passes", 1}, {"n_rpm", o.passes[0].n_rpm}, {"fz_mm", 0.06}};
  const auto deep = part(j);
  const auto conflicts =
      auxiliary_conflicts(deep, 0, Clamping::chuck, assign(p).setups[0]);
  EXPECT_TRUE(std::any_of(conflicts.begin(), conflicts.end(), [](const Conflict& c) {
    return c.limit == "stable depth with its margin";
  }));
}

TEST(Milled, WiderMarginsNeverCostLess) {
  double before = 0;
  for (const double margin : {0.0, 0.2, 0.5}) {
    auto place = keyway();
    place["stability_margin"] = margin;
    const auto work = work_of(part(milled_pin(place)));
    const auto* o = milled_in(work);
    ASSERT_NE(o, nullptr);
    EXPECT_GE(o->cost, before * (1 - 1e-6));
    EXPECT_GE(o->milled->limit_mm, o->passes[0].ap_mm * (1 + margin) * (1 - 1e-9));
    before = o->cost;
  }
}

// Whatever is drawn: an operation that keeps its limits, or a conflict; never NaN.
TEST(Milled, AnyPlaceIsAnsweredOrRefused) {
  std::mt19937_64 draw(11);
  std::uniform_real_distribution<double> u(0, 1);
  const char* const materials[] = {"C45", "AlMgSi", "X5CrNi18-10", "Ti-6Al-4V"};
  int planned = 0, refused = 0;
  for (int k = 0; k < 6; ++k) {
    const double D = 12 + 60 * u(draw), width = 3 + 14 * u(draw);
    const char* const kind = k % 3 == 0 ? "keyway" : k % 3 == 1 ? "flat" : "slot";
    json place{{"id", "m"},
               {"kind", kind},
               {"on", "d1"},
               {"z_mm", k % 3 == 2 ? 50 : 20 + 20 * u(draw)},
               {"length_mm", k % 3 == 2 ? 30 : 6 + 30 * u(draw)},
               {"depth_mm", 0.2 + 0.3 * D * u(draw)},
               {"stability_margin", 1.5 * u(draw)},
               {"speed_margin", 0.01 + 0.05 * u(draw)}};
    if (k % 3 != 1) place["width_mm"] = width;
    auto j = milled_pin(place, D);
    j.erase("tools");
    j["material"] = materials[k % 4];
    try {
      const auto p = part(j);
      const auto work = work_of(p);
      const auto* o = milled_in(work);
      EXPECT_EQ(o == nullptr, !work.conflicts.empty());
      (o ? planned : refused)++;
      if (!o) continue;
      for (const auto& c : o->constraints) EXPECT_GE(c.margin, -1e-9) << j << c.name;
      EXPECT_GT(o->cost, 0);
      EXPECT_LE(o->certificate.gap, 1e-3) << j;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(planned, 0);
  EXPECT_EQ(planned + refused, 6);
}

}  // namespace
}  // namespace turnwright::planning
