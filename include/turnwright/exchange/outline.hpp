#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/part/drawing.hpp"
#include "turnwright/part/tolerance_kind.hpp"

/// What a foreign drawing (a STEP file, a DXF file, a line of text) says of a turned part:
/// the geometry of a part document before stock, machine and clamping are added.  z = 0 at
/// the left end of the part; sizes are diameters.  document/ writes it as a part document.
namespace turnwright::exchange {

/// Shapes of an element of the contour, as the part document names them.
/// `as_stock`: it stays as the bar is, of `flats` flats if that is no round one.
enum class Shape { cylinder, cone, arc, groove, thread, hole, as_stock };

/// What the drawing asks of one surface: an element, the shoulder between two, an end.
struct Demands {
  std::optional<std::string> fit = {};      ///< ISO 286 tolerance class, "k6"
  std::optional<part::Limits> limits = {};  ///< not together with `fit`
  std::optional<double> Ra_um = {}, Rz_um = {};
  std::optional<double> grinding_mm = {};  ///< allowance on the diameter that is ground
};

/// One element of the outer contour or of a bore.
struct Element {
  std::string id;  ///< "d1", "d2" .. outside; "b1", "b2" .. inside
  Shape shape = Shape::cylinder;
  double length_mm = 0;
  /// Diameters at its ends along the part; equal for a cylinder, for a groove (its floor)
  /// and for a thread (its nominal diameter); of what stays as the bar is that of the bar, or
  /// across its flats.
  double left_mm = 0, right_mm = 0;
  double pitch_mm = 0;                    ///< of a thread; 0: the coarse one of ISO 261
  int flats = 0;                          ///< of what stays as a hexagon or square bar is
  std::optional<std::string> knurl = {};  ///< of a cylinder, "RAA0.8"
  double radius_mm = 0;                   ///< of an arc
  bool convex = true;                     ///< an arc bulges out of the material
  part::End from = part::End::right;      ///< end that an inner element is reached from
  Demands demands = {};
  /// Names of what it was read from: "#123", a face of a STEP file; "LINE 2F" of a DXF.
  std::vector<std::string> sources = {};
};

/// An edge of the contour, named as in the part document: "left", "d1|d2", "left|b1".
struct Edge {
  std::string at;
  std::optional<double> chamfer_mm = {};  ///< along the axis
  double angle_deg = 45;                  ///< of the chamfer, from the axis
  std::optional<double> radius_mm = {};   ///< of a rounded edge
  std::optional<double> fillet_mm = {};
  std::optional<std::string> undercut = {};  ///< "E0.8x0.3" or "DIN 76-A"
  /// Of the thread that an undercut of DIN 76 was read as that of; 0: that beside it.
  double pitch_mm = 0;
  std::vector<std::string> sources = {};
};

/// "left", "right", or "d1|d2" for the shoulder between two neighbouring elements.
struct FaceOf {
  std::string id;
  Demands demands = {};  ///< roughness only
  std::vector<std::string> sources = {};
};

/// A milled place or a cross hole on an outer cylinder.
struct Milled {
  enum class Kind { flat, keyway, slot, cross_hole };
  enum class Through { no, wall, part };
  std::string id;  ///< "m1", "m2" ..
  Kind kind = Kind::keyway;
  std::string on;        ///< the element
  double z_mm = 0;       ///< left end, of a cross hole its middle
  double length_mm = 0;  ///< not of a cross hole
  double width_mm = 0;   ///< not of a flat; of a cross hole its diameter
  double depth_mm = 0;   ///< below the cylinder's rim, of what does not go through
  int count = 1;         ///< of such places at equal angles
  double angle_deg = 0;
  Through through = Through::no;  ///< of a cross hole
  Demands demands = {};           ///< likewise, its size alone
  std::vector<std::string> sources = {};
};

/// A centre hole of ISO 6411 in an end of the part.
struct CentreHole {
  part::End at = part::End::right;
  std::string designation;  ///< "A4/8.5" or "ISO 6411-A4/8.5"
};

/// Something that was taken to be so, or that could not be understood, and where.
struct Remark {
  std::string at;    ///< "#123", "LINE 2F", "d1", "" for the whole drawing
  std::string text;  ///< a whole sentence
};

struct Outline {
  std::string name;  ///< "" if the drawing has none
  part::TitleBlock title = {};
  std::string material;  ///< as the drawing calls it, "" if it does not
  std::string general;   ///< general tolerances, "ISO 2768-mK"; "" if it does not say
  std::vector<Element> outer;  ///< left to right
  std::vector<Element> inner;  ///< those of one end from it inwards
  std::vector<Edge> edges = {};
  std::vector<FaceOf> faces = {};
  std::vector<part::Tolerance> tolerances =
      {};  ///< `of`, `datum`, `between`: ids as above
  std::vector<Milled> milled = {};
  std::vector<CentreHole> centre_holes = {};
  std::vector<Remark> assumed = {}, ignored = {};
};

}  // namespace turnwright::exchange
