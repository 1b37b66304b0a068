#include "turnwright/chatter/cutter_limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/say.hpp"
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
double step_out(const DelayMap& map, const OnCircle& at, double outwards) {
  return -std::log(modulus(map.multiplier_near(std::polar(1.0, at.theta)))) / outwards;
}

/// The map of a depth at a fineness; counted as work.
using MapAt = std::function<DelayMap(double w_mm, const Fineness& fineness)>;

/// Steps on one map after the other, each finer than the last, at least two and until the
/// error is too small to matter.  An error by kinks falls at least with the square of the
/// fineness, so that what is left is below 1.3 steps; 3 are told.  A step may be small by
/// chance, so the error is at least 0.3 of the step before, and at least 1e-10.  `at`
/// initially has the error by the noise of the interpolant.
void refine(const MapAt& map_at, double outwards, OnCircle& at) {
  constexpr double kLarge = 5e-9;
  constexpr double kSteps = 3, kByChance = 0.3, kLeast = 1e-10;
  constexpr double kRounding = 1e-13;  // of ln |mu|
  const double rounding = kRounding / std::abs(outwards) / at.w_mm;
  double before = at.relative_error;
  Eigen::Index unknowns = 0;
  bool again = false;
  for (const Fineness& fineness : kFiner) {
    try {
      const DelayMap map = map_at(at.w_mm, fineness);
      if (map.unknowns() <= unknowns) continue;  // the same nodes again
      unknowns = map.unknowns();
      const double step = step_out(map, at, outwards), size = std::abs(step) / at.w_mm;
      at.w_mm += step;
      at.relative_error =
          std::max({kSteps * size, kByChance * before, kLeast}) + rounding;
      before = std::max(size, before * (again ? 0 : kByChance));
    } catch (const ModelRangeError&) {  // a finer map would be too large
      if (!again) throw;
      return;
    }
    if (std::exchange(again, true) && at.relative_error <= kLarge) return;
  }
}

/// Whether the edges differ from straight ones in their helix alone, so that the delayed
/// motion is the present one times a constant, as in propagator.hpp.
bool only_helical(const Cutter& c) {
  return c.helix_rad > 0 && c.indentation_N_mm == 0 && !c.by_revolution() &&
         std::holds_alternative<LinearForce>(c.system.force);
}

/// f of an only helical cutter at one depth.
Characteristic helical(const Cutter& cutter, double n_rpm, double ap_mm,
                       const Resolution& resolution) {
  return {cutter.system, helical_arc_loads(cutter, n_rpm, ap_mm), n_rpm, resolution};
}

/// Approximate number of operations for its series: products of 20 terms with 40 for every
/// interval.
double helical_work(const Cutter& cutter, double n_rpm) {
  constexpr double kEach = 20 * 40, kPhase = 5;  // rad of an interval
  double fastest = 0;
  for (const Mode& m : cutter.system.modes) fastest = std::max(fastest, m.wn_rad_s);
  const auto states = 2 * static_cast<double>(cutter.system.modes.size());
  return kEach * states * states * states *
         (2 + fastest * period_s(cutter, n_rpm) / kPhase);
}

/// The f of a depth at a resolution; counted as work.
using HelicalAt =
    std::function<Characteristic(double w_mm, const Resolution& resolution)>;

/// Newton's method with the slopes of the interpolant, at two resolutions of unlike
/// fineness.  Three times the step between their zeros is told, and at least 1e-10.
void refine(const HelicalAt& helical_at, const CharacteristicInterpolant& interpolant,
            const Local& slope, OnCircle& at) {
  constexpr int kIterations = 20;
  constexpr double kSettled = 1e-12, kSteps = 3, kLeast = 1e-10;
  const bool flip = at.flip();
  double coarse = 0, step = 0;
  for (const Resolution& resolution : {kCoarse, kFine}) {
    coarse = at.w_mm;
    for (int i = 0; i < kIterations; ++i) {
      const Complex g =
          interpolant.phase(at.theta) *
          helical_at(at.w_mm, resolution).value(std::polar(1.0, -at.theta), 1);
      const double det = cross(slope.g_w, slope.g_theta);
      step = flip ? -g.real() / slope.g_w.real() : -cross(g, slope.g_theta) / det;
      if (!flip) at.theta -= cross(slope.g_w, g) / det;
      at.w_mm += step;
      if (std::abs(step) <= kSettled * at.w_mm) break;
    }
  }
  at.relative_error =
      std::max(kSteps * (std::abs(at.w_mm - coarse) + std::abs(step)) / at.w_mm, kLeast);
}

/// Refines a zero of the interpolant with the given slopes.
using Refine = std::function<void(const CharacteristicInterpolant& interpolant,
                                  const Local& slope, OnCircle& at)>;

/// Newton's method on the interpolant, then on what it interpolates.
OnCircle polished(const CharacteristicInterpolant& interpolant, const Refine& refine,
                  const Box& zero) {
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
  refine(interpolant, g, at);
  return at;
}

/// Zeros on the circle from 0 up to a depth.
class Ascent {
 public:
  Ascent(const Cutter& cutter, double n_rpm, double ap_max, double work)
      : cutter_(cutter), n_rpm_(n_rpm), ap_max_(ap_max), left_(work) {
    std::vector<double> ends = kinks_mm(cutter, n_rpm, ap_max);
    ends.push_back(ap_max);
    try {
      for (const double to : ends)
        if (to > searched_) climb(searched_, to);
    } catch (const ModelRangeError&) {
      if (searched_ == 0) throw;
    }
    std::ranges::sort(zeros_, {}, &OnCircle::w_mm);
  }

  const std::vector<OnCircle>& zeros() const { return zeros_; }
  /// Depth up to which they are all found.
  double searched_mm() const { return searched_; }

 private:
  void spend(double work) {
    left_ -= work;
    if (left_ < 0) throw TooManyVibrations(tr(kTooLong));
  }

  // At the ends of a range ends of engagement may coincide, so that pieces vanish;
  // samples are therefore taken beside them.
  std::optional<CharacteristicInterpolant> sampled(double from, double to, double tail) {
    constexpr double kBeside = 1e-10;  // rad
    constexpr int kSamples = 17;
    const double lag = lag_rad_mm(cutter_),
                 least = lag > 0 ? std::min(kBeside / lag, 1e-6 * (to - from)) : 0;
    const auto beside = [&](double w) { return std::clamp(w, from + least, to - least); };
    if (only_helical(cutter_)) {
      bool precise = true;
      const auto made = CharacteristicInterpolant::sampled(
          [&](double w, bool counted) {
            auto sample = helical_sample(beside(w), counted);
            precise = precise && sample;
            return sample ? *sample : DepthSample{.d = {1}, .noise = 0, .outside = 0};
          },
          from, to, tail);
      if (precise) return made;
    }
    const DelayMap::Range range{from, to};
    const double most =
        kSamples * DelayMap(cutter_, n_rpm_, to - least, range, kPlain).work();
    if (most > left_ / 2) throw TooManyVibrations(tr(kTooLong));
    return CharacteristicInterpolant::sampled(
        [&](double w, bool) {
          const DelayMap map(cutter_, n_rpm_, beside(w), range, kPlain);
          spend(map.work());
          return depth_sample(map.multipliers());
        },
        from, to, tail);
  }

  Characteristic helical_at(double w, const Resolution& resolution) {
    spend(helical_work(cutter_, n_rpm_));
    return helical(cutter_, n_rpm_, w, resolution);
  }

  /// None where the series of the depth is not precise.
  std::optional<DepthSample> helical_sample(double w, bool counted) {
    const Characteristic f = helical_at(w, kFine);
    const auto whole = series_up_to(f, 1);
    if (!whole || whole->depth_mm < 1) return std::nullopt;
    DepthSample out{.d = by_powers(whole->series, 1), .noise = whole->series.noise(2)};
    if (counted) out.outside = multipliers_outside(whole->series, 1);
    return out;
  }

  /// Searches a range, or its halves if the whole is not precise enough, too large or
  /// more than half of the work left: so low depths are told where deep ones cannot be.
  void climb(double from, double to) {
    constexpr double kTail = 1e-7, kRough = 1e-5, kNarrow = 1e-2;
    const bool narrow = to - from < kNarrow * ap_max_;
    try {
      const auto interpolant = sampled(from, to, narrow ? kRough : kTail);
      if (interpolant && enter(*interpolant)) {
        searched_ = to;
        return;
      }
    } catch (const TooManyVibrations&) {
      if (narrow) throw;
    }
    if (narrow)
      throw ModelRangeError(
          say("milling: the stability of this cutter near a depth of {:f} mm cannot be "
              "decided; ask for a smaller ap_max_mm or a higher speed",
              from));
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
      const OnCircle at = polished(interpolant, refiner(), zero);
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

  Refine refiner() {
    if (only_helical(cutter_))
      return [this](const CharacteristicInterpolant& interpolant, const Local& slope,
                    OnCircle& at) {
        refine([this](double w, const Resolution& r) { return helical_at(w, r); },
               interpolant, slope, at);
      };
    return [this](const CharacteristicInterpolant&, const Local& slope, OnCircle& at) {
      const auto map_at = [this](double w_mm, const Fineness& fineness) {
        DelayMap map(cutter_, n_rpm_, w_mm, fineness);
        spend(map.work_near());
        return map;
      };
      refine(map_at, outwards(slope), at);
    };
  }

  static constexpr const char* kTooLong = to_translate(
      "milling: the search takes too long; ask for a smaller ap_max_mm or a higher "
      "speed");
  const Cutter& cutter_;
  double n_rpm_, ap_max_, left_, searched_ = 0;  // operations left
  std::vector<OnCircle> zeros_;
};

}  // namespace

SpeedLimits speed_limits(const Cutter& cutter, double n_rpm, double ap_max_mm,
                         std::span<const double> depths_mm, double work) {
  const auto told = [&](const std::vector<OnCircle>& zeros,
                        std::span<const double> depths) {
    return charted(zeros, cutter.system, n_rpm, period_s(cutter, n_rpm), depths);
  };
  if (std::holds_alternative<ConstantForce>(cutter.system.force))
    return told(turning_on_circle(cutter, n_rpm, ap_max_mm), depths_mm);
  const Ascent ascent(cutter, n_rpm, ap_max_mm, work);
  const double searched = ascent.searched_mm();
  if (searched == ap_max_mm) return told(ascent.zeros(), depths_mm);
  const auto deeper = std::ranges::upper_bound(depths_mm, searched);
  SpeedLimits out = told(ascent.zeros(), {depths_mm.begin(), deeper});
  out.searched_mm = searched;
  return out;
}

std::vector<Surface> surfaces(const Cutter& cutter, double n_rpm, double ap_mm) {
  constexpr int kHeights = 21;
  const DelayMap map(cutter, n_rpm, ap_mm, kFiner.front());
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
  const auto fine = DelayMap(cutter, n_rpm, ap_mm, kFiner.front()).multipliers(),
             coarse = DelayMap(cutter, n_rpm, ap_mm, kPlain).multipliers();
  const double radius = modulus(fine.front());
  const double differ = std::abs(radius - modulus(coarse.front()));
  const bool clear = std::ranges::none_of(
      fine, [&](Complex mu) { return std::abs(modulus(mu) - 1) <= 10 * differ; });
  if (count(fine) != count(coarse)) throw ModelRangeError(kOnCircle);
  return {.unstable = count(fine), .spectral_radius = radius, .certified = clear};
}

}  // namespace turnwright::chatter
