#pragma once
#include <vector>

#include "feature.hpp"

/// A tolerance is a semi-infinite constraint: one inequality for every position on the
/// surface.
namespace turnwright::planning {

/// The exchange (cutting-point) method for such constraints: the positions at which the
/// tolerances are imposed so far.  The most violated positions are added until none is
/// violated.
/// Source: [Blankenship 1976], the method; the choice of positions derived here.
class Exchange {
 public:
  Exchange(const Feature& feature, std::vector<Demand> demands);

  const std::vector<double>& stations() const { return stations_; }
  const std::vector<Functional>& functionals() const { return functionals_; }

  /// Imposes every tolerance at its first positions: the ends and the middle.
  void add_all();

  /// Adds the most violated positions of every tolerance that the deflection under these
  /// conditions violates by more than the optimiser's own tolerance (5e-10 of the limit),
  /// together with the tolerance's first positions; returns false if none is violated.  A
  /// tolerance that is never violated is imposed nowhere and costs nothing.
  bool add_violated(const Recipe& recipe, const Economy& economy,
                    const Choice<double>& choice);

 private:
  std::size_t station(double at_mm);
  using Terms = std::vector<std::pair<double, double>>;  // position, weight
  void add(const Terms& terms, double limit, const Demand& d);
  void add_first(std::size_t demand);

  const Feature* feature_;
  std::vector<Demand> demands_;
  std::vector<bool> asked_;  // per demand
  std::vector<double> stations_;
  std::vector<Functional> functionals_;
};

}  // namespace turnwright::planning
