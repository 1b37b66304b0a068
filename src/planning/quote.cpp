#include "turnwright/planning/quote.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

double mass_kg(const PlanRequest& r, double length_mm) {
  constexpr double kCubicMetres = 1e-9;
  return part::section_mm2(r.drawing.stock) * length_mm * kCubicMetres *
         r.material.rho_kg_m3;
}

// What an offer costs apart from its batch, and once for each.
struct Costs {
  double stock = 0, run = 0, setting_up = 0, run_min = 0;
  double unproven = 0;  // its cost less what is proved to be needed
  double total(double batch) const { return stock + run + setting_up / batch; }
};

Costs costs(const Offer& offer, const Charges& charges) {
  const auto& p = *offer.plan;
  Costs c;
  c.stock = p.breakdown.stock.cost + offer.stock_price;
  c.run = p.cost_per_part - p.breakdown.stock.cost - p.breakdown.setup_share.cost;
  c.run_min = p.time_per_part_min - p.breakdown.setup_share.time_min;
  c.setting_up = charges.setter_per_min ? *charges.setter_per_min * p.setting_up.minutes
                                        : p.setting_up.cost;
  c.unproven = p.cost_per_part * p.certificate.gap;
  return c;
}

}  // namespace

double stock_mass_kg(const PlanRequest& r) {
  return mass_kg(r, r.drawing.stock.length_mm);
}

long pieces_of_bar(const PlanRequest& r, const StockPrice& price) {
  if (!r.drawing.stock.outline.empty()) return 0;
  const double piece = r.drawing.stock.length_mm + price.kerf_mm;
  const double usable = price.bar_length_mm - price.remnant_mm;
  return usable > 0 ? static_cast<long>(std::floor(usable / piece * (1 + 1e-12))) : 0;
}

double piece_price(const PlanRequest& r, const StockPrice& price) {
  const auto& stock = r.drawing.stock;
  if (price.per_kg)  // castings and forgings are not cut off
    return *price.per_kg *
           mass_kg(r, stock.length_mm + (stock.outline.empty() ? price.kerf_mm : 0));
  if (!price.per_bar) return 0;
  const long pieces = pieces_of_bar(r, price);
  if (pieces < 1) throw std::domain_error("piece_price: the bar gives no piece");
  return *price.per_bar / static_cast<double>(pieces);
}

double all_conform(const ProcessPlan& plan) {
  double fails = 0;
  for (const auto& t : plan.tolerances) fails += 1 - t.P_conform;
  return std::max(0.0, 1 - fails);
}

double energy_kWh(const PlanRequest& r, const ProcessPlan& plan, double idle_kW) {
  double kW_min =
      idle_kW * (plan.time_per_part_min - plan.breakdown.setup_share.time_min);
  for (const auto& setup : plan.setups)
    for (const auto& o : setup.operations) {
      double passes_min = 0, passes_kW_min = 0;
      for (const auto& pass : o.passes) {
        passes_min += pass.time_min;
        passes_kW_min += pass.Pc_kW * pass.time_min;
      }
      if (passes_min > 0)
        kW_min += passes_kW_min / passes_min * o.time_min / r.machine.efficiency;
    }
  return kW_min / 60;
}

std::vector<UnitPrice> unit_prices(std::span<const Offer> offers,
                                   std::span<const double> batches,
                                   const Charges& charges) {
  std::vector<UnitPrice> all;
  for (const double batch : batches) {
    UnitPrice best;
    double least = std::numeric_limits<double>::infinity();
    double bound = least;
    for (std::size_t i = 0; i < offers.size(); ++i) {
      const auto& plan = *offers[i].plan;
      const double P = charges.scrap ? all_conform(plan) : 1;
      if (plan.status != PlanStatus::ok || !(P > 0)) continue;
      const auto c = costs(offers[i], charges);
      bound = std::min(bound, c.total(batch) - c.unproven);
      if (!(c.total(batch) < least)) continue;
      least = c.total(batch);
      const double minutes = plan.setting_up.minutes / batch;
      best = {.batch = batch,
              .offer = i,
              .stock = c.stock,
              .run = c.run,
              .setting_up = c.setting_up / batch,
              .scrap = least / P - least,
              .time_min = c.run_min + minutes};
    }
    if (!std::isfinite(least)) return {};
    best.overhead = (least + best.scrap) * charges.overhead;
    const double cost = least + best.scrap + best.overhead;
    best.price = cost / (1 - charges.margin);
    best.margin = best.price - cost;
    best.lower_bound = bound;
    all.push_back(best);
  }
  return all;
}

}  // namespace turnwright::planning
