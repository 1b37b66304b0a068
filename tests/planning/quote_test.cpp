// Unit prices of batches.
#include "turnwright/planning/quote.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "parts.hpp"
#include "turnwright/planning/choice.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

const std::vector<double> kBatches{1, 10, 100, 1000};

PreparedPart small_pin(const std::string& machine, double diameter_mm, int batch) {
  auto d = pin();
  d["machine"] = machine;
  d["rates"].erase("machine_per_min");
  d["stock"]["diameter_mm"] = diameter_mm;
  d["batch"] = batch;
  d["budget"] = no_shop_errors();
  return part(d);
}

void leave(const PreparedPart&, ProcessPlan&) {}

// Four lathes would plan for long: two, and three bars, whose price grows with their mass.
TEST(Quote, IsTheCheapestOfSeparatePlansOfEachBatch) {
  const StockPrice stock{.per_kg = 1.7, .kerf_mm = 3};
  std::vector<Candidate> candidates;
  for (const char* machine : {"lathe-small", "lathe-medium"})
    for (const double diameter : {42.0, 45.0, 50.0})
      candidates.push_back({machine, small_pin(machine, diameter, 7)});
  const auto plans = judged_plans(candidates, leave);
  std::vector<Offer> offers;
  for (std::size_t i = 0; i < plans.size(); ++i)
    offers.push_back(
        {&candidates[i].part, &plans[i], piece_price(candidates[i].part, stock)});
  const auto prices = unit_prices(offers, kBatches, {.scrap = false});
  ASSERT_EQ(prices.size(), kBatches.size());
  for (const auto& u : prices) {
    double least = INFINITY;
    for (auto c : candidates) {
      c.part.batch = u.batch;
      c.part.stock_price = piece_price(c.part, stock);
      const auto separate = plan(c.part);
      ASSERT_EQ(separate.status, PlanStatus::ok);
      least = std::min(least, separate.cost_per_part);
    }
    EXPECT_NEAR(u.price, least, 1e-6 * least) << u.batch;
    EXPECT_LE(u.lower_bound, least);
    EXPECT_GT(u.lower_bound, 0.999 * least);
  }
}

ToleranceResult kept(double P) {
  ToleranceResult t;
  t.P_conform = P;
  return t;
}

// A plan of made-up numbers.
ProcessPlan made_up(double run, double setting_up, double stock, double P = 1) {
  ProcessPlan p;
  p.breakdown.stock.cost = stock;
  p.breakdown.setup_share = {20, setting_up};  // batch of one
  p.setting_up.minutes = 20;
  p.setting_up.cost = setting_up;
  p.cost_per_part = run + setting_up + stock;
  p.time_per_part_min = 5 + 20;
  p.certificate.gap = 0.01;
  if (P < 1) p.tolerances.push_back(kept(P));
  return p;
}

TEST(Quote, ChangesItsWayWhereBatchesGrow) {
  const auto simple = made_up(4, 10, 1), quick = made_up(3, 60, 1);
  const std::vector<Offer> offers{{nullptr, &simple}, {nullptr, &quick}};
  const std::vector<double> batches{1, 49, 51, 1000};  // even at 50
  const auto prices = unit_prices(offers, batches, {});
  EXPECT_EQ(prices[0].offer, 0U);
  EXPECT_EQ(prices[1].offer, 0U);
  EXPECT_EQ(prices[2].offer, 1U);
  EXPECT_EQ(prices[3].offer, 1U);
  EXPECT_NEAR(prices[3].price, 4.06, 1e-12);
  EXPECT_NEAR(prices[3].time_min, 5 + 20.0 / 1000, 1e-12);
}

TEST(Quote, AddsWhatAPlanDoesNotContain) {
  const auto plan = made_up(4, 10, 1, 0.98);
  const std::vector<Offer> offers{{nullptr, &plan, 0.5}};
  const std::vector<double> one{10};
  const Charges charges{.setter_per_min = 0.8, .overhead = 0.15, .margin = 0.1};
  const auto u = unit_prices(offers, one, charges).at(0);
  EXPECT_NEAR(u.stock, 1.5, 1e-12);
  EXPECT_NEAR(u.run, 4, 1e-12);
  EXPECT_NEAR(u.setting_up, 1.6, 1e-12);
  EXPECT_NEAR(u.scrap, 7.1 / 0.98 - 7.1, 1e-12);
  EXPECT_NEAR(u.overhead, 0.15 * 7.1 / 0.98, 1e-12);
  EXPECT_NEAR(u.price, 7.1 / 0.98 * 1.15 / 0.9, 1e-12);
  EXPECT_NEAR(u.margin, 0.1 * u.price, 1e-12);
  EXPECT_NEAR(u.price, u.stock + u.run + u.setting_up + u.scrap + u.overhead + u.margin,
              1e-12);
  EXPECT_NEAR(u.lower_bound, 7.1 - 0.01 * 15, 1e-12);
}

TEST(Quote, PartsOfWhichNoneIsSureToConformAreNotQuoted) {
  auto plan = made_up(4, 10, 1, 0.5);
  plan.tolerances.push_back(kept(0.5));
  const std::vector<Offer> offers{{nullptr, &plan}};
  EXPECT_EQ(all_conform(plan), 0);
  EXPECT_TRUE(unit_prices(offers, kBatches, {}).empty());
  EXPECT_EQ(unit_prices(offers, kBatches, {.scrap = false}).size(), 4U);
  plan.status = PlanStatus::infeasible;
  EXPECT_TRUE(unit_prices(offers, kBatches, {.scrap = false}).empty());
}

// Whatever depends on what: of parts drawn so that failures exclude each other the bound is
// exact, of independent ones it is below the share.
TEST(Quote, TheShareThatConformsIsABound) {
  ProcessPlan p;
  for (const double P : {0.99, 0.97, 0.995}) p.tolerances.push_back(kept(P));
  EXPECT_NEAR(all_conform(p), 1 - 0.01 - 0.03 - 0.005, 1e-15);
  EXPECT_LT(all_conform(p), 0.99 * 0.97 * 0.995);
}

TEST(Quote, StockIsPaidByWeightOrByTheBar) {
  auto p = part(pin());  // a bar of 42 mm, 92 mm long, of C45
  const double kg = M_PI / 4 * 42 * 42 * 92 * 1e-9 * p.material.rho_kg_m3;
  EXPECT_NEAR(stock_mass_kg(p), kg, 1e-12);
  EXPECT_NEAR(piece_price(p, {.per_kg = 2, .kerf_mm = 8}), 2 * kg * 100 / 92, 1e-12);
  StockPrice bar{.per_bar = 60, .bar_length_mm = 3000, .kerf_mm = 3, .remnant_mm = 150};
  EXPECT_EQ(pieces_of_bar(p, bar), 30);  // 2850/95
  EXPECT_NEAR(piece_price(p, bar), 2, 1e-12);
  bar.remnant_mm = 150.001;
  EXPECT_EQ(pieces_of_bar(p, bar), 29);
  bar.bar_length_mm = 240;
  EXPECT_EQ(pieces_of_bar(p, bar), 0);
  EXPECT_THROW(piece_price(p, bar), std::domain_error);
  EXPECT_EQ(piece_price(p, {}), 0);
  p.drawing.stock.inner_mm = 20;
  EXPECT_NEAR(stock_mass_kg(p), kg * (1 - 400.0 / (42 * 42)), 1e-12);
}

// Of 24 mm over 80 mm and 36 mm over 12 mm.
TEST(Quote, CastingsAndForgingsArePaidByWeightWithoutAKerf) {
  auto p = part(pin());
  p.drawing.stock.outline = {{80, 24, 24}, {12, 36, 36}};
  const double kg =
      M_PI / 4 * (24 * 24 * 80 + 36 * 36 * 12) * 1e-9 * p.material.rho_kg_m3;
  EXPECT_NEAR(piece_price(p, {.per_kg = 2, .kerf_mm = 8}), 2 * kg, 1e-12);
  const StockPrice bar{.per_bar = 60, .bar_length_mm = 3000};
  EXPECT_EQ(pieces_of_bar(p, bar), 0);
  EXPECT_THROW(piece_price(p, bar), std::domain_error);
}

TEST(Quote, EnergyIsThatOfTheCutsAndOfTheIdlingMachine) {
  auto p = part(pin());
  const auto plan = turnwright::planning::plan(p);
  const double idle = energy_kWh(p, plan, 1.5) - energy_kWh(p, plan, 0);
  EXPECT_NEAR(idle,
              1.5 * (plan.time_per_part_min - plan.breakdown.setup_share.time_min) / 60,
              1e-12);
  double kW_min = 0;
  for (const auto& s : plan.setups)
    for (const auto& o : s.operations)
      if (o.kind == OperationKind::rough) kW_min += o.passes[0].Pc_kW * o.time_min;
  EXPECT_GT(energy_kWh(p, plan, 0), kW_min / p.machine.efficiency / 60);
  p.machine.efficiency /= 2;
  EXPECT_NEAR(energy_kWh(p, plan, 0), 2 * energy_kWh(part(pin()), plan, 0), 1e-12);
}

}  // namespace
}  // namespace turnwright::planning
