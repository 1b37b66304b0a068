#pragma once
#include <nlohmann/json.hpp>

#include "document/json/reader.hpp"
#include "turnwright/tolerance/budget.hpp"

/// The member "budget" of a tolerance's case and of its result.
namespace turnwright::document {

/// Sources, required conformance, measuring uncertainty, seed and number of draws.
tolerance::BudgetDemand read_budget(Reader r);

/// A range without a lower end has null in its place; "index" is null if the sum of the
/// sources does not spread.
nlohmann::json to_json(const tolerance::Budget& budget);

}  // namespace turnwright::document
