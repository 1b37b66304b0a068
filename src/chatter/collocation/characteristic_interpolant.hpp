#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "chatter/fundamental_matrix/krawczyk_search.hpp"

namespace turnwright::chatter {

/// The characteristic function f(z) = sum_l d_l z^l of a cut at one depth.
struct DepthSample {
  std::vector<double> d;
  double noise = 0;                 ///< bound of the errors of f for |z| <= 1
  std::optional<int> outside = {};  ///< multipliers outside the unit circle
};
/// By all multipliers but those too small to matter.
DepthSample depth_sample(const std::vector<Complex>& multipliers);

/// `counted` where the multipliers outside are wanted, too.
using SampleAt = std::function<DepthSample(double w_mm, bool counted)>;

/// Interpolant of the characteristic function of a delayed motion
///
///     f(z, w) = prod_i (1 - z mu_i(w)) = sum_l d_l(w) z^l                            (1)
///
/// over depths from a to b.  f is entire in z, so its coefficients decay:
///
///     d_l(w) = sum_k d_lk T_k(t),   t = (2 w - a - b)/(b - a)                        (2)
///
/// with Chebyshev polynomials through samples at their extrema.  Zeros inside the unit
/// circle belong to the unstable multipliers, as in taylor_patch.hpp.
/// Source: derived here.
class CharacteristicInterpolant {
 public:
  /// None if 17 depths leave a tail above `tail` of sum_l |d_l|.
  static std::optional<CharacteristicInterpolant> sampled(const SampleAt& sample,
                                                          double from_mm, double to_mm,
                                                          double tail);

  double from_mm() const { return middle_ - half_; }
  double to_mm() const { return middle_ + half_; }
  /// Multipliers outside the circle at the two ends.
  int unstable_at_from() const { return below_; }
  int unstable_at_to() const { return above_; }

  /// Bound of the errors of f: the tail of (2), rounding and the noise of the samples.
  double noise() const { return noise_; }
  /// g over f at an angle.
  Complex phase(double theta) const { return std::polar(1.0, shift_ * theta); }

  /// g = e^(i s theta) f(e^(-i theta), w) over a box, as in taylor_patch.hpp, with the
  /// integer s for which the argument of g varies slowly.
  Local at(const Box& box, Complex u) const;

 private:
  double middle_ = 0, half_ = 0, noise_ = 0;
  int below_ = 0, above_ = 0;
  std::size_t powers_ = 0, terms_ = 0;  // of z, of Chebyshev's series
  double shift_ = 0;                    // s
  std::vector<double> d_;               // d_lk, [k * powers_ + l]
  /// Bounds on derivatives of g by t (T) and theta (U) on all of the interpolant.
  struct Bounds {
    double TTT = 0, TTU = 0, TUU = 0, UUU = 0;
  } most_;
};

}  // namespace turnwright::chatter
