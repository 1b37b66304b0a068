#pragma once
#include <vector>

#include "feature.hpp"

/// The places where tolerances are asked, grown until they stand for the whole surface.
namespace turnwright::planning {

class Exchange {
 public:
  Exchange(const Feature& feature, std::vector<Demand> demands);

  const std::vector<double>& stations() const { return stations_; }
  const std::vector<Functional>& functionals() const { return functionals_; }

  /// Asks every demand at its first places: the ends, the middle.
  void add_all();

  /// Adds the worst places of every demand that an error breaks by more than the
  /// optimiser leaves (5e-10 of its limit), and its first places with them; false if none
  /// does.  A demand that no error breaks is asked nowhere and costs nothing.
  bool add_violated(const Recipe& recipe, const Economy& economy,
                    const Choice<double>& choice);

 private:
  std::size_t station(double at_mm);
  using Terms = std::vector<std::pair<double, double>>;  // place, weight
  void add(const Terms& terms, double limit, const Demand& d);
  void add_first(std::size_t demand);

  const Feature* feature_;
  std::vector<Demand> demands_;
  std::vector<bool> asked_;  // per demand
  std::vector<double> stations_;
  std::vector<Functional> functionals_;
};

}  // namespace turnwright::planning
