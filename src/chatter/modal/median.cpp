#include "median.hpp"

#include <algorithm>
#include <iterator>

namespace turnwright::chatter {

double median(std::vector<double> all) {
  if (all.empty()) return 0;
  const auto middle = all.begin() + std::ssize(all) / 2;
  std::ranges::nth_element(all, middle);
  return *middle;
}

}  // namespace turnwright::chatter
