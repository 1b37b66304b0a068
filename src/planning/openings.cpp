#include "openings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turnwright::planning {
namespace {

constexpr double kFarOpen = 1e9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Least share of what the cut may use of a tolerance, from conditions that keep every
// limit: one variable more, t, with value/limit - 1 <= t.
double least_share(const FeatureTask& task, const FeatureAnswer& a,
                   std::size_t tolerance) {
  const auto& m = *a.model;
  const auto& full = m.problem();
  const auto mine = [&](std::size_t i) {
    const auto& r = m.rows()[i];
    return r.check == Check::tolerance &&
           m.chain().functionals[r.operation].tolerance == tolerance;
  };
  const auto n = full.lower.size();
  optimise::Problem p{full.lower, full.upper, full.constraints, {}};
  p.lower.push_back(-1);
  p.upper.push_back(0.1);
  p.evaluate = [&](std::span<const double> y, optimise::Values& out) {
    optimise::Values v{0, std::vector<double>(n), std::vector<double>(full.constraints),
                       std::vector<double>(full.constraints * n)};
    full.evaluate(y.first(n), v);
    out.f = y[n];
    std::fill(out.df.begin(), out.df.end(), 0.0);
    out.df[n] = 1;
    for (std::size_t i = 0; i < full.constraints; ++i) {
      out.g[i] = v.g[i] - (mine(i) ? y[n] : 0);
      std::copy_n(v.dg.begin() + static_cast<long>(i * n), n,
                  out.dg.begin() + static_cast<long>(i * (n + 1)));
      out.dg[i * (n + 1) + n] = mine(i) ? -1 : 0;
    }
  };
  auto y = m.point(a.choice);
  y.push_back(0.01);
  const auto s = optimise::local_minimum(p, y);
  auto choice = a.choice;
  if (s.status != optimise::Status::no_feasible_point_met)
    choice = m.choice({s.y.begin(), s.y.end() - 1});
  const auto e = task.feature.profile(m.recipe(), task.economy, choice);
  for (const auto& d : task.demands)
    if (d.tolerance == tolerance) return std::min(1.0, 1 + worst_excess({d}, e));
  return 1;
}

// Where a tolerance stands once those before it are left out.
std::size_t place_of(const Feasibility& part, std::size_t limit, const Openings& times) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < limit; ++i)
    place += part.limits()[i].kind == Openable::Kind::tolerance && times[i] != kWithout;
  return place;
}

// Tries an opening; if it suffices, how far it might have been less by what was found.
double reached(Feasibility& part, std::size_t limit, Openings times, double opening) {
  times[limit] = opening;
  if (part.limits()[limit].kind != Openable::Kind::tolerance)
    return part.with(times) ? opening : kInfinity;
  const auto place = place_of(part, limit, times);
  const double now = name_of(part.plan(), part.limits()[limit]).now;
  double least = 0;  // the surface that asks for most
  const bool kept = part.with(times, [&](const FeatureTask& t, const FeatureAnswer& a) {
    for (const auto& d : t.demands)
      if (d.tolerance == place && d.shape != Demand::Shape::none) {
        const double left = now * opening - d.taken_mm;
        least = std::max(least, (d.taken_mm + left * least_share(t, a, place)) / now);
      }
  });
  if (!kept) return kInfinity;
  return least > 1 ? std::min(least, opening) : opening;
}

double rounded_up(double x) {
  const double digit = std::pow(10, std::floor(std::log10(x)) - 3);
  return std::ceil(x / digit * (1 - 1e-12)) * digit;
}

}  // namespace

double as_told(const LimitName& limit, double times) {
  if (limit.at_most) return rounded_up(limit.now * times) / limit.now;
  return rounded_up(times);
}

double opened_value(const LimitName& limit, double times) {
  return limit.at_most ? limit.now * times : limit.now / times;
}

std::optional<double> least_opening(Feasibility& part, std::size_t limit,
                                    Openings times) {
  const auto& l = part.limits()[limit];
  times[limit] = kWithout;
  if (!part.with(times)) return {};
  if (is_given(l) || l.kind >= Openable::Kind::depth_min) return kWithout;
  double low = 1, enough = reached(part, limit, times, kFarOpen);
  if (enough == kInfinity) return {};
  // Down in growing steps from what a local search reached to one that is refuted, and
  // by halving where none has searched.
  double step = kOpening;
  while (enough > low * kOpening) {
    const bool halve = l.kind != Openable::Kind::tolerance || !(enough / step > low);
    const double next = halve ? std::sqrt(enough * low) : enough / step;
    const double at = reached(part, limit, times, next);
    if (at < kInfinity) {
      enough = at;
      step *= step;
    } else {
      low = next;
      step = kOpening;
    }
  }
  const auto name = name_of(part.plan(), l);
  for (double more = 1; more < kOpening; more += 1e-3) {
    times[limit] = as_told(name, enough * more);
    if (part.with(times)) return times[limit];
  }
  return {};
}

}  // namespace turnwright::planning
