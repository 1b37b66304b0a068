#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "turnwright/part/drawing.hpp"

/// General tolerances of ISO 2768, which apply where a drawing says only "ISO 2768-mK".
/// The numbers agree with public transcriptions of its tables (scribd.com, documents
/// 151864629 and 320059830), except a run-out, and 0.15 mm for c of 0.5 .. 3 mm, where
/// other transcriptions have the 0.2 mm used here.  Run-outs are handbook values.
/// Nothing was compared with the printed standard.
namespace turnwright::tolerance {

enum class LinearClass { f, m, c, v };    ///< part 1: fine, medium, coarse, very coarse
enum class GeometricalClass { H, K, L };  ///< part 2: fine to coarse

struct GeneralTolerance {
  std::optional<LinearClass> linear;
  std::optional<GeometricalClass> geometrical;
};

/// Reads "ISO 2768-m", "ISO 2768-mK" or "ISO 2768-K".
/// @throws std::domain_error with the accepted forms.
GeneralTolerance general_tolerance(std::string_view designation);

/// Symmetrical deviations [mm] of a length or diameter (not of radii and chamfers),
/// part 1.
/// @throws std::domain_error unless 0.5 <= nominal <= 4000 mm, for f <= 2000, for v > 3.
part::Limits general_limits_mm(double nominal_mm, LinearClass tolerance_class);

/// Symmetrical deviations [mm] of an external radius or a chamfer's height, part 1.
/// @throws std::domain_error unless nominal >= 0.5 mm.
part::Limits general_edge_limits_mm(double nominal_mm, LinearClass tolerance_class);

/// Symmetrical deviation [rad] of an angle, by the length of its shorter leg (a cone's
/// generatrix); part 1.
/// @throws std::domain_error unless leg > 0 mm.
double general_angle_rad(double leg_mm, LinearClass tolerance_class);

/// Straightness or flatness [mm] of a surface, by its length, for a round face by its
/// diameter.
/// @throws std::domain_error unless 0 < length <= 3000 mm.
double general_straightness_mm(double length_mm, GeometricalClass tolerance_class);

/// Perpendicularity [mm], by the length of the shorter leg.
/// @throws std::domain_error unless 0 < length <= 3000 mm.
double general_perpendicularity_mm(double length_mm, GeometricalClass tolerance_class);

/// Symmetry [mm], by the length of the shorter surface.
/// @throws std::domain_error unless 0 < length <= 3000 mm.
double general_symmetry_mm(double length_mm, GeometricalClass tolerance_class);

/// Circular run-out [mm], radial or axial.
double general_runout_mm(GeometricalClass tolerance_class);

/// The form tolerances that part 2 implies where the drawing holds the form less closely,
/// ids "<of>:<kind>": of an element without a cut a straightness, unless half the width of
/// its diameter's limits, by which the radius varies at most, or a zone of it is as
/// narrow; of a faced end a flatness by its diameter, unless a zone of it is as narrow.
/// Nothing where the tables have no value.
std::vector<part::Tolerance> implied_form_tolerances(const part::Drawing& drawing,
                                                     GeometricalClass tolerance_class);

}  // namespace turnwright::tolerance
