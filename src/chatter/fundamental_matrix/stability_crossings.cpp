#include "stability_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "chatter/model/chatter_frequency.hpp"
#include "krawczyk_search.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

constexpr double kNoisy = 1e-4;  // relative noise above which a patch is replaced

/// Patches on demand; those of enclosing boxes are reused while they are precise.
class Patches {
 public:
  using Patch = chatter::Patch;
  Patches(const Characteristic& f, double rho) : f_(&f), rho_(rho) {}
  explicit Patches(const Series& series) : series_(&series), rho_(1) {}

  /// A patch for `inner`: `above` itself, a shift of it or a new one, kept in `own`; null
  /// if the disc is too large for any.
  const Patch* pick(const Patch* above, const Box& box, Complex u,
                    std::optional<Patch>& own) const {
    return pick(above, chatter::disc(box, u, rho_), own);
  }
  const Patch* pick(const Patch* above, const Disc& inner,
                    std::optional<Patch>& own) const {
    constexpr double kFar = 24;  // beyond it bounds of third order are too wide
    if (above && holds(above->disc(), inner)) {
      if (kFar * inner.radius > above->disc().radius) return above;
      const double room =
          above->disc().radius - modulus(inner.centre - above->disc().centre);
      own = above->shifted({inner.centre, std::min(2 * inner.radius, room)});
      if (own->noise() < kNoisy * (series_ ? own->change() : own->scale())) return &*own;
    } else if (above) {
      return nullptr;
    }
    own = sampled(inner);
    return own ? &*own : nullptr;
  }

  std::optional<Patch> sampled(const Disc& disc) const {
    return series_ ? shifted(disc) : measured(disc);
  }

 private:
  std::optional<Patch> measured(const Disc& disc) const {
    constexpr double kHopeless = 14;  // growth across the disc beyond which none is tried
    if (f_->growth(disc.radius) > kHopeless) return std::nullopt;
    return Patch::sampled(*f_, disc, rho_);
  }

  std::optional<Patch> shifted(const Disc& disc) const {
    constexpr double kWide = 8;  // terms that matter across the disc
    const double share = disc.radius / series_->radius_mm;
    if (modulus(disc.centre) + disc.radius > series_->radius_mm ||
        share * static_cast<double>(series_->terms()) > kWide)
      return std::nullopt;
    return Patch::of(*series_, disc, rho_);
  }

  const Characteristic* f_ = nullptr;
  const Series* series_ = nullptr;
  double rho_;
};

Complex g_at(const Characteristic& f, double w, double theta) {
  return f.value(std::polar(1.0, -theta), w);
}

struct Slopes {
  Complex w, theta;
};

Slopes slopes(const Characteristic& f, double w, double theta) {
  constexpr double kStep = 1e-5;
  return {(g_at(f, w * (1 + kStep), theta) - g_at(f, w * (1 - kStep), theta)) /
              (2 * kStep * w),
          (g_at(f, w, theta + kStep) - g_at(f, w, theta - kStep)) / (2 * kStep)};
}

/// Newton's method with the slopes of the start, which are good to 1e-9.
OnCircle newton(const Characteristic& f, OnCircle at, const Slopes& slope) {
  constexpr int kSteps = 30;
  const bool flip = at.flip();
  for (int i = 0; i < kSteps; ++i) {
    const Complex g = g_at(f, at.w_mm, at.theta);
    double dw = 0, dtheta = 0;
    if (flip) {
      dw = -g.real() / slope.w.real();
    } else {
      const double det = cross(slope.w, slope.theta);
      dw = -cross(g, slope.theta) / det;
      dtheta = -cross(slope.w, g) / det;
    }
    at.w_mm += dw;
    at.theta += dtheta;
    at.relative_error = std::abs(dw / at.w_mm);
    if (at.relative_error < 1e-14) break;
  }
  return at;
}

// As w rises past the zero, dz/z = -g_w/(z g_z) dw = i g_w/g_theta dw, and ln |mu| = -ln
// |z| grows by Im(g_w/g_theta) dw.
// The step between the two propagators may be small by chance, and both round alike; many
// modes together have lost 3e-13 so.
OnCircle polished(const Characteristic& coarse, const Characteristic& fine,
                  const Box& zero) {
  constexpr double kLeast = 1e-11;
  OnCircle at{.w_mm = zero.w, .theta = zero.theta};
  at = newton(coarse, at, slopes(coarse, at.w_mm, at.theta));
  const Slopes slope = slopes(fine, at.w_mm, at.theta);
  const OnCircle best = newton(fine, at, slope);
  const double outwards = cross(slope.theta, slope.w);
  OnCircle out = best;
  out.relative_error =
      std::max(std::abs(best.w_mm - at.w_mm) / best.w_mm + best.relative_error, kLeast);
  out.change = (outwards > 0 ? 1 : -1) * (out.flip() ? 1 : 2);
  return out;
}

/// The same on the series.
OnCircle polished(const Series& series, const Box& zero) {
  constexpr int kSteps = 30;
  constexpr Complex kI(0, 1);
  OnCircle at{.w_mm = zero.w, .theta = zero.theta};
  double uncertain = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Complex z = std::polar(1.0, -at.theta), kappa = at.w_mm * (1.0 - z);
    const SeriesValue p = value(series, z, kappa);
    const Complex g_w = (1.0 - z) * p.f_kappa,
                  g_theta = kI * z * (at.w_mm * p.f_kappa - p.f_z);
    const double det = cross(g_w, g_theta);
    const double dw = at.flip() ? -p.f.real() / g_w.real() : -cross(p.f, g_theta) / det;
    if (!at.flip()) at.theta -= cross(g_w, p.f) / det;
    at.w_mm += dw;
    at.change = (det < 0 ? 1 : -1) * (at.flip() ? 1 : 2);
    uncertain = series.noise(std::abs(kappa)) *
                (at.flip() ? 1 / std::abs(g_w.real()) : std::abs(g_theta / det));
    at.relative_error = (std::abs(dw) + uncertain) / at.w_mm;
    if (std::abs(dw) <= std::max(uncertain / 8, 1e-15 * at.w_mm)) break;
  }
  return at;
}

std::vector<OnCircle> sorted(const std::vector<OnCircle>& zeros, double from_mm,
                             double to_mm) {
  std::vector<OnCircle> out;
  for (const OnCircle& at : zeros) {
    if (!(at.w_mm > from_mm && at.w_mm <= to_mm)) continue;
    const bool again = std::ranges::any_of(out, [&](const OnCircle& other) {
      return std::abs(other.w_mm - at.w_mm) < 1e-8 * at.w_mm &&
             std::abs(other.theta - at.theta) < 1e-6;
    });
    if (!again) out.push_back(at);
  }
  std::ranges::sort(out, {}, &OnCircle::w_mm);
  return out;
}

}  // namespace

bool OnCircle::flip() const { return theta == kPi; }

Crossing crossing(const OnCircle& at, bool loss, const System& system, double tau_s) {
  return {.ap_mm = at.w_mm,
          .loss = loss,
          .flip = at.flip(),
          .theta_rad = at.theta,
          .frequency_Hz = at.frequency_Hz ? *at.frequency_Hz
                                          : chatter_frequency_Hz(system, tau_s, at.theta),
          .relative_error = at.relative_error};
}

SpeedLimits charted(const std::vector<OnCircle>& zeros, const System& system,
                    double n_rpm, double tau_s, std::span<const double> depths_mm) {
  SpeedLimits out{.n_rpm = n_rpm, .crossings = {}, .unstable = {}};
  int count = 0;
  for (const OnCircle& at : zeros) {
    const bool was_stable = count == 0;
    count += at.change;
    if (was_stable == (count == 0)) continue;
    out.crossings.push_back(crossing(at, was_stable, system, tau_s));
  }
  for (const double w : depths_mm) {
    int unstable = 0;
    for (const OnCircle& at : zeros)
      if (at.w_mm < w) unstable += at.change;
    out.unstable.push_back(unstable);
  }
  return out;
}

std::vector<OnCircle> on_circle(const Characteristic& coarse, const Characteristic& fine,
                                double from_mm, double to_mm) {
  Search<Patches> search(Patches(coarse, 1));
  // The disc about w of radius w contains kappa for every depth up to w and |z| <= 1.
  constexpr double kReach = 1.6;
  std::optional<Patch> first;
  if (from_mm == 0) first = search.source().sampled({to_mm, kReach * to_mm});
  search.strip(from_mm, to_mm, first ? &*first : nullptr);

  std::vector<OnCircle> zeros;
  for (const Box& zero : search.found()) zeros.push_back(polished(coarse, fine, zero));
  return sorted(zeros, from_mm, to_mm);
}

std::vector<OnCircle> on_circle(const Series& series, const Characteristic& coarse,
                                const Characteristic& fine, double to_mm) {
  constexpr double kLarge =
      1e-9;  // error above which zeros are refined without the series
  Search<Patches> search{Patches(series)};
  search.strip(0, to_mm, nullptr);
  std::vector<OnCircle> zeros;
  for (const Box& zero : search.found()) {
    const OnCircle at = polished(series, zero);
    zeros.push_back(at.relative_error < kLarge ? at : polished(coarse, fine, zero));
  }
  return sorted(zeros, 0, to_mm);
}

namespace {

/// The change of the argument of g along the half circle, chord by chord.  Where chords meet
/// their ends may differ by the noise of their patches.
class Winding {
 public:
  Winding(const Patches& patches, double w, double rho)
      : patches_(patches), w_(w), rho_(rho) {}

  /// Bound of what the noise may have added to the angle.
  double slack() const { return slack_; }

  /// The change of the argument of g over [0, pi].
  double angle() {
    constexpr double kFew = 4;
    double sum = 0;
    for (double i = 0; i < kFew; ++i)
      sum += go({w_, 0, (i + 0.5) * kPi / kFew, kPi / (2 * kFew)}, nullptr);
    return sum;
  }

 private:
  double go(const Box& box, const Patch* above) {
    constexpr double kSmallest = 1e-13;
    if (box.theta_half < kSmallest || ++boxes_ > kBoxes)
      throw ModelRangeError(tr(kOnCircle));
    std::optional<Patch> own;
    const Complex u = box.u();
    const Patch* patch = patches_.pick(above, disc(box, u, rho_), own);
    if (patch) {
      const Local g = patch->at(box, u);
      const Complex E = g.g_theta * box.theta_half;
      const double rest = g.tt * box.theta_half * box.theta_half / 2 + patch->noise();
      if (distance(g.g, E) > rest) {
        const Complex from = end(*patch, box, -1), to = end(*patch, box, +1);
        slack_ +=
            kPi / 2 * patch->noise() * (1 / modulus(from) + 1 / modulus(to));  // > asin
        return std::arg(to / from);
      }
    }
    const Patch* next = patch ? patch : (above && !own ? above : nullptr);
    const double half = box.theta_half / 2;
    return go({w_, 0, box.theta - half, half}, next) +
           go({w_, 0, box.theta + half, half}, next);
  }

  Complex end(const Patch& patch, const Box& box, double side) const {
    const Box point{w_, 0, box.theta + side * box.theta_half, 0};
    return patch.at(point, point.u()).g;
  }

  Patches patches_;
  double w_, rho_, slack_ = 0;
  std::size_t boxes_ = 0;
};

// z runs clockwise, and the lower half mirrors the upper; u^(-m/2) has turned g by m/2
// half turns.
int whole_turns(Winding winding, std::size_t m) {
  constexpr double kRounding = 1e-3, kUnambiguous = 1;  // rad, far below half a turn
  const double turns = static_cast<double>(m / 2) - winding.angle() / kPi,
               whole = std::round(turns);
  if (!(std::abs(turns - whole) < kRounding || winding.slack() < kUnambiguous))
    throw ModelRangeError(tr(kOnCircle));  // the chords' angles are only rounding
  return static_cast<int>(whole);
}

}  // namespace

int multipliers_outside(const Characteristic& f, double w_mm, double rho) {
  return whole_turns(Winding(Patches(f, rho), w_mm, rho), f.states());
}

int multipliers_outside(const Series& series, double w_mm) {
  return whole_turns(Winding(Patches(series), w_mm, 1), series.states());
}

}  // namespace turnwright::chatter
