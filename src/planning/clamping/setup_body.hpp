#pragma once
#include <vector>

#include "made_surfaces.hpp"
#include "turnwright/part/shaft.hpp"

/// The body that a setup holds while it cuts.
namespace turnwright::planning {

/// The part from its root, where the jaws end (between centres: the end at the headstock),
/// to the free end.  The held end is as the setups before have left it.
class SetupBody {
 public:
  SetupBody(const PreparedPart& plan, std::size_t setup, Clamping clamping,
            const Finished& finished);

  /// Distance from the root [mm], of a z of the part.
  double x_mm(double z_mm) const { return sign_ * (z_mm - root_z_); }
  double length_mm() const { return length_; }

  /// The body with material of this thickness [mm] on one whole element, as a pass leaves
  /// it.  A hole is never narrower than that of the stock.
  part::Shaft shaft(const Element& element, double left_mm) const;
  /// The body with the elements of `finished`; one with a groove, thread or arc counts as
  /// its core, a hole that will be drilled as drilled.
  part::Shaft shaft() const;

 private:
  struct Zone {
    double z0, z1, d0, d1;  // left and right end and the diameters there
  };
  part::Shaft shaft(const std::vector<Zone>& outer, const std::vector<Zone>& inner) const;

  const PreparedPart* part_;
  double root_z_, sign_, length_;
  std::vector<Zone> outer_, inner_;  // one per element, then the stock beside them
};

}  // namespace turnwright::planning
