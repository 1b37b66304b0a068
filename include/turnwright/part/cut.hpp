#pragma once
#include <numbers>

/// What is cut at fixed conditions into an element once it is turned or bored: the
/// element itself is then the blank.
namespace turnwright::part {

enum class CutKind { groove, thread, arc };

/// Diameters at the left and the right end [mm].
struct Ends {
  double left_mm = 0, right_mm = 0;
};

struct Cut {
  CutKind kind = CutKind::groove;
  Ends drawn = {};  ///< floor of a groove, nominal diameter of a thread, an arc's ends
  Ends core = {};   ///< diameters that a beam may count on: never too stiff
  double depth_mm = 0;   ///< on the radius, where it is deepest
  double pitch_mm = 0;   ///< of a thread
  double radius_mm = 0;  ///< of an arc
  bool convex = true;    ///< an arc bulges outwards
  double path_mm = 0;    ///< length of an arc
  /// Slope at which an arc falls at most on the way to an end: 0 if it only rises.
  double falls_to_left_rad = 0, falls_to_right_rad = 0;
};

/// Slope that a profiling tool is taken to clear behind its corner: a 35 deg insert in
/// any of the usual holders does.
inline constexpr double kProfilingClears_rad = std::numbers::pi / 6;

/// A blank with its cut.
struct Shaped {
  Ends blank;
  Cut cut;
};

enum class Where { outside, inside };

/// Groove with a floor, in a blank of a diameter.
Shaped groove(double blank_mm, double floor_mm);

/// ISO metric thread of nominal diameter d and pitch P, H = (sqrt 3/2) P:
///
///     outside: turned to d, depth h3 = (17/24) H = 0.61343 P, core d3 = d - 2 h3 (1)
///     inside:  bored to D1 = d - 2 (5/8) H, depth (5/8) H = 0.54127 P, opening d (2)
///
/// Source: ISO 68-1's basic profile, ISO 724's diameters; d3 with the root radius H/6 of
/// the handbook's tables.
Shaped thread(double d_mm, double pitch_mm, Where where);

/// Arc of radius R through two ends of diameters left and right, `length` apart.  With
/// c the chord, s = R - sqrt(R^2 - c^2/4) its sagitta and rc the centre's height:
///
///     convex:  turned to a cylinder of its largest diameter; the chord is the core (3)
///     concave: turned to the chord, depth s c/length; a cylinder of its least
///              diameter is the core (4)
///     path = 2 R asin(c/(2 R)) (5)
///     slope where it is steepest, at an end: asin(distance from the centre / R) (6)
///
/// Source: derived here, cut_test measures points on the circle.
/// @throws std::domain_error naming what cannot be: R below half the chord, an arc that
///         reaches beyond its ends along the axis, or one that meets the axis.
Shaped arc(double length_mm, Ends ends, double radius_mm, bool convex);

}  // namespace turnwright::part
