#pragma once
#include <vector>

#include "turnwright/deflection/beam.hpp"

namespace turnwright::deflection {

/// Form error of a faced surface.  While it is cut, the section of the face rotates under
/// the forces, which leaves the form [mm], positive where material remains and zero at
/// the axis,
///
///     g(rho) = -f_wp Ff rho + f_pp Fp rho^2                                     (1)
///
/// with Ff the radial force (feed) and Fp the axial one, on the tool at radius rho [mm].
/// The axial compliance of the clamping adds c_ax Fp everywhere, which is an error of the
/// length and not of the form.
/// Source: derived here from the rotation f_wp Fr + f_pp C of the section.
struct FaceForm {
  double peak_to_valley_mm = 0;      ///< over [rho_min, rho_max], including the vertex
  std::vector<double> rho_mm, g_mm;  ///< 33 equidistant radii, and the vertex if inside
};

struct Facing {
  double rho_min_mm = 0, rho_max_mm = 0;
  double Ff_N = 0, Fp_N = 0;
};

/// @param radial  flexibility of the section of the face.
/// @throws std::domain_error unless 0 <= rho_min < rho_max.
FaceForm face_form(const Flexibility& radial, const Facing& facing);

}  // namespace turnwright::deflection
