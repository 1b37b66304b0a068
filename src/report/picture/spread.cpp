#include "spread.hpp"

#include <algorithm>

namespace turnwright::report {

std::vector<double> spread(std::vector<double> places, double gap, double least,
                           double most) {
  for (auto& place : places) least = (place = std::max(place, least)) + gap;
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    most = (*place = std::min(*place, most)) - gap;
  return places;
}

}  // namespace turnwright::report
