#include "turnwright/chatter/cutter_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "chatter/collocation/characteristic_interpolant.hpp"
#include "chatter/collocation/delay_map.hpp"
#include "chatter/fundamental_matrix/stability_crossings.hpp"
#include "chatter/model/engagement.hpp"
#include "turning.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::chatter {
namespace {

using units::kPi;

/// One interpolant as a source of patches.
struct OneInterpolant {
  using Patch = CharacteristicInterpolant;
  const CharacteristicInterpolant* interpolant = nullptr;
  const CharacteristicInterpolant* pick(const CharacteristicInterpolant*, const Box&,
                                        Complex,
                                        std::optional<CharacteristicInterpolant>&) const {
    return interpolant;
  }
};

// As w rises ln |mu| grows by Im(g_w/g_theta) dw, see stability_crossings.cpp.
double outwards(const Local& g) { return cross(g.g_theta, g.g_w) / std::norm(g.g_theta); }

/// A step in depth towards |mu| = 1 for the multiplier that is nearest e^(i theta).
double step_out(const MultipliersAt& multipliers, const OnCircle& at, double outwards) {
  const Complex right = std::polar(1.0, at.theta);
  const auto all = multipliers(at.w_mm);
  const Complex nearest =
      *std::ranges::min_element(all, {}, [&](Complex mu) { return modulus(mu - right); });
  return -std::log(modulus(nearest)) / outwards;
}

/// Steps on one map after the other, each finer than the last, until a step is too small
/// to matter as error.  `at` initially has the error by the noise of the interpolant.
void refine(const std::vector<MultipliersAt>& finer, double outwards, OnCircle& at) {
  constexpr double kLarge = 5e-9;
  double noise = at.relative_error;
  for (const MultipliersAt& multipliers : finer) {
    try {
      const double step = step_out(multipliers, at, outwards);
      at.relative_error = std::abs(step) / at.w_mm + std::exchange(noise, 0);
      at.w_mm += step;
    } catch (const ModelRangeError&) {  // a finer map would be too large
      if (noise > 0) throw;
      return;
    }
    if (at.relative_error <= kLarge) return;
  }
}

/// Newton's method on the interpolant, then steps to the finer maps' multipliers.
OnCircle polished(const CharacteristicInterpolant& interpolant,
                  const std::vector<MultipliersAt>& finer, const Box& zero) {
  constexpr int kSteps = 30;
  OnCircle at{.w_mm = zero.w, .theta = zero.theta};
  const bool on_line = at.theta == 0 || at.theta == kPi;
  Local g;
  for (int i = 0; i < kSteps; ++i) {
    const Box point{at.w_mm, 0, at.theta, 0};
    g = interpolant.at(point, point.u());
    const double det = cross(g.g_w, g.g_theta);
    const double dw = on_line ? -g.g.real() / g.g_w.real() : -cross(g.g, g.g_theta) / det;
    if (!on_line) at.theta -= cross(g.g_w, g.g) / det;
    at.w_mm += dw;
    if (std::abs(dw) <= 1e-14 * at.w_mm) break;
  }
  const double uncertain =
      interpolant.noise() * (on_line ? 1 / std::abs(g.g_w.real())
                                     : std::abs(g.g_theta / cross(g.g_w, g.g_theta)));
  at.change = (outwards(g) > 0 ? 1 : -1) * (on_line ? 1 : 2);
  at.relative_error = uncertain / at.w_mm;
  refine(finer, outwards(g), at);
  return at;
}

/// Zeros on the circle from 0 up to a depth.
class Ascent {
 public:
  Ascent(const Cutter& cutter, double n_rpm, double ap_max)
      : cutter_(cutter), n_rpm_(n_rpm), ap_max_(ap_max) {
    finer_.push_back(at_depths({0, ap_max}, kFiner));
    for (const Fineness& fineness : kFinest)
      finer_.push_back(at_depths({0, ap_max}, fineness));
    double from = 0;
    std::vector<double> ends = kinks_mm(cutter, n_rpm, ap_max);
    ends.push_back(ap_max);
    for (const double to : ends)
      if (to > from) {
        climb(from, to);
        from = to;
      }
    std::ranges::sort(zeros_, {}, &OnCircle::w_mm);
  }

  const std::vector<OnCircle>& zeros() const { return zeros_; }

 private:
  MultipliersAt at_depths(const DelayMap::Range& range, const Fineness& fineness) {
    return [this, range, fineness](double w) {
      const DelayMap map(cutter_, n_rpm_, w, range, fineness);
      work_ += map.work();
      if (work_ > kWork)
        throw TooManyVibrations(
            "milling: the search takes too long; ask for a smaller ap_max_mm or a higher "
            "speed");
      return map.multipliers();
    };
  }

  void climb(double from, double to) {
    constexpr double kTail = 1e-9, kRough = 1e-5, kNarrow = 1e-2;
    // At the ends of a range ends of engagement may coincide, so that pieces vanish;
    // samples are therefore taken at this distance from them.
    constexpr double kBeside = 1e-10;  // rad
    const bool narrow = to - from < kNarrow * ap_max_;
    const double lag = lag_rad_mm(cutter_),
                 least = lag > 0 ? std::min(kBeside / lag, 1e-6 * (to - from)) : 0;
    const MultipliersAt within = at_depths({from, to}, kPlain);
    const auto beside = [&](double w) {
      return within(std::clamp(w, from + least, to - least));
    };
    const auto interpolant =
        CharacteristicInterpolant::sampled(beside, from, to, narrow ? kRough : kTail);
    if (interpolant && enter(*interpolant)) return;
    if (narrow)
      throw ModelRangeError(
          "milling: the stability of this cutter near a depth of " +
          std::to_string(from) +
          " mm cannot be decided; ask for a smaller ap_max_mm or a higher speed");
    const double middle = from + 0.49 * (to - from);
    climb(from, middle);
    climb(middle, to);
  }

  /// False if noise hides zeros, or if those found do not explain the change of the
  /// count.
  bool enter(const CharacteristicInterpolant& interpolant) {
    Search<OneInterpolant> search{OneInterpolant{&interpolant}};
    try {
      search.strip(interpolant.from_mm(), interpolant.to_mm(), nullptr, true);
    } catch (const ModelRangeError&) {
      return false;
    }
    std::vector<OnCircle> found;
    int count = interpolant.unstable_at_from();
    for (const Box& zero : search.found()) {
      const OnCircle at = polished(interpolant, finer_, zero);
      const auto again = [&](const OnCircle& other) {
        return std::abs(other.w_mm - at.w_mm) < 1e-8 * at.w_mm &&
               std::abs(other.theta - at.theta) < 1e-6;
      };
      if (!(at.w_mm > interpolant.from_mm() && at.w_mm <= interpolant.to_mm()) ||
          std::ranges::any_of(found, again))
        continue;
      found.push_back(at);
      count += at.change;
    }
    if (count != interpolant.unstable_at_to()) return false;
    zeros_.insert(zeros_.end(), found.begin(), found.end());
    return true;
  }

  const Cutter& cutter_;
  static constexpr double kWork = 2e11;  // half a minute
  double n_rpm_, ap_max_, work_ = 0;
  std::vector<MultipliersAt> finer_;
  std::vector<OnCircle> zeros_;
};

}  // namespace

SpeedLimits speed_limits(const Cutter& cutter, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm) {
  const auto zeros = std::holds_alternative<ConstantForce>(cutter.system.force)
                         ? turning_on_circle(cutter, n_rpm, ap_max_mm)
                         : Ascent(cutter, n_rpm, ap_max_mm).zeros();
  return charted(zeros, cutter.system, n_rpm, period_s(cutter, n_rpm), depths_mm);
}

std::vector<Surface> surfaces(const Cutter& cutter, double n_rpm, double ap_mm) {
  constexpr int kHeights = 21;
  const DelayMap map(cutter, n_rpm, ap_mm, kFiner);
  const DelayMap::Forced forced = map.forced();
  std::vector<Surface> out;
  for (const bool at_entry : {true, false}) {
    const double wall = at_entry ? 0 : kPi;
    if ((at_entry ? cutter.system.entry_rad : cutter.system.exit_rad) != wall) continue;
    Surface surface{.up_milled = at_entry, .height_mm = {}, .left_mm = {}};
    for (int i = 0; i < kHeights; ++i) {
      const double z = ap_mm * i / (kHeights - 1);
      double left = std::numeric_limits<double>::infinity();
      for (const Passage& p : map.contact().passages(wall, z)) {
        const double y = forced.displacement_mm(p.angle_rad)[1];
        left = std::min(left, (at_entry ? -y : y) - p.offset_mm);
      }
      surface.height_mm.push_back(z);
      surface.left_mm.push_back(left);
    }
    out.push_back(std::move(surface));
  }
  return out;
}

Multipliers multipliers(const Cutter& cutter, double n_rpm, double ap_mm) {
  const auto count = [](const std::vector<Complex>& all) {
    return static_cast<int>(
        std::ranges::count_if(all, [](Complex mu) { return modulus(mu) > 1; }));
  };
  const auto fine = DelayMap(cutter, n_rpm, ap_mm, kFiner).multipliers(),
             coarse = DelayMap(cutter, n_rpm, ap_mm, kPlain).multipliers();
  const double radius = modulus(fine.front());
  const double differ = std::abs(radius - modulus(coarse.front()));
  const bool clear = std::ranges::none_of(
      fine, [&](Complex mu) { return std::abs(modulus(mu) - 1) <= 10 * differ; });
  if (count(fine) != count(coarse)) throw ModelRangeError(kOnCircle);
  return {.unstable = count(fine), .spectral_radius = radius, .certified = clear};
}

}  // namespace turnwright::chatter
