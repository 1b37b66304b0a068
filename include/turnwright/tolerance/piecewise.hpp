#pragma once
#include <variant>
#include <vector>

/// The error e(z) over a surface, and the widths of the narrowest zones that contain it.
namespace turnwright::tolerance {

/// Piece k on [breaks_mm[k], breaks_mm[k + 1]]:
///
///     e(z) = sum_j c[k][j] s^j,   s = z - breaks_mm[k]                  (1)
///
/// with z, s and e in mm and c[k][j] in mm^(1 - j), in ascending powers.  Neighbouring
/// pieces may differ at their common break (a step); both values count.
struct PiecewisePolynomial {
  std::vector<double> breaks_mm;
  std::vector<std::vector<double>> coefficients;
};

/// Measured or computed points of e(z); no values are assumed between them.
struct Samples {
  std::vector<double> z_mm = {};  ///< rising; empty: equally spaced
  std::vector<double> e_mm;
};

/// The error e(z) of a surface.  Of a face, z stands for the radius rho and e for the
/// axial error g.
using Profile = std::variant<Samples, PiecewisePolynomial>;

/// Whether the profile has no point, for a surface whose error is not given.
bool empty(const Profile& profile);

/// @throws std::domain_error if there is no point, a number is not finite, positions fall
///   (samples) or do not rise (breaks), or counts do not match.
void check(const Profile& profile);

struct Extremes {
  double min_mm = 0, max_mm = 0;
};

/// Least and largest e, for polynomials over every whole piece with its ends.  The
/// turning points are found through the sequence of derivatives: between two neighbouring
/// roots of p'' the derivative p' is monotone, and bisection finds its root to the last
/// bit; the sequence starts at the linear derivative.  No start value is needed and no
/// turning point is missed.
/// @throws std::domain_error as check().
Extremes extremes(const Profile& profile);

/// The largest number in the evaluation of e, sum_j |c_j| h^j or |e| [mm].  Rounding
/// errors of e are a few times 2.2e-16 of it.
double magnitude_mm(const Profile& profile);

struct Zone {
  double width_mm = 0;
  double slope = 0;  ///< of the zone's middle line, mm/mm (per sample if equally spaced)
};

/// Minimum zone of straightness (Chebyshev's best line):
///
///     width = min over a of [ max_z (e - a z) - min_z (e - a z) ]        (2)
///
/// measured along e; across the zone it is cos(atan a) times as wide, 5e-9 less at
/// a = 1e-4.
/// Samples: exact, because the best line is parallel to an edge of their convex hull.
/// Polynomials: by the exchange method.  The best line of finitely many points of the
/// curve is a lower bound; the extremes of the curve about that line give an upper bound
/// and the next points.  It ends when the two agree within 1e-12 of the width or within
/// the rounding of e.
/// Source: [Stiefel 1959], the exchange; checked in piecewise_test.
/// @throws std::domain_error as check().
Zone minimum_zone(const Profile& profile);

}  // namespace turnwright::tolerance
