#pragma once
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "propagator.hpp"

namespace turnwright::chatter {

inline constexpr std::size_t kSeriesTerms = 96;  ///< at most

/// The coefficients of f(z, kappa) = det(I - z Phi(kappa)) = sum_i c_i(kappa) z^i as real
/// polynomials about kappa = 0, which serve every depth and every multiplier at once:
///
///     c_i(kappa) = sum_j c[i][j] (kappa/radius)^j,   |kappa| <= radius              (1)
///
/// The stretches are multiplied as polynomials, so that what rounding leaves of a
/// coefficient is small beside the sum of moduli it was made of, and errors fall with
/// |kappa| as (1) does.  c_0 = 1 and c_m = det Phi are known.
/// Source: derived here.
struct Series {
  double radius_mm = 0;
  std::vector<std::vector<double>> c;
  std::vector<double> size, minors;  ///< bound |Phi| and its minors of order 2, as c c_i
  double rounding = 0;               ///< of Phi, relative to that bound

  std::size_t states() const { return c.size() - 1; }
  /// Errors of f are smaller for |z| <= 1.
  double noise(double kappa_abs) const;
};

/// f and its derivatives at one point.
struct SeriesValue {
  std::complex<double> f, f_z, f_kappa;
};
SeriesValue value(const Series& series, std::complex<double> z,
                  std::complex<double> kappa_mm);

/// None if there are more than two modes (the minors of Phi become too many) or if f
/// needs more terms than are worth it.
/// @param kappa_max  for which the propagator was made.
std::optional<Series> series(const Propagator& propagator, double kappa_max_mm);

/// The series of one spindle speed for depths up to `depth_mm`, as deep as it is precise
/// but not deeper than asked; none if there is none.
struct DeepSeries {
  Series series;
  double depth_mm = 0;
};
std::optional<DeepSeries> series_up_to(const System& system,
                                       const std::vector<ArcLoad>& arcs, double n_rpm,
                                       double ap_max_mm);

}  // namespace turnwright::chatter
