#pragma once
#include <complex>
#include <memory>
#include <vector>

#include "propagator.hpp"

namespace turnwright::chatter {

using Complex = std::complex<double>;

/// Coefficients of f(z) at one kappa, times e^-log_scale.
struct Coefficients {
  std::vector<Complex> c;  ///< of z^0 .. z^m
  double log_scale = 0;
};

/// The characteristic function of one spindle speed:
///
///     f(z, kappa) = det(I - z Phi(kappa)) = sum_i c_i(kappa) z^i                    (1)
///
/// mu = 1/z is a multiplier at the depth w if f(z, w (1 - z)) = 0.  That function of z is
/// entire and 1 at z = 0, so its zeros inside the unit circle belong to the unstable
/// multipliers.  c_0 = 1 and c_m = det Phi are known (Liouville).
///
/// A small Phi is multiplied out.  Where the growth over the period would cost digits,
/// the intervals are eliminated one by one with pivoting instead, as in multiple
/// shooting; (1) is then the determinant of the remaining system times the pivots.
class Characteristic {
 public:
  Characteristic(const System& system, double n_rpm, const Resolution& resolution);
  /// @param arcs  the arcs of the system at that speed.
  Characteristic(const System& system, std::vector<ArcLoad> arcs, double n_rpm,
                 const Resolution& resolution);

  std::size_t states() const { return 2 * system_->modes.size(); }
  double tau_s() const { return tau_s_; }
  const System& system() const { return *system_; }
  double growth(double kappa_mm) const {
    return chatter::growth(*system_, arcs_, kappa_mm);
  }

  /// @param kappa_max  at least |kappa|.  Values at one kappa differ by the error of the
  ///   method for different kappa_max; for one kappa_max they are smooth.
  /// @throws ModelRangeError once the evaluations of a search have taken seconds.
  Coefficients at(Complex kappa, double kappa_max) const;

  /// f(z, w (1 - z)) times a positive number that is 1 unless f would overflow.
  Complex value(Complex z, double w_mm) const;

  const std::vector<ArcLoad>& arcs() const { return arcs_; }
  double n_rpm() const { return n_rpm_; }

 private:
  const Propagator& propagator_for(double kappa_abs) const;

  const System* system_;
  std::vector<ArcLoad> arcs_;
  double n_rpm_, tau_s_;
  Resolution resolution_;
  mutable std::vector<std::pair<double, std::unique_ptr<Propagator>>> made_;
  mutable std::size_t work_ = 0;
};

}  // namespace turnwright::chatter
