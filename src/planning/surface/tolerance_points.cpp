#include "tolerance_points.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <utility>

#include "planning/operation/evaluate.hpp"

namespace turnwright::planning {
namespace {

constexpr double kAllowed = 5e-10;  // of a limit: half of what a plan may be over
constexpr std::size_t kGrid = 33;

// The value of the error that a tolerance constrains; for a centred size half its range.
double weight(const CutTolerance& d) {
  return d.shape == CutTolerance::Shape::centred ? d.factor / 2 : d.factor;
}

bool of_range(const CutTolerance& d) {
  return d.shape == CutTolerance::Shape::range || d.shape == CutTolerance::Shape::centred;
}

struct Place {
  double at, value;
};

// Position of the largest sign * e: every peak of a grid refined between its neighbours,
// because one that is lower on the grid may be higher between its points.
Place largest(const std::function<double(double)>& e, double low, double high,
              double sign) {
  const auto at = [&](std::size_t k) {
    return low + (high - low) * static_cast<double>(k) / (kGrid - 1);
  };
  std::vector<double> v(kGrid);
  for (std::size_t k = 0; k < kGrid; ++k) v[k] = sign * e(at(k));
  Place p{at(0), v[0]};
  for (std::size_t k = 0; k < kGrid; ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, kGrid - 1);
    if (v[k] < v[before] || v[k] < v[after]) continue;
    if (v[k] > p.value) p = {at(k), v[k]};
    const auto [z, f] = boost::math::tools::brent_find_minima(
        [&](double x) { return -sign * e(x); }, at(before), at(after), 40);
    if (-f > p.value) p = {z, -f};
  }
  return p;
}

double evaluate(const tolerance::PiecewisePolynomial& e, double z) {
  std::size_t k = 0;
  while (k + 2 < e.breaks_mm.size() && z > e.breaks_mm[k + 1]) ++k;
  double sum = 0;
  for (std::size_t j = e.coefficients[k].size(); j-- > 0;)
    sum = sum * (z - e.breaks_mm[k]) + e.coefficients[k][j];
  return sum;
}

}  // namespace

TolerancePoints::TolerancePoints(const MachinedSurface& feature,
                                 std::vector<CutTolerance> cut_tolerances)
    : feature_(&feature),
      cut_tolerances_(std::move(cut_tolerances)),
      asked_(cut_tolerances_.size(), false) {}

void TolerancePoints::add_all() {
  for (std::size_t i = 0; i < cut_tolerances_.size(); ++i) add_first(i);
}

std::size_t TolerancePoints::station(double at_mm) {
  const auto it = std::find(stations_.begin(), stations_.end(), at_mm);
  if (it != stations_.end()) return static_cast<std::size_t>(it - stations_.begin());
  stations_.push_back(at_mm);
  return stations_.size() - 1;
}

void TolerancePoints::add(const Terms& terms, double limit, const CutTolerance& d) {
  Functional g;
  for (const auto& [at, weight] : terms)
    g.terms.emplace_back(station(at), feature_->sign() * weight);
  g.limit =
      std::max(limit, 1e-12);  // a tolerance the machine has used up: kept by nothing
  g.tolerance = d.tolerance;
  if (std::ranges::find(functionals_, g) == functionals_.end())
    functionals_.push_back(std::move(g));
}

void TolerancePoints::add_first(std::size_t cut_tolerance) {
  if (asked_[cut_tolerance]) return;
  asked_[cut_tolerance] = true;
  const CutTolerance& d = cut_tolerances_[cut_tolerance];
  const double low = feature_->low_mm(), high = feature_->high_mm();
  const double middle = (low + high) / 2, w = weight(d);
  using enum CutTolerance::Shape;
  if (d.shape == size)
    for (const double z : {low, high}) {
      add({{z, w}}, d.upper, d);
      add({{z, -w}}, -d.lower, d);
    }
  if (of_range(d)) {
    add({{low, w + d.lag}, {high, -w}}, d.upper, d);
    add({{high, w + d.lag}, {low, -w}}, d.upper, d);
  }
  if (d.shape == straightness)
    for (const double sign : {1.0, -1.0})
      add({{middle, sign}, {low, -sign / 2}, {high, -sign / 2}}, d.upper, d);
}

bool TolerancePoints::add_violated(const Recipe& recipe, const Economy& economy,
                                   const Choice<double>& choice) {
  if (std::all_of(
          cut_tolerances_.begin(), cut_tolerances_.end(),
          [](const CutTolerance& d) { return d.shape == CutTolerance::Shape::none; }))
    return false;
  const auto profile = feature_->profile(recipe, economy, choice);
  const double low = feature_->low_mm(), high = feature_->high_mm();
  const auto e = [&](double z) { return evaluate(profile, z); };
  const Place top = largest(e, low, high, 1), bottom = largest(e, low, high, -1);
  const auto before = functionals_.size();
  // The profile finds the positions; the constraint uses the exact error there.
  const auto add_if_broken = [&](const Terms& terms, double limit,
                                 std::size_t cut_tolerance) {
    const CutTolerance& d = cut_tolerances_[cut_tolerance];
    std::vector<double> places;
    for (const auto& t : terms) places.push_back(t.first);
    const auto exact = feature_->errors(recipe, economy, choice, places);
    double value = 0;
    for (std::size_t k = 0; k < terms.size(); ++k) value += terms[k].second * exact[k];
    if (!(value > limit * (1 + kAllowed))) return;
    add_first(cut_tolerance);
    add(terms, limit, d);
  };
  using enum CutTolerance::Shape;
  for (std::size_t i = 0; i < cut_tolerances_.size(); ++i) {
    const CutTolerance& d = cut_tolerances_[i];
    const double w = weight(d);
    if (d.shape == size) {
      if (w * top.value > d.upper) add_if_broken({{top.at, w}}, d.upper, i);
      if (w * bottom.value > -d.lower) add_if_broken({{bottom.at, -w}}, -d.lower, i);
    } else if (of_range(d)) {
      const double range = w * (top.value + bottom.value);
      if (range + d.lag * top.value > d.upper)
        add_if_broken({{top.at, w + d.lag}, {bottom.at, -w}}, d.upper, i);
      if (d.lag > 0 && range + d.lag * bottom.value > d.upper)
        add_if_broken({{top.at, w}, {bottom.at, -w - d.lag}}, d.upper, i);
    } else if (d.shape == straightness) {
      const auto zone = tolerance::minimum_zone(profile);
      if (!(zone.width_mm > d.upper)) continue;
      // The zone touches at three places, alternating: two on one line, one between them
      // on the other.
      const auto tilted = [&](double z) { return e(z) - zone.slope * z; };
      for (const double sign : {1.0, -1.0}) {
        const Place peak = largest(tilted, low, high, sign);
        if (peak.at <= low || peak.at >= high) continue;
        const Place l = largest(tilted, low, peak.at, -sign);
        const Place r = largest(tilted, peak.at, high, -sign);
        const double share = (r.at - peak.at) / (r.at - l.at);
        add_if_broken(
            {{peak.at, sign}, {l.at, -sign * share}, {r.at, -sign * (1 - share)}},
            d.upper, i);
      }
    }
  }
  return functionals_.size() > before;
}

}  // namespace turnwright::planning
