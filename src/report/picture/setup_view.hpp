#pragma once
#include <cstddef>

#include "contour.hpp"
#include "svg.hpp"
#include "turnwright/planning/process_plan.hpp"

/// A setup on paper as it stands in the machine: the chuck to the left, the free end to
/// the right, whichever end of the part that is.
namespace turnwright::report {

/// Common to the pictures of a plan.
struct Scales {
  double length = 0;  ///< paper mm of a mm
  double factor = 0;  ///< an error is drawn so much larger; 0: there is none
};

struct SetupView {
  static constexpr double kWidth = 190, kJaw = 9;  ///< mm of paper: the page, a jaw

  const planning::PreparedPart& part;
  const planning::ProcessPlan& plan;
  const planning::SetupWork& work;
  std::size_t setup;
  Scales scale;
  Contour contour;
  double axis = 0;  ///< y of the centre line
  Svg svg = {};

  planning::Clamping clamping() const { return plan.setups[setup].clamping; }
  part::End held() const { return part.setups[setup].hold; }
  bool holds_left() const { return held() == part::End::left; }
  /// The program's Z: from the finished face of the free end, away from the chuck.
  double program_z(double z) const {
    return (holds_left() ? 1 : -1) * (z - planning::free_z_mm(part, setup));
  }
  double x(double z) const {
    const auto& stock = part.drawing.stock;
    const double from_chuck = holds_left()
                                  ? z + stock.left_allowance_mm
                                  : stock.length_mm - stock.left_allowance_mm - z;
    return (kWidth - scale.length * stock.length_mm) / 2 + scale.length * from_chuck;
  }
  Point at(double z, double r) const { return {x(z), axis - scale.length * r}; }
  double stock_height() const { return scale.length * part.drawing.stock.outer_mm / 2; }
  double left_z() const { return contour.outer.front().z0; }
  double right_z() const { return contour.outer.back().z1; }
};

}  // namespace turnwright::report
