#pragma once
#include <optional>
#include <string>

#include "turnwright/part/drawing.hpp"
#include "turnwright/tolerance/piecewise.hpp"

/// Does a feature with error e(z) conform to a tolerance of the drawing?
///
/// e is the signed radius error (positive = larger radius), for faces the axial error
/// g(rho); both over the whole profile.  t is the zone's width, alpha the half angle of a
/// cone, m the machine and chucking terms, W the minimum zone of e(z).  Conditions:
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
/// with r = e_max - e_min, l and u the limits of the size.  In (6) a cone's W is radial,
/// 1/cos(alpha) of the zone across it: on the safe side.  In (9) the cut's deflection
/// has no term: it is the same all round and the axis springs back; lobes of clamping and
/// spindle and rechucking eccentricity count, and are m.  In (3) m is form that a
/// two-point size does not show (lobes, a bent axis), on the diameter; (2) alone judges
/// local sizes (ISO 14405-1's default).
///
/// Sources: ISO 1101 and ISO 14405-1 definitions (from general knowledge); G. Valino et
/// al., "Machining Error Predictive Model in a CAPP system for turning" (2008), Eqs.
/// (9)-(24), which seed_verdict reproduces: (11) and (15) are the last column of (1) and
/// (2) alone, so a part wholly off its limits passes; (22), with moduli, is
/// |e_max| + |e_min| <= t/cos(alpha), so twice the error of (7) passes; (16), (19), (23),
/// (24) are (4) and (5) without m.  Where it has no equation its verdict is `accepted`.
namespace turnwright::tolerance {

/// Which of the two the tolerance of perpendicularity controls; the other is its datum.
enum class Controlled { face, axis };

/// Envelope requirement (E) of ISO 14405-1 on a diameter.
enum class Envelope { none, shaft, bore };

/// A tolerance and the error of its feature.
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

/// Whether e enters: everywhere but in (9).
bool counts_deflection(const Case& c);

/// Whether m enters: in (3), (5) and (9).
bool counts_machine(const Case& c);

struct Verdict {
  bool accepted = false;
  bool accepted_after_offset = false;  ///< could one constant offset make it conform?
  double offset_mm = 0;  ///< -(e_min + e_max)/2: centres the error about zero
  /// What the tool must be offset by so that the feature lies in the middle of its
  /// limits, added to e [mm, on the radius or along the axis]; offset_mm unless limits or
  /// m are one-sided.
  double offset_into_limits_mm = 0;
  bool seed_verdict = false;
  Extremes extremes_mm;    ///< of e; of the length's deviation; 0, 0 if e is empty
  double measured_mm = 0;  ///< what is compared: in (1), (2) the spread of the size,
                           ///< in (7) twice the largest deviation, else the left side
  double allowed_mm = 0;   ///< u - l or t
  double margin_mm = 0;    ///< distance to the nearest limit, < 0 outside, on the
                           ///< size (1)-(3) or the zone
  double margin_after_offset_mm = 0;  ///< allowed less what no offset can remove
  /// How far the size, the located profile (normal to its surface) or the zone's width
  /// may still move, down (min) and up (max), rounding forgiven; down without end for
  /// zones.
  Extremes room_mm = {};
  std::string why;  ///< one sentence with the numbers, in um
};

/// The verdict on one case; no other case enters.
///
/// Comparisons forgive rounding alone, so that a part exactly on its limit conforms
/// although decimals have no exact double: 8 eps = 1.8e-15 of the largest numbers
/// involved (1e-17 mm for 0.01 mm); 2e-12 of W in (6), found by iteration.
/// @throws std::domain_error if t or the limits are missing or no zone, e is missing
///   where it counts, alpha or m is out of range, or a profile is none (see check()).
Verdict verdict(const Case& c);

}  // namespace turnwright::tolerance
