#pragma once
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"

/// Measured results in QIF 3.0 (ISO 23952), the XML of measuring machines.
namespace turnwright::document::measured_parts {

/// What a characteristic is to be, where the file says it.
struct QifLimits {
  double nominal_mm = 0, upper_mm = 0;
  std::optional<double> lower_mm = {};  ///< none of form and place
};

/// One value of one part.
struct QifValue {
  std::string part, characteristic;  ///< serial number; name of the item, which is unique
  double value_mm = 0;
  std::optional<double> time_s = {};  ///< since 1970, when it was measured
  std::optional<std::string> device = {};
  std::string edge = {}, machine = {};  ///< attributes of the part
  std::optional<double> parts_on_edge = {}, offset_mm = {};
  std::string pointer = {};
};

struct QifResults {
  std::vector<QifValue> values;
  std::vector<std::pair<std::string, QifLimits>> limits;  ///< by name, each once
  /// What was not read, as sentences: kinds of characteristics, values without a status
  /// that counts.
  std::vector<std::string> not_read;
};

/// The lengths among the measured characteristics of documents, the parts in their order:
///
///     sizes           Diameter, Radius, SphericalDiameter, SphericalRadius, Length, Width,
///                     Depth, Height, Thickness, Square, Chord, CurveLength,
///                     DistanceBetween, DistanceFrom, LinearCoordinate, UserDefinedLinear
///     form and place  Circularity, Cylindricity, Straightness, Flatness, Sphericity,
///                     Conicity, Parallelism, Perpendicularity, Angularity, CircularRunout,
///                     TotalRunout, Coaxiality, Concentricity, Symmetry, Position,
///                     LineProfile, SurfaceProfile
///
/// A value counts in the unit of its own attribute, else the primary one of its file, else
/// metres; units have a factor to metres, S = (X + offset) factor.  Limits are those of the
/// item's nominal (target) and definition (tolerance, as deviations or as limits).  A
/// component without a serial number is told by its number in the files.  Attributes of a
/// component called edge, parts_on_edge, offset_mm and machine are those of `learn`.
/// An item that is measured again in the same results, as the next hole of a pattern, is the
/// characteristic "name #2".
/// Source: the schemas of QIF 3.0 (QIFResults, Characteristics, Units), [QIF 3.0] in
/// docs/bibliography.md.
/// Problems in the files are reported at "/qif/files/0#line 12".
QifResults read_qif(const std::vector<Reader>& files);

}  // namespace turnwright::document::measured_parts
