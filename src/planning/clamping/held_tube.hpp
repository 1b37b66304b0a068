#pragma once
#include "turnwright/planning/prepared_part.hpp"

/// A hollow part between three jaws.
namespace turnwright::planning {

inline constexpr int kJaws = 3;
/// Of the yield strength, at most, is the stress that the jaws cause in a hollow part.
inline constexpr double kOfYield = 2.0 / 3;

/// The section between the jaws once a setup is done.
struct HeldTube {
  double outer_mm = 0, inner_mm = 0;
  bool hollow() const { return outer_mm > inner_mm && inner_mm > 0; }
  double R_mm() const { return (outer_mm + inner_mm) / 4; }
  double wall_mm() const { return (outer_mm - inner_mm) / 2; }
  double decay_1_mm() const;  ///< of its lobes, (3) of ring.hpp
  /// Length of the tube that bears a grip: a narrow one is borne by the tube beside it too,
  /// 1/2 lambda wide at its end.
  double width_mm(double grip_mm) const;
};
HeldTube held_tube(const PreparedPart& part, std::size_t setup, Clamping clamping);

/// The largest stress [MPa] in that section at a force of all jaws, (5) of ring.hpp; 0 of a
/// solid one.
double squeeze_MPa(const PreparedPart& part, std::size_t setup, Clamping clamping,
                   double force_N);

/// The largest force [N] of all jaws that strains the section to kOfYield of the yield
/// strength; infinite of a solid section, in a collet, which closes all round, and where
/// the material's document has none.
double elastic_grip_N(const PreparedPart& part, std::size_t setup, Clamping clamping);

}  // namespace turnwright::planning
