#include "turnwright/planning/process_plan.hpp"

#include <algorithm>

namespace turnwright::planning {

Breakdown& Breakdown::operator+=(const Breakdown& other) {
  for (const auto share : kSpendings) this->*share += other.*share;
  return *this;
}

Spending Breakdown::total() const {
  Spending sum;
  for (const auto share : kSpendings) sum += this->*share;
  return sum;
}

double interpolated(const Compensation::Table& table, double at) {
  std::size_t k = 0;
  while (k + 2 < table.size() && at > table[k + 1].first) ++k;
  const auto& [z0, dr0] = table[k];
  const auto& [z1, dr1] = table[k + 1];
  return dr0 + (dr1 - dr0) * (std::clamp(at, z0, z1) - z0) / (z1 - z0);
}

}  // namespace turnwright::planning
