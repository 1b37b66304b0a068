#pragma once
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "characteristic.hpp"
#include "series.hpp"

namespace turnwright::chatter {

/// |x| without hypot's care for numbers that overflow when squared: there are none here.
inline double modulus(Complex x) { return std::sqrt(std::norm(x)); }

/// What a count at the depths w and on the circle |z| = rho needs to know of
///
///     g(w, theta) = u^(-m/2) f(z, kappa),  u = e^(-i theta),  z = rho u,            (1)
///     kappa = w (1 - z)
///
/// at one point and around it; m is the degree of f in z, an even number, and the factor
/// makes g turn slowly.
struct Local {
  Complex g;                      ///< value at the centre of the box
  Complex g_w, g_theta;           ///< derivatives there
  double ww = 0, wt = 0, tt = 0;  ///< bounds on the second derivatives in all of the box
  double unseen = 0;  ///< what g hides in its slopes times the half widths: bound
};

/// w within w_half of w, theta within theta_half of theta.
struct Box {
  double w = 0, w_half = 0;
  double theta = 0, theta_half = 0;
  Complex u() const { return std::polar(1.0, -theta); }
};

/// A disc that holds the kappa of every point of the box; u is that of the box.
struct Disc {
  Complex centre;
  double radius = 0;
};
Disc disc(const Box& box, Complex u, double rho);
inline bool holds(const Disc& outer, const Disc& inner) {
  return modulus(inner.centre - outer.centre) + inner.radius <= outer.radius;
}

/// Taylor series in kappa of the coefficients of f, good in a disc:
///
///     f(z, kappa) = sum_i (z/rho)^i sum_j c_ij ((kappa - centre)/radius)^j (2)
///
/// found by sampling on the rim.  Bounds on derivatives are the sums of moduli, so they
/// hold for every point of the disc, and are the sharper the smaller it is.
class Patch {
 public:
  /// f at one point and bounds on the moduli of its second derivatives nearby.
  struct Point {
    Complex f, f_z, f_kappa;
    double kk = 0, kz = 0, zz = 0;
  };

  /// @param disc  inside the circle of the series.
  static Patch of(const Series& series, const Disc& disc, double rho);

  /// None if the disc is too large for the series to be precise at its centre.
  static std::optional<Patch> sampled(const Characteristic& f, const Disc& disc,
                                      double rho);

  /// The same function about another disc inside this one.
  Patch shifted(const Disc& disc) const;

  const Disc& disc() const { return disc_; }
  /// Errors of g in the disc are smaller.
  double noise() const { return noise_; }
  /// By how much g changes over the disc, to first order: noise far below that is none.
  double change() const;
  /// |g| at the disc's centre and some z, for telling whether the noise matters.
  double scale() const;

  /// @param box  its disc must lie in this one; u is that of the box.
  Local at(const Box& box, Complex u) const;

  /// Bounds hold within `reach` of kappa and `dz` of z, as far as that is inside the disc
  /// and |z| <= rho.
  Point point(Complex z, Complex kappa, double reach, double dz) const;

 private:
  /// The first and the last coefficient of f are constant.
  std::size_t terms_of(std::size_t i) const {
    return i == 0 || i + 1 == powers_ ? 1 : terms_;
  }
  /// c_i at t, its derivative, and half of its second one.
  struct Coefficient {
    Complex value, slope, curve;
  };
  Coefficient coefficient(std::size_t i, Complex t) const;
  void keep(std::size_t terms);
  /// Leaves out the last terms as far as their sizes add up to less than `most`.
  void drop(std::span<const double> size, double most);
  void bound();

  Disc disc_;
  double rho_ = 1;
  std::size_t powers_ = 0;  // of z: c_i, i = 0 .. powers_ - 1
  std::size_t terms_ = 0;   // of kappa
  std::vector<Complex> c_;  // [i * terms_ + j]
  double noise_ = 0;
  double slope_noise_ = 0;  // errors of the derivative by t, of terms dropped
  /// Bounds on derivatives of f in all of |t| <= 1, t = (kappa - centre)/radius, by their
  /// order in t (T) and u = z/rho (U).
  struct Bounds {
    double TT = 0, TU = 0, UU = 0, TTT = 0, TTU = 0, TUU = 0, UUU = 0;
  };
  Bounds inside_;  // in |u| <= 1
  Bounds on_rim_;  // on |u| = 1: of u^(-m/2) f, U standing for the operator u d/du
};

}  // namespace turnwright::chatter
