#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "outcome.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::planning {
namespace {

using part::Tolerance;
using part::ToleranceKind;

constexpr double kOver = 1e-9;  // of a tolerance: what an optimum may be over its limit

struct Found {
  const SolvedFeature* feature = nullptr;
  const Demand* demand = nullptr;
};

Found find(const std::vector<SolvedSetup>& setups, const std::string& surface,
           std::size_t tolerance) {
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      if (f.task.feature.surface() != surface) continue;
      for (const auto& d : f.task.demands)
        if (d.tolerance == tolerance) return {&f, &d};
    }
  return {};
}

tolerance::Profile profile(const Found& f) {
  if (!f.feature) return tolerance::Samples{};
  return f.feature->answer.profile;
}

// The tolerance less the machine's share, as tolerance/ judges it; sizes about the middle
// that the tool is programmed to.
tolerance::Case judged(const Tolerance& t, const Found& at, const Found& other,
                       double share_mm, double half_angle) {
  tolerance::Case c;
  c.kind = t.kind;
  c.half_angle_rad = half_angle;
  c.e_mm = profile(at);
  c.other_mm = profile(other);
  const bool bare = !at.demand || at.demand->shape == Demand::Shape::none;
  if (t.limits) {
    const double half = (t.limits->upper_mm - t.limits->lower_mm - share_mm) / 2;
    c.limits = part::Limits{-half, half};
  } else if (bare) {
    c.value_mm = t.value_mm;
    c.machine_mm = share_mm;  // the cut has no term here
    if (t.kind == ToleranceKind::perpendicularity)
      c.controlled = tolerance::Controlled::axis;
  } else {
    c.value_mm = t.value_mm - share_mm;
  }
  return c;
}

// Relative standard deviation of the error: force and stiffness multiply it.
double spread(const PartPlan& p) {
  return std::hypot(p.material.kc_uncertainty_pct, p.machine.stiffness_uncertainty_pct) /
         100;
}

// P(value (1 + spread Z) <= limit), Z normal.
double conformance(double value, double limit, double spread) {
  if (!(value > 0)) return limit >= 0 ? 1 : 0;
  if (!(spread > 0)) return value <= limit ? 1 : 0;
  return boost::math::erfc(-(limit / value - 1) / spread / std::sqrt(2.0)) / 2;
}

}  // namespace

std::vector<ToleranceResult> tolerance_results(const PartPlan& p,
                                               const std::vector<SolvedSetup>& setups) {
  std::vector<ToleranceResult> all;
  const double share_mm = units::mm_from_um(p.machine_share_um);
  for (std::size_t i = 0; i < p.drawing.tolerances.size(); ++i) {
    const auto& t = p.drawing.tolerances[i];
    const bool length = t.kind == ToleranceKind::length;
    const Found at = find(setups, length ? t.between[1] : t.of, i);
    const Found other = length ? find(setups, t.between[0], i) : Found{};
    double half_angle = 0;
    for (const auto& e : p.drawing.outer)
      if (e.id == t.of) half_angle = half_angle_rad(e);

    ToleranceResult r;
    r.id = t.id;
    r.kind = t.kind;
    r.of = length ? t.between[0] + " .. " + t.between[1] : t.of;
    const double width = t.limits ? t.limits->upper_mm - t.limits->lower_mm : t.value_mm;
    if (width - share_mm <= 0) {
      r.verdict = Verdict::not_met;
      r.seed_verdict = false;
      r.predicted_mm = {share_mm};
      r.allowed_mm = {width};
      r.margin_mm = width - share_mm;
      r.shares = {{"machine", p.machine_share_um}};
      r.P_conform = 0;
      all.push_back(std::move(r));
      continue;
    }
    const bool used_offset = (at.feature && at.feature->compensated) ||
                             (other.feature && other.feature->compensated);
    const auto c = judged(t, at, other, share_mm, half_angle);
    const bool no_error = tolerance::empty(c.e_mm) && tolerance::empty(c.other_mm);
    if (t.limits && no_error) {  // an end left as the stock has it: nothing is predicted
      r.predicted_mm = {0, 0};
      r.allowed_mm = {t.limits->lower_mm, t.limits->upper_mm};
      r.shares = {{"machine", p.machine_share_um}};
      all.push_back(std::move(r));
      continue;
    }
    tolerance::Case full = c;
    if (t.limits && tolerance::empty(full.e_mm)) std::swap(full.e_mm, full.other_mm);
    const auto v = tolerance::verdict(full);
    r.seed_verdict = v.seed_verdict;
    r.margin_mm = used_offset ? v.margin_after_offset_mm : v.margin_mm;
    const bool kept = r.margin_mm >= -kOver * width;
    r.verdict = !kept         ? Verdict::not_met
                : used_offset ? Verdict::met_with_offset
                              : Verdict::met;
    const double cut_um =
        std::max(0.0, units::um_from_mm(v.measured_mm) - units::um_from_mm(c.machine_mm));
    r.shares = {{"deflection", cut_um}, {"machine", p.machine_share_um}};
    double value = v.measured_mm, limit = v.allowed_mm;
    if (t.limits) {
      const double middle = (t.limits->upper_mm + t.limits->lower_mm) / 2;
      const double factor = t.kind == ToleranceKind::diameter ? 2 : 1;
      double low = factor * v.extremes_mm.min_mm, high = factor * v.extremes_mm.max_mm;
      if (used_offset) {
        const double centre = (low + high) / 2;
        low -= centre;
        high -= centre;
      }
      r.predicted_mm = {middle + low, middle + high};
      r.allowed_mm = {t.limits->lower_mm + share_mm / 2,
                      t.limits->upper_mm - share_mm / 2};
      value = std::max(high, -low);
      limit = c.limits->upper_mm;
    } else {
      r.predicted_mm = {v.measured_mm};
      r.allowed_mm = {v.allowed_mm};
    }
    r.P_conform =
        cut_um > 0 ? conformance(value, limit, spread(p)) : (v.accepted ? 1 : 0);
    all.push_back(std::move(r));
  }
  return all;
}

std::vector<Compensation> compensations(const std::vector<SolvedSetup>& setups) {
  constexpr int kPoints = 11;
  std::vector<Compensation> all;
  for (const auto& s : setups)
    for (const auto& f : s.features) {
      if (!f.compensated || !f.answer.feasible) continue;
      const auto& feature = f.task.feature;
      std::vector<double> places;
      for (int k = 0; k < kPoints; ++k)
        places.push_back(feature.low_mm() +
                         (feature.high_mm() - feature.low_mm()) * k / (kPoints - 1));
      const auto e = feature.errors(f.answer.model->recipe(), f.task.economy,
                                    f.answer.choice, places);
      Compensation c{feature.surface(), s.setup, {}};
      for (std::size_t k = 0; k < places.size(); ++k)
        c.table_mm.emplace_back(places[k], -e[k]);
      all.push_back(std::move(c));
    }
  return all;
}

}  // namespace turnwright::planning
