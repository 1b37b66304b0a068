#pragma once
#include <span>
#include <vector>

#include "turnwright/part/shaft.hpp"

namespace turnwright::deflection {

enum class Method { chuck, between_centres, chuck_tailstock };

/// Compliance of the root S = [[c0, c1], [c1, c2]] (seed Eqs. 3, 4): deflection and
/// rotation at z = 0 per unit force and couple there.
struct Root {
  double c0_mm_N = 0, c1_rad_N = 0, c2_rad_Nmm = 0;
};

/// Supports in one plane (radial or tangential); zeros are rigid.
struct Supports {
  Method method = Method::chuck;
  Root root;               ///< chuck and chuck-tailstock
  double head_mm_N = 0;    ///< headstock centre, between centres
  double tail_mm_N = 0;    ///< tail centre
};

/// What one newton and one newton-millimetre at z = a do to the section there.
struct Flexibility {
  double f_ww_mm_N = 0;     ///< deflection per unit force
  double f_wp_rad_N = 0;    ///< rotation per unit force = deflection per unit couple
  double f_pp_rad_Nmm = 0;  ///< rotation per unit couple
  double tail_per_N = 0;    ///< tail centre's reaction per unit force, against it
  double tail_per_Nmm = 0;  ///< and per unit couple
};

/// The beam of a part: prefix sums once, then every position in O(1).
class Beam {
 public:
  /// @throws std::domain_error on lengths or diameters that are no body, E or nu not
  /// physical (E > 0, 0 <= nu < 0.5).
  explicit Beam(const part::Shaft& shaft);

  double length_mm() const noexcept;

  /// Flexibility at a [mm], 0 <= a <= L.  @throws std::domain_error outside.
  Flexibility at(double a_mm, const Supports& supports) const;

 private:
  // filled by the implementation: cumulative moments from the chuck, with local origin
};

}  // namespace turnwright::deflection
