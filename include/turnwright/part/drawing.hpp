#pragma once
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "turnwright/part/cut.hpp"
#include "turnwright/part/tolerance_kind.hpp"

/// The content of the drawing, left to right along the axis, with z = 0 at the left end
/// of the finished part.  Plain values; document/ reads and checks them.
namespace turnwright::part {

enum class ElementKind { cylinder, cone };

/// Deviations of a size from its nominal value [mm]: lower <= upper.
struct Limits {
  double lower_mm = 0, upper_mm = 0;
};

/// A chamfer at an end of an element, which ends with a smaller radius outside and with a
/// larger one inside; or a rounded edge.
struct Chamfer {
  double axial_mm = 0, radial_mm = 0;  ///< taken from the length and from the radius
  /// At the rim of a groove whose blank is as high as the element: the grooving blade cuts
  /// it after the groove.
  bool by_blade = false;
  /// Asked for by the title block of all edges alike: where no tool passes it is left to the
  /// hand.
  bool general = false;
  /// A rounded edge: a quarter of a circle of the radius axial_mm == radial_mm, tangent to the
  /// element and to the face or the wall before it.
  bool round = false;
};

/// How far a chamfer goes into the radius at a distance from its end of the element; 0 beyond
/// it.  Of a rounded edge of radius R, at x < R,
///
///     R - sqrt(R^2 - (R - x)^2).                                                     (4)
double into_radius_mm(const Chamfer& chamfer, double from_end_mm);

/// The straight chamfer at which roughing stops: the chamfer itself; of a rounded edge of
/// radius R the one of 45 deg that touches it, with legs of R (2 - sqrt 2).
Chamfer roughed(const Chamfer& chamfer);

/// An undercut of DIN 509, or of DIN 76 behind an outer thread, at the end of an element
/// before a shoulder: at a distance from the shoulder the surface falls at an angle to a
/// depth, and an inner radius leads from there to the shoulder.  The forms F, G and H go into
/// the shoulder too: from the radius their surface comes back to the shoulder at an angle.
struct Undercut {
  double radius_mm = 0, depth_mm = 0, width_mm = 0;
  double recess_mm = 0;  ///< deepest place in the shoulder; 0: of form E, of DIN 76
  double pitch_mm = 0;   ///< of the thread, of DIN 76; 0: DIN 509
  char form = 'E';       ///< 'E' to 'H' of DIN 509, 'A' or 'B' of DIN 76
};

/// The undercut of form 'E', 'F', 'G' or 'H' with a radius and a depth.
/// Source: DIN 509:2006, table 1: radius x depth, width f, depth t2 in the shoulder, as
/// IS 3428:2009 has it.  The slope of H1.2x0.3 is tangent to its radius at a width of
/// 2.43 mm, within f = 2.4 +0.2 mm; that is its width here.  Nothing if the table has none.
std::optional<Undercut> undercut(char form, double radius_mm, double depth_mm);

/// The undercut of form 'A' (regular) or 'B' (short) behind an outer thread of a pitch:
/// depth (d - dg)/2, and the width g2 at which its flank of 30 deg meets the diameter d.
/// Source: DIN 76-1, table 1: dg, g2 and r by the pitch.  Nothing if the table has none.
std::optional<Undercut> thread_undercut(char form, double pitch_mm);

/// "E0.8x0.3", "DIN 76-A".
std::string designation(const Undercut& undercut);

/// Angle at which an undercut falls to its floor: 15 deg of the forms E, F and H, 17.5 deg of
/// G, 30 deg of DIN 76.
///
/// Source: of G and H derived here: they have the shape of inserts, a rhombus of 55 deg and a
/// triangle (foreword of IS 3428), whose edges lie off both surfaces by half of what the
/// right angle is more, 17.5 and 15 deg.  By f and g of their three rows, printed to 0.1 mm,
/// it is 16.1 to 18.9 deg and 14.7 to 15.3 deg.
double falls_rad(const Undercut& undercut);
/// Angle at which it comes back to the shoulder: 8 deg of form F, 17.5 deg of G, 15 deg of H;
/// 0 of the others.
double leans_rad(const Undercut& undercut);
/// Length [mm] along the axis that it falls on, t/tan(angle).
double fall_mm(const Undercut& undercut);
/// Height above its floor at which an undercut that comes back at an angle `a` ends on the
/// shoulder:
///
///     form E, DIN 76: g = r                                                          (1)
///     forms F to H: g = r (1 + sin a) + (t2 - r (1 - cos a))/tan a                   (2)
///
/// Source: derived here from DIN 509's picture; its table rounds g to 0.1 mm.
double height_mm(const Undercut& undercut);
/// Distance of the centre of its radius from the shoulder, r - t2.
double centre_mm(const Undercut& undercut);

/// One outer element.  A cylinder has left_mm == right_mm (diameters).  With a groove,
/// thread or arc cut into it the diameters are those of the blank.
struct OuterElement {
  std::string id;
  ElementKind kind = ElementKind::cylinder;
  double length_mm = 0;
  double left_mm = 0, right_mm = 0;
  /// It stays as the stock is: no tool turns it, and no tolerance is on it.
  bool as_stock = false;
  std::optional<std::string> fit = {};  ///< ISO 286 tolerance class as drawn, "k6"
  std::optional<Limits> limits = {};    ///< from `fit`, `limits_mm` or general
  std::optional<double> Ra_um = {}, Rz_um = {};
  std::optional<std::string> ground_to = {};  ///< what grinding makes later, "25 k6"
  std::optional<Cut> cut = {};
  std::optional<Chamfer> left_chamfer = {}, right_chamfer = {};
  /// Largest radius that may stay in the inner corner at that end.
  std::optional<double> left_fillet_mm = {}, right_fillet_mm = {};
  std::optional<Undercut> left_undercut = {}, right_undercut = {};
};

/// Depth [mm] of the undercuts of an element at a distance from its left end, its radii
/// left out.
double undercut_mm(const OuterElement& element, double from_left_mm);

enum class End { left, right };
constexpr End opposite(End end) { return end == End::left ? End::right : End::left; }

/// One inner element.  Elements are listed from the end of the part inwards; left_mm and
/// right_mm are its diameters in the direction of the axis.
struct InnerElement {
  std::string id;
  ElementKind kind = ElementKind::cylinder;
  End from = End::right;
  double length_mm = 0;
  double left_mm = 0, right_mm = 0;
  std::optional<std::string> fit = {};
  std::optional<Limits> limits = {};
  std::optional<double> Ra_um = {}, Rz_um = {};
  std::optional<std::string> ground_to = {};  ///< what grinding makes later, "25 k6"
  std::optional<Cut> cut = {};
  std::optional<Chamfer> left_chamfer = {}, right_chamfer = {};
  /// Largest radius that may stay in the inner corner at that end.
  std::optional<double> left_fillet_mm = {}, right_fillet_mm = {};
};

/// Whether an element stays as the stock is; bores never do.
inline bool stays(const OuterElement& e) { return e.as_stock; }
inline bool stays(const InnerElement&) { return false; }

/// A face: "left", "right" (the ends), "d1|d2" (the shoulder between two elements) or
/// "b1|b2" (between two bores, the wider one first).
struct Face {
  std::string id;
  std::optional<double> Ra_um = {}, Rz_um = {};
};

struct Tolerance {
  std::string id;
  ToleranceKind kind = ToleranceKind::diameter;
  std::string of;                      ///< element or face; empty for `length`
  std::string datum;                   ///< element or face; may be empty
  std::array<std::string, 2> between;  ///< the two faces of a `length`
  double value_mm = 0;                 ///< width of the zone (upper - lower for a size)
  std::optional<Limits> limits = {};   ///< of a size: `diameter`, `length`
  /// The second element of a common datum A-B, whose axis goes through the middles of
  /// `datum` and of this; empty of a single datum.
  std::string common_datum = {};
};

enum class StockKind { bar, tube, hexagon, square, casting, forging };

/// A cylinder or cone of the outline of a casting or forging: diameters as drawn.
struct BlankPiece {
  double length_mm = 0, left_mm = 0, right_mm = 0;
};

struct Stock {
  StockKind kind = StockKind::bar;
  /// Diameters; outside that through the corners of a hexagon or square, and the largest
  /// that a casting or forging may have; inside 0 but of a tube or a cored blank.
  double outer_mm = 0, inner_mm = 0;
  double length_mm = 0;
  double left_allowance_mm = 0;  ///< stock to the left of z = 0
  /// If set, the first setup parts off at the held end and leaves this allowance there.
  std::optional<double> parted_mm = {};
  /// Outline of a casting or forging from left to right, empty of other kinds, and by how
  /// much its diameters may differ from it.
  std::vector<BlankPiece> outline = {};
  Limits outline_limits = {};
};

/// Diameters [mm] that stock has between two positions: the least that a bar with corners,
/// or a blank within its limits, certainly has, and the largest that it may have.
struct StockRange {
  double least_mm = 0, most_mm = 0;
};
/// Between two positions z0 < z1 of the part; where the stock ends before one of them, of
/// its end.
StockRange stock_between(const Stock& stock, double z0_mm, double z1_mm);

/// A line of the outside of a stock, diameters at positions z0 < z1 of the part.
struct StockLine {
  double z0_mm = 0, left_mm = 0, z1_mm = 0, right_mm = 0;
};
/// Those between two positions, from left to right: of a casting or forging at the largest.
std::vector<StockLine> stock_lines(const Stock& stock, double z0_mm, double z1_mm);

/// Corners of the largest half section of a stock, radius and position on the axis of the
/// part, once around.
std::vector<std::array<double, 2>> half_section(const Stock& stock);

/// Number of flats of a stock's section, 0 of a round one.
int flats(StockKind kind);
/// Across the flats of a stock [mm], the largest circle in its section:
///
///     outer cos(pi/n)                                                                (5)
///
/// of n flats; of a round one its diameter.  Jaws hold it, and no bar is taken for stiffer.
double across_mm(const Stock& stock);
/// Area of a stock's section [mm^2]; of n flats n across^2/4 tan(pi/n).  Of a casting or
/// forging the mean along it, as drawn.
double section_mm2(const Stock& stock);

/// What the title block of the drawing says beside the name; empty: not given.
struct TitleBlock {
  std::string drawing_number, revision, customer;
};

/// A centre hole of ISO 6411's form A, B (with a protecting chamfer) or R (rounded): the
/// diameters of its pilot hole and where it is widest, and the depth of the pilot's tip.
struct CentreHole {
  char form = 'A';
  double pilot_mm = 0, diameter_mm = 0, depth_mm = 0;
};
/// The centre hole of a form with these diameters.
///
///     depth = (D3 - D2)/2/tan 60 deg + (D2 - d)/2/tan 30 deg + l                      (3)
///
/// with D3 = D2 but of form B; form R is taken as deep as form A, an estimate.
/// Source: ISO 6411:1982, table: d, and D1 (form R), D2 (A), D3 (B); l of ISO 866.
/// Nothing if the table has none.
std::optional<CentreHole> centre_hole(char form, double pilot_mm, double diameter_mm);
/// "ISO 6411-A4/8.5".
std::string designation(const CentreHole& hole);

struct Drawing {
  std::string name;
  Stock stock;
  std::vector<OuterElement> outer;
  std::vector<InnerElement> inner;
  std::vector<Face> faces;
  std::vector<Tolerance> tolerances;  ///< with the sizes of the elements; ids are unique
  TitleBlock title = {};
  std::optional<CentreHole> left_centre = {}, right_centre = {};
};
inline const std::optional<CentreHole>& centre_at(const Drawing& drawing, End end) {
  return end == End::left ? drawing.left_centre : drawing.right_centre;
}

/// Diameter [mm] that jaws at an end hold in the i-th setup: the stock first, finished ends
/// afterwards; 0 of a part without elements.
double held_mm(const Drawing& drawing, std::size_t setup, End hold);
/// Length of the finished part [mm]: the sum of the outer elements.
double length_mm(const Drawing& drawing);
/// Left end z [mm] of outer element i.
double left_z_mm(const Drawing& drawing, std::size_t i);
/// What stands of the stock over outer element i before it is cut: over the outermost ones
/// to the ends of the stock, and the largest also where tools run out, kRunOut_mm over
/// neighbours that are no larger.
StockRange stock_of(const Drawing& drawing, std::size_t i);
inline constexpr double kRunOut_mm = 5;
/// Left end z [mm] of inner element i.
double inner_left_z_mm(const Drawing& drawing, std::size_t i);
/// Left ends z [mm] of all outer elements at once, each equal to its `left_z_mm`.
std::vector<double> left_ends_mm(const Drawing& drawing);
/// Left ends z [mm] of all inner elements at once, each equal to its `inner_left_z_mm`.
std::vector<double> inner_left_ends_mm(const Drawing& drawing);
/// Largest diameter [mm] of the stock's hole and the inner elements between two positions.
double largest_hole_mm(const Drawing& drawing, double z0_mm, double z1_mm);
/// And the narrowest; 0 if the part is solid somewhere between them.
double least_hole_mm(const Drawing& drawing, double z0_mm, double z1_mm);
/// Diameters at the ends of the finished element; of one with a groove, thread or arc,
/// those of its core.
template <class Element>
Ends core(const Element& e) {
  return e.cut ? e.cut->core : Ends{e.left_mm, e.right_mm};
}
/// How far the chamfers of an element go into its radius at a distance [mm] from its left
/// end; 0 where it has none.
template <class Element>
double chamfered_mm(const Element& e, double from_left_mm) {
  const auto into = [](const std::optional<Chamfer>& c, double from_end_mm) {
    return c ? into_radius_mm(*c, from_end_mm) : 0.0;
  };
  return into(e.left_chamfer, from_left_mm) +
         into(e.right_chamfer, e.length_mm - from_left_mm);
}
/// Whether a groove, thread or arc is cut into the element of this id, or the drill makes it.
bool has_cut(const Drawing& drawing, const std::string& id);
/// Whether a groove is cut into an element.
template <class Element>
bool is_groove(const Element& e) {
  return e.cut && e.cut->kind == CutKind::groove;
}
inline bool is_knurled(const OuterElement& e) {
  return e.cut && e.cut->kind == CutKind::knurl;
}
/// What a knurl raises [mm] the radius of its blank; 0 of other elements.
inline double raised_mm(const OuterElement& e) {
  return is_knurled(e) ? (e.cut->drawn.left_mm - e.left_mm) / 2 : 0;
}
/// Whether a bore is drilled instead of bored: to its size, or for a reamer or a tap.
inline bool is_hole(const InnerElement& e) { return e.cut && e.cut->drilled_mm > 0; }
inline bool is_tapped(const InnerElement& e) {
  return is_hole(e) && e.cut->kind == CutKind::thread;
}
inline bool is_counterbore(const InnerElement& e) { return e.cut && e.cut->flat; }
inline bool is_reamed(const InnerElement& e) {
  return is_hole(e) && !is_tapped(e) && !is_counterbore(e) && e.cut->depth_mm > 0;
}
/// Diameter [mm] to which drills open a hole before its other tools come.
inline double opened_mm(const Cut& hole) {
  return hole.flat ? hole.drawn.left_mm : hole.drilled_mm;
}
/// How far [mm] a hole is drilled beyond its end: by the lead of its reamer or its tap, and
/// for a tap, which does not stop to a hair, a pitch more.
inline double drilled_beyond_mm(const Cut& hole) {
  return hole.lead_mm + (hole.kind == CutKind::thread ? hole.pitch_mm : 0);
}
/// The chamfer where a bore begins.
inline const std::optional<Chamfer>& opening_chamfer(const InnerElement& e) {
  return e.from == End::left ? e.left_chamfer : e.right_chamfer;
}
/// The chamfer at the other end of a bore, and whether that is a face of the part.
inline const std::optional<Chamfer>& closing_chamfer(const InnerElement& e) {
  return e.from == End::left ? e.right_chamfer : e.left_chamfer;
}
bool leaves_part(const Drawing& drawing, std::size_t inner);
/// Diameter [mm] of the narrowest bore through which the i-th one is reached from its end;
/// infinite at the end itself.
double way_in_mm(const Drawing& drawing, std::size_t i);
/// The shoulder between two bores that meet: "b1|b2" by the wider and the narrower one.
struct InnerShoulder {
  std::string id;
  std::size_t wider = 0, narrower = 0;  ///< inner elements
  double z_mm = 0;
  std::string reversed;  ///< "b2|b1", by which documents may name it too
};
/// The shoulders between bores of different diameters that no groove is beside.
std::vector<InnerShoulder> inner_shoulders(const Drawing& drawing);
/// The shoulder between bores of a name, in either order; nothing if it names none.
std::optional<InnerShoulder> inner_shoulder(const Drawing& drawing,
                                            const std::string& id);
/// The shoulder at an end of an inner element that is the wider one there.
std::optional<InnerShoulder> shoulder_behind(const Drawing& drawing, std::size_t wider);
/// Whether a tolerance is on a face, or a length is measured to it.
bool has_tolerance(const Drawing& drawing, const std::string& face);

/// Whether a countersink of a point angle cuts a chamfer.
bool fits_countersink(const Chamfer& chamfer, double point_deg);

/// Position of an element along the axis, and the diameters at its ends.
struct Extent {
  double z0_mm = 0, z1_mm = 0;
  double left_mm = 0, right_mm = 0;
  bool inner = false;
};
/// Extent of the element of this id; nothing for a face or an unknown id.
std::optional<Extent> extent(const Drawing& drawing, const std::string& id);
/// Half angle [rad] of an element, 0 of a cylinder; nothing for a face.
std::optional<double> half_angle_rad(const Drawing& drawing, const std::string& id);
/// The datum as it is written in a tolerance frame, "d2" or "d2-d6"; "" without.
std::string datum_words(const Tolerance& tolerance);
/// Upper less lower limit, or the zone's width [mm].
double width_mm(const Tolerance& tolerance);
/// Multiplies the width by `times`; limits stay centred about their middle.
void widen(Tolerance& tolerance, double times);
/// Stock to the right of the finished right end [mm].
double right_allowance_mm(const Drawing& drawing);

}  // namespace turnwright::part
