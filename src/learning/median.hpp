#pragma once
#include <algorithm>
#include <vector>

namespace turnwright::learning {

/// Of one value at least; the mean of both middle ones of an even number.
inline double median(std::vector<double> x) {
  const auto middle = x.begin() + std::ssize(x) / 2;
  std::ranges::nth_element(x, middle);
  if (x.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(x.begin(), middle)) / 2;
}

}  // namespace turnwright::learning
