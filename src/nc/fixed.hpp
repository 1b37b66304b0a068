#pragma once
#include <cstddef>

#include "site.hpp"

namespace turnwright::nc {

/// Ways of an operation at fixed conditions; what cannot be programmed goes to
/// `site.cannot`.
void fixed(Site& site, std::size_t operation);

/// What the operation's tool is for.
catalogue::FixedUse use_of(const Site& site, const planning::OperationPlan& operation);

}  // namespace turnwright::nc
