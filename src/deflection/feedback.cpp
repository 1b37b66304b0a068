#include "turnwright/deflection/feedback.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/root.hpp"

namespace turnwright::deflection {
namespace {

/// (1) and (2) in the depth: g(h) = h + A c h^x + B (c h^x)^2 - ap.
struct Balance {
  double A, B, c, x, ap;

  double force(double h) const { return c * std::pow(h, x); }
  double error(double F) const { return (A + B * F) * F; }  // Eq. (2)
  double value(double h) const { return h + error(force(h)) - ap; }
  double slope(double h) const {
    const double F = force(h);
    return 1 + (A + 2 * B * F) * x * F / h;
  }
};

/// An h > 0 with g(h) >= 0 and none below ap; g(0) = -ap.
double above(const Balance& g) {
  double h = g.ap;
  // small steps, for g may come down again soon when x > 1
  while (!(g.value(h) >= 0)) {
    h *= 1.05;
    if (!(h <= 100 * g.ap))
      throw ModelRangeError(
          say("the feed force pulls the part into the tool without end: loop gain {:f}",
              g.A * g.c * g.x * std::pow(g.ap, g.x - 1)));
  }
  return h;
}

// Newton needs about five steps.
double depth(const Balance& g) {
  const double high = above(g);
  const auto value_and_slope = [&g](double h) {
    return std::pair{g.value(h), g.slope(h)};
  };
  return bracketed_root(value_and_slope, 0, high, high,
                        std::numeric_limits<double>::epsilon());
}

Balance balance(double D_mm, const Flexibility& radial, const Flexibility& tangential,
                const ForceLaw& law) {
  if (!(D_mm > 0 && law.c_N > 0 && law.x > 0 && law.ap_mm > 0))
    throw std::domain_error("equilibrium: D, c, x and ap must be positive");
  const double t = tangential.f_ww_mm_N * law.Ft_over_Fr;
  return {radial.f_ww_mm_N - radial.f_wp_rad_N * law.Fa_over_Fr * D_mm / 2, t * t / D_mm,
          law.c_N, law.x, law.ap_mm};
}

}  // namespace

Equilibrium equilibrium(double D_mm, const Flexibility& radial,
                        const Flexibility& tangential, const ForceLaw& law) {
  const Balance g = balance(D_mm, radial, tangential, law);
  const double Fr = g.force(depth(g)), uncoupled = g.force(g.ap);
  return {.Fr_N = Fr,
          .radius_error_mm = g.error(Fr),
          .radius_error_without_feedback_mm = g.error(uncoupled),
          .loop_gain = g.A * g.x * uncoupled / g.ap};  // Eq. (3)
}

std::vector<double> radius_errors_of_passes(double D_mm, const Flexibility& radial,
                                            const Flexibility& tangential, ForceLaw law,
                                            std::span<const double> ap_mm) {
  std::vector<double> errors;
  double left_over = 0;
  for (const double ap : ap_mm) {
    if (!(ap >= 0)) throw std::domain_error("passes: depths must be >= 0 mm");
    law.ap_mm = ap + left_over;
    // a tool that does not reach the surface leaves it as it is
    left_over = law.ap_mm > 0 ? equilibrium(D_mm, radial, tangential, law).radius_error_mm
                              : law.ap_mm;
    errors.push_back(left_over);
  }
  return errors;
}

}  // namespace turnwright::deflection
