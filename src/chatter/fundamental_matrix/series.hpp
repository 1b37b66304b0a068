#pragma once
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "propagator.hpp"

namespace turnwright::chatter {

inline constexpr std::size_t kSeriesTerms = 96;  ///< at most

/// The coefficients of f(z, kappa) = det(I - z Phi(kappa)) = sum_i c_i(kappa) z^i as real
/// polynomials about kappa = 0, valid for every depth and every multiplier at once:
///
///     c_i(kappa) = sum_j c[i][j] (kappa/radius)^j,   |kappa| <= radius              (1)
///
/// The intervals are multiplied as polynomials.  So the rounding error of a coefficient
/// is small compared with the sum of moduli of its terms, and errors fall with |kappa| as
/// (1) does.  c_0 = 1 and c_m = det Phi are known.
/// Source: derived here.
struct Series {
  double radius_mm = 0;
  std::vector<std::vector<double>> c;
  std::vector<double> size, minors;  ///< bounds of |Phi| and of its minors of order 2
  double rounding = 0;               ///< rounding of Phi, relative to its bound

  std::size_t states() const { return c.size() - 1; }
  /// Bound of the errors of f for |z| <= 1.
  double noise(double kappa_abs) const;
};

/// f and its derivatives at one point.
struct SeriesValue {
  std::complex<double> f, f_z, f_kappa;
};
SeriesValue value(const Series& series, std::complex<double> z,
                  std::complex<double> kappa_mm);

/// The series; none if there are more than two modes, because Phi then has too many
/// minors, or if f needs too many terms.
/// @param kappa_max  the value for which the propagator was made.
std::optional<Series> series(const Propagator& propagator, double kappa_max_mm);

/// The series of one spindle speed for depths up to `depth_mm`, which is ap_max or the
/// depth at which the series ceases to be precise; none if there is no series.
struct DeepSeries {
  Series series;
  double depth_mm = 0;
};
std::optional<DeepSeries> series_up_to(const System& system,
                                       const std::vector<ArcLoad>& arcs, double n_rpm,
                                       double ap_max_mm);

}  // namespace turnwright::chatter
