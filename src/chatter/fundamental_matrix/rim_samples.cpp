#include "rim_samples.hpp"

#include <algorithm>

#include "turnwright/base/units.hpp"

namespace turnwright::chatter {

std::vector<std::complex<double>> unit_roots(std::size_t n) {
  std::vector<std::complex<double>> all;
  for (std::size_t k = 0; k < n; ++k)
    all.push_back(std::polar(
        1.0, 2 * units::kPi * static_cast<double>(k) / static_cast<double>(n)));
  return all;
}

std::optional<Resolved> resolved(std::span<const double> size) {
  constexpr double kTail = 1e-13;   // of the series, relative to its largest term
  constexpr double kFloor = 1e-10;  // the same, where rounding ends the descent
  const double largest = *std::ranges::max_element(size);
  if (!(largest < 1e300)) return std::nullopt;
  // If the series has decayed before, the last quarter of its terms is rounding.
  const auto rest = size.last(size.size() / 4);
  const double floor = *std::ranges::max_element(rest);
  if (!(floor < kFloor * largest)) return std::nullopt;
  std::size_t terms = size.size();
  double tail = 0;
  while (terms > 3 && size[terms - 1] <= std::max(kTail * largest, 2 * floor))
    tail += size[--terms];
  return Resolved{
      terms, 2 * tail + static_cast<double>(size.size()) * floor + kRounding * largest};
}

}  // namespace turnwright::chatter
