#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/volumetric/kinematics.hpp"

/// From a lathe's errors to a turned part: surfaces are displaced as the machine cuts
/// them, then measured as features.  Chains hold X, Z and C; the tool stands at +X.
namespace turnwright::volumetric {

/// Straight generator of a turned surface, in the direction of the cut: a cylinder, a
/// cone or a face.  Outside surfaces; a bore's deviations are those of its radius alike.
struct Generator {
  double r_start_mm = 0, z_start_mm = 0, r_end_mm = 0, z_end_mm = 0;
  /// Signs of motion of the axis that the cut leaves at rest, from its last approach.
  double approach_x = -1, approach_z = -1;
};

/// A generator turned: what the part's surface is off its nominal place along its normal
/// [mm], positive to larger radii (cylinders, cones) and to +Z (faces).
struct Surface {
  Generator generator;
  std::vector<double> theta_rad;   ///< places around
  std::vector<double> r_mm, z_mm;  ///< along the generator
  std::vector<double> e_mm;        ///< theta by theta
  double at(std::size_t around, std::size_t along) const {
    return e_mm[around * r_mm.size() + along];
  }
};

/// The surface cut while the spindle turns forward.  At workpiece angle theta and
/// programmed (r, z) the tip leaves the radius |tip_xy| and the length tip_z there; the
/// tip's own angle matters by y^2/2R, which is kept.
/// @throws std::domain_error if the generator is a point or reaches past the axis, or
///   around < 8 or along < 2.
Surface turned(const Kinematics& machine, const Vec3& tool_point_mm,
               const Generator& generator, std::size_t around = 72,
               std::size_t along = 41);

/// A form by the surface of least squares and by the narrowest zone.
struct Form {
  double least_squares_mm = 0, minimum_zone_mm = 0;
};

/// Line through a cylinder or cone: x0 + ax z, y0 + ay z, of least squares.
struct DatumAxis {
  double x0_mm = 0, y0_mm = 0, ax = 0, ay = 0;
};

DatumAxis axis_of(const Surface& cylinder);
/// Normal of a face's plane of least squares, through the spindle's axis.
DatumAxis normal_of(const Surface& face);
double diameter_error_mm(const Surface& cylinder);  ///< of least squares
/// Diameter at the end of greater z less that at the other, of least squares.
double taper_mm(const Surface& cylinder);
Form straightness(const Surface& surface);   ///< of the worst generatrix
Form roundness(const Surface& surface);      ///< of the worst section
Form cylindricity(const Surface& cylinder);  ///< coaxial cylinders, tilt and place free
Form flatness(const Surface& face);          ///< parallel planes
/// Width of the zone about the nominal profile as it lies: twice the largest modulus.
double profile_mm(const Surface& surface);
double circular_radial_runout_mm(const Surface& surface, const DatumAxis& datum);
double total_radial_runout_mm(const Surface& surface, const DatumAxis& datum);
/// Diameter of the cylinder about the datum that holds the surface's own axis.
double coaxiality_mm(const Surface& cylinder, const DatumAxis& datum);
double circular_axial_runout_mm(const Surface& face, const DatumAxis& datum);
/// Total axial runout, and perpendicularity to the datum: planes square to it.
double perpendicularity_mm(const Surface& face, const DatumAxis& datum);
/// Planes parallel to the datum face of least squares.
double parallelism_mm(const Surface& face, const Surface& datum);
/// Mean distance of two faces less the nominal one.
double length_error_mm(const Surface& left, const Surface& right);

/// One source of error: what one unit of it does to the surface, and its standard
/// deviation and bound in such units.
struct FormSource {
  std::vector<double> field_mm;
  double u = 0;
  double bound = 0;
};

struct FormDistribution {
  double median_mm = 0, p95_mm = 0;
  double worst_mm = 0;  ///< sum of bounds, the cap of both
};

/// Distribution of the range of sum_i x_i field_i with x_i normal, standard deviation
/// u_i. Of a form by least squares the fields are what its surface leaves of them
/// (projected once; least squares is linear).  Ranges are neither additive nor normal:
/// the root of squares is off by -8 to +22 % of them.
/// @throws std::domain_error if fields differ in length or there are no draws.
FormDistribution form_distribution(std::span<const FormSource> sources, std::size_t draws,
                                   std::uint64_t seed);

/// What the cylinder of least squares leaves of a surface, for form_distribution.
std::vector<double> cylinder_residual_mm(const Surface& cylinder);

}  // namespace turnwright::volumetric
