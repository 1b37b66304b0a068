#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "turnwright/planning/process_plan.hpp"

/// What tools leave of a part: heights of the material over a fine grid along the axis,
/// cut by the tools' own outlines.  Knows nothing of how ways are made.
namespace turnwright::nc::test {

inline constexpr double kGrid_mm = 0.01;

/// Lower outline of a tool about its corner's centre: a circle, the minor edge behind it,
/// upright before it.  A blade is flat and as wide as it is.
struct Outline {
  double re_mm = 0, minor_rad = 0, blade_mm = 0;
  double behind_mm = 8;  ///< length of the minor edge

  double reach() const { return blade_mm > 0 ? blade_mm : re_mm + behind_mm; }
  /// Height over the centre at a distance s behind it.
  double operator()(double s) const {
    const double sine = re_mm * std::sin(minor_rad), cosine = re_mm * std::cos(minor_rad);
    if (s < sine) return -std::sqrt(std::max(0.0, re_mm * re_mm - s * s));
    return -cosine + (s - sine) * std::tan(minor_rad);
  }
  /// Where the outline has a slope, held in its range.
  double at_slope(double m) const {
    if (m >= std::tan(minor_rad)) return behind_mm;
    return re_mm * m / std::sqrt(1 + m * m);
  }
};

/// A height h over z, h into the air (outside h = x, in a bore h = -x).
class Material {
 public:
  Material(double z0, double z1, double h)
      : z0_(z0), h_(static_cast<std::size_t>((z1 - z0) / kGrid_mm) + 1, h) {}

  double z(std::size_t i) const { return z0_ + kGrid_mm * static_cast<double>(i); }
  std::size_t size() const { return h_.size(); }
  double operator[](std::size_t i) const { return h_[i]; }
  void remove(std::size_t i) { h_[i] = -INFINITY; }
  void put(std::size_t i, double h) { h_[i] = h; }

  /// Takes off what the tool meets on a straight way of its tip, in a frame with the free
  /// end at +z; `frame` makes z of the frame from z of the part.
  template <class Frame>
  void cut(const Outline& o, const Frame& frame, double h_a, double z_a, double h_b,
           double z_b) {
    const auto [from, to] = below(o, frame, z_a, z_b);
    for (std::size_t i = from; i < to; ++i)
      h_[i] = std::min(h_[i], lowest(o, frame(z(i)), h_a, z_a, h_b, z_b));
  }
  /// The most that such a way would take off.
  template <class Frame>
  double would_cut(const Outline& o, const Frame& frame, double h_a, double z_a,
                   double h_b, double z_b) const {
    double most = 0;
    const auto [from, to] = below(o, frame, z_a, z_b);
    for (std::size_t i = from; i < to; ++i)
      most = std::max(most, h_[i] - lowest(o, frame(z(i)), h_a, z_a, h_b, z_b));
    return most;
  }
  template <class Frame>
  void drill(double D, double z_full, const Frame& frame) {
    for (std::size_t i = 0; i < h_.size(); ++i)
      if (frame(z(i)) >= z_full) h_[i] = std::min(h_[i], -D / 2);
  }
  template <class Frame>
  void countersink(double slope, double D, double z_point, const Frame& frame) {
    for (std::size_t i = 0; i < h_.size(); ++i)
      if (frame(z(i)) >= z_point)
        h_[i] = std::min(h_[i], -std::min(D / 2, slope * (frame(z(i)) - z_point)));
  }

 private:
  // The places that a way's outlines reach.
  template <class Frame>
  std::pair<std::size_t, std::size_t> below(const Outline& o, const Frame& frame,
                                            double z_a, double z_b) const {
    const double first = frame(z(0)), step = frame(z(1)) - first;
    double a = (std::min(z_a, z_b) - first) / step;
    double b = (std::max(z_a, z_b) + o.re_mm + o.reach() - first) / step;
    if (a > b) std::swap(a, b);
    const auto held = [&](double i) {
      return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(h_.size())));
    };
    return {held(std::floor(a) - 1), held(std::ceil(b) + 2)};
  }
  // Of the outline over a place while the tip goes from a to b; infinite if it never is
  // there.
  static double lowest(const Outline& o, double z, double h_a, double z_a, double h_b,
                       double z_b) {
    if (z_a > z_b) {
      std::swap(z_a, z_b);
      std::swap(h_a, h_b);
    }
    if (o.blade_mm > 0) {
      const double first = std::max(z_a, z - o.blade_mm), last = std::min(z_b, z);
      if (first > last) return INFINITY;
      if (!(z_b - z_a > 1e-12)) return std::min(h_a, h_b);
      const double slope = (h_b - h_a) / (z_b - z_a);
      return h_a + std::min(slope * (first - z_a), slope * (last - z_a));
    }
    const double r = o.re_mm;
    const double from = std::max(z_a, z - r - o.behind_mm), to = std::min(z_b, z);
    if (from > to) return INFINITY;
    // The tip at t has the centre at t + r, and the place is s = z - t - r behind it.
    const auto height = [&](double t) {
      const double u = z_b > z_a ? (t - z_a) / (z_b - z_a) : 0;
      return h_a + u * (h_b - h_a) + r + o(z - t - r);
    };
    if (!(z_b - z_a > 1e-12)) return std::min(h_a, h_b) + r + o(z - z_a - r);
    const double slope = (h_b - h_a) / (z_b - z_a);
    const double t = std::clamp(z - r - o.at_slope(slope), from, to);
    return height(t);
  }

  double z0_;
  std::vector<double> h_;
};

}  // namespace turnwright::nc::test
