#include "stack.hpp"

#include <algorithm>

namespace turnwright::report {

Stack stack(double width_um, double margin_um, int ends, const Shares& shares) {
  Stack s;
  double cut = 0, others = 0;
  bool made = false;
  for (const auto& [source, um] : shares) {
    const bool deflection = source == "deflection";
    made = made || deflection;
    (deflection ? cut : others) += um;
  }
  s.left_um = made ? ends * margin_um : width_um - others;
  const double factor = made && others > 0 ? (width_um - cut - s.left_um) / others : 1;
  for (const auto& [source, um] : shares)
    s.slices.emplace_back(source, source == "deflection" ? um : factor * um);
  return s;
}

std::vector<std::string> sources(const std::vector<Stack>& stacks) {
  std::vector<std::string> all;
  for (const auto& s : stacks)
    for (const auto& [source, um] : s.slices)
      if (um > 0 && std::find(all.begin(), all.end(), source) == all.end())
        all.push_back(source);
  return all;
}

}  // namespace turnwright::report
