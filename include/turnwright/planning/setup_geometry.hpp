#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "turnwright/deflection/beam.hpp"
#include "turnwright/part/shaft.hpp"
#include "turnwright/planning/part_plan.hpp"

/// Which setup cuts what, and the body that stands in the machine while it does.
namespace turnwright::planning {

/// What a setup cuts: elements in the order of the tool, from the free end inwards.
struct SetupWork {
  std::vector<std::size_t> elements;  ///< indices into drawing.outer
  bool end_face = false;              ///< the face of the free end
  std::vector<std::size_t>
      shoulders;  ///< element k: the face "k-1|k", where the drawing asks
};

struct Assignment {
  std::vector<SetupWork> setups;
  std::vector<std::string>
      unreachable;  ///< one sentence per element or face nobody can cut
};

/// Gives every element to the first setup that can cut it: it lies outside the jaws and
/// nothing between it and the free end is larger than it.  An end face goes to the first
/// setup whose free end it is, if the stock leaves material there; a shoulder to the
/// setup of its larger element, if a face, tolerance or roughness of the drawing names
/// it.
Assignment assign(const PartPlan& plan);

/// z of the jaws' end (between centres: of the held end) in part coordinates.
double root_z_mm(const PartPlan& plan, std::size_t setup, Clamping clamping);
/// z of the free end once this setup has faced it.
double free_z_mm(const PartPlan& plan, std::size_t setup);

/// Diameter [mm] the jaws close on, 0 between centres.
double grip_diameter_mm(const PartPlan& plan, std::size_t setup, Clamping clamping);

/// The body from the root to the free end.  `finished` says per outer element whether it
/// has its final diameters; the others are stock.  The end at the root is as the setups
/// before left it.
class SetupBody {
 public:
  SetupBody(const PartPlan& plan, std::size_t setup, Clamping clamping,
            const std::vector<bool>& finished);

  /// Distance from the root [mm], of a z of the part.
  double x_mm(double z_mm) const { return sign_ * (z_mm - root_z_); }
  double length_mm() const { return length_; }

  /// The body with radius offsets [mm] on all of one outer element: what a pass leaves.
  part::Shaft shaft(std::size_t element, double offset_mm) const;
  /// The body as `finished` says.
  part::Shaft shaft() const;

 private:
  struct Zone {
    double z0, z1, d0, d1;  // left and right end and the diameters there
    std::size_t element;
  };
  const PartPlan* plan_;
  double root_z_, sign_, length_;
  std::vector<Zone> zones_;
};

/// Supports of the radial and the tangential plane of a clamping on a lathe.
struct Planes {
  deflection::Supports radial, tangential;
};
Planes planes(const catalogue::Lathe& machine, Clamping clamping);

}  // namespace turnwright::planning
