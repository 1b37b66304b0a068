#pragma once
#include <vector>

namespace turnwright::thermal {

/// Rows of a log or of a plan, at rising times.  The spindle keeps rpm[i] from time_s[i]
/// to time_s[i + 1]; the ambient temperature is linear between the rows.
struct Inputs {
  std::vector<double> time_s, rpm, ambient_degC;
};

}  // namespace turnwright::thermal
