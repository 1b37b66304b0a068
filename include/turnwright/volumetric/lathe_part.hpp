#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "turnwright/volumetric/kinematics.hpp"

/// From a lathe's geometric errors to the errors of a turned part.  Surfaces are
/// displaced as the machine cuts them, and then measured as a tolerance prescribes.
/// Chains hold X, Z and C; the tool stands at +X.
namespace turnwright::volumetric {

/// Straight generator of a turned surface (cylinder, cone or face) in the direction of
/// the cut.  The formulas are those of outside surfaces; in a bore the deviations of the
/// radius are the same.
struct Generator {
  double r_start_mm = 0, z_start_mm = 0, r_end_mm = 0, z_end_mm = 0;
  /// Signs of the last motion of an axis that is at rest during the cut.
  double approach_x = -1, approach_z = -1;
};

/// A turned surface: the deviation from its nominal position along its normal [mm],
/// positive towards larger radii (cylinders, cones) and towards +Z (faces).
struct Surface {
  Generator generator;
  std::vector<double> theta_rad;   ///< angles of the points
  std::vector<double> r_mm, z_mm;  ///< points along the generator
  std::vector<double> e_mm;        ///< deviations, all points of one angle together
  double at(std::size_t around, std::size_t along) const {
    return e_mm[around * r_mm.size() + along];
  }
};

/// The surface that is cut while the spindle turns forward.  At the workpiece angle theta
/// and programmed (r, z) the tip generates the radius |tip_xy| and the length tip_z.  The
/// tangential position of the tip acts by y^2/2R, which is included.
/// @throws std::domain_error if the generator is a point or reaches past the axis, or
///   around < 8 or along < 2.
Surface turned(const Kinematics& machine, const Vec3& tool_point_mm,
               const Generator& generator, std::size_t around = 72,
               std::size_t along = 41);

/// A form deviation about the least-squares surface, and by the narrowest zone.
struct Form {
  double least_squares_mm = 0, minimum_zone_mm = 0;
};

/// Least-squares axis of a cylinder or cone: x0 + ax z, y0 + ay z.
struct DatumAxis {
  double x0_mm = 0, y0_mm = 0, ax = 0, ay = 0;
};

DatumAxis axis_of(const Surface& cylinder);
/// Normal of a face's least-squares plane, through the spindle's axis.
DatumAxis normal_of(const Surface& face);
double diameter_error_mm(const Surface& cylinder);  ///< by least squares
/// Diameter at the end of greater z less that at the other end, by least squares.
double taper_mm(const Surface& cylinder);
Form straightness(const Surface& surface);  ///< of the worst generatrix
Form roundness(const Surface& surface);     ///< of the worst section
Form cylindricity(
    const Surface& cylinder);        ///< coaxial cylinders, free tilt and position
Form flatness(const Surface& face);  ///< parallel planes
/// Width of the zone about the nominal profile in its nominal position: twice the largest
/// modulus of the deviation.
double profile_mm(const Surface& surface);
double circular_radial_runout_mm(const Surface& surface, const DatumAxis& datum);
double total_radial_runout_mm(const Surface& surface, const DatumAxis& datum);
/// Diameter of the cylinder about the datum that contains the axis of the surface.
double coaxiality_mm(const Surface& cylinder, const DatumAxis& datum);
double circular_axial_runout_mm(const Surface& face, const DatumAxis& datum);
/// Perpendicularity to the datum, which equals the total axial run-out: distance of two
/// planes square to the datum.
double perpendicularity_mm(const Surface& face, const DatumAxis& datum);
/// Distance of two planes parallel to the least-squares plane of the datum face.
double parallelism_mm(const Surface& face, const Surface& datum);
/// Mean distance of two faces less the nominal one.
double length_error_mm(const Surface& left, const Surface& right);

/// One source of error: the displacement of the surface by one unit of it, and its
/// standard deviation and bound in such units.
struct FormSource {
  std::vector<double> field_mm;
  double u = 0;
  double bound = 0;
};

struct FormDistribution {
  double median_mm = 0, p95_mm = 0;
  double worst_mm = 0;  ///< sum of bounds, the cap of both
};

/// Distribution of the range of sum_i x_i field_i, with x_i normal of standard deviation
/// u_i.  For a form deviation by least squares the fields are the residuals from its
/// surface (least squares is linear, so they are projected once).  Ranges are neither
/// additive nor normal: the root of the sum of squares is wrong by -8 to +22 %.
/// @throws std::domain_error if fields differ in length or there are no draws.
FormDistribution form_distribution(std::span<const FormSource> sources, std::size_t draws,
                                   std::uint64_t seed);

/// Residuals of a surface from its least-squares cylinder, for form_distribution.
std::vector<double> cylinder_residual_mm(const Surface& cylinder);

}  // namespace turnwright::volumetric
