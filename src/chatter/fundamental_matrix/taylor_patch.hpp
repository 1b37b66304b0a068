#pragma once
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "characteristic.hpp"
#include "series.hpp"

namespace turnwright::chatter {

/// |x| without hypot's protection against overflow, which is not needed here.
inline double modulus(Complex x) { return std::sqrt(std::norm(x)); }

/// Local expansion of
///
///     g(w, theta) = u^(-m/2) f(z, kappa),  u = e^(-i theta),  z = rho u,            (1)
///     kappa = w (1 - z)
///
/// over a box of depths w and angles theta on the circle |z| = rho.  m is the degree of f
/// in z, an even number; the factor makes the argument of g vary slowly.
struct Local {
  Complex g;                      ///< value at the centre of the box
  Complex g_w, g_theta;           ///< derivatives there
  double ww = 0, wt = 0, tt = 0;  ///< bounds on the second derivatives in all of the box
  double unseen = 0;  ///< bound of the errors of the slopes times the half widths
};

/// A box: depths within w_half of w, angles within theta_half of theta.
struct Box {
  double w = 0, w_half = 0;
  double theta = 0, theta_half = 0;
  Complex u() const { return {std::cos(theta), -std::sin(theta)}; }
};

/// A disc that contains the kappa of every point of the box; u is that of the box.
struct Disc {
  Complex centre;
  double radius = 0;
};
Disc disc(const Box& box, Complex u, double rho);
inline bool holds(const Disc& outer, const Disc& inner) {
  return modulus(inner.centre - outer.centre) + inner.radius <= outer.radius;
}

/// Taylor polynomials in kappa of the coefficients of f, valid in a disc:
///
///     f(z, kappa) = sum_i (z/rho)^i sum_j c_ij ((kappa - centre)/radius)^j (2)
///
/// computed from samples on the rim.  Bounds on derivatives are sums of moduli, so they
/// hold at every point of the disc; they are sharper in smaller discs.
class Patch {
 public:
  /// f at one point, with bounds on the moduli of its second derivatives nearby.
  struct Point {
    Complex f, f_z, f_kappa;
    double kk = 0, kz = 0, zz = 0;
  };

  /// @param disc  inside the circle of convergence of the series.
  static Patch of(const Series& series, const Disc& disc, double rho);

  /// A patch from samples; none if the disc is too large for the required precision.
  static std::optional<Patch> sampled(const Characteristic& f, const Disc& disc,
                                      double rho);

  /// The same function about another disc inside this one.
  Patch shifted(const Disc& disc) const;

  const Disc& disc() const { return disc_; }
  /// Bound of the errors of g in the disc.
  double noise() const { return noise_; }
  /// First-order change of g over the disc; noise far below it does not matter.
  double change() const;
  /// |g| at the disc's centre for some z, with which the noise is compared.
  double scale() const;

  /// @param box  a box whose disc lies in this one; u is that of the box.
  Local at(const Box& box, Complex u) const;

  /// f at a point; the bounds hold within `reach` of kappa and `dz` of z, inside the disc
  /// and for |z| <= rho.
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
  /// Drops the last terms as long as their sizes add up to less than `most`.
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
