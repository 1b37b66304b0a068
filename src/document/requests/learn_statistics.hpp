#pragma once
#include <optional>
#include <vector>

#include "learn_request.hpp"
#include "turnwright/learning/mixups.hpp"
#include "turnwright/learning/trend.hpp"

namespace turnwright::document::measured_parts {

/// One characteristic on its way through the capability.
struct Learned {
  MadeSeries made;
  std::vector<std::size_t> left_out;  ///< of the series
  learning::Series kept;
  std::optional<learning::MixUp> all;  ///< the whole series is one
  std::optional<learning::Trend> trend;
};

Learned learned(const Request& request, std::size_t characteristic);

}  // namespace turnwright::document::measured_parts
