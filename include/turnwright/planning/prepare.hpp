#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

/// From a request to what follows from it.
namespace turnwright::planning {

/// Everything that follows from a request: the PreparedPart.
PreparedPart prepare(PlanRequest request);

/// Prepares a request that differs from that of `like` only in numbers that move no
/// surface: limits of tolerances, roughness, machine, tools and operations, prices, the
/// objective. The machine's shares and the ways of milling, which take long to compute,
/// are copied from `like`.
PreparedPart prepare(PlanRequest request, const PreparedPart& like);

/// Whether a request may have plans that differ by PlanRequest::face_edges_in_stock.
bool has_edges_in_stock(PlanRequest request);

/// The part with edges in stock faced where it has them not, and not where it has; none if
/// it has no such edges.
std::optional<PreparedPart> faced_otherwise(const PreparedPart& part);

/// Surfaces, chamfers, undercuts and centre holes that no setup of a request makes, in
/// grips that help where they are left open: a sentence for each.
std::vector<std::string> not_made(PlanRequest request);

}  // namespace turnwright::planning
