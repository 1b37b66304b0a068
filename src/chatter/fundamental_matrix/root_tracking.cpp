#include "root_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "taylor_patch.hpp"

namespace turnwright::chatter {
namespace {

struct Slope {
  Complex f, z, w;  // F(z, w) = f(z, w (1 - z)) and its derivatives
};

Slope slope_of(const Patch::Point& p, double w, Complex z) {
  return {p.f, p.f_z - w * p.f_kappa, (1.0 - z) * p.f_kappa};
}

/// A step with the disc of its zeros.
struct Step {
  double middle = 0, half = 0;
  Complex z;
  double radius = 0;
  Disc disc() const {
    return {middle * (1.0 - z), half * (std::abs(1.0 - z) + radius) + middle * radius};
  }
};

/// Whether the disc contains exactly one zero for every depth of the step, with F_zz =
/// f_zz - 2 w f_kz + w^2 f_kk, F_zw = (1 - z)(f_kz - w f_kk) - f_k, F_ww = (1 - z)^2
/// f_kk.
bool shown(const Patch& patch, const Step& step) {
  const Patch::Point p =
      patch.point(step.z, step.middle * (1.0 - step.z), step.disc().radius, step.radius);
  const Slope F = slope_of(p, step.middle, step.z);
  const double w = step.middle + step.half, q = std::abs(1.0 - step.z) + step.radius;
  const double reach = step.disc().radius;
  const double zz = p.zz + 2 * w * p.kz + w * w * p.kk;
  const double zw =
      q * (p.kz + w * p.kk) + std::abs(p.f_kappa) + p.kk * reach + p.kz * step.radius;
  const double ww = q * q * p.kk;
  const double at_centre = std::abs(F.f) + std::abs(F.w) * step.half +
                           ww * step.half * step.half / 2 + patch.noise();
  return at_centre + (zz * step.radius + zw * step.half) * step.radius <
         std::abs(F.z) * step.radius;
}

}  // namespace

Complex zero_near(const Characteristic& f, double w_mm, Complex z) {
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const Complex h = 1e-6 * (1.0 + std::abs(z));
    const Complex value = f.value(z, w_mm);
    const Complex slope = (f.value(z + h, w_mm) - f.value(z - h, w_mm)) / (2.0 * h);
    const Complex step = value / slope;
    z -= step;
    if (!(std::abs(z) < 1e6)) break;
    if (std::abs(step) < 1e-13 * std::abs(z)) return z;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

namespace {

/// A zero near z by Newton's method inside a patch; NaN if it leaves the patch.
Complex zero_in(const Patch& patch, double w, Complex z) {
  constexpr int kSteps = 20;
  for (int i = 0; i < kSteps; ++i) {
    const Complex kappa = w * (1.0 - z);
    if (!holds(patch.disc(), {kappa, 0})) break;
    const Slope F = slope_of(patch.point(z, kappa, 0, 0), w, z);
    const Complex step = F.f / F.z;
    z -= step;
    if (std::abs(step) < 1e-11) return z;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The largest patch about the disc that has the required precision, or none.
std::optional<Patch> patch_around(const Characteristic& f, const Disc& disc) {
  constexpr double kGrowth = 8;
  double radius = std::max(std::abs(disc.centre), disc.radius);
  while (radius > disc.radius && f.growth(radius) > kGrowth) radius /= 2;
  for (; radius > disc.radius / 2; radius /= 2)
    if (auto patch = Patch::sampled(f, {disc.centre, std::max(radius, disc.radius)}, 1))
      return patch;
  return std::nullopt;
}

}  // namespace

Tracked unstable_until(const Characteristic& f, double from_mm, double to_mm, Complex z) {
  constexpr double kFirst = 0.02, kLeast = 1e-6, kNoisy = 1e-4;
  double w = from_mm, half = kFirst * from_mm;
  std::optional<Patch> patch;
  Complex slope = 0;  // dz/dw
  while (to_mm - w > 1e-13 * to_mm) {
    half = std::min(half, (to_mm - w) / 2);
    if (half < kLeast * w && w + 2 * half < to_mm) return {w, z};
    Step step{.middle = w + half, .half = half, .z = z + slope * half};
    const Disc likely{
        step.middle * (1.0 - step.z),
        half * std::abs(1.0 - step.z) + 4 * step.middle * half * std::abs(slope)};
    if (!patch || !holds(patch->disc(), likely)) patch = patch_around(f, likely);
    if (patch) step.z = zero_in(*patch, step.middle, step.z);
    if (patch && std::abs(step.z) < 1) {
      const Slope F = slope_of(patch->point(step.z, step.middle * (1.0 - step.z), 0, 0),
                               step.middle, step.z);
      slope = -F.w / F.z;
      step.radius = std::min(2 * half * std::abs(slope) + 1e-9, 1 - std::abs(step.z));
      const Disc needed = step.disc();
      if (holds(patch->disc(), needed)) {
        const Patch local = patch->shifted(needed);
        if (local.noise() > kNoisy * local.scale()) {
          patch.reset();
        } else if (shown(local, step)) {
          w = step.middle + step.half;
          z = step.z + slope * half;
          half *= 1.4;
          continue;
        }
      } else {
        patch.reset();
      }
    }
    half /= 2;
  }
  return {to_mm, z};
}

}  // namespace turnwright::chatter
