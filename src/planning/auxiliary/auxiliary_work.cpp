#include "auxiliary_work.hpp"

namespace turnwright::planning {

std::vector<AuxiliaryOperation> AuxiliaryWork::all() const {
  auto both = before;
  both.insert(both.end(), after.begin(), after.end());
  return both;
}

double AuxiliaryWork::minutes() const {
  double sum = 0;
  for (const auto& o : all()) sum += o.minutes();
  return sum;
}

double AuxiliaryWork::edges_cost() const {
  double sum = 0;
  for (const auto& o : all()) sum += o.edges_cost;
  return sum;
}

double AuxiliaryWork::open() const {
  double sum = 0;
  for (const auto& o : all()) sum += o.open;
  return sum;
}

}  // namespace turnwright::planning
