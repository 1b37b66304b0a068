#pragma once
#include <vector>

#include "machined_surface.hpp"

/// A tolerance is a semi-infinite constraint: one inequality for every position on the
/// surface.
namespace turnwright::planning {

/// The exchange (cutting-point) method for such constraints: the positions at which the
/// tolerances are imposed so far.  The most violated positions are added until none is
/// violated.
/// Source: [Blankenship 1976], the method; the choice of positions derived here.
class TolerancePoints {
 public:
  TolerancePoints(const MachinedSurface& feature,
                  std::vector<CutTolerance> cut_tolerances);

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
  void add(const Terms& terms, double limit, const CutTolerance& d);
  void add_first(std::size_t cut_tolerance);

  const MachinedSurface* feature_;
  std::vector<CutTolerance> cut_tolerances_;
  std::vector<bool> asked_;  // per cut tolerance
  std::vector<double> stations_;
  std::vector<Functional> functionals_;
};

}  // namespace turnwright::planning
