#pragma once
#include <limits>
#include <vector>

#include "global_search.hpp"
#include "planning/surface/machined_surface.hpp"

/// One surface with one recipe: the cheapest conditions on shrinking lattices.
namespace turnwright::reference {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A choice, how far it is outside its limits (<= 0: inside) and what it costs.
struct Point {
  planning::Choice<double> choice;
  double excess = kInfinity, cost = kInfinity;
};

/// Feasible before infeasible, then the cheaper or the less violated.
bool better(const Point& a, const Point& b);

class SurfaceSearch {
 public:
  SurfaceSearch(const planning::MachinedSurface& feature,
                std::vector<planning::CutTolerance> cut_tolerances,
                const planning::Recipe& recipe, const planning::Economy& economy,
                const Effort& effort);

  /// False if no depth suits the tools with these passes.
  bool possible() const { return !axes_.empty(); }
  /// The best conditions with the tolerances left out.
  Point without_tolerances() const;
  /// The best conditions.
  Point best() const;
  /// Cost and worst check of given conditions, tolerances left out.
  Point at(const planning::Choice<double>& choice) const;
  /// value/limit - 1 of the worst demand with exact errors at `places` places.
  double tolerance_excess(const planning::Choice<double>& choice, int places) const;

 private:
  struct Axis {
    double low = 0, high = 0;  // logarithms
    int count = 1;
  };
  struct Lattice {
    std::vector<std::vector<double>> x;  // logarithms along a, f0, f1
  };
  struct Cell {
    std::size_t k[3];
    double cost, excess;
  };

  Point lattice_best(const Lattice& lattice, const Point& incumbent, bool tolerances,
                     bool fine, std::vector<Point>* starts) const;
  Point refine(Point p, bool tolerances) const;
  Point polish(Point p) const;
  Lattice whole() const;
  std::vector<double> spacing() const;
  Point at_best_speed(std::size_t operation, double f, double a, bool fine) const;
  Point evaluated(std::size_t operation, const planning::Choice<double>& c,
                  double& fixed_excess) const;
  double excess_of(const std::vector<double>& e, double reserve) const;
  double tolerance_excess(const planning::Choice<double>& choice) const;
  friend struct Cobyla;

  const planning::MachinedSurface* feature_;
  std::vector<planning::CutTolerance> cut_tolerances_;
  planning::Recipe recipe_;
  planning::Economy economy_;
  Effort effort_;
  planning::Chain chain_;
  std::vector<planning::Chain> single_;  // one operation each
  std::vector<Axis> axes_;               // ln a, then ln f of each operation
};

}  // namespace turnwright::reference
