#pragma once
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "characteristic.hpp"
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
///
/// With more than two modes Phi has too many minors.  Then (1) comes from samples of f on
/// the rim |kappa| = radius, and its errors are alike in all of the disc.
/// Source: derived here.
struct Series {
  double radius_mm = 0;
  std::vector<std::vector<double>> c;
  std::vector<double> size, minors;  ///< bounds of |Phi| and of its minors of order 2
  double rounding = 0;               ///< rounding of Phi, relative to its bound
  double sampling = 0;               ///< errors of samples of f

  std::size_t states() const { return c.size() - 1; }
  std::size_t terms() const { return c[1].size(); }
  /// Bound of the errors of f for |z| <= 1.
  double noise(double kappa_abs) const;
};

/// Coefficients of f(z, w (1 - z)) by powers of z, at one depth.
std::vector<double> by_powers(const Series& series, double w_mm);

/// f and its derivatives at one point.
struct SeriesValue {
  std::complex<double> f, f_z, f_kappa;
};
SeriesValue value(const Series& series, std::complex<double> z,
                  std::complex<double> kappa_mm);

/// The series of a system of one or two modes; none if f needs too many terms.
/// @param kappa_max  the value for which the propagator was made.
std::optional<Series> series(const Propagator& propagator, double kappa_max_mm);

/// The series of any system; none if f needs too many terms, or is so large that rounding
/// exceeds `noise`.
std::optional<Series> sampled_series(const Characteristic& f, double kappa_max_mm,
                                     double noise);

/// The series of one spindle speed for depths up to `depth_mm`, which is ap_max or the
/// depth at which the series ceases to be precise; none if there is no series.
/// @param most_growth  by `growth`, beyond which none is tried.
struct DeepSeries {
  Series series;
  double depth_mm = 0;
};
std::optional<DeepSeries> series_up_to(const Characteristic& f, double ap_max_mm,
                                       double most_growth = 100);

}  // namespace turnwright::chatter
