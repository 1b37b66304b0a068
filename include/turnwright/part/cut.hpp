#pragma once
#include <numbers>
#include <optional>
#include <string>

/// Grooves, threads, arcs and knurls: shapes that are made on an element at fixed conditions
/// after it has been turned or bored.  The element itself is then their blank.  A hole is
/// drilled instead of bored: to its size, or narrower for a reamer, a tap or a flat drill.
namespace turnwright::part {

enum class CutKind { groove, thread, arc, hole, knurl };
/// Whether neighbours meet another shape than the blank.
constexpr bool replaces_blank(CutKind kind) {
  return kind == CutKind::groove || kind == CutKind::arc;
}

/// Diameters at the left and the right end [mm].
struct Ends {
  double left_mm = 0, right_mm = 0;
};

/// Types of knurls: with grooves along the axis; left-hand, right-hand; both hands with
/// points raised, indented; crossed along and around the axis with points raised, indented.
enum class KnurlType { RAA, RBL, RBR, RGE, RGV, RKE, RKV };
/// A knurl of DIN 82, whose profile has an angle of 90 deg.
struct Knurl {
  KnurlType type = KnurlType::RAA;
  double pitch_mm = 0;
};
/// The knurl of a text, "RAA0.8", "RGE 0,8", "DIN 82-RGE1.2": one of the seven types with a
/// pitch of DIN 82: 0.5, 0.6, 0.8, 1, 1.2 or 1.6 mm.  Nothing of other texts.
std::optional<Knurl> knurl(const std::string& text);
/// "RAA0.8".
std::string designation(const Knurl& knurl);

struct Cut {
  CutKind kind = CutKind::groove;
  /// Floor of a groove, nominal diameter of a thread or a knurl, ends of an arc, a hole's
  /// diameter.
  Ends drawn = {};
  /// Diameters of the load-bearing core, as a beam never too stiff: of a groove its floor and
  /// of a thread its root where they are cut.
  Ends core = {};
  double depth_mm = 0;  ///< largest depth, on the radius, from the blank as it is cut
  double pitch_mm = 0;  ///< of a thread or a knurl
  KnurlType knurl = KnurlType::RAA;
  /// Diameter of the drill of a hole or a tapped thread; 0: bored.
  double drilled_mm = 0;
  bool flat = false;  ///< a hole that a flat drill opens: a counterbore
  /// How far the reamer or the tap has to go beyond the element for its lead.
  double lead_mm = 0;
  double radius_mm = 0;  ///< of an arc
  bool convex = true;    ///< an arc bulges outwards
  double path_mm = 0;    ///< length of an arc
  /// Steepest slope at which an arc falls towards an end; 0 if it only rises.
  double falls_to_left_rad = 0, falls_to_right_rad = 0;
};

/// Steepest falling slope that a profiling tool is assumed to clear behind its corner; a
/// 35 deg insert in any of the usual holders does.
inline constexpr double kProfilingClears_rad = std::numbers::pi / 6;

/// A blank with the shape that is cut into it.
struct Shaped {
  Ends blank;
  Cut cut;
};

enum class Where { outside, inside };

/// A groove in a cylindrical blank, with the diameter of its floor that is drawn and the one
/// to which it is cut.
Shaped groove(double blank_mm, double drawn_mm, double floor_mm);

/// A hole that is drilled to its size.
Shaped hole(double diameter_mm);
/// A hole of a diameter that is drilled narrower and reamed.
Shaped reamed(double diameter_mm, double drilled_mm, double lead_mm);
/// A counterbore: a flat drill opens a narrower hole to a diameter.
Shaped counterbored(double diameter_mm, double drilled_mm);

/// Knurl of nominal diameter d1 and pitch t, pressed into a narrower blank whose material
/// rises between the wheel's teeth.  With a profile of 90 deg it is t/2 deep, and as no
/// material is lost the blank is as high as the mean of the profile: half its height between
/// straight grooves, a third of it of pyramids that are raised, two thirds of those that are
/// indented.
///
///     RAA, RBL, RBR: d2 = d1 - t/2;  RGE, RKE: d2 = d1 - 2 t/3;  RGV, RKV: d2 = d1 - t/3,
///     depth d2/2 - (d1 - t)/2, core d1 - t                                          (5)
///
/// Source: derived here; DIN 82, 2.4, calculates d2 = d1 - 0.33 t of RKV, as its English
/// text of 1973 has it, and says that neither rounded grooves nor the material count.
Shaped knurled(double d1_mm, const Knurl& knurl);

/// Arc of radius R through two ends of given diameters, `length` apart.  With c the
/// chord, s = R - sqrt(R^2 - c^2/4) its sagitta and rc the centre's height:
///
///     convex:  turned to a cylinder of its largest diameter; the chord is the core (1)
///     concave: turned to the chord, depth s c/length; a cylinder of its least
///              diameter is the core (2)
///     path = 2 R asin(c/(2 R)) (3)
///     slope where it is steepest, at an end: asin(distance from the centre / R) (4)
///
/// Source: derived here, cut_test measures points on the circle.
/// @throws std::domain_error naming the reason: R is below half the chord, the arc
///         reaches beyond its ends along the axis, or it meets the axis.
Shaped arc(double length_mm, Ends ends, double radius_mm, bool convex);

}  // namespace turnwright::part
