#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Prices of a part in batches, from the plans of the requests that it may be made by.
///
/// A plan's conditions do not depend on the batch: preparing the machine costs the same
/// whatever is cut.  So one certified plan of each candidate serves every batch,
///
///     c(b) = stock + run + setting up/b                                              (1)
///
/// and the candidate with the least c(b) is quoted.  Of a batch as many parts more are made
/// as do not conform, P being at least 1 - sum over the tolerances of (1 - P_i), whatever
/// their dependence (Bonferroni):
///
///     cost = c/P (1 + overhead),  price = cost/(1 - margin)                          (2)
///
/// Source: elementary; each is tested against separate plans and by hand.
namespace turnwright::planning {

/// What a plan does not contain.
struct Charges {
  std::optional<double> setter_per_min =
      {};               ///< for preparing; absent: the machine's rate
  double overhead = 0;  ///< share of the cost
  double margin = 0;    ///< share of the price, below 1
  bool scrap = true;    ///< whether parts that do not conform are paid for
};

/// The price of stock by weight or by the bar.
struct StockPrice {
  std::optional<double> per_kg = {}, per_bar = {};
  double bar_length_mm = 0;            ///< of a bar as it is bought
  double kerf_mm = 0, remnant_mm = 0;  ///< of each cut; the end that is left of each bar
};

/// Mass [kg] of the piece of stock for one part, without its kerf.
double stock_mass_kg(const PlanRequest& request);

/// Pieces from a bar; 0 if it is too short for one, or they are castings or forgings.
long pieces_of_bar(const PlanRequest& request, const StockPrice& price);

/// The piece's price: of its mass with the kerf, which a casting or forging has not, or a
/// bar's share.
/// @throws std::domain_error if the bar gives no piece.
double piece_price(const PlanRequest& request, const StockPrice& price);

/// Probability with which a part keeps every tolerance, at least.
double all_conform(const ProcessPlan& plan);

/// Energy [kWh] of one part: Pc/eta of each cut while it lasts, and the machine's power
/// without a cut over the whole time of a part, setting up apart.
double energy_kWh(const PlanRequest& request, const ProcessPlan& plan, double idle_kW);

/// A candidate with its plan; the price of its stock in addition to the plan's own.
struct Offer {
  const PreparedPart* part = nullptr;
  const ProcessPlan* plan = nullptr;
  double stock_price = 0;
};

/// A price of one part, and what it consists of.
struct UnitPrice {
  double batch = 1;
  std::size_t offer = 0;  ///< the one quoted
  double stock = 0, run = 0, setting_up = 0, scrap = 0, overhead = 0, margin = 0;
  double price = 0;
  double time_min = 0;  ///< of a part, its share of setting up included
  /// stock + run + setting up of no plan of any offer is below this.
  double lower_bound = 0;
};

/// The unit price of each batch by (1) and (2); nothing for any batch if no offer is
/// feasible, or none of whose parts is sure to conform with `charges.scrap`.
std::vector<UnitPrice> unit_prices(std::span<const Offer> offers,
                                   std::span<const double> batches,
                                   const Charges& charges);

}  // namespace turnwright::planning
