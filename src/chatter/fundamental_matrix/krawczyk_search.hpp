#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/say.hpp"
#include "taylor_patch.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

/// The search for zeros of g(w, theta) of taylor_patch.hpp box by box, see
/// stability_crossings.hpp.
namespace turnwright::chatter {

inline double cross(Complex a, Complex b) {
  return a.real() * b.imag() - a.imag() * b.real();
}
inline double dot(Complex a, Complex b) {
  return a.real() * b.real() + a.imag() * b.imag();
}

/// Distance of 0 from the segment p + t d, |t| <= 1.
inline double distance(Complex p, Complex d) {
  const double t =
      std::norm(d) > 0 ? std::clamp(-dot(p, d) / std::norm(d), -1.0, 1.0) : 0;
  return modulus(p + t * d);
}

inline constexpr std::size_t kBoxes = 400000;  // a few seconds

enum class Verdict { none, one, unclear };

struct Judged {
  Verdict verdict = Verdict::unclear;
  double s = 0, t = 0;  // of the zero, in half widths of the box
};

/// Decides by the local bounds whether g has no zero or exactly one in the box.
inline Judged judge(const Local& g, const Box& box, double noise) {
  const Complex D = g.g_w * box.w_half, E = g.g_theta * box.theta_half;
  const double ww = g.ww * box.w_half * box.w_half,
               wt = g.wt * box.w_half * box.theta_half,
               tt = g.tt * box.theta_half * box.theta_half;
  const double rest = (ww + 2 * wt + tt) / 2 + noise;
  const double size_D = modulus(D), size_E = modulus(E);
  if (modulus(g.g) > size_D + size_E + rest) return {Verdict::none};

  const double det = cross(D, E);
  if (det == 0) return {};
  const double s = -cross(g.g, E) / det, t = -cross(D, g.g) / det;
  const bool inside = std::abs(s) <= 1 && std::abs(t) <= 1;
  if (!inside) {
    const double far = std::min({distance(g.g + D, E), distance(g.g - D, E),
                                 distance(g.g + E, D), distance(g.g - E, D)});
    if (far > rest) return {Verdict::none};
  }
  // [Krawczyk 1969]: with Y = (D E)^-1 the map x -> x - Y g(x) contracts by q in the box,
  // and sends the box into the Newton point +- (q + noise).
  const double row = std::max(size_D, size_E) / std::abs(det);
  const double q = row * (ww + 2 * wt + tt + g.unseen), slack = q + row * noise;
  if (!(q < 1)) return {};
  if (std::abs(s) > 1 + slack || std::abs(t) > 1 + slack) return {Verdict::none};
  if (std::abs(s) + slack <= 1 && std::abs(t) + slack <= 1) return {Verdict::one, s, t};
  return {};
}

/// g is real at theta = 0 and pi; boxes at these lines are symmetric about them.
enum class Line { none, at_zero, at_pi };

/// @tparam Source  provides g: a type `Patch`, and `pick`, which returns a patch for a
///   box, or none.
template <class Source>
class Search {
 public:
  using Patch = typename Source::Patch;
  explicit Search(Source source) : source_(std::move(source)) {}

  /// Finds all zeros with w in [from, to], with those at theta = 0 only if `with_zero`.
  void strip(double from, double to, const Patch* patch, bool with_zero = false) {
    const double half = (to - from) / 2, w = from + half;
    constexpr double kLine = units::kPi / 6;  // half height of the box about a line
    go({w, half, units::kPi, kLine}, Line::at_pi, patch);
    const double low = with_zero ? kLine : 0, middle = (units::kPi - kLine - low) / 2;
    go({w, half, low + middle, middle}, Line::none, patch);
    if (with_zero) go({w, half, 0, kLine}, Line::at_zero, patch);
  }

  const Source& source() const { return source_; }
  const std::vector<Box>& found() const { return found_; }

 private:
  void go(const Box& box, Line line, const Patch* above) {
    constexpr double kSmallest = 1e-13, kNothing = 1e-30;  // halved one way without end
    if ((box.theta_half < kSmallest && box.w_half < kSmallest * box.w) ||
        box.theta_half < kNothing || box.w_half < kNothing * box.w)
      throw ModelRangeError(
          tr("milling: multipliers that meet on the circle cannot be told apart; ask for "
             "another speed"));
    if (++boxes_ > kBoxes)
      throw ModelRangeError(
          say("milling: the search for stability limits at a speed needs more than {} "
              "boxes; ask for a smaller ap_max_mm or a higher speed",
              kBoxes));
    constexpr double kInflation =
        1.01;  // so that zeros on the borders of boxes are found
    Box wide = box;
    wide.w_half *= kInflation;
    wide.theta_half *= kInflation;
    std::optional<Patch> own;
    const Complex u = box.u();
    const Patch* patch = source_.pick(above, wide, u, own);
    Local g;
    if (patch) {
      g = patch->at(wide, u);
      const Judged judged = judge(g, wide, patch->noise());
      if (judged.verdict == Verdict::none) return;
      if (judged.verdict == Verdict::one) {
        Box zero = wide;
        zero.w += judged.s * wide.w_half;
        if (line == Line::none) zero.theta += judged.t * wide.theta_half;
        found_.push_back(zero);
        return;
      }
    }
    split(box, u, line, g, patch ? patch : (above && !own ? above : nullptr));
  }

  void split(const Box& box, Complex u, Line line, const Local& g, const Patch* patch) {
    double by_w = box.w_half * modulus(1.0 - u), by_theta = box.w * box.theta_half;
    if (g.tt > 0) {
      by_w = std::sqrt(g.ww) * box.w_half;
      by_theta = std::sqrt(g.tt) * box.theta_half;
    }
    Box part = box;
    if (by_w > by_theta) {
      part.w_half = box.w_half / 2;
      part.w = box.w - part.w_half;
      go(part, line, patch);
      part.w = box.w + part.w_half;
      go(part, line, patch);
    } else if (line != Line::none) {
      part.theta_half = box.theta_half / 3;
      go(part, line, patch);
      part.theta += (line == Line::at_pi ? -2 : 2) * part.theta_half;
      go(part, Line::none, patch);
    } else {
      part.theta_half = box.theta_half / 2;
      part.theta = box.theta - part.theta_half;
      go(part, Line::none, patch);
      part.theta = box.theta + part.theta_half;
      go(part, Line::none, patch);
    }
  }

  Source source_;
  std::vector<Box> found_;
  std::size_t boxes_ = 0;
};

}  // namespace turnwright::chatter
