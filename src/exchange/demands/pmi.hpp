#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/exchange/outline.hpp"
#include "turnwright/exchange/part21.hpp"

/// Product and manufacturing information (PMI) of a STEP file of AP242, or of AP203 and
/// AP214 as far as these have it: what a drawing says beside the shape, as data and not
/// as strokes.  A plain list of all that the file holds; step_pmi.hpp puts it on a turned
/// part.
///
/// The chain of entities, from a tolerance to the faces of the solid:
///
///     FLATNESS_TOLERANCE(name, text, #magnitude, #aspect)           alone, or
///     (FLATNESS_TOLERANCE() GEOMETRIC_TOLERANCE(..) ..)             with what is added to it
///       #magnitude  a measure with its own unit, step_unit.hpp
///       #aspect     SHAPE_ASPECT or one of its kinds; also a DIMENSIONAL_SIZE
///     GEOMETRIC_ITEM_SPECIFIC_USAGE(.., #aspect, #shape, #face)     aspect -> face
///     SHAPE_ASPECT_RELATIONSHIP(.., #composite, #aspect)            composite -> its members
///     SHAPE_ASPECT_RELATIONSHIP(.., #datum feature, #datum)         datum -> its feature
///     DATUM_SYSTEM(.., (#compartment ..)) -> DATUM or a list of them for a common datum A-B
///
///     DIMENSIONAL_SIZE(#aspect, 'diameter')
///     DIMENSIONAL_LOCATION(.., #from, #to)
///     DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#dimension, (#nominal value ..))
///     PLUS_MINUS_TOLERANCE(TOLERANCE_VALUE(#lower, #upper) or
///                          LIMITS_AND_FITS(..), #dimension)
///
/// Traps, all met in files of the NIST test cases (tests/data/step/nist):
///
/// - each measure has a unit of its own; a file whose shape is in mm has tolerances in
///   inches, and one converter to QIF drops that (CTC-03);
/// - a dimension may have its limits as a plus-minus tolerance or as further items of its
///   representation named 'upper limit' and 'lower limit' (CTC-01);
/// - a datum's faces hang on its feature, on the datum itself (CTC-02), or in a set of an
///   ITEM_IDENTIFIED_REPRESENTATION_USAGE (CTC-01);
/// - modifiers stand in other records of a complex instance, so a reader of the simple
///   forms loses them and with them the meaning of the value.  Open CASCADE 7.6.3 loses
///   magnitudes that are complex instances too: all six of CTC-01 come back as 0.
namespace turnwright::exchange {

/// The faces that a tolerance, a dimension or a datum is about.
struct Feature {
  std::string at = {};                  ///< "#120", the aspect; "" if the file names none
  std::vector<std::string> faces = {};  ///< "#861", each once, in the order of the file
  std::vector<std::string> other = {};  ///< "#3891 EDGE_CURVE": geometry that is no face
  bool axis = false;                    ///< the axis or median plane of the faces
  std::string extent = {};  ///< "all around", "between"; "" of the whole feature
};

/// A nominal size with the deviations allowed of it; any of them may be missing.
struct Dimension {
  std::string at = {};  ///< "#120"
  /// "diameter", "linear distance", "thickness", as the file has it.
  std::string name = {};
  std::optional<double> nominal_mm = {};
  std::optional<part::Limits> limits = {};  ///< of the size less the nominal one
  std::string fit = {};                     ///< ISO 286 tolerance class, "k6"; "" without
  /// "theoretical" (a basic size), "auxiliary" (a reference), "statistical" and so on.
  std::vector<std::string> notes = {};
  Feature of = {};
  std::optional<Feature> to = {};  ///< of a location: the distance is from `of` to it
};

/// An angle, of a feature or between two.
struct AngularDimension {
  std::string at = {}, name = {};
  std::optional<double> nominal_rad = {};
  std::optional<double> lower_rad = {}, upper_rad = {};  ///< deviations as above
  std::vector<std::string> notes = {};
  Feature of = {};
  std::optional<Feature> to = {};
};

/// Symbols of ISO 1101.
enum class Symbol {
  angularity,
  circular_runout,
  coaxiality,
  concentricity,
  cylindricity,
  flatness,
  line_profile,
  parallelism,
  perpendicularity,
  position,
  roundness,
  straightness,
  surface_profile,
  symmetry,
  total_runout
};

/// "circular run-out".
const char* name(Symbol symbol);

/// One compartment of a tolerance frame after the value: a datum, or a common datum A-B.
struct DatumReference {
  std::vector<std::string> letters = {};    ///< {"A"}, {"A", "B"}
  std::vector<std::string> modifiers = {};  ///< in words
};

struct GeometricTolerance {
  std::string at = {};  ///< "#57"
  Symbol symbol = Symbol::position;
  std::string name = {};                ///< "Flatness.1"
  std::optional<double> width_mm = {};  ///< of the zone; its diameter if `diametral`
  bool diametral = false;
  Feature of = {};
  std::vector<DatumReference> datums = {};  ///< in their order
  /// What changes the meaning of the value, in words: "maximum material requirement",
  /// "projected by 50 mm", "unequally disposed by 0.5 mm", "per 6.35 mm".
  std::vector<std::string> modifiers = {};
};

struct Datum {
  std::string at = {};      ///< "#37"
  std::string letter = {};  ///< "A"
  Feature of = {};
  bool targets = false;  ///< established by datum targets, not by whole faces
};

/// A parameter of surface texture, "Ra" [um].
struct SurfaceTexture {
  std::string at = {}, parameter = {};
  double value_um = 0;
  Feature of = {};
};

/// A text of the product: a note, or an attribute that its author named.
struct Note {
  std::string at = {};    ///< "#4331"
  std::string name = {};  ///< "Part Number"; "" of a note
  std::string text = {};
};

struct Pmi {
  std::vector<Dimension> dimensions;
  std::vector<AngularDimension> angles;
  std::vector<GeometricTolerance> tolerances;
  std::vector<Datum> datums;
  std::vector<SurfaceTexture> textures;
  std::vector<Note> notes;
  std::string part_number, part_name, revision, material;
  std::size_t annotations = 0;  ///< drawn in the model
  /// Those of them that no dimension, tolerance, datum or text of the file stands behind:
  /// strokes alone.  By their names.
  std::vector<std::string> strokes_alone;
  std::vector<Remark> unread;  ///< what is broken, with the reason
};

/// All PMI of a file, in its order.  A broken record costs what it says and no more: it
/// is told under `unread`.  Time and memory are proportional to the file; features that
/// are nested or shared so that their lists of faces would outgrow it many times are
/// refused. @throws InputError of such features.
Pmi read_pmi(const Exchange& file);

}  // namespace turnwright::exchange
