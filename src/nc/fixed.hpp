#pragma once
#include <cstddef>

#include "site.hpp"

namespace turnwright::nc {

/// Tool paths of an operation at fixed conditions; the reasons why one cannot be
/// programmed are appended to `site.cannot`.
void fixed(Site& site, std::size_t operation);

/// The use of the operation's tool.
catalogue::FixedUse use_of(const Site& site, const planning::OperationPlan& operation);

}  // namespace turnwright::nc
