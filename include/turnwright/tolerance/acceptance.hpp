#pragma once
#include <optional>
#include <string>

#include "turnwright/part/drawing.hpp"
#include "turnwright/tolerance/piecewise.hpp"

/// Whether a surface with the error e(z) conforms to a tolerance of the drawing.
///
/// e is the signed radius error (positive = larger radius), for faces the axial error
/// g(rho), both over the whole profile.  t is the width of the zone, alpha the half angle
/// of a cone, m the terms of machine and chucking, W the minimum zone of e(z).
/// Conditions:
///
///     kind                             accepted                       after an offset
///     length (faces i, j)    (1)  l <= min e_i + min e_j              r_i + r_j <= u - l
///                                 and max e_i + max e_j <= u
///     diameter               (2)  l <= 2 e_min and 2 e_max <= u       2 r <= u - l
///       with (E) of a shaft  (3)  2 e_max + m <= u besides            2 r + m <= u - l
///       with (E) of a bore   (3)  l <= 2 e_min - m besides            2 r + m <= u - l
///     flatness, cylindricity, parallelism, perpendicularity of a face
///                            (4)  r <= t                              the same
///     total runouts          (5)  r + m <= t                          the same
///     straightness           (6)  W <= t                              the same
///     profile                (7)  max |e| cos(alpha) <= t/2           r cos(alpha) <= t
///     profile without datum  (8)  r cos(alpha) <= t                   the same
///     perpendicularity of an axis, and what is left of part/tolerance_kind.hpp
///                            (9)  m <= t                              the same
///
/// with r = e_max - e_min and l, u the limits of the size.  In (6) the W of a cone is
/// radial, 1/cos(alpha) times the zone across it, which is on the safe side.  In (9) the
/// cut's deflection has no term, because it is the same all round and the axis springs
/// back; m contains the lobes of clamping and spindle and the eccentricity of
/// re-chucking. In (3) m is a form error, on the diameter, that a two-point size does not
/// show (lobes, a bent axis); (2) alone judges local sizes, the default of ISO 14405-1.
///
/// Sources: the definitions of ISO 1101 and ISO 14405-1 (from general knowledge);
/// [Valino 2008], Eqs. (9)-(24), which published_verdict reproduces.  Its (11) and (15)
/// are the last column of (1) and (2) alone, so a part wholly off its limits passes; its
/// (22), with moduli, is |e_max| + |e_min| <= t/cos(alpha), so twice the error of (7)
/// passes; its (16), (19), (23), (24) are (4) and (5) without m.  For kinds without a
/// published equation published_verdict equals `accepted`.
namespace turnwright::tolerance {

/// The element that a tolerance of perpendicularity controls; the other is its datum.
enum class Controlled { face, axis };

/// Envelope requirement (E) of ISO 14405-1 on a diameter.
enum class Envelope { none, shaft, bore };

/// A tolerance and the error of the surface to which it applies.
struct Case {
  part::ToleranceKind kind = part::ToleranceKind::diameter;
  Profile e_mm;           ///< length: of face j, positive = longer; may be empty in (9)
  Profile other_mm = {};  ///< length: of face i, positive = longer; empty: no error
  double value_mm = 0;    ///< t > 0; all kinds but diameter and length
  std::optional<part::Limits> limits = {};  ///< of diameter and length, lower < upper
  double half_angle_rad = 0;                ///< profiles: 0 <= alpha < pi/2
  double machine_mm = 0;                    ///< m >= 0, of (3), (5) and (9)
  Controlled controlled = Controlled::face;
  Envelope envelope = Envelope::none;
};

/// Whether e enters the condition, which it does everywhere but in (9).
bool counts_deflection(const Case& c);

/// Whether m enters the condition, which it does in (3), (5) and (9).
bool counts_machine(const Case& c);

struct Verdict {
  bool accepted = false;
  bool accepted_after_offset = false;  ///< could one constant offset make it conform?
  double offset_mm = 0;  ///< -(e_min + e_max)/2: centres the error about zero
  /// Tool offset, to be added to e [mm, on the radius or along the axis], that brings the
  /// surface to the middle of its limits; it equals offset_mm unless limits or m are
  /// one-sided.
  double offset_into_limits_mm = 0;
  bool published_verdict = false;  ///< by the equations of [Valino 2008]
  Extremes extremes_mm;    ///< of e or of the length's deviation; 0, 0 if e is empty
  double measured_mm = 0;  ///< value compared: in (1), (2) the spread of the size, in (7)
                           ///< twice the largest deviation, otherwise the left side
  double allowed_mm = 0;   ///< u - l or t
  double margin_mm = 0;    ///< distance to the nearest limit, < 0 outside, on the
                           ///< size (1)-(3) or the zone
  double margin_after_offset_mm = 0;  ///< allowed_mm less the part no offset can remove
  /// Distance by which the size, the located profile (normal to its surface) or the width
  /// of the zone may still change, down (min) and up (max), with the rounding allowed
  /// for; zones have no limit downwards.
  Extremes room_mm = {};
  std::string why;  ///< one sentence with the numbers, in um
};

/// The verdict on one case, independent of all others.
///
/// Comparisons allow for rounding alone, so that a part exactly on its limit conforms
/// although decimals have no exact binary form: 8 eps = 1.8e-15 of the largest numbers
/// involved (1e-17 mm for 0.01 mm), and 2e-12 of W in (6), which is found by iteration.
/// @throws std::domain_error if t or the limits are missing or invalid, if e is missing
///   where it counts, if alpha or m is out of range, or if a profile is invalid
///   (check()).
Verdict verdict(const Case& c);

}  // namespace turnwright::tolerance
