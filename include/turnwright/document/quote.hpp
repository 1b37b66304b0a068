#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "turnwright/document/prepared_part.hpp"
#include "turnwright/planning/quote.hpp"

/// Quotes: unit prices of parts in batches.
namespace turnwright::document {

/// The request of `quote` (schemas/quote.request.json).
struct QuoteRequest {
  std::vector<Candidates> parts;  ///< one at least
  std::vector<double> batches;
  std::string currency;  ///< as the request names it; empty: not named
  planning::Charges charges;
  planning::StockPrice stock;
  double idle_kW = 0;
  double kg_CO2_per_kWh = 0;
};

/// @throws InputError with every problem, those of the parts below "/parts/N".
QuoteRequest load_quote(const nlohmann::json& json, const Catalogue& catalogue);

/// The result of `quote` (schemas/quote.result.json) from the plans of each part's
/// candidates, in their order.
nlohmann::ordered_json quote_result(
    const QuoteRequest& request,
    const std::vector<std::vector<planning::ProcessPlan>>& plans);

}  // namespace turnwright::document
