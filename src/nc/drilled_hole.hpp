#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "turnwright/gcode/dialect.hpp"
#include "turnwright/toolpath/setup_program.hpp"

/// Holes among the moves of an operation, as the cycles of controls drill them.
namespace turnwright::nc {

using namespace toolpath;

/// A hole on the axis: at feed to each place, each time out at rapid to where the drill
/// began, and before each but the first in at rapid to before the place reached.
struct DrilledHole {
  double from_mm = 0;                  ///< place from which it is drilled
  std::vector<double> places_mm = {};  ///< ends of the pecks, falling, the bottom last
  double back_mm = 0;                  ///< before the place reached, where feed begins

  double bottom_mm() const { return places_mm.back(); }
  double first_mm() const { return from_mm - places_mm.front(); }
  /// Length of the pecks behind the first; 0 if there are none.
  double step_mm() const;
  /// Whether the pecks follow a law of gcode/dialect.hpp, within 1e-6 mm.
  bool pecked_as(gcode::PeckLaw law) const;
  std::vector<Move> moves() const;
};

/// The hole that the moves from the k-th drill; none if they drill no hole.
std::optional<DrilledHole> drilled_hole(const std::vector<Move>& moves, std::size_t k);

/// The hole with pecks of one length, the first too, counted from where the drill begins:
/// the fewest of which none is longer than `pecks` allows.
DrilledHole with_equal_pecks(const DrilledHole& hole, const Pecks& pecks, double back_mm);

}  // namespace turnwright::nc
