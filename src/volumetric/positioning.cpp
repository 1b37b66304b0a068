#include "turnwright/volumetric/positioning.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace turnwright::volumetric {
namespace {

constexpr double kCoverage = 2;    // standard deviations to either side
constexpr double kLong_mm = 2000;  // travel beyond which ISO 230-2 tests otherwise

std::optional<double> mean_of(const std::vector<double>& x) {
  if (x.empty()) return std::nullopt;
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

std::optional<double> deviation_of(const std::vector<double>& x) {
  if (x.size() < 2) return std::nullopt;
  const double mean = *mean_of(x);
  double square = 0;
  for (const double one : x) square += (one - mean) * (one - mean);
  return std::sqrt(square / static_cast<double>(x.size() - 1));
}

PositionValues values_of(const Target& t) {
  PositionValues v{.q_mm = t.q_mm,
                   .approaches_plus = t.plus_mm.size(),
                   .approaches_minus = t.minus_mm.size(),
                   .mean_plus_mm = mean_of(t.plus_mm),
                   .mean_minus_mm = mean_of(t.minus_mm),
                   .s_plus_mm = deviation_of(t.plus_mm),
                   .s_minus_mm = deviation_of(t.minus_mm),
                   .mean_mm = {},
                   .B_mm = {},
                   .R_mm = {}};
  if (v.mean_plus_mm && v.mean_minus_mm) {
    v.mean_mm = (*v.mean_plus_mm + *v.mean_minus_mm) / 2;  // Eq. (1)
    v.B_mm = *v.mean_plus_mm - *v.mean_minus_mm;           // Eq. (2)
  }
  if (v.s_plus_mm && v.s_minus_mm) {  // Eq. (3)
    const double plus = kCoverage * *v.s_plus_mm, minus = kCoverage * *v.s_minus_mm;
    v.R_mm = std::max({plus + minus + std::abs(*v.B_mm), 2 * plus, 2 * minus});
  }
  return v;
}

using Positions = std::vector<PositionValues>;
using Member = std::optional<double> PositionValues::*;

/// Whether every position has a member.
bool all_have(const Positions& all, Member member) {
  return !all.empty() &&
         std::ranges::all_of(all, [&](const auto& p) { return (p.*member).has_value(); });
}

template <class Of>
std::optional<double> largest(const Positions& all, Member member, Of of) {
  if (!all_have(all, member)) return std::nullopt;
  double most = of(*(all.front().*member));
  for (const auto& p : all) most = std::max(most, of(*(p.*member)));
  return most;
}

/// Of a mean, with the coverage of its standard deviation to either side if `s` is given.
std::optional<Extent> extent(const Positions& all, Member mean, Member s = nullptr) {
  if (!all_have(all, mean) || (s && !all_have(all, s))) return std::nullopt;
  Extent e{std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};
  for (const auto& p : all) {
    const double half = s ? kCoverage * *(p.*s) : 0;
    e.low_mm = std::min(e.low_mm, *(p.*mean) - half);
    e.high_mm = std::max(e.high_mm, *(p.*mean) + half);
  }
  return e;
}

std::optional<Extent> both(const std::optional<Extent>& a,
                           const std::optional<Extent>& b) {
  if (!a || !b) return std::nullopt;
  return Extent{std::min(a->low_mm, b->low_mm), std::max(a->high_mm, b->high_mm)};
}

}  // namespace

std::vector<Target> targets(const AxisTable& readings) {
  std::map<double, Target> found;
  for (std::size_t i = 0; i < readings.q.size(); ++i) {
    Target& t = found[readings.q[i]];
    t.q_mm = readings.q[i];
    if (!readings.plus.empty()) t.plus_mm.push_back(readings.plus[i]);
    if (!readings.minus.empty()) t.minus_mm.push_back(readings.minus[i]);
  }
  std::vector<Target> out;
  for (auto& [q, target] : found) out.push_back(std::move(target));
  return out;
}

Iso230_2 iso230_2(std::span<const Target> all) {
  Iso230_2 v;
  std::ranges::transform(all, std::back_inserter(v.positions), values_of);
  const Positions& p = v.positions;
  const auto modulus = [](double x) { return std::abs(x); };
  const auto coverage = [](double s) { return 2 * kCoverage * s; };
  v.B_mm = largest(p, &PositionValues::B_mm, modulus);  // Eq. (2)
  if (v.B_mm) {
    double sum = 0;
    for (const auto& one : p) sum += *one.B_mm;
    v.B_mean_mm = sum / static_cast<double>(p.size());
  }
  v.R_plus_mm = largest(p, &PositionValues::s_plus_mm, coverage);  // Eq. (3)
  v.R_minus_mm = largest(p, &PositionValues::s_minus_mm, coverage);
  v.R_mm = largest(p, &PositionValues::R_mm, modulus);
  v.M = extent(p, &PositionValues::mean_mm);            // Eq. (4)
  v.E_plus = extent(p, &PositionValues::mean_plus_mm);  // Eq. (5)
  v.E_minus = extent(p, &PositionValues::mean_minus_mm);
  v.E = both(v.E_plus, v.E_minus);
  v.A_plus =
      extent(p, &PositionValues::mean_plus_mm, &PositionValues::s_plus_mm);  // Eq. (6)
  v.A_minus = extent(p, &PositionValues::mean_minus_mm, &PositionValues::s_minus_mm);
  v.A = both(v.A_plus, v.A_minus);
  return v;
}

std::size_t positions_wanted(double travel_mm) {
  constexpr double kInterval_mm = 250, kFive = 5;
  const double wanted = travel_mm > kLong_mm ? travel_mm / kInterval_mm + 1
                                             : std::max(kFive, kFive * travel_mm / 1000);
  return static_cast<std::size_t>(std::ceil(wanted - 1e-9));  // rounding of the travel
}

std::size_t approaches_wanted(double travel_mm) { return travel_mm > kLong_mm ? 1 : 5; }

bool evenly_spaced(std::span<const Target> all) {
  if (all.size() < 3) return false;
  const double travel = all.back().q_mm - all.front().q_mm;
  const double step = travel / static_cast<double>(all.size() - 1);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (!(std::abs(all[i].q_mm - all[i - 1].q_mm - step) <= 1e-9 * travel)) return false;
  return true;
}

double error_at(const ErrorFunction& e, double q, double Q, double s) {
  const double t = q / Q;
  double sum = e.c[0] + t * (e.c[1] + t * (e.c[2] + t * e.c[3])) + s * e.b;
  for (std::size_t h = 0; h < e.f.size(); ++h) {
    const double hq = static_cast<double>(h + 1) * q;
    sum += e.f[h].a * std::cos(hq) + e.f[h].d * std::sin(hq);
  }
  return sum;
}

}  // namespace turnwright::volumetric
