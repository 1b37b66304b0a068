#pragma once
#include <optional>
#include <vector>

/// The kinds of tolerance that a drawing may ask for (ISO 1101, ISO 14405-1), with what
/// the rest of the program has to know of each: one table, a row a kind.
namespace turnwright::part {

enum class ToleranceKind {
  diameter,
  length,
  straightness,
  circularity,
  flatness,
  cylindricity,
  profile,
  profile_without_datum,
  parallelism,
  perpendicularity,
  angularity,
  position,
  coaxiality,
  circular_radial_runout,
  circular_axial_runout,
  total_radial_runout,
  total_axial_runout
};

/// What a tolerance of a kind may be given to.
enum class Toleranced { two_faces, cylinder, element, face, element_or_face };

/// What the datum of a tolerance has to be; `other`: a face for an element, an element for
/// a face.
enum class DatumFeature { none, element, face, other, element_or_face };

/// The condition on a surface's error by which a tolerance is judged: Eqs. (1) to (9) of
/// tolerance/acceptance.hpp.
enum class ToleranceRule {
  size,              ///< (1) to (3): both limits of a size
  range,             ///< (4): largest less smallest error
  runout,            ///< (5): the range and what spindle and chucking add
  straightness,      ///< (6): width of the minimum zone
  profile,           ///< (7): distance from the nominal surface, to either side
  floating_profile,  ///< (8): the range across the surface
  machine            ///< (9): spindle and chucking alone, the cut has no term
};

/// How a tolerance sees that its datum was cut in another setup: an eccentricity e of the
/// part in its jaws is 2 e of a run-out, moves a located surface by e, tilts the part.
enum class Rechucked { unseen, run_out, displaced, tilted };

/// A row of the table.
struct ToleranceFacts {
  ToleranceKind kind = ToleranceKind::diameter;
  const char* name = nullptr;  ///< in the documents: "total-radial-runout"
  Toleranced of = Toleranced::element_or_face;
  DatumFeature datum = DatumFeature::none;
  ToleranceRule rule = ToleranceRule::machine;
  /// Where the toleranced feature is an axis, if that changes the rule.
  std::optional<ToleranceRule> axis_rule = std::nullopt;
  bool sees_lobes = false;  ///< of a thin ring in three jaws
  Rechucked rechucked = Rechucked::unseen;

  ToleranceRule rule_of_axis() const { return axis_rule.value_or(rule); }
};

const ToleranceFacts& facts(ToleranceKind kind);

/// Every kind, in the order of the enumerators.
const std::vector<ToleranceFacts>& tolerance_kinds();

/// "total-radial-runout" and so on, as in the documents.
const char* name(ToleranceKind kind);

/// True of sizes and of profiles about the nominal surface, which an error may leave at
/// either end; false of zones, of which only the width counts.
bool has_two_ends(ToleranceKind kind);

}  // namespace turnwright::part
